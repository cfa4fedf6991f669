"""A page on two sheets of A4, taped together a little awry and photographed one after the other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from bent_paper import Bend, Points
from camera import aimed, rotation
from measuring import QUANTILES, picture_of
from nuisances import FOCAL, SIZES, random_sensor
from pencil import FULL, Light
from photograph import Shot, photographed
from printed_courses import CourseKind, course_of
from printer import PER_MM

from graphcam.constructions.views import PROFILE
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import SIDE_NAMES, Side
from graphcam.photo.tags import find_tags
from graphcam.photo.taped_tiles import Tile, joined_tiles, registered_tiles

KIND = CourseKind("inversion-translating", "A3-tiles", "colour", ("17", "18"))
SLIP, TURN = 0.5, 0.15
"""Standard deviations of how far from its place the right sheet is taped [mm, degrees]."""
BEYOND = 42.0
"""mm of the other sheet that a photograph shows: its tags near the seam."""
ON_THE_SEAM = 3.0
"""mm to the right of the seam, where both photographs are compared."""


def tiles_measured(number: int, seed: int, scratch: Path) -> dict[str, Any]:
    """How far two photographs of one page are off at the seam, and the right one beyond it."""
    rng = np.random.default_rng([seed, number])
    megapixels = int(rng.choice([12, 5]))
    found: dict[str, Any] = {"number": number, "kind": "tiles", "megapixels": megapixels, "bend": "flat"}
    course = course_of(KIND, scratch)
    student = KIND.students[rng.integers(len(KIND.students))]
    page_number, page = course.page(student, PROFILE.name)
    seam = page.seam or 0.0
    sheets = [course.print_of_file(student, 2 * (page_number - 1) + side, scratch)[0] for side in (0, 1)]
    turn = np.exp(1j * np.radians(rng.normal(0, TURN)))
    shift = complex(rng.uniform(0, 2 * SLIP), rng.normal(0, SLIP))
    light = taped(sheets[0], sheets[1], seam, page.height, turn, shift)
    paper = (page.width, page.height)
    shots = [_shot(paper, shown, megapixels, rng) for shown in ((0.0, seam + BEYOND), (seam - BEYOND, page.width))]
    tiles: dict[Side, Tile] = {}
    try:
        for side, shot in zip(SIDE_NAMES, shots, strict=True):
            picture = picture_of(photographed(light, paper, PER_MM, shot, rng), scratch / f"{number}-{side}.jpg")
            tags = find_tags(np.asarray(cv2.cvtColor(picture.pixels, cv2.COLOR_BGR2GRAY), np.uint8))
            tiles[side] = registered_tiles(picture.pixels, tags, page, picture.focal)[side]
        tiles = dict(joined_tiles(tiles, page))
    except (PhotographError, KeyError) as error:
        return found | {"refused": "photo", "why": repr(error)[:120]}
    found["slip"] = round(abs(shift), 2)
    heights = np.arange(30.0, page.height - 30, 5.0)
    near = seam + ON_THE_SEAM + 1j * heights
    seen = [
        tiles[side].registration.millimetres(shot.pixels(near)) for side, shot in zip(SIDE_NAMES, shots, strict=True)
    ]
    far = seam + np.linspace(10, 190, 10)[:, None] + 1j * heights
    off = np.abs(tiles["right"].registration.millimetres(shots[1].pixels(far)) - far)
    for name, errors in (("seam", np.abs(seen[0] - seen[1])), ("beyond", off)):
        found[name] = np.round(np.quantile(errors, QUANTILES), 4).tolist()
    return found


def taped(left: Light, right: Light, seam: float, height: float, turn: complex, shift: complex) -> Light:
    """Both prints on one paper (rows, columns, 3): the right one turned about its lower left corner, then shifted."""
    rows, columns = round(height * PER_MM), round(2 * seam * PER_MM)
    found = np.full((rows, columns, 3), 255, np.uint8)
    found[: left.shape[0], : left.shape[1]] = left[:rows]
    # From a pixel (column, row) of the right print to one of the paper, by three of its points.
    corners = np.array([0j, 100 + 0j, 100j])
    there = seam + corners * turn + shift
    matrix = cv2.getAffineTransform(_pixels(corners, height), _pixels(there, height))
    border = cv2.BORDER_CONSTANT
    beside = cv2.warpAffine(
        right, matrix, (columns, rows), flags=cv2.INTER_LINEAR, borderMode=border, borderValue=(0, 0, 0)
    )
    inside = cv2.warpAffine(np.full(right.shape[:2], 255, np.uint8), matrix, (columns, rows), borderMode=border)
    found[inside > 254] = beside[inside > 254]
    return found.astype(np.uint16) * np.uint16(FULL // 255)


def _pixels(points: Points, height: float) -> np.ndarray[Any, np.dtype[np.float32]]:
    places = np.stack([points.real * PER_MM - 0.5, (height - points.imag) * PER_MM - 0.5], axis=-1)
    return places.astype(np.float32)


def _shot(paper: tuple[float, float], across: tuple[float, float], megapixels: int, rng: np.random.Generator) -> Shot:
    bend = Bend.none(complex(*paper) / 2)
    tilt = rng.uniform(0, 18) * np.exp(1j * rng.uniform(0, 2 * np.pi))
    eye = aimed(
        paper, SIZES[megapixels], rotation(tilt.real, tilt.imag, rng.normal(90, 2.5)), bend, focal=FOCAL,
        lens=(float(rng.uniform(-0.06, 0.04)), 0.0), fill=rng.uniform(0.88, 0.96),
        shown=(across[0], 0.0, across[1], paper[1]),
    )  # fmt: skip
    return Shot(eye, bend, sensor=random_sensor(rng, megapixels), quarters=int(rng.integers(4)), focal=FOCAL)
