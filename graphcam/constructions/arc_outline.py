"""A cam flank of three circular arcs, with ruler and compass.

The third arc touches the second in G, so its centre lies on the line G C2.  If rho1 is laid off on that line from G to
P, the centre of the third arc is as far from P as from C1: the perpendicular bisector of C1 P meets the line in C3.
Laid off the other way it gives the other root.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.drafting.euclid import UP, along_to_circle, meet, perpendicular_bisector, turned, unit
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Arc, Circle, Dimension, Dots, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Hand, Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.plane import cross, dot
from graphcam.words import sequence

ARCS = View("arcs", say("Three arcs"), across="arcs x", up="arcs y")
CENTRE = np.zeros((), dtype=complex)
"""The cam centre O."""
OVERHANG = 6.0
"""How far a line runs on beyond the point that it was drawn for [mm]."""
SAME_RADIUS = 1e-6
"""Lengths this near to one another [mm of paper] are the same: rounding."""


@dataclass(frozen=True, eq=False)
class ThreeArcsGivens:
    """What lies on the board; see :func:`three_arcs`."""

    given: ThreeArcs
    dwell: float
    mu_l: Scale


ArcOutline = Construction[ThreeArcsGivens]


MEANING = Meaning(
    "three_arcs",
    say("The arcs"),
    say(
        "Where two circles touch, their centres and the point of touch lie on one line. From this alone the centres "
        "of the three arcs follow with ruler and compass."
    ),
    {
        "base": ReadingMeaning(say("radius of the base circle"), "OA", "mm"),
        "outer": ReadingMeaning(say("radius of the outer circle"), "OD", "mm"),
        **{
            f"{point}_{axis}": ReadingMeaning(
                sequence([point, axis]), f"{point} {axis}", "mm", (Compared(f"{point}_{axis}"),)
            )
            for point in ("C1", "C2", "C3", "F")
            for axis in "xy"
        },
        "rho2": ReadingMeaning(say("radius ρ₂"), "ρ₂", "mm", (Compared("rho2", say("ρ₂")),)),
        "rho3": ReadingMeaning(say("radius ρ₃"), "ρ₃", "mm", (Compared("rho3", say("ρ₃")),)),
        **{
            f"other_{point}_{axis}": ReadingMeaning(sequence([f"{point}′", axis]), f"{point}′ {axis}", "mm")
            for point in ("C3", "F")
            for axis in "xy"
        },
    },
)


def three_arcs(given: ThreeArcs, dwell: float, mu_l: Scale, pencil: Pencil) -> ArcOutline:
    """Find the centres and the points of touching of both roots.

    dwell : angle [rad] for which the outer circle holds the follower up
    mu_l : drawing scale [mm/mm]

    Readings [mm]: x and y of ``C1``, ``C2``, ``C3`` and ``F`` as ``C3_x`` ..., and of the other root's ``other_C3`` and
    ``other_F``; ``rho2``, ``rho3``, and the radii of the circles about the cam centre, ``base`` and ``outer``.
    Points: these, with ``A``, ``D``, ``G`` and the laid off ``P`` and ``other_P``.
    """
    hand = pencil.hand("three_arcs")
    rho1 = given.rho1 / mu_l.per_mm

    def plotted(point: Point) -> Points:
        """A given point [mm] on the paper, where the hand sets it."""
        return complex(*point) / mu_l.per_mm + hand.point(1)[..., 0]

    points = {"D": plotted(given.D), "G": plotted(given.G)}
    g, d = points["G"], points["D"]
    c1 = d - unit(d) * (rho1 + _dividers(hand)) if given.C1 is None else plotted(given.C1)
    if given.A is not None:
        points["given_A"] = plotted(given.A)
    if given.C2 is None:
        c2 = meet(*perpendicular_bisector(points["given_A"], g), CENTRE, points["given_A"])
    else:
        c2 = plotted(given.C2)
    rho2 = np.abs(c2 - g)
    points |= {"C1": c1, "C2": c2}
    for name, side in (("", 1), ("other_", -1)):
        p = g + side * unit(c2 - g) * (rho1 + _dividers(hand))
        c3 = meet(*perpendicular_bisector(c1, p), g, c2 - g)
        points |= {f"{name}P": p, f"{name}C3": c3, f"{name}F": _touching(c1, rho1, c3, g) + hand.point(1)[..., 0]}
    # The dwells' circles touch the arcs on the lines through the centres.
    points["A"] = along_to_circle(CENTRE, -c2, c2, rho2)
    points["D"] = along_to_circle(CENTRE, c1, c1, rho1)
    lengths = {"rho2": rho2, "rho3": np.abs(points["C3"] - g)}
    lengths |= {"base": np.abs(points["A"]), "outer": np.abs(points["D"])}
    for name in ("C1", "C2", "C3", "F", "other_C3", "other_F"):
        lengths |= {f"{name}_x": points[name].real, f"{name}_y": points[name].imag}
    readings = hand.readings(mu_l.per_mm, "mm", **lengths)
    return Construction(MEANING, ThreeArcsGivens(given, dwell, mu_l), pencil, readings, points, _draw)


def _dividers(hand: Hand) -> Floats:
    """The error of one setting of the dividers, ([samples])."""
    return hand.dividers(1)[..., 0]


def _touching(c1: Points, rho1: float, c3: Points, g: Points) -> Points:
    """F: of the two places where the line of centres meets the circle about C1 the one on the circle about C3."""
    with np.errstate(invalid="ignore"):
        radius, towards = np.abs(c3 - g), rho1 * unit(c1 - c3)
    beyond, between = c1 + towards, c1 - towards
    off = [np.abs(np.abs(f - c3) - radius) for f in (beyond, between)]
    return np.where(off[0] <= off[1], beyond, between)


def run(arcs: ArcOutline) -> int:
    """sigma of the first sample: +1 where the way from A to D is clockwise, so that the cam turns counter-clockwise."""
    return -1 if float(cross(arcs.first("A"), arcs.first("D"))) > 0 else 1


def mirrored(arcs: ArcOutline, points: Points) -> Points:
    """Points of the rise's flank, of the first sample, on the return's: across the middle of the upper dwell."""
    axis = turned(unit(arcs.first("D")), -run(arcs) * arcs.givens.dwell / 2)
    return axis**2 * np.conj(points)


def outline(arcs: ArcOutline, grown: float, role: Role) -> list[Mark]:
    """The closed profile of the first sample, all arcs ``grown`` by a roller's radius [mm of paper]."""
    a, g, f, d = (complex(arcs.first(name)) for name in ("A", "G", "F", "D"))
    c1, c2, c3 = (complex(arcs.first(name)) for name in ("C1", "C2", "C3"))
    marks: list[Mark] = []
    for centre, start, end in ((c2, a, g), (c3, g, f), (c1, f, d)):
        for flip in (False, True):
            three: Points = np.array([centre, start, end])
            c, p, q = (mirrored(arcs, three) if flip else three).tolist()
            marks.append(_arc(c, p, q, grown, role))
    sigma, dwell, rise = run(arcs), arcs.givens.dwell, float(abs(np.angle(d / a)))
    for start, angle in ((d, dwell), (complex(mirrored(arcs, np.asarray(a))), FULL_TURN - 2 * rise - dwell)):
        if angle > 0:
            first = float(np.angle(start))
            low, high = sorted((first, first - sigma * angle))
            marks.append(Arc(0j, abs(start) + grown, low, high, role))
    return marks


def _arc(centre: complex, start: complex, end: complex, grown: float, role: Role) -> Arc:
    """The shorter arc about a centre from one point to another."""
    turn, first = float(np.angle((end - centre) / (start - centre))), float(np.angle(start - centre))
    low, high = sorted((first, first + turn))
    return Arc(centre, abs(start - centre) + grown, low, high, role)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(arcs: ArcOutline) -> list[Step]:
    drawn = {name: complex(arcs.first(name)) for name in arcs.points}
    steps = [_data(arcs, drawn), _first_centre(arcs, drawn), _second_centre(arcs, drawn)]
    if np.isnan(drawn["C2"]):
        return steps
    for name in ("", "other_"):
        steps += _third_arc(arcs, drawn, name)
    if np.isnan(drawn["C3"]):
        return steps
    return [*steps, _profile(arcs, drawn)]


def _profile(arcs: ArcOutline, drawn: dict[str, complex]) -> Step:
    rho1, mu_l = arcs.givens.given.rho1, arcs.givens.mu_l.per_mm
    radii = {name: float(arcs.value(name)) for name in ("rho2", "rho3", "base", "outer")}
    said = say(
        "The arcs AG about C2, GF about C3 and FD about C1 are drawn, with the radii ρ₂ = {rho2:.3f} mm, ρ₃ = "
        "{rho3:.3f} mm and ρ₁ = {rho1:g} mm; they touch the circles of {base:.3f} mm and {outer:.3f} mm about O. The "
        "return is the mirror image; the outer circle holds the follower up over {dwell:.6g}°."
    ).where(rho1=rho1, dwell=np.degrees(arcs.givens.dwell), **radii)
    arms = (
        ("C1", "D", "ρ₁", rho1),
        ("C2", "G", "ρ₂", float(arcs.first("rho2")) * mu_l),
        ("C3", "F", "ρ₃", float(arcs.first("rho3")) * mu_l),
    )
    dimensions = [
        Dimension(drawn[centre], drawn[end], say("{name} = {rho:.2f}", name=name, rho=rho))
        for centre, end, name, rho in arms
    ]
    marks = (*outline(arcs, 0.0, Role.RESULT), *dimensions)
    return Step(say("The profile"), said, ARCS, marks, reads=("base", "outer"))


def _named(name: str, at: complex, away: complex = 0j) -> Label:
    return Label(at, name, towards=(at - away) / abs(at - away) if abs(at - away) > SAME_RADIUS else 1 + 1j)


def _at(arcs: ArcOutline, name: str) -> Caption:
    """A point's coordinates as they are told."""
    x, y = (float(arcs.value(reading)) for reading in _xy(name))
    return say("({x:.3f}, {y:.3f}) mm", x=x, y=y)


def _xy(name: str) -> tuple[str, str]:
    """The names of a point's two readings."""
    return f"{name}_x", f"{name}_y"


def _told(point: Point) -> Caption:
    return say("({x:g}, {y:g}) mm", x=point[0], y=point[1])


def _data(arcs: ArcOutline, drawn: dict[str, complex]) -> Step:
    given, mu_l = arcs.givens.given, arcs.givens.mu_l
    names = [name for name in ("A", "D", "G") if getattr(given, name) is not None]
    outer = Circle(0j, abs(drawn["D"]), Role.CONSTRUCTION)
    reach = np.array([-1, 1]) * (outer.radius + OVERHANG)
    plotted = (
        *(Line(reach + 0j, Role.AXIS), Line(UP * reach, Role.AXIS)),
        *(Dots(np.array([0j, *(drawn[name] for name in names)])), Label(0j, "O", towards=-1 - 1j)),
        *(_named(name, drawn[name]) for name in names),
    )
    points = sequence([say("{name} = {at}", name=name, at=_told(getattr(given, name))) for name in names])
    said = say("About the cam centre O the given points {points} are plotted at {ratio}, and the circle through D.")
    said = said.where(points=points, ratio=ratio_text(mu_l.per_mm))
    return Step(say("The data"), said, ARCS, (outer, *plotted), given=plotted)


def _first_centre(arcs: ArcOutline, drawn: dict[str, complex]) -> Step:
    given, c1, d = arcs.givens.given, drawn["C1"], drawn["D"]
    if given.C1 is None:
        said = say(
            "On the line OD the radius ρ₁ = {rho1:g} mm is stepped off from D to C1 = {at}, the centre of the first "
            "arc, which touches the outer circle in D."
        ).where(rho1=given.rho1, at=_at(arcs, "C1"))
    else:
        said = say(
            "The centre C1 = {at} of the first arc is plotted. Its circle, ρ₁ = {rho1:g} mm, touches one about O in D, "
            "on the line O C1."
        ).where(rho1=given.rho1, at=_told(given.C1))
    marks = (
        Line(np.array([0j, d * (1 + OVERHANG / abs(d))]), Role.CONSTRUCTION),
        Circle(c1, given.rho1 / arcs.givens.mu_l.per_mm, Role.CONSTRUCTION),
        Dots(np.array([c1])),
        _named("C1", c1, d),
    )
    return Step(say("The first centre"), said, ARCS, marks, reads=_xy("C1"))


def _second_centre(arcs: ArcOutline, drawn: dict[str, complex]) -> Step:
    given, c2, g, a = arcs.givens.given, drawn["C2"], drawn["G"], drawn["A"]
    if np.isnan(c2):
        said = say("The bisector of AG meets the line OA at less than a degree: C2 cannot be read.")
        return Step(say("The second centre"), said, ARCS, ())
    rho2 = float(arcs.value("rho2"))
    if given.C2 is None:
        said = say(
            "The chord AG is bisected; the perpendicular meets the line AO in C2 = {at}, the centre of the second arc: "
            "ρ₂ = C2 G = {rho2:.3f} mm."
        ).where(at=_at(arcs, "C2"), rho2=rho2)
        bisector = _bisector(a, g, c2)
    else:
        said = say(
            "The centre C2 = {at} of the second arc is plotted; its radius is C2 G = {rho2:.3f} mm. It touches a "
            "circle about O in A, on the line C2 O."
        ).where(at=_told(given.C2), rho2=rho2)
        bisector = ()
    marks = (
        Line(np.array([a * (1 + OVERHANG / abs(a)), c2]), Role.CONSTRUCTION),
        Line(np.array([g, c2]), Role.CONSTRUCTION),
        Circle(0j, abs(a), Role.CONSTRUCTION),
        *bisector,
        Dots(np.array([c2, a])),
        _named("C2", c2),
        *((_named("A", a),) if given.A is None else ()),
    )
    return Step(say("The second centre"), said, ARCS, marks, reads=(*_xy("C2"), "rho2"))


def _bisector(a: complex, b: complex, to: complex, role: Role = Role.CONSTRUCTION) -> tuple[Mark, ...]:
    """A chord, and its perpendicular bisector from a little beyond the middle to a point on it."""
    middle = (a + b) / 2
    along = to - middle
    start = middle - along / abs(along) * OVERHANG if abs(along) > SAME_RADIUS else middle
    return Line(np.array([a, b]), role), Line(np.array([start, to]), role)


def _third_arc(arcs: ArcOutline, drawn: dict[str, complex], name: str) -> list[Step]:
    """The centre of the third arc and F, of the one root or the ``other_``."""
    other = bool(name)
    p, c3, f, g, c1, c2 = (drawn[key] for key in (f"{name}P", f"{name}C3", f"{name}F", "G", "C1", "C2"))
    role, prime = (Role.HIDDEN, "′") if other else (Role.CONSTRUCTION, "")
    title = say("The third centre")
    laid_off = say("On the line G C2 the radius ρ₁ is laid off from G towards C2 to P.")
    if other:
        title = say("The other root")
        laid_off = say("On the line G C2 the radius ρ₁ is laid off from G away from C2 to P′.")
    if np.isnan(c3):
        parallel = say("The bisector of C1 P{prime} is almost parallel to the line: C3{prime} cannot be read.")
        return [Step(title, sequence([laid_off, parallel.where(prime=prime)], " "), ARCS, ())]
    rho3 = abs(c3 - g) * arcs.givens.mu_l.per_mm
    found_centre = say(
        "The perpendicular bisector of C1 P{prime} meets the line in C3{prime} = {c3}, as far from P{prime} as from "
        "C1: ρ₃{prime} = C3{prime} G = {rho3:.3f} mm."
    ).where(prime=prime, c3=_at(arcs, f"{name}C3"), rho3=rho3)
    centre = sequence([laid_off, found_centre], " ")
    touching = say("The line of centres C3{prime} C1 meets the circle about C1 in F{prime} = {f}. {orders}").where(
        prime=prime, f=_at(arcs, f"{name}F"), orders=_orders(f, c1, c3, g, c2, prime)
    )
    found = (
        *(*_bisector(c1, p, c3, role), Line(_whole(g, p, c3), role), Dots(np.array([p, c3]))),
        *(_named(f"P{prime}", p), _named(f"C3{prime}", c3)),
    )
    line = (Line(_whole(c3, c1, f), role), Dots(np.array([f])), _named(f"F{prime}", f))
    if other:
        reads = (*_xy("other_C3"), *_xy("other_F"))
        return [Step(title, sequence([centre, touching], " "), ARCS, (*found, *line), reads)]
    return [
        Step(title, centre, ARCS, found, reads=(*_xy("C3"), "rho3")),
        Step(say("Where it touches"), touching, ARCS, line, reads=_xy("F")),
    ]


def _whole(*points: complex) -> Points:
    """The two of three points of a line that lie farthest apart."""
    pairs = [np.array([a, b]) for k, a in enumerate(points) for b in points[k + 1 :]]
    return max(pairs, key=lambda pair: abs(pair[0] - pair[1]))


def _orders(f: complex, c1: complex, c3: complex, g: complex, c2: complex, prime: str) -> Caption:
    """What is read off the two lines of centres."""
    first = _order({f"F{prime}": f, "C1": c1, f"C3{prime}": c3})
    second = _order({"G": g, f"C3{prime}": c3, "C2": c2})
    verdict = say("such a cam cannot be built")
    if first == ["F", "C1", "C3"] and second == ["G", "C3", "C2"] and not prime:
        verdict = say("the arcs touch from inside, and the cam can be built")
    said = say("On the lines lie {first} and {second}, in these orders: {verdict}.")
    return said.where(first=sequence(first), second=sequence(second), verdict=verdict)


def _order(points: dict[str, complex]) -> list[str]:
    """The names of points of a line in their order, the first of the dictionary before the last."""
    names = list(points)
    ends = _whole(*points.values())
    along: Points = np.asarray(ends[1] - ends[0])
    place = {name: float(dot(along, np.asarray(at))) for name, at in points.items()}
    order = sorted(names, key=lambda name: place[name])
    return order if order.index(names[0]) < order.index(names[-1]) else order[::-1]
