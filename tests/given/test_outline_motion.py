"""Cams given by their radii: published values, a roller laid on points of the outline, derivatives, closing sizes.

``python tests/random_cases.py tests/given/test_outline_motion.py --cases 300 --seed 1000`` tries as many as asked.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from over_all import over_all, over_seeds

import graphcam as gc
from graphcam.mechanism.turn_extremes import max_velocity

LAID_ON = 2e-5
"""How far a roller on points of an outline lies from one on the outline itself, as a part of the base radius."""
POINTS = 40001
"""Points of the outline."""
DERIVED = 1e-6
"""How far a derivative is from the difference quotient of the one before, as a part of its maximum."""


def outline_points(cam):
    """(n,) points of an outline on a cam that turns counter-clockwise, the base circle among them."""
    parts = list(cam.arcs())
    found = []
    for arc, following in zip(parts, [*parts[1:], parts[0]], strict=True):
        if math.isinf(arc.radius):
            found.append(arc.point + (following.point - arc.point) * np.linspace(0, 1, 2))
            continue
        start = np.angle(arc.outward)
        turned = -np.mod(start - np.angle(following.outward), 2 * math.pi) or -2 * math.pi
        if arc.radius < 0:
            turned = np.mod(np.angle(following.outward) - start, 2 * math.pi)
        angles = start + turned * np.linspace(0, 1, POINTS)
        found.append(arc.centre + arc.radius * np.exp(1j * angles))
    return np.concatenate([dense(part) for part in found])


def dense(part):
    """A straight part with as many points as an arc."""
    return part if part.size > 2 else part[0] + (part[1] - part[0]) * np.linspace(0, 1, POINTS)


def highest(points, follower, base):
    """s of a follower that is laid on points from above."""
    if isinstance(follower, gc.FlatFaced):
        return points.imag.max() - base
    if isinstance(follower, gc.OscillatingFlat):
        # Every point holds the face at least so far from the line of centres.
        away, f = follower.distance - points, follower.face_offset
        least = np.arcsin(f / np.abs(away)) - np.angle(away)
        return least.max() - math.asin((base + f) / follower.distance)
    r = follower.roller_radius
    if isinstance(follower, gc.Translating):
        beside = points.real - follower.offset
        under = np.abs(beside) <= r
        lowest = math.sqrt((base + r) ** 2 - follower.offset**2)
        return (points.imag[under] + np.sqrt(r * r - beside[under] ** 2)).max() - lowest
    c, arm = follower.distance, follower.arm
    away, reach = points - c, np.abs(points - c)
    near = np.abs(reach - arm) <= r
    # The trace point is at the arm's length from the pivot, and at the roller's radius from the point.
    beyond = np.arccos(np.clip((reach**2 + arm**2 - r * r) / (2 * reach * arm), -1, 1))[near]
    psi = np.angle(np.exp(1j * (math.pi - np.angle(away[near]) + beyond)))
    return psi.max() - math.acos((c * c + arm * arm - (base + r) ** 2) / (2 * c * arm))


def random_cam(rng):
    """A cam that exists, with a follower that can follow it; None where there is none."""
    base, lift, kind = rng.uniform(15, 60), rng.uniform(3, 20), rng.choice(["arc", "straight", "hollow", "eccentric"])
    sizes = {"lift": lift, "nose_radius": rng.uniform(0.1, 0.9) * base, "dwell": rng.choice([0.0, rng.uniform(0, 1)])}
    if kind == "eccentric":
        sizes = {"lift": lift}
    elif kind == "straight":
        sizes |= {"flank_radius": "straight"}
    else:
        size = rng.uniform(1.2, 6) * (base + lift)
        sizes |= {"flank_radius": size if kind == "arc" else -size}
    roller = rng.choice([0.0, rng.uniform(2, 20)])
    follower = rng.choice(["central", "offset", "arm", "flat"])
    built = {
        "central": gc.Translating(0.0, max(roller, 2.0)),
        "offset": gc.Translating(rng.uniform(-0.4, 0.4) * base, max(roller, 2.0)),
        "arm": gc.Oscillating(90.0, 90.0 * rng.uniform(0.9, 1.4), max(roller, 2.0)),
        "flat": gc.FlatFaced(),
    }[follower]
    if follower == "flat" and rng.random() < 0.5:
        built = gc.OscillatingFlat(rng.uniform(1.6, 3) * (base + lift), rng.uniform(-0.3, 0.3) * base)
    try:
        cam = gc.cam_by_radii(base, **sizes)
        rotation = str(rng.choice(["ccw", "cw"]))
        return cam, built, rotation, gc.outline_motion(cam, built, rotation)
    except gc.DesignError:
        return None


def faults_of_case(seed):
    """What is wrong with the motion on one random cam; None where there is no such cam."""
    rng = np.random.default_rng(seed)
    found = random_cam(rng)
    if found is None:
        return None
    cam, follower, rotation, motion = found
    sigma, faults = (1 if rotation == "ccw" else -1), []
    points = outline_points(cam)
    points = points if sigma > 0 else points.conj()
    # Where the follower stands at phi = 0: on the start of the flank, or of an eccentric cam on its lowest place.
    if isinstance(follower, gc.FlatFaced):
        start = 1j
    elif isinstance(follower, gc.OscillatingFlat):
        psi = math.asin((cam.base_radius + follower.face_offset) / follower.distance)
        start = 1j * np.exp(-1j * psi)
    elif isinstance(follower, gc.Translating):
        r0 = motion.prime_radius
        start = complex(follower.offset, math.sqrt(r0**2 - follower.offset**2)) / r0
    else:
        arm, c, r0 = follower.arm, follower.distance, motion.prime_radius
        start = c - arm * np.exp(-1j * math.acos((c * c + arm * arm - r0 * r0) / (2 * c * arm)))
        start /= abs(start)
    if cam.is_eccentric:
        turns = np.linspace(0, 2 * math.pi, 2001)
        heights = [highest(points[::50] * np.exp(1j * turn), follower, cam.base_radius) for turn in turns]
        low, top = min(heights), max(heights)
        if abs(top - low - motion.lift) > 1e-3 * cam.base_radius:
            faults.append(f"lift {motion.lift:.6f}, laid on {top - low:.6f}")
        return faults
    for phi in rng.uniform(0, 2 * math.pi, 12):
        laid = highest(points * start * np.exp(1j * sigma * phi), follower, cam.base_radius)
        swings = isinstance(follower, gc.Oscillating | gc.OscillatingFlat)
        miss = abs(laid - float(motion(phi)[0])) * (1.0 if laid > 1 or not swings else 90)
        if miss > LAID_ON * cam.base_radius:
            faults.append(f"s at {math.degrees(phi):.3f} is off by {miss:.2e}")
    for k, phase in enumerate(motion.phases):
        if not phase.direction:
            continue
        ends = [0.0, *phase.normalised.edges, 1.0]
        for low, high in pairwise(ends):
            u = low + (high - low) * np.linspace(0.1, 0.9, 9)
            step = 1e-4 * (high - low)
            plus, minus = (phase.normalised(u + way * step) for way in (1, -1))
            here = phase.normalised(u)
            for order in range(3):
                slope = (plus[order] - minus[order]) / (2 * step)
                scale = np.abs(here[order + 1]).max() + 1
                if np.abs(slope - here[order + 1]).max() > 100 * DERIVED * scale:
                    faults.append(f"derivative {order + 1} of phase {k}")
    return faults


@over_seeds(15)
def test_a_roller_laid_on_the_outline_stands_where_the_arcs_say(seed):
    assert not faults_of_case(seed)


def test_most_random_sizes_make_a_cam_that_is_followed():
    assert sum(random_cam(np.random.default_rng(seed)) is not None for seed in range(40)) > 20


def accelerations(motion, rpm, phi, side):
    """a [m/s^2] at a cam angle [rad]."""
    return motion(phi, side)[2] * (rpm * math.pi / 30) ** 2 / 1000


def test_a_tangent_cam_has_its_published_accelerations():
    """Base radius 28, roller 16, ascent 70 degrees, lift 15, 600 rpm: closed forms, differentiated with mpmath."""
    cam = gc.cam_by_radii(28, "straight", lift=15, ascent=math.radians(70))
    assert (cam.nose_distance, cam.nose_radius) == pytest.approx((22.7971, 20.2029), abs=5e-5)
    motion = gc.outline_motion(cam, gc.Translating(roller_radius=16))
    end = motion.breaks[1]
    assert math.degrees(end) == pytest.approx(25.96, abs=5e-5)
    found = [
        accelerations(motion, 600, *place)
        for place in ((0, "right"), (end, "left"), (end, "right"), (cam.ascent, "left"))
    ]
    assert found == pytest.approx([173.71, 284.79, -74.53, -146.67], abs=0.005)
    assert max_velocity(motion) * 20 * math.pi / 1000 == pytest.approx(1.4971, abs=5e-5)


def test_a_circular_arc_cam_has_its_published_accelerations():
    """Base 12, flank 36, nose 1.2, lift 7, under a flat face at 600 rpm."""
    cam = gc.cam_by_radii(12, 36, nose_radius=1.2, lift=7)
    assert math.degrees(cam.ascent) == pytest.approx(68.1347, abs=5e-5)
    motion = gc.outline_motion(cam, gc.FlatFaced())
    end = motion.breaks[1]
    assert math.degrees(end) == pytest.approx(28.3397, abs=5e-5)
    places = (0, "right"), (end, "left"), (end, "right"), (cam.ascent, "left")
    found = [accelerations(motion, 600, *place) for place in places]
    assert found == pytest.approx([94.75, 83.39, -53.99, -70.27], abs=0.005)
    assert max_velocity(motion) * 20 * math.pi / 1000 == pytest.approx(0.7158, abs=5e-5)


def test_an_eccentric_cam_gives_a_flat_face_a_harmonic_motion():
    """s = e (1 - cos phi)."""
    motion, phi = gc.outline_motion(gc.cam_by_radii(20, lift=12), gc.FlatFaced()), np.linspace(0, 6.2, 50)
    s, v, a, j = motion(phi)
    assert s == pytest.approx(6 * (1 - np.cos(phi)), abs=1e-13)
    assert np.array([v, a, j]) == pytest.approx(6 * np.array([np.sin(phi), np.cos(phi), -np.sin(phi)]), abs=1e-12)


@over_all("left_out", ["flank_radius", "nose_radius", "lift", "ascent"])
@over_all("flank", [36.0, -80.0, "straight"])
def test_each_size_follows_from_the_others(left_out, flank):
    """And the arcs touch: their centres and the point of contact lie on a line."""
    whole = gc.cam_by_radii(12, flank, nose_radius=4, lift=7)
    sizes = {"flank_radius": flank, "nose_radius": 4.0, "lift": 7.0, "ascent": whole.ascent}
    found = gc.cam_by_radii(12, **{name: size for name, size in sizes.items() if name != left_out})
    for name, size in sizes.items():
        if not (name == "flank_radius" and flank == "straight"):
            assert getattr(found, name) == pytest.approx(size, rel=1e-9)
    if flank != "straight":
        parts = found.arcs()
        for arc, following in pairwise(parts):
            assert abs(following.point - arc.centre) == pytest.approx(abs(arc.radius), rel=1e-9)


@over_all(
    ("sizes", "said"),
    [
        ({"base_radius": 12}, "3 of flank_radius"),
        ({"base_radius": 12, "flank_radius": 36, "nose_radius": 3, "lift": 7, "ascent": 1.0}, "3 of flank_radius"),
        ({"base_radius": 28, "flank_radius": 30, "nose_radius": 5, "lift": 15}, "greater than 35.5 mm"),
        (
            {"base_radius": 28, "flank_radius": 100, "nose_radius": 40, "lift": 15},
            "nose_radius is 40.0, but must be less than 35.5",
        ),
        ({"base_radius": -2, "lift": 7}, "base_radius"),
        ({"base_radius": 12, "flank_radius": 36, "nose_radius": 3, "lift": 7, "dwell": 5.0}, "less than a turn"),
        ({"base_radius": 28, "flank_radius": "straight", "nose_radius": 30, "ascent": 0.2}, "lift is none"),
    ],
)
def test_what_is_no_cam_is_told(sizes, said):
    with pytest.raises(gc.DesignError, match=said):
        gc.cam_by_radii(**sizes)


@over_all(
    ("cam", "follower", "said"),
    [
        (
            {"base_radius": 28, "flank_radius": "straight", "lift": 15, "ascent": 1.2},
            gc.FlatFaced(),
            "flank_radius is straight",
        ),
        ({"base_radius": 28, "flank_radius": -60, "nose_radius": 6, "lift": 12}, gc.FlatFaced(), "hollow"),
        ({"base_radius": 28, "flank_radius": -60, "nose_radius": 6, "lift": 12}, gc.Translating(0, 70), "hollow flank"),
        ({"base_radius": 28, "lift": 12}, gc.Translating(30), "offset"),
        ({"base_radius": 28, "lift": 12}, gc.Oscillating(80), "distance"),
        ({"base_radius": 28, "lift": 12}, gc.Oscillating(80, 200), "base_radius"),
        ({"base_radius": 28, "lift": 12}, gc.OscillatingFlat(39), "centre distance is 39, but must be greater than"),
        (
            {"base_radius": 28, "flank_radius": "straight", "lift": 15, "ascent": 1.2},
            gc.OscillatingFlat(90),
            "flank_radius is straight",
        ),
        ({"base_radius": 10, "flank_radius": 100, "nose_radius": 1, "lift": 40}, gc.Oscillating(25, 30), "90 degrees"),
    ],
)
def test_a_follower_that_cannot_follow_is_told(cam, follower, said):
    with pytest.raises(gc.DesignError, match=said):
        gc.outline_motion(gc.cam_by_radii(**cam), follower)
