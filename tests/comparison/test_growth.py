"""What it takes to draw, compare and cover grows with the number of phases, not with its square."""

from __future__ import annotations

import gc
import sys
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from types import FrameType
from typing import Any

import numpy as np
import pytest
from over_all import fast_first

from graphcam.comparison.quantities import Comparison
from graphcam.constructions.working_profile import _covered
from graphcam.drafting.pencil import Pencil
from graphcam.solving.solve import solve
from graphcam.tasks.motion_tables import MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import (
    CamTable,
    FlatFacedTable,
    LimitsTable,
    OscillatingTable,
    TranslatingTable,
)
from graphcam.tasks.task_file import builtin_task

PHASES = (20, 60, 180)
FOLLOWERS = {
    "translating": (TranslatingTable(0.0, 2.0), LimitsTable(40.0, 40.0)),
    "arm": (OscillatingTable(arm=100.0, distance=120.0, roller_radius=2.0), LimitsTable(40.0, 40.0)),
    "flat": (FlatFacedTable(), LimitsTable(min_curvature_radius=5.0)),
}
each_follower = pytest.mark.parametrize("follower", fast_first(FOLLOWERS))


def comparison_of(follower: str, phases: int) -> Comparison:
    """A cam that rises and returns over and over; what is drawn of it lies no longer on the board."""
    kind, limits = FOLLOWERS[follower]
    angle, lift = 360 / phases, 20 / phases
    both = RiseTable(angle, lift, "3-4-5"), ReturnTable(angle, lift, "cycloidal")
    cam = CamTable(60.0 if follower != "flat" else 20000.0)
    task = replace(
        builtin_task(), motion=MotionTable(both * (phases // 2)), follower=kind, limits=limits, cam=cam,
    )  # fmt: skip
    solution = solve(task)
    return Comparison(solution.chain.by(Pencil(seed=1)), solution.cam)


def calls(job: Callable[[], Any]) -> int:
    """How many functions are called, those of numpy included: each is a pass over arrays, or one step of a loop.

    The garbage collector rests meanwhile: whenever it runs it calls whoever listens to it, such as hypothesis.
    """
    count = 0

    def called(_frame: FrameType, event: str, _arg: Any) -> None:
        nonlocal count
        count += event in {"call", "c_call"}

    before = sys.getprofile()
    gc.disable()
    sys.setprofile(called)
    try:
        job()
    finally:
        sys.setprofile(before)
        gc.enable()
    return count


def peak(job: Callable[[], Any]) -> int:
    """The greatest memory that is held at once [bytes]."""
    tracemalloc.start()
    try:
        job()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def slopes(of: Callable[[int], float]) -> list[float]:
    """By how much a cost grows with every further phase, between few phases and between many."""
    return (np.diff([of(phases) for phases in PHASES]) / np.diff(PHASES)).tolist()


@each_follower
def test_calls_and_memory_of_a_comparison_grow_in_proportion_to_the_phases(follower):
    """With every phase as at first, and by few calls: nothing but scales, stations and chords goes phase by phase."""

    def calls_of(phases: int) -> int:
        comparison = comparison_of(follower, phases)
        return calls(lambda: comparison.quantities)

    def memory_of(phases: int) -> int:
        comparison = comparison_of(follower, phases)
        return peak(lambda: comparison.quantities)

    assert comparison_of(follower, 2).quantities  # the first one imports what it needs
    few, many = slopes(calls_of)
    assert many == pytest.approx(few, rel=0.1)
    assert many < 800  # half of them step the three points along the curve of a phase
    few, many = slopes(memory_of)
    assert many == pytest.approx(few, rel=0.1)


@each_follower
def test_a_least_radius_is_drawn_in_as_many_passes_whatever_the_number_of_phases(follower):
    """What is left goes by the piece: its slice, and the rest after it."""

    def calls_of(phases: int) -> int:
        chain = comparison_of(follower, phases).drawn
        assert chain["integration"]
        return calls(lambda: chain["minimum_radius"])

    few, many = slopes(calls_of)
    # One call more or less in all of the phases that are added.
    assert many == pytest.approx(few, abs=0.1)
    assert many < 20


class Counted(np.ndarray[Any, Any]):
    """An array that counts the numbers that are computed from it, and from what comes of it."""

    numbers = 0

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """The plain ufunc; what comes out is counted."""
        plain = [each.view(np.ndarray) if isinstance(each, Counted) else each for each in inputs]
        options.pop("out", None)
        found = np.asarray(getattr(ufunc, method)(*plain, **options))
        Counted.numbers += max(found.size, *map(np.size, plain))
        return found.view(Counted)


def ring(count: int) -> np.ndarray[Any, Any]:
    """Points of a curve that bends too sharply for a roller of 30 at its two ends."""
    turn = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return 100 * np.cos(turn) + 40j * np.sin(turn)


def inner(pitch: np.ndarray[Any, Any], radius: float) -> np.ndarray[Any, Any]:
    """The contact points of circles about a ring."""
    along = np.roll(pitch, -1) - np.roll(pitch, 1)
    return pitch + 1j * along / np.abs(along) * radius


def test_covered_touch_points_are_found_among_few_and_are_the_same():
    numbers = []
    for count in (500, 2000, 8000):
        pitch = ring(count)
        touch = inner(pitch, 30.0)
        Counted.numbers = 0
        covered = _covered(touch.view(Counted), pitch.view(Counted), 29.999)
        numbers.append(Counted.numbers)
        if count < 8000:
            distance = np.abs(touch[:, None] - pitch)
            np.fill_diagonal(distance, np.inf)
            assert covered.tolist() == (distance < 29.999).any(axis=1).tolist()
        assert 0 < covered.sum() < count
    orders = np.diff(np.log(numbers)) / np.log(4)
    assert np.all(orders < 1.65), orders


def test_many_hands_and_a_missing_centre_cover_as_each_alone():
    random = np.random.default_rng(1)
    pitch = ring(60) + random.normal(0, 0.3, (5, 60))
    touch = inner(ring(60), 30.0) + random.normal(0, 0.3, (5, 60))
    pitch[2, 7] = np.nan
    together = _covered(touch, pitch, 29.5)
    for mine, centres, points in zip(together, pitch, touch, strict=True):
        distance = np.abs(points[:, None] - centres)
        np.fill_diagonal(distance, np.inf)
        assert mine.tolist() == (distance < 29.5).any(axis=1).tolist()
        assert mine.any()
