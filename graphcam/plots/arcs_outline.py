"""A cam of three circular arcs: its profile, where the arcs touch, and their centres."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from graphcam.mechanism.arcs import ThreeArcCam
from graphcam.plots.cam_outline import SIZE, finished, mark_centre, turn
from graphcam.plots.figures import axes_on
from graphcam.sheets.styles import BLACK, CURRENT, GREY

NEAR = 1.2
"""A centre farther away than so many of the cam's greatest radii is not shown."""


def plot(cam: ThreeArcCam, on: Axes | Figure | None = None) -> Axes:
    """Draw the profile of a sound cam, its flank's arcs and their centres, in mm."""
    motion = cam.motion()  # of a knife edge, which runs on the profile itself
    axes = axes_on(on, *SIZE)
    axes.plot(*motion.pitch_curve(turn(motion.breaks)).T, color=BLACK, linewidth=2.0, label="profile")
    joints = np.array([cam.A, cam.G, cam.F, cam.D])
    reach = NEAR * float(np.max(np.hypot(*joints.T)))
    centres = {name: at for name in ("C1", "C2", "C3") if np.hypot(*(at := getattr(cam, name))) <= reach}
    axes.plot(*joints.T, "o", color=CURRENT, markersize=4, label="arc ends")
    axes.plot(*np.array(list(centres.values())).reshape(-1, 2).T, "o", color=GREY, markersize=4, label="arc centres")
    for name, at in {**dict(zip("AGFD", joints, strict=True)), **centres}.items():
        axes.annotate(name, (at[0], at[1]), xytext=(5, 5), textcoords="offset points")
    mark_centre(axes)
    axes.margins(0.1)  # for the names
    return finished(axes)
