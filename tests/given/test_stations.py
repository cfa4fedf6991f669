from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all

from graphcam.errors import DesignError
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.stations import divide


def motion_of(name: str, ratio: float = 1.0) -> Motion:
    return Motion([Rise(30, 1.4, name, ratio), Dwell(0.8), Return(30, 1.1, name, ratio), Dwell(FULL_TURN - 3.3)])


@over_all("name", LAWS)
@over_all("n", [2, 7, 12])
def test_stations_are_the_ends_of_the_parts_of_the_moving_phases(name, n):
    motion = motion_of(name)
    stations = divide(motion, n)
    assert [span.stop - span.start for span in stations.phases] == [n + 1, n + 1]
    assert sorted(set(stations.phase.tolist())) == [0, 2]  # no stations in dwells
    for span, start, angle in zip(stations.phases, (0, 2.2), (1.4, 1.1), strict=True):
        assert stations.u[span][[0, -1]].tolist() == [0, 1]
        assert_allclose(stations.phi[span], start + angle * stations.u[span])
    assert stations.left.size == 2 * n


@over_all("ratio", [0.2, 1.0, 1.7, 5.0, 40.0])
@over_all("n", [1, 2, 3, 12, 25])
def test_a_jump_of_the_acceleration_falls_on_a_division(ratio, n):
    stations = divide(motion_of("rectangular", ratio), n)
    for first, second in (stations.pieces[:2], stations.pieces[2:]):
        assert first.stop - 1 == second.start
        assert stations.u[second.start] == pytest.approx(1 / (1 + ratio), rel=1e-15)
        for piece in (first, second):
            assert piece.stop - piece.start >= 2  # at least one part
            assert np.ptp(np.diff(stations.u[piece])) < 1e-15  # equal parts
    # A whole phase in one part cannot hold the jump on a division: it gets two.
    assert stations.left.size == 2 * max(n, 2)


def test_the_jump_stands_on_its_division_to_the_last_bit_however_often_it_is_divided_again():
    """A rounding beyond it, the ordinate before the jump would be the one after it."""
    random = np.random.default_rng(5)
    for ratio, n, again in zip(
        random.uniform(0.3, 3, 200), random.integers(2, 25, 200), (2, 3, 5, 7) * 50, strict=True
    ):
        motion = motion_of("rectangular", float(ratio))
        stations = divide(motion, int(n), again)
        (jump,) = motion.phases[0].normalised.jumps
        for piece in stations.pieces:
            assert set(stations.u[piece][[0, -1]]) < {0.0, jump, 1.0}
        ends = [piece.stop - 1 for piece in stations.pieces]
        ordinates = [motion.at(stations.phase, stations.u, "left")[2][at] for at in (ends, np.subtract(ends, 1))]
        assert_allclose(*ordinates, rtol=1e-12)


@over_all(("ratio", "shares"), [(1.0, (6, 6)), (2.0, (4, 8)), (3.0, (3, 9)), (0.5, (8, 4)), (100.0, (1, 11))])
def test_parts_are_shared_out_in_proportion(ratio, shares):
    stations = divide(motion_of("rectangular", ratio), 12)
    assert tuple(piece.stop - piece.start - 1 for piece in stations.pieces[:2]) == shares


@over_all("name", LAWS)
@over_all("n", [1, 4, 7, 12, 25])
def test_on_demand_corners_of_the_acceleration_fall_on_divisions(name, n):
    """Between breaks the parts are equal, none is missing, and smooth curves are faired from jump to jump as before."""
    motion = motion_of(name)
    plain, cornered = divide(motion, n), divide(motion, n, at_corners=True)
    corners = {"triangular": [0.25, 0.75], "trapezoidal": [0.125, 0.375, 0.625, 0.875]}.get(name, [])
    for span, part in zip(cornered.phases, cornered.parts, strict=True):
        assert set(corners) <= set(cornered.u[span].tolist())
        breaks = 1 + len(corners) + (name == "rectangular")
        assert part.stop - part.start == max(n, breaks)
    for stretch in cornered.stretches:
        assert stretch.stop - stretch.start >= 2
        assert np.ptp(np.diff(cornered.u[stretch])) < 1e-15
    assert [cornered.u[piece][[0, -1]].tolist() for piece in cornered.pieces] == [
        plain.u[piece][[0, -1]].tolist() for piece in plain.pieces
    ]
    assert plain.stretches == plain.pieces


def test_parts_lie_between_neighbouring_stations_of_one_phase():
    stations = divide(motion_of("cosine"), 5)
    assert (stations.phase[stations.left] == stations.phase[stations.left + 1]).all()
    for span, part in zip(stations.phases, stations.parts, strict=True):
        assert stations.left[part].tolist() == list(range(span.start, span.stop - 1))


@over_all("n", [0, -3])
def test_a_phase_has_at_least_one_part(n):
    with pytest.raises(DesignError, match=r"divisions is .*1 or more"):
        divide(motion_of("cosine"), n)
