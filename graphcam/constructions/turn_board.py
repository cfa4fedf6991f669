"""What lies on the board of every diagram over the cam angle: its axes, and what stands under the lowest of them."""

from dataclasses import dataclass, field

from graphcam.constructions.axes import (
    broken_angles,
    degrees_below,
    height_range,
    ordinate_title,
    phase_ends,
    phases_below,
    phi_axes,
    second_line,
)
from graphcam.constructions.graduation import times_below
from graphcam.drafting.marks import Mark
from graphcam.drafting.scale import Scale
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.stations import Stations


@dataclass(frozen=True, eq=False)
class TurnGivens:
    """What lies on the board of a diagram over the cam angle.

    ordinate : greatest of the first rise in the acceleration diagram [mm of paper]
    mu_phi : scale of the cam angle [rad/mm];  unit : of the lift
    omega : of the cam [rad/s], where the task gives a speed: then the axis is one of time too
    """

    motion: Motion
    stations: Stations
    ordinate: float
    mu_phi: Scale
    unit: str
    omega: float | None = field(default=None, kw_only=True)

    @property
    def end(self) -> float:
        """The end of the turn on the axis of the cam angle [mm of paper]."""
        return float(phase_ends(self.motion, self.mu_phi)[-1])

    def axes(self, symbol: str, heights: Floats) -> tuple[Mark, ...]:
        """The axes of the diagram of a quantity that reaches over ``heights`` [mm of paper]."""
        return phi_axes(self.motion, self.stations, self.mu_phi, heights, ordinate_title(symbol, self.unit))

    def degrees_under(self, heights: Floats) -> tuple[Mark, ...]:
        """The numbers under a diagram that is the lowest on its page: degrees, and times where there is a speed."""
        low = height_range(heights)[0]
        times = times_below(self.end, self.mu_phi, low, self.omega, phases=False)
        return (*degrees_below(self.end, self.mu_phi, low), *broken_angles(self.motion, self.mu_phi, low), *times)

    def phases_under(self, heights: Floats) -> tuple[Mark, ...]:
        """The numbers under the lowest diagram of all: degrees, the angles of the phases, and times."""
        low = height_range(heights)[0]
        phases = phases_below(self.motion, self.mu_phi, low)
        return (*phases, *times_below(self.end, self.mu_phi, low - second_line(self.motion), self.omega))
