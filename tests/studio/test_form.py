"""The form of sizes: it names every size of a task, and whatever it offers is a design that can be drawn."""

import json
import math

import pytest
from studio_tasks import BUILT_IN, plain_task, rebuilt, solved

import graphcam as gc
from graphcam.studio.engine import answer
from graphcam.studio.handle import changes_with
from graphcam.studio.phase_fields import phases_without, with_dwell, with_step
from graphcam.studio.sizes_form import form_of
from graphcam.studio.task_paths import changed_task, steps_of, value_at

DRAWN_ELSEWHERE = "title", "part"
"""Tables that change nothing in the construction."""
ALWAYS = "drawing.whole_turn"
"""What its page does whatever the task says."""

WITHOUT = {
    "measured": {"motion.table"},
    "flat": {"limits.rest"},
    "swinging-face": {"limits.rest"},
    "arcs": {"follower.kind", "arcs.C1[0]", "arcs.C1[1]"},
}
"""What a task says without a choice: a table is a file, a flat face has no angle at rest, arcs have one
follower, and C1 goes with D."""


def leaves(table, path=""):
    """The paths of all values of a task, phases and a table of a motion as one."""
    for key, value in table.items():
        here = f"{path}.{key}".lstrip(".")
        if isinstance(value, dict) and key != "table":
            yield from leaves(value, here)
        elif isinstance(value, list) and key != "phases":
            yield from (f"{here}[{k}]" for k in range(len(value)))
        else:
            yield here


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_value_of_a_task_has_its_field(name):
    task = plain_task(name)
    paths = {field["path"] for field in form_of(solved(name), str)}
    said = {path for path in leaves(task) if path.split(".")[0] not in DRAWN_ELSEWHERE} - {ALWAYS}
    assert said - paths == WITHOUT.get(name, set())
    assert len(paths) == len(form_of(solved(name), str))


@pytest.mark.parametrize("name", BUILT_IN)
def test_values_are_those_of_the_task_and_lie_in_their_ranges(name):
    task = plain_task(name)
    for field in form_of(solved(name), str):
        there = value_at(task, field["path"])
        if there is not None and field["kind"] != "phases":
            assert field["value"] == there
        for value in (field.get("value"), field.get("adopted")):
            if "min" in field and value is not None:
                assert field["min"] <= value <= field["max"], field["path"]
        if field["kind"] == "choice":
            assert field["value"] in [choice["value"] for choice in field["choices"]]
    json.dumps(form_of(solved(name), str), allow_nan=False)


@pytest.mark.parametrize("name", BUILT_IN)
def test_the_ends_of_every_range_can_be_typed(name):
    """A slider must not lead to an error of a single field; what two sizes make of each other is said beside them."""
    task = plain_task(name)
    for field in form_of(solved(name), str):
        if field["kind"] not in ("number", "open-number") or field["path"] == "pencil" or field["path"][:4] == "arcs":
            continue
        for end in (field["min"], field["max"]):
            typed = changed_task(task, changes_with(field, field["path"], end))
            assert value_at(rebuilt(typed).to_dict(), field["path"]) == end


@pytest.mark.parametrize("name", [name for name in BUILT_IN if name != "arcs"])
def test_every_kind_of_follower_that_is_offered_can_be_drawn(name):
    task = plain_task(name)
    kinds = next(field for field in form_of(solved(name), str) if field["path"] == "follower.kind")
    # A face that swings is offered where the lifts are in degrees already.
    assert len(kinds["choices"]) == (4 if rebuilt(task).follower.column == "s_deg" else 3)
    for choice in kinds["choices"]:
        other = gc.solve(rebuilt(changed_task(task, choice["changes"])))
        assert other.task.follower.kind == choice["value"]
        assert other.chain.prime_radius > 0


TRANSLATING_SPRING = {"mass": 2.0, "stiffness": 3.0, "preload": 50.0, "friction": 0.05}
ARM_SPRING = {"inertia": 1500.0, "stiffness": 4000.0, "load": 2.0}
AT_A_POINT = {"inertia": 1500.0, "stiffness": 4.0, "preload": 30.0, "at": {"arm": 60.0, "anchor": [40.0, 20.0]}}


@pytest.mark.parametrize(
    ("name", "spring", "kind", "kept"),
    [
        ("coursework", TRANSLATING_SPRING, "oscillating", {"friction": 0.05}),
        ("coursework", TRANSLATING_SPRING, "flat-faced", TRANSLATING_SPRING),
        ("arm", ARM_SPRING, "translating", {"load": 2.0}),
        ("arm", AT_A_POINT, "translating", {"stiffness": 4.0, "preload": 30.0}),
    ],
)
def test_another_follower_keeps_its_spring_and_material(name, spring, kind, kept):
    """The mass at the end of an arm has the moment of inertia m l^2, and a spring there turns with c l^2."""
    task = changed_task(plain_task(name), {"speed_rpm": 120.0, "spring": spring, "material": {"width": 15.0}})
    solution = gc.solve(rebuilt(task))
    kinds = next(field for field in form_of(solution, str) if field["path"] == "follower.kind")
    choice = next(each for each in kinds["choices"] if each["value"] == kind)
    other = gc.solve(rebuilt(changed_task(task, choice["changes"])))
    assert kept.items() <= other.task.to_dict()["spring"].items()
    assert other.task.material == solution.task.material
    arm = other.task.follower.arm if kind == "oscillating" else getattr(solution.task.follower, "arm", 1.0)
    own, new = solution.task.spring, other.task.spring
    if kind == "oscillating":
        assert new.inertia == pytest.approx(own.mass * arm**2, rel=1e-3)
        assert new.stiffness == pytest.approx(own.stiffness * arm**2, rel=1e-3)
        assert new.preload == pytest.approx(own.preload * arm, rel=1e-3)
    if name == "arm":
        assert new.mass == pytest.approx(own.inertia / arm**2, rel=1e-3)
        assert "at" in spring or new.stiffness == pytest.approx(own.stiffness / arm**2, rel=1e-3)


def test_only_followers_that_a_table_goes_with_are_offered():
    measured = gc.builtin_task("measured")
    assert "motion.phases" not in {field["path"] for field in form_of(gc.solve(measured), str)}


def within(phases, k, new, made):
    """Whether a rise and a return were put into the upper dwell."""
    return new is made["step"] and phases[k]["kind"] == "dwell" and k == 1


@pytest.mark.parametrize("name", ["coursework", "arm", "flat"])
def test_phases_that_are_edited_still_close(name):
    task = plain_task(name)
    phases = task["motion"]["phases"]
    edits = next(field for field in form_of(solved(name), str) if field["kind"] == "phases")["phases"]
    offered = 0
    for k, row in enumerate(edits):
        made = {"remove": phases_without(phases, k), "dwell": with_dwell(phases, k), "step": with_step(phases, k)}
        assert row["edits"] == made
        for new in filter(None, made.values()):
            offered += 1
            assert math.fsum(phase["angle"] for phase in new) == 360
            lift = rebuilt(changed_task(task, {"motion.phases": new})).motion().lift
            # Half a lift may stand on top of the whole one.
            assert lift / solved(name).cam.motion.lift == pytest.approx(1.5 if within(phases, k, new, made) else 1.0)
    assert offered >= 6


def test_a_lone_rise_cannot_be_taken_away():
    phases = plain_task("coursework")["motion"]["phases"]
    assert phases_without(phases, 0) is None
    assert phases_without(with_step(phases, 0), 0) is not None


def test_paths():
    task = {"motion": {"phases": [{"angle": 80}, {"angle": 45}]}}
    assert steps_of("motion.phases[1].angle") == ("motion", "phases", 1, "angle")
    assert value_at(task, "motion.phases[1].angle") == 45
    assert value_at(task, "motion.phases[7].angle") is None
    new = changed_task(task, {"motion.phases[0].angle": 90, "limits.rest": False})
    assert (new["motion"]["phases"][0]["angle"], new["limits"]) == (90, {"rest": False})
    assert task["motion"]["phases"][0]["angle"] == 80


@pytest.mark.parametrize("path", ["", "a..b", "a[x]", "[0]", "a[0", "motion.phases[9].angle", "motion.phases.angle"])
def test_a_path_that_leads_nowhere_is_refused(path):
    with pytest.raises(gc.DesignError, match="path"):
        changed_task({"motion": {"phases": [{"angle": 80}]}}, {path: 1})


@pytest.mark.parametrize("name", [each for each in BUILT_IN if each != "arcs"])
def test_forces_and_stress_are_added_and_taken_away(name):
    """With a spring there are diagrams of forces, with a contact that of its stress; without them all is as it was."""

    def chosen(task, path, value):
        form = {field["path"]: field for field in answer({"task": task, "views": [], "form": True})["form"]}
        choices = {choice["value"]: choice["changes"] for choice in form[path]["choices"]}
        assert choices[form[path]["value"]] == {}
        return changed_task(task, choices[value])

    def views(task):
        return {each["name"] for each in answer({"task": task, "views": []})["names"]}

    pressed = chosen(plain_task(name), "spring", True)
    assert "normal_force" in views(pressed) - views(plain_task(name))
    stressed = chosen(pressed, "material", True)
    assert "contact_stress" in views(stressed) - views(pressed)
    bare = chosen(stressed, "spring", False)
    assert bare | {"speed_rpm": None} == plain_task(name) | {"speed_rpm": None}
