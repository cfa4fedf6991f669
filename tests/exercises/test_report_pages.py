"""The pages of a graded course: complete in themselves, and a student's without the key."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from browsers import opened
from issued_variants import SECRET, issued, key
from russian import english_words

from graphcam.exercises.course.course_folder import TEACHER, AnswerKeys
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.student_page import student_page

NAME = "inversion-translating"
HOSTILE = "<img src=http://127.0.0.1/x onerror=alert(1)>"
IDS = ("Anna", "Boris", "Clara", "Dmitri", HOSTILE)


def answers(student: str, answer_key: AnswerKey) -> str:
    """By Anna a careful hand's, by Boris those of the wrong offset, by Clara a bump, by Dmitri nearly none."""
    exercise = issued(NAME)[0]
    values = dict(key(answer_key))
    rng = np.random.default_rng(len(student))
    values = {
        name: value + answer_key.keys[name].tolerance / 5 * rng.standard_normal() for name, value in values.items()
    }
    if student == "Boris":
        wrong = answer_key.hypotheses["offset-sign"]
        values = {asked.name: each.value for asked, each in zip(exercise.answers, wrong, strict=True)}
    if student == "Clara":
        bump = 4 * np.exp(-(((np.arange(values["pitch"].size) - 9) / 1.5) ** 2))
        values["pitch"] = values["pitch"] * (1 + bump / np.abs(values["pitch"]))
    if student == "Dmitri":
        values = {"s_4": values["s_4"]}
    if student == HOSTILE:
        return f'"{HOSTILE}" = 1\npitch = "{HOSTILE}"\n'
    return "".join(
        f"{name} = {[[z.real, z.imag] for z in value.tolist()] if isinstance(value, np.ndarray) else value}\n"
        for name, value in values.items()
    )


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("course")
    kept = AnswerKeys(place / TEACHER)
    kept.keep_course(exercise_path(NAME), SECRET, language="en")
    (place / "secret").write_bytes(SECRET)
    for student in IDS:
        answer_key = issued(NAME, student)[1]
        kept.keep(student, answer_key.to_json())
        folder = place / "students" / folder_name(student)
        folder.mkdir(parents=True)
        (folder / "answers.toml").write_text(answers(student, answer_key))
    grade_course(Course(place, place / "secret", place / "grades.csv", feedback=place / "pages"))
    return place


def page_of(place: Path, student: str) -> Path:
    return place / "pages" / f"{folder_name(student)}.html"


@pytest.mark.slow
def test_the_pages_need_nothing_from_elsewhere_and_run_nothing(pages: Path):
    for path in (pages / "grades.html", *(page_of(pages, student) for student in ("Boris", HOSTILE))):
        with opened(path) as (page, wrong):
            assert page.title()
            assert page.evaluate("document.images.length") == 0
            # Nothing sticks out of the page.
            assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
        assert wrong == []


def numbers_of(html: str) -> set[float]:
    text = re.sub(r"<style>.*?</style>", "", html, flags=re.DOTALL)
    return {float(number) for number in re.findall(r"-?\d+\.\d+", text)}


def disclosed(html: str, answer_key: AnswerKey) -> list[str]:
    """Answers whose keys stand on a page, to three decimals, or of points most of them to two."""
    shown = numbers_of(html)
    found: list[str] = []
    for name, value in key(answer_key).items():
        if isinstance(value, np.ndarray):
            near = [any(abs(x - part) < 0.006 for x in shown) for z in value for part in (z.real, -z.imag)]
            if np.mean(near) > 0.5:
                found.append(name)
        elif any(abs(x - float(value)) < 1e-3 * max(1.0, abs(float(value))) / 10 for x in shown):
            found.append(name)
    return found


def test_a_students_page_does_not_hold_the_key(pages: Path):
    for student in IDS[1:]:
        answer_key = issued(NAME, student)[1]
        html = page_of(pages, student).read_text()
        own = {name for name in key(answer_key) if f"{name} = " in answers(student, answer_key)}
        # What the student gave right stands there as the student's own.
        given_right = {
            answer["name"] for record in json.loads((pages / "grades.json").read_text()) if record["student"] == student
            for answer in record["answers"] if answer["outcome"] == "right"
        }  # fmt: skip
        assert set(disclosed(html, answer_key)) <= given_right & own, student


def test_the_teachers_page_shows_the_key_so_the_check_above_would_find_it(pages: Path):
    assert "pitch" in disclosed((pages / "grades.html").read_text(), issued(NAME, "Boris")[1])


def test_the_report_tells_what_to_teach_again(pages: Path):
    text = (pages / "grades.html").read_text()
    from graphcam.exercises.definition.mistakes import misconception

    assert str(misconception("offset-sign").said) in text
    assert "<img" not in text
    assert "<img" not in page_of(pages, HOSTILE).read_text()


def test_the_pages_of_a_russian_course_are_russian(pages: Path):
    kept = AnswerKeys(pages / TEACHER)
    exercise = find_exercise(NAME, "ru")
    records = json.loads((pages / "grades.json").read_text())
    answer_keys = {student: AnswerKey.from_json(kept.find(student)) for student in IDS}
    # The sentences of a record were said when it was marked; here the pages' own words are looked at.
    records = [record | {"feedback": [], "notes": []} for record in records if record["student"] != HOSTILE]
    html = [group_page(exercise, records, answer_keys)]
    html += [student_page(exercise, record, answer_keys[record["student"]]) for record in records]
    for page in html:
        text = re.sub(r"<style>.*?</style>|<[^>]*>", " ", page, flags=re.DOTALL)
        assert english_words(text, (*IDS, *(asked.name for asked in exercise.answers))) == set()
        assert not re.search(r"\d\.\d", text)


def test_a_bump_is_circled_where_it_is(pages: Path):
    """4 mm too far out at the tenth point, and the page says the tenth."""
    record = next(one for one in json.loads((pages / "grades.json").read_text()) if one["student"] == "Clara")
    pitch = next(answer for answer in record["answers"] if answer["name"] == "pitch")
    assert pitch["station"] == 9
    assert pitch["off_paper"] == pytest.approx(4.0, abs=0.5)
    html = page_of(pages, "Clara").read_text()
    assert "most of all at point 10" in html
    spot = re.search(r'class="spot" cx="(-?[\d.]+)" cy="(-?[\d.]+)"', html)
    assert spot is not None
    place = key(issued(NAME, "Clara")[1])["pitch"][9]
    assert abs(complex(float(spot[1]), -float(spot[2])) - place) == pytest.approx(4.0, abs=0.6)
