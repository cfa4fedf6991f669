"""Even pictures of paper for tests of reading: light print, strokes, and what a camera does to them.

Simpler than the simulator of photographs: no tilt, no lens, no JPEG, so that a test takes a fraction of a second.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from graphcam.photo.printed_page import PrintedPage, PrintedView
from graphcam.photo.rectify import EvenPicture

Points = NDArray[np.complex128]
PER_MM = 8.0
FINER = 2
"""Strokes are drawn so many times finer than the picture is."""
CORNER = 30 + 20j
"""Lower left corner of the part of the page that is shown."""
INKS = {"colour": (0.55, 0.78, 0.95), "grey": (0.7, 0.7, 0.7)}
"""What a 45 % cyan and a 30 % grey let through: red, green, blue."""
PENS = {
    "HB": (0.5, (0.33, 0.33, 0.34)),
    "2H": (0.3, (0.58, 0.58, 0.59)),
    "fine": (0.2, (0.62, 0.62, 0.62)),
    "blue biro": (0.4, (0.10, 0.14, 0.45)),
    "red pencil": (0.6, (0.80, 0.35, 0.33)),
}
"""Width [mm], and what it lets through."""


def circle(radius: float, start: float = 0.0, end: float = 360.0) -> Points:
    """An arc about 0, from and to angles [degrees]."""
    return radius * np.exp(1j * np.radians(np.linspace(start, end, 721)))


def cam(least: float = 28.0, lift: float = 14.0) -> Points:
    """A curve as a cam has it, counter-clockwise: rise, dwell, fall, and a rest on the circle of the least radius."""
    angle = np.linspace(0, 360, 1441)[:-1]
    rise, fall = np.clip(angle / 110, 0, 1), np.clip((angle - 150) / 100, 0, 1)
    way = (rise - np.sin(2 * np.pi * rise) / (2 * np.pi)) - (fall - np.sin(2 * np.pi * fall) / (2 * np.pi))
    return (least + lift * way) * np.exp(1j * np.radians(angle + 20))


@dataclass(frozen=True, eq=False)
class Camera:
    """What a camera does.

    blur : of everything;  colour_blur : of the colours besides [mm];  noise : standard deviation, of white
    cast : of the white balance, red, green, blue
    """

    blur: float = 0.1
    colour_blur: float = 0.2
    noise: float = 0.015
    cast: tuple[float, float, float] = (1.1, 1.0, 0.8)
    grey: bool = False


class Sheet:
    """A square part of a page, with a view about its middle."""

    def __init__(self, side: float = 110.0, ink: str = "colour", seed: int = 0, closed: bool = True) -> None:
        self.side, self.ink, self.rng = side, ink, np.random.default_rng(seed)
        self.pixels = round(side * PER_MM)
        self.through = np.ones((self.pixels, self.pixels, 3), np.float32)
        self.givens: list[Points] = []
        self.patches: list[complex] = []
        self.black: list[tuple[float, float, float, float]] = []
        self.origin = CORNER + side / 2 * (1 + 1j) if closed else CORNER + 6 + 1j * side / 2
        left, bottom = CORNER.real + 1, CORNER.imag + 1
        room = (left, bottom, left + side - 2, bottom + side - 2)
        self.view = PrintedView(self.origin, room, closed, 0.0, side - 14)

    def print_line(self, points: Points) -> None:
        """A light line of 0.18 mm, from the origin."""
        self.givens.append(self.origin + points)
        self._lay(self._covered(points, 0.18), INKS[self.ink])

    def print_patch(self, corner: complex) -> None:
        """A square of 7 mm of the ink of the givens, from the sheet's corner."""
        self.patches.append(CORNER + corner)
        outline = CORNER + corner + 7 * np.array([0, 1, 1 + 1j, 1j]) - self.origin
        self._lay(self._covered(outline, 0.0), INKS[self.ink])

    def print_black(self, box: tuple[float, float, float, float]) -> None:
        """A black square, from the origin."""
        left, bottom, right, top = box
        x, y = self.origin.real, self.origin.imag
        self.black.append((left + x, bottom + y, right + x, top + y))
        corners = np.array([complex(left, bottom), complex(right, bottom), complex(right, top), complex(left, top)])
        self._lay(self._covered(corners, 0.0), (0.05, 0.05, 0.05))

    def fill(self, outline: Points, through: tuple[float, float, float]) -> None:
        """Something that lies on the sheet, from the origin."""
        self._lay(self._covered(outline, 0.0), through)

    def stroke(self, points: Points, pen: str = "HB", strength: float = 1.0) -> None:
        """A line, from the origin, as uneven as graphite on paper."""
        width, through = PENS[pen]
        covered = cv2.GaussianBlur(self._covered(points, width), (0, 0), 0.06 * PER_MM)
        grain = cv2.GaussianBlur(self.rng.normal(size=covered.shape).astype(np.float32), (0, 0), 1.2)
        self._lay(covered * np.clip(0.9 + 0.5 * grain, 0.2, 1.2) * strength, through)

    def by_hand(self, points: Points, pen: str = "HB", tremor: float = 0.15, strength: float = 1.0) -> Points:
        """A curve drawn with a tremor [mm]; what was really drawn."""
        ahead = np.gradient(points)
        aside = gaussian_filter1d(self.rng.normal(size=points.size), 40, mode="wrap")
        drawn = points + 1j * ahead / np.abs(ahead) * aside * tremor / aside.std()
        self.stroke(np.append(drawn, drawn[:1]) if self.view.closed else drawn, pen, strength)
        return drawn

    def cross(self, place: complex, pen: str = "fine", arm: float = 1.5) -> None:
        """Two short strokes."""
        for way in (1, 1j):
            self.stroke(place + arm * way * np.array([-1, 1]), pen)

    def with_construction(self, curve: Points) -> None:
        """Rays, crosses and numbers of twelve stations of a curve."""
        for k, place in enumerate(curve[:: curve.size // 12]):
            self.stroke(np.array([0, 1.12 * place]), "fine")
            self.cross(place)
            self.write(str(k), place * (1 + 4 / abs(place)))

    def write(self, text: str, place: complex) -> None:
        """Digits, 3 mm high."""
        covered = np.zeros(self.through.shape[:2], np.uint8)
        column, row = self._places(np.array([place]), 1)[0]
        where = (round(float(column)), round(float(row)))
        cv2.putText(covered, text, where, cv2.FONT_HERSHEY_SIMPLEX, 3 * PER_MM / 22, 255, 2, cv2.LINE_AA)
        self._lay(covered.astype(np.float32) / 255, PENS["fine"][1])

    def page(self) -> PrintedPage:
        """What is known of the page."""
        return PrintedPage(
            code="",
            width=420.0,
            height=297.0,
            tags={},
            tag_side=12.0,
            bars=(),
            patches=tuple(self.patches),
            patch_side=7.0,
            ink="grey" if self.ink == "grey" else "colour",
            givens=tuple(self.givens),
            black=tuple(self.black),
            views={"view": self.view},
        )

    def flat(self, camera: Camera | None = None) -> EvenPicture:
        """The sheet as a camera shows it in uneven light, even again."""
        camera = camera or Camera()
        light = np.linspace(0.5, 0.85, self.pixels, dtype=np.float32)
        shown = cv2.GaussianBlur(self.through * light[:, None, None], (0, 0), camera.blur * PER_MM)
        shown += self.rng.normal(size=shown.shape).astype(np.float32) * camera.noise
        grey = shown.mean(2, keepdims=True)
        colours = cv2.GaussianBlur(shown - grey, (0, 0), camera.colour_blur * PER_MM)
        shown = np.repeat(grey, 3, 2) if camera.grey else (grey + colours) * np.array(camera.cast, np.float32)
        left, bottom = CORNER.real, CORNER.imag
        return EvenPicture(np.clip(shown, 0, 1), (left, bottom, left + self.side, bottom + self.side), PER_MM)

    def _covered(self, points: Points, width: float) -> NDArray[np.float32]:
        """How much of each pixel lies under a line, or within an outline where it has no width."""
        fine = np.zeros((FINER * self.pixels,) * 2, np.uint8)
        corners = np.round(self._places(points, FINER) * 16).astype(np.int32)
        if width:
            cv2.polylines(fine, [corners], False, 255, max(1, round(width * PER_MM * FINER)), cv2.LINE_AA, 4)
        else:
            cv2.fillPoly(fine, [corners], 255, cv2.LINE_AA, 4)
        return cv2.resize(fine, (self.pixels,) * 2, interpolation=cv2.INTER_AREA).astype(np.float32) / 255

    def _places(self, points: Points, finer: int) -> NDArray[np.float64]:
        from_corner = points + self.origin - CORNER
        scale = PER_MM * finer
        return np.stack([from_corner.real * scale - 0.5, (self.side - from_corner.imag) * scale - 0.5], -1)

    def _lay(self, covered: NDArray[np.float32], through: tuple[float, ...]) -> None:
        self.through *= 1 - np.clip(covered, 0, 1)[..., None] * (1 - np.array(through, np.float32))


def profile_sheet(ink: str = "colour", seed: int = 0) -> Sheet:
    """A sheet with the givens of a cam: two circles, two axes, two patches."""
    sheet = Sheet(ink=ink, seed=seed)
    for given in (circle(28), circle(9), np.array([-50, 50 + 0j]), np.array([-50j, 50j])):
        sheet.print_line(given)
    for corner in (2 + 2j, 12 + 2j):
        sheet.print_patch(corner)
    return sheet


def diagram_sheet(seed: int = 0) -> Sheet:
    """A sheet with the axis of a diagram and two patches."""
    sheet = Sheet(seed=seed, closed=False)
    sheet.print_line(np.array([0, sheet.view.end + 0j]))
    sheet.print_line(np.array([-45j, 45j]))
    for corner in (20 + 2j, 30 + 2j):
        sheet.print_patch(corner)
    return sheet
