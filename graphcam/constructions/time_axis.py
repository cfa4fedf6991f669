"""The diagrams over time: where the cam has a speed, a second graduation of the axis, in seconds, and of ordinates.

The curves stay as they are.  As t = phi/omega, the scale of the time is mu_t = mu_phi/omega, and those of velocity,
acceleration and jerk are mu_v omega, mu_a omega^2 and mu_j omega^3.
"""

import math

import numpy as np

from graphcam.constructions.axes import LONG_TICK, PHASES_BELOW, TICK, TICKS_ROOM, reach
from graphcam.constructions.graduation import ROUND, graduated, round_up
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, say
from graphcam.drafting.marks import Label, Line, Mark, Origin, Role, Segments
from graphcam.drafting.scale import Scale
from graphcam.drafting.units import unit
from graphcam.given.angular_velocity import MM_PER_M
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

TIMES_APART = 16.0
"""Numbers of seconds stand at least so far apart [mm of paper]."""
UNDER_PHASES, UNDER_DEGREES = 6.0, 10.0
"""The times stand so far below the angles of the phases, and below a line of degrees without them [mm of paper]."""
BESIDE = 17.0
"""The second graduation of an ordinate stands so far beside the first one [mm of paper]."""
PER_SECOND = {"mm": ("m/s", "m/s²", "m/s³"), "rad": ("rad/s", "rad/s²", "rad/s³")}
"""The units of velocity, acceleration and jerk at a speed, by that of the lift."""
SYMBOLS = "vaj"


def time_scale(mu_phi: Scale, omega: float) -> Scale:
    """Seconds for a millimetre of the axis, at an angular velocity [rad/s].

    >>> round(time_scale(Scale(math.radians(1), "rad"), 2 * math.pi).per_mm * 360, 12)
    1.0
    """
    return Scale(mu_phi.per_mm / omega, "s")


def scale_at_speed(per_mm: float, symbol: str, omega: float, lift_unit: str) -> Scale:
    """The scale of v, a or j at an angular velocity [rad/s], from that per radian of the cam.

    >>> scale_at_speed(2.0, "a", 10.0, "mm")
    Scale(per_mm=0.2, unit='m/s²')
    """
    order = SYMBOLS.index(symbol) + 1
    per_unit = MM_PER_M if lift_unit == "mm" else 1.0
    return Scale(per_mm * omega**order / per_unit, PER_SECOND[lift_unit][order - 1])


def times_below(end: float, mu_phi: Scale, low: float, omega: float | None, *, phases: bool = True) -> tuple[Mark, ...]:
    """A line graduated in seconds under a diagram that reaches down to ``low`` [mm of paper]; none without a speed.

    phases : whether the angles of the phases stand above it, or degrees alone
    """
    if omega is None:
        return ()
    mu_t, level = time_scale(mu_phi, omega), low - (PHASES_BELOW + UNDER_PHASES if phases else UNDER_DEGREES + LOWER)
    every, lead = round_up(TIMES_APART * mu_t.per_mm, ROUND)
    parts = 4 if lead == 2 else 5
    parts = parts if every / mu_t.per_mm / parts >= TICKS_ROOM else 1
    counts = np.arange(math.floor(end * mu_t.per_mm / every * parts * (1 + 1e-12)) + 1)
    whole = counts % parts == 0
    x = counts * (every / parts / mu_t.per_mm) + level * UP
    below = x - np.where(whole, LONG_TICK, TICK) * UP
    named = zip(below[whole].tolist(), (counts[whole] // parts).tolist(), strict=True)
    return (
        Line(np.array([0.0, end]) + level * UP, Role.SCALE),
        Segments(x, below, Role.SCALE),
        *(Label(at, say("{t:.6g}", t=n * every), towards=-UP, small=True) for at, n in named),
        # The scale stands over the line, in the last phase: beside it there may be another view.
        Label(complex(end, level), say("t, {unit}", unit=unit("s")), 1 + 0j),
        Label(complex(end, level), say("μₜ = {mu:.4g} {unit}/mm", unit=unit("s"), mu=mu_t.per_mm), -1 + 1j, small=True),
    )


LOWER = 11.0
"""So far below the lowest place of a diagram a line of degrees ends, with its numbers [mm of paper]."""


def axis_said(mu_phi: Scale, omega: float) -> Caption:
    """How the axis of the cam angle becomes one of time."""
    return say(
        "At ω = {omega:.5g} rad/s one revolution takes T = 2π/ω = {turn:.4g} s, so the same axis is one of time: μₜ = "
        "μᵩ/ω = {mu:.4g} s/mm."
    ).where(omega=omega, turn=FULL_TURN / omega, mu=time_scale(mu_phi, omega).per_mm)


_FACTORS = say("ω"), say("ω²"), say("ω³")


def scale_said(per_mm: float, symbol: str, omega: float, lift_unit: str) -> Caption:
    """The scale of v, a or j in metres and seconds, beside that per radian of the cam."""
    at = scale_at_speed(per_mm, symbol, omega, lift_unit)
    said = say("Over time a millimetre is {mu:.5g}·{factor} = {value:.4g} {unit}: the graduation farther to the right.")
    factor = _FACTORS[SYMBOLS.index(symbol)]
    if lift_unit == "mm":
        said = say(
            "Over time a millimetre is {mu:.5g}·{factor}/1000 = {value:.4g} {unit}: the graduation farther to the "
            "right."
        )
    return said.where(mu=per_mm, factor=factor, value=at.per_mm, unit=unit(at.unit))


def graduated_at_speed(
    heights: Floats, per_mm: float, symbol: str, omega: float, lift_unit: str, end: float, of: Origin | None
) -> tuple[Mark, ...]:
    """The second graduation of the ordinates of v, a or j, beside the one at the ``end`` of the turn [mm of paper]."""
    at, x = scale_at_speed(per_mm, symbol, omega, lift_unit), end + BESIDE
    low, high = reach(heights)
    return (
        Line(x + UP * np.array([low, high]), Role.SCALE, of=of),
        *graduated(heights, at.per_mm, x, of),
        Label(x + high * UP, say("{symbol}, {unit}", symbol=symbol, unit=unit(at.unit)), towards=UP, of=of),
    )
