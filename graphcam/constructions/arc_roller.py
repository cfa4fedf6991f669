"""A roller on a cam of arcs: lift, velocity and acceleration at stations, with ruler and compass and without an error.

The roller's centre B keeps to an arc grown by the roller's radius, so the follower moves as the piston of a crank drive
whose crank is O C, from the cam centre to the arc's centre, and whose rod is C B.  The rod meets the perpendicular to
the follower's line through O in K, and OK is the velocity ds/dphi, as in every velocity plan.  CN = CK^2/CB on the rod,
by the theorem of the height in a right triangle, is the rod's normal acceleration; the perpendicular to the rod in N
meets the follower's line in M, and MO is the acceleration d^2s/dphi^2 (after Klein, who found N by two circles).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.arc_outline import ArcOutline, mirrored, outline, run
from graphcam.drafting.euclid import UP, along_to_circle, meet, turned, unit
from graphcam.drafting.ink import Construction, Step, View, Words, reading, say
from graphcam.drafting.marks import Circle, Dots, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.laws import Floats
from graphcam.plane import cross, dot
from graphcam.words import joined

ROLLER = View("roller", say("The roller on the arcs"), across="roller x", up="roller y")
PLAN = View("plan", say("Velocity and acceleration at a station"), across="plan", up="plan")
CENTRE = np.zeros((), dtype=complex)
ARCS = ("AG", "GF", "FD")
"""The arcs of the rise, in order."""
JOINTS = (
    *(("a_A", 0, 0), ("a_G_before", 0, -1), ("a_G_after", 1, 0)),
    *(("a_F_before", 1, -1), ("a_F_after", 2, 0), ("a_D", 2, -1)),
)
"""The accelerations at the ends of the arcs: their names, which arc, and its first or its last station."""


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
"""The accelerations at both ends of every arc."""
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
)


def arc_roller(arcs: ArcOutline, roller_radius: float, stations: ArcStations, pencil: Pencil) -> RollerOnArcs:
    """Put the roller on the arcs at every station of the rise, and find s, v and a there.

    arcs : from :func:`~graphcam.constructions.arc_outline.three_arcs`
    roller_radius : mm

    Readings: ``s``, ``v``, ``a`` [mm, per radian] and ``alpha`` [rad] at the stations, ``phi`` there [rad], ``x`` and
    ``y`` of the roller's centre [mm]; the cam angles ``edges`` (..., 4) [rad] where the arcs begin and the last one
    ends, and alone ``rise``, ``phi_G`` and ``phi_F``; the ``lift``, the ``prime_radius``, the ``roller_radius`` and
    the least radius of curvature ``rho`` of the roller's path [mm]; the accelerations on both sides of the joints,
    ``a_A``, ``a_G_before``, ``a_G_after``, ``a_F_before``, ``a_F_after`` and ``a_D``.
    Points: ``B``, ``C`` the centre of its arc, ``K``, ``right`` the corner of the right angle, ``beyond`` where it cuts
    off the rod, ``N``, ``M``; ``trace``, the roller's centre in A, G, F and D; ``ray``, directions.
    """
    hand, count = pencil.hand("arc_roller"), stations.u.size
    mu_l = arcs.givens.mu_l.per_mm
    touch, centres = _stacked(arcs, "AGFD"), _stacked(arcs, ("C2", "C2", "C3", "C1"))
    # The roller's centre lies on the line of centres through each joint.
    trace = touch + unit(touch - centres) * (roller_radius / mu_l + hand.dividers(4))
    sigma = -np.sign(cross(touch[..., 0], touch[..., 3]))[..., None]
    edges = sigma * np.angle(trace[..., :1] * np.conj(trace))
    edges[..., 1:] += hand.protractor(3)
    arc, u = stations.arc, stations.u
    phi = edges[..., arc] + (edges[..., arc + 1] - edges[..., arc]) * u
    ray = turned(unit(trace[..., :1]), -sigma * phi + hand.protractor(count))
    # Each arc passes through the joint at which it begins, the last one ends on the outer circle.
    c = _stacked(arcs, ("C2", "C3", "C1"))[..., arc]
    b = along_to_circle(CENTRE, ray, c, np.abs(trace[..., [0, 1, 3]][..., arc] - c)) + hand.point(count)
    s = np.abs(b) - np.abs(trace[..., :1]) + hand.dividers(count)
    k = meet(b, c - b, CENTRE, UP * ray)
    rod = unit(b - c)
    right = c + UP * rod * (np.abs(k - c) + hand.dividers(count))
    beyond = meet(right, UP * (b - right), b, rod)
    n = c + rod * (np.abs(beyond - c) + hand.dividers(count))
    m = meet(n, UP * rod, CENTRE, ray)
    v = dot(k, -1j * sigma * ray) + hand.dividers(count)
    a = -dot(m, ray) + hand.dividers(count)
    alpha = sigma * np.angle(rod * np.conj(ray)) + hand.protractor(count)
    prime_radius = np.abs(trace[..., 0])
    radii = {"prime_radius": prime_radius, "roller_radius": np.abs(trace - touch)[..., 3]}
    radii["rho"] = np.minimum(np.abs(trace[..., 3] - c[..., -1]), prime_radius)
    readings = {
        **hand.readings(mu_l, "mm", s=s),
        **hand.readings(mu_l, "mm/rad", v=v),
        **hand.readings(mu_l, "mm/rad²", a=a),
        "alpha": reading(alpha, 1.0, "rad"),
        "phi": reading(phi, 1.0, "rad"),
        **hand.readings(mu_l, "mm", x=b.real, y=b.imag),
        "edges": reading(edges, 1.0, "rad"),
        **hand.readings(mu_l, "mm", lift=s[..., -1], **radii),
        **{name: reading(edges[..., k], 1.0, "rad") for k, name in enumerate(("phi_G", "phi_F", "rise"), 1)},
        **hand.readings(mu_l, "mm/rad²", **{name: a[..., stations.spans[of]][..., end] for name, of, end in JOINTS}),
    }
    points = {"B": b, "C": c, "K": k, "right": right, "beyond": beyond, "N": n, "M": m, "trace": trace, "ray": ray}
    givens = ArcRollerGivens(arcs, roller_radius, stations)
    return Construction(MEANING, givens, pencil, readings, points, _draw)


def _stacked(arcs: ArcOutline, names: Iterable[str]) -> Points:
    """Points side by side, (..., k)."""
    return np.stack([arcs.points[name] for name in names], axis=-1)


# --- the steps -------------------------------------------------------------------------------------------------------

SHOWN = 2, 0.5
"""The plan is drawn for the station in the middle of the arc FD."""
PLAN_SIZE = 190.0
"""The plan is drawn at the largest standard scale at which it is not larger [mm]."""
BEYOND = 7.0
"""How far the rays run on beyond the roller's centre [mm]."""


def _draw(rolled: RollerOnArcs) -> list[Step]:
    if np.isnan(rolled.first("trace")).any():
        said = say(
            "Without a readable centre of every arc, {missing}, the roller has no path.", missing=_missing(rolled)
        )
        return [Step(say("The arcs of the roller's centre"), said, ROLLER, ())]
    arcs, stations = rolled.givens.arcs, rolled.givens.stations
    mu_l, roller = arcs.givens.mu_l, rolled.givens.roller_radius
    b, ray, trace = (rolled.first(name) for name in ("B", "ray", "trace"))
    edges = np.degrees(rolled.first("edges"))
    reach = float(np.abs(trace[-1])) + BEYOND
    follows = say("The roller's centre") if roller else say("The knife edge")
    kept = say(
        "{follows} keeps to arcs about the same centres, with radii greater by r = {roller:g} mm; they meet on the "
        "lines of centres. The cam angles, measured at O from OA, are {g:.3f}° at G, {f:.3f}° at F and {d:.3f}° at D, "
        "where the rise ends."
    ).where(follows=follows, roller=roller, g=edges[1], f=edges[2], d=edges[3])
    outlines = _outlines(arcs, trace, roller / mu_l.per_mm)
    divided = say(
        "The angle of each arc is divided into {parts} equal parts, and a ray is drawn from O for each; it meets the "
        "arc in the roller's centre B. What B is farther from O than at A is the displacement, {lift:.2f} mm of paper "
        "at the end; the return is the mirror image."
    ).where(parts=len(stations.u) // 3 - 1, lift=float(rolled.first("lift")))
    # Where two arcs meet, both have a station of one name.
    named = dict(zip(stations.names, ray.tolist(), strict=True)).items()
    places = (
        Segments(0 * ray, reach * ray, Role.CONSTRUCTION),
        *(Dots(centres, Role.CONSTRUCTION) for centres in (b, mirrored(arcs, b))),
        *_rollers(rolled),
        *(Label(at * reach, name, towards=at, small=True) for name, at in named),
    )
    reads = ("phi_G", "phi_F", "rise", "prime_radius", "roller_radius", "rho")
    return [
        Step(say("The arcs of the roller's centre"), kept, ROLLER, outlines, reads),
        Step(say("Stations"), divided, ROLLER, places, reads=("lift", "s", "alpha", "x", "y")),
        *_plan(rolled),
    ]


def _outlines(arcs: ArcOutline, trace: Points, roller: float) -> tuple[Mark, ...]:
    """The cam and the path of the roller's centre, which passes through ``trace`` (4,); ``roller`` in mm of paper."""
    return (
        *outline(arcs, 0.0, Role.RESULT),
        *(outline(arcs, roller, Role.CURVE) if roller else ()),
        Segments(trace[1:3], np.array([arcs.first("C3")] * 2), Role.AXIS),
        *(Label(complex(arcs.first(name)), name, towards=-complex(at)) for name, at in zip("AGFD", trace, strict=True)),
        Dots(np.array([0j])),
        Label(0j, "O", towards=-1 - 1j),
    )


def _rollers(rolled: RollerOnArcs) -> list[Circle]:
    """The roller in the middle of every arc."""
    roller, stations = rolled.givens.roller_radius, rolled.givens.stations
    if not roller:
        return []
    middle = [span.start + stations.u.size // 6 for span in stations.spans]
    radius = roller / rolled.givens.arcs.givens.mu_l.per_mm
    return [Circle(complex(at), radius, Role.CONSTRUCTION) for at in rolled.first("B")[middle]]


def _missing(rolled: RollerOnArcs) -> Words:
    arcs = rolled.givens.arcs
    return joined([name for name in ("C1", "C2", "C3") if np.isnan(arcs.first(name))])


def _plan(rolled: RollerOnArcs) -> list[Step]:
    """The velocity and the acceleration at one station, enlarged, with the follower's line upright."""
    arcs, stations = rolled.givens.arcs, rolled.givens.stations
    on, share = SHOWN
    at = stations.spans[on].start + round(share * (stations.u.size // 3 - 1))
    station = stations.names[at]
    mu_l, sigma = arcs.givens.mu_l, run(arcs)
    upright = UP / rolled.first("ray")[at]
    names = ("B", "C", "K", "right", "beyond", "N", "M")
    points = {name: complex(rolled.first(name)[at] * upright) * mu_l.per_mm for name in names}
    if np.isnan(list(points.values())).any():
        said = say("At station {name} a line cannot be read: it crosses another at less than a degree.", name=station)
        return [Step(say("Velocity and acceleration"), said, PLAN, ())]
    everything: Points = np.array([0j, *points.values()])
    size = float(max(np.ptp(everything.real), np.ptp(everything.imag)))
    scale = standard_scale(size, PLAN_SIZE)
    p = {name: point / scale.per_mm for name, point in points.items()}
    v, a = (float(rolled.value(name)[at]) for name in "va")
    centre = ("C2", "C3", "C1")[on]
    side = -sigma * 1.0
    velocity = say(
        "At station {name}, on the arc {arc}, drawn upright at {ratio}: the line of centres B{centre} meets the "
        "perpendicular to the follower's line through O in K, and OK = {paper:.2f} mm is the velocity, v = {v:.3f} "
        "mm/rad."
    ).where(name=station, arc=ARCS[on], centre=centre, ratio=ratio_text(scale.per_mm), paper=abs(p["K"]), v=v)
    directed = say("it is directed towards the cam centre: M lies on the side of B.")
    if a > 0:
        directed = say("it is directed away from the cam centre: M lies beyond O.")
    acceleration = say(
        "{centre}K is erected on the rod in {centre}, and at its end a right angle to B: it cuts off {centre}N′ = "
        "{centre}K²/{centre}B on the rod, which is laid off towards B to N. The perpendicular to the rod in N meets "
        "the follower's line in M, and OM = {paper:.2f} mm is the acceleration, a = {a:.3f} mm/rad²; {sense}"
    ).where(centre=centre, paper=abs(p["M"]), a=a, sense=directed)
    reads = ("v", "a", *(name for name, *_ in JOINTS))
    return [
        Step(say("Velocity at station {name}", name=station), velocity, PLAN, _velocity(p, centre, side)),
        Step(say("Acceleration at station {name}", name=station), acceleration, PLAN, _acceleration(p, side), reads),
    ]


def _velocity(p: Mapping[str, complex], centre: str, side: float) -> tuple[Mark, ...]:
    """The rod from B to its ``centre``, and K; labels stand to the ``side`` of -1 or 1."""
    axis = np.array([min(0.0, p["M"].imag, p["C"].imag) - BEYOND, p["B"].imag + BEYOND]) * UP
    return (
        Line(axis, Role.AXIS),
        Line(np.array([p["B"], p["C"]]), Role.CURVE),
        Line(np.array([0j, p["K"]]), Role.RESULT),
        Line(np.array([p["B"], p["K"]]), Role.CURVE),
        Dots(np.array([0j, p["B"], p["C"], p["K"]])),
        Label(0j, "O", towards=-side - 1j),
        Label(p["B"], "B", towards=side + 0j),
        Label(p["C"], centre, towards=-side - 1j),
        Label(p["K"], "K", towards=side + 0j),
    )


def _acceleration(p: Mapping[str, complex], side: float) -> tuple[Mark, ...]:
    """The right angle that cuts N′ off, N, and M; labels as in :func:`_velocity`."""
    return (
        Line(np.array([p["C"], p["right"], p["B"]]), Role.CONSTRUCTION),
        Line(np.array([p["right"], p["beyond"], p["C"]]), Role.CONSTRUCTION),
        Line(np.array([p["N"], p["M"]]), Role.CONSTRUCTION),
        Line(np.array([0j, p["M"]]), Role.RESULT),
        Dots(np.array([p["right"], p["beyond"], p["N"], p["M"]])),
        Label(p["beyond"], "N′", towards=-side + 0j),
        Label(p["N"], "N", towards=side + 0j),
        Label(p["M"], "M", towards=-side + 0j),
    )
