"""The exact mechanism over a turn, and as plain data with which the step player turns the cam.

Points are complex, in mm, in the frame with the cam centre at the origin; the step player lets them move.
"""

import math
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Any, Literal

import numpy as np

from graphcam.constructions.axes import phase_symbol, phase_title
from graphcam.drafting.ink import Caption, Points, say
from graphcam.drafting.scale import unit as unit_of
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.cam import Cam
from graphcam.plane_vectors import turned
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.solving.shown_solution import plain_number
from graphcam.solving.solution import Solution
from graphcam.subscripts import in_html
from graphcam.words import Tell

DECIMALS = 3
"""Decimals of lengths [mm] and angles [degrees], more than a screen shows."""
SCENE_DESCRIPTIONS = {
    "stem": say("Cam and translating follower; the normal and the line of motion make the pressure angle."),
    "arm": say("Cam and oscillating follower; the normal and the direction of motion make the pressure angle."),
    "face": say("Cam and flat-faced follower; the normal of the face is its line of motion."),
    "blade": say("Cam and oscillating flat face; the contact wanders along the face."),
}
INSTANT_CENTRES = {
    False: say("P is the instant centre of cam and follower; its distance from the cam centre is v."),
    True: say("P is the instant centre of cam and follower."),
}
"""What the mark P is, by whether the follower swings."""
LIVE_READINGS = ("pressure_angle", "displacement", "velocity")
"""Quantities shown while the cam turns; a flat face has no pressure angle."""


POSITION_COUNT = 720
"""The number of positions in a turn, one for each half degree of the cam angle."""


@dataclass(frozen=True)
class TurnPhase:
    """A phase of the turn: its name, its short name, and the cam angles [rad] where it begins and ends."""

    name: str | Caption
    symbol: str | Caption
    start: float
    end: float


@dataclass(frozen=True, eq=False)
class MechanismScene:
    """A mechanism at n + 1 cam angles; the last position is the first again.

    kind : of the follower: a stem with a roller or a knife edge, an arm, a flat face, a flat face that swings
    sigma : the sense in which the cam turns;  roller : its radius, 0 for none;  pivot : of the arm, or of the face
    profile : (m,) the closed profile of the cam as it lies at phi = 0
    face : how far the face reaches to the left (negative) and to the right, or where it begins and ends from its pivot
    phi : (n + 1,) cam angles [rad]
    trace, contact : (n + 1,) the trace point, or the middle of the face, or the contact on a face that swings, and
        where the profile is touched
    motion, normal : (n + 1,) unit directions of the trace point's motion on the rise, and of the normal off the cam
    alpha : (n + 1,) from the motion to the normal, positive in the sense of the rotation [rad]
    s, v : (n + 1,) displacement and velocity [mm, mm/rad; of an arm rad, rad/rad]
    rho : (n + 1,) radius of curvature of the profile [mm], negative where it is hollow; NaN where it is cut away
    """

    kind: Literal["stem", "arm", "face", "blade"]
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
    rho: Floats
    pivot: complex = 0j
    face: tuple[float, float] = (0.0, 0.0)

    @property
    def swings(self) -> bool:
        """Whether the follower swings about the pivot."""
        return self.kind in ("arm", "blade")

    @property
    def has_face(self) -> bool:
        """Whether a face touches the profile: then there is no pitch curve beside it."""
        return self.kind in ("face", "blade")


def cam_scene(solution: Solution) -> MechanismScene:
    """The mechanism of a solution.

    >>> import graphcam as gc
    >>> found = cam_scene(gc.solve(gc.builtin_task()))
    >>> found.kind, found.trace[0].round(4).item(), found.phi.size
    ('stem', (-10+42.8486j), 721)
    """
    cam, phi = solution.cam, _turn()
    origin = cam.motion.origin
    values = cam.motion(phi - origin)
    shown, normal = cam.kinematics.appearance(cam.motion, values), cam.kinematics.normal(values)
    contact = cam.kinematics.point(values) - cam.roller_radius * normal
    starts = origin + np.array([*cam.motion.starts.tolist(), FULL_TURN])
    # A phase that reaches over the table's 0 is shown at both ends of the turn.
    phases = tuple(
        TurnPhase(phase_title(cam.motion, k), phase_symbol(cam.motion, k), max(start, 0.0), min(end, FULL_TURN))
        for turn in (FULL_TURN, 0.0, -FULL_TURN)
        for k, (start, end) in enumerate(pairwise((starts + turn).tolist()))
        if max(start, 0.0) < min(end, FULL_TURN)
    )
    phases = tuple(sorted(phases, key=lambda phase: phase.start))
    profile, alpha = _outline(cam, contact, phi), cam.pressure_angle(phi - origin)
    points, (s, v, *_) = (shown.trace, contact, shown.motion, normal), values
    placed = shown.pivot, shown.face
    moved, rho = (alpha, s, v), _profile_radius(cam.pitch_curvature(phi - origin), cam.roller_radius)
    return MechanismScene(shown.kind, cam.sigma, cam.roller_radius, profile, phases, phi, *points, *moved, rho, *placed)


def _profile_radius(pitch_curvature: Floats, roller_radius: float) -> Floats:
    """The radius of curvature of a profile [mm], by the curvature of its pitch curve [1/mm]."""
    with np.errstate(divide="ignore"):
        rho = 1 / pitch_curvature - roller_radius
    return np.where((pitch_curvature > 0) & (rho < 0), np.nan, rho)


def _outline(cam: Cam, contact: Points, phi: Floats) -> Points:
    """The profile (m,) that is cut; where none can be cut, the whole envelope with its loops."""
    try:
        points = turned(cam.trimmed_profile(POSITION_COUNT), cam.table_turn)
    except DesignError:
        return (contact * np.exp(-1j * cam.sigma * phi))[:-1]
    return points[:, 0] + 1j * points[:, 1]


def arcs_scene(solution: ArcsSolution) -> MechanismScene:
    """The mechanism of a cam of arcs, turned so that the follower is vertical."""
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
    rho = _profile_radius(moved.pitch_curvature(phi), moved.roller_radius)
    return MechanismScene("stem", moved.sigma, moved.roller_radius, profile, phases, phi, *points, alpha, s, v, rho)


def _turn() -> Floats:
    return np.linspace(0.0, 2 * math.pi, POSITION_COUNT + 1)


def mechanism_view(scene: MechanismScene, tell: Tell, decimal: str = ".") -> dict[str, Any]:
    """The scene as data for ``mechanism.js``: lengths in mm, angles in degrees.

    tell : translates into the language of the page, whose decimal sign is ``decimal``
    """
    greatest = float(np.abs(scene.trace).max())
    unit, swings = greatest / 28, scene.swings
    ground, top = (_pivot(scene, unit), 0.0) if swings else _guide(scene, unit)
    degree = math.degrees(1.0) if swings else 1.0
    pitch = None if scene.has_face else _points((scene.trace * np.exp(-1j * scene.sigma * scene.phi))[:-1])
    stem, face = top + 1.5 * unit - float(scene.trace.imag.min()), (scene.face[0] - 2 * unit, scene.face[1] + 2 * unit)
    sizes = {"unit": unit, "roller": scene.roller, "reach": 0.55 * greatest, "stem": stem}
    live = dict(zip(LIVE_READINGS, (np.degrees(scene.alpha), degree * scene.s, scene.v), strict=True))
    if scene.kind == "face":
        del live["pressure_angle"]
    of_velocity = unit_of("rad/rad" if swings else "mm/rad")
    mm = " " + tell(unit_of("mm"))
    units = "°", "°" if swings else mm, " " + tell(of_velocity)
    data: dict[str, Any] = {
        "kind": scene.kind,
        "about": f"{tell(SCENE_DESCRIPTIONS[scene.kind])} {tell(INSTANT_CENTRES[swings])}",
        "sigma": scene.sigma,
        "step": 360 / (scene.phi.size - 1),
        "phases": [_phase(phase, tell) for phase in scene.phases],
        "profile": _points(scene.profile),
        "pitch": pitch,
        "mark": _point(0.92 * scene.profile[0]),
        "pivot": _point(scene.pivot),
        "ground": ground,
        "sizes": {name: _rounded_number(size) for name, size in sizes.items()}
        | {"face": [_rounded_number(x) for x in face]},
        "arrays": {
            **{name: _points(getattr(scene, name)) for name in ("trace", "contact")},
            **{name: _numbers(np.degrees(np.angle(getattr(scene, name)))) for name in ("motion", "normal")},
            **{name: _numbers(values) for name, values in live.items()},
            "curvature_radius": _numbers(scene.rho),
        },
        "live": list(live),
        "units": dict(zip(LIVE_READINGS, units, strict=True)) | {"curvature_radius": mm},
        "digits": dict(zip(LIVE_READINGS, (2, 2, 3 if swings else 2), strict=True)),
        "decimal": decimal,
    }
    return data | {"box": _box(scene, data, unit)}


def _phase(phase: TurnPhase, tell: Tell) -> dict[str, Any]:
    start, extent = (round(math.degrees(angle), DECIMALS) for angle in (phase.start, phase.end - phase.start))
    name, symbol = tell(phase.name), tell(phase.symbol)
    return {"name": name, "heading": in_html(escape(name)), "symbol": symbol, "start": start, "extent": extent}


def _guide(scene: MechanismScene, unit: float) -> tuple[list[dict[str, Any]], float]:
    """The marks of a stem's guide above its highest position, and the height of the guide [mm]."""
    x, low = float(scene.trace[0].real), float(scene.trace.imag.max()) + scene.roller + 1.5 * unit
    high = low + 4 * unit
    marks = [_mark("axis", np.array([x - 1j * 3 * unit, x + 1j * (high + 2 * unit)]))]
    for side in (-1, 1):
        wall = x + side * 1.1 * unit
        marks.append(_mark("guide", np.array([wall + 1j * low, wall + 1j * high])))
        ticks = wall + 1j * np.linspace(low, high - unit, 5)
        marks += [_mark("hatch", np.array([tick, tick + (side + 1j) * 0.9 * unit])) for tick in ticks.tolist()]
    return marks, high


def _pivot(scene: MechanismScene, unit: float) -> list[dict[str, Any]]:
    at, foot = scene.pivot, np.array([-1.6 - 3.4j, 1.6 - 3.4j]) * unit
    ticks = at + np.arange(-2.2, 2.3, 1.1) * unit - 3.4j * unit
    return [
        _mark("axis", np.array([0j, at])),
        _mark("guide", np.array([at, *(at + foot)]), closed=True),
        *(_mark("hatch", np.array([tick, tick - (0.9 + 0.9j) * unit])) for tick in ticks.tolist()),
    ]


def _box(scene: MechanismScene, data: dict[str, Any], unit: float) -> list[float]:
    """The box of all positions, y downwards: left, top, width, height [mm]."""
    # The cam sweeps a whole circle, and its pitch curve with it.
    swept = float(np.abs(scene.profile if data["pitch"] is None else scene.trace).max())
    corners = [complex(-swept, -swept), complex(swept, swept)]
    corners += [complex(*point) for mark in data["ground"] for point in mark["points"]]
    reach = data["sizes"]["reach"] + 4 * unit
    corners += [*(scene.trace + reach * scene.normal), *(scene.trace + reach * scene.motion)]
    corners += [scene.trace.min() - scene.roller, scene.trace.max() + scene.roller]
    if scene.kind == "face":
        corners += [complex(x, 0) for x in data["sizes"]["face"]]
    if scene.kind == "blade":  # from its pivot to its end
        way = 1j * scene.normal
        foot = scene.pivot + ((scene.contact - scene.pivot) * scene.normal.conj()).real * scene.normal
        corners += [scene.pivot, *(foot + data["sizes"]["face"][1] * way)]
    if not scene.swings:
        corners.append(scene.trace[np.argmax(scene.trace.imag)] + 1j * data["sizes"]["stem"])
    x, y = np.real(corners), np.imag(corners)
    left, top = float(x.min()) - 2 * unit, -float(y.max()) - 2 * unit
    return [_rounded_number(n) for n in (left, top, float(np.ptp(x)) + 4 * unit, float(np.ptp(y)) + 4 * unit)]


def _mark(kind: str, points: Points, *, closed: bool = False) -> dict[str, Any]:
    return {"kind": kind, "points": _points(points), "closed": closed}


def _rounded_number(value: float) -> float:
    return round(value, DECIMALS) + 0.0


def _point(point: complex) -> list[float]:
    return [_rounded_number(point.real), _rounded_number(point.imag)]


def _points(points: Points) -> list[list[float]]:
    return _rounded(np.stack([points.real, points.imag], axis=-1)).tolist()


def _numbers(values: Floats) -> list[float | None]:
    return [plain_number(value) for value in _rounded(values).tolist()]


def _rounded(values: Floats) -> Floats:
    return np.round(values, DECIMALS) + 0.0
