"""What the numbers of a picture mean in light: sRGB and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def _linear() -> NDArray[np.float32]:
    said = np.arange(256) / 255
    return np.where(said <= 0.04045, said / 12.92, ((said + 0.055) / 1.055) ** 2.4).astype(np.float32)


LINEAR = _linear()
"""Light (256,) in parts of all of it, by the value of a pixel."""
