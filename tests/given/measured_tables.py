"""Random measured tables with reading noise, run-out and jumps: which dwells are found, and which are lost or false.

``python tests/given/measured_tables.py --cases 500 --seed 1``, of dense rows with ``--step 0.1``, prints a line for
each law, kind of table and step of the rows: how many dwells were found, how many of these have an end that is off by
more than noise hides, how many were lost, how many were found where there is none, and how many tables were refused.
For as many lobes of arcs under a flat face, whose acceleration jumps, it prints how many are smoothed to a motion
that is undercut, for how many that is told as a fact though it is false, and how many are told of those that are
truly undercut by half a millimetre.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphcam.bench.measured_rows import hidden_angles
from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced
from graphcam.given.laws import Floats
from graphcam.given.measured import NOISE_TOLERANCE, MeasuredMotion, measured_motion
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Phase, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.within_rows import rows_tell
from graphcam.solving.solution_warnings import profile_speed

LAWS = "rectangular", "cosine", "2-3", "3-4-5", "cycloidal", "modified-trapezoidal", "4-5-6-7"
KINDS = "four decimals", "noise 0.1 %", "noise 0.3 %", "noise 1 %", "ruler 0.5 mm", "run-out"
STEPS = {"ruler 0.5 mm": (5.0, 10.0)}
USUAL_STEPS = 1.0, 0.5
HIDDEN_ROWS = 3
"""The end of a dwell may be off by so many rows, or by what the noise hides."""


@dataclass(frozen=True, eq=False)
class MeasuredTable:
    """A table, and the motion that it was made of.

    noise : what a row may be off by, its standard deviation [mm];  step : of the rows [degrees]
    """

    motion: Motion
    law: str
    kind: str
    step: float
    noise: float
    tolerance: float
    phi: Floats
    s: Floats

    @property
    def dwells(self) -> list[tuple[float, float]]:
        """Where the motion dwells [rad]."""
        return _dwells(self.motion, 0.0)

    def measured(self) -> MeasuredMotion:
        """What graphcam makes of the table."""
        return measured_motion(self.phi, self.s, self.tolerance)

    def hidden(self) -> float:
        """How far the end of a dwell may be off [rad]."""
        step = FULL_TURN / self.phi.size
        moving = [phase for phase in self.motion.phases if not isinstance(phase, Dwell)]
        return max(HIDDEN_ROWS * step, *(max(hidden_angles(phase, self.noise, step)) for phase in moving))


def _dwells(motion: Motion, zero: float) -> list[tuple[float, float]]:
    found = [(start + zero, end + zero) for kind, start, end in motion.timing if kind == "dwell"]
    if len(found) > 1 and abs(found[-1][1] - found[0][0] - FULL_TURN) < 1e-9:
        found = [(found[-1][0], found[0][1] + FULL_TURN), *found[1:-1]]
    return found


def random_table(seed: int, k: int, given_step: float = 0.0) -> MeasuredTable:
    """Table k of a seed: 1 to 3 dwells of 30 degrees or more among rises and returns of one law.

    given_step : of the rows [degrees], instead of a random one

    >>> random_table(1, 0).kind
    'four decimals'
    """
    random = np.random.default_rng([seed, k])
    kind, law = KINDS[k % len(KINDS)], LAWS[k // len(KINDS) % len(LAWS)]
    step = float(random.choice(STEPS.get(kind, USUAL_STEPS)))
    step = given_step or step
    motion = _random_motion(random, law)
    phi = np.radians(np.arange(0.0, 360.0, step))
    s = motion(phi)[0]
    if kind == "run-out":
        off = float(random.uniform(0.1, 0.5))  # of the tolerance
        tolerance = 0.1
        s = np.round(s + off * tolerance * np.sin(phi - random.uniform(0, FULL_TURN)), 4)
        return MeasuredTable(motion, law, kind, step, off * tolerance, tolerance, phi, s)
    if kind == "ruler 0.5 mm":
        noise = 0.5 / math.sqrt(12)
        s = np.round(s / 0.5) * 0.5
    elif kind == "four decimals":
        noise, s = 1e-4 / math.sqrt(12), np.round(s, 4)
    else:
        noise = float(kind.split()[1]) / 100 * motion.lift
        s = s + noise * random.standard_normal(phi.size)
    return MeasuredTable(motion, law, kind, step, noise, max(NOISE_TOLERANCE * noise, 0.002), phi, s)


def _random_motion(random: np.random.Generator, law: str) -> Motion:
    """Rises and returns with one to three dwells; every lift is a third of the motion's or more."""
    lift = float(random.uniform(15, 40))
    shapes = ("RDED", "RED", "RDE", "RDRDED", "RDEDED", "RDRED")
    shape = shapes[int(random.integers(len(shapes)))]
    angles = 30 + random.dirichlet(2 * np.ones(len(shape))) * (360 - 30 * len(shape))
    angles = np.where([one == "D" for one in shape], angles, np.maximum(angles, 50))
    angles = np.radians(angles * 360 / np.sum(angles))
    lifts = {kind: lift / shape.count(kind) for kind in "RE"}
    made: dict[str, type[Rise] | type[Return]] = {"R": Rise, "E": Return}
    phases: list[Phase] = [
        Dwell(angle) if kind == "D" else made[kind](lifts[kind], angle, law)
        for kind, angle in zip(shape, angles.tolist(), strict=True)
    ]
    return Motion(phases)


def outcome(table: MeasuredTable) -> Counter[str]:
    """How many dwells of a table are found, of these with an end that is off, lost and false; or that it is refused."""
    try:
        motion = table.measured()
    except DesignError:
        return Counter(refused=1)
    found = _dwells(motion, motion.zero)
    count, hidden = Counter[str](), table.hidden()
    for begin, end in table.dwells:
        beside = [one for one in found if _common(one, (begin, end)) > 0.5 * (end - begin)]
        count["found" if beside else "lost"] += 1
        away = [abs(math.remainder(a - b, FULL_TURN)) for one in beside for a, b in zip(one, (begin, end), strict=True)]
        count["off"] += bool(beside) and max(away) > hidden
    for one in found:
        count["false"] += not any(_common(one, true) > 0 for true in table.dwells)
    return count


def _common(one: tuple[float, float], other: tuple[float, float]) -> float:
    """The angle that two intervals have in common, whatever turn they are told in."""
    turns = [(other[0] + k * FULL_TURN, other[1] + k * FULL_TURN) for k in (-2, -1, 0, 1, 2)]
    return max(min(one[1], end) - max(one[0], begin) for begin, end in turns)


def outcomes(cases: int, seed: int, step: float = 0.0) -> Iterator[tuple[MeasuredTable, Counter[str]]]:
    """The tables of a seed, and what came of each; ``step`` of the rows [degrees], 0 for the usual ones."""
    for k in range(cases):
        table = random_table(seed, k, step)
        yield table, outcome(table)


def lobe(phi: Floats, base: float, nose: float, distance: float, flank: float) -> Floats:
    """The displacement of a flat face on a lobe of arcs whose top lies at half a turn [mm].

    base, nose, flank : radii [mm], the flank's circle touches the others inside;  distance : of the nose's centre
    """
    # The centre of the flank's circle: as far from both others' centres as its radius exceeds theirs.
    a, b = flank - base, flank - nose
    along = (a * a - b * b + distance * distance) / (2 * distance)
    centre = complex(along, -math.sqrt(a * a - along * along))
    from_top = np.abs(np.mod(phi, FULL_TURN) - math.pi)
    to_flank, to_nose = np.angle(-centre), np.angle(distance - centre)
    on_flank = (np.conj(centre) * np.exp(1j * from_top)).real + flank
    on_nose = distance * np.cos(from_top) + nose
    return np.where(from_top > to_flank, base, np.where(from_top > to_nose, on_flank, on_nose)) - base


def lobe_outcome(seed: int, k: int) -> Counter[str]:
    """Of a lobe: whether it is smoothed to an undercut, whether this is told as a fact, and whether a true one is."""
    random = np.random.default_rng([seed, k, 7])
    base, nose, flank = random.uniform(10, 20), random.uniform(0.5, 4), random.uniform(30, 90)
    distance = base - nose + random.uniform(4, 10)
    phi = np.radians(np.arange(0, 360, float(random.choice([0.5, 1.0, 2.0]))))
    decimals = int(random.choice([3, 4, 5]))
    s = np.round(lobe(phi, base, nose, distance, flank), decimals)
    motion = measured_motion(phi, s, max(float(random.choice([0.002, 0.01, 0.03])), 4 * 10.0**-decimals))
    count = Counter(lobes=1)
    # On a smaller base circle the whole lobe is a parallel curve, whose nose is turned inside out.
    for smaller, name in ((0.0, "false"), (0.5 + nose, "told")):
        cam = Cam(motion, FlatFaced(), base - smaller)
        undercut = bool(cam.undercuts())
        count["smoothed"] += undercut and not smaller
        count[name] += undercut and rows_tell(motion, profile_speed(cam))
    return count


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--step", type=float, default=0.0, help="of the rows, in degrees, instead of the usual ones")
    asked = parser.parse_args(arguments)
    total: dict[tuple[str, ...], Counter[str]] = {}
    for table, count in outcomes(asked.cases, asked.seed, asked.step):
        for key in ((table.law, table.kind, f"{table.step:g}"), ("all", table.kind, ""), ("all", "", "")):
            total.setdefault(key, Counter()).update(count)
    columns = "found", "off", "lost", "false", "refused"
    head = "".join(f"{name:22}" for name in ("law", "table", "step, degrees")) + "".join(f"{c:>9}" for c in columns)
    lines = ["".join(f"{name:22}" for name in key) + "".join(f"{n[c]:9}" for c in columns) for key, n in total.items()]
    sys.stdout.write("\n".join([head, *sorted(lines)]) + "\n")
    lobes = sum((lobe_outcome(asked.seed, k) for k in range(asked.cases)), Counter[str]())
    sys.stdout.write(
        f"{lobes['lobes']} lobes: {lobes['smoothed']} smoothed to an undercut, {lobes['false']} told as a fact; "
        f"undercut by 0.5 mm, {lobes['told']} told\n"
    )
    whole = total["all", "", ""]
    return bool(whole["lost"] or whole["false"] or lobes["false"])


if __name__ == "__main__":
    raise SystemExit(main())
