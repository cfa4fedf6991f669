"""Bands of s, v and a: the first order against a sample of solved mechanisms, the theorems of propagation, refusals."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from math import radians

import numpy as np
import pytest
from over_all import over_all, over_seeds

import graphcam as gc
from graphcam.given.laws import LAWS
from graphcam.mechanism import motion_bands as bands_module

SCATTER = 5.0
"""Standard deviations by which a sample may miss."""


def motion(lift: float = 20.0) -> gc.Motion:
    rise, back = gc.Rise(lift, radians(100), "3-4-5"), gc.Return(lift, radians(110), "cycloidal")
    return gc.Motion([rise, gc.Dwell(radians(60)), back, gc.Dwell(radians(90))])


CAMS = {
    "translating": gc.Cam(motion(), gc.Translating(offset=8, roller_radius=10), 40, "cw"),
    "oscillating": gc.Cam(motion(0.3), gc.Oscillating(arm=80, distance=100, roller_radius=10), 45),
    "flat-faced": gc.Cam(motion(), gc.FlatFaced(), 45),
}
OWN = {"translating": {"offset": 0.06}, "oscillating": {"distance": 0.05, "arm": 0.04}, "flat-faced": {}}


def errors(kind: str, **changed) -> gc.MakingErrors:
    roller = {} if kind == "flat-faced" else {"roller_diameter": 0.03}
    return gc.MakingErrors(**{"waviness": (0.008, 0.001), "harmonics": (3, 24), **roller, **OWN[kind], **changed})


@over_all("distribution", ["normal", "uniform"])
@over_all("kind", CAMS)
def test_the_root_of_the_sum_of_squares_is_the_scatter_of_solved_mechanisms(kind, distribution):
    """The variances of independent errors add; a sample of n misses a standard deviation by its 1/sqrt(2 n) part."""
    samples = 800
    bands = gc.motion_bands(CAMS[kind], errors(kind, distribution=distribution), samples=samples, seed=7)
    ratio = bands.sample.deviation / bands.deviation
    second_order = 0.01
    assert np.abs(ratio - 1).max() < SCATTER / np.sqrt(2 * samples) + second_order
    # No mechanism lies beyond all errors at their ends.
    assert (np.maximum(bands.sample.high, -bands.sample.low) < bands.worst * (1 + second_order)).all()


@over_all("kind", CAMS)
def test_a_single_wave_fills_its_band_and_no_more(kind):
    """Of a random phase it lies within cos(pi/2 (1 - p)) of its amplitude in the part p of all cams."""
    alone = gc.MakingErrors((0.004,), (24,))
    bands = gc.motion_bands(CAMS[kind], alone, samples=1500, coverage=0.9)
    assert bands.half_width.tolist() == bands.worst.tolist()
    assert bands.sample.half_width / bands.worst == pytest.approx(
        np.full_like(bands.worst, np.cos(0.05 * np.pi)), rel=0.03
    )


def test_velocity_grows_with_the_harmonic_and_acceleration_with_its_square():
    """In a dwell, where the slope of the flank does not change: exactly."""
    cam, at_rest = CAMS["translating"], np.array([radians(130)])
    for n in (1, 3, 50, 400):
        wave = gc.motion_bands(cam, gc.MakingErrors((1e-6,), (n,)), at_rest)
        s, v, a = wave.effects[f"waviness {n}"][:, 0]
        assert (v / s, a / s) == pytest.approx((n, n * n), rel=1e-13)


def test_shares_are_parts_of_one():
    bands = gc.motion_bands(CAMS["oscillating"], errors("oscillating"))
    assert sum(bands.shares.values()) == pytest.approx(np.ones_like(bands.deviation), rel=1e-13)
    table = bands.table()
    assert sum(share.shares for share in table) == pytest.approx(np.ones(3), rel=1e-13)
    assert [float(share.shares[0]) for share in table] == sorted(
        (float(share.shares[0]) for share in table), reverse=True
    )


def random_bands(seed: int) -> gc.MotionBands:
    """The bands of any follower with any two laws, some dwells, waves and tolerances."""
    draw = np.random.default_rng(seed)
    kind = list(OWN)[seed % 3]
    first, second = draw.choice(list(LAWS), 2)
    high, low, *moving = np.radians([*draw.uniform(0, 60, 2) * (draw.random(2) < 0.7), *draw.uniform(80, 120, 2)])
    lift = draw.uniform(0.1, 0.35) if kind == "oscillating" else draw.uniform(5, 25)
    rests = [[gc.Dwell(angle)] if angle else [] for angle in (high, low)]
    rest = gc.Dwell(2 * np.pi - sum(moving) - high - low)
    turn = [gc.Rise(lift, moving[0], first), *rests[0], gc.Return(lift, moving[1], second), *rests[1], rest]
    follower = {
        "translating": gc.Translating(draw.uniform(-15, 15), roller_radius=4),
        "oscillating": gc.Oscillating(80, draw.uniform(95, 110), roller_radius=4),
        "flat-faced": gc.FlatFaced(),
    }[kind]
    cam = gc.Cam(gc.Motion(turn), follower, draw.uniform(70, 90), str(draw.choice(["cw", "ccw"])))
    waves = int(draw.integers(1, 4))
    harmonics = draw.choice(np.arange(1, 40), waves, replace=False).tolist()
    roller = {} if kind == "flat-faced" else {"roller_diameter": draw.uniform(0, 0.1)}
    sizes = {name: draw.uniform(0, 0.2) * (draw.random() < 0.7) for name in OWN[kind]}
    made = gc.MakingErrors(tuple(10 ** draw.uniform(-5, -3, waves)), harmonics, **roller, **sizes)
    return gc.motion_bands(cam, made, coverage=draw.choice([0.5, 0.9, 0.95, 0.997]))


def highest_nearby(height, places: np.ndarray) -> float:
    """The greatest of a quantity, at places close together and then ever closer about the highest of them."""
    values = height(places)
    for k in np.argsort(-values)[:5]:
        low, high = places[max(k - 1, 0)], places[min(k + 1, places.size - 1)]
        for _ in range(4):
            near = np.linspace(low, high, 201)
            values = np.append(values, height(near))
            top = int(np.argmax(values[-201:]))
            low, high = near[max(top - 1, 0)], near[min(top + 1, 200)]
    return float(values.max())


@over_seeds(5)
def test_the_widest_place_of_a_band_is_its_maximum(seed):
    """Of s, v and a beside a dense turn; where the worst case takes over from the sum of squares there is a corner."""
    bands = random_bands(seed)
    motion = bands.cam.motion

    def half_width(phi, k: int, side="right"):
        effects = bands_module.effects_of(bands.cam.kinematics, bands.errors, motion(phi, side))
        return bands_module.half_widths(effects, bands.errors, bands.coverage)[k]

    breaks = np.concatenate([motion.breaks, motion.starts])
    for k, (value, phi, side) in enumerate(bands.widest):
        at_breaks = [half_width(breaks, k, each).max() for each in ("left", "right")]
        dense = max(highest_nearby(partial(half_width, k=k), np.linspace(0, 2 * np.pi, 20_001)), *at_breaks)
        assert dense * (1 - 1e-11) < value < dense * (1 + 1e-9)
        assert half_width(np.array([phi]), k, side) == pytest.approx(value, rel=1e-13)


def test_the_table_stands_where_the_bands_are_widest():
    bands = gc.motion_bands(CAMS["translating"], errors("translating"))
    for k, widest in enumerate(bands.widest):
        reached = np.sqrt(sum((bands.errors.part(share.name) * share.effects[k]) ** 2 for share in bands.table()))
        at_ends = sum(share.effects[k] for share in bands.table())
        assert min(1.959964 * reached, at_ends) == pytest.approx(widest.value, rel=1e-6)


def test_a_larger_tolerance_never_narrows_a_band():
    narrow, wide = (gc.motion_bands(CAMS["translating"], errors("translating", offset=zone)) for zone in (0.02, 0.2))
    assert (wide.half_width >= narrow.half_width).all()


def test_one_error_more_does_not_change_the_others():
    one, more = (
        gc.MakingErrors(offset=0.1).sample(9, seed=4),
        gc.MakingErrors((0.1,), (2,), offset=0.1).sample(9, seed=4),
    )
    assert one.sizes["offset"].tolist() == more.sizes["offset"].tolist()
    assert gc.MakingErrors(offset=0.1).sample(9, seed=5).sizes["offset"].tolist() != one.sizes["offset"].tolist()


def test_chunks_do_not_change_a_bit(monkeypatch):
    whole = gc.motion_bands(CAMS["translating"], errors("translating"), samples=50)
    monkeypatch.setattr(bands_module, "BATCH_SIZE", 500)
    parted = gc.motion_bands(CAMS["translating"], errors("translating"), samples=50)
    assert whole.sample.low.tolist() == parted.sample.low.tolist()


def test_a_jump_of_the_acceleration_is_met_on_neither_side():
    jumping = gc.Motion([gc.Rise(20, radians(180), "rectangular"), gc.Return(20, radians(180), "rectangular")])
    bands = gc.motion_bands(gc.Cam(jumping, gc.Translating(roller_radius=10), 40), gc.MakingErrors((0.005,), (3,)))
    assert bands.sample.half_width[2].max() == pytest.approx(bands.half_width[2].max(), rel=0.03)
    assert [top.side for top in bands.widest].count("left") >= 1 or bands.widest[2].phi in jumping.breaks


@over_all(
    ("kind", "given", "message"),
    [
        ("translating", {"distance": 0.1}, "distance is 0.1, but must be left out: this follower has no such size"),
        ("flat-faced", {"roller_diameter": 0.1}, "roller_diameter is 0.1, but must be left out"),
        (
            "translating",
            {"waviness": (0.5,), "harmonics": (60,)},
            r"waviness\[0\] is 0.5, but must be less than .* roller",
        ),
        (
            "flat-faced",
            {"waviness": (0.1,), "harmonics": (60,)},
            r"waviness\[0\] is 0.1, but must be less than .* face",
        ),
    ],
)
def test_errors_that_a_cam_cannot_have_are_refused(kind, given, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.motion_bands(CAMS[kind], gc.MakingErrors(**given))


def test_the_deepest_waves_that_are_let_pass_can_be_followed():
    """Half as deep as a hollow may be, r n^2 A = L M/2, the roller touches its bottom; a deeper one is refused."""
    cam = CAMS["translating"]
    with pytest.raises(gc.DesignError) as caught:
        gc.motion_bands(cam, gc.MakingErrors((1.0,), (40,)))
    deepest = float(caught.value.limit.split()[2])
    gc.motion_bands(cam, gc.MakingErrors((0.98 * deepest,), (40,)), samples=200).sample  # noqa: B018
    with pytest.raises(gc.DesignError, match="bridge the hollows"):
        gc.motion_bands(cam, gc.MakingErrors((1.02 * deepest,), (40,)))


@over_all(
    ("given", "message"),
    [
        ({"samples": 1}, "samples is 1, but must be 2 or more"),
        ({"coverage": 1.0}, "coverage is 1.0, but must be between 0 and 1"),
        ({"seed": -1}, "seed is -1, but must be 0 or more"),
    ],
)
def test_wrong_questions_are_refused(given, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.motion_bands(CAMS["translating"], gc.MakingErrors(offset=0.1), **given)


def test_a_knife_edge_has_no_roller_and_an_undercut_profile_no_errors():
    knife = replace(CAMS["translating"].follower, roller_radius=0.0)
    with pytest.raises(gc.DesignError, match="a knife edge has no roller"):
        gc.motion_bands(gc.Cam(motion(), knife, 40), gc.MakingErrors(roller_diameter=0.1))
    large = replace(CAMS["translating"].follower, roller_radius=29.0)
    with pytest.raises(gc.DesignError, match="profile is undercut"):
        gc.motion_bands(gc.Cam(motion(), large, 30), gc.MakingErrors(offset=0.1))


def test_tolerances_wider_than_the_mechanism_are_told_when_it_is_solved():
    bands = gc.motion_bands(CAMS["translating"], gc.MakingErrors(offset=400.0), samples=200)
    with pytest.raises(gc.DesignError, match="tolerances is too wide"):
        bands.sample  # noqa: B018


@over_all(
    ("given", "message"),
    [
        ({}, "waviness is left out, but must be given where no size has a tolerance"),
        ({"offset": -0.1}, "offset is -0.1, but must be a finite length of 0 mm or more"),
        ({"waviness": (0.1,)}, "harmonics is a list of 0, but must be a list of 1, as waviness is"),
        ({"waviness": (0.1,), "harmonics": (0,)}, r"harmonics\[0\] is 0, but must be from 1 to 10000"),
        ({"waviness": (0.1, 0.2), "harmonics": (3, 3)}, r"harmonics\[1\] is 3, but must be given once"),
        ({"offset": 0.1, "distribution": "norml"}, "did you mean 'normal'"),
    ],
)
def test_errors_that_cannot_be_are_refused(given, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.MakingErrors(**given)


def test_the_figure_shows_the_nominal_curves_and_the_bands(tmp_path):
    from matplotlib.figure import Figure

    bands = gc.motion_bands(CAMS["translating"], errors("translating"), samples=100)
    figure = Figure()
    axes = bands.plot(figure)
    upper, middle, lower = axes.child_axes
    assert [diagram.get_ylabel() for diagram in (upper, middle, lower)] == ["s", "v", "a"]
    for k, diagram in enumerate(axes.child_axes):
        high, low, nominal = (line.get_ydata() for line in diagram.get_lines()[1::-1] + diagram.get_lines()[2:3])
        assert nominal.tolist() == bands.nominal[k].tolist()
        times = float(diagram.texts[0].get_text().split("×")[1])
        assert (high - low) / 2 == pytest.approx(times * bands.half_width[k], rel=1e-9, abs=1e-9)
    assert "<svg" in bands._repr_svg_()
    assert str(bands).splitlines()[0] == "MotionBands, which hold 0.95 of all cams"
