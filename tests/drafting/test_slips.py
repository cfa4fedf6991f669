"""The error model is written down once, and the hand errs by it: every kind of act, each thing that is off in it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from graphcam.drafting.acts import Drawn, Kind
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import BISECTION_SHARE, Hand, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.slips import PROTRACTOR_RADIUS, SLIPS

MEANING = Meaning("example", say("Example"), say("To try."), {"length": ReadingMeaning(say("length"), "l", "lift")})
ERRORS = {"line": 0.2, "dividers": 0.3, "division": 0.5, "protractor": 0.01}
SAMPLES = 5_000
WITHIN = 0.06
"""Of a standard deviation from 5,000 samples: six of its own."""
WAY = (3 + 4j) / 5
Off = Mapping[str, np.ndarray]


def aside(drawn: Drawn, way: complex = WAY) -> dict[str, np.ndarray]:
    """How far places lie along a direction from the origin, and across it."""
    return {"along": (drawn.points / way).real, "across": (drawn.points / way).imag}


def turn(drawn: Drawn, way: complex = WAY) -> np.ndarray:
    return np.angle(drawn.directions / way)


def divided(hand: Hand) -> Off:
    ends = hand.given("start", -10 * WAY), hand.given("end", 10 * WAY)
    return {"along": aside(hand.divide("marks", *ends, 0.5))["along"]}


def erected(hand: Hand) -> Off:
    return {"across": aside(hand.erect("line", hand.given("foot", 0j), WAY))["across"]}


def projected(hand: Hand) -> Off:
    return {"along": aside(hand.project("foot", hand.given("p", 5j * WAY), hand.given("l", 0j, WAY)))["along"]}


def laid_off(hand: Hand) -> Off:
    return {"along": aside(hand.lay_off("end", hand.given("start", -10 * WAY), WAY, 10.0))["along"]}


def parallel(hand: Hand) -> Off:
    line = hand.parallel("line", hand.given("to", 9j, along=WAY), hand.given("through", 0j))
    return {"across": aside(line)["across"], "turn": turn(line)}


def perpendicular(hand: Hand) -> Off:
    line = hand.perpendicular("line", hand.given("to", 9j, along=WAY / 1j), hand.given("through", 0j))
    return {"across": aside(line)["across"], "turn": turn(line)}


def tangent(hand: Hand) -> Off:
    """With a set square to an arc, whose farthest place is the origin; with a mirror to any curve."""
    x = np.linspace(-3.0, 3.0, 7)
    line = hand.tangent("touch", hand.given("arc", (x - 1j * x**2) * WAY), [slice(0, 7)], 1j * WAY)
    mirrored = hand.tangents_at("mirror", hand.given("curve", 0j), lambda points: np.full(points.shape, WAY))
    beside = np.concatenate([aside(each)["across"] for each in (line, mirrored)])
    return {"across": beside, "along": aside(line)["along"], "turn": turn(mirrored)}


def bisected(hand: Hand) -> Off:
    """Where the bisector passes the heights of both crossings of the arcs."""
    line = hand.bisect("line", hand.given("a", -5 + 0j), hand.given("b", 5 + 0j))
    height = 10 * math.sqrt(BISECTION_SHARE**2 - 0.25)
    slope = line.directions.real / line.directions.imag
    one, other = (line.points.real + slope * (side * height - line.points.imag) for side in (-1, 1))
    return {"one": one, "other": other}


def circle(hand: Hand) -> Off:
    drawn = hand.circle("circle", hand.given("centre", 0j), 20.0)
    assert drawn.radius is not None
    return {"across": drawn.points.real, "up": drawn.points.imag, "radius": drawn.radius}


def protracted(hand: Hand) -> Off:
    line = hand.protractor("line", hand.given("vertex", 0j), RIGHT, float(np.angle(WAY)))
    # The offset is across the line as it was set.
    return {"turn": turn(line), "across": (line.points / line.directions * np.abs(line.directions)).imag}


def read(hand: Hand) -> Off:
    """Lengths that end anywhere between two divisions, and an angle."""
    assert hand.pencil.samples
    ends = hand.given("ends", 1j * np.linspace(7.0, 57.0, SAMPLES, endpoint=False) + 0j)
    length = distance_between(hand.given("foot", 0j), ends, UP)
    off = hand.read("length", length, 1.0).paper[0] - length.amount[0]
    line = hand.given("line", 0j, along=WAY)
    return {"length": off, "turn": hand.angle("angle", WAY, line).paper}


ACTS: Mapping[Kind, Callable[[Hand], Off]] = {
    Kind.DIVIDE: divided,
    Kind.ERECT: erected,
    Kind.PROJECT: projected,
    Kind.LAY_OFF: laid_off,
    Kind.PARALLEL: parallel,
    Kind.PERPENDICULAR: perpendicular,
    Kind.TANGENT: tangent,
    Kind.BISECT: bisected,
    Kind.CIRCLE: circle,
    Kind.PROTRACTOR: protracted,
    Kind.READ: read,
}


def hands(only: frozenset[Kind] | None = None) -> Hand:
    return Hand(Pencil(**ERRORS, samples=SAMPLES, seed=3, only=only), MEANING)


@pytest.mark.parametrize("kind", SLIPS)
def test_every_act_errs_by_what_is_written_down(kind):
    off = ACTS[kind](hands())
    assert set(off) == set(SLIPS[kind])
    for what, values in off.items():
        slip = SLIPS[kind][what]
        assert np.std(values) == pytest.approx(slip.times * ERRORS[slip.of], rel=WITHIN), what
        assert np.std(values) == pytest.approx(hands().pencil.deviation(kind, what), rel=WITHIN)


@pytest.mark.parametrize("kind", SLIPS)
def test_a_hand_that_errs_in_other_acts_only_does_this_one_exactly(kind):
    exact, erring = (ACTS[kind](hands(only)) for only in (frozenset(SLIPS) - {kind}, frozenset({kind})))
    assert max(np.ptp(values) for values in exact.values()) < 1e-12
    assert min(np.ptp(values) for values in erring.values()) > 1e-3


def test_the_two_crossings_of_a_bisector_are_found_each_for_itself():
    off = bisected(hands())
    assert abs(np.corrcoef(off["one"], off["other"])[0, 1]) < WITHIN


def test_hands_that_err_in_some_acts_make_the_same_errors_there_as_hands_that_err_in_all():
    """So that what they are off by adds up."""

    def feet(only: frozenset[Kind] | None) -> np.ndarray:
        hand = hands(only)
        line = hand.erect("line", hand.given("foot", 0j), RIGHT)
        return hand.project("feet", hand.lay_off("end", line, RIGHT, 5.0), hand.given("axis", 0j, RIGHT + UP)).points

    exact = (RIGHT + UP) * 2.5
    alone = sum(feet(frozenset({kind})) - exact for kind in (Kind.ERECT, Kind.LAY_OFF, Kind.PROJECT))
    assert_allclose(feet(None) - exact, alone, atol=1e-12)


PASSES_ON = set(Kind) - set(SLIPS)
"""Acts that have no error of their own."""


def test_what_passes_errors_on_adds_none():
    assert {Kind.GIVEN, Kind.JOIN, Kind.CROSS, Kind.FAIR, Kind.TAKE, Kind.ENLARGE} == PASSES_ON
    hand = hands()
    a, b = hand.given("a", 0j), hand.given("b", np.array([0j, 4 + 1j, 8 + 0j]))
    line = hand.join("line", a, hand.take("end", b, which=1))
    level = hand.given("level", 1j, along=RIGHT)
    left = [
        line,
        hand.cross("crossing", line, level),
        hand.fair("curve", b, [slice(0, 3)]),
        hand.enlarged("large", b, a, 2j),
        hand.mirrored("image", b, level),
    ]
    for drawn in left:
        assert_array_equal(np.ptp(drawn.points, axis=0), 0)


def test_a_hand_of_one_number_errs_by_it_at_the_edge_of_the_protractor():
    hand = Pencil.of(0.2, samples=7, seed=3)
    assert hand == Pencil(line=0.2, dividers=0.2, protractor=0.2 / PROTRACTOR_RADIUS, samples=7, seed=3)
    assert 0.2 < math.degrees(hand.protractor) < 0.25
    assert Pencil.of(0.0).perfect


def test_a_hand_without_an_act_in_which_it_errs_is_perfect():
    assert Pencil(line=0.2, only=frozenset({Kind.READ, Kind.LAY_OFF})).perfect
    assert not Pencil(line=0.2, only=frozenset({Kind.ERECT})).perfect
