"""What the hand takes hold of in a drawing: where it lies, which sizes it changes, and what they become when it moves.

Places are complex, in mm of a view from its origin, y upwards; the page counts y downwards.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from graphcam.studio.size_ranges import SizeRange
from graphcam.words import Caption, Tell, say

Changes = dict[str, Any]
"""New values of a task by their paths."""
PULL = 2.5
"""A magnet draws what comes this near to it [mm of paper]."""
COARSE = 10
"""A coarse step is so many steps."""
DECIMALS = 3
TURN = SizeRange(0.0, 360.0, 0.5)
"""The range of the cam angle [degrees]."""


@dataclass(frozen=True)
class HandleAxis:
    """A size that a handle changes, as one slider for the keyboard.

    path : of the size;  name, unit : as they are told
    value : at present;  range : of it
    screen : "x" or "y", along which the arrow keys move it
    extra : what must be changed with it: ``first``, what is put into the task before; ``sum``, another size that is the
        rest of a total
    """

    path: str
    name: Caption
    unit: str
    value: float
    range: SizeRange
    screen: str
    extra: Mapping[str, Any] | None = None

    def plain(self, tell: Tell) -> dict[str, Any]:
        """The axis as plain data for the page."""
        each = self.range.around(self.value)
        return {
            "path": self.path,
            "name": tell(self.name),
            "unit": self.unit,
            "value": self.value,
            **each.plain(),
            "fine": round(each.step / 5, 9),
            "coarse": COARSE * each.step,
            "screen": self.screen,
            **(self.extra or {}),
        }


@dataclass(frozen=True, eq=False)
class Handle:
    """A place of a drawing that can be moved.

    key : its own among those of its view
    at : where it lies
    shape : how it moves: "x", "y", "xy" or "along", in the direction ``along``
    drag : what the sizes become if it is moved to a place, finely or not; snapped, and within their ranges
    limit : whether it lies where a limit is not kept
    """

    view: str
    key: str
    name: Caption
    at: complex
    shape: str
    axes: Sequence[HandleAxis]
    drag: Callable[[complex, bool], Changes]
    along: complex | None = None
    limit: bool = False

    @property
    def id(self) -> str:
        """An identifier that no other handle of the views has."""
        return f"{self.view}/{self.key}"

    def plain(self, tell: Tell) -> dict[str, Any]:
        """The handle as plain data for the page."""
        return {
            "id": self.id,
            "view": self.view,
            "name": tell(self.name),
            "at": on_page(self.at),
            "shape": self.shape,
            "along": None if self.along is None else on_page(self.along),
            "limit": self.limit,
            "axes": [axis.plain(tell) for axis in self.axes],
        }


@dataclass(frozen=True)
class HandleState:
    """What is shown besides the task.

    phi : cam angle [degrees], from 0 to 360
    station : that the velocity plan shows, by its number; None is the one that it shows by itself
    """

    phi: float = 0.0
    station: int | None = None


def on_page(place: complex) -> list[float]:
    """A place or direction as the page counts it.

    >>> on_page(3 + 4j)
    [3.0, -4.0]
    """
    return [round(place.real, DECIMALS) + 0.0, round(-place.imag, DECIMALS) + 0.0]


def drawn_to(value: float, magnets: Sequence[float], reach: float) -> float | None:
    """The magnet that a value is drawn to, if any.

    >>> drawn_to(4.2, [0.0, 5.0], 1.0), drawn_to(3.0, [0.0, 5.0], 1.0)
    (5.0, None)
    """
    near = [each for each in magnets if abs(each - value) <= reach]
    return min(near, key=lambda each: abs(each - value)) if near else None


def snapped(
    value: float, within: SizeRange, *, fine: bool = False, magnets: Sequence[float] = (), reach: float = 0.0
) -> float:
    """A value on a magnet, or else on a step, within its range; finely there are no magnets."""
    pulled = None if fine else drawn_to(value, magnets, reach)
    if pulled is not None and within.least <= pulled <= within.most:
        return pulled
    return within.kept(value, fine=fine)


def phi_axis(phi: float, screen: str = "x") -> HandleAxis:
    """The cam angle."""
    return HandleAxis("phi", say("Cam angle φ"), "°", phi, TURN, screen)
