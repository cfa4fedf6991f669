"""A picture in memory: upright, blue, green, red, of bounded size, with what the camera says of its lens."""

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
"""The maximum number of pixels before a picture is reduced: no telephone makes larger ones."""
MAX_KEPT_PIXELS = 24_000_000
"""The maximum number of pixels of a picture that is read: finer ones tell no more about a pencil line."""
MAX_UNPACKED_BYTES = 320_000_000
"""Bytes that a picture may take when it is unpacked, so that all stays within 600 MB."""
COLOUR_PIXEL_BYTES = 4
"""Bytes a pixel in memory for colours; grey ones and those of a palette take one."""
PIXEL_BYTES_BY_MODE: Mapping[str, int] = {"1": 1, "L": 1, "P": 1, "I;16": 2, "I;16B": 2, "I;16L": 2}
"""Bytes a pixel of the other modes."""
STRIP_ROWS = 256
"""Rows that are copied at a time."""
ORIENTATION_TAG = 0x0112
"""EXIF says here how the camera was held."""
LENS_TAG = 0x8769
"""EXIF tells about the lens in a table of its own, by the following numbers."""
FOCAL_35_TAG, FOCAL_MM_TAG, PLANE_RESOLUTION_TAG, PLANE_UNIT_TAG, PLANE_WIDTH_TAG = (
    0xA405,
    0x920A,
    0xA20E,
    0xA210,
    0xA002,
)
MM_PER_EXIF_UNIT: Mapping[int, float] = {2: 25.4, 3: 10.0, 4: 1.0}
"""mm of EXIF's units of length."""
DIAGONAL_35 = 43.27
"""mm of the film to which focal lengths are compared."""
FOCAL_RANGE = (0.4, 4.0)
"""Focal lengths that are believed, in diagonals of the picture."""


class PhotographError(GraphcamError):
    """A photograph, or what is drawn on it, that is not read; nothing of it is marked.

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
        """Why it is not read."""
        return self.why


def _linear() -> NDArray[np.float32]:
    said = np.arange(256) / 255
    return np.where(said <= 0.04045, said / 12.92, ((said + 0.055) / 1.055) ** 2.4).astype(np.float32)


LINEAR_LIGHT = _linear()
"""Light (256,) in parts of all of it, by the value of a pixel."""


@dataclass(frozen=True, eq=False)
class Photograph:
    """A picture.

    name : of its file, with the page's number if that has several
    pixels : (h, w, 3) blue, green, red, upright
    focal : the lens's focal length in pixels, None if nobody says
    """

    name: str
    pixels: Pixels
    focal: float | None = None


def check_size(width: int, height: int, bytes_a_pixel: int = 1) -> None:
    """Check the size of a picture before it is unpacked.

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
    """A picture that has been opened but not unpacked yet.

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
    """A picture of grey pixels (h, w), or red, green, blue (h, w, 3); the average over areas if they are too many.

    focal : the lens's in pixels, where the picture's longer side was ``longer`` of them
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
    """The pixels of a picture, strip by strip: all at once they would be in memory three times."""
    width, height = image.size
    copy = np.empty((height, width) if mode == "L" else (height, width, 3), np.uint8)
    for top in range(0, height, STRIP_ROWS):
        bottom = min(top + STRIP_ROWS, height)
        copy[top:bottom] = np.asarray(image.crop((0, top, width, bottom)).convert(mode))
    return copy


def upright_pixels(pixels: Pixels, orientation: int) -> Pixels:
    """Pixels (h, w, 3) as they are to be seen, for one of EXIF's orientations 1 to 8."""
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
    """How the camera was held, 1 to 8; 1 if nobody says."""
    said = exif.get(ORIENTATION_TAG, 1)
    return said if isinstance(said, int) and 1 <= said <= 8 else 1


def focal_length(exif: Image.Exif, size: tuple[int, int]) -> float | None:
    """The focal length in pixels of a picture of so many columns and rows; None if nobody says, or it cannot be."""
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
