"""The working drawing as a sheet: nothing lies on anything, it is true to scale, and CAD programs can go on with it."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from over_all import over_all
from overlaps import overlaps
from random_tasks import random_flat_task
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.drafting.marks import Role
from graphcam.errors import DesignError
from graphcam.language import language
from graphcam.report.output_folder import write
from graphcam.sheets.cad_renderer import write_cad
from graphcam.sheets.model import Curve, Drawing, Heads, Length, Stroke, Strokes, Text
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import TranslatingTable
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.part_layout import standard_ratios
from graphcam.workshop.part_outline import outline_of
from graphcam.workshop.working_drawing import working_drawing_of

NAMES = ("coursework", "arm", "flat", "measured", "arcs")
HUB = PartTable(bore=16, width=12, hub_diameter=32, hub_length=25, cutter_radius=8, table_step=10)
FORMATS = {(420.0, 297.0), (594.0, 420.0), (841.0, 594.0)}


@cache
def solved(name: str, frame: str = "gost", language: str = "en", part: PartTable | None = None) -> AnySolution:
    task = gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name)
    return gc.solve(replace(task, drawing=replace(task.drawing, frame=frame, language=language), part=part))


@cache
def drawn(name: str, frame: str = "gost", language: str = "en", part: PartTable | None = None) -> Drawing:
    return working_drawing_of(PartContents(solved(name, frame, language, part)))


def texts(drawing: Drawing) -> list[str]:
    return [e.text for page in drawing.pages for g in page.groups for e in g.entities if isinstance(e, Text)]


def undercut_task() -> gc.Task:
    task = gc.builtin_task()
    follower, cam = replace(task.follower, roller_radius=40.0), replace(task.cam, prime_radius=45.0)
    return replace(task, follower=follower, cam=cam, part=PartTable(bore=6.0, keyway="none"))


@pytest.mark.slow
@over_all(("frame", "language"), [("gost", "ru"), ("iso", "en")])
@over_all("name", NAMES)
def test_no_text_lies_on_a_text_or_on_a_bold_line(name: str, frame: str, language: str) -> None:
    drawing = drawn(name, frame, language)
    assert overlaps(drawing) == []
    assert {(page.width, page.height) for page in drawing.pages} <= FORMATS


OTHER_PARTS = [
    ("coursework", "gost", HUB),
    ("flat", "iso", PartTable(keyway="none")),
    ("flat", "gost", PartTable(bore=8, width=60)),
    ("coursework", "iso", PartTable(table_step=1)),
]


@pytest.mark.slow
@over_all(("name", "frame", "part"), OTHER_PARTS)
def test_other_parts_are_as_clear(name: str, frame: str, part: PartTable) -> None:
    assert overlaps(drawn(name, frame, "ru", part)) == []


@pytest.mark.parametrize("size", [0.01, 0.3, 7.0, 400.0])
def test_small_and_large_cams_have_a_standard_scale(size: float) -> None:
    task = gc.builtin_task("flat")
    phases = tuple(replace(p, lift=p.lift * size) if hasattr(p, "lift") else p for p in task.motion.phases or ())
    limits = replace(task.limits, min_curvature_radius=None)
    motion, cam = replace(task.motion, phases=phases), replace(task.cam, prime_radius=20 * size)
    # For small bores the standards have no keys, so one is given.
    part = PartTable(bore=6 * size, keyway="none") if size < 1 else None
    changed = replace(task, motion=motion, cam=cam, limits=limits, part=part)
    drawing = working_drawing_of(PartContents(gc.solve(changed)))
    assert overlaps(drawing) == []
    scale = next(text for text in texts(drawing) if re.fullmatch(r"[\d.e+]+:[\d.e+]+", text))
    over, under = map(float, scale.split(":"))
    mantissa = f"{max(over, under):.6e}"[0]
    assert min(over, under) == 1
    assert mantissa in "125"


def profile(drawing: Drawing) -> np.ndarray:
    page = drawing.pages[0]
    (outline,) = [
        e
        for g in page.groups
        if g.name == "front"
        for e in g.entities
        if isinstance(e, Curve) or (isinstance(e, Stroke) and e.closed and len(e.points) > 100)
    ]
    return outline.points - page.origins["front"]


@pytest.mark.parametrize("name", NAMES)
def test_the_true_view_is_the_profile_at_its_scale(name: str) -> None:
    """Turned so that the zero mark is up, and not mirrored: the distances from the axis are those of profile.csv."""
    drawing, solution = drawn(name), solved(name)
    points, outline = profile(drawing), outline_of(solution)
    scale = np.abs(points).max() / outline.greatest_radius
    assert any(abs(scale - ratio) < 1e-6 for ratio, _ in zip(standard_ratios(10), range(12), strict=False))
    cam_sense = -outline.sense
    turned = points / scale * np.exp(1j * (outline.zero - np.pi / 2))
    if isinstance(solution, gc.Solution):
        exact = solution.cam.trimmed_profile(5000) @ [1, 1j]
        assert cam_sense == solution.cam.sigma
        assert max(np.abs(exact - point).min() for point in turned[::40]) < 0.05
    up = points[np.argmin(np.abs(np.angle(points / 1j)))]
    assert abs(up) / scale == pytest.approx(outline.least_radius, rel=1e-4)


def test_the_section_shows_width_bore_and_hub_to_scale() -> None:
    drawing = drawn("flat", part=HUB)
    (section,) = [g for g in drawing.pages[0].groups if g.name == "section"]
    measured = {
        t.text: abs(t.of.end - t.of.start) for t in section.entities if isinstance(t, Text) and isinstance(t.of, Length)
    }
    scale = np.abs(profile(drawing)).max() / 50
    assert measured == pytest.approx({"12": 12 * scale, "25": 25 * scale, "⌀32": 32 * scale})


@pytest.mark.parametrize("name", ["coursework", "arcs"])
def test_dxf_has_dimensions_and_blocks_and_is_clean(tmp_path: Path, name: str) -> None:
    write_cad(drawn(name), tmp_path / "part.dxf")
    document = ezdxf.readfile(tmp_path / "part.dxf")
    auditor = document.audit()
    assert (len(auditor.errors), len(auditor.fixes)) == (0, 0)
    said = {d.dxf.text: d.get_measurement() for d in document.modelspace().query("DIMENSION")}
    written = " ".join(text.dxf.text for text in document.modelspace().query("TEXT"))
    part = PartContents(solved(name)).part
    width = next(measured for text, measured in said.items() if text == f"{part.width:g}")
    assert any(
        width == pytest.approx(part.width * ratio) for ratio, _ in zip(standard_ratios(10), range(9), strict=False)
    )
    assert re.search(r"⌀.*H7", written)
    assert "JS9" in written or any("JS9" in text for text in said)
    # For reference: the tolerance of the profile limits them.
    assert len(re.findall(r"R[\d.]+\*", f"{written} {' '.join(said)}")) == 2
    (block,) = document.modelspace().query("INSERT")
    entries = {attribute.dxf.tag: attribute.dxf.text for attribute in block.attribs}
    assert float(entries["MASS"]) == pytest.approx(part.mass(PartContents(solved(name)).outline.area), rel=0.005)
    assert " ".join(text for tag, text in entries.items() if tag.startswith("MATERIAL")) == "Steel 45 GOST 1050-2013"


def test_every_row_of_the_table_is_on_the_drawing() -> None:
    rows = PartContents(solved("coursework")).table
    said = texts(drawn("coursework"))
    assert {f"{angle:g}" for angle in rows.angles} <= set(said)
    assert sum(text == "27.00" for text in said) == np.count_nonzero(rows.radii.round(2) == 27)


@pytest.mark.slow
def test_a_long_table_goes_on_on_further_pages() -> None:
    drawing = drawn("coursework", "iso", "en", PartTable(profile_tolerance=0.002, table_step=1, cutter_radius=5))
    assert len(drawing.pages) > 1
    assert overlaps(drawing) == []
    rows = PartContents(
        solved("coursework", "iso", "en", PartTable(profile_tolerance=0.002, table_step=1, cutter_radius=5))
    )
    said = texts(drawing)
    assert {f"{angle:g}" for angle in rows.table.angles} <= set(said)


def test_an_undercut_cam_says_so_and_keeps_its_corner() -> None:
    drawing = working_drawing_of(PartContents(gc.solve(undercut_task())))
    assert overlaps(drawing) == []
    assert any("undercut leaves a corner" in text for text in texts(drawing))


@pytest.mark.parametrize("frame", ["gost", "iso"])
def test_the_standards_of_the_frame_are_named(frame: str) -> None:
    said = " ".join(texts(drawn("coursework", frame)))
    assert ("GOST 30893.1" in said, "ISO 2768" in said) == (frame == "gost", frame == "iso")
    assert ("GOST 23360" in said, "DIN 6885" in said) == (frame == "gost", frame == "iso")
    assert {"Ra 0.8", "Ra 1.6", "Ra 3.2", "A–A"} <= set(texts(drawn("coursework", frame)))


def test_deviations_are_told_as_the_frame_standard_tells_them() -> None:
    """ISO 129-1 tells a zero deviation, GOST 2.307 leaves it out."""
    part = PartTable(bore=20)
    over = "⌀20 H7 (^{+0.021}"
    assert {"22.8^{+0.1}_{0}", f"{over}_{{0}})"} <= set(texts(drawn("coursework", "iso", part=part)))
    assert {"22.8^{+0.1}_{}", f"{over}_{{}})"} <= set(texts(drawn("coursework", "gost", part=part)))


def test_the_profile_is_toleranced_from_bore_and_keyway_and_the_keyway_from_the_bore() -> None:
    with_keyway, without = (texts(drawn("coursework", part=PartTable(keyway=k))) for k in (None, "none"))
    # The bore's letter stands in its own square and in the frames of profile, side and keyway.
    assert (with_keyway.count("B"), with_keyway.count("D")) == (4, 2)
    assert (without.count("B"), without.count("D")) == (3, 0)
    assert any("radius of its corners 0.16...0.25 mm" in text for text in with_keyway)


def test_a_part_has_its_own_name_and_number_and_no_rule() -> None:
    told = texts(drawn("coursework", part=PartTable(name="Feed cam", number="KM-1.02")))
    assert {"Feed cam", "KM-1.02"} <= set(told)
    assert "mm, true to scale" not in told
    assert "Cam" in texts(drawn("coursework"))
    with pytest.raises(DesignError, match=r"length of part\.number"):
        drawn("coursework", part=PartTable(number="KM" * 200))


def test_a_cam_that_is_next_to_nothing_is_refused() -> None:
    with pytest.raises(DesignError, match=r"mass of the cam is 7e-05 kg, but must be at least 0\.001 kg"):
        PartContents(solved("coursework", part=PartTable(bore=28.0, width=0.0023))).check()
    small = replace(undercut_task(), part=PartTable())
    with pytest.raises(DesignError, match=r"minimum radius of the profile is 5 mm, .* or give part\.bore"):
        PartContents(gc.solve(small)).check()


def strokes(drawing: Drawing, group: str, role: str) -> np.ndarray:
    """Starts and ends of the straight lines of a role (n, 2)."""
    (drawn,) = [g for g in drawing.pages[0].groups if g.name == group]
    pieces = [np.array([e.starts, e.ends]).T for e in drawn.entities if isinstance(e, Strokes) and e.role == role]
    return np.concatenate(pieces)


@pytest.mark.parametrize("seed", [None, 1, 4])
def test_lines_to_the_profile_cross_no_radius(seed: int | None) -> None:
    solution = solved("flat", "iso") if seed is None else gc.solve(random_flat_task(seed))
    drawing = working_drawing_of(PartContents(solution))
    lines = strokes(drawing, "front", Role.DIMENSION)
    origin = drawing.pages[0].origins["front"]
    of_radius = np.abs(lines[:, 0] - origin) < 1e-9
    assert np.count_nonzero(of_radius) == 2
    for start, end in lines[of_radius]:
        seen = (lines[~of_radius] - start) / (end - start)
        across = seen[:, 0].imag * seen[:, 1].imag < 0
        share = seen[across, 0].imag / (seen[across, 0].imag - seen[across, 1].imag)
        at = (seen[across, 0] + share * (seen[across, 1] - seen[across, 0])).real
        assert not np.any((at > 0) & (at < 1))


@pytest.mark.parametrize("part", [None, PartTable(keyway="none")])
def test_the_section_shows_all_four_ends_of_the_chamfers(part: PartTable | None) -> None:
    edges = strokes(drawn("coursework", part=part), "section", Role.RESULT)
    ways = edges[:, 1] - edges[:, 0]
    assert np.count_nonzero((np.abs(ways.real) > 1e-9) & (np.abs(ways.imag) > 1e-9)) == 4


def test_lines_to_the_side_of_an_undercut_cam_end_on_what_is_seen_of_it() -> None:
    """Of the half in front of the cutting plane, which is cut away, nothing is seen, however far it reaches."""
    drawing = working_drawing_of(PartContents(gc.solve(undercut_task())))
    origin = drawing.pages[0].origins["section"]
    (section,) = [g for g in drawing.pages[0].groups if g.name == "section"]
    heads = np.concatenate([e.corners for e in section.entities if isinstance(e, Heads)]) - origin
    # From the left; those of the width come from the right.
    on_side = heads[(np.abs(heads[:, 0].real) < 1e-6) & (heads[:, 1].real < 0), 0]
    edges = strokes(drawing, "section", Role.RESULT) - origin
    assert on_side.size >= 2
    assert edges.imag.min() < on_side.imag.min() < 0 < on_side.imag.max() < edges.imag.max()


def test_masses_have_no_powers_of_ten() -> None:
    for width, told in ((0.0023, "0.0000675"), (230000.0, "6751")):
        contents = PartContents(solved("coursework", part=PartTable(bore=28.0, width=width)))
        assert contents.title(1.0).mass == told


def test_a_cam_that_is_not_hardened_has_no_note_of_it() -> None:
    assert not any("hardened" in text for text in texts(drawn("coursework", part=PartTable(hardness=""))))


def test_files_are_written_and_named(tmp_path: Path) -> None:
    files = write(solved("flat"), tmp_path / "out", ["note"], working_drawing=True)
    expected = {kind: f"working-drawing.{kind}" for kind in ("pdf", "svg", "dxf")}
    assert {kind: files[f"working_drawing_{kind}"] for kind in expected} == expected
    document = json.loads((tmp_path / "out" / "solution.json").read_text(encoding="utf-8"))
    assert document["files"] == files
    assert all((tmp_path / "out" / name).stat().st_size > 0 for name in expected.values())
    assert "working_drawing_pdf" not in write(solved("flat"), tmp_path / "plain", ["note"])


def test_a_worksheet_has_no_working_drawing(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match="it would give the answers away"):
        write(solved("flat"), tmp_path / "out", upto=0, working_drawing=True)
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_part_that_cannot_be_ends_the_command_with_one_message(tmp_path: Path) -> None:
    text = (Path(gc.__file__).parent / "data" / "tasks" / "flat.toml").read_text(encoding="utf-8")
    (tmp_path / "cam.toml").write_text(text + "\n[cam]\nprime_radius = 40\n\n[part]\nbore = 60\n", encoding="utf-8")
    for more in ([], ["--json"]):
        asked = ["solve", str(tmp_path / "cam.toml"), "--working-drawing", *more]
        result = CliRunner().invoke(app, asked if more else [*asked, "--out", str(tmp_path / "out")])
        assert result.exit_code == 2
        (last,) = [line for line in result.stderr.splitlines() if line.startswith("graphcam:")]
        assert "part.bore" in last
    assert not (tmp_path / "out").exists()


def test_two_runs_draw_the_same() -> None:
    first, second = (working_drawing_of(PartContents(solved("coursework"))) for _ in range(2))
    assert texts(first) == texts(second)


def test_a_given_size_is_told_as_it_is_given() -> None:
    part = PartTable(bore=12.345, width=7.125, keyway="none", cutter_radius=3.125)
    told = texts(drawn("coursework", part=part))
    assert any(text.startswith("⌀12.345 H7") for text in told)
    assert "7.125" in told
    assert any("cutter of radius 3.125 mm" in text for text in told)


def test_a_zero_mark_in_an_undercut_is_not_said_to_be_met() -> None:
    phases = (ReturnTable(20.0, 30.0, "cosine"), DwellTable(300.0), RiseTable(40.0, 30.0, "cosine"))
    task = gc.builtin_task()
    sized = replace(
        task,
        motion=MotionTable(phases),
        follower=TranslatingTable(offset=0.0, roller_radius=40.0),
        cam=replace(task.cam, prime_radius=50.0),
    )
    contents = PartContents(gc.solve(sized))
    assert not contents.outline.zero_met
    notes = " ".join(texts(working_drawing_of(contents)))
    assert "lost to the undercut" in notes
    assert "there the follower meets" not in notes
    assert all(PartContents(solved(name)).outline.zero_met for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_built_in_task_is_called_in_the_language_of_the_sheet(name: str) -> None:
    """What a Russian sheet says in its title block has no Latin letter."""
    title = solved(name, language="ru").task.title
    assert re.fullmatch(r"[А-Яа-яё ]+", title.translated_name(language("ru").text))
    assert title.translated_name(str) == title.name
