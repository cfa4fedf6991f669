"""The profile under a flat face by inversion: the envelope of the face's positions.

On the ray of every inverted position r0 + s is laid off and the perpendicular, the face, is drawn.  The profile touches
it ds/dphi to the side of the ray: to the right of a cam that turns counter-clockwise while the follower rises.
"""

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import Hand, between, reckoned
from graphcam.drafting.ink import Step, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Rotation, sense

FACE_BEYOND = 6.0
"""How far a face is drawn beyond the place where it is touched, and to the other side of its ray [mm]."""


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned round it, against its rotation. In each position the face is "
        "moved by its displacement and touches the cam beside its ray, where the velocity as a length puts it."
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


def _draw(inverted: profile_view.Inverted) -> list[Step]:
    rays, feet, faces = (inverted.acts[name] for name in ("inverted positions", "feet", "faces"))
    r0, contact = inverted.givens.prime_radius, inverted.first("contact")
    start = complex(UP * r0 / inverted.givens.mu_l.per_mm)
    lines = Segments(rays.shown, feet.shown, Role.CONSTRUCTION, of=rays.act)
    further = (lines, *profile_view.phase_angles(inverted, start))
    drawn = say(
        "About the cam centre the prime circle r₀ = {r0:g} mm is drawn, and the rays of the inverted positions, "
        "numbered against the rotation ({rotation}); the phases take {angles}."
    ).where(r0=r0, **profile_view.divided_by(inverted))
    across = -unit(faces.first.directions)
    left = faces.shown + across * (np.minimum(contact, 0) - FACE_BEYOND)
    right = faces.shown + across * (np.maximum(contact, 0) + FACE_BEYOND)
    touched = say(
        "On every ray r₀ + s is laid off and the face drawn square to it. The profile touches the face ds/dφ to the "
        "side: at most {left:.2f} mm to the left and {right:.2f} mm to the right, the face's half-widths."
    ).where(left=float(inverted.value("face_left")), right=float(inverted.value("face_right")))
    lines = (Segments(left, right, Role.CONSTRUCTION, of=faces.act),)
    reads = ("face_left", "face_right", "contact", *profile_view.CURVE_READINGS)
    return [
        profile_view.prime_step(inverted, say("Prime circle and rays"), drawn, start, further=further),
        *profile_view.pitch_steps(
            inverted,
            Step(say("Faces and contacts"), touched, PROFILE, lines, reads),
            say("Profile"),
            say("A smooth curve through the points, with arcs about the centre in the dwells, is the profile."),
        ),
    ]
