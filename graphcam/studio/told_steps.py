"""The steps of a view as plain data: captions, parts that light what they are found from, and readings."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from graphcam.drafting.acts import Act
from graphcam.drafting.moves import ActPlaces
from graphcam.report.sheet_contents import scales_found
from graphcam.report.step_player import drawn_in_parts, told
from graphcam.sheets.model import Source
from graphcam.sheets.player import PartText, Pieces, ReadingText, Slide
from graphcam.studio.view_steps import NamedStep, ViewSteps
from graphcam.words import Tell


@dataclass(frozen=True)
class SeenActs:
    """Numbers for the acts that can be seen: the same for the same task, whichever of its views are told."""

    numbers: Mapping[Act, int]

    def number(self, act: Act) -> int:
        """The number of an act, -1 for one that cannot be seen."""
        return self.numbers.get(act, -1)

    def piece(self, piece: ActPlaces) -> list[Any]:
        """Some places of an act: its number and theirs, None for all of them."""
        return [self.number(piece.act), None if len(piece.at) == piece.act.size else list(piece.at)]


@dataclass(frozen=True, eq=False)
class ToldSteps:
    """What is said of steps, by their running numbers, and the numbers of the acts that they show.

    headings : of views whose scales are found by drawing, without them, and the steps that find them
    """

    slides: Mapping[int, Slide]
    acts: SeenActs
    headings: Mapping[str, tuple[str, int]] = field(default_factory=dict[str, tuple[str, int]])
    in_parts: Collection[int] = field(default_factory=frozenset[int])

    def shown_by(self, source: Source) -> tuple[int | None, bool]:
        """The number of the act that an entity shows, and whether it is drawn in parts."""
        number = self.acts.numbers.get(source.of) if isinstance(source.of, Act) else None
        return number, number in self.in_parts

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


def told_steps(known: ViewSteps, views: Collection[str], tell: Tell) -> ToldSteps:
    """What is said of the steps in some views."""
    marks = (mark for each in known.steps for mark in each.step.marks)
    seen = dict.fromkeys(mark.of for mark in marks if isinstance(mark.of, Act))
    acts = SeenActs({act: number for number, act in enumerate(seen)})
    last = max((each.number for each in known.steps if each.step.view.name in views), default=0)
    steps = told(
        known.drawn,
        known.numbered,
        known.numbers,
        acts,
        tell,
        lambda step: step.view.name in views,
    )
    slides: dict[int, Slide] = {}
    for number, slide in steps:
        slides[number] = slide
        if number == last:
            break
    titles = {each.step.view.name: tell(each.step.view.title).replace("，", ", ") for each in known.steps}
    found = scales_found(known.drawn, known.numbered)
    headings = {view: (titles[view].partition(", ")[0], step) for view, step in found.items() if view in titles}
    return ToldSteps(slides, acts, headings, drawn_in_parts(slides.values()))


def _part(part: PartText) -> dict[str, Any]:
    """A part as plain data."""
    pieces = {name: _seen(getattr(part, name)) for name in ("draws", "lit", "moves")}
    return {"caption": part.caption, "tools": list(part.tools), **pieces, "views": list(part.views)}


def _reading(construction: str, reading: ReadingText) -> dict[str, Any]:
    """A reading as plain data."""
    table = [{**asdict(row), "lit": _seen(row.lit)} for row in reading.table]
    said = {"title": reading.title, "taken": reading.taken, "value": reading.value}
    return {"id": f"{construction}/{reading.name}", **said, "lit": _seen(reading.lit), "table": table}


def _seen(pieces: Iterable[list[Any]]) -> Pieces:
    """The pieces that can be seen."""
    return [piece for piece in pieces if piece[0] >= 0]
