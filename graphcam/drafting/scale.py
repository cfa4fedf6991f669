"""Scale factors: machine units per millimetre of paper."""

import math
from dataclasses import dataclass

from graphcam.errors import DesignError
from graphcam.words import Caption, say

STANDARD_RATIOS = (
    *(100.0, 50.0, 40.0, 20.0, 10.0, 5.0, 4.0, 2.5, 2.0, 1.0),
    *(1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 15, 1 / 20, 1 / 25, 1 / 40, 1 / 50, 1 / 75, 1 / 100),
)
"""Drawing scales of ISO 5455 and GOST 2.302, paper over machine, the largest first."""


@dataclass(frozen=True)
class Scale:
    """mu = ``per_mm`` machine units of ``unit`` for one millimetre of paper.

    >>> import graphcam as gc
    >>> gc.Scale(0.6, "mm").value(50), gc.Scale(0.6, "mm").paper(30)
    (30.0, 50.0)
    """

    per_mm: float
    unit: str

    def __post_init__(self) -> None:
        if not (math.isfinite(self.per_mm) and self.per_mm > 0):
            raise DesignError("scale", self.per_mm, f"a finite number of {self.unit} per mm greater than 0")

    def value(self, paper: float) -> float:
        """The machine value of a length on paper: mu times mm."""
        return self.per_mm * paper

    def paper(self, value: float) -> float:
        """The length on paper [mm] of a machine value."""
        return value / self.per_mm


def standard_scale(size: float, room: float) -> Scale:
    """The largest standard drawing scale at which ``size`` mm of machine fit into ``room`` mm of paper.

    >>> standard_scale(150, 310).per_mm
    0.5
    """
    for ratio in STANDARD_RATIOS:
        if size * ratio <= room:
            return Scale(1 / ratio, "mm")
    # Beyond the standard series: powers of ten go on for ever.
    return Scale(10.0 ** math.ceil(math.log10(size / room)), "mm")


def ratio_text(per_mm: float) -> Caption:
    """A drawing scale as it is written in a title block.

    >>> [str(ratio_text(per_mm)) for per_mm in (0.5, 2.5, 1.0)]
    ['2:1', '1:2.5', '1:1']
    """
    return say("{times:g}:1", times=1 / per_mm) if per_mm < 1 else say("1:{times:g}", times=per_mm)
