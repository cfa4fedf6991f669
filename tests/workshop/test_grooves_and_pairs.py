"""Working drawings of grooved cams and of conjugate pairs, against walls that are worked out here from the motion."""

from dataclasses import replace
from functools import cache
from math import pi, radians

import numpy as np
import pytest
from numpy.typing import NDArray
from overlaps import overlaps
from shapely import Polygon

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.sheets.model import Text
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import CamTable, OscillatingTable, TranslatingTable
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.working_drawing import working_drawing_of

PHASES = RiseTable(120, 20, "cycloidal"), DwellTable(60), ReturnTable(120, 20, "3-4-5"), DwellTable(60)
STEM, ARM = TranslatingTable(0.0, 10.0), OscillatingTable(90.0, 110.0, 10.0, lift="arc")
GROOVE = PartTable(groove_depth=12.0)
PAIR = PartTable(second_roller=(0.0, -90.0), second_roller_radius=8.0)
PHI = np.linspace(0, 2 * pi, 200_000, endpoint=False)


@cache
def contents(
    part: PartTable, follower: TranslatingTable | OscillatingTable = STEM, language: str = "en"
) -> PartContents:
    task = gc.Task("cw", MotionTable(PHASES), follower, cam=CamTable(50.0), part=part)
    return PartContents(gc.solve(replace(task, drawing=replace(task.drawing, language=language))))


def displacement() -> NDArray[np.float64]:
    """s of the phases above, by their formulas."""
    deg, s = np.degrees(PHI), np.zeros(PHI.size)
    u, w = deg / 120, 1 - (deg - 180) / 120
    s[deg < 120] = 20 * (u - np.sin(2 * pi * u) / (2 * pi))[deg < 120]
    s[(deg >= 120) & (deg < 180)] = 20
    back = (deg >= 180) & (deg < 300)
    s[back] = 20 * (10 * w**3 - 15 * w**4 + 6 * w**5)[back]
    return s


def parallel(centres: NDArray[np.complex128], outwards: float) -> NDArray[np.complex128]:
    """The curve beside the path of a roller's centre on a cam that turns clockwise, which runs anticlockwise."""
    along = np.roll(centres, -1) - np.roll(centres, 1)
    return centres - 1j * outwards * along / np.abs(along)


def radii(curve: NDArray[np.complex128], angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """The radii of a closed curve at angles from the upward direction, anticlockwise."""
    at = np.angle(curve / 1j)
    order = np.argsort(at)
    return np.interp(np.angle(np.exp(1j * angles)), at[order], np.abs(curve)[order], period=2 * pi)


def test_the_table_of_a_groove_has_both_walls_of_the_rollers_path() -> None:
    table, path = contents(GROOVE).table, 1j * (50 + displacement()) * np.exp(1j * PHI)
    assert table.wall is not None
    for column, outwards in ((table.radii, -10.0), (table.wall, 10.0)):
        assert np.abs(column - radii(parallel(path, outwards), np.radians(table.angles))).max() < 1e-5


def test_the_second_cam_is_the_parallel_curve_of_its_rollers_path_and_timed_by_the_same_key() -> None:
    """The zero mark is over the keyways of both, so its table counts from the first roller's direction."""
    second = replace(contents(PAIR), second=True)
    path = 1j * (displacement() - 90) * np.exp(1j * PHI)
    own = radii(parallel(path, -8.0), np.radians(second.table.angles))
    assert np.abs(second.table.radii - own).max() < 1e-5
    assert second.part.bore == contents(PAIR).part.bore
    assert second.outline.zero == pytest.approx(radians(90))


def test_a_disk_weighs_what_its_groove_leaves() -> None:
    made = contents(GROOVE)
    path = 1j * (50 + displacement())[::20] * np.exp(1j * PHI[::20])
    inner, outer = (Polygon([(z.real, z.imag) for z in parallel(path, side)]).area for side in (-10.0, 10.0))
    assert made.groove is not None
    assert made.groove.disk_radius == 92.5  # 80 mm and as much rim as the groove is deep, to the millimetre across
    blank = made.part.mass(pi * 92.5**2)
    assert made.mass == pytest.approx(blank - 12 * (outer - inner) * 7850e-9, rel=1e-5)


HUB = PartTable(bore=20, hub_diameter=40, hub_length=30, groove_depth=8, cutter_radius=10)
DRAWN = (GROOVE, STEM, 1), (HUB, ARM, 1), (PAIR, STEM, 2), (PartTable(second_roller=(-40.0, -60.0)), ARM, 2)


@pytest.mark.parametrize("language", ["en", "ru"])
@pytest.mark.parametrize(("part", "follower", "pages"), DRAWN)
def test_nothing_lies_on_anything(
    part: PartTable, follower: TranslatingTable | OscillatingTable, pages: int, language: str
) -> None:
    drawing = working_drawing_of(contents(part, follower, language))
    assert overlaps(drawing) == []
    assert len(drawing.pages) == pages
    told = {
        entity.text for page in drawing.pages for g in page.groups for entity in g.entities if isinstance(entity, Text)
    }
    assert {f"⌀{d}" for d in (185, 176)} & told == ({"⌀185" if part is GROOVE else "⌀176"} if pages == 1 else set())


REFUSED = [
    (PartTable(groove_depth=40.0), STEM, "part.groove_depth"),
    (GROOVE, TranslatingTable(0.0, 0.0), "part.groove_depth"),
    (PartTable(second_roller=(0.0, 90.0)), STEM, "part.second_roller"),
    (PartTable(second_roller=(0.0, -90.0), second_roller_radius=95.0), STEM, "part.second_roller_radius"),
    (PAIR, TranslatingTable(0.0, 0.0), "part.second_roller"),
]


@pytest.mark.parametrize(("part", "follower", "quantity"), REFUSED)
def test_what_cannot_be_made_is_refused_by_its_key(part: PartTable, follower: TranslatingTable, quantity: str) -> None:
    with pytest.raises(DesignError) as error:
        contents(part, follower).check()
    assert error.value.quantity == quantity


def test_tables_that_contradict_are_refused() -> None:
    with pytest.raises(DesignError, match="groove holds"):
        PartTable(groove_depth=5.0, second_roller=(0.0, -90.0))
    with pytest.raises(DesignError, match="place too"):
        PartTable(second_roller_radius=5.0)


def test_the_files_show_the_other_curve_and_no_solid_without_its_groove(tmp_path) -> None:
    kinds = ["profile_csv", "profile_dxf"]
    files = contents(GROOVE).solution.write(tmp_path / "groove", kinds)
    assert {files["profile_outer_csv"], files["profile_outer_dxf"]} == {"profile-outer.csv", "profile-outer.dxf"}
    x, y = np.loadtxt(tmp_path / "groove" / "profile-outer.csv", delimiter=",", skiprows=1)[:, 1:3].T
    assert np.hypot(x, y).min() == pytest.approx(60, abs=1e-9)
    second = contents(PAIR).solution.write(tmp_path / "pair", kinds)
    assert second["profile_second_dxf"] == "profile-second.dxf"
    # A roller that fits no hollow of its path is told, with the working drawing or without.
    phases = RiseTable(60, 30, "rectangular"), ReturnTable(60, 30, "rectangular"), DwellTable(240)
    hollow = gc.Task("cw", MotionTable(phases), STEM, cam=CamTable(22.0), part=GROOVE)
    with pytest.raises(DesignError, match="the hollow of its path"):
        gc.solve(hollow).write(tmp_path / "hollow", kinds)
    with pytest.raises(DesignError, match="groove_depth"):
        contents(GROOVE).solution.write(tmp_path / "solid", ["profile_step"])
