"""Answers in a notebook: tagged cells of literals, parsed and never run."""

import ast
import json
import warnings
from collections.abc import Generator
from typing import Any

from graphcam.errors import UnreadableError
from graphcam.exercises.reading.answer_tables import text_of
from graphcam.exercises.reading.answer_values import short_text
from graphcam.exercises.reading.typed_answers import mended
from graphcam.words import say

ANSWER_TAG = "answers"
"""The tag of the cells that hold the answers."""
MAX_CELL_LENGTH = 64_000
"""Letters of the answer cells that are parsed."""


def notebook_values(name: str, data: bytes) -> dict[str, Any]:
    """The literals of the tagged cells: ``v_max = 12.5`` a line, or one ``answers = {"v_max": 12.5}``.

    Raises
    ------
    UnreadableError : no notebook, no such cell, an answer given twice, or anything in it that is not a literal

    >>> cell = {"cell_type": "code", "metadata": {"tags": ["answers"]}, "source": ["v_max = 12.5\\n", "touch = [1, 2]"]}
    >>> notebook_values("a.ipynb", json.dumps({"cells": [cell]}).encode())
    {'v_max': 12.5, 'touch': [1, 2]}
    """
    tagged = [cell_source(cell) for cell in code_cells(name, data) if ANSWER_TAG in cell_tags(cell)]
    if not tagged:
        raise UnreadableError(say("{name} has no cell with the tag {tag}", name=name, tag=ANSWER_TAG))
    if sum(map(len, tagged)) > MAX_CELL_LENGTH:
        raise UnreadableError(
            say("{name}: the answers are longer than {most} letters", name=name, most=MAX_CELL_LENGTH)
        )
    return _literals(name, tagged)


def code_cells(name: str, data: bytes) -> list[dict[str, Any]]:
    """The code cells of a notebook, in order."""
    try:
        whole = json.loads(text_of(name, data))
    except (ValueError, RecursionError):
        raise UnreadableError(say("{name} is not a notebook: it is not valid JSON", name=name)) from None
    cells = whole.get("cells") if isinstance(whole, dict) else None
    if not isinstance(cells, list):
        raise UnreadableError(say("{name} is not a notebook: it has no cells", name=name))
    return [cell for cell in cells if isinstance(cell, dict) and cell.get("cell_type") == "code"]


def cell_tags(cell: dict[str, Any]) -> list[Any]:
    """The tags of a cell; none where the metadata are not what they should be."""
    metadata = cell.get("metadata")
    tags = metadata.get("tags") if isinstance(metadata, dict) else None
    return tags if isinstance(tags, list) else []


def cell_source(cell: dict[str, Any]) -> str:
    """The text of a cell, which a notebook stores as one text or as its lines."""
    source = cell.get("source", "")
    if isinstance(source, list):
        return "".join(line for line in source if isinstance(line, str))
    return source if isinstance(source, str) else ""


def _literals(name: str, sources: list[str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    try:
        # What Python finds strange in it is no news for the teacher's terminal.
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for key, node in (pair for source in sources for pair in _assignments(_parsed(source))):
                if key in found:
                    raise UnreadableError(say("{name}: {answer} is answered twice", name=name, answer=short_text(key)))
                found[key] = ast.literal_eval(node)
    # Too deep for the parser is a MemoryError there; numbers too long are a ValueError or a SyntaxError.
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        raise UnreadableError(
            say(
                "{name}: the answer cell may hold only lines such as v_max = 12.5, with numbers and lists of numbers",
                name=name,
            )
        ) from None
    return found


def _parsed(source: str) -> ast.Module:
    """The cell; one that is no Python with its numbers as texts, where they have a unit or the minus of print."""
    try:
        return ast.parse(source)
    except SyntaxError:
        return ast.parse("\n".join(mended(line) for line in source.split("\n")))


def _assignments(tree: ast.Module) -> Generator[tuple[str, ast.expr]]:
    """Names and values, of lines or of the dictionary ``answers``.

    >>> list(_assignments(ast.parse("# YOUR CODE HERE\\nraise NotImplementedError()")))
    []
    """
    for statement in tree.body:
        match statement:
            case ast.Assign(targets=[ast.Name(id="answers")], value=ast.Dict(keys=keys, values=values)):
                for key, value in zip(keys, values, strict=True):
                    if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
                        raise ValueError("not a name")
                    yield key.value, value
            case ast.Assign(targets=[ast.Name(id=key)], value=value):
                yield key, value
            case ast.Expr(value=ast.Constant(value=str() | None)):
                pass
            # What nbgrader puts into a cell that is to be filled in.
            case ast.Raise(exc=ast.Call(func=ast.Name(id="NotImplementedError"), args=[], keywords=[])):
                pass
            case _:
                raise ValueError("not an assignment")
