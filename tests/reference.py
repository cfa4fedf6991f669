"""What the exact side is checked against: textbook formulas at 50 digits, everything else by differentiation.

Nothing here repeats the formulas that graphcam computes with.  Displacements are those printed in the books (J. E.
Shigley, *Theory of Machines*; R. L. Norton, *Cam Design and Manufacturing Handbook*), which every law declares
beside its own; velocities, accelerations, tangents and curvatures are ``mpmath.diff`` of them.
"""

from __future__ import annotations

from collections.abc import Callable

from mpmath import cos, diff, matrix, mp, mpf, sin, sqrt, tan

from graphcam.given.laws import DECLARED_LAWS

mp.dps = 50
Number = mpf
EPS = 2.0**-52


def lift(name: str, u: Number, ratio: float = 1.0) -> Number:
    """The textbook's normalised displacement at u in [0, 1]."""
    u, ratio = mpf(u), mpf(ratio)
    if ratio != 1:  # its halves are stretched to parts of unequal length
        m = 1 / (1 + ratio)
        if name == "rectangular":
            return u**2 / m if u <= m else 1 - (1 - u) ** 2 / (1 - m)
        return 2 * m * lift(name, u / (2 * m)) if u <= m else 1 - 2 * (1 - m) * lift(name, (1 - u) / (2 * (1 - m)))
    with mp.workdps(2 * mp.dps + 50):  # near u = 0 all but the fourth power of the double harmonic cancels
        return DECLARED_LAWS[name].printed(u, mp)


def lift_of(phase, u: Number) -> Number:
    """The normalised way of a phase, up or down; a return without a dwell before it is the rise seen backwards."""
    if phase.direction < 0 and DECLARED_LAWS[phase.law].rise_fall:
        return 1 - lift(phase.law, 1 - mpf(u))
    return lift(phase.law, u, phase.ratio)


def displacement(motion, phi: Number) -> Number:
    """s at the cam angle phi in [0, 2 pi), from the phases alone."""
    start, level = mpf(0), mpf(0)
    lowest = _lowest_level(motion)
    for phase in motion.phases:
        if phi <= start + mpf(phase.angle):
            break
        start += mpf(phase.angle)
        level += phase.direction * mpf(phase.lift)
    if phase.direction == 0:
        return level - lowest
    u = (phi - start) / mpf(phase.angle)
    return level - lowest + phase.direction * mpf(phase.lift) * lift_of(phase, u)


def _lowest_level(motion) -> Number:
    levels = [mpf(0)]
    for phase in motion.phases:
        levels.append(levels[-1] + phase.direction * mpf(phase.lift))
    return min(levels[:-1])


class ReferenceCam:
    """A translating cam, built from its definition: the trace point turned back by the cam's angle."""

    def __init__(self, cam) -> None:
        self.motion = cam.motion
        self.sigma = {"ccw": 1, "cw": -1}[cam.rotation]
        self.offset, self.radius = mpf(cam.follower.offset), mpf(cam.prime_radius)
        self.roller = mpf(cam.follower.roller_radius)

    def pitch(self, phi: Number) -> matrix:
        return turned(self.trace(phi), -self.sigma * phi)

    def trace(self, phi: Number) -> matrix:
        return matrix([self.offset, sqrt(self.radius**2 - self.offset**2) + displacement(self.motion, phi)])

    def tangent(self, phi: Number, order: int = 1) -> matrix:
        return matrix([diff(lambda t, i=i: self.pitch(t)[i], phi, order) for i in (0, 1)])

    def normal(self, phi: Number) -> matrix:
        """The unit normal that points away from the cam, in cam coordinates."""
        x, y = self.tangent(phi)
        n = matrix([y, -x]) / sqrt(x * x + y * y)
        # Towards the follower: in the frame the normal has a part along the follower's motion.
        return n if turned(n, self.sigma * phi)[1] > 0 else -n

    def profile(self, phi: Number) -> matrix:
        return self.pitch(phi) - self.roller * self.normal(phi)

    def pressure_angle(self, phi: Number) -> Number:
        """Between the normal and the follower's motion, positive where the cam pushes the stem along with its turn."""
        x, y = turned(self.normal(phi), self.sigma * phi)
        return mp.atan2(-self.sigma * x, y)

    def curvature(self, phi: Number) -> Number:
        """Positive where the curve bends away from the follower."""
        x1, y1 = self.tangent(phi)
        x2, y2 = self.tangent(phi, 2)
        nx, ny = self.normal(phi)
        return -(x2 * nx + y2 * ny) / (x1**2 + y1**2)


def turned(point: matrix, angle: Number) -> matrix:
    c, s = cos(angle), sin(angle)
    return matrix([c * point[0] - s * point[1], s * point[0] + c * point[1]])


def maximum(function: Callable[[Number], Number], low: Number, high: Number) -> Number:
    """The greatest value of a function with one peak between low and high, by golden sections."""
    golden = (sqrt(mpf(5)) - 1) / 2
    a, b = mpf(low), mpf(high)
    c, d = b - golden * (b - a), a + golden * (b - a)
    fc, fd = function(c), function(d)
    while b - a > (abs(a) + abs(b)) * mpf(10) ** -24:
        if fc > fd:
            b, d, fd = d, c, fc
            c = b - golden * (b - a)
            fc = function(c)
        else:
            a, c, fc = c, d, fd
            d = a + golden * (b - a)
            fd = function(d)
    return max(fc, fd)


def least_radius(motion, rise: float, return_: float | None, rest: bool, offset: Number | None = None) -> Number:
    """The least prime radius by its definition; offset is sigma e, None for free."""
    slopes = {1: tan(mpf(rise)), -1: None if return_ is None else tan(mpf(return_))}
    heights = {direction: _tallest(motion, direction, slope) for direction, slope in slopes.items() if slope}

    def squared(x: Number) -> Number:
        s0 = (heights[1] - x) / slopes[1]
        if return_ is not None:
            s0 = max(s0, (heights[-1] + x) / slopes[-1])
        if rest:  # |x| / s0, the tangent where nothing moves, at both ends of the lower dwell
            s0 = max(s0, *(abs(x) / slope for slope in slopes.values() if slope))
        return x**2 + max(s0, mpf(0)) ** 2

    if offset is not None:
        return sqrt(squared(mpf(offset)))
    far = 2 * sum(abs(h) for h in heights.values())
    return sqrt(-maximum(lambda x: -squared(x), -far, far))


def _tallest(motion, direction: int, slope: Number) -> Number:
    best = []
    level = -_lowest_level(motion)
    for phase in motion.phases:
        next_level = level + phase.direction * mpf(phase.lift)
        if phase.direction == direction:
            h, angle = mpf(phase.lift), mpf(phase.angle)

            def s(u, phase=phase, level=level, h=h):
                return level + phase.direction * h * lift_of(phase, u)

            def height(u, s=s, angle=angle):
                return abs(diff(s, u)) / angle - slope * s(u)

            best.append(maximum(height, mpf(10) ** -20, 1 - mpf(10) ** -20))
        level = next_level
    return max(best)


class ReferenceArm(ReferenceCam):
    """An arm's cam, from its definition: two circles meet in the trace point, which then turns about the pivot."""

    def __init__(self, cam) -> None:
        self.motion = cam.motion
        self.sigma = {"ccw": 1, "cw": -1}[cam.rotation]
        self.arm, self.distance = mpf(cam.follower.arm), mpf(cam.follower.distance)
        self.radius, self.roller = mpf(cam.prime_radius), mpf(cam.follower.roller_radius)

    def trace(self, phi: Number) -> matrix:
        c, r0 = self.distance, self.radius
        x = (r0**2 - self.arm**2 + c**2) / (2 * c)
        from_pivot = matrix([x - c, sqrt(r0**2 - x**2)])
        return matrix([c, 0]) + turned(from_pivot, -displacement(self.motion, phi))  # the lift turns clockwise

    def outward(self, phi: Number) -> matrix:
        """The trace point's direction on the rise, in the frame: across the arm."""
        x, y = self.trace(phi) - matrix([self.distance, 0])
        return matrix([y, -x]) / self.arm

    def normal(self, phi: Number) -> matrix:
        x, y = self.tangent(phi)
        n, out = matrix([y, -x]) / sqrt(x * x + y * y), self.outward(phi)
        seen = turned(n, self.sigma * phi)
        return n if seen[0] * out[0] + seen[1] * out[1] > 0 else -n

    def pressure_angle(self, phi: Number) -> Number:
        """Between the normal and the trace point's motion, positive where the normal lies counter-clockwise of it."""
        (x, y), (a, b) = turned(self.normal(phi), self.sigma * phi), self.outward(phi)
        return mp.atan2(a * y - b * x, a * x + b * y)


class ReferenceSwingingFace:
    """A cam under a face that swings: each point of its profile is the limit of where two positions of the face meet.

    In the frame the face goes through a point f beside the pivot (c, 0), along (-cos(psi), sin(psi)).
    """

    def __init__(self, cam) -> None:
        self.motion, self.sigma = cam.motion, {"ccw": 1, "cw": -1}[cam.rotation]
        self.c, self.f = mpf(cam.follower.distance), mpf(cam.follower.face_offset)
        self.psi0 = mp.asin((mpf(cam.prime_radius) + self.f) / self.c)

    def face(self, phi: Number) -> tuple[matrix, matrix]:
        """A point of the face and its direction, in cam coordinates."""
        psi = self.psi0 + displacement(self.motion, phi)
        way = matrix([-cos(psi), sin(psi)])
        foot = matrix([self.c, 0]) + self.f * matrix([-way[1], way[0]])
        return turned(foot, -self.sigma * phi), turned(way, -self.sigma * phi)

    def meeting(self, phi: Number) -> tuple[Number, matrix]:
        """How far from the foot of the pivot a face is touched, and where: it moves along itself there."""
        point, way = self.face(phi)
        point1, way1 = (matrix([diff(lambda t, i=i, k=k: self.face(t)[k][i], phi) for i in (0, 1)]) for k in (0, 1))
        along = -(point1[0] * way[1] - point1[1] * way[0]) / (way1[0] * way[1] - way1[1] * way[0])
        return along, point + along * way

    def profile(self, phi: Number) -> matrix:
        return self.meeting(phi)[1]

    def radius_of_curvature(self, phi: Number) -> Number:
        """The way along the face for each radian that its direction turns."""
        way = self.face(phi)[1]
        x1, y1 = (diff(lambda t, i=i: self.profile(t)[i], phi) for i in (0, 1))
        dx, dy = (diff(lambda t, i=i: self.face(t)[1][i], phi) for i in (0, 1))
        return (x1 * way[0] + y1 * way[1]) / (way[0] * dy - way[1] * dx)


class ReferenceFace:
    """A flat face's cam: each point of the profile is the limit of where two positions of the face meet."""

    def __init__(self, cam) -> None:
        self.motion, self.radius = cam.motion, mpf(cam.prime_radius)
        self.sigma = {"ccw": 1, "cw": -1}[cam.rotation]

    def height(self, phi: Number) -> Number:
        return self.radius + displacement(self.motion, phi)

    def profile(self, phi: Number) -> matrix:
        # The line x.n = height, its derivative x.n' = height': solved for x.
        n = turned(matrix([0, 1]), -self.sigma * phi)
        n1 = self.sigma * matrix([n[1], -n[0]])
        return self.height(phi) * n + diff(self.height, phi) * n1

    def radius_of_curvature(self, phi: Number) -> Number:
        """The way along the profile, against the cam's turn, for each radian that the face turns."""
        n = turned(matrix([0, 1]), -self.sigma * phi)
        n1 = self.sigma * matrix([n[1], -n[0]])
        x1, y1 = (diff(lambda t, i=i: self.profile(t)[i], phi) for i in (0, 1))
        return x1 * n1[0] + y1 * n1[1]
