"""The simulator keeps its own laws: what it says of where things are is where they are."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from bent_paper import Bend, Floats
from camera import Camera, Eye, Scanner, Upright, aimed, rotation, seen_places
from exposure import Sensor
from hand import by_hand, even, goes, hatching, normals, wobble
from pencil import FULL, PENS, Leaf, Stroke
from photograph import Shot, photographed
from printer import RENDERERS, Placing, Print, Printer, screened
from stand_in import drawn_page, stand_in

from graphcam.photo.tags import find_tags

pytestmark = pytest.mark.slow

PAGE = (420.0, 297.0)
MIDDLE = complex(*PAGE) / 2
SIZE = (1000, 750)


def camera(bend: Bend, size: tuple[int, int] = SIZE) -> Camera:
    return aimed(PAGE, size, rotation(20, -15, 183), bend, lens=(-0.05, 0.01), aside=0.3 - 0.2j)


EYES: dict[str, Eye] = {
    "flat": camera(Bend.none(MIDDLE)),
    "curl": camera(Bend.curl(MIDDLE, np.exp(0.1j), 210, 8, 1.5)),
    "turned": Upright(camera(Bend.none(MIDDLE)), 1),
    "scanner": Scanner((990, 700), (2.35, 2.36), 0.01, 3 + 699j),
}


def off_in_the_map(eye: Eye) -> Floats:
    """By how many pixels some pixels of an eye's picture miss the places that they see."""
    across, up = (np.asarray(part[::5, ::7], np.float64) for part in seen_places(eye, PAGE).fine)
    inside = (across > 0) & (across < PAGE[0]) & (up > 0) & (up < PAGE[1])
    assert inside.mean() > 0.5
    rows, columns = np.nonzero(inside)
    return np.abs(eye.pixels((across + 1j * up)[inside]) - (7 * columns + 5j * rows))


@pytest.mark.parametrize("name", EYES)
def test_every_pixel_sees_the_place_that_is_seen_there(name: str) -> None:
    assert off_in_the_map(EYES[name]).max() < 0.01


def test_at_a_fold_the_map_is_off_by_less_than_a_third_of_a_pixel() -> None:
    off = off_in_the_map(camera(Bend.fold(MIDDLE, np.exp(0.1j), (20.0,), 15), (2592, 1944)))
    assert np.percentile(off, 99) < 0.05
    assert off.max() < 0.3


def test_the_paper_fills_the_picture_and_lies_within_it() -> None:
    corners = np.array([0, PAGE[0], complex(*PAGE), 1j * PAGE[1]])
    seen = camera(Bend.none(MIDDLE)).pixels(corners)
    assert 0 < seen.real.min() < seen.real.max() < SIZE[0]
    assert 0 < seen.imag.min() < seen.imag.max() < SIZE[1]
    assert max(np.ptp(seen.real) / SIZE[0], np.ptp(seen.imag) / SIZE[1]) == pytest.approx(0.92, abs=0.01)


@pytest.mark.parametrize(
    "bend", [Bend.curl(MIDDLE, 1 + 0j, 210, 12, 2.0), Bend.fold(MIDDLE, 1j, (10.0,), 15)], ids=["curl", "fold"]
)
def test_bent_paper_keeps_its_lengths(bend: Bend) -> None:
    along = bend.towards * np.linspace(-150, 150, 3001)
    plan, height = bend.raised(MIDDLE + along)
    length = np.hypot(np.abs(np.diff(plan)), np.diff(height)).sum()
    assert length == pytest.approx(300, abs=0.01)


def test_curled_paper_lifts_its_edge_by_so_much() -> None:
    _, height = Bend.curl(MIDDLE, 1 + 0j, 210, 8.0, 1.5).raised(np.array([0.0, 420.0]) + 0j)
    assert height == pytest.approx([8.0, 8.0], abs=0.1)


def test_a_hand_strays_as_much_as_it_is_told() -> None:
    strays = wobble(40_000, 0.2, np.random.default_rng(1), closed=True)
    assert np.sqrt(np.mean(strays**2)) == pytest.approx(0.2)
    # 12 mm away it strays little alike, 3 mm away nearly the same.
    alike = [float(np.mean(strays * np.roll(strays, steps)) / 0.04) for steps in (12, 48, 200)]
    assert alike[0] > 0.9
    assert alike[1] == pytest.approx(np.exp(-1), abs=0.08)
    assert abs(alike[2]) < 0.12


def test_a_line_in_several_goes_is_all_of_the_line() -> None:
    circle = 40 * np.exp(2j * np.pi * np.arange(500) / 500)
    rng = np.random.default_rng(2)
    line = by_hand(circle, 0.1, rng, closed=True)
    drawn = np.concatenate(goes(line, rng, closed=True))
    assert np.abs(line[:, None] - drawn[::3]).min(axis=1).max() < 0.5
    assert np.abs(normals(even(circle, closed=True), closed=True)) == pytest.approx(1.0)


def test_hatching_stays_within_its_outline() -> None:
    outline = 10 * np.exp(2j * np.pi * np.arange(60) / 60)
    strokes = hatching(outline, 0.7, 2.0, np.random.default_rng(3))
    assert len(strokes) >= 8
    assert max(float(np.abs(stroke.points).max()) for stroke in strokes) < 11.5


@pytest.mark.parametrize("pen", ["HB", "2H", "biro-blue"])
def test_a_line_is_where_it_was_drawn_and_as_dark_as_its_pen(pen: str) -> None:
    bare = np.full((300, 600, 3), 255, np.uint8)
    leaf = Leaf(bare, 300 / 12, 12.0, np.random.default_rng(4))
    height = 11.37
    line = np.linspace(5, 45, 200) + 1j * height
    leaf.draw([Stroke.of(line, leaf.rng, uneven=0.0)], PENS[pen])
    dark = 1 - leaf.light[:, 120:480, 1] / FULL
    rows = np.arange(300)[:, None]
    middle = float((dark * rows).sum() / dark.sum())
    assert leaf.height - (middle + 0.5) / 12 == pytest.approx(height, abs=0.02)
    assert dark.mean(axis=1).max() == pytest.approx(1 - PENS[pen].through[1], abs=0.15)
    across = dark.mean(axis=1)
    assert (across > across.max() / 2).sum() / 12 == pytest.approx(PENS[pen].width, abs=0.15)


def test_what_was_rubbed_out_is_fainter() -> None:
    found: list[float] = []
    for pen in (PENS["HB"], PENS["HB"].lighter(0.2)):
        leaf = Leaf(np.full((120, 360, 3), 255, np.uint8), 10, 12.0, np.random.default_rng(5))
        leaf.draw([Stroke.of(np.linspace(2, 28, 100) + 5j, leaf.rng)], pen)
        found.append(float(1 - leaf.light[..., 1].min() / FULL))
    assert found[1] < 0.45 * found[0]


@pytest.mark.parametrize("printer", [Printer(), Printer(106, 0.9), Printer(0, 1.0)], ids=["laser", "coarse", "jet"])
def test_a_tint_is_dissolved_into_so_much_ink(printer: Printer) -> None:
    tint = np.full((600, 600, 3), 255, np.uint8)
    tint[100:500, 100:500] = 255 * 65 // 100
    light = screened(tint, printer)[60:240, 60:240] / 255
    assert light.mean() == pytest.approx(1 - 0.35 * (1 - 0.03), abs=0.05)
    assert (screened(tint, printer)[:40] == 255).all()


def test_a_printer_puts_the_page_where_it_says() -> None:
    placing = Placing((1.012, 0.99), 0.003, 1.2 - 0.7j)
    points = np.array([0, 100, 100 + 50j])
    assert placing.page(placing.paper(points)) == pytest.approx(points)
    # A hand measures true millimetres: 101.2 of them are 100 of the page.
    on_paper = placing.paper(placing.by_hand(np.array([0, 101.2])))
    assert abs(on_paper[1] - on_paper[0]) == pytest.approx(101.2)
    assert placing.by_hand(np.array([101.2]))[0] == pytest.approx(100)


def test_both_renderers_draw_the_same(tmp_path_factory: pytest.TempPathFactory) -> None:
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle

    folder = tmp_path_factory.mktemp("pdf")
    figure = Figure(figsize=(100 / 25.4, 50 / 25.4))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 100), ylim=(0, 50))
    axes.axis("off")
    axes.add_patch(Rectangle((20, 10), 40, 25, color="black", linewidth=0))
    figure.savefig(folder / "page.pdf")
    for renderer in RENDERERS.values():
        dark = np.argwhere(renderer(folder / "page.pdf", 0)[..., 1] < 128)
        (top, left), (bottom, right) = dark.min(axis=0), dark.max(axis=0)
        per_mm = 600 / 25.4
        found = [left / per_mm, 50 - (bottom + 1) / per_mm, (right + 1) / per_mm, 50 - top / per_mm]
        assert found == pytest.approx([20, 10, 60, 35], abs=0.06)


@pytest.fixture(scope="module")
def print_of_the_stand_in() -> Print:
    return screened(drawn_page(stand_in()), Printer())


@pytest.mark.parametrize("quarters", [0, 3])
def test_tags_are_seen_where_the_truth_says(print_of_the_stand_in: Print, quarters: int) -> None:
    page, bend = stand_in(), Bend.none(MIDDLE)
    eye = aimed(PAGE, (2592, 1944), rotation(12, -8, 2), bend, lens=(-0.04, 0.0))
    shot = Shot(eye, bend, Placing((1.01, 0.995), 0.002, 1j), Sensor(moved=1.5 + 0.5j), quarters=quarters, focal=0.75)
    rng = np.random.default_rng(6)
    leaf = Leaf(print_of_the_stand_in, page.height, 300 / 25.4, rng)
    data = np.frombuffer(photographed(leaf.light, PAGE, leaf.per_mm, shot, rng), np.uint8)
    # OpenCV turns the picture as the file says.
    grey = cv2.imdecode(data, cv2.IMREAD_GRAYSCALE)
    assert grey is not None
    assert grey.shape[::-1] == shot.upright.size
    tags = find_tags(np.asarray(grey, np.uint8))
    assert len(tags.numbers) == len(page.tags)
    corners = np.array([page.tags[number] for number in tags.numbers.tolist()])[:, None]
    off = tags.corners - shot.pixels(corners + page.tag_side * np.array([0, 1, 1 + 1j, 1j]))
    assert np.sqrt(np.mean(np.abs(off) ** 2)) < 0.3
    assert abs(off.mean()) < 0.1
