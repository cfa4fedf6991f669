"""A photograph, or a scan, of paper that was printed and drawn on."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import cv2
import numpy as np
from bent_paper import Bend, Points
from camera import Eye, NDFloat32, Scanner, SeenPlaces, Upright, seen_places
from exposure import Photograph, Sensor, as_jpeg, developed, scanned
from light import lit, table, with_fingers
from pencil import FULL, Light
from PIL import Image
from printer import Placing

Rng = np.random.Generator
PAPER = (0.80, 0.80, 0.79)
"""The light that paper gives back: blue, green, red."""
ORIENTATION, FOCAL_35, EXIF = 0x0112, 0xA405, 0x8769
"""Tags of EXIF: how the picture is to be turned, the focal length as of a small-picture camera, where that one is."""
TURNS = {0: 1, 1: 6, 2: 3, 3: 8}
"""The orientation by the quarters clockwise by which the picture is to be turned."""
SMALL_PICTURE = 36.0
"""Its width, mm."""


@dataclass(frozen=True, eq=False)
class Shot:
    """How a photograph, or a scan, is taken.

    quarters : by which the file says that its picture is to be turned clockwise
    fingers : tip on the paper, direction out of it
    focal : that the file tells, of the picture's longer side; 0 where it tells none
    """

    eye: Eye
    bend: Bend
    placing: Placing = field(default_factory=Placing)
    sensor: Sensor = field(default_factory=Sensor)
    quarters: int = 0
    shadows: int = 2
    fingers: tuple[tuple[complex, complex], ...] = ()
    focal: float = 0.0
    grey: bool = False

    @property
    def scan(self) -> bool:
        """Whether it is a scan."""
        return isinstance(self.eye, Scanner)

    @cached_property
    def upright(self) -> Upright:
        """The eye whose picture is the file's after turning."""
        return Upright(self.eye, self.quarters)

    def pixels(self, points: Points) -> Points:
        """Where points (...) of the *page* are in the picture after turning: the truth of a registration."""
        return self.upright.pixels(self.placing.paper(points))


def photographed(light: Light, page: tuple[float, float], per_mm: float, shot: Shot, rng: Rng) -> bytes:
    """The JPEG file.

    light : (rows, columns, 3) what the page gives back, see :mod:`pencil`
    page : its width and height, which the paper has too [mm]
    """
    picture = _taken(light, page, per_mm, shot, rng)
    return _with_exif(as_jpeg(picture, shot.sensor.quality), shot)


def _taken(light: Light, page: tuple[float, float], per_mm: float, shot: Shot, rng: Rng) -> Photograph:
    seen = seen_places(shot.eye, page)
    found = _reflected(light, seen, page, per_mm, shot, rng)
    if shot.scan:
        return scanned(found, rng, grey=shot.grey, blur=shot.sensor.blur, noise=shot.sensor.noise)
    found *= lit(shot.eye.size, seen, shot.bend, rng, shadows=shot.shadows)
    with_fingers(found, shot.eye, list(shot.fingers), rng)
    return developed(found, shot.sensor, rng)


def _reflected(
    light: Light, seen: SeenPlaces, page: tuple[float, float], per_mm: float, shot: Shot, rng: Rng
) -> NDFloat32:
    """What paper and table give back (h, w, 3) at every pixel of the picture."""
    across, up = seen.fine
    # Pixels of the page that one of the picture covers, where it covers most.
    middle = slice(None, None, 64)
    covered = float(np.percentile(np.abs(np.diff(across[middle], axis=1)) + np.abs(np.diff(up[middle], axis=1)), 80))
    smaller = min(1.0, 1.3 / max(covered * per_mm, 1e-6))
    scale = per_mm, per_mm
    if smaller < 0.8:
        size = round(light.shape[1] * smaller), round(light.shape[0] * smaller)
        scale = per_mm * size[0] / light.shape[1], per_mm * size[1] / light.shape[0]
        light = cv2.resize(light, size, interpolation=cv2.INTER_AREA)
    columns, rows = _on_page(across, up, page, scale, shot.placing)
    found = cv2.remap(light, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE).astype(np.float32)
    found *= np.array(PAPER, np.float32) / FULL
    inside = np.minimum(np.minimum(across, page[0] - across), np.minimum(up, page[1] - up))
    inside = np.clip(inside / np.float32(max(covered, 1e-6)) + 0.5, 0, 1)
    beside = np.float32(0.75) if shot.scan else table(shot.eye.size, rng)
    shadow = 1 - 0.5 * cv2.resize(
        cv2.GaussianBlur(cv2.resize(inside, None, fx=0.125, fy=0.125), (0, 0), 2.5), inside.shape[::-1]
    )
    found -= beside * shadow[..., None]
    found *= inside[..., None]
    found += beside * shadow[..., None]
    return found


def _on_page(
    across: NDFloat32, up: NDFloat32, page: tuple[float, float], scale: tuple[float, float], placing: Placing
) -> tuple[NDFloat32, NDFloat32]:
    """Column and row of the page at places of the paper."""
    corner, one, other = placing.page(np.array([0, 1, 1j]))
    right, upwards = one - corner, other - corner
    x = across * np.float32(right.real * scale[0]) + up * np.float32(upwards.real * scale[0])
    y = across * np.float32(right.imag * scale[1]) + up * np.float32(upwards.imag * scale[1])
    x += np.float32(corner.real * scale[0] - 0.5)
    y += np.float32(corner.imag * scale[1])
    return x, np.float32(page[1] * scale[1] - 0.5) - y


def _with_exif(jpeg: bytes, shot: Shot) -> bytes:
    """The file with what a telephone notes: how the picture is turned, and the focal length."""
    if shot.scan:
        return jpeg
    notes = Image.Exif()
    notes[ORIENTATION] = TURNS[shot.quarters % 4]
    if shot.focal:
        notes.get_ifd(EXIF)[FOCAL_35] = round(shot.focal * SMALL_PICTURE)
    data = notes.tobytes()
    return jpeg[:2] + b"\xff\xe1" + (len(data) + 2).to_bytes(2, "big") + data + jpeg[2:]
