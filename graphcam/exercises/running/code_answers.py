"""Answers that a student's code hands out: run, limited, and read as the untrusted data they are."""

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from graphcam.drafting.ink import Caption, say
from graphcam.errors import UnreadableError
from graphcam.exercises.reading.answer_values import short_text
from graphcam.exercises.reading.notebook import cell_source, code_cells, notebook_values
from graphcam.exercises.running.isolation_levels import MEBIBYTE, Level, ResourceLimits
from graphcam.exercises.running.limited_process import RunEnd
from graphcam.exercises.running.sandbox import run_cells


def run_notebook(
    level: Level, names: Sequence[str], limits: ResourceLimits, name: str, data: bytes
) -> tuple[Mapping[str, Any], list[Caption]]:
    """The values that a notebook's code hands out, and sentences on how it ended.

    Where it hands out nothing, its answer cell counts if it holds literals.

    names : the answers that are asked;  name, data : of the notebook

    Raises
    ------
    UnreadableError : it is no notebook
    """
    sources = [cell_source(cell).splitlines() for cell in code_cells(name, data)]
    # Without the lines that are for the notebook program itself.
    cells = ["\n".join("" if line.startswith(("%", "!")) else line for line in lines) for lines in sources]
    ended = run_cells(level, cells, [*names, "answers"], limits)
    values, notes = _last_answers(name, ended.handed_out)
    if not values:
        with suppress(UnreadableError):
            values, notes = notebook_values(name, data), []
    return values, [*_end_remarks(name, ended, limits), *notes]


def _last_answers(name: str, data: bytes) -> tuple[dict[str, Any], list[Caption]]:
    """The last whole line that says something: an answer may be given again, improved."""
    lines = [line for line in data.split(b"\n")[:-1] if line.strip() not in (b"", b"{}")]
    if not lines:
        return {}, [say("{name} returns no answers", name=name)]
    try:
        found = json.loads(lines[-1], object_pairs_hook=_without_repeats)
    except (ValueError, RecursionError):
        return {}, [say("{name}: what it returns cannot be read", name=name)]
    if not isinstance(found, dict):
        return {}, [say("{name}: what it returns is not a table of answers", name=name)]
    inner = found.pop("answers", {})
    return {**(inner if isinstance(inner, dict) else {}), **found}, []


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        raise ValueError("an answer stands there twice")
    return found


def _end_remarks(name: str, ended: RunEnd, limits: ResourceLimits) -> list[Caption]:
    if ended.late:
        return [say("{name} was stopped after {seconds:g} s", name=name, seconds=limits.seconds)]
    if ended.large:
        limit = limits.memory // MEBIBYTE
        return [
            say(
                "{name} was stopped: its processes together took more than {limit} MiB of memory",
                name=name,
                limit=limit,
            )
        ]
    # The student's own words; what is shown of them is one short line.
    last = ended.text.strip().splitlines()[-1:]
    if last and ("Error" in last[0] or "SystemExit" in last[0] or "Interrupt" in last[0]):
        return [say("{name} ended with {error}", name=name, error=short_text(last[0]))]
    if ended.status:
        return [say("{name} ended with status {status}", name=name, status=ended.status)]
    return []
