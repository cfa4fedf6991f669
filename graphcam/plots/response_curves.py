"""An elastic follower: its response to one rise, its steady motion over a turn, and shock spectra."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.follower_train import VibratingFollower
from graphcam.mechanism.shock_response import FollowerResponse, ShockSpectrum
from graphcam.plots.figures import ANGLE_LABEL, axes_on, diagrams_in, divide_turn
from graphcam.sheets.styles import ACCENT, BLACK, CURRENT_COLOUR, GREY

FIGURE_SIZE = 7.0, 5.0
"""The size of a new figure [inches]."""
POINTS_PER_PERIOD, MIN_POINTS = 24, 400
"""Points of a curve in a natural period, and the minimum number in all."""
SHOWN_AFTER_RISE = 0.6, 3.0
"""The time shown after the rise: rise times, or natural periods, whichever is longer."""
AXIS_NAME_OFFSET = -0.11
"""The horizontal place of the axis labels, as a part of the diagrams' width."""


def plot(
    shown: FollowerResponse | VibratingFollower,
    on: Axes | Figure | None = None,
    label: str = "",
    color: str | None = None,
) -> Axes:
    """Draw two diagrams inside of axes, one above the other; returns the axes, whose ``child_axes`` they are."""
    axes = axes_on(on, *FIGURE_SIZE)
    upper, lower = diagrams_in(axes, 2)
    if isinstance(shown, FollowerResponse):
        _response(shown, upper, lower, label or "mass", color)
    else:
        _turn(shown, upper, lower, label or "mass", color)
        divide_turn(axes, (upper, lower), ANGLE_LABEL)
    for diagram in (upper, lower):
        diagram.axhline(0.0, color=BLACK, linewidth=0.6)
        diagram.spines[["top", "right"]].set_visible(False)
        diagram.yaxis.set_label_coords(AXIS_NAME_OFFSET, 0.5)
        diagram.legend(frameon=False, fontsize="small")
    upper.tick_params(labelbottom=False)
    return axes


def _response(response: FollowerResponse, upper: Axes, lower: Axes, label: str, color: str | None) -> None:
    """Plot displacement and acceleration of the cam and of the mass over the time."""
    end = response.event.end
    until = end + max(SHOWN_AFTER_RISE[0], SHOWN_AFTER_RISE[1] / response.n)
    u = np.linspace(0, until, MIN_POINTS + round(POINTS_PER_PERIOD * response.n * until))
    # Twice where the cam's acceleration may jump, seen from either side.
    edges = response.event.drive.edges
    u = np.sort(np.concatenate([u, np.nextafter(edges, -1), np.nextafter(edges, until)]))
    s, a = np.full(u.size, response.event.level), np.zeros(u.size)
    moving = (u > 0) & (u < end)
    s[moving], _, a[moving] = response.event.lift(u[moving])
    s[u <= 0] = 0.0
    x, _, x2 = response(u)
    upper.plot(u, s, color=GREY, linewidth=1.5, linestyle=(0, (6, 3)), label="cam")
    upper.plot(u, x, color=color or CURRENT_COLOUR, linewidth=1.5, label=label)
    lower.plot(u, a, color=GREY, linewidth=1.5, linestyle=(0, (6, 3)), label="cam")
    lower.plot(u, x2, color=color or ACCENT, linewidth=1.5, label=label)
    for diagram in (upper, lower):
        diagram.axvline(end, color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
        diagram.set_xlim(0, until)
    upper.set_ylabel("lift, $h$")
    lower.set(ylabel="acceleration, $h/T^2$", xlabel="time, times of the rise $T$")
    damped = f"damping ratio {response.damping:g}" if response.damping else "without damping"
    title = f"{response.event.name}, {response.n:g} natural periods in the rise, {damped}"
    upper.set_title(title, fontsize="medium")


def _turn(follower: VibratingFollower, upper: Axes, lower: Axes, label: str, color: str | None) -> None:
    """Plot the acceleration of the cam and of the mass, and the force on the cam, over the turn."""
    phi = _dense_angles(follower)
    found = follower(phi)
    degrees = np.degrees(phi)
    upper.plot(degrees, follower.motion(phi)[2], color=GREY, linewidth=1.2, linestyle=(0, (6, 3)), label="cam")
    upper.plot(degrees, found.a, color=color or CURRENT_COLOUR, linewidth=1.5, label=label)
    force = "force on the cam" if label == "mass" else label
    lower.plot(degrees, found.force, color=color or BLACK, linewidth=1.5, label=force)
    for number, (start, end) in enumerate(follower.lost()):
        for turned in (0.0, FULL_TURN):  # an end beyond the turn is shown at its beginning
            span = np.degrees([start - turned, end - turned])
            lost = "contact is lost" if number == 0 and turned == 0 else None
            lower.axvspan(*span, color=color or ACCENT, alpha=0.3, linewidth=0, label=lost)
    for diagram in (upper, lower):
        for _, start, _ in follower.motion.timing:
            diagram.axvline(np.degrees(start), color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
    upper.set_ylabel("acceleration, mm/rad²")
    lower.set_ylabel("force, N")
    upper.set_title(f"Elastic follower at {follower.speed_rpm:g} rpm", fontsize="medium")


def _dense_angles(follower: VibratingFollower) -> Floats:
    """Cam angles (n,) [rad] over the turn, on both sides of every break, close enough to show the vibrations."""
    breaks = follower.motion.breaks
    phi = np.linspace(0, FULL_TURN, MIN_POINTS + round(POINTS_PER_PERIOD * follower.vibrations))
    before = np.nextafter(breaks[breaks > 0], 0)
    return np.sort(np.concatenate([phi[:-1], breaks, before, [np.nextafter(FULL_TURN, 0)]]))


SIZE_OF_SPECTRUM = 7.0, 4.2
"""The size of a new figure of a spectrum [inches]."""
LEGEND_OFFSET = -0.16
"""The vertical place of the legend, as a part of the diagram's height."""
AXIS_ROOM = 1.05
"""The height of the axes, as a multiple of the maximum value."""
MIN_CURVE_POINTS = 3
"""The minimum number of ratios that are joined by a curve; fewer are points."""
MAX_LINEAR_DECADES = 2.0
"""The maximum number of decades of the ratios on a linear scale; more stand on a logarithmic one."""


def plot_spectrum(
    spectrum: ShockSpectrum, on: Axes | Figure | None = None, label: str = "", color: str | None = None
) -> Axes:
    """Draw primary and residual accelerations over n, with the cam's own maximum acceleration; returns the axes."""
    axes = axes_on(on, *SIZE_OF_SPECTRUM)
    order = np.argsort(spectrum.n)
    n = spectrum.n[order]
    axes.axhline(spectrum.peak, color=GREY, linewidth=1.0, linestyle=(0, (6, 4)), label="the cam's own, $C_a$")
    marker = "o" if n.size < MIN_CURVE_POINTS else ""
    before = f"{label}, " if label else ""
    for values, colour, line, name in (
        (spectrum.primary, BLACK, "-", "during the rise (primary)"),
        (spectrum.residual, ACCENT, "--" if color else "-", "in the dwell after it (residual)"),
    ):
        axes.plot(n, values[order], line, color=color or colour, marker=marker, linewidth=1.5, label=f"{before}{name}")
    axes.set(
        xlabel="n, time of the rise over natural period",
        ylabel="maximum acceleration, $h/T^2$",
        ylim=(0, AXIS_ROOM * max(float(spectrum.maximum.max()), spectrum.peak)),
    )
    if n[-1] > 10**MAX_LINEAR_DECADES * n[0]:
        axes.set_xscale("log")
    elif n.size > 1:
        axes.set_xlim(n[0], n[-1])
    damped = f"damping ratio {spectrum.damping:g}" if spectrum.damping else "without damping"
    axes.set_title(f"Shock spectrum, {spectrum.law}, {damped}", fontsize="medium")
    axes.grid(visible=True, color="#dddddd", linewidth=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    # Below the diagram: inside, some law's curve would run through it.
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, LEGEND_OFFSET), ncols=3, frameon=False, fontsize="small")
    return axes
