"""A second draughtsman: the exercises' answers by formulas and plain arithmetic, right and with every mistake.

Nothing here comes from graphcam: no law, no integration, no inversion, no region, no curvature.  It takes the
parameters of a variant and what is asked, and answers.  Lengths are mm, angles rad; a cam that turns counter-clockwise
has the sense +1; the follower moves upwards, its line at x = offset, the cam centre at the origin.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

Array = np.ndarray
MU_PHI = math.radians(1)
"""The scale of the cam angle on a sheet A1: one degree to a millimetre [rad/mm]."""
FINE = 2000
"""Places in a phase where curves are looked at in place of being drawn."""


# --- laws of motion: displacement over a phase from 0 to 1 ------------------------------------------------------------


def cosine(u: Array) -> Array:
    return (1 - np.cos(np.pi * u)) / 2


def cycloidal(u: Array) -> Array:
    return u - np.sin(2 * np.pi * u) / (2 * np.pi)


def polynomial(u: Array) -> Array:
    return u**3 * (10 - 15 * u + 6 * u**2)


def cubic(u: Array) -> Array:
    return u**2 * (3 - 2 * u)


def seventh(u: Array) -> Array:
    return u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)


def parabolic(u: Array) -> Array:
    return np.where(u < 0.5, 2 * u**2, 1 - 2 * (1 - u) ** 2)


def modified_sine(u: Array) -> Array:
    ends = np.pi * u - np.sin(4 * np.pi * u) / 4
    middle = 2 + np.pi * u - 9 / 4 * np.sin((4 * np.pi * u + np.pi) / 3)
    return np.where(u < 1 / 8, ends, np.where(u > 7 / 8, 4 + ends, middle)) / (4 + np.pi)


def triangular(u: Array) -> Array:
    """The acceleration rises evenly from nought, falls evenly through nought in the middle, and comes back."""
    w = np.minimum(u, 1 - u)
    first = 16 / 3 * w**3
    second = first - 2 * 16 / 3 * np.maximum(w - 1 / 4, 0) ** 3
    return np.where(u <= 0.5, second, 1 - second)


LAWS: Mapping[str, Callable[[Array], Array]] = {
    "cosine": cosine,
    "cycloidal": cycloidal,
    "3-4-5": polynomial,
    "modified-sine": modified_sine,
    "2-3": cubic,
    "4-5-6-7": seventh,
    "rectangular": parabolic,
    "triangular": triangular,
}


def speed(law: Callable[[Array], Array], u: Array) -> Array:
    h = 1e-5
    a, b = np.clip(u - h, 0, 1), np.clip(u + h, 0, 1)
    return (law(b) - law(a)) / (b - a)


def bend(law: Callable[[Array], Array], u: Array) -> Array:
    """The second derivative, from one side where it jumps at an end."""
    h = 1e-3
    u = np.clip(u, h, 1 - h)
    # A jump in the middle belongs to the part that ends there.
    return (law(u + h) - 2 * law(u) + law(u - h)) / h**2


# --- diagrams --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Givens:
    """A task as its text says it.

    laws, angles : of rise and return; divisions : parts of a phase; poles : from a to v, from v to s
    ordinate : of the rise, on paper; ratio : what the return's ordinate is multiplied by beside the right one
    late : stations by which the diagrams are read too late; at_ends : whether ordinates are taken at the ends of parts
    v_factor, a_factor : by which the scales of v and a are off
    drawn_poles : other ones that the diagrams are drawn with, if any
    arm, distance : of an oscillating follower, from its pivot to the roller and to the cam centre; its lift is an angle
    """

    lift: float
    laws: tuple[str, str]
    angles: tuple[float, float]
    dwell: float
    divisions: int
    ordinate: float
    poles: tuple[float, float]
    sense: int = 1
    offset: float = 0.0
    prime: float = 0.0
    roller: float = 0.0
    limits: tuple[float, float] = (0.0, 0.0)
    rule: float = 0.0
    ratio: float = 1.0
    late: int = 0
    at_ends: bool = False
    v_factor: float = 1.0
    a_factor: float = 1.0
    drawn_poles: tuple[float, float] | None = None
    arm: float = 0.0
    distance: float = 0.0


@dataclass(frozen=True)
class Diagrams:
    """Ordinates on paper at the stations of both phases (2, divisions + 1), and the scales."""

    middles: Array
    greatest: tuple[float, float]
    v: Array
    s: Array
    mu_s: float
    mu_v: float
    mu_a: float


def diagrams(given: Givens) -> Diagrams:
    """Acceleration, velocity and displacement by middle ordinates, as sums over the parts."""
    n, (h1, h2) = given.divisions, given.drawn_poles or given.poles
    u = np.linspace(0, 1, FINE + 1)
    size = [np.abs(bend(LAWS[name], u)).max() / angle**2 for name, angle in zip(given.laws, given.angles, strict=True)]
    greatest = given.ordinate, given.ordinate * size[1] / size[0] * given.ratio
    middles, vs, ss = [], [], []
    start = 0.0
    at = (np.arange(n) + 1) / n if given.at_ends else (np.arange(n) + 0.5) / n
    # At an end of a part on a jump the ordinate is that of the part.
    at = np.where(np.isclose(at, 0.5), 0.5 - 2e-3, at) if given.at_ends else at
    for name, angle, top, sign in zip(given.laws, given.angles, greatest, (1, -1), strict=True):
        run, law = angle / MU_PHI, LAWS[name]
        a = sign * top * bend(law, at) / np.abs(bend(law, u)).max()
        along = np.linspace(0, 1, n + 1)
        v = np.concatenate([[0], np.cumsum(a * run / n / h1)])
        # A closing error is spread evenly over the phase, here and in the return's displacement.
        v = v - v[-1] * along
        # Between two stations the curve is faired: it leaves its chord as the law's own curve does.
        faired = sign * top * speed(law, np.linspace(0, 1, 2 * n + 1)) / np.abs(bend(law, u)).max() * run / h1
        v_middles = (v[:-1] + v[1:]) / 2 + faired[1::2] - (faired[:-1:2] + faired[2::2]) / 2
        s = start + np.concatenate([[0], np.cumsum(v_middles * run / n / h2)])
        s = s - s[-1] * along if sign < 0 else s
        start = s[-1]
        middles.append(a)
        vs.append(v)
        ss.append(s)
    mu_s = given.lift / ss[0][-1]
    mu_v = mu_s / (MU_PHI * given.poles[1])
    mu_a = mu_v / (MU_PHI * given.poles[0])
    v, s = np.array(vs), np.array(ss)
    if given.late:
        v, s = (np.stack([np.append(row[1:], row[-1]) for row in each]) for each in (v, s))
    v_scale = mu_v * given.v_factor
    return Diagrams(np.array(middles), greatest, v, s, mu_s, v_scale, mu_a * given.v_factor * given.a_factor)


# --- about the cam centre ---------------------------------------------------------------------------------------------


def height(given: Givens) -> float:
    """s0: from the cam centre's level to the start of the lift."""
    return math.sqrt(max(given.prime**2 - given.offset**2, 0.0))


def pitch(given: Givens, phi: Array, s: Array, sense: int) -> Array:
    """Places of the roller's centre on the cam, as complex numbers; the frame turns against the cam.

    An arm has its pivot to the right of the cam centre, and its roller above.
    """
    if given.arm:
        place = (given.distance**2 + given.prime**2 - given.arm**2) / (2 * given.distance)
        start = place + 1j * math.sqrt(given.prime**2 - place**2) - given.distance
        return (given.distance + start * np.exp(-1j * s)) * np.exp(-1j * sense * phi)
    return (given.offset + 1j * (height(given) + s)) * np.exp(-1j * sense * phi)


def pressure(given: Givens, v: Array, s: Array) -> Array:
    return np.arctan((v - given.sense * given.offset) / (height(given) + s))


def exact(given: Givens) -> tuple[Array, Array, Array]:
    """phi, s and v all along rise, dwell and return."""
    u = np.linspace(0, 1, FINE + 1)
    (one, two), (b1, b2) = given.laws, given.angles
    phi = np.concatenate([u * b1, b1 + u * given.dwell, b1 + given.dwell + u * b2])
    s = given.lift * np.concatenate([LAWS[one](u), np.ones_like(u), 1 - LAWS[two](u)])
    zero = np.zeros_like(u)
    v = given.lift * np.concatenate([speed(LAWS[one], u) / b1, zero, -speed(LAWS[two], u) / b2])
    return phi, s, v


def least_height(given: Givens, offset: float, v: Array, s: Array) -> float:
    """The least s0 at an offset by which no permitted pressure angle is exceeded."""
    up, down = (math.tan(angle) for angle in given.limits)
    rest = min(up, down)  # the lower dwell has the limits of both phases beside it
    side = given.sense * offset
    rising = ((v - side) / up - s)[v > 0].max()
    falling = ((-v + side) / down - s)[v < 0].max()
    return max(rising, falling, abs(offset) / rest)


def least_radius(given: Givens, v: Array, s: Array, *, free: bool) -> tuple[float, float]:
    """s0 and offset: the given one, or that of the cam centre nearest to the start of the lift."""
    if not free:
        return least_height(given, given.offset, v, s), given.offset
    tried = np.linspace(-300, 300, 6001)
    heights = np.array([least_height(given, float(e), v, s) for e in tried])
    best = int(np.hypot(heights, tried).argmin())
    return float(heights[best]), float(tried[best])


def sharpest(given: Givens) -> float:
    """The least radius of curvature of the convex pitch curve."""
    found = []
    for law, angle, sign, start in zip(
        given.laws, given.angles, (1, -1), (0.0, given.angles[0] + given.dwell), strict=True
    ):
        u = np.linspace(0, 1, FINE + 1)
        s = LAWS[law](u) if sign > 0 else 1 - LAWS[law](u)
        z = pitch(given, start + u * angle, given.lift * s, given.sense)
        one, two = np.gradient(z, u), np.gradient(np.gradient(z, u), u)
        turn = (one.conj() * two).imag / np.abs(one) ** 3 * -given.sense
        found.append(turn[20:-20].max())
    return min(1 / max(found), given.prime)


def profile_radius(given: Givens, phi: float, s: float, v: float) -> float:
    """How far the roller at a place touches the profile from the cam centre."""
    h = 1e-4
    a, b = (pitch(given, np.array(phi + d), np.array(s + v * d), given.sense) for d in (-h, h))
    along = (b - a) / abs(b - a)
    z = complex(pitch(given, np.array(phi), np.array(s), given.sense))
    inside = complex(along) * -1j * given.sense
    return abs(z + given.roller * inside)


# --- a given cam -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class GivenCam:
    """A tangent cam as the text gives it, with the scale of its drawing [mm/mm], and what a student does with it.

    measured_from : the radius of the circle from which displacements are measured, where it is not the prime circle
    rolls : whether the roller is drawn;  numbered : the sense by which positions are numbered
    held_at : the offset with which the follower is drawn;  v_factor, a_factor : by which the scales are off
    """

    base: float
    lift: float
    ascent: float
    roller: float
    offset: float
    sense: int
    scale: float
    poles: tuple[float, float]
    held_at: float
    numbered: int
    measured_from: float = math.nan
    rolls: bool = True
    v_factor: float = 1.0
    a_factor: float = 1.0
    drawn_poles: tuple[float, float] | None = None


@cache
def touching(given: GivenCam, phi: float) -> tuple[complex, float]:
    """Where the roller's centre, or an edge, stands on the cam that is held still, and the direction of the normal.

    The cam is the hull of its base circle and its nose, so a place lies as far outside as beyond the worst tangent.
    """
    top = given.base + given.lift
    nose = (given.base - top * math.cos(given.ascent)) / (1 - math.cos(given.ascent))
    # At phi = 0 the roller touches where the flank begins.
    r0 = given.base + given.roller
    apex = math.atan2(math.sqrt(r0**2 - given.offset**2), given.offset) - given.sense * given.ascent
    theta = np.linspace(-np.pi, np.pi, 7201)
    reach = np.maximum(given.base, nose + (top - nose) * np.cos(theta - apex)) + given.roller * given.rolls
    turn = np.exp(-1j * given.numbered * phi)
    low, high = 0.0, 2 * (top + given.roller)
    for _ in range(40):
        y = (low + high) / 2
        z = complex((given.held_at + 1j * y) * turn)
        beyond = (z * np.exp(-1j * theta)).real - reach
        low, high = (y, high) if beyond.max() < 0 else (low, y)
    return z, float(theta[int(beyond.argmax())])


def analysed(given: GivenCam, asked: Asked, mistake: str) -> float:
    """Readings of a given cam: by positions of its follower, and by chords over equal parts of the turn."""
    phi = np.arange(PARTS_OF_TURN) * 2 * math.pi / PARTS_OF_TURN
    places = [touching(given, float(each)) for each in phi]
    z = np.array([place for place, _ in places])
    r0 = given.base + given.roller * given.rolls
    circle = r0 if math.isnan(given.measured_from) else given.measured_from
    s = (z * np.exp(1j * given.numbered * phi)).imag - math.sqrt(circle**2 - given.held_at**2)
    if mistake == "from-the-centre":
        s = np.abs(z)
    paper, mu_s = s / given.scale, given.scale
    if mistake == "scale-forgotten: analysis.s":
        mu_s = 1.0
    k = int(asked.station or 1)
    if asked.construction == "analysis" and asked.reading == "s":
        return float(paper[k]) * (1.0 if asked.of == "paper" else mu_s)
    if asked.construction == "analysis":
        motion = math.pi / 2 - given.numbered * float(phi[k])
        alpha = given.numbered * ((places[k][1] - motion + math.pi) % (2 * math.pi) - math.pi)
        alpha = math.copysign(math.pi / 2, alpha) - alpha if mistake == "angle-of-the-tangent" else alpha
        return math.degrees(alpha) * (-1 if mistake == "angle-sign" else 1)
    return chords(np.append(paper, paper[0]), mu_s, given, asked, mistake)


# --- mistakes --------------------------------------------------------------------------------------------------------


def with_mistake(given: Givens, name: str) -> Givens:
    """The task as a student with a mistake about its givens takes it; others are about reading."""
    what, _, of = name.partition(": ")
    swapped = given.laws[::-1], given.angles[::-1]
    r1, r2 = (diagrams(given).greatest[k] for k in (0, 1))
    changes: Mapping[str, Callable[[], Givens]] = {
        "wrong-law": lambda: replace(given, laws=(of, of)),
        "laws-swapped": lambda: replace(given, laws=swapped[0]),
        "angles-swapped": lambda: replace(given, angles=swapped[1]),
        "lift-halved": lambda: replace(given, lift=given.lift / 2),
        "ordinates-equal": lambda: replace(given, ratio=r1 / r2),
        "ordinates-swapped": lambda: replace(given, ratio=(r1 / r2) ** 2),
        "end-ordinate": lambda: replace(given, at_ends=True),
        "degree-for-radian": lambda: replace(given, v_factor=MU_PHI, a_factor=MU_PHI),
        "pole-forgotten": lambda: replace(given, v_factor=given.poles[1], a_factor=given.poles[0]),
        "poles-swapped": lambda: replace(given, drawn_poles=given.poles[::-1]),
        "station-too-late": lambda: replace(given, late=1),
        "offset-sign": lambda: replace(given, offset=-given.offset),
        "offset-forgotten": lambda: replace(given, offset=0.0),
        "offset-subtracted": lambda: replace(given, prime=math.hypot(given.prime - abs(given.offset), given.offset)),
        "offset-circle": lambda: replace(given, prime=abs(given.offset)),
        "rotation-sense": lambda: replace(given, sense=-given.sense),
        "base-circle": lambda: replace(given, prime=given.prime - given.roller),
        "roller-added": lambda: replace(given, prime=given.prime + given.roller),
        "prime-diameter": lambda: replace(given, prime=given.prime / 2),
        "limits-swapped": lambda: replace(given, limits=given.limits[::-1]),
        "limit-from-the-horizontal": lambda: replace(given, limits=tuple(math.pi / 2 - a for a in given.limits)),
    }
    return changes[what]() if what in changes else given


def with_cam_mistake(given: GivenCam, name: str) -> GivenCam:
    """A given cam as a student with a mistake takes it."""
    r0, e = given.base + given.roller, given.offset
    changes: Mapping[str, Mapping[str, object]] = {
        "roller-forgotten": {"rolls": False},
        "base-circle": {"measured_from": given.base},
        "roller-added": {"measured_from": r0 + given.roller},
        "prime-diameter": {"measured_from": r0 / 2},
        "offset-circle": {"measured_from": abs(e)},
        "offset-subtracted": {"measured_from": math.hypot(r0 - abs(e), e)},
        "numbering-sense": {"numbered": -given.sense},
        "rotation-sense": {"numbered": -given.sense},
        "offset-sign": {"held_at": -e},
        "offset-forgotten": {"held_at": 0.0},
        "degree-for-radian: differentiation": {"v_factor": MU_PHI, "a_factor": MU_PHI},
        "pole-forgotten: differentiation": {"v_factor": given.poles[1], "a_factor": given.poles[0]},
        "poles-swapped: differentiation": {"drawn_poles": given.poles[::-1]},
    }
    return replace(given, **changes.get(name, {}))  # type: ignore[arg-type]


@dataclass(frozen=True)
class Asked:
    """One answer, as an exercise asks it."""

    construction: str
    reading: str
    station: str
    of: str
    unit: str
    component: str = ""


def _concerns(mistake: str, asked: Asked) -> bool:
    """Whether a mistake is made where this answer is drawn: a given displacement is not integrated first."""
    if asked.construction == "differentiation":
        return not mistake.endswith(": integration") and mistake != "end-ordinate"
    return mistake != "offset-circle" or asked.construction not in ("pressure_angle", "minimum_radius")


def answer(given: Givens | GivenCam, asked: Asked, mistake: str = "") -> float:
    """What a student answers who draws without errors, right or with one mistake."""
    if isinstance(given, GivenCam):
        return analysed(with_cam_mistake(given, mistake), asked, mistake)
    if given.rule:
        given = replace(given, roller=given.rule * sharpest(given))
    given = with_mistake(given, mistake) if _concerns(mistake, asked) else given
    drawn = diagrams(given)
    phase = asked.station.count("'")
    number = int(asked.station.rstrip("'") or 0)
    start = (0.0, given.angles[0] + given.dwell)[phase if asked.construction != "acceleration" else 0]
    k = min(number, given.divisions)
    v, s = (float(each[phase, k]) for each in (drawn.v, drawn.s))
    value_v, value_s = v * drawn.mu_v, s * drawn.mu_s
    phi = start + given.angles[phase] * k / given.divisions
    if asked.construction == "acceleration" and asked.reading == "stations":
        law, share = LAWS[given.laws[phase]], np.array([k / given.divisions])
        height = drawn.greatest[phase] / np.abs(bend(law, np.linspace(0, 1, FINE + 1))).max()
        return (1, -1)[phase] * float(bend(law, share)[0]) * height
    if asked.construction == "acceleration":
        return drawn.greatest[number - 1] if asked.reading == "greatest" else float(drawn.middles[0, number - 1])
    if asked.construction == "differentiation":
        return differentiated(given, asked, mistake)
    if asked.construction == "integration":
        if asked.of == "scale":
            return {"s": drawn.mu_s, "v": drawn.mu_v, "a": drawn.mu_a}[asked.reading]
        paper = {"v": v, "s": s, "max_v": float(np.abs(drawn.v).max())}[asked.reading]
        mu = drawn.mu_s if asked.reading == "s" else drawn.mu_v
        return paper if asked.of == "paper" else _in_unit(paper * mu, asked)
    if asked.construction in ("pressure_angle", "minimum_radius"):
        return _limited(given, drawn, asked, value_v, value_s, mistake)
    if asked.construction == "inversion":
        sense = -given.sense if mistake == "numbering-sense" else given.sense
        z = complex(pitch(given, np.array(phi), np.array(value_s), sense))
        if mistake == "polar-angle":
            first = complex(pitch(given, np.array(0.0), np.array(0.0), sense))
            z = abs(z) * first / abs(first) * np.exp(-1j * sense * phi)
        if asked.reading == "pivots":
            pivot = given.distance * np.exp(-1j * sense * phi)
            return float(pivot.real if asked.component == "x" else pivot.imag)
        angle = math.degrees(math.atan2(z.imag, z.real))
        return {"x": z.real, "y": z.imag, "radius": abs(z), "polar_angle": angle}[asked.reading]
    if asked.construction == "working_profile":
        roller = given.roller * {"roller-outside": -1, "roller-diameter": 2}.get(mistake, 1)
        # The roller touches where the drawn curve runs, whatever scale v is read by.
        return profile_radius(replace(given, roller=roller), phi, value_s, value_v / given.v_factor)
    rho = sharpest(given) * (2 if mistake == "diameter-for-radius" else 1)
    return rho if asked.construction == "curvature" else given.rule * rho


def _in_unit(value: float, asked: Asked) -> float:
    return math.degrees(value) if asked.unit.startswith("deg") else value


PARTS_OF_TURN = 24
"""Into so many the turn is divided for differentiation."""


def differentiated(given: Givens, asked: Asked, mistake: str) -> float:
    """Readings of a displacement that is differentiated by chords over equal parts of the turn, in its own scale."""
    phi, s, _ = exact(given)
    mu_s = diagrams(given).mu_s
    ends = np.arange(PARTS_OF_TURN + 1) * 2 * math.pi / PARTS_OF_TURN
    return chords(np.interp(ends, phi, s, right=0.0) / mu_s, mu_s, given, asked, mistake)


def chords(plotted: Array, mu_s: float, given: Givens | GivenCam, asked: Asked, mistake: str) -> float:
    """Readings of the differentiation of a displacement that is plotted at the ends of all parts of the turn."""
    rise, run = np.diff(plotted), 2 * math.pi / PARTS_OF_TURN / MU_PHI
    second, first = given.poles
    v = (second if given.drawn_poles else first) * rise / run
    if mistake == "slope-inverted":
        v = first * run / rise[: int(asked.station or 1)]
    if mistake == "chord-at-its-end":
        v = (v + np.roll(v, 1)) / 2
    k = int(asked.station or 1) - 1 + (mistake == "station-too-late: differentiation")
    mu_v = mu_s / (MU_PHI * first) * given.v_factor
    if mistake == "scale-forgotten: differentiation.v":
        mu_v = 1.0
    if asked.of == "scale":
        return mu_v if asked.reading == "v" else mu_v / (MU_PHI * second) * given.a_factor
    if asked.reading == "rise":
        return float(rise[k])
    return float(v[k]) * (1.0 if asked.of == "paper" else mu_v)


def _limited(given: Givens, drawn: Diagrams, asked: Asked, v: float, s: float, mistake: str) -> float:
    """Readings of the diagram of pressure angles, and of the region of the cam centre."""
    region = asked.construction == "minimum_radius"
    unequal = drawn.mu_s / drawn.mu_v if mistake == "unequal-scales" and region else 1.0
    if asked.reading in ("ends", ""):
        return -given.sense * v * unequal / drawn.mu_s
    if asked.construction == "pressure_angle":
        return (
            height(given) if asked.reading == "s0" else math.degrees(float(pressure(given, np.array(v), np.array(s))))
        )
    _, all_s, all_v = exact(given)
    factor = drawn.mu_v / (drawn.mu_s / (MU_PHI * given.poles[1]))
    if given.late or given.ratio != 1.0 or given.drawn_poles or given.at_ends:
        all_s, all_v = (each.ravel() for each in (drawn.s * drawn.mu_s, drawn.v * drawn.mu_v))
        factor = 1.0
    free = not given.offset and mistake != "offset-forgotten"
    s0, offset = least_radius(given, all_v * factor * unequal, all_s, free=free)
    forgotten = drawn.mu_s if mistake == "scale-forgotten: minimum_radius.prime_radius" else 1.0
    radius = math.hypot(s0, offset) / forgotten
    return {"s0": s0 / drawn.mu_s, "offset": offset, "prime_radius": radius}[asked.reading]
