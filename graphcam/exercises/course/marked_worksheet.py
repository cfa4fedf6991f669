"""A worksheet to be drawn on in pencil and photographed: light givens, room for all that is drawn, marks, and its code.

Ordinary sheets are laid out by :mod:`graphcam.sheets.layout`.  Here nothing may depend on what a student gets: every
view has its room, and every page the same places.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import AXIS_OVERHANG, ordinate_title
from graphcam.constructions.chain import Chain
from graphcam.constructions.views import ANALYSIS, PROFILE, at_scale
from graphcam.drafting.marks import Mark, Points
from graphcam.errors import DesignError
from graphcam.exercises.course.handouts import Sheets, answer_table, instructions
from graphcam.exercises.course.page_parts import (
    TextColumn,
    bar_captions,
    captions,
    code_group,
    code_side,
    mark_group,
    paragraphs,
    upright_text,
)
from graphcam.exercises.course.roster import Student
from graphcam.exercises.course.sheet_code import SheetCode
from graphcam.exercises.definition.blank_axes import AXES_ROOM, marked_axes, room_of
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of
from graphcam.exercises.definition.exercise import Diagram, Exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.photo.printed_page import Edges, Ink, PrintedPage, PrintedView
from graphcam.sheets.formats import Format, Lettering
from graphcam.sheets.labels import lettered_steps
from graphcam.sheets.mark_entities import Placement, expand
from graphcam.sheets.marked_paper import BAR_ROOM, MARKED_PAPERS, PATCH_SIDE, TITLE_ROOM, MarkedPaper, in_tiles
from graphcam.sheets.model import (
    ArcEntity,
    Box,
    Circles,
    Curve,
    Drawing,
    Entity,
    Group,
    Page,
    Stroke,
    Text,
    bounding_box,
)
from graphcam.sheets.sampling import box_of, pieces
from graphcam.sheets.styles import LIGHT_ROLES
from graphcam.sheets.tables import Block, table_blocks
from graphcam.words import Caption, Tell, say

AXIS_TIP_MARGIN = 1.0
"""The room beyond the tip of the axis of the cam angle, mm."""


@dataclass(frozen=True, eq=False)
class MarkedView:
    """A view about its origin.

    name : as in ``Page.origins``
    room : the box that is kept for what is drawn, nothing black in it
    marks : the givens
    title : said above it, or beside one that is a diagram
    end_title : said at the end of a diagram's axis
    turn : the length of a diagram's axis [mm], 0 where a curve runs round the origin
    """

    name: str
    room: Box
    marks: tuple[Mark, ...]
    title: str
    end_title: str = ""
    turn: float = 0.0

    def printed(self, origin: complex) -> PrintedView:
        """The view as it is printed on its page."""
        room = self.room.moved(origin)
        edges = room.left, room.bottom, room.right, room.top
        return PrintedView(origin, edges, closed=not self.turn, end=self.turn)


def marked_views(exercise: Exercise, chain: Chain, side: float, tell: Tell) -> list[MarkedView]:
    """The views of an exercise's worksheet: its diagrams in order, and the profile or the given cam.

    side : of the room of the cam [mm]

    Raises
    ------
    DesignError : the worksheet shows a view for which no room is known
    """
    steps = [step for name, count in exercise.sheet.items() for step in construction_of(chain, name).steps()[:count]]
    cams = {PROFILE.name: PROFILE, ANALYSIS.name: ANALYSIS}
    for step in steps:
        if step.view.name not in cams:
            limit = say("the profile, a given cam and empty axes alone where worksheets are photographed")
            raise DesignError("sheet", step.view.name, limit, say("leave papers out"))
    views = [_diagram(exercise, chain, name, tell) for name in exercise.axes]
    for name, cam in cams.items():
        marks = tuple(mark for step in steps if step.view.name == name for mark in step.translated(tell).marks)
        if marks:
            # In the room for which its scale was chosen, whatever the cam.
            room = Box(-side / 2, -side / 2, side / 2, side / 2)
            views.append(MarkedView(name, room, marks, tell(at_scale(cam, chain.profile_scale).title)))
    return views


def _diagram(exercise: Exercise, chain: Chain, name: Diagram, tell: Tell) -> MarkedView:
    """Empty axes that reach up to the edges of their room; what they are called stands outside."""
    (low, high), (view, marks, before) = room_of(exercise, name), marked_axes(exercise, chain, name)
    mu_phi = chain.board.mu_phi
    turn = 2 * np.pi / mu_phi.per_mm
    room = Box(-before, low, turn + AXIS_OVERHANG + AXIS_TIP_MARGIN, high)
    unit = ordinate_title(AXES_ROOM[name][0], chain.board.follower.unit)
    title = tell(say("{title}: {unit}", title=view.title, unit=unit))
    scale = tell(say("φ, °; μᵩ = {mu:.4g}°/mm", mu=np.degrees(mu_phi.per_mm)))
    return MarkedView(view.name, room, marks, title, scale, turn)


Polyline = NDArray[np.complex128]


def black_boxes(groups: Iterable[Group]) -> list[Edges]:
    """Boxes about all that is printed in black."""
    light = set(LIGHT_ROLES.values())
    boxes = [box_of([e]) for group in groups for e in group.entities if e.role not in light]
    return [(box.left, box.bottom, box.right, box.top) for box in boxes if box is not None]


def polylines(entities: Iterable[Entity]) -> list[Polyline]:
    """The lines of entities, texts left out.

    >>> [line.tolist() for line in polylines([Stroke(np.array([0, 2, 2j]), "light grey", closed=True)])]
    [[0j, (2+0j), 2j, 0j]]
    """
    return [np.asarray(line, dtype=np.complex128) for entity in entities for line in _lines(entity)]


def _lines(entity: Entity) -> Iterable[Points]:
    match entity:
        case Text():
            return []
        case Stroke(closed=False):
            return [entity.points]
        case Stroke() | Curve():
            return [_closed(entity.points)]
        case ArcEntity():
            starts, ends = pieces(entity)
            return [np.append(starts, ends[-1:])]
        case Circles(centres=centres):
            starts, _ = pieces(entity)
            return [_closed(ring) for ring in starts.reshape(len(centres), -1)]
        case _:
            return np.column_stack(pieces(entity))


def _closed(points: Points) -> Points:
    return np.append(points, points[:1])


BLOCK_GAP = 3.0
"""The gap between views, and between blocks of text, mm."""
TAG_GAP = 1.5
"""The gap between the white about a tag and a line beside it, mm."""
TEXT_GAP = 5.0
"""The gap between a view and the text beside it, mm."""
ROW_HEIGHT = 2.8
"""Height of the rows of the answers, in heights of the letters: wide enough for handwriting."""
DRAWING_ADVICE = say(
    "Draw in pencil. Write down the length of each scale bar on your print, to half a millimetre. Draw nothing "
    "on the black squares or the code. Photograph each page from above, with all its edges."
)

CROSSES_ADVICE = say("Mark each point with a cross of 3 mm; crosses must not touch.")
TAPE_ADVICE = say("First lay the two halves edge to edge and tape them together on the back.")


@dataclass(frozen=True, eq=False)
class PlacedView:
    """A view with its origin on its page."""

    view: MarkedView
    origin: complex

    @property
    def room(self) -> Box:
        """The room of the view on the page."""
        return self.view.room.moved(self.origin)

    @property
    def box(self) -> Box:
        """The room of the view with that for its titles."""
        room = self.room
        if self.view.turn:
            return Box(room.left - TITLE_ROOM, room.bottom, room.right + TITLE_ROOM, room.top)
        return Box(room.left, room.bottom, room.right, room.top + TITLE_ROOM)


def marked_sheets(
    variant: Variant, student: Student, secret: bytes, paper: str, ink: Ink
) -> tuple[Sheets, list[PrintedPage]]:
    """The worksheet with the sheets as one draws on them in CAD, every page whole."""
    whole, pages = _one_sheet_each(variant, student, secret, paper, ink)
    seam = MARKED_PAPERS[paper].seam
    return Sheets(whole if seam is None else in_tiles(whole, seam), whole), pages


def _one_sheet_each(
    variant: Variant, student: Student, secret: bytes, paper: str, ink: Ink
) -> tuple[Drawing, list[PrintedPage]]:
    marked, exercise = MARKED_PAPERS[paper], variant.exercise
    views = marked_views(exercise, board_chain(variant.task), marked.square, exercise.tell)
    pages = _placed_views(views, marked)
    maker = _PageMaker(variant, student, secret, marked, ink)
    # The text comes before the table, and where one finds no room the next must wait too.
    blocks, drawn = maker.blocks(pages), list[tuple[list[PlacedView], list[Entity]]]()
    for k, placed in enumerate(pages):
        entities, blocks = maker.column(placed, k + 1).fill(blocks, BLOCK_GAP)
        drawn.append((placed, entities))
    while blocks:
        entities, left = maker.column([], len(drawn) + 1).fill(blocks, BLOCK_GAP)
        if len(left) == len(blocks):
            limit = say("short enough for a page of {paper}", paper=paper)
            remedy = say("shorten them, or take a larger paper")
            raise DesignError(say("the text with the answers"), say("too long"), limit, remedy)
        blocks = left
        drawn.append(([], entities))
    made = [maker.page(placed, entities, k, len(drawn)) for k, (placed, entities) in enumerate(drawn, 1)]
    return Drawing(exercise.title, tuple(page for page, _ in made)), [printed for _, printed in made]


def _placed_views(views: Sequence[MarkedView], paper: MarkedPaper) -> list[list[PlacedView]]:
    """The views on their pages, diagrams one under the other as long as there is room."""
    stacks = list[list[MarkedView]]()
    for view in views:
        if view.turn and stacks and stacks[-1][0].turn and _height([*stacks[-1], view]) <= paper.free_box.height:
            stacks[-1].append(view)
        else:
            stacks.append([view])
    return [_stacked_views(stack, paper) for stack in stacks]


def _height(stack: Sequence[MarkedView]) -> float:
    """The height of views one under the other, without a title above."""
    return sum(view.room.height for view in stack) + BLOCK_GAP * (len(stack) - 1)


def _stacked_views(stack: Sequence[MarkedView], paper: MarkedPaper) -> list[PlacedView]:
    """Views one under the other: a page that stands has its text above them, one that lies on their right."""
    free, left = paper.free_box, paper.free_box.left + (TITLE_ROOM if stack[0].turn else 0.0)
    level = free.bottom + _height(stack) if paper.is_upright else free.top - (0.0 if stack[0].turn else TITLE_ROOM)
    placed: list[PlacedView] = []
    for view in stack:
        placed.append(PlacedView(view, complex(left - view.room.left, level - view.room.top)))
        level -= view.room.height + BLOCK_GAP
    return placed


@dataclass(frozen=True, eq=False)
class _PageMaker:
    variant: Variant
    student: Student
    secret: bytes
    paper: MarkedPaper
    ink: Ink

    def code(self, page: int) -> str:
        """What the code of a page says."""
        exercise = self.variant.exercise
        said = SheetCode(exercise.name, exercise.version, self.student.id, self.variant.draw, page)
        return said.text(self.secret)

    def column(self, placed: Sequence[PlacedView], page: int) -> TextColumn:
        """What the views leave of a page for text and code."""
        free, side = self.paper.free_box, code_side(self.code(page), self.paper)
        free = Box(free.left, free.bottom, free.right - TAG_GAP, free.top)
        if not placed:
            return TextColumn(free, side, upright=False)
        views = bounding_box([each.box for each in placed])
        if self.paper.is_upright:
            return TextColumn(Box(free.left, views.top + BLOCK_GAP, free.right, free.top), side, upright=False)
        return TextColumn(Box(views.right + TEXT_GAP, free.bottom, free.right, free.top), side, upright=True)

    @property
    def lettering(self) -> Lettering:
        """The heights of the letters on its paper."""
        drawing = self.variant.task.drawing
        return Format(drawing.format, drawing.frame, drawing.orientation).lettering

    @property
    def letters(self) -> float:
        """The height of the text's letters [mm]."""
        return self.lettering.label

    def blocks(self, pages: Sequence[Sequence[PlacedView]]) -> list[Block]:
        """The text, and the table of answers, as wide as the narrowest column."""
        tell = self.variant.exercise.tell
        rooms = [self.column(placed, k).room for k, placed in enumerate(pages, 1)]
        narrow = min(room.width for room in rooms)
        taped = [tell(TAPE_ADVICE)] if self.paper.seam is not None else []
        crosses = any(asked.mark_form == "cross" for asked in self.variant.exercise.answers)
        how = [*taped, " ".join([tell(DRAWING_ADVICE), *([tell(CROSSES_ADVICE)] if crosses else [])])]
        text = paragraphs([instructions(self.variant), *how], self.letters, rooms[0].width)
        table = answer_table(self.variant.exercise).translated(tell)
        tall = max(room.height for room in rooms)
        return [text, *table_blocks(table, self.letters, narrow, tall, row_height=ROW_HEIGHT)]

    def page(
        self, placed: Sequence[PlacedView], entities: list[Entity], page: int, pages: int
    ) -> tuple[Page, PrintedPage]:
        """A page of so many, and what a reader must know of it."""
        paper, exercise, code = self.paper, self.variant.exercise, self.code(page)
        column, who = self.column(placed, page), self.student.name or self.student.id
        whose = [exercise.tell(said.with_values(who=who, page=page, pages=pages)) for said in self.owner_captions]
        texts = [*captions(paper, exercise.title, whose), *bar_captions(paper, exercise.tell)]
        titles = [text for each in placed for text in self.titles(each)]
        corners = [column.code_corner]
        if paper.seam is not None:
            # Either tile is photographed alone.
            corners.append(complex(paper.strip + BAR_ROOM, paper.height - paper.strip - code_side(code, paper)))
        groups = [
            mark_group(paper, LIGHT_ROLES[self.ink]),
            Group("captions", tuple(texts)),
            code_group(code, corners, paper),
            *([Group("text", tuple(entities))] if entities else []),
            *([Group("titles", tuple(titles))] if titles else []),
        ]
        black = black_boxes(groups)
        givens = [self.givens(each) for each in placed]
        named = [
            Group(f"given-{each.view.name.replace(' ', '-')}", tuple(g)) for each, g in zip(placed, givens, strict=True)
        ]
        origins = {each.view.name: each.origin for each in placed}
        frame = paper.box.grown(-paper.edge)
        drawn = Page(paper.width, paper.height, frame, (*groups, *named), origins)
        return drawn, PrintedPage(
            *(code, paper.width, paper.height, paper.tags, paper.side, paper.bars, paper.patches, PATCH_SIDE, self.ink),
            givens=tuple(line for entities in givens for line in polylines(entities)),
            black=tuple(black),
            views={each.view.name: each.view.printed(each.origin) for each in placed},
            seam=paper.seam,
        )

    @property
    def owner_captions(self) -> tuple[Caption, ...]:
        """Captions of whose page it is, or whose either tile is."""
        if self.paper.seam is None:
            return (say("{who}, page {page} of {pages}"),)
        return (
            say("{who}, page {page} of {pages}, left half"),
            say("{who}, page {page} of {pages}, right half"),
        )

    def titles(self, placed: PlacedView) -> list[Text]:
        """What a view is called, outside its room."""
        room, view = placed.room, placed.view
        if not view.turn:
            at = complex(room.left, room.top + TITLE_ROOM / 4)
            return [Text(at, view.title, self.letters)]
        left = Box(room.left - TITLE_ROOM, room.bottom, room.left, room.top)
        right = Box(room.right, room.bottom, room.right + TITLE_ROOM, room.top)
        return [*upright_text(view.title, left, self.letters), *upright_text(view.end_title, right, self.letters)]

    def givens(self, placed: PlacedView) -> list[Entity]:
        """The light lines of a view, with their texts in its room."""
        tell = self.variant.exercise.tell
        drawn = expand(placed.view.marks, Placement(placed.origin), self.lettering, tell)
        entities = lettered_steps([drawn], [], placed.room)[0]
        return [replace(entity, role=LIGHT_ROLES[self.ink]) for entity in entities]
