"""What the task leaves open: the region of the cam centre, and the sizes that are adopted from the drawing."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from boards import SIZES, board_of, coursework, coursework_motion, limits, motion_of
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.constructions.minimum_radius import active_boundaries
from graphcam.drafting.scale import GOST_2_302, Paper
from graphcam.errors import DesignError
from graphcam.given.roller_rule import roller_rule

N = 96
WITHIN = 47 / N**2
"""The constant of the convergence tests, over n^2 [mm]."""


def region_of(motion, permitted, offset=None, n=N, rotation="ccw"):
    return Chain(board_of(motion, limits=permitted, offset=offset, rotation=rotation, divisions=n))["minimum_radius"]


def names(region) -> set[str]:
    return {line.name for line in active_boundaries(region)}


# --- the region ------------------------------------------------------------------------------------------------------


@over_all(
    ("law", "force", "form"),
    [
        ("rectangular", 43.28, 102.05), ("cosine", 29.76, 82.30), ("cycloidal", 44.47, 102.96), ("3-4-5", 40.13, 96.93),
    ],
)  # fmt: skip
def test_the_least_radii_of_the_coursework(law, force, form):
    """The case coursework-radius: the printed digits, within what 96 parts leave."""
    for permitted, printed in ((limits(30), force), (limits(30, 30), form)):
        region = region_of(coursework_motion(law), permitted, -10.0, rotation="cw")
        assert region.readings["prime_radius"].value == pytest.approx(printed, abs=0.005 + WITHIN)
        assert region.readings["offset"].value == pytest.approx(-10, rel=1e-12)


@over_all(
    ("law", "r0", "e"),
    [("3-4-5", 31.460717695936821, 1.2523617177719384), ("rectangular", 32.222477494517386, 1.4015871026113479)],
)
def test_the_nearest_point_of_the_region(law, r0, e):
    """The case least-radius."""
    region = region_of(motion_of((30, 120, law), (0, 60), (-30, 90, law)), limits(30, 40))
    assert region.readings["prime_radius"].value == pytest.approx(r0, abs=WITHIN)
    assert region.readings["offset"].value == pytest.approx(e, abs=WITHIN)
    assert names(region) == {"rise", "return"}


def test_the_lowest_permitted_point_of_a_central_follower():
    region = region_of(motion_of((30, 120, "3-4-5"), (0, 60), (-30, 90, "3-4-5")), limits(30, 40), 0.0)
    assert region.readings["prime_radius"].value == pytest.approx(33.604935458511626, abs=WITHIN)
    assert len(names(region)) == 1


APEX = motion_of((30, 60, "cycloidal"), (-30, 240, "cycloidal"))


def test_the_apex_is_not_always_the_least_radius():
    """The case apex-is-not-least: without the rest line the foot on the rise's tangent is nearer."""
    region = region_of(APEX, limits(30, 85, rest=False))
    assert region.readings["prime_radius"].value == pytest.approx(42.577631133349168, abs=WITHIN)
    assert names(region) == {"rise"}
    centre = complex(region.points["centre"])
    assert abs(math.degrees(math.atan2(abs(centre.real), -centre.imag))) == pytest.approx(60)  # square to 30 degrees


def test_the_rest_line_moves_the_centre_to_the_corner():
    region = region_of(APEX, limits(30, 85))
    assert region.readings["prime_radius"].value == pytest.approx(49.164413592591466, abs=WITHIN)
    assert region.readings["offset"].value == pytest.approx(24.582206796295733, abs=WITHIN)
    assert names(region) == {"rise", "rest"}


@over_all("rotation", ["ccw", "cw"])
@over_all("offset", [None, 0.0, 12.0, -12.0, 60.0])
@over_all("permitted", [limits(30), limits(25, 40), limits(35, 70, rest=False), limits(40, 20)])
def test_region_and_exact_least_radius_agree_where_the_law_is_drawn_without_error(rotation, offset, permitted):
    motion = motion_of((20, 90, "rectangular", 1.5), (0, 30), (10, 60, "rectangular"), (-30, 150, "rectangular", 0.7))
    exact = gc.minimum_radius(
        motion, gc.Translating(), rotation, permitted.rise, permitted.return_, offset, permitted.rest
    )
    region = region_of(motion, permitted, offset, n=10, rotation=rotation)
    assert region.readings["prime_radius"].value == pytest.approx(exact.prime_radius, rel=1e-11)
    assert region.readings["offset"].value == pytest.approx(exact.offset, rel=1e-11, abs=1e-11)
    # Exactly both lines from the start of the lift are of the rest.
    assert {name.removesuffix(" after the return") for name in names(region)} == set(exact.active)


def test_force_closure_has_no_line_of_the_return():
    region = region_of(coursework_motion("cosine"), limits(30))
    assert "return" not in region.points
    assert "spring" in str(region.steps()[2].caption)


# --- adoption --------------------------------------------------------------------------------------------------------


def test_the_built_in_task():
    """Minimum radius 43.28 mm, adopted 44; 0.4 r0 = 17.6 mm binds the rule, adopted 17."""
    chain = Chain(coursework())
    assert chain.sizes == AdoptedSizes(44.0, -10.0, 17.0)
    assert chain["roller"].readings["roller_radius"].value == pytest.approx(17.6, rel=1e-12)


@over_all("law", gc.LAWS)
def test_a_free_offset_is_rounded_and_the_radius_read_again_at_it(law):
    chain = Chain(coursework(law, offset=None, limits=limits(30, 45)))
    free = chain["minimum_radius"].readings
    assert chain.place == round(float(free["offset"].value))
    at_offset = Chain(coursework(law, offset=chain.place, limits=limits(30, 45)))["minimum_radius"]
    again = float(at_offset.readings["prime_radius"].value)
    assert chain.prime_radius == math.ceil(again)
    assert again >= free["prime_radius"].value - 1e-9
    assert np.degrees(np.abs(chain["pressure_angle"].readings["alpha"].value)).max() < 45.5


def test_given_sizes_are_kept_and_the_least_radius_is_drawn_all_the_same():
    chain = Chain(coursework(prime_radius=61.5, roller_radius=13.25, offset=-7.125))
    assert chain.sizes == AdoptedSizes(61.5, -7.125, 13.25)
    exact = gc.minimum_radius(coursework_motion("rectangular"), gc.Translating(), "cw", offset=-7.125)
    assert chain["minimum_radius"].readings["prime_radius"].value == pytest.approx(exact.prime_radius, rel=1e-12)
    assert chain["inversion"].readings["radius"].value.min() == pytest.approx(61.5, rel=1e-12)
    assert chain["roller"].readings["roller_radius"].value == pytest.approx(13.25)


def test_sizes_decided_before_take_the_place_of_the_proposals():
    chain = Chain(coursework(), decided=SIZES)
    assert chain.sizes == SIZES
    assert chain["inversion"].givens.prime_radius == SIZES.prime_radius


@over_all(
    ("rounding", "sizes"),
    [
        (None, (44.0, -10.0, 17.0)), (0.5, (43.5, -10.0, 17.0)), (0.1, (43.3, -10.0, 17.3)),
        (5.0, (45.0, -10.0, 15.0)), (20.0, (60.0, -10.0, 20.0)),
    ],
)  # fmt: skip
def test_radius_up_and_roller_down_to_a_multiple_of_the_rounding(rounding, sizes):
    """A given offset is not rounded; tenths are the nearest doubles to the printed decimals."""
    assert Chain(coursework(rounding=rounding)).sizes == AdoptedSizes(*sizes)


@over_all(("lift", "rounding"), [(0.3, 0.01), (3, 0.1), (9, 0.1), (30, 1.0), (3000, 1.0)])
def test_the_default_rounding_is_the_largest_power_of_ten_below_a_tenth_of_the_radius(lift, rounding):
    chain = Chain(board_of(motion_of((lift, 80, "cosine"), (-lift, 60, "cosine")), offset=None))
    assert chain.rounding == pytest.approx(rounding, rel=1e-15)
    least = float(chain["minimum_radius"].readings["prime_radius"].value)
    assert rounding == 1.0 or rounding <= least / 10 < 10 * rounding


@over_all("offset", [10.0, 12.0, 27.0, 36.0])
def test_a_radius_that_is_round_already_is_not_raised(offset):
    """The rest line alone binds: s0 = e/tan 30, so r0 = 2 e, but for rounding of the arithmetic."""
    chain = Chain(board_of(motion_of((-30, 80, "3-4-5"), (0, 40), (30, 100, "cosine")), offset=-offset))
    assert names(chain["minimum_radius"]) == {"rest"}
    assert chain["minimum_radius"].readings["prime_radius"].value == pytest.approx(2 * offset, rel=1e-12)
    assert chain.prime_radius == 2 * offset


def test_without_the_rest_line_a_large_offset_leaves_a_cam_all_the_same():
    """The least radius would be the offset itself, where the line of motion only touches the prime circle."""
    chain = Chain(coursework(offset=-60.0, limits=limits(30, rest=False)))
    assert chain["minimum_radius"].readings["prime_radius"].value == pytest.approx(60)
    assert names(chain["minimum_radius"]) == set()
    assert chain.prime_radius == 61.0
    for construction in chain.values():
        assert all(np.isfinite(kept.value).all() for kept in construction.readings.values())


def test_the_smallest_of_the_rules_terms_is_taken():
    chain = Chain(coursework("cosine", roller_rule=roller_rule("min(0.8 rho, 0.45 r0, rho - 4)")), decided=SIZES)
    rho = float(chain["curvature"].readings["rho"].value)
    candidates = chain["roller"].readings["candidates"].value
    assert candidates == pytest.approx([0.8 * rho, 0.45 * 46, rho - 4], rel=1e-12)
    assert chain["roller"].readings["roller_radius"].value == candidates.min()


def test_rules_of_a_published_coursework():
    """The case rollers: by the prime radius of 134.8 mm, 0.4 r0 = 53.92 mm."""
    chain = Chain(coursework(prime_radius=134.8, roller_rule=roller_rule("min(0.4 r0, 0.65 rho)")))
    candidates = chain["roller"].readings["candidates"].value
    assert candidates[0] == pytest.approx(53.92, rel=1e-12)
    assert candidates[1] == pytest.approx(0.65 * float(chain["curvature"].readings["rho"].value), rel=1e-12)


def test_a_rule_that_leaves_no_roller_is_an_error_with_a_remedy():
    chain = Chain(coursework(roller_rule=roller_rule("rho - 200")))
    with pytest.raises(DesignError, match=r"give follower\.roller_radius or another rule"):
        _ = chain["working_profile"]
    assert chain["roller"].readings["roller_radius"].value < 0  # the proposal itself is drawn


def test_a_roller_smaller_than_the_rounding_is_kept_as_proposed():
    chain = Chain(coursework(roller_rule=roller_rule("0.01 r0")))
    assert chain.roller_radius == pytest.approx(0.44)


def test_the_profile_is_drawn_at_the_largest_standard_scale_that_fits():
    scales = []
    for room in (1000, 330, 150, 60, 20):
        chain = Chain(coursework(paper=Paper(room, room + 50, GOST_2_302)))
        reach = 2 * np.abs(chain["inversion"].points["pitch"]).max() + 2 * 17 / chain.profile_scale.per_mm
        assert reach <= room
        scales.append(chain.profile_scale.per_mm)
    assert all(first < second for first, second in pairwise(scales))
