"""Texts as QR codes, by segno."""

import numpy as np
import segno
from numpy.typing import NDArray

CORRECTION_LEVEL = "m"
"""The level of error correction, at which 15 % of damage may be repaired."""
MIN_CODE_SIDE = 18.0
"""The minimum side of a code, without the white about it [mm]."""
MIN_MODULE, MIN_TILE_MODULE = 0.75, 0.6
"""The minimum module [mm] on a sheet (4 pixels in a photograph of A3 with 5 megapixels), and on a tile."""
QUIET_MODULES = 4
"""The width of the white about a code [modules]."""


def modules(text: str) -> NDArray[np.bool_]:
    """The dark modules (n, n) of a text's code, the rows from above.

    >>> modules("GC1").shape
    (21, 21)
    """
    code = segno.make_qr(text, error=CORRECTION_LEVEL, boost_error=False)
    return np.array([list(row) for row in code.matrix]) == 1


def module_size(count: int, finest: float = MIN_MODULE) -> float:
    """The side of a module [mm] of a code with ``count`` in a row.

    >>> round(module_size(21), 3), module_size(33), module_size(33, MIN_TILE_MODULE)
    (0.857, 0.75, 0.6)
    """
    return max(finest, MIN_CODE_SIDE / count)
