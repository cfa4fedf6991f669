"""The profile by inversion: the cam stands still and the frame turns about it, against the cam's rotation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP, along_to_circle, stepped_off, turned
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Circle, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.follower import Rotation, sense


@dataclass(frozen=True, eq=False)
class InversionGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`inversion`."""

    offset: float


OffsetInverted = Construction[InversionGivens]


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned round it, against its rotation. In each position the follower "
        "is moved by its displacement: the places that it takes make the cam."
    ),
    profile_view.CURVE,
    "report.translating_paragraphs.inversion",
)


def inversion(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    offset: float,
    mu_l: Scale,
    pencil: Pencil,
) -> OffsetInverted:
    """Lay the displacements off along the follower's line in its inverted positions: the pitch curve.

    integrated : from :func:`~graphcam.constructions.integration.integration`
    mu_l : drawing scale of the profile [mm/mm]

    Readings: ``x``, ``y``, ``radius`` and ``polar_angle`` of the pitch curve at the stations.
    """
    hand = pencil.hand("inversion")
    s, count = integrated.readings["s"], integrated.givens.stations.u.size
    position = profile_view.inverted_positions(integrated, rotation, hand)
    feet = stepped_off(offset / mu_l.per_mm, 0j, position)  # on the circle e
    along = turned(UP, position)  # its tangents
    starts = along_to_circle(feet, along, 0j, prime_radius / mu_l.per_mm)
    laid_off = s.value / mu_l.per_mm + hand.dividers(count)
    pitch = starts + along * laid_off + hand.point(count)
    givens = InversionGivens(integrated, rotation, prime_radius, mu_l, offset)
    points = {"feet": feet, "starts": starts, "pitch": pitch, "motion": along}
    readings = profile_view.curve_readings(pitch, mu_l, hand)
    return Construction(MEANING, givens, pencil, readings, points, _draw)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(inverted: OffsetInverted) -> list[Step]:
    mu_l, phi = inverted.givens.mu_l, inverted.givens.integrated.givens.stations.phi
    sigma, e, r0 = sense(inverted.givens.rotation), inverted.givens.offset, inverted.givens.prime_radius
    feet, starts, pitch = (inverted.first(name) for name in ("feet", "starts", "pitch"))
    start = complex(turned(starts[0], sigma * phi[0]))  # on the prime circle, where the turn begins
    # A central follower has no circle e: its lines are rays through the cam centre.
    circle = (Circle(0j, abs(e) / mu_l.per_mm, Role.CONSTRUCTION),) if e else ()
    arrow = profile_view.radius_arrow(inverted, start * UP, "e", abs(e)) if e else ()
    circles = say(
        "About the cam centre the prime circle r₀ = {r0:g} mm and the circle of the offset e = {e:g} mm are drawn at "
        "{ratio}: {r0_paper:.1f} mm and {e_paper:.1f} mm. The follower's line touches the circle e."
    ).where(r0=r0, e=e, ratio=ratio_text(mu_l.per_mm), r0_paper=r0 / mu_l.per_mm, e_paper=abs(e) / mu_l.per_mm)
    tangents = say(
        "The circle e is divided as the axis of the cam angle is, numbered against the rotation ({rotation}), and the "
        "tangents are drawn; the phases take {angles}."
    ).where(**profile_view.divided_by(inverted))
    ends = say(
        "On every tangent the displacement is laid off from the prime circle, in the scale of the profile; the "
        "greatest is {longest:.1f} mm. The ends are points of the pitch curve."
    ).where(longest=float(np.abs(pitch - starts).max()))
    lines = (Segments(feet, pitch, Role.CONSTRUCTION), *profile_view.phase_angles(inverted, start))
    laid_off = Step(say("Displacements laid off"), ends, PROFILE, (), reads=profile_view.CURVE_READINGS)
    return [
        profile_view.prime_step(inverted, say("Prime circle and offset circle"), circles, start, circle, arrow),
        Step(say("Inverted positions of the follower's line"), tangents, PROFILE, lines),
        *profile_view.pitch_steps(inverted, laid_off),
    ]
