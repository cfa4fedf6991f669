"""Products of plane vectors, which are complex numbers; used by both the drawn and the exact side."""

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


def turned(points: NDArray[np.floating[Any]], by: complex) -> NDArray[np.floating[Any]]:
    """Points (..., 2) turned about the origin by a unit vector; by 1, every digit stays.

    >>> turned(np.array([[2.0, 1.0]]), 1j).tolist()
    [[-1.0, 2.0]]
    """
    x, y = points[..., 0], points[..., 1]
    return points if by == 1 else np.stack([by.real * x - by.imag * y, by.imag * x + by.real * y], axis=-1)
