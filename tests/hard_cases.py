"""Hard cases and what they come to: ``python tests/hard_cases.py`` writes the table
``graphcam/data/hard_cases.toml`` anew.

Everything is computed with mpmath at 50 digits from the textbooks' definitions, and nothing by graphcam: the laws are
printed displacements, and their derivatives quotients of differences at several hundred digits; pitch curve, profile
and curvature are those of :mod:`reference`.  The table keeps 30 digits of each value, as text.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mpmath
from mpmath import diff, findroot, mp, mpf, workdps
from reference import ReferenceCam, displacement, least_radius, lift, maximum

TABLE = Path(__file__).parents[1] / "graphcam" / "data" / "hard_cases.toml"
DIGITS = 30
FULL_TURN = 2 * math.pi
LAWS = (
    "rectangular", "triangular", "cosine", "cycloidal", "trapezoidal",
    "modified-trapezoidal", "modified-sine", "2-3", "3-4-5", "4-5-6-7", "double-harmonic", "eighth-degree",
)  # fmt: skip
Row = dict[str, Any]


def digits(value: Any) -> str | list[str]:
    """A number, or several, to :data:`DIGITS` digits."""
    if isinstance(value, Iterable):
        return [mpmath.nstr(x, DIGITS) for x in value]
    return mpmath.nstr(value, DIGITS)


# --- motions ---------------------------------------------------------------------------------------------------------
# A phase is written as [kind, lift in mm, angle in degrees, law]; a turn is closed by a dwell.


def motion(phases: list[list[Any]], repeat: int = 1) -> SimpleNamespace:
    """The phases as the reference wants them, their angles in radians as a float has them."""
    made: list[SimpleNamespace] = []
    for kind, h, angle, *law in phases * repeat:
        direction = {"rise": 1, "dwell": 0, "return": -1}[kind]
        name, ratio = (*law, 1.0)[:2] if law else ("", 1.0)
        made.append(SimpleNamespace(direction=direction, lift=h, angle=math.radians(angle), law=name, ratio=ratio))
    rest = FULL_TURN - math.fsum(phase.angle for phase in made)
    if rest > 1e-9:
        made.append(SimpleNamespace(direction=0, lift=0.0, angle=rest, law="", ratio=1.0))
    return SimpleNamespace(phases=made)


def cam(phases: list[list[Any]], *, repeat: int = 1, offset: float, prime_radius: float, roller: float, rotation: str):
    """A translating cam as the reference wants it."""
    follower = SimpleNamespace(offset=offset, roller_radius=roller)
    moved = motion(phases, repeat)
    return ReferenceCam(
        SimpleNamespace(motion=moved, follower=follower, prime_radius=prime_radius, rotation=rotation)
    ), moved


# --- the exact side --------------------------------------------------------------------------------------------------


def law_ends() -> Iterator[Row]:
    """The laws as near to their ends as a float can be, each counted from its end."""
    for name in LAWS:
        yield from (law_end(name, 1.0, x) for x in (1e-300, 1e-200, 1e-100, 1e-30, 1e-16, 1e-9, 1e-4, 0.1))
    yield from (law_end("rectangular", ratio, x) for ratio in (0.01, 7.3) for x in (1e-300, 1e-16, 1e-4))


def law_end(name: str, ratio: float, x: float) -> Row:
    """f, f', f'', f''' at the distance x from the start, and from the end the same with the missing lift for f."""
    # The differences are far smaller than x; their cubes are told from rounding, also beside the lift of 1, and what
    # is zero is so as a float.
    with workdps(500 - round(6 * math.log10(x))):
        start = [diff(lambda u: lift(name, u, ratio), mpf(x), n) for n in range(4)]
        end = [diff(lambda u: 1 - lift(name, 1 - u, ratio), mpf(x), n) for n in range(4)]
    return {"law": name, "ratio": ratio, "x": x, "start": digits(start), "end": digits(end)}


def many_turns() -> Iterator[Row]:
    """Angles of up to a thousand million turns, in degrees and in turns, reduced in 50 digits."""
    phases = [["rise", 30.0, 120.0, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 30.0, 120.0, "cycloidal"]]
    moved = motion(phases)
    for unit, turn in (("degrees", 360.0), ("turns", 1.0)):
        for part in (0.1, 1 / 7, 0.31, 0.61, -0.2):
            for count in (0, 1, 1000, 1_000_000_007, -1_000_000_007):
                angle = (part + count) * turn
                phi = mpf(angle) % mpf(turn) * 2 * mpmath.pi / mpf(turn)
                values = [diff(lambda t: displacement(moved, t), phi, n) for n in range(4)]
                yield {"phases": phases, "unit": unit, "angle": angle, "phi": digits(phi), "values": digits(values)}


STEEP = [["rise", 30.0, 70.0, "4-5-6-7"], ["dwell", 0.0, 30.0], ["return", 30.0, 200.0, "3-4-5"]]
GENTLE = [["rise", 30.0, 120.0, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 30.0, 120.0, "cycloidal"]]
TINY = [["rise", 1e-9, 120.0, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 1e-9, 120.0, "modified-sine"]]
SHORT = [["rise", 30.0, 1e-6, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 30.0, 1e-6, "cosine"]]
STRAIGHT = [["rise", 10.0, math.degrees(1.0), "rectangular"], ["dwell", 0.0, 60.0], ["return", 10.0, 120.0, "2-3"]]
MANY = [["rise", 1.0, 0.72, "3-4-5"], ["return", 1.0, 0.72, "cosine"]]
NEAR = 50.0 * (1 - 1e-9)

CAMS: dict[str, Row] = {
    "ordinary": {"phases": GENTLE, "offset": 10.0, "prime_radius": 50.0, "roller": 12.0, "rotation": "ccw"},
    "ordinary, clockwise": {"phases": STEEP, "offset": -7.0, "prime_radius": 45.0, "roller": 9.0, "rotation": "cw"},
    "offset near the prime radius": {
        "phases": GENTLE, "offset": NEAR, "prime_radius": 50.0, "roller": 5.0, "rotation": "ccw",
    },
    "offset near minus the prime radius": {
        "phases": STEEP, "offset": -NEAR, "prime_radius": 50.0, "roller": 0.0, "rotation": "ccw",
    },
    "offset near the prime radius, clockwise": {
        "phases": GENTLE, "offset": NEAR, "prime_radius": 50.0, "roller": 5.0, "rotation": "cw",
    },
    "tiny lift on a large radius": {
        "phases": TINY, "offset": 100.0, "prime_radius": 1000.0, "roller": 50.0, "rotation": "ccw",
    },
    "huge radius": {"phases": GENTLE, "offset": 1e8, "prime_radius": 1e9, "roller": 10.0, "rotation": "cw"},
    "huge lift": {
        "phases": [["rise", 1e9, 120.0, "cycloidal"], ["dwell", 0.0, 60.0], ["return", 1e9, 120.0, "4-5-6-7"]],
        "offset": 1e8, "prime_radius": 2e9, "roller": 1e7, "rotation": "ccw",
    },
    "phases of a millionth of a degree": {
        "phases": SHORT, "offset": 5.0, "prime_radius": 50.0, "roller": 0.0, "rotation": "ccw",
    },
    "500 phases": {
        "phases": MANY, "repeat": 250, "offset": 10.0, "prime_radius": 500.0, "roller": 0.1, "rotation": "ccw",
    },
}  # fmt: skip
PLACES = ((0, 1e-6), (0, 0.01), (0, 0.23), (0, 0.5), (0, 0.77), (0, 0.999), (2, 1e-4), (2, 0.3), (2, 0.5), (2, 0.9))


def cams() -> Iterator[Row]:
    """Trace point, contact point, pressure angle and curvature of cams at the edge, at fractions u of a phase."""
    for name, given in CAMS.items():
        exact, moved = cam(**given)
        places = ((0, 0.2), (0, 0.8), (137, 0.4), (250, 0.01), (498, 0.6), (499, 0.9)) if "repeat" in given else PLACES
        yield {
            "name": name, **given,
            "phase": [phase for phase, _ in places], "u": [u for _, u in places],
            **_at(exact, [_angle(moved, phase, u) for phase, u in places]),
        }  # fmt: skip


def _angle(moved: SimpleNamespace, phase: int, u: float) -> mpf:
    return mpmath.fsum(mpf(part.angle) for part in moved.phases[:phase]) + mpf(u) * mpf(moved.phases[phase].angle)


def _at(exact: ReferenceCam, places: list[mpf]) -> Row:
    pitch, profile = ([f(phi) for phi in places] for f in (exact.pitch, exact.profile))
    return {
        "x": digits(p[0] for p in pitch), "y": digits(p[1] for p in pitch),
        "profile_x": digits(p[0] for p in profile), "profile_y": digits(p[1] for p in profile),
        "pressure_angle": digits(map(exact.pressure_angle, places)),
        "curvature": digits(map(exact.curvature, places)),
    }  # fmt: skip


def inflections() -> Iterator[Row]:
    """Where the pitch curve is straight: the nearest float to each root of its curvature, and a straight start."""
    for name, offset, r0, bracket in (
        ("in a rise", 0.0, 30.0, (0.05, 0.5)), ("in a rise, with an offset", 8.0, 30.0, (0.05, 0.5)),
    ):  # fmt: skip
        given = {"phases": STEEP, "offset": offset, "prime_radius": r0, "roller": 5.0, "rotation": "ccw"}
        exact, _ = cam(**given)
        root = findroot(exact.curvature, tuple(map(mpf, bracket)), solver="anderson", tol=1e-60)
        phi = float(root)
        yield {"name": name, **given, "phi": phi, "curvature": digits(exact.curvature(mpf(phi)))}
    # At the start s = v = 0 and a = r0, so the curvature (r0 - a)/r0^2 vanishes.
    given = {"phases": STRAIGHT, "offset": 0.0, "prime_radius": 40.0, "roller": 5.0, "rotation": "ccw"}
    yield {"name": "at the start of a rise", **given, "phi": 0.0, "curvature": "0.0"}


LIMITS = (1e-6, 0.01, 89.9, 89.999999, 90 - 1e-9)


def least_radii() -> Iterator[Row]:
    """Least radii at permitted angles near 0 and 90 degrees: free, at a given offset, with and without the return."""
    for law in ("rectangular", "cosine", "cycloidal", "trapezoidal", "2-3", "3-4-5", "4-5-6-7"):
        phases = [["rise", 30.0, 120.0, law], ["dwell", 0.0, 60.0], ["return", 30.0, 100.0, law]]
        for degrees in LIMITS:
            given = motion(phases)
            angle = math.radians(degrees)
            with workdps(120):  # the steepest limits leave differences of the lift's last 70 digits
                free = least_radius(given, angle, None, rest=True)
                both = least_radius(given, angle, angle, rest=True)
                central = least_radius(given, angle, None, rest=True, offset=mpf(0))
            yield {
                "phases": phases, "limit": degrees, "free": digits(free), "with_return": digits(both),
                "central": digits(central),
            }  # fmt: skip


EXCESSES = (-1e-6, -2e-12, -9e-13, -1e-15, 0.0, 1e-15, 9e-13, 2e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.1)


MISSED = {"reached": 2e-14, "why": "the goal is 1e-14 mm, but the last digit of 42 mm is 7e-15 mm"}
"""Of the crossing of a large loop on a cam of ordinary size."""


def critical_rollers() -> Iterator[Row]:
    """Rollers about the least radius of curvature, and where the branches of the loop cross that a large one leaves."""
    for size in (1.0, 0.1):
        phases = [[kind, h * size, *rest] for kind, h, *rest in STEEP]
        given = {"phases": phases, "offset": 5.0 * size, "prime_radius": 40.0 * size, "rotation": "ccw"}
        knife, _ = cam(**given, roller=0.0)
        critical = 1 / maximum(knife.curvature, mpf(0.7), mpf(1.1))
        for excess in EXCESSES:
            roller = float(critical) * (1 + excess)
            exact, _ = cam(**given, roller=roller)
            depth = mpf(roller) / critical - 1
            yield {
                **given, "roller": roller, "excess": digits(depth),
                "expected": "sound" if depth < -1e-12 else "cusp" if depth < 1e-12 else "loop",
                **(_crossing(exact, knife, critical, depth) if depth > 1e-12 else {}),
                **(MISSED if (excess, size) == (0.1, 1.0) else {}),
            }  # fmt: skip


def _crossing(exact: ReferenceCam, knife: ReferenceCam, critical: mpf, depth: mpf) -> Row:
    """Where the two branches of the profile meet: about the sharpest place, as far apart as the depth lets them be."""
    with workdps(80):
        middle = findroot(lambda t: diff(knife.curvature, t), mpf(0.9), tol=1e-30)
        bend = -diff(knife.curvature, middle, 2) * critical / 2
        half = mpmath.sqrt(3 * depth / bend)
        # Divided by the cube of the distance, so that the root at phi1 = phi2 is none.
        m, t = findroot(
            lambda m, t: list((exact.profile(m + t) - exact.profile(m - t)) / t**3), (middle, half),
            tol=mpf(10) ** -30, maxsteps=50,
        )  # fmt: skip
        point = exact.profile(m - t)
    return {"crossing": digits([m - t, m + t, point[0], point[1]])}


def orientations() -> Iterator[Row]:
    """Three points that are nearly on a line: which way they turn, and their circle, from the exact floats."""
    one = 1.0 + 2.0**-52
    for points in (
        [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0 * one]],
        [[0.0, 0.0], [1.0, one], [2.0, 2.0]],
        [[0.5, 0.5], [12.0, 12.0], [24.0, 24.0]],
        [[0.5 + 2.0**-53, 0.5], [12.0, 12.0], [24.0, 24.0]],
        [[0.5, 0.5 + 2.0**-53], [12.0, 12.0], [24.0, 24.0]],
        [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]],
        [[0.1, 0.3], [0.2, 0.6], [0.7, 2.1]],
        [[1e-20, 1e-20], [1.0, 1.0], [3.0, 3.0]],
        [[1e9, 1.0], [1e9 + 1.0, 1.0 + 2.0**-52], [1e9 + 3.0, 1.0]],
        [[40.0, 30.0], [40.0 + 3e-8, 30.0 - 4e-8], [40.0 + 6e-8, 30.0 - 8e-8]],
        [[1e9, 1e9 / 3], [2e9, 2e9 / 3], [3e9, 1e9]],
        [[0.0, 0.0], [1e-200, 1e-200], [3e-200, 3.0000000001e-200]],
        [[0.0, 0.0], [1e200, 1e200], [3e200, 3.0000000001e200]],
    ):
        (ax, ay), (mx, my), (bx, by) = ([Fraction(x) for x in point] for point in points)
        turn = (mx - ax) * (by - my) - (my - ay) * (bx - mx)
        row: Row = {"points": points, "turns": "left" if turn > 0 else "right" if turn < 0 else "not"}
        if turn:
            lengths = [_exact(p * p + q * q) for p, q in ((mx - ax, my - ay), (bx - mx, by - my), (bx - ax, by - ay))]
            row["radius"] = digits(mpmath.sqrt(lengths[0] * lengths[1] * lengths[2]) / (2 * _exact(turn)))
        yield row


def _exact(fraction: Fraction) -> mpf:
    return mpf(fraction.numerator) / fraction.denominator


def sums() -> Iterator[Row]:
    """Sums over ten million stations of values in a cycle, exactly: the cycle's sum as often as it comes."""
    for cycle in ([0.1], [0.1, 0.7], [1e8, 0.1], [1.0, 1e-9, 1e-9, 1e-9], [1e8, -1e8, 0.3, 0.1]):
        total = mpf(10_000_000) / len(cycle) * mpmath.fsum(map(mpf, cycle))
        yield {"cycle": cycle, "count": 10_000_000, "total": digits(total)}


def straight_flanks() -> Iterator[Row]:
    """Three arcs whose flank is nearly straight: C3 and F by the linear problem, from the exact floats.

    What bends by less than the rounding of its lengths is straight.
    """
    for tilt in (0.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-14, -1e-14, -1e-12, -1e-9, -1e-6):
        c1, c2, g, rho1 = (20.0, 25.0 - tilt), (0.0, -50.0), (0.0, 30.0), 5.0
        first, second, point = (mpmath.mpc(*p) for p in (c1, c2, g))
        n = (second - point) / abs(second - point)
        w = point - first
        bend = (w * mpmath.conj(n)).real + rho1
        row: Row = {"C1": list(c1), "C2": list(c2), "G": list(g), "D": [40.0, 20.0], "rho1": rho1}
        if bend == 0:
            yield {**row, "flank": "straight", "F": digits([first.real, first.imag + rho1]), "bend": "0.0"}
            continue
        rounding = abs(bend) <= mpf(2) ** -50 * (abs(w) + rho1)
        t = (rho1 - abs(w)) * (rho1 + abs(w)) / (2 * bend)
        c3 = point + t * n
        f = first + rho1 * (first - c3) / abs(first - c3) * (1 if t > 0 else -1)
        flank = "straight" if rounding else "hollow" if t < 0 else "convex"
        yield {**row, "flank": flank, "F": digits([f.real, f.imag]), "bend": digits(1 / t)}


# --- the drawn side --------------------------------------------------------------------------------------------------
# A task, and what becomes of it: "drawn" is every quantity within its bound of the exact one; what cannot be read is
# named, with words of the sentence that says so; and so are the quantities that are drawn though no bound is known.

DRAWN: dict[str, Row] = {
    "lines that cross at less than a degree": {
        "phases": GENTLE, "rise": 0.4, "prime_radius": 60.0, "offset": 0.0,
        "unread": ["minimum_prime_radius", "minimum_offset"], "says": ["at less than a degree"],
    },
    "lines that cross at less than a degree, on both sides": {
        "phases": GENTLE, "rise": 0.2, "return": 0.2, "prime_radius": 60.0, "offset": 0.0,
        "unread": ["minimum_prime_radius", "minimum_offset"], "says": ["at less than a degree"],
    },
    "lines that cross at less than a degree, nothing given": {
        "phases": GENTLE, "rise": 0.4, "offset": "open", "refused": "give follower.offset and cam.prime_radius",
    },
    "lines that cross at less than a degree, the prime radius given": {
        "phases": GENTLE, "rise": 0.4, "offset": "open", "prime_radius": 60.0, "refused": "give follower.offset",
    },
    "a limit near 90 degrees": {"phases": GENTLE, "rise": 89.999999, "offset": "open"},
    "a limit near 90 degrees, at an offset": {"phases": GENTLE, "rise": 89.9},
    "two parts a phase": {"phases": GENTLE, "divisions": 2},
    "two parts a phase across a jump": {
        "phases": [["rise", 30.0, 120.0, "rectangular"], ["dwell", 0.0, 60.0], ["return", 30.0, 120.0, "rectangular"]],
        "divisions": 2, "no_bound": ["min_pitch_curvature_radius"],
    },
    "two parts a phase under a flat face": {
        "phases": GENTLE, "divisions": 2, "kind": "flat-faced", "prime_radius": 60.0,
    },
    "two parts a phase of an arm": {"phases": GENTLE, "divisions": 2, "kind": "oscillating"},
    "three parts a phase": {"phases": GENTLE, "divisions": 3},
    "a thousand parts a phase": {"phases": GENTLE, "divisions": 1000, "slow": True},
    "a jump off every grid": {
        "phases": [["rise", 30.0, 120.0, "rectangular", 1 / math.pi], ["return", 30.0, 120.0, "rectangular", 7.3]],
    },
    "chords that are almost the tangent": {
        "phases": [["rise", 1.0, 180.0, "3-4-5"], ["return", 1.0, 180.0, "3-4-5"]], "prime_radius": 1000.0,
        "roller": 10.0, "divisions": 96,
    },
    "a pitch curve that begins straight": {"phases": STRAIGHT, "offset": 0.0, "prime_radius": 40.0, "roller": 5.0},
    "an undercut envelope": {"phases": STEEP, "offset": 5.0, "prime_radius": 40.0, "roller": 30.0, "warns": "undercut"},
    "a lobe that is lost in its envelope": {
        "phases": [["rise", 30.0, 40.0, "3-4-5"], ["dwell", 0.0, 4.0], ["return", 30.0, 40.0, "3-4-5"]],
        "offset": 0.0, "prime_radius": 30.0, "roller": 25.0, "warns": "undercut",
    },
    "an undercut flat face": {
        "phases": [["rise", 30.0, 60.0, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 30.0, 60.0, "3-4-5"]],
        "kind": "flat-faced", "prime_radius": 10.0, "warns": "undercut",
    },
    "an undercut cam of an arm": {
        "phases": [["rise", 30.0, 40.0, "3-4-5"], ["dwell", 0.0, 60.0], ["return", 30.0, 60.0, "3-4-5"]],
        "kind": "oscillating", "prime_radius": 40.0, "roller": 25.0, "warns": "undercut",
    },
    "a rise of a millionth of a degree": {
        "phases": SHORT, "prime_radius": 50.0, "warns": "undercut",
        "unread": ["min_pitch_curvature_radius"], "no_bound": ["roller_radius"],
        "says": ["turns by more than 45° within one part", "0.7 ρ, which cannot be read"],
    },
    "a dwell of a millionth of a degree": {
        "phases": [["rise", 30.0, 120.0, "3-4-5"], ["dwell", 0.0, 1e-6], ["return", 30.0, 120.0, "cycloidal"]],
    },
    "a tiny lift on a large radius": {"phases": TINY, "offset": 0.0, "prime_radius": 1000.0, "roller": 5.0},
    "a tiny lift": {"phases": TINY, "offset": "open"},
    "a huge radius": {"phases": GENTLE, "offset": 0.0, "prime_radius": 1e9, "roller": 5.0},
    "an offset near the prime radius": {"phases": GENTLE, "offset": NEAR, "prime_radius": 50.0, "roller": 5.0},
    "phases that meet without a rest": {
        "phases": [["rise", 1e-3, 120.0, "3-4-5"], ["dwell", 0.0, 120.0], ["return", 1e-3, 120.0, "cycloidal"]],
        "offset": "open",
    },
    "500 phases": {
        "phases": MANY, "repeat": 250, "offset": 0.0, "prime_radius": 500.0, "roller": 0.1, "divisions": 4,
        "slow": True,
    },
}  # fmt: skip


def follower(given: Row) -> Row:
    """The follower as a task file has it: 10 mm of offset where nothing is said, an arm of 100 mm 120 mm away."""
    kind = given.get("kind", "translating")
    offset = given.get("offset", 10.0)
    sizes = {
        "translating": {} if offset == "open" else {"offset": offset},
        "oscillating": {"arm": 100.0, "distance": 120.0},
        "flat-faced": {},
    }[kind]
    return {"kind": kind, **sizes, **({"roller_radius": given["roller"]} if "roller" in given else {})}


def drawn() -> Iterator[Row]:
    """Tasks at the edge of what can be drawn; the least radius and the greatest v and a beside them."""
    for name, given in DRAWN.items():
        moved = motion(given["phases"], given.get("repeat", 1))
        kind = given.get("kind", "translating")
        unit = mpf(math.radians(1)) if kind == "oscillating" else 1
        said = {key: value for key, value in given.items() if key not in ("phases", "kind", "offset", "roller")}
        row: Row = {"name": name, "phases": given["phases"], "follower": follower(given), **said}
        if "repeat" not in given:
            row["max_v"] = digits(unit * max(_peak(phase, 1) for phase in moved.phases if phase.direction))
            row["max_a"] = digits(unit * max(_peak(phase, 2) for phase in moved.phases if phase.direction))
        if kind == "translating" and "repeat" not in given:
            limits = [None if x is None else math.radians(x) for x in (given.get("rise", 30.0), given.get("return"))]
            offset = given.get("offset", 10.0)
            side = None if offset == "open" else -mpf(offset)  # clockwise
            row["minimum_prime_radius"] = digits(least_radius(moved, limits[0], limits[1], rest=True, offset=side))
        yield row


def _peak(phase: SimpleNamespace, order: int) -> mpf:
    """The greatest |v| or |a| of a phase; the laws' peaks are where the next derivative vanishes, or at an end."""

    def value(u: mpf) -> mpf:
        return abs(diff(lambda x: lift(phase.law, x, phase.ratio), u, order))

    near = mpf(10) ** -30
    grid = [mpf(k) / 48 for k in range(1, 48)] + [near, 1 - near]
    breaks = [1 / (1 + mpf(phase.ratio)) - near, 1 / (1 + mpf(phase.ratio)) + near]
    best = max(grid + breaks, key=value)
    around = maximum(value, max(best - mpf(1) / 48, near), min(best + mpf(1) / 48, 1 - near))
    return max(value(best), around) * mpf(phase.lift) / mpf(phase.angle) ** order


SECTIONS = {
    "law_end": law_ends, "many_turns": many_turns, "cam": cams, "inflection": inflections,
    "least_radius": least_radii, "critical_roller": critical_rollers, "orientation": orientations, "sum": sums,
    "straight_flank": straight_flanks, "drawn": drawn,
}  # fmt: skip


# --- the table -------------------------------------------------------------------------------------------------------

HEAD = """\
# Hard cases, what is expected of them, and reference values at 50 digits, of which 30 are kept.
# Written by tests/hard_cases.py: change that, and run `python tests/hard_cases.py`.
"""


def written(value: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, list):
        return f"[{', '.join(map(written, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {written(each)}' for key, each in value.items())} }}"
    return repr(value)


def section(name: str) -> list[str]:
    """One kind of cases, a table each."""
    return [
        f"[[{name}]]\n" + "".join(f"{key} = {written(value)}\n" for key, value in row.items())
        for row in SECTIONS[name]()
    ]


def table() -> str:
    """The whole file."""
    mp.dps = 50
    return "\n".join([HEAD, *(text for name in SECTIONS for text in section(name))])


if __name__ == "__main__":
    TABLE.write_text(table(), encoding="utf-8")
