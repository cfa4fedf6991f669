"""Point D, the end of v at the cam angle, from which the cam centre is seen under the pressure angle."""

import math

import numpy as np

from graphcam.solving.solution import Solution
from graphcam.studio.handle import Changes, Handle, HandleState, phi_axis
from graphcam.studio.over_turn import in_degrees, nearest_station, over_stations
from graphcam.words import say


def point_on_curve(view: str, places: str, solution: Solution, state: HandleState) -> Handle:
    """The handle of the cam angle on the curve of a view.

    places : the name of the ends at the stations, in the construction of the pressure angle
    """
    stations = solution.chain.board.stations
    ends = np.asarray(solution.chain["pressure_angle"].first(places))

    def drag(to: complex, fine: bool) -> Changes:
        """The cam angle of the nearest station."""
        return {"phi": in_degrees(stations.phi[nearest_station(ends, to)])}

    at = over_stations(stations, math.radians(state.phi), ends)
    return Handle(view, "D", say("Point D of the curve"), at, "xy", (phi_axis(state.phi),), drag)
