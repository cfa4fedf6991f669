"""Forces, torque and contact stress over the turn of the cam."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.given.laws import Floats
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.hertz import ContactStress
from graphcam.mechanism.turn_extremes import TurnCurve, ValueAt, over_turn
from graphcam.plots.figures import ANGLE_LABEL, axes_on, diagrams_in, divide_turn, name_ordinates
from graphcam.sheets.styles import ACCENT, BLACK, CURRENT_COLOUR, GREY

FIGURE_SIZE = 7.0, 5.0
"""The size of a new figure of forces [inches]."""
SIZE_OF_STRESS = 7.0, 3.6
"""The size of a new figure of stress [inches]."""


def plot(forces: CamForces, on: Axes | Figure | None = None, label: str = "", color: str | None = None) -> Axes:
    """Draw normal force and torque in two diagrams inside of axes; returns the axes, whose ``child_axes`` they are."""
    axes = axes_on(on, *FIGURE_SIZE)
    upper, lower = diagrams_in(axes, 2)
    curves: Mapping[str, tuple[Axes, TurnCurve, str]] = {
        name: (diagram, over_turn(forces.cam.motion, quantity, forces.pressing.knots), own)
        for name, diagram, quantity, own in (
            ("normal force N, N", upper, forces.normal, CURRENT_COLOUR),
            ("torque on the cam, N mm", lower, forces.torque, ACCENT),
        )
    }
    for diagram, curve, own in curves.values():
        _draw(diagram, forces, curve, label, color or own)
    divide_turn(axes, (upper, lower), ANGLE_LABEL)
    name_ordinates(axes, (upper, lower), [*curves], ("N", "T"))
    upper.set_title(f"Forces at {forces.load.speed_rpm:g} rpm", fontsize="medium")
    return axes


def plot_stress(
    stress: ContactStress, on: Axes | Figure | None = None, label: str = "", color: str | None = None
) -> Axes:
    """Draw the peak pressure of the contact over the turn, with its maximum; returns the axes."""
    axes = axes_on(on, *SIZE_OF_STRESS)
    greatest = stress.max_pressure()
    _draw(axes, stress.forces, stress.curve(), label, color or ACCENT, greatest)
    divide_turn(axes, (axes,), ANGLE_LABEL)
    axes.set_ylabel("contact stress p, MPa")
    axes.set_title(f"Contact stress at {stress.forces.load.speed_rpm:g} rpm", fontsize="medium")
    return axes


def _draw(
    diagram: Axes, forces: CamForces, curve: TurnCurve, label: str, colour: str, marked: ValueAt | None = None
) -> None:
    """Draw a curve over the turn, where the phases begin, and a marked place of it."""
    phi: Floats = np.degrees(curve.phi)
    diagram.plot(phi, curve.values, color=colour, linewidth=1.5, label=label or None)
    diagram.axhline(0.0, color=BLACK, linewidth=0.6)
    for _, start, _ in forces.cam.motion.timing:
        diagram.axvline(np.degrees(start), color=GREY, linewidth=0.6, linestyle=(0, (4, 3)))
    if marked:
        at = np.degrees(marked.phi), marked.value
        diagram.plot(*at, "o", color=colour, markersize=4)
        diagram.annotate(f"{marked.value:.4g}", at, (4, 4), textcoords="offset points", color=colour)
    if label:
        diagram.legend(frameon=False, fontsize="small")
