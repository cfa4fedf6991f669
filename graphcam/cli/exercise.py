"""``graphcam exercise``: the commands about exercises."""

from __future__ import annotations

import json
import os
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from typer import Argument, Option

from graphcam.cli.command_language import translated, voice
from graphcam.cli.shared import (
    DEFAULT_FOLDER,
    echo,
    echo_line,
    input_errors,
    path_argument,
    path_option,
    print_table,
    progress_bar,
    progress_lines,
)
from graphcam.errors import TaskError, install_advice
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.running.isolation_levels import Level
from graphcam.language import languages
from graphcam.words import Caption, Words, say, say_many

if TYPE_CHECKING:
    from graphcam.exercises.marking.simulate import Simulation

SecretFile = Annotated[
    Path | None, path_option(metavar="F", help="The course's secret, if it is not in the course's folder 'teacher'.")
]
exercise = typer.Typer(
    name="exercise", no_args_is_help=True, help="Exercises that grade themselves: variants, marking, reports."
)
EarlierSecret = Annotated[
    Path | None, path_option(metavar="F", help="An earlier course's secret; by default a new one is made.")
]
CORE_COUNT = os.cpu_count() or 1
Workers = Annotated[int, Option(min=1, metavar="N", help="Number of processes; the default is one for each core.")]
Cluster = Annotated[str, Option(metavar="ADDRESS", help="A dask scheduler, instead of processes on this machine.")]
Hand = Annotated[
    str, Option(metavar="NAME", help="Students whose drawing errors set the tolerances: careful, usual or first-year.")
]
SECRET = b"simulation"
"""The secret of the simulated course, always the same, so that the figures repeat."""
Name = Annotated[str, Argument(metavar="NAME", help="Name of an exercise, or its file NAME.toml.")]


def _secret_advice(secret: Path) -> Caption:
    """The sentence that tells where a new secret is, and that it must be kept."""
    advice = say("Keep the folder 'teacher' safe and to yourself: without it nothing can be graded.")
    return say("{file} is new: the course's secret. {advice}", file=str(secret), advice=advice)


@exercise.command("list")
def list_exercises() -> None:
    """List the exercises that come with graphcam."""
    from graphcam.exercises.definition.exercise_file import find_exercise, library

    rows: list[list[str]] = []
    with input_errors():
        for name in library():
            found = find_exercise(name, voice().language.name)
            counts = (len(found.answers), f"{found.marks:g}", len(found.misconceptions))
            rows.append([name, found.title, *map(str, counts)])
    print_table((say("name"), say("title"), say("answers"), say("marks"), say("mistakes told")), rows, words=2)


@exercise.command("copy")
def copy_exercise(
    name: Annotated[str, Argument(metavar="NAME", help="Name of an exercise that 'graphcam exercise list' names.")],
    file: Annotated[Path, path_argument(metavar="FILE.toml", help="A new file.")],
) -> None:
    """Write the file of an exercise, as a start for one of your own.

    [bold]Examples[/bold]

    graphcam exercise copy integration mine.toml
    """
    from graphcam.exercises.definition.exercise_file import exercise_path
    from graphcam.files import write_new

    with input_errors():
        if file.suffix != ".toml":
            raise TaskError(str(file), say("the file"), say("none of TOML"), say("called NAME.toml"))
        write_new(file, exercise_path(name).read_text(encoding="utf-8"))
    echo(say("{file}: change it, then try it out with 'graphcam exercise simulate {file}'", file=str(file)))


@exercise.command()
def simulate(
    name: Name,
    variants: Annotated[int, Option(min=1, metavar="N", help="Number of variants.")] = 5,
    hands: Annotated[int, Option(min=1, metavar="N", help="Students per variant and mistake.")] = 400,
    as_json: Annotated[bool, Option("--json", help="Print only the figures, as JSON.")] = False,
    out: Annotated[Path | None, path_option(metavar="FILE", help="Write the JSON into a new file.")] = None,
    workers: Annotated[
        int, Option(min=1, metavar="N", help="Number of processes; the figures do not depend on it.")
    ] = 1,
    cluster: Cluster = "",
    hand: Hand = "",
) -> None:
    """Let simulated students do an exercise: some draw everything right, others make each catalogued mistake.

    [bold]Examples[/bold]

    graphcam exercise simulate pressure-angle

    graphcam exercise simulate whole-cam --variants 20 --json

    graphcam exercise simulate pressure-angle --hand first-year
    """
    from graphcam.exercises.definition.exercise_file import find_exercise
    from graphcam.exercises.marking.simulate import simulate as run
    from graphcam.files import check_new, write_new

    progress = progress_lines(quiet=as_json)
    with input_errors():
        if out:
            check_new(out)

        def step(done: int, total: int) -> None:
            """Show which variant has been simulated."""
            progress(say("variant {done} of {total}", done=done, total=total))

        found = run(find_exercise(name, hand=hand), SECRET, variants, hands, step, workers=workers, cluster=cluster)
        text = json.dumps(found.to_dict(), indent=2, allow_nan=False)
        if out:
            write_new(out, text + "\n")
    if as_json:
        typer.echo(text)
    else:
        _print_matrix(found)


def _print_matrix(found: Simulation) -> None:
    rows: list[list[str]] = []
    for name, row in found.rows.items():
        most = sorted(row.named.items(), key=lambda pair: -pair[1])
        named = ", ".join(f"{other} {count}" for other, count in most)
        rows.append([name, named, str(row.hands), str(row.accepted), f"{row.named_share(name):.1%}"])
    columns = (say("mistake made"), say("named"), say("submissions"), say("full marks"), say("named rightly"))
    print_table(columns, rows, words=2, title=say("{exercise}: what was named", exercise=found.exercise))
    draws, copies = say("{draws:.2f}, at most {most}", draws=found.draws, most=len(found.issued)), found.copies
    for counted, value in (
        (say("right work that loses any point, of {count}", count=found.careful), f"{found.false_rejections:.2%}"),
        *(
            (say("of it with {name} hands, of {hands}", name=name, hands=tally.hands), f"{tally.rate:.2%}")
            for name, tally in found.populations.items()
        ),
        (say("right work remarked on as exact as a program"), str(found.too_exact)),
        (say("wrong work that earns full marks"), f"{found.false_acceptances:.2%}"),
        (
            say(
                "mistakes not listed that show and earn full marks, of {count}",
                count=sum(found.unlisted.shown.values()),
            ),
            f"{found.unlisted_kept:.2%}",
        ),
        (say("mistakes named rightly"), f"{found.right_diagnoses:.2%}"),
        (say("mistakes that are not looked for, taken for another"), f"{found.outside_named:.2%}"),
        (say("marks earned at most by a copy of another variant, of {n}", n=copies.pairs), f"{copies.best:.0%}"),
        (say("copies of another variant that earn more than half"), f"{copies.part_above_half:.1%}"),
        (say("draws a variant, all {variants} separable", variants=found.variants), draws),
    ):
        typer.echo(f"{translated(counted)}: {translated(value)}")


@exercise.command()
def make(
    name: Name,
    roster: Annotated[
        Path, path_option(metavar="CSV", help="The students: ids in the column 'id', or else in the first column.")
    ],
    out: Annotated[Path, path_option(metavar="DIR", help="Folder for the handouts.")] = DEFAULT_FOLDER / "exercise",
    secret_file: EarlierSecret = None,
    language: Annotated[
        str, Option(metavar="|".join(languages()), help="Language of the handouts and of the feedback.")
    ] = "en",
    workers: Workers = CORE_COUNT,
    cluster: Cluster = "",
    hand: Hand = "",
    paper: Annotated[
        str,
        Option(
            metavar="P",
            help="A1, A3, A4 or A3-tiles, to be photographed, or unmarked; the default is A3 if the exercise has it.",
        ),
    ] = "",
    ink: Annotated[
        Literal["colour", "grey"], Option("--print", help="How the light lines of these worksheets are printed.")
    ] = "colour",
    studio: Annotated[
        str, Option(metavar="URL", help="Address of your studio; each student gets a link into it.")
    ] = "",
    studio_checks: Annotated[
        bool, Option("--studio-checks", help="Let the studio say right or wrong, by hashes, which a program can guess.")
    ] = False,
) -> None:
    """Make a variant for each student: notebook, worksheet and file for the answers; and the answer keys for you.

    [bold]Examples[/bold]

    graphcam exercise make pressure-angle --roster roster.csv --out week-5

    graphcam exercise make inversion-arm --roster roster.csv --out week-6 --paper A4 --print grey

    graphcam exercise make least-radius --roster roster.csv --out week-7 --studio https://course.example/studio/

    graphcam exercise make pressure-angle --roster longer.csv --out late --secret-file week-5/teacher/secret
    """
    from graphcam.exercises.course.course_folder import SECRET_FILE as SECRET_FILE, TEACHER_FOLDER
    from graphcam.exercises.course.course_making import UNMARKED_OPTION, make as run, usual_paper
    from graphcam.exercises.course.roster import ids_from
    from graphcam.exercises.exports.studio_link import check_url, write_links

    voice().adopt_language(language)
    progress = progress_lines(quiet=False)

    def step(done: int, total: int) -> None:
        """Show for which student files are being made."""
        progress(say("student {done} of {total}", done=done, total=total))

    def remark(line: Words) -> None:
        """Print what is odd about the course on standard error, beside its output."""
        typer.echo(translated(line), err=True)

    with input_errors():
        if studio:
            check_url(studio)
        chosen = usual_paper(name) if not paper else "" if paper == UNMARKED_OPTION else paper
        if not paper and chosen and find_spec("segno") is None:
            chosen = ""
            untagged = say("{name}: worksheets without tags; for such that can be photographed, {advice}")
            progress(untagged.with_values(name=name, advice=install_advice("photo")))
        papers = {"language": language, "hand": hand, "paper": chosen}
        told = ids_from(roster)
        count = run(
            name, roster, secret_file, out, **papers, ink=ink, workers=workers, cluster=cluster, step=step, tell=remark
        )
        if studio:
            write_links(out, secret_file, studio, checks=studio_checks)
    students = say_many("{count} student", "{count} students", count)
    echo(
        say("{out}: {students}, papers for students in 'students', yours in 'teacher'", out=str(out), students=students)
    )
    echo(told)
    if secret_file is None:
        echo(_secret_advice(out / TEACHER_FOLDER / SECRET_FILE))
    else:
        echo(say("{file} is a copy of {given}", file=str(out / TEACHER_FOLDER / SECRET_FILE), given=str(secret_file)))


@exercise.command()
def read(
    photographs: Annotated[
        list[Path] | None,
        path_argument(metavar="[PHOTO]...", help="JPEG, PNG, HEIC, TIFF, PDF scans, or folders of them."),
    ] = None,
    *,
    course: Annotated[Path, path_option(metavar="DIR", help="The course, as 'exercise make' wrote it.")],
    secret_file: SecretFile = None,
    out: Annotated[
        Path | None, path_option(metavar="DIR", help="Folder for the readings, instead of DIR/photos.")
    ] = None,
    review: Annotated[
        Path | None,
        path_option(metavar="FILE.html", help="Write the page on which you check and correct the readings."),
    ] = None,
    corrections: Annotated[
        Path | None, path_option(metavar="FILE", help="File that this page exported; it is kept for later runs.")
    ] = None,
    workers: Workers = CORE_COUNT,
) -> None:
    """Read photographs of a course's worksheets, with any file names; then grade DIR/photos.

    Each photograph is read once: an interrupted run continues where it stopped, and later photographs are added.  If
    you name no photographs, only the corrections are applied.

    [bold]Examples[/bold]

    graphcam exercise read telephone/ --course week-5 --review review.html

    graphcam exercise read --course week-5 --corrections photo-corrections.json

    graphcam exercise grade week-5/photos --out grades.csv --feedback pages
    """
    from graphcam.exercises.photographs.course_photographs import ReadingOrder, read_course, summary

    with input_errors(), progress_bar(say("photographs")) as step:
        order = ReadingOrder(photographs or [], course, secret_file, out, review, corrections, workers)
        lines = list(summary(read_course(order, step)))
    for line in lines:
        echo_line(line)


@exercise.command()
def grade(
    folder: Annotated[Path, path_argument(metavar="DIR", help="Folder with a folder for each student, or a zip file.")],
    out: Annotated[
        Path, path_option(metavar="CSV", help="File for the grades; reports of the same name are written beside it.")
    ],
    secret_file: SecretFile = None,
    exercise: Annotated[str, Option(metavar="NAME", help="The exercise, if 'exercise make' did not make DIR.")] = "",
    level: Annotated[Level, Option(help="Where the code of notebooks is run; at L0 no code is run.")] = Level.L0,
    seconds: Annotated[float, Option(min=0.1, help="Time limit in seconds for a notebook's code.")] = 10.0,
    workers: Workers = CORE_COUNT,
    cluster: Cluster = "",
    feedback: Annotated[
        Path | None, path_option(metavar="DIR", help="Folder for the feedback pages, one for each student.")
    ] = None,
    gradebook: Annotated[
        str, Option(metavar="URL", help="Also enter the scores into this database, such as sqlite:///gradebook.db.")
    ] = "",
    trusted: Annotated[
        bool, Option("--i-trust-these-students", help="Allow level L1, where code can change your files.")
    ] = False,
    roster: Annotated[
        Path | None, path_option(metavar="CSV", help="The students, instead of the roster the course was made for.")
    ] = None,
    overrides: Annotated[
        Path | None, path_option(metavar="CSV", help="Marks by hand, instead of overrides.csv in the teacher's folder.")
    ] = None,
    follow_through: Annotated[
        float | None,
        Option(
            metavar="PART",
            help="Part of an answer's marks for a correct follow-through from the student's own answers.",
        ),
    ] = None,
    near: Annotated[
        float | None, Option(metavar="K", help="An answer that is up to K tolerances off earns part of its marks.")
    ] = None,
    cap: Annotated[
        list[str] | None,
        Option(
            metavar="MISTAKE=PART",
            help="Maximum part of all marks with this mistake; repeat the option for more mistakes.",
        ),
    ] = None,
    anonymous: Annotated[
        bool,
        Option(
            "--anonymous", help="Pages show names made from the secret instead of ids; a table says whose they are."
        ),
    ] = False,
    show_right: Annotated[
        bool, Option("--show-right", help="Students' pages show the right answers; not before the last deadline.")
    ] = False,
    elsewhere: Annotated[str, Option("--deadline", "--late", "--attempts", hidden=True)] = "",
) -> None:
    """Grade the submissions of a course: answers.toml, .csv, .ipynb or .dxf in the folder of each student.

    Start an interrupted run again: it continues where it stopped.

    [bold]Examples[/bold]

    graphcam exercise grade week-5 --out grades.csv

    graphcam exercise grade week-5 --out grades.csv --level L2 --feedback pages

    graphcam exercise grade week-5 --out grades.csv --near 2 --cap offset-sign=0.5
    """
    # The parameters have the names of the order's fields.
    options = dict(locals())
    from graphcam.exercises.grading.course_grading import Course, grade_course

    with input_errors(), progress_bar(say("submissions")) as step:
        said = grade_course(Course(**options), step)
    for line in said:
        echo_line(line)


@exercise.command()
def export(
    name: Name,
    target: Annotated[LearningSystem, Option("--format", help="The system for which to export.")],
    count: Annotated[int, Option(min=1, max=1000, metavar="N", help="Number of variants.")] = 1,
    roster: Annotated[
        Path | None, path_option(metavar="CSV", help="The students: one variant for each, instead of --count.")
    ] = None,
    secret_file: EarlierSecret = None,
    language: Annotated[
        str, Option(metavar="|".join(languages()), help="Language of everything that students read.")
    ] = "en",
    out: Annotated[Path, path_option(metavar="DIR", help="A new folder for the export.")] = DEFAULT_FOLDER / "export",
    hand: Hand = "",
) -> None:
    """Export variants of an exercise for Moodle, Canvas, PrairieLearn, nbgrader, Gradescope or QTI 2.1.

    [bold]Examples[/bold]

    graphcam exercise export whole-cam --format moodle --count 20 --out moodle

    graphcam exercise export whole-cam --format moodle-cloze --count 20 --out cloze

    graphcam exercise export whole-cam --format canvas --roster roster.csv --out canvas

    graphcam exercise export whole-cam --format qti --count 20 --out qti

    graphcam exercise export whole-cam --format prairielearn --count 20 --out course

    graphcam exercise export whole-cam --format nbgrader --roster roster.csv --out course
    """
    from graphcam.exercises.course.course_folder import SECRET_FILE as SECRET_FILE, TEACHER_FOLDER, read_secret
    from graphcam.exercises.course.roster import Student, read_roster
    from graphcam.exercises.exports.export import export as write

    voice().adopt_language(language)
    with input_errors(), progress_bar(say("variants")) as step:
        secret = read_secret(secret_file) if secret_file else None
        students = [Student(f"variant-{k:0{len(str(count))}d}") for k in range(1, count + 1)]
        if roster:
            students = read_roster(roster)
        write(name, target, students, out, secret, step, language, hand)
    variants = say_many("{count} variant", "{count} variants", len(students))
    where = {"name": name, "target": str(target), "out": str(out)}
    echo(say("{variants} of {name} for {target} in {out}", variants=variants, **where))
    if secret_file is None:
        echo(_secret_advice(out / TEACHER_FOLDER / SECRET_FILE))


@exercise.command()
def speed(
    names: Annotated[
        list[str] | None, Argument(metavar="[NAME]...", help="Exercises or their files; the default is all.")
    ] = None,
) -> None:
    """Measure how long handouts take to make, and how many submissions one core grades in a second.

    Submissions are read and marked alone, and as a whole course with its files; simulated students submit answers.toml.

    [bold]Examples[/bold]

    graphcam exercise speed

    graphcam exercise speed inversion-translating
    """
    from graphcam.bench.timing import Timer
    from graphcam.exercises.definition.exercise_file import find_exercise, library
    from graphcam.exercises.grading.course_speed import course_speed, marking_speed

    progress, timer = progress_lines(quiet=False), Timer(budget=0.5)
    rows: list[list[str]] = []
    with input_errors():
        for name in names or library():
            progress(name)
            found, course = marking_speed(find_exercise(name), timer), course_speed(name)
            rates = (found.careful, found.wrong, course.graded)
            rows.append([found.exercise, *(f"{rate:.0f}" for rate in rates), f"{course.papers:.2f}"])
    heads = say("careful"), say("with a mistake"), say("with files"), say("papers, s")
    print_table((say("submissions a second, one core"), *heads), rows)
