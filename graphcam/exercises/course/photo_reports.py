"""What 'exercise read' left in a folder of readings: the sentences and the pictures that belong to a hand-in.

Only a folder that a teacher's run made is believed: what students hand in may be called like that too.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from graphcam.errors import UnreadableError
from graphcam.exercises.course.submissions import HandIn
from graphcam.exercises.reading.regular_file import read_regular
from graphcam.words import sequence

READINGS_FOLDER = ".photographs"
"""The hidden folder of what was read; a folder without it was not made by 'exercise read'."""
REPORT_FILE = "report.json"
"""The file in a student's folder that says what became of the photographs."""
MAX_REPORT_BYTES, MAX_PICTURE_BYTES = 1_000_000, 2_000_000
"""Bytes that are read."""
MAX_PAGES = 20
"""The maximum number of pages of a worksheet."""


def with_photo_notes(hand_ins: Sequence[HandIn], submissions: Path) -> list[HandIn]:
    """The hand-ins with what must be said of the photographs that they were read off.

    submissions : the folder that is graded
    """
    if not read_off_photographs(submissions):
        return list(hand_ins)
    return [replace(one, notes=(*one.notes, *(sequence([note]) for note in _notes(one)))) for one in hand_ins]


def read_off_photographs(submissions: Path) -> bool:
    """Whether a folder is one of readings that a teacher's run made."""
    return (submissions / READINGS_FOLDER).is_dir()


def await_review(hand_ins: Sequence[HandIn], submissions: Path) -> list[str]:
    """The students whose photographs have something that is to be looked at, and that nobody has."""
    if not read_off_photographs(submissions):
        return []
    reports = [(one.student, _report(one.path)) for one in hand_ins]
    return [student for student, said in reports if said.get("to_be_looked_at") is True and not said.get("reviewed")]


def _notes(one: HandIn) -> list[str]:
    said = _report(one.path).get("notes", [])
    return [str(note) for note in said] if isinstance(said, list) else []


def photo_pictures(folder: Path, *, right: bool) -> list[str]:
    """The pictures of a student's photographs with what was read drawn over, as addresses that hold all of them.

    folder : of the student, in a folder of readings
    right : whether what is right is drawn too
    """
    if not (folder.parent / READINGS_FOLDER).is_dir():
        return []
    listed = _report(folder).get("overlays", [])
    found: list[str] = []
    for overlays in listed[:MAX_PAGES] if isinstance(listed, list) else []:
        name = overlays.get("right" if right else "own") if isinstance(overlays, dict) else None
        if isinstance(name, str) and Path(name).name == name:
            try:
                data = read_regular(folder / name, MAX_PICTURE_BYTES)
            except UnreadableError:
                continue
            found.append("data:image/jpeg;base64," + base64.b64encode(data).decode("ascii"))
    return found


def _report(folder: Path) -> dict[str, Any]:
    try:
        said = json.loads(read_regular(folder / REPORT_FILE, MAX_REPORT_BYTES))
    except (UnreadableError, ValueError):
        return {}
    return said if isinstance(said, dict) else {}
