"""The table ``[sizing]`` of a task file: the ranges of sizes for the best cam, and the objective."""

from dataclasses import dataclass
from typing import Literal

from graphcam.errors import DesignError
from graphcam.tasks.number_limits import check_limits
from graphcam.tasks.units import Length, Size
from graphcam.words import say

RangeTable = Size | tuple[Size, Size]
"""A range [mm], or the one size that is permitted."""


@dataclass(frozen=True)
class SizingTable:
    """``[sizing]``: ranges in which ``graphcam size`` seeks the best cam; it needs [spring], [material] and a stress.

    prime_radius : mm, or base_radius, which is less by the roller; a number in place of a range gives a size
    base_radius : mm, in place of prime_radius
    offset : mm; offset, roller_radius and width: left out: as [follower] and [material] give them
    roller_radius : mm
    width : mm, of the contact
    objective : "size", the smallest cam; or "stress", that of the lowest contact stress

    Raises
    ------
    DesignError : a value that cannot be

    >>> SizingTable(base_radius=(60, 120), offset=20).ranges()["offset"]
    (20, 20)
    """

    prime_radius: RangeTable | None = None
    base_radius: RangeTable | None = None
    offset: Length | tuple[Length, Length] | None = None
    roller_radius: RangeTable | None = None
    width: RangeTable | None = None
    objective: Literal["size", "stress"] = "size"

    def __post_init__(self) -> None:
        check_limits(self)
        for name, (low, high) in self.ranges().items():
            if not low <= high:
                limit = say("a range from the smaller size to the larger, in mm")
                found = say("from {low:g} to {high:g}", low=low, high=high)
                raise DesignError(name, found, limit, say("exchange the two"))
        if (self.prime_radius is None) == (self.base_radius is None):
            either = say("either prime_radius or base_radius")
            if self.prime_radius is None:
                limit = say("given as a range in mm")
                raise DesignError("prime_radius", say("missing"), limit, say("give {either}", either=either))
            found = say("given beside prime_radius")
            raise DesignError("base_radius", found, say("left out"), say("give {either}", either=either))

    def ranges(self) -> dict[str, tuple[float, float]]:
        """The ranges (low, high) that are given [mm], by their keys; one size is a range of two equal ends."""
        said = {name: getattr(self, name) for name in RANGE_KEYS if getattr(self, name) is not None}
        return {name: value if isinstance(value, tuple) else (value, value) for name, value in said.items()}


RANGE_KEYS = "prime_radius", "base_radius", "offset", "roller_radius", "width"
"""The keys of the table that are ranges."""
