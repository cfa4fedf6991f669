"""The profile under a flat face by inversion: the envelope of the face's positions.

On the ray of every inverted position r0 + s is laid off and the perpendicular, the face, is drawn.  The profile touches
it ds/dphi to the side of the ray: to the right of a cam that turns counter-clockwise while the follower rises.
"""

import math
from dataclasses import replace

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.axes import numbers, station_names, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import Hand, between, reckoned
from graphcam.drafting.ink import Caption, Part, Step, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import NOTHING
from graphcam.given.follower import Rotation, sense
from graphcam.words import sequence

FACE_BEYOND = 6.0
"""How far a face is drawn beyond the place where it is touched, and to the other side of its ray [mm]."""


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
            say("half-width of the face, left"), "bₗ", "mm", (Compared("face_left", say("face to the left")),)
        ),
        "face_right": ReadingMeaning(
            say("half-width of the face, right"), "bᵣ", "mm", (Compared("face_right", say("face to the right")),)
        ),
        "contact": ReadingMeaning(say("contact beside the ray"), "q", "mm"),
        **profile_view.CURVE,
    },
    "report.flat_paragraphs.inversion",
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
    hand.read("contact", reckoned(np.copysign, between(feet, touch), aside), mu_l.per_mm)
    # The contact over the cam angle, faired as any other curve, says how far it wanders.
    axis, origin = hand.found(integrated.givens.diagram, "axis"), hand.given("cam centre")
    wander = hand.lay_off("contacts", axis, UP, aside)
    lowest, highest = (hand.tangent(f"farthest {way}", wander, pieces, way * UP) for way in (-1, 1))
    hand.read("face_left", between(lowest, origin, UP), mu_l.per_mm)
    hand.read("face_right", between(origin, highest, UP), mu_l.per_mm)
    givens = profile_view.InvertedGivens(integrated, rotation, prime_radius, mu_l)
    return hand.finished(givens, _draw, {"feet": feet, "pitch": touch, "motion": rays.directions})


# --- the steps -------------------------------------------------------------------------------------------------------

WORKED = 4
"""The station that a caption works in full."""


def _draw(inverted: profile_view.Inverted) -> list[Step]:
    decided, mu_l = inverted.givens.adopted(), inverted.givens.mu_l.per_mm
    adoption = [adoption_step(decided, "e", mu_l, PROFILE)] if decided else []
    touched, profile = profile_view.pitch_steps(
        inverted,
        _contacts(inverted),
        say("Profile"),
        say(
            "Join the contact points by the smooth curve that touches every face at its contact point: it is the "
            "envelope."
        ),
    )
    why = say("Because the cam touches the face in every position and crosses it in none.")
    return [*adoption, _circle(inverted), _rays(inverted), _faces(inverted), touched, replace(profile, why=why)]


def _worked(inverted: profile_view.Inverted) -> int:
    first = inverted.givens.integrated.givens.stations.phases[0]
    return min(first.start + WORKED, first.stop - 1)


def _name(inverted: profile_view.Inverted, k: int) -> str:
    return station_names(inverted.givens.integrated.givens.stations)[k]


def _on_profile(inverted: profile_view.Inverted, name: str, k: int) -> dict[str, float]:
    """What captions say of an ordinate at a station on its way to the profile, whatever its sign."""
    reading, mu_l = inverted.givens.integrated.readings[name], inverted.givens.mu_l.per_mm
    ordinate = abs(float(inverted.givens.integrated.first(name)[k]))
    factor = reading.per_mm / mu_l
    return {"mm": ordinate, "mu": reading.per_mm, "mu_l": mu_l, "factor": factor, "length": ordinate * factor}


def _circle(inverted: profile_view.Inverted) -> Step:
    """The prime circle."""
    r0, mu_l = inverted.givens.prime_radius, inverted.givens.mu_l.per_mm
    said = say(
        "Set the compass to {r0:g}/{mu_l:g} = {paper:.1f} mm, for r₀ = {r0:g} mm at {ratio}, and draw the prime circle "
        "about the cam centre A."
    ).where(r0=r0, mu_l=mu_l, paper=r0 / mu_l, ratio=ratio_text(mu_l))
    why = say("Because the face is r₀ from the cam centre before the follower rises.")
    step = profile_view.prime_step(inverted, say("Prime circle"), said, profile_view.start_of_turn(inverted))
    return replace(step, why=why)


def _rays(inverted: profile_view.Inverted) -> Step:
    """The follower's line in its inverted positions, numbered, up to the prime circle."""
    integrated, (rays, starts) = inverted.givens.integrated, _drawn(inverted, "inverted positions", "starts")
    stations = integrated.givens.stations
    against = turning("ccw" if inverted.givens.rotation == "cw" else "cw")
    captions = [_ray(inverted, k, against) for k in range(stations.phi.size)]
    phases, last = profile_view.phase_angles(inverted, profile_view.start_of_turn(inverted))
    said = say(
        "The cam turns {rotation}: hold it still and turn the follower the other way, {against}. {one} Repeat for the "
        "others, and number them. {marked}"
    ).where(
        rotation=turning(inverted.givens.rotation),
        against=against,
        one=captions[_worked(inverted)],
        marked=last.caption,
    )
    parts = [Part(caption, (rays[k], starts[k])) for k, caption in enumerate(captions)]
    marks = (
        Segments(rays.shown, starts.shown, Role.CONSTRUCTION).left_by(rays),
        *numbers(starts, stations, -unit(starts.shown)),
        *phases,
    )
    why = say("Because, seen from the cam, the follower goes round the other way and meets the same points of the cam.")
    title = say("Rays of the inverted positions")
    return Step(title, said, PROFILE, marks, why=why, parts=(*parts, last))


def _ray(inverted: profile_view.Inverted, k: int, against: Caption) -> Caption:
    angle = math.degrees(inverted.givens.integrated.givens.stations.phi[k])
    said = (
        say("Ray {name}: draw the vertical from the cam centre to the prime circle.")
        if angle < NOTHING
        else say(
            "Ray {name}: set the protractor to {angle:.2f}° from the vertical, {against}, and draw from the cam "
            "centre to the prime circle."
        )
    )
    return said.where(name=_name(inverted, k), angle=angle, against=against)


def _drawn(inverted: profile_view.Inverted, *names: str) -> list[Drawn]:
    return [inverted.acts[name].first for name in names]


def _faces(inverted: profile_view.Inverted) -> Step:
    """The displacements on the rays, and the faces there."""
    starts, feet, faces = _drawn(inverted, "starts", "feet", "faces")
    contact, across = inverted.first("contact"), -unit(faces.directions)
    left = faces.shown + across * (np.minimum(contact, 0) - FACE_BEYOND)
    right = faces.shown + across * (np.maximum(contact, 0) + FACE_BEYOND)
    captions = [_face(inverted, k) for k in range(feet.shown.size)]
    said = say(
        "On each ray lay off the displacement with the dividers, outward from the prime circle: its ordinate times "
        "μₛ/μₗ = {mu:.4g}/{mu_l:g} = {factor:.4f}. With two set squares draw the face there, square to the ray. {one} "
        "Repeat for the others."
    ).where(one=captions[_worked(inverted)], **_on_profile(inverted, "s", 0))
    marks = (
        *(feet.from_(starts, Role.CONSTRUCTION), feet.dots(Role.CONSTRUCTION)),
        Segments(left, right, Role.CONSTRUCTION).left_by(faces),
    )
    why = say("Because the face is r₀ + s from the cam centre, square to the motion.")
    parts = tuple(Part(caption, (feet[k], faces[k])) for k, caption in enumerate(captions))
    return Step(say("Faces"), said, PROFILE, marks, why=why, parts=parts)


def _face(inverted: profile_view.Inverted, k: int) -> Caption:
    values = _on_profile(inverted, "s", k)
    said = (
        say("Station {name}: the follower has not risen, so draw the face where ray {name} meets the prime circle.")
        if values["mm"] < NOTHING
        else say(
            "Station {name}: lay off {mm:.2f} mm × {factor:.4f} = {length:.2f} mm outward on ray {name}, and draw the "
            "face."
        )
    )
    return said.where(name=_name(inverted, k), **values)


def _contacts(inverted: profile_view.Inverted) -> Step:
    """Where the profile touches the faces, and how far that wanders."""
    (pitch,), mu_l = _drawn(inverted, "pitch"), inverted.givens.mu_l.per_mm
    rises = _side(sense(inverted.givens.rotation))
    captions = [_contact(inverted, k) for k in range(pitch.shown.size)]
    laid_off = say(
        "From the end of each ray lay off the velocity along the face with the dividers: its ordinate times "
        "μᵥ/μₗ = {mu:.4g}/{mu_l:g} = {factor:.4f}, on a rise {side}, seen from the cam centre, and on a return "
        "to the other side. {one} Repeat for the others, and number the contact points."
    ).where(side=rises, one=captions[_worked(inverted)], **_on_profile(inverted, "v", 0))
    widths = {side: float(inverted.value(f"face_{side}")) for side in ("left", "right")}
    widest = say(
        "Joined over φ by a smooth curve, as the velocities are, these lengths reach {left_mm:.2f} mm to the left and "
        "{right_mm:.2f} mm to the right: times {mu_l:g} the half-widths of the face, {left:.2f} mm and {right:.2f} mm."
    ).where(mu_l=mu_l, **widths, **{f"{side}_mm": width / mu_l for side, width in widths.items()})
    parts = (*(Part(caption, (pitch[k],)) for k, caption in enumerate(captions)), Part(widest, ()))
    why = say(
        "Because the cam's point ds/dφ beside the ray moves along the ray just as fast as the face: they touch there."
    )
    reads = ("face_left", "face_right", "contact", *profile_view.CURVE_READINGS)
    said = sequence([laid_off, widest], " ")
    return Step(say("Contact points"), said, PROFILE, (), reads, why=why, parts=parts)


def _contact(inverted: profile_view.Inverted, k: int) -> Caption:
    values, v = _on_profile(inverted, "v", k), float(inverted.givens.integrated.first("v")[k])
    said = (
        say("Station {name}: the follower does not move, so the contact point is the end of ray {name}.")
        if values["mm"] < NOTHING
        else say(
            "Station {name}: {mm:.2f} mm × {factor:.4f} = {length:.2f} mm {side} along the face: the contact point."
        )
    )
    side = _side(v * sense(inverted.givens.rotation))
    return said.where(name=_name(inverted, k), side=side, **values)


def _side(aside: float) -> Caption:
    return say("to the right") if aside > 0 else say("to the left")
