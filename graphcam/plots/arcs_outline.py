"""A cam of three circular arcs: its profile, where the arcs touch, and their centres."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from graphcam.mechanism.arcs import ThreeArcCam
from graphcam.plots.cam_outline import SIZE, finished, mark_centre, turn
from graphcam.plots.figures import given_or_new, svg_of
from graphcam.sheets.styles import BLACK, CURRENT, GREY

NEAR = 1.5
"""A centre farther away than so many of the cam's greatest radii is not shown."""


def plot(cam: ThreeArcCam, axes: Axes | None = None) -> Axes:
    """Draw the profile of a sound cam, its flank's arcs and their centres, in mm."""
    motion = cam.motion()  # of a knife edge, which runs on the profile itself
    axes = given_or_new(axes, *SIZE)
    axes.plot(*motion.pitch_curve(turn(motion.breaks)).T, color=BLACK, linewidth=2.0, label="profile")
    joints = np.array([cam.A, cam.G, cam.F, cam.D])
    reach = NEAR * float(np.max(np.hypot(*joints.T)))
    centres = {name: at for name in ("C1", "C2", "C3") if np.hypot(*(at := getattr(cam, name))) <= reach}
    axes.plot(*joints.T, "o", color=CURRENT, markersize=4, label="ends of the arcs")
    axes.plot(
        *np.array(list(centres.values())).reshape(-1, 2).T, "o", color=GREY, markersize=4, label="centres of the arcs"
    )
    for name, at in {**dict(zip("AGFD", joints, strict=True)), **centres}.items():
        axes.annotate(name, (at[0], at[1]), xytext=(5, 5), textcoords="offset points")
    mark_centre(axes)
    return finished(axes)


def svg(cam: ThreeArcCam) -> str | None:
    """The cam as SVG, None of one that is not sound."""
    return svg_of(lambda axes: plot(cam, axes), *SIZE) if cam.sound else None
