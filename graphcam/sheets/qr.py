"""Texts as QR codes, by segno."""

import numpy as np
import segno
from numpy.typing import NDArray

LEVEL = "m"
"""Of the correction of errors: what 15 % of damage leaves readable."""
SMALLEST = 18.0
"""Of a code's side, mm, without the white about it."""
FINEST = 0.6
"""Of a module, mm: a photograph of a whole sheet of A3 shows it with four pixels and more."""
QUIET = 4
"""Modules that stay white about a code."""


def modules(text: str) -> NDArray[np.bool_]:
    """The dark modules (n, n) of a text's code, the rows from above.

    >>> modules("GC1").shape
    (21, 21)
    """
    code = segno.make_qr(text, error=LEVEL, boost_error=False)
    return np.array([list(row) for row in code.matrix]) == 1


def module_size(count: int) -> float:
    """The side of a module in mm, of a code with so many in a row.

    >>> round(module_size(21), 3), module_size(33)
    (0.857, 0.6)
    """
    return max(FINEST, SMALLEST / count)
