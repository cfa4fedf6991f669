"""Checks of answers: the tolerance kept, the hash by its standard, and links that hold no key."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import zlib
from dataclasses import replace

import pytest
from hypothesis import given, strategies as st
from studio_tasks import BUILT_IN, plain_task
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.exports.studio_link import (
    check_url,
    exercise_of,
    given_construction,
    studio_address,
    write_links,
)
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.studio.address import MAX_LENGTH, place_of
from graphcam.studio.engine import answer
from graphcam.studio.exercise_checks import ITERATIONS, cell, check_of, checked, hashed, salt_of
from graphcam.studio.task_text import built_in_tasks

SALT = b"salt of a test"
FEW = 10
URL = "https://course.example/studio/"


def unpacked(address: str) -> dict:
    packed = address.partition("#1.")[2]
    return json.loads(zlib.decompress(base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4)), -15))


@pytest.fixture(scope="module")
def issued() -> tuple[Variant, AnswerKey]:
    exercise = find_exercise("least-radius-offset")
    (both,) = course_variants(exercise, ["Anna"], b"secret")
    return both


def test_the_hash_is_that_of_the_standard():
    # RFC 7914, section 11: PBKDF2-HMAC-SHA-256 (P="passwd", S="salt", c=1), first bytes.
    assert hashlib.pbkdf2_hmac("sha256", b"passwd", b"salt", 1, 4).hex() == "55ac046e"
    made = hashlib.pbkdf2_hmac("sha256", b"r0:53", SALT, FEW, 6)
    assert hashed("r0", 53, SALT, FEW) == base64.urlsafe_b64encode(made).decode()


def test_without_openssl_the_hash_is_the_same(monkeypatch):
    known = hashed("r0", 53, SALT, FEW)
    monkeypatch.delattr(hashlib, "pbkdf2_hmac")
    assert hashed("r0", 53, SALT, FEW) == known
    assert hashed("r0", 53, b"salt", 1) == "5Cs5zhFq"


@given(
    st.floats(-500, 500).map(lambda x: round(x, 4)),
    st.floats(0.01, 5),
    st.floats(-0.9999, 0.9999),
    st.floats(1.001, 100),
    st.booleans(),
)
def test_all_within_the_tolerance_has_the_cell_of_the_key_and_nothing_beyond(key, tolerance, inside, outside, below):
    check = check_of("x", key, tolerance, SALT, iterations=FEW)
    cells = check["offset"], check["width"]
    own = cell(key, *cells)
    assert cell(key + inside * tolerance, *cells) == own
    assert cell(key + (-outside if below else outside) * tolerance, *cells) != own


def test_a_check_tells_neither_the_key_nor_the_answer_of_a_mistake():
    check = check_of("r0", 43.28, 0.4, SALT, [(39.1, 0), (43.3, 1)])
    assert "43" not in json.dumps(check["offset"])
    assert check["offset"] < check["width"] == pytest.approx(0.8, rel=1e-4)
    # What a mistake answers within the tolerance is right.
    assert len(check["hints"]) == 1


def test_salts_differ_by_student_and_are_made_again():
    assert salt_of(b"secret", "whole-cam", "Anna") == salt_of(b"secret", "whole-cam", "Anna")
    assert salt_of(b"secret", "whole-cam", "Anna") != salt_of(b"secret", "whole-cam", "Bert")


def test_every_right_answer_is_right_and_a_mistake_gets_its_sentence(issued):
    variant, key = issued
    exercise = exercise_of(variant, key, SALT)
    exercise["iterations"] = ITERATIONS
    right = {name: float(each.expected.value) for name, each in key.keys.items()}
    found = answer({"ask": "exercise", "exercise": exercise, "given": right})["checked"]
    assert found == {name: {"right": True, "hint": None} for name in right}
    mistake = list(key.hypotheses).index("offset-sign")
    asked = [each.name for each in variant.exercise.answers]
    wrong = {name: each.value for name, each in zip(asked, list(key.hypotheses.values())[mistake], strict=True)}
    found = answer({"ask": "exercise", "exercise": exercise, "given": wrong})["checked"]
    off = [name for name, each in found.items() if not each["right"]]
    assert off
    assert all(found[name]["hint"] is not None for name in off)


def test_the_tolerance_is_that_of_marking(issued):
    variant, key = issued
    for asked in exercise_of(variant, key, SALT)["answers"]:
        own = key.keys[asked["name"]]
        value = float(own.expected.value)
        for far, right in ((0.999, True), (-0.999, True), (1.01, False), (-1.01, False)):
            found = checked(asked["name"], value + far * own.tolerance, asked["check"], SALT)
            assert found["right"] == right


def test_the_page_is_not_told_the_key(issued):
    variant, key = issued
    told = json.dumps(exercise_of(variant, key, SALT))
    for each in key.keys.values():
        # As a number of its own: the offset of a hash may begin with the same digits.
        assert not re.search(rf"(?<![\d.]){float(each.expected.value):.2f}(?!\d)", told)
    assert "check" not in json.dumps(exercise_of(variant))


@pytest.mark.parametrize("name", library())
def test_what_is_given_comes_before_all_that_is_asked(name):
    variant = drawn(find_exercise(name), "Anna", b"secret", 0)
    from graphcam.exercises.definition.drawn_answers import board_chain

    names = board_chain(variant.task).names
    asked = {each.construction for each in variant.exercise.answers} & set(names)
    assert all(names.index(given_construction(variant)) < names.index(each) for each in asked)


def test_a_link_shows_the_variant_and_what_is_asked(issued):
    variant, key = issued
    address = studio_address(variant, key, SALT)
    place = place_of(address, built_in_tasks())
    assert len(address) <= MAX_LENGTH
    assert place.task == variant.task.to_dict()
    assert place.mode == "exercise"
    assert place.exercise is not None
    assert [each["name"] for each in place.exercise["answers"]] == [each.name for each in variant.exercise.answers]
    views = answer({"task": dict(place.task), "upto": place.exercise["upto"], "views": []})["names"]
    assert [view["name"] for view in views] == ["scheme", "acceleration"]


def test_a_long_text_gives_way_to_the_length_of_an_address(issued):
    variant, key = issued
    # Of letters that hardly deflate.
    noise = base64.b64encode(hashlib.shake_256(b"long").digest(900)).decode()
    long = replace(variant, exercise=replace(variant.exercise, text=variant.exercise.text + noise))
    told = unpacked(studio_address(long, key, SALT))["x"]
    assert "text" not in told
    assert all("right" in each["check"] for each in told["answers"])


@pytest.mark.slow
def test_links_stand_in_the_students_folders(tmp_path):
    (tmp_path / "roster.csv").write_text("id\ns-1\ns-2\n", encoding="utf-8")
    (tmp_path / "secret").write_text("a long random text", encoding="utf-8")
    out = tmp_path / "week-5"
    arguments = ["exercise", "make", "pressure-angle", "--out", str(out), "--studio", URL, "--studio-checks"]
    arguments += ["--roster", str(tmp_path / "roster.csv"), "--secret-file", str(tmp_path / "secret")]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    kept = AnswerKeys(out / "teacher")
    for student in ("s-1", "s-2"):
        text = (out / "students" / student / "studio.txt").read_text(encoding="utf-8")
        told, key = unpacked(text.split()[-1])["x"], AnswerKey.from_json(kept.find(student))
        assert text.split()[-1].startswith(URL + "#1.")
        salt = base64.urlsafe_b64decode(told["salt"])
        asked = told["answers"][0]
        assert checked(asked["name"], key.keys[asked["name"]].expected.value, asked["check"], salt)["right"]
    # Again without checks: then nothing of the key is in them.
    assert write_links(out, tmp_path / "secret", URL) == 2
    (*_, link) = (out / "students" / "s-1" / "studio.txt").read_text(encoding="utf-8").split()
    assert "salt" not in unpacked(link)["x"]


def test_a_wrong_address_is_told_before_anything_is_made(tmp_path):
    (tmp_path / "roster.csv").write_text("id\ns-1\n", encoding="utf-8")
    (tmp_path / "secret").write_text("a long random text", encoding="utf-8")
    arguments = ["exercise", "make", "pressure-angle", "--out", str(tmp_path / "out"), "--studio", "studio"]
    arguments += ["--roster", str(tmp_path / "roster.csv"), "--secret-file", str(tmp_path / "secret")]
    assert CliRunner().invoke(app, arguments).exit_code == 2
    assert not (tmp_path / "out").exists()
    with pytest.raises(TaskError, match="--studio"):
        check_url("https://course.example/#1.x")


@pytest.mark.parametrize(
    "request_",
    [
        {},
        {"exercise": [], "given": {}},
        {"exercise": {"answers": [], "salt": "AA==", "iterations": 0}, "given": {}},
        {"exercise": {"answers": [], "salt": "AA==", "iterations": 10**9}, "given": {}},
        {
            "exercise": {"answers": [{"name": "a", "check": {"offset": 0, "width": 0, "right": ""}}], "salt": "AA=="},
            "given": {"a": 1},
        },
        {"exercise": {"answers": [{"name": "a", "check": {}}], "salt": "AA=="}, "given": {"a": "x"}},
        {"exercise": {"answers": [{"name": "a", "check": {}}]}, "given": {"a": 1}},
    ],
)
def test_senseless_checks_are_refused(request_):
    found = answer({"ask": "exercise", **request_})
    assert not found["ok"]
    assert found["error"]["field"].startswith("exercise")


@pytest.mark.parametrize("name", [*BUILT_IN])
def test_an_exercise_to_try_gives_no_construction_in_which_an_answer_is_read(name):
    task = plain_task(name)
    made = answer({"ask": "sample_exercise", "task": task})["exercise"]
    shown = answer({"task": task, "upto": made["upto"], "values": True})["values"]
    asked = {each["name"] for each in made["answers"]}
    assert len(asked) >= 2
    assert not asked & {each["id"] for each in shown}
    exact = {each["id"]: each["exact"] for each in answer({"task": task, "values": True})["values"]}
    typed = {each["name"]: round(exact[each["name"]], each["decimals"]) for each in made["answers"]}
    checked = answer({"ask": "exercise", "exercise": made, "given": typed})["checked"]
    assert all(checked[each]["right"] for each in asked)
    wrong = answer({"ask": "exercise", "exercise": made, "given": {each: 1.03 * exact[each] for each in asked}})
    assert not any(wrong["checked"][each]["right"] for each in asked)
