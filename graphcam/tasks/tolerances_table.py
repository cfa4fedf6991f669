"""The table ``[tolerances]`` of a task file: how far profile and sizes may deviate when they are made."""

from dataclasses import dataclass

from graphcam.errors import DesignError
from graphcam.given.making_errors import TOLERANCED_SIZES, Distribution, MakingErrors, deviations_within
from graphcam.tasks.number_limits import check_limits
from graphcam.tasks.units import Size
from graphcam.words import say


@dataclass(frozen=True)
class TolerancesTable:
    """``[tolerances]``: errors of making: how far the motion may be off, and which tolerance matters most.

    waviness : mm, amplitudes of waves of the profile along its normal
    harmonics : as many: waves per turn
    roller_diameter : mm, widths of tolerance zones, from the smallest size to the largest
    offset : mm, of a translating follower
    distance : mm, of an arm: of the centre distance
    arm : mm, and of the arm's length
    distribution : of the sizes in their zones: "normal", three standard deviations on either side; or "uniform"
    coverage : the part of all mechanisms that the bands hold

    Raises
    ------
    DesignError : a value that cannot be

    >>> TolerancesTable(waviness=(0.005,), harmonics=(24,), offset=0.05)().reaches
    {'waviness 24': 0.005, 'offset': 0.025}
    """

    waviness: tuple[Size, ...] = ()
    harmonics: tuple[int, ...] = ()
    roller_diameter: Size | None = None
    offset: Size | None = None
    distance: Size | None = None
    arm: Size | None = None
    distribution: Distribution = "normal"
    coverage: float = 0.95

    def __post_init__(self) -> None:
        check_limits(self)
        self()
        deviations_within(self.coverage)

    def __call__(self) -> MakingErrors:
        """The errors of making in the terms of the exact side."""
        sizes = {name: getattr(self, name) or 0.0 for name in TOLERANCED_SIZES}
        return MakingErrors(self.waviness, self.harmonics, **sizes, distribution=self.distribution)

    def check(self, kind: str, own: tuple[str, ...]) -> None:
        """Refuse tolerances of sizes that this kind of follower does not have.

        Raises
        ------
        DesignError : there is such a tolerance
        """
        for name in TOLERANCED_SIZES:
            if (tolerance := getattr(self, name)) is not None and name not in own:
                left_out = say("left out for a follower of kind {kind}", kind=kind)
                remedy = say("of its sizes none is to be made: waviness is left")
                if own:
                    remedy = say("it has {names}", names=", ".join(own))
                raise DesignError(f"tolerances.{name}", tolerance, left_out, remedy)
