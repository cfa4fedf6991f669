"""A picture in memory: upright, blue, green, red, of bounded size, with the camera's data on its lens."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from graphcam.errors import GraphcamError
from graphcam.words import Words, say

Pixels = NDArray[np.uint8]
MAX_PIXELS = 120_000_000
"""The maximum number of pixels of a file's picture: no telephone makes larger ones."""
MAX_KEPT_PIXELS = 24_000_000
"""The maximum number of pixels of a picture that is read; a larger one is reduced first."""
MAX_UNPACKED_BYTES = 320_000_000
"""The maximum number of bytes of an unpacked picture, so that all stays within 600 MB."""
COLOUR_PIXEL_BYTES = 4
"""The number of bytes per pixel of colours in memory; pixels of grey and of palettes take one."""
PIXEL_BYTES_BY_MODE: Mapping[str, int] = {"1": 1, "L": 1, "P": 1, "I;16": 2, "I;16B": 2, "I;16L": 2}
"""The number of bytes per pixel, by the mode of a picture."""
STRIP_ROWS = 256
"""The number of rows that are copied at a time."""
ORIENTATION_TAG = 0x0112
"""The number of EXIF's tag for how the camera was held."""
LENS_TAG = 0x8769
"""The number of EXIF's tag for the table on the lens; the following numbers are of its entries."""
FOCAL_35_TAG, FOCAL_MM_TAG, PLANE_RESOLUTION_TAG, PLANE_UNIT_TAG, PLANE_WIDTH_TAG = (
    0xA405,
    0x920A,
    0xA20E,
    0xA210,
    0xA002,
)
MM_PER_EXIF_UNIT: Mapping[int, float] = {2: 25.4, 3: 10.0, 4: 1.0}
"""EXIF's units of length in mm, by their numbers."""
DIAGONAL_35 = 43.27
"""The diagonal of the film to which focal lengths are compared [mm]."""
FOCAL_RANGE = (0.4, 4.0)
"""The range of plausible focal lengths, in diagonals of the picture."""


class PhotographError(GraphcamError):
    """A photograph, or a drawing on it, that cannot be read; nothing of it is marked.

    why : a sentence without its full stop ("only 2 of 8 marks are seen")
    remedy : what to do about it ("take in the whole sheet")

    >>> print(PhotographError("the picture is blurred", "hold still"))
    the picture is blurred; hold still
    """

    def __init__(self, why: Words, remedy: Words) -> None:
        super().__init__(why, remedy)
        self.why = why
        self.advice = remedy

    @property
    def fault(self) -> Words:
        """The reason why it cannot be read."""
        return self.why


def _linear() -> NDArray[np.float32]:
    said = np.arange(256) / 255
    return np.where(said <= 0.04045, said / 12.92, ((said + 0.055) / 1.055) ** 2.4).astype(np.float32)


LINEAR_LIGHT = _linear()
"""Light (256,) as a share of full light, by the value of a pixel."""


@dataclass(frozen=True, eq=False)
class Photograph:
    """A picture in memory.

    name : of its file, with the page's number if that has several
    pixels : (h, w, 3) blue, green, red, upright
    focal : the lens's focal length in pixels, None if it is not known
    """

    name: str
    pixels: Pixels
    focal: float | None = None


def check_size(width: int, height: int, bytes_a_pixel: int = 1) -> None:
    """Refuse a picture of impossible size before it is unpacked.

    Raises
    ------
    PhotographError : it is too large, or has no size
    """
    if min(width, height) < 1:
        raise PhotographError(say("the picture is empty"), say("send it again"))
    if width * height > MAX_PIXELS or width * height * bytes_a_pixel > MAX_UNPACKED_BYTES:
        raise PhotographError(
            say("the picture is too large, {width} x {height} pixels", width=width, height=height),
            say("send it with 12 megapixels, or scan it at 300 dpi"),
        )


def picture_of(image: Image.Image, name: str) -> Photograph:
    """The photograph of a picture that has been opened but not unpacked yet.

    Raises
    ------
    PhotographError : it is too large, or its colours are none that are known
    OSError, SyntaxError, ValueError : its file is broken
    """
    size = image.size
    check_size(*size)
    if image.format in ("JPEG", "MPO") and image.width * image.height > 2 * MAX_KEPT_PIXELS:
        # A JPEG can be unpacked at half its size, which takes a quarter of the memory.
        image.draft(None, (image.width // 2, image.height // 2))
    check_size(*image.size, PIXEL_BYTES_BY_MODE.get(image.mode, COLOUR_PIXEL_BYTES))
    # Not before the size is known to be bounded, as Pillow unpacks a PNG when it is asked for its EXIF.
    image.load()
    exif = image.getexif()
    picture = bounded(_colours(image), name, focal_length(exif, size), max(size))
    return Photograph(name, upright_pixels(picture.pixels, orientation(exif)), picture.focal)


def bounded(pixels: Pixels, name: str, focal: float | None, longer: int) -> Photograph:
    """The photograph of grey pixels (h, w), or red, green, blue (h, w, 3), reduced if they are too many.

    focal : the lens's focal length in pixels of a picture whose longer side has ``longer``
    """
    height, width = pixels.shape[:2]
    shrink = float(np.sqrt(MAX_KEPT_PIXELS / (width * height)))
    if shrink < 1:
        size = int(width * shrink), int(height * shrink)
        pixels = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), np.uint8)
    way = cv2.COLOR_GRAY2BGR if pixels.ndim == 2 else cv2.COLOR_RGB2BGR
    reduced = np.asarray(cv2.cvtColor(pixels, way), np.uint8)
    return Photograph(name, reduced, None if focal is None else focal * max(reduced.shape[:2]) / longer)


def _colours(image: Image.Image) -> Pixels:
    """The pixels (h, w) of a grey picture, or (h, w, 3) red, green, blue; what is transparent shows white paper."""
    if image.width * image.height > 2 * MAX_KEPT_PIXELS and image.mode in ("L", "RGB", "RGBA", "CMYK"):
        image = image.reduce(2)
    if image.mode.startswith("I"):
        return np.clip(np.asarray(image) >> 8, 0, 255).astype(np.uint8)
    if image.mode in ("1", "L"):
        return _copied(image, "L")
    if image.mode in ("RGBA", "LA", "PA", "La", "RGBa") or "transparency" in image.info:
        seen = image.convert("RGBA")
        white = Image.new("RGB", seen.size, "white")
        white.paste(seen, mask=seen.getchannel("A"))
        return _copied(white, "RGB")
    if image.mode == "F":
        raise PhotographError(say("the colour format of the picture is not supported"), say("send a JPEG"))
    return _copied(image, "RGB")


def _copied(image: Image.Image, mode: str) -> Pixels:
    """The pixels of a picture, copied in strips: all at once they would be in memory three times."""
    width, height = image.size
    copy = np.empty((height, width) if mode == "L" else (height, width, 3), np.uint8)
    for top in range(0, height, STRIP_ROWS):
        bottom = min(top + STRIP_ROWS, height)
        copy[top:bottom] = np.asarray(image.crop((0, top, width, bottom)).convert(mode))
    return copy


def upright_pixels(pixels: Pixels, orientation: int) -> Pixels:
    """Pixels (h, w, 3) turned upright, by one of EXIF's orientations 1 to 8."""
    upright = {
        2: pixels[:, ::-1],
        3: pixels[::-1, ::-1],
        4: pixels[::-1],
        5: pixels.swapaxes(0, 1),
        6: pixels[::-1].swapaxes(0, 1),
        7: pixels[::-1, ::-1].swapaxes(0, 1),
        8: pixels[:, ::-1].swapaxes(0, 1),
    }
    return np.ascontiguousarray(upright.get(orientation, pixels))


def orientation(exif: Image.Exif) -> int:
    """EXIF's orientation of the camera, 1 to 8; 1 if it is not known."""
    said = exif.get(ORIENTATION_TAG, 1)
    return said if isinstance(said, int) and 1 <= said <= 8 else 1


def focal_length(exif: Image.Exif, size: tuple[int, int]) -> float | None:
    """The focal length in pixels of a picture of ``size`` columns and rows; None if it is unknown or implausible."""
    diagonal = float(np.hypot(*size))
    try:
        said = exif.get_ifd(LENS_TAG)
        focal = float(said.get(FOCAL_35_TAG, 0)) / DIAGONAL_35 * diagonal
        if not focal:
            per_mm = float(said[PLANE_RESOLUTION_TAG]) / MM_PER_EXIF_UNIT[int(said.get(PLANE_UNIT_TAG, 2))]
            focal = float(said[FOCAL_MM_TAG]) * per_mm * size[0] / float(said.get(PLANE_WIDTH_TAG, size[0]))
    except (KeyError, TypeError, ValueError, ZeroDivisionError, OSError, SyntaxError):
        return None
    least, most = FOCAL_RANGE
    return focal if least * diagonal <= focal <= most * diagonal else None
