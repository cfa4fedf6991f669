"""Exercise files: TOML in, an exercise out, or one error that says which field is wrong."""

import dataclasses
import re
from collections.abc import Mapping
from importlib import resources
from keyword import iskeyword
from pathlib import Path
from typing import Any

from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError, TaskError, nearest_word_remedy, suggestion
from graphcam.exercises.definition.blank_axes import empty_axes
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of, drawn_answer
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise, Parameter
from graphcam.exercises.definition.marked_formats import PAPER_NAMES, TILED_A3, format_of, orientation_of
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.definition.variant import fill_in
from graphcam.language import ENGLISH, languages
from graphcam.tasks.dataclass_reader import Classes
from graphcam.tasks.sheet_tables import SheetTable
from graphcam.tasks.task_file import checked_table, other_file, read_content, read_toml
from graphcam.words import say

REMEDY = say("see exercises/README.md")
UNREAD_FIELDS = {"name", "language", "paper"}
"""What an exercise has and its file does not say."""


def library() -> tuple[str, ...]:
    """The names of the exercises that come with graphcam.

    >>> "acceleration-and-scales" in library()
    True
    """
    return tuple(sorted(path.stem for path in _folder().glob("*.toml")))


def find_exercise(name: str, language: str = ENGLISH.name, hand: str = "", paper: str = "") -> Exercise:
    """An exercise by its name in the library, or by the path of its file; its texts in a language.

    hand : another one than the file names, for whose students the tolerances are made; see :data:`hands.HANDS`
    paper : "A1", "A3", "A4" or "A3-tiles", for worksheets that are photographed, instead of the format of the task

    Raises
    ------
    TaskError : there is none of that name, or its file is wrong
    DesignError : there is no such hand, or the exercise is not made for the paper
    """
    exercise = load_exercise(exercise_path(name), language)
    if hand:
        exercise = dataclasses.replace(exercise, hand=dataclasses.replace(exercise.hand, name=hand))
    return on_paper(exercise, paper) if paper else exercise


FORMAT_KEYS = ("ordinate", "poles")
"""Keys of a task's ``[drawing]`` that belong to one size of sheet."""


def on_paper(exercise: Exercise, paper: str) -> Exercise:
    """An exercise for worksheets that are photographed, drawn at the scales of that paper.

    Ordinate and poles are chosen anew: those that the file gives were chosen for its own format.

    >>> on_paper(find_exercise("inversion-arm"), "A3-tiles").task["drawing"]
    {'format': 'A3', 'divisions': 12, 'orientation': 'landscape'}

    Raises
    ------
    DesignError : it is not made for the paper
    """
    format_ = format_of(paper)
    if format_ not in exercise.papers or paper not in (*PAPER_NAMES, TILED_A3):
        made_for = [*exercise.papers, *([TILED_A3] if "A3" in exercise.papers else [])]
        none = say("left out: no paper of this exercise is made to be photographed")
        raise DesignError("paper", paper, say("one of {names}", names=", ".join(made_for)) if made_for else none)
    drawing = dict(exercise.task.get("drawing", {}))
    sheet = {"format": format_, "orientation": orientation_of(paper)}
    if format_ != drawing.get("format", SheetTable.format) or "orientation" in drawing:
        drawing = {key: value for key, value in drawing.items() if key not in FORMAT_KEYS}
    return dataclasses.replace(exercise, paper=paper, task={**exercise.task, "drawing": {**drawing, **sheet}})


def exercise_path(name: str) -> Path:
    """The file of an exercise of the library by its name; or the path itself.

    Raises
    ------
    TaskError : the library has none of that name

    >>> exercise_path("integration").name, exercise_path("mine/cam.toml").name
    ('integration.toml', 'cam.toml')
    """
    if name.endswith(".toml") or "/" in name:
        return Path(name)
    if name not in library():
        known = say("one that 'graphcam exercise list' names")
        raise TaskError(name, say("the exercise"), say("unknown"), known, nearest_word_remedy(name, library()))
    return _folder() / f"{name}.toml"


def load_exercise(path: str | Path, language: str = ENGLISH.name) -> Exercise:
    """The exercise in a TOML file, its texts in a language.

    Raises
    ------
    TaskError : there is no such file, it is not TOML, or a field is missing, unknown or wrong
    """
    path = Path(path)
    with other_file(say("exercise file"), REMEDY):
        read = read_toml(str(path), read_content(path))
        data = read.data
        if "motion" in data and "task" not in data:
            remedy = say("begin with a copy: 'graphcam exercise copy integration mine.toml'")
            expected = say("an exercise, which has the task in its table [task]")
            raise TaskError(str(path), say("the file"), say("a task"), expected, remedy)
        for key in UNREAD_FIELDS & data.keys():
            raise TaskError(str(path), key, say("an unknown key"), say("a key of this table"), REMEDY)
        told = in_language(str(path), data, language)
        exercise = checked_table(Exercise, _classes(data), str(path), told, told, read)
    exercise = dataclasses.replace(exercise, name=path.stem, language=language)
    _check(str(path), exercise)
    return exercise


def _folder() -> Path:
    """The folder of the library: installed beside the code, in a checkout at the top level."""
    installed = Path(str(resources.files("graphcam").joinpath("exercises", "library")))
    return installed if installed.is_dir() else Path(__file__).parents[3] / "exercises"


def _classes(data: dict[str, Any]) -> Classes:
    """The class of each table of a file; every parameter has a table by its own name."""
    parameters = data.get("parameters")
    named = parameters if isinstance(parameters, dict) else {}
    tables: Classes = {("parameters", str(name)): Parameter for name in named}
    return {(): Exercise, ("answers",): AskedAnswer, ("hand",): HandTable, ("marks",): MarksPolicy, **tables}


def _check(path: str, exercise: Exercise) -> None:
    """What only a drawing shows: that the task, every answer and every mistake can be drawn."""
    for name in exercise.misconceptions:
        try:
            misconception(name)
        except DesignError as error:
            raise TaskError(path, "misconceptions", name, *error.args[2:]) from None
    _check_text(path, exercise)
    first = {name: parameter.values[0] for name, parameter in exercise.parameters.items()}
    task = fill_in(exercise, first, path)
    for name, parameter in exercise.parameters.items():
        for k, value in enumerate(parameter.choices or ()):
            try:
                fill_in(exercise, {**first, name: value}, path)
            except TaskError as error:
                raise TaskError(path, f"parameters.{name}.choices[{k}]", *error.args[2:]) from None
    chain = board_chain(task)
    shown = worksheet_views(exercise, chain)
    for k, asked in enumerate(exercise.answers):
        if not (asked.name.isascii() and asked.name.isidentifier()) or iskeyword(asked.name):
            limit = say("a name of Latin letters, digits and _, as students write it before their answer")
            raise TaskError(path, f"answers[{k}].name", asked.name, limit, say('write "v_max"'))
        try:
            drawn_answer(chain, asked)
            if asked.place and asked.place not in shown:
                limit = say("a view of the worksheet: {value}", value=", ".join(shown) or say("none is shown"))
                raise DesignError("place", asked.place, limit, suggestion(asked.place, shown))
        except DesignError as error:
            place = f"answers[{k}].{error.quantity}"
            _, value, limit, remedy = error.args
            raise TaskError(path, place, value, limit, remedy or REMEDY) from None


def _check_text(path: str, exercise: Exercise) -> None:
    """Check that the text tells every parameter, and nothing in braces that is none."""
    for said in re.findall(r"\{[^{}]*\}", exercise.text):
        if (name := said[1:-1]) not in exercise.parameters:
            expected = say("the name of a parameter in braces")
            raise TaskError(path, "text", said, expected, suggestion(name, exercise.parameters))
    for name in exercise.parameters:
        if f"{{{name}}}" not in exercise.text:
            found, limit = say("without {{{name}}}", name=name), say("one that tells students every parameter")
            raise TaskError(path, "text", found, limit, say("write {{{name}}} where its value stands", name=name))


def worksheet_views(exercise: Exercise, chain: Chain) -> list[str]:
    """The names of the views on the worksheet, those of empty axes first."""
    shown = [empty_axes(exercise, chain, name).view.name for name in exercise.axes]
    for name, count in exercise.sheet.items():
        shown += [step.view.name for step in construction_of(chain, name).steps()[:count]]
    return list(dict.fromkeys(shown))


TEXT_KEYS = ("title", "text")
"""The keys of an exercise and of its answers that a student reads."""


def in_language(path: str, tables: Mapping[str, Any], language: str) -> dict[str, Any]:
    """The tables of an exercise file with every text in one language.

    A text that is not there in the language stays English, as one of a catalog does, or else what is there first.

    >>> in_language("", {"title": {"en": "The cam", "ru": "Кулачок"}, "answers": [{"text": "v"}]}, "ru")
    {'title': 'Кулачок', 'answers': [{'text': 'v'}]}

    Raises
    ------
    TaskError : a text is in a language that there is not
    """
    chosen = _chosen_text(path, "", tables, language)
    if isinstance(answers := tables.get("answers"), list):
        chosen["answers"] = [
            _chosen_text(path, f"answers[{k}].", each, language) if isinstance(each, dict) else each
            for k, each in enumerate(answers)
        ]
    return chosen


def _chosen_text(path: str, place: str, table: Mapping[str, Any], language: str) -> dict[str, Any]:
    found = dict(table)
    for key in TEXT_KEYS:
        texts = table.get(key)
        if not isinstance(texts, dict) or not texts:
            continue
        for name in texts:
            if name not in languages():
                expected = say("a language, one of {names}", names=", ".join(languages()))
                raise TaskError(path, f"{place}{key}", name, expected, suggestion(name, languages()))
        first = next(iter(texts.values()))
        found[key] = texts.get(language, texts.get(ENGLISH.name, first))
    return found
