"""The teacher's folder of a course: which exercise it is, in which language, and one answer key a student."""

from __future__ import annotations

import hashlib
import json
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from graphcam.errors import MissingFileError, TaskError, unreadable_error
from graphcam.exercises.course.roster import (
    MOODLE_ID_HEADING,
    Student,
    folder_name,
    id_heading,
    is_shortened,
    read_roster,
    student_of,
)
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.files import OutputError
from graphcam.language import ENGLISH
from graphcam.words import Caption, say, sequence

STUDENTS_FOLDER, TEACHER_FOLDER = "students", "teacher"
"""The two folders that 'exercise make' writes; the first may be handed out as it is."""
SUBMITTED_FOLDER = "submitted"
"""The folder where nbgrader collects: one for every student, and in it one for every assignment."""
PRINTED_FOLDER = "printed"
"""The teacher's folder of what a reader of photographs must know of the printed pages of every worksheet."""
COURSE_FILE = "course.json"
"""The teacher's file of what the course is about."""
ANSWER_KEYS_FOLDER = "certificates"
"""The folder of answer keys in the teacher's folder, or the hidden one."""
ROSTER_FILE = "roster.csv"
"""The teacher's copy of the roster that the course was made for."""
SECRET_FILE = "secret"
"""The teacher's file of the course's secret, if graphcam made it."""
KEYS_FILE = "keys.csv"
"""The teacher's table of all answer keys."""
HIDDEN_FOLDER = ".graphcam"
"""The folder of answer keys in a course made otherwise; no student's folder has a name that begins with a point."""


KEEP = say(
    "choose another folder; to keep the variants: --secret-file {secret}; do not delete {teacher}: without its secret "
    "nothing can be graded"
)


class CourseThereError(OutputError):
    """A folder that a course is to be made in, and that holds one.

    Whoever removes it loses the secret, so this is not advised.

    >>> print(CourseThereError("week-5"))
    week-5 already holds a course; choose another folder
    """

    def __init__(self, path: str | Path) -> None:
        teacher, remedy = Path(path, TEACHER_FOLDER), say("choose another folder")
        secret = teacher / SECRET_FILE
        if secret.is_file():
            remedy = KEEP.with_values(secret=str(secret), teacher=str(teacher))
        super().__init__(path, say("it already holds a course"), remedy)

    @property
    def fault(self) -> Caption:
        """What lies in the folder."""
        return say("{path} already holds a course", path=str(self.path))


@dataclass(frozen=True)
class AnswerKeys:
    """The answer keys kept in a folder."""

    folder: Path

    @staticmethod
    def of(course: Path) -> tuple[Path, AnswerKeys]:
        """The place of a course's submissions, and of its answer keys: beside them if graphcam made the course."""
        for submissions in (STUDENTS_FOLDER, SUBMITTED_FOLDER):
            # Students may have any name, and hand in what they like.
            if (course / submissions).is_dir() and (course / TEACHER_FOLDER / COURSE_FILE).is_file():
                return course / submissions, AnswerKeys(course / TEACHER_FOLDER)
        if _alone(course, STUDENTS_FOLDER):
            return course / STUDENTS_FOLDER, AnswerKeys(course / HIDDEN_FOLDER)
        beside = course.resolve().parent / TEACHER_FOLDER
        # What a learning system packed may have any name.
        if (beside / COURSE_FILE).is_file() or (
            course.resolve().name in (STUDENTS_FOLDER, SUBMITTED_FOLDER) and beside.is_dir()
        ):
            return course, AnswerKeys(beside)
        return course, AnswerKeys(course / HIDDEN_FOLDER)

    def find(self, student: str) -> str:
        """A student's answer key as JSON; empty where there is none."""
        try:
            return self._path(student).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError):
            return ""

    def student(self, place: str) -> str:
        """The student whose folder has this name; who had to be cut for it is named by the answer key."""
        if not is_shortened(place):
            return student_of(place)
        try:
            student = str(json.loads((self.folder / ANSWER_KEYS_FOLDER / f"{place}.json").read_bytes())["student"])
        except (OSError, ValueError, TypeError, KeyError):
            return student_of(place)
        return student if folder_name(student) == place else student_of(place)

    def students(self) -> list[Student]:
        """The students of the course: of the roster that was kept, or else those who have an answer key.

        Raises
        ------
        TaskError : the roster that was kept cannot be used any more
        """
        if (self.folder / ROSTER_FILE).is_file():
            return read_roster(self.folder / ROSTER_FILE)
        emails = self.course().get("emails", {})
        addresses = {student: email for email, student in emails.items()} if isinstance(emails, dict) else {}
        found = sorted(self.student(path.stem) for path in (self.folder / ANSWER_KEYS_FOLDER).glob("*.json"))
        return [Student(student, email=str(addresses.get(student, ""))) for student in found]

    def id_heading(self, roster: Path | None) -> str:
        """The heading of the ids in a roster, or else in the one that was kept; that of Moodle where there is none."""
        kept = roster or self.folder / ROSTER_FILE
        return (id_heading(kept) if kept.is_file() else "") or MOODLE_ID_HEADING

    def keep(self, student: str, answer_key: str) -> None:
        """Keep an answer key; it is there whole or not at all."""
        path = self._path(student)
        path.parent.mkdir(parents=True, exist_ok=True)
        # Two runs may keep the same one.
        draft = path.with_name(f"{path.name}.{os.getpid()}.new")
        draft.write_text(answer_key, encoding="utf-8", newline="\n")
        draft.replace(path)

    def keep_course(self, exercise: Path, secret: bytes, **said: Any) -> None:
        """Note what the course is about: a copy of the exercise's file, and what else is said, such as the language.

        Of the secret a part of a digest is noted, so that another one is not taken for it.

        A copy, so that the course can be graded wherever it goes, and after the library's exercise has changed.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / exercise.name).write_bytes(exercise.read_bytes())
        said = {"exercise": exercise.stem, "secret": _secret_digest(secret), **said}
        (self.folder / COURSE_FILE).write_text(json.dumps(said) + "\n", encoding="utf-8", newline="\n")

    def exercise(self) -> str:
        """What the course is about, as ``find_exercise`` takes it; or empty.

        Raises
        ------
        MissingFileError : it is an exercise of the teacher's own, whose file is gone
        """
        name = str(self.course().get("exercise", ""))
        copy = self.folder / f"{name}.toml"
        if name and not copy.is_file() and name not in library():
            # An exercise of the teacher's own: the library cannot replace it.
            raise MissingFileError(str(copy), say("put the exercise's file back there"))
        return str(copy) if copy.is_file() else name

    def check_secret(self, secret: bytes, path: str | Path) -> None:
        """Hold the secret against the course's: with another one, everybody's work would be that of a stranger.

        Raises
        ------
        TaskError : the course was made with another one
        """
        if self.course().get("secret", _secret_digest(secret)) != _secret_digest(secret):
            remedy = say("name the file that 'graphcam exercise make' or 'export' was given")
            expected = say("the one that the course was made with")
            raise TaskError(str(path), say("the secret"), say("another one"), expected, remedy)

    def secret_file(self, given: Path | None) -> Path:
        """The file of the course's secret: the one that is given, or else the one in this folder.

        Raises
        ------
        TaskError : none is given, and this folder holds none
        """
        path = self.folder / SECRET_FILE if given is None else given
        if given is None and not path.is_file():
            if self.folder.name == HIDDEN_FOLDER:
                remedy = say("name the file that the course was made with, by --secret-file")
                what = say("the course's secret")
                raise TaskError(str(self.folder.parent), what, say("missing"), say("given"), remedy)
            remedy = say("name the file that the course was made with, by --secret-file, or put a copy of it there")
            if (self.folder / KEYS_FILE).is_file():
                keys = say("{file} still has the keys for marking by hand", file=KEYS_FILE)
                remedy = sequence([remedy, keys], "; ")
            what = say("the course's secret")
            raise TaskError(str(path), what, say("missing"), say("in the teacher's folder"), remedy)
        return path

    def secret(self, given: Path | None) -> bytes:
        """The course's secret, from the file that is given or from the one in this folder.

        Raises
        ------
        TaskError : the file is missing or empty, or its secret is another course's
        """
        path = self.secret_file(given)
        secret = read_secret(path)
        self.check_secret(secret, path)
        return secret

    def course_exercise(self, named: str = "") -> Exercise:
        """The exercise in the language, for the hand and on the paper that the course is noted to be made for.

        named : another one than the course is noted to be about

        Raises
        ------
        GraphcamError : it is not there, or its file is wrong
        """
        noted = {"language": ENGLISH.name, "hand": "", "paper": ""} | self.course()
        return find_exercise(named or self.exercise(), *(str(noted[key]) for key in ("language", "hand", "paper")))

    def course(self) -> dict[str, Any]:
        """What is noted of the course; empty where nothing is."""
        try:
            said = json.loads((self.folder / COURSE_FILE).read_bytes())
        except (OSError, ValueError):
            return {}
        return said if isinstance(said, dict) else {}

    def _path(self, student: str) -> Path:
        return Path(f"{self.folder}/{ANSWER_KEYS_FOLDER}/{folder_name(student)}.json")


@dataclass(frozen=True)
class KeysAsNeeded(Mapping[str, AnswerKey]):
    """Answer keys by student, read one by one as they are needed: together they would fill the memory.

    Who has none that can be read is left out.

    kept : where they are;  students : whose
    """

    kept: AnswerKeys
    students: Sequence[str]

    def __getitem__(self, student: str) -> AnswerKey:
        try:
            return AnswerKey.from_json(self.kept.find(student))
        except TaskError:
            raise KeyError(student) from None

    def __iter__(self) -> Iterator[str]:
        return (student for student in self.students if student in self)

    def __len__(self) -> int:
        return sum(1 for _ in self)


def _alone(course: Path, name: str) -> bool:
    """Whether a folder of that name is the only one that can be seen in a course's: the teacher's is gone."""
    try:
        folders = [path.name for path in course.iterdir() if path.is_dir() and not path.name.startswith(".")]
    except OSError:
        return False
    return folders == [name]


def _secret_digest(secret: bytes) -> str:
    return hashlib.sha256(b"graphcam course" + secret).hexdigest()[:16]


def make_secret() -> bytes:
    """A new secret, which nobody can guess: 64 hexadecimal digits."""
    return secrets.token_hex(32).encode()


def write_secret(path: Path, secret: bytes) -> None:
    """Write a secret into a new file that nobody but its owner can read."""
    # Closed to others before it holds anything.
    path.touch(mode=0o600, exist_ok=False)
    path.write_bytes(secret + b"\n")


def read_secret(path: str | Path) -> bytes:
    """The secret of a course, without the end of its line.

    Raises
    ------
    TaskError : the file cannot be read, or it is empty
    """
    try:
        secret = Path(path).read_bytes().strip()
    except (OSError, ValueError) as error:
        remedy = say("name the file with the secret that the course was made with")
        raise unreadable_error(path, say("the secret"), say("a file that only you can read"), error, remedy) from None
    if not secret:
        remedy = say("write one into the file and keep it")
        raise TaskError(str(path), say("the secret"), say("empty"), say("a long random text"), remedy)
    return secret
