"""A proved bound of the double integration: how far its chords can be off, known before anything is drawn.

A law f is integrated twice over divisions 0 = u_0 < ... < u_n = 1 of widths w, as the textbook does it: a chord climbs
by w f''(middle), the velocity left at the end is taken up by the base line, a second chord climbs by w times the mean
of the velocities at its ends, and the end is read as the known lift.

Theorem.  Inside its parts let |f'''''| <= M; at a distance x behind the division before it, y before the next one and
m = min(x, y), let f'' jump by D, f''' by J and f'''' by G.  With sums over the parts before u_k

    v_k - f'_k = u_k E_n - E_k + at most (1 - u_k) R_k + u_k (R_n - R_k)
        E = sum w^2/24 (f''' from end to end, less J) + J m^2/2 + D (y or -x, whichever is the smaller)
        R = sum M w^4/192 + |G| m (w^2/24 - m^2/6)
    S_k - f_k = a_k + at most r_k, where the trapezoid of the velocities' errors and of their bounds comes to
        a = sum w^2/12 (f'' from end to end) + D (x y/2 - w^2/12) + J x y (y - x)/12
        r = sum M w^5/720 + |G| x^2 y^2/24

and with the end read as 1 displacement, velocity and acceleration are off by at most the magnitude of a_k - f_k a_n
(u_k E_n - E_k - f'_k a_n; f'' a_n) and its bound r_k + f_k r_n (and so on), over 1 + a_n - r_n.

Proof.  The middle ordinate errs by the integral over the part of K f'''', K = t^2/2 at the distance t from the nearer
division (Peano).  The mean of K is w^2/24; what is left of it has none, so by parts its integral, t^3/6 - w^2 t/24,
stands before f''''', and the magnitude of that makes w^4/192.  The trapezoid of f' errs by the integral of x y/2 times
f''', of mean w^2/12; twice by parts the rest makes x y (y - x)/12 before f'''' and x^2 y^2/24, in all w^5/720, before
f'''''.  Every jump counts by the kernel at its place.  The base line takes up u_k of the whole error.  Last, S_k/S_n -
f_k = (S_k - f_k - f_k (S_n - 1))/S_n.

A jump on a division counts for nothing; one of f'' off the grid makes D m, of first order where all else is of second.
The named part is the error itself, so that the bound is the tighter the more parts there are.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.given.laws import DECLARED_LAWS, Floats, canonical_law, law as law_of
from graphcam.given.motion import Motion, MovingPhase
from graphcam.given.motion_law import Law
from graphcam.given.stations import Stations
from graphcam.mechanism.turn_extremes import max_acceleration, max_velocity


@dataclass(frozen=True, eq=False)
class ChordErrors:
    """How far the chords of a law are off at its divisions (n + 1,), of the lift: the part that is known, and the rest.

    s, v : the known parts before the end is read as the lift;  s_rest, v_rest : what may come to them
    exact : f, f', f''
    """

    s: Floats
    s_rest: Floats
    v: Floats
    v_rest: Floats
    exact: tuple[Floats, Floats, Floats]

    def read(self) -> tuple[Floats, Floats, Floats]:
        """The bounds of displacement, velocity and acceleration at the divisions, the end being read as the lift.

        >>> s, v, a = chord_errors(law_of("3-4-5"), np.linspace(0, 1, 13)).read()
        >>> np.round([s.max(), v.max(), a.max()], 5).tolist()
        [0.00539, 0.00866, 0.09965]
        """
        end, rest, (f, f1, f2) = self.s[-1], self.s_rest[-1], self.exact
        least = 1 + end - rest
        if not least > 0:
            return np.full_like(f, np.inf), np.full_like(f, np.inf), np.full_like(f, np.inf)
        s = np.abs(self.s - f * end) + self.s_rest + f * rest
        v = np.abs(self.v - f1 * end) + self.v_rest + f1 * rest
        return s / least, v / least, np.abs(f2) * (abs(end) + rest) / least


def known_derivatives(law: Law) -> tuple[Floats, Floats] | None:
    """The greatest fifth derivative of each piece of a law, and the jumps of the fourth between them, as declared.

    None of a law of one's own, whatever its name.
    """
    declared = DECLARED_LAWS.get(law.name)
    if declared is None or declared.fifth_derivatives is None:
        return None
    if law not in ((named := law_of(canonical_law(declared.name), law.ratio)), named.reversed):
        return None
    greatest, bends = declared.fifth_derivatives
    # The halves of a law are stretched to its parts; at their end, where f'''' is odd about it, it does not jump.
    first, second = 2 * law.middle, 2 * (1 - law.middle)
    return (
        np.array([*(x / first**4 for x in greatest), *(x / second**4 for x in greatest[::-1])]),
        np.array([*(x / first**3 for x in bends), 0.0, *(x / second**3 for x in bends[::-1])]),
    )


def chord_errors(law: Law, u: Floats) -> ChordErrors:
    """The errors of the chords between the divisions u, from 0 to 1, of a law whose derivatives are known."""
    known = known_derivatives(law)
    assert known is not None
    w, after, before = np.diff(u), law(u[:-1]), law(u[1:], side="left")
    greatest, bends = known
    first, last = np.searchsorted(law.edges, u[:-1], "right"), np.searchsorted(law.edges, u[1:], "left")
    fifth = np.array([greatest[a : b + 1].max() for a, b in zip(first, last, strict=True)])
    steep = w**2 / 24 * (before[3] - after[3])
    steep_rest, flat_rest = fifth * w**4 / 192, fifth * w**5 / 720
    flat = w**2 / 12 * (before[2] - after[2])
    for edge, bend in zip(law.edges, bends, strict=True):
        part = min(int(np.searchsorted(u, edge, "right")) - 1, w.size - 1)
        x, y, width = edge - u[part], u[part + 1] - edge, w[part]
        if not x > 0:
            continue
        m = min(x, y)
        step, jump = (float(law(edge)[n] - law(edge, side="left")[n]) for n in (2, 3))
        steep[part] += jump * (m * m / 2 - width**2 / 24) + step * (y if y < x else -x)
        flat[part] += step * (x * y / 2 - width**2 / 12) + jump * x * y * (y - x) / 12
        steep_rest[part] += bend * m * (width**2 / 24 - m * m / 6)
        flat_rest[part] += bend * (x * y) ** 2 / 24
    error, rest = (np.append(0.0, np.cumsum(each)) for each in (steep, steep_rest))
    v, v_rest = u * error[-1] - error, (1 - u) * rest + u * (rest[-1] - rest)
    s, s_rest = (
        np.append(0.0, np.cumsum(own + w * (of_v[:-1] + of_v[1:]) / 2))
        for own, of_v in ((flat, v), (flat_rest, v_rest))
    )
    f, f1, f2 = law(u, derivatives=2)
    return ChordErrors(s, s_rest, v, v_rest, (f, f1, f2))


def proved_bounds(motion: Motion, stations: Stations) -> dict[str, float]:
    """How far the greatest v and a are off at most, in machine units, for a hand without error; empty if not known.

    The rises come first and settle the scale.  The greatest v is read from a parabola through three plotted points,
    whose top is by an eighth of their second difference higher than the highest, at most.

    >>> import graphcam as gc
    >>> chain = gc.solve(gc.builtin_task()).chain
    >>> {name: round(bound, 9) for name, bound in proved_bounds(chain.board.motion, chain.board.stations).items()}
    {'max_v': 0.0, 'max_a': 0.0}
    """
    phases = [phase for phase in motion.phases if isinstance(phase, MovingPhase)]
    directions = [phase.direction for phase in phases]
    if directions != sorted(directions, reverse=True) or not all(
        known_derivatives(phase.normalised) for phase in phases
    ):
        return {}
    divisions = [stations.u[span] for span in stations.phases]
    drawn = [chord_errors(p.normalised, u) for p, u in zip(phases, divisions, strict=True)]
    rises = [(p, c) for p, c in zip(phases, drawn, strict=True) if p.direction > 0]
    ends = [p.lift / motion.lift * np.array([c.s[-1], c.s_rest[-1]]) for p, c in rises]
    end, rest = np.sum(ends, axis=0).tolist()
    if not 1 + end - rest > 0:
        return {}
    tops = [_range_of_top(c, np.isin(u, p.normalised.jumps)) for p, c, u in zip(phases, drawn, divisions, strict=True)]
    low, high = np.max([top * (p.lift / p.angle) for top, p in zip(tops, phases, strict=True)], axis=0)
    exact = max_velocity(motion)
    off = max(abs(low / (1 + end + rest) - exact), abs(high / (1 + end - rest) - exact))
    return {"max_v": float(off), "max_a": max_acceleration(motion) * (abs(end) + rest) / (1 + end - rest)}


def _range_of_top(c: ChordErrors, jumps: NDArray[np.bool_]) -> Floats:
    """The heights between which the curve of v, faired from jump to jump, has its top, of the lift over the phase."""
    plotted = c.exact[1] + c.v
    second = np.where(jumps[1:-1], 0.0, np.abs(np.diff(plotted, 2)) + 4 * np.max(c.v_rest))
    low = np.max(plotted - c.v_rest)
    # Each of the three points may be the highest one.
    likely = np.convolve(plotted + c.v_rest >= low, np.ones(3), "valid") > 0
    return np.array([low, np.max(plotted + c.v_rest) + np.max(second[likely], initial=0.0) / 8])
