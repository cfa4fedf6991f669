"""The profile under a flat face by inversion: the envelope of the face's positions.

On the ray of every inverted position r0 + s is laid off and the perpendicular, the face, is drawn.  The profile touches
it ds/dphi to the side of the ray: to the right of a cam that turns counter-clockwise while the follower rises.
"""

import math

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.axes import number_labels, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import Caption, Part, Step, Words, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.meaning import R0, RADIUS, ComparedReading, Formula, Meaning, ReadingMeaning, S, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.telling import STATION, run, setting
from graphcam.given.follower import Rotation, sense
from graphcam.given.stations import Stations

FACE_OVERHANG = 6.0
"""How far a face is drawn beyond the place where it is touched, and to the other side of its ray [mm]."""


EXTREMES = {
    1: (r"-\min\frac{ds}{d\varphi}", r"\max\frac{ds}{d\varphi}"),
    -1: (r"\max\frac{ds}{d\varphi}", r"-\min\frac{ds}{d\varphi}"),
}
"""What the face must reach to, left and right, by the sense in which the cam turns."""


def _worked_values(inverted: profile_view.Inverted) -> Values:
    """The formula's values: the polar radius at the worked station."""
    givens, stations, r0 = inverted.givens, inverted.givens.integrated.givens.stations, inverted.givens.prime_radius
    k = profile_view.worked_station(stations)
    s, v = (float(givens.integrated.value(name)[k]) for name in "sv")
    yield {"k": station_names(stations)[k], "r0": r0, "s": s, "v": abs(v), "radius": math.hypot(r0 + s, v)}


def _widths(inverted: profile_view.Inverted) -> Values:
    """The formula's values: the width of the face on either side, and in all [mm]."""
    left, right = (float(inverted.value(f"face_{side}")) for side in ("left", "right"))
    left_of, right_of = EXTREMES[sense(inverted.givens.rotation)]
    yield {"left": left, "right": right, "width": left + right, "left_of": left_of, "right_of": right_of}


FORMULAS = (
    Formula(
        r"R = \sqrt{(r_0 + s)^2 + \left(\frac{ds}{d\varphi}\right)^2}",
        r"R_{<k>} = \sqrt{(<r0:.6g> + <s:.2f>)^2 + <v:.2f>^2} = <radius:.2f>\ \text{<mm>}",
        _worked_values,
        (RADIUS, R0, S),
        of="radius",
    ),
    Formula(
        r"b_l = <left_of>, \qquad b_r = <right_of>, \qquad b = b_l + b_r",
        r"b = <left:.2f> + <right:.2f> = <width:.2f>\ \text{<mm>}",
        _widths,
        (
            Symbol("b_l", say("what the face needs to the left of the line of motion"), "mm"),
            Symbol("b_r", say("what it needs to the right"), "mm"),
            Symbol("b", say("its minimum width"), "mm"),
        ),
        of="face_left",
    ),
)


MEANING = Meaning(
    "inversion",
    say("Profile by inversion"),
    say(
        "The cam is held still and the frame is turned about it, against the cam's rotation. In each position "
        "the face is moved by its displacement. It touches the cam beside its ray, at a distance equal to the "
        "velocity as a length."
    ),
    {
        "face_left": ReadingMeaning(
            say("half-width of the face, left"), "bₗ", "mm", (ComparedReading("face_left", say("face to the left")),)
        ),
        "face_right": ReadingMeaning(
            say("half-width of the face, right"), "bᵣ", "mm", (ComparedReading("face_right", say("face to the right")),)
        ),
        "contact": ReadingMeaning(say("contact beside the ray"), "q", "mm"),
        **profile_view.CURVE_MEANINGS,
    },
    FORMULAS,
    scales={"profile": "x"},
)


def flat_inversion(
    integrated: Integrated, rotation: Rotation, prime_radius: float, mu_l: Scale, pencil: Pencil
) -> profile_view.Inverted:
    """Lay off r0 + s on the rays, draw the faces, and mark where the profile touches them.

    mu_l : drawing scale of the profile [mm/mm]
    """
    hand, sigma, pieces = Hand(pencil, MEANING), sense(rotation), integrated.givens.stations.pieces
    s, v = integrated.readings["s"], integrated.readings["v"]
    prime = profile_view.prime_circle(hand, prime_radius, mu_l)
    rays = profile_view.inverted_positions(hand, integrated, rotation, UP)
    feet = hand.lay_off("feet", hand.cross("starts", rays, prime), rays, hand.carry(s, s.scale / mu_l.per_mm))
    faces, aside = hand.perpendicular("faces", rays, feet), hand.carry(v, sigma * np.asarray(v.scale) / mu_l.per_mm)
    touch = hand.lay_off("pitch", feet, faces.turned(-1), aside)
    profile_view.curve_readings(hand, touch, mu_l)
    hand.read("contact", calculated_setting(np.copysign, distance_between(feet, touch), aside), mu_l.per_mm)
    # The contact over the cam angle, faired as any other curve, says how far it wanders.
    axis, origin = hand.earlier_places(integrated.givens.diagram, "axis"), hand.given("cam centre")
    wander = hand.lay_off("contacts", axis, UP, aside)
    lowest, highest = (hand.tangent(f"farthest {way}", wander, pieces, way * UP) for way in (-1, 1))
    hand.read("face_left", distance_between(lowest, origin, UP), mu_l.per_mm)
    hand.read("face_right", distance_between(origin, highest, UP), mu_l.per_mm)
    givens = profile_view.InvertedGivens(integrated, rotation, prime_radius, mu_l)
    return hand.finished(givens, _draw, {"feet": feet, "pitch": touch, "motion": rays.directions})


# --- the steps -------------------------------------------------------------------------------------------------------

ENVELOPE_SAID = say(
    "Join the contact points by the smooth curve that touches every face at its contact point: it is the envelope."
)
ENVELOPE_WHY = say("The cam touches the face in every position and crosses it in none.")


def _draw(inverted: profile_view.Inverted) -> list[Step]:
    decided, mu_l = inverted.givens.adopted(), inverted.givens.mu_l.per_mm
    adoption = [adoption_step(decided, "e", mu_l, PROFILE)] if decided else []
    profile = profile_view.pitch_steps(inverted, _contacts(inverted), say("Profile"), ENVELOPE_SAID, ENVELOPE_WHY)
    return [*adoption, _circle(inverted), _rays(inverted), _faces(inverted), *profile]


def _stations(inverted: profile_view.Inverted) -> Stations:
    return inverted.givens.integrated.givens.stations


def _on_profile(inverted: profile_view.Inverted, name: str) -> dict[str, float | str]:
    """The caption's values for ordinates on their way to the profile, with the name of the worked station."""
    mu, mu_l = inverted.givens.integrated.readings[name].per_mm, inverted.givens.mu_l.per_mm
    stations = _stations(inverted)
    at = station_names(stations)[profile_view.worked_station(stations)]
    return {"mu": mu, "mu_l": mu_l, "factor": mu / mu_l, "name": at}


def _circle(inverted: profile_view.Inverted) -> Step:
    why = say("The face is r₀ from the cam centre before the follower rises.")
    return profile_view.prime_step(inverted, say("Prime circle"), profile_view.start_of_turn(inverted), why=why)


def _rays(inverted: profile_view.Inverted) -> Step:
    rays, starts = (inverted.acts[name].first for name in ("inverted positions", "starts"))
    said = say(
        "The cam turns {rotation}: hold it still and turn the follower the other way, {against}. For every station set "
        "the protractor to its angle from the vertical, {against}, draw the ray from the cam centre to the prime "
        "circle, and number it: ray {name} at {angle}."
    ).with_values(**profile_view.position_words(inverted))
    marks = (
        Segments(rays.shown, starts.shown, Role.CONSTRUCTION).left_by(rays),
        *number_labels(starts, _stations(inverted), -unit(starts.shown)),
    )
    why = say("Seen from the cam, the follower goes round the other way and meets the same points of the cam.")
    turned = run(said, say("Ray {name}"), station_names(_stations(inverted)), rays, starts)
    return Step(say("Rays of the inverted positions"), (turned,), PROFILE, marks, why=why)


def _faces(inverted: profile_view.Inverted) -> Step:
    starts, feet, faces = (inverted.acts[name].first for name in ("starts", "feet", "faces"))
    contact, across = inverted.first("contact"), -unit(faces.directions)
    left = faces.shown + across * (np.minimum(contact, 0) - FACE_OVERHANG)
    right = faces.shown + across * (np.maximum(contact, 0) + FACE_OVERHANG)
    said = say(
        "On each ray lay off the displacement with the dividers, outward from the prime circle: its ordinate times "
        "μₛ/μₗ = {mu:.5g}/{mu_l:g} = {factor:.5g}. Station {name}: {length}. With two set squares draw the face there, "
        "square to the ray."
    ).with_values(length=setting(feet[profile_view.worked_station(_stations(inverted))]), **_on_profile(inverted, "s"))
    marks = (
        *(feet.segments_from(starts, Role.CONSTRUCTION), feet.dots(Role.CONSTRUCTION)),
        Segments(left, right, Role.CONSTRUCTION).left_by(faces),
    )
    why = say("The face is r₀ + s from the cam centre, square to the motion.")
    part = run(said, STATION, station_names(_stations(inverted)), feet, faces)
    return Step(say("Faces"), (part,), PROFILE, marks, why=why)


def _contacts(inverted: profile_view.Inverted) -> Step:
    pitch, mu_l, v = inverted.acts["pitch"].first, inverted.givens.mu_l.per_mm, inverted.givens.integrated.first("v")
    sigma = sense(inverted.givens.rotation)

    def laid_off(k: int) -> Words:
        """The length at station k, and the side to which it is laid off."""
        length, side = setting(pitch[k]), _side(v[k] * sigma)
        return say("{length} {side}", length=length, side=side) if isinstance(length, Caption) else length

    said = say(
        "From the end of each ray lay off the velocity along the face with the dividers: its ordinate times μᵥ/μₗ = "
        "{mu:.5g}/{mu_l:g} = {factor:.5g}, on a rise {side}, seen from the cam centre, and on a return to the other "
        "side. Station {name}: {length}. The ends are the contact points: number them."
    ).with_values(side=_side(sigma), length=laid_off(profile_view.worked_station(_stations(inverted))))
    widths = {side: float(inverted.value(f"face_{side}")) for side in ("left", "right")}
    widest = say(
        "Joined over φ by a smooth curve, as the velocities are, these lengths reach {left_mm:.2f} mm to the left and "
        "{right_mm:.2f} mm to the right: times {mu_l:g} the half-widths of the face, {left:.2f} mm and {right:.2f} mm."
    ).with_values(mu_l=mu_l, **widths, **{f"{side}_mm": width / mu_l for side, width in widths.items()})
    said = said.with_values(**_on_profile(inverted, "v"))
    parts = run(said, STATION, station_names(_stations(inverted)), pitch, settings=laid_off), Part(widest)
    why = say("The cam's point ds/dφ beside the ray moves along the ray just as fast as the face: they touch there.")
    reads = ("face_left", "face_right", "contact", *profile_view.CURVE_READINGS)
    return Step(say("Contact points"), parts, PROFILE, (), reads, why=why)


def _side(aside: float) -> Caption:
    return say("to the right") if aside > 0 else say("to the left")
