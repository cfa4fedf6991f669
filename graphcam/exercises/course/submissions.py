"""What lies in a folder of submissions: whose each folder or file is, and what is nobody's.

Of several attempts of a student the newest counts that has answers.
"""

import os
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from graphcam.drafting.ink import Caption, say
from graphcam.errors import unreadable_error
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.roster import read_roster
from graphcam.exercises.reading.submission_files import answer_files, answers_in

MOODLE_PATTERN = re.compile(r"(?P<whose>.+)_\d+_assignsubmission_(?:file|onlinetext)(?:_(?P<file>.*))?", re.DOTALL)
"""Name_1234_assignsubmission_file_, a folder, or with the name of the file behind it; the number is nobody's id."""
BLACKBOARD_PATTERN = re.compile(
    r"(?P<whose>.+)_attempt_(?P<attempt>\d{4}(?:-\d\d){5})(?:_(?P<file>.+)|\.(?P<info>txt))?", re.DOTALL
)
"""Assignment_username_attempt_2026-11-20-12-30-00_answers.toml; the one that ends .txt tells about the attempt."""
CANVAS = re.compile(r"(?P<whose>[^_]+)(?:_LATE)?_(?P<number>\d+)_\d+_(?P<file>.+)", re.DOTALL)
"""lastfirst_12345_67890_answers.toml: the number of the user, then that of the submission."""


@dataclass(frozen=True)
class ExportName:
    """What the name of a folder or file says.

    whose : texts of which one is the student's id, address or name
    file : as it was called when it was handed in; empty of a folder, and of a file that holds no answers
    attempt : greater of a later one; empty where there is but one
    """

    whose: tuple[str, ...]
    file: str = ""
    attempt: str = ""


def export_name(name: str) -> ExportName | None:
    """What the name says; None of one that no learning system gives.

    >>> export_name("Anna Berg_1234_assignsubmission_file_")
    ExportName(whose=('Anna Berg',), file='', attempt='')
    >>> export_name("berganna_LATE_12345_67890_answers.toml")
    ExportName(whose=('berganna', '12345'), file='answers.toml', attempt='')
    >>> export_name("Cams_1_aberg_attempt_2026-11-20-12-30-00_answers.dxf").whose
    ('aberg', '1_aberg', 'Cams_1_aberg')
    >>> export_name("Anna Berg")
    """
    if found := MOODLE_PATTERN.fullmatch(name):
        return ExportName((found["whose"],), found["file"] or "")
    if found := BLACKBOARD_PATTERN.fullmatch(name):
        # Both the assignment and the user may have underscores in their names.
        parts = found["whose"].split("_")
        whose = tuple("_".join(parts[k:]) for k in reversed(range(len(parts))))
        return ExportName(whose, found["file"] or "", found["attempt"])
    if found := CANVAS.fullmatch(name):
        return ExportName((found["whose"], found["number"]), found["file"])
    return None


MAX_ATTEMPTS = 10
"""How many attempts of a student are looked into, the newest first: students may pack any number of them."""
ATTEMPT = re.compile(r"(?:attempt|попытка)[ _-]*0*([1-9]\d{0,3})", re.IGNORECASE)
"""A folder in a student's own that holds one of several attempts."""


@dataclass(frozen=True)
class HandIn:
    """A hand-in: the place of one student's answers.

    place : the name of the folder, or of the first file, which two never share
    path : a folder of the student's own, or the one that holds the student's files among those of others
    names : of files among those of others, by how each was called when it was handed in how it is called there
    notes : sentences for the teacher
    unread : it has files, and none that can hold answers; the last of the notes says why
    """

    student: str
    place: str
    path: Path
    names: Mapping[str, str] | None = None
    notes: tuple[Caption, ...] = ()
    unread: bool = False


@dataclass(frozen=True)
class Refused:
    """A folder or file that is not graded, and why."""

    place: str
    why: Caption


def hand_ins_in(folder: Path, kept: AnswerKeys, roster: Path | None = None) -> tuple[list[HandIn], list[Refused]]:
    """What was handed in, in the order of the students, and what is not graded.

    Whatever stands there but for plain files is somebody's submission, also a link or a pipe in place of a folder;
    names that begin with a point are not.

    kept : of the course; where none was made and no roster is given, every folder is that of the student of its name
    roster : of the students, instead of the one that was kept

    Raises
    ------
    TaskError : there is no such folder, or the roster cannot be used
    """
    known = course_students(kept, roster)
    names = _names(folder, lambda name: bool(kept.find(kept.student(name))), lms=known is not None)
    if known is None:
        found, refused = [_student_hand_ins(folder, kept.student(name), name) for name in names], list[Refused]()
    else:
        found, refused = _assigned(folder, names, kept.student, known)
    return sorted(found, key=lambda one: (one.student, one.place)), sorted(refused, key=lambda one: one.place)


def course_students(kept: AnswerKeys, roster: Path | None) -> Recognition | None:
    """The students of the course; None where nobody said who they are.

    Raises
    ------
    TaskError : the roster cannot be used
    """
    if roster is not None:
        return Recognition(read_roster(roster))
    return Recognition(kept.students()) if kept.course() else None


def _names(folder: Path, known: Callable[[str], bool], *, lms: bool) -> list[str]:
    """Names of what may be somebody's submission; ``lms`` takes the files of learning systems in."""
    try:
        with os.scandir(folder) as entries:
            listed = [(entry.name, entry.is_file(follow_symlinks=False)) for entry in entries]
    except OSError as error:
        raise unreadable_error(folder, say("the folder"), say("one with a folder for every student"), error) from None
    return sorted(
        name
        for name, plain in listed
        if not name.startswith(".") and (not plain or known(name) or (lms and export_name(name) is not None))
    )


def _student_hand_ins(folder: Path, student: str, name: str) -> HandIn:
    """What lies in a folder of a student's own: the newest of its attempts, or the answers that lie in it."""
    path = folder / name
    listed: list[tuple[str, bool]] = []
    # A link would lead into another student's folder.
    if not path.is_symlink():
        with suppress(OSError), os.scandir(path) as entries:
            listed = [(entry.name, entry.is_dir(follow_symlinks=False)) for entry in entries]
    numbered = [(int(found[1]), inner) for inner, inside in listed if inside and (found := ATTEMPT.fullmatch(inner))]
    if not numbered:
        return HandIn(student, name, path)
    # The files that were handed out, left empty, hide nothing.
    if answer_files(inner for inner, _ in listed)[0] and answers_in(path):
        note = say("the folders of attempts beside the answers are not read")
        return HandIn(student, name, path, notes=(note,))
    attempts = [inner for _, inner in sorted(numbered, reverse=True)]
    answered = next((inner for inner in attempts[:MAX_ATTEMPTS] if answers_in(path / inner)), None)
    chosen = answered or attempts[0]
    notes = _chosen_of(len(attempts)) if answered else ()
    return HandIn(student, f"{name}/{chosen}", path / chosen, notes=notes)


def _chosen_of(attempts: int) -> tuple[Caption, ...]:
    """What the teacher and the student are told of the attempt that was chosen."""
    said = say("{count} attempts were handed in; the last one with answers counts", count=attempts)
    return (said,) if attempts > 1 else ()


def answers_folder(one: HandIn, assignment: str) -> Path:
    """The folder in which the answers of a hand-in lie.

    assignment : name of the folder in the student's that counts if it is there, as nbgrader collects
    """
    within = one.path / assignment
    if one.names is None and os.path.isdir(within) and not os.path.islink(one.path):  # noqa: PTH112, PTH114
        # A link would lead into another student's folder; what may not be looked into is no folder, and no error here.
        return within
    return one.path


def _assigned(
    folder: Path, names: Iterable[str], student_of: Callable[[str], str], known: Recognition
) -> tuple[list[HandIn], list[Refused]]:
    """Each name's student, as far as there is exactly one."""
    refused: list[Refused] = []
    strays: list[str] = []
    places: dict[str, list[tuple[str, ExportName | None]]] = {}
    for name in names:
        student, said = student_of(name), None
        if student not in known.ids:
            said = export_name(name)
            meant = known.meant([name, *(said.whose if said else ())])
            if len(meant) != 1:
                if meant:
                    why = say("it may belong to several students: {students}", students=", ".join(meant))
                    refused.append(Refused(name, why))
                else:
                    strays.append(name)
                continue
            student = meant[0]
        places.setdefault(student, []).append((name, said))
    # Who has handed in is not looked for.
    missing = known.ids.keys() - places.keys()
    refused += [Refused(name, _nobodys(name, known, missing)) for name in strays]
    found: list[HandIn] = []
    for student, listed in places.items():
        if len(listed) == 1 and _is_folder(folder / listed[0][0], listed[0][1]):
            found.append(_student_hand_ins(folder, student, listed[0][0]))
        elif all(said and not _is_folder(folder / name, said) for name, said in listed):
            found.append(_files(folder, student, [(name, said) for name, said in listed if said]))
        else:
            why = say("several of these belong to {student}; keep one", student=student)
            refused += [Refused(name, why) for name, _ in listed]
    return found, refused


def _is_folder(path: Path, said: ExportName | None) -> bool:
    """Whether it counts as a folder of a student's own: also what stands in place of one, to be told about."""
    return said is None or path.is_dir() or not (said.file or said.attempt)


def _nobodys(name: str, known: Recognition, missing: Collection[str]) -> Caption:
    """The reason why a folder is nobody's, and whose it may have been meant for.

    missing : the students who have handed in nothing
    """
    near = known.nearest(name, missing)
    if near is None:
        return say("no student of the course has this id, address or name")
    return say(
        "no student of the course has this id, address or name; did you mean {student}?",
        student=f"{near.id} ({near.name})" if near.name else near.id,
    )


def _files(folder: Path, student: str, listed: list[tuple[str, ExportName]]) -> HandIn:
    """One student's files among those of others: those of the newest attempt that has answers."""
    attempts: dict[str, dict[str, str]] = {}
    for name, said in sorted(listed, key=lambda one: one[1].attempt, reverse=True):
        attempts.setdefault(said.attempt, {}).update({said.file: name} if said.file else {})
    made = list(attempts.values())
    answered = next((files for files in made[:MAX_ATTEMPTS] if answers_in(folder, files)), None)
    files = made[0] if answered is None else answered
    place = next(iter(files.values()), listed[0][0])
    return HandIn(student, place, folder, files, _chosen_of(len(made)) if answered else ())
