"""What may be wrong with a print, a camera, the light: drawn at random, each within what a classroom sees."""

from __future__ import annotations

from typing import Any

import numpy as np
from bent_paper import Bend
from camera import Scanner, aimed, rotation
from exposure import Sensor
from photograph import Shot
from printer import Placing, Printer

Rng = np.random.Generator
SIZES = {12: (4000, 3000), 5: (2592, 1944)}
"""Of pictures by megapixels; the shorter side of the paper lies along the shorter one of these."""
SCAN = 200 / 25.4
"""Pixels a mm."""
PRINTERS = (Printer(), Printer(106.0, 0.9, 0.95), Printer(0.0, 1.0, 0.9), Printer(170.0, 0.8, 1.0))
FOCAL = 26 / 36
"""Of most telephones, of the longer side of the picture."""


def random_placing(rng: Rng, *, scaled: bool = True) -> Placing:
    """A printer's scale from 0.985 to 1.015, not the same both ways; it shifts and turns the page a little.

    Every second printer keeps to 0.3 %.
    """
    both, other = rng.uniform(-1, 1) * rng.choice([0.002, 0.012]), rng.uniform(-1, 1) * rng.choice([0.001, 0.003])
    stretched = (1 + both + other, 1 + both - other) if scaled else (1.0, 1.0)
    shifted = complex(*rng.uniform(-1.5, 1.5, 2))
    return Placing(stretched, float(np.radians(rng.normal(0, 0.15))), shifted)


def random_sensor(rng: Rng, megapixels: int) -> Sensor:
    """Of a telephone: the smaller its picture, the older it is."""
    old = megapixels < 12
    white = tuple((1 + rng.uniform(-0.1, 0.1, 3)).tolist())
    return Sensor(
        blur=float(rng.uniform(0.6, 1.5)),
        moved=complex(rng.uniform(0, 2.0) * np.exp(1j * rng.uniform(0, np.pi))),
        noise=float(rng.uniform(0.008, 0.035 if old else 0.028)),
        reading=float(rng.uniform(0.002, 0.006)),
        white=(white[0], white[1], white[2]),
        colourful=float(rng.uniform(-0.1, 0.35)),
        smoothed=float(rng.uniform(0.8, 1.8)),
        sharpened=float(rng.uniform(0, 0.7)),
        quality=int(rng.integers(72, 94)),
    )


def random_bend(page: tuple[float, float], rng: Rng, kind: str) -> tuple[Bend, float]:
    """How the paper lies, and by how much it is bent."""
    middle = complex(*page) / 2
    towards = np.exp(1j * (rng.normal(0, 0.12) + (np.pi / 2 if rng.random() < 0.25 else 0)))
    reach = abs(towards.real) * page[0] / 2 + abs(towards.imag) * page[1] / 2
    if kind == "curl":
        lift = float(rng.uniform(2, 8))
        return Bend.curl(middle, towards, reach, lift * rng.choice([-1, 1], p=[0.2, 0.8]), rng.uniform(1, 2)), lift
    if kind == "strong curl":
        lift = float(rng.uniform(12, 18))
        return Bend.curl(middle, towards, reach, lift, rng.uniform(1, 2)), lift
    if kind == "fold":
        angle = float(rng.uniform(4, 15)) * rng.choice([-1, 1])
        return Bend.fold(middle, towards, (rng.uniform(-0.35, 0.35) * reach,), angle), abs(angle)
    if kind == "two folds":
        angle = float(rng.uniform(8, 15))
        return Bend.fold(middle, towards, (-0.4 * reach, 0.3 * reach), angle), angle
    return Bend.none(middle), 0.0


def random_shot(page: tuple[float, float], rng: Rng, megapixels: int, bend: str = "flat", **said: Any) -> Shot:
    """A photograph of a page; of no megapixels a scan.

    said : of the :class:`Shot`, what is not left to chance
    """
    placing = said.pop("placing", None) or random_placing(rng)
    if not megapixels:
        return _scan(page, rng, placing, **said)
    paper, _ = random_bend(page, rng, bend)
    size = SIZES[megapixels]
    upright = page[1] > page[0]
    # The telephone is held either way up; what it notes of that may be wrong.
    quarters = int(rng.choice([0, 2] if not upright else [1, 3]))
    tilt = rng.uniform(0, 30) * np.exp(1j * rng.uniform(0, 2 * np.pi))
    turned = rotation(tilt.real, tilt.imag, 90 * quarters + rng.normal(0, 2.5))
    lens = (float(rng.uniform(-0.09, 0.05)), float(rng.uniform(-0.02, 0.02)))
    focal = FOCAL * rng.uniform(0.92, 1.12)
    eye = aimed(
        page, size, turned, paper, focal=focal, lens=lens,
        fill=rng.uniform(0.86, 0.97), aside=complex(*rng.uniform(-0.8, 0.8, 2)),
    )  # fmt: skip
    fingers = said.pop("fingers", None)
    if fingers is None:
        fingers = random_fingers(page, rng, int(rng.choice([0, 1, 2], p=[0.6, 0.25, 0.15])))
    noted = int(rng.choice([0, (4 - quarters) % 4 if rng.random() < 0.9 else int(rng.integers(4))]))
    return Shot(
        eye,
        paper,
        placing,
        said.pop("sensor", None) or random_sensor(rng, megapixels),
        quarters=noted,
        shadows=int(rng.integers(0, 3)),
        fingers=fingers,
        focal=focal if rng.random() < 0.7 else 0.0,
        **said,
    )


def random_fingers(page: tuple[float, float], rng: Rng, count: int) -> tuple[tuple[complex, complex], ...]:
    """Fingers that hold the paper at its border, from below or from either side."""
    width, height = page
    found: list[tuple[complex, complex]] = []
    for _ in range(count):
        place, deep = rng.uniform(0.12, 0.88), rng.uniform(6, 16)
        low, left, right = place * width + deep * 1j, deep + place * height * 1j, width - deep + place * height * 1j
        tip, outwards = ((low, -1j), (left, -1 + 0j), (right, 1 + 0j))[rng.integers(3)]
        found.append((tip, outwards * np.exp(1j * rng.normal(0, 0.25))))
    return tuple(found)


def _scan(page: tuple[float, float], rng: Rng, placing: Placing, **said: Any) -> Shot:
    per_mm = SCAN * (1 + rng.uniform(-0.002, 0.002, 2))
    size = (int(page[0] * SCAN) + 1, int(page[1] * SCAN) + 1)
    corner = complex(*rng.uniform(-4, 4, 2)) + 1j * (size[1] - 1)
    eye = Scanner(size, (float(per_mm[0]), float(per_mm[1])), float(np.radians(rng.normal(0, 0.5))), corner)
    sensor = Sensor(
        blur=float(rng.uniform(0.4, 0.8)), noise=float(rng.uniform(0.005, 0.02)), quality=int(rng.integers(80, 95))
    )
    said.setdefault("grey", bool(rng.random() < 0.5))
    return Shot(eye, Bend.none(complex(*page) / 2), placing, sensor, **said)
