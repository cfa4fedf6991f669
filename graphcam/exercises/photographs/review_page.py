"""The page on which a teacher looks at what was read, corrects it and types what is not read: one file for itself."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterable
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.photographs.corrections import FORMAT_VERSION, STRETCH_RANGE, student_data
from graphcam.exercises.photographs.counted_answers import COUNTED_STATES, UNIT_STRETCH, SettledAnswer, SettledStudent
from graphcam.exercises.photographs.photograph_store import KeptPhotographs
from graphcam.exercises.photographs.read_photo import BARS, TABLE, ReadPhoto, pairs
from graphcam.exercises.photographs.student_files import right_in_photo
from graphcam.exercises.reports.unrolled_drawings import key_line
from graphcam.exercises.reports.web_pages import page
from graphcam.language import language
from graphcam.photo.printed_page import Edges
from graphcam.words import say

MAX_CURVE_POINTS = 600
"""Points of a right curve that the page shows."""
PAGE_CAPTIONS = {
    "point": say("{answer}: point {number} of {count} at x {x}, y {y} mm"),
    "number": say("{count} of {wanted} points: until the number is right, the answer earns nothing"),
    "progress": say("{done} of {count} done"),
    "noNumber": say("not a number"),
    "measureAgain": say("no printer scales by so much; measure again: from {low} to {high} mm"),
}
"""What the page says while it is used; the page itself fills the places."""
Told = tuple[SettledStudent, AnswerKey | None]


def review_page(
    exercise: Exercise, students: Iterable[Told], kept: KeptPhotographs, photos: Iterable[ReadPhoto] = ()
) -> str:
    """The page as HTML.

    students : with their answer keys, for what is right
    photos : all of them; those that are nobody's are listed
    """
    listed = [_student(exercise, student, answer_key, kept) for student, answer_key in students]
    spoken = language(exercise.language)
    data = {
        "format": FORMAT_VERSION,
        "exercise": exercise.name,
        "stretch": STRETCH_RANGE,
        "decimal": spoken.decimal,
        "texts": {name: spoken.catalog.translation(words.template) for name, words in PAGE_CAPTIONS.items()},
        "students": [
            {name: one[name] for name in ("student", "corrections", "drawn")}
            | {"views": [{"answers": view["answers"]} for view in one["views"]]}
            for one in listed
        ],
    }
    return page(
        "review.html",
        exercise,
        students=listed,
        unknown=[photo for photo in photos if photo.why and not photo.is_identified],
        data=_safe(json.dumps(data, allow_nan=False)),
        script=_page_file("review.js"),
        review_style=_page_file("review.css"),
    )


def _student(
    exercise: Exercise, student: SettledStudent, answer_key: AnswerKey | None, kept: KeptPhotographs
) -> dict[str, Any]:
    drawn = [_drawn_answer(exercise, one, student, answer_key) for one in student.answers if one.asked.mark_form]
    tables = (kept.picture(photo, TABLE) for photo in student.pages.values())
    refused = [photo for photo in student.others if photo.why]
    notes = [say("{name}: {why}; {remedy}", name=one.name, why=one.why, remedy=one.remedy) for one in refused]
    return {
        "student": student.student,
        "open": student.open,
        "notes": [exercise.tell(note) for note in (*student.notes, *notes)],
        "drawn": drawn,
        "typed": [
            {"name": one.asked.name, "text": _answer_text(exercise, one, answer_key), "unit": one.asked.unit_caption}
            for one in student.answers
            if not one.asked.mark_form
        ],
        "table": next((_address(data) for data in tables if data is not None), None),
        "views": [view for number, photo in student.pages.items() for view in _views(number, photo, student, kept)],
        "pages": [{"page": number, "bars": _bars(photo, kept)} for number, photo in student.pages.items()],
        "corrections": student_data(student.corrections),
    }


def _drawn_answer(
    exercise: Exercise, one: SettledAnswer, student: SettledStudent, answer_key: AnswerKey | None
) -> dict[str, Any]:
    """A drawn answer as the page shows it, and as its script takes it."""
    right = right_in_photo(one, answer_key, student.stretches.get(one.page, UNIT_STRETCH))
    shown: NDArray[Any] | None = None
    if right is not None:
        shown = key_line(right) if one.asked.kind == "curve" else np.atleast_1d(np.asarray(right.value))
    read = one.read
    photo = student.pages.get(one.page)
    # What was read, not what was made of it: that is among the corrections.
    points = one.points if one.status != "corrected" or read is None else read.points
    return {
        "name": one.asked.name,
        "text": _answer_text(exercise, one, answer_key),
        "mark": one.asked.mark_form,
        "closed": read is not None and read.closed,
        "points": None if points is None else pairs(points),
        "right": None if shown is None else pairs(shown[_shown_indices(shown.size)]),
        "digest": photo.digest if photo is not None else "",
        "counts": one.status in COUNTED_STATES,
        "why": exercise.tell(one.why),
        "remedy": exercise.tell(one.remedy),
        "share": None if read is None else read.share,
        "confidence": None if read is None else read.confidence,
        "wanted": int(shown.size) if shown is not None and one.asked.kind == "points" else 0,
    }


def _answer_text(exercise: Exercise, one: SettledAnswer, answer_key: AnswerKey | None) -> str:
    return sentence(one.asked.text, answer_key.parameters if answer_key is not None else {}, exercise.tell)


def _views(number: int, photo: ReadPhoto, student: SettledStudent, kept: KeptPhotographs) -> list[dict[str, Any]]:
    """The views of a page in which answers are drawn."""
    places: dict[str, list[str]] = {}
    for one in student.answers:
        if one.page == number and one.read is not None:
            places.setdefault(one.read.place, []).append(one.asked.name)
    found: list[dict[str, Any]] = []
    for place, names in places.items():
        data = kept.picture(photo, place)
        if data is None:
            continue
        frame, image = _frame(photo.pictures[place].box)
        found.append(
            {
                "place": place,
                "page": number,
                "photo": photo.name,
                "tags": photo.tags,
                "expected": photo.expected,
                "residual": photo.residual,
                "picture": _address(data),
                "frame": frame,
                "image": image,
                "answers": names,
            }
        )
    return found


def _frame(box: Edges) -> tuple[str, Any]:
    """What an SVG shows, y down, and the attributes of the picture that fills it."""
    from markupsafe import Markup

    left, bottom, right, top = box
    width, height = right - left, top - bottom
    image = f'x="{left:.3f}" y="{-top:.3f}" width="{width:.3f}" height="{height:.3f}"'
    return f"{left:.3f} {-top:.3f} {width:.3f} {height:.3f}", Markup(image)


def _bars(photo: ReadPhoto, kept: KeptPhotographs) -> list[tuple[str, float, str | None]]:
    found: list[tuple[str, float, str | None]] = []
    for name, length in zip(BARS, photo.bars, strict=True):
        data = kept.picture(photo, name)
        found.append((name, round(length, 3), None if data is None else _address(data)))
    return found


def _shown_indices(count: int) -> NDArray[np.intp]:
    return np.unique(np.linspace(0, count - 1, min(count, MAX_CURVE_POINTS)).astype(np.intp))


def _address(data: bytes) -> str:
    return "data:image/jpeg;base64," + base64.b64encode(data).decode("ascii")


def _safe(text: str) -> Any:
    """JSON that stands in a page, whatever a student is called: no text of it ends the element."""
    from markupsafe import Markup

    return Markup(text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026"))


def _page_file(name: str) -> Any:
    from markupsafe import Markup

    return Markup(resources.files("graphcam").joinpath("data", "grading", name).read_text(encoding="utf-8"))
