"""Mistakes about the cam centre: the follower's place, the sense of rotation, circles, permitted angles, the roller."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.working_profile import working_profile
from graphcam.drafting.ink import say
from graphcam.errors import DesignError
from graphcam.exercises.definition.catalogue import catalogued
from graphcam.exercises.definition.drawn_answers import construction_of, redrawn, rescaled, with_reading
from graphcam.given.follower import Limits, Rotation, sense


@catalogued(say("You seem to have laid off the offset on the other side of the cam centre."))
def offset_sign(chain: Chain) -> Chain:
    """The follower's line on the other side of the cam centre."""
    return redrawn(chain, replace(chain.board, follower=DrawnTranslating(-_given_offset(chain))))


@catalogued(
    say("You seem to have drawn the follower's line through the cam centre: it lies beside it, as far as the offset.")
)
def offset_forgotten(chain: Chain) -> Chain:
    """The follower's line through the cam centre."""
    _given_offset(chain)
    return redrawn(chain, replace(chain.board, follower=DrawnTranslating(0.0)))


@catalogued(
    say(
        "You seem to have subtracted the offset from the prime radius: s₀ is a leg of the right triangle whose "
        "hypotenuse is the prime radius and whose other leg is the offset."
    )
)
def offset_subtracted(chain: Chain) -> Chain:
    """The difference of prime radius and offset taken for s0."""
    offset = _given_offset(chain)
    return _about_circle(chain, math.hypot(chain.prime_radius - abs(offset), offset))


def _given_offset(chain: Chain) -> float:
    """The offset that the task gives."""
    follower = chain.board.follower
    if follower.place is None or follower.place_name != "offset":
        raise DesignError("offset", say("not given"), say("given where it is to be mistaken"))
    return follower.place


@catalogued(
    say("You seem to have turned the cam in the other sense: v is turned by 90° in the sense of the cam's rotation.")
)
def rotation_sense(chain: Chain) -> Chain:
    """The cam turned in the other sense."""
    return redrawn(chain, replace(chain.board, rotation=_opposite_sense(chain.board.rotation)))


@catalogued(
    say("You seem to have numbered the positions with the rotation: in the inversion the frame turns against it.")
)
def numbering_sense(chain: Chain) -> Chain:
    """The positions of the follower numbered with the rotation."""
    return _inverted(chain, chain.prime_radius, _opposite_sense(chain.board.rotation))


@catalogued(
    say(
        "You seem to have used the base circle as the prime circle: the prime circle passes through the "
        "roller's centre."
    )
)
def base_circle(chain: Chain) -> Chain:
    """The circle of the profile's least radius where the prime circle is asked."""
    return _about_circle(chain, chain.prime_radius - chain.roller_radius)


@catalogued(
    say(
        "You seem to have added the roller radius to the prime radius: the prime circle already passes through "
        "the roller's centre."
    )
)
def roller_added(chain: Chain) -> Chain:
    """The prime radius taken for that of the profile's least circle, and the roller's radius added."""
    return _about_circle(chain, chain.prime_radius + chain.roller_radius)


@catalogued(say("You seem to have taken the prime radius for a diameter."))
def prime_diameter(chain: Chain) -> Chain:
    """A prime circle of half the size."""
    return _about_circle(chain, chain.prime_radius / 2)


def _about_circle(chain: Chain, radius: float) -> Chain:
    """Pressure angle and inversion drawn about a circle of another radius [mm]."""
    if "analysis" in chain.names:
        return _analysed(chain, prime_radius=radius)
    # The scale of the profile stays what it is, so the task's own prime radius does not change.
    board = chain.board
    measured = board.follower.pressure_angle(chain.integration, board.rotation, radius, chain.place, chain.pencil)
    return _inverted(chain.continued_from(measured), radius, board.rotation)


@catalogued(say("You seem to have laid off the displacements from the offset circle: they start at the prime circle."))
def offset_circle(chain: Chain) -> Chain:
    """The displacements laid off from the points where the tangents touch the circle e."""
    # A hair more than the circle e itself, which a tangent meets in one point or, by rounding, in none.
    return _inverted(chain, abs(chain.place) * (1 + 1e-9), chain.board.rotation)


@catalogued(
    say(
        "You seem to have measured at the outline, as under a knife edge: what moves is the roller's centre, which "
        "runs on the pitch curve."
    )
)
def roller_forgotten(chain: Chain) -> Chain:
    """The outline of a given cam taken for the pitch curve, and its base circle for the prime circle."""
    givens = construction_of(chain, "analysis").givens
    return _analysed(chain, prime_radius=givens.prime_radius - givens.roller_radius, roller_radius=0.0)


@catalogued(
    say("You seem to have measured the displacements from the cam centre: they are counted from the prime circle.")
)
def from_the_centre(chain: Chain) -> Chain:
    """The distance of the roller's centre from the cam centre taken for the displacement."""
    drawn = construction_of(chain, "analysis")
    return chain.continued_from(with_reading(drawn, "s", np.abs(drawn.points["places"])))


@catalogued(
    say(
        "You seem to have measured the angle of the tangent: the pressure angle lies between the normal of the pitch "
        "curve and the line of motion."
    )
)
def angle_of_the_tangent(chain: Chain) -> Chain:
    """The complement of every pressure angle at the contact, on its own side."""
    drawn = construction_of(chain, "analysis")
    alpha = drawn.readings["alpha"].paper
    return chain.continued_from(with_reading(drawn, "alpha", np.copysign(math.pi / 2, alpha) - alpha))


@catalogued(say("You seem to have read the pressure angles with the wrong sign: on a rise they are mostly positive."))
def angle_sign(chain: Chain) -> Chain:
    """Every pressure angle at the contact on the other side."""
    drawn = construction_of(chain, "analysis")
    return chain.continued_from(with_reading(drawn, "alpha", -drawn.readings["alpha"].paper))


@catalogued(
    say(
        "You seem to have used cam angles as polar angles of the points: a point does not lie on the ray of "
        "its cam angle."
    )
)
def polar_angle(chain: Chain) -> Chain:
    """The points of the pitch curve, at their radii, on the rays of the cam angles from the first of them on."""
    inverted, stations = chain.inversion, chain.board.stations
    pitch = inverted.points["pitch"]
    rays = np.exp(-1j * sense(chain.board.rotation) * (stations.phi - stations.phi[0]))
    placed = np.abs(pitch) * (pitch / np.abs(pitch))[..., :1] * rays
    readings = {
        **inverted.readings,
        "x": replace(inverted.readings["x"], paper=placed.real),
        "y": replace(inverted.readings["y"], paper=placed.imag),
        "polar_angle": replace(inverted.readings["polar_angle"], paper=np.angle(placed)),
    }
    return chain.continued_from(replace(inverted, readings=readings, points={**inverted.points, "pitch": placed}))


@catalogued(
    say(
        "You seem to have laid off the angle of the tangent where v and s have different scales: redraw v in the "
        "scale of s, or correct the angle."
    )
)
def unequal_scales(chain: Chain) -> Chain:
    """The lengths of v from its own diagram laid off beside s, in the scale of v."""
    integrated, board = chain.integration, chain.board
    laid_off = rescaled(integrated, "v", np.asarray(integrated.readings["s"].scale))
    place = board.follower.place
    region = board.follower.least_radius(laid_off, board.rotation, board.limits, place, chain.pencil)
    return chain.continued_from(region)


@catalogued(say("You seem to have exchanged the permitted angles of rise and return."))
def limits_swapped(chain: Chain) -> Chain:
    """The rise at the return's permitted angle, the return at the rise's."""
    limits = chain.board.limits
    if limits.return_ is None:
        raise DesignError("limits", say("without one of the return"), say("two where they are to be swapped"))
    return redrawn(chain, replace(chain.board, limits=Limits(limits.return_, limits.rise, limits.rest)))


@catalogued(
    say("You seem to have laid off the permitted angle from the wrong axis: it is measured from the line of motion.")
)
def limit_from_the_horizontal(chain: Chain) -> Chain:
    """The permitted angles laid off from the axis across the motion."""
    limits = chain.board.limits
    back = None if limits.return_ is None else math.pi / 2 - limits.return_
    return redrawn(chain, replace(chain.board, limits=Limits(math.pi / 2 - limits.rise, back, limits.rest)))


@catalogued(say("You seem to have given the diameter instead of the radius of curvature."))
def diameter_for_radius(chain: Chain) -> Chain:
    """The radius of curvature doubled."""
    return chain.continued_from(with_reading(chain.curvature, "rho", 2 * chain.curvature.readings["rho"].paper))


@catalogued(
    say(
        "You seem to have drawn the profile on the far side of the roller: it lies between the roller's "
        "centre and the cam centre."
    )
)
def roller_outside(chain: Chain) -> Chain:
    """The outer envelope of the roller's circles."""
    profile, pitch = chain.working_profile, chain.inversion.points["pitch"]
    outer = np.abs(2 * pitch - profile.points["touch"])
    return chain.continued_from(with_reading(profile, "radius", outer))


@catalogued(say("You seem to have drawn the roller with its diameter as the radius."))
def roller_diameter(chain: Chain) -> Chain:
    """Circles of the roller's diameter about its centre, where its radius is given."""
    return chain.continued_from(working_profile(chain.inversion, 2 * chain.roller_radius, chain.pencil))


@catalogued(say("You seem to have taken the larger value of the rule: the smaller one is the limit."))
def rule_greater(chain: Chain) -> Chain:
    """The greatest of what the rule for the roller proposes."""
    greatest = chain.roller.readings["candidates"].paper.max(axis=-1)
    return chain.continued_from(with_reading(chain.roller, "roller_radius", greatest))


def _opposite_sense(rotation: Rotation) -> Rotation:
    return "cw" if rotation == "ccw" else "ccw"


def _inverted(chain: Chain, prime_radius: float, rotation: Rotation) -> Chain:
    """The inversion alone drawn otherwise, or of a given cam the analysis."""
    if "analysis" in chain.names:
        return _analysed(chain, prime_radius=prime_radius, rotation=rotation)
    follower = chain.board.follower
    inverted = follower.inversion(
        chain.integration, rotation, prime_radius, chain.place, chain.profile_scale, chain.pencil
    )
    return chain.continued_from(inverted)


def _analysed(chain: Chain, **changes: Any) -> Chain:
    """The analysis of a given cam alone drawn otherwise."""
    givens = replace(chain.analysis.givens, **changes)
    return chain.continued_from(chain.board.follower.analysis(givens, chain.pencil))
