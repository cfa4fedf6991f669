"""A law whose accelerating part and decelerating part are of unequal length, made from the one with equal parts.

Both halves of a law g that mirror each other are stretched, to the parts p and 1 - p of the phase: f = 2 p g(u/2p) in
the first, and so from the other end.  The velocity, g' at the middle, is the same for both, so they join; the
accelerations are as 1 - p to p, their ratio is nu = (1 - p)/p, and p = 1/(1 + nu).

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 3, skewed (unsymmetrical) curves.
"""

from functools import partial

from graphcam.given.motion_law import Law, Tangent
from graphcam.given.piecewise import Floats, Formula


def skewed(law: Law, ratio: float) -> Law:
    """The law with the ratio |a1|/|a2| of the accelerations of its two parts.

    law : one whose second half mirrors the first

    >>> import graphcam as gc
    >>> law = gc.law("cycloidal", ratio=3.0)
    >>> [round(float(x), 6) for x in law(0.25)[:2]], law.peak_acceleration / gc.law("cycloidal").peak_acceleration
    ([0.25, 2.0], 2.0)
    """
    if ratio == 1:
        return law
    first = 1 / (1 + ratio)
    halves = [piece.formula for piece in law.pieces if piece.start < law.middle]
    edges = [u for u in law.edges if u < law.middle]
    parts = first, 1 - first
    formulas = [
        partial(_stretched, formula=formula, part=part)
        for part, run in zip(parts, (halves, halves[::-1]), strict=True)
        for formula in run
    ]
    ends = [2 * first * u for u in edges], [1 - 2 * parts[1] * u for u in edges[::-1]]
    ahead, back = (
        None if tangent is None else partial(_stretched_tangent, tangent=tangent, part=part)
        for tangent, part in zip(law.tangents, parts, strict=True)
    )
    peaks = law.peak_velocity, law.peak_acceleration / (2 * min(parts))
    inner = (*ends[0], first, *ends[1])
    return Law(law.name, formulas, inner, False, first, ratio, peaks, (ahead, back), trusted=True)


def _stretched(x: Floats, *, formula: Formula, part: float) -> tuple[Floats | float, ...]:
    """The half of a law over a part of the phase, at the distance x from its end."""
    f, f1, f2, f3 = formula(x / (2 * part))
    return 2 * part * f, f1, f2 / (2 * part), f3 / (2 * part) ** 2


def _stretched_tangent(k: float, *, tangent: Tangent, part: float) -> tuple[float, float]:
    """The place where f' - f/k is greatest, which lies where the acceleration is positive, and that value."""
    u, height = tangent(k / (2 * part))
    return 2 * part * u, height
