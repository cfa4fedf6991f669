"""Bands of s, v and a over the turn, so many times as wide as they are, about the nominal curves."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.given.laws import Floats
from graphcam.mechanism.motion_bands import MotionBands
from graphcam.plots.figures import axes_on
from graphcam.plots.motion_curves import ACROSS, GAP
from graphcam.sheets.styles import ACCENT, BLACK, CURRENT, GREY

SIZE = 7.0, 7.5
"""The size of a new figure [inches]."""
SYMBOLS = "s", "v", "a"
OF_RANGE = 0.12
"""The widest place of a band is drawn about so many times as high as the nominal curve ranges."""
ROUND = 1.0, 2.0, 5.0, 10.0
BEFORE = -0.12
"""The place of the names of the axes, as a part of the diagrams' width."""


def plot(bands: MotionBands, on: Axes | Figure | None = None) -> Axes:
    """Draw s, v and a in three diagrams inside of axes; returns the axes, whose ``child_axes`` they are."""
    axes = axes_on(on, *SIZE)
    axes.set_axis_off()
    height = (1 + GAP) / 3
    diagrams = [axes.inset_axes((0.0, k * height, 1.0, height - GAP)) for k in (2, 1, 0)]
    degrees, sample = np.degrees(bands.phi), bands.sample
    for k, (diagram, symbol) in enumerate(zip(diagrams, SYMBOLS, strict=True)):
        nominal, half = bands.nominal[k], bands.half_width[k]
        times = magnified(nominal, half)
        low, high = nominal + times * sample.low[k], nominal + times * sample.high[k]
        label = f"{bands.samples} mechanisms, solved"
        diagram.fill_between(degrees, low, high, color=CURRENT, alpha=0.3, linewidth=0, label=label)
        for sign in (-1, 1):
            label = "to the first order" if sign > 0 else None
            diagram.plot(degrees, nominal + sign * times * half, color=ACCENT, linewidth=1.0, label=label)
        diagram.plot(degrees, nominal, color=BLACK, linewidth=1.2, label="nominal")
        diagram.axhline(0.0, color=BLACK, linewidth=0.6)
        for _, start, _ in bands.cam.motion.timing:
            diagram.axvline(np.degrees(start), color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
        diagram.set(xlim=(0, 360), xticks=range(0, 361, 30), ylabel=symbol)
        diagram.tick_params(labelbottom=diagram is diagrams[-1])
        diagram.yaxis.set_label_coords(BEFORE, 0.5)
        diagram.spines[["top", "right"]].set_visible(False)
        diagram.text(
            1.01, 0.5, f"bands × {times:g}", rotation=90, transform=diagram.transAxes, va="center", color=ACCENT
        )
    diagrams[0].legend(frameon=False, fontsize="small", loc="best")
    diagrams[-1].set_xlabel(ACROSS.replace("; v, a and j", "; v and a"))
    diagrams[0].set_title(f"{100 * bands.coverage:g} of 100 mechanisms lie within the bands", fontsize="medium")
    return axes


def magnified(nominal: Floats, half_width: Floats) -> float:
    """How many times as wide a band is drawn, a round number.

    >>> magnified(np.array([0.0, 30.0]), np.array([0.01, 0.02]))
    100.0
    """
    wanted = OF_RANGE * float(np.ptp(nominal)) / max(float(half_width.max()), 1e-300)
    power = 10.0 ** np.floor(np.log10(max(wanted, 1.0)))
    return float(max(times * power for times in ROUND if times * power <= max(wanted, 1.0)))
