"""The profile by inversion: the cam stands still and the frame turns about it, against the cam's rotation."""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.follower import Rotation


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
    scales={"profile": "x"},
)


def inversion(
    integrated: Integrated, rotation: Rotation, prime_radius: float, offset: float, mu_l: Scale, pencil: Pencil
) -> OffsetInverted:
    """Lay the displacements off along the follower's line in its inverted positions: the pitch curve.

    mu_l : drawing scale of the profile [mm/mm]
    """
    hand, s = Hand(pencil, MEANING), integrated.readings["s"]
    prime = profile_view.prime_circle(hand, prime_radius, mu_l)
    if offset:
        hand.circle("offset circle", hand.given("cam centre"), abs(offset) / mu_l.per_mm)
        rays = profile_view.inverted_positions(hand, integrated, rotation, RIGHT * np.sign(offset))
        feet = hand.lay_off("feet", rays, rays, abs(offset) / mu_l.per_mm)
        lines = hand.perpendicular("tangents", rays.turned(np.sign(offset)), feet)
    else:
        # A central follower has no circle e: its lines are rays through the cam centre.
        lines = profile_view.inverted_positions(hand, integrated, rotation, UP)
        feet = hand.take("feet", lines)
    motion = hand.take("motion", lines)
    met, touch = hand.cross("circle and lines", motion, prime), hand.project("touch", prime, motion)
    # A line that misses the circle, by the hand's errors, is taken to touch it.
    at = np.arange(integrated.givens.stations.u.size)
    starts = hand.take("starts", met, touch, which=np.where(np.isnan(met.points), at.size + at, at))
    pitch = hand.lay_off("pitch", starts, motion, hand.carry(s, s.scale / mu_l.per_mm))
    profile_view.curve_readings(hand, pitch, mu_l)
    givens = InversionGivens(integrated, rotation, prime_radius, mu_l, offset)
    places = {"feet": feet, "starts": starts, "pitch": pitch, "motion": motion.directions}
    return hand.finished(givens, _draw, places)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(inverted: OffsetInverted) -> list[Step]:
    mu_l, e, r0 = inverted.givens.mu_l, inverted.givens.offset, inverted.givens.prime_radius
    starts, pitch = inverted.acts["starts"], inverted.acts["pitch"]
    start = profile_view.start_of_turn(inverted)
    circle, arrow = (), ()
    if e:
        offset_circle = inverted.acts["offset circle"]
        circle = (offset_circle.drawn_circle(Role.CONSTRUCTION),)
        arrow = profile_view.radius_arrow(inverted, offset_circle, start * UP, "e", abs(e))
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
    ).where(longest=float(np.abs(pitch.shown - starts.shown).max()))
    motion = inverted.acts["motion"]
    drawn = Segments(motion.shown, pitch.shown, Role.CONSTRUCTION, of=motion.act)
    lines = (drawn, *profile_view.phase_angles(inverted, start))
    laid_off = Step(say("Displacements laid off"), ends, PROFILE, (), reads=profile_view.CURVE_READINGS)
    return [
        profile_view.prime_step(inverted, say("Prime circle and offset circle"), circles, start, circle, arrow),
        Step(say("Inverted positions of the follower's line"), tangents, PROFILE, lines),
        *profile_view.pitch_steps(inverted, laid_off),
    ]
