"""A student's folder: which of its files hold answers, and what they say together."""

import os
import re
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from graphcam.drafting.ink import Caption, say
from graphcam.dxf_curves import read_layers
from graphcam.errors import UnreadableError
from graphcam.exercises.definition.exercise import BAR, Answers, AskedAnswer, Given
from graphcam.exercises.reading.answer_tables import csv_values, toml_values
from graphcam.exercises.reading.answer_values import number, points, short_text
from graphcam.exercises.reading.drawn_layers import CadDrawing
from graphcam.exercises.reading.notebook import cell_tags, code_cells, notebook_values
from graphcam.exercises.reading.paper_area import PaperArea
from graphcam.exercises.reading.regular_file import open_folder, read_regular
from graphcam.exercises.reading.typed_answers import by_answer_names, left_commented, quantity
from graphcam.typed_words import meant

TOML, CSV, NOTEBOOK, DXF = "answers.toml", "answers.csv", "answers.ipynb", "answers.dxf"
BYTE_LIMITS = {TOML: 64_000, CSV: 200_000, NOTEBOOK: 20_000_000, DXF: 5_000_000}
"""Bytes of a file that are read."""
SIMILAR_NAME_PATTERN = re.compile(
    r" *answers *(?:\(\d{1,4}\)|[-_]\d{1,4})? *\.(toml|csv|ipynb|dxf)(?:\.txt)? *", re.ASCII | re.IGNORECASE
)
"""What systems make of the names: capitals, a number where there was a file, an ending that an editor adds."""
NO_FILES_REMARK = say("there is none of {names}", names=", ".join(BYTE_LIMITS))
"""What is said of a folder without any of these files."""
NO_ANSWERS_REMARK = say("none of the answers is given")
"""What is said of files without any answer."""
Reader = Callable[[str, bytes], tuple[Mapping[str, Any], list[Caption]]]
"""Values by name out of a file's bytes, and sentences on it."""


def read_files(
    folder: str | os.PathLike[str], names: Mapping[str, str] | None = None
) -> tuple[dict[str, bytes], list[Caption]]:
    """The bytes of the answer files that are there, and sentences on those that cannot be read or are called otherwise.

    names : of a folder that holds files of others too, how the student's are called there by how they were handed in
    """
    found: dict[str, bytes] = {}
    errors: list[Caption] = []
    try:
        with open_folder(folder) as place:
            there = names if names is not None else {name: name for name in os.listdir(place)}  # noqa: PTH208
            chosen, notes = answer_files(there)
            for name, handed_in in chosen.items():
                try:
                    found[name] = read_regular(there[handed_in], BYTE_LIMITS[name], place)
                except UnreadableError as error:
                    errors.append(error.why)
    except OSError:
        return {}, [say("the submission is not a folder")]
    if not found and not errors and not notes:
        errors.append(NO_FILES_REMARK)
    return found, [*errors, *notes]


def answer_files(there: Iterable[str]) -> tuple[dict[str, str], list[Caption]]:
    """The files that are read, by the names that they should have, and sentences on those called otherwise.

    >>> answer_files(["Answers.toml", "answers (1).csv", "answers.dxf.txt", "notes.toml"])[0]
    {'answers.toml': 'Answers.toml', 'answers.csv': 'answers (1).csv', 'answers.dxf': 'answers.dxf.txt'}
    """
    alike: dict[str, list[str]] = {name: [] for name in BYTE_LIMITS}
    for name in there:
        if meant := SIMILAR_NAME_PATTERN.fullmatch(name):
            alike[f"answers.{meant[1].lower()}"].append(name)
    chosen: dict[str, str] = {}
    notes: list[Caption] = []
    for name, listed in alike.items():
        others = sorted(one for one in listed if one != name)
        if name in listed:
            chosen[name] = name
            notes += [say("{other} is not read, since there is {name}", other=other, name=name) for other in others[:1]]
        elif len(others) == 1:
            chosen[name] = others[0]
            notes.append(say("{other} is read as {name}", other=others[0], name=name))
        elif others:
            said = ", ".join(others[:3])
            notes.append(say("none of {others} is read: rename the right one to {name}", others=said, name=name))
    return chosen, notes


def from_files(
    asked: Iterable[AskedAnswer],
    files: Mapping[str, bytes],
    notes: Iterable[Caption] = (),
    notebook: Reader | None = None,
    rooms: Mapping[str, PaperArea] | None = None,
) -> Answers:
    """What the files answer, and what they tell as :data:`BAR` beside it.

    asked : the answers that there should be
    files : bytes by name, as :func:`read_files` finds them
    notes : sentences on files that could not be read
    notebook : how the notebook is run; None reads the literals of its answer cell
    rooms : by the answer's name, where on the paper a drawn one can lie
    """
    asked, notes = [*asked, BAR], list(notes)
    given: dict[str, list[Any]] = {}
    for name in (name for name in TABLES if name in files):
        try:
            read = notebook if notebook and name == NOTEBOOK else _table(TABLES[name])
            values, more = read(name, files[name])
        except UnreadableError as error:
            notes.append(error.why)
            continue
        notes += more
        for answer, value in values.items():
            if not is_gap(value):
                given.setdefault(answer, []).append(value)
    given, more = by_answer_names(asked, given)
    notes += more
    if TOML in files:
        # Bytes that are no text have been told already.
        for answer, text in left_commented(asked, given, files[TOML].decode("utf-8-sig", "ignore")).items():
            given[answer] = [text]
            notes.append(say("{answer} is read, though the # was left in before it", answer=answer))
    drawing = None
    if DXF in files:
        try:
            drawing = CadDrawing(read_layers(DXF, files[DXF]))
        except UnreadableError as error:
            notes.append(error.why)
    return _answers(asked, given, drawing, notes, rooms or {})


def is_gap(value: Any) -> bool:
    """Whether a value is a gap of a form that was not filled in: "" or None."""
    return value is None or (isinstance(value, str) and not value)


def _table(values: Callable[[str, bytes], Mapping[str, Any]]) -> Reader:
    return lambda name, data: (values(name, data), [])


def _answers(
    asked: list[AskedAnswer],
    given: Mapping[str, list[Any]],
    drawing: CadDrawing | None,
    notes: list[Caption],
    rooms: Mapping[str, PaperArea],
) -> Answers:
    values: dict[str, Given] = {}
    problems: dict[str, Caption] = {}
    unmarked = False
    for one in asked:
        try:
            if one.name in given:
                values[one.name] = _agreed_value(one, given[one.name])
            elif drawing is not None and one.kind != "number":
                values[one.name], more = _drawn_answer(one, drawing, rooms.get(one.name))
                notes = [*notes, *more]
                unmarked = unmarked or not drawing.marks_origin(one.layer)
        except UnreadableError as error:
            problems[one.name] = error.why
    if unmarked:
        notes = [
            *notes,
            say("{name} marks no origin by a POINT on the layer ORIGIN; the drawing's own zero is used", name=DXF),
        ]
    if not (values.keys() | problems.keys()) - {BAR.name}:
        notes = [*notes, NO_ANSWERS_REMARK]
    return Answers(values, problems, (*notes, *_bad_lines(asked, given), *_unknown_name_remark(asked, given)))


def _bad_lines(asked: list[AskedAnswer], given: Mapping[str, list[Any]]) -> list[Caption]:
    """A sentence on the first bad line that names none of the answers: it may have been meant for one."""
    names = {one.name for one in asked}
    values = [value for name, listed in given.items() if name not in names for value in listed]
    return [value.why for value in values if isinstance(value, UnreadableError)][:1]


def _drawn_answer(asked: AskedAnswer, drawing: CadDrawing, room: PaperArea | None) -> tuple[Given, list[Caption]]:
    """The drawn answer in a drawing, and sentences on it."""
    points = drawing.points(asked.layer) if asked.kind == "points" else drawing.curve(asked.layer)
    if room is None:
        return points, []
    marked = drawing.marks_origin(asked.layer)
    room.admit(asked.layer, points, marked=marked)
    if not (marked and room.is_moved(points)):
        return points, []
    moved = say(
        "the drawing on the layer {layer} seems to be moved as a whole relative to the POINT on the layer "
        "ORIGIN; check that it marks the origin of this drawing",
        layer=asked.layer,
    )
    # It is marked as it lies: the place is part of the answer.
    return points, [moved]


def _agreed_value(asked: AskedAnswer, listed: list[Any]) -> Given:
    for value in listed:
        if isinstance(value, UnreadableError):
            raise value
    found = [_value(asked, value) for value in listed]
    if any(np.shape(one) != np.shape(found[0]) or np.any(one != found[0]) for one in found[1:]):
        raise UnreadableError(say("{answer} is answered differently in two files", answer=asked.name))
    return found[0]


def _value(asked: AskedAnswer, value: Any) -> Given:
    if asked.kind == "number" and isinstance(value, str):
        return quantity(asked, value)
    if asked.kind == "number":
        return number(asked.name, value)
    return value if isinstance(value, np.ndarray) else points(asked.name, value)


def _unknown_name_remark(asked: list[AskedAnswer], given: Mapping[str, list[Any]]) -> list[Caption]:
    """A sentence on the first name that was not asked: a slip of the keys loses an answer otherwise."""
    names = [one.name for one in asked if one is not BAR]
    strange = [name for name in given if name not in (*names, BAR.name)]
    if not strange or len(given.keys() & set(names)) == len(names):
        return []
    first = short_text(strange[0])
    if name := meant(first, names):
        return [say("there is no answer {answer} in this exercise; did you mean {meant}?", answer=first, meant=name)]
    return [
        say(
            "there is no answer {answer} in this exercise; the answers are {names}",
            answer=first,
            names=", ".join(names),
        )
    ]


TABLES: Mapping[str, Callable[[str, bytes], Mapping[str, Any]]] = {
    TOML: toml_values,
    CSV: csv_values,
    NOTEBOOK: notebook_values,
}
"""How the files are read that can be empty; a drawing is made by somebody."""


def answers_something(name: str, data: bytes) -> bool:
    """Whether a file has an answer, or something that cannot be read and may have been one.

    name : the one that it is read by

    >>> answers_something("answers.toml", b"# v =\\n"), answers_something("answers.toml", b"v = 1")
    (False, True)
    """
    if name not in TABLES:
        return True
    try:
        given = any(not is_gap(value) for value in TABLES[name](name, data).values())
        # Code of one's own may make the answers.
        return given or (name == NOTEBOOK and any("answers" not in cell_tags(cell) for cell in code_cells(name, data)))
    except UnreadableError:
        return True


def answers_in(folder: str | os.PathLike[str], names: Mapping[str, str] | None = None) -> bool:
    """Whether one of the answer files in a folder says anything.

    names : of files among those of others, by how each was called how it is called there; None where all count
    """
    try:
        with open_folder(folder) as place:
            there = {name: name for name in os.listdir(place)} if names is None else names  # noqa: PTH208
            chosen, _ = answer_files(there)
            return any(_has_answers(name, there[called], place) for name, called in chosen.items())
    except OSError:
        return False


def _has_answers(name: str, there: str, place: Any) -> bool:
    try:
        return answers_something(name, read_regular(there, BYTE_LIMITS[name], place))
    except UnreadableError:
        return True


def answers_named(name: str, data: bytes) -> set[str]:
    """The names that a table of answers gives a value.

    name : TOML or CSV

    >>> answers_named("answers.toml", b"v = 1\\nw = ''")
    {'v'}
    """
    try:
        return {answer for answer, value in TABLES[name](name, data).items() if not is_gap(value)}
    except UnreadableError:
        return set()
