"""A roller on a cam of arcs: lift, velocity and acceleration at stations, with ruler and compass and without an error.

The roller's centre B keeps to an arc grown by the roller's radius, so the follower moves as the piston of a crank drive
whose crank is O C, from the cam centre to the arc's centre, and whose rod is C B.  The rod meets the perpendicular to
the follower's line through O in K, and OK is the velocity ds/dphi, as in every velocity plan.  CN = CK^2/CB on the rod,
by the theorem of the height in a right triangle, is the rod's normal acceleration; the perpendicular to the rod in N
meets the follower's line in M, and MO is the acceleration d^2s/dphi^2 (after Klein, who found N by two circles).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.arc_outline import ArcOutline, cam, middle_of_dwell, outline, run
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Construction, Step, View, say
from graphcam.drafting.marks import Circle, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.laws import Floats
from graphcam.words import joined

ROLLER = View(
    "roller", say("The roller on the arcs"), "roller x", "roller y", scale=say("The roller on the arcs, {ratio}")
)
PLAN = View("plan", say("Velocity and acceleration at a station"), across="plan", up="plan")
ARCS = ("AG", "GF", "FD")
"""The arcs of the rise, in order."""


@dataclass(frozen=True, eq=False)
class ArcStations:
    """The ends of equal parts of the three arcs of a rise, both ends of each arc included.

    arc : (m,) which arc;  u : (m,) fraction of its angle;  spans : slice of the stations of each arc
    """

    arc: NDArray[np.intp]
    u: Floats
    spans: tuple[slice, ...]

    @property
    def names(self) -> list[str]:
        """0, 1, 2 ... through the rise; where two arcs meet, the first one's end and the second one's start are one."""
        return [str(k - arc) for k, arc in enumerate(self.arc.tolist())]


def divide_arcs(parts: int) -> ArcStations:
    """Each arc divided into so many equal parts.

    >>> divide_arcs(2).names
    ['0', '1', '2', '2', '3', '4', '4', '5', '6']
    """
    count = parts + 1
    spans = tuple(slice(k * count, (k + 1) * count) for k in range(3))
    return ArcStations(np.repeat(np.arange(3), count), np.tile(np.arange(count) / parts, 3), spans)


@dataclass(frozen=True, eq=False)
class ArcRollerGivens:
    """The arcs, the roller on them [mm], and where it stands."""

    arcs: ArcOutline
    roller_radius: float
    stations: ArcStations


RollerOnArcs = Construction[ArcRollerGivens]


ENDS = {
    "a_A": say("a in {point}", point="A"),
    "a_G_before": say("a in {point}, {side}", point="G", side=say("before")),
    "a_G_after": say("a in {point}, {side}", point="G", side=say("after")),
    "a_F_before": say("a in {point}, {side}", point="F", side=say("before")),
    "a_F_after": say("a in {point}, {side}", point="F", side=say("after")),
    "a_D": say("a in {point}", point="D"),
}
"""The accelerations at the first and the last station of every arc, in order."""
MEANING = Meaning(
    "arc_roller",
    say("The roller on the arcs"),
    say(
        "As long as the roller runs on one arc, cam and follower move as a crank mechanism: the crank from the cam "
        "centre to the arc's centre, the rod from there to the roller. Its plans give velocity and acceleration."
    ),
    {
        "s": ReadingMeaning(say("displacement s"), "s", "mm"),
        "v": ReadingMeaning(say("velocity v"), "v", "mm/rad"),
        "a": ReadingMeaning(say("acceleration a"), "a", "mm/rad²"),
        "alpha": ReadingMeaning(say("pressure angle α"), "α", "rad"),
        "x": ReadingMeaning(say("x"), "x", "mm"),
        "y": ReadingMeaning(say("y"), "y", "mm"),
        "rho": ReadingMeaning(
            say("least radius of curvature ρ"), "ρ", "mm", (Compared("min_pitch_curvature_radius", say("least ρ")),)
        ),
        "roller_radius": ReadingMeaning(
            say("roller radius r"), "r", "mm", (Compared("roller_radius", say("roller radius")),)
        ),
        "lift": ReadingMeaning(say("lift h"), "h", "mm", (Compared("lift", say("lift")),)),
        "prime_radius": ReadingMeaning(say("prime radius r₀"), "r₀", "mm", (Compared("prime_radius"),)),
        **{
            name: ReadingMeaning(
                title, f"φ({point})", "rad", (Compared(f"phi_{point}_deg", say("φ at {point}", point=point)),)
            )
            for name, point, title in (
                ("phi_G", "G", say("φ at G")),
                ("phi_F", "F", say("φ at F")),
                ("rise", "D", say("angle of the rise")),
            )
        },
        **{name: ReadingMeaning(title, "a", "mm/rad²", (Compared(name),)) for name, title in ENDS.items()},
    },
    scales={"roller": "x"},
)


def arc_roller(arcs: ArcOutline, roller_radius: float, stations: ArcStations, pencil: Pencil) -> RollerOnArcs:
    """Put the roller on the arcs at every station of the rise, and find s, v and a there.

    Readings besides those of the meaning: the cam angles ``phi`` of the stations, and ``edges`` (..., 4) where the arcs
    begin and the last one ends.
    Points: ``B``, ``C`` the centre of its arc, ``K``, ``right`` the corner of the right angle, ``beyond`` where it cuts
    off the rod, ``N``, ``M``; ``trace``, the roller's centre in A, G, F and D; ``ray``, directions.
    """
    hand, mu_l, sigma = Hand(pencil, MEANING), arcs.givens.mu_l.per_mm, run(arcs)
    o, (a_, g, f, d, c1, c2, c3) = hand.given("O"), (hand.found(arcs, name) for name in (*"AGFD", "C1", "C2", "C3"))
    # The roller's centre lies on the line of centres through each joint.
    touch = hand.take("touch", a_, g, f, d)
    lines = hand.join("lines of centres", hand.take("centres", c2, c2, c3, c1), touch)
    trace = hand.lay_off("trace", touch, lines, roller_radius / mu_l)
    to_joints = hand.join("to the joints", o, trace)
    joints = {"phi_G": to_joints[1], "phi_F": to_joints[2], "rise": to_joints[3]}
    edges = [hand.angle(name, to_joints[0], to_joint, -sigma) for name, to_joint in joints.items()]
    measured = reckoned(_from_nothing, *(hand.carry(edge) for edge in edges))
    phi = reckoned(partial(_divided, stations), measured)
    rays = hand.protractor("rays", o, to_joints[0], reckoned(partial(np.multiply, -sigma), phi))
    # Each arc passes through the joint at which it begins, the last one ends on the outer circle.
    centres, on = hand.take("centres of the arcs", c2, c3, c1), trace[[0, 1, 3]]
    paths = hand.circle("arcs of the roller's centre", centres, between(centres, on))
    hand.circle("dwells of the roller's centre", o, between(o, trace[[3, 0]]))
    b, c = hand.cross("B", rays, paths[stations.arc]), hand.take("C", centres, which=stations.arc)
    rods = hand.join("rods", b, c)
    outward = rods.turned(-1)
    across = hand.perpendicular("across", rays, o)
    k = hand.cross("K", rods, across)
    erected = hand.perpendicular("perpendiculars in C", outward, c)
    right = hand.lay_off("right", erected, erected, between(c, k))
    beyond = hand.cross("beyond", hand.perpendicular("right angles", hand.join("legs", right, b), right), rods)
    n = hand.lay_off("N", c, outward, between(c, beyond))
    m = hand.cross("M", hand.perpendicular("perpendiculars in N", outward, n), rays)
    prime_radius = between(o, trace[0])
    hand.read("s", reckoned(np.subtract, between(o, b), between(o, trace[[0]])), mu_l)
    hand.read("v", between(o, k, across.turned(-sigma)), mu_l)
    hand.read("a", between(m, o, rays), mu_l)
    hand.angle("alpha", rays, outward, sigma)
    hand.read("phi", phi, 1.0, "rad", rounded=False)
    for name, along in (("x", RIGHT), ("y", UP)):
        hand.read(name, between(o, b, along), mu_l)
    hand.read("edges", measured, 1.0, "rad", rounded=False)
    hand.read("lift", reckoned(np.subtract, between(o, b[-1]), prime_radius), mu_l)
    hand.read("prime_radius", prime_radius, mu_l)
    hand.read("roller_radius", between(touch[3], trace[3]), mu_l)
    hand.read("rho", reckoned(np.minimum, between(c1, trace[3]), prime_radius), mu_l)
    ends = [at for span in stations.spans for at in (span.start, span.stop - 1)]
    for name, at in zip(ENDS, ends, strict=True):
        hand.read(name, between(m[at], o, rays[at]), mu_l)
    points = {"B": b, "C": c, "K": k, "right": right, "beyond": beyond, "N": n, "M": m, "trace": trace}
    givens = ArcRollerGivens(arcs, roller_radius, stations)
    return hand.finished(givens, _draw, points | {"ray": unit(rays.directions)})


def _from_nothing(*angles: Floats) -> Floats:
    """Angles in a row, (..., k + 1), after one of zero."""
    return np.stack([np.zeros_like(angles[0]), *angles], axis=-1)


def _divided(stations: ArcStations, edges: Floats) -> Floats:
    """The stations between the ``edges`` (..., 4) of the arcs."""
    start, end = edges[..., stations.arc], edges[..., stations.arc + 1]
    return start + (end - start) * stations.u


# --- the steps -------------------------------------------------------------------------------------------------------

SHOWN = 2, 0.5
"""The plan is drawn for the station in the middle of the arc FD."""
PLAN_SIZE = 190.0
"""The plan is drawn at the largest standard scale at which it is not larger [mm]."""
BEYOND = 7.0
"""How far the rays run on beyond the roller's centre [mm]."""


def _draw(rolled: RollerOnArcs) -> list[Step]:
    if np.isnan(rolled.first("trace")).any():
        missing = joined([name for name in ("C1", "C2", "C3") if np.isnan(rolled.givens.arcs.first(name))])
        said = say("Without a readable centre of every arc, {missing}, the roller has no path.", missing=missing)
        return [Step(say("The arcs of the roller's centre"), said, ROLLER, ())]
    arcs, stations, roller = rolled.givens.arcs, rolled.givens.stations, rolled.givens.roller_radius
    b, rays, ray, edges = rolled.acts["B"], rolled.acts["rays"], rolled.first("ray"), np.degrees(rolled.first("edges"))
    ends = rays.shown + (float(np.abs(rolled.first("trace")[-1])) + BEYOND) * ray
    returning = showing(rolled).mirrored("B on the return", b.first, middle_of_dwell(arcs))
    follows = say("The roller's centre") if roller else say("The knife edge")
    kept = say(
        "{follows} keeps to arcs about the same centres, with radii greater by r = {roller:g} mm; they meet on the "
        "lines of centres. The cam angles, measured at O from OA, are {g:.3f}° at G, {f:.3f}° at F and {d:.3f}° at D, "
        "where the rise ends."
    ).where(follows=follows, roller=roller, g=edges[1], f=edges[2], d=edges[3])
    divided = say(
        "The angle of each arc is divided into {parts} equal parts, and a ray is drawn from O for each; it meets the "
        "arc in the roller's centre B. What B is farther from O than at A is the displacement, {lift:.2f} mm of paper "
        "at the end; the return is the mirror image."
    ).where(parts=len(stations.u) // 3 - 1, lift=float(rolled.first("lift")))
    # Where two arcs meet, both have a station of one name.
    named = dict(zip(stations.names, zip(ends.tolist(), ray.tolist(), strict=True), strict=True))
    places = (
        Segments(rays.shown, ends, Role.CONSTRUCTION, of=rays.act),
        *(centres.dots(Role.CONSTRUCTION) for centres in (b, returning)),
        *_rollers(rolled),
        *(Label(end, name, way, small=True, of=rays.act) for name, (end, way) in named.items()),
    )
    reads = ("phi_G", "phi_F", "rise", "prime_radius", "roller_radius", "rho")
    return [
        Step(say("The arcs of the roller's centre"), kept, ROLLER, _outlines(rolled), reads),
        Step(say("Stations"), divided, ROLLER, places, reads=("lift", "s", "alpha", "x", "y")),
        *_plan(rolled),
    ]


def _outlines(rolled: RollerOnArcs) -> tuple[Mark, ...]:
    """The cam, and the path of the roller's centre."""
    arcs, trace, o = rolled.givens.arcs, rolled.first("trace"), rolled.acts["O"]
    paths, dwells = (rolled.acts[f"{name} of the roller's centre"].first for name in ("arcs", "dwells"))
    path = outline(arcs, [paths[0], paths[1], paths[2], dwells[0], dwells[1]], trace, Role.CURVE)
    return (
        *cam(arcs),
        *(path if rolled.givens.roller_radius else ()),
        Segments(trace[1:3], np.array([arcs.first("C3")] * 2), Role.AXIS, of=rolled.acts["lines of centres"].act),
        *(arcs.acts[name].label(name, -complex(at)) for name, at in zip("AGFD", trace, strict=True)),
        *(o.dots(), o.label("O", -1 - 1j)),
    )


def _rollers(rolled: RollerOnArcs) -> list[Circle]:
    """The roller in the middle of every arc."""
    stations, radius = rolled.givens.stations, rolled.givens.roller_radius / rolled.givens.arcs.givens.mu_l.per_mm
    if not radius:
        return []
    middle = rolled.acts["B"].first[[span.start + stations.u.size // 6 for span in stations.spans]]
    rollers = showing(rolled).circle("rollers", middle, radius)
    return [rollers[k].drawn_circle(Role.CONSTRUCTION) for k in range(3)]


def _plan(rolled: RollerOnArcs) -> list[Step]:
    """The velocity and the acceleration at one station, enlarged, with the follower's line upright."""
    arcs, stations = rolled.givens.arcs, rolled.givens.stations
    on, share = SHOWN
    at = stations.spans[on].start + round(share * (stations.u.size // 3 - 1))
    station = stations.names[at]
    mu_l, side = arcs.givens.mu_l.per_mm, -float(run(arcs))
    names, upright = ("B", "C", "K", "right", "beyond", "N", "M"), UP / rolled.first("ray")[at]
    places: Points = np.array([0j, *(rolled.first(name)[at] * upright for name in names)])
    if np.isnan(places).any():
        said = say("At station {name} a line cannot be read: it crosses another at less than a degree.", name=station)
        return [Step(say("Velocity and acceleration"), said, PLAN, ())]
    scale = standard_scale(float(max(np.ptp(places.real), np.ptp(places.imag))) * mu_l, PLAN_SIZE)
    hand, o, times = showing(rolled), rolled.acts["O"].first, upright * mu_l / scale.per_mm
    p = {name: hand.enlarged(name, rolled.acts[name].first[at], o, times) for name in names}
    p["O"] = hand.enlarged("O", o, o, times)
    v, a = (float(rolled.value(name)[at]) for name in "va")
    centre = ("C2", "C3", "C1")[on]
    velocity = say(
        "At station {name}, on the arc {arc}, drawn upright at {ratio}: the line of centres B{centre} meets the "
        "perpendicular to the follower's line through O in K, and OK = {paper:.2f} mm is the velocity, v = {v:.3f} "
        "mm/rad."
    ).where(name=station, arc=ARCS[on], centre=centre, ratio=ratio_text(scale.per_mm), paper=abs(p["K"].place), v=v)
    directed = say("it is directed towards the cam centre: M lies on the side of B.")
    if a > 0:
        directed = say("it is directed away from the cam centre: M lies beyond O.")
    acceleration = say(
        "{centre}K is erected on the rod in {centre}, and at its end a right angle to B: it cuts off {centre}N′ = "
        "{centre}K²/{centre}B on the rod, which is laid off towards B to N. The perpendicular to the rod in N meets "
        "the follower's line in M, and OM = {paper:.2f} mm is the acceleration, a = {a:.3f} mm/rad²; {sense}"
    ).where(centre=centre, paper=abs(p["M"].place), a=a, sense=directed)
    titles = say("Velocity at station {name}", name=station), say("Acceleration at station {name}", name=station)
    return [
        Step(titles[0], velocity, PLAN, _velocity(hand, p, centre, side)),
        Step(titles[1], acceleration, PLAN, _acceleration(hand, p, side), ("v", "a", *ENDS)),
    ]


def _velocity(hand: Hand, p: Mapping[str, Drawn], centre: str, side: float) -> tuple[Mark, ...]:
    """The rod from B to its ``centre``, and K; labels stand to the ``side`` of -1 or 1."""
    axis = np.array([min(0.0, p["M"].place.imag, p["C"].place.imag) - BEYOND, p["B"].place.imag + BEYOND]) * UP
    lines = (("B", "C", Role.CURVE), ("O", "K", Role.RESULT), ("B", "K", Role.CURVE))
    names = (("O", "O", -side - 1j), ("B", "B", side + 0j), ("C", centre, -side - 1j), ("K", "K", side + 0j))
    return (
        Line(axis, Role.AXIS),
        *(_row(hand, p, start, end).line(role) for start, end, role in lines),
        _row(hand, p, *"OBCK").dots(),
        *(p[name].label(text, towards) for name, text, towards in names),
    )


def _acceleration(hand: Hand, p: Mapping[str, Drawn], side: float) -> tuple[Mark, ...]:
    """The right angle that cuts N′ off, N, and M; labels as in :func:`_velocity`."""
    lines = (("C", "right", "B"), ("right", "beyond", "C"), ("N", "M"))
    return (
        *(_row(hand, p, *places).line(Role.CONSTRUCTION) for places in lines),
        _row(hand, p, "O", "M").line(Role.RESULT),
        _row(hand, p, "right", "beyond", "N", "M").dots(),
        *(p["beyond"].label("N′", -side + 0j), p["N"].label("N", side + 0j), p["M"].label("M", -side + 0j)),
    )


def _row(hand: Hand, p: Mapping[str, Drawn], *names: str) -> Drawn:
    return hand.take(" ".join(names), *(p[name] for name in names))
