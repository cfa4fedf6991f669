"""The stations of a roller on a cam of three arcs, and what lies on its board."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.arc_profile import ArcOutline
from graphcam.drafting.ink import Construction, View, Words, say
from graphcam.given.laws import Floats

ROLLER = View(
    *("roller", say("The roller on the arcs"), "roller x", "roller y"),
    scale=say("The roller on the arcs, {ratio}"),
    main=True,
)
ARCS = ("AG", "GF", "FD")
"""The arcs of the rise, in order."""
CENTRES = ("C2", "C3", "C1")
"""What they are about."""


@dataclass(frozen=True, eq=False)
class ArcStations:
    """The ends of equal parts of the three arcs of a rise, both ends of each arc included.

    arc : (m,) which arc;  u : (m,) fraction of its angle;  spans : slice of the stations of each arc
    """

    arc: NDArray[np.intp]
    u: Floats
    spans: tuple[slice, ...]

    @cached_property
    def names(self) -> list[str]:
        """0, 1, 2 ... through the rise; where two arcs meet, the first one's end and the second one's start are one."""
        return [str(k - arc) for k, arc in enumerate(self.arc.tolist())]

    @cached_property
    def places(self) -> dict[str, list[int]]:
        """Which of the stations are of one name.

        >>> list(divide_arcs(1).places.items())
        [('0', [0]), ('1', [1, 2]), ('2', [3, 4]), ('3', [5])]
        """
        return {name: [k for k, each in enumerate(self.names) if each == name] for name in dict.fromkeys(self.names)}

    @cached_property
    def titles(self) -> list[Words]:
        """The names of all stations, with their arc where one name has two."""
        titles: list[Words] = []
        for name, arc in zip(self.names, self.arc.tolist(), strict=True):
            both = len(self.places[name]) > 1
            titles.append(say("{name} on {arc}", name=name, arc=ARCS[arc]) if both else name)
        return titles


def divide_arcs(parts: int) -> ArcStations:
    """Each arc divided into so many equal parts.

    >>> divide_arcs(2).names
    ['0', '1', '2', '2', '3', '4', '4', '5', '6']
    """
    count = parts + 1
    spans = tuple(slice(k * count, (k + 1) * count) for k in range(3))
    return ArcStations(np.repeat(np.arange(3), count), np.tile(np.arange(count) / parts, 3), spans)


@dataclass(frozen=True, eq=False)
class ArcRollerGivens:
    """The arcs, the roller on them [mm], where it stands, and how fast the cam turns [rad/s], if that is given."""

    arcs: ArcOutline
    roller_radius: float
    stations: ArcStations
    omega: float | None = None


RollerOnArcs = Construction[ArcRollerGivens]
