"""Which station a line touches a plotted curve at."""

import numpy as np

from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.drafting.marks import Points
from graphcam.drafting.units import NOTHING
from graphcam.plane import dot

ON_A_STATION = 0.05
"""A line that touches this near to a station, in parts of the way to the next one, touches at it."""


def touched(integrated: Integrated, plotted: Points, place: complex, direction: int) -> list[str]:
    """The name of the station that a curve is touched at, or the names of those between which it is.

    plotted : (n,) the curve's points at the stations;  direction : 1 for the curve of the rises, -1 of the returns

    >>> import graphcam as gc
    >>> integrated = gc.solve(gc.builtin_task()).drawn["integration"]
    >>> curve = np.arange(integrated.first("s").size) + 0j
    >>> touched(integrated, curve, 4.02 + 0j, 1), touched(integrated, curve, 4.3 + 0j, 1)
    (['4'], ['4', '5'])
    """
    motion, stations = integrated.givens.motion, integrated.givens.stations
    names, moving = station_names(stations), np.array([phase.direction for phase in motion.phases])
    left = stations.left[moving[stations.phase[stations.left]] == direction]
    ways = plotted[left + 1] - plotted[left]
    # A part that has no length, where the follower stays, is touched nowhere.
    along = np.clip(dot(ways, place - plotted[left]) / np.maximum(np.abs(ways) ** 2, NOTHING), 0.0, 1.0)
    part = int(np.argmin(np.abs(plotted[left] + along * ways - place)))
    first, share = int(left[part]), float(along[part])
    if min(share, 1 - share) < ON_A_STATION:
        return [names[first + (share > 0.5)]]
    return [names[first], names[first + 1]]
