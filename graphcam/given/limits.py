"""What a design must keep to."""

import math
from dataclasses import dataclass
from numbers import Real

from graphcam.errors import DesignError, check_kind
from graphcam.given.follower import Translating
from graphcam.words import say

QUARTER_TURN = math.pi / 2
PERMITTED = {
    "rise": say("permitted pressure angle on the rise"),
    "return": say("permitted pressure angle on the return"),
}
"""What an error calls a limit, by its name."""


@dataclass(frozen=True)
class Limits:
    """Permitted pressure angles [rad], as magnitudes.

    rise : on every rise
    return_ : on every return; None for force closure, where a spring drives the return
    rest : whether the angle in the lower dwell must keep the rise's limit too

    Raises
    ------
    DesignError : an angle is not between 0 and 90 degrees

    >>> import graphcam as gc
    >>> gc.Limits(rise=math.radians(30), return_=math.radians(45)).rest
    True
    >>> gc.Limits(rise=30)
    Traceback (most recent call last):
    graphcam.errors.DesignError: permitted pressure angle on the rise is 1718.87 degrees, but must be between 0 and ...
    """

    rise: float = math.radians(Translating.usual_limit_deg)
    return_: float | None = None
    rest: bool = True

    def __post_init__(self) -> None:
        back = self.return_
        for name, angle in (("rise", self.rise), ("return", 0.0 if back is None else back)):
            check_kind(PERMITTED[name], angle, Real, say("an angle in rad"), say("30 degrees are math.radians(30)"))
        if not (0 < self.rise < QUARTER_TURN and (back is None or 0 < back < QUARTER_TURN)):
            name, value = ("return", back) if 0 < self.rise < QUARTER_TURN else ("rise", self.rise)
            given, limit = math.degrees(value or 0.0), say("between 0 and 90 degrees, both excluded")
            remedy = say("30 degrees is usual for a translating follower")
            if given > 360:
                remedy = say("write math.radians({value:g}) if it is in degrees", value=value)
            raise DesignError(PERMITTED[name], say("{given:g} degrees", given=given), limit, remedy)

    def slip(self) -> tuple[str, float] | None:
        """The name and the degrees of a limit so small that radians were given for degrees; None if there is none.

        >>> Limits(rise=math.radians(0.52)).slip()
        ('rise', 0.52)
        >>> Limits(rise=0.52).slip()
        """
        for name, value in (("rise", self.rise), ("return", self.return_)):
            if value is not None and (given := math.degrees(value)) <= QUARTER_TURN:
                return name, round(given, 12)
        return None
