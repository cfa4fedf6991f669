"""The whole report: what is measured with how much effort, and its files."""

import csv
import json
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from graphcam import __version__
from graphcam.bench.bench_followers import BENCH_LAWS
from graphcam.bench.convergence import BOUNDS_SECTION, CONVERGENCE, PARTS
from graphcam.bench.exact_rows import EXACT_SECTION
from graphcam.bench.hand_errors import BUDGETS, PARTS as PENCIL_PARTS, PENCIL_ERRORS, PENCIL_SECTION
from graphcam.bench.load_rows import LOADS_SECTION
from graphcam.bench.measured_rows import MEASURED_SECTION
from graphcam.bench.peers import PEERS
from graphcam.bench.rows import Effort, Line, Section
from graphcam.bench.sweep_curve import CURVE_SECTION, DESIGN_COUNTS as SWEPT
from graphcam.bench.tradeoff import METHODS
from graphcam.bench.waiting_rows import DRAWING, STUDIO_SECTION, WAITING_SECTION
from graphcam.files import whole_folder
from graphcam.report.output_folder import ignore_progress
from graphcam.words import Words, say

ROWS = (EXACT_SECTION, LOADS_SECTION, BOUNDS_SECTION, MEASURED_SECTION, WAITING_SECTION, STUDIO_SECTION, CURVE_SECTION)
"""The sections of measured figures and goals."""
REPORT_SECTIONS = (CONVERGENCE, PENCIL_SECTION, BUDGETS, PENCIL_ERRORS, METHODS, *ROWS, PEERS, DRAWING)
"""All tables, in order."""
PARTS_BY_FOUR = (6, 12, 24, 48, 96, 384, 1536, 6144, 24576, 98304)
"""Parts, each time twice and then four times as many."""
PARTS_BY_THREE = (12, 36, 120, 360, 1080, 3240, 9720, 29160)
POLYGON_CORNERS = (24, 96, 360, 1440, 5760, 23040)
ALL_SIZES = {
    "graphical": PARTS_BY_FOUR,
    "profile": PARTS_BY_FOUR[:7],
    "integrators": PARTS_BY_FOUR,
    "half_planes": PARTS_BY_THREE,
    "optimiser": PARTS_BY_THREE[:4],
    "buffer": POLYGON_CORNERS,
}
REDUCED_SIZES = {"graphical": 8, "profile": 6, "integrators": 9, "half_planes": 6, "optimiser": 4, "buffer": 5}
"""How many of them are taken when it must be quick."""
FULL_EFFORT = Effort(PARTS, BENCH_LAWS, 2000, PENCIL_PARTS, ALL_SIZES, 100_000, 1_000_000, 0.2, SWEPT)
QUICK_EFFORT = replace(
    FULL_EFFORT,
    hands=1000,
    budget=0.02,
    swept=(),
    sizes={name: ALL_SIZES[name][:k] for name, k in REDUCED_SIZES.items()},
)

COLUMNS = (
    *("section", "subject", "law", "quantity", "n", "error", "error_unit", "ratio", "ratio_unit", "remark"),
    *("goal", "goal_met"),
)
"""The columns of the long table of numbers."""
FIGURE_NAMES = ("bench-parts", "bench-time", "bench-pencil")
FILE_NAMES = (
    "bench.md",
    "bench.csv",
    "bench.json",
    *(f"{name}.{kind}" for name in FIGURE_NAMES for kind in ("pdf", "png")),
)


@dataclass(frozen=True)
class Report:
    """Everything that was measured.

    pair : the time of one sine and one cosine on this machine [s], the unit of all times
    records : of each section, by its key
    """

    pair: float
    records: Mapping[str, tuple[Any, ...]]

    def tables(self) -> Iterator[tuple[Section, list[str], list[list[str]]]]:
        """Every section of which something was measured, with the head and the rows of its table."""
        for section in REPORT_SECTIONS:
            if found := self.records[section.key]:
                head, *rows = section.texts(found, self.pair)
                yield section, head, rows

    def markdown(self) -> str:
        """The report as a Markdown file."""
        parts = ["# Speed against error\n"]
        for section, head, rows in self.tables():
            rule = ["---"] * section.words + ["---:"] * (len(head) - section.words)
            cells = ([cell.replace("|", "\\|") for cell in row] for row in (head, rule, *rows))
            body = "\n".join(f"| {' | '.join(row)} |" for row in cells)
            note = section.note.format(pair_ns=1e9 * self.pair)
            parts.append(f"## {section.title}\n\n{note}\n\n{body}\n")
        return "\n".join(parts)

    def numbers(self) -> Iterator[Line]:
        """The lines of the long table."""
        for section in REPORT_SECTIONS:
            for record in self.records[section.key]:
                yield from ({"section": section.key, **line} for line in section.lines(record))

    def to_dict(self) -> dict[str, Any]:
        """Ratios and errors as plain data: times are in sine-cosine pairs, no seconds are kept."""
        told = {each.key: [each.to_dict(record) for record in self.records[each.key]] for each in REPORT_SECTIONS}
        drawing = told.pop(DRAWING.key)
        stages = {d["construction"]: d["steps"] for d in drawing if d["readings"] is None}
        rest = {"drawing": [d for d in drawing if d["readings"] is not None], "rendering": stages}
        unit = "one sine and one cosine of 1e5, in the same run"
        return _plain_data({"unit_of_time": unit, **told, **rest})


def measure(effort: Effort, progress: Callable[[Words], None]) -> Report:
    """The report of all that is measured."""
    pair, records = effort.pair, dict[str, tuple[Any, ...]]()
    for section in REPORT_SECTIONS:
        progress(section.title)
        records[section.key] = tuple(section.measured(effort))
    return Report(pair, records)


def bench(effort: Effort, directory: Path | str, progress: Callable[[Words], None] = ignore_progress) -> Report:
    """Measure drawn, sampled and exact side by side, and write tables, JSON and figures into a folder: all, or none.

    Raises
    ------
    OutputError : the folder cannot be written, which is said before anything is measured
    """
    # matplotlib takes long to load, so it comes when there is something to draw.
    from graphcam.bench import bench_figures as figures

    with whole_folder(directory) as folder:
        report = measure(effort, progress)
        progress(say("drawing the figures"))
        (folder / "bench.md").write_text(report.markdown(), encoding="utf-8", newline="\n")
        with (folder / "bench.csv").open("w", newline="", encoding="utf-8") as file:
            lines = csv.DictWriter(file, COLUMNS, restval="")
            lines.writeheader()
            lines.writerows(report.numbers())
        document = {"graphcam": __version__, **report.to_dict()}
        text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False)
        (folder / "bench.json").write_text(text + "\n", encoding="utf-8", newline="\n")
        shown = CONVERGENCE, PENCIL_SECTION, METHODS, PENCIL_ERRORS
        series, hands, methods, pencils = (report.records[each.key] for each in shown)
        figures.save(figures.error_against_parts, folder / "bench-parts", series)
        figures.save(figures.error_against_time, folder / "bench-time", methods, pencils, report.pair)
        figures.save(figures.error_of_the_hand, folder / "bench-pencil", hands)
    return report


def _plain_data(value: Any) -> Any:
    """Lists, dictionaries and numbers; None for what is not finite."""
    if isinstance(value, dict):
        return {str(key): _plain_data(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain_data(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
