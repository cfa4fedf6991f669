"""How long constructions take to be drawn, and the sheet to be laid out and rendered."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam.bench.rows import Effort, Line, Section
from graphcam.bench.scenes import FOLLOWERS, scene
from graphcam.report.documents import sheet_of
from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task
from graphcam.words import say


@dataclass(frozen=True)
class DrawingTime:
    """Times of one construction in sine-cosine pairs; what it starts from is drawn before.

    readings : None for a stage of the sheet, which takes one time alone
    """

    follower: str
    construction: str
    readings: float | None
    steps: float


def drawing_times(effort: Effort, parts: int = 12, law: str = "3-4-5") -> Iterator[DrawingTime]:
    """Every construction of every follower; then laying out and rendering the sheet of the built-in task."""
    # matplotlib takes long to load, so it comes when there is something to draw.
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png

    for follower in FOLLOWERS:
        chain = scene(follower, law).chain(parts)
        for name in chain:
            # The function itself draws anew, from constructions that the chain keeps.
            readings, steps = effort.timer.seconds(chain.own[name], chain), effort.timer.seconds(chain[name].steps)
            yield DrawingTime(follower, name, readings / effort.pair, steps / effort.pair)
    once, solution = replace(effort.timer, least_runs=1), solve(builtin_task())
    drawing = sheet_of(solution)
    with TemporaryDirectory() as folder:
        for stage, seconds in (
            ("layout", once.seconds(sheet_of, solution)),
            ("PDF", once.seconds(write_pdf, drawing, Path(folder, "sheet.pdf"))),
            ("PNG", once.seconds(write_png, drawing.pages[0], Path(folder, "sheet.png"))),
        ):
            yield DrawingTime("sheet", stage, None, seconds / effort.pair)


def _texts(found: Sequence[DrawingTime], pair: float) -> Iterator[list[str]]:
    yield ["follower", "construction", "readings, ms", "steps, ms"]
    for d in found:
        times = ("" if pairs is None else f"{1e3 * pair * pairs:.3g}" for pairs in (d.readings, d.steps))
        yield [d.follower, d.construction, *times]


def _lines(d: DrawingTime) -> Iterator[Line]:
    of = {"subject": d.follower, "quantity": d.construction, "ratio_unit": "sine-cosine pairs"}
    if d.readings is not None:
        yield {**of, "section": "readings", "ratio": d.readings}
    yield {**of, "section": "rendering" if d.readings is None else "steps", "ratio": d.steps}


DRAWING = Section(
    "drawing",
    say("Readings, steps and rendering"),
    "Milliseconds on this machine, 12 parts per phase: for the readings, for the steps drawn from them, and for the "
    "whole sheet.",
    drawing_times,
    _texts,
    _lines,
    derived=(),
)
