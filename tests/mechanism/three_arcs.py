"""Cams of three arcs for tests: published data, and sound ones at random, built forwards from A to D."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np

CASE = tomllib.loads((Path(__file__).parents[1] / "data" / "cases.toml").read_text(encoding="utf-8"))["three_arcs"]
EXAMPLE = {name: CASE[name] for name in ("D", "G", "rho1", "A", "C1", "C2")}


def sound_data(count: int, seed: int = 0) -> Iterator[dict]:
    """Data of sound cams, complete: arc after arc, each turning its normal on by an angle and ending on the next."""
    random = np.random.default_rng(seed)
    while count:
        base, q = random.uniform(10, 60), random.uniform(5, 400)
        rho1, rho2 = random.uniform(1, 20), base + q
        rho3 = random.uniform(1.05 * rho1, 0.95 * rho2) if rho2 > 1.2 * rho1 else 0.0
        at_g, at_f = np.cumsum(random.uniform(0.02, 0.7, 2))
        mirror, turn = random.choice([-1, 1]), np.exp(1j * random.uniform(0, 2 * np.pi))
        n2, n3 = (1j * np.exp(-1j * angle) for angle in (at_g, at_f))  # clockwise from A above the centre
        c2 = -1j * q
        g = c2 + rho2 * n2
        c3 = g - rho3 * n2
        c1 = c3 + (rho3 - rho1) * n3
        at_d = np.pi / 2 - np.angle(c1)
        d = c1 * (1 + rho1 / abs(c1))
        if not (rho3 and at_f + 0.02 < at_d < 3 and abs(d) > base + 0.5 and rho1 < abs(d)):
            continue
        count -= 1

        def placed(z: complex, mirror=mirror, turn=turn) -> tuple[float, float]:
            z = turn * complex(mirror * z.real, z.imag)
            return z.real, z.imag

        yield {"D": placed(d), "G": placed(g), "rho1": rho1, "A": placed(1j * base), "C1": placed(c1),
               "C2": placed(c2), "C3": placed(c3), "F": placed(c1 + rho1 * n3)}  # fmt: skip


def given(data: dict, *left_out: str) -> dict:
    """The arguments among the data, but for those that are left out."""
    return {name: data[name] for name in ("D", "G", "rho1", "A", "C1", "C2") if name not in left_out}
