"""The greatest value of a quantity of a cam, proved with mpmath's interval arithmetic.

Nothing here imports or repeats what graphcam's own proof is made of: laws are sums of powers and sines, a quantity is
followed with its first two derivatives as intervals, and an interval of cam angles is done with when the quantity stays
below what is reached, when its slope has one sign, or when it is bent downwards all over it: then it is no greater than
q(m) - q'(m)^2/(2 q''), with the least bend.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from mpmath import iv, mp, mpf, pi

from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.given.motion import Dwell
from graphcam.mechanism.cam import Cam

iv.dps, mp.dps = 30, 50
SLACK = mpf(10) ** -15
"""Where all derivatives vanish at an end, the bound exceeds what is reached by no more than this part of it."""
TOO_NARROW = mpf(10) ** -25
"""An interval of cam angles that is divided so far cannot be decided."""


class Sum(NamedTuple):
    """A piece of a law up to u = end: sum of c_n (u - origin)^n, and of A sin(k u + p)."""

    end: mpf
    powers: tuple[mpf, ...] = ()
    sines: tuple[tuple[mpf, mpf, mpf], ...] = ()
    origin: mpf = mpf(0)

    def derivative(self, u, n: int):
        """The n-th derivative on an interval of u."""
        powers, sines = _terms(self, n)
        total, way = iv.mpf(0), u - self.origin
        for c in powers:
            total = total * way + c
        for height, k, p in sines:
            total += height * (iv.cos if n % 2 else iv.sin)(k * u + p)
        return total


@cache
def _terms(piece: Sum, n: int):
    """The coefficients of the n-th derivative, the highest power first, and its sines or cosines."""
    powers = [iv.mpf(mp.ff(k, n) * c) for k, c in enumerate(piece.powers)][: n - 1 if n else None : -1]
    sines = [[iv.mpf(x) for x in ((-1) ** (n // 2) * height * k**n, k, p)] for height, k, p in piece.sines]
    return powers, sines


def law_of(name: str, middle: float = 0.5) -> list[Sum]:
    """The pieces of a law as the textbooks print it."""
    if name == "rectangular":
        m = mpf(middle)
        return [Sum(m, (0, 0, 1 / m)), Sum(mpf(1), (1 - 1 / (1 - m), 2 / (1 - m), -1 / (1 - m)))]
    return _WHOLE[name]() if name in _WHOLE else _mirrored(_HALF[name]())


def _mirrored(first: list[Sum]) -> list[Sum]:
    """1 - f(1 - u) behind the middle."""
    starts = [mpf(0), *(piece.end for piece in first)]
    second = []
    for piece, start in zip(first[::-1], starts[-2::-1], strict=True):
        powers = [mpf(0)] * len(piece.powers)
        for n, c in enumerate(piece.powers):
            for k in range(n + 1):
                powers[k] -= c * mp.binomial(n, k) * (-1) ** k
        powers[0] += 1
        # -A sin(k (1 - u) + p) = A sin(k u - k - p)
        second.append(Sum(1 - start, tuple(powers), tuple((h, k, -k - p) for h, k, p in piece.sines)))
    return [*first, *second]


_E = mpf(1) / 8
_HALF: dict[str, Callable[[], list[Sum]]] = {
    "triangular": lambda: [
        Sum(mpf(1) / 4, (0, 0, 0, mpf(16) / 3)),
        Sum(mpf(1) / 2, (mpf(1) / 6, -2, 8, -mpf(16) / 3)),
    ],
    "trapezoidal": lambda: [
        Sum(_E, (0, 0, 0, mpf(64) / 9)),
        Sum(3 * _E, (mpf(1) / 72, -mpf(1) / 3, mpf(8) / 3)),
        Sum(4 * _E, (mpf(7) / 18, -mpf(10) / 3, mpf(32) / 3, -mpf(64) / 9)),
    ],
    "modified-trapezoidal": lambda: [
        Sum(_E, (0, 2 / (2 + pi)), ((-1 / (2 * pi) / (2 + pi), 4 * pi, mpf(0)),)),
        Sum(
            3 * _E,
            tuple(c / (2 + pi) for c in (mpf(1) / 4 - 1 / (2 * pi) - 2 * _E + 4 * pi * _E**2, 2 - 8 * pi * _E, 4 * pi)),
        ),
        Sum(4 * _E, (-pi / 2 / (2 + pi), 2 * (1 + pi) / (2 + pi)), ((-1 / (2 * pi) / (2 + pi), 4 * pi, -pi),)),
    ],
}
_WHOLE: dict[str, Callable[[], list[Sum]]] = {
    "cosine": lambda: [Sum(mpf(1), (mpf(1) / 2,), ((-mpf(1) / 2, pi, pi / 2),))],
    "cycloidal": lambda: [Sum(mpf(1), (0, 1), ((-1 / (2 * pi), 2 * pi, mpf(0)),))],
    "modified-sine": lambda: [
        Sum(_E, (0, pi / (4 + pi)), ((-1 / (4 * (4 + pi)), 4 * pi, mpf(0)),)),
        Sum(7 * _E, (2 / (4 + pi), pi / (4 + pi)), ((-9 / (4 * (4 + pi)), 4 * pi / 3, pi / 3),)),
        Sum(mpf(1), (4 / (4 + pi), pi / (4 + pi)), ((-1 / (4 * (4 + pi)), 4 * pi, mpf(0)),)),
    ],
    "2-3": lambda: [Sum(mpf(1), (0, 0, 3, -2))],
    "3-4-5": lambda: [Sum(mpf(1), (0, 0, 0, 10, -15, 6))],
    "4-5-6-7": lambda: [Sum(mpf(1), (0, 0, 0, 0, 35, -84, 70, -20))],
    "double-harmonic": lambda: [
        Sum(mpf(1), (3 * _E,), ((-mpf(1) / 2, pi, pi / 2), (_E, 2 * pi, pi / 2))),
    ],
    "eighth-degree": lambda: [
        Sum(mpf(1), tuple(map(mpf, ("0", "0", "0", "6.09755", "0", "-20.7804", "26.73155", "-13.60965", "2.56095"))))
    ],
}


def backwards(law: list[Sum]) -> list[Sum]:
    """1 - f(1 - u)."""
    return _mirrored(law)[len(law) :]


def law_of_polynomials(law) -> list[Sum]:
    """The pieces of a measured law, from its coefficients."""
    out = []
    ends = (0.0, *law.edges, 1.0)
    for piece, begin, end in zip(law.pieces, ends[:-1], ends[1:], strict=True):
        series, from_end = piece.formula, piece.length < 0
        low, high = (1 - end, 1 - begin) if from_end else (begin, end)
        inner = series.ends[(series.ends > low + 1e-12) & (series.ends < high - 1e-12)]
        cuts = [low, *inner.tolist(), high]
        for x0, x1 in list(pairwise(cuts))[:: -1 if from_end else 1]:
            cell = int(np.searchsorted(series.ends[1:-1], (x0 + x1) / 2))
            anchor = mpf(float(series.anchors[cell]))
            # About the anchor, or from the end 1 - u: about u = 0 the terms would be huge and cancel.
            powers = [mpf(c) * (-1) ** (n * from_end) for n, c in enumerate(series.coefficients[:, cell].tolist())]
            if from_end:
                powers = [-c for c in powers]
                powers[0] += 1
            last = x0 == cuts[0] if from_end else x1 == cuts[-1]
            upto = mpf(end) if last else 1 - mpf(x0) if from_end else mpf(x1)
            out.append(Sum(upto, tuple(powers), origin=1 - anchor if from_end else anchor))
    return out


@dataclass(frozen=True)
class Jet:
    """A quantity and its first two derivatives by phi, each an interval."""

    q: object
    d: object
    b: object

    def __add__(self, other):
        other = other if isinstance(other, Jet) else Jet(other, 0, 0)
        return Jet(self.q + other.q, self.d + other.d, self.b + other.b)

    __radd__ = __add__

    def __neg__(self):
        return Jet(-self.q, -self.d, -self.b)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if not isinstance(other, Jet):
            return Jet(self.q * other, self.d * other, self.b * other)
        b = self.b * other.q + 2 * self.d * other.d + self.q * other.b
        return Jet(self.q * other.q, self.d * other.q + self.q * other.d, b)

    __rmul__ = __mul__

    def power(self, n):
        """The n-th power of what is positive."""
        q = _power(self.q, n)
        rate = n * _power(self.q, n - 1)
        return Jet(q, rate * self.d, rate * self.b + n * (n - 1) * _power(self.q, n - 2) * self.d * self.d)

    def wave(self):
        """Cosine and sine."""
        c, s = iv.cos(self.q), iv.sin(self.q)
        square = self.d * self.d
        return Jet(c, -s * self.d, -c * square - s * self.b), Jet(s, c * self.d, c * self.b - s * square)


def _power(q, n):
    if q.a <= 0:
        raise ZeroDivisionError
    return iv.exp(n * iv.log(q))


def _jets(piece: Sum, phase, level, u) -> tuple[Jet, Jet, Jet]:
    """s, v and a on an interval of u."""
    angle, h = iv.mpf(phase.angle), phase.direction * iv.mpf(phase.lift)
    f = [h * piece.derivative(u, n) / angle**n for n in range(5)]
    s = level + f[0]  # of a return f is negative, and the level the upper one
    return Jet(s, f[1], f[2]), Jet(f[1], f[2], f[3]), Jet(f[2], f[3], f[4])


def quantities(cam: Cam) -> tuple[Callable[..., Jet], Callable[..., Jet]]:
    """The tangent of the pressure angle and the curvature (of a flat face: minus its radius) from s, v, a."""
    r0, sigma, f = iv.mpf(cam.prime_radius), cam.sigma, cam.follower
    if isinstance(f, FlatFaced):
        return (lambda s, v, a: 0 * s), (lambda s, v, a: -(s + a + r0))
    if isinstance(f, Translating):
        e = iv.mpf(f.offset)
        s0 = iv.sqrt(r0**2 - e**2)

        def trace(s, v, a):
            zero = 0 * s
            return (zero + e, s + s0), (zero, v), (zero, a)

        def tangent(s, v, a):
            return (v - sigma * e) * (s + s0).power(-1)

    else:
        assert isinstance(f, Oscillating)
        c, arm = iv.mpf(f.distance), iv.mpf(f.arm)
        cosine = (c**2 + arm**2 - r0**2) / (2 * c * arm)
        psi0 = 2 * _arctangent(iv.sqrt((1 - cosine) / (1 + cosine)))

        def trace(s, v, a):
            cos, sin = (s + psi0).wave()
            x, y, across = -(cos * arm) + c, sin * arm, cos * arm
            return (x, y), (v * y, v * across), (a * y + v * v * across, a * across - v * v * y)

        def tangent(s, v, a):
            cos, sin = (s + psi0).wave()
            return ((1 + v * sigma) * arm - cos * c) * (sin * c).power(-1)

    def curvature(s, v, a):
        (x, y), (x1, y1), (x2, y2) = trace(s, v, a)
        p, q = x1 + sigma * y, y1 - sigma * x
        bend = p * (y2 - y - 2 * sigma * x1) - q * (x2 - x + 2 * sigma * y1)
        return -sigma * (bend * (p * p + q * q).power(iv.mpf(-1.5)))

    return tangent, curvature


def _arctangent(x):
    return iv.mpf([mp.atan(mpf(x.a)) * (1 - mp.eps), mp.atan(mpf(x.b)) * (1 + mp.eps)])


def greatest(cam: Cam, laws: list[list[Sum]], quantity, direction: int, *, signed: bool) -> mpf:
    """What the quantity nowhere exceeds on the rises (direction 1) or the returns (-1), and reaches to 25 digits."""
    best = -mpf("inf")
    motion = cam.motion
    signs = (1, -1) if signed else (1,)
    todo = []
    for phase, pieces, low in zip(motion.phases, laws, motion.levels[:-1].tolist(), strict=True):
        if isinstance(phase, Dwell) or phase.direction != direction:
            continue
        for piece, (u0, u1) in zip(pieces, pairwise([mpf(0), *(piece.end for piece in pieces)]), strict=True):

            @cache
            def at(begin, end, phase=phase, piece=piece, low=low):
                return quantity(*_jets(piece, phase, iv.mpf(low), iv.mpf([begin, end])))

            best = max([best, *(mpf((sign * at(u, u).q).b) for u in (u0, u1) for sign in signs)])
            todo += [
                (at, sign, u0 + (u1 - u0) * k / 8, u0 + (u1 - u0) * (k + 1) / 8, mpf(phase.angle))
                for sign in signs
                for k in range(8)
            ]
    while todo:
        at, sign, low, high, angle = todo.pop()
        try:
            over = sign * at(low, high)
            if best < over.q.b <= best + SLACK * abs(best):
                best = mpf(over.q.b)
            decided = mpf(over.q.b) <= best or mpf(over.d.a) > 0 or mpf(over.d.b) < 0 or mpf(over.b.a) > 0
            least_bend = -mpf(over.b.b)
        except (ValueError, ZeroDivisionError, TypeError):  # a power of what may be negative
            decided, least_bend = False, mpf(-1)
        if decided:
            continue
        if least_bend > 0:
            m = (low + high) / 2
            for _ in range(12):
                there = sign * at(m, m)
                m = min(max(m - mpf(there.d.mid) / mpf(there.b.mid) / angle, low), high)
            there = sign * at(m, m)
            slope = max(abs(mpf(there.d.a)), abs(mpf(there.d.b)))
            outwards = (m == low and mpf(there.d.b) < 0) or (m == high and mpf(there.d.a) > 0)
            best = max(best, mpf(there.q.b) + (0 if outwards else slope**2 / (2 * least_bend)))
            continue
        assert high - low > TOO_NARROW, "cannot be decided"
        middle = (low + high) / 2
        todo += [(at, sign, low, middle, angle), (at, sign, middle, high, angle)]
    return best
