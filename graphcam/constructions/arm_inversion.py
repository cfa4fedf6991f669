"""The profile of an oscillating follower by inversion: the pivot goes round the cam, against the cam's rotation."""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, circles_meet, unit
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Role
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.follower import Rotation


@dataclass(frozen=True, eq=False)
class ArmInversionGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`arm_inversion`."""

    arm: float
    distance: float


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned round it, against its rotation. From each place of the pivot "
        "the arm is turned by its displacement: the places that its end takes make the cam."
    ),
    profile_view.CURVE,
    scales={"profile": "x"},
)


def arm_inversion(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    arm: float,
    distance: float,
    mu_l: Scale,
    pencil: Pencil,
) -> Construction[ArmInversionGivens]:
    """Step the pivot off on its circle, swing the arm to the prime circle, and turn it by the displacement.

    integrated : of an angle s [rad];  mu_l : drawing scale of the profile [mm/mm]
    """
    hand, s = Hand(pencil, MEANING), integrated.readings["s"]
    prime = profile_view.prime_circle(hand, prime_radius, mu_l)
    circle = hand.circle("pivot circle", hand.given("cam centre"), distance / mu_l.per_mm)
    pivots = hand.cross("pivots", profile_view.inverted_positions(hand, integrated, rotation, RIGHT), circle)
    arcs = hand.circle("arcs of the arm", pivots, arm / mu_l.per_mm)
    # To the left of the way from the cam centre to the pivot: above the line of centres.
    # Where a triangle has these sides, circles that miss one another by a hand's errors are taken to touch.
    closes = bool(np.isfinite(circles_meet(np.asarray(0j), prime_radius, np.asarray(distance + 0j), arm)))
    starts = hand.cross("starts", prime, arcs, flat=closes)
    swung = hand.protractor("swung", pivots, hand.join("arms at rest", pivots, starts), hand.carry(s, -s.scale))
    pitch = hand.cross("pitch", swung, arcs)
    motion = hand.perpendicular("motion", hand.join("arms", pivots, pitch).turned(-1), pitch)
    profile_view.curve_readings(hand, pitch, mu_l)
    givens = ArmInversionGivens(integrated, rotation, prime_radius, mu_l, arm, distance)
    places = {"pivots": pivots, "starts": starts, "pitch": pitch, "motion": unit(motion.directions)}
    return hand.finished(givens, _draw, places)


def _draw(inverted: Construction[ArmInversionGivens]) -> list[Step]:
    integrated, mu_l = inverted.givens.integrated, inverted.givens.mu_l
    c, r0 = inverted.givens.distance, inverted.givens.prime_radius
    pivots, start = inverted.acts["pivots"], profile_view.start_of_turn(inverted)
    circle = (inverted.acts["pivot circle"].drawn_circle(Role.CONSTRUCTION),)
    drawn = say(
        "About the cam centre the prime circle r₀ = {r0:g} mm and the circle of the pivot, c = {c:g} mm, are drawn at "
        "{ratio}: {r0_paper:.1f} mm and {c_paper:.1f} mm."
    ).where(r0=r0, c=c, ratio=ratio_text(mu_l.per_mm), r0_paper=r0 / mu_l.per_mm, c_paper=c / mu_l.per_mm)
    stepped = say(
        "The pivot is stepped off on its circle as the axis of the cam angle is divided, numbered against the rotation "
        "({rotation}); the phases take {angles}."
    ).where(**profile_view.divided_by(inverted))
    swung = say(
        "From every pivot the arc of the arm's length, {arm:.1f} mm, meets the prime circle; from there the arm is "
        "turned by the displacement, at most {most:.2f}°. Its ends are points of the pitch curve."
    ).where(arm=inverted.givens.arm / mu_l.per_mm, most=np.degrees(integrated.value("s").max()))
    first = pivots.first[0]
    positions = (pivots.dots(Role.CONSTRUCTION), *profile_view.phase_angles(inverted, start))
    arms = (inverted.acts["arms"].ways(Role.CONSTRUCTION), first.label("C", first.place))
    return [
        profile_view.prime_step(inverted, say("Prime circle and pivot circle"), drawn, start, circle),
        Step(say("Inverted positions of the pivot"), stepped, PROFILE, positions),
        *profile_view.pitch_steps(
            inverted, Step(say("Arms turned by the displacement"), swung, PROFILE, arms, profile_view.CURVE_READINGS)
        ),
    ]
