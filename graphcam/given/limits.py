"""What a design must keep to."""

from __future__ import annotations

import math
from dataclasses import dataclass

from graphcam.errors import DesignError

USUAL_PRESSURE_ANGLE = {"translating": 30.0, "oscillating": 45.0}
"""The permitted pressure angle on the rise [degrees] where none is given, by the follower's kind."""


def usual_limit(kind: str) -> float:
    """The permitted pressure angle on the rise [rad] where none is given; of a flat face as of a translating follower.

    >>> round(math.degrees(usual_limit("oscillating")), 9)
    45.0
    """
    return math.radians(USUAL_PRESSURE_ANGLE.get(kind, USUAL_PRESSURE_ANGLE["translating"]))


@dataclass(frozen=True)
class Limits:
    """Permitted pressure angles [rad], as magnitudes.

    rise : on every rise
    return_ : on every return; None for force closure, where a spring drives the return
    rest : whether the angle at the low rest must keep the rise's limit too

    >>> Limits(rise=0.5).return_ is None
    True
    """

    rise: float = usual_limit("translating")
    return_: float | None = None
    rest: bool = True

    def __post_init__(self) -> None:
        for name, value in (("rise", self.rise), ("return", self.return_)):
            if value is not None and not 0 < value < math.pi / 2:
                quantity, limit = f"permitted pressure angle on the {name}", "between 0 and 90 degrees, both excluded"
                remedy = "30 degrees is usual for a translating follower"
                raise DesignError(quantity, f"{math.degrees(value):g} degrees", limit, remedy)
