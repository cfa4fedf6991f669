"""Points drawn in any order, each beside the one that it is meant to be."""

from __future__ import annotations

import numpy as np

from graphcam.drafting.marks import Points


def paired(given: Points, wanted: Points) -> Points:
    """As many points (n,) in the order of the wanted ones, paired so that they lie as near as they can together.

    A drawing does not say which point is which, and a CAD program may save them in another order.  The distances
    themselves are summed, not their squares, so that one point in a wrong place is left as that one.

    >>> paired(np.array([5 + 1j, 0.2 + 0j]), np.array([0j, 5 + 0j]))
    array([0.2+0.j, 5. +1.j])
    """
    from scipy.optimize import linear_sum_assignment

    _, order = linear_sum_assignment(np.abs(wanted[:, None] - given))
    return given[order]
