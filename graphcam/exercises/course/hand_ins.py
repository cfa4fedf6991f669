"""What lies in a folder of submissions: whose each folder or file is, and what is nobody's."""

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from graphcam.drafting.ink import Caption, say
from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.course.export_names import ExportName, export_name
from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.roster import read_roster


@dataclass(frozen=True)
class HandIn:
    """Where one student's answers lie.

    place : the name of the folder, or of the first file, which two never share
    path : a folder of the student's own, or the one that holds the student's files among those of others
    names : of files among those of others, by how each was called when it was handed in how it is called there
    notes : sentences for the teacher
    """

    student: str
    place: str
    path: Path
    names: Mapping[str, str] | None = None
    notes: tuple[Caption, ...] = ()


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
    known = _known(kept, roster)
    names = _names(folder, lambda name: bool(kept.find(kept.student(name))), lms=known is not None)
    if known is None:
        return sorted((_own(folder, kept.student(name), name) for name in names), key=_order), []
    return _assigned(folder, names, kept.student, known)


def _known(kept: AnswerKeys, roster: Path | None) -> Recognition | None:
    """The students of the course; None where nobody said who they are."""
    if roster is not None:
        return Recognition(read_roster(roster))
    return Recognition(kept.students()) if kept.course() else None


def _names(folder: Path, known: Callable[[str], bool], *, lms: bool) -> list[str]:
    """Names of what may be somebody's submission; ``lms`` takes the files of learning systems in."""
    try:
        with os.scandir(folder) as entries:
            listed = [(entry.name, entry.is_file(follow_symlinks=False)) for entry in entries]
    except OSError as error:
        why = error.strerror or "not there"
        raise TaskError(str(folder), "the folder", why, "one with a folder a student") from None
    return sorted(
        name
        for name, plain in listed
        if not name.startswith(".") and (not plain or known(name) or (lms and export_name(name) is not None))
    )


def _own(folder: Path, student: str, name: str) -> HandIn:
    return HandIn(student, name, folder / name)


def _order(one: HandIn) -> tuple[str, str]:
    return one.student, one.place


def _assigned(
    folder: Path, names: Iterable[str], student_of: Callable[[str], str], known: Recognition
) -> tuple[list[HandIn], list[Refused]]:
    """Each name's student, as far as there is exactly one."""
    refused: list[Refused] = []
    places: dict[str, list[tuple[str, ExportName | None]]] = {}
    for name in names:
        student, said = student_of(name), None
        if student not in known.ids:
            said = export_name(name)
            meant = known.meant([name, *(said.whose if said else ())])
            if len(meant) != 1:
                refused.append(Refused(name, _why(meant)))
                continue
            student = meant[0]
        places.setdefault(student, []).append((name, said))
    found: list[HandIn] = []
    for student, listed in places.items():
        if len(listed) == 1 and _is_folder(folder / listed[0][0], listed[0][1]):
            found.append(_own(folder, student, listed[0][0]))
        elif all(said and not _is_folder(folder / name, said) for name, said in listed):
            found += _files(folder, student, [(name, said) for name, said in listed if said])
        else:
            why = say("several of these are {student}'s; leave one", student=student)
            refused += [Refused(name, why) for name, _ in listed]
    return sorted(found, key=_order), sorted(refused, key=lambda one: one.place)


def _is_folder(path: Path, said: ExportName | None) -> bool:
    """Whether it counts as a folder of a student's own: also what stands in place of one, to be told about."""
    return said is None or path.is_dir() or not (said.file or said.attempt)


def _why(meant: list[str]) -> Caption:
    if meant:
        return say("it may be that of several students: {students}", students=", ".join(meant))
    return say("no student of the course has this id, address or name")


def _files(folder: Path, student: str, listed: list[tuple[str, ExportName]]) -> list[HandIn]:
    """One student's files among those of others: those of the last attempt."""
    last = max(said.attempt for _, said in listed)
    counted = {said.file: name for name, said in listed if said.attempt == last and said.file}
    attempts = {said.attempt for _, said in listed}
    notes = (
        (say("{count} attempts were handed in; the last one counts", count=len(attempts)),) if len(attempts) > 1 else ()
    )
    return [HandIn(student, listed[0][0], folder, counted, notes)]
