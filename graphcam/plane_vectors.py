"""Products of plane vectors, which are complex numbers; used by both the drawn and the exact side."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Vectors = NDArray[np.complexfloating[Any, Any]]


def dot(a: Vectors | complex, b: Vectors | complex) -> NDArray[np.float64]:
    """The scalar product |a| |b| cos(a, b), by elements of arrays that broadcast.

    >>> float(dot(3 + 0j, 2 + 5j))
    6.0
    """
    return np.asarray(a.real * b.real + a.imag * b.imag)


def cross(a: Vectors | complex, b: Vectors | complex) -> NDArray[np.float64]:
    """The vector product |a| |b| sin(a, b), positive if b lies counter-clockwise from a; by elements of arrays.

    >>> float(cross(3 + 0j, 2 + 5j))
    15.0
    """
    return np.asarray(a.real * b.imag - a.imag * b.real)
