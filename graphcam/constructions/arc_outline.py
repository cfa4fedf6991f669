"""A cam flank of three circular arcs, with ruler and compass.

The third arc touches the second in G, so its centre lies on the line G C2.  If rho1 is laid off on that line from G to
P, the centre of the third arc is as far from P as from C1: the perpendicular bisector of C1 P meets the line in C3.
Laid off the other way it gives the other root.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Arc, Dimension, Dots, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.motion import FULL_TURN
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.plane import cross, dot
from graphcam.words import sequence

ARCS = View("arcs", say("Three arcs"), across="arcs x", up="arcs y", scale=say("Three arcs, {ratio}"))
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
    scales={"arcs": "base"},
)


def three_arcs(given: ThreeArcs, dwell: float, mu_l: Scale, pencil: Pencil) -> ArcOutline:
    """Find the centres and the points of touching of both roots.

    dwell : angle [rad] for which the outer circle holds the follower up
    mu_l : drawing scale [mm/mm]

    Points: ``C1``, ``C2``, ``C3`` and ``F``, the other root's ``other_C3`` and ``other_F``, with ``A``, ``D``, ``G``
    and the laid off ``P`` and ``other_P``.
    """
    hand, rho1 = Hand(pencil, MEANING), given.rho1 / mu_l.per_mm
    o = hand.given("O")
    points = _plotted(hand, o, given, mu_l)
    d, g = points.pop("given_D"), points["G"]
    if given.C1 is None:
        points["C1"] = hand.lay_off("C1", d, hand.join("D O", d, o), rho1)
    if given.C2 is None:
        a = points["given_A"]
        hand.join("given_A G", a, g)
        points["C2"] = hand.cross("C2", hand.bisect("bisector of given_A G", a, g), hand.join("O A", o, a))
    c1, c2 = points["C1"], points["C2"]
    about_c1 = hand.circle("circle about C1", c1, rho1)
    line = hand.join("G C2", g, c2)
    for name, side in (("", 1), ("other_", -1)):
        p = hand.lay_off(f"{name}P", g, line.turned(side), rho1)
        hand.join(f"C1 {name}P", c1, p)
        c3 = hand.cross(f"{name}C3", hand.bisect(f"bisector of C1 {name}P", c1, p), line)
        f = _touching(hand, name, hand.join(f"C1 {name}C3", c1, c3), about_c1, between(c3, g))
        points |= {f"{name}P": p, f"{name}C3": c3, f"{name}F": f}
    # The dwells' circles touch the arcs on the lines through the centres.
    about_c2, _ = (hand.circle(f"circle about {c}", points[c], between(points[c], g)) for c in ("C2", "C3"))
    points["A"] = hand.cross("A", hand.join("O C2", o, c2).turned(-1), about_c2)
    points["D"] = hand.cross("D", hand.join("O C1", o, c1), about_c1)
    for name in ("A", "D"):
        hand.circle(f"circle through {name}", o, between(o, points[name]))
    radii = {"rho2": (c2, g), "rho3": (points["C3"], g), "base": (o, points["A"]), "outer": (o, points["D"])}
    for name, ends in radii.items():
        hand.read(name, between(*ends), mu_l.per_mm)
    for name in ("C1", "C2", "C3", "F", "other_C3", "other_F"):
        for reading, along in zip(_xy(name), (RIGHT, UP), strict=True):
            hand.read(reading, between(o, points[name], along), mu_l.per_mm)
    return hand.finished(ThreeArcsGivens(given, dwell, mu_l), _draw, points)


def _plotted(hand: Hand, o: Drawn, given: ThreeArcs, mu_l: Scale) -> dict[str, Drawn]:
    """The given points: laid off across, and up from there."""
    # A and D are found again, where the dwells' circles touch.
    places = {f"given_{p}" if p in "AD" else p: at for p, at in vars(given).items() if at is not None and p != "rho1"}
    x, y = np.array([*places.values()]).T / mu_l.per_mm
    plotted = hand.lay_off("given points", hand.erect("uprights", hand.lay_off("feet", o, RIGHT, x)), UP, y)
    return {name: hand.take(name, plotted, which=k) for k, name in enumerate(places)}


def _touching(hand: Hand, name: str, centres: Drawn, about_c1: Drawn, rho3: Setting) -> Drawn:
    """F: of the two places where the line of centres meets the circle about C1 the one on the circle about C3."""
    ends = hand.cross(f"{name}ends", hand.take(f"{name}both ways", centres.turned(-1), centres), about_c1)
    off = np.abs(np.abs(ends.points - (centres.points + centres.directions)[..., None]) - rho3.amount[..., None])
    return hand.take(f"{name}F", ends, which=np.argmin(off, axis=-1)[..., None])[0]


def run(arcs: ArcOutline) -> int:
    """sigma of the first sample: +1 where the way from A to D is clockwise, so that the cam turns counter-clockwise."""
    return -1 if float(cross(arcs.first("A"), arcs.first("D"))) > 0 else 1


def middle_of_dwell(arcs: ArcOutline) -> Drawn:
    """The line through the middle of the upper dwell: beyond it lies the mirror image of the rise, the return."""
    turn = -run(arcs) * arcs.givens.dwell / 2
    return showing(arcs).protractor("middle of the dwell", arcs.acts["O"].first, arcs.first("D"), turn)


def outline(arcs: ArcOutline, circles: Sequence[Drawn], joints: Points, role: Role) -> list[Mark]:
    """The closed profile of the first sample.

    circles : about C2, C3 and C1, and about O the outer and the base circle
    joints : (4,) where the arcs of the rise begin, and where the last one ends
    """
    hand, axis = showing(arcs), middle_of_dwell(arcs)
    image = hand.mirrored("joints of the return", hand.given("joints", joints), axis).points
    marks: list[Mark] = []
    for k, circle in enumerate(circles[:3]):
        turn = float(np.angle((joints[k + 1] - circle.place) / (joints[k] - circle.place)))
        other = hand.mirrored(f"{circle.act.name} on the return", circle.first, axis)
        marks += [_arc(circle, joints[k], turn, role), _arc(other, image[k], -turn, role)]
    dwell, rise = arcs.givens.dwell, float(abs(np.angle(joints[3] / joints[0])))
    dwells = zip(circles[3:], (joints[3], image[0]), (dwell, FULL_TURN - 2 * rise - dwell), strict=True)
    return marks + [_arc(circle, start, -run(arcs) * angle, role) for circle, start, angle in dwells if angle > 0]


def _arc(circle: Drawn, start: complex, turn: float, role: Role) -> Arc:
    """The part of a circle that begins at a point and turns by an angle [rad], counter-clockwise positive."""
    first = float(np.angle(start - circle.place))
    low, high = sorted((first, first + turn))
    return Arc(circle.place, float(np.asarray(circle.first.radius)), low, high, role, of=circle.act)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(arcs: ArcOutline) -> list[Step]:
    steps = [_data(arcs), _first_centre(arcs), _second_centre(arcs)]
    if not np.isnan(arcs.first("C2")):
        steps += [*_third_arc(arcs, ""), *_third_arc(arcs, "other_")]
    return steps if np.isnan(arcs.first("C3")) else [*steps, _profile(arcs)]


def _profile(arcs: ArcOutline) -> Step:
    rho1 = arcs.givens.given.rho1
    radii = {name: float(arcs.value(name)) for name in ("rho2", "rho3", "base", "outer")}
    said = say(
        "The arcs AG about C2, GF about C3 and FD about C1 are drawn, with the radii ρ₂ = {rho2:.3f} mm, ρ₃ = "
        "{rho3:.3f} mm and ρ₁ = {rho1:g} mm; they touch the circles of {base:.3f} mm and {outer:.3f} mm about O. The "
        "return is the mirror image; the outer circle holds the follower up over {dwell:.6g}°."
    ).where(rho1=rho1, dwell=np.degrees(arcs.givens.dwell), **radii)
    arms = (
        ("C1", "D", "ρ₁", rho1, arcs.acts["circle about C1"].act),
        ("C2", "G", "ρ₂", radii["rho2"], arcs.readings["rho2"].act),
        ("C3", "F", "ρ₃", radii["rho3"], arcs.readings["rho3"].act),
    )
    dimensions = [
        Dimension(arcs.acts[centre].place, arcs.acts[end].place, say("{name} = {rho:.2f}", name=name, rho=rho), of=of)
        for centre, end, name, rho, of in arms
    ]
    return Step(say("The profile"), said, ARCS, (*cam(arcs), *dimensions), reads=("base", "outer"))


def cam(arcs: ArcOutline) -> list[Mark]:
    """The closed profile of the cam."""
    circles = [arcs.acts[f"circle {name}"] for name in ("about C2", "about C3", "about C1", "through D", "through A")]
    return outline(arcs, circles, np.array([arcs.acts[name].place for name in "AGFD"]), Role.RESULT)


def _dots(arcs: ArcOutline, *names: str) -> Dots:
    return showing(arcs).take(" ".join(names), *(arcs.acts[name].first for name in names)).dots()


def _primed(name: str) -> str:
    """What a point is called on the paper."""
    return name.removeprefix("other_") + "′" * name.startswith("other_")


def _named(arcs: ArcOutline, name: str, away: complex = 0j) -> Label:
    """The name of a point, on the side that is ``away`` from a place."""
    way = arcs.acts[name].place - away
    return arcs.acts[name].label(_primed(name), way / abs(way) if abs(way) > SAME_RADIUS else 1 + 1j)


def _line(arcs: ArcOutline, name: str, *ends: complex | str, role: Role = Role.CONSTRUCTION) -> Line:
    """The part of a line between those two of its points that lie farthest apart."""
    places = [arcs.acts[end].place if isinstance(end, str) else end for end in ends]
    pair = max(combinations(places, 2), key=lambda pair: abs(pair[0] - pair[1]))
    return Line(np.array(pair), role, of=arcs.acts[name].act)


def _bisector(arcs: ArcOutline, a: str, b: str, to: str, role: Role = Role.CONSTRUCTION) -> tuple[Mark, ...]:
    """A chord, and its perpendicular bisector from a little beyond the middle to a point on it."""
    name, chord = f"bisector of {a} {b}", _line(arcs, f"{a} {b}", a, b, role=role)
    middle, along = arcs.acts[name].place, arcs.acts[to].place - arcs.acts[name].place
    start = middle - along / abs(along) * OVERHANG if abs(along) > SAME_RADIUS else middle
    return chord, _line(arcs, name, start, to, role=role)


def _at(arcs: ArcOutline, name: str) -> Caption:
    x, y = (float(arcs.value(reading)) for reading in _xy(name))
    return say("({x:.3f}, {y:.3f}) mm", x=x, y=y)


def _xy(name: str) -> tuple[str, str]:
    """The names of a point's two readings."""
    return f"{name}_x", f"{name}_y"


def _told(point: Point) -> Caption:
    return say("({x:g}, {y:g}) mm", x=point[0], y=point[1])


def _data(arcs: ArcOutline) -> Step:
    given, outer = arcs.givens.given, arcs.acts["circle through D"].drawn_circle(Role.CONSTRUCTION)
    names = [name for name in ("A", "D", "G") if getattr(given, name) is not None]
    reach = np.array([-1, 1]) * (outer.radius + OVERHANG)
    plotted = (
        *(Line(reach + 0j, Role.AXIS), Line(UP * reach, Role.AXIS)),
        *(_dots(arcs, "O", *names), arcs.acts["O"].label("O", -1 - 1j)),
        *(_named(arcs, name) for name in names),
    )
    points = sequence([say("{name} = {at}", name=name, at=_told(getattr(given, name))) for name in names])
    said = say("About the cam centre O the given points {points} are plotted at {ratio}, and the circle through D.")
    said = said.where(points=points, ratio=ratio_text(arcs.givens.mu_l.per_mm))
    return Step(say("The data"), said, ARCS, (outer, *plotted), given=plotted)


def _first_centre(arcs: ArcOutline) -> Step:
    given, d = arcs.givens.given, arcs.acts["D"].place
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
        _line(arcs, "O C1", 0j, d * (1 + OVERHANG / abs(d))),
        arcs.acts["circle about C1"].drawn_circle(Role.CONSTRUCTION),
        *(arcs.acts["C1"].dots(), _named(arcs, "C1", d)),
    )
    return Step(say("The first centre"), said, ARCS, marks, reads=_xy("C1"))


def _second_centre(arcs: ArcOutline) -> Step:
    given, a = arcs.givens.given, arcs.acts["A"].place
    if np.isnan(a):
        said = say("The bisector of AG meets the line OA at less than a degree: C2 cannot be read.")
        return Step(say("The second centre"), said, ARCS, ())
    rho2 = float(arcs.value("rho2"))
    if given.C2 is None:
        said = say(
            "The chord AG is bisected; the perpendicular meets the line AO in C2 = {at}, the centre of the second arc: "
            "ρ₂ = C2 G = {rho2:.3f} mm."
        ).where(at=_at(arcs, "C2"), rho2=rho2)
        bisector = _bisector(arcs, "given_A", "G", "C2")
    else:
        said = say(
            "The centre C2 = {at} of the second arc is plotted; its radius is C2 G = {rho2:.3f} mm. It touches a "
            "circle about O in A, on the line C2 O."
        ).where(at=_told(given.C2), rho2=rho2)
        bisector = ()
    marks = (
        _line(arcs, "O C2", a * (1 + OVERHANG / abs(a)), "C2"),
        _line(arcs, "G C2", "G", "C2"),
        arcs.acts["circle through A"].drawn_circle(Role.CONSTRUCTION),
        *(*bisector, _dots(arcs, "C2", "A"), _named(arcs, "C2")),
        *((_named(arcs, "A"),) if given.A is None else ()),
    )
    return Step(say("The second centre"), said, ARCS, marks, reads=(*_xy("C2"), "rho2"))


def _third_arc(arcs: ArcOutline, name: str) -> list[Step]:
    """The centre of the third arc and F, of the one root or the ``other_``."""
    p, c3, f = (f"{name}{point}" for point in ("P", "C3", "F"))
    role, prime = (Role.HIDDEN, "′") if name else (Role.CONSTRUCTION, "")
    title, laid_off = say("The third centre"), say("On the line G C2 the radius ρ₁ is laid off from G towards C2 to P.")
    if name:
        title = say("The other root")
        laid_off = say("On the line G C2 the radius ρ₁ is laid off from G away from C2 to P′.")
    if np.isnan(arcs.first(c3)):
        parallel = say("The bisector of C1 P{prime} is almost parallel to the line: C3{prime} cannot be read.")
        return [Step(title, sequence([laid_off, parallel.where(prime=prime)], " "), ARCS, ())]
    rho3 = abs(arcs.acts[c3].place - arcs.acts["G"].place) * arcs.givens.mu_l.per_mm
    found_centre = say(
        "The perpendicular bisector of C1 P{prime} meets the line in C3{prime} = {c3}, as far from P{prime} as from "
        "C1: ρ₃{prime} = C3{prime} G = {rho3:.3f} mm."
    ).where(prime=prime, c3=_at(arcs, c3), rho3=rho3)
    centre = sequence([laid_off, found_centre], " ")
    touching = say("The line of centres C3{prime} C1 meets the circle about C1 in F{prime} = {f}. {orders}").where(
        prime=prime, f=_at(arcs, f), orders=_orders(arcs, name)
    )
    lines = (*_bisector(arcs, "C1", p, c3, role), _line(arcs, "G C2", "G", p, c3, role=role))
    found = (*lines, _dots(arcs, p, c3), _named(arcs, p), _named(arcs, c3))
    line = (_line(arcs, f"C1 {c3}", c3, "C1", f, role=role), arcs.acts[f].dots(), _named(arcs, f))
    if name:
        return [Step(title, sequence([centre, touching], " "), ARCS, (*found, *line), (*_xy(c3), *_xy(f)))]
    return [
        Step(title, centre, ARCS, found, reads=(*_xy("C3"), "rho3")),
        Step(say("Where it touches"), touching, ARCS, line, reads=_xy("F")),
    ]


def _orders(arcs: ArcOutline, name: str) -> Caption:
    """What is read off the two lines of centres."""
    first, second = _order(arcs, f"{name}F", "C1", f"{name}C3"), _order(arcs, "G", f"{name}C3", "C2")
    built = (first, second) == (["F", "C1", "C3"], ["G", "C3", "C2"])
    can, cannot = say("the arcs touch from inside, and the cam can be built"), say("such a cam cannot be built")
    said = say("On the lines lie {first} and {second}, in these orders: {verdict}.")
    return said.where(first=sequence(first), second=sequence(second), verdict=can if built else cannot)


def _order(arcs: ArcOutline, *names: str) -> list[str]:
    """The names of points of a line in their order, the first before the last."""
    places = np.array([arcs.acts[name].place for name in names])
    return [_primed(names[k]) for k in np.argsort(dot(places[-1] - places[0], places))]
