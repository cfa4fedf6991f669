"""A cam flank of three circular arcs, with ruler and compass.

The third arc touches the second in G, so its centre lies on the line G C2.  If rho1 is laid off on that line from G to
P, the centre of the third arc is as far from P as from C1: the perpendicular bisector of C1 P meets the line in C3.
Laid off the other way it gives the other root.
"""

from itertools import combinations

import numpy as np

from graphcam.constructions.arc_profile import (
    SENSE_NAMES,
    ArcOutline,
    ThreeArcsGivens,
    arc,
    cam,
    middle_of_dwell,
    sense_sign,
)
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import BISECTION_SHARE, Hand, distance_between
from graphcam.drafting.ink import Caption, Part, Step, View, say
from graphcam.drafting.marks import Dimension, Label, Line, Mark, Role
from graphcam.drafting.meaning import ComparedReading, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import UNLIMITED, Paper, Scale, ratio_text
from graphcam.drafting.telling import Move, move_parts
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.plane_vectors import dot
from graphcam.subscripts import indexed
from graphcam.words import and_list, sequence

ARCS = View("arcs", say("Three arcs"), across="arcs x", up="arcs y", scale=say("Three arcs, {ratio}"), main=True)
AXIS_OVERHANG = 6.0
"""How far a line runs on beyond the point that it was drawn for [mm]."""
SAME_RADIUS = 1e-6
"""Lengths this near to one another [mm of paper] are the same: rounding."""


def _centres_apart(arcs: ArcOutline) -> Values:
    """The formula's values: the radius that is found, and how far its centre lies from C1 [mm]."""
    c1, c3 = (complex(arcs.first(name)) for name in ("C1", "C3"))
    if not np.isnan(c3):
        apart = abs(c3 - c1) * arcs.givens.mu_l.per_mm
        yield {"rho1": arcs.givens.given.rho1, "rho3": float(arcs.value("rho3")), "apart": apart}


MEANING = Meaning(
    "three_arcs",
    say("The arcs"),
    say(
        "Where two circles touch, their centres and the point of contact lie on one line. This alone gives the "
        "centres of the three arcs with ruler and compass."
    ),
    {
        "base": ReadingMeaning(say("radius of the base circle"), "OA", "mm"),
        "outer": ReadingMeaning(say("radius of the outer circle"), "OD", "mm"),
        **{
            f"{point}_{axis}": ReadingMeaning(
                sequence([indexed(point), axis]),
                f"{indexed(point)} {axis}",
                "mm",
                (ComparedReading(f"{point}_{axis}"),),
            )
            for point in ("C1", "C2", "C3", "F")
            for axis in "xy"
        },
        "rho2": ReadingMeaning(say("radius ρ₂"), "ρ₂", "mm", (ComparedReading("rho2", say("ρ₂")),)),
        "rho3": ReadingMeaning(say("radius ρ₃"), "ρ₃", "mm", (ComparedReading("rho3", say("ρ₃")),)),
        **{
            f"other_{point}_{axis}": ReadingMeaning(
                sequence([f"{indexed(point)}′", axis]), f"{indexed(point)}′ {axis}", "mm"
            )
            for point in ("C3", "F")
            for axis in "xy"
        },
    },
    (
        Formula(
            r"C_3C_1 = \rho_3 - \rho_1, \qquad C_3G = \rho_3",
            r"C_3C_1 = <rho3:.3f> - <rho1:g> = <apart:.3f>\ \text{<mm>}, \qquad C_3G = <rho3:.3f>\ \text{<mm>}",
            _centres_apart,
            (
                Symbol(r"\rho_1", say("the radius of the arc about C₁"), "mm"),
                Symbol(r"\rho_3", say("the radius of the arc about C₃"), "mm"),
            ),
            "rho3",
        ),
    ),
    scales={"arcs": "base"},
)


def three_arcs(given: ThreeArcs, dwell: float, mu_l: Scale, pencil: Pencil, paper: Paper = UNLIMITED) -> ArcOutline:
    """Find the centres of the arcs and the points of contact, for both roots.

    dwell : angle [rad] for which the outer circle holds the follower up
    mu_l : drawing scale [mm/mm]
    paper : for the plans of the roller on the arcs

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
        f = _touching(hand, name, hand.join(f"C1 {name}C3", c1, c3), about_c1, distance_between(c3, g))
        points |= {f"{name}P": p, f"{name}C3": c3, f"{name}F": f}
    # The dwells' circles touch the arcs on the lines through the centres.
    about_c2, _ = (hand.circle(f"circle about {c}", points[c], distance_between(points[c], g)) for c in ("C2", "C3"))
    points["A"] = hand.cross("A", hand.join("O C2", o, c2).turned(-1), about_c2)
    points["D"] = hand.cross("D", hand.join("O C1", o, c1), about_c1)
    for name in ("A", "D"):
        hand.circle(f"circle through {name}", o, distance_between(o, points[name]))
    radii = {"rho2": (c2, g), "rho3": (points["C3"], g), "base": (o, points["A"]), "outer": (o, points["D"])}
    for name, ends in radii.items():
        hand.read(name, distance_between(*ends), mu_l.per_mm)
    for name in ("C1", "C2", "C3", "F", "other_C3", "other_F"):
        for reading, along in zip(_xy(name), (RIGHT, UP), strict=True):
            hand.read(reading, distance_between(o, points[name], along), mu_l.per_mm)
    return hand.finished(ThreeArcsGivens(given, dwell, mu_l, paper), _draw, points)


def _plotted(hand: Hand, o: Drawn, given: ThreeArcs, mu_l: Scale) -> dict[str, Drawn]:
    """The given points by name, laid off across and then up or down."""
    # A and D are found again, where the dwells' circles touch.
    places = {f"given_{p}" if p in "AD" else p: at for p, at in vars(given).items() if at is not None and p != "rho1"}
    x, y = np.array([*places.values()]).T / mu_l.per_mm
    plotted = hand.lay_off("given points", hand.erect("verticals", hand.lay_off("feet", o, RIGHT, x)), UP, y)
    return {name: hand.take(name, plotted, which=k) for k, name in enumerate(places)}


def _touching(hand: Hand, name: str, centres: Drawn, about_c1: Drawn, rho3: Setting) -> Drawn:
    """F: the meeting of the line of centres with the circle about C1 that lies on the circle about C3."""
    ends = hand.cross(f"{name}ends", hand.take(f"{name}both ways", centres.turned(-1), centres), about_c1)
    off = np.abs(np.abs(ends.points - (centres.points + centres.directions)[..., None]) - rho3.amount[..., None])
    return hand.take(f"{name}F", ends, which=np.argmin(off, axis=-1)[..., None])[0]


# --- the steps -------------------------------------------------------------------------------------------------------


def unreadable_step(title: Caption, said: Caption, view: View) -> Step:
    """The step in place of one that cannot be drawn, for lines cross at less than a degree."""
    why = say("Lines that cross at less than a degree have no point of intersection that can be read.")
    return Step(title, (Part(said),), view, (), why=why)


def _draw(arcs: ArcOutline) -> list[Step]:
    steps = [_data(arcs), _first_centre(arcs), _second_centre(arcs)]
    if not np.isnan(arcs.first("C2")):
        steps += [*_third_arc(arcs, ""), *_third_arc(arcs, "other_")]
    return steps if np.isnan(arcs.first("C3")) else [*steps, _profile(arcs)]


PLOT_CAPTION = say("{name} = {told}: from O lay off {way}.")


def _plot(arcs: ArcOutline, name: str, point: Point) -> Move:
    """The move that lays a given point off, across and then up or down."""
    at, across, up = complex(*point) / arcs.givens.mu_l.per_mm, say("{mm:.2f} mm to the right"), say("{mm:.2f} mm up")
    if at.real < 0:
        across = say("{mm:.2f} mm to the left")
    if at.imag < 0:
        up = say("{mm:.2f} mm down")
    ways = [way.with_values(mm=mm) for way, mm in ((across, abs(at.real)), (up, abs(at.imag))) if mm > SAME_RADIUS]
    told = say("({x:g}, {y:g}) mm", x=point[0], y=point[1])
    drawn = arcs.acts[f"given_{name}" if name in "AD" else name]
    return PLOT_CAPTION.with_values(name=indexed(name), told=told, way=and_list(ways)), drawn


def _data(arcs: ArcOutline) -> Step:
    given, mu_l, o = arcs.givens.given, arcs.givens.mu_l.per_mm, arcs.acts["O"]
    axes = say("Draw two axes through the cam centre O, and plot at {ratio}: every length times {times:g}.")
    moves = [_plot(arcs, name, at) for name in "ADG" if (at := getattr(given, name)) is not None]
    parts = move_parts(moves, {"ratio": ratio_text(mu_l), "times": 1 / mu_l}, [axes])
    reach = np.array([-1, 1]) * (abs(complex(*given.D)) / mu_l + AXIS_OVERHANG)
    plotted: tuple[Mark, ...] = (
        *(Line(reach + 0j, Role.AXIS), Line(UP * reach, Role.AXIS), o.dots(), o.label("O", -1 - 1j)),
        *(at.dots() for part in parts for at in part.draws),
        *(at.label(at.act.name[-1], complex(unit(at.shown).item())) for part in parts for at in part.draws),
    )
    why = say("Everything else follows from these points and the radius ρ₁ alone, so they come first.")
    return Step(say("The data"), parts, ARCS, plotted, given=plotted, why=why)


OUTER_CIRCLE_CAPTION = say("Draw the outer circle about O through D: compass {outer:.2f} mm.")


def _first_centre(arcs: ArcOutline) -> Step:
    given, mu_l, acts = arcs.givens.given, arcs.givens.mu_l.per_mm, arcs.acts
    c1, d, about, outer = (acts[name] for name in ("C1", "D", "circle about C1", "circle through D"))
    values = {"rho1": given.rho1, "radius": given.rho1 / mu_l, "outer": abs(d.place), "at": _at(arcs, "C1")}
    circle = say("Draw the circle about C₁: compass {radius:.2f} mm, ρ₁ = {rho1:g} mm."), about
    if given.C1 is None:
        stepped = say("With the dividers step {radius:.2f} mm off from D towards O: C₁ = {at}.")
        joined_with, join = "D O", (say("Join D and O with the ruler."), acts["D O"])
        moves = [join, (stepped, c1), circle, (OUTER_CIRCLE_CAPTION, d, outer)]
    else:
        join = say("Join O and C₁; of the two crossings with the circle, D is the one beyond C₁.")
        joined_with, plotted = "O C1", _plot(arcs, "C1", given.C1)
        moves = [plotted, circle, (join, acts["O C1"], d), (OUTER_CIRCLE_CAPTION, outer)]
    marks = (
        _line(arcs, joined_with, 0j, d.place * (1 + AXIS_OVERHANG / abs(d.place))),
        *(about.drawn_circle(Role.CONSTRUCTION), c1.dots(), d.dots(), _named(arcs, "C1", d.place)),
        outer.drawn_circle(Role.CONSTRUCTION),
    )
    why = say("The outer circle and the arc about C₁ touch in D, so O, C₁ and D lie on one line.")
    parts = move_parts(moves, values)
    return Step(say("The first centre"), parts, ARCS, marks, (*_xy("C1"), "outer"), why=why)


def _second_centre(arcs: ArcOutline) -> Step:
    given, acts, mu_l = arcs.givens.given, arcs.acts, arcs.givens.mu_l.per_mm
    a, c2, g, about = (acts[name] for name in ("A", "C2", "G", "circle about C2"))
    if np.isnan(a.place):
        said = say("The bisector of AG meets the line OA at less than a degree: C₂ cannot be read.")
        return unreadable_step(say("The second centre"), said, ARCS)
    radius = abs(g.place - c2.place)
    values = {"rho2": radius * mu_l, "radius": radius, "mu": mu_l, "base": abs(a.place), "at": _at(arcs, "C2")}
    if given.C2 is None:
        chord, on, bisector = acts["given_A G"], "O A", _bisector(arcs, "given_A", "G", "C2")
        values["compass"] = BISECTION_SHARE * float(abs(chord.first.directions))
        halved = say("Bisect AG: compass {compass:.2f} mm about both ends, the ruler through the two crossings.")
        found: list[Move] = [
            (say("Join A and G with the ruler."), chord),
            (halved, acts["bisector of given_A G"]),
            (say("Extend the line AO beyond O as far as the bisector: C₂ = {at}."), acts["O A"], c2),
        ]
    else:
        on, bisector = "O C2", ()
        found = [_plot(arcs, "C2", given.C2), (say("Join C₂ and O, and go on beyond O."), acts["O C2"])]
    moves = [
        *found,
        (say("Join G and C₂: ρ₂ = C₂ G = {radius:.2f} mm × {mu:g} = {rho2:.3f} mm."), acts["G C2"]),
        (say("Draw the arc about C₂ from G with {radius:.2f} mm: it meets that line beyond O in A."), about, a),
        (say("Draw the base circle about O through A: compass {base:.2f} mm."), acts["circle through A"]),
    ]
    turn = float(np.angle((a.place - c2.place) / (g.place - c2.place)))
    marks = (
        *(_line(arcs, on, a.place * (1 + AXIS_OVERHANG / abs(a.place)), "C2"), _line(arcs, "G C2", "G", "C2")),
        arc(about, g.place, turn, Role.CONSTRUCTION, AXIS_OVERHANG),
        acts["circle through A"].drawn_circle(Role.CONSTRUCTION),
        *(*bisector, c2.dots(), a.dots(), _named(arcs, "C2"), *((_named(arcs, "A"),) if given.A is None else ())),
    )
    why = say("The arc touches the base circle in A, so O lies on the line C₂ A, and C₂ is as far from A as from G.")
    reads, parts = (*_xy("C2"), "rho2", "base"), move_parts(moves, values)
    return Step(say("The second centre"), parts, ARCS, marks, reads, why=why)


LAID_OFF = say("Set the dividers to {step:.2f} mm, ρ₁, and lay it off on the line G C₂ from G {side}: P{prime}.")


def _third_arc(arcs: ArcOutline, name: str) -> list[Step]:
    """The steps that find the centre of the third arc and F, for one root or the ``other_``."""
    p, c3, f = (f"{name}{point}" for point in ("P", "C3", "F"))
    role, mu_l, acts = Role.HIDDEN if name else Role.CONSTRUCTION, arcs.givens.mu_l.per_mm, arcs.acts
    chord, radius = abs(acts[p].place - acts["C1"].place), abs(acts[c3].place - acts["G"].place)
    values = {"prime": "′" if name else "", "step": arcs.givens.given.rho1 / mu_l, "compass": BISECTION_SHARE * chord}
    values |= {"radius": radius, "mu": mu_l, "rho3": radius * mu_l}
    values |= {"c3": _at(arcs, c3), "f": _at(arcs, f), "side": say("away from C₂") if name else say("towards C₂")}
    title = say("The other root") if name else say("The third centre")
    if np.isnan(arcs.first(c3)):
        parallel = say("The bisector of C₁ P{prime} is almost parallel to the line: C₃{prime} cannot be read.")
        said = sequence([each.with_values(**values) for each in (LAID_OFF, parallel)], " ")
        return [unreadable_step(title, said, ARCS)]
    to_c3 = [
        (LAID_OFF, acts["G C2"], acts[p]),
        (say("Join C₁ and P{prime} with the ruler."), acts[f"C1 {p}"]),
        (
            say("Bisect C₁ P{prime}: compass {compass:.2f} mm about both ends, the ruler through the two crossings."),
            acts[f"bisector of C1 {p}"],
        ),
        (
            say(
                "Where the bisector meets the line G C₂ is C₃{prime} = {c3}: ρ₃{prime} = C₃{prime} G = {radius:.2f} mm "
                "× {mu:g} = {rho3:.3f} mm."
            ),
            acts[c3],
        ),
    ]
    to_f = [
        (say("Join C₃{prime} and C₁, and go on to both crossings with the circle about C₁."), acts[f"C1 {c3}"]),
        (say("The crossing {radius:.2f} mm from C₃{prime}, as far as G, is F{prime} = {f}."), acts[f]),
    ]
    centre = (
        *(_line(arcs, "G C2", "G", p, c3, role=role), *_bisector(arcs, "C1", p, c3, role)),
        *(acts[p].dots(), acts[c3].dots(), _named(arcs, p), _named(arcs, c3)),
    )
    line = (_line(arcs, f"C1 {c3}", c3, "C1", f, role=role), acts[f].dots(), _named(arcs, f))
    orders = _orders(arcs, name)
    if name:
        why = say(
            "Laid off the other way, ρ₁ leads to a second centre as far from P′ as from C₁, so that there are two "
            "roots."
        )
        parts = move_parts([*to_c3, *to_f], values, last=[orders])
        return [Step(title, parts, ARCS, (*centre, *line), (*_xy(c3), *_xy(f)), why=why)]
    why = say("C₃ lies on the line G C₂, and as C₃ P and C₃ C₁ both are ρ₃ − ρ₁, on the bisector of C₁ P.")
    touch = say("The arcs about C₃ and C₁ touch in F, so C₃, C₁ and F lie on one line.")
    first, last = move_parts(to_c3, values), move_parts(to_f, values, last=[orders])
    return [
        Step(title, first, ARCS, centre, (*_xy("C3"), "rho3"), why=why),
        Step(say("The point of contact"), last, ARCS, line, _xy("F"), why=touch),
    ]


def _profile(arcs: ArcOutline) -> Step:
    acts, axis, mu_l = arcs.acts, middle_of_dwell(arcs), arcs.givens.mu_l.per_mm
    dwell, rho1 = float(np.degrees(arcs.givens.dwell)), arcs.givens.given.rho1
    turned = {"dwell": dwell, "half": dwell / 2, "sense": SENSE_NAMES[sense_sign(arcs)]}
    flank = ("AG", "C2", "G", "ρ₂"), ("GF", "C3", "F", "ρ₃"), ("FD", "C1", "D", "ρ₁")
    outer, base = (float(arcs.value(name)) for name in ("outer", "base"))
    radii = {"ρ₁": rho1, "ρ₂": float(arcs.value("rho2")), "ρ₃": float(arcs.value("rho3"))}
    rise = say("Arc {arc} about {centre}: compass {paper:.2f} mm, {name} = {rho:.3f} mm.")
    back = say(
        "Mirror {centre} and the ends of {arc} in that line and draw the arc about its image: compass {paper:.2f} mm."
    )
    held = say("Upper dwell, from D {dwell:.6g}° {sense} about O: compass {paper:.2f} mm, {rho:.3f} mm of the cam.")
    rest = say("Lower dwell, from the end of the return to A about O: compass {paper:.2f} mm, {rho:.3f} mm of the cam.")
    middle = say("Set the protractor to {half:.6g}° from OD, {sense}: the middle line of the dwell.").with_values(
        **turned
    )
    if not dwell:
        middle = say("There is no upper dwell, so the return is mirrored in the line OD itself.")

    def of_arc(said: Caption, arc: str, centre: str, name: str) -> Caption:
        """A sentence on an arc, with its radius in mm and on paper."""
        return said.with_values(arc=arc, centre=indexed(centre), name=name, rho=radii[name], paper=radii[name] / mu_l)

    said = [
        *(of_arc(rise, arc, centre, name) for arc, centre, _, name in flank),
        *([held.with_values(rho=outer, paper=outer / mu_l, **turned)] if dwell else []),
        *(of_arc(back, arc, centre, name) for arc, centre, _, name in flank[::-1]),
        rest.with_values(rho=base, paper=base / mu_l),
    ]
    pieces = cam(arcs, axis)
    parts = [Part(each, (circle,)) for each, (_, circle) in zip(said, pieces, strict=True)]
    parts.insert(-4, Part(middle, (axis,)))
    dimensions = (
        Dimension(
            *(acts[centre].place, acts[end].place, say("{name} = R{rho:.2f}", name=name, rho=radii[name])),
            of_radius=True,
        ).left_by(acts[f"circle about {centre}"])
        for _, centre, end, name in flank
    )
    ends = np.array([axis.place, axis.place + complex(unit(axis.directions)) * (outer / mu_l + AXIS_OVERHANG)])
    line = Line(ends, Role.AXIS).left_by(axis)
    why = say(
        "The arcs touch, so the profile has no corner, and the same flank, mirrored, lets the follower down again."
    )
    marks = (*(mark for mark, _ in pieces), line, *dimensions)
    return Step(say("The profile"), tuple(parts), ARCS, marks, why=why)


# Names, lines and what is said of them.


def _primed(name: str) -> str:
    """A point's name as it is written, of the other root with a prime."""
    return indexed(name.removeprefix("other_")) + "′" * name.startswith("other_")


def _named(arcs: ArcOutline, name: str, away: complex = 0j) -> Label:
    """The label of a point, on the side ``away`` from a place."""
    way = arcs.acts[name].place - away
    return arcs.acts[name].label(_primed(name), way / abs(way) if abs(way) > SAME_RADIUS else 1 + 1j)


def _line(arcs: ArcOutline, name: str, *ends: complex | str, role: Role = Role.CONSTRUCTION) -> Line:
    """A line between those two of its points that lie farthest apart."""
    places = [arcs.acts[end].place if isinstance(end, str) else end for end in ends]
    pair = max(combinations(places, 2), key=lambda pair: abs(pair[0] - pair[1]))
    return Line(np.array(pair), role).left_by(arcs.acts[name])


def _bisector(arcs: ArcOutline, a: str, b: str, to: str, role: Role = Role.CONSTRUCTION) -> tuple[Mark, ...]:
    """A chord, and its perpendicular bisector from a little beyond the middle to a point on it."""
    name, chord = f"bisector of {a} {b}", _line(arcs, f"{a} {b}", a, b, role=role)
    middle, along = arcs.acts[name].place, arcs.acts[to].place - arcs.acts[name].place
    start = middle - along / abs(along) * AXIS_OVERHANG if abs(along) > SAME_RADIUS else middle
    return chord, _line(arcs, name, start, to, role=role)


def _at(arcs: ArcOutline, name: str) -> Caption:
    x, y = (float(arcs.value(reading)) for reading in _xy(name))
    return say("({x:.3f}, {y:.3f}) mm", x=x, y=y)


def _xy(name: str) -> tuple[str, str]:
    return f"{name}_x", f"{name}_y"


def _orders(arcs: ArcOutline, name: str) -> Caption:
    """A caption with the order of the points on the two lines of centres."""
    first, second = _order(arcs, f"{name}F", "C1", f"{name}C3"), _order(arcs, "G", f"{name}C3", "C2")
    built = (first, second) == (["F", "C₁", "C₃"], ["G", "C₃", "C₂"])
    can, cannot = say("the arcs touch internally, and the cam can be made"), say("such a cam cannot be made")
    said = say("The orders on the lines are {first} and {second}: {verdict}.")
    return said.with_values(first=sequence(first), second=sequence(second), verdict=can if built else cannot)


def _order(arcs: ArcOutline, *names: str) -> list[str]:
    """The names of the points of a line, in their order along it, the first one before the last."""
    places = np.array([arcs.acts[name].place for name in names])
    return [_primed(names[k]) for k in np.argsort(dot(places[-1] - places[0], places))]
