"""The steps of a solution in their views, with names that no number and no language changes, and as plain data."""

import math
import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from graphcam.drafting.act_order import ActPlaces
from graphcam.drafting.acts import Act
from graphcam.drafting.ink import Construction, Step, View
from graphcam.drafting.scale import unit
from graphcam.errors import DesignError, choice_limit
from graphcam.report.sheet_contents import chapter_numbers, construction_named, names_of, scaled_steps, scales_found
from graphcam.report.step_player import drawn_in_parts, step_slides
from graphcam.sheets.layout import Numbered
from graphcam.sheets.player import Acts, PartText, Pieces, ReadingText, Slide
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import Caption, Tell, say

SHORT_VIEW_NAMES: Mapping[str, Caption] = {
    "scheme": say("Diagram"),
    "acceleration": say("a(φ)"),
    "velocity": say("v(φ)"),
    "displacement": say("s(φ)"),
    "measured acceleration": say("a(φ) measured"),
    "measured velocity": say("v(φ) measured"),
    "measured displacement": say("s(φ) measured"),
    "combined": say("Region"),
    "region": say("Region"),
    "plan": say("Plan"),
    "arm angles": say("Angles"),
    "angle": say("α(φ)"),
    "profile": say("Profile"),
    "curvature": say("Curvature"),
    "cam centre": say("Centre"),
    "forces": say("Forces"),
    "arcs": say("Arcs"),
    "roller": say("Roller"),
    "accelerations": say("Accelerations"),
}
"""What views are called where there is little room; one without a short name bears its title."""


@dataclass(frozen=True)
class ViewName:
    """What a view is called: its name, its title in whole and in short, and the number of its steps."""

    name: str
    title: str
    short: str
    steps: int


@dataclass(frozen=True, eq=False)
class NamedStep:
    """A step with its names.

    id : construction and title, as "minimum_radius/the-minimum-prime-radius"
    number : in order, from 1, of all steps that are drawn
    """

    id: str
    number: int
    construction: str
    step: Step


@dataclass(frozen=True, eq=False)
class ViewSteps:
    """The steps that are drawn, and what is known of them.

    drawn : the constructions by name;  steps : in order
    """

    drawn: Mapping[str, Construction]
    steps: tuple[NamedStep, ...]

    def of_view(self, name: str) -> list[NamedStep]:
        """The steps in a view."""
        return [each for each in self.steps if each.step.view.name == name]

    @property
    def numbered_steps(self) -> Numbered:
        """The steps with their running numbers and constructions."""
        return tuple((each.number, each.construction, each.step) for each in self.steps)

    @property
    def numbers(self) -> Mapping[int, str]:
        """The numbers within the task, such as "3.2", by the running ones."""
        return chapter_numbers(self.numbered_steps)

    @property
    def views(self) -> dict[str, View]:
        """The views by name, in order; of several titles of one view the last counts."""
        return {each.step.view.name: each.step.view for each in self.steps}

    def drawing_in(self, view: str) -> tuple[str, ...]:
        """The constructions that draw in a view."""
        return tuple(dict.fromkeys(each.construction for each in self.of_view(view)))

    def settling(self, view: str) -> tuple[str, ...]:
        """The constructions that settle the scale of the view."""
        return tuple(name for name, each in self.drawn.items() if view in each.meaning.scales)

    def ordinate(self, view: str, tell: Tell) -> dict[str, object] | None:
        """What a millimetre of paper stands for in a view, angles in degrees; None where no reading settles it."""
        if not (settling := self.settling(view)):
            return None
        construction = self.drawn[settling[0]]
        read = construction.readings[construction.meaning.scales[view]]
        if read.unit == "rad":
            return {"per_mm": math.degrees(read.per_mm), "unit": "°"}
        return {"per_mm": read.per_mm, "unit": tell(unit(read.unit))}

    def names(self, tell: Tell) -> tuple[ViewName, ...]:
        """What an answer says of every view."""
        counts = Counter(each.step.view.name for each in self.steps)
        return tuple(
            ViewName(name, tell(view.title), tell(SHORT_VIEW_NAMES.get(name, view.title)), counts[name])
            for name, view in self.views.items()
        )


def view_steps(
    solution: AnySolution,
    only: Collection[str] | None = None,
    silent: Collection[str] = (),
    upto: str | None = None,
) -> ViewSteps:
    """The steps of a solution.

    only : the constructions that are drawn, None for all;  silent : those of them whose steps are not asked for
    upto : the last construction that is shown, in the order in which they are told

    Raises
    ------
    DesignError : there is no such construction
    """
    names = names_of(solution)
    if upto is not None:
        if upto not in names:
            raise DesignError("upto", upto, *choice_limit(upto, names))
        names = names[: names.index(upto) + 1]
    drawn = {name: construction_named(solution, name) for name in names if only is None or name in only}
    return ViewSteps(drawn, tuple(named_steps(scaled_steps(drawn, silent))))


def named_steps(steps: Numbered) -> Iterable[NamedStep]:
    """The steps with their names, "-2" and "-3" behind those of steps alike in one construction."""
    taken = Counter[str]()
    for number, construction, step in steps:
        name = f"{construction}/{slug(step.title.template)}"
        taken[name] += 1
        again = f"-{taken[name]}" if taken[name] > 1 else ""
        yield NamedStep(name + again, number, construction, step)


def slug(template: str) -> str:
    """A title's template in letters that an address takes.

    >>> slug("Pole and rays, {source} to {target}")
    'pole-and-rays-source-to-target'
    """
    return re.sub(r"[^a-z0-9]+", "-", template.lower()).strip("-")


@dataclass(frozen=True)
class ActNumbering:
    """Numbers for the acts that can be seen: the same for the same task, whichever of its views are told."""

    numbers: Mapping[Act, int]

    def number(self, act: Act) -> int:
        """The number of an act, -1 for one that cannot be seen."""
        return self.numbers.get(act, -1)

    def piece(self, piece: ActPlaces) -> list[Any]:
        """Some places of an act: its number and theirs, None for all of them."""
        return [self.number(piece.act), None if len(piece.at) == piece.act.size else list(piece.at)]


@dataclass(frozen=True, eq=False)
class StepsData:
    """What is said of steps, by their running numbers, and the numbers of the acts that they show.

    headings : of views whose scales are found by drawing, without them, and the steps that find them
    """

    slides: Mapping[int, Slide]
    acts: Acts
    headings: Mapping[str, tuple[str, int]]

    def plain(self, step: NamedStep) -> dict[str, Any]:
        """What is said of a step as plain data."""
        slide = self.slides[step.number]
        heading, found = self.headings.get(step.step.view.name, ("", 0))
        return {
            "heading": heading if step.number < found else None,
            "number": slide.number,
            "chapter": slide.chapter,
            "title": slide.title,
            "caption": slide.caption,
            "why": slide.reason,
            "opens": slide.why,
            "parts": [_part(part) for part in slide.parts],
            "runs": [{**asdict(run), "widest": run.widest} for run in slide.runs],
            "readings": [_reading(step.construction, reading) for reading in slide.readings],
        }


def steps_data(known: ViewSteps, views: Collection[str], tell: Tell) -> StepsData:
    """What is said of the steps in some views."""
    marks = (mark for each in known.steps for mark in each.step.marks)
    seen = dict.fromkeys(mark.of for mark in marks if isinstance(mark.of, Act))
    acts = ActNumbering({act: number for number, act in enumerate(seen)})
    last = max((each.number for each in known.steps if each.step.view.name in views), default=0)
    asked = known.drawn, known.numbered_steps, known.numbers
    slides: dict[int, Slide] = {}
    for number, slide in step_slides(*asked, acts, tell, lambda step: step.view.name in views):
        slides[number] = slide
        if number == last:
            break
    titles = {each.step.view.name: tell(each.step.view.title).replace("，", ", ") for each in known.steps}
    found = scales_found(known.drawn, known.numbered_steps)
    headings = {view: (titles[view].partition(", ")[0], step) for view, step in found.items() if view in titles}
    return StepsData(slides, Acts(numbers=acts.numbers, in_parts=drawn_in_parts(slides.values())), headings)


def _part(part: PartText) -> dict[str, Any]:
    pieces = {name: _visible_pieces(getattr(part, name)) for name in ("draws", "lit", "moves")}
    return {"caption": part.caption, "tools": list(part.tools), **pieces, "views": list(part.views)}


def _reading(construction: str, reading: ReadingText) -> dict[str, Any]:
    table = [{**asdict(row), "lit": _visible_pieces(row.lit)} for row in reading.table]
    said = {"title": reading.title, "taken": reading.taken, "value": reading.value}
    return {"id": f"{construction}/{reading.name}", **said, "lit": _visible_pieces(reading.lit), "table": table}


def _visible_pieces(pieces: Iterable[list[Any]]) -> Pieces:
    return [piece for piece in pieces if piece[0] >= 0]
