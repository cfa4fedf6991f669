"""Adopted sizes against the exact limits: what is said of one that is too small, and that the remedies help."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import graphcam as gc
from graphcam.constructions.angle_diagram import inner_maximum
from graphcam.errors import DesignError, TaskError
from graphcam.report.documents import sheet_of
from graphcam.report.note import note
from graphcam.sheets.model import Text
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import (
    CamTable,
    DrawingTable,
    FlatFacedTable,
    LimitsTable,
    OscillatingTable,
    SpringTable,
    Task,
    TranslatingTable,
)
from graphcam.tasks.task_file import load_task


def motion(lift: float, *laws: str, angles: tuple[float, ...] = (120, 40, 100, 100)) -> MotionTable:
    """A rise and a return with these laws, between dwells; angles in degrees."""
    rise, back = laws
    up, high, down, low = angles
    return MotionTable((RiseTable(up, lift, rise), DwellTable(high), ReturnTable(down, lift, back), DwellTable(low)))


FLAT = Task(
    "ccw",
    motion(24, "modified-sine", "cycloidal", angles=(100, 30, 110, 120)),
    FlatFacedTable(),
    limits=LimitsTable(min_curvature_radius=6),
    drawing=DrawingTable("A3", "iso", ordinate=25, poles=(20, 20)),
)
ARM = Task(
    "ccw",
    motion(22, "cycloidal", "3-4-5"),
    OscillatingTable(95, roller_radius=9),
    limits=LimitsTable(45, 70),
    drawing=DrawingTable("A2", "iso"),
)


def warned(task: Task, *of: str) -> list[str]:
    """What is said of a size, or of the named ones."""
    solution = gc.solve(task)
    return [str(caution.said) for caution in solution.cautions if caution.of in (of or ("prime radius",))]


TOLD = {
    "drawing.divisions": r"(\d+) parts in each phase",
    "cam.prime_radius": r"a prime radius of ([\d.]+) mm",
    "follower.offset": r"an offset of (-?[\d.]+) mm",
    "follower.distance": r"a centre distance of ([\d.]+) mm",
    "follower.roller_radius": r"a roller radius of ([\d.]+) mm",
}
"""The words of a drawing for the keys of a task file."""


def named(sentence: str) -> list[dict[str, float]]:
    """The remedies of a warning: each the keys of a task file that are to be given together."""
    _, remedy = sentence.rstrip(".").split(" Take ")
    return [
        {key: float(found[1]) for key, words in TOLD.items() if (found := re.search(words, one))}
        for one in remedy.split(", or ")
    ]


def mended(task: Task, remedy: dict[str, float]) -> Task:
    """The task with the keys of a remedy."""
    for key, value in remedy.items():
        table, name = key.split(".")
        given = int(value) if name == "divisions" else value
        task = replace(task, **{table: replace(getattr(task, table), **{name: given})})
    return task


# --- the prime radius ------------------------------------------------------------------------------------------------


def test_a_flat_face_whose_drawn_minimum_is_too_small_is_told_with_remedies_that_help():
    """Twelve divisions draw 25.26 mm, and 26 mm is adopted; -min(s + a) + 6 is 26.12 mm."""
    solution = gc.solve(FLAT)
    assert solution.cam.prime_radius == 26, "what was drawn is adopted as it was"
    (said,) = solution.warnings
    assert said == (
        "The adopted prime radius of 26 mm is smaller than the exact minimum, 26.121 mm: the drawn one, 25.258 mm, is "
        "0.863 mm too small. The radius of curvature falls to 5.88 mm; 6 mm are required. "
        "Take 24 parts in each phase, or a prime radius of 27 mm."
    )
    phi = np.linspace(0, 2 * np.pi, 200_001)
    s, _, a, _ = solution.cam.motion(phi)
    assert 6 - float((s + a).min()) == pytest.approx(26.121, abs=1e-3)
    for remedy in named(said):
        assert gc.solve(mended(FLAT, remedy)).warnings == []


def test_a_flat_face_with_a_given_radius_is_told_as_before():
    (said,) = gc.solve(replace(FLAT, cam=CamTable(26.0))).warnings
    assert said == "The given prime radius of 26 mm is smaller than the minimum permitted one, 26.12 mm."


def test_an_arm_whose_angle_exceeds_the_limit_by_the_drawing_error_is_told():
    exceeded, said = gc.solve(ARM).warnings
    assert exceeded == "The pressure angle reaches 45.05° on the rise, at 49.63°; 45° are permitted."
    assert said.startswith(
        "The adopted prime radius of 15 mm is smaller than the exact minimum at the centre distance of"
    )
    assert len(named(said)) == 2
    for remedy in named(said):
        assert gc.solve(mended(ARM, remedy)).warnings == []
    assert gc.solve(replace(ARM, rotation="cw")).warnings == []


@pytest.mark.parametrize("divisions", [4, 6])
@pytest.mark.parametrize("law", ["cycloidal", "3-4-5"])
@pytest.mark.parametrize(
    "follower", [TranslatingTable(), TranslatingTable(5.0), OscillatingTable(100.0), FlatFacedTable()], ids=str
)
def test_every_remedy_that_is_named_satisfies_the_exact_limits(follower, law, divisions):
    angles = (80, 45, 75, 160)
    task = Task("ccw", motion(30, law, law, angles=angles), follower, drawing=DrawingTable(divisions=divisions))
    of = ("pressure angle", "prime radius", "roller radius")
    told = [said for said in warned(task, *of[1:]) if "adopted" in said]
    assert bool(told) or not warned(task, *of), "what breaks a limit has a remedy"
    for said in told:
        subject = "roller radius" if "roller" in said else "prime radius"
        for remedy in named(said):
            assert not warned(mended(task, remedy), subject), (said, remedy)


def test_the_remedy_is_the_next_round_size():
    """One multiple less would not satisfy the limit."""
    (said,) = warned(FLAT)
    radius = named(said)[-1]["cam.prime_radius"]
    assert gc.solve(replace(FLAT, cam=CamTable(radius - 1))).warnings != []


def test_a_radius_that_only_rounding_up_made_large_enough_is_not_told():
    """At 18 divisions the drawn minimum is 25.68 mm; with rounding to 2 mm that is 26, to 10 mm it is 30."""
    coarse = replace(FLAT, drawing=replace(FLAT.drawing, divisions=18, rounding=10.0))
    assert gc.solve(coarse).chain.adopted().least < 26.12 < gc.solve(coarse).cam.prime_radius
    assert warned(coarse) == []


def test_a_roller_larger_than_the_rule_permits_is_told():
    task = Task(
        "cw",
        motion(25.0, "cycloidal", "cycloidal", angles=(80, 45, 75, 160)),
        OscillatingTable(100.0),
        drawing=DrawingTable("A1"),
    )
    (said,) = warned(task, "roller radius")
    assert "larger than the rule permits, 10.663 mm" in said
    assert named(said) == [{"drawing.divisions": 24}, {"follower.roller_radius": 10}]


def test_solution_json_sheet_and_note_tell_it():
    solution = gc.solve(FLAT)
    assert solution.to_dict()["warnings"] == solution.warnings
    assert gc.solve(gc.builtin_task()).to_dict()["warnings"] == []
    assert f"**{solution.warnings[0]}**" in note(solution)
    entities = [entity for page in sheet_of(solution).pages for group in page.groups for entity in group.entities]
    assert solution.warnings[0] in " ".join(entity.text for entity in entities if isinstance(entity, Text))


# --- the face --------------------------------------------------------------------------------------------------------


def test_a_face_with_a_margin_is_adopted_in_round_millimetres():
    """24.78 + 3 and 24.08 + 3 mm, rounded up; the exact half-widths are 25.00 and 24.20 mm."""
    solution = gc.solve(replace(FLAT, follower=FlatFacedTable(face_margin=3.0), cam=CamTable(27.0)))
    face = solution.to_dict()["face"]
    assert (face["left"]["adopted"], face["right"]["adopted"], face["width"], face["margin"]) == (28, 28, 56, 3)
    exact = gc.face_width(solution.cam.motion, "ccw")
    assert face["left"]["exact"], face["right"]["exact"] == (exact.left, exact.right)
    written = note(solution)
    assert "With 3 mm on each side the face must reach 27.78 mm to the left and 27.08 mm to the right" in written
    assert "the face is 28 + 28 mm, 56 mm wide" in written
    assert solution.warnings == []


def test_without_a_margin_no_face_is_adopted():
    solution = gc.solve(FLAT)
    assert solution.face is None
    assert "face" not in solution.to_dict()
    assert "face_margin" not in solution.to_dict()["task"]["follower"]
    assert gc.solve(replace(FLAT, follower=FlatFacedTable(face_margin=0.0))).face.adopted == (25, 25)


def test_a_face_that_is_drawn_too_narrow_is_told():
    """Six divisions read 0.2 mm too little, and a rounding of 0.1 mm does not make up for it."""
    drawing = replace(FLAT.drawing, divisions=6, rounding=0.1)
    task = replace(FLAT, follower=FlatFacedTable(face_margin=3.0), cam=CamTable(30.0), drawing=drawing)
    told = warned(task, "face")
    assert told[0].startswith("The adopted face, ")
    assert "its margin of 3 mm, 28.002 mm" in told[0]
    assert told[0].endswith("or 28.1 mm.")


@pytest.mark.parametrize("margin", [-1.0, 1e12])
def test_a_margin_that_cannot_be_is_refused(margin):
    with pytest.raises(DesignError, match="face_margin"):
        FlatFacedTable(face_margin=margin)


def test_only_a_flat_face_has_a_margin(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text('rotation = "cw"\n[motion]\nphases = []\n[follower]\nkind = "translating"\nface_margin = 3\n')
    with pytest.raises(TaskError, match="face_margin"):
        load_task(path)


# --- contact without a preload ---------------------------------------------------------------------------------------


IDLE = "With F₀ = 0 the contact force is zero during the whole lower dwell"


def test_a_contact_that_nothing_presses_in_the_lower_dwell_is_told():
    sprung = replace(FLAT, speed_rpm=900, spring=SpringTable(0.35, 6.0))
    solution = gc.solve(sprung)
    assert solution.spring.load.preload == 0
    assert IDLE in note(solution)
    over = solution.to_dict()["spring"]["over_turn"]
    low = np.array(over["phi_deg"]) > 241
    assert np.abs(np.array(over["normal_force"])[low]).max() < 1e-9


@pytest.mark.parametrize("spring", [SpringTable(0.35, 6.0, preload=20.0), SpringTable(0.35, 6.0, load=15.0)], ids=str)
def test_a_preload_or_a_load_presses_there(spring):
    assert IDLE not in note(gc.solve(replace(FLAT, speed_rpm=900, spring=spring)))


# --- pressure angles -------------------------------------------------------------------------------------------------


def test_the_maximum_inside_the_rise_is_shown_beside_a_larger_angle_in_the_dwell():
    """With the offset that makes the cam smallest the angle in the lower dwell is the larger one, and negative."""
    task = Task(
        "ccw",
        motion(36, "cosine", "rectangular", angles=(110, 25, 95, 130)),
        TranslatingTable(),
        limits=LimitsTable(28),
        drawing=DrawingTable("A1", ordinate=40, poles=(40, 40)),
    )
    solution = gc.solve(task)
    plotted = solution.drawn["angle_diagram"]
    other = inner_maximum(plotted, "rise")
    assert other is not None
    assert np.degrees(float(plotted.value("max_rise"))) < 0, "the reading is what it was"
    highest = np.degrees(solution.cam.pressure_angle(np.radians(np.linspace(0, 110, 11_001)))).max()
    read = other.place.imag * np.degrees(plotted.givens.mu_alpha.per_mm)
    assert read == pytest.approx(highest, abs=0.25), "a drawing error of 0.25 mm"
    assert f"the maximum is {read:.2f}°; the larger one is at an end of the phase" in note(solution)
    marks = plotted.steps()[-1].marks
    assert f"{read:.1f}°" in [str(mark.text) for mark in marks if hasattr(mark, "text")]


@pytest.mark.parametrize("name", ["coursework", "arm", "measured"])
def test_no_second_maximum_is_told_where_the_farthest_point_is_inside(name):
    plotted = gc.solve(gc.builtin_task(name)).drawn["angle_diagram"]
    assert [inner_maximum(plotted, phase) for phase in ("rise", "return")] == [None, None]


@pytest.mark.parametrize(("rotation", "sign"), [("ccw", 1), ("cw", -1)])
def test_the_sign_of_an_arms_pressure_angle_follows_the_rotation(rotation, sign):
    """Arm and cam in opposite senses (ccw): positive on the rise; in the same sense (cw): negative."""
    extremes = gc.solve(replace(ARM, rotation=rotation)).cam.extremes()
    assert np.sign(extremes.pressure_angle_rise[0]) == sign
    assert np.sign(extremes.pressure_angle_return[0]) == -sign
