"""What the exact side warns of: a profile that cannot be cut, limits that are not kept."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.drafting.scale import Scale, ratio_from_text, ratio_text
from graphcam.errors import DesignError
from graphcam.given.impact import velocity_jumps
from graphcam.given.motion import Motion
from graphcam.mechanism.cam import Cam, largest_roller
from graphcam.mechanism.turn_extremes import PlaceQuantity
from graphcam.mechanism.undercut import Undercut
from graphcam.mechanism.within_rows import rows_tell
from graphcam.tasks.task import Task
from graphcam.words import Caption, and_list, say, sequence

SAME_ANGLE = 1e-6
"""Cam angles that differ by less [rad] are one."""
PRINT_ROUNDING = 0.005
"""mm or degrees: what differs by less does not differ in print."""
ENLARGE_REMEDY = say("Enlarge the prime radius.")
MAX_METRES_LIFT = 0.2
"""A lift below so many mm looks like metres."""
MAX_RADIANS_LIFT = 1.0
"""A lift below so many degrees looks like radians."""
MAX_STIFFNESS, MAX_MASS = 500.0, 50.0
"""A stiffness of more N/mm looks like N/m, a mass of more kg like grams."""


@dataclass(frozen=True)
class Caution:
    """A sentence on what is wrong, and where it is seen.

    of : what is not as it should be
    phi : the cam angles [rad] there
    alpha : the pressure angle there [rad], of one that exceeds its limit
    """

    said: Caption
    of: Literal[
        "profile", "pressure angle", "prime radius", "roller radius", "face", "contact", "contact stress", "rounding",
        "unit", "scale", "divisions", "velocity", "drawing",
    ]  # fmt: skip
    phi: tuple[float, ...] = ()
    alpha: float | None = None


def warnings_of(cam: Cam, board: Board, least_prime_radius: float) -> list[Caution]:
    """What is to be warned of, the gravest first; nothing for a sound cam.

    cam : as it was adopted;  board : what was given;  least_prime_radius : the exact one of the task [mm]
    """
    return [
        *_jumps(cam),
        *_undercut(cam),
        *_limits(cam, board),
        *_too_sharp(cam, board),
        *_prime_radius(cam, board, least_prime_radius),
    ]


def _jumps(cam: Cam) -> Iterator[Caution]:
    """The sentences on a velocity that jumps, and on what the follower does where the cam has a corner by it."""
    if not (jumps := velocity_jumps(cam.motion)):
        return
    said = say(
        "At {places} the velocity jumps: there the acceleration and the force are infinite, and the law cannot be "
        "integrated from the acceleration, so v and s are drawn as the law gives them. Such a cam is only fit for slow "
        "turning; blends of the law make it fit for speed."
    )
    yield Caution(said.with_values(places=and_list([_degrees(jump.phi) for jump in jumps])), "velocity")
    falls = and_list([_degrees(jump.phi) for jump in jumps if jump.size < 0])
    if cam.kinematics.takes_roller and not cam.roller_radius and any(jump.size < 0 for jump in jumps):
        edge = say("The profile has an edge at {places}, which wears the more since a knife edge runs over it.")
        yield Caution(edge.with_values(places=falls), "velocity")


def _rounded_corner(cam: Cam, lost: Undercut) -> Caption | None:
    """The sentence on a roller that rolls over the edge of the profile at a jump of the velocity; None elsewhere."""
    at = [
        jump.phi for jump in velocity_jumps(cam.motion) if any(abs(jump.phi - phi) < SAME_ANGLE for phi in lost.cusps)
    ]
    if not at or not cam.roller_radius:
        return None
    corner, (start, end, x, y) = cam.pitch_curve(at[0]), lost.crossing
    off = math.dist(corner, (x, y)) - cam.roller_radius
    said = say(
        "At {phi} the pitch curve has a corner that no roller can follow: from {start} to {end} the roller rolls over "
        "the edge of the profile and rounds the corner, by {off:.2f} mm."
    )
    return said.with_values(phi=_degrees(at[0]), start=_degrees(start), end=_degrees(end), off=off)


def beside_rows(motion: Motion, said: Caption, quantity: PlaceQuantity) -> Caption:
    """What is said, as a fact only if the quantity is negative for every motion that the rows of a table permit."""
    if rows_tell(motion, quantity):
        return said
    return say("As the table is smoothed, though its rows do not tell it within their tolerance: {said}", said=said)


def profile_speed(cam: Cam) -> PlaceQuantity:
    """The speed along the profile at places, which is negative where an undercut makes it run backwards."""
    return lambda places: cam.kinematics.speed(places.values, cam.roller_radius)


def _undercut(cam: Cam) -> Iterator[Caution]:
    try:
        lost = cam.undercuts()
    except DesignError:
        remedy = ENLARGE_REMEDY
        if cam.kinematics.takes_roller:
            remedy = say("Take a roller well below {radius} mm.", radius=_rounded_down(largest_roller(cam)))
        said = say("The profile cannot be cut: its undercut consists of loops that cannot be told apart. {remedy}")
        yield Caution(beside_rows(cam.motion, said.with_values(remedy=remedy), profile_speed(cam)), "profile")
        return
    rounded = {k: said for k, part in enumerate(lost) if (said := _rounded_corner(cam, part))}
    yield from (Caution(said, "profile", lost[k].crossing[:1]) for k, said in rounded.items())
    if not (lost := [part for k, part in enumerate(lost) if k not in rounded]):
        return
    too_large = (
        say("with a roller of {radius:g} mm", radius=cam.roller_radius)
        if cam.kinematics.takes_roller
        else say("by the flat face on a prime radius of {radius:g} mm", radius=cam.prime_radius)
    )
    said = say("The profile cannot be cut {cause}: it is undercut {where}. {remedy}")
    where = sequence([_undercut_place(part) for part in lost], "; ")
    corners = tuple(part.crossing[0] for part in lost)
    said = said.with_values(cause=too_large, where=where, remedy=_remedy(cam, lost))
    if all(part.cusps for part in lost):
        said = beside_rows(cam.motion, said, profile_speed(cam))
    yield Caution(said, "profile", corners)


def _undercut_place(part: Undercut) -> Caption:
    if part.is_cusp:
        return say("to an edge at {phi}", phi=_degrees(part.cusps[0]))
    lost = {name: _degrees(phi) for name, phi in zip(("start", "end"), part.crossing, strict=False)}
    if not part.cusps:
        return say("where its flanks meet, and is lost from {start} to {end}", **lost)
    return say(
        "between the cusps at {first} and {last}, and is lost from {start} to {end}",
        first=_degrees(part.cusps[0]),
        last=_degrees(part.cusps[-1]),
        **lost,
    )


def _remedy(cam: Cam, lost: list[Undercut]) -> Caption:
    if not cam.kinematics.takes_roller:
        return ENLARGE_REMEDY
    if any(part.cusps for part in lost):
        return say("Every roller smaller than {radius} mm avoids the cusps.", radius=_rounded_down(largest_roller(cam)))
    return say("Take a smaller roller or a larger prime radius.")


EXCEEDED_WARNINGS = {
    "rise": say("The pressure angle reaches {alpha:.2f}° on the rise, at {phi}; {limit:g}° are permitted."),
    "return": say("The pressure angle reaches {alpha:.2f}° on the return, at {phi}; {limit:g}° are permitted."),
}


def _limits(cam: Cam, board: Board) -> Iterator[Caution]:
    for word, alpha, phi, limit in angles_exceeded(cam, board, PRINT_ROUNDING):
        values = {"alpha": abs(math.degrees(alpha)), "phi": _degrees(phi), "limit": math.degrees(limit)}
        yield Caution(replace(EXCEEDED_WARNINGS[word], values=values), "pressure angle", (phi,), alpha)


def _too_sharp(cam: Cam, board: Board) -> Iterator[Caution]:
    rho, phi = cam.extremes().min_convex_radius
    least = board.min_profile_radius
    if least is not None and rho - cam.roller_radius < least - PRINT_ROUNDING:
        said = say("The radius of curvature of the profile falls to {rho:.2f} mm at {phi}; {least:g} mm are required.")
        yield Caution(said.with_values(rho=rho - cam.roller_radius, phi=_degrees(phi), least=least), "profile", (phi,))


def angles_exceeded(cam: Cam, board: Board, slack: float) -> Iterator[tuple[str, float, float, float]]:
    """The phases whose pressure angle exceeds its limit by more than ``slack`` [degrees]: their kind, then radians.

    returns : "rise" or "return", the pressure angle, the cam angle there, and the limit
    """
    extremes, limits = cam.extremes(), board.limits
    if "curvature" in board.follower.conditions:  # which takes the place of the pressure angle
        return
    for word, (alpha, phi), limit, driven in (
        ("rise", extremes.pressure_angle_rise, limits.rise, 1),
        ("return", extremes.pressure_angle_return, limits.return_, -1),
    ):
        at_rest = driven * alpha < 0 and not limits.rest  # the angle at the low rest, which is not limited
        if limit is not None and not at_rest and math.degrees(abs(alpha) - limit) > slack:
            yield word, alpha, phi, limit


def _prime_radius(cam: Cam, board: Board, least: float) -> Iterator[Caution]:
    given = board.prime_radius
    if given is not None and given < least - PRINT_ROUNDING:
        said = say("The given prime radius of {given:g} mm is smaller than the minimum permitted one, {least:.2f} mm.")
        said = said.with_values(given=given, least=least)
        if "curvature" in board.follower.conditions:
            permitted, speed = board.follower.conditions["curvature"] or 0.0, profile_speed(cam)
            said = beside_rows(cam.motion, said, lambda places: speed(places) - permitted)
        yield Caution(said, "prime radius")


def unit_slips(task: Task) -> Iterator[Caution]:
    """The sentences on values that look as if they were given in another unit, though they make a cam."""
    swings = task.follower.swings and task.follower.column == "s_deg"
    lift = task.motion().lift / task.follower.lift_unit
    if swings and lift < MAX_RADIANS_LIFT:
        said = say("The lift of {lift:g}° looks like radians: if so, give {meant:.3g}, in degrees.")
        yield Caution(said.with_values(lift=lift, meant=math.degrees(lift)), "unit")
    elif not swings and lift < MAX_METRES_LIFT:
        said = say("The lift of {lift:g} mm looks like metres: if so, give {meant:g}, in mm.")
        yield Caution(said.with_values(lift=lift, meant=1000 * lift), "unit")
    for value, most, name, other, factor, unit in (
        (getattr(task.spring, "stiffness", 0.0), MAX_STIFFNESS, "stiffness", "N/m", 1e-3, "N/mm"),
        (getattr(task.spring, "mass", 0.0), MAX_MASS, "mass", "g", 1e-3, "kg"),
    ):
        if value > most and not task.follower.swings:
            said = say("spring.{name} = {value:g} {unit} looks like {other}: if so, give {meant:g}, in {unit}.")
            values = {"name": name, "value": value, "unit": unit, "other": other, "meant": factor * value}
            yield Caution(said.with_values(**values), "unit")
    if slip := task.limits().slip():
        said = say(
            "The permitted pressure angle of {angle:g}° looks like radians: if so, give {meant:.3g}, in degrees."
        )
        yield Caution(said.with_values(angle=slip[1], meant=math.degrees(slip[1])), "unit")


def closed_turn(task: Task) -> Iterator[Caution]:
    """The sentence on a turn that the phase angles of the file miss by their rounding."""
    if closing := task.motion.closed:
        k, missing = closing
        said = say("The phase angles sum to {turn:.10g}°: φ{number} takes up the missing {missing:.2g}°.")
        if missing < 0:
            said = say("The phase angles sum to {turn:.10g}°: φ{number} is shortened by {missing:.2g}°.")
        values = {"turn": 360 - missing, "number": k + 1, "missing": abs(missing)}
        yield Caution(said.with_values(**values), "rounding")


def title_scale(task: Task, drawn: Scale) -> Iterator[Caution]:
    """The sentence on a scale in the title block at which the cam's profile is not drawn."""
    said = ratio_from_text(task.title.scale or "")
    if said is not None and not math.isclose(said, drawn.per_mm):
        text = say(
            "The title block says {said}, but the profile is drawn at {drawn}: title.scale only fills the title block; "
            "drawing.profile_scale draws the profile larger or smaller."
        )
        yield Caution(text.with_values(said=ratio_text(said), drawn=ratio_text(drawn.per_mm)), "scale")


def less_round(chain: Chain) -> list[Caution]:
    """The sentence on sizes that are no multiples of the rounding, because none of them goes with another."""
    if chain.rounded:
        return []
    said = say(
        "No combination of multiples of {rounding:g} mm stays within the permitted pressure angles: the prime "
        "radius {radius:g} mm with the centre distance {distance:g} mm is adopted.",
        rounding=chain.rounding,
        radius=chain.prime_radius,
        distance=chain.place,
    )
    return [Caution(said, "rounding")]


def _degrees(phi: float) -> Caption:
    return say("{phi:.2f}°", phi=math.degrees(phi))


def _rounded_down(length: float) -> Caption:
    return say("{length:.3f}", length=math.floor(length * 1000) / 1000)
