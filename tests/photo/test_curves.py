"""Curves are read without a key: where they are seen, within a pencil's width, and refused where they are none."""

from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray
from photo.drawn_flats import Camera, Sheet, cam, circle, diagram_sheet, profile_sheet
from scipy.spatial import cKDTree

from graphcam.photo.curve_grid import BEND_PRICE, CORNER_PRICE, MAX_BEND, best_way
from graphcam.photo.drawn_curves import CurveReading, read_curve
from graphcam.photo.flag_runs import bridged
from graphcam.photo.pencil_ink import ink_of

pytestmark = pytest.mark.slow

Points = NDArray[np.complex128]
MEDIAN, P95 = 0.1, 0.3
"""mm, of the places of a curve where it is seen."""
SHARE = 0.95


def read(sheet: Sheet, camera: Camera | None = None) -> CurveReading:
    return read_curve(ink_of(sheet.flat(camera), sheet.page()), sheet.view)


def distances(points: Points, line: Points) -> NDArray[np.float64]:
    """Of points (n,) from a line through dense ones (m,), mm."""
    fine = np.interp(np.arange(0, line.size - 1, 0.1), np.arange(line.size), line)
    tree = cKDTree(np.stack([fine.real, fine.imag], 1))
    return tree.query(np.stack([points.real, points.imag], 1))[0]


def assert_read(reading: CurveReading, drawn: Points) -> None:
    assert reading.refusal() is None
    assert reading.measures.share >= SHARE
    off = distances(reading.points[reading.seen], drawn)
    assert np.median(off) <= MEDIAN
    assert np.percentile(off, 95) <= P95


def why(reading: CurveReading) -> str:
    refusal = reading.refusal()
    assert refusal is not None
    return str(refusal[0])


@pytest.mark.parametrize(
    ("ink", "pen", "camera"),
    [
        ("colour", "HB", Camera()),
        ("colour", "2H", Camera(blur=0.15, noise=0.025)),
        ("colour", "blue biro", Camera()),
        ("colour", "red pencil", Camera()),
        ("grey", "2H", Camera()),
        ("colour", "HB", Camera(grey=True)),
    ],
)
def test_a_right_curve_among_its_construction(ink: str, pen: str, camera: Camera) -> None:
    sheet = profile_sheet(ink)
    sheet.with_construction(cam())
    drawn = sheet.by_hand(cam(), pen)
    assert_read(read(sheet, camera), np.append(drawn, drawn[:1]))


def test_a_rest_along_the_printed_circle_is_seen_if_drawn_and_only_then() -> None:
    drawn, left_out = profile_sheet(), profile_sheet()
    curve = cam()
    on_circle = np.abs(np.abs(curve) - 28) < 0.05
    drawn.stroke(np.append(curve, curve[:1]), "2H")
    left_out.stroke(np.roll(curve, -int(np.flatnonzero(on_circle)[-1]) - 1)[: int((~on_circle).sum())], "2H")
    full, part = read(drawn), read(left_out)
    assert full.measures.share > SHARE
    assert part.measures.share < 1 - 0.8 * on_circle.mean()
    assert "% of the curve can be seen" in why(part)
    resting = np.abs(np.abs(part.points[part.seen]) - 28) < 0.3
    assert resting.mean() < 0.1


def test_what_an_eraser_left_and_hatching_do_not_derail_it() -> None:
    sheet = profile_sheet()
    sheet.by_hand(cam() * (1 + 4 / np.abs(cam())), strength=0.25)
    for k in np.arange(-12, 12, 3.0):
        sheet.stroke(25 + 12j + np.exp(0.6j) * (k * 1j + np.array([-12, 12])), "fine")
    drawn = sheet.by_hand(cam())
    assert_read(read(sheet), np.append(drawn, drawn[:1]))


@pytest.mark.parametrize("part", [0.15, 0.4, 0.7])
def test_what_an_eraser_left_of_a_whole_curve_is_not_read_beside_a_part_of_a_dark_one(part: float) -> None:
    sheet = profile_sheet()
    curve = cam()
    sheet.stroke(np.append(curve, curve[:1]) * 0.8, strength=0.12)
    sheet.stroke(curve[: int(part * curve.size)], "blue biro")
    reading = read(sheet)
    assert reading.refusal() is not None
    assert reading.measures.share < 0.9 or reading.measures.darker > 0.1


def test_what_an_eraser_left_is_not_read_beside_a_whole_dark_curve() -> None:
    sheet = profile_sheet()
    curve = cam()
    sheet.stroke(np.append(curve, curve[:1]) * 0.8, strength=0.12)
    drawn = sheet.by_hand(curve, "blue biro")
    assert_read(read(sheet), np.append(drawn, drawn[:1]))


def test_the_edge_of_a_finger_is_no_darker_line() -> None:
    sheet = profile_sheet()
    drawn = sheet.by_hand(cam(), "2H")
    finger = np.array([-60 + 45j, 60 + 48j, 60 + 60j, -60 + 60j])
    sheet.fill(finger, (0.5, 0.3, 0.2))
    assert_read(read(sheet), np.append(drawn, drawn[:1]))


def test_a_foreign_curve_is_read_as_it_is() -> None:
    sheet = profile_sheet()
    foreign = circle(24)[:-1] + 9 + 5j
    drawn = sheet.by_hand(foreign)
    assert_read(read(sheet), np.append(drawn, drawn[:1]))


def test_points_run_counter_clockwise_from_the_origin_of_the_view() -> None:
    sheet = profile_sheet()
    sheet.by_hand(cam())
    points = read(sheet).points
    turns = np.angle(np.roll(points, -1) / points)
    assert turns.min() > -0.005
    assert turns.sum() == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("apart", [2.0, 4.0])
@pytest.mark.parametrize("whole", [True, False])
def test_two_curves_are_refused(apart: float, whole: bool) -> None:
    sheet = profile_sheet()
    curve = cam()
    sheet.by_hand(curve)
    second = curve * (1 + apart / np.abs(curve))
    sheet.by_hand(second) if whole else sheet.stroke(second[: second.size // 2])
    assert "second curve" in why(read(sheet))


def test_two_lines_beside_each_other_are_refused() -> None:
    sheet = profile_sheet()
    curve = cam()
    sheet.stroke(curve)
    sheet.stroke(curve * (1 + 1.1 / np.abs(curve)))
    reading = read(sheet)
    assert reading.refusal() is not None
    assert reading.measures.twin > 0.5


def test_half_a_curve_is_refused_and_its_other_half_is_nowhere() -> None:
    sheet = profile_sheet()
    curve = cam()
    sheet.with_construction(curve)
    sheet.stroke(curve[: curve.size // 2])
    reading = read(sheet)
    assert reading.measures.share < 0.7
    assert "can be seen" in why(reading)
    missing = np.isnan(reading.points)
    assert missing.mean() > 0.3
    assert not (reading.seen & missing).any()


@pytest.mark.parametrize("construction", [True, False])
def test_an_empty_sheet_is_refused(construction: bool) -> None:
    sheet = profile_sheet()
    if construction:
        sheet.with_construction(cam())
    assert why(read(sheet)) == "no curve can be seen"


@pytest.mark.parametrize("seed", range(4))
def test_scribbles_are_refused(seed: int) -> None:
    sheet = profile_sheet(seed=seed)
    rng = np.random.default_rng(seed)
    for _ in range(5):
        steps = np.cumsum(np.cumsum(rng.normal(size=(400, 2)), 0) @ np.array([1, 1j]) * 0.02)
        steps = np.convolve(steps, np.ones(9) / 9, "valid")
        sheet.stroke(steps / np.abs(steps).max() * 30 + 15 * np.exp(2j * np.pi * rng.random()))
    assert read(sheet).refusal() is not None


def test_a_short_gap_is_bridged_by_the_run_of_its_neighbours_and_a_long_one_is_not() -> None:
    for gap, short in ((5.0, True), (20.0, False)):
        sheet = profile_sheet()
        curve = cam()
        kept = np.cumsum(np.abs(np.gradient(curve))) > gap
        sheet.stroke(curve[kept], "HB")
        reading = read(sheet)
        unseen = ~reading.seen
        assert unseen.any()
        assert (reading.refusal() is None) == short
        assert np.isfinite(reading.points[unseen]).all() == short
        if short:
            assert distances(reading.points[unseen], curve).max() < P95


def test_under_black_print_nothing_is_seen() -> None:
    sheet = profile_sheet()
    sheet.by_hand(cam())
    place = cam()[400]
    sheet.print_black((place.real - 1, place.imag - 1, place.real + 1, place.imag + 1))
    reading = read(sheet)
    assert 0.01 < reading.measures.hidden < 0.1
    assert reading.measures.share > SHARE
    under = np.abs(reading.points - place) < 1
    assert under.any()
    assert not reading.seen[under].any()


def diagram(amplitude: float) -> Points:
    """A displacement over the axis with a rise, a dwell, a fall and a rest."""
    x = np.linspace(0, 96, 1921)
    rise, fall = np.clip(x / 30, 0, 1), np.clip((x - 45) / 30, 0, 1)
    return x + 1j * amplitude * (np.sin(np.pi * rise / 2) ** 2 - np.sin(np.pi * fall / 2) ** 2)


@pytest.mark.parametrize("amplitude", [12.0, 38.0])
def test_a_displacement_over_its_axis(amplitude: float) -> None:
    sheet = diagram_sheet()
    curve = diagram(amplitude)
    for place in curve[::160]:
        sheet.stroke(np.array([place.real, place]), "fine")
        sheet.cross(place)
    drawn = sheet.by_hand(curve, "2H")
    reading = read(sheet)
    assert_read(reading, drawn)
    assert (np.diff(reading.points.real) > -0.5).all()


def test_a_velocity_with_a_corner_goes_below_the_axis() -> None:
    sheet = diagram_sheet()
    x = np.linspace(0, 96, 1921)
    curve = x + 1j * np.interp(x, [0, 16, 32, 50, 63, 76, 96], [0, 35, 0, 0, -38, 0, 0])
    sheet.stroke(curve, "HB")
    assert_read(read(sheet), curve)


def test_half_a_diagram_is_refused() -> None:
    sheet = diagram_sheet()
    sheet.stroke(diagram(30)[:1000])
    reading = read(sheet)
    assert reading.refusal() is not None
    assert np.isnan(reading.points[-30:]).all()


def test_the_best_way_is_the_best_of_all() -> None:
    rng = np.random.default_rng(5)
    for _ in range(5):
        rewards = rng.normal(size=(4, 5, 3)).astype(np.float32)
        found = best_way(rewards, wraps=False)
        best = max(_value(rewards, start, slopes) for start in range(5) for slopes in product((-1, 0, 1), repeat=4))
        assert _value(rewards, int(found.states[0]), tuple(found.slopes.tolist())) == pytest.approx(best, abs=1e-5)


def _value(rewards: NDArray[np.float32], start: int, slopes: tuple[int, ...]) -> float:
    state, value = start, 0.0
    for k, slope in enumerate(slopes):
        if not 0 <= state < 5:
            return -np.inf
        value += float(rewards[k, state, slope + 1])
        if k:
            turn = abs(slope - slopes[k - 1])
            value -= min(BEND_PRICE * turn, CORNER_PRICE) if turn <= MAX_BEND else CORNER_PRICE
        state += slope
    return value if 0 <= state < 5 else -np.inf


def test_bridges_follow_an_arc() -> None:
    arc = circle(50)[:90]
    seen = np.ones(90, bool)
    seen[40:50] = False
    found = bridged(np.where(seen, arc, 0), seen, np.full(90, 0.44), wraps=False)
    assert np.abs(np.abs(found) - 50).max() < 0.02
