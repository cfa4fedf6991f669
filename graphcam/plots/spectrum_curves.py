"""The shock spectrum of a law: the greatest accelerations during a rise and after it, over the ratio of times."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.mechanism.shock_response import ShockSpectrum
from graphcam.plots.figures import axes_on
from graphcam.sheets.styles import ACCENT, BLACK, GREY

SIZE = 7.0, 4.2
"""The size of a new figure [inches]."""
BELOW = -0.16
"""The place where the legend begins, as a part of the diagram's height."""
ROOM = 1.05
"""The height of the axes, as a multiple of the highest value."""
FEW = 3
"""Fewer ratios are points and no curve."""
DECADES = 2.0
"""Ratios over more decades stand on a scale of logarithms."""


def plot(spectrum: ShockSpectrum, on: Axes | Figure | None = None) -> Axes:
    """Draw primary and residual accelerations over n, with the cam's own greatest acceleration."""
    axes = axes_on(on, *SIZE)
    order = np.argsort(spectrum.n)
    n = spectrum.n[order]
    axes.axhline(spectrum.peak, color=GREY, linewidth=1.0, linestyle=(0, (6, 4)), label="the cam's own, $C_a$")
    marker = "o" if n.size < FEW else ""
    for values, colour, label in (
        (spectrum.primary, BLACK, "during the rise (primary)"),
        (spectrum.residual, ACCENT, "in the dwell after it (residual)"),
    ):
        axes.plot(n, values[order], color=colour, marker=marker, linewidth=1.5, label=label)
    axes.set(
        xlabel="n, time of the rise over natural period",
        ylabel="maximum acceleration, $h/T^2$",
        ylim=(0, ROOM * max(float(spectrum.greatest.max()), spectrum.peak)),
    )
    if n[-1] > 10**DECADES * n[0]:
        axes.set_xscale("log")
    elif n.size > 1:
        axes.set_xlim(n[0], n[-1])
    damped = f"damping ratio {spectrum.damping:g}" if spectrum.damping else "without damping"
    axes.set_title(f"Shock spectrum, {spectrum.law}, {damped}", fontsize="medium")
    axes.grid(visible=True, color="#dddddd", linewidth=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    # Below the diagram: inside, some law's curve would run through it.
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, BELOW), ncols=3, frameon=False, fontsize="small")
    return axes
