"""A task mirrors its file and converts to what the exact and the drawn side take."""

from __future__ import annotations

import json
import math
import tomllib
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings, strategies as st

from graphcam.errors import DesignError
from graphcam.given.laws import LAWS
from graphcam.given.motion import Rise
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import (
    CamTable,
    DrawingTable,
    FlatFacedTable,
    LimitsTable,
    OscillatingTable,
    Task,
    TitleTable,
    TranslatingTable,
)
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_task, builtin_text, load_task

UP_AND_DOWN = MotionTable((RiseTable(120, 30, "3-4-5"), ReturnTable(240, 30, "cosine")))


def toml(value: Any) -> str:
    """A value in TOML: JSON but for tables."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def file_of(task: Task) -> str:
    return "".join(f"{key} = {toml(value)}\n" for key, value in task.to_dict().items())


def test_the_coursework_mirrors_its_file():
    task = builtin_task()
    data = tomllib.loads(builtin_text("coursework"))
    assert [phase.angle for phase in task.motion.phases] == [phase["angle"] for phase in data["motion"]["phases"]]
    assert (task.rotation, task.speed_rpm, task.title.name) == ("cw", 120, "Cam mechanism")
    assert task.follower == TranslatingTable(offset=-10.0, roller_radius=None)
    assert task.cam.prime_radius is None
    assert task.drawing == DrawingTable("A1", "gost", "en", 12, 50, (40, 40), None)


@pytest.mark.parametrize("name", BUILTIN_TASK_NAMES)
def test_a_task_says_what_its_file_says(name):
    said = builtin_task(name).to_dict()

    def within(part: Any, whole: Any) -> bool:
        if isinstance(part, dict):
            return all(within(value, whole[key]) for key, value in part.items())
        if isinstance(part, list):
            return len(part) == len(whole) and all(map(within, part, whole))
        return part == whole

    assert within(tomllib.loads(builtin_text(name)), said)


def test_angles_become_radians():
    task = builtin_task()
    motion = task.motion()
    assert motion.phases[0] == Rise(30.0, math.radians(80), "rectangular")
    assert motion.starts.tolist() == pytest.approx(in_radians([0, 80, 125, 185]), abs=1e-15)
    assert task.limits().rise == math.radians(30)
    assert task.limits().return_ is None


def in_radians(degrees: list[float]) -> list[float]:
    return [math.radians(x) for x in degrees]


def test_the_lift_of_an_arm_is_an_angle():
    task = builtin_task("arm")
    assert task.motion.phases[0].lift == 15
    assert task.motion().lift == math.radians(15)
    # ... and stays one when a table is changed.
    assert replace(task, drawing=replace(task.drawing, divisions=24)).motion().lift == math.radians(15)
    # The table that went in is not touched: for a translating follower the same table is in mm.
    assert Task("cw", UP_AND_DOWN, OscillatingTable(125, 150)).motion().lift == math.radians(30)
    assert Task("cw", UP_AND_DOWN, TranslatingTable()).motion().lift == 30


def test_the_distance_of_an_arm_may_be_left_open():
    task = Task("cw", UP_AND_DOWN, OscillatingTable(125))
    assert task.follower().distance is None
    assert "distance" not in task.to_dict()["follower"]


@pytest.mark.parametrize(("name", "limit"), [("coursework", 30), ("arm", 45)])
def test_the_usual_limit_belongs_to_the_follower(name, limit):
    task = replace(builtin_task(name), limits=LimitsTable())
    assert task.limits.pressure_angle_rise == limit
    assert task.limits().rise == math.radians(limit)


def test_what_is_open_is_central_and_sharp():
    task = Task("ccw", UP_AND_DOWN, TranslatingTable())
    assert (task.follower.offset, task.follower.roller_radius) == (None, None)
    assert (task.follower().offset, task.follower().roller_radius) == (0, 0)
    # Open and zero are different tasks.
    assert "offset" not in task.to_dict()["follower"]
    assert Task("ccw", UP_AND_DOWN, TranslatingTable(offset=0)).to_dict()["follower"]["offset"] == 0


def test_a_mark_of_byte_order_is_no_fault(tmp_path):
    (tmp_path / "cam.toml").write_bytes(b"\xef\xbb\xbf" + builtin_text("flat").encode())
    assert load_task(str(tmp_path / "cam.toml")) == builtin_task("flat")


def test_no_such_built_in_task():
    with pytest.raises(DesignError, match="did you mean 'coursework'"):
        builtin_task("course")


lengths = st.floats(0.1, 1e4)
texts = st.text(st.characters(exclude_categories=("C", "Z")), max_size=20)
ratios = st.floats(0.1, 10)


@st.composite
def phase_tables(draw: st.DrawFn) -> tuple[RiseTable | DwellTable | ReturnTable, ...]:
    """A rise and a return with as many dwells as one likes; the last dwell takes what is left of the turn."""
    lift = draw(lengths)
    moving = [
        kind(draw(st.floats(1, 80)), lift, name := draw(st.sampled_from(LAWS)), draw(ratios) if name == LAWS[0] else 1)
        for kind in (RiseTable, ReturnTable)
    ]
    dwells = [DwellTable(angle) for angle in draw(st.lists(st.floats(1, 30), max_size=4))]
    phases = [*moving, *dwells]
    return (*phases, DwellTable(360 - math.fsum(phase.angle for phase in phases)))


limits = st.builds(LimitsTable, st.none() | st.floats(1, 89), st.none() | st.floats(1, 89), rest=st.booleans())
rollers = st.one_of(
    st.builds(TranslatingTable, st.none() | st.floats(-9, 9), st.none() | st.floats(0.001, 9)),
    st.builds(OscillatingTable, lengths, lengths, st.none() | st.floats(0.001, 9)),
)
flat_limits = st.builds(LimitsTable, min_curvature_radius=st.none() | lengths)
tasks = st.one_of(
    st.builds(
        Task,
        rotation=st.sampled_from(["cw", "ccw"]),
        motion=st.builds(MotionTable, phase_tables()),
        follower=followers,
        speed_rpm=st.none() | lengths,
        title=st.builds(TitleTable, texts, texts, texts),
        cam=st.builds(CamTable, st.none() | st.floats(10, 100)),
        limits=limited,
        drawing=st.builds(DrawingTable, divisions=st.integers(1, 1000), poles=st.tuples(lengths, lengths)),
    )
    for followers, limited in ((rollers, limits), (st.builds(FlatFacedTable), flat_limits))
)


@settings(deadline=None)  # it writes a file
@given(tasks)
def test_what_a_task_says_is_a_file_of_that_task(tmp_path_factory, task):
    path = tmp_path_factory.mktemp("task") / "cam.toml"
    path.write_text(file_of(task), encoding="utf-8")
    assert load_task(path) == task


@given(phase_tables())
def test_angles_that_close_in_degrees_close_in_radians(phases):
    motion = MotionTable(phases)()
    s = motion([0.0, 2 * math.pi])[0]
    assert s[0] == s[1]


@pytest.mark.parametrize(
    ("make", "quantity"),
    [
        (lambda: RiseTable(80, 0, "2-3"), "lift"),
        (lambda: RiseTable(-80, 30, "2-3"), "angle"),
        (lambda: RiseTable(80, 30, "2-3", ratio=2), "ratio"),
        (lambda: ReturnTable(80, 30, "3-2"), "law"),
        (lambda: DwellTable(math.nan), "angle"),
        (lambda: MotionTable((DwellTable(360),)), "motion"),
        (lambda: MotionTable((RiseTable(180, 30, "2-3"), ReturnTable(179, 30, "2-3"))), "sum of the phase angles"),
        (lambda: MotionTable((RiseTable(180, 30, "2-3"), ReturnTable(180, 29, "2-3"))), "sum of rises less returns"),
        (lambda: TranslatingTable(roller_radius=-1), "roller radius"),
        (lambda: TranslatingTable(roller_rule="half of it"), "roller rule"),
        (lambda: OscillatingTable(arm=0, distance=100), "arm"),
        (lambda: CamTable(0), "prime_radius"),
        (lambda: LimitsTable(90), "permitted pressure angle on the rise"),
        (lambda: LimitsTable(min_curvature_radius=0), "min_curvature_radius"),
        (lambda: DrawingTable(format="A5"), "format"),
        (lambda: DrawingTable(divisions=0), "divisions"),
        (lambda: DrawingTable(poles=(40, 0)), "poles[1]"),
        (lambda: TitleTable(author="a\nb"), "author"),
        (lambda: Task("left", UP_AND_DOWN, FlatFacedTable()), "rotation"),
        (lambda: Task("cw", UP_AND_DOWN, FlatFacedTable(), speed_rpm=0), "speed_rpm"),
        (lambda: Task("cw", UP_AND_DOWN, TranslatingTable(-50), cam=CamTable(50)), "follower.offset"),
        (lambda: Task("cw", UP_AND_DOWN, OscillatingTable(9, 9, 50), cam=CamTable(50)), "follower.roller_radius"),
        (
            lambda: Task("cw", UP_AND_DOWN, FlatFacedTable(), limits=LimitsTable(pressure_angle_rise=30)),
            "limits.pressure_angle_rise",
        ),
        (
            lambda: Task("cw", UP_AND_DOWN, FlatFacedTable(), limits=LimitsTable(pressure_angle_return=30)),
            "limits.pressure_angle_return",
        ),
    ],
)
def test_a_task_made_by_hand_is_checked_too(make, quantity):
    with pytest.raises(DesignError) as caught:
        make()
    assert caught.value.quantity == quantity


def test_an_arc_lift_is_the_arm_times_the_angle():
    """A coursework table gives the lift of an arm as an arc of 32 mm."""
    angle = RiseTable(115, 15, "cosine"), ReturnTable(245, 15, "2-3")
    arc = RiseTable(115, math.radians(15) * 125, "cosine"), ReturnTable(245, math.radians(15) * 125, "2-3")
    by_angle = Task("ccw", MotionTable(angle), OscillatingTable(arm=125, distance=150))
    by_arc = Task("ccw", MotionTable(arc), OscillatingTable(arm=125, distance=150, lift="arc"))
    assert by_arc.motion().lift == pytest.approx(by_angle.motion().lift, rel=1e-15)
    with pytest.raises(DesignError, match="lift"):
        OscillatingTable(arm=125, lift="chord")
