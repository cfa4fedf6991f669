"""Diagrams of exact quantities over the turn: a curve, its axes, the extremes that are marked, a limit.

What the exact side knows at every cam angle, such as forces or stress, is shown as a curve, not drawn by hand.  A
diagram is given as a :class:`TurnDiagram`; several of them are one construction of the sheet, the note and the player.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import axes_over_phi, degrees, degrees_below, height_range, phase_ends, phase_symbol
from graphcam.constructions.graduation import graduation_marks, round_up
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, Construction, Part, Step, View, Words, say
from graphcam.drafting.marks import Dots, Label, Line, Mark, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.mechanism.turn_extremes import TurnCurve, ValueAt

TURN_WIDTH = 120.0
"""A turn is this long on paper [mm]."""
MAX_HEIGHT = 50.0
"""Diagrams have the largest round scale at which no ordinate is longer [mm]."""
BREAK_DISTANCE = 1e-9
"""What lies so near to a break of the motion lies on one side of it [rad]."""
ROUND_NUMBERS = (1.0, 2.0, 2.5, 5.0, 10.0)
"""Round scales are these times a power of ten."""


@dataclass(frozen=True, eq=False)
class TurnDiagram:
    """A quantity over the turn.

    name : of the diagram, its view and its axes among all others
    title : of the step;  heading : of the view, which may say the scale as {mu}
    ordinate : what the axis is called, with its unit;  unit : of the quantity, as "N"
    motion : whose phases divide the axis;  curve : the quantity
    caption : the step in sentences, which may say the scale as {mu};  why : the reason, in one sentence
    marked : extremes that get a dot, each with what stands beside it
    limit : what is permitted, a level line with what stands beside it
    wrong : stretches of the cam angle [rad] that are marked on the axis
    """

    name: str
    title: Caption
    heading: Caption
    ordinate: Caption
    unit: str
    motion: Motion
    curve: TurnCurve
    caption: Caption
    why: Caption = field(default_factory=lambda: Caption(""))
    marked: tuple[tuple[ValueAt, Words], ...] = ()
    limit: tuple[float, Words] | None = None
    wrong: tuple[tuple[float, float], ...] = ()

    @property
    def mu(self) -> Scale:
        """The scale of the ordinates."""
        values = np.abs(self.curve.values)
        greatest = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
        return diagram_scale(max(greatest, abs(self.limit[0]) if self.limit else 0.0), self.unit)


@dataclass(frozen=True, eq=False)
class TurnDiagrams:
    """Diagrams that belong together."""

    diagrams: tuple[TurnDiagram, ...]


def turn_diagrams(meaning: Meaning, diagrams: Sequence[TurnDiagram], pencil: Pencil) -> Construction[TurnDiagrams]:
    """Diagrams as one construction, a step for each; nothing is read off them.

    meaning : title and reason of all, and who tells the numbers in the note
    """
    return Construction(meaning, TurnDiagrams(tuple(diagrams)), pencil, {}, {}, diagram_steps)


def diagram_steps(drawn: Construction[TurnDiagrams]) -> list[Step]:
    """The diagrams, each in a step of its own."""
    return [diagram_step(diagram) for diagram in drawn.givens.diagrams]


def diagram_scale(greatest: float, unit: str) -> Scale:
    """The largest round scale at which an ordinate is not longer than :data:`MAX_HEIGHT`.

    >>> diagram_scale(160, "N").per_mm, diagram_scale(0.9, "").per_mm
    (5.0, 0.02)
    """
    return Scale(round_up(max(greatest, 1e-6) / MAX_HEIGHT, ROUND_NUMBERS)[0], unit)


def diagram_step(diagram: TurnDiagram) -> Step:
    """The curve with its axes, its marked extremes, its limit, and what is wrong."""
    motion, mu, mu_phi = diagram.motion, diagram.mu, Scale(FULL_TURN / TURN_WIDTH, "rad")
    points = diagram.curve.phi / mu_phi.per_mm + UP * diagram.curve.values / mu.per_mm
    level = [] if diagram.limit is None else [diagram.limit[0] / mu.per_mm]
    heights = np.append(points.imag, level)
    low, high = height_range(heights)
    ends = phase_ends(motion, mu_phi)
    axes = (
        *axes_over_phi(TURN_WIDTH, mu_phi, heights, diagram.ordinate),
        *graduation_marks(heights, mu.per_mm),
        *degrees_below(TURN_WIDTH, mu_phi, low),
        Segments(ends[1:] + low * UP, ends[1:] + high * UP, Role.CONSTRUCTION),
        *(
            Label(complex((a + b) / 2), phase_symbol(motion, k), towards=-UP, small=True)
            for k, (a, b) in enumerate(pairwise(ends))
        ),
    )
    marks: list[Mark] = [*axes, *(Line(run, Role.RESULT) for run in _number_stretches(points))]
    for found, said in diagram.marked:
        place = found.phi / mu_phi.per_mm + UP * found.value / mu.per_mm
        side = -UP if found.value <= np.nanmean(diagram.curve.values) else UP
        # Beside the mark, for over it stands the line of a phase's end, where extremes often lie.
        beside = 1 if place.real < TURN_WIDTH / 2 else -1
        marks += [Dots(np.array([place]), Role.LIMIT), Label(place, said, towards=side + beside)]
    if diagram.limit is not None:
        across = np.array([0.0, TURN_WIDTH]) + UP * level[0]
        marks += [Line(across, Role.LIMIT), Label(complex(across[1]), diagram.limit[1], towards=UP - 1)]
    wrong = [part for stretch in diagram.wrong for part in _in_turn(*stretch)]
    marks += [Line(np.array(each) / mu_phi.per_mm + 0j, Role.LIMIT) for each in wrong]
    values = {"mu": mu.per_mm}
    view = View(diagram.name, diagram.heading.with_values(**values), across="turn phi", up=f"{diagram.name} up")
    said = replace(diagram.caption, values={**diagram.caption.values, **values})
    return Step(diagram.title, (Part(said),), view, tuple(marks), given=axes, why=diagram.why)


def at_angle(phi: float) -> Caption:
    """The cam angle [rad] at which a value was found, in degrees as a drawing shows them."""
    return say("at {phi}", phi=say("{angle:.1f}°", angle=math.degrees(phi)))


def at_side(found: ValueAt, motion: Motion) -> Caption:
    """The cam angle at which a value stands, and the side of it where the motion has a break."""
    phi = degrees(found.phi)
    if np.abs(np.append(motion.breaks, FULL_TURN) - found.phi).min() > BREAK_DISTANCE:
        return at_angle(found.phi)
    return say("just before {phi}", phi=phi) if found.side == "left" else say("just after {phi}", phi=phi)


def plain_place(found: ValueAt, unit: str) -> dict[str, float | str]:
    """An extreme as plain data."""
    return {"value": found.value, "unit": unit, "phi_deg": math.degrees(found.phi), "side": found.side}


def _number_stretches(points: np.ndarray) -> list[np.ndarray]:
    known = np.flatnonzero(np.isfinite(points))
    runs = np.split(known, np.flatnonzero(np.diff(known) > 1) + 1)
    return [points[run] for run in runs if run.size > 1]


def _in_turn(start: float, end: float) -> list[tuple[float, float]]:
    """An interval that may run over the end of the turn, in parts inside it."""
    return [(start, end)] if end <= FULL_TURN else [(start, FULL_TURN), (0.0, end - FULL_TURN)]
