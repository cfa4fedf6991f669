"""The handle of the velocity plan: the station at which it is drawn."""

from collections.abc import Iterator

import numpy as np

from graphcam.constructions import arm_pressure_angle, pressure_angle
from graphcam.constructions.pressure_angle import moving_up, shown_station
from graphcam.constructions.views import PLAN
from graphcam.drafting.marks import Points
from graphcam.given.follower import sense
from graphcam.solving.solution import Solution
from graphcam.studio.handle import Changes, Handle, HandleAxis, HandleState, nearest_station
from graphcam.studio.size_ranges import SizeRange, sizes_of
from graphcam.words import say

STATION_NAME = say("Station of the velocity plan")


def station(solution: Solution, state: HandleState) -> Iterator[Handle]:
    """The end D of the mechanism's triangle, which goes to that of the nearest station with a plan."""
    measured = solution.chain["pressure_angle"]
    shown, possible = shown_station(measured), np.flatnonzero(moving_up(measured))
    places = _ends(solution, shown)

    def drag(to: complex, fine: bool) -> Changes:
        return {"station": int(possible[nearest_station(places[possible], to)])}

    room = SizeRange(float(possible[0]), float(possible[-1]), 1.0)
    axis = HandleAxis("station", STATION_NAME, "", shown, room, "x", {"fine": 1.0, "coarse": 1.0})
    yield Handle(PLAN.name, "station", STATION_NAME, complex(places[shown]), "xy", (axis,), drag)


def _ends(solution: Solution, shown: int) -> Points:
    """The ends D of all stations about the cam centre, at the scale of the plan that is shown [mm of paper]."""
    measured = solution.chain["pressure_angle"]
    if "arm" not in sizes_of(solution.task):
        mu, centre = measured.readings["s0"].per_mm, complex(np.ravel(measured.first("centre"))[0])
        ends = (np.asarray(measured.first("ends")) - centre) * mu
        return ends / pressure_angle.plan_scale(measured, shown, complex(ends[shown])).per_mm
    integrated, givens = measured.givens.integrated, measured.givens
    s, v = (np.asarray(integrated.value(name)) for name in "sv")
    arms = -givens.arm * np.exp(-1j * (float(measured.first("psi0")) + s))
    ends = givens.distance + arms * (1 + sense(givens.rotation) * v)
    return ends / arm_pressure_angle.plan_scale(measured, shown).per_mm
