"""Cams of three circular arcs, exactly: both roots of the third arc, and which of them can be built.

The third arc begins at G, where it touches the arc about C2, so its centre C3 lies on the line G C2.  Lay rho1 off
along that line, from G to P = G + k n with k = rho1 or k = -rho1: where the third arc touches the circle about C1, its
centre is as far from P as from C1.  So C3 is where the perpendicular bisector of C1 P meets the line, one root for each
k, and the line of centres through F is the line G C2 mirrored in that bisector.  The mirror image is there even where
the bisector is parallel to the line: then the flank is straight and C3 at infinity.

Source: C. Lanni, M. Ceccarelli, G. Figliolini, "An analytical design for three circular-arc cams", *Mechanism and
Machine Theory* 37 (2002).
"""

from __future__ import annotations

import math
from dataclasses import replace
from textwrap import wrap

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.mechanism.arc_motion import ArcFlank, ArcMotion
from graphcam.plane_vectors import dot
from graphcam.showing import MAX_WIDTH, Plottable, value_text
from graphcam.subscripts import indexed
from graphcam.words import Caption, say, sequence

LENGTH_ROUNDING = 4 * float(np.finfo(np.float64).eps)
"""What a sum of lengths may be off by, as a part of them: a flank that bends by no more is straight."""


class ThreeArcCam(ArcFlank, Plottable):
    """One root of a three-arc cam: its flank, and the motion of a follower on it."""

    _drawn_in = "cam_outline.plot_arcs"

    def __repr__(self) -> str:
        radii = f"radii {self.rho1:.6g}, {self.rho2:.6g} and {self.rho3:.6g} mm about C1, C2 and C3"
        points = [f"{name} ({x:.6g}, {y:.6g})" for name in ("A", "G", "F", "D") for x, y in [getattr(self, name)]]
        first = f"Cam of three circular arcs, {'sound' if self.sound else 'not sound'}"
        rows = (radii, f"{', '.join(points)} mm", *wrap(self.why, MAX_WIDTH))
        return value_text(first, rows, ".motion(roller_radius); .plot() draws it")

    def motion(self, roller_radius: float = 0.0, dwell: float = 0.0) -> ArcMotion:
        """What a central translating follower does on this flank and its mirror image.

        roller_radius : mm, 0 for a knife edge
        dwell : angle [rad] for which the outer circle holds the follower up

        Raises
        ------
        DesignError : the root is not sound, its arcs do not form a profile, or the follower cannot run on it

        >>> import graphcam as gc
        >>> upper, _ = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))
        >>> motion = upper.motion(roller_radius=10, dwell=math.radians(40))
        >>> round(motion.lift, 2), round(math.degrees(motion.rise), 2)
        (15.0, 70.0)
        """
        return ArcMotion(self, roller_radius, dwell)


def three_arc_cam(
    D: Point, G: Point, rho1: float, A: Point | None = None, C1: Point | None = None, C2: Point | None = None
) -> tuple[ThreeArcCam, ThreeArcCam]:
    """The two cams of three arcs with these data, each with its centres, F, and whether it is sound and why.

    See :class:`~graphcam.given.three_arcs.ThreeArcs` for the data and what may be left out.  Only the first root, whose
    circles about C1 and C3 touch without a cusp, can be sound.

    Raises
    ------
    DesignError : the data are impossible, or A and G ask for a second arc that is straight

    >>> import graphcam as gc
    >>> cam, other = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, C1=(35.71, 13), C2=(0, -75.64))
    >>> cam.sound, cam.C3.round(3).tolist(), cam.F.round(3).tolist()
    (True, [12.003, -14.394], [46.834, 25.855])
    >>> print(other.why)
    On the line of F, C₁ and C₃ the order is C₁, F, C₃ instead of F, C₁, C₃: the profile would turn back in a cusp at F.
    """
    given = ThreeArcs(D, G, rho1, A, C1, C2)
    c1, c2 = first_centre(given), second_centre(given)
    return _root(given, c1, c2, given.rho1), _root(given, c1, c2, -given.rho1)


def first_centre(given: ThreeArcs) -> complex:
    """C1: as given, else rho1 from D towards the cam centre."""
    if given.C1 is not None:
        return complex(*given.C1)
    d = complex(*given.D)
    return d - given.rho1 * d / abs(d)


def second_centre(given: ThreeArcs) -> complex:
    """C2: as given, else on the line OA as far from A as from G."""
    if given.C2 is not None:
        return complex(*given.C2)
    assert given.A is not None  # or C2 would be given
    a, g = complex(*given.A), complex(*given.G)
    outward, chord = a / abs(a), a - g
    below = float(dot(outward, chord))  # how far G lies below the base circle's tangent at A
    if abs(below) <= LENGTH_ROUNDING * (abs(a) + abs(g)):
        remedy = say("move G: an arc that is straight has no centre C₂")
        raise DesignError("G", given.G, say("off the tangent of the base circle at A"), remedy)
    # |A - rho2 outward - G| = rho2, the squares of rho2 cancelling.
    return a - outward * abs(chord) ** 2 / (2 * below)


def _root(given: ThreeArcs, c1: complex, c2: complex, k: float) -> ThreeArcCam:
    g = complex(*given.G)
    rho2 = abs(c2 - g)
    n = (c2 - g) / rho2
    w = g - c1
    m = w + k * n  # from C1 to P
    bend = float(dot(m, n))  # zero where the bisector of C1 P is parallel to the line G C2
    reach = abs(w) + abs(k)
    if abs(m) <= LENGTH_ROUNDING * reach:
        f, t = g, math.nan
        why = say("The arcs about C₁ and C₂ touch in G themselves: there is nothing for a third to join.")
    else:
        # The line of centres through F is the line G C2 mirrored in the bisector.
        f = c1 - k * (n - 2 * bend * m / abs(m) ** 2)
        t = math.inf
        if abs(bend) > LENGTH_ROUNDING * reach:
            # |C3 - C1| = |t - k|; the difference of squares is factored, because G may lie almost on the circle.
            t = (k - abs(w)) * (k + abs(w)) / (2 * bend)
        why = _root_reason(k, t, rho2)
    c3 = g + t * n if math.isfinite(t) else complex(math.nan, math.nan)
    # D: where the circle about C1 touches one about the cam centre that it lies inside.
    d = c1 * (1 + abs(k) / abs(c1)) if c1 else complex(math.nan, math.nan)
    a, sound = _base_point(c2, rho2, g), 0 < k < t < rho2
    A, D, F, G, C1, C2, C3 = (_xy(point) for point in (a, d, f, g, c1, c2, c3))
    return ThreeArcCam(given, A, D, F, G, C1, C2, C3, abs(k), rho2, abs(t), t < 0, sound, why)


def _base_point(c2: complex, rho2: float, g: complex) -> complex:
    """A: where the circle about C2 touches one about the cam centre that lies inside it."""
    if not c2:
        return complex(math.nan, math.nan)  # it is itself a circle about the cam centre
    distance = abs(c2)
    # rho2 - |C2| without the difference of two large numbers that a flat arc would leave.
    return -c2 / distance * float(dot(g, g - 2 * c2)) / (rho2 + distance)


STRAIGHT_FLANK_REASONS = (
    say("The flank from G to F is straight: it has no centre C₃."),
    say("The flank from G to F is straight: it has no centre C₃, and the profile would turn back in a cusp at F."),
)
"""Why a straight flank is no root: without a cusp, and with one."""
ORDER_AT_F_REASON = say("On the line of F, C₁ and C₃ the order is {order} instead of F, C₁, C₃: {reason}.")
ORDER_AT_G_REASON = say("On the line of G, C₃ and C₂ the order is {order} instead of G, C₃, C₂: {reason}.")


def _root_reason(k: float, t: float, rho2: float) -> Caption:
    """The reason why a root is sound or not: k as laid off from G, t the directed way from G to C3 [mm]."""
    if math.isinf(t):
        return STRAIGHT_FLANK_REASONS[k < 0]
    hollow = say("the flank would be hollow")
    said: list[Caption] = []
    if not 0 < k < t:
        reason = say("the profile would turn back in a cusp at F")
        if k > 0:
            reason = hollow if t < 0 else say("the third arc would bend more sharply than the first")
        said.append(replace(ORDER_AT_F_REASON, values={"order": _order(F=-k, C1=0.0, C3=t - k), "reason": reason}))
    if not 0 < t < rho2:
        reason = hollow if t < 0 else say("the third arc would be flatter than the second")
        said.append(replace(ORDER_AT_G_REASON, values={"order": _order(G=0.0, C3=t, C2=rho2), "reason": reason}))
    if said:
        return sequence(said, " ")
    return say("F, C₁, C₃ and G, C₃, C₂ lie in these orders: the arcs touch internally at F and at G.")


def _order(**places: float) -> str:
    return ", ".join(indexed(name) for name in sorted(places, key=lambda name: places[name]))


def _xy(z: complex) -> Floats:
    return np.array([z.real, z.imag])
