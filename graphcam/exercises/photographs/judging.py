"""What was read beside the key and the usual mistakes: what looks like none of them is nothing that is marked.

It is the first place that knows the key.  Nothing that was read is changed here, it is only taken or not.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from graphcam.exercises.definition.exercise import Asked, Exercise, Given
from graphcam.exercises.key.answer_key import AnswerKey, Key
from graphcam.exercises.key.expectation import Expected, distance_from_drawn, paired
from graphcam.photo.printed import Points
from graphcam.words import Caption, say

SEARCH_BAND = 6.0
"""mm of paper.  The usual mistakes are drawn out, so what lies farther from all of them was drawn for something else,
or is no drawing of this exercise; slips of a hand are less."""
MOST_OF_IT = 95
"""Percent of the expected places that must lie within the band: one bad place is a slip, and is marked as one."""
FAINT_BAND = 2.5
"""mm about a place in which a faint point is taken for the one that is missing there."""
MOST_FAINT = 0.4
"""Share of the places whose points may be faint: of a foreign drawing most are without."""
LOOK = say("the teacher will check it on the review page")
"""What becomes of what is not taken."""


def given_by(asked: Asked, points: Points, key: Key | None) -> Given | None:
    """The answer that drawn points (n,) give [mm of paper from the view's origin]; None where others are needed.

    key : tells the scale of a length, without which there is none

    >>> asked = Asked("x", "Where?", "inversion", points="pitch", component="x", place="profile", mark="cross")
    >>> given_by(asked, np.array([3 + 4j]), None)
    3.0
    """
    if asked.kind != "number":
        return points if points.size else None
    if asked.drawn_as == "length":
        return None if key is None or points.size != 2 else float(abs(points[1] - points[0])) * _per_mm(key)
    if points.size != 1 or not asked.component:
        return None
    return float(points[0].real if asked.component == "x" else points[0].imag)


def chosen(
    asked: Asked, seen: Points, faint: Points, answer_key: AnswerKey, place: int
) -> tuple[Points, Caption | None]:
    """The points that were plotted for the answer, of all that are seen (n,), and why these are not marked.

    More is seen on a drawing than is asked: the centre, numbers, other constructions.  What lies outside the band about
    the places of a drawing, the right one or one with a usual mistake, is not meant for it.  Two points near one place
    are not chosen from.  A place without a point is not filled; a faint one (m,) that is seen there is taken, of a few.

    place : of the answer in the exercise
    """
    if asked.kind != "points":
        return seen, None
    most, wanted = 0, 0
    for expected in _known(answer_key.keys[asked.name], answer_key, place):
        places = np.atleast_1d(np.asarray(expected.value))
        near = seen[(np.abs(seen[:, None] - places) <= SEARCH_BAND).any(axis=1)]
        near = np.append(near, _faint_at(places, near, faint))
        if near.size == places.size and np.abs(paired(near, places) - places).max() <= SEARCH_BAND:
            return near, None
        if not wanted or near.size > most:
            most, wanted = int(near.size), int(places.size)
    if most > wanted:
        return seen, say("{found} points are seen near {wanted} places", found=most, wanted=wanted)
    return seen, say("{found} of {wanted} points are seen", found=most, wanted=wanted)


def _faint_at(places: Points, near: Points, faint: Points) -> Points:
    """Faint points (m,), each the only one at a place that has no sure one, unless too many of the places need them."""
    lone = places[(np.abs(places[:, None] - near) > FAINT_BAND).all(axis=1)]
    at = np.abs(lone[:, None] - faint) <= FAINT_BAND
    if lone.size > MOST_FAINT * places.size:
        return faint[:0]
    return faint[at[at.sum(axis=1) == 1].any(axis=0)]


def not_taken(exercise: Exercise, asked: Asked, value: Given, answer_key: AnswerKey) -> Caption | None:
    """The reason why a value that was read is not marked without a teacher's look; None where it is.

    value : in the student's unit, or points (n,) in mm of paper from the view's origin
    """
    place = exercise.answers.index(asked)
    key = answer_key.keys[asked.name]
    # Most are right, so the key comes first, and the mistakes only where they are needed.
    off = math.inf
    for expected in _known(key, answer_key, place):
        off = min(off, _off(asked, value, expected, key))
        if off <= SEARCH_BAND:
            return None
    if not math.isfinite(off):
        return say("it resembles neither the right drawing nor a usual mistake")
    return say(
        "it lies {off:.0f} mm from the right drawing and from every usual mistake; at most {band:g} mm is accepted",
        off=math.ceil(off),
        band=SEARCH_BAND,
    )


def _known(key: Key, answer_key: AnswerKey, place: int) -> Iterator[Expected]:
    """What is right, and what every usual mistake would draw."""
    yield key.expected
    for wrong in answer_key.hypotheses.values():
        yield wrong[place]


def _off(asked: Asked, value: Given, expected: Expected, key: Key) -> float:
    """How far most of a drawing lies from what would be expected, mm of paper."""
    if not isinstance(value, np.ndarray):
        # Of what has no length on paper nothing can be said in mm.
        off = abs(value - float(np.real(expected.value))) / _per_mm(key)
        return off if math.isfinite(off) else 0.0
    distances = expected.distances(value, asked.kind)
    if asked.kind == "curve":
        # The other way round too: a scribble that passes all places of the key is none of its drawings.
        back, _ = distance_from_drawn(value, np.atleast_1d(np.asarray(expected.value)), expected.bulge)
        return max(float(np.percentile(distances, MOST_OF_IT)), float(np.percentile(back, MOST_OF_IT)))
    return float(np.percentile(distances, MOST_OF_IT)) if np.isfinite(distances).all() else math.inf


def _per_mm(key: Key) -> float:
    """Units of a length in one mm of paper; NaN of what is none."""
    return key.tolerance / key.tolerance_paper if key.tolerance_paper > 0 else math.nan
