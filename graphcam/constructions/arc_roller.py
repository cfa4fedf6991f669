"""A roller on a cam of arcs: lift, velocity and acceleration at stations, with ruler and compass and without an error.

The roller's centre B keeps to an arc grown by the roller's radius, so the follower moves as the piston of a crank drive
whose crank is O C, from the cam centre to the arc's centre, and whose rod is C B.  The rod meets the perpendicular to
the follower's line through O in K, and OK is the velocity ds/dphi, as in every velocity plan.  CN = CK^2/CB on the rod,
by the theorem of the height in a right triangle, is the rod's normal acceleration; the perpendicular to the rod in N
meets the follower's line in M, and MO is the acceleration d^2s/dphi^2 (after Klein, who found N by two circles).
"""

from functools import partial

import numpy as np

from graphcam.constructions.arc_outline import unreadable_step
from graphcam.constructions.arc_plan import UNREADABLE, plans, shown_station, worked_station
from graphcam.constructions.arc_profile import (
    ARCS,
    CENTRES,
    ROLLER,
    SENSE_NAMES,
    ArcOutline,
    ArcRollerGivens,
    ArcStations,
    RollerOnArcs,
    cam,
    middle_of_dwell,
    mirror_line,
    outline,
    sense_sign,
)
from graphcam.constructions.axes import sense_caption, standing_apart
from graphcam.constructions.kinematic_sketch import sketched_stem
from graphcam.constructions.views import SCHEME
from graphcam.drafting import telling
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Part, Row, Step, say
from graphcam.drafting.marks import AngleMark, Label, Line, Mark, Role, Segments
from graphcam.drafting.meaning import A, ComparedReading, Formula, Meaning, ReadingMeaning, Symbol, V, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, unit as unit_named
from graphcam.given.laws import Floats
from graphcam.subscripts import indexed
from graphcam.words import and_list

ENDS = {
    "a_A": say("a in {point}", point="A"),
    "a_G_before": say("a in {point}, {side}", point="G", side=say("before")),
    "a_G_after": say("a in {point}, {side}", point="G", side=say("after")),
    "a_F_before": say("a in {point}, {side}", point="F", side=say("before")),
    "a_F_after": say("a in {point}, {side}", point="F", side=say("after")),
    "a_D": say("a in {point}", point="D"),
}
"""The accelerations at the first and the last station of every arc, in order."""


def _worked_values(rolled: RollerOnArcs) -> Values:
    """The formula's values at the station of the plan: lengths in the roller's drawing, and what they stand for."""
    k, mu = shown_station(rolled.givens.stations), rolled.givens.arcs.givens.mu_l.per_mm
    b, c, k_, m, n = (complex(rolled.first(name)[k]) for name in "BCKMN")
    if not np.isnan(m):
        lengths = {"ok": abs(k_), "ck": abs(k_ - c), "cb": abs(b - c), "cn": abs(n - c), "om": abs(m)}
        values = {name: abs(float(rolled.value(name)[k])) for name in "va"}
        units = {f"of_{name}": unit_named(rolled.readings[name].unit) for name in "va"}
        yield {"k": rolled.givens.stations.names[k], "mu": mu, **lengths, **values, **units}


FORMULAS = (
    Formula(
        r"v = \mu_l \cdot OK",
        r"v_{<k>} = <mu:g> \cdot <ok:.2f> = <v:.3f>\ \text{<of_v>}",
        _worked_values,
        (
            V,
            Symbol(r"\mu_l", say("the scale of the drawing"), "mm/mm"),
            Symbol("OK", say("what the rod cuts off the line through O square to the ray"), "mm of paper"),
        ),
        "v",
    ),
    Formula(
        r"CN = \frac{CK^2}{CB}, \qquad |a| = \mu_l \cdot OM",
        r"CN_{<k>} = \frac{<ck:.2f>^2}{<cb:.2f>} = <cn:.2f>\ \text{<mm>}, \qquad "
        r"|a_{<k>}| = <mu:g> \cdot <om:.2f> = <a:.3f>\ \text{<of_a>}",
        _worked_values,
        (
            A,
            Symbol("C", say("the centre of the arc on which the roller runs")),
            Symbol("CN", say("the distance of N from C"), "mm of paper"),
            Symbol("CK", say("the distance of K from C"), "mm of paper"),
            Symbol("CB", say("the rod"), "mm of paper"),
            Symbol("OM", say("what the line through N square to the rod cuts off the ray"), "mm of paper"),
        ),
        "a",
    ),
)
MEANING = Meaning(
    "arc_roller",
    say("The roller on the arcs"),
    say(
        "As long as the roller runs on one arc, cam and follower move as a slider-crank mechanism: the crank "
        "from the cam centre to the arc's centre, the rod from there to the roller. Its plans give velocity and "
        "acceleration."
    ),
    {
        "s": ReadingMeaning(say("displacement s"), "s", "mm"),
        "v": ReadingMeaning(say("velocity v"), "v", "mm/rad"),
        "a": ReadingMeaning(say("acceleration a"), "a", "mm/rad²"),
        "alpha": ReadingMeaning(say("pressure angle α"), "α", "rad"),
        "x": ReadingMeaning(say("x"), "x", "mm"),
        "y": ReadingMeaning(say("y"), "y", "mm"),
        "rho": ReadingMeaning(
            say("minimum radius of curvature ρ"),
            "ρ",
            "mm",
            (ComparedReading("min_pitch_curvature_radius", say("minimum ρ")),),
        ),
        "roller_radius": ReadingMeaning(
            say("roller radius r"), "r", "mm", (ComparedReading("roller_radius", say("roller radius")),)
        ),
        "lift": ReadingMeaning(say("lift h"), "h", "mm", (ComparedReading("lift", say("lift")),)),
        "prime_radius": ReadingMeaning(say("prime radius r₀"), "r₀", "mm", (ComparedReading("prime_radius"),)),
        **{
            name: ReadingMeaning(
                title, f"φ({point})", "rad", (ComparedReading(f"phi_{point}_deg", say("φ at {point}", point=point)),)
            )
            for name, point, title in (
                ("phi_G", "G", say("φ at G")),
                ("phi_F", "F", say("φ at F")),
                ("rise", "D", say("angle of the rise")),
            )
        },
        **{name: ReadingMeaning(title, "a", "mm/rad²", (ComparedReading(name),)) for name, title in ENDS.items()},
    },
    FORMULAS,
    scales={"roller": "x"},
)


def arc_roller(arcs: ArcOutline, roller_radius: float, stations: ArcStations, pencil: Pencil) -> RollerOnArcs:
    """Put the roller on the arcs at every station of the rise, and find s, v and a there.

    Readings besides those of the meaning: the cam angles ``phi`` of the stations, and ``edges`` (..., 4) where the arcs
    begin and the last one ends.
    Points: ``B``, ``C`` the centre of its arc, ``K``, ``right`` the corner of the right angle, ``beyond`` where it cuts
    off the rod, ``N``, ``M``; ``trace``, the roller's centre in A, G, F and D; ``ray``, directions.
    """
    hand, mu_l, sigma = Hand(pencil, MEANING), arcs.givens.mu_l.per_mm, sense_sign(arcs)
    o, (a_, g, f, d, c1, c2, c3) = (
        hand.given("O"),
        (hand.earlier_places(arcs, name) for name in (*"AGFD", "C1", "C2", "C3")),
    )
    # The roller's centre lies on the line of centres through each joint.
    touch = hand.take("touch", a_, g, f, d)
    lines = hand.join("lines of centres", hand.take("centres", c2, c2, c3, c1), touch)
    trace = hand.lay_off("trace", touch, lines, roller_radius / mu_l)
    to_joints = hand.join("to the joints", o, trace)
    joints = {"phi_G": to_joints[1], "phi_F": to_joints[2], "rise": to_joints[3]}
    edges = [hand.angle(name, to_joints[0], to_joint, -sigma) for name, to_joint in joints.items()]
    measured = calculated_setting(_with_leading_zero, *(hand.carry(edge) for edge in edges))
    phi = calculated_setting(partial(_stations_between, stations), measured)
    rays = hand.protractor("rays", o, to_joints[0], calculated_setting(partial(np.multiply, -sigma), phi))
    # Each arc passes through the joint at which it begins, the last one ends on the outer circle.
    centres, on = hand.take("centres of the arcs", c2, c3, c1), trace[[0, 1, 3]]
    paths = hand.circle("arcs of the roller's centre", centres, distance_between(centres, on))
    hand.circle("dwells of the roller's centre", o, distance_between(o, trace[[3, 0]]))
    b, c = hand.cross("B", rays, paths[stations.arc]), hand.take("C", centres, which=stations.arc)
    rods = hand.join("rods", b, c)
    outward = rods.turned(-1)
    across = hand.perpendicular("across", rays, o)
    k = hand.cross("K", rods, across)
    erected = hand.perpendicular("perpendiculars in C", outward, c)
    right = hand.lay_off("right", erected, erected, distance_between(c, k))
    beyond = hand.cross("beyond", hand.perpendicular("right angles", hand.join("legs", right, b), right), rods)
    n = hand.lay_off("N", c, outward, distance_between(c, beyond))
    m = hand.cross("M", hand.perpendicular("perpendiculars in N", outward, n), rays)
    prime_radius = distance_between(o, trace[0])
    hand.read("s", calculated_setting(np.subtract, distance_between(o, b), distance_between(o, trace[[0]])), mu_l)
    hand.read("v", distance_between(o, k, across.turned(-sigma)), mu_l)
    hand.read("a", distance_between(m, o, rays), mu_l)
    hand.angle("alpha", rays, outward, sigma)
    hand.read("phi", phi, 1.0, "rad", rounded=False)
    for name, along in (("x", RIGHT), ("y", UP)):
        hand.read(name, distance_between(o, b, along), mu_l)
    hand.read("edges", measured, 1.0, "rad", rounded=False)
    hand.read("lift", calculated_setting(np.subtract, distance_between(o, b[-1]), prime_radius), mu_l)
    hand.read("prime_radius", prime_radius, mu_l)
    hand.read("roller_radius", distance_between(touch[3], trace[3]), mu_l)
    hand.read("rho", calculated_setting(np.minimum, distance_between(c1, trace[3]), prime_radius), mu_l)
    ends = [at for span in stations.spans for at in (span.start, span.stop - 1)]
    for name, at in zip(ENDS, ends, strict=True):
        hand.read(name, distance_between(m[at], o, rays[at]), mu_l)
    points = {"B": b, "C": c, "K": k, "right": right, "beyond": beyond, "N": n, "M": m, "trace": trace}
    givens = ArcRollerGivens(arcs, roller_radius, stations)
    return hand.finished(givens, _draw, points | {"ray": unit(rays.directions)})


def _with_leading_zero(*angles: Floats) -> Floats:
    """Angles in a row after one of zero, (..., k + 1)."""
    return np.stack([np.zeros_like(angles[0]), *angles], axis=-1)


def _stations_between(stations: ArcStations, edges: Floats) -> Floats:
    """The cam angles of the stations between the ``edges`` (..., 4) of the arcs."""
    start, end = edges[..., stations.arc], edges[..., stations.arc + 1]
    return start + (end - start) * stations.u


# --- the steps -------------------------------------------------------------------------------------------------------

RAY_OVERHANG = 7.0
"""How far the rays run on beyond the roller's centre [mm]."""


def _draw(rolled: RollerOnArcs) -> list[Step]:
    if np.isnan(rolled.first("trace")).any():
        missing = and_list([indexed(name) for name in ("C1", "C2", "C3") if np.isnan(rolled.givens.arcs.first(name))])
        said = say(
            "Not every arc has a centre that can be read ({missing}), so the roller has no path.", missing=missing
        )
        return [unreadable_step(say("The arcs of the roller's centre"), said, ROLLER)]
    return [_paths(rolled), _joints(rolled), _stations(rolled), *plans(rolled, ENDS), _scheme(rolled)]


def _scheme(rolled: RollerOnArcs) -> Step:
    sigma, radius = sense_sign(rolled.givens.arcs), rolled.givens.roller_radius
    said = say("The cam turns {rotation} about O and moves a translating follower; its roller turns about B.")
    if not radius:
        said = say("The cam turns {rotation} about O and moves a translating follower; its knife edge is B.")
    said = said.with_values(rotation=sense_caption("ccw" if sigma > 0 else "cw"))
    marks = sketched_stem("O", 0.0, sigma, radius, 0.0)
    why = say("The diagram shows how the links are joined; its cam is simplified.")
    return Step(say("Kinematic diagram"), (Part(said),), SCHEME, marks, given=marks, why=why)


def _prime(rolled: RollerOnArcs) -> Drawn:
    return rolled.acts["dwells of the roller's centre"].first[1]


def _radii(circle: Drawn) -> list[float]:
    return np.atleast_1d(np.asarray(circle.first.radius)).tolist()


def _paths(rolled: RollerOnArcs) -> Step:
    arcs, acts, trace, roller = rolled.givens.arcs, rolled.acts, rolled.acts["trace"], rolled.givens.roller_radius
    axis, o, lines, prime = middle_of_dwell(arcs), acts["O"], acts["lines of centres"].first, _prime(rolled)
    profile, joints = cam(arcs, axis), [arcs.acts[name] for name in "AGFD"]
    centres = {name: acts[f"three_arcs: {name}"] for name in ("C3", "C1")}
    starts = np.array([centres[name].place for name in ("C3", "C3", "C1")])
    values = {"roller": roller, "paper": roller / arcs.givens.mu_l.per_mm, "prime": _radii(prime)[0]}
    copied = say("Copy the profile from the drawing of the arcs, with O, the joints, C₁ and C₃.")
    if not roller:
        copied = say(
            "The knife edge moves along the arcs of the profile itself: copy it from the drawing of the arcs, with O, "
            "the joints, C₁ and C₃."
        )
    parts = [Part(copied, (*(circle for _, circle in profile), *joints, o, *centres.values()))]
    marks: list[Mark] = [
        *(mark for mark, _ in profile),
        Segments(trace.shown[1:], starts, Role.AXIS).left_by(lines[1:]),
        *(joint.label(name, -at) for joint, name, at in zip(joints, "AGFD", trace.shown.tolist(), strict=True)),
        *(o.dots(), o.label("O", -1 - 1j), prime.drawn_circle(Role.CONSTRUCTION)),
        *(mark for name, at in centres.items() for mark in (at.dots(), at.label(indexed(name), -UP))),
    ]
    why = say("A knife edge has no radius, so it runs on the profile itself.")
    if roller:
        why = say(
            "A roller touches an arc on the line through the arc's centre, so its own centre stays r farther out."
        )
        paths, dwells = (acts[f"{name} of the roller's centre"].first for name in ("arcs", "dwells"))
        circles = [paths[0], paths[1], paths[2], dwells[0], dwells[1]]
        grown = outline(arcs, axis, circles, trace.shown, Role.CURVE)
        marks += [trace.dots(Role.CONSTRUCTION), *(mark for mark, _ in grown)]
        parts += [_lines_to_centre(rolled, values), _arcs(rolled, [circle for _, circle in grown])]
    circled = say(
        "Draw the prime circle about O through the path at A, also over the lower dwell: compass {prime:.2f} mm."
    )
    parts.append(Part(circled.with_values(**values), (prime,)))
    title, reads = say("The arcs of the roller's centre"), ("prime_radius", "roller_radius", "rho")
    return Step(title, tuple(parts), ROLLER, tuple(marks), reads, why=why)


def _lines_to_centre(rolled: RollerOnArcs, values: dict[str, float]) -> Part:
    lines, trace = rolled.acts["lines of centres"].first, rolled.acts["trace"].first
    said = say(
        "The roller's centre moves along arcs about the same centres, with radii larger by r = {roller:g} mm: from "
        "every joint set {paper:.2f} mm off outward on its line of centres."
    ).with_values(**values)
    centres = [say("on the line from {centre}", centre=name) for name in ("O", "C₃", "C₃", "C₁")]
    return telling.run(said, say("From {name}"), "AGFD", lines, trace, settings=centres.__getitem__)


def _arcs(rolled: RollerOnArcs, circles: list[Drawn]) -> Part:
    radii, about = [_radii(circle)[0] for circle in circles], say("about {centre}, compass {radius:.2f} mm")
    rows = [Row(ARCS[k], about.with_values(centre=CENTRES[k], radius=radii[k]), (circles[k],)) for k in range(3)]
    if rolled.givens.arcs.givens.dwell:
        rows.append(Row(say("Upper dwell"), about.with_values(centre="O", radius=radii[3]), (circles[3],)))
    mirrored = say("the three arcs, mirrored in {line}", line=mirror_line(rolled.givens.arcs))
    rows.append(Row(say("Return"), mirrored, tuple(circles[-4:-1])))
    said = say(
        "Open the compass from each centre to the points set off and draw the arcs, {arc} about {centre} with "
        "{radius:.2f} mm."
    ).with_values(arc=ARCS[0], centre=CENTRES[0], radius=radii[0])
    return Part(said, rows=tuple(rows))


def _joints(rolled: RollerOnArcs) -> Step:
    lines, trace, sigma = rolled.acts["to the joints"].first, rolled.acts["trace"].first, sense_sign(rolled.givens.arcs)
    angles = np.abs(rolled.first("edges"))
    base, reads = float(np.angle(trace.shown[0])), ("phi_G", "phi_F", "rise")
    values = {"g": angles[1], "f": angles[2], "d": angles[3]}
    values = {key: float(np.degrees(angle)) for key, angle in values.items()} | {"sense": SENSE_NAMES[sigma]}
    said = say(
        "Join O with the points of the path at A, G, F and D. Set the protractor on OA and read the angles of the "
        "others {sense}: {g:.3f}° at G, {f:.3f}° at F, and {d:.3f}° at D, where the rise ends."
    )
    size = abs(complex(trace.shown[0]))
    marks: list[Mark] = [lines.segments(Role.CONSTRUCTION)]
    for k, name in enumerate(reads, 1):
        low, high = sorted((base, base - sigma * float(angles[k])))
        shown_as = say("{angle:.2f}°", angle=float(np.degrees(angles[k])))
        marks.append(AngleMark(0j, (0.15 + 0.15 * k) * size, low, high, shown_as, of=rolled.readings[name].act))
    why = say("These are the angles by which the cam turns while the roller runs over one arc after another.")
    part = telling.run(
        *(said.with_values(**values), say("Line O{name}"), "AGFD", lines),
        settings=lambda k: say("{angle:.3f}°", angle=float(np.degrees(angles[k]))) if k else "",
    )
    return Step(say("The angles of the arcs"), (part,), ROLLER, tuple(marks), reads, why=why)


def _stations(rolled: RollerOnArcs) -> Step:
    arcs, stations, b, rays = rolled.givens.arcs, rolled.givens.stations, rolled.acts["B"], rolled.acts["rays"].first
    reach, ray = float(np.abs(rolled.first("trace")[-1])) + RAY_OVERHANG, rolled.first("ray")
    ends, mu_l = rays.shown + reach * ray, arcs.givens.mu_l.per_mm
    hand, axis = errorless_hand(rolled), middle_of_dwell(arcs)
    returning, feet = hand.mirrored("B on the return", b.first, axis), hand.cross("feet", rays, _prime(rolled))
    rollers = _rollers(rolled, hand)
    phi, s = np.degrees(rolled.first("phi")), rolled.first("s")
    at = worked_station(stations, s)
    named = (
        Label(ends[k], stations.names[k], ray[k], small=True, of=rays.act, index=rays[k].index)
        for k in standing_apart(ends, stations.ends_first)
    )
    marks: tuple[Mark, ...] = (
        Segments(rays.shown, ends, Role.CONSTRUCTION).left_by(rays),
        Segments(feet.shown, b.shown, Role.RESULT).left_by(rays),
        *(each.dots(Role.CONSTRUCTION) for each in (b, returning)),
        *(each.drawn_circle(Role.CONSTRUCTION) for each in rollers.values()),
        *named,
        Line(np.array([0j, complex(unit(axis.directions)) * reach]), Role.AXIS).left_by(axis),
    )
    one = say("{phi:.3f}°, on the arc about {centre} {s:.2f} mm outside the prime circle")
    level, rows = say("{phi:.3f}°, on the prime circle"), list[Row]()
    for name, places in stations.places.items():
        k = places[0]
        told = UNREADABLE if np.isnan(s[k]) else one if s[k] > NEGLIGIBLE_SIZE else level
        told = told.with_values(phi=abs(phi[k]), centre=CENTRES[stations.arc[k]], s=s[k])
        draws = rays[places], b.first[places], *(rollers[j] for j in places if j in rollers)
        rows.append(Row(say("Ray {name}", name=name), told, draws))
    said = say(
        "Hold the cam and turn the follower the other way, {sense}. Divide the angle of each arc into {parts} "
        "equal parts, set the angles off from OA with the protractor and number the rays. Ray {name} makes "
        "{phi:.3f}° with OA and meets the arc about {centre} in B. With the dividers take the distance of B "
        "outside the prime circle: {s:.2f} mm × {mu:g} = {lift:.3f} mm is the displacement."
    ).with_values(
        parts=stations.u.size // 3 - 1,
        name=stations.names[at],
        phi=abs(phi[at]),
        centre=CENTRES[stations.arc[at]],
        s=s[at],
        lift=s[at] * mu_l,
        sense=SENSE_NAMES[sense_sign(arcs)],
        mu=mu_l,
    )
    back = Part(say("Return: mirror the points B in {line}.", line=mirror_line(arcs)), (returning,))
    why = say(
        "Turning the follower about a fixed cam is the same relative motion as turning the cam under the follower."
    )
    parts = Part(said, rows=tuple(rows)), back
    return Step(say("Stations"), parts, ROLLER, marks, ("lift", "s", "x", "y"), why=why)


def _rollers(rolled: RollerOnArcs, hand: Hand) -> dict[int, Drawn]:
    """The roller in the middle of every arc, by its station."""
    stations, radius = rolled.givens.stations, rolled.givens.roller_radius / rolled.givens.arcs.givens.mu_l.per_mm
    if not radius:
        return {}
    middle = [span.start + stations.u.size // 6 for span in stations.spans]
    rollers = hand.circle("rollers", rolled.acts["B"].first[middle], radius)
    return {k: rollers[j] for j, k in enumerate(middle)}
