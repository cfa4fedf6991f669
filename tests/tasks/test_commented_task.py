"""The file of ``graphcam init``: the coursework task, in which every key is explained, in every language."""

import dataclasses
import re
import tomllib
from importlib import resources

import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.given.table_file import CurveTable
from graphcam.help_texts import help_text
from graphcam.language import language
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.commented_task import IN_PLACE_OF_MOTION, commented_task, table_docs
from graphcam.tasks.dataclass_reader import classes_of
from graphcam.tasks.declared_numbers import declared
from graphcam.tasks.spring_tables import ArmSpringTable
from graphcam.tasks.task import Task

CLASSES, CLASSES_OF_ARCS = classes_of(Task), classes_of(ArcsTask)
TABLES = {*CLASSES.values(), *CLASSES_OF_ARCS.values(), *IN_PLACE_OF_MOTION.values(), ArmSpringTable}
TABLES.remove(CurveTable)  # of which a file gives the name
UNIT_WORDS = {"deg": "degrees", "um": "micrometres"}


@pytest.mark.parametrize("name", ["en", "ru", "vi"])
def test_it_is_the_coursework(name, tmp_path):
    result = CliRunner().invoke(app, ["init", str(tmp_path / "cam.toml"), "--language", name])
    assert result.exit_code == 0, result.output
    task, own = gc.load_task(tmp_path / "cam.toml"), gc.builtin_task()
    assert task.drawing.language == name
    assert dataclasses.replace(task, drawing=own.drawing) == own


def test_every_key_stands_in_it():
    text = commented_task()
    for table in TABLES - {*CLASSES_OF_ARCS.values()}:
        for key in (field.name for field in dataclasses.fields(table) if field.init and field.name != "radii"):
            written = rf"(?m)^(?:# )?(?:\[{key}\]|{key} = )|[{{ ]{key} = |^#   {key} "
            assert re.search(written, text), (table.__name__, key)


def test_every_key_is_explained():
    """In one line of the docstring of its table, which begins with the unit of a number."""
    for table in TABLES:
        texts, numbers = table_docs(table)[1], declared(table)
        for field in dataclasses.fields(table):
            if (
                not field.init
                or field.name == "kind"
                or (table.__name__.endswith("Task") and field.name not in numbers)
            ):
                continue
            assert texts.get(field.name), f"{table.__name__}.{field.name}"
            if field.name in numbers and (held := numbers[field.name].held):
                unit = UNIT_WORDS.get(held.own, held.own)
                assert unit in texts[field.name], f"{table.__name__}.{field.name}: {unit}"


def test_nearly_every_text_is_told_in_russian():
    """A new one falls through to English until a release, see tests/translations.py."""
    russian, texts = language("ru"), {text for table in TABLES for text in table_docs(table)[1].values()}
    told = [bool(re.search("[а-я]", russian.text(help_text(text)))) for text in texts]
    assert sum(told) > 0.95 * len(told) > 90
    assert "мм, 0 для острия; если не задан, выбирается по правилу" in commented_task(russian)


def test_examples_are_those_of_keys_that_there_are():
    examples = tomllib.loads(resources.files("graphcam").joinpath("data", "examples.toml").read_text(encoding="utf-8"))
    known = {field.name for table in TABLES for field in dataclasses.fields(table)}
    assert {key for table in examples.values() for key in table} <= known
    assert max(map(len, commented_task().splitlines())) < 130


def test_an_unknown_language_is_refused(tmp_path):
    result = CliRunner().invoke(app, ["init", str(tmp_path / "cam.toml"), "--language", "xx"])
    assert result.exit_code == 2
    assert "'xx'" in result.stderr
    assert not (tmp_path / "cam.toml").exists()
