"""The mechanism over a turn, exactly: where the follower is, where it touches, and which way it is pushed.

Points are complex, in mm, in the frame with the cam centre at the origin; the step player lets them move.
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from graphcam.constructions.axes import phase_symbol, phase_title
from graphcam.drafting.ink import Caption, Points, say
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.solving.solution import Solution

POSITIONS = 720
"""In a turn, so that the cam angle goes in halves of a degree."""


@dataclass(frozen=True)
class TurnPhase:
    """A phase of the turn: its name in full and in short, and the cam angles [rad] where it begins and ends."""

    name: str | Caption
    symbol: str | Caption
    start: float
    end: float


@dataclass(frozen=True, eq=False)
class MechanismScene:
    """A mechanism at n + 1 cam angles, the last position the first again.

    kind : what follows: a stem with a roller or a knife edge, an arm, a flat face
    sigma : the sense in which the cam turns;  roller : its radius, 0 for none;  pivot : of the arm
    profile : (m,) the closed profile of the cam as it lies at phi = 0
    face : how far the face reaches to the left (negative) and to the right
    phi : (n + 1,) cam angles [rad]
    trace, contact : (n + 1,) the trace point, or the middle of the face, and where the profile is touched
    motion, normal : (n + 1,) unit directions of the trace point's motion on the rise, and of the normal off the cam
    alpha : (n + 1,) from the motion to the normal, positive in the sense of the rotation [rad]
    s, v : (n + 1,) displacement and velocity [mm, mm/rad; of an arm rad, rad/rad]
    """

    kind: Literal["stem", "arm", "face"]
    sigma: int
    roller: float
    profile: Points
    phases: tuple[TurnPhase, ...]
    phi: Floats
    trace: Points
    contact: Points
    motion: Points
    normal: Points
    alpha: Floats
    s: Floats
    v: Floats
    pivot: complex = 0j
    face: tuple[float, float] = (0.0, 0.0)


def cam_scene(solution: Solution) -> MechanismScene:
    """The mechanism of a solution.

    >>> import graphcam as gc
    >>> found = cam_scene(gc.solve(gc.builtin_task()))
    >>> found.kind, found.trace[0].round(4).item(), found.phi.size
    ('stem', (-10+42.8486j), 721)
    """
    cam, phi = solution.cam, _turn()
    values = cam.motion(phi)
    shown, normal = cam.kinematics.appearance(cam.motion, values), cam.kinematics.normal(values)
    contact = cam.kinematics.point(values) - cam.roller_radius * normal
    starts = [*cam.motion.starts.tolist(), 2 * math.pi]
    phases = tuple(
        TurnPhase(phase_title(cam.motion, k), phase_symbol(cam.motion, k), start, end)
        for k, (start, end) in enumerate(pairwise(starts))
    )
    profile, alpha = _outline(cam, contact, phi), cam.pressure_angle(phi)
    points, (s, v, *_) = (shown.trace, contact, shown.motion, normal), values
    placed = shown.pivot, shown.face
    return MechanismScene(shown.kind, cam.sigma, cam.roller_radius, profile, phases, phi, *points, alpha, s, v, *placed)


def _outline(cam: Cam, contact: Points, phi: Floats) -> Points:
    """The profile that is cut; where none can be cut, the whole envelope with its loops."""
    try:
        points = cam.trimmed_profile(POSITIONS)
    except DesignError:
        return (contact * np.exp(-1j * cam.sigma * phi))[:-1]
    return points[:, 0] + 1j * points[:, 1]


def arcs_scene(solution: ArcsSolution) -> MechanismScene:
    """The mechanism of a cam of arcs, seen so that the follower stands upright."""
    moved, phi = solution.motion, _turn()
    s, v, _, _ = moved(phi)
    alpha = moved.pressure_angle(phi)
    normal = 1j * np.exp(1j * moved.sigma * alpha)
    trace = 1j * (moved.prime_radius + s)
    contact = trace - moved.roller_radius * normal
    edges = [0.0, moved.rise, moved.rise + moved.dwell, 2 * moved.rise + moved.dwell, 2 * math.pi]
    names = (say("rise"), say("upper dwell"), say("return"), say("lower dwell"))
    phases = tuple(TurnPhase(n, n, a, b) for n, (a, b) in zip(names, pairwise(edges), strict=True) if b > a)
    profile = (contact * np.exp(-1j * moved.sigma * phi))[:-1]
    points = (trace, contact, np.full(phi.shape, 1j), normal)
    return MechanismScene("stem", moved.sigma, moved.roller_radius, profile, phases, phi, *points, alpha, s, v)


def _turn() -> Floats:
    return np.linspace(0.0, 2 * math.pi, POSITIONS + 1)
