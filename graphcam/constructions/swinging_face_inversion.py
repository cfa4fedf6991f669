"""The profile under an oscillating flat face by inversion: its pivot goes round the cam, and the face swings about it.

The face at rest is a tangent from the pivot: to the prime circle, or with an offset f, as the line through the pivot,
to the circle with the radius r0 + f.  The profile touches a face at the foot of the perpendicular from the pole of cam
and follower, which divides the line of centres as their angular velocities.
"""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.arm_inversion import pivots_step
from graphcam.constructions.arm_positions import arc_through, example_station, turning_angle
from graphcam.constructions.axes import station_names
from graphcam.constructions.flat_inversion import ENVELOPE_SAID, ENVELOPE_WHY
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Role, Segments, angle_at
from graphcam.drafting.meaning import (
    DISTANCE,
    RADIUS,
    SIGMA,
    ComparedReading,
    Formula,
    Meaning,
    ReadingMeaning,
    S,
    Symbol,
    V,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale
from graphcam.drafting.telling import STATION, circle_caption, no_setting, run
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.words import say_in

FACE_OVERHANG = 6.0
"""How far a face is drawn beyond the places where it is touched in the course of a turn [mm]."""
ARC_OVERHANG = 0.05
"""How far the arcs across the circle of the tangents are drawn beyond them [rad]."""
ANGLE_SHARE = 0.3
"""The arc of the angle at rest has this part of the centre distance as its radius."""
SWINGING_PSI0 = Symbol(
    r"\psi_0", say("the angle between the face and the line of centres at the start of the lift"), "°"
)
FACE_OFFSET = Symbol("f", say("the offset of the face from the line through its pivot, towards A"), "mm")


@dataclass(frozen=True, eq=False)
class SwingingInvertedGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`swinging_face_inversion`."""

    distance: float
    face_offset: float


SwingingInverted = Construction[SwingingInvertedGivens]


def _worked_values(inverted: SwingingInverted) -> Values:
    """The formula's values: the polar radius at the worked station."""
    givens, stations = inverted.givens, inverted.givens.integrated.givens.stations
    k = profile_view.worked_station(stations)
    s, v = (float(givens.integrated.value(name)[k]) for name in "sv")
    c, f, turning = givens.distance, givens.face_offset, sense(givens.rotation) * v
    psi0 = float(inverted.value("psi0"))
    height, aside = c * math.sin(psi0 + s) - f, c * turning * math.cos(psi0 + s) / (1 + turning)
    angle = math.degrees(psi0 + s)
    yield {"k": station_names(stations)[k], "c": c, "f": abs(f), "psi": angle, "v": turning} | {
        "minus": "-" if f >= 0 else "+",
        "plus": "+" if turning >= 0 else "-",
        "size": abs(turning),
        "radius": math.hypot(height, aside),
    }


FORMULAS = (
    Formula(
        r"R = \sqrt{(c\sin(\psi_0 + s) - f)^2 + \left(\frac{\sigma v}{1 + \sigma v}\,c\cos(\psi_0 + s)\right)^2}",
        r"R_{<k>} = \sqrt{(<c:.6g>\sin <psi:.3f>^\circ <minus> <f:g>)^2 + "
        r"\left(\frac{<v:.4f>}{1 <plus> <size:.4f>} \cdot <c:.6g>\cos <psi:.3f>^\circ\right)^2}"
        r" = <radius:.2f>\ \text{<mm>}",
        _worked_values,
        (RADIUS, DISTANCE, FACE_OFFSET, SWINGING_PSI0, S, V, SIGMA),
        of="radius",
    ),
)


MEANING = Meaning(
    "inversion",
    say("Profile by inversion"),
    say(
        "The cam is held still and the frame is turned about it, against the cam's rotation. At each position of the "
        "pivot the face is turned by its displacement. The profile is the curve that touches all these faces."
    ),
    {
        "psi0": ReadingMeaning(say("angle of the face at rest ψ₀"), "ψ₀", "rad"),
        "face_near": ReadingMeaning(
            say("nearest contact on the face"),
            "qₘᵢₙ",
            "mm",
            (ComparedReading("face_near", say("nearest contact from the pivot")),),
        ),
        "face_far": ReadingMeaning(
            say("farthest contact on the face"),
            "qₘₐₓ",
            "mm",
            (ComparedReading("face_far", say("farthest contact from the pivot")),),
        ),
        "contact": ReadingMeaning(say("contact from the pivot along the face"), "q", "mm"),
        **profile_view.CURVE_MEANINGS,
    },
    FORMULAS,
    scales={"profile": "x"},
)


def swinging_face_inversion(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    distance: float,
    face_offset: float,
    mu_l: Scale,
    pencil: Pencil,
) -> SwingingInverted:
    """Step the pivot off on its circle, draw the tangent at rest from it, turn it, and mark where it is touched.

    integrated : of an angle s [rad];  distance, face_offset : c and f [mm];  mu_l : drawing scale [mm/mm]
    """
    hand, (s, v) = Hand(pencil, MEANING), (integrated.readings[name] for name in "sv")
    prime, centre = profile_view.prime_circle(hand, prime_radius, mu_l), hand.given("cam centre")
    circle = hand.circle("pivot circle", centre, distance / mu_l.per_mm)
    rays = profile_view.inverted_positions(hand, integrated, rotation, RIGHT)
    pivots = hand.cross("pivots", rays, circle)
    touched = hand.circle("circle of the tangents", centre, (prime_radius + face_offset) / mu_l.per_mm)
    touched = touched if face_offset else prime
    # The tangent from the first pivot, by the circle of Thales; its length serves all the others.
    first = pivots[0]
    half = hand.divide("middle", centre, first, 0.5)
    thales = hand.circle("circle of Thales", half, distance_between(half, first))
    tangent = hand.cross("first tangent", touched, thales)
    arcs = hand.circle("arcs of the tangents", pivots, distance_between(first, tangent))
    starts = hand.cross("starts", touched, arcs)
    lines = hand.protractor("lines", pivots, hand.join("lines at rest", pivots, starts), hand.carry(s, -s.scale))
    feet = hand.lay_off("feet", pivots, lines.turned(1j), face_offset / mu_l.per_mm)
    faces = hand.parallel("faces", lines, feet) if face_offset else lines
    share = partial(_pole_share, sense(rotation), distance / mu_l.per_mm)
    poles = hand.lay_off("poles", centre, rays, calculated_setting(share, hand.carry(v, v.scale)))
    pitch = hand.project("pitch", poles, faces)
    profile_view.curve_readings(hand, pitch, mu_l)
    to_centre = hand.join("line of centres", first, centre)
    hand.angle("psi0", to_centre, hand.join("first line at rest", first, tangent), -1)
    from_foot = distance_between(feet, pitch)
    hand.read("contact", from_foot, mu_l.per_mm)
    # The contact over the cam angle, faired as any other curve, says how far it wanders.
    axis, origin = hand.earlier_places(integrated.givens.diagram, "axis"), hand.given("origin")
    wander, pieces = hand.lay_off("contacts", axis, UP, from_foot), integrated.givens.stations.pieces
    for name, way in (("near", -1), ("far", 1)):
        end = hand.tangent(f"{name}est" if way < 0 else "farthest", wander, pieces, way * UP)
        hand.read(f"face_{name}", distance_between(origin, end, UP), mu_l.per_mm)
    givens = SwingingInvertedGivens(integrated, rotation, prime_radius, mu_l, distance, face_offset)
    places = {"pivots": pivots, "starts": starts, "pitch": pitch, "motion": unit(faces.turned(-1j).directions)}
    return hand.finished(givens, _draw, places)


def _pole_share(sigma: int, distance: float, v: Floats) -> Floats:
    """How far the pole lies from the cam centre, towards the pivot: c sigma v/(1 + sigma v)."""
    return distance * sigma * v / (1 + sigma * v)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(inverted: SwingingInverted) -> list[Step]:
    decided, mu_l = inverted.givens.adopted(), inverted.givens.mu_l.per_mm
    adoption = [adoption_step(decided, "c", mu_l, PROFILE)] if decided else []
    profile = profile_view.pitch_steps(inverted, _contacts(inverted), say("Profile"), ENVELOPE_SAID, ENVELOPE_WHY)
    return [*adoption, _circles(inverted), pivots_step(inverted), _rest(inverted), _faces(inverted), *profile]


def _circles(inverted: SwingingInverted) -> Step:
    givens, mu_l = inverted.givens, inverted.givens.mu_l.per_mm
    start, circle, touched = profile_view.start_of_turn(inverted), inverted.acts["pivot circle"], _touched(inverted)
    pivots = circle_caption(say_in("drawn", "the circle of the pivot about A"), "c", givens.distance, mu_l)
    parts, circles = [Part(pivots, (circle,))], [circle.drawn_circle(Role.CONSTRUCTION)]
    if givens.face_offset:
        tangents = say_in("drawn", "the circle about A that the line through the pivot touches at rest")
        radius = givens.prime_radius + givens.face_offset
        parts.append(Part(circle_caption(tangents, "r₀ + f", radius, mu_l), (touched,)))
        circles.append(touched.drawn_circle(Role.CONSTRUCTION))
    why = say("The pivot stays at the centre distance from A, and the face touches the prime circle before it swings.")
    title = say("Prime circle and pivot circle")
    return profile_view.prime_step(inverted, title, start, tuple(circles), why=why, parts=tuple(parts))


def _touched(inverted: SwingingInverted) -> Drawn:
    """The circle that the line through the pivot touches at rest."""
    return inverted.acts["circle of the tangents" if inverted.givens.face_offset else "prime circle"]


def _rest(inverted: SwingingInverted) -> Step:
    names = ("middle", "circle of Thales", "first tangent", "arcs of the tangents", "starts", "pivots")
    half, thales, tangent, arcs, starts, pivots = (inverted.acts[name].first for name in names)
    stations, psi0 = station_names(inverted.givens.integrated.givens.stations), float(inverted.value("psi0"))
    length = abs(tangent.place - pivots[0].place)
    first = say(
        "Halve the line from A to the first pivot C{name}, and with {half:.1f} mm draw the semicircle about its "
        "middle: it meets the circle in T. CT is the tangent, {length:.2f} mm long, and the face at rest leans by ψ₀ = "
        "{psi0:.2f}° from the line of centres."
    ).with_values(
        name=stations[0],
        half=float(np.asarray(thales.radius)),
        length=length,
        psi0=math.degrees(psi0),
    )
    others = say(
        "Keep {length:.2f} mm in the compass and strike it from every pivot across the circle, always on the left as "
        "seen from A: the points T of all tangents."
    ).with_values(length=length)
    line, centres = inverted.acts["first line at rest"].first, inverted.acts["line of centres"].first
    radius = ANGLE_SHARE * abs(pivots[0].place)
    named = say("ψ₀ = {angle:.2f}°", angle=math.degrees(psi0))
    start, end = (float(np.angle(way.directions)) for way in (centres, line))
    drawn = [arc_through(arcs[k], np.atleast_1d(starts.shown[k]), ARC_OVERHANG) for k in range(len(stations))]
    marks = (
        arc_through(thales, np.array([pivots[0].place, tangent.place, 0j]), 0.0),
        *(half.dots(Role.CONSTRUCTION), line.way(Role.CONSTRUCTION), centres.way(Role.AXIS)),
        angle_at(pivots[0].place, start, end, radius, named, inverted.readings["psi0"].act),
        *(*drawn, starts.dots(Role.CONSTRUCTION), tangent.label("T", tangent.place)),
    )
    struck = run(others, STATION, stations, arcs, starts, settings=no_setting)
    why = say("The angle in a semicircle is a right angle, so CT touches the circle about A in T.")
    parts = Part(first, (half, thales, tangent, line, centres)), struck
    return Step(say("The face at rest"), parts, PROFILE, marks, ("psi0",), why=why)


def _faces(inverted: SwingingInverted) -> Step:
    integrated, f = inverted.givens.integrated, inverted.givens.face_offset
    lines, faces = inverted.acts["lines"].first, inverted.acts["faces" if f else "lines"].first
    feet, pivots, contact = inverted.acts["feet"].first, inverted.acts["pivots"].first, inverted.first("contact")
    names, k = station_names(integrated.givens.stations), example_station(integrated, pivots)
    s, factor = integrated.first("s"), np.degrees(integrated.readings["s"].per_mm)
    said = say(
        "Turn every tangent about its pivot by the displacement, away from A (clockwise on the paper), with the "
        "protractor. Station {name}: {turn}."
    ).with_values(name=names[k], turn=turning_angle(s[k], factor))
    along = unit(faces.directions)
    near, far = float(np.nanmin(contact)) - FACE_OVERHANG, float(np.nanmax(contact)) + FACE_OVERHANG
    marks = [Segments(feet.shown + near * along, feet.shown + far * along, Role.CURVE).left_by(faces)]
    parts = [run(said, STATION, names, lines, settings=lambda n: turning_angle(s[n], factor))]
    if f:
        parallel = _offset_caption(f).with_values(length=abs(f) / inverted.givens.mu_l.per_mm, name=names[k])
        parts.append(run(parallel, STATION, names, feet, faces, settings=no_setting))
        marks.append(feet.segments_from(pivots, Role.CONSTRUCTION))
    why = say("The displacement is the angle through which the face has turned from its lowest position.")
    return Step(say("Faces"), tuple(parts), PROFILE, tuple(marks), why=why)


def _offset_caption(f: float) -> Caption:
    if f > 0:
        return say("Draw the face parallel to each of them with two set squares, {length:.2f} mm nearer to A.")
    return say("Draw the face parallel to each of them with two set squares, {length:.2f} mm farther from A.")


def _contacts(inverted: SwingingInverted) -> Step:
    integrated, poles, pitch = inverted.givens.integrated, inverted.acts["poles"].first, inverted.acts["pitch"].first
    names, k = station_names(integrated.givens.stations), example_station(integrated, inverted.acts["pivots"])
    v, c, sigma = (
        integrated.value("v"),
        inverted.givens.distance / inverted.givens.mu_l.per_mm,
        sense(inverted.givens.rotation),
    )
    v = v[0] if v.ndim > 1 else v

    def laid_off(n: int) -> Caption:
        """Where the instant centre P of a station lies, as a caption."""
        share = float(_pole_share(sigma, c, v[n]))
        if abs(share) < NEGLIGIBLE_SIZE:
            return say("P is A")
        said = (
            say("v = {v:.4f}: {share:.2f} mm towards C") if share > 0 else say("v = {v:.4f}: {share:.2f} mm beyond A")
        )
        return said.with_values(v=v[n], share=abs(share))

    formula = say("c·v/(1 + v)") if sigma > 0 else say("c·v/(1 − v)")
    towards = say("towards the pivot on a rise") if sigma > 0 else say("away from the pivot on a rise")
    said = say(
        "Read the velocity of every station, v = ds/dφ in radians per radian, calculate {formula} and lay it off from "
        "A on the line of centres, {towards}: the pole P. Station {name}: {length}. With two set squares drop the "
        "perpendicular from P on the face: its foot is the contact point. Number it."
    ).with_values(formula=formula, towards=towards, name=names[k], length=laid_off(k))
    ends = {name: float(inverted.value(f"face_{name}")) for name in ("near", "far")}
    reach = say(
        "Joined over φ by a smooth curve, the distances of the contact from the pivot, along the face, run from "
        "{near:.2f} mm to {far:.2f} mm: the face must be {length:.2f} mm long."
    ).with_values(**ends, length=ends["far"] - ends["near"])
    marks = (
        poles[k].dots(Role.CONSTRUCTION),
        poles[k].label("P", -UP),
        pitch[k].line_from(poles[k], Role.CONSTRUCTION),
    )
    why = say(
        "In the pole cam and face have the same velocity: they turn about it relative to one another, so the common "
        "normal in the contact passes through it."
    )
    parts = run(said, STATION, names, poles, pitch, settings=laid_off), Part(reach)
    reads = ("face_near", "face_far", "contact", *profile_view.CURVE_READINGS)
    return Step(say("Contact points"), parts, PROFILE, marks, reads, why=why)
