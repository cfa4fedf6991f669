"""The profile under a flat face by inversion: the envelope of the face's positions.

On the ray of every inverted position r0 + s is laid off and the perpendicular, the face, is drawn.  The profile touches
it ds/dphi to the side of the ray: to the right of a cam that turns counter-clockwise while the follower rises.
"""

from __future__ import annotations

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.curve import highest_and_lowest
from graphcam.drafting.euclid import UP, turned
from graphcam.drafting.ink import Construction, Step, say
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
)


def flat_inversion(
    integrated: Integrated, rotation: Rotation, prime_radius: float, mu_l: Scale, pencil: Pencil
) -> profile_view.Inverted:
    """Lay off r0 + s on the rays, draw the faces, and mark where the profile touches them.

    integrated : from :func:`~graphcam.constructions.integration.integration`
    mu_l : drawing scale of the profile [mm/mm]

    Readings: ``x``, ``y``, ``radius`` and ``polar_angle`` of the profile at the stations; the ``contact`` to the right
    of the ray, and the face's least half-widths ``face_left`` and ``face_right`` [mm].
    """
    hand, sigma = pencil.hand("inversion"), sense(rotation)
    s, v, stations = integrated.readings["s"], integrated.readings["v"], integrated.givens.stations
    count = stations.u.size
    position = profile_view.inverted_positions(integrated, rotation, hand)
    along, across = turned(UP, position), turned(1 + 0j, position)
    feet = along * (prime_radius / mu_l.per_mm + s.value / mu_l.per_mm + hand.dividers(count))
    contact = sigma * v.value / mu_l.per_mm + hand.dividers(count)
    touch = feet + across * contact + hand.point(count)
    # The velocity over the cam angle, faired as any other curve, says how far the contact wanders.
    wander = integrated.points["v_curve"].real + UP * contact
    ends = highest_and_lowest(wander, stations.pieces).imag
    faces = {"face_left": -ends[..., 1], "face_right": ends[..., 0]}
    return Construction(
        MEANING,
        profile_view.InvertedGivens(integrated, rotation, prime_radius, mu_l),
        pencil,
        profile_view.curve_readings(touch, mu_l, hand) | hand.readings(mu_l.per_mm, "mm", contact=contact, **faces),
        {"feet": feet, "pitch": touch, "motion": along},
        _draw,
    )


def _draw(inverted: profile_view.Inverted) -> list[Step]:
    feet, along = inverted.first("feet"), inverted.first("motion")
    r0, contact = inverted.givens.prime_radius, inverted.first("contact")
    across, start = along / UP, complex(UP * r0 / inverted.givens.mu_l.per_mm)
    rays = (Segments(np.zeros_like(feet), feet, Role.CONSTRUCTION), *profile_view.phase_angles(inverted, start))
    drawn = say(
        "About the cam centre the prime circle r₀ = {r0:g} mm is drawn, and the rays of the inverted positions, "
        "numbered against the rotation ({rotation}); the phases take {angles}."
    ).where(r0=r0, **profile_view.divided_by(inverted))
    left = feet + across * (np.minimum(contact, 0) - FACE_BEYOND)
    right = feet + across * (np.maximum(contact, 0) + FACE_BEYOND)
    touched = say(
        "On every ray r₀ + s is laid off and the face drawn square to it. The profile touches the face ds/dφ to the "
        "side: at most {left:.2f} mm to the left and {right:.2f} mm to the right, the face's half-widths."
    ).where(left=float(inverted.value("face_left")), right=float(inverted.value("face_right")))
    faces = (Segments(left, right, Role.CONSTRUCTION),)
    reads = ("face_left", "face_right", "contact", *profile_view.CURVE_READINGS)
    return [
        profile_view.prime_step(inverted, say("Prime circle and rays"), drawn, start, further=rays),
        *profile_view.pitch_steps(
            inverted,
            Step(say("Faces and contacts"), touched, PROFILE, faces, reads),
            say("Profile"),
            say("A smooth curve through the points, with arcs about the centre in the dwells, is the profile."),
        ),
    ]
