"""Exercise files: every exercise that comes with graphcam stands, and a wrong file gets one message."""

from __future__ import annotations

import re

import pytest
from over_all import over_all
from russian import english_words
from translations import CATALOGS, MOST_MISSING, lacking_of_exercises, texts_of

from graphcam.errors import DesignError, TaskError
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise, library, load_exercise
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.language import languages
from graphcam.tasks.task_file import builtin_text

KNOWN = ", ".join(languages())
TITLE = (
    'title.en = "Graphical integration"\ntitle.ru = "Графическое интегрирование"\n'
    'title.vi = "Tích phân đồ thị"\ntitle.zh = "图解积分"'
)
TOPICS = {
    "acceleration-and-scales", "integration", "differentiation", "pressure-angle", "least-radius",
    "least-radius-offset", "inversion-translating", "inversion-arm", "curvature-and-roller", "given-cam",
    "given-cam-positions", "whole-cam",
}  # fmt: skip

PLACE = re.compile(r"\{[a-z_0-9]+\}")


def test_there_is_an_exercise_for_every_construction():
    assert set(library()) >= TOPICS
    for name in library():
        exercise = find_exercise(name)
        assert exercise.name == name
        assert len(exercise.misconceptions) >= 3
        for parameter in exercise.parameters.values():
            assert parameter.values


@pytest.mark.parametrize("name", sorted(TOPICS))
def test_the_text_names_every_parameter_of_the_task(name):
    exercise = find_exercise(name)
    unsaid = {parameter for parameter in exercise.parameters if f"{{{parameter}}}" not in exercise.text}
    assert unsaid == set()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (TITLE, "", "title is missing"),
        (TITLE, "title = 3", "title is 3, but must be text in quotes"),
        (TITLE, "title.en = 3", "title is 3, but must be text in quotes"),
        ("title.en", "title.eng", f"title is 'eng', but must be a language, one of {KNOWN}; did you mean 'en'"),
        ('text.ru = "Наибольший', 'text.rus = "Наибольший', r"answers\[7\].text is 'rus'"),
        (TITLE, f'{TITLE}\nlanguage = "ru"', "language is an unknown key"),
        ('reading = "max_v"', 'reading = "vmax"', "reading is 'vmax', but must be one of"),
        ('construction = "integration"', 'construction = "integral"', "construction is 'integral'"),
        ('station = "2"', 'station = "9"', r"station is '9', but must be up to 8"),
        ('station = "2"', "station = \"2''\"", "moving phases"),
        ('"end-ordinate"', '"end-ordinat"', "did you mean 'end-ordinate'"),
        ('"wrong-law: rectangular"', '"wrong-law: rectangula"', "did you mean 'rectangular'"),
        ('"wrong-law: rectangular"', '"wrong-law"', "followed by a colon"),
        ("lift = { start = 12, stop = 50, step = 0.5 }", "lift = { start = 12, stop = 50 }", "start, stop and step"),
        (
            "lift = { start = 12, stop = 50, step = 0.5 }",
            "lift = { start = 12, stop = 4, step = 0.5 }",
            "at least start",
        ),
        ('lift = "{lift}"', 'lift = "{lft}"', "did you mean 'lift'"),
        (
            "{lift} mm",
            "{lft} mm",
            r"text is '\{lft\}', but must be the name of a parameter in braces; did you mean 'lift'",
        ),
        ("{lift} mm", "{ lift } mm", r"text is '\{ lift \}', but must be"),
        ("{lift} mm", "30 mm", r"text is without \{lift\}, but must be one that tells .*; write \{lift\} where"),
        ('name = "mu_v"', 'name = "mu v"', r"answers\[\d\].name is 'mu v', but must be a name of Latin letters"),
        ('"cosine", ', '"cosine", "sawtooth", ', r"parameters\.law_up\.choices\[\d\] is 'sawtooth', but must be"),
        ("decimals = 1", "decimal = 1", "unknown key"),
        ("marks = 2", "marks = 0", "marks is 0"),
        ('law = "{law_up}"', 'law = "sawtooth"', "law of phase 1 is 'sawtooth'"),
        ("[sheet]", "[sheet", r"line \d+: the table is \[sheet, but must be closed by"),
    ],
)
def test_a_wrong_file_gets_one_message(tmp_path, old, new, message):
    from graphcam.exercises.definition.exercise_file import _folder

    text = (_folder() / "integration.toml").read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(TaskError, match=message) as caught:
        load_exercise(path)
    assert "\n" not in str(caught.value)
    assert str(caught.value).startswith(str(path))


@pytest.mark.parametrize(
    ("name", "station", "message"),
    [
        ("given-cam", '"6"', "station is '24', but must be from 0 to 23"),
        ("differentiation", '"4"', "station is '25', but must be from 1 to 24"),
    ],
)
def test_a_place_beyond_the_turn_is_told(tmp_path, name, station, message):
    """Positions of a given cam are numbered from 0, chords from 1."""
    text, beyond = exercise_path(name).read_text(encoding="utf-8"), message.split("'")[1]
    (tmp_path / "mine.toml").write_text(
        text.replace(f"station = {station}", f'station = "{beyond}"', 1), encoding="utf-8"
    )
    with pytest.raises(TaskError, match=message):
        load_exercise(tmp_path / "mine.toml")


@pytest.mark.slow
@over_all("language", CATALOGS)
@over_all("name", library())
def test_what_is_translated_of_an_exercise_of_the_library_has_the_same_places(name, language):
    english, told = texts_of(name, "en"), texts_of(name, language)
    told = {key: text for key, text in told.items() if text != english[key]}
    for key, text in told.items():
        assert sorted(PLACE.findall(text)) == sorted(PLACE.findall(english[key])), key
    if language == "ru":
        assert {word for text in told.values() for word in english_words(PLACE.sub("", text))} <= {"min"}


@pytest.mark.slow
@pytest.mark.parametrize("language", CATALOGS)
def test_the_library_is_nearly_all_translated(language):
    every = sum(len(texts_of(name, language)) for name in library())
    missing = lacking_of_exercises(language)
    assert len(missing) <= MOST_MISSING * every, missing


def test_a_text_without_a_language_is_said_in_every_one(tmp_path):
    path = tmp_path / "mine.toml"
    text = (exercise_path("integration")).read_text(encoding="utf-8")
    assert TITLE in text
    path.write_text(text.replace(TITLE, 'title = "Übung"'), encoding="utf-8")
    for language in languages():
        assert load_exercise(path, language).title == "Übung"
    with pytest.raises(DesignError, match="language is 'xx'"):
        load_exercise(path, "xx")
    # What nobody has translated stays English.
    path.write_text(text.replace(TITLE, TITLE.splitlines()[0]), encoding="utf-8")
    assert load_exercise(path, "ru").title == "Graphical integration"


def test_an_unknown_exercise_gets_a_suggestion():
    with pytest.raises(TaskError, match="did you mean 'whole-cam'"):
        find_exercise("hole-cam")
    with pytest.raises(TaskError, match=r"there is no file nowhere/mine.toml; check the name; "):
        find_exercise("nowhere/mine.toml")


def test_every_mistake_speaks_without_numbers():
    arguments = {"wrong-law": ": cosine", "scale-forgotten": ": integration.v"}
    for name, entry in CATALOGUE.items():
        full = name + (arguments.get(name, ": integration") if entry.takes else "")
        said = str(misconception(full).said)
        assert said.endswith(".")
        assert not any(character.isdecimal() for character in said.replace("90°", ""))


def test_a_task_file_is_told_from_an_exercise(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(builtin_text("coursework"), encoding="utf-8")
    with pytest.raises(TaskError, match=r"the file is a task, but must be an exercise, .* \[task\]"):
        load_exercise(path)
