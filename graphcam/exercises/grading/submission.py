"""Submissions: which folders there are, whose they are, and the bytes that lie in them."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from graphcam.drafting.ink import Caption
from graphcam.errors import TaskError
from graphcam.exercises.course.folder_names import student_of
from graphcam.exercises.reading.submission_files import read_files


@dataclass(frozen=True)
class Submission:
    """What one student handed in, as bytes: it can travel to another machine.

    student : any text
    place : the name of the folder, which two never share
    files : by name, those that can hold answers
    errors : sentences on files that could not be read
    answer_key : the student's answer key as JSON; empty where there is none yet
    """

    student: str
    place: str
    files: dict[str, bytes]
    errors: tuple[Caption, ...]
    answer_key: str = ""

    @property
    def digest(self) -> str:
        """Tells whether it is the same submission as before."""
        digest = hashlib.sha256()
        for error in self.errors:
            digest.update(hashlib.sha256(str(error).encode("utf-8", "surrogatepass")).digest())
        for name, data in sorted(self.files.items()):
            digest.update(name.encode() + hashlib.sha256(data).digest())
        return digest.hexdigest()


def students_in(
    folder: Path, student_of: Callable[[str], str] = student_of, known: Callable[[str], bool] = lambda student: False
) -> list[tuple[str, Path]]:
    """The students who handed in, in the order of their names, each with the folder.

    Whatever stands there but for plain files is somebody's submission, also a link or a pipe in place of a folder;
    names that begin with a point are not.

    student_of : whose a folder of this name is;  known : whether it is a student's, so that a plain file counts too

    Raises
    ------
    TaskError : there is no such folder
    """
    try:
        with os.scandir(folder) as entries:
            found = [Path(entry.path) for entry in entries if not _is_aside(entry, student_of, known)]
    except OSError as error:
        raise TaskError(
            str(folder), "the folder", error.strerror or "not there", "one with a folder a student"
        ) from None
    return sorted((student_of(path.name), path) for path in found)


def read_submission(student: str, folder: Path, answer_key: str = "", assignment: str = "") -> Submission:
    """The bytes of a student's folder, whatever it is.

    assignment : name of the folder in it that counts if it is there, as nbgrader collects
    """
    within = folder / assignment
    # A link would lead into another student's folder; what may not be looked into is no folder, and no error here.
    files, errors = read_files(within if os.path.isdir(within) and not os.path.islink(folder) else folder)  # noqa: PTH112, PTH114
    return Submission(student, folder.name, files, tuple(error.why for error in errors), answer_key)


def _is_aside(entry: os.DirEntry[str], student_of: Callable[[str], str], known: Callable[[str], bool]) -> bool:
    plain = entry.is_file(follow_symlinks=False)
    return entry.name.startswith(".") or (plain and not known(student_of(entry.name)))
