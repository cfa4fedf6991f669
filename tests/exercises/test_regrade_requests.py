"""Questions about marks: the teacher sees each with what it is about, and answers by marks given by hand."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path
from urllib.parse import unquote

import pytest
from issued_variants import answer_lines, course_of, issued, key
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import TEACHER
from graphcam.exercises.course.regrade_requests import REQUESTS, RegradeRequest
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.overrides import OVERRIDES
from graphcam.exercises.reports.answered_requests import answered
from graphcam.exercises.reports.group_page import group_page

NAME = "acceleration-and-scales"
EXERCISE = issued(NAME)[0]
FIRST, SECOND = EXERCISE.answers[:2]
HEAD = "student,answer,question\n"
STRANGE = "a/b 100%"
"""An id whose page has a name that a link must quote."""


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """The first answer of Anna is wrong; the other student has nothing; Clara did not hand in."""
    values = {**key(issued(NAME, "Anna")[1]), FIRST.name: 12345.5}
    return course_of(tmp_path, NAME, {"Anna": answer_lines(values), STRANGE: "", "Clara": None})


def page(course: Path, questions: str, **more: object) -> str:
    """The page of the group, after these questions."""
    (course / TEACHER / REQUESTS).write_text(questions, encoding="utf-8")
    out = course / "out" / "grades.csv"
    grade_course(Course(course, course / "secret", out, feedback=course / "pages" / "week 5", **more))  # type: ignore[arg-type]
    return out.with_suffix(".html").read_text(encoding="utf-8")


def asked(html: str) -> list[list[str]]:
    """The cells of the table of questions."""
    table = re.search(r'<table class="requests">(.*?)</table>', html, re.DOTALL)
    rows = re.findall(r"<tr>(<td>.*?)</tr>", table[1], re.DOTALL) if table else []
    return [[unescape(re.sub("<.*?>", "", cell)) for cell in re.findall(r"<td.*?>(.*?)</td>", row)] for row in rows]


def test_a_question_stands_beside_what_it_is_about_and_the_open_ones_first(course: Path):
    (course / TEACHER / OVERRIDES).write_text(f"student,answer,marks,comment\nAnna,{FIRST.name},0.5,half of it\n")
    questions = [f"Anna,{FIRST.name},Is it not <b>near</b>?", f"anna,{SECOND.name},Why?", f"{STRANGE},total,On paper"]
    html = page(course, HEAD + "\n".join(questions))
    assert asked(html) == [
        [
            "Anna",
            SECOND.name,
            "Why?",
            f"{float(str(key(issued(NAME, 'Anna')[1])[SECOND.name])):.6g}",
            f"{SECOND.marks:g} of {SECOND.marks:g}",
            "open",
        ],
        [STRANGE, "total", "On paper", "–", f"0 of {EXERCISE.marks:g}", "open"],
        ["Anna", FIRST.name, "Is it not <b>near</b>?", "12345.5", f"0.5 of {FIRST.marks:g}", "0.5; half of it"],
    ]
    # Each link leads from the group's page to the student's.
    links = re.findall(r'<td><a href="(.*?)">', html[html.index('class="requests"') :])
    assert len(links) == 3
    for link, student in zip(links, ("Anna", STRANGE, "Anna"), strict=True):
        assert f'<p class="under">{student}</p>' in (course / "out" / unquote(link)).read_text(encoding="utf-8")
    assert "half of it" in (course / "pages" / "week 5" / "Anna.html").read_text(encoding="utf-8")


def test_without_pages_there_are_no_links_and_without_questions_nothing_is_said_of_them(course: Path):
    out = course / "out" / "grades.csv"
    (course / TEACHER / REQUESTS).write_text(f"{HEAD}Anna,total,Why?\n")
    grade_course(Course(course, course / "secret", out))
    html = out.with_suffix(".html").read_text(encoding="utf-8")
    assert asked(html)[0][:3] == ["Anna", "total", "Why?"]
    assert "href" not in html
    assert "Questions from students" not in page(course, HEAD)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (f"{HEAD}Dora,total,Why?\n", r"line 2: student is 'Dora', but must be one student who handed in"),
        (f"{HEAD}Clara,total,Why?\n", r"line 2: student is 'Clara', but must be one student who handed in"),
        (f"{HEAD}\nAnna,v,Why?\n", rf"line 3: answer is 'v', but must be one of {FIRST.name}, .*total; check the name"),
        (f"{HEAD}Anna,total, \n", r"line 2: question is ''"),
        (
            "student,answer\nAnna,total\n",
            r"the first line is 'student,answer', .* with student,answer,question",
        ),
    ],
)
def test_a_question_of_nobody_or_about_nothing_is_told_before_anything_is_graded(course: Path, text: str, message: str):
    with pytest.raises(TaskError, match=message):
        page(course, text)
    assert not (course / "out").exists()
    assert not (course / "pages").exists()


def test_the_questions_have_russian_headings():
    exercise = find_exercise(NAME, "ru")
    record: dict[str, object] = {"student": "Anna", "answers": [], "total": 1.5, "of": 4.0}
    requests = list(answered([RegradeRequest("Anna", "total", "Почему?")], [record], {}))
    table = re.search(r"<h2>Вопросы студентов.*?</table>", group_page(exercise, [], {}, requests=requests), re.DOTALL)
    assert table is not None
    assert "1,5 из 4" in table[0]
    assert english_words(re.sub("<.*?>", " ", table[0]), ["Anna"]) == set()
