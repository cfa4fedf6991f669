"""The bands of many cams at once: as of one by one, refused where they cannot be, the same bits in any chunks."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from over_all import fast_first

import graphcam as gc

ERRORS = {
    "translating": gc.MakingErrors((0.01, 0.002), (3, 24), roller_diameter=0.02, offset=0.06),
    "oscillating": gc.MakingErrors((0.01,), (3,), distance=0.05, arm=0.03, distribution="uniform"),
    "flat-faced": gc.MakingErrors((0.01,), (3,)),
}
ROUNDING, CORNER = 1e-13, 1e-7
"""A sweep closes in on a maximum to a hundred millionth of its bracket, which counts where the band has a corner."""


def designs(kind: str, n: int = 40) -> gc.Designs:
    draw = np.random.default_rng(3).uniform
    own = {
        "translating": {"offset": draw(-8, 8, n), "roller_radius": 8.0},
        "oscillating": {"arm": 80.0, "distance": draw(90, 110, n), "roller_radius": 8.0},
        "flat-faced": {},
    }[kind]
    return gc.Designs(
        lift=0.25 if kind == "oscillating" else draw(8, 20, n),
        rise_angle=1.9,
        return_angle=1.5,
        dwell_angle=np.where(draw(0, 1, n) < 0.5, 0, 0.4),
        prime_radius=draw(40, 60, n),
        rise_law="cycloidal",
        return_law=["3-4-5", "rectangular"] * (n // 2),
        rotation=["cw", "ccw"] * (n // 2),
        follower=kind,
        **own,
    )


@pytest.mark.parametrize("kind", fast_first(ERRORS))
def test_bands_of_a_sweep_are_those_of_each_cam(kind):
    many = designs(kind)
    found = gc.sweep(many, ["position_band"], errors=ERRORS[kind], coverage=0.99)["position_band"]
    each = np.array(
        [gc.motion_bands(many.cam(k), ERRORS[kind], coverage=0.99).widest[0].value for k in range(len(many))]
    )
    assert (found <= each * (1 + ROUNDING)).all()
    assert found == pytest.approx(each, rel=CORNER)
    assert np.median(np.abs(found / each - 1)) < ROUNDING


def test_neither_chunks_nor_threads_change_a_bit():
    many, errors = designs("translating"), ERRORS["translating"]
    whole = gc.sweep(many, ["position_band"], errors=errors)["position_band"]
    with ThreadPoolExecutor(2) as pool:
        parted = gc.sweep(many, ["position_band"], pool, errors=errors, chunk=7)["position_band"]
    assert whole.tobytes() == parted.tobytes()


def test_what_is_no_cam_has_no_band():
    none = gc.Designs(lift=10, rise_angle=2.0, return_angle=2.0, prime_radius=[5.0, 50.0], offset=8, roller_radius=4)
    found = gc.sweep(none, ["position_band"], errors=gc.MakingErrors(offset=0.1))["position_band"]
    assert np.isnan(found).tolist() == [True, False]


@pytest.mark.parametrize(
    ("kind", "errors", "message"),
    [
        ("translating", None, "errors is left out, but must be given for position_band"),
        (
            "flat-faced",
            gc.MakingErrors(offset=0.1),
            "offset is 0.1, but must be left out: this follower has no such size",
        ),
        ("oscillating", gc.MakingErrors(offset=0.1), "offset is 0.1, but must be left out"),
    ],
)
def test_bands_without_their_errors_are_refused(kind, errors, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.sweep(designs(kind), ["position_band"], errors=errors)


def test_knife_edges_have_no_roller():
    knives = gc.Designs(lift=10, rise_angle=2.0, return_angle=2.0, prime_radius=50.0, roller_radius=[0.0, 4.0])
    with pytest.raises(gc.DesignError, match="left out where a follower has a knife edge"):
        gc.sweep(knives, ["position_band"], errors=gc.MakingErrors(roller_diameter=0.1))
