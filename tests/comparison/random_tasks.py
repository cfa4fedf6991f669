"""Tasks drawn at random: all followers and laws, both rotations, sizes given or open, 6 to 24 parts a phase."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphcam.comparison.quantities import Quantity
from graphcam.given.laws import DWELL_TO_DWELL_LAWS
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import (
    CamTable,
    DrawingTable,
    FlatFacedTable,
    LimitsTable,
    OscillatingTable,
    Task,
    TranslatingTable,
)

SHAPES = (("rise", "dwell", "return", "dwell"), ("rise", "return"), ("dwell", "rise", "rise", "dwell", "return"))
"""Phases of a turn; of the last the second rise goes on where the first one stopped."""


def random_task(seed: int, law: str | None = None) -> Task:
    """A task that depends on the seed alone: coursework sizes, every option left open or given."""
    random = np.random.default_rng(seed)
    return Task(
        rotation=random.choice(["cw", "ccw"]).item(),
        motion=_motion(random, law),
        follower=TranslatingTable(
            offset=random.choice([None, 0.0, round(random.uniform(-15, 15), 1)]),
            roller_radius=random.choice([None, None, 0.0, 5.0]),
        ),
        cam=CamTable(random.choice([None, None, round(random.uniform(40, 90))])),
        limits=LimitsTable(
            pressure_angle_rise=random.uniform(25, 45),
            pressure_angle_return=random.choice([None, random.uniform(30, 60)]),
            rest=bool(random.integers(2)),
        ),
        drawing=DrawingTable(divisions=int(random.integers(6, 25)), ordinate=60.0),
    )


def flips(quantity: Quantity) -> bool:
    """Whether a signed greatest is compared with one on the other side, or its bound reaches over there."""
    # What is less than a degree may lie on either side without a flip.
    reach = max(abs(quantity.error), quantity.tolerance_paper * abs(quantity.per_mm))
    return reach > max(0.25 * abs(quantity.exact), 1.0)


def random_arm_task(seed: int) -> Task:
    """An arm of 100 mm that swings by 5 to 30 degrees; distance, prime radius and roller are given or left open."""
    random = np.random.default_rng([seed, 1])
    distance = random.choice([None, None, round(random.uniform(110, 150))])
    # A given radius meets the arm from a given distance; the one that is proposed may be too far away.
    prime_radius = None if distance is None else random.choice([None, round(random.uniform(58, 75))])
    return Task(
        rotation=random.choice(["cw", "ccw"]).item(),
        motion=_motion(random, None, lifts=(5, 30)),
        follower=OscillatingTable(
            arm=100.0,
            distance=distance,
            roller_radius=random.choice([None, None, 0.0, 3.0]),
        ),
        cam=CamTable(prime_radius),
        limits=LimitsTable(
            pressure_angle_rise=random.uniform(40, 60),
            pressure_angle_return=random.choice([None, random.uniform(40, 70)]),
            rest=bool(random.integers(2)),
        ),
        drawing=DrawingTable(divisions=int(random.integers(6, 25)), ordinate=60.0),
    )


def random_flat_task(seed: int) -> Task:
    """A flat face that lifts by 5 to 40 mm; prime radius and least curvature are given or left open."""
    random = np.random.default_rng([seed, 2])
    return Task(
        rotation=random.choice(["cw", "ccw"]).item(),
        motion=_motion(random, None, lifts=(5, 40)),
        follower=FlatFacedTable(),
        cam=CamTable(random.choice([None, None, round(random.uniform(60, 120))])),
        limits=LimitsTable(min_curvature_radius=random.choice([None, random.uniform(3, 15), 20.0])),
        drawing=DrawingTable(divisions=int(random.integers(6, 25)), ordinate=60.0),
    )


def random_coursework(seed: int) -> Task:
    """A task as it is set: rounded angles and sizes, dwells, an arm of 60 to 120 mm or an offset, 8 to 24 parts."""
    random = np.random.default_rng([seed, 77])
    angles = random.dirichlet(np.full(4, 6.0)).round(3) * 360
    angles[-1] = 360 - angles[:-1].sum()
    arm = bool(random.integers(3))
    lift = round(random.uniform(5, 30 if arm else 50), 1)
    rise, high, back, low = angles.tolist()
    laws = random.choice(list(DWELL_TO_DWELL_LAWS), 2).tolist()
    phases = RiseTable(rise, lift, laws[0]), DwellTable(high), ReturnTable(back, lift, laws[1]), DwellTable(low)
    offset = random.choice([None, 0.0, round(random.uniform(-15, 15), 1)])
    distance = random.choice([None, None, float(random.integers(70, 150))])
    least, most = (30, 60) if arm else (20, 45)
    return Task(
        rotation=random.choice(["cw", "ccw"]).item(),
        motion=MotionTable(phases),
        follower=OscillatingTable(float(random.integers(60, 121)), distance) if arm else TranslatingTable(offset),
        limits=LimitsTable(
            pressure_angle_rise=float(random.integers(least, most + 1)),
            pressure_angle_return=random.choice([None, float(random.integers(least + 5, most + 11))]),
        ),
        drawing=DrawingTable(divisions=random.choice([8, 10, 12, 12, 12, 16, 24]).item()),
    )


def _motion(random: np.random.Generator, law: str | None, lifts: tuple[float, float] = (10, 50)) -> MotionTable:
    kinds = SHAPES[random.integers(len(SHAPES))]
    angles = random.dirichlet(np.full(len(kinds), 6.0)) * 360
    angles[-1] = 360 - angles[:-1].sum()
    total = round(random.uniform(*lifts), 1)
    shares = {"rise": 1 / kinds.count("rise"), "return": 1.0}
    phases = [
        DwellTable(angle) if kind == "dwell" else _moving(random, kind, angle, total * shares[kind], law)
        for kind, angle in zip(kinds, angles.tolist(), strict=True)
    ]
    return MotionTable(tuple(phases))


def _moving(random: np.random.Generator, kind: str, angle: float, lift: float, law: str | None):
    name = law or DWELL_TO_DWELL_LAWS[random.integers(len(DWELL_TO_DWELL_LAWS))]
    table = {"rise": RiseTable, "return": ReturnTable}[kind](angle, lift, name)
    return replace(table, ratio=round(random.uniform(0.5, 2), 2)) if name == "rectangular" else table
