"""Whose page a photograph shows: the code says so or nobody does."""

from __future__ import annotations

import pytest

from graphcam.exercises.course.course_folder import PRINTED_FOLDER, TEACHER_FOLDER
from graphcam.exercises.course.sheet_code import SheetCode
from graphcam.exercises.photographs.page_owner import PrintedSheets
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import PrintedPage

pytestmark = pytest.mark.slow

SECRET = b"the secret of scanned sheets"


@pytest.fixture
def sheets(course) -> PrintedSheets:
    exercise = course.exercise
    return PrintedSheets(course.place / TEACHER_FOLDER, exercise.name, exercise.version, ("Anna", "Boris"), SECRET)


def printed(course, student: str, page: int) -> PrintedPage:
    path = course.place / TEACHER_FOLDER / PRINTED_FOLDER / f"{student}-{page}.json"
    return PrintedPage.from_json(path.read_text())


def test_the_code_on_the_sheet_says_whose_it_is(course, sheets):
    for student, page in (("Anna", 1), ("Anna", 2), ("Boris", 2)):
        text = printed(course, student, page).code
        code, found = sheets.page(["https://elsewhere.example", text, text], tags=True)
        assert (code.student, code.page) == (student, page)
        assert found.code == text


def code(course, **changes: object) -> SheetCode:
    draw = course.key("Anna").draw
    said = {"exercise": course.exercise.name, "version": course.exercise.version, "student": "Anna", "draw": draw}
    return SheetCode(**{**said, "page": 2, **changes})


@pytest.mark.parametrize(("tags", "why"), [(True, "the QR code cannot be seen"), (False, "it shows no worksheet")])
def test_without_a_code_nobodys_page_is_guessed(sheets, tags, why):
    with pytest.raises(PhotographError, match=why):
        sheets.page([], tags=tags)


@pytest.mark.parametrize(
    ("changes", "secret", "why"),
    [
        ({}, b"another", "signed with another secret"),
        ({"exercise": "whole-cam"}, SECRET, "of 'whole-cam'"),
        ({"student": "Zoe"}, SECRET, "of 'Zoe'"),
        ({"version": 1}, SECRET, "it belongs to version 1 of the exercise"),
        ({"draw": 999}, SECRET, "differs from the printed sheets of this course"),
        ({"page": 9}, SECRET, "differs from the printed sheets of this course"),
    ],
)
def test_a_code_of_another_sheet_is_refused_with_its_own_reason(course, sheets, changes, secret, why):
    with pytest.raises(PhotographError, match=why):
        sheets.page([code(course, **changes).text(secret)], tags=True)


@pytest.mark.parametrize("text", ["https://elsewhere.example", "GC1/a", "", "GC1/" + "x/" * 5000])
def test_any_other_code_is_none_of_ours(sheets, text):
    with pytest.raises(PhotographError, match="none of graphcam's"):
        sheets.page([text], tags=True)


def test_two_sheets_in_one_picture_are_told_apart_by_nobody(course, sheets):
    texts = [printed(course, student, 2).code for student in ("Anna", "Boris")]
    with pytest.raises(PhotographError, match="it shows 2 sheets"):
        sheets.page(texts, tags=True)


def test_a_page_that_is_kept_no_more_is_refused(course, sheets):
    text = printed(course, "Anna", 2).code
    (course.place / TEACHER_FOLDER / PRINTED_FOLDER / "Anna-2.json").write_text("{")
    with pytest.raises(PhotographError, match="make the course again"):
        sheets.page([text], tags=True)
