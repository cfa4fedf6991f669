"""A new field of the task is two lines in its table: all else that tells of it is derived from them."""

import dataclasses
import re
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Annotated, Any

import pytest
from studio_tasks import BUILT_IN, solved

import graphcam as gc
from graphcam.language import language
from graphcam.studio.engine import field_of, named_fields
from graphcam.studio.size_ranges import ranges
from graphcam.studio.sizes_form import form_of
from graphcam.tasks import commented_task, task_file
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.dataclass_reader import classes_of
from graphcam.tasks.declared_numbers import Fixed, Ruled, declared, numbers_of
from graphcam.tasks.spring_tables import ArmSpringTable
from graphcam.tasks.task import DrawingTable, Task
from graphcam.tasks.units import PartOfTurn
from graphcam.words import say

PAGE_FILE = Path(__file__).parents[2] / "notebooks" / "site" / "task_file_page.py"
SPEC = spec_from_file_location("task_file_page", PAGE_FILE)
page_of_the_site = module_from_spec(SPEC)
SPEC.loader.exec_module(page_of_the_site)
IN_NO_FORM = "sizing.", "tolerances.", "part."
"""Tables of which the form has no number."""
NO_NAME = {"motion.per_cam_degree", "follower.face_margin", "drawing.rounding"}
"""Other numbers that no form has."""
CHECKED_BY_THEIR_TABLES = {"spring.stiffness", "spring.preload", "part.spline_control_points", "tolerances.coverage"}
"""Those of an arm's spring have the unit of its kind; the others are refused by what they are given to."""


def test_every_number_has_what_is_told_of_it_in_its_declaration():
    numbers = {**declared(ArcsTask), **declared(Task)} | {f"spring.{k}": n for k, n in declared(ArmSpringTable).items()}
    assert len(numbers) > 70
    for path, number in numbers.items():
        in_form = not path.startswith(IN_NO_FORM) and path not in NO_NAME and path.partition("[")[0][:-1] != "arcs."
        point = path.startswith("arcs.") and path.endswith("]")
        assert (number.name is not None) == (in_form and not point), path
        sized = path.startswith("sizing.") or path in CHECKED_BY_THEIR_TABLES
        assert number.limits or sized, path


@pytest.mark.parametrize("name", BUILT_IN)
def test_every_ruled_number_has_its_rule(name):
    solution = solved(name)
    ruled = {path for path, each in numbers_of(solution.task).items() if each.name and isinstance(each.range, Ruled)}
    assert ruled <= ranges(solution).keys()
    assert len(ruled) >= 2


@dataclass(frozen=True)
class WithStation(DrawingTable):
    """``[drawing]``: with one number more.

    plan_station : degrees, the cam angle at which the velocity plan is drawn; left out: that of the maximum
    """

    plan_station: Annotated[PartOfTurn | None, say("Station of the velocity plan"), Fixed(0.0, 359.0, 1.0)] = None


WithStation.__module__ = DrawingTable.__module__


@dataclass(frozen=True, repr=False)
class TaskWithStation(Task):
    """A design task whose drawing has one number more."""

    drawing: WithStation = dataclasses.field(default_factory=WithStation)


def read(**drawing: Any) -> TaskWithStation:
    """The coursework task with such keys of its drawing."""
    said = gc.builtin_task().to_dict()
    said["drawing"] |= drawing
    return task_file.checked_table(TaskWithStation, classes_of(TaskWithStation), "task", said, said)


def test_the_how_to_adds_the_same_field():
    page = (PAGE_FILE.parent / "pages" / "how-to" / "add-a-field.md").read_text(encoding="utf-8")
    shown = re.findall(r"^plan_station ?: ?.+$", page, re.MULTILINE)
    here = Path(__file__).read_text(encoding="utf-8")
    assert len(shown) == 2
    assert all(f"\n    {line}\n" in here for line in shown)


def test_a_new_number_is_read_in_any_unit_and_written():
    assert read(plan_station=40).drawing.plan_station == 40.0
    task = read(plan_station="0.5 rad")
    assert task.to_dict()["drawing"]["plan_station"] == pytest.approx(28.64788975654116)
    assert read().drawing.plan_station is None


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (-5, "is -5, but must be at least 0 and less than 360 degrees"),
        (360, "is 360, but must be at least 0 and less than 360 degrees"),
        ("3 kg", "is '3 kg', but must be a number of deg (without quotes), or text with its unit: deg, °, rad, grad"),
        (True, "is true, but must be a number (without quotes)"),
    ],
)
def test_a_new_number_is_refused_by_its_path(value, told):
    with pytest.raises(gc.TaskError) as caught:
        read(plan_station=value)
    assert f"drawing.plan_station {told}" in str(caught.value)
    assert field_of(caught.value, {}) == "drawing.plan_station"


def test_a_misspelt_new_number_is_suggested():
    with pytest.raises(gc.TaskError, match="did you mean 'plan_station'"):
        read(plan_statoin=40)


def test_a_new_number_is_in_the_form():
    solution = dataclasses.replace(solved("coursework"), task=read(plan_station=40))
    field = next(each for each in form_of(solution, str) if each["path"] == "drawing.plan_station")
    told = {"group": "Drawing", "name": "Station of the velocity plan", "unit": "°", "kind": "open-number"}
    assert field == {"path": "drawing.plan_station", **told, "value": 40, "min": 0, "max": 359, "step": 1} | {
        "adopted": None
    }


def test_a_new_number_is_explained_in_the_file_of_init_and_in_the_reference(monkeypatch):
    for module in (commented_task, page_of_the_site):
        monkeypatch.setattr(module, "Task", TaskWithStation)
    text = "degrees, the cam angle at which the velocity plan is drawn; left out: that of the maximum"
    assert f"# plan_station = 180    # {text}" in commented_task.commented_task()
    assert "# plan_station = 180    # " in commented_task.commented_task(language("ru"))
    assert f"| `plan_station` | 0 to 360 | {text} |" in page_of_the_site.task_file_page()


def test_the_page_of_the_site_has_every_key():
    page = page_of_the_site.task_file_page()
    for path in declared(Task):
        key = path.rpartition(".")[2].partition("[")[0]
        assert f"| `{key}` |" in page, path


def test_a_message_names_a_number_as_the_form_does():
    told = named_fields("spring.damping is -1, but must be a finite number of 0 N s/m or more", language("en"))
    assert told == "Damping d is -1, but must be a finite number of 0 N s/m or more"
