"""The scheme of the mechanism: cam, follower and frame at the start of the turn, small, for the eye alone."""

from dataclasses import dataclass, replace

import numpy as np

from graphcam.constructions.board import DrawnFollower
from graphcam.constructions.profile_view import closed_curve, rotation_arrow
from graphcam.constructions.roller import Profile
from graphcam.constructions.views import SCHEME, at_scale
from graphcam.drafting.hand import showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Label, Role
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.follower import sense

SIZE = 60.0
"""The cam is drawn at the largest standard scale at which it is not wider [mm]."""


@dataclass(frozen=True, eq=False)
class SchemeGivens:
    """The profile, and the follower on it."""

    profile: Profile
    follower: DrawnFollower


MEANING = Meaning("scheme", say("Scheme of the mechanism"), say("The mechanism at the start of the turn."))


def scheme(profile: Profile, follower: DrawnFollower) -> Construction[SchemeGivens]:
    """Cam, follower and frame at the start of the turn."""
    return Construction(MEANING, SchemeGivens(profile, follower), profile.pencil, {}, {}, _draw)


def _draw(drawn: Construction[SchemeGivens]) -> list[Step]:
    profile = drawn.givens.profile
    inverted, roller = profile.givens.inverted, profile.givens.roller_radius
    mu_l, sigma = inverted.givens.mu_l, sense(inverted.givens.rotation)
    hand, curve = showing(drawn), closed_curve("outline", inverted, profile.acts["touch"])
    scale = standard_scale(2 * float(np.abs(curve.points).max()) * mu_l.per_mm, SIZE)
    centre, scheme = hand.given("A"), at_scale(SCHEME, scale)
    outline = hand.enlarged("outline", curve, centre, mu_l.per_mm / scale.per_mm)
    radius = 0.5 * inverted.givens.prime_radius / scale.per_mm
    circle = hand.circle("circle of the rotation", centre, radius)
    ground = hand.given("ground", np.arange(-3, 3.1, 1.5) - 5j, -1.2 - 1.5j)
    marks = (
        outline.line(Role.RESULT, closed=True),
        *drawn.givens.follower.scheme(inverted, roller, scale),
        hand.circle("shaft", centre, 1.2).drawn_circle(Role.CURVE),
        hand.given("support", np.array([-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j])).line(Role.CURVE),
        ground.ways(Role.HATCH),
        replace(rotation_arrow(np.pi / 2 - sigma * 1.9, sigma, radius), of=circle.act),
        Label(radius * complex(-sigma, 1), "ω", towards=complex(-sigma), of=circle.act),
        centre.label("A", 1 - 1j),
    )
    said = say("Cam, follower and frame at the start of the turn, at {ratio}.", ratio=ratio_text(scale.per_mm))
    return [Step(say("Scheme of the mechanism"), said, scheme, marks)]
