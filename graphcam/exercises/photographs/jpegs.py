"""Pictures as files."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

QUALITY = 80
"""The quality of JPEG: a pencil line keeps its edges, and a view of A3 takes 60 kB."""


def jpeg(pixels: NDArray[np.uint8]) -> bytes:
    """A picture (rows, columns, 3), blue, green, red, as JPEG.

    >>> jpeg(np.zeros((8, 8, 3), np.uint8))[:2].hex()
    'ffd8'
    """
    # Colours as sharp as light, or a thin coloured line would be grey.
    sharp = [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
    _, data = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, QUALITY, *sharp])
    return data.tobytes()
