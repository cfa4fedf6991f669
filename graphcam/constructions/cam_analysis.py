"""The analysis of a given cam: its outline stands still, and the follower goes round it against the rotation.

The centre of a roller runs on the pitch curve, which is drawn as the envelope of the roller's circles about points of
the outline.  Where the follower meets it in equally spaced positions is how far it has moved; the normal there is the
pressure angle.  What is common to all followers stands here; how one is placed beside the cam stands in its own file.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions import profile_view
from graphcam.constructions.axes import phase_kind, phase_symbol, phase_title, sense_caption
from graphcam.constructions.views import ANALYSIS, at_scale
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import UP, turned_direction, unit
from graphcam.drafting.hand import Direction, Hand, calculated_setting, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, View, say
from graphcam.drafting.marks import AngleMark, Arc, Label, Line, Mark, Role, Segments
from graphcam.drafting.meaning import ComparedReading, Meaning, ReadingMeaning
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.telling import STATION, circle_caption, run
from graphcam.given.follower import Rotation, sense
from graphcam.given.laid_outline import GivenCamMotion, LaidOutline
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import Words, say_in, sequence

NUMBERS_ROOM = 5.0
"""Numbers of positions find room that are so far apart [mm of paper]."""
NORMAL_BEYOND, NORMAL_INWARD = 7.0, 5.0
"""So far a normal and a line of motion are drawn beyond the place where their angle is measured, and the normal inward,
at least [mm of paper]."""
PHASE_ARC_OFFSET = 14.0
"""How far the arcs of the phase angles lie outside the curve [mm of paper]."""
ARC_SHOWN = math.radians(35)
"""Of a circle of the roller so much is drawn on either side of where the pitch curve touches it [rad]."""
STANDSTILL = 1e-3
"""A follower that moves less than this part of its lift from station to station stands still."""
MAX_CIRCLES = 80
"""So many circles of the roller are shown at most."""
LINES_FROM = 0.25
"""The positions of a line through the cam centre are drawn from this part of the prime radius on, for it is crowded."""


OUTLINE, PITCH_CURVE = "line of the outline", "line of the pitch curve"
"""The names of the curves that the outline and the pitch curve are."""
ON_A_STATION = 1e-6
"""A joint nearer to a station than this part of their distance lies on it."""


@dataclass(frozen=True, eq=False)
class AnalysisGivens:
    """What lies on the board of an analysis.

    outline : of the cam [mm];  motion : of whose phases the kinds are seen, and the angles measured
    prime_radius, roller_radius, place : mm; the place is the follower's offset or centre distance
    phi : (n,) the stations, equal parts of the turn [rad];  mu_l : drawing scale of the cam [mm/mm]
    unit : of the lift
    """

    outline: LaidOutline
    motion: GivenCamMotion
    rotation: Rotation
    prime_radius: float
    roller_radius: float
    place: float
    phi: Floats
    mu_l: Scale
    unit: str


Analysis = Construction[AnalysisGivens]


def _stations(drawn: Analysis) -> list[Words]:
    return [f"{k}" for k in range(drawn.givens.phi.size)]


def _phases(drawn: Analysis) -> list[Caption]:
    return [phase_title(drawn.givens.motion, k) for k in range(len(drawn.givens.motion.phases))]


def _greatest_angle(way: str, title: Caption) -> ReadingMeaning:
    """The meaning of the maximum pressure angle on the rise or on the return."""
    name = f"max_pressure_angle_{way}_deg"
    compared = ComparedReading(f"measured_{name}", sides=f"{way}_candidates", exact=name)
    return ReadingMeaning(title, "max α", "rad", (compared,))


MEANING = Meaning(
    "analysis",
    say("Analysis of the given cam"),
    say(
        "The cam is held still and the follower goes round it, against the cam's rotation. In every position the "
        "outline tells how far the follower has moved, and the normal at the contact tells the pressure angle."
    ),
    {
        "s": ReadingMeaning(say("measured displacement s"), "s", "lift", over=_stations),
        "lift": ReadingMeaning(say("measured lift"), "h", "lift", (ComparedReading("measured_lift", exact="lift"),)),
        "phase_angles": ReadingMeaning(say("phase angles"), "φ", "rad", over=_phases),
        "rise_angle": ReadingMeaning(
            say("measured angle of the rise"), "φ₁", "rad", (ComparedReading("measured_rise_deg", exact="rise_deg"),)
        ),
        "alpha": ReadingMeaning(say("pressure angle at the contact"), "α", "rad", over=_stations),
        "max_rise": _greatest_angle("rise", say("measured maximum α, rise")),
        "max_return": _greatest_angle("return", say("measured maximum α, return")),
    },
)


# --- acts ------------------------------------------------------------------------------------------------------------


def lay_cam(hand: Hand, givens: AnalysisGivens) -> tuple[Drawn, Drawn, Drawn]:
    """Points of the outline, or under a roller of the pitch curve, the curve through them, and the prime circle."""
    laid, mu_l = givens.outline, givens.mu_l.per_mm
    points, count = hand.given("outline", laid.points / mu_l), laid.points.size - 1
    normals, faired = hand.given("normals", laid.points / mu_l, laid.normals), hand.fair(OUTLINE, points, laid.pieces)
    if givens.roller_radius:
        circles = hand.circle("roller circles", points[:-1], givens.roller_radius / mu_l)
        touched = hand.cross("farthest out", normals[:-1], circles)
        points = hand.take("pitch points", touched, which=np.arange(count + 1) % count)
        faired = hand.fair(PITCH_CURVE, points, laid.pieces)
    return points, faired, profile_view.prime_circle(hand, givens.prime_radius, givens.mu_l)


def inverted_positions(hand: Hand, givens: AnalysisGivens, base: Direction) -> Drawn:
    """The lines through the cam centre that a line of the frame takes at the stations, turned from ``base``."""
    turns = -sense(givens.rotation) * givens.phi
    return hand.protractor("inverted positions", hand.given("cam centre"), base, turns)


def joints(givens: AnalysisGivens) -> NDArray[np.intp]:
    """The places of the outline where one part of it follows another, in the order in which they are met."""
    pieces = givens.outline.pieces
    return np.array([piece.start for piece in pieces if len(pieces) > 1], dtype=np.intp)


def measure_phases(
    hand: Hand, givens: AnalysisGivens, s: Setting, base: Direction, rays: Drawn | None
) -> Setting | None:
    """Read the phase angles, by the displacements and by where arcs about the cam centre end, if these are known.

    rays : where the line that was at ``base`` at the start lies when the follower stands on the joints

    Returns
    -------
    the cam angles of the joints, None where there is none
    """
    at_joints = None
    if rays is not None:
        at_joints = hand.carry(hand.angle("angles of the joints", base, rays, -sense(givens.rotation)))
    directions, dwells = tuple(int(way) for way in givens.motion.directions), givens.outline.dwells
    if directions.count(0) != len(dwells):
        return at_joints  # of an outline by points no eye tells where an arc about the cam centre ends
    # Of several strokes the eye knows which turn is meant: that between the middles of the two phases.
    spans = [span for _, *span in givens.motion.timing]
    middles = tuple((start + end) / 2 for start, end in spans)
    formula = partial(_phase_angles, directions, dwells, middles, givens.phi)
    angles = calculated_setting(formula, s, *([] if at_joints is None else [at_joints]))
    hand.read("phase_angles", angles, 1.0, rounded=False)
    hand.read("rise_angle", calculated_setting(_first_of, angles), 1.0, rounded=False)
    return at_joints


def _first_of(values: Floats) -> Floats:
    return values[..., 0]


def top_of_parabola(
    values: Floats, at: NDArray[np.intp], allowed: NDArray[np.bool_] | bool = True
) -> tuple[Floats, Floats]:
    """The parabola through three neighbours of a turn about places: the height of its top, and by how much it is off.

    values : (..., n);  at : (...);  allowed : (...) whether the three lie on one smooth piece

    >>> height, off = top_of_parabola(np.array([0.0, 3.0, 4.0, 3.0, 0.0]), np.array(2))
    >>> float(height), float(off)
    (4.0, 0.0)
    """
    count = values.shape[-1]
    a, b, c = (np.take_along_axis(values, (at[..., None] + k) % count, -1)[..., 0] for k in (-1, 0, 1))
    slope, bend = (c - a) / 2, a - 2 * b + c
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.where(bend != 0, -slope / bend, 0.0)
    off = np.where(allowed & (np.abs(off) <= 1), off, 0.0)
    return b + off * (slope + off * bend / 2), off


def _is_smooth(phi: Floats, at: NDArray[np.intp], angles: Floats | None) -> NDArray[np.bool_] | bool:
    """Whether no joint, at cam angles (..., j), lies between the two neighbours of stations (...)."""
    if angles is None:
        return True
    step = phi[1] - phi[0]
    away = np.remainder(angles - phi[at][..., None] + FULL_TURN / 2, FULL_TURN) - FULL_TURN / 2
    return ~np.any(np.abs(away) < step * (1 - ON_A_STATION), axis=-1)


def read_lift(hand: Hand, givens: AnalysisGivens, s: Setting, scale: float) -> None:
    """Read the lift: the maximum of the displacement, in a dwell as it is measured, else at the top of a parabola."""
    motion = givens.motion
    dwells = any(phase_kind(motion, k) == "upper dwell" for k in range(len(motion.phases)))
    hand.read("lift", calculated_setting(_greatest if dwells else _highest, s), scale, rounded=False)


def _greatest(s: Floats) -> Floats:
    return s.max(axis=-1)


def _highest(s: Floats) -> Floats:
    return top_of_parabola(s, np.argmax(s, axis=-1))[0]


def _phase_angles(
    directions: Sequence[int],
    dwells: Sequence[int],
    middles: Sequence[float],
    phi: Floats,
    s: Floats,
    angles: Floats | None = None,
) -> Floats:
    """The angles of the phases (..., k) [rad]: a dwell has the ends of an arc, else s is greatest or least between.

    dwells : the numbers of the pieces about the cam centre;  angles : (..., j) of the joints, with which they begin
    middles : cam angles of the middles of the phases, between which a turn is looked for
    """
    begins, passed = list[Floats](), 0
    for k, way in enumerate(directions):
        before = directions[k - 1]
        if way and before:
            between = (phi - middles[k - 1]) % FULL_TURN <= ((middles[k] - middles[k - 1]) % FULL_TURN or FULL_TURN)
            at = np.argmax(np.where(between, before * s, -np.inf), axis=-1)
            begins.append((at + top_of_parabola(s, at)[1]) * (phi[1] - phi[0]))
        else:
            assert angles is not None
            joint = dwells[passed - 1] + 1 if way else dwells[passed]  # the end of the dwell before, or its own start
            begins.append(angles[..., joint % angles.shape[-1]])
        passed += not way
    found = np.stack(begins, axis=-1)
    return (np.roll(found, -1, axis=-1) - found) % FULL_TURN


def measure_angles(
    hand: Hand,
    givens: AnalysisGivens,
    motion: Drawn,
    places: Drawn,
    s: Setting,
    sigma: int,
    on_joints: Drawn | None,
    angles: Setting | None,
) -> None:
    """Measure the pressure angles: of the normals at the places of the pitch curve with the lines of motion.

    sigma : counter-clockwise they are measured, or clockwise;  on_joints, angles : the lines of motion on the joints of
        the outline, where an angle may be greatest too, and their cam angles
    """
    normals = hand.tangents_at("tangents", places).turned(UP * sense(givens.motion.rotation))
    measured = [hand.carry(hand.angle("alpha", motion, normals, sigma)), s]
    if on_joints is not None and angles is not None:
        there = hand.tangents_at("normals at the joints", hand.acts["normals"][joints(givens)])
        measured += [hand.carry(hand.angle("alpha on the joints", on_joints, there, sigma)), angles]
    for way, direction in (("rise", 1), ("return", -1)):
        both = calculated_setting(partial(_extremes, givens.phi, direction), *measured)
        hand.read(f"{way}_candidates", both, 1.0, "rad", rounded=False)
        hand.read(f"max_{way}", calculated_setting(_farther, both), 1.0, rounded=False)


def _extremes(
    phi: Floats, direction: int, alpha: Floats, s: Floats, on_joints: Floats | None = None, angles: Floats | None = None
) -> Floats:
    """The highest and the lowest of pressure angles where the follower moves in a direction: (..., 2).

    alpha, s : (..., n) at the stations;  on_joints, angles : (..., j) pressure angles on the joints, and cam angles
    """
    ahead, behind = np.roll(s, -1, axis=-1), np.roll(s, 1, axis=-1)
    moving, found = direction * (ahead - behind) > 0, list[Floats]()
    for side in (1, -1):
        at = np.argmax(np.where(moving, side * alpha, -np.inf), axis=-1)
        top = top_of_parabola(side * alpha, at, _is_smooth(phi, at, angles))[0]
        if on_joints is not None and angles is not None:
            last = np.floor(angles / (phi[1] - phi[0])).astype(np.intp) % phi.size
            passing = direction * np.take_along_axis(ahead - s, last, -1) > 0
            top = np.maximum(top, np.where(passing, side * on_joints, -np.inf).max(axis=-1))
        found.append(side * top)
    return np.stack(found, axis=-1)


def _farther(both: Floats) -> Floats:
    return np.where(both[..., 0] >= -both[..., 1], both[..., 0], both[..., 1])


# --- steps -----------------------------------------------------------------------------------------------------------


def view_of(drawn: Analysis) -> View:
    """The view of the given cam, at its scale."""
    return at_scale(ANALYSIS, drawn.givens.mu_l)


KNIFE_EDGE = say("Under a knife edge the outline is itself the pitch curve.")


def cam_steps(drawn: Analysis) -> list[Step]:
    """The steps of the given outline, and of the pitch curve under a roller."""
    givens, mu_l, view = drawn.givens, drawn.givens.mu_l.per_mm, view_of(drawn)
    outline, line = drawn.acts["outline"], drawn.acts[OUTLINE].first
    reach = _outer_radius(drawn)
    sigma, arrow = sense(givens.rotation), 0.6 * float(np.abs(outline.shown).min())
    centre = drawn.acts["cam centre"]
    marks = (
        *(Line(way * reach * np.array([-1, 1]), Role.AXIS) for way in (1 + 0j, UP)),
        profile_view.rotation_arrow(-np.pi / 2, sigma, arrow),
        Label(-arrow * UP + sigma * arrow / 2, "ω", towards=-UP + sigma),
        centre.dots(Role.RESULT),
        centre.label("A", 1 - 1j),
        line.line(Role.RESULT),
    )
    said = say(
        "The outline of the cam lies on the paper at {ratio}, turned as it is when the follower begins to rise; A is "
        "the cam centre, and the cam turns {rotation}."
    ).with_values(ratio=ratio_text(mu_l), rotation=sense_caption(givens.rotation))
    why = say("What the follower does is found from the outline alone, however it was designed.")
    # Under a face square to its motion no pitch curve is spoken of.
    edge = [KNIFE_EDGE] if not givens.roller_radius and "alpha" in drawn.readings else []
    part = Part(sequence([said, *edge], " "), (line,))
    steps = [Step(say("The given cam"), (part,), view, marks, given=marks, why=why)]
    if givens.roller_radius:
        steps.append(_pitch_step(drawn))
    return steps


def _pitch_step(drawn: Analysis) -> Step:
    givens, circles, curve = drawn.givens, drawn.acts["roller circles"].first, drawn.acts[PITCH_CURVE].first
    each = say_in("drawn", "circles of the roller about points of the outline, close to one another")
    said = circle_caption(each, "r", givens.roller_radius, givens.mu_l.per_mm)
    joined = say(
        "With the French curve draw the line that touches all circles on the outside: the pitch curve, on which the "
        "centre of the roller runs."
    )
    why = say("Where the roller touches the outline, its centre is the roller's radius away along the normal.")
    outward = np.angle(drawn.acts["normals"].first.directions).tolist()
    every = 1 + circles.shown.size // MAX_CIRCLES
    arcs = [_outer_arc(circles[k], outward[k]) for k in range(0, circles.shown.size, every)]
    marks = (*arcs, curve.line(Role.CURVE))
    parts = Part(said, (circles,)), Part(joined, (curve,))
    return Step(say("Pitch curve"), parts, view_of(drawn), marks, why=why)


def _outer_arc(circle: Drawn, outward: float) -> Arc:
    """The part of a roller's circle about the direction [rad] in which the pitch curve touches it."""
    whole = circle.drawn_circle(Role.CONSTRUCTION)
    ends = outward - ARC_SHOWN, outward + ARC_SHOWN
    return Arc(whole.centre, whole.radius, *ends, Role.CONSTRUCTION).left_by(circle)


def position_numbers(drawn: Analysis, places: Drawn) -> tuple[Mark, ...]:
    """The numbers of the positions inside of places, as many as find room."""
    apart, at = float(np.median(np.abs(np.diff(places.shown)))), places.shown
    every = next((k for k in (1, 2, 3, 6) if k * apart >= NUMBERS_ROOM), 12)
    numbered = range(0, at.size, every)
    return tuple(places[k].label(f"{k}", complex(-unit(at[k : k + 1])[0]), small=True) for k in numbered)


def position_values(drawn: Analysis) -> dict[str, Words]:
    """The caption's values for the inverted positions."""
    against = sense_caption("ccw" if drawn.givens.rotation == "cw" else "cw")
    step = say("{angle:g}°", angle=round(float(np.degrees(drawn.givens.phi[1])), 3))
    count = f"{drawn.givens.phi.size}"
    return {"rotation": sense_caption(drawn.givens.rotation), "against": against, "step": step, "count": count}


def circles_step(drawn: Analysis, title: Caption, more: Sequence[Part] = (), marks: Sequence[Mark] = ()) -> Step:
    """The step of the prime circle, and of what else is drawn about the cam centre."""
    givens, circle = drawn.givens, drawn.acts["prime circle"]
    prime = say_in("drawn", "the prime circle about the cam centre A")
    parts = Part(circle_caption(prime, "r₀", givens.prime_radius, givens.mu_l.per_mm), (circle,)), *more
    why = say("On the prime circle the follower is lowest: the displacement is counted from there.")
    return Step(title, parts, view_of(drawn), (circle.drawn_circle(Role.CONSTRUCTION), *marks), why=why)


def _without_minus_zero(value: float, digits: int = 2) -> float:
    """A value, or zero where it is told as zero: as a rule shows it."""
    return value if round(value, digits) else 0.0


def displacement_step(drawn: Analysis, said: Caption, why: Caption, marks: Sequence[Mark], *draws: Drawn) -> Step:
    """The step in which the displacements are measured, position by position."""
    s, per_mm = drawn.first("s"), drawn.readings["s"].per_mm
    angle = drawn.givens.unit == "rad"
    k = int(np.argmax(s))

    def measured(n: int) -> Caption:
        """The displacement at position n, as it is measured."""
        if angle:
            return say("{s:.2f}°", s=_without_minus_zero(math.degrees(s[n])))
        paper = _without_minus_zero(float(s[n]))
        return say("{paper:.2f} mm × {mu:.5g} = {s:.2f} mm", paper=paper, mu=per_mm, s=paper * per_mm)

    part = run(said.with_values(k=f"{k}", s=measured(k)), STATION, _stations(drawn), *draws, settings=measured)
    return Step(say("Displacements measured"), (part,), view_of(drawn), tuple(marks), ("s", "lift"), why=why)


def _rounded(angle: float) -> Caption:
    """An angle [rad] in degrees, as it is read off."""
    return say("{angle:.1f}°", angle=math.degrees(angle))


def _outer_radius(drawn: Analysis) -> float:
    """The radius of the arcs of the phase angles: outside the curve on which the trace point runs [mm of paper]."""
    curve = drawn.acts.get("pitch points", drawn.acts["outline"])
    return float(np.nanmax(np.abs(curve.shown))) + PHASE_ARC_OFFSET


def phases_steps(drawn: Analysis) -> list[Step]:
    """The step in which the phase angles are read, where they are."""
    if "phase_angles" not in drawn.readings:
        return []
    rows = [Row(_phase_caption(drawn, k), "", ()) for k in range(len(drawn.givens.motion.phases))]
    marks, lines = _phase_marks(drawn)
    said = say(
        "Read the phase angles. Where the outline begins or ends an arc about A, a dwell begins or ends: bring the "
        "follower to these places and measure the angles between its positions with a protractor. Where a rise and a "
        "return meet, s has its maximum or minimum: the top of the parabola through three stations."
    )
    why = say("While the outline keeps its distance from the cam centre, the follower dwells.")
    parts = (Part(said, lines, tuple(rows)),)
    return [Step(say("Phase angles"), parts, view_of(drawn), marks, ("phase_angles", "rise_angle"), why=why)]


def _phase_marks(drawn: Analysis) -> tuple[tuple[Mark, ...], tuple[Drawn, ...]]:
    """The angles of the phases outside the curve, against the rotation, and the lines between them."""
    givens, radius, angles = drawn.givens, _outer_radius(drawn), drawn.value("phase_angles")
    start, hand = complex(drawn.acts["starts"].shown[0]), errorless_hand(drawn)
    limits = np.angle(start) - sense(givens.rotation) * np.append(0.0, np.cumsum(angles))
    rays = hand.erect("limits of the phases", hand.given("cam centre", 0j * limits[:-1]), np.exp(1j * limits[:-1]))
    ends = turned_direction(radius + PHASE_ARC_OFFSET / 4 + 0j, limits[:-1])
    arcs = (
        AngleMark(0j, radius, min(both), max(both), _phase_caption(drawn, k), of=rays.act, index=rays.index[k : k + 1])
        for k, both in enumerate(pairwise(limits.tolist()))
    )
    return (Segments(0j * ends, ends, Role.AXIS).left_by(rays), *arcs), (rays,)


def _phase_caption(drawn: Analysis, k: int) -> Caption:
    angle = _rounded(drawn.value("phase_angles")[k])
    return say("{symbol} = {angle}", symbol=phase_symbol(drawn.givens.motion, k), angle=angle)


def angles_step(drawn: Analysis) -> Step:
    """The step in which the pressure angles are measured at the contact."""
    tangents, motion = drawn.acts["tangents"].first, drawn.acts["motion"].first
    alpha, s, sigma = drawn.value("alpha"), drawn.first("s"), sense(drawn.givens.rotation)
    # In a dwell it stays as it was: there the normals are not drawn.
    moving = np.flatnonzero(np.abs(np.roll(s, -1) - np.roll(s, 1)) > STANDSTILL * s.max())
    shown, lines = tangents[moving], motion[moving]
    normals = errorless_hand(drawn).perpendicular("normals", shown, shown)
    outward, along, places = (
        sigma * unit(normals.directions),
        unit(lines.directions),
        drawn.acts["places"].shown[moving],
    )
    inward = max(drawn.givens.roller_radius / drawn.givens.mu_l.per_mm, NORMAL_INWARD)
    at = normals.shown
    marks = (
        Segments(at - inward * outward, at + NORMAL_BEYOND * outward, Role.LIMIT).left_by(normals),
        Segments(places, places + NORMAL_BEYOND * along, Role.CONSTRUCTION).left_by(lines),
    )

    def measured(k: int) -> Caption:
        """The pressure angle at position k, as it is measured."""
        return say("{alpha:.1f}°", alpha=_without_minus_zero(math.degrees(alpha[k]), 1))

    k = int(np.argmax(np.abs(alpha)))
    said = say(
        "In every position hold a mirror across the pitch curve, and turn it until the curve runs into its image "
        "without a corner: it stands on the normal, which runs through the centre of the arc. Measure its angle with "
        "the line on which the follower moves, by protractor: {alpha} at position {k}."
    ).with_values(k=f"{k}", alpha=measured(k))
    part = run(said, STATION, _stations(drawn), tangents, settings=measured)
    top = say(
        "The maximum lies at the top of the parabola through three angles that follow one another: {rise:.2f}° on the "
        "rise, {back:.2f}° on the return."
    )
    if joints(drawn.givens).size:
        top = say(
            "Bring the follower to the joints of the outline too, where one arc passes into the next. The maximum lies "
            "there, or at the top of the parabola through three angles that follow one another: {rise:.2f}° on the "
            "rise, {back:.2f}° on the return."
        )
    rise, back = (float(np.degrees(drawn.value(f"max_{way}"))) for way in ("rise", "return"))
    top = top.with_values(rise=rise, back=back)
    why = say("Without friction the cam presses on the follower along the common normal.")
    reads = ("alpha", "max_rise", "max_return")
    return Step(say("Pressure angles at the contact"), (part, Part(top)), view_of(drawn), marks, reads, why=why)
