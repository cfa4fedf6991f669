"""``graphcam bench``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from typer import Option

from graphcam.cli.shared import DEFAULT_FOLDER, one_message, print_table, progress_lines

DEFAULT_BENCH = DEFAULT_FOLDER / "bench"


def bench(
    quick: Annotated[bool, Option("--quick", help="Fewer and shorter measurements: half a minute.")] = False,
    out: Annotated[Path, Option(metavar="DIR", help="Folder for the report and its figures.")] = DEFAULT_BENCH,
) -> None:
    """Report speed against error: drawn, sampled and exact, beside what else one would use.

    [bold]Examples[/bold]

    graphcam bench --quick

    graphcam bench --out bench
    """
    from graphcam.bench import bench_report as report
    from graphcam.bench.bench_files import FILES, bench as measure
    from graphcam.bench.bench_tables import tables

    with one_message():
        measured = measure(report.QUICK if quick else report.FULL, out, progress_lines(quiet=False))
    for table in tables(measured):
        if table.brief:
            print_table(table.columns, table.rows, table.words, title=table.title, title_justify="left")
    typer.echo(f"{out}: " + ", ".join(FILES))
