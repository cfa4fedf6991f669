"""A student's variant in the studio: a link with the task, what is asked, and what is given, without the key.

The page draws the diagrams that are given, up to the last construction before the first that is asked.  If the lecturer
wants it to say "right" and "wrong", the link holds salted hashes of the answers, see
:mod:`graphcam.studio.exercise_checks`: they hide a key from a look, not from a program.  Four digits are guessed in
seconds, and where the engine runs in the page it can solve the task itself.  Without hashes the page only asks.  Marks
count from ``graphcam exercise grade`` alone, with or without them.
"""

import base64
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from graphcam.errors import DesignError, TaskError
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.definition.variant import Variant, sentence
from graphcam.exercises.exports.question_parts import mistaken
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.exercise_checks import ITERATIONS, check_of, salt_of
from graphcam.studio.task_text import built_in_tasks, nearest_built_in, plain_task
from graphcam.words import say

LINK_FILE = "studio.txt"
"""The file of the link in a student's folder."""
FIRST_CONSTRUCTION = "scheme"
"""What is given of a task whose answers begin with the first diagram, or stand beside the others."""
PRACTICE_NOTE = say("Your exercise in the studio, for practice only: marks are given for what you hand in.")


def exercise_of(variant: Variant, answer_key: AnswerKey | None = None, salt: bytes = b"") -> dict[str, Any]:
    """What the page is told of an exercise.

    answer_key : for hashes of its answers; None for a page that only asks
    """
    exercise = variant.exercise
    sentences: list[str] = []
    said: dict[str, Any] = {
        "title": exercise.title,
        "text": instructions(variant),
        "upto": given_construction(variant),
        "answers": [_answer_check(variant, asked, answer_key, salt, sentences) for asked in exercise.answers],
    }
    if answer_key is not None:
        said |= {"salt": base64.urlsafe_b64encode(salt).decode(), "iterations": ITERATIONS, "hints": sentences}
    return said


def given_construction(variant: Variant) -> str:
    """The last construction before the first that is asked.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.variant import drawn
    >>> given_construction(drawn(find_exercise("inversion-translating"), "Anna", b"secret", 0))
    'scheme'
    """
    names, asked = board_chain(variant.task).names, {each.construction for each in variant.exercise.answers}
    if not asked <= set(names):
        return FIRST_CONSTRUCTION
    return names[max(min(names.index(name) for name in asked) - 1, 0)]


def _answer_check(
    variant: Variant, asked: AskedAnswer, answer_key: AnswerKey | None, salt: bytes, sentences: list[str]
) -> dict[str, Any]:
    """One answer; the sentences of its hints are added to those there."""
    exercise, tell = variant.exercise, variant.exercise.tell
    text = sentence(asked.text, variant.parameters, tell)
    said: dict[str, Any] = {"name": asked.name, "text": text}
    if asked.kind != "number":
        return said | {"drawn": True}
    said |= {"unit": tell(asked.unit_caption), "decimals": asked.decimals}
    if answer_key is None:
        return said
    key, wrong = answer_key.keys[asked.name], list[tuple[float, int]]()
    for each in mistaken(exercise, answer_key, asked):
        told = tell(each.said)
        if told not in sentences:
            sentences.append(told)
        wrong.append((each.value, sentences.index(told)))
    return said | {"check": check_of(asked.name, float(str(key.expected.value)), key.tolerance, salt, wrong)}


def studio_address(variant: Variant, answer_key: AnswerKey | None = None, salt: bytes = b"") -> str:
    """The part of an address from ``#`` on; the hints are left out where they, and then the text, make it too long.

    Raises
    ------
    DesignError : it is too long all the same
    """
    *shorter, shortest = _ever_shorter(exercise_of(variant, answer_key, salt))
    task, tasks = variant.task, built_in_tasks()
    place = StudioPlace(plain_task(task), nearest_built_in(task), mode="exercise")
    for exercise in shorter:
        try:
            return address_of(_with_exercise(place, exercise), tasks)
        except DesignError:
            continue
    return address_of(_with_exercise(place, shortest), tasks)


def _with_exercise(place: StudioPlace, exercise: Mapping[str, Any]) -> StudioPlace:
    return replace(place, exercise=exercise)


def _ever_shorter(exercise: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """What the page is told, with less and less that it can do without."""
    yield exercise
    answers = [
        asked
        | (
            {"check": {key: value for key, value in asked["check"].items() if key != "hints"}}
            if "check" in asked
            else {}
        )
        for asked in exercise["answers"]
    ]
    unhinted = {key: value for key, value in exercise.items() if key != "hints"} | {"answers": answers}
    if "hints" in exercise:
        yield unhinted
    yield {key: value for key, value in unhinted.items() if key != "text"}


def check_url(url: str) -> None:
    """Check that a link can begin so.

    Raises
    ------
    TaskError : it is no address of a page

    >>> check_url("course.example/studio")
    Traceback (most recent call last):
    graphcam.errors.TaskError: --studio: the address is 'course.example/studio', but must be that of the studio's \
page, with https:// before it; put the page there with 'graphcam studio --site'
    """
    parts = urlsplit(url)
    if parts.scheme not in ("http", "https", "file") or parts.fragment or not (parts.netloc or parts.path):
        remedy = say("put the page there with 'graphcam studio --site'")
        what = say("the address")
        raise TaskError("--studio", what, url, say("that of the studio's page, with https:// before it"), remedy)


def write_links(folder: Path, secret_file: Path | None, url: str, *, checks: bool = False) -> int:
    """Write every student's link into the student's folder of a course that was made; how many there are.

    secret_file : of the course's secret; None for the one in the teacher's folder
    url : of the studio's page
    checks : whether the page tells right from wrong, by hashes

    Raises
    ------
    TaskError : the address is none, or the folder holds no course
    """
    check_url(url)
    students, kept = AnswerKeys.of(folder)
    secret = kept.secret(secret_file)
    exercise = kept.course_exercise()
    written = 0
    for student in kept.students():
        key = AnswerKey.from_json(kept.find(student.id))
        variant = Variant(exercise, student.id, key.draw, key.parameters)
        salt = salt_of(secret, exercise.name, student.id)
        address = studio_address(variant, key if checks else None, salt)
        text = f"{exercise.tell(PRACTICE_NOTE)}\n\n{url}{address}\n"
        (students / folder_name(student.id) / LINK_FILE).write_text(text, encoding="utf-8", newline="\n")
        written += 1
    return written
