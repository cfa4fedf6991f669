"""Making an exercise for a course: the students' handouts in one folder, the teacher's in another."""

import csv
import math
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam.exercises.course.course_folder import ROSTER, STUDENTS, TEACHER, AnswerKeys, read_secret
from graphcam.exercises.course.handouts import key_rows, key_sheet, write_handouts
from graphcam.exercises.course.roster import Student, folder_name, read_roster
from graphcam.exercises.course.spreadsheet import cell
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.files import OutputError, whole_folder
from graphcam.language import languages
from graphcam.tasks.sheet_tables import one_of
from graphcam.workers import executor_of, in_order


def make(
    name: str,
    roster: str | Path,
    secret_file: str | Path,
    out: str | Path,
    *,
    language: str = "en",
    hand: str = "",
    workers: int = 1,
    cluster: str = "",
    step: Callable[[int, int], None] = lambda done, total: None,
) -> int:
    """Make every student's handouts; how many students there are.

    language : of all handouts, and noted for the feedback
    hand : of the students, by its name, and noted too; else as the exercise says
    workers, cluster : processes here, or the address of a dask scheduler, whose machines share no files with this one

    Raises
    ------
    GraphcamError : the exercise, the roster or the secret is not there, or the folder cannot be written
    OSError : no scheduler answers at the address
    """
    one_of("language", language, languages())
    exercise, students, secret = find_exercise(name, language, hand), read_roster(roster), read_secret(secret_file)
    out = Path(out)
    for part in (STUDENTS, TEACHER):
        if (out / part).exists():
            raise OutputError(out / part, "it is there already", "name a new folder, or remove that one first")
    with whole_folder(out) as draft, executor_of(workers, cluster) as executor:
        answer_keys: list[AnswerKey] = []
        variants = course_variants(exercise, (student.id for student in students), secret, executor)
        jobs = zip(students, variants, strict=True)
        for text, files in in_order(executor, papers, jobs):
            answer_keys.append(AnswerKey.from_json(text))
            for name_in_draft, data in files.items():
                path = draft / name_in_draft
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
            step(len(answer_keys), len(students))
        kept = AnswerKeys(draft / TEACHER)
        kept.keep_course(exercise_path(name), secret, version=exercise.version, language=language, hand=hand)
        # Who hands in is told by it, whatever a learning system calls the folders.
        (draft / TEACHER / ROSTER).write_bytes(Path(roster).read_bytes())
        _write_keys(draft / TEACHER / "keys.csv", exercise, answer_keys)
    return len(students)


def papers(job: tuple[Student, tuple[Variant, AnswerKey]]) -> tuple[str, dict[str, bytes]]:
    """One student's answer key as text, and the bytes of all files about the student by their paths in the course."""
    from graphcam.sheets.matplotlib_renderer import write_pdf

    student, (variant, answer_key) = job
    name, text = folder_name(student.id), answer_key.to_json()
    with TemporaryDirectory(prefix="graphcam-") as scratch:
        place = Path(scratch)
        theirs, key_sheets = place / STUDENTS / name, place / TEACHER / "keys"
        for folder in (theirs, key_sheets):
            folder.mkdir(parents=True)
        write_handouts(variant, student, theirs)
        write_pdf(key_sheet(variant, student, answer_key), key_sheets / f"{name}.pdf")
        AnswerKeys(place / TEACHER).keep(student.id, text)
        files = sorted(path for path in place.rglob("*") if path.is_file())
        return text, {path.relative_to(place).as_posix(): path.read_bytes() for path in files}


def _write_keys(path: Path, exercise: Exercise, answer_keys: list[AnswerKey]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, quoting=csv.QUOTE_ALL)
        head = ["student", "draw", "answer", "unit", "key", "tolerance", "marks", "tolerance_paper_mm", "bound"]
        table.writerow(head)
        for each in answer_keys:
            for row in key_rows(exercise, each):
                length = each.keys[str(row[0])].tolerance_paper
                paper = f"{length:.3f}" if math.isfinite(length) else ""
                table.writerow([cell(each.student), each.draw, *map(str, row), paper, f"{each.bound:.3f}"])
