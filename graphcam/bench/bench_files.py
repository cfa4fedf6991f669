"""The report of speed against error: measured, and written with its figures."""

import csv
import json
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam import __version__
from graphcam.bench.bench_report import Effort, Report, measure
from graphcam.bench.bench_tables import markdown, numbers
from graphcam.bench.timing import Timer
from graphcam.files import whole_folder
from graphcam.report.documents import sheet_of
from graphcam.report.output_folder import unheard
from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task

FIGURES = ("bench-parts", "bench-time", "bench-pencil")
FILES = ("bench.md", "bench.csv", "bench.json", *(f"{name}.{kind}" for name in FIGURES for kind in ("pdf", "png")))


def bench(effort: Effort, directory: Path | str, progress: Callable[[str], None] | None = None) -> Report:
    """Measure drawn, sampled and exact side by side, and write tables, JSON and figures into a folder: all, or none.

    Raises
    ------
    OutputError : the folder cannot be written, which is said before anything is measured
    """
    # matplotlib takes long to load, so it comes when there is something to draw.
    from graphcam.bench.bench_figures import error_against_parts, error_against_time, error_of_the_hand, save

    progress = progress or unheard
    with whole_folder(directory) as folder:
        report = measure(effort, _rendering, progress)
        progress("drawing the figures")
        (folder / "bench.md").write_text(markdown(report), encoding="utf-8")
        with (folder / "bench.csv").open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(numbers(report))
        document = {"graphcam": __version__, **report.to_dict()}
        text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
        (folder / "bench.json").write_text(text + "\n", encoding="utf-8")
        for name, draw in zip(FIGURES, (error_against_parts, error_against_time, error_of_the_hand), strict=True):
            save(draw, report, folder / name)
    return report


def _rendering(timer: Timer) -> Mapping[str, float]:
    """Times [s] of laying out and rendering the sheet of the built-in task."""
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png

    once = Timer(timer.budget, least_runs=1)
    solution = solve(builtin_task())
    drawing = sheet_of(solution)
    with TemporaryDirectory() as folder:
        return {
            "layout": once.seconds(lambda: sheet_of(solution)),
            "PDF": once.seconds(lambda: write_pdf(drawing, Path(folder, "sheet.pdf"))),
            "PNG": once.seconds(lambda: write_png(drawing.pages[0], Path(folder, "sheet.png"))),
        }
