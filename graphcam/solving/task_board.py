"""Task to drawing board: what a hand starts from, and how much paper it has."""

import math
from contextlib import suppress
from dataclasses import replace
from functools import partial, singledispatch

from graphcam.comparison.chord_readings import finer_parts
from graphcam.constructions.board import Board, DrawnFollower
from graphcam.constructions.drawn_arm import MAX_ARM_ON_PAPER, DrawnOscillating, positions_extent
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_swinging_face import DrawnOscillatingFlat
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.views import PROFILE
from graphcam.drafting.scale import (
    STANDARD_RATIOS,
    Paper,
    Scale,
    coarsest_scale,
    ratio_from_text,
    ratio_text,
    standard_scale,
)
from graphcam.errors import DesignError
from graphcam.given.follower import Oscillating, omega_of, sense
from graphcam.given.limits_and_fits import shaft_radius
from graphcam.given.stations import divide
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.oscillating_flat import check_swing
from graphcam.sheets.formats import Format
from graphcam.sheets.layout import profile_room
from graphcam.sheets.page_filling import ONE_PAGE
from graphcam.sheets.page_space import free_rooms
from graphcam.solving.diagram_sizes import (
    DEFAULT_POLE,
    STANDARD_POLES,
    DiagramRoom,
    DrawnHeights,
    cam_angle_scale,
    over_the_turn,
)
from graphcam.tasks.sheet_tables import SheetTable
from graphcam.tasks.task import (
    DrawingTable,
    FlatFacedTable,
    FollowerTable,
    OscillatingFlatTable,
    OscillatingTable,
    Task,
    TranslatingTable,
)
from graphcam.words import say

USUAL_DIVISIONS = 12
"""The parts of a phase where the task leaves them open."""


def format_of(drawing: SheetTable) -> Format:
    """The sheet that a task asks for."""
    return Format(drawing.format, drawing.frame, drawing.orientation)


def profile_paper(drawing: SheetTable, share: float = 1.0) -> Paper:
    """What the cam's profile may take of the sheet, or a share of its width and height."""
    width, height = profile_room(drawing.format, drawing.frame, drawing.orientation)
    # On A1 a profile that is larger stands beside the diagrams.
    bounded = drawing.format not in ONE_PAGE
    return Paper(share * width, share * height, STANDARD_RATIOS[drawing.frame], bounded)


def papers(drawing: SheetTable, beside: complex = 0j) -> list[Paper]:
    """The largest free boxes of a page, the widest first, that hold more than what stands beside a view.

    beside : wide + i high [mm of paper]

    >>> [paper.height for paper in papers(SheetTable("A3"), complex(100.0, 240.0))]
    [258.0, 272.0]
    """
    rooms, ratios = free_rooms(format_of(drawing)), STANDARD_RATIOS[drawing.frame]
    return [Paper(*room, ratios) for room in rooms if room[0] > beside.real and room[1] > beside.imag]


def largest_drawn(drawing: SheetTable, size: complex, beside: complex) -> Paper:
    """The free box of a page in which a view is drawn the largest.

    size : of the view, wide + i high [mm];  beside : what stands around it [mm of paper]
    """
    return min(papers(drawing, beside), key=lambda paper: paper.scale(size, beside).per_mm)


def board_of(task: Task) -> Board:
    """What the task puts on the drawing board."""
    drawing, motion, part, scale = task.drawing, task.motion(), task.part, given_profile_scale(task.drawing)
    follower = drawn_follower(task.follower, task)
    room = diagram_room(drawing, angles="angle_diagram" in follower.constructions)
    room = room.beside_jerk if drawing.jerk else room
    divisions, at_corners = drawing.divisions or USUAL_DIVISIONS, follower.divides_at_corners or drawing.jerk
    divided = partial(divide, motion, divisions, at_corners=at_corners)
    finer = {} if drawing.divisions else finer_parts(motion, divisions, lambda finer: divided(finer=finer))
    mu_phi = mu_alpha = Scale(math.radians(room.degrees_per_mm), "rad")
    if not drawing.whole_turn:
        # The diagrams of what was measured show the whole turn.
        breaks, longest = bool(task.motion.phases), longest_axis(drawing)
        # A longer axis would take the room of other views on a sheet that shows all of them.
        long, usual = drawing.format not in ONE_PAGE, room.degrees_per_mm
        mu_phi = cam_angle_scale(motion, divided(finer=finer), usual, longest, breaks=breaks, long=long)
    heights, given = DrawnHeights(motion, mu_phi), (drawing.ordinate, drawing.poles)
    most = page_room(task, heights, follower)
    if mu_phi != mu_alpha:
        # The displacement is no higher than at the usual scale, so that the combined diagram keeps to its room.
        usual, page = DrawnHeights(motion, mu_alpha), most
        most = replace(page, s=min(page.s, usual.displacement(*usual.highest(room, page, *given))))
        if any(given) and not heights.fit(page, *heights.choose(room, most, *given)):
            # Given sizes may suit the whole turn alone.
            mu_phi, heights, most = mu_alpha, usual, page_room(task, usual, follower)
    ordinate, poles = heights.choose(room, most, *given)
    return Board(
        motion=motion,
        follower=follower,
        rotation=task.rotation,
        limits=task.limits(),
        prime_radius=task.prime_radius,
        roller_radius=task.follower.roller_radius,
        roller_rule=task.roller_terms,
        min_profile_radius=task.limits.min_curvature_radius if "roller" in follower.constructions else None,
        shaft_radius=0.0 if part is None or part.bore is None else shaft_radius(part.bore, part.keyway != "none"),
        divisions=divisions,
        ordinate=ordinate,
        poles=poles,
        mu_phi=mu_phi,
        mu_alpha=mu_alpha,
        finer=finer,
        rounding=drawing.rounding,
        omega=None if task.speed_rpm is None else omega_of(task.speed_rpm),
        paper=profile_paper(drawing) if scale is None else replace(profile_paper(drawing), held={PROFILE.name: scale}),
        jerk_pole=heights.jerk_pole(room, ordinate) if drawing.jerk else None,
    )


def given_profile_scale(drawing: DrawingTable) -> float | None:
    """The scale that the task gives the profile [mm/mm]; None where it is left out.

    Raises
    ------
    DesignError : it is none of the frame's standard

    >>> given_profile_scale(DrawingTable(profile_scale="2:1")), given_profile_scale(DrawingTable())
    (0.5, None)
    """
    if drawing.profile_scale is None:
        return None
    ratios, said = STANDARD_RATIOS[drawing.frame], ratio_from_text(drawing.profile_scale)
    if said is None or not any(math.isclose(said * ratio, 1) for ratio in ratios):
        usual = ", ".join(str(ratio_text(1 / ratio)) for ratio in ratios if 1 / 10 <= ratio <= 10)
        limit = say("a standard drawing scale, such as {usual}", usual=usual)
        raise DesignError("drawing.profile_scale", drawing.profile_scale, limit, say("or leave it out"))
    return said


@singledispatch
def drawn_follower(table: FollowerTable, task: Task) -> DrawnFollower:
    """The follower of a task's table, as it is drawn: the one place of the drawn side that asks which it is."""
    raise TypeError(table)


@drawn_follower.register
def _(table: TranslatingTable, task: Task) -> DrawnTranslating:
    return DrawnTranslating(table.offset)


@drawn_follower.register
def _(table: OscillatingTable, task: Task) -> DrawnOscillating:
    scale = _scale_of_positions(task, Oscillating(table.arm, table.distance))
    return DrawnOscillating(table.arm, table.distance, scale)


@drawn_follower.register
def _(table: FlatFacedTable, task: Task) -> DrawnFlatFaced:
    return DrawnFlatFaced(task.limits.min_curvature_radius or 0.0)


@drawn_follower.register
def _(table: OscillatingFlatTable, task: Task) -> DrawnOscillatingFlat:
    check_swing(task.motion(), sense(task.rotation))  # which no drawing could show
    size = complex(2 * table.distance, table.distance)
    paper = largest_drawn(task.drawing, size, ARM_MARGINS)
    scale = coarsest_scale(
        standard_scale(table.distance, MAX_ARM_ON_PAPER, paper.ratios), paper.scale(size, ARM_MARGINS)
    )
    least = task.limits.min_curvature_radius or 0.0
    return DrawnOscillatingFlat(table.distance, table.face_offset, least, scale)


DIAGRAM_ROOMS = {
    ("A1", False): DiagramRoom(1.0, 180.0, 130.0, 60.0),
    ("A1", True): DiagramRoom(1.0, 120.0, 100.0, 50.0),
    ("A2", False): DiagramRoom(1.0, 75.0, 60.0, 36.0),
    ("A2", True): DiagramRoom(2.0, 110.0, 90.0, 50.0),
    ("A3", False): DiagramRoom(2.0, 90.0, 75.0, 40.0),
    ("A3", True): DiagramRoom(2.0, 80.0, 70.0, 40.0),
    ("A4", False): DiagramRoom(2.0, 45.0, 40.0, 30.0),
    ("A4", True): DiagramRoom(3.0, 75.0, 65.0, 40.0),
}
"""The rooms for diagrams by format, and whether it stands upright."""
MAX_HEIGHT_FACTOR = 1.6
"""So many times its height the displacement may have where no diagram of the pressure angle stands under it; not on A4,
where the combined diagram, which has the same scale, would be wider than the sheet."""


def diagram_room(drawing: SheetTable, *, angles: bool = True) -> DiagramRoom:
    """What the diagrams of a sheet are drawn for, with or without that of the pressure angle."""
    upright = format_of(drawing).is_upright
    room = DIAGRAM_ROOMS[drawing.format, upright]
    return room if angles or drawing.format == "A4" else replace(room, s=MAX_HEIGHT_FACTOR * room.s)


DIAGRAM_MARGINS = complex(60.0, 52.0)
"""What numbers, letters, arrows and the title need about the curves of a diagram."""

POLE_MARGIN, SPEED_MARGIN = 24.0, 39.0
"""What stands to the left of a pole, and to the right of a turn; and where a speed graduates the turn once more."""


BROKEN_AXIS_MARGIN = 38.0
"""What stands beside a pole and a broken axis, with its graduations and letters [mm of paper]."""


def longest_axis(drawing: SheetTable) -> float:
    """The room of a page for a pole and the axis of the cam angle, without what stands beside [mm]."""
    return max(width for width, _ in free_rooms(format_of(drawing))) - BROKEN_AXIS_MARGIN


def page_room(task: Task, heights: DrawnHeights, follower: DrawnFollower) -> DiagramRoom:
    """What no diagram may exceed, for no page of the format would take it.

    The displacement is kept so low that the combined diagram, which has its scale, fits a page too.
    """
    beside = heights.turn + (POLE_MARGIN if task.speed_rpm is None else SPEED_MARGIN)
    wide = papers(task.drawing, complex(beside + STANDARD_POLES[0], 0.0))
    if heights.mu_phi.middles:
        # Beside a finer axis the usual pole is longer: a page with room for it is preferred.
        room = heights.turn + BROKEN_AXIS_MARGIN
        if wider := papers(task.drawing, complex(room + DEFAULT_POLE / heights.degrees_per_mm, 0.0)):
            beside, wide = room, wider
    diagram = max(wide, key=lambda paper: paper.height)
    size = follower.extent(heights.values, task.limits(), task.rotation, task.prime_radius)
    # So many units of the lift for a millimetre of paper let the combined diagram into one of the rooms.
    free = [complex(paper.width, paper.height) - DIAGRAM_MARGINS for paper in papers(task.drawing, DIAGRAM_MARGINS)]
    mu_s = min(max(size.real / each.real, size.imag / each.imag) for each in free)
    low = heights.motion.lift / mu_s if mu_s else math.inf
    high, pole = diagram.height - DIAGRAM_MARGINS.imag, diagram.width - beside
    # Of few parts velocity and displacement are drawn higher: by so much of a cycloid, less of other laws.
    part = math.pi / max(task.drawing.divisions or USUAL_DIVISIONS, 2)
    surplus = (part / math.sin(part)) ** 2
    return DiagramRoom(heights.degrees_per_mm, high, high / surplus, min(high, low) / surplus, pole)


MAX_OVERSIZE = 10.0
"""Diagrams that exceed a page so many times are not laid out: their strokes alone would fill the memory."""


def check_given_sizes(task: Task, times: float = 1.0) -> None:
    """Check that the ordinate and the poles that a task gives leave diagrams that fit a page of its format.

    times : how many times the room of the page they may take

    Raises
    ------
    DesignError : one of them is too large

    >>> import graphcam as gc
    >>> from dataclasses import replace
    >>> task = gc.builtin_task()
    >>> check_given_sizes(replace(task, drawing=replace(task.drawing, ordinate=2000.0)))
    Traceback (most recent call last):
    graphcam.errors.DesignError: drawing.ordinate is 2000 mm, but must be at most 149 mm on A1 landscape; take ...
    """
    drawing, board = task.drawing, board_of(task)
    sheet, larger = format_of(drawing).description, say("take a larger format, or leave it out")
    heights = DrawnHeights(board.motion, board.mu_phi)
    most = page_room(task, heights, board.follower)
    for k, pole in enumerate(drawing.poles or ()):
        if pole > times * most.pole:
            limit = say("at most {floor:g} mm on {sheet}", floor=math.floor(most.pole), sheet=sheet)
            raise DesignError(f"drawing.poles[{k}]", say("{length:g} mm", length=pole), limit, larger)
    largest = heights.largest_ordinate(most, board.poles)
    if (given := drawing.ordinate) is not None and given > times * largest:
        limit = say("at most {value:.3g} mm on {sheet}", value=math.floor(10 * largest) / 10 or largest, sheet=sheet)
        larger = say("take larger poles or a larger format, or leave it out") if drawing.poles else larger
        raise DesignError("drawing.ordinate", say("{length:g} mm", length=given), limit, larger)


ARM_MARGINS = complex(40.0, 62.0)
"""What stands about the arm positions: letters, the region below the cam centre, the title."""


def _scale_of_positions(task: Task, arm: Oscillating) -> Scale:
    """The largest standard scale at which the arm is no longer than usual and its positions fit a page."""
    limits, radius = task.limits(), task.prime_radius
    centres = [] if radius is None or arm.distance is None else [(radius, arm.distance)]
    # Where the drawing will find the cam centre is computed, for no other end than to leave room for it.
    with suppress(DesignError):
        least = minimum_radius(task.motion(), arm, task.rotation, limits.rise, limits.return_, rest=limits.rest)
        centres.append((least.prime_radius, least.distance))
    size = positions_extent(arm.arm, over_the_turn(task.motion()), task.rotation, limits, centres)
    paper = largest_drawn(task.drawing, size, ARM_MARGINS)
    return coarsest_scale(standard_scale(arm.arm, MAX_ARM_ON_PAPER, paper.ratios), paper.scale(size, ARM_MARGINS))
