"""A cam at the start of its turn: pitch curve, working profile, prime circle, and the roller or the flat face."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.three_arc_cam import ThreeArcCam
from graphcam.plots.figures import axes_on, size_of
from graphcam.sheets.styles import ACCENT, BLACK, CURRENT_COLOUR, GREY

FIGURE_SIZE = 6.0, 6.5
"""The size of a new figure [inches]."""
PIECE_POINTS = 181
"""The number of points of each curve between two breaks."""
LEGEND_ROOM = 0.22
"""Room for the legend, as a part of the cam's height."""
MIN_HEIGHT = 3.5
"""The minimum height of axes [inches] with a legend below the cam."""
FACE_HALF_LENGTH = 0.5
"""Half of the drawn face, as a part of the prime radius."""
SENSE_NAMES = {"ccw": "anticlockwise", "cw": "clockwise"}


def plot(cam: Cam, on: Axes | Figure | None = None, label: str = "", color: str | None = None) -> Axes:
    """Draw a cam in its own coordinates [mm], as it stands at the start of the turn; returns the axes.

    Under a label the working profile alone stands in the legend.
    """
    axes = axes_on(on, *FIGURE_SIZE)
    phi = turn(cam.motion.breaks)
    pitch, profile = cam.pitch_curve(phi), cam.profile(phi)
    flat, unnamed = np.array_equal(pitch, profile), "_" if label else ""
    if not flat:
        axes.plot(
            *pitch.T, color=color or GREY, linewidth=1.0, linestyle=(0, (9, 2, 1, 2)), label=f"{unnamed}pitch curve"
        )
    axes.plot(*profile.T, color=color or BLACK, linewidth=2.0, label=label or "working profile")
    circle = np.stack([np.cos(phi), np.sin(phi)], axis=-1)
    prime = f"{unnamed}prime circle, {cam.prime_radius:.6g} mm"
    axes.plot(*(cam.prime_radius * circle).T, color=color or GREY, linewidth=1.0, linestyle="--", label=prime)
    if cam.roller_radius:
        roller = cam.pitch_curve(0.0) + cam.roller_radius * circle
        named = f"{unnamed}roller, {cam.roller_radius:.6g} mm"
        axes.plot(*roller.T, color=color or CURRENT_COLOUR, linewidth=1.5, label=named)
    if flat:
        half, up = FACE_HALF_LENGTH * cam.prime_radius, profile[0, 1]
        axes.plot([-half, half], [up, up], color=color or CURRENT_COLOUR, linewidth=1.5, label=f"{unnamed}flat face")
    mark_centre(axes, unnamed)
    axes.set_title(f"Cam that turns {SENSE_NAMES[cam.rotation]}, at φ = 0", fontsize="medium")
    return finish_axes(axes)


def turn(breaks: Floats) -> Floats:
    """Cam angles [rad] over a whole turn, the breaks among them."""
    ends = np.append(breaks, FULL_TURN)
    return np.unique(np.linspace(ends[:-1], ends[1:], PIECE_POINTS))


def mark_centre(axes: Axes, unnamed: str) -> None:
    """Draw a cross at the cam centre."""
    axes.plot([0.0], [0.0], "+", color=ACCENT, markersize=10, label=f"{unnamed}cam centre")


def finish_axes(axes: Axes) -> Axes:
    """Set equal scales and axis labels, and put the legend below the cam, in room of its own; returns the axes.

    Low axes have no legend: there is no room for one, and ``axes.legend()`` puts it where the caller wants it.
    """
    axes.autoscale()
    axes.set(xlabel="x, mm", ylabel="y, mm", aspect="equal")
    if size_of(axes)[1] < MIN_HEIGHT:
        return axes
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom - LEGEND_ROOM * (top - bottom), top)
    axes.legend(loc="lower center", ncols=2, frameon=False, fontsize="small")
    return axes


MAX_CENTRE_DISTANCE = 1.2
"""The distance up to which a centre is shown, as a multiple of the cam's maximum radius."""


def plot_arcs(cam: ThreeArcCam, on: Axes | Figure | None = None, label: str = "", color: str | None = None) -> Axes:
    """Draw the profile of a sound cam, its flank's arcs and their centres [mm]; returns the axes."""
    motion = cam.motion()  # of a knife edge, which runs on the profile itself
    axes = axes_on(on, *FIGURE_SIZE)
    axes.plot(*motion.pitch_curve(turn(motion.breaks)).T, color=color or BLACK, linewidth=2.0, label=label or "profile")
    joints = np.array([cam.A, cam.G, cam.F, cam.D])
    reach = MAX_CENTRE_DISTANCE * float(np.max(np.hypot(*joints.T)))
    centres = {name: at for name in ("C1", "C2", "C3") if np.hypot(*(at := getattr(cam, name))) <= reach}
    unnamed = "_" if label else ""
    axes.plot(*joints.T, "o", color=color or CURRENT_COLOUR, markersize=4, label=f"{unnamed}arc ends")
    at_centres = np.array(list(centres.values())).reshape(-1, 2)
    axes.plot(*at_centres.T, "o", color=color or GREY, markersize=4, label=f"{unnamed}arc centres")
    for name, at in {**dict(zip("AGFD", joints, strict=True)), **centres}.items():
        axes.annotate(name, (at[0], at[1]), xytext=(5, 5), textcoords="offset points")
    mark_centre(axes, unnamed)
    axes.margins(0.1)  # for the names
    return finish_axes(axes)
