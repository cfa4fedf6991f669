"""A view as SVG, step by step: its frame, its lettering for the screen, and labels that stay while the hand is down."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import astuple, dataclass, replace
from hashlib import blake2b
from itertools import chain

from graphcam.drafting.ink import Step
from graphcam.drafting.marks import AngleMark, Dimension, Label, Mark, Role
from graphcam.errors import DesignError
from graphcam.sheets.formats import Lettering
from graphcam.sheets.labels import held_places, label_places, places_of, shading_parted, with_texts
from graphcam.sheets.mark_entities import Drawn, Placement, expand
from graphcam.sheets.model import Box, Entity, Group
from graphcam.sheets.player_svg import MM_PER_POINT, Numbers, group_svg
from graphcam.sheets.sampling import box_of
from graphcam.sheets.text_measures import points_size
from graphcam.sheets.view_panels import LABEL_MARGIN
from graphcam.studio.held_solutions import MAX_HEIGHT, HeldView
from graphcam.studio.view_steps import NamedStep
from graphcam.studio.views_request import USUAL_LETTER_PX, AskedView
from graphcam.words import Caption, Tell, say

LABEL_ROOM = 12.0
"""The room for labels around the drawing [mm]."""
INDEX_HEIGHT_SHARE = math.sqrt(0.5)
"""The height of an index, in heights of its letter."""
HEIGHT_STEP = 0.25
"""Letters grow in steps, so that they do not change with every pixel [mm]."""
LINE_ROOM, NUMBER_ROOM = 1.6, 3.8
"""Numbers of a plain view stand at least so far apart, one over another and side by side, in heights of a letter."""
PLAIN_ROLES = Role.SCALE, Role.RESULT, Role.LIMIT
"""Lines of a plain view."""
EMPTY_FRAME = Box(0.0, 0.0, 1.0, 1.0)
"""The frame of a view in which nothing is drawn."""


def screen_letters(paper: Lettering, px_per_mm: float, letter_px: float) -> Lettering:
    """The lettering of a view on the screen: as on paper, or larger where that could not be read.

    letter_px : no letter is smaller

    >>> screen_letters(Lettering(5.0, 3.5, 2.5), 4.0, 10.0)
    Lettering(title=5.0, label=3.5, small=2.5)
    """
    # What is asked for is the size of a font, which is more than the height of its capitals.
    font = points_size(1.0) * MM_PER_POINT
    small = letter_px / (font * px_per_mm)
    heights = (
        math.ceil(each / HEIGHT_STEP) * HEIGHT_STEP
        for each in (small / INDEX_HEIGHT_SHARE, small / INDEX_HEIGHT_SHARE, small)
    )
    return Lettering(*map(max, (paper.title, paper.label, paper.small), heights))


@dataclass(frozen=True, eq=False)
class DrawnView:
    """A view that is drawn.

    steps : with what each of them draws, in order
    kept : what the view keeps while the hand is down
    """

    steps: tuple[tuple[NamedStep, tuple[Entity, ...]], ...]
    kept: HeldView

    @property
    def frame(self) -> list[float]:
        """Left, top, width and height, y downwards [mm]."""
        box = Box(*self.kept.frame)
        return [round(each, 2) + 0.0 for each in (box.left, -box.top, box.width, box.height)]

    def svg(self, numbers: Numbers | None) -> dict[str, str]:
        """The elements of every step by its name.

        numbers : of the acts that they show, where these are told
        """
        drawn = ((each.id, Group(each.id, entities)) for each, entities in self.steps)
        return {name: group_svg(group, 0.0, numbers) if numbers else group_svg(group, 0.0) for name, group in drawn}


def drawn_view(
    steps: Sequence[NamedStep],
    constructions: tuple[tuple[str, ...], tuple[str, ...]],
    asked: AskedView,
    paper: Lettering,
    tell: Tell,
    held: HeldView | None,
    *,
    lowest: bool = True,
) -> DrawnView:
    """The view that is asked for, drawn from the steps.

    constructions : those that draw in it, and those that settle its scale
    paper : the lettering of the sheet
    held : what the view keeps, None where it is free
    lowest : whether no other stands under it

    Raises
    ------
    DesignError : it is larger than any sheet; while it is held nothing depends on how large it is
    """
    letters = screen_letters(paper, max(asked.px_per_mm, 0.01), asked.letter_px or USUAL_LETTER_PX)
    steps = (
        [replace(each, step=_plain(each.step, letters.small, lowest=lowest)) for each in steps]
        if asked.plain
        else steps
    )
    drawn = [_expanded(each.step, letters, tell, labelled=asked.labelled) for each in steps]
    names = [name for each in steps for name in label_names(each)] if asked.labelled else []
    former, room = held.places if held else {}, _room(drawn)
    places: list[int | None] = [*places_of(drawn, [], room)] if held is None else held_places(names, drawn, former)
    finished = shading_parted(with_texts(drawn, places))
    frame = held.frame if held else astuple(_frame(chain(*finished)))
    labels = label_places(names, drawn, places, former)
    standing = {name: _rounded(at.centre.real, at.centre.imag, at.angle) for name, at in labels.items()}
    kept = HeldView(frame, *constructions, standing)
    return DrawnView(tuple(zip(steps, finished, strict=True)), kept)


def _rounded(x: float, y: float, angle: float) -> tuple[float, float, float]:
    """The place of a label to a thousandth, which is not seen."""
    return round(x, 3) + 0.0, round(y, 3) + 0.0, round(angle, 3) + 0.0


def _expanded(step: Step, letters: Lettering, tell: Tell, *, labelled: bool) -> Drawn:
    """What a step draws.  A view of the studio stands alone, so the numbers of an axis stand under it."""
    entities, writings = expand((*step.marks, *step.under), Placement(0j), letters, tell)
    return entities, writings if labelled else []


def _plain(step: Step, letter: float, *, lowest: bool) -> Step:
    """The step without its construction: axes with one graduation, results and limits.

    letter : the height of the numbers [mm]; of those along an axis only so many are kept that they find room
    """
    kept, numbered = list[Mark](), list[complex]()
    marks = (*step.marks, *(step.under if lowest else ()))
    for mark in sorted(marks, key=lambda mark: abs(mark.at.imag) if isinstance(mark, Label) else 0.0):
        if mark.spare or not (mark.axis if isinstance(mark, Label) else getattr(mark, "role", None) in PLAIN_ROLES):
            continue
        if isinstance(mark, Label) and mark.small:
            # An ordinate is zero where it meets the other axis.
            zero = [] if mark.towards.imag else [complex(mark.at.real)]
            apart = [mark.at - other for other in (*zero, *numbered) if other != mark.at]
            if any(abs(d.imag) < LINE_ROOM * letter and abs(d.real) < NUMBER_ROOM * letter for d in apart):
                continue
            numbered.append(mark.at)
        kept.append(mark)
    return replace(step, marks=tuple(kept), under=())


def label_names(named: NamedStep) -> list[str]:
    """Names for the labels of a step that stay while its numbers change, in their order: "step|template|occurrence"."""
    taken = Counter[str]()
    found: list[str] = []
    for mark in (*named.step.marks, *named.step.under):
        if isinstance(mark, Label | Dimension | AngleMark):
            text = mark.text.template if isinstance(mark.text, Caption) else mark.text
            taken[text] += 1
            found.append(f"{named.id}|{text}|{taken[text]}")
    return found


def _room(drawn: Iterable[Drawn]) -> Box:
    """The box that no label leaves; it is looked through point by point, so it has an end."""
    lines = [entity for entities, _ in drawn for entity in entities]
    room = (box_of(lines) or EMPTY_FRAME).grown(LABEL_ROOM)
    if (largest := max(room.width, room.height)) > MAX_HEIGHT:
        remedy = say("take sizes of which none is so much greater than the others")
        found = say("{length:.0f} mm", length=math.ceil(largest))
        raise DesignError("drawing", found, say("at most {most:g} mm wide and high", most=MAX_HEIGHT), remedy)
    return room


def _frame(entities: Iterable[Entity]) -> Box:
    """The box of a whole view."""
    return (box_of(entities) or EMPTY_FRAME).grown(LABEL_MARGIN)


def digest(svg: str) -> str:
    """A short hash of a drawing, by which one of a step is told from another."""
    return blake2b(svg.encode(), digest_size=6).hexdigest()


def key_of(asked: AskedView) -> str:
    """What a view is kept by: with and without labels it has different frames."""
    kind = ", plain" if asked.plain else "" if asked.labelled else ", small"
    return asked.name + kind
