"""The command line in another language: messages told by their captions, and which language it is."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from russian import english_words
from typer.testing import CliRunner

import graphcam
from graphcam.cli import app
from graphcam.cli.command_language import Voice, language_of_machine
from graphcam.errors import DesignError, GraphcamError, MissingFileError, TaskError, suggestion
from graphcam.files import OutputError
from graphcam.language import ENGLISH, Language, language, languages, read_catalog
from graphcam.words import bare_caption, or_list, say

pytestmark = pytest.mark.slow

PACKAGE = Path(graphcam.__file__).parent
RUSSIAN = language("ru")


def russian(*words: str, folder: Path | None = None, **variables: str) -> subprocess.CompletedProcess[str]:
    """What the command line does on a Russian machine."""
    environment = {**os.environ, "LANGUAGE": "ru", "PYTHONPATH": str(PACKAGE.parent), "COLUMNS": "200", **variables}
    command = [sys.executable, "-m", "graphcam", *words]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False)


@pytest.mark.parametrize(
    ("variables", "name"),
    [
        ({}, "en"),
        ({"LANG": "C.UTF-8"}, "en"),
        ({"LANG": "ru_RU.UTF-8"}, "ru"),
        ({"LANG": "ru"}, "ru"),
        ({"LANG": "ru_RU@euro", "LC_MESSAGES": ""}, "ru"),
        ({"LANG": "ru_RU.UTF-8", "LC_ALL": "C"}, "en"),
        ({"LANG": "en_US.UTF-8", "LC_MESSAGES": "ru_RU.UTF-8"}, "ru"),
        ({"LANG": "en_US.UTF-8", "LANGUAGE": "xx:ru"}, "ru"),
        ({"LANG": "ru_RU.UTF-8", "LANGUAGE": "xx"}, "en"),
    ],
)
def test_the_machine_names_its_language_as_for_gettext(variables, name):
    assert language_of_machine(variables).name == name


def test_what_is_asked_for_counts_before_the_task_and_the_task_before_the_machine():
    voice = Voice(language=RUSSIAN)
    voice.adopt_language("en")
    assert voice.language == RUSSIAN
    voice.choose("en")
    voice.adopt_language("ru")
    assert voice.language == ENGLISH
    voice = Voice(language=ENGLISH)
    voice.choose(None)
    voice.choose("xx")
    voice.adopt_language("ru")
    assert voice.language == RUSSIAN


def told(error: GraphcamError, spoken: Language = RUSSIAN) -> str:
    return spoken.text(error.caption)


def test_a_message_is_told_with_what_stands_in_it():
    limit = say("greater than {least:g} {unit}", least=0, unit=say("mm"))
    error = TaskError("cam.toml", "motion.phases[0].lift", 0, limit, suggestion("lfit", ["lift"]))
    assert told(error, ENGLISH) == str(error)
    assert told(error).startswith("cam.toml: motion.phases[0].lift: 0, а должно быть: ")
    assert told(error).endswith("; может быть, 'lift'?")


def test_the_names_of_fields_and_what_a_user_wrote_stay():
    # "rotation" is a caption as well.
    error = DesignError("rotation", "rise", or_list(["'ccw'", "'cw'"]))
    assert told(error) == "rotation: 'rise', а должно быть: 'ccw' или 'cw'"


def test_a_message_that_stands_in_no_catalog_stays_english():
    assert told(OutputError("out", say("a brand-new text"))) == (
        "не удаётся записать 'out' (a brand-new text); выберите другое место"
    )


@pytest.mark.parametrize("spoken", languages())
def test_numbers_of_a_message_are_told_as_they_are_typed(spoken):
    error = DesignError("offset", -0.5, say("at least {length:g} mm", length=-0.25))
    assert "-0.5" in told(error, language(spoken))
    assert "-0.25" in told(error, language(spoken))
    assert "−0,25" in RUSSIAN.text(say("{length:g} mm", length=-0.25))


def test_half_a_message_is_told_by_no_language():
    """What a catalog has of captions stands in messages too; without their sentence they are told in English."""
    half = Language("xx", read_catalog('msgid "prime radius"\nmsgstr "r0"\n'))
    error = DesignError(say("prime radius"), 0, say("greater than 0 mm"))
    assert told(error, half) == str(error)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (say("missing"), "отсутствует"),
        (say("left out"), "не указано"),
        (say("not installed"), "не установлено"),
        (say("{degrees:g} degrees", degrees=30), "30 градусов"),
        (say("not readable ({why})", why="Permission denied"), "не читается (Permission denied)"),
        (bare_caption("[a, b]"), "[a, b]"),
    ],
)
def test_what_is_said_of_a_value_is_told_too(words, said):
    assert told(DesignError("lift", words, say("a number"))) == f"lift: {said}, а должно быть: число"
    # What somebody wrote is not.
    assert told(DesignError("lift", str(words), say("a number"))) == f"lift: '{words}', а должно быть: число"


def test_a_missing_file_is_told_with_its_place():
    error = MissingFileError("motion.csv", say("check motion.table"), where=say("beside {path}", path="cam.toml"))
    assert told(error) == "отсутствует файл motion.csv рядом с cam.toml; проверьте motion.table"
    error = MissingFileError("week 5", kind=say("folder"))
    assert told(error) == "отсутствует папка week 5; проверьте имя"


def test_what_is_found_in_a_line_of_a_file_is_told_piece_by_piece(tmp_path, monkeypatch):
    (tmp_path / "cam.toml").write_text(
        'rotation = "cw"\n'
        'follower = { kind = "translating", offset = −10, roller_radius = 10 }\n'
        'motion.phases = [{ kind = "rise", angle = 180, lift = 20, law = "cosine" },\n'
        '  { kind = "return", angle = 180, lift = 20, law = "cosine" }]\n',
        encoding="utf-8",
    )
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["solve", "cam.toml"], env={"LANGUAGE": "ru"})
    place = "cam.toml: строка 2, столбец 45: знак"
    wanted = "а должно быть: обычный '-'; наберите его в текстовом редакторе"
    assert done.stderr == f"graphcam: {place}: '−' (minus sign), {wanted}\n"


@pytest.mark.parametrize(
    "text",
    [
        '[drawing]\nlanguage = "ru"\n',
        "rotation = \n[drawing]\nlanguage = 'ru'\n",
        'rotation = "cw"\ndrawing = { format = "A1", language = "ru" }\n',
        '# Задание\nrotation = "cw"\ndrawing.language = "ru"  # language = "en"\n',
    ],
    ids=["incomplete", "no TOML", "in braces", "with dots"],
)
@pytest.mark.parametrize("command", ["solve", "size", "notebook", "studio"])
def test_the_language_of_a_task_is_heard_before_the_task_is_found_right(command, text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "q.toml").write_text(text, encoding="utf-8")
    done = CliRunner().invoke(app, [command, "q.toml"], env={"LANGUAGE": "en"})
    assert done.exit_code == 2
    assert "а должно быть: " in done.stderr
    asked = CliRunner().invoke(app, [command, "q.toml", "--language", "en"], env={"LANGUAGE": "en"})
    assert ", but must be " in asked.stderr


@pytest.mark.parametrize(
    "text", ['# language = "ru"\n[drawing]\n', '[drawing]\nlanguage = "xx"\n', "[drawing]\nlanguage = 7\n"]
)
def test_a_task_that_names_no_language_is_told_in_that_of_the_machine(text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "q.toml").write_text(text, encoding="utf-8")
    assert ", but must be " in CliRunner().invoke(app, ["solve", "q.toml"], env={"LANGUAGE": "en"}).stderr
    assert "а должно быть: " in CliRunner().invoke(app, ["solve", "q.toml"], env={"LANGUAGE": "ru"}).stderr


TYPED = re.compile(
    r"(?<![\w’}])'[^'\s{][^']*'(?!\w)|\"[^\"{]+\"|`[^`]+`|\b[a-z_.]{3,} = (?=[\"{\[\d])|\[[a-z_.]+\]|--[a-z-]+"
)
"""What of a text is typed: quoted words, assignments, tables and options."""


@pytest.mark.parametrize("spoken", [name for name in languages() if name != ENGLISH.name])
def test_what_must_be_typed_stands_in_every_translation(spoken):
    told = language(spoken).catalog.told
    found = [(text, word) for (_, text), forms in told.items() for word in TYPED.findall(text) if word not in forms[0]]
    assert found == []
    # Nearly all of them are messages, which some languages do not have.
    least = 20 if language(spoken).has_messages else 10
    assert sum(bool(TYPED.search(text)) for _, text in told) > least


def calls_of_the_command_line() -> list[tuple[Path, ast.Call]]:
    found = []
    for path in (PACKAGE / "cli").rglob("*.py"):
        module = ast.parse(path.read_text(encoding="utf-8"))
        found += [(path, node) for node in ast.walk(module) if isinstance(node, ast.Call)]
    return found


def test_no_text_of_the_command_line_escapes_the_catalogs():
    """What is printed as it is, by typer or rich, has no words of its own: these go through ``echo`` or ``tell``."""
    printing = [
        (path, call)
        for path, call in calls_of_the_command_line()
        if isinstance(call.func, ast.Attribute) and call.func.attr in ("echo", "secho", "print")
    ]
    assert printing
    as_they_are = [
        (path.name, part.value)
        for path, call in printing
        for part in ast.walk(call)
        if isinstance(part, ast.Constant) and isinstance(part.value, str) and re.search("[A-Za-z]{3}", part.value)
    ]
    # The name of the program, and a key of a document.
    assert {text for _, text in as_they_are} <= {"graphcam ", "graphcam: ", "files"}


def test_the_help_is_russian_and_the_names_in_it_are_not():
    for words in (["--help"], ["solve", "--help"], ["exercise", "grade", "--help"]):
        said = russian(*words).stdout
        # Click's own words stand in no catalog of ours, and the remarks beside the examples are part of them.
        assert "Show this message and exit." in said
        assert re.search("[а-я]{4,}", said)
    summaries = [line for line in russian("--help").stdout.splitlines() if line.startswith("│ ")]
    names = ("version", "help", "bool", "Show this message and exit", "graphcam", "Jupyter", *app_names())
    assert english_words("\n".join(summaries), names) == set()


def app_names() -> list[str]:
    return [*(str(command.callback.__name__) for command in app.registered_commands if command.callback), "exercise"]


WRONG = {
    "a missing task": (["solve", "none.toml"], {"none", "toml", "TOML", "graphcam", "init", "FILE"}),
    "no such division": (["solve", "--divisions", "0"], {"graphcam", "divisions"}),
    "no such language": (["solve", "--language", "xx"], {"graphcam", "language"}),
    "two options": (["solve", "--worksheet", "--upto", "2"], {"graphcam", "upto", "worksheet"}),
    "no such exercise": (["exercise", "make", "nix", "--roster", "r", "--secret-file", "s"], None),
    "no such course": (["exercise", "grade", "none", "--secret-file", "s", "--out", "g.csv"], None),
    "a file that is there": (["init", "there.toml"], {"graphcam", "there", "toml"}),
}


def test_what_to_do_next_is_russian_but_the_commands():
    said = CliRunner().invoke(app, [], env={"LANGUAGE": "ru"}).stdout
    lines = [line for line in said.splitlines() if not line.startswith("    ")]
    assert english_words("\n".join(lines)) <= {"graphcam", "out", "help", "solve", "Jupyter"}
    assert said.splitlines()[0].endswith("кулачки, построенные как на чертёжной доске, и рядом точные значения.")


def test_the_exercises_are_listed_by_their_titles_in_the_language():
    said = CliRunner().invoke(app, ["exercise", "list"], env={"LANGUAGE": "ru", "COLUMNS": "200"}).stdout
    assert re.search(r"pressure-angle +Угол давления", said)


@pytest.mark.parametrize("case", WRONG)
def test_wrong_input_is_told_in_russian(case, tmp_path, monkeypatch):
    words, names = WRONG[case]
    (tmp_path / "there.toml").touch()
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, words, env={"LANGUAGE": "ru"})
    assert done.exit_code == 2
    assert re.search("[а-я]{4,}", done.stderr), done.stderr
    if names is not None:
        assert english_words(done.stderr) <= names


def test_the_table_of_a_task_in_russian_is_russian(tmp_path):
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["solve", "--language", "ru", "--out", str(out)], env={"LANGUAGE": ""})
    assert done.exit_code == 0
    assert re.search(r"величина +ед\. +построено +точно +погрешность +предел", done.stdout)
    assert "погрешность и оценка предельной погрешности в мм на чертеже" in done.stdout
    assert re.search(r"мм/рад +57,296 +57,296", done.stdout)
    assert re.search(r"sheet.pdf, .*: лист в масштабе\n", done.stdout)
    assert english_words(done.stderr) <= {"PDF", "SVG", "PNG", "DXF"}


def test_the_tables_of_a_sized_cam_are_russian(tmp_path):
    done = CliRunner().invoke(app, ["size", "--language", "ru", "--out", str(tmp_path / "out")], env={"LANGUAGE": ""})
    assert done.exit_code == 0
    tables = done.stdout.partition(str(tmp_path))[0]
    assert english_words(tables) == set()
    assert re.search(r"эксцентриситет +20,000 мм", tables)
    assert "активные ограничения: угол давления на удалении, контактное напряжение" in tables
