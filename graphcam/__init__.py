"""Cams designed on the drawing board: textbook constructions drawn to scale, computed, and compared with exact values.

Units.  Machine lengths in mm, forces in N, stress in MPa, mass in kg; angles in radians, but in degrees in files,
tables, captions and any name that ends in ``_deg``.  Derivatives are with respect to the cam angle phi in radians:
s [mm], v = ds/dphi [mm/rad], a [mm/rad^2], j [mm/rad^3].  For an oscillating follower s is the angle psi - psi0 [rad].

Paper.  Lengths on paper are in mm too, so every name of one ends in ``_paper``.  A scale mu is machine units per mm of
paper: value = mu * length_paper.

Frame.  Cam centre at the origin, x right, y up.  The cam turns by phi >= 0 in the sense sigma: ``rotation="ccw"`` is
sigma = +1, ``"cw"`` is sigma = -1.  By inversion a point fixed to the frame appears in cam coordinates turned by
-sigma*phi.  All coordinates of profiles are cam coordinates at phi = 0.

- Translating follower: the trace point (roller centre or knife edge) moves up along x = e.  r0 is the *prime radius*,
  the least radius of the pitch curve; s0 = sqrt((r0 - e)(r0 + e)); the trace point is (e, s0 + s), and
  tan(alpha) = (v - sigma*e)/(s0 + s), positive on an ordinary rise.  A favourable offset has sigma*e > 0.
- Oscillating follower: pivot at (c, 0), arm l above the line of centres, psi the angle between them;
  cos(psi0) = (c^2 + l^2 - r0^2)/(2 c l), psi = psi0 + s, tan(alpha) = (l (1 + sigma*v) - c cos(psi))/(c sin(psi)).
- Flat-faced follower: contact at (sigma*v, r0 + s); the radius of curvature of the profile is r0 + s + a.
- Curvature kappa of the pitch curve is positive where the cam is convex.
- The working profile is the inner parallel curve of the pitch curve at the roller radius.

Errors.  A design that cannot be raises :class:`DesignError`, a wrong file :class:`TaskError`; inside arrays a miss is
NaN.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphcam.arcs_task import ArcsTask
    from graphcam.drafting.ink import Construction, Reading, Step
    from graphcam.drafting.pencil import Pencil
    from graphcam.drafting.scale import Scale
    from graphcam.errors import DesignError, GraphcamError, TaskError
    from graphcam.given.follower import FlatFaced, Oscillating, Translating
    from graphcam.given.guide import Guide
    from graphcam.given.laws import LAWS, law
    from graphcam.given.measured import IntegratedMotion, MeasuredMotion, integrated_motion, measured_motion
    from graphcam.given.motion import Dwell, Motion, Return, Rise, cam_angle
    from graphcam.given.spring_load import SpringLoad
    from graphcam.main_job import ArcsSolution, Solution, solve
    from graphcam.main_job.sizing_sheet import sizing_sheet
    from graphcam.mechanism.arc_motion import ArcMotion
    from graphcam.mechanism.arcs import ThreeArcCam, three_arc_cam
    from graphcam.mechanism.batch.designs import Designs
    from graphcam.mechanism.batch.sweep import sweep
    from graphcam.mechanism.cam import Cam
    from graphcam.mechanism.contact import Contact, SpringPreload, spring_preload
    from graphcam.mechanism.flat_faced import FaceWidth, face_width
    from graphcam.mechanism.forces import CamForces
    from graphcam.mechanism.hertz import ContactStress, LineContact, RollerContact, hertz_line_contact
    from graphcam.mechanism.least_radius import FlatMinimumRadius, MinimumRadius, minimum_radius
    from graphcam.mechanism.least_radius_arm import ArmMinimumRadius
    from graphcam.mechanism.sizing import SizedCam, size_cam
    from graphcam.mechanism.spline import ProfileSpline, profile_spline
    from graphcam.mechanism.three_points import circumradius
    from graphcam.mechanism.undercut import Undercut, largest_roller
    from graphcam.task import Task
    from graphcam.task_file import builtin_arcs_task, builtin_task, load_task

__version__ = "0.1.0"

__all__ = [
    "LAWS",
    "ArcMotion",
    "ArcsSolution",
    "ArcsTask",
    "ArmMinimumRadius",
    "Cam",
    "CamForces",
    "Construction",
    "Contact",
    "ContactStress",
    "DesignError",
    "Designs",
    "Dwell",
    "FaceWidth",
    "FlatFaced",
    "FlatMinimumRadius",
    "GraphcamError",
    "Guide",
    "IntegratedMotion",
    "LineContact",
    "MeasuredMotion",
    "MinimumRadius",
    "Motion",
    "Oscillating",
    "Pencil",
    "ProfileSpline",
    "Reading",
    "Return",
    "Rise",
    "RollerContact",
    "Scale",
    "SizedCam",
    "Solution",
    "SpringLoad",
    "SpringPreload",
    "Step",
    "Task",
    "TaskError",
    "ThreeArcCam",
    "Translating",
    "Undercut",
    "builtin_arcs_task",
    "builtin_task",
    "cam_angle",
    "circumradius",
    "face_width",
    "hertz_line_contact",
    "integrated_motion",
    "largest_roller",
    "law",
    "load_task",
    "measured_motion",
    "minimum_radius",
    "profile_spline",
    "size_cam",
    "sizing_sheet",
    "solve",
    "spring_preload",
    "sweep",
    "three_arc_cam",
]


_WHEN_USED = {
    "ProfileSpline": "graphcam.mechanism.spline",
    "Undercut": "graphcam.mechanism.undercut",
    "largest_roller": "graphcam.mechanism.undercut",
    "profile_spline": "graphcam.mechanism.spline",
    "SizedCam": "graphcam.mechanism.sizing",
    "size_cam": "graphcam.mechanism.sizing",
    "sizing_sheet": "graphcam.main_job.sizing_sheet",
    "LAWS": "graphcam.given.laws",
    "ArcMotion": "graphcam.mechanism.arc_motion",
    "ArcsSolution": "graphcam.main_job",
    "ArcsTask": "graphcam.arcs_task",
    "ArmMinimumRadius": "graphcam.mechanism.least_radius_arm",
    "Cam": "graphcam.mechanism.cam",
    "Designs": "graphcam.mechanism.batch.designs",
    "sweep": "graphcam.mechanism.batch.sweep",
    "CamForces": "graphcam.mechanism.forces",
    "Construction": "graphcam.drafting.ink",
    "Contact": "graphcam.mechanism.contact",
    "ContactStress": "graphcam.mechanism.hertz",
    "DesignError": "graphcam.errors",
    "Dwell": "graphcam.given.motion",
    "FaceWidth": "graphcam.mechanism.flat_faced",
    "FlatFaced": "graphcam.given.follower",
    "FlatMinimumRadius": "graphcam.mechanism.least_radius",
    "GraphcamError": "graphcam.errors",
    "Guide": "graphcam.given.guide",
    "IntegratedMotion": "graphcam.given.measured",
    "LineContact": "graphcam.mechanism.hertz",
    "MeasuredMotion": "graphcam.given.measured",
    "MinimumRadius": "graphcam.mechanism.least_radius",
    "Motion": "graphcam.given.motion",
    "Oscillating": "graphcam.given.follower",
    "Pencil": "graphcam.drafting.pencil",
    "Reading": "graphcam.drafting.ink",
    "Return": "graphcam.given.motion",
    "Rise": "graphcam.given.motion",
    "RollerContact": "graphcam.mechanism.hertz",
    "Scale": "graphcam.drafting.scale",
    "Solution": "graphcam.main_job",
    "SpringLoad": "graphcam.given.spring_load",
    "SpringPreload": "graphcam.mechanism.contact",
    "Step": "graphcam.drafting.ink",
    "Task": "graphcam.task",
    "TaskError": "graphcam.errors",
    "ThreeArcCam": "graphcam.mechanism.arcs",
    "Translating": "graphcam.given.follower",
    "builtin_arcs_task": "graphcam.task_file",
    "builtin_task": "graphcam.task_file",
    "cam_angle": "graphcam.given.motion",
    "circumradius": "graphcam.mechanism.three_points",
    "face_width": "graphcam.mechanism.flat_faced",
    "hertz_line_contact": "graphcam.mechanism.hertz",
    "integrated_motion": "graphcam.given.measured",
    "law": "graphcam.given.laws",
    "measured_motion": "graphcam.given.measured",
    "load_task": "graphcam.task_file",
    "minimum_radius": "graphcam.mechanism.least_radius",
    "solve": "graphcam.main_job",
    "spring_preload": "graphcam.mechanism.contact",
    "three_arc_cam": "graphcam.mechanism.arcs",
}
"""Where the public names stand: a module loads when its name is used, so that importing graphcam costs nothing."""


def __getattr__(name: str) -> Any:
    if name not in _WHEN_USED:
        raise AttributeError(f"module 'graphcam' has no attribute '{name}'")
    value = globals()[name] = getattr(import_module(_WHEN_USED[name]), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
