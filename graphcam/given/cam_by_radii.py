"""Cams given by their radii: base circle, flanks and nose, of circular arcs or with straight flanks; eccentric cams.

The base circle of radius R1 is about the cam centre O, the nose of radius R3 about N, at the distance d = R1 + L - R3
from O for a lift L, and the flank of radius R2 about F.  Where arcs touch their centres and the point of contact lie on
one line, so F is R2 - R1 from O and R2 - R3 from N, and with the angle of ascent b between OA, where the flank leaves
the base circle, and ON

    (R2 - R3)^2 = (R2 - R1)^2 + d^2 + 2 (R2 - R1) d cos(b).

Each of the five sizes follows from the other four.  A hollow flank has a negative R2; of a straight one, the tangent
cam, what is left as R2 grows is d cos(b) = R1 - R3.

Source: the theory of machines of every school, on cams with specified contours (circular arc and tangent cams).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

from graphcam.errors import DesignError, check_number
from graphcam.given.motion import FULL_TURN
from graphcam.words import say

Straight = Literal["straight"]
STRAIGHT: Straight = "straight"
SIZE_NAMES = ("flank_radius", "nose_radius", "lift", "ascent")
"""The sizes of which three are given beside the base radius."""


class OutlineArc(NamedTuple):
    """A part of the outline, as it lies where the rise begins, with the start of the flank on the positive axis.

    centre : complex [mm], of an arc;  radius : mm, negative of a hollow one, inf of a straight part
    normal : of a straight part, away from the cam
    point, outward : where the part begins, and the unit normal there, away from the cam
    """

    centre: complex
    radius: float
    normal: complex
    point: complex
    outward: complex


@dataclass(frozen=True)
class ArcOutline:
    """A cam of base circle, flank and nose that is its own mirror image; made by :func:`cam_by_radii`.

    base_radius, nose_radius, lift : mm;  flank_radius : mm, inf where the flank is straight, negative of a hollow one
    ascent : rad, from the start of the flank to the apex
    dwell : rad, for which an arc about the cam centre holds the follower up
    """

    base_radius: float
    flank_radius: float
    nose_radius: float
    lift: float
    ascent: float
    dwell: float = 0.0

    @property
    def nose_distance(self) -> float:
        """The distance d of the centre of the nose from the cam centre [mm]."""
        return self.base_radius + self.lift - self.nose_radius

    @property
    def widest_nose(self) -> float:
        """The radius of the one circle that would have this base radius and lift: flanks are flatter, noses sharper."""
        return self.base_radius + self.lift / 2

    @property
    def is_eccentric(self) -> bool:
        """Whether it is one circle about another point than the cam centre."""
        return self.ascent == FULL_TURN / 2

    def arcs(self, _sigma: int = 1) -> Sequence[OutlineArc]:
        """Its parts in the order in which the rise meets them, of a cam that turns clockwise its mirror image's."""
        base, nose, d = self.base_radius, self.nose_radius, self.nose_distance
        if self.is_eccentric:
            return [OutlineArc(complex(-d), nose, 0j, complex(base), 1 + 0j)]
        apex, back = _turned(-self.ascent), _turned(-self.ascent - self.dwell)
        mirror, centre = apex * back, complex(base - self.flank_radius) if self.has_arcs else 0j
        leaving = self.leaving_normal
        outer = base + self.lift
        parts = [
            OutlineArc(centre, self.flank_radius, 1 + 0j, complex(base), 1 + 0j),
            OutlineArc(d * apex, nose, 0j, d * apex + nose * leaving, leaving),
        ]
        if self.dwell:
            parts += [OutlineArc(0j, outer, 0j, outer * apex, apex), OutlineArc(d * back, nose, 0j, outer * back, back)]
        point, outward = (mirror * each.conjugate() for each in (d * apex + nose * leaving, leaving))
        return [
            *parts,
            OutlineArc(mirror * centre.conjugate(), self.flank_radius, mirror, point, outward),
            OutlineArc(0j, base, 0j, base * mirror, mirror),
        ]

    @property
    def has_arcs(self) -> bool:
        """Whether the flanks are arcs, not straight."""
        return math.isfinite(self.flank_radius)

    @property
    def leaving_normal(self) -> complex:
        """The unit normal where the flank ends and the nose begins."""
        if not self.has_arcs:
            return 1 + 0j
        between = self.nose_distance * _turned(-self.ascent) + (self.flank_radius - self.base_radius)
        return between / (self.flank_radius - self.nose_radius)


def _turned(angle: float) -> complex:
    return complex(math.cos(angle), math.sin(angle))


def cam_by_radii(
    base_radius: float,
    flank_radius: float | Straight | None = None,
    nose_radius: float | None = None,
    lift: float | None = None,
    ascent: float | None = None,
    dwell: float = 0.0,
) -> ArcOutline:
    """A cam from its base radius and three of its other sizes, or an eccentric cam from its base radius and its lift.

    Parameters
    ----------
    base_radius, nose_radius, lift : mm
    flank_radius : mm, "straight" for a tangent cam, negative for a hollow flank
    ascent : rad, from the start of the flank to the apex of the nose
    dwell : rad, for which the follower is held up

    Raises
    ------
    DesignError : too few or too many sizes, or there is no such cam: then the message says which size would make one

    >>> cam = cam_by_radii(base_radius=28, flank_radius="straight", lift=15, ascent=math.radians(70))
    >>> round(cam.nose_radius, 4), round(cam.nose_distance, 4)
    (20.2029, 22.7971)
    >>> round(math.degrees(cam_by_radii(12, 36, nose_radius=1.2, lift=7).ascent), 4)
    68.1347
    >>> cam_by_radii(28, 30, nose_radius=5, lift=15)
    Traceback (most recent call last):
    graphcam.errors.DesignError: flank_radius is 30.0, but must be greater than 35.5 mm, or negative ...
    """
    given = dict(zip(SIZE_NAMES, (flank_radius, nose_radius, lift, ascent), strict=True))
    for name, value in {"base_radius": base_radius, **given, "dwell": dwell}.items():
        if value is not None and value != STRAIGHT:
            _check_size(name, value)
    missing = [name for name in SIZE_NAMES if given[name] is None]
    if missing == ["flank_radius", "nose_radius", "ascent"] and lift is not None and not dwell:
        return ArcOutline(base_radius, math.nan, base_radius + lift / 2, lift, FULL_TURN / 2)
    if len(missing) != 1:
        quantity = say("number of sizes beside base_radius")
        limit = say("3 of flank_radius, nose_radius, lift and ascent, or lift alone for an eccentric cam")
        raise DesignError(quantity, len(SIZE_NAMES) - len(missing), limit)
    known = ArcOutline(
        base_radius,
        math.inf if flank_radius == STRAIGHT else _number(flank_radius),
        _number(nose_radius),
        _number(lift),
        _number(ascent),
        dwell,
    )
    found = replace(known, **{missing[0]: SOUGHT[missing[0]](known)})
    _check(found, missing[0])
    return found


def _check_size(name: str, value: object) -> None:
    if name == "flank_radius":
        check_number(name, value, say('a finite length in mm, or "straight"'))
    elif name == "dwell":
        check_number(name, value, say("an angle of 0 rad or more"), least=0)
    else:
        check_number(name, value, say("a finite number greater than 0"), above=0)


def _number(value: float | Straight | None) -> float:
    return math.nan if value is None or value == STRAIGHT else float(value)


# --- the size that is not given --------------------------------------------------------------------------------------


def _ascent(cam: ArcOutline) -> float:
    d, a = cam.nose_distance, cam.flank_radius - cam.base_radius
    if not cam.has_arcs:
        cosine = (cam.base_radius - cam.nose_radius) / d
    else:
        between = cam.flank_radius - cam.nose_radius
        cosine = ((between - a) * (between + a) - d * d) / (2 * a * d)
    return math.acos(cosine) if -1 < cosine < 1 else math.nan


def _flank_radius(cam: ArcOutline) -> float:
    d, base, nose, c = cam.nose_distance, cam.base_radius, cam.nose_radius, math.cos(cam.ascent)
    flatness = 2 * (base - nose - d * c)
    rest = base * base + d * d - 2 * base * d * c - nose * nose
    return rest / flatness if flatness else math.inf


def _nose_radius(cam: ArcOutline) -> float:
    top, c = cam.base_radius + cam.lift, math.cos(cam.ascent)
    if not cam.has_arcs:
        return (cam.base_radius - top * c) / (1 - c)
    flank, a = cam.flank_radius, cam.flank_radius - cam.base_radius
    return (a * a + top * top + 2 * a * top * c - flank * flank) / (2 * (top - flank + a * c))


def _lift(cam: ArcOutline) -> float:
    nose, c = cam.nose_radius, math.cos(cam.ascent)
    if not cam.has_arcs:
        d = (cam.base_radius - nose) / c
    else:
        a, between = cam.flank_radius - cam.base_radius, cam.flank_radius - nose
        squared = between * between - a * a * (1 - c * c)
        d = math.sqrt(squared) - a * c if squared >= 0 else math.nan
        if a < 0 and squared >= 0:  # round a hollow flank the nearer of the two places of N
            d = -a * c - math.sqrt(squared)
    return d + nose - cam.base_radius


SOUGHT = {"flank_radius": _flank_radius, "nose_radius": _nose_radius, "lift": _lift, "ascent": _ascent}
"""What finds a size from the others."""


def _check(cam: ArcOutline, sought: str) -> None:
    """Refuse what is no cam: say which size is wrong and what it may be."""
    nose, lift, flank, widest = cam.nose_radius, cam.lift, cam.flank_radius, cam.widest_nose
    limit, remedy = say("one with which base circle, flank and nose touch"), say("a smaller nose often helps")
    none = DesignError(sought, say("none"), limit, remedy)
    if not lift > 0:
        raise none
    if sought != "flank_radius" and 0 <= flank <= widest:
        limit = say("greater than {least:.6g} mm, or negative for a hollow flank", least=widest)
        raise DesignError("flank_radius", flank, limit, say("or {straight} for a tangent cam", straight='"straight"'))
    if sought != "nose_radius" and nose >= widest:
        raise DesignError("nose_radius", nose, say("less than {most:.6g} mm", most=widest), say("or lift more"))
    sizes = nose, lift, cam.ascent, abs(flank), cam.nose_distance
    sound = all(size > 0 for size in sizes) and cam.ascent < FULL_TURN / 2 and (flank < 0 or flank > widest > nose)
    leaving = -cmath.phase(cam.leaving_normal) if sound else math.nan
    if not (leaving < cam.ascent and (leaving >= 0) == (flank > 0)):
        raise none
    moving = 2 * cam.ascent + cam.dwell
    if not moving < FULL_TURN:
        found = say("{angle:.6g} degrees", angle=math.degrees(moving))
        raise DesignError(say("ascent, dwell and descent"), found, say("less than a turn"), say("shorten the dwell"))
