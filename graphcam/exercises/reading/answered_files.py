"""Whether files say anything: the handouts, given back as they were, do not."""

import os
from collections.abc import Callable, Mapping
from typing import Any

from graphcam.exercises.reading.answer_tables import csv_values, toml_values
from graphcam.exercises.reading.notebook import cell_tags, code_cells, notebook_values
from graphcam.exercises.reading.regular_file import UnreadableError, open_folder, read_regular
from graphcam.exercises.reading.submission_files import CSV, LIMITS, NOTEBOOK, TOML, answer_files, is_gap

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
            return any(_says(name, there[called], place) for name, called in chosen.items())
    except OSError:
        return False


def _says(name: str, there: str, place: Any) -> bool:
    try:
        return answers_something(name, read_regular(there, LIMITS[name], place))
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
