"""Pages with tags under a pinhole camera: the places of their points, and pictures of them if they lie flat."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cv2
import numpy as np

from graphcam.photo.printed_page import PrintedPage, PrintedView
from graphcam.photo.tag_family import dark_cells
from graphcam.photo.tags import Tags

CORNERS = np.array([0, 1, 1 + 1j, 1j])
"""Of a tag of side 1, in their order."""
FINE = 8
"""Pixels a mm of a page that is drawn, in which every cell of a tag is whole."""


def page_of(width=420.0, height=297.0, columns=3, rows=3, side=12.0, edge=8.0, seam=None) -> PrintedPage:
    """A page with tags along its edges and one view in its middle."""
    across = np.linspace(edge, width - edge - side, columns)
    up = np.linspace(edge, height - edge - side, rows)
    places = [complex(x, y) for x in across for y in up if x in across[[0, -1]] or y in up[[0, -1]]]
    view = PrintedView(complex(width, height) / 2, (30.0, 30.0, width - 30.0, height - 30.0), closed=True)
    places = [complex(round(z.real * FINE), round(z.imag * FINE)) / FINE for z in places]
    empty = {"bars": (), "patches": (), "givens": (), "black": ()}
    return PrintedPage(
        "code", width, height, dict(enumerate(places)), side, patch_side=7.0, ink="colour", views={"profile": view},
        seam=seam, **empty,
    )  # fmt: skip


def flat(points):
    """Points (n,) from the middle of the page as solid ones (n, 3), the third coordinate towards the camera."""
    return np.stack([points.real, points.imag, 0 * points.real], -1)


def folded(place, slope, degrees):
    """Paper folded along a line: its distance from the middle [mm], its direction's slope, the angle."""

    def bend(points):
        across = (1 - 1j * slope) / np.hypot(1, slope)
        turned = points * np.conj(across)
        beyond, angle = np.maximum(turned.real - place, 0), np.radians(degrees)
        laid = turned - beyond * (1 - np.cos(angle))
        return np.concatenate([flat(laid * across)[:, :2], (beyond * np.sin(angle))[:, None]], 1)

    return bend


def rolled(lift, degrees, width):
    """Paper whose edges lift by some mm at half a width from the middle, about an axis in some direction."""

    def bend(points):
        across = np.exp(1j * np.radians(degrees))
        turned = points * np.conj(across)
        lengths = np.linspace(-width, width, 4001)
        slope = 2 * lift * lengths / (width / 2) ** 2
        step = lengths[1] - lengths[0]
        # Lengths along the paper stay.
        along, height = (np.cumsum(part) * step for part in (np.sqrt(1 - slope**2), slope))
        along, height = along - along[2000], height - height[2000]
        laid = np.interp(turned.real, lengths, along) + 1j * turned.imag
        return np.concatenate([flat(laid * across)[:, :2], np.interp(turned.real, lengths, height)[:, None]], 1)

    return bend


@dataclass
class Camera:
    """A pinhole camera with a lens, that sees a page whole.

    tilt : degrees about the axes across, up and towards the page
    """

    page: PrintedPage
    tilt: tuple[float, float, float] = (10.0, -8.0, 3.0)
    size: tuple[int, int] = (4000, 3000)
    lens: tuple[float, float] = (-0.05, 0.01)
    bend: Callable = flat
    filled: float = 0.93

    def __post_init__(self):
        turns = [cv2.Rodrigues(np.eye(3)[k] * np.radians(self.tilt[k]))[0] for k in range(3)]
        self.rotation = turns[2] @ turns[1] @ turns[0]
        self.focal = 0.73 * max(self.size)
        self.distance = 500.0
        width, height = self.page.width, self.page.height
        for _ in range(40):
            seen = self.pixels(np.array([0, width, width + 1j * height, 1j * height])) - self.centre
            over = max(np.abs(seen.real).max() / self.size[0], np.abs(seen.imag).max() / self.size[1]) * 2
            self.distance *= 1 + 0.7 * (over / self.filled - 1)

    @property
    def centre(self):
        return complex(self.size[0] - 1, self.size[1] - 1) / 2

    def pixels(self, points):
        """Where points of the paper (n,) [mm] are in the picture."""
        solid = self.bend(points - complex(self.page.width, self.page.height) / 2) * [1, -1, -1]
        seen = solid @ self.rotation.T + [0, 0, self.distance]
        straight = (seen[:, 0] + 1j * seen[:, 1]) / seen[:, 2]
        squared = np.abs(straight) ** 2
        return self.centre + self.focal * straight * (1 + self.lens[0] * squared + self.lens[1] * squared**2)

    def tags(self, noise=0.08, seed=0, hidden=()):
        """The tags, with noise on their corners [px] and without those that are hidden."""
        random = np.random.default_rng(seed)
        numbers = np.array([number for number in sorted(self.page.tags) if number not in hidden], int)
        corners = np.array([self.page.tags[number] for number in numbers.tolist()])[:, None]
        found = self.pixels((corners + self.page.tag_side * CORNERS).ravel()).reshape(-1, 4)
        return Tags(numbers, found + random.normal(0, noise, found.shape) + 1j * random.normal(0, noise, found.shape))

    def misses(self, registration, count=25):
        """By how much a registration misplaces points all over the page's views [mm]."""
        left, bottom, right, top = next(iter(self.page.views.values())).room
        points = (np.linspace(left, right, count) + 1j * np.linspace(bottom, top, count)[:, None]).ravel()
        return np.abs(registration.millimetres(self.pixels(points)) - points)


def drawn(page: PrintedPage):
    """The page as printed (rows, columns), in parts of all light."""
    paper = np.ones((round(page.height * FINE), round(page.width * FINE)), np.float32)
    cell = round(page.tag_side * FINE / 8)
    for number, place in page.tags.items():
        dark = np.kron(dark_cells(number), np.ones((cell, cell))) > 0
        left, bottom = round(place.real * FINE), round((page.height - place.imag) * FINE)
        paper[bottom - 8 * cell : bottom, left : left + 8 * cell][dark] = 0.0
    return 0.03 + 0.77 * paper


def photograph(camera: Camera, paper=None, blur=1.0, noise=0.01, quality=90, seed=0):
    """A grey picture of a flat page, through a lens that keeps lines straight."""
    assert camera.lens == (0, 0)
    assert camera.bend is flat
    page, (columns, rows) = camera.page, camera.size
    paper = drawn(page) if paper is None else paper
    width, height = page.width, page.height
    corners = np.array([0, width, width + 1j * height, 1j * height])
    source = (corners * FINE).conj() + 1j * height * FINE - 0.5 - 0.5j
    twice = camera.pixels(corners) * 2 + 0.5 + 0.5j
    pairs = [np.stack([z.real, z.imag], -1).astype(np.float32) for z in (source, twice)]
    matrix = cv2.getPerspectiveTransform(*pairs)
    large = cv2.warpPerspective(paper, matrix, (2 * columns, 2 * rows), flags=cv2.INTER_LINEAR, borderValue=0.1)
    light = cv2.GaussianBlur(cv2.resize(large, (columns, rows), interpolation=cv2.INTER_AREA), (0, 0), blur)
    random = np.random.default_rng(seed)
    light += noise * np.sqrt(light) * random.standard_normal(light.shape, np.float32)
    grey = (255 * np.clip(light, 0, 1) ** (1 / 2.2) + 0.5).astype(np.uint8)
    return cv2.imdecode(cv2.imencode(".jpg", grey, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], cv2.IMREAD_GRAYSCALE)
