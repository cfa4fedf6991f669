"""A step names the readings that it takes; written down, millimetres times the scale are the value."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from boards import coursework
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.constructions.force_plan import force_plan
from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.ink import Construction, Part, Step, View, reading, say
from graphcam.drafting.pencil import Pencil
from graphcam.given.spring_load import SpringLoad
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

TASKS = ("coursework", "arm", "flat", "swinging-face", "measured", "arcs")
HANDS = (Pencil(), Pencil(line=0.1, dividers=0.1, protractor=math.radians(0.5), samples=3, seed=4))
each_task = over_all("task", TASKS)
each_hand = over_all("pencil", HANDS)
WRITTEN = re.compile(r"(-?[\d.]+) mm × ([-\d.e]+)(°| \(?[^ ]+\)?)/mm = (-?[\d.]+)(°| .+)")


@cache
def drawn(task: str, pencil: Pencil) -> dict[str, Construction]:
    solution = gc.solve(builtin_arcs_task() if task == "arcs" else builtin_task(task), pencil)
    found = dict(solution.drawn)
    if task == "coursework":
        found["force_plan"] = force_plan(found["pressure_angle"], SpringLoad(0.5, 300.0, 2.0, 20.0), pencil)
    return found


def steps(task: str, pencil: Pencil) -> Iterator[tuple[Construction, Step]]:
    for construction in drawn(task, pencil).values():
        for step in construction.steps():
            yield construction, step


@each_hand
@each_task
def test_millimetres_times_the_scale_are_the_value(task, pencil):
    """As a reader multiplies the printed numbers, to the last printed digit."""
    written = 0
    for construction, step in steps(task, pencil):
        for row, place in ((read, k) for read in rows(construction, step) for _, k in told(read)):
            said = str(row.caption(place))
            assert not re.search("nan|inf|None", said), said
            if row.mu is None:
                assert re.fullmatch(r"-?\d+\.\d\d(°| mm)", said), said
                continue
            paper, mu, _, value, _ = WRITTEN.fullmatch(said).groups()
            half_a_digit = 0.006 * float(mu) + 1e-4 * abs(float(value))
            assert float(paper) * float(mu) == pytest.approx(float(value), abs=half_a_digit), said
            written += 1
    assert written > 8


def told(row: ReadingRow) -> list[tuple[object, int | None]]:
    """What is told first: of several values the extremes."""
    return row.extremes if row.places else [("", None)]


@each_hand
@each_task
def test_the_value_is_that_of_the_reading(task, pencil):
    for construction, step in steps(task, pencil):
        for row in rows(construction, step):
            unit = 180 / math.pi if row.unit == "°" else 1.0
            np.testing.assert_allclose(row.value, unit * construction.value(row.name), rtol=1e-12, atol=1e-7)
            assert len(row.places) == (row.value.size if row.value.ndim else 0)


@each_task
def test_every_construction_with_readings_says_where_they_are_taken(task):
    for name, construction in drawn(task, HANDS[0]).items():
        taken = [reads for step in construction.steps() for reads in step.reads]
        assert len(taken) == len(set(taken)), name
        assert bool(taken) == bool(construction.readings), name


def test_what_a_construction_says_of_its_readings_some_step_reads():
    """And nothing is read that it does not speak of."""
    taken = defaultdict(set)
    for task in TASKS:
        for construction, step in steps(task, HANDS[0]):
            # Constructions of different followers may have one name.
            taken[construction.name, str(construction.meaning.why)].update(step.reads)
    for task in TASKS:
        for construction in drawn(task, HANDS[0]).values():
            meaning = construction.meaning
            assert taken[meaning.name, str(meaning.why)] == set(meaning.readings), meaning.name


@each_task
def test_the_unit_of_a_reading_is_the_one_that_its_meaning_says(task):
    for construction in drawn(task, HANDS[0]).values():
        for name, meaning in construction.meaning.readings.items():
            lift = "rad" if task in ("arm", "swinging-face") else "mm"
            assert construction.readings[name].unit == meaning.unit.replace("lift", lift), (construction.name, name)


def test_a_reading_of_which_nothing_is_said_is_refused_by_its_name():
    construction = Chain(coursework())["minimum_radius"]
    step = Step(say("A"), (Part(say("B.")),), View("v", say("V"), "x", "y"), (), reads=("height",))
    with pytest.raises(gc.DesignError, match=r"reading of minimum_radius is .*, but must be told"):
        rows(replace(construction, readings={"height": reading(1.0, 1.0, "mm")}), step)


def test_values_at_stations_bear_the_names_of_the_stations():
    (row,) = (
        r for c, s in steps("coursework", HANDS[0]) for r in rows(c, s) if c.name == "integration" and r.name == "s"
    )
    assert row.places[:3] == ("0", "1", "2")
    assert row.places[-1].endswith("′")
    assert str(row.caption(0)).startswith("0.00 mm × ")
    assert [str(row.extreme_caption(what, k)) for what, k in row.extremes] == ["maximum (station 12)"]


def row_of(task: str, construction: str, name: str) -> ReadingRow:
    (row,) = (r for c, s in steps(task, HANDS[0]) for r in rows(c, s) if (c.name, r.name) == (construction, name))
    return row


@over_all(
    ("task", "name", "extremes"),
    [
        ("coursework", "inversion.x", ["minimum (station 12) = -73.49", "maximum (station 12′) = 13.69"]),
        ("coursework", "inversion.radius", ["maximum (station 12) = 73.49"]),
        ("coursework", "pressure_angle.alpha", ["minimum (station 6′) = -49.32", "maximum (station 6) = 29.68"]),
        ("coursework", "pressure_angle.transmission", ["minimum (station 6′) = 40.68"]),
        ("arm", "pressure_angle.transmission", ["minimum (station 6′) = 55.18"]),
        ("coursework", "acceleration.greatest", ["maximum (return φ₃) = 88.89"]),
        ("coursework", "acceleration.middles", ["minimum (part 1′) = -88.89", "maximum (part 7′) = 88.89"]),
        ("coursework", "integration.closing_v", ["maximum (rise φ₁) = 0"]),
        ("coursework", "roller.candidates", ["minimum (0.4 r₀) = 17.6"]),
        ("arm", "roller.candidates", ["minimum (given) = 15"]),
        ("measured", "differentiation.v", ["minimum (φ = 183.8°) = -35.6", "maximum (φ = 48.75°) = 32.1"]),
        ("arcs", "arc_roller.a", ["minimum (station 8) = -93.3", "maximum (station 4) = 36.5"]),
    ],
)
def test_several_values_are_summed_up_by_what_counts_and_where_it_is(task, name, extremes):
    """Both of what has two signs, of angles that must not be small the least."""
    row = row_of(task, *name.split("."))
    found = [f"{row.extreme_caption(what, k)} = {row.value[k]:.4g}" for what, k in row.extremes]
    where = [text.rpartition(" = ")[0] for text in found]
    assert where == [text.rpartition(" = ")[0] for text in extremes]
    values = [float(text.rpartition(" = ")[2]) for text in found]
    assert values == pytest.approx([float(text.rpartition(" = ")[2]) for text in extremes], rel=2e-3)


@each_hand
@each_task
def test_the_extremes_are_the_least_and_the_greatest_value(task, pencil):
    for construction, step in steps(task, pencil):
        for row in rows(construction, step):
            if not row.places:
                continue
            found = {str(what): row.value[k] for what, k in row.extremes}
            low, high = np.nanmin(row.value), np.nanmax(row.value)
            assert found.get("minimum", low) == low
            assert found.get("maximum", high) == high
            both = row.judged == "extremes" and low < 0 <= high
            assert (len(found) == 2) == both, (construction.name, row.name)


@each_task
def test_what_does_not_belong_to_stations_is_not_said_to(task):
    for construction, step in steps(task, HANDS[0]):
        for row in rows(construction, step):
            stations = {str(name) for name in row.places} if row.stations else {"0", "12"}
            assert row.stations or construction.meaning.readings[row.name].over or not row.places, row.name
            assert all(re.fullmatch(r"\d+′*|[A-Z]", name) for name in stations), stations


def test_what_could_not_be_read_is_left_out():
    construction = Chain(coursework())["minimum_radius"]
    unreadable = replace(construction, readings={"s0": reading(np.nan, 1.0, "mm")})
    step = Step(say("A"), (Part(say("B.")),), View("v", say("V"), "x", "y"), (), reads=("s0",))
    assert rows(construction, step)
    assert rows(unreadable, step) == []


def test_a_wrong_scale_would_be_seen():
    """The first test multiplies what is printed: a value of another scale fails it."""
    row = ReadingRow("s0", say("s₀"), np.array(50.0), 0.5, np.array(25.1), "mm", ())
    paper, mu, _, value, _ = WRITTEN.fullmatch(str(row.caption())).groups()
    assert float(paper) * float(mu) != pytest.approx(float(value), abs=0.006 * 0.5 + 1e-4 * 25)
