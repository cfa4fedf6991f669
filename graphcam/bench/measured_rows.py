"""Random motions, measured with noise, against the motions they were sampled from and the best that noise permits."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.integrate import cumulative_trapezoid

from graphcam.bench.rows import BenchRow, Effort, Section
from graphcam.given.laws import DWELL_TO_DWELL_LAWS, Floats, LawName
from graphcam.given.measured import DEFAULT_TOLERANCE, NOISE_TOLERANCE, MeasuredMotion, measured_motion
from graphcam.given.motion import FULL_TURN, Dwell, Motion, MovingPhase, Phase, Return, Rise
from graphcam.mechanism.turn_extremes import max_acceleration
from graphcam.words import say

NOISE_DEVIATIONS = 0.0, 0.003, 0.01, 0.03
"""Standard deviations of the displacements [mm]."""
TABLE_ROWS = 360
MIN_PHASE_ANGLE = math.radians(25)
"""The minimum angle of a phase [rad]."""
LOWEST_ERROR, HIGHEST_ERROR = 4.0, 40.0
"""Lifts are between these [mm]."""
UNEVEN_STEP_RANGE = 0.4, 1.6
"""Uneven steps are between so many degrees."""
ACCELERATION_RATIOS = 0.5, 2.0
JUMPING_LAWS = "rectangular", "cosine", "2-3"
"""Laws whose acceleration jumps."""
CERTAINTY = 4.0
"""Motions that differ by twice so many times the noise are told apart: the best test errs 1 in 30,000."""
TWO_ROW_ANGLE = 2 * FULL_TURN / TABLE_ROWS
PEAK_GOALS = {0.0: (0.02, 0.05), 0.003: (0.15, 0.4), 0.01: (0.15, 0.4), 0.03: (math.inf, math.inf)}
"""Goals of max |a| by noise: of laws whose acceleration is continuous, and of those whose jumps."""
END_JERK = 60.0
"""The jerk of the 3-4-5 law where it begins and ends, in h/F^3: what the jerk of a motion changes by over a phase."""


def measured_rows(effort: Effort) -> Iterator[BenchRow]:
    """Rows of random motions with noise: wrong phases, ends and maximum accelerations, beside what noise permits."""
    every = list(sampled_motions(effort.motions))
    for noise in NOISE_DEVIATIONS:
        some = [one for one in every if one.noise == noise]
        name, first = f"measured, noise {noise:g} mm", some[0]
        seconds = effort.timer.seconds(measured_motion, first.phi, first.s, first.tolerance)
        wrong, end = sum(not one.phases_right for one in some), max(one.end_error for one in some)
        yield BenchRow(name, "phases wrong", wrong, f"of {len(some)}", "<= 0", seconds=seconds)
        ends = "ends off, beside two rows or what noise hides"
        yield BenchRow(name, ends, end, "maximum", "<= 1", seconds=seconds)
        for jumps, (peak, acceleration) in enumerate(zip(PEAK_GOALS[noise], ("continuous", "jumps"), strict=True)):
            of_these = [one for one in some if one.jumps == bool(jumps)]
            off = 100 * max(abs(one.peak_error) for one in of_these)
            best = 100 * math.sqrt(np.mean([one.least_scatter**2 for one in of_these])) if noise else 0.0
            what = f"max |a| off, acceleration {acceleration}; sd of the best linear estimate {best:.1f} %"
            goal = "" if math.isinf(peak) else f"<= {100 * peak:g} %"
            yield BenchRow(name, what, off, "%", goal, seconds=seconds)


@dataclass(frozen=True, eq=False)
class Sampled:
    """A motion, its table, and the motion that was made of the table.

    noise : the standard deviation with which the displacements scatter [mm]
    phi, s : (n,) the table, cam angles [rad] and displacements [mm]
    """

    motion: Motion
    noise: float
    phi: Floats
    s: Floats

    @property
    def tolerance(self) -> float:
        """What the noise asks for [mm]."""
        return NOISE_TOLERANCE * self.noise or DEFAULT_TOLERANCE

    @cached_property
    def measured(self) -> MeasuredMotion:
        """What was made of the table."""
        return measured_motion(self.phi, self.s, self.tolerance)

    @property
    def phases_right(self) -> bool:
        """Whether rises, dwells and returns follow one another as in the motion."""
        return math.isfinite(self.end_error)

    @cached_property
    def end_error(self) -> float:
        """The maximum |error| of an end of a phase, beside two rows or what the noise hides, if that is more.

        Infinite where the measured phases are others.
        """
        begin, end = np.array(
            [hidden_angles(phase, self.noise, FULL_TURN / TABLE_ROWS) for phase in self.motion.phases]
        ).T
        # A phase may begin, or the one before end, so much later or sooner, unseen.
        hidden = np.maximum(TWO_ROW_ANGLE, np.maximum(begin, np.roll(end, 1)))
        timing = [(kind, start + self.measured.zero) for kind, start, _ in self.measured.timing]
        if timing[0][0] == timing[-1][0]:
            timing = [(timing[0][0], timing[-1][1]), *timing[1:-1]]
        errors = [math.inf]
        for turned in ([*timing[k:], *timing[:k]] for k in range(len(timing))):
            if [kind for kind, _ in turned] == [phase.kind for phase in self.motion.phases]:
                away = (np.array([start for _, start in turned]) - self.motion.starts + math.pi) % FULL_TURN - math.pi
                errors.append(float(np.max(np.abs(away) / hidden)))
        return min(errors)

    @cached_property
    def peak_error(self) -> float:
        """The relative error of max |a|."""
        return max_acceleration(self.measured) / max_acceleration(self.motion) - 1

    @cached_property
    def jumps(self) -> bool:
        """Whether the acceleration jumps anywhere."""
        return any(
            isinstance(phase, MovingPhase) and phase.normalised.name in JUMPING_LAWS for phase in self.motion.phases
        )

    @cached_property
    def least_scatter(self) -> float:
        """The standard deviation of max |a|, as a part of it, in the best linear estimate; see :func:`best_scatter`."""
        u = np.linspace(0, 1, 1001)
        accelerations = np.abs([self.motion.at(k, u)[2] for k in range(len(self.motion.phases))])
        k, place = divmod(int(accelerations.argmax()), u.size)
        phase, at = self.motion.phases[k], float(self.motion.angle_at(k, u[place]))
        apart = (self.phi - at + math.pi) % FULL_TURN - math.pi
        near = np.sort(apart[np.abs(apart) <= phase.angle])
        change = END_JERK * phase.lift / phase.angle**3
        return best_scatter(near, self.noise, change**2 / phase.angle) / float(accelerations.max())


def hidden_angles(phase: Phase, noise: float, step: float) -> tuple[float, float]:
    """How much later a phase may begin, and how much sooner it may end [rad], so that no test can tell it.

    The rows of a motion that rests so much longer differ from the phase's, in the root of the sum of squares, by no
    more than twice :data:`CERTAINTY` times the noise: what the best test (J. Neyman, E. S. Pearson 1933) takes to err
    by as much on either side.

    >>> begins, ends = hidden_angles(Rise(10, 1.0, "4-5-6-7"), 0.01, math.radians(1))
    >>> round(math.degrees(begins), 1), begins == ends
    (7.7, True)
    """
    if isinstance(phase, Dwell):
        return 0.0, 0.0
    u, angles = np.linspace(0, 0.5, 5001), list[float]()
    for law in (phase.normalised, phase.normalised.reversed):
        squares = phase.angle / step * cumulative_trapezoid((phase.lift * law(u)[0]) ** 2, u, initial=0)
        angles.append(phase.angle * float(np.interp((2 * CERTAINTY * noise) ** 2, squares, u)))
    return angles[0], angles[1]


def best_scatter(x: Floats, noise: float, intensity: float) -> float:
    """The standard deviation of the acceleration at 0 in the best linear unbiased estimate from displacements at x.

    x : (n,) cam angles [rad] that grow, on both sides of 0
    noise : the standard deviation of the displacements
    intensity : of the jerk's steps: the mean square by which it changes over an angle, by this angle

    The state is (s, v, a, j), of which nothing is known at first; the jerk is a sum of independent steps.  So s is a
    cubic plus a process with the covariances below, and the best estimate is that of C. F. Gauss and A. A. Markov.

    >>> x = np.radians(np.arange(-10.0, 11.0))
    >>> fewer, more = best_scatter(x[::2], 0.01, 0.0), best_scatter(x, 0.01, 0.0)
    >>> round(fewer / more, 1)
    1.3
    """
    t, at = x - x[0], -float(x[0])
    apart, less = np.abs(t - t[:, None]), np.minimum(t, t[:, None])
    rows = less**7 / 7 + apart * less**6 / 2 + 3 * apart**2 * less**5 / 5 + apart**3 * less**4 / 4
    covariance = intensity / 36 * rows + noise**2 * np.eye(t.size)
    d = np.abs(t - at)
    before, after = t**5 / 5 + d * t**4 / 4, at**5 / 5 + 3 * d * at**4 / 4 + d**2 * at**3 + d**3 * at**2 / 2
    towards = intensity / 6 * np.where(t <= at, before, after)
    cubic = np.vander(t / t[-1], 4, increasing=True)
    wanted = np.array([0.0, 0.0, 2.0, 6.0 * at / t[-1]]) / t[-1] ** 2
    solved = np.linalg.solve(covariance, np.column_stack([cubic, towards]))
    missing = wanted - cubic.T @ solved[:, 4]
    unknown = missing @ np.linalg.solve(cubic.T @ solved[:, :4], missing)
    return math.sqrt(intensity * at**3 / 3 - towards @ solved[:, 4] + unknown)


def sampled_motions(n: int, seed: int = 0) -> Iterator[Sampled]:
    """Random motions of 2 to 6 phases by all laws, their tables at about 1 degree with all noises, even and uneven.

    >>> [len(one.motion.phases) for one in sampled_motions(4)]
    [6, 4, 6, 4]
    """
    for k in range(n):
        random = np.random.default_rng([seed, k])
        motion, noise = random_motion(random), NOISE_DEVIATIONS[k % len(NOISE_DEVIATIONS)]
        steps = (
            np.ones(TABLE_ROWS)
            if k // len(NOISE_DEVIATIONS) % 2 == 0
            else random.uniform(*UNEVEN_STEP_RANGE, TABLE_ROWS)
        )
        phi = (np.cumsum(steps) - steps) * FULL_TURN / np.sum(steps)
        yield Sampled(motion, noise, phi, motion(phi)[0] + noise * random.standard_normal(TABLE_ROWS))


def random_motion(random: np.random.Generator) -> Motion:
    """A motion of 2 to 6 phases, in which no two of a kind follow one another.

    >>> random_motion(np.random.default_rng(1)).starts.size
    4
    """
    n = int(random.integers(2, 7))
    while True:
        kinds = random.choice([1, -1, 0], n)
        if np.all(kinds != np.roll(kinds, 1)) and {1, -1} <= set(kinds.tolist()):
            lifts = np.zeros(n)
            height = random.uniform(LOWEST_ERROR, HIGHEST_ERROR)
            for kind in (1, -1):
                lifts[kinds == kind] = height * random.dirichlet(3 * np.ones(np.count_nonzero(kinds == kind)))
            if lifts[kinds != 0].min() >= LOWEST_ERROR:
                break
    angles = MIN_PHASE_ANGLE + random.dirichlet(2 * np.ones(n)) * (FULL_TURN - n * MIN_PHASE_ANGLE)
    if random.random() < 0.5:
        angles = np.radians(np.round(np.degrees(angles)))
        angles[-1] = FULL_TURN - np.sum(angles[:-1])
    return Motion([_phase(random, *one) for one in zip(kinds.tolist(), lifts.tolist(), angles.tolist(), strict=True)])


def _phase(random: np.random.Generator, kind: int, lift: float, angle: float) -> Phase:
    if not kind:
        return Dwell(angle)
    law: LawName = random.choice(DWELL_TO_DWELL_LAWS).item()
    ratio = float(random.uniform(*ACCELERATION_RATIOS)) if law == "rectangular" else 1.0
    return (Rise if kind > 0 else Return)(lift, angle, law, ratio)


MEASURED_SECTION = Section(
    "measured",
    say("Measured motions"),
    "Random motions of 2 to 6 phases by all laws, sampled at about 1 degree with noise, against the sampled motions. "
    "Noise hides an end as far as no test can distinguish the motions. The best linear estimate knows the jerk's usual "
    "change.",
    measured_rows,
)
