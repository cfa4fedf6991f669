"""The lines at the permitted angle to the normals of an arm's positions, as steps: beyond them no cam centre may lie.

A line is known by the name of its act, "limits: rise", "limits: return", "limits: rest" or "limits: reach".
"""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.arm_positions import ArmPositions, example_station, lift_directions, stroke
from graphcam.constructions.axes import degrees, station_names
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import errorless_hand
from graphcam.drafting.ink import Part, Step, Words, say
from graphcam.drafting.marks import AngleMark, Line, Points, Role, Segments
from graphcam.drafting.telling import run
from graphcam.given.follower import Limits, sense
from graphcam.plane_vectors import dot
from graphcam.words import say_in, sequence

MIN_LINE_LENGTH, LINE_OVERHANG = 20.0, 5.0
"""A line at a limit that does not bound the region is drawn only so far, one that does so far beyond it [mm]."""
ARM_OVERHANG_FACTOR = 1.3
"""An arm is produced so far beyond its end, in lengths of the arm."""
CORNER_DISTANCE = 1.0
"""A line that comes so near to a corner of the region bounds it [mm]."""


@dataclass(frozen=True)
class _AtLimit:
    """Lines at a limit [rad] to the arm's normal, and their side of it: 1 towards the pivot."""

    side: int
    limit: float

    @property
    def caption_values(self) -> dict[str, Words]:
        """Captions of the turn from the normal that points down, and of the side of the lines that A must lie on."""
        turn, kept = say("anticlockwise, towards C"), say_in("a side of a line", "away from C")
        if self.side < 0:
            turn, kept = say("clockwise, away from C"), say_in("a side of a line", "towards C")
        return {"limit": degrees(self.limit), "turn": turn, "kept": kept}


def _lines_downwards(lines: Drawn, hatched: Points) -> Segments:
    """The lines at a limit, from the ends D down along the region that they bound."""
    down = _down(lines)
    ends = [touch + way * bounding_length(touch, way, hatched) for touch, way in zip(lines.shown, down, strict=True)]
    return Segments(lines.shown, np.array(ends), Role.CONSTRUCTION).left_by(lines)


def _down(lines: Drawn) -> Points:
    along = unit(np.atleast_1d(lines.first.directions))
    return np.where(along.imag < 0, along, -along)


def bounding_length(touch: complex, way: complex, hatched: Points) -> float:
    """The length of a line from its touch, as far as it bounds the region of these corners [mm].

    >>> square = np.array([0j, 20 + 0j, 20 - 60j, -60j])
    >>> bounding_length(20 + 1j, -1j, square), bounding_length(30 + 1j, -1j, square)
    (66.0, 20.0)
    """
    along = dot(way, hatched - touch)[np.abs(dot(way * UP, hatched - touch)) < CORNER_DISTANCE]
    return max([MIN_LINE_LENGTH, *(along + LINE_OVERHANG).tolist()])


def family_step(drawn: ArmPositions, name: str, direction: int, limit: float, hatched: Points) -> Step:
    """The step that draws the lines at the limit of all arms of one direction, down to the region ``hatched``."""
    integrated, tips, lines = drawn.givens.integrated, drawn.acts["tips"], drawn.acts[f"limits: {name}"]
    so = _AtLimit(direction * sense(drawn.givens.rotation), limit)
    at, k = (
        np.flatnonzero(lift_directions(integrated) == direction).tolist(),
        example_station(integrated, tips, direction),
    )
    named, own = station_names(integrated.givens.stations), at.index(k)
    title, phase = say("Lines at the limit of the rise"), say("rise")
    if direction < 0:
        title, phase = say("Lines at the limit of the return"), say("return")
    square = say(
        "At every point D of the {phase} draw the normal to the arm downwards with the set squares; that at D{name} is "
        "shown."
    ).with_values(phase=phase, name=named[k])
    said = say(
        "From every D draw with the protractor the line at {limit} to its normal, turned from it {turn}. The cam "
        "centre A must lie on the side {kept}."
    ).with_values(**so.caption_values)
    normal, shown, angle = _normal(drawn, k, lines[own], so)
    # The worked one comes first.
    order = [own, *(i for i in range(len(at)) if i != own)]
    return Step(
        title,
        (Part(square, (normal,)), run(said, say("Line {name}"), [named[at[i]] for i in order], lines[order])),
        *(at_scale(REGION, drawn.givens.mu_l), (shown, _lines_downwards(lines, hatched), angle)),
        why=say(
            "The direction from D to the cam centre makes the pressure angle with the normal to the arm, and on the "
            "{phase} this angle may be at most {limit}."
        ).with_values(phase=phase, limit=degrees(limit)),
    )


def _normal(drawn: ArmPositions, station: int, line: Drawn, so: _AtLimit) -> tuple[Drawn, Line, AngleMark]:
    """The normal to an arm at its D, what is drawn of it, and the angle from there to the line at the limit."""
    hand, tip, length = errorless_hand(drawn), drawn.acts["tips"].first[station], abs(drawn.acts["start"].place)
    normal = hand.perpendicular("normal to the arm", drawn.acts["arms"].first[station], tip)
    begin = float(np.angle(normal.directions))
    start, end = sorted((begin, begin + so.side * so.limit))
    angle = AngleMark(tip.place, 0.25 * length, start, end, degrees(so.limit)).left_by(line)
    return normal, stroke(normal, 0.4 * length), angle


def dwells_step(drawn: ArmPositions, limits: Limits, hatched: Points) -> Step:
    """The step that draws the lines at the limits where the arm dwells, down to the region ``hatched``."""
    sigma, top = sense(drawn.givens.rotation), highest_arm(drawn)
    families = {"rest": _AtLimit(-sigma, limits.rise)}
    if limits.return_ is not None:
        families["rest after the return"] = _AtLimit(sigma, limits.return_)
    each = say(
        "From B₀ and from the end {top} of the highest arm draw lines with the protractor at {limit} to the normal "
        "downwards, turned from it {turn}. A must lie on the side {kept}."
    )
    parts, marks = list[Part](), list[Segments]()
    for name, so in families.items():
        lines, said = drawn.acts[f"limits: {name}"], each.with_values(top=top, **so.caption_values)
        if not parts:
            said = sequence([say("In a dwell D is the end of the arm."), said], " ")
        marks.append(_lines_downwards(lines, hatched))
        parts.append(run(said, say("From {name}"), ("B₀", top), lines))
    return Step(
        say("Lines at the limit in the dwells"),
        *(tuple(parts), at_scale(REGION, drawn.givens.mu_l), tuple(marks)),
        why=say("In a dwell nothing is laid off along the arm, and the angle is limited on the other side as well."),
    )


def highest_arm(drawn: ArmPositions) -> str:
    """The name of the highest arm: CB with its station."""
    integrated = drawn.givens.integrated
    return station_names(integrated.givens.stations)[int(np.argmax(integrated.first("s")))]


def reach_step(drawn: ArmPositions) -> Step:
    """The step that draws the lines of the lowest and of the highest arm: the cam centre lies below both."""
    lines, top = drawn.acts["limits: reach"], highest_arm(drawn)
    out = lines.shown - ARM_OVERHANG_FACTOR * abs(drawn.acts["start"].place) * unit(lines.first.directions)
    produced = Segments(lines.shown, out, Role.CONSTRUCTION).left_by(lines)
    return Step(
        say("The arm extended"),
        (
            Part(say("With the ruler extend CB₀ beyond B₀; A must lie below it."), (lines[0],)),
            Part(say("Extend the highest arm, {top}, beyond its end; A must lie below it too.", top=top), (lines[1],)),
        ),
        *(at_scale(REGION, drawn.givens.mu_l), (produced,)),
        why=say("The cam lies below the arm, which must not swing across the line of centres CA."),
    )
