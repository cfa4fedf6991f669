"""The face that is built: as far as the contact was drawn to wander, the margin that the task asks for, and rounded."""

from dataclasses import dataclass
from typing import Any

from graphcam.constructions.adoption import multiple, steps_up
from graphcam.constructions.chain import Chain
from graphcam.solving.warnings import LAST_DIGIT

Sides = tuple[float, float]
"""Lengths to the left and to the right of the follower's axis [mm]."""


@dataclass(frozen=True)
class FaceDesign:
    """A flat face with a margin on each side.

    drawn, exact : how far the contact wanders
    margin : mm, beyond the contact on each side
    rounding : mm, the adopted half-widths are multiples of it
    """

    drawn: Sides
    exact: Sides
    margin: float
    rounding: float

    @property
    def least(self) -> Sides:
        """The drawn half-widths with the margin [mm]."""
        left, right = self.drawn
        return left + self.margin, right + self.margin

    @property
    def adopted(self) -> Sides:
        """The half-widths, rounded up [mm].

        >>> FaceDesign((24.78, 24.08), (25.0, 24.2), 3.0, 1.0).adopted
        (28.0, 28.0)
        """
        left, right = (multiple(steps_up(side, self.rounding), self.rounding) for side in self.least)
        return left, right

    @property
    def wide_enough(self) -> bool:
        """Whether the adopted face has the margin beyond the exact contact too."""
        return all(
            exact + self.margin <= adopted + LAST_DIGIT for exact, adopted in zip(self.exact, self.adopted, strict=True)
        )

    def to_dict(self) -> dict[str, Any]:
        """The face as plain data [mm]."""
        sides = zip(("left", "right"), self.drawn, self.exact, self.adopted, strict=True)
        told = {side: {"drawn": drawn, "exact": exact, "adopted": adopted} for side, drawn, exact, adopted in sides}
        return {"margin": self.margin, **told, "width": sum(self.adopted)}


def face_design(chain: Chain, exact: Sides, margin: float) -> FaceDesign:
    """The face that a drawing proposes.

    exact : how far the contact wanders, to the left and to the right;  margin : beyond that [mm]
    """
    drawn = chain.perfect["inversion"]
    left, right = (float(drawn.value(f"face_{side}")) for side in ("left", "right"))
    return FaceDesign((left, right), exact, margin, chain.rounding)
