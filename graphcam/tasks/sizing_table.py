"""The table ``[sizing]`` of a task file: between what sizes the best cam is sought, and what best means."""

from dataclasses import dataclass
from typing import Literal

from graphcam.errors import DesignError, Unquoted, check_number
from graphcam.given.ranges import bounded, positive

RangeTable = float | tuple[float, float]
"""A range [mm], or the one size that is permitted."""


@dataclass(frozen=True)
class SizingTable:
    """``[sizing]``: the ranges [mm] for ``graphcam size``; it needs a ``[spring]`` and a ``[material]``.

    prime_radius, base_radius : one of both, the least radius of the pitch curve or of the profile
    offset, roller_radius, width : what is left out is what ``[follower]`` and ``[material]`` give
    objective : "size", the least radius, or "stress", the least contact stress

    Raises
    ------
    DesignError : a value that cannot be

    >>> SizingTable(base_radius=(60, 120), offset=20).ranges()["offset"]
    (20, 20)
    """

    prime_radius: RangeTable | None = None
    base_radius: RangeTable | None = None
    offset: RangeTable | None = None
    roller_radius: RangeTable | None = None
    width: RangeTable | None = None
    objective: Literal["size", "stress"] = "size"

    def __post_init__(self) -> None:
        for name, (low, high) in self.ranges().items():
            if not low <= high:
                limit = "a range from the smaller size to the larger, in mm"
                raise DesignError(name, Unquoted(f"from {low:g} to {high:g}"), limit, "exchange the two")
            for end in (low, high):
                if name == "offset":
                    _finite(name, end)
                    bounded(name, end, "mm")
                else:
                    positive(name, end, "mm")
        if (self.prime_radius is None) == (self.base_radius is None):
            either = "either prime_radius or base_radius"
            if self.prime_radius is None:
                raise DesignError("prime_radius", Unquoted("missing"), "given as a range in mm", f"give {either}")
            raise DesignError("base_radius", Unquoted("given beside prime_radius"), "left out", f"give {either}")

    def ranges(self) -> dict[str, tuple[float, float]]:
        """The ranges that are given, by their keys; one size is a range of two equal ends."""
        said = {name: getattr(self, name) for name in RANGES if getattr(self, name) is not None}
        return {name: value if isinstance(value, tuple) else (value, value) for name, value in said.items()}


RANGES = "prime_radius", "base_radius", "offset", "roller_radius", "width"
"""The keys that are ranges."""


def _finite(name: str, value: float) -> None:
    check_number(name, value, "a finite number of mm")
