"""What counts of one student's photographs: the best of each page, judged, and with the teacher's corrections.

It is the first place that knows the key: what looks neither like it nor like a usual mistake is nothing that is marked.
Nothing that was read is changed here, it is only taken or not.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from graphcam.exercises.definition.exercise import AskedAnswer, Exercise, Given
from graphcam.exercises.key.answer_key import AnswerKey, Key
from graphcam.exercises.key.expected_answers import Expected, distance_from_drawn, paired
from graphcam.exercises.photographs.corrections import (
    CORRECTIONS_FILE,
    NO_CORRECTIONS,
    Correction,
    StudentCorrections,
    stretch_of,
    stretched_points,
)
from graphcam.exercises.photographs.read_photo import ReadAnswer, ReadPhoto
from graphcam.photo.printed_page import Points
from graphcam.words import Caption, Words, say

SEARCH_BAND = 6.0
"""mm of paper.  The usual mistakes are drawn out, so what lies farther from all of them was drawn for something else,
or is no drawing of this exercise; slips of a hand are less."""
BAND_PERCENT = 95
"""Percent of the expected places that must lie within the band: one bad place is a slip, and is marked as one."""
FAINT_BAND = 2.5
"""mm about a place in which a faint point is taken for the one that is missing there."""
MAX_FAINT_SHARE = 0.4
"""Share of the places whose points may be faint: of a foreign drawing most are without."""
REVIEW_NOTE = say("the teacher will check it on the review page")
"""What becomes of what is not taken."""


def answer_from_points(asked: AskedAnswer, points: Points, key: Key | None) -> Given | None:
    """The answer that drawn points (n,) give [mm of paper from the view's origin]; None where others are needed.

    key : tells the scale of a length, without which there is none

    >>> asked = AskedAnswer("x", "Where?", "inversion", points="pitch", component="x", place="profile", mark="cross")
    >>> answer_from_points(asked, np.array([3 + 4j]), None)
    3.0
    """
    if asked.kind != "number":
        return points if points.size else None
    if asked.mark_form == "length":
        return None if key is None or points.size != 2 else float(abs(points[1] - points[0])) * _per_mm(key)
    if points.size != 1 or not asked.component:
        return None
    return float(points[0].real if asked.component == "x" else points[0].imag)


def chosen_points(
    asked: AskedAnswer, seen: Points, faint: Points, answer_key: AnswerKey, place: int
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
    if lone.size > MAX_FAINT_SHARE * places.size:
        return faint[:0]
    return faint[at[at.sum(axis=1) == 1].any(axis=0)]


def not_taken(exercise: Exercise, asked: AskedAnswer, value: Given, answer_key: AnswerKey) -> Caption | None:
    """The reason why a value that was read is not marked without a teacher's look; None where it is.

    value : in the student's unit, or points (n,) in mm of paper from the view's origin
    """
    place = exercise.answers.index(asked)
    key = answer_key.keys[asked.name]
    # Most are right, so the key comes first, and the mistakes only where they are needed.
    off = math.inf
    for expected in _known(key, answer_key, place):
        off = min(off, _distance_from(asked, value, expected, key))
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


def _distance_from(asked: AskedAnswer, value: Given, expected: Expected, key: Key) -> float:
    """How far most of a drawing lies from what would be expected, mm of paper."""
    if not isinstance(value, np.ndarray):
        # Of what has no length on paper nothing can be said in mm.
        off = abs(value - float(np.real(expected.value))) / _per_mm(key)
        return off if math.isfinite(off) else 0.0
    distances = expected.distances(value, asked.kind)
    if asked.kind == "curve":
        # The other way round too: a scribble that passes all places of the key is none of its drawings.
        back, _ = distance_from_drawn(value, np.atleast_1d(np.asarray(expected.value)), expected.bulge)
        return max(float(np.percentile(distances, BAND_PERCENT)), float(np.percentile(back, BAND_PERCENT)))
    return float(np.percentile(distances, BAND_PERCENT)) if np.isfinite(distances).all() else math.inf


def _per_mm(key: Key) -> float:
    """Units of a length in one mm of paper; NaN of what is none."""
    return key.tolerance / key.tolerance_paper if key.tolerance_paper > 0 else math.nan


Status = Literal["read", "refused", "not seen", "corrected", "confirmed", "left out", "typed", "not typed"]
COUNTED_STATES: tuple[Status, ...] = ("read", "corrected", "confirmed", "typed")
"""The states of an answer that goes into answers.toml."""
UNIT_STRETCH = (1.0, 1.0)


@dataclass(frozen=True, eq=False)
class SettledAnswer:
    """What became of one answer.

    read : as the photograph shows it; None where it shows none
    status : whether it counts, and by whose word
    given : what counts, as answers.toml takes it, on paper as long as its bars measure; None where nothing does
    as_read : what was read and taken, on paper as it was printed; None where nothing was
    points : that are drawn for it, as the photograph has them, corrections included; None where none are
    why, remedy : of one that does not count
    page : on which it is drawn; 0 where it is not
    outdated : whether the teacher looked at another photograph than the one that counts now
    """

    asked: AskedAnswer
    read: ReadAnswer | None
    status: Status
    given: Given | None = None
    as_read: Given | None = None
    points: Points | None = None
    why: Words = ""
    remedy: Words = ""
    page: int = 0
    outdated: bool = False


@dataclass(frozen=True, eq=False)
class SettledStudent:
    """What counts of a student's photographs.

    pages : the photograph that counts, by page
    others : photographs of the same pages that do not count, and those that are refused
    answers : in the order of the exercise
    stretches : by page, how much longer the paper is than it should be, across and up, where a bar was measured
    """

    student: str
    pages: Mapping[int, ReadPhoto]
    others: Sequence[ReadPhoto]
    answers: Sequence[SettledAnswer]
    corrections: StudentCorrections
    stretches: Mapping[int, tuple[float, float]]

    @property
    def open(self) -> bool:
        """Whether a teacher has to look at it."""
        waits = any(one.status in ("refused", "not seen") for one in self.answers)
        return (waits and not self.corrections.reviewed) or any(one.outdated for one in self.answers)

    def values(self) -> dict[str, Given]:
        """What counts, by the answer's name."""
        return {one.asked.name: one.given for one in self.answers if one.given is not None}

    def read_values(self) -> dict[str, Given]:
        """What was read and taken, on paper as it was printed, by the answer's name."""
        return {one.asked.name: one.as_read for one in self.answers if one.as_read is not None}

    @property
    def notes(self) -> list[Words]:
        """Sentences for the teacher."""
        found: list[Words] = [
            say(
                "{answer} was checked on another photograph than {photo}, which counts now; check it again",
                answer=one.asked.name,
                photo=self.pages[one.page].name,
            )
            for one in self.answers
            if one.outdated
        ]
        found += [
            say(
                "{photo} shows page {page} too; {best} is the better photograph and counts",
                photo=photo.name,
                page=photo.page,
                best=self.pages[photo.page].name,
            )
            for photo in self.others
            if not photo.why and not photo.half and photo.page in self.pages
        ]
        found += [
            say(
                "{photo} shows one of the two sheets of page {page}; give the photographs of both in one run",
                photo=photo.name,
                page=photo.page,
            )
            for photo in self.others
            if photo.half and not photo.why and photo.page not in self.pages
        ]
        return found


def best_photographs(photos: Iterable[ReadPhoto]) -> dict[int, ReadPhoto]:
    """The photograph of each page that counts: the one with most answers read, most of them seen, least residual."""
    best: dict[int, ReadPhoto] = {}
    for photo in sorted(photos, key=_merit, reverse=True):
        if photo.is_identified and not photo.why and not photo.half:
            best.setdefault(photo.page, photo)
    return dict(sorted(best.items()))


def _merit(photo: ReadPhoto) -> tuple[int, float, float, str]:
    read = [one for one in photo.answers.values() if not one.why]
    # In steps, so that a hair more that is seen does not outweigh marks that fit badly.
    share = round(min((one.share for one in read), default=0.0), 2)
    return len(read), share, -photo.residual, photo.digest


def settled_student(
    exercise: Exercise,
    student: str,
    photos: Sequence[ReadPhoto],
    answer_key: AnswerKey | None,
    corrections: StudentCorrections = NO_CORRECTIONS,
) -> SettledStudent:
    """What counts of a student's photographs.

    answer_key : without it nothing is judged, so nothing that is drawn counts

    Raises
    ------
    TaskError : a scale bar is measured so that no printer scales like that
    """
    pages = best_photographs(photos)
    others = [photo for photo in photos if photo is not pages.get(photo.page)]
    stretches = {
        page: stretch_of(photo.bars, corrections.bars[page], f"{CORRECTIONS_FILE}: students.{student}.bars.{page}")
        for page, photo in pages.items()
        if page in corrections.bars
    }
    answers: list[SettledAnswer] = []
    for asked in exercise.answers:
        correction = corrections.answers.get(asked.name)
        photo = next((one for one in pages.values() if asked.name in one.answers), None)
        if not asked.mark_form:
            answers.append(_settled_text(asked, correction))
        elif photo is None:
            why = say("no readable photograph shows it")
            remedy = say("photograph the page on which it is drawn")
            answers.append(SettledAnswer(asked, None, "not seen", why=why, remedy=remedy))
        else:
            read = photo.answers[asked.name]
            judge = _Judge(exercise, asked, answer_key, read.closed, stretches.get(photo.page, UNIT_STRETCH))
            one = _settled_drawing(judge, read, correction)
            outdated = correction is not None and correction.photo not in ("", photo.digest)
            answers.append(replace(one, page=photo.page, outdated=outdated))
    return SettledStudent(student, pages, others, answers, corrections, stretches)


def _settled_text(asked: AskedAnswer, correction: Correction | None) -> SettledAnswer:
    if correction is None:
        why = say("the answer table is not read; type it in on the review page")
        return SettledAnswer(asked, None, "not typed", why=why)
    return SettledAnswer(asked, None, "typed", correction.value)


@dataclass(frozen=True, eq=False)
class _Judge:
    """What it takes to make an answer of what is drawn."""

    exercise: Exercise
    asked: AskedAnswer
    answer_key: AnswerKey | None
    closed: bool
    stretch: tuple[float, float]

    def answer_from(self, points: Points, stretch: tuple[float, float]) -> Given | None:
        """The answer that the points give; None where there are too few or too many."""
        key = None if self.answer_key is None else self.answer_key.keys[self.asked.name]
        points = np.append(points, points[:1]) if self.closed else points
        return answer_from_points(self.asked, stretched_points(points, stretch), key)

    def judged(self, read: ReadAnswer) -> tuple[Points | None, tuple[Words, Words] | None]:
        """The points that are meant for the answer, and why they are not marked and what to do, if they are not."""
        points = read.points
        if read.why or points is None:
            return points, (read.why or say("nothing is read"), read.remedy or REVIEW_NOTE)
        if self.answer_key is None:
            return points, (say("the student has no answer key"), REVIEW_NOTE)
        points, why = chosen_points(
            self.asked, points, read.faint, self.answer_key, self.exercise.answers.index(self.asked)
        )
        if why is None:
            # As long as the bars measure: a page that was printed small is not foreign for that.
            given = self.answer_from(points, self.stretch)
            if given is None:
                why = say("{count} points are seen, not the required number", count=int(points.size))
            else:
                why = not_taken(self.exercise, self.asked, given, self.answer_key)
        return points, None if why is None else (why, REVIEW_NOTE)


def _settled_drawing(judge: _Judge, read: ReadAnswer, correction: Correction | None) -> SettledAnswer:
    """The mark of a drawn answer after its correction, if there is one."""
    asked = judge.asked
    points, refused = judge.judged(read)
    as_read = judge.answer_from(points, UNIT_STRETCH) if points is not None and not refused else None
    if correction is not None and correction.verdict == "left out":
        return SettledAnswer(asked, read, "left out", None, as_read, points, say("the teacher has excluded it"))
    if correction is not None:
        said = np.asarray(correction.value) if correction.verdict == "corrected" else points
        given = None if said is None else judge.answer_from(said, judge.stretch)
        if given is not None:
            return SettledAnswer(asked, read, correction.verdict, given, as_read, said)
    if refused or points is None:
        why, remedy = refused or ("", "")
        return SettledAnswer(asked, read, "refused", None, None, points, why, remedy)
    return SettledAnswer(asked, read, "read", judge.answer_from(points, judge.stretch), as_read, points)
