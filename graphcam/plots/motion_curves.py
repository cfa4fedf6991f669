"""A motion over one turn of the cam: s, v, a and j one under the other, and the bands of its tolerances."""

from typing import Protocol

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.motion_bands import MotionBands
from graphcam.plots.figures import ANGLE_LABEL, axes_on, diagrams_in, divide_turn, name_ordinates
from graphcam.sheets.styles import ACCENT, BLACK, CURRENT_COLOUR, GREY

CURVE_LABELS = (("lift s", BLACK), ("v = ds/dφ", CURRENT_COLOUR), ("a = dv/dφ", ACCENT), ("j = da/dφ", GREY))
"""Axis label and colour of each curve, from the top."""
UNITS_LABEL = "s in mm, of an arm in rad; v, a and j per rad of cam angle"
FIGURE_SIZE = 7.0, 7.0
"""The size of a new figure [inches]."""
PIECE_POINTS = 61
"""The number of points of each curve between two breaks."""
MIN_NAME_ANGLE, MIN_UPRIGHT_NAME_ANGLE = 28.0, 8.0
"""The minimum angles of a phase [degrees] for its name, and for its name turned upright."""


class PhasedMotion(Protocol):
    """A motion that can be drawn here, of phases or of arcs."""

    @property
    def breaks(self) -> Floats:
        """Cam angles [rad] where a derivative may jump."""
        ...

    @property
    def timing(self) -> list[tuple[str, float, float]]:
        """For each phase its kind, and the cam angles [rad] where it begins and ends."""
        ...

    def __call__(self, phi: ArrayLike, side: Side = "right") -> tuple[Floats, Floats, Floats, Floats]:
        """(s, v, a, j) at cam angles [rad]."""
        ...


def plot(motion: PhasedMotion, on: Axes | Figure | None = None, label: str = "", color: str | None = None) -> Axes:
    """Draw s, v, a and j in four diagrams inside of axes; returns the axes, whose ``child_axes`` are the diagrams."""
    axes = axes_on(on, *FIGURE_SIZE)
    second = bool(axes.child_axes)
    diagrams = diagrams_in(axes, len(CURVE_LABELS))
    phi, values = _curves(motion)
    for diagram, (_, colour), value in zip(diagrams, CURVE_LABELS, values, strict=True):
        diagram.plot(np.degrees(phi), value, color=color or colour, linewidth=1.5, label=label or None)
        if not second and not np.any(value):
            diagram.set(ylim=(-1.0, 1.0), yticks=[0.0])  # of no height there would be divisions of a hundredth
        diagram.axhline(0.0, color=BLACK, linewidth=0.6)
        for _, start, _ in motion.timing:
            diagram.axvline(np.degrees(start), color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
    if not second:
        divide_turn(axes, diagrams, ANGLE_LABEL if axes is on else f"{ANGLE_LABEL}\n{UNITS_LABEL}")
        name_ordinates(axes, diagrams, [name for name, _ in CURVE_LABELS], "svaj")
        _name_phases(diagrams[0], motion)
    if label:
        diagrams[0].legend(frameon=False, fontsize="small")
    return axes


JUMP_WIDTH = 1e-6
"""Over less of the cam angle [rad] the velocity jumps: what its derivatives are there is infinite, and not shown."""


def _curves(motion: PhasedMotion) -> tuple[Floats, Floats]:
    """Cam angles (n,) [rad] over the turn, those of jumps twice, and (4, n) the values of s, v, a, j there."""
    ends = np.append(motion.breaks, FULL_TURN)
    phi = np.linspace(ends[:-1], ends[1:], PIECE_POINTS, axis=1)
    right, left = np.array(motion(phi[:, :-1])), np.array(motion(phi[:, -1:], "left"))
    values = np.concatenate([right, left], axis=2)
    values[2:, np.diff(ends) < JUMP_WIDTH] = np.nan
    return phi.ravel(), values.reshape(4, -1)


def _name_phases(diagram: Axes, motion: PhasedMotion) -> None:
    for kind, start, end in motion.timing:
        wide = np.degrees(end - start)
        if wide >= MIN_UPRIGHT_NAME_ANGLE:
            middle, turned = float(np.degrees(start + end) / 2), 0 if wide >= MIN_NAME_ANGLE else 90
            above = diagram.get_xaxis_transform()
            diagram.text(middle, 1.02, kind, transform=above, rotation=turned, ha="center", va="bottom", size="small")


BAND_FIGURE_SIZE = 7.0, 7.5
"""The size of a new figure of bands [inches]."""
CURVE_SYMBOLS = "s", "v", "a"
BAND_HEIGHT_SHARE = 0.12
"""The height of a band at its widest, as a part of the range of the nominal curve."""
ROUND_FACTORS = 1.0, 2.0, 5.0, 10.0


def plot_bands(bands: MotionBands, on: Axes | Figure | None = None, label: str = "", color: str | None = None) -> Axes:
    """Draw s, v and a in three diagrams inside of axes; returns the axes, whose ``child_axes`` they are."""
    axes = axes_on(on, *BAND_FIGURE_SIZE)
    diagrams = diagrams_in(axes, len(CURVE_SYMBOLS))
    degrees, sample = np.degrees(bands.phi), bands.sample
    for k, diagram in enumerate(diagrams):
        nominal, half = bands.nominal[k], bands.half_width[k]
        times = magnification(nominal, half)
        low, high = nominal + times * sample.low[k], nominal + times * sample.high[k]
        solved = f"{bands.samples} mechanisms, solved"
        diagram.fill_between(degrees, low, high, color=color or CURRENT_COLOUR, alpha=0.3, linewidth=0, label=solved)
        for sign in (-1, 1):
            order = "to the first order" if sign > 0 else None
            diagram.plot(degrees, nominal + sign * times * half, color=color or ACCENT, linewidth=1.0, label=order)
        diagram.plot(degrees, nominal, color=color or BLACK, linewidth=1.2, label=label or "nominal")
        diagram.axhline(0.0, color=BLACK, linewidth=0.6)
        for _, start, _ in bands.cam.motion.timing:
            diagram.axvline(np.degrees(start), color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
        diagram.text(
            1.01, 0.5, f"bands × {times:g}", rotation=90, transform=diagram.transAxes, va="center", color=ACCENT
        )
    diagrams[0].legend(frameon=False, fontsize="small", loc="best")
    divide_turn(axes, diagrams, f"{ANGLE_LABEL}\n{UNITS_LABEL.replace('v, a and j', 'v and a')}")
    name_ordinates(axes, diagrams, CURVE_SYMBOLS, CURVE_SYMBOLS)
    diagrams[0].set_title(f"{100 * bands.coverage:g} of 100 mechanisms lie within the bands", fontsize="medium")
    return axes


def magnification(nominal: Floats, half_width: Floats) -> float:
    """The factor, a round number, by which bands are drawn wider.

    >>> magnification(np.array([0.0, 30.0]), np.array([0.01, 0.02]))
    100.0
    """
    wanted = BAND_HEIGHT_SHARE * float(np.ptp(nominal)) / max(float(half_width.max()), 1e-300)
    power = 10.0 ** np.floor(np.log10(max(wanted, 1.0)))
    return float(max(times * power for times in ROUND_FACTORS if times * power <= max(wanted, 1.0)))
