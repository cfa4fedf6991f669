"""Numbers of a task file may be text with a unit: every field, every unit, and what is no such text."""

from __future__ import annotations

import copy
import dataclasses
import difflib
import json
import math
import pickle
import re
from collections import Counter
from collections.abc import Iterator
from decimal import Decimal
from importlib.resources import files
from pathlib import Path
from typing import Any, get_args, get_origin, get_type_hints

import pytest
from over_all import fast_first
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.variant import fill_in
from graphcam.report.documents import contents_of, note_of, sheet_of
from graphcam.sheets.model import Curve, Stroke
from graphcam.studio.sizes_form import form_of
from graphcam.studio.task_paths import changed_task, steps_of, value_at
from graphcam.studio.task_text import opened_task, plain_task
from graphcam.sweeps.design_space import load_space
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.dataclass_reader import classes_of
from graphcam.tasks.declared_numbers import Fixed, declared
from graphcam.tasks.spring_tables import ArmSpringTable
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import (
    builtin_arcs_task,
    builtin_text,
    task_from,
)
from graphcam.tasks.task_writer import task_files
from graphcam.tasks.units import UNITS, HeldIn, numbers_in_units

SPRING = {"mass": 0.3, "stiffness": 3.0, "preload": 40.0, "acceleration": 2.0, "load": 12.0, "damping": 5.0}
ROWS = [[0.0, 12.0], [180.0, 60.0], [360.0, 12.0]]
ARM_SPRING = {"inertia": 900.0, "stiffness": 4e5, "preload": 3e4, "acceleration": 2.0, "load": ROWS, "damping": 90.0}
POINTS = [{"angle": 160.0, "s": 12.0, "v": 0.0, "a": 0.0, "j": 0.0}, {"angle": 220.0, "s": 5.0},
          {"angle": 280.0, "s": 0.0, "v": 0.0, "a": 0.0}]  # fmt: skip
PARTS = [
    {"kind": "polynomial", "points": [
        {"angle": 0.0, "s": 0.0, "v": 0.0, "a": 0.0}, {"angle": 120.0, "s": 12.0, "v": 0.0, "a": 0.0, "j": 0.0},
    ]},
    {"kind": "spline", "degree": 5, "points": POINTS, "knots": [200.0, 240.0]},
]  # fmt: skip
PART = {
    "bore": 20.0, "width": 18.0, "hub_diameter": 36.0, "hub_length": 30.0, "profile_tolerance": 0.05,
    "second_roller": [0.0, -100.0], "second_roller_radius": 12.0,
    "cutter_radius": 10.0, "density": 7850.0, "feed": 100.0, "roughness": 3.2, "profile_roughness": 0.8,
    "bore_roughness": 1.6,
}  # fmt: skip


def builtin(name: str, **tables: Any) -> dict[str, Any]:
    """A built-in task as plain data, with other tables."""
    return plain_task(gc.builtin_task(name)) | tables


TASKS = {
    "translating": builtin(
        "sizing",
        follower={"kind": "translating", "offset": 8.0, "roller_radius": 12.0},
        cam={"prime_radius": 80.0},
        limits={"pressure_angle_rise": 30.0, "pressure_angle_return": 60.0, "rest": True},
        spring=SPRING,
        material={"width": 15.0, "young_cam": 2e5, "young_follower": 2e5, "permitted_stress": 900.0},
        tolerances={"waviness": [0.01, 0.02], "harmonics": [3, 24], "roller_diameter": 0.03, "offset": 0.05},
        sizing={"prime_radius": [60.0, 90.0], "offset": 5.0, "roller_radius": [8.0, 12.0], "width": [10.0, 20.0]},
        part=PART,
        drawing={"ordinate": 50.0, "poles": [40.0, 30.0], "rounding": 0.5},
    ),
    "base radius": builtin("sizing"),
    "arm": builtin(
        "arm", speed_rpm=100.0, spring=ARM_SPRING, tolerances={"roller_diameter": 0.03, "distance": 0.05, "arm": 0.02}
    ),
    "arm by its arc": changed_task(
        builtin("arm"), {"follower.lift": "arc", **{f"motion.phases[{k}].lift": 30.0 for k in (0, 2)}}
    ),
    "arm with a spring at a point": builtin(
        "arm", speed_rpm=100.0, spring={**ARM_SPRING, "stiffness": 3.0, "at": {"arm": 60.0, "anchor": [120.0, -60.0]}}
    ),
    "flat": builtin("flat", follower={"kind": "flat-faced", "face_margin": 3.0}),
    "swinging face by conditions": builtin("swinging-face", motion={"parts": PARTS}),
    "conditions": builtin("coursework", motion={"parts": PARTS}),
    "measured": builtin("measured"),
    "given cam": {
        "rotation": "ccw", "follower": {"kind": "flat-faced"},
        "motion": {"radii": {"base_radius": 12.0, "flank_radius": 36.0, "nose_radius": 1.5, "lift": 7.0, "dwell": 20.0}},  # noqa: E501
    },
    "given tangent cam": {
        "rotation": "ccw", "follower": {"kind": "translating", "offset": 2.0, "roller_radius": 8.0},
        "motion": {"radii": {"base_radius": 28.0, "flank_radius": "straight", "lift": 15.0, "ascent": 70.0}},
        "part": {"groove_depth": 8.0},
    },
    "arcs": builtin_arcs_task().to_dict() | {"speed_rpm": 90.0},
}  # fmt: skip
"""Tasks in which every number that has a unit stands at least once."""
for path, number in declared(Task).items():
    # A number that is new, and stands nowhere yet.
    if isinstance(number.range, Fixed) and all(value_at(task, path) is None for task in TASKS.values()):
        TASKS["translating"] = changed_task(TASKS["translating"], {path: number.range.least + number.range.step})


def leaves(data: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """The numbers of plain data, by their paths."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from leaves(value, f"{path}.{key}".lstrip("."))
    elif isinstance(data, list):
        for k, value in enumerate(data):
            yield from leaves(value, f"{path}[{k}]")
    elif isinstance(data, float | int) and not isinstance(data, bool):
        yield path, data


def mark_at(hint: Any, steps: tuple[int | str, ...]) -> HeldIn | None:
    """The mark of the number at a place in tables, the first of several; None if it has no unit.

    hint : the type of the tables
    """
    marks = [mark for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, HeldIn)]
    if marks:
        return None if steps else marks[0]
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        hints = get_type_hints(hint, include_extras=True)
        return mark_at(hints[steps[0]], steps[1:]) if steps and steps[0] in hints else None
    parts = get_args(hint)
    if get_origin(hint) is tuple:
        place, *steps = steps or (0,)
        parts = parts[:1] if parts[1:] == (...,) else parts[int(place) :][:1]
    return next(filter(None, (mark_at(part, steps) for part in parts)), None)


def held(data: dict[str, Any], path: str) -> tuple[HeldIn, str] | None:
    """The mark of a number of a task, and its unit there; None where it has none."""
    root, place, turning = ArcsTask if "arcs" in data else Task, steps_of(path), False
    if "inertia" in data.get("spring", {}) and place[0] == "spring":
        root, place, turning = ArmSpringTable, place[1:], "at" not in data["spring"]
    elif place[0] == "motion":
        turning = data["follower"]["kind"] == "oscillating-flat" or data["follower"].get("lift") == "angle"
    mark = mark_at(root, place)
    return None if mark is None else (mark, (turning and mark.of_turning) or mark.own)


NUMBERS = [
    (name, path, value, *found)
    for name, data in TASKS.items()
    for path, value in leaves(data)
    if not path.startswith("motion.table") and (found := held(data, path))
]
"""Task, path, number, mark and unit of every number that has a unit."""


def hinted(hint: Any) -> bool:
    """Whether a type of a field has a unit, itself or that of its parts."""
    own = any(isinstance(mark, HeldIn) for mark in getattr(hint, "__metadata__", ()))
    return own or (not dataclasses.is_dataclass(hint) and any(map(hinted, get_args(hint))))


def test_the_tasks_have_every_field_that_has_a_unit():
    tables = {*classes_of(Task).values(), *classes_of(ArcsTask).values(), ArmSpringTable}
    asked = {
        (table, name)
        for table in tables
        for name, hint in get_type_hints(table, include_extras=True).items()
        if hinted(hint)
    }
    said = {(table, name) for data in TASKS.values() for table, name in fields_of(task_from(data))}
    assert len(asked) > 60
    assert {(table.__name__, name) for table, name in asked - said} == set()


def fields_of(table: Any) -> Iterator[tuple[type, str]]:
    """The fields of a task's tables that are given, with the class of the table."""
    if isinstance(table, tuple):
        for part in table:
            yield from fields_of(part)
    elif dataclasses.is_dataclass(table):
        for field in dataclasses.fields(table):
            if (value := getattr(table, field.name)) is not None:
                yield type(table), field.name
                yield from fields_of(value)


@pytest.mark.slow
def test_every_number_is_the_same_in_every_unit():
    wrong, count = [], 0
    for name, path, value, _, own in NUMBERS:
        for unit, factor in UNITS[own].items():
            read = value_at(task_from(changed_task(TASKS[name], {path: f"{value / factor!r} {unit}"})).to_dict(), path)
            count += 1
            if type(read) is not float or abs(read - value) > 1e-15 * abs(value):
                wrong.append((name, path, value, unit, read))
    assert wrong == []
    assert count > 1000


def test_a_unit_of_another_dimension_is_told_by_its_field():
    for name, path, _, mark, own in NUMBERS:
        unit = "lbf" if own == "kg" else "kg"
        with pytest.raises(TaskError) as caught:
            task_from(changed_task(TASKS[name], {path: f"3 {unit}"}))
        error, other = caught.value, "kg" if unit == "kg" else "N"
        assert (error.field, error.value) == (path, f"3 {unit}")
        assert str(error.remedy) == f"{unit} converts to {other}, not to {mark.own}"
        assert all(each in error.expected for each in UNITS[own])


@pytest.mark.parametrize(("name", "path", "text"), [
    ("translating", "motion.phases[0].lift", "12 deg"), ("arm", "motion.phases[0].lift", "12 mm"),
    ("arm by its arc", "motion.phases[0].lift", "0.5 rad"), ("conditions", "motion.parts[0].points[1].s", "12 deg"),
    ("swinging face by conditions", "motion.parts[1].points[0].v", "0 in/rad"),
    ("measured", "motion.tolerance", "1 deg"),
    ("arm", "spring.stiffness", "3 N/mm"), ("arm", "spring.preload", "3 lbf"),
    ("arm with a spring at a point", "spring.stiffness", "3 N m/rad"),
])  # fmt: skip
def test_a_lift_or_a_spring_has_the_unit_of_its_motion(name, path, text):
    others = {place: text for place, _ in leaves(TASKS[name]) if path.endswith("lift") and place.endswith(".lift")}
    with pytest.raises(TaskError, match="converts to") as caught:
        task_from(changed_task(TASKS[name], {**others, path: text}))
    assert (caught.value.field, str(caught.value.value)) == (path, text)


READ = {
    "1.25 in": 31.75, "0.020 in": 0.508, ".5in": 12.7, "5. mm": 5.0, "+3 mm": 3.0, "  2  cm ": 20.0, "1e-2 m": 10.0,
    "\u22121 mm": -1.0, "250 \u00b5m": 0.25, "250 \u03bcm": 0.25, "20 thou": 0.508, "3\tmm": 3.0, "0.1 in": 2.54,
}  # fmt: skip


@pytest.mark.parametrize(("text", "value"), READ.items())
def test_a_length_is_read_to_the_last_digit(text, value):
    assert HeldIn("mm").number(text) == value


@pytest.mark.parametrize(("own", "text", "value"), [
    ("rpm", "25 rad/s", 25 * 30 / math.pi), ("deg", "0.5 rad", math.degrees(0.5)), ("deg", "30°", 30.0),
    ("N", "12 lbf", 12 * 4.4482216152605), ("MPa", "1 ksi", 6.894757293168361), ("kg mm^2", "2 kg·m²", 2e6),
    ("N mm/rad", "1 N m/deg", 1000 * 180 / math.pi), ("N/mm", "1.5 kN/m", 1.5), ("MPa", "30 N/mm²", 30.0),
    ("kg/m^3", "0.284 lb/in^3", 0.284 * 27679.904710203), ("mm/rad^2", "1 in/deg^2", 25.4 * (180 / math.pi) ** 2),
])  # fmt: skip
def test_units_are_those_of_the_handbooks(own, text, value):
    assert HeldIn(own).number(text) == pytest.approx(value, rel=1e-13)


HOSTILE = {
    "": "", " ": "", "in": "", "auto": "", "nan in": "", "inf mm": "", "1e999 in": "", "- 3 mm": "", "--3 mm": "",
    "0x10 mm": "convert", "1_000 mm": "convert", "\u0663 mm": "", "mm 3": "", "3 furlong": "convert", "3 MM": '"3 mm"',
    "3 inches": '"3 in"', '3"': '"3 in"', "3 In": '"3 in"', "3 mm mm": "convert", "3 in 4 in": "convert",
    "1/4 in": "convert", "1 1/4 in": "convert", "3 mm^2": "convert", "1.2.3 mm": "convert", "1,25 in": '"1.25 in"',
    "1,250 in": '"1.250 in" or "1250 in"', "1.25": 'write 1.25 without quotes, or "1.25 mm"', "3 %": "convert",
    "3 mm; rm": "convert", "3\x00mm": '"3 mm"', "3 mm # in": "convert", "(3 mm)": "", "3 kg": "kg converts to kg",
    "3 rad": "rad converts to deg", "1e-999999999 furlong": "convert", "9" * 5000: "", "1 " + "m" * 100_000: "convert",
    "3\n\nmm\nx": "convert", "{offset}": "", "1.25 in": None,
    "3 мм": '"3 mm"', "8,5 мм": '"8.5 mm"', "8,5": 'without quotes, or "8.5 mm"',
}  # fmt: skip
"""What is typed for a length, and what of the remedy tells it; None if it is one."""


@pytest.mark.parametrize("text", HOSTILE, ids=[repr(text[:20]) for text in HOSTILE])
def test_hostile_texts_are_told_by_their_field(text):
    changed, said = changed_task(TASKS["translating"], {"follower.offset": text}), HOSTILE[text]
    if said is None:
        assert task_from(changed).follower.offset == 31.75
        return
    with pytest.raises(TaskError) as caught:
        task_from(changed)
    error = caught.value
    assert error.field == "follower.offset"
    assert error.expected == "a number of mm (without quotes), or text with its unit: " + ", ".join(UNITS["mm"])
    assert said in error.remedy if said else error.remedy == "or leave it out to let it be found"
    assert len(str(error)) < 500
    assert "\n" not in str(error)


@pytest.mark.parametrize("value", [True, [3], {"mm": 3}])
def test_what_is_no_text_is_told_as_before(value):
    with pytest.raises(TaskError) as caught:
        task_from(TASKS["translating"] | {"part": {"bore": value}})
    assert caught.value.field == "part.bore"
    assert caught.value.expected == "a number (without quotes)"


def in_inches(text: str) -> str:
    """The file of a task with its lengths in inches."""
    lengths = r"\b(lift|offset|roller_radius|rho1|distance|ordinate) = (-?[\d.]+)"
    return re.sub(lengths, lambda found: f'{found[1]} = "{Decimal(found[2]) / Decimal("25.4")} in"', text)


def on_sheet(solution: Any) -> tuple[Counter[bytes], Counter[str]]:
    """The strokes and curves on the sheets of a solution, and their texts."""
    drawing = sheet_of(solution)
    entities = [each for page in drawing.pages for group in page.groups for each in group.entities]
    lines = Counter(each.points.round(9).tobytes() for each in entities if isinstance(each, Stroke | Curve))
    return lines, Counter(each.text for each in drawing.texts)


def loaded(text: str, folder: Path) -> Any:
    path = folder / "inches.toml"
    path.write_text(text, encoding="utf-8")
    return gc.load_task(path)


@pytest.mark.parametrize("name", fast_first(["coursework", "flat", "arcs"]))
def test_a_task_in_inches_has_the_same_sheet_and_note_but_for_one_line(name, tmp_path):
    text = builtin_text(name)
    changed, given = (gc.solve(loaded(each, tmp_path)) for each in (in_inches(text), text))
    assert in_inches(text) != text
    assert changed.task == given.task
    assert json.dumps(changed.to_dict()) == json.dumps(given.to_dict())
    (lines, texts), (lines_given, texts_given) = map(on_sheet, (changed, given))
    assert lines == lines_given
    assert sum(lines.values()) >= 30
    row = ["units in the task file", "1 in = 25.4 mm", "given"]
    assert (texts - texts_given, texts_given - texts) == (Counter(row), Counter())
    sheets = [contents_of(solution) for solution in (changed, given)]
    (data, *others), (data_given, *others_given) = (sheet.givens for sheet in sheets)
    assert [str(words) for words in data.rows[-1]] == row
    assert data.rows[:-1] == data_given.rows
    assert (others, sheets[0].results) == (others_given, sheets[1].results)
    lines = [[re.sub(r"[ |-]+", " ", line) for line in note_of(each).splitlines()] for each in (changed, given)]
    added = [line for line in difflib.unified_diff(lines[1], lines[0], n=0) if re.match(r"[-+][^-+]", line)]
    assert len(added) == 1
    assert added[0].startswith("+ units in the task file 1 in = 25.4 mm")


def test_several_units_are_told_once_each_in_the_language_of_the_sheet(tmp_path):
    text = in_inches(builtin_text("coursework")).replace("speed_rpm = 120", 'speed_rpm = "4.5 rad/s"')
    text = text.replace("pressure_angle_rise = 30", 'pressure_angle_rise = "30 deg"').replace('"en"', '"ru"')
    solution = gc.solve(loaded(text, tmp_path))
    rows = [[solution.tell(words) for words in row] for row in contents_of(solution).givens[0].rows]
    assert [row[:2] for row in rows[-2:]] == [
        ["единицы в файле задания", "1 in = 25,4 мм"], ["", "1 рад/с = 9,549297 об/мин"],
    ]  # fmt: skip


def test_what_is_written_of_a_task_is_in_its_own_units(tmp_path):
    task = loaded(in_inches(builtin_text("coursework")), tmp_path)
    texts = [value for _, value in leaves(task.to_dict()) if type(value) not in (float, int)]
    assert texts == []
    assert task_files(task) == task_files(gc.builtin_task())
    for again in (pickle.loads(pickle.dumps(task)), copy.deepcopy(task), dataclasses.replace(task, title=task.title)):
        assert [number.text for _, number in numbers_in_units(again)] == [
            number.text for _, number in numbers_in_units(task)
        ]
    assert len(list(numbers_in_units(task))) == 4


def test_the_studio_opens_it_and_its_form_holds_millimetres():
    text = in_inches(builtin_text("coursework"))
    task = opened_task({"text": text})["task"]
    assert task == plain_task(gc.builtin_task())
    assert {type(value) for _, value in leaves(task)} <= {float, int}
    fields = {each["path"]: each for each in form_of(gc.solve(task_from(task)), str)}
    offset, phases = fields["follower.offset"], fields["motion.phases"]["phases"]
    assert (offset["value"], offset["unit"], phases[0]["lift"]) == (-10.0, "mm", 30.0)


@pytest.mark.parametrize(("name", "unit"), [
    ("translating", "mm"), ("arm", "°"), ("arm by its arc", "mm"), ("flat", "mm"), ("swinging face", "°"),
])  # fmt: skip
def test_the_form_has_the_unit_of_the_lift(name, unit):
    data = builtin("swinging-face") if name == "swinging face" else TASKS[name]
    (phases,) = (each for each in form_of(gc.solve(task_from(data)), str) if each["path"] == "motion.phases")
    fields = [field for phase in phases["phases"] for field in phase["fields"] if field["path"].endswith(".lift")]
    assert {field["unit"] for field in fields} == {unit}


def test_the_tolerance_of_a_table_may_have_a_unit(tmp_path):
    heights = [0, 1, 3, 5, 6, 5, 3, 1, 0.5]
    rows = "phi_deg,s_mm\n" + "".join(f"{45 * k},{s}\n" for k, s in enumerate(heights))
    (tmp_path / "measured.csv").write_text(rows, encoding="utf-8")
    text = builtin_text("measured").replace("tolerance = 0.01", 'tolerance = "1 mm"')
    assert loaded(text, tmp_path).motion.tolerance == 1.0
    with pytest.raises(TaskError, match="line 10"):
        loaded(text.replace("1 mm", "100 um"), tmp_path)


def test_exercises_and_spaces_have_plain_numbers(tmp_path):
    exercise = find_exercise("integration")
    parameters = {name: each.values[0] for name, each in exercise.parameters.items()}
    template = exercise.task | {"follower": exercise.task["follower"] | {"roller_radius": "0.5 in"}}
    with pytest.raises(TaskError) as caught:
        fill_in(dataclasses.replace(exercise, task=template), parameters)
    assert (caught.value.field, caught.value.expected) == ("follower.roller_radius", "a number (without quotes)")
    space = tmp_path / "space.toml"
    text = (files("graphcam") / "data" / "space.toml").read_text(encoding="utf-8")
    space.write_text(text.replace("lift = 30 ", 'lift = "1.25 in" '), encoding="utf-8")
    with pytest.raises(TaskError, match=r"motion\.lift"):
        load_space(space)


@pytest.mark.parametrize(("value", "remedy"), [
    ('"3 furlong"', "convert the number to one of these units"), ('"3 kg"', "kg converts to kg, not to mm"),
    ('"1.25"', 'write 1.25 without quotes, or "1.25 mm"'), ('"1,25 in"', 'write "1.25 in"'),
])  # fmt: skip
def test_the_command_line_tells_a_wrong_unit(value, remedy, tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(builtin_text("coursework").replace("offset = -10", f"offset = {value}"), encoding="utf-8")
    result = CliRunner().invoke(app, ["solve", str(path), "--out", str(tmp_path / "out")])
    shown = value.replace('"', "'")
    assert (result.exit_code, result.stdout) == (INPUT_ERROR_STATUS, "")
    assert result.stderr == (
        f"graphcam: {path}: line 18: follower.offset is {shown}, but must be a number of mm (without quotes), "
        f"or text with its unit: mm, cm, m, um, in, mil, thou, ft; {remedy}\n"
    )
    assert INPUT_ERROR_STATUS == 2


@pytest.mark.parametrize(("typed", "remedy"), [
    ("30 mm", "write 30"), ("1.25 in", 'write "1.25 in"'), ("3 cm", 'write "3 cm"'), ("3 furlong", "write 3"),
])  # fmt: skip
def test_a_unit_without_quotes_is_told(typed, remedy, tmp_path):
    with pytest.raises(TaskError) as caught:
        loaded(builtin_text("coursework").replace("lift = 30", f"lift = {typed}"), tmp_path)
    assert caught.value.remedy == remedy
