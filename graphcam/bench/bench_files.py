"""The report as tables of texts and as one long table of numbers, and its files: measured, written with its figures."""

import csv
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from graphcam import __version__
from graphcam.bench.bench_report import SECTIONS, Effort, Report, measure
from graphcam.bench.hand_errors import SIGMA
from graphcam.bench.rows import BenchRow, Section, spoken_time
from graphcam.bench.timing import Timer
from graphcam.files import whole_folder
from graphcam.report.documents import sheet_of
from graphcam.report.output_folder import unheard
from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task
from graphcam.words import Words, say

NONE = "–"
Cell = str | int | float | None
FIGURES = ("bench-parts", "bench-time", "bench-pencil")
FILES = ("bench.md", "bench.csv", "bench.json", *(f"{name}.{kind}" for name in FIGURES for kind in ("pdf", "png")))


@dataclass(frozen=True)
class TextTable:
    """Texts in rows; the first ``words`` columns hold words, the others numbers; ``brief`` ones go to the terminal."""

    title: str
    note: str
    columns: tuple[str, ...]
    rows: list[list[str]]
    words: int = 1
    brief: bool = True


def tables(report: Report) -> list[TextTable]:
    """All tables of a report, in order."""
    figures = [_figures(section, report.rows[section.key]) for section in SECTIONS if report.rows[section.key]]
    of_hands = [_pencil(report), _budgets(report)]
    return [_convergence(report), *of_hands, _methods(report), *figures, _peers(report), _drawing(report)]


def markdown(report: Report) -> str:
    """The report as a Markdown file."""
    parts = ["# Speed against error\n"]
    for table in tables(report):
        rule = ["---"] * table.words + ["---:"] * (len(table.columns) - table.words)
        lines = [table.columns, rule, *table.rows]
        body = "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines)
        parts.append(f"## {table.title}\n\n{table.note}\n\n{body}\n")
    return "\n".join(parts)


HEAD = (
    *("section", "subject", "law", "quantity", "n", "error", "error_unit", "ratio", "ratio_unit", "remark"),
    *("goal", "goal_met"),
)


def numbers(report: Report) -> Iterator[list[Cell]]:
    """Head and rows of the long table; only the measured figures have a goal."""
    yield list(HEAD)
    for row in _without_goals(report):
        yield [*row, "", ""]
    for key, rows in report.rows.items():
        for r in rows:
            figures: list[Cell] = [None, r.error_eps, "eps", r.ratio, r.unit, "", r.goal, _said(r.goal_met)]
            yield [key, r.name, "", r.what, *figures]


def _without_goals(report: Report) -> Iterator[list[Cell]]:
    for s in report.series:
        remark = "exact" if s.exact else f"order {s.order}"
        for n, error in zip(s.parts, s.errors, strict=True):
            yield ["convergence", s.follower, s.law, s.quantity, n, error, "relative", None, "", remark]
    for h in report.hands:
        for n, mean, method in zip(h.parts, h.mean, h.method, strict=True):
            remark = f"of the method {method:.3g}" + (", best" if n == h.best else "")
            yield ["pencil", "translating", h.law, "displacement", n, mean, "of the lift", None, "", remark]
    for b in report.budgets:
        for kind, part in b.parts.items():
            named = f"{b.construction}: {b.reading}"
            yield ["budget", b.follower, "", named, None, part, "of the variance", None, "", kind]
    for m in report.methods:
        for n, pairs, error in zip(m.n, m.pairs, m.errors, strict=True):
            yield ["time", m.name, "", m.question, n, error, "relative", pairs, "sine-cosine pairs", m.kind]
    for p in report.peers:
        yield ["peers", p.package, "", p.quantity, None, p.error, p.unit, p.slower, "times graphcam's", p.reason]
    for d in report.drawing:
        yield ["readings", d.follower, "", d.construction, None, None, "", d.readings, "sine-cosine pairs", ""]
        yield ["steps", d.follower, "", d.construction, None, None, "", d.steps, "sine-cosine pairs", ""]
    for name, pairs in report.rendering.items():
        yield ["rendering", "sheet", "", name, None, None, "", pairs, "sine-cosine pairs", ""]


def _said(met: bool | None) -> str:
    return "" if met is None else "yes" if met else "no"


def _convergence(report: Report) -> TextTable:
    laws = list(dict.fromkeys(s.law for s in report.series))
    cells: dict[tuple[str, str], dict[str, str]] = {}
    for s in report.series:
        constant = np.format_float_positional(round(s.constant, 3), 2, fractional=False, unique=False, trim="-")
        text = "exact" if s.exact else f"{s.order:.2f} ({constant})" if s.order else NONE
        cells.setdefault((s.follower, s.quantity), {})[s.law] = text
    rows = [[*key, *(by_law.get(law, NONE) for law in laws)] for key, by_law in cells.items()]
    note = (
        "Drawn with an ideal pencil: the fitted order p of error ~ 1/n^p over n = 12, 24, 48, 96 parts per phase, and "
        "in brackets the maximum of n² times the relative error. A maximum is read off a faired curve between the "
        "stations: its error stays below the bracket over n² but oscillates, so its order is not a whole number."
    )
    return TextTable("Error against the number of parts", note, ("follower", "quantity", *laws), rows, 2)


def _pencil(report: Report) -> TextTable:
    rows = [
        [h.law, str(h.best), f"{100 * h.floor:.2f} %", f"{100 * h.band[0]:.2f} to {100 * h.band[1]:.2f} %"]
        for h in report.hands
    ]
    note = (
        "The maximum error of the displacement, as a part of the lift, over many drawings with errors of "
        f"{SIGMA} mm in every line, every setting and at the edge of the protractor: the number of parts at which its "
        "mean is smallest, this mean, and the range of nine drawings in ten. If the method draws a law exactly, the "
        "smallest number of parts is the best."
    )
    return TextTable("Drawing error", note, ("law", "best number of parts", "mean error", "nine drawings in ten"), rows)


def _budgets(report: Report) -> TextTable:
    rows: list[list[str]] = []
    for b in report.budgets:
        largest = sorted(b.parts.items(), key=lambda part: -part[1])
        brought = ", ".join(f"{kind} {100 * part:.0f}" for kind, part in largest if part >= LEAST_SHARE)
        rows.append([b.follower, f"{b.construction}: {b.reading}", f"{b.deviation:.3g}", brought])
    note = (
        f"With drawing errors of {SIGMA} mm, 12 parts per phase: the standard deviation in mm of paper (for a measured "
        "angle in radians), and the share of its variance, in percent, that is due to the acts of each kind; "
        '"together" is the share that errors of several kinds have only in combination.'
    )
    columns = ("follower", "reading", "scatter", "due to, %")
    return TextTable("Error budget of the drawing", note, columns, rows, 4, False)


LEAST_SHARE = 0.01
"""The smallest share of the variance that is listed."""


def _methods(report: Report) -> TextTable:
    rows = [
        [m.question, m.name, str(n), f"{pairs:.3g}", f"{error:.1e}"]
        for m in report.methods
        for n, pairs, error in zip(m.n, m.pairs, m.errors, strict=True)
    ]
    note = (
        "From the task to the result, including everything in between. Times are in pairs of a sine and a cosine: one "
        f"pair took {1e9 * report.pair:.1f} ns on this machine."
    )
    return TextTable(
        "Error against time", note, ("question", "method", "n", "time, pairs", "relative error"), rows, 2, False
    )


def _figures(section: Section, found: Sequence[BenchRow]) -> TextTable:
    rows: list[list[str]] = []
    for r in found:
        rounding = "" if r.error_eps is None else f"{r.error_eps:.1f}"
        ratio, here = f"{r.ratio:.3g} {r.unit}", spoken_time(r.seconds)
        rows.append([r.name, r.what, ratio, r.goal, _said(r.goal_met), here, rounding])
    columns = ("what", "of what", "ratio", "goal", "goal met", "here", "eps")
    return TextTable(section.title, section.note, columns, rows, 2)


def _peers(report: Report) -> TextTable:
    rows: list[list[str]] = []
    for p in report.peers:
        error = NONE if p.error is None else f"{p.error:.2g} {p.unit}"
        rows.append([p.package, p.quantity, p.reason, error, NONE if p.slower is None else f"{p.slower:.1f}"])
    note = (
        "On a cam of prime radius 60, offset 10, roller 12, lift 30, phases of 120, 30, 90 and 120 degrees, cycloidal "
        "rise, harmonic return. Time is a multiple of graphcam's for 360 stations."
    )
    return TextTable("Other packages", note, ("package", "quantity", "remark", "maximum error", "time ratio"), rows, 3)


def _drawing(report: Report) -> TextTable:
    def here(pairs: float) -> str:
        """Milliseconds."""
        return f"{1e3 * report.pair * pairs:.3g}"

    rows = [[d.follower, d.construction, here(d.readings), here(d.steps)] for d in report.drawing]
    rows += [["sheet", name, "", here(pairs)] for name, pairs in report.rendering.items()]
    note = (
        "Milliseconds on this machine, 12 parts per phase: for the readings, for the steps drawn from them, and for "
        "the whole sheet."
    )
    columns = ("follower", "construction", "readings, ms", "steps, ms")
    return TextTable("Readings, steps and rendering", note, columns, rows, 2)


def bench(effort: Effort, directory: Path | str, progress: Callable[[Words], None] | None = None) -> Report:
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
        progress(say("drawing the figures"))
        (folder / "bench.md").write_text(markdown(report), encoding="utf-8", newline="\n")
        with (folder / "bench.csv").open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(numbers(report))
        document = {"graphcam": __version__, **report.to_dict()}
        text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
        (folder / "bench.json").write_text(text + "\n", encoding="utf-8", newline="\n")
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
