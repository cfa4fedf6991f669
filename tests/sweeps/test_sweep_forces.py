"""Forces of many cams at once: against one cam after the other by the exact side."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from sweeps.test_sweep import same_bits, some_arms, some_designs

import graphcam as gc
from graphcam.sweeps.sweep_forces import FORCE_QUANTITIES

SLIDING = gc.SpringLoad(mass=0.3, speed_rpm=250, stiffness=3, preload=120, acceleration=20, load=15)
TORSION = gc.ArmLoad(inertia=900, speed_rpm=250, stiffness=4000, preload=9000, acceleration=-20, load=5)
AT_A_POINT = gc.ArmLoad(900, 250, stiffness=4, preload=120, load=5, at=gc.ArmSpring(30.0, (60.0, -200.0)))


def flat(n: int) -> gc.Designs:
    random = np.random.default_rng(4)
    return gc.Designs(
        follower="flat-faced", lift=random.uniform(5, 30, n), rise_angle=1.6, dwell_angle=0.4, return_angle=1.8,
        prime_radius=random.uniform(30, 90, n), rise_law="cycloidal",
    )  # fmt: skip


LAWS = {"rise_law": "rectangular", "return_law": "cycloidal"}
CASES = {
    "sliding": (replace(some_designs(16, seed=7), return_law="modified-sine"), SLIDING),
    "torsion": (replace(some_arms(12, seed=8), **LAWS), TORSION),
    "at a point": (replace(some_arms(24, seed=9), **LAWS), AT_A_POINT),
    "flat": (flat(6), SLIDING),
}
EVERY = pytest.mark.parametrize("case", CASES)


def one_by_one(designs: gc.Designs, load, friction: float) -> dict[str, np.ndarray]:
    rows = []
    for k in range(len(designs)):
        row = dict.fromkeys(FORCE_QUANTITIES, math.nan)
        try:
            cam = designs.cam(k)
            row["jamming_margin"] = gc.jamming_margin(cam, friction).value
            row["least_preload"] = gc.spring_preload(cam, load).preload
            forces = gc.CamForces(cam, load, friction=friction)
            row["max_normal_force"], row["min_normal_force"] = forces.max_normal()[0], forces.min_normal()[0]
            row["max_torque"] = forces.max_torque().value
        except gc.DesignError as error:
            if error.quantity == "at.anchor":
                row = dict.fromkeys(FORCE_QUANTITIES, math.nan)
        rows.append(row)
    return {name: np.array([row[name] for row in rows]) for name in FORCE_QUANTITIES}


@pytest.mark.parametrize(("case", "friction"), [*((case, 0.15) for case in CASES), ("sliding", 0.0)])
def test_every_force_is_that_of_its_cam(case, friction):
    designs, load = CASES[case]
    found, there = (
        gc.sweep(designs, FORCE_QUANTITIES, load=load, friction=friction),
        one_by_one(designs, load, friction),
    )
    for name in FORCE_QUANTITIES:
        same = np.isnan(there[name]) == np.isnan(found[name])
        assert same.all(), (name, np.flatnonzero(~same))
        known = ~np.isnan(there[name])
        assert known.sum() > 3
        size = np.maximum(np.abs(there[name]), 1e-3 * np.nanmax(np.abs(there[name])))
        assert np.max(np.abs(found[name] - there[name])[known] / size[known]) < 1e-12, name


@EVERY
def test_the_bits_depend_on_no_chunk(case):
    designs, load = CASES[case]
    whole = gc.sweep(designs, FORCE_QUANTITIES, load=load, friction=0.1)
    assert same_bits(whole, gc.sweep(designs, FORCE_QUANTITIES, load=load, friction=0.1, chunk=7))


@pytest.mark.parametrize(
    ("load", "friction", "words"),
    [
        (None, 0.0, "load left out max_torque SpringLoad"),
        (TORSION, 0.0, "load ArmLoad a SpringLoad slide"),
        (SLIDING, -1.0, "friction -1.0 0 or more"),
        (gc.SpringLoad(1, 1, 1, load=gc.LoadCurve([0, math.tau], [1, 1])), 0.0, "load table a number in a sweep"),
    ],
)
def test_what_no_sweep_can_take_is_named(load, friction, words):
    with pytest.raises(gc.DesignError) as caught:
        gc.sweep(CASES["flat"][0], ["max_torque"], load=load, friction=friction)
    assert all(word in str(caught.value) for word in words.split())
