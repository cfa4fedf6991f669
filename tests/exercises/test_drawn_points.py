"""Plotted points are marked in whatever order and form they are given; one that is off, missing or too many is said."""

from __future__ import annotations

import numpy as np
import pytest
from issued_variants import issued, key
from test_drawn_answers import data_of, new, origin

from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Record
from graphcam.exercises.reading.submission_files import from_files
from graphcam.exercises.reports.unrolled_drawings import worst_place

NAME, ASKED, LAYER = "inversion-arm", "rollers", "ROLLERS"
Points = np.ndarray


def centres() -> Points:
    return np.array(key(issued(NAME)[1])[ASKED])


def shuffled(points: Points) -> Points:
    return np.random.RandomState(3).permutation(points)


def as_toml(points: Points) -> dict[str, bytes]:
    return {"answers.toml": f"{ASKED} = {[[z.real, z.imag] for z in points.tolist()]}".encode()}


def as_csv(points: Points) -> dict[str, bytes]:
    return {"answers.csv": "\n".join(f"{ASKED};{z.real};{z.imag}" for z in points.tolist()).replace(".", ",").encode()}


def as_points(points: Points) -> dict[str, bytes]:
    drawing = origin(new(), 30 - 20j)
    # Some stand twice on the same place, as a copied layer leaves them.
    for z in (*points.tolist(), *points[:5].tolist()):
        drawing.modelspace().add_point((z.real + 30, z.imag - 20), dxfattribs={"layer": LAYER})
    return {"answers.dxf": data_of(drawing, "asc")}


def as_rollers(points: Points) -> dict[str, bytes]:
    drawing = origin(new(), 0j)
    for z in points.tolist():
        drawing.modelspace().add_circle((z.real, z.imag), 12, dxfattribs={"layer": LAYER.lower()})
    return {"answers.dxf": data_of(drawing, "asc")}


FORMS = {"toml": as_toml, "csv": as_csv, "points": as_points, "circles": as_rollers}


def handed_in(files: dict[str, bytes]) -> Record:
    exercise, answer_key = issued(NAME)
    return mark(exercise, answer_key, from_files(exercise.answers, files))


def rollers_of(record: Record):
    return next(answer for answer in record.answers if answer.name == ASKED)


@pytest.mark.parametrize("form", FORMS)
def test_points_are_marked_in_any_order_and_form(form: str):
    careful = shuffled(centres() + 0.4 * np.exp(1j * np.arange(centres().size)))
    found = rollers_of(handed_in(FORMS[form](careful)))
    assert found.outcome == "right"
    assert found.off_paper == pytest.approx(0.4, abs=1e-3)


@pytest.mark.parametrize("form", FORMS)
def test_the_one_point_that_is_off_is_the_one_that_is_shown(form: str):
    drawn = centres()
    # Far beyond its neighbours, so that the nearest of the right places is not its own.
    drawn[9] *= 1.4
    found = rollers_of(handed_in(FORMS[form](shuffled(drawn))))
    assert found.outcome == "wrong"
    assert found.station == 9
    assert found.off_paper == pytest.approx(0.4 * abs(centres()[9]), abs=1e-3)
    spot = worst_place(issued(NAME)[1].keys[ASKED].expected, {"station": 9, "given": found.given}, "points")
    assert spot == pytest.approx(complex(drawn[9]), abs=1e-3)


@pytest.mark.parametrize("more", [-1, 1])
def test_another_number_of_points_is_no_answer_and_said(more: int):
    points = np.append(centres(), 0j)[: centres().size + more]
    record = handed_in(as_toml(points))
    found = rollers_of(record)
    assert (found.outcome, found.station, found.off_paper) == ("wrong", None, None)
    assert any(f"points read: {points.size};" in str(sentence) for sentence in record.feedback)
    assert record.to_dict()["answers"][-1]["deviation"] is None


def test_a_set_of_points_passes_only_once_for_each_place():
    """A point drawn over another does not stand for the one that was left out."""
    drawn = centres()
    drawn[12] = drawn[11] + 0.01
    assert rollers_of(handed_in(as_toml(drawn))).outcome == "wrong"


def test_points_of_a_usual_mistake_are_named_and_follow():
    exercise, answer_key = issued(NAME)
    for name, wrong in answer_key.hypotheses.items():
        given = {asked.name: value.value for asked, value in zip(exercise.answers, wrong, strict=True)}
        given[ASKED] = shuffled(np.asarray(given[ASKED]))
        record = mark(exercise, answer_key, Answers(given))
        assert record.diagnosis is not None
        assert name in (record.diagnosis.misconception, *record.diagnosis.alike)
        assert rollers_of(record).outcome in ("follow-through", "wrong")
        assert record.total < record.of
