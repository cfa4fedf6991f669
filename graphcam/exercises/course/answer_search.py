"""Where in a hand-in its answers lie: also in a zip, a folder further in, or one table that is called otherwise."""

import os
import shutil
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from graphcam.drafting.ink import Caption, say
from graphcam.errors import TaskError, UnreadableError
from graphcam.exercises.course.submissions import HandIn, answers_folder
from graphcam.exercises.course.zipped_submissions import unpack_one
from graphcam.exercises.reading.regular_file import read_regular
from graphcam.exercises.reading.submission_files import BYTE_LIMITS, CSV, TOML, answer_files, answers_in, answers_named
from graphcam.tasks.task_writer import TASK_FILE

HANDED_OUT_FILES = ("worksheet.pdf", "worksheet.dxf", TASK_FILE)
"""What a student has anyway."""
SYSTEM_FILES = ("timestamp.txt", "Thumbs.db", "desktop.ini")
"""What nbgrader and desktops put into a folder."""
TABLE_NAMES = {".toml": TOML, ".csv": CSV}
"""Endings of tables that are read under another name if there is but one, and the name that they are read by."""
MAX_SEARCHED_PLACES = 20
"""How many folders, zips and tables are looked into: students may hand in any number of them."""


@dataclass(frozen=True)
class AnswerSearch:
    """A search for the answers of a hand-in.

    assignment : name of the folder in a student's that counts if it is there
    answers : their names
    scratch : an empty folder, in which zips are unpacked
    table : name of a file that was handed out with the task; empty where there is none
    """

    assignment: str
    answers: Collection[str]
    scratch: Path
    table: str = ""

    def located(self, one: HandIn) -> HandIn:
        """The hand-in with the place where its answers lie; as it is where nothing else has any.

        What has other files and no answers is noted, and is "unread".
        """
        folder = answers_folder(one, self.assignment)
        there = _entries(folder) if one.names is None else [(name, False) for name in one.names]
        others = [(name, inside) for name, inside in there if name != self.table and _is_unknown_file(name)]
        read = answer_files(name for name, inside in there if not inside)[0]
        # Most have the files that were handed out and nothing else: no more than the names is read of them here.
        if not others or (read and (one.names is not None or answers_in(folder))):
            return one
        real = one.names or {}
        places, bad = self._places(folder, [(name, real.get(name, name), inside) for name, inside in others])
        if len(places) == 1:
            where, place = places[0]
            return replace(
                one, path=place, names=None, notes=(*one.notes, say("the answers are read from {place}", place=where))
            )
        if not places and not bad:
            tables = self._tables(folder, [(name, real.get(name, name)) for name, inside in others if not inside])
            if len(tables) == 1:
                name, known, file = tables[0]
                note = say("{other} is read as {name}", other=name, name=known)
                return replace(one, path=folder, names={known: file}, notes=(*one.notes, note))
            places = [(name, folder) for name, _, _ in tables]
        return replace(one, notes=(*one.notes, _no_answers(others, [name for name, _ in places], bad)), unread=True)

    def _places(
        self, folder: Path, others: Sequence[tuple[str, str, bool]]
    ) -> tuple[list[tuple[str, Path]], list[Caption]]:
        """Folders with answers, in the hand-in's own or in a zip there, by name; and what is wrong with a zip."""
        found: list[tuple[str, Path]] = []
        wrong: list[Caption] = []
        for name, file, inside in others[:MAX_SEARCHED_PLACES]:
            if inside:
                found += [(name, folder / file)] if answers_in(folder / file) else []
            elif name.lower().endswith(".zip"):
                place = self.scratch / str(len(os.listdir(self.scratch)))  # noqa: PTH208
                place.mkdir()
                try:
                    unpack_one(folder / file, place)
                except (TaskError, UnreadableError):
                    wrong.append(say("{name} is not a zip that can be unpacked", name=name))
                looked = [
                    (name, place),
                    *((f"{name}/{each}", place / each) for each, deeper in _entries(place) if deeper),
                ]
                within = [(where, path) for where, path in looked[:MAX_SEARCHED_PLACES] if answers_in(path)]
                found += within
                if not within:
                    # The next one finds the room again.
                    shutil.rmtree(place)
        return found, wrong

    def _tables(self, folder: Path, others: Sequence[tuple[str, str]]) -> list[tuple[str, str, str]]:
        """Tables with answers that are called otherwise: as handed in, by what they are read, as they are called."""
        found: list[tuple[str, str, str]] = []
        tables = [(name, file) for name, file in others if Path(name).suffix.lower() in TABLE_NAMES]
        for name, file in tables[:MAX_SEARCHED_PLACES]:
            known = TABLE_NAMES[Path(name).suffix.lower()]
            with suppress(UnreadableError):
                if answers_named(known, read_regular(folder / file, BYTE_LIMITS[known])) & set(self.answers):
                    found.append((name, known, file))
        return found


def _entries(folder: Path) -> list[tuple[str, bool]]:
    """What lies in a folder, by name, and whether it is a folder; of a link or what is no folder nothing."""
    if folder.is_symlink():
        return []
    with suppress(OSError), os.scandir(folder) as entries:
        return sorted((entry.name, entry.is_dir(follow_symlinks=False)) for entry in entries)
    return []


def _is_unknown_file(name: str) -> bool:
    """Whether a file or folder is none that is handed out, nor read anyway."""
    return not (
        name.startswith((".", "__MACOSX")) or name in (*HANDED_OUT_FILES, *SYSTEM_FILES) or answer_files([name])[0]
    )


def _no_answers(others: Sequence[tuple[str, bool]], places: Sequence[str], wrong: Sequence[Caption]) -> Caption:
    """The reason why nothing is read of a hand-in that has something."""
    if wrong:
        return wrong[0]
    if places:
        return say("answers are in several places, keep one: {places}", places=", ".join(places[:3]))
    listed = ", ".join(name for name, _ in others[:3])
    return say("no answers can be read from {files}", files=listed)
