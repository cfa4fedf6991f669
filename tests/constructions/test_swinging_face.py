"""The oscillating flat face on the drawing board, against the exact cam and against the figure itself."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest
from boards import arm_motion, order, swinging_face_board

import graphcam as gc
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.given.motion import Motion
from graphcam.given.stations import divide

SIZES = AdoptedSizes(prime_radius=70.0, place=150.0, roller_radius=0.0)
CASES = [*product(("ccw", "cw"), (10.0, 0.0, -12.0))]


def chain_of(rotation: str, offset: float, law: str = "3-4-5", divisions: int = 12, **changes) -> Chain:
    board = swinging_face_board(
        arm_motion(law, 9.0), face_offset=offset, rotation=rotation, divisions=divisions, **changes
    )
    return Chain(board, decided=SIZES)


def cam_of(chain: Chain) -> gc.Cam:
    return gc.Cam(chain.board.motion, chain.board.follower.built(150.0, 0.0), 70.0, chain.board.rotation)


def complex_of(xy: np.ndarray) -> np.ndarray:
    return xy[..., 0] + 1j * xy[..., 1]


@pytest.mark.parametrize(("rotation", "offset"), CASES)
def test_the_faces_of_a_perfect_drawing_are_tangents_of_the_exact_cam(rotation, offset):
    """The angle of the face follows from s alone, so only the drawn displacement and velocity are off."""
    chain = chain_of(rotation, offset, divisions=48)
    stations, drawn = chain.board.stations, chain["inversion"]
    exact = complex_of(cam_of(chain).at(stations.phase, stations.u).profile)
    mu = chain.profile_scale.per_mm
    assert np.abs(drawn.value("x") + 1j * drawn.value("y") - exact).max() < 0.1
    faces = drawn.acts["faces" if offset else "lines"]
    way = faces.directions / np.abs(faces.directions)
    normal = -1j * way
    # All places of the exact profile lie on the inner side of every drawn face, and the nearest of them upon it.
    body = complex_of(cam_of(chain).profile(np.linspace(0, 2 * math.pi, 4001))) / mu
    beyond = np.max(((body[:, None] - faces.points) * normal.conj()).real, axis=0)
    assert np.abs(beyond).max() < 0.1


@pytest.mark.parametrize(("rotation", "offset"), CASES)
def test_the_profile_converges_with_the_parts(rotation, offset):
    parts, errors = (6, 12, 24, 48), []
    for divisions in parts:
        chain = chain_of(rotation, offset, divisions=divisions)
        stations, drawn = chain.board.stations, chain["inversion"]
        exact = complex_of(cam_of(chain).at(stations.phase, stations.u).profile)
        errors.append(np.abs(drawn.value("x") + 1j * drawn.value("y") - exact).max())
    assert order(parts, errors) > 1.8


@pytest.mark.parametrize(("rotation", "offset"), CASES)
@pytest.mark.parametrize("law", ["3-4-5", "cosine", "rectangular"])
def test_the_minimum_radius_converges_to_the_exact_one(rotation, offset, law):
    def drawn(divisions: int) -> float:
        board = chain_of(rotation, offset, law, divisions).board
        return float(Chain(board)["minimum_radius"].value("prime_radius"))

    follower = gc.OscillatingFlat(150.0, offset)
    exact = gc.minimum_radius(arm_motion(law, 9.0), follower, rotation, curvature=8.0).prime_radius
    coarse, fine = (abs(drawn(divisions) - exact) for divisions in (12, 48))
    assert fine < 0.15
    assert fine < coarse / 4 or coarse < 0.05


@pytest.mark.parametrize(("rotation", "offset"), CASES)
def test_angle_and_reach_are_read(rotation, offset):
    chain = chain_of(rotation, offset, divisions=24)
    drawn, reach = chain["inversion"], gc.face_reach(chain.board.motion, cam_of(chain).follower, 70.0, rotation)
    assert float(drawn.value("psi0")) == pytest.approx(math.asin((70 + offset) / 150), abs=1e-12)
    assert float(drawn.value("face_near")) == pytest.approx(reach.near, abs=0.3)
    assert float(drawn.value("face_far")) == pytest.approx(reach.far, abs=0.3)


@pytest.mark.parametrize(("rotation", "offset"), CASES)
def test_a_profile_that_is_touched_beyond_the_pivot_circle_reaches_so_far(rotation, offset):
    board = swinging_face_board(arm_motion("3-4-5", 40.0), face_offset=offset, rotation=rotation)
    cam = gc.Cam(board.motion, board.follower.built(150.0, 0.0), 70.0, rotation)
    farthest = np.hypot(*np.moveaxis(cam.profile(np.linspace(0, 2 * math.pi, 4001)), -1, 0)).max()
    assert farthest > 160
    assert board.follower.reach(70.0, 150.0, board.motion, 0.0, rotation) == pytest.approx(farthest, rel=5e-3)


def test_the_line_from_the_pivot_touches_its_circle():
    drawn = chain_of("cw", 10.0)["inversion"]
    starts, pivots = drawn.acts["starts"].points, drawn.acts["pivots"].points
    assert np.abs((starts.conj() * (pivots - starts)).real).max() < 1e-9
    assert np.abs(np.abs(starts) - 80.0 / chain_of("cw", 10.0).profile_scale.per_mm).max() < 1e-9


def test_the_radius_of_curvature_by_three_points_approaches_the_exact_one():
    exact = cam_of(chain_of("ccw", 10.0)).extremes().min_convex_radius[0]
    found = [float(chain_of("ccw", 10.0, divisions=n)["curvature"].value("rho")) for n in (12, 72)]
    assert abs(found[1] - exact) < 1.0
    assert abs(found[1] - exact) < abs(found[0] - exact)


def test_a_dwell_alone_asks_for_the_permitted_radius_itself():
    """Of a hardly moving face the radius of curvature is that of the prime circle."""
    motion = Motion([gc.Rise(1e-4, 2.0), gc.Dwell(1.0), gc.Return(1e-4, 2.0), gc.Dwell(2 * math.pi - 5.0)])
    region = Chain(swinging_face_board(motion))["minimum_radius"]
    assert float(region.value("prime_radius")) == pytest.approx(8.0, abs=0.1)


def test_hands_err_and_are_told_apart():
    chain = chain_of("ccw", 10.0).by(gc.Pencil(line=0.1, dividers=0.1, protractor=0.001, samples=20))
    x = chain["inversion"].readings["x"].value
    assert x.shape == (20, chain.board.stations.u.size)
    assert 0.05 < x.std(axis=0).mean() < 0.6
    radius = chain["minimum_radius"].readings["prime_radius"].value
    assert radius.shape == (20,)
    assert np.isfinite(radius).all()
    assert all(construction.steps() for construction in chain.values())


def test_a_radius_that_no_place_permits_is_told():
    board = swinging_face_board(arm_motion("3-4-5", 20.0), distance=60.0, least_curvature=55.0)
    with pytest.raises(gc.DesignError, match=r"give cam\.prime_radius, or permit a smaller radius of curvature"):
        _ = Chain(board).prime_radius


def test_the_stations_stand_at_corners_of_the_acceleration():
    board = swinging_face_board(arm_motion("trapezoidal", 9.0))
    assert board.stations.u.size == divide(board.motion, 12, at_corners=True).u.size
