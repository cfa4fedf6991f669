"""``graphcam exercise read``: photographs of worksheets become answers that can be graded."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from graphcam.cli.shared import echo_line, named, one_message, progress_bar
from graphcam.words import say

SecretFile = Annotated[
    Path | None,
    Option(parser=named, metavar="F", help="The course's secret, if it is not in the course's folder 'teacher'."),
]


def read(
    photographs: Annotated[
        list[Path] | None,
        Argument(parser=named, metavar="[PHOTO]...", help="JPEG, PNG, HEIC, TIFF, PDF scans, or folders of them."),
    ] = None,
    *,
    course: Annotated[Path, Option(parser=named, metavar="DIR", help="The course, as 'exercise make' wrote it.")],
    secret_file: SecretFile = None,
    out: Annotated[
        Path | None, Option(parser=named, metavar="DIR", help="Folder for the readings, instead of DIR/photos.")
    ] = None,
    review: Annotated[
        Path | None,
        Option(parser=named, metavar="FILE.html", help="Write the page on which you check and correct the readings."),
    ] = None,
    corrections: Annotated[
        Path | None,
        Option(parser=named, metavar="FILE", help="File that this page exported; it is kept for later runs."),
    ] = None,
    workers: Annotated[
        int, Option(min=1, metavar="N", help="Number of processes; the default is one for each core.")
    ] = os.cpu_count() or 1,
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

    with one_message(), progress_bar(say("photographs")) as step:
        order = ReadingOrder(photographs or [], course, secret_file, out, review, corrections, workers)
        lines = list(summary(read_course(order, step)))
    for line in lines:
        echo_line(line)
