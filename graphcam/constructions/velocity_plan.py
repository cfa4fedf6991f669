"""The velocity plan of any follower at a station, v₂ = v₁ + v₂₁: what a millimetre of it stands for, and its sides."""

from dataclasses import dataclass, replace

from graphcam.constructions.views import PLAN
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, View, Words, say
from graphcam.drafting.marks import Arrow, Label, Mark, Role
from graphcam.drafting.scale import Scale, ratio_text, unit
from graphcam.given.follower import MM_PER_M
from graphcam.plane_vectors import dot

SPEED_CAPTION = say("{symbol} = {speed:.3g} {unit}")


@dataclass(frozen=True)
class VelocityScale:
    """The scales of a velocity plan.

    mu_l : mm of the mechanism, or mm/rad of a velocity divided by ω, to a millimetre of paper
    omega : of the cam [rad/s], None where no speed is given
    """

    mu_l: Scale
    omega: float | None

    @property
    def mu(self) -> Scale:
        """The scale of the velocities [(m/s)/mm], or of their quotients by ω [(mm/rad)/mm].

        >>> VelocityScale(Scale(0.5, "mm"), 20.0).mu
        Scale(per_mm=0.01, unit='m/s')
        """
        if self.omega is None:
            return Scale(self.mu_l.per_mm, "mm/rad")
        return Scale(self.mu_l.per_mm * self.omega / MM_PER_M, "m/s")

    @property
    def acceleration(self) -> Scale:
        """The scale of accelerations drawn with them [(m/s²)/mm], or of their quotients by ω² [(mm/rad²)/mm]."""
        if self.omega is None:
            return Scale(self.mu_l.per_mm, "mm/rad²")
        return Scale(self.mu_l.per_mm * self.omega**2 / MM_PER_M, "m/s²")

    def view(self, station: str) -> View:
        """The view of the plan at a station; its title says both scales."""
        title = say("Velocity plan at station {name}, {ratio}, μᵥ = {mu:.4g} ({unit})/mm")
        mu, ratio = self.mu, ratio_text(self.mu_l.per_mm)
        said = title.with_values(name=station, ratio=ratio, mu=mu.per_mm, unit=unit(mu.unit))
        return replace(PLAN, title=said, mu_l=self.mu_l.per_mm)

    def side_caption(self, symbol: str, side: complex) -> Words:
        """The name of a side [mm of paper], with its speed where one is given."""
        if self.omega is None:
            return symbol
        return SPEED_CAPTION.with_values(symbol=symbol, speed=self.mu.value(abs(side)), unit=unit(self.mu.unit))

    def speed_captions(self, pole: Drawn, v1: Drawn, v2: Drawn) -> tuple[Caption, ...]:
        """The speeds that the sides stand for, in a sentence, where a speed is given."""
        if self.omega is None:
            return ()
        one, two = v1.place - pole.place, v2.place - pole.place
        said = say("At ω = {omega:.4g} {per_s} 1 mm is {mu:.4g} {unit}: {v1}, {v2}, {v21}.")
        names = {
            "v1": self.side_caption("v₁", one),
            "v2": self.side_caption("v₂", two),
            "v21": self.side_caption("v₂₁", two - one),
        }
        units = {"per_s": unit("rad/s"), "unit": unit(self.mu.unit)}
        return (said.with_values(omega=self.omega, mu=self.mu.per_mm, **units, **names),)


def velocity_plan(pole: Drawn, v1: Drawn, v2: Drawn, v21: Drawn, scale: VelocityScale) -> tuple[Mark, ...]:
    """The plan from its pole: v₁ across the radius, v₂ along the motion, and the line v₂₁ that closes it."""
    start, one, other = pole.place, v1.place, v2.place
    sides = (("v₁", start, one, other, v1), ("v₂", start, other, one, v2), ("v₂₁", one, other, start, v21))
    return (
        *(v1.arrow(pole, Role.CURVE), v2.arrow(pole, Role.CURVE), Arrow(one, other, Role.CURVE).left_by(v21)),
        *(
            Label((a + b) / 2, scale.side_caption(symbol, b - a), _outward_direction(a, b, opposite)).left_by(side)
            for symbol, a, b, opposite, side in sides
        ),
        pole.label("p", -1 - 1j),
    )


def _outward_direction(start: complex, end: complex, opposite: complex) -> complex:
    """The direction square to a side of a triangle, away from the opposite corner."""
    across = UP * (end - start)
    return across if dot(across, opposite - start) < 0 else -across
