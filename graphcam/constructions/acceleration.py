"""The acceleration diagram, drawn in a scale that is not yet known.

The greatest ordinate of the first rise is chosen, or of the first phase that has one: where the velocity jumps the
acceleration is infinite, or as good as that, and an arrow stands for it.  The lift of a phase goes as y F^2/C, so for
the displacement to come back to the axis every other ordinate must be y = y1 (C h/F^2)/(C1 h1/F1^2).  Which
acceleration a millimetre means is known only after two integrations, when the known lift fixes the scale.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import isclose
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import (
    ARROW_OVERHANG,
    BROKEN_DWELL,
    MIN_INFINITE_ARROW,
    degrees,
    height_range,
    joined_parts,
    number_labels,
    part_titles,
    phase_ends,
    phase_names,
    phase_title,
    station_names,
)
from graphcam.constructions.graduation import time_axis_caption
from graphcam.constructions.law_names import law_name
from graphcam.constructions.turn_board import TurnGivens
from graphcam.constructions.views import ACCELERATION
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Construction, Part, Step, say
from graphcam.drafting.marks import Arrow, Dimension, Label, Mark, Role, Segments
from graphcam.drafting.meaning import LIFT, MU_PHI, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.telling import FRENCH_CURVE, RULER, introduced_parts
from graphcam.given.laws import Floats, Side
from graphcam.given.monotone_spline import MEASURED_LAW
from graphcam.given.motion import FULL_TURN, Motion, MovingPhase
from graphcam.given.stations import Stations
from graphcam.words import Caption, and_list, sequence

AccelerationDiagram = Construction[TurnGivens]


def _scale_of_angle(diagram: AccelerationDiagram) -> Values:
    mu_phi = diagram.givens.mu_phi
    shown = float(np.degrees(FULL_TURN - mu_phi.left_out))
    yield {"shown": shown, "base": float(diagram.first("base")), "mu": mu_phi.per_mm}


def _ordinate_values(diagram: AccelerationDiagram) -> Values:
    """The formula's values for every ordinate that follows from the chosen one, phase by phase."""
    stations, greatest = diagram.givens.stations, diagram.first("greatest").tolist()
    phases, index = moving_phases(diagram.givens.motion, stations), stations.phase[stations.last].tolist()
    first = index.index(diagram.givens.motion.reference[0])

    def terms(k: int, of: str) -> dict[str, Any]:
        """The values that the lift of phase ``k`` is proportional to; ``of`` ends their names."""
        phase = phases[k]
        law = {f"C{of}": phase.normalised.steady_acceleration, f"h{of}": phase.lift}
        return {**law, f"k{of}": index[k] + 1, f"angle{of}": float(np.degrees(phase.angle)), f"y{of}": greatest[k]}

    yield from (terms(k, "") | terms(first, "1") for k in range(len(phases)) if k != first and greatest[k])


FORMULAS = (
    Formula(
        r"\mu_\varphi = \frac{\Phi}{b}\cdot\frac{\pi}{180^\circ}",
        r"\mu_\varphi = \frac{<shown:.6g>^\circ}{<base:.2f>}\cdot\frac{\pi}{180^\circ} = <mu:.6f>\ \text{<rad_per_mm>}",
        _scale_of_angle,
        (
            MU_PHI,
            Symbol(r"\Phi", say("the angle that the axis shows, without what broken dwells leave out"), "°"),
            Symbol("b", say("the length of the axis"), "mm of paper"),
        ),
        of="base",
    ),
    Formula(
        r"y_k = y_1\,\frac{C_k h_k/\varphi_k^2}{C_1 h_1/\varphi_1^2}, \qquad C = \frac{a_{\max}\varphi^2}{h}",
        r"y_{<k>} = <y1:.2f> \cdot \frac{<C:.6g> \cdot <h:.6g>/<angle:.6g>^2}"
        r"{<C1:.6g> \cdot <h1:.6g>/<angle1:.6g>^2} = <y:.2f>\ \text{<mm>}",
        _ordinate_values,
        (
            Symbol("y", say("the maximum ordinate of a phase, y₁ that of the first rise"), "mm of paper"),
            Symbol("C", say("the factor of its law")),
            LIFT,
            Symbol(r"\varphi_k", say("the angle of a phase"), "°"),
        ),
        of="greatest",
    ),
)


MEANING = Meaning(
    "acceleration",
    say("Acceleration diagram"),
    say(
        "The laws of the motion give the shape of the acceleration. Its scale is not known yet: the first "
        "ordinate is chosen freely, and the others follow, so that the displacement returns to the axis."
    ),
    {
        "greatest": ReadingMeaning(say("maximum ordinates"), "y", "mm of paper", over=phase_names),
        "middles": ReadingMeaning(say("middle ordinates"), "yₘ", "mm of paper", over=part_titles),
        "base": ReadingMeaning(say("length of the axis"), "b", "rad"),
    },
    FORMULAS,
)


def acceleration_diagram(
    motion: Motion,
    stations: Stations,
    ordinate: float,
    mu_phi: Scale,
    unit: str,
    pencil: Pencil,
    *,
    omega: float | None = None,
) -> AccelerationDiagram:
    """Lay off the cam angle, choose the ordinate of the first rise, compute the others, plot the middle ordinates.

    ordinate : greatest ordinate of the first rise [mm of paper]
    mu_phi : scale of the cam angle [rad/mm];  unit : of the lift
    omega : of the cam [rad/s], where the task gives a speed: then the axis is one of time too

    Readings besides those of the meaning: ordinates at the ``stations``, and ``before``, on the near side of a jump.
    Points: the stations on the ``axis``, the ``plotted`` ordinates there, and those on the ``near side`` of a jump.
    """
    hand, phases = Hand(pencil, MEANING), moving_phases(motion, stations)
    _, reference = motion.reference
    greatest = ordinate * np.array([phase.steady_acceleration for phase in phases]) / reference

    origin, u, left = hand.given("origin"), stations.u, stations.left
    turn = hand.lay_off("turn", origin, RIGHT, mu_phi.paper(FULL_TURN))
    axis, begins = _station_ticks(hand, origin, stations, mu_phi), [span.start for span in stations.phases]

    def ordinates(u: Floats, phase: NDArray[np.intp], side: Side = "right") -> Floats:
        """The ordinates [mm of paper] at parts u of phases; 0 where the velocity jumps."""
        drawn = np.where(motion.in_blow(phase, u, side), 0.0, motion.at(phase, u, side)[2])
        return ordinate / reference * drawn

    tops = hand.lay_off("greatest", axis[begins], UP, greatest)
    after, before = ordinates(u, stations.phase), ordinates(u, stations.phase, "left")
    plotted = hand.lay_off("stations", axis, UP, after)
    # Where the acceleration jumps a second ordinate stands on the near side.
    jumps = np.flatnonzero(np.abs(after - before) > SAME_ORDINATE * ordinate)
    near = hand.lay_off("before the jumps", axis[jumps], UP, before[jumps])
    which = np.arange(u.size)
    which[jumps] = u.size + np.arange(jumps.size)
    middles = hand.divide("middles of the parts", axis[left], axis[left + 1], 0.5)
    middle = hand.lay_off("middles", middles, UP, ordinates((u[left] + u[left + 1]) / 2, stations.phase[left]))
    hand.read("greatest", distance_between(axis[begins], tops, UP), 1.0, rounded=False)
    nearer = hand.take("before", plotted, near, which=which)
    for name, ends in (("stations", plotted), ("before", nearer)):
        hand.read(name, distance_between(axis, ends, UP), 1.0, "mm of paper", rounded=False)
    hand.read("middles", distance_between(middles, middle, UP), 1.0, rounded=False)
    hand.read("base", distance_between(origin, turn), mu_phi.per_mm, rounded=False)
    # What a chord between neighbouring stations is drawn from and to.
    plotted, nearer = hand.take("plotted", plotted), hand.take("near side", nearer)
    givens = TurnGivens(motion, stations, ordinate, mu_phi, unit, omega=omega)
    return hand.finished(givens, _draw, {"axis": axis, "plotted": plotted, "near side": nearer})


def _station_ticks(hand: Hand, origin: Drawn, stations: Stations, mu_phi: Scale) -> Drawn:
    """The stations on the axis: the phases are laid off, and each of their stretches is divided into equal parts."""
    bounds = np.array([[stretch.start, stretch.stop - 1] for stretch in stations.stretches])
    places, at = np.unique(stations.phi[bounds], return_inverse=True)
    cuts = hand.lay_off("cuts", origin, RIGHT, mu_phi.paper(places))
    station = np.arange(stations.u.size)
    stretch = np.searchsorted(bounds[:, 0], station, side="right") - 1
    start, end = at.reshape(bounds.shape)[stretch].T
    share = (station - bounds[stretch, 0]) / (bounds[:, 1] - bounds[:, 0])[stretch]
    return hand.divide("axis", cuts[start], cuts[end], share)


def moving_phases(motion: Motion, stations: Stations) -> list[MovingPhase]:
    """The rises and returns that the stations divide, in order."""
    phases = [motion.phases[k] for k in stations.phase[stations.last]]
    return [phase for phase in phases if isinstance(phase, MovingPhase)]


def equal_parts(stations: Stations) -> Caption:
    """A sentence on which parts are equal to one another."""
    if stations.stretches == stations.pieces and not stations.finer:
        return say("equal between jumps of the acceleration")
    return say("equal between jumps and corners of the acceleration")


def _shape(phase: MovingPhase, u: Floats, side: Side = "right") -> Floats:
    """The given ordinates of a law as fractions of its greatest, none in a blow; a return begins downwards."""
    greatest, (low, high) = phase.normalised.steady_acceleration, phase.normalised.steady
    if not greatest:
        return np.zeros_like(u)
    shape = phase.direction * phase.normalised(u, side=side)[2] / greatest
    return np.where((u < low) | (u > high), 0.0, shape)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(diagram: AccelerationDiagram) -> list[Step]:
    motion, stations = diagram.givens.motion, diagram.givens.stations
    x = diagram.first("axis").real
    moving = zip(
        (phase_title(motion, k) for k in stations.phase[stations.last].tolist()),
        moving_phases(motion, stations),
        diagram.first("greatest").tolist(),
        ((x[span.start], x[span.stop - 1]) for span in stations.phases),
        strict=True,
    )
    laws = [_LawOverPhase(*each) for each in moving]
    curves = [law.drawn(errorless_hand(diagram), k) for k, law in enumerate(laws)]
    lines = tuple(curve.line(Role.RESULT) for curve in curves)
    reach = _reach(motion, np.concatenate([curve.shown.imag for curve in curves]))
    shape = say("The maximum ordinate of a phase is known now, and all others are in proportion to it.")
    return [
        _axis(diagram, reach),
        _ordinates(diagram, laws, curves),
        Step(
            say("Acceleration by the law"),
            (*_law_parts(laws, curves), *_blow_parts(motion)),
            ACCELERATION,
            (*lines, *_arrows(diagram, reach)),
            why=shape,
        ),
        _middle_ordinates(diagram),
    ]


def _law_parts(laws: Sequence[_LawOverPhase], curves: Sequence[Drawn]) -> tuple[Part, ...]:
    """The parts that tell how the curves are drawn: by a textbook's law, or by the ordinates of a smoothed table."""
    named = [say("{phase} {law}", phase=law.title, law=law_name(law.phase.normalised)) for law in laws]
    told = say(
        "Over each moving phase draw the acceleration by its law: {laws}. Ordinates above the axis are positive; "
        "at a jump the line is vertical."
    ).with_values(laws=sequence(named))
    if all(law.phase.normalised.name == MEASURED_LAW for law in laws):
        told = say(
            "The motion is a table, which has no law: its acceleration is that of the smoothed table, as under "
            "“{section}”. Ordinates above the axis are positive."
        ).with_values(section=say("Velocity and acceleration by differentiation"))
    return introduced_parts(told, [Part(law.told(), (curve,)) for law, curve in zip(laws, curves, strict=True)])


def _reach(motion: Motion, heights: Floats) -> Floats:
    """The heights of the curves with those of the arrows for an acceleration that cannot be drawn [mm of paper]."""
    low, high = height_range(heights)
    tips = {
        max(high + ARROW_OVERHANG, MIN_INFINITE_ARROW)
        if blow.acceleration > 0
        else min(low - ARROW_OVERHANG, -MIN_INFINITE_ARROW)
        for blow in motion.blows
    }
    return np.append(heights, [*tips])


def _blow_parts(motion: Motion) -> Iterator[Part]:
    """The parts that say where an arrow stands for the acceleration."""
    for how, said in (
        (True, say("At {places} the velocity jumps: there the acceleration is infinite, and an arrow stands for it.")),
        (False, say("At {places} the acceleration is too short and too high to be drawn: an arrow stands for it.")),
    ):
        if places := dict.fromkeys(blow.phi % FULL_TURN for blow in motion.blows if np.isinf(blow.acceleration) == how):
            yield Part(said.with_values(places=and_list([degrees(phi) for phi in places])))


def _arrows(diagram: AccelerationDiagram, reach: Floats) -> Iterator[Mark]:
    """The arrows with the sign of infinity, or with the acceleration; of two blows at one place one."""
    low, high = height_range(reach)
    for phi, acceleration in dict.fromkeys(diagram.givens.motion.blows):
        foot = complex(diagram.givens.mu_phi.paper(phi))
        tip = foot + UP * (high if acceleration > 0 else low)
        text = "∞" if np.isinf(acceleration) else say("{a:.3g}", a=abs(acceleration))
        yield Arrow(foot, tip, Role.LIMIT)
        yield Label(tip, text, towards=1 + 0j)


def _axis(diagram: AccelerationDiagram, heights: Floats) -> Step:
    """The step that draws the axes, for ordinates of these ``heights`` [mm]."""
    motion, mu_phi, stations = diagram.givens.motion, diagram.givens.mu_phi, diagram.givens.stations
    omega = diagram.givens.omega
    turn, ends = diagram.acts["turn"], phase_ends(motion, mu_phi)
    level = say(
        "With T-square and ruler draw a horizontal line {length:.1f} mm long for one revolution, so 1 mm is "
        "{degree:.4g}° and μᵩ = {mu:.5f} rad/mm."
    ).with_values(length=ends[-1], degree=np.degrees(mu_phi.per_mm), mu=mu_phi.per_mm)
    if mu_phi.middles:
        broken = [k for k, (start, stop) in enumerate(pairwise(ends)) if any(start < x < stop for x in mu_phi.middles)]
        level = say(
            "With T-square and ruler draw a horizontal line {length:.1f} mm long for one revolution. Broken by two "
            "short strokes and only {room:g} mm long, because nothing moves there: {dwells}. Elsewhere 1 mm is "
            "{degree:.4g}° and μᵩ = {mu:.5f} rad/mm."
        ).with_values(**level.values, dwells=and_list([phase_title(motion, k) for k in broken]), room=BROKEN_DWELL)
    level = level if omega is None else sequence([level, time_axis_caption(mu_phi, omega)], " ")
    upright = say(
        "From its left end set off {ends} mm with the ruler, where the phases end, and draw a vertical at each with "
        "the set square."
    ).with_values(ends=sequence([say("{end:.1f}", end=end) for end in ends[1:]]))
    cuts = diagram.acts["axis"].first[[k for span in stations.phases for k in (span.start, span.stop - 1)]]
    across, up, thin, *others = diagram.givens.axes("a", heights)
    # A thin line belongs to the cut that it stands on; that at the end of the turn goes with the last one.
    nearest = [int(np.argmin(np.abs(cuts.shown.real - end))) for end in ends[1:]]
    thin = replace(thin, of=cuts.act, index=cuts.index[nearest])
    axes = (across, up, thin, *others, turn.line_from(0j, Role.RESULT))
    title = say("Axis of the cam angle")
    why = say("All diagrams are drawn over the cam angle, so one axis with one scale serves them all.")
    parts, under = (Part(level, (turn.first,)), Part(upright, (cuts,))), diagram.givens.degrees_under(heights)
    return Step(title, parts, ACCELERATION, axes, ("base",), given=axes, why=why, under=under)


def _ordinates(diagram: AccelerationDiagram, laws: Sequence[_LawOverPhase], curves: Sequence[Drawn]) -> Step:
    moving = diagram.givens.stations.phase[diagram.givens.stations.last].tolist()
    chosen = moving.index(diagram.givens.motion.reference[0])
    title = say("Ordinates of the phases")
    if not laws[chosen].greatest:
        none = say("The velocity is constant between its jumps: no phase has an ordinate of the acceleration.")
        why = say("Then nothing can be integrated from the acceleration: the velocity is laid off by the law.")
        return Step(title, (Part(none),), ACCELERATION, (), ("greatest",), why=why)
    having = [k for k, law in enumerate(laws) if law.greatest]
    numbers = [
        say("{c:.5g} ({phase})", c=laws[k].phase.normalised.steady_acceleration, phase=laws[k].title) for k in having
    ]
    choice = say("Choose {y:.1f} mm for the maximum ordinate of {phase}; its scale is found at the end.")
    others = say(
        "The others follow from y = y₁·(C·h/φ²)/(C₁·h₁/φ₁²), with lift h and angle φ of the phase and C = aₘₐₓ·φ²/h "
        "of its law, here {numbers}."
    ).with_values(numbers=sequence(numbers))
    marks = tuple(_dimension(diagram, k, laws[k], curves[k]) for k in having)
    ends = diagram.acts["greatest"].first
    first = Part(choice.with_values(phase=laws[chosen].title, y=laws[chosen].greatest), (ends[[chosen]],))
    reckoned = [Part(laws[k].reckoned(laws[chosen]), (ends[[k]],)) for k in having if k != chosen]
    why = say(
        "The lift of a phase is proportional to y·φ²/C, so the displacement returns to the axis only if the "
        "ordinates are in this ratio."
    )
    parts = first, *introduced_parts(others, reckoned)
    return Step(title, parts, ACCELERATION, marks, ("greatest",), why=why)


@dataclass(frozen=True)
class _LawOverPhase:
    """A moving phase on the paper: its name, its largest ordinate [mm] and its ends on the axis [mm]."""

    title: Caption
    phase: MovingPhase
    greatest: float
    ends: tuple[float, float]

    def branches(self) -> Iterator[tuple[Floats, Floats]]:
        """Places on the axis and ordinates [mm] between jumps and corners; of a straight branch its ends alone."""
        law = self.phase.normalised
        for first, last in pairwise(sorted({0.0, *law.jumps, *law.corners, *law.steady, 1.0})):
            u = np.linspace(first, last, 97)
            height = self.greatest * np.append(_shape(self.phase, u[:-1]), _shape(self.phase, u[-1:], "left"))
            straight = np.abs(height - np.linspace(height[0], height[-1], u.size)).max() < SAME_ORDINATE * self.greatest
            shown = [0, -1] if straight else slice(None)
            yield self.ends[0] + (self.ends[1] - self.ends[0]) * u[shown], height[shown]

    def drawn(self, hand: Hand, k: int) -> Drawn:
        """The k-th curve, from the axis and back to it, upright where the acceleration jumps."""
        x, y = zip(*self.branches(), strict=True)
        feet = hand.given("feet of the law", np.concatenate([self.ends[:1], *x, self.ends[1:]]))
        return hand.lay_off(f"law {k}", feet, UP, np.concatenate([[0.0], *y, [0.0]]))

    def told(self) -> Caption:
        """A sentence with the ordinates that the curve is drawn through."""
        if not self.greatest:
            return say("Over {phase} the acceleration is zero: draw it along the axis.", phase=self.title)
        branches = list(self.branches())
        curved = any(x.size > 2 for x, _ in branches)
        branches = [(x, y) if x.size == 2 else (x[::PLOTTED_STEP], y[::PLOTTED_STEP]) for x, y in branches]
        # What is nothing has no sign; a corner, where one branch goes on from another, is one point.
        ends = [(a, b + 0.0) for x, y in branches for a, b in zip(x, np.round(y, 1), strict=True)]
        ends = [end for end, before in zip(ends, (None, *ends), strict=False) if end != before]
        places = [say("{y:.1f} at {x:.1f}", x=a, y=b) for a, b in ends]
        said = say("Over {phase} set off the ordinates {places} mm and join them {tool}.")
        return said.with_values(phase=self.title, places=sequence(places), tool=FRENCH_CURVE if curved else RULER)

    def reckoned(self, first: _LawOverPhase) -> Caption:
        """How the maximum ordinate follows from the chosen one, less the factors that are equal in both phases."""
        ours, theirs = self.phase, first.phase
        c, c1 = ours.normalised.steady_acceleration, theirs.normalised.steady_acceleration
        factors = [
            *([say("{c:.5g}/{c1:.5g}", c=c, c1=c1)] if not isclose(c, c1) else []),
            *([say("{h:.5g}/{h1:.5g}", h=ours.lift, h1=theirs.lift)] if not isclose(ours.lift, theirs.lift) else []),
        ]
        if not isclose(ours.angle, theirs.angle):
            angles = {"phi": degrees(ours.angle), "phi1": degrees(theirs.angle)}
            factors.append(say("({phi1}/{phi})²").with_values(**angles))
        if not factors:
            return say("For {phase} take {y:.1f} mm again.", phase=self.title, y=self.greatest)
        values = {"phase": self.title, "y1": first.greatest, "y": self.greatest, "factors": sequence(factors, " × ")}
        return say("For {phase} take {y1:.1f} mm × {factors} = {y:.1f} mm.").with_values(**values)


def _middle_ordinates(diagram: AccelerationDiagram) -> Step:
    stations, axis, middles = diagram.givens.stations, diagram.acts["axis"], diagram.acts["middles"]
    x = axis.shown
    marks = (
        middles.segments_from(diagram.acts["middles of the parts"], Role.CONSTRUCTION),
        middles.dots(Role.CONSTRUCTION),
        Segments(x - UP, x + UP, Role.SCALE).left_by(axis),
        # On the side of the axis where no ordinates stand.
        *number_labels(axis, stations, np.where(diagram.first("before") + diagram.first("stations") < 0, UP, -UP)),
    )
    why = say(
        "A part's area is its width times its middle ordinate, exactly where the acceleration is a straight line, and "
        "very nearly elsewhere."
    )
    divided = say(
        "Divide the moving phases into parts, {equal}, and number the cuts; each part has the number of the cut at its "
        "end."
    ).with_values(equal=equal_parts(stations))
    if finer := [phase_title(diagram.givens.motion, k) for k in stations.finer]:
        said = say(
            "Over {phases} the acceleration lasts less than a usual part, and would be missed between two middle "
            "ordinates or counted whole: there its corners are cuts, and the parts are shorter where it acts."
        )
        divided = sequence([divided, said.with_values(phases=and_list(finer))], " ")
    parts = introduced_parts(
        divided, [part for k in range(len(stations.phases)) for part in _divided_phase(diagram, k)]
    )
    return Step(say("Middle ordinates"), parts, ACCELERATION, marks, ("middles",), given=marks, why=why)


def _divided_phase(diagram: AccelerationDiagram, k: int) -> Iterator[Part]:
    """The parts of the k-th moving phase, and their middle ordinates."""
    motion, stations, ordinates = diagram.givens.motion, diagram.givens.stations, diagram.first("middles")
    x, span, own = diagram.first("axis").real, stations.phases[k], stations.parts[k]
    runs: list[tuple[int, int]] = []
    blows = stations.left[stations.blows]
    stretches = (s for s in stations.stretches if span.start <= s.start < span.stop and s.start not in blows)
    for start, stop in ((s.start, s.stop - 1) for s in stretches):
        first = runs[-1][0] if runs else start
        # Stretches whose parts are as wide as the last ones' go on with these.
        if runs and abs((x[stop] - x[start]) / (stop - start) - (x[first + 1] - x[first])) < SAME_LENGTH:
            runs[-1] = (first, stop)
        else:
            runs.append((start, stop))
    cut = [
        say("{start:.1f} to {stop:.1f} mm into {n} parts of {width:.2f} mm").with_values(
            start=x[a], stop=x[b], n=b - a, width=(x[b] - x[a]) / (b - a)
        )
        for a, b in runs
    ]
    title, names = phase_title(motion, int(stations.phase[span.start])), station_names(stations)[span]
    divided = say("Over {phase} divide {cuts} with the dividers; number the cuts {first} to {last}.")
    values = {"phase": title, "cuts": and_list(cut), "first": names[0], "last": names[-1]}
    yield Part(divided.with_values(**values), (diagram.acts["axis"].first[span],))
    heights: list[list[int]] = []
    for part in np.arange(own.start, own.stop)[~stations.blows[own]].tolist():
        if heights and abs(ordinates[part] - ordinates[heights[-1][0]]) < SAME_LENGTH:
            heights[-1].append(part)
        else:
            heights.append([part])
    told = [say("{parts}: {y:z.1f}", parts=joined_parts(same, stations), y=ordinates[same[0]]) for same in heights]
    raised = say(
        "Over {phase} draw a thin ordinate at the middle of each part up to the curve with the set square, in mm: "
        "{ordinates}."
    )
    lines = tuple(diagram.acts[name].first[own] for name in ("middles of the parts", "middles"))
    yield Part(raised.with_values(phase=title, ordinates=sequence(told, "; ")), lines)


DIMENSION_OFFSET, MIN_DIMENSION_OFFSET = 6.0, 3.0
"""The dimension of the greatest ordinate stands so far beyond the part of the curve that is on its side [mm]; at least
so far."""


def _dimension(diagram: AccelerationDiagram, k: int, law: _LawOverPhase, curve: Drawn) -> Dimension:
    """The dimension of a phase's largest ordinate, beyond where the curve crosses the axis: clear of the others."""
    line, of = curve.shown, diagram.acts["greatest"]
    side = float(np.sign(line.imag[np.argmax(np.abs(line.imag))]))
    height = side * line.imag
    # A curve is drawn through points, of which none need be its highest.
    top = complex(line.real[np.flatnonzero(height >= (1 - SAME_ORDINATE) * height.max())[-1]], side * law.greatest)
    crossing = float(line.real[np.flatnonzero(height > SAME_ORDINATE * height.max())[-1]])
    room = (float(line.real[-1]) - crossing) / 2
    # Where the curve ends on this side, its dimension stands beyond the end: on the curve's own upright it cannot.
    by = crossing + (min(DIMENSION_OFFSET, room) if room >= MIN_DIMENSION_OFFSET else 2 * room + DIMENSION_OFFSET)
    by -= top.real
    # To the right of an ordinate that points up is on the negative side of its dimension.
    aside, text = -by if top.imag > 0 else by, say("{y:.1f}", y=law.greatest)
    return Dimension(complex(top.real), top, text, aside, of=of.act, index=of.index[[k]])


PLOTTED_STEP = 8
"""Every eighth of the 97 points of a branch of a law is told."""
SAME_LENGTH = 5e-3
"""Lengths [mm] that differ by less are told as one."""
SAME_ORDINATE = 1e-6
"""Ordinates that differ by less than this part of the greatest are one."""
