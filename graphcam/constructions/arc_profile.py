"""The closed profile of a cam of three arcs (rise, upper dwell, the rise mirrored, lower dwell), and its stations."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.acts import Drawn
from graphcam.drafting.hand import errorless_hand
from graphcam.drafting.ink import Caption, Construction, View, Words, say
from graphcam.drafting.marks import Arc, Points, Role
from graphcam.drafting.scale import Paper, Scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.three_arcs import ThreeArcs
from graphcam.plane_vectors import cross
from graphcam.words import say_in


@dataclass(frozen=True, eq=False)
class ThreeArcsGivens:
    """What lies on the board; see :func:`~graphcam.constructions.arc_outline.three_arcs`."""

    given: ThreeArcs
    dwell: float
    mu_l: Scale
    paper: Paper


ArcOutline = Construction[ThreeArcsGivens]
SENSE_NAMES = {1: say("clockwise"), -1: say("anticlockwise")}
"""The sense in which the follower is turned about a cam, by its :func:`sense_sign`."""


def sense_sign(arcs: ArcOutline) -> int:
    """The sign sigma of the first sample: +1 where A to D is clockwise, so that the cam turns counter-clockwise."""
    return -1 if float(cross(arcs.first("A"), arcs.first("D"))) > 0 else 1


def middle_of_dwell(arcs: ArcOutline) -> Drawn:
    """The line through the middle of the upper dwell: beyond it lies the mirror image of the rise, the return."""
    turn = -sense_sign(arcs) * arcs.givens.dwell / 2
    return errorless_hand(arcs).protractor("middle of the dwell", arcs.acts["O"].first, arcs.first("D"), turn)


def mirror_line(arcs: ArcOutline) -> Caption:
    """The name of the line in which the rise is mirrored."""
    if not arcs.givens.dwell:
        return say_in("mirrored in", "the line OD")
    return say_in("mirrored in", "the middle line of the dwell")


def outline(
    arcs: ArcOutline, axis: Drawn, circles: Sequence[Drawn], joints: Points, role: Role
) -> list[tuple[Arc, Drawn]]:
    """The closed profile of the first sample, arc by arc, each with the circle that it is a part of.

    axis : the middle of the upper dwell
    circles : about C2, C3 and C1, and about O the outer and the base circle
    joints : (4,) where the arcs of the rise begin, and where the last one ends

    The three arcs of the rise, the upper dwell if there is one, the return from the top down, the lower dwell.
    """
    hand = errorless_hand(arcs)
    image = hand.mirrored("joints of the return", hand.given("joints", joints), axis).points
    rise: list[tuple[Arc, Drawn]] = []
    back: list[tuple[Arc, Drawn]] = []
    for k, circle in enumerate(circles[:3]):
        turn = float(np.angle((joints[k + 1] - circle.place) / (joints[k] - circle.place)))
        other = hand.mirrored(f"{circle.act.name} on the return", circle.first, axis)
        rise.append((arc(circle, joints[k], turn, role), circle))
        back.append((arc(other, image[k], -turn, role), other))
    dwell, angle = arcs.givens.dwell, float(abs(np.angle(joints[3] / joints[0])))
    up = [(arc(circles[3], joints[3], -sense_sign(arcs) * dwell, role), circles[3])] if dwell else []
    down = arc(circles[4], image[0], -sense_sign(arcs) * (FULL_TURN - 2 * angle - dwell), role)
    return [*rise, *up, *back[::-1], (down, circles[4])]


def arc(circle: Drawn, start: complex, turn: float, role: Role, overhang: float = 0.0) -> Arc:
    """The part of a circle that begins at a point and turns by an angle [rad], counter-clockwise positive.

    overhang : how far it runs on beyond both ends [mm]
    """
    radius, first = float(np.asarray(circle.first.radius).item()), float(np.angle(start - circle.place))
    low, high = sorted((first, first + turn))
    more = overhang / radius
    return Arc(circle.place, radius, low - more, high + more, role).left_by(circle)


def cam(arcs: ArcOutline, axis: Drawn) -> list[tuple[Arc, Drawn]]:
    """The closed profile of the cam; see :func:`outline`."""
    circles = [arcs.acts[f"circle {name}"] for name in ("about C2", "about C3", "about C1", "through D", "through A")]
    return outline(arcs, axis, circles, np.array([arcs.acts[name].place for name in "AGFD"]), Role.RESULT)


ROLLER = View(
    *("roller", say("The roller on the arcs"), "roller x", "roller y"),
    scale=say("The roller on the arcs, {ratio}"),
    main=True,
)
ARCS = ("AG", "GF", "FD")
"""The arcs of the rise, in order."""
CENTRES = ("C₂", "C₃", "C₁")
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
        """The names 0, 1, 2 ... through the rise; one for the end of an arc and the start of the next."""
        return [str(k - arc) for k, arc in enumerate(self.arc.tolist())]

    @cached_property
    def places(self) -> dict[str, list[int]]:
        """The stations that bear each name, by the name.

        >>> list(divide_arcs(1).places.items())
        [('0', [0]), ('1', [1, 2]), ('2', [3, 4]), ('3', [5])]
        """
        return {name: [k for k, each in enumerate(self.names) if each == name] for name in dict.fromkeys(self.names)}

    @cached_property
    def ends_first(self) -> list[int]:
        """All stations, the ends of the arcs before those between, for what has no room for every name.

        >>> divide_arcs(2).ends_first
        [0, 2, 3, 5, 6, 8, 1, 4, 7]
        """
        return sorted(range(self.u.size), key=lambda k: 0 < self.u[k] < 1)

    @cached_property
    def titles(self) -> list[Words]:
        """The names of all stations, with their arc where two stations bear one name."""
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
