"""The velocity and the acceleration of a roller on an arc, by the plans of a crank drive: the steps of the drawing.

See :mod:`~graphcam.constructions.arc_roller` for what is drawn.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from graphcam.constructions.arc_outline import unreadable_step
from graphcam.constructions.arc_profile import ARCS, CENTRES, ROLLER, ArcStations, RollerOnArcs, sense_sign
from graphcam.constructions.axes import standing_apart
from graphcam.constructions.velocity_plan import VelocityScale
from graphcam.constructions.views import at_scale
from graphcam.drafting import telling
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Part, Row, Step, View, say
from graphcam.drafting.marks import Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.scale import (
    NEGLIGIBLE_SIZE,
    Scale,
    coarsest_scale,
    ratio_text,
    standard_scale,
    unit as unit_named,
)
from graphcam.drafting.telling import Move, move_parts
from graphcam.given.laws import Floats

PLAN = View("plan", say("Velocity and acceleration"), across="plan", up="plan")
ACCELERATIONS = View("accelerations", say("The accelerations at all stations"), "accelerations x", "accelerations y")
SHOWN_PLACE = 2, 0.5
"""The plan is drawn for the station in the middle of the arc FD."""
MAX_PLAN_SIZE = 190.0
"""A plan is drawn at the largest standard scale at which it is not larger [mm]."""
PLAN_MARGINS = complex(20.0, 25.0)
"""What stands about a plan: letters, the ends of lines [mm]."""
LINE_OVERHANG = 7.0
"""How far the follower's line runs on beyond the plan [mm]."""


def shown_station(stations: ArcStations) -> int:
    """The station for which the plan is drawn."""
    on, share = SHOWN_PLACE
    return stations.spans[on].start + round(share * (stations.u.size // 3 - 1))


def worked_station(stations: ArcStations, values: Floats) -> int:
    """The station that is told in full: that of the plan, or the first at which there is a value."""
    at = shown_station(stations)
    return at if np.isfinite(values[at]) else int(np.argmax(np.isfinite(values)))


def plans(rolled: RollerOnArcs, ends: Iterable[str]) -> list[Step]:
    """The steps that draw the plan at one station move by move, then at every station.

    ends : the readings of the acceleration where arcs begin and end
    """
    return [*_plan(rolled), _velocities(rolled), _accelerations(rolled, ends)]


# --- at one station --------------------------------------------------------------------------------------------------


def _plan(rolled: RollerOnArcs) -> list[Step]:
    """The velocity and the acceleration at one station, enlarged, with the follower's line upright."""
    at, mu_l = shown_station(rolled.givens.stations), rolled.givens.arcs.givens.mu_l.per_mm
    station, upright = rolled.givens.stations.names[at], UP / rolled.first("ray")[at]
    places: Points = np.array([0j, *(rolled.first(name)[at] for name in PLACE_NAMES)]) * upright
    if np.isnan(places).any():
        said = say("At station {name} a line cannot be read: it crosses another at less than a degree.", name=station)
        return [unreadable_step(say("Velocity and acceleration"), said, PLAN)]
    scale = _scale(rolled, places, PLAN)
    hand, velocities = errorless_hand(rolled), VelocityScale(scale, rolled.givens.omega)
    _crank_drive(hand, rolled, at, upright * mu_l / scale.per_mm)
    return [_velocity(hand, rolled, at, velocities), _acceleration(hand, rolled, at, velocities)]


def _at_scale(station: str, scale: VelocityScale) -> View:
    """The view of the plan at a station, with its scales in the title."""
    title = say("v and a at station {name}, {ratio}, μᵥ = {mu:.4g} ({per_v})/mm, μₐ = {mu_a:.4g} ({per_a})/mm")
    scales = {"ratio": ratio_text(scale.mu_l.per_mm), "mu": scale.mu.per_mm, "per_v": unit_named(scale.mu.unit)}
    scales |= {"mu_a": scale.acceleration.per_mm, "per_a": unit_named(scale.acceleration.unit)}
    return replace(PLAN, title=title.with_values(name=station, **scales), mu_l=scale.mu_l.per_mm)


def _scale(rolled: RollerOnArcs, places: Points, view: View) -> Scale:
    """The largest standard scale at which places of the drawing of the roller fit a view of their own."""
    arcs = rolled.givens.arcs.givens
    size = arcs.mu_l.per_mm * complex(np.ptp(places.real), np.ptp(places.imag))
    usual = standard_scale(max(size.real, size.imag), MAX_PLAN_SIZE, arcs.paper.ratios)
    return arcs.paper.kept_scale(view.name) or coarsest_scale(usual, arcs.paper.scale(size, PLAN_MARGINS))


PLACE_NAMES = ("B", "C", "K", "right", "beyond", "N", "M")


def _crank_drive(hand: Hand, rolled: RollerOnArcs, at: int, times: complex) -> None:
    """Draw O, B and C of a station in another view, and the plans from them."""
    o = hand.enlarged("O", rolled.acts["O"].first, rolled.acts["O"].first, times)
    b, c = (hand.enlarged(name, rolled.acts[name].first[at], rolled.acts["O"].first, times) for name in "BC")
    follower, rod = hand.join("follower", o, b), hand.join("rod", b, c)
    outward = rod.turned(-1)
    k = hand.cross("K", rod, hand.perpendicular("across", follower, o))
    hand.join("OK", o, k)
    erected = hand.perpendicular("erected", outward, c)
    e = hand.lay_off("E", erected, erected, distance_between(c, k))
    beyond = hand.cross("N′", hand.perpendicular("square", hand.join("leg", e, b), e), rod)
    n = hand.lay_off("N", c, outward, distance_between(c, beyond))
    m = hand.cross("M", hand.perpendicular("to M", outward, n), follower)
    hand.join("OM", o, m)


def _segment(hand: Hand, line: str, start: str, end: str, role: Role = Role.CONSTRUCTION) -> Line:
    drawn = hand.acts[line]
    ends = np.array([hand.acts[name].place for name in (start, end)])
    return Line(ends, role).left_by(drawn)


def _distance(hand: Hand, start: str, end: str) -> float:
    return abs(hand.acts[end].place - hand.acts[start].place)


def _velocity(hand: Hand, rolled: RollerOnArcs, at: int, scale: VelocityScale) -> Step:
    arcs, acts, station, centre = (
        rolled.givens.arcs,
        hand.acts,
        rolled.givens.stations.names[at],
        CENTRES[SHOWN_PLACE[0]],
    )
    mu, ok = scale.mu_l.per_mm, _distance(hand, "O", "K")
    c, m, b, side = acts["C"].place, acts["M"].place, acts["B"].place, -float(sense_sign(arcs))
    values = {"name": station, "centre": centre, "arc": ARCS[SHOWN_PLACE[0]], "ratio": ratio_text(mu)}
    values |= {"times": arcs.givens.mu_l.per_mm / mu, "mu": mu, "v": float(rolled.value("v")[at])}
    values |= {"ob": _distance(hand, "O", "B"), "oc": _distance(hand, "O", "C"), "bc": _distance(hand, "B", "C")}
    values |= {"paper": ok, "side": say("on the left") if c.real < 0 else say("on the right")}
    opening = say(
        "Station {name}, on the arc {arc}, is drawn at {ratio} with the follower's line vertical: "
        "every length times {times:g}."
    )
    moves: list[Move] = [
        (
            say("Draw the follower's line vertical, and on it O and B above it: OB = {ob:.2f} mm."),
            *(acts[name] for name in ("O", "B", "follower")),
        ),
        (say("{centre}: with the dividers {oc:.2f} mm from O and {bc:.2f} mm from B, {side} of the line."), acts["C"]),
        (
            say("Draw the rod from B through {centre} as far as the horizontal line through O: they meet in K."),
            *(acts[name] for name in ("rod", "across", "K")),
        ),
        (say("OK = {paper:.2f} mm × {mu:g} = {v:.3f} mm/rad is the velocity v."), acts["OK"]),
    ]
    axis = np.array([min(0.0, m.imag, c.imag) - LINE_OVERHANG, b.imag + LINE_OVERHANG]) * UP
    speed = (
        ()
        if scale.omega is None
        else (Label(acts["K"].place / 2, scale.side_caption("v", ok), -UP, of=acts["OK"].act),)
    )
    names = (("O", "O", -side - 1j), ("B", "B", side + 0j), ("C", centre, -side - 1j), ("K", "K", side + 0j))
    marks: tuple[Mark, ...] = (
        Line(axis, Role.AXIS).left_by(acts["follower"]),
        *(acts["rod"].way(Role.CURVE), acts["OK"].way(Role.RESULT), _segment(hand, "rod", "B", "K", Role.CURVE)),
        *(acts[name].dots() for name in "OBCK"),
        *(acts[name].label(text, towards) for name, text, towards in names),
        *speed,
    )
    parts = move_parts(moves, values, [opening])
    why = say(
        "While the roller runs on one arc, O{centre} is a crank and {centre}B a rod, and OK is ds/dφ, as in every "
        "velocity plan.",
        centre=centre,
    )
    title, view = say("Velocity at station {name}", name=station), _at_scale(station, scale)
    return Step(title, parts, view, marks, why=why)


def _acceleration(hand: Hand, rolled: RollerOnArcs, at: int, scale: VelocityScale) -> Step:
    acts, station, centre = hand.acts, rolled.givens.stations.names[at], CENTRES[SHOWN_PLACE[0]]
    a, side = float(rolled.value("a")[at]), -float(sense_sign(rolled.givens.arcs))
    directed = say("it is directed towards the cam centre, because M lies on the side of B")
    if a > 0:
        directed = say("it is directed away from the cam centre, because M lies beyond O")
    values = {"centre": centre, "ck": _distance(hand, "C", "K"), "cn": _distance(hand, "C", "N′"), "directed": directed}
    values |= {"om": _distance(hand, "O", "M"), "mu": scale.mu_l.per_mm, "a": a}
    moves: list[Move] = [
        (
            say(
                "Square to the rod in {centre}, to the left going from {centre} to B, lay off {centre}E = {centre}K = "
                "{ck:.2f} mm."
            ),
            *(acts["erected"], acts["E"]),
        ),
        (
            say("Join E and B; square to EB, a line through E cuts {centre}N′ = {cn:.2f} mm off the rod."),
            *(acts[name] for name in ("leg", "square", "rod", "N′")),
        ),
        (say("With the dividers lay this length off from {centre} towards B: N."), acts["N"]),
        (say("Square to the rod, a line through N meets the follower's line in M."), acts["to M"], acts["M"]),
        (say("OM = {om:.2f} mm × {mu:g}: a = {a:.3f} mm/rad² is the acceleration; {directed}."), acts["OM"]),
    ]
    marks: tuple[Mark, ...] = (
        *(_segment(hand, "erected", "C", "E"), acts["leg"].way(Role.CONSTRUCTION)),
        *(_segment(hand, "square", "E", "N′"), _segment(hand, "rod", "N′", "C"), _segment(hand, "to M", "N", "M")),
        acts["OM"].way(Role.RESULT),
        *(acts[name].dots() for name in ("E", "N′", "N", "M")),
        *(acts["E"].label("E", side + 0j), acts["N′"].label("N′", -side + 0j)),
        *(acts["N"].label("N", side + 0j), acts["M"].label("M", -side + 0j)),
    )
    parts = move_parts(moves, values)
    why = say(
        "In a right triangle the height squared is the product of the parts of the base, so {centre}N is "
        "{centre}K²/{centre}B, the rod's normal acceleration.",
        centre=centre,
    )
    title = say("Acceleration at station {name}", name=station)
    return Step(title, parts, _at_scale(station, scale), marks, why=why)


# --- at all stations -------------------------------------------------------------------------------------------------

UNREADABLE = say("nothing can be read: a line crosses another at less than a degree")


def _velocities(rolled: RollerOnArcs) -> Step:
    """The step that finds K of every station, in the drawing of the roller itself."""
    stations, mu = rolled.givens.stations, rolled.givens.arcs.givens.mu_l.per_mm
    rods, across, k = (rolled.acts[name].first for name in ("rods", "across", "K"))
    paper, alpha = np.abs(k.shown), np.degrees(rolled.first("alpha"))
    at = worked_station(stations, paper)

    def told(j: int) -> Caption:
        """What is read at a place: OK on paper, the velocity [mm/rad], the pressure angle [degrees]."""
        if np.isnan(paper[j]):
            return UNREADABLE
        if paper[j] <= NEGLIGIBLE_SIZE:
            return say("the rod lies on the ray, so K coincides with O; velocity and pressure angle are zero")
        said = say("OK = {paper:.2f} mm × {mu:g} = {v:.3f} mm/rad, and {alpha:.2f}°")
        return said.with_values(paper=paper[j], mu=mu, v=float(rolled.value("v")[j]), alpha=alpha[j])

    rows = tuple(
        Row(telling.STATION.with_values(name=name), told(j[0]), (rods[j], across[j], k[j]))
        for name, j in stations.places.items()
    )
    named = standing_apart(k.shown, stations.ends_first)
    out = across.directions * -sense_sign(rolled.givens.arcs)
    marks: tuple[Mark, ...] = (
        Segments(rolled.acts["B"].shown, k.shown, Role.CONSTRUCTION).left_by(rods),
        Segments(np.zeros_like(k.shown), k.shown, Role.CURVE).left_by(across),
        k.dots(),
        *(k[j].label(stations.names[j], complex(unit(out)[j]), small=True) for j in named),
    )
    said = say(
        "Do the same at every station, in the drawing of the roller itself: draw the rod from B towards the centre of "
        "its arc as far as the line through O square to the ray; K has the number of its ray. The angle between rod "
        "and ray, read with the protractor, is the pressure angle. Station {name}: {there}."
    ).with_values(name=stations.names[at], there=told(at))
    why = say("The rod is the normal of the profile, so its angle with the follower's motion is the pressure angle.")
    return Step(say("Velocities at all stations"), (Part(said, rows=rows),), ROLLER, marks, ("v", "alpha"), why=why)


def _accelerations(rolled: RollerOnArcs, ends: Iterable[str]) -> Step:
    """The step that finds N and M of every station, in a view of their own, for M may lie far out."""
    stations, mu = rolled.givens.stations, rolled.givens.arcs.givens.mu_l.per_mm
    hand, o = errorless_hand(rolled), rolled.acts["O"].first
    places: Points = np.concatenate([[0j], *(rolled.first(name) for name in "BNM")])
    known = places[~np.isnan(places)]
    scale = _scale(rolled, known, ACCELERATIONS)
    b, n, m, across = (
        hand.enlarged(name, rolled.acts[name].first, o, mu / scale.per_mm)
        for name in ("B", "N", "M", "perpendiculars in N")
    )
    rays, centre = hand.join("rays", hand.enlarged("O", o, o, 1.0), b), [CENTRES[arc] for arc in stations.arc]
    ck, cn, om = (
        np.abs(rolled.first(end) - start)
        for end, start in (("K", rolled.first("C")), ("N", rolled.first("C")), ("M", 0j))
    )

    def told(j: int) -> Caption:
        """What is read at a place: the lengths on paper, and the acceleration [mm/rad²]."""
        if np.isnan(om[j]):
            return UNREADABLE
        n_at = say("{centre}N = {cn:.2f} mm") if cn[j] > NEGLIGIBLE_SIZE else say("N in {centre}")
        a = float(rolled.value("a")[j])
        way, named = say("beyond O") if a > 0 else say("towards B"), {"centre": centre[j], "cn": cn[j]}
        said = say(
            "{centre}E = {centre}K = {ck:.2f} mm, {n_at}, OM = {om:.2f} mm {way}, × {mu:g}: a = {a:.3f} mm/rad²"
        ).with_values(n_at=n_at.with_values(**named), **named)
        return said.with_values(ck=ck[j], om=om[j], mu=mu, way=way, a=a)

    named = standing_apart(m.shown, stations.ends_first)
    marks: tuple[Mark, ...] = (
        rays.segments(Role.CONSTRUCTION),
        Segments(np.zeros_like(m.shown), m.shown, Role.CURVE).left_by(rays),
        Segments(n.shown, m.shown, Role.CONSTRUCTION).left_by(across),
        *(b.dots(Role.CONSTRUCTION), m.dots(), n.dots(Role.CONSTRUCTION)),
        *(m[j].label(stations.names[j], complex(unit(m.shown)[j]), small=True) for j in named),
    )
    at = worked_station(stations, om)
    said = say(
        "Do the same at every station in the drawing of the roller, with E laid off square to the rod; only the rays, "
        "B, N and M are shown here, at {ratio}, and the lengths given are those in the drawing of the roller. Station "
        "{name}: {there}."
    ).with_values(ratio=ratio_text(scale.per_mm), name=stations.titles[at], there=told(at))
    why = say(
        "Where two arcs meet, the length of the rod changes suddenly, so the acceleration jumps, and such a "
        "station has two points M."
    )
    part = telling.run(said, telling.STATION, stations.titles, rays, b, n, across, m, settings=told)
    title = say("Accelerations at all stations")
    return Step(title, (part,), at_scale(ACCELERATIONS, scale), marks, ("a", *ends), why=why)
