"""The short commands: ``graphcam notebook``, ``bench``, ``sweep`` and ``init``."""

from contextlib import closing
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer
from typer import Option

from graphcam.cli.command_language import voice
from graphcam.cli.shared import (
    DEFAULT_FOLDER,
    TaskFile,
    echo,
    errors_name,
    input_errors,
    nonempty_place,
    path_argument,
    path_option,
    print_table,
    progress_bar,
    progress_lines,
    quoted,
    read_task,
)
from graphcam.files import OutputError, write_new
from graphcam.language import ENGLISH, language as language_of, languages
from graphcam.tasks.commented_task import commented_task
from graphcam.words import say


def notebook(
    task: TaskFile = None,
    out: Annotated[Path, path_option(metavar="DIR", help="Folder for the notebook and its task.")] = DEFAULT_FOLDER
    / "notebook",
    run: Annotated[bool, Option("--execute", help="Execute it, so that it contains its figures.")] = False,
    html: Annotated[bool, Option("--html", help="Execute it and make a web page of it in one file.")] = False,
    pdf: Annotated[bool, Option("--pdf", help="Execute it and print it as PDF with the installed Chromium.")] = False,
    language: Annotated[
        str | None, Option(metavar="NAME", help="Language of the captions, instead of the task's.")
    ] = None,
    course: Annotated[
        Path | None,
        path_option(
            metavar="DIR",
            help="Write the whole course for this task instead: the student's edition, and the teacher's with answers.",
        ),
    ] = None,
) -> None:
    """Write the step-by-step notebook of a task, or the course of notebooks for it.

    [bold]Examples[/bold]

    graphcam notebook

    graphcam notebook cam.toml --out lesson

    graphcam notebook cam.toml --out lesson --html --pdf

    graphcam notebook cam.toml --course course --html

    To execute it you need the extra "notebooks": in the folder of graphcam's source, pip install ".\\[notebooks]"
    """
    voice().choose(language)
    with input_errors():
        given = read_task(task)
        if language is not None:
            given = replace(given, drawing=replace(given.drawing, language=language))
        # Loads nbconvert: only when the input has been found right.
        from graphcam.notebooks.course_editions import write_course
        from graphcam.notebooks.notebook_folder import write_folder

        with errors_name(task):
            if course is not None:
                out = course
                files = write_course(given, out, html=html, pdf=pdf, progress=progress_lines(quiet=False))
            else:
                files = write_folder(given, out, run=run, html=html, pdf=pdf, progress=progress_lines(quiet=False))
    typer.echo(f"{out}: " + ", ".join(files))


def bench(
    quick: Annotated[
        bool, Option("--quick", help="Fewer and shorter measurements: about 40 s of processor time.")
    ] = False,
    hard: Annotated[
        bool, Option("--hard", help="Only show what is left of the digits in hard cases, computed and drawn.")
    ] = False,
    out: Annotated[Path, path_option(metavar="DIR", help="Folder for the report and its figures.")] = DEFAULT_FOLDER
    / "bench",
) -> None:
    """Report speed against error of drawn, sampled and exact methods and of the usual alternatives.

    [bold]Examples[/bold]

    graphcam bench --quick

    graphcam bench --hard

    graphcam bench --out bench
    """
    if hard:
        from graphcam.bench import hard_cases

        computed, drawn = hard_cases.computed_rows(), hard_cases.drawn_rows()
        print_table(hard_cases.COMPUTED_HEAD, computed, 2, title=f"\n{hard_cases.COMPUTED_TITLE}")
        print_table(hard_cases.DRAWN_HEAD, drawn, 2, title=f"\n{hard_cases.DRAWN_TITLE}")
        return
    from graphcam.bench import bench_report as bench

    with input_errors():
        report = bench.bench(bench.QUICK_EFFORT if quick else bench.FULL_EFFORT, out, progress_lines(quiet=False))
    for section, head, rows in report.tables():
        if section.brief:
            print_table(head, rows, section.words, title=f"\n{section.title}")
    typer.echo(f"{out}: " + ", ".join(bench.FILE_NAMES))


def sweep(
    space: Annotated[Path, path_argument(metavar="SPACE.toml", help="File with the values of every size.")],
    out: Annotated[
        str,
        Option(
            parser=nonempty_place,
            metavar="PLACE",
            help="Results, one row per design: a .csv or .parquet file, or a folder.",
        ),
    ],
    workers: Annotated[int, Option(min=1, help="Number of processes.")] = 1,
    cluster: Annotated[
        str, Option(metavar="ADDRESS", help="A dask scheduler, instead of processes on this machine.")
    ] = "",
) -> None:
    """Compute the extremes for every combination of sizes, and find the cams that satisfy the limits.

    At the end it shows how many cams satisfy the limits, the smallest of them, and the Pareto front of size and
    pressure angle, which is also written beside the results as a table and a figure.

    If PLACE is a folder, the workers write Parquet parts themselves; start an interrupted run again to resume it.

    [bold]Examples[/bold]

    graphcam sweep space.toml --out results.csv

    graphcam sweep space.toml --out results --workers 8

    graphcam sweep space.toml --out s3://bucket/results --cluster tcp://scheduler:8786
    """
    # Loads NumPy.
    from graphcam.cli.sweep_summary import print_sweep, write_front
    from graphcam.sweeps import dataset
    from graphcam.sweeps.dataset import is_file, sweep_to_file
    from graphcam.sweeps.design_space import load_space
    from graphcam.workers import executor_of, worker_pool

    with input_errors(), progress_bar(say("designs")) as step:
        designs = load_space(space)
        if is_file(out):
            if cluster:
                raise OutputError(out, say("a cluster writes a folder of parts"), say("leave out the ending"))
            with executor_of(workers) as executor:
                found = sweep_to_file(designs, out, executor, lambda done: step(done, len(designs)))
        else:
            with closing(worker_pool(workers, cluster, dataset.__name__)) as pool:
                found = dataset.sweep_to_folder(designs, out, pool, lambda done: step(done, len(designs)))
    if isinstance(found, dataset.Summary):
        print_table((say("quantity"), say("minimum"), say("maximum")), found.rows())
        echo(say("{out}: {found}", out=str(out), found=found.caption))
    print_sweep(designs, found)
    with input_errors():
        write_front(designs, out, found.front)


def init(
    file: Annotated[
        Path, path_argument(metavar="FILE", help="Name of the task file to write; the file must not exist yet.")
    ],
    space: Annotated[bool, Option("--sweep", help="Write a file for 'graphcam sweep' instead, in English.")] = False,
    language: Annotated[
        str, Option(metavar="|".join(languages()), help="Language of the explanations and of the sheet.")
    ] = ENGLISH.name,
) -> None:
    """Write the coursework task as a file in which every key is explained, for you to change.

    [bold]Examples[/bold]

    graphcam init cam.toml

    graphcam init cam.toml --language ru

    graphcam init space.toml --sweep
    """
    use, more = ("sweep", " --out results.csv") if space else ("solve", "")
    with input_errors():
        sweep_text = resources.files("graphcam").joinpath("data", "space.toml").read_text(encoding="utf-8")
        write_new(file, sweep_text if space else commented_task(language_of(language)))
    command = f"graphcam {use} {quoted(file)}{more}"
    echo(say("{file} is written; use it with: {command}", file=str(file), command=command))
