"""The chain as a whole: each construction fed by those before it, drawn when asked for, and a value that travels."""

from __future__ import annotations

import multiprocessing
import pickle
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from boards import SIZES, arm_board, arm_motion, coursework, flat_board, flat_motion, limits
from numpy.testing import assert_array_equal
from over_all import over_all

from graphcam.constructions import board as board_module, chain as chain_module, drawn_translating as translating
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil

HAND = Pencil(line=0.2, dividers=0.2, division=0.5, protractor=0.01, seed=4)
HANDS = Pencil(line=0.2, dividers=0.2, protractor=0.01, samples=3, seed=4)
NAMES = translating.DrawnTranslating.constructions
PENCILS = over_all("pencil", [Pencil(), HAND, HANDS])


def every_reading(chain: Chain) -> dict[tuple[str, str], np.ndarray]:
    return {(name, key): kept.value for name in sorted(chain) for key, kept in chain[name].readings.items()}


def assert_same(first, second):
    assert first.keys() == second.keys()
    for key, value in first.items():
        assert_array_equal(second[key], value, err_msg=str(key))


def test_the_chain_is_a_mapping_in_the_order_of_drawing():
    chain = Chain(coursework())
    assert list(chain) == list(NAMES)
    assert len(chain) == len(NAMES)
    assert [construction.name for construction in chain.values()] == list(NAMES)
    assert chain["integration"] is chain["integration"]
    for name in ("gear", "board", "perfect", "sizes"):
        with pytest.raises(KeyError):
            chain[name]


NEEDS = {
    "scheme": set(),
    "acceleration": set(),
    "integration": {"acceleration_diagram"},
    "minimum_radius": {"acceleration_diagram", "integration"},
    "pressure_angle": {"acceleration_diagram", "integration"},
    "angle_diagram": {"acceleration_diagram", "integration", "pressure_angle"},
    "inversion": {"acceleration_diagram", "integration"},
    "curvature": {"acceleration_diagram", "integration", "inversion"},
    "roller": {"acceleration_diagram", "integration", "inversion", "curvature"},
    "working_profile": {"acceleration_diagram", "integration", "pressure_angle", "inversion"},
}
"""With all sizes given: the constructions that each starts from."""
FUNCTIONS = {
    "acceleration": "acceleration_diagram", "minimum_radius": "least_radius", "roller": "roller_radius",
}  # fmt: skip
"""Functions that are not named as their construction."""


@pytest.fixture
def drawn(monkeypatch) -> list[str]:
    """The names of the constructions' functions in the order in which they are called."""
    calls: list[str] = []
    for name in NAMES:
        function = FUNCTIONS.get(name, name)
        module = next(m for m in (chain_module, translating, board_module) if hasattr(m, function))
        monkeypatch.setattr(module, function, counted(calls, function, getattr(module, function)))
    return calls


def counted(calls: list[str], name: str, function):
    def call(*args, **options):
        calls.append(name)
        return function(*args, **options)

    return call


@pytest.mark.parametrize("name", NAMES)
def test_one_construction_draws_only_what_it_starts_from(name, drawn):
    given = coursework(prime_radius=46.0, roller_radius=12.0)
    _ = Chain(given)[name]
    assert sorted(drawn) == sorted({*NEEDS[name], FUNCTIONS.get(name, name)})  # each once


def test_the_whole_chain_draws_every_construction_once(drawn):
    chain = Chain(coursework("cycloidal"))
    for name in (*NAMES, *reversed(NAMES)):
        chain[name].steps()
    assert sorted(drawn) == sorted(FUNCTIONS.get(name, name) for name in NAMES)


@PENCILS
def test_asking_for_the_steps_changes_no_reading(pencil):
    untouched = every_reading(Chain(coursework("3-4-5"), pencil))
    chain = Chain(coursework("3-4-5"), pencil)
    for construction in chain.values():
        first, second = construction.steps(), construction.steps()
        assert [str(step.caption) for step in first] == [str(step.caption) for step in second]
    assert_same(untouched, every_reading(chain))


@PENCILS
def test_the_order_of_asking_and_what_else_is_asked_for_change_no_reading(pencil):
    whole = every_reading(Chain(coursework("cycloidal"), pencil))
    backwards = Chain(coursework("cycloidal"), pencil)
    for name in reversed(NAMES):
        _ = backwards[name]
    assert_same(whole, every_reading(backwards))
    alone = Chain(coursework("cycloidal"), pencil)["angle_diagram"]
    for key, kept in alone.readings.items():
        assert_array_equal(kept.value, whole["angle_diagram", key])


def test_another_seed_is_another_hand():
    first, second = (Chain(coursework(), Pencil(line=0.2, seed=seed), decided=SIZES) for seed in (1, 2))
    assert not np.array_equal(first["integration"].readings["s"].value, second["integration"].readings["s"].value)


def test_errors_travel_from_one_construction_to_the_next():
    """A hand that errs in the integration alone moves every reading after it."""
    board = coursework("3-4-5")
    perfect = Chain(board)
    wrong = chain_module.integration(perfect["acceleration"], board.poles, Pencil(line=0.5))
    region = translating.least_radius(wrong, board.rotation, board.limits, board.follower.place, Pencil())
    before = perfect["minimum_radius"].readings["prime_radius"].value
    assert abs(region.readings["prime_radius"].value - before) > 0.01


@PENCILS
@over_all("name", NAMES)
def test_a_construction_pickles_with_all_that_it_needs(name, pencil):
    construction = Chain(coursework("3-4-5"), pencil)[name]
    again = pickle.loads(pickle.dumps(construction))
    assert again.readings.keys() == construction.readings.keys()
    for key, kept in construction.readings.items():
        assert_array_equal(again.readings[key].value, kept.value)
    assert [str(step.caption) for step in again.steps()] == [str(step.caption) for step in construction.steps()]


def test_a_construction_is_drawn_in_another_process():
    profile = Chain(coursework("cycloidal"))["working_profile"]
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        far = pool.submit(Construction.steps, profile).result(timeout=60)
    near = profile.steps()
    assert [str(step.caption) for step in far] == [str(step.caption) for step in near]
    assert_array_equal(far[3].marks[0].points, near[3].marks[0].points)


# --- other followers -------------------------------------------------------------------------------------------------

OTHERS = {
    "arm": arm_board(arm_motion("3-4-5"), None, limits=limits(45, 40)),
    "flat": flat_board(flat_motion("3-4-5")),
}
each_other = pytest.mark.parametrize("board", OTHERS.values(), ids=OTHERS)


@PENCILS
@each_other
def test_other_followers_draw_the_same_in_any_order_with_and_without_steps(board, pencil):
    whole = every_reading(Chain(board, pencil))
    backwards = Chain(board, pencil)
    for name in reversed(list(backwards)):
        first, second = (backwards[name].steps() for _ in range(2))
        assert [str(step.caption) for step in first] == [str(step.caption) for step in second]
    assert_same(whole, every_reading(backwards))


@PENCILS
@each_other
def test_constructions_of_other_followers_pickle_with_all_that_they_need(board, pencil):
    for construction in Chain(board, pencil).values():
        again = pickle.loads(pickle.dumps(construction))
        assert_same(
            {key: kept.value for key, kept in construction.readings.items()},
            {key: kept.value for key, kept in again.readings.items()},
        )
        assert [str(step.caption) for step in again.steps()] == [str(step.caption) for step in construction.steps()]


@each_other
def test_other_followers_are_drawn_by_many_hands_at_once_and_decided_by_the_perfect_one(board):
    perfect, many = Chain(board), Chain(board, Pencil(line=0.1, dividers=0.1, protractor=0.002, samples=50, seed=1))
    assert many.sizes == perfect.sizes
    alike = Chain(board, Pencil(samples=2))
    for name, construction in many.items():
        for key, kept in construction.readings.items():
            exact = perfect[name].readings[key].value
            assert kept.value.shape == (50, *np.shape(exact)), (name, key)
            sampled = alike[name].readings[key].value
            np.testing.assert_allclose(sampled, np.broadcast_to(exact, sampled.shape), rtol=1e-9, atol=1e-9)


def test_of_other_followers_only_a_flat_face_draws_its_region_for_the_curvature():
    """The arm's least radius may be unreadable while its curvature is not."""
    for name, board in OTHERS.items():
        chain = Chain(replace(board, prime_radius=50.0), decided=SIZES if name == "flat" else ARM_SIZES)
        _ = chain["curvature"]
        assert ("minimum_radius" in chain.lying) == (name == "flat")


ARM_SIZES = AdoptedSizes(50.0, 120.0, 10.0)
