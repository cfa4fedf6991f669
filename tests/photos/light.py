"""Two lights of different colours over a table, the shadows in them, the table itself, and fingers."""

from __future__ import annotations

import cv2
import numpy as np
from bent_paper import Bend, Points
from camera import Eye, NDFloat32, SeenPlaces, Size

Rng = np.random.Generator
DAYLIGHT, LAMP = (1.15, 1.0, 0.88), (0.6, 1.0, 1.32)
"""Blue, green, red."""
COARSE = 8
"""Light is computed for squares of so many pixels."""
SKINS = ((0.30, 0.42, 0.62), (0.22, 0.33, 0.55), (0.08, 0.13, 0.25), (0.36, 0.46, 0.68))
TABLES = ((0.10, 0.20, 0.34), (0.05, 0.09, 0.15), (0.42, 0.44, 0.45), (0.16, 0.15, 0.14), (0.14, 0.12, 0.10))
"""Wood, dark wood, a white table, stone, cloth: blue, green, red, linear."""


def lit(size: Size, seen: SeenPlaces, bend: Bend, rng: Rng, *, shadows: int = 2, dim: float = 1.0) -> NDFloat32:
    """The light (rows, columns, 3) on what is seen; the paper's middle has about ``dim``.

    shadows : of the telephone and the head: hard in the one light, soft in the other
    """
    # Of every so many pixels in both directions one.
    across, up = (part[::COARSE, ::COARSE] for part in seen.fine)
    x, y = np.meshgrid(*(np.linspace(-1, 1, n, dtype=np.float32) for n in across.shape[::-1]))
    around = rng.uniform(0, 2 * np.pi, 4)
    day = 0.5 * (1 + 0.2 * (np.cos(around[0]) * x + np.sin(around[0]) * y))
    lamp = 0.5 * (1 + 0.32 * (np.cos(around[1]) * x + np.sin(around[1]) * y) - 0.1 * (x * x + y * y))
    for light, sharp, angle in ((lamp, 55.0, around[2]), (day, 14.0, around[3]))[:shadows]:
        edge = x * np.cos(angle) + 0.8 * y * np.sin(angle) + 0.06 * np.sin(3 * y + angle) - rng.uniform(-0.4, 0.6)
        light *= 1 - rng.uniform(0.25, 0.6) / (1 + np.exp(-edge * sharp))
    both = day[..., None] * np.array(DAYLIGHT, np.float32) + lamp[..., None] * np.array(LAMP, np.float32)
    if not bend.flat:
        # A slope turns the paper towards the one light and away from the other.
        slope = np.clip(bend.slopes(across + 1j * up), -0.5, 0.5).astype(np.float32)
        both *= 1 + rng.uniform(-0.6, 0.6) * np.sin(slope)[..., None]
    # The lens gives its corners less.
    both *= (1 - rng.uniform(0.05, 0.2) * (x * x + y * y))[..., None]
    return cv2.resize(both * np.float32(dim), size, interpolation=cv2.INTER_LINEAR)


def table(size: Size, rng: Rng) -> NDFloat32:
    """The table (rows, columns, 3) that the paper lies on: grain, knots, and some things on it."""
    width, height = size[0] // 2, size[1] // 2
    base = np.array(TABLES[rng.integers(len(TABLES))], np.float32) * rng.uniform(0.7, 1.3)
    stretch = rng.uniform(4, 40)
    picture = np.ones((height, width), np.float32)
    for cells, much in ((6, 0.25), (40, 0.2), (240, 0.14)):
        noise = rng.standard_normal((max(2, int(cells * height / width)), max(2, int(cells / stretch) + 2)), np.float32)
        picture += much * cv2.resize(noise, (width, height), interpolation=cv2.INTER_CUBIC)
    picture += 0.06 * cv2.GaussianBlur(rng.standard_normal(picture.shape, np.float32), (0, 0), 1.2)
    if rng.random() < 0.5:
        picture = np.ascontiguousarray(picture[::-1])
    colour = np.clip(picture, 0.15, 2.2)[..., None] * base
    for _ in range(int(rng.integers(0, 4))):
        corner, sides, angle = rng.uniform(0, 1, 2) * (width, height), rng.uniform(60, 500, 2), rng.uniform(0, 90)
        thing = cv2.boxPoints((corner.tolist(), sides.tolist(), float(angle)))
        cv2.fillPoly(colour, [np.round(thing).astype(np.int32)], rng.uniform(0.02, 0.8, 3).tolist(), cv2.LINE_AA)
    return cv2.resize(colour, size, interpolation=cv2.INTER_LINEAR)


def with_fingers(picture: NDFloat32, eye: Eye, tips: list[tuple[complex, complex]], rng: Rng) -> None:
    """Lay fingers over a picture (rows, columns, 3) of linear light.

    tips : of every finger where it ends on the paper, and its direction from there, out of the paper
    """
    skin = np.array(SKINS[rng.integers(len(SKINS))], np.float32)
    for tip, outwards in tips:
        thick = rng.uniform(13, 18)
        spine = tip + outwards * np.linspace(0, 90, 24)
        seen = eye.pixels(spine)
        per_mm = float(np.abs(seen[1] - seen[0]) / np.abs(spine[1] - spine[0]))
        _laid(picture, seen, thick * per_mm, skin * rng.uniform(0.8, 1.1), rng)


def _laid(picture: NDFloat32, spine: Points, thick: float, skin: NDFloat32, rng: Rng) -> None:
    height, width = picture.shape[:2]
    # Its shadow ends well within.
    low = np.floor([spine.real.min() - 2.5 * thick, spine.imag.min() - 2.5 * thick]).astype(int)
    high = np.ceil([spine.real.max() + 2.5 * thick, spine.imag.max() + 2.5 * thick]).astype(int)
    (left, top), (right, bottom) = np.clip(low, 0, [width, height]), np.clip(high, 0, [width, height])
    if right - left < 4 or bottom - top < 4:
        return
    fine = 4
    mask = np.zeros(((bottom - top) // fine + 1, (right - left) // fine + 1), np.uint8)
    way = np.round(np.stack([spine.real - left, spine.imag - top], -1) / fine).astype(np.int32)
    cv2.polylines(mask, [way], False, 255, max(1, round(thick / fine)), cv2.LINE_AA)
    near = cv2.GaussianBlur(mask, (0, 0), thick / fine / 7).astype(np.float32) / 255
    round_ = cv2.GaussianBlur(mask, (0, 0), thick / fine / 3.2).astype(np.float32) / 255
    skin_grain = cv2.GaussianBlur(rng.standard_normal(mask.shape, np.float32), (0, 0), 3)
    shade = np.clip(0.25 + 1.1 * round_, 0, 1.15) * (1 + 0.3 * skin_grain)
    dropped = cv2.GaussianBlur(mask, (0, 0), thick / fine / 2).astype(np.float32) / 255
    size = (int(right - left), int(bottom - top))
    near, shade, dropped = (cv2.resize(each, size, interpolation=cv2.INTER_LINEAR) for each in (near, shade, dropped))
    alpha = np.clip(near * 2.2 - 0.6, 0, 1)[..., None]
    part = picture[top:bottom, left:right]
    part *= (1 - 0.35 * dropped)[..., None]
    part += alpha * (shade[..., None] * skin - part)
