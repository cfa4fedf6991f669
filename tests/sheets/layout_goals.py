"""What the layout of sheets is measured by: order, empty room, widths of parts, labels, leaders, numbers of rays.

``PYTHONPATH=tests:tests/comparison python tests/sheets/layout_goals.py TASK.toml ...`` draws the sheets of tasks and
prints what each misses; without a task it takes those of ``tests/sheets/coursework`` and the built-in ones, with
``--random N`` also N tasks drawn at random, from the number that ``--first`` tells on.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
from overlaps import overlaps
from random_sheets import solved

import graphcam as gc
from graphcam.constructions.axes import broken_axis, part_names
from graphcam.drafting.marks import Points, Role
from graphcam.drafting.scale import Scale
from graphcam.given.motion import FULL_TURN
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.fewer_sheets import larger_paper
from graphcam.report.sheet_contents import Contents
from graphcam.sheets.model import Box, Drawing, Entity, Page, Strokes, Text
from graphcam.sheets.sampling import box_around, corners, linework, outermost, sampled
from graphcam.sheets.styles import BOLD
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.diagram_sizes import MIN_POLE, narrowest_part
from graphcam.solving.solution import Solution
from graphcam.solving.task_board import longest_axis
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_arcs_task, builtin_task

CELL = 4.0
"""The cells in which an empty rectangle is sought [mm]."""
MAX_EMPTY_SHARE = 0.2
"""The maximum empty rectangle of a page, as a part of its frame."""
MIN_PART_WIDTH = 4.0
"""The minimum width of a part of a phase [mm]."""
MAX_PARTS_ON_A4 = 24
"""With more parts than this on A4 they may be narrower.

So they may on any format that has no room for parts of this width, if a larger one, or fewer parts, are proposed.
"""
TANGLE_SIZE = 20.0
"""Crossings of leaders that are no farther apart are one tangle [mm]."""
MIN_CROSSING_LEADERS = 3
"""The number of leaders that make a tangle."""
INSIDE = 0.5
"""A label is in another view if its box is so deep in the convex outline of its lines [mm]."""


@dataclass(frozen=True)
class LayoutMeasures:
    """What was measured on the sheets of a task; every list is empty on a good one.

    early : pairs of views of which the second stands on a page before the first, which the work needs before it
    empty : of every page the part of its frame that its largest empty rectangle takes
    part_width : of the narrowest part of a phase [mm]
    trespassing : labels in other views, each with the view
    tangles : leaders that cross one another within a small place
    on_bold : texts on bold lines, on other texts, outside the frame
    unnumbered : rays without a number, of so many ``rays``
    """

    early: list[tuple[str, str]]
    empty: list[float]
    part_width: float
    trespassing: list[tuple[str, str]]
    tangles: list[str]
    on_bold: list[str]
    unnumbered: list[str]
    rays: int
    narrow_allowed: bool

    def missed(self) -> Mapping[str, object]:
        """The goals that are missed, by name, with what was found."""
        # What stands on the last of several pages need not fill it.
        counted = self.empty[:-1] if len(self.empty) > 1 else self.empty
        empty = [round(share, 2) for share in counted if share > MAX_EMPTY_SHARE]
        narrow = self.part_width if self.part_width < MIN_PART_WIDTH and not self.narrow_allowed else None
        found = {"order": self.early, "empty": empty, "parts": narrow, "labels": self.trespassing}
        found |= {"tangle": self.tangles, "bold": self.on_bold, "rays": self.unnumbered}
        return {name: each for name, each in found.items() if each}


def measured(solution: AnySolution) -> LayoutMeasures:
    """The measures of a solution's finished sheets."""
    contents = contents_of(solution)
    drawing = drawing_of(contents)
    texts = overlaps(drawing, BOLD)
    unnumbered, rays = _unnumbered_rays(contents, drawing)
    width, parts = _parts(solution)
    return LayoutMeasures(
        _early_views(contents, drawing),
        [empty_share(page) for page in drawing.pages],
        width,
        list(_trespassing(contents, drawing)),
        [tangle for page in drawing.pages for tangle in _tangles(page)],
        [f"{each.text!r} on {each.other!r}, page {each.page}" for each in texts],
        unnumbered,
        rays,
        (solution.task.drawing.format == "A4" and parts > MAX_PARTS_ON_A4)
        or (not _has_room_for_wide_parts(solution) and any(larger_paper(solution))),
    )


def _has_room_for_wide_parts(solution: AnySolution) -> bool:
    """Whether an axis of the cam angle with parts of the minimum width, and the shortest pole, fit a page."""
    if not isinstance(solution, Solution):
        return True
    board = solution.chain.board
    per_mm = narrowest_part(board.stations) / MIN_PART_WIDTH
    # The diagrams of what was measured show the whole turn.
    axis = broken_axis(board.motion, per_mm) if solution.task.motion.phases else Scale(per_mm, "rad")
    return float(axis.paper(FULL_TURN)) + MIN_POLE <= longest_axis(solution.task.drawing)


def _early_views(contents: Contents, drawing: Drawing) -> list[tuple[str, str]]:
    page_of = {name: k for k, page in enumerate(drawing.pages) for name in page.origins}
    order = [name for name in dict.fromkeys(step.view.name for _, _, step in contents.steps) if name in page_of]
    return [(a, b) for a, b in combinations(order, 2) if page_of[b] < page_of[a]]


def empty_share(page: Page) -> float:
    """The part of the frame that the largest empty rectangle takes."""
    entities = [e for group in page.groups for e in group.entities]
    lines = sampled(*linework(e for e in entities if not isinstance(e, Text)), CELL / 4)
    boxes = [box_around(corners(e)) for e in entities if isinstance(e, Text) and e.text]
    full = np.zeros((math.floor(page.height / CELL) + 1, math.floor(page.width / CELL) + 1), dtype=bool)
    lines = lines[(lines.real >= 0) & (lines.real < page.width) & (lines.imag >= 0) & (lines.imag < page.height)]
    full[(lines.imag / CELL).astype(int), (lines.real / CELL).astype(int)] = True
    for box in boxes:
        rows, columns = (
            slice(max(0, int(low / CELL)), int(high / CELL) + 1)
            for low, high in ((box.bottom, box.top), (box.left, box.right))
        )
        full[rows, columns] = True
    frame = page.frame
    inside = full[
        math.ceil(frame.bottom / CELL) : math.floor(frame.top / CELL),
        math.ceil(frame.left / CELL) : math.floor(frame.right / CELL),
    ]
    return _largest_empty(inside) * CELL**2 / frame.area


def _largest_empty(full: np.ndarray) -> int:
    """The number of cells of the largest rectangle of cells that are not full."""
    best, heights = 0, np.zeros(full.shape[1], dtype=int)
    for row in full:
        heights = np.where(row, 0, heights + 1)
        standing: list[tuple[int, int]] = []
        for k, height in enumerate([*heights.tolist(), 0]):
            start = k
            while standing and standing[-1][1] >= height:
                start, high = standing.pop()
                best = max(best, high * (k - start))
            standing.append((start, height))
    return best


def _parts(solution: AnySolution) -> tuple[float, int]:
    """The width of the narrowest part of a phase [mm], and the number of parts."""
    if "acceleration" not in solution.drawn:
        return math.inf, 0
    diagram = solution.drawn["acceleration"]
    stations = diagram.givens.stations
    widths = np.diff(diagram.acts["axis"].shown.real)[stations.left][~stations.blows]
    return float(widths.min()), widths.size


def _views(contents: Contents, page: Page) -> Mapping[str, list[Entity]]:
    """The entities of each view of a page."""
    named = {contents.as_one_part.group_name(number, name): step.view.name for number, name, step in contents.steps}
    found: dict[str, list[Entity]] = {}
    for group in page.groups:
        if group.name in named:
            found.setdefault(named[group.name], []).extend(group.entities)
    return found


def _trespassing(contents: Contents, drawing: Drawing) -> Iterator[tuple[str, str]]:
    """Labels whose box reaches into the lines of another view, and the view."""
    for page in drawing.pages:
        views = _views(contents, page)
        # A leader may lead out of its view: where it ends a label does.
        drawn = {
            name: linework(e for e in _without_leaders(entities) if not isinstance(e, Text))
            for name, entities in views.items()
        }
        bands = {name: list(_bands(lines)) for name, lines in drawn.items()}
        for name, entities in views.items():
            for text in (e for e in entities if isinstance(e, Text) and e.text):
                own, others = box_around(corners(text)), (other for other in bands if other != name)
                yield from ((text.text, other) for other in others if any(box.meets(own) for box in bands[other]))


def _bands(lines: tuple[Points, Points]) -> Iterator[Box]:
    """Level bands of a view's convex outline, without their edge: beyond it the box of the view is empty."""
    points = sampled(*lines, 1.0)
    if not points.size:
        return
    hull = outermost(points)
    steps = np.linspace(0.0, 1.0, 200)[:, None]
    outline = (hull + steps * (np.roll(hull, -1) - hull)).ravel()
    low, high = float(points.imag.min()), float(points.imag.max())
    for start, end in pairwise(np.linspace(low, high, max(2, math.ceil((high - low) / CELL))).tolist()):
        band = outline[(outline.imag >= start) & (outline.imag <= end)]
        if band.size and np.ptp(band.real) > 2 * INSIDE:
            yield Box(band.real.min() + INSIDE, start + INSIDE, band.real.max() - INSIDE, end - INSIDE)


def _without_leaders(entities: Sequence[Entity]) -> list[Entity]:
    leaders = {id(line) for line in _leaders(entities)}
    return [e for e in entities if id(e) not in leaders]


def _leaders(entities: Iterable[Entity]) -> list[Strokes]:
    """The lines that join labels and what they name: each follows its text."""
    return [
        line
        for text, line in pairwise(entities)
        if isinstance(text, Text) and isinstance(line, Strokes) and line.role == Role.DIMENSION
    ]


def _tangles(page: Page) -> Iterator[str]:
    """Places where three leaders or more cross one another."""
    ends = [(complex(line.starts[0]), complex(line.ends[0])) for g in page.groups for line in _leaders(g.entities)]
    crossings = [
        (at, pair) for pair in combinations(range(len(ends)), 2) if (at := _crossing(*ends[pair[0]], *ends[pair[1]]))
    ]
    while crossings:
        near = [pair for at, pair in crossings if abs(at - crossings[0][0]) <= TANGLE_SIZE]
        leaders = {k for pair in near for k in pair}
        if len(leaders) >= MIN_CROSSING_LEADERS:
            yield f"{len(leaders)} leaders at {crossings[0][0]:.0f}"
        crossings = [(at, pair) for at, pair in crossings if pair not in near]


def _crossing(a: complex, b: complex, c: complex, d: complex) -> complex | None:
    """Where the line from a to b crosses that from c to d; None if it does not."""
    along, other = b - a, d - c
    turn = (along.conjugate() * other).imag
    if not turn:
        return None
    share, second = (((c - a).conjugate() * way).imag / turn for way in (other, along))
    return a + share * along if 0 < share < 1 and 0 < second < 1 else None


RAYS = ("rays of v", "rays of s")
NAME = re.compile(r"(\d+)(′*)")


def _unnumbered_rays(contents: Contents, drawing: Drawing) -> tuple[list[str], int]:
    """The parts whose rays have no number where they are drawn, and the number of rays."""
    if "integration" not in contents.drawn:
        return [], 0
    integrated = contents.drawn["integration"]
    givens, names = integrated.givens, part_names(integrated.givens.stations)
    groups = {group.name: group for page in drawing.pages for group in page.groups}
    missing, rays = list[str](), 0
    steps = [(number, step) for number, name, step in contents.steps if name == "integration"]
    for index, act in enumerate(RAYS, 1):
        expected = [name for name, used in zip(names, givens.integrated_parts(index), strict=True) if used]
        found = [
            number
            for number, step in steps
            if any(
                act in {d.act.name for d in p.draws} | {d.act.name for r in p.rows for d in r.draws} for p in step.parts
            )
        ]
        if not expected or not found:
            continue
        group = groups[contents.as_one_part.group_name(found[0], "integration")]
        shown = {name for e in group.entities if isinstance(e, Text) for name in _named(e.text)}
        missing += [f"{name} ({act[-1]})" for name in expected if name not in shown]
        rays += len(expected)
    return missing, rays


def _named(text: str) -> Iterator[str]:
    """The parts that a number at a ray names, such as "1-3, 5′"."""
    for run in re.split(r", *|; *", text):
        ends = [NAME.fullmatch(end) for end in re.split("[-–]", run)]
        if all(ends) and len({end[2] for end in ends if end}) == 1:
            numbers = [int(end[1]) for end in ends if end]
            yield from (f"{k}{ends[0][2]}" for k in range(numbers[0], numbers[-1] + 1) if ends[0])


def solutions(files: Sequence[str], random: int, first: int = 0) -> Iterator[tuple[str, AnySolution]]:
    """The solutions of task files, or of the coursework and the built-in tasks; and of random tasks."""
    for file in files or sorted(map(str, Path(__file__).with_name("coursework").glob("*.toml"))):
        yield Path(file).stem, gc.solve(gc.load_task(file))
    if not files:
        for name in BUILTIN_TASK_NAMES:
            yield name, gc.solve(builtin_task(name))
        yield "arcs", gc.solve(builtin_arcs_task())
    yield from ((f"random {k}", solved(k)) for k in range(first, first + random))


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*")
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--all", action="store_true", help="tell all that is missed, not the first of each")
    asked = parser.parse_args()
    total: dict[str, int] = {}
    count = pages = rays = unnumbered = 0
    for name, solution in solutions(asked.tasks, asked.random, asked.first):
        found = measured(solution)
        count, pages, rays = count + 1, pages + len(found.empty), rays + found.rays
        unnumbered += len(found.unnumbered)
        empty = " ".join(f"{share:.2f}" for share in found.empty)
        print(f"{name}: {len(found.empty)} pages, empty {empty}, parts {found.part_width:.2f} mm")
        if found.part_width < MIN_PART_WIDTH and found.narrow_allowed:
            print("    narrow parts, for the format has no room for wider ones")
        for goal, what in found.missed().items():
            total[goal] = total.get(goal, 0) + 1
            said = what if asked.all or not isinstance(what, list) else f"{len(what)}: {what[:3]}"
            print(f"    {goal}: {said}", flush=True)
    print(
        f"{count} tasks, {pages} pages; rays without a number {unnumbered} of {rays}; tasks that miss",
        total or "nothing",
    )
    return bool(total)


if __name__ == "__main__":
    sys.exit(main())
