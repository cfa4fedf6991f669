"""What is written of one student: what was read, what counts, the pictures with both drawn over, and the report."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from graphcam.exercises.course.photo_reports import REPORT_FILE
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import Exercise, Given
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.photographs.counted_answers import UNIT_STRETCH, SettledAnswer, SettledStudent
from graphcam.exercises.photographs.photograph_store import KeptPhotographs
from graphcam.exercises.photographs.read_photo import ReadPhoto, pairs
from graphcam.exercises.reading.submission_files import TOML
from graphcam.files import digest, whole_folder
from graphcam.photo.printed_page import Points
from graphcam.words import Words, say

READINGS_FILE = "readings.toml"
"""What was read, without the teacher's corrections."""
FORMER_FILE_PATTERN = re.compile(r"(?:answers|readings)\.toml|report\.json|(?:overlay|traced)-\d+\.jpg")
"""Files of a run before, which go when there are new ones."""
NUMBER_DECIMALS = 6
"""Decimals of a number: more than any drawing shows."""


def write_student(
    folder: Path, exercise: Exercise, student: SettledStudent, answer_key: AnswerKey | None, kept: KeptPhotographs
) -> None:
    """Write a student's folder in the folder of the readings; all of it or nothing.

    Raises
    ------
    OutputError : it cannot be written
    """
    place = folder / folder_name(student.student)
    files = [path for path in place.iterdir() if path.is_file()] if place.is_dir() else []
    former = {path.name: digest(path) for path in files if FORMER_FILE_PATTERN.fullmatch(path.name)}
    with whole_folder(place, former) as draft:
        listed: list[dict[str, str]] = []
        for page, photo in student.pages.items():
            pictures = _overlays(student, page, photo, answer_key, kept)
            if pictures is not None:
                names = {"right": f"overlay-{page}.jpg", "own": f"traced-{page}.jpg"}
                for name, data in zip(names.values(), pictures, strict=True):
                    (draft / name).write_bytes(data)
                listed.append(names)
        (draft / READINGS_FILE).write_text(
            answer_lines(exercise, student.read_values()), encoding="utf-8", newline="\n"
        )
        (draft / TOML).write_text(answer_lines(exercise, student.values()), encoding="utf-8", newline="\n")
        report = json.dumps(student_report(exercise, student) | {"overlays": listed}, indent=1, allow_nan=False)
        (draft / REPORT_FILE).write_text(report + "\n", encoding="utf-8", newline="\n")


def answer_lines(exercise: Exercise, values: Mapping[str, Given]) -> str:
    """Values as ``answers.toml`` has them; what there is none of stays missing.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> print(answer_lines(find_exercise("inversion-translating"), {"pitch": np.array([1 + 2j])}))
    # Profile by inversion, translating follower
    pitch = [[1.0, 2.0]]
    <BLANKLINE>
    """
    lines = [f"# {exercise.title}"]
    for asked in exercise.answers:
        if (value := values.get(asked.name)) is not None:
            said = pairs(value) if isinstance(value, np.ndarray) else round(value, NUMBER_DECIMALS)
            lines.append(f"{asked.name} = {json.dumps(said)}")
    return "\n".join(lines) + "\n"


def _overlays(
    student: SettledStudent, page: int, photo: ReadPhoto, answer_key: AnswerKey | None, kept: KeptPhotographs
) -> tuple[bytes, bytes] | None:
    """Pictures of the first view of a page in which is drawn, with what is right and without; None if there is none."""
    from graphcam.exercises.photographs.overlays import OverlaidDrawing, overlay

    drawn = [one for one in student.answers if one.page == page and one.read is not None and one.points is not None]
    if not drawn or drawn[0].read is None:
        return None
    place = drawn[0].read.place
    picture = kept.picture(photo, place)
    if picture is None:
        return None
    stretch = student.stretches.get(page, UNIT_STRETCH)
    box = photo.pictures[place].box
    layers: tuple[list[OverlaidDrawing], list[OverlaidDrawing]] = ([], [])
    for one in drawn:
        if one.read is not None and one.read.place == place and one.points is not None:
            right = right_in_photo(one, answer_key, stretch)
            layers[0].append(OverlaidDrawing(one.asked.kind, one.points, one.read.closed, right))
            # A student sees what is marked, not what a scribble was taken for.
            if one.given is not None:
                layers[1].append(OverlaidDrawing(one.asked.kind, one.points, one.read.closed))
    return overlay(picture, box, layers[0]), overlay(picture, box, layers[1])


def right_in_photo(one: SettledAnswer, answer_key: AnswerKey | None, stretch: tuple[float, float]) -> Expected | None:
    """What is right, where it would lie in the photograph of paper that is so much longer."""
    if answer_key is None or one.asked.kind == "number":
        return None
    right = answer_key.keys[one.asked.name].expected
    value = np.atleast_1d(np.asarray(right.value, dtype=np.complex128))
    moved: Points = value.real / stretch[0] + 1j * value.imag / stretch[1]
    return Expected(moved, right.scatter, right.bulge)


def student_report(exercise: Exercise, student: SettledStudent) -> dict[str, Any]:
    """What became of a student's photographs and of every answer, as JSON takes it, in the course's language."""
    tell = exercise.tell
    photos = [*student.pages.values(), *student.others]
    return {
        "student": student.student,
        "exercise": exercise.name,
        "to_be_looked_at": student.open,
        "reviewed": student.corrections.reviewed,
        "notes": [tell(note) for note in grading_notes(student)],
        "photographs": [photo_data(photo, counts=photo is student.pages.get(photo.page)) for photo in photos],
        "answers": [_answer_data(one, exercise) for one in student.answers],
        "stretch": {str(page): list(parts) for page, parts in student.stretches.items()},
    }


def photo_data(photo: ReadPhoto, *, counts: bool) -> dict[str, Any]:
    """A photograph as the report has it."""
    return {
        "photograph": photo.name,
        "digest": photo.digest,
        "page": photo.page,
        "counts": counts,
        "marks_found": photo.tags,
        "marks_printed": photo.expected,
        "residual_px": round(photo.residual, 3),
        "paper": photo.kind,
        "refused": photo.why,
        "remedy": photo.remedy,
    }


def _answer_data(one: SettledAnswer, exercise: Exercise) -> dict[str, Any]:
    said: dict[str, Any] = {"answer": one.asked.name, "status": one.status, "page": one.page}
    said |= {"why": exercise.tell(one.why), "remedy": exercise.tell(one.remedy)}
    if one.read is not None:
        said |= {"share_seen": round(one.read.share, 4), "confidence": round(one.read.confidence, 4)}
        said["measures"] = dict(one.read.measures)
    return said


def grading_notes(student: SettledStudent) -> list[Words]:
    """What must be said beside the marks: what is not marked, and why."""
    found: list[Words] = [
        say("{answer} is not marked: {why}; {remedy}", answer=one.asked.name, why=one.why, remedy=one.remedy)
        for one in student.answers
        if one.status in ("refused", "not seen")
    ]
    missing = [one.asked.name for one in student.answers if one.status == "not typed"]
    if missing:
        found.append(say("not yet typed in from the answer table: {names}", names=", ".join(missing)))
    refused = [photo for photo in student.others if photo.why]
    found += [
        say("the photograph {name} is rejected: {why}; {remedy}", name=one.name, why=one.why, remedy=one.remedy)
        for one in refused
        if one.page not in student.pages
    ]
    return [*found, *student.notes]
