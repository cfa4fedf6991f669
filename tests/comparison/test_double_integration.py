"""The proved bound of the double integration holds against 50 digits, and tends to the error itself."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
import reference
from mpmath import diff, mpf
from random_tasks import random_arm_task, random_flat_task, random_task

import graphcam as gc
from graphcam.comparison.double_integration import chord_errors, known_derivatives, proved_bounds
from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import DECLARED_LAWS, LAWS, Floats, law as law_of
from graphcam.given.stations import divide
from graphcam.report.markdown import blocks
from graphcam.report.note import against_exact
from graphcam.solving.solve import AnySolution, solve
from graphcam.tasks.task_file import builtin_task

ROUNDING = 2e-14
"""Of the bound, which is computed in double precision."""
PARTS = (3, 4, 7, 12, 31, 96)
SMOOTH = tuple(name for name in LAWS if name != "rectangular")


def told_against_exact(solution: AnySolution) -> str:
    """What the note tells of the drawn values beside the exact ones."""
    return blocks(*against_exact(solution))


def acceleration(name: str, u: mpf, ratio: float = 1.0) -> mpf:
    if name == "rectangular":  # its two halves, of which a difference would mix both
        return 2 * (1 + mpf(ratio)) if u < 1 / (1 + mpf(ratio)) else -2 * (1 + 1 / mpf(ratio))
    return diff(lambda x: reference.lift(name, x, ratio), u, 2)


def velocity(name: str, u: mpf, ratio: float = 1.0) -> mpf:
    if u in {0, 1}:
        return mpf(0)
    return diff(lambda x: reference.lift(name, x, ratio), u, direction=-1)


@cache
def drawn(name: str, u: tuple[float, ...], ratio: float = 1.0) -> tuple[list[mpf], list[mpf]]:
    """The chords at 50 digits: heights of s and of v above the base line, before the end is read as the lift."""
    at = [mpf(x) for x in u]
    v, s = [mpf(0)], [mpf(0)]
    for a, b in pairwise(at):
        v.append(v[-1] + (b - a) * acceleration(name, (a + b) / 2, ratio))
    v = [height - v[-1] * x for height, x in zip(v, at, strict=True)]
    for k, (a, b) in enumerate(pairwise(at)):
        s.append(s[-1] + (b - a) * (v[k] + v[k + 1]) / 2)
    return s, v


def off(name: str, u: Floats, ratio: float = 1.0) -> tuple[Floats, Floats]:
    """How far the known part of the bound is from the error of s and v."""
    (s, v), found = drawn(name, tuple(u.tolist()), ratio), chord_errors(law_of(name, ratio), u)
    errors_s = [float(x - reference.lift(name, at, ratio)) for x, at in zip(s, u.tolist(), strict=True)]
    errors_v = [float(x - velocity(name, mpf(at), ratio)) for x, at in zip(v, u.tolist(), strict=True)]
    return np.abs(errors_s - found.s), np.abs(errors_v - found.v)


def holds(name: str, u: Floats, ratio: float = 1.0) -> bool:
    found, (s, v) = chord_errors(law_of(name, ratio), u), off(name, u, ratio)
    return bool(np.all(s <= found.s_rest + ROUNDING) and np.all(v <= found.v_rest + ROUNDING))


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("n", PARTS)
def test_the_theorem_holds_at_every_division_wherever_corners_fall(name, n):
    assert holds(name, np.linspace(0, 1, n + 1))


@pytest.mark.parametrize("name", ["triangular", "cycloidal", "modified-trapezoidal", "modified-sine"])
@pytest.mark.parametrize("ratio", [0.3, 2.0])
def test_the_theorem_holds_of_laws_with_unequal_parts(name, ratio):
    assert all(holds(name, np.linspace(0, 1, n + 1), ratio) for n in (5, 12))


@pytest.mark.parametrize("ratio", [1.0, 0.37, 2.3])
def test_a_jump_counts_for_nothing_on_a_division_and_holds_off_the_grid(ratio):
    motion = gc.Motion([gc.Rise(1, 3.0, "rectangular", ratio), gc.Return(1, 2 * np.pi - 3, "cosine")])
    law = law_of("rectangular", ratio)
    errors = []
    for n in (5, 12, 41):
        stations = divide(motion, n)
        on = stations.u[stations.phases[0]]
        assert holds("rectangular", on, ratio)
        assert max(each.max() for each in chord_errors(law, on).read()) < ROUNDING
        beside = np.linspace(0, 1, n + 1) if ratio != 1 else np.linspace(0, 1, 2 * n + 2)
        assert holds("rectangular", beside, ratio)
        errors.append(chord_errors(law, beside).read()[1].max())
    assert errors[0] > errors[2] > 1e-3  # of first order only


@pytest.mark.parametrize("name", SMOOTH)
def test_what_is_read_lies_within_the_bounds_and_they_tend_to_the_error(name):
    tightness = []
    for n in range(3, 97):
        u = np.linspace(0, 1, n + 1)
        law, middle = law_of(name), (u[1:] + u[:-1]) / 2
        v = np.append(0, np.cumsum(law(middle)[2]) / n)
        v = v - v[-1] * u
        s = np.append(0, np.cumsum(v[1:] + v[:-1]) / 2 / n)
        errors = [np.abs(x / s[-1] - exact) for x, exact in zip((s, v, law(u)[2]), law(u, 2), strict=True)]
        bounds = chord_errors(law, u).read()
        for error, bound in zip(errors, bounds, strict=True):
            assert np.all(error <= bound + 20 * ROUNDING)
        tightness.append([b.max() / e.max() for e, b in zip(errors, bounds, strict=True) if e.max() > 1e-12])
    # Without a jerk at the ends the errors are of a higher order than what is known of them.
    assert np.median(tightness[-1] or 1.0) < (1.3 if np.any(law_of(name)([0.0, 1.0])[3]) else 2.2)


@pytest.mark.parametrize("name", [name for name in SMOOTH if max(DECLARED_LAWS[name].fifth_derivatives[0]) > 0])
def test_a_tenth_of_the_fifth_derivative_does_not_hold(name, monkeypatch):
    assert holds(name, np.linspace(0, 1, 6))
    less = tuple(tuple(value / 10 for value in half) for half in DECLARED_LAWS[name].fifth_derivatives)
    monkeypatch.setitem(DECLARED_LAWS, name, replace(DECLARED_LAWS[name], fifth_derivatives=less))
    assert not all(holds(name, np.linspace(0, 1, n + 1)) for n in (3, 4, 5, 7, 12))


@pytest.mark.parametrize("name", LAWS)
def test_the_fifth_derivatives_are_the_greatest(name):
    edges = [0.0, *(e for e in law_of(name).edges if e < 0.5), 0.5]
    for (a, b), greatest in zip(pairwise(edges), DECLARED_LAWS[name].fifth_derivatives[0], strict=True):
        inside = [mpf(a) + mpf(b - a) * k / 40 for k in (1e-3, *range(1, 40), 40 - 1e-3)]
        values = [abs(float(diff(lambda x: reference.lift(name, x), x, 5, h=mpf("1e-7")))) for x in inside]
        assert max(values) <= greatest * (1 + 1e-6) + 1e-6
        assert max(values) >= 0.8 * greatest
    for edge, jump in zip(edges[1:-1], DECLARED_LAWS[name].fifth_derivatives[1], strict=True):
        sides = [diff(lambda x: reference.lift(name, x), mpf(edge) + s, 4, h=mpf("1e-9")) for s in (-1e-6, 1e-6)]
        assert abs(float(sides[1] - sides[0])) == pytest.approx(jump, rel=1e-3, abs=1e-6)


def test_the_greatest_v_and_a_of_random_tasks_lie_within_the_proved_bounds():
    found = 0
    for seed in range(8):
        for random in (random_task, random_arm_task, random_flat_task):
            try:
                quantities = solve(random(seed)).comparison.quantities
            except gc.DesignError:
                continue
            for q in (quantities["max_v"], quantities["max_a"]):
                assert abs(q.error_paper) <= q.proved_paper + 1e-9, (seed, q)
                found += 1
    assert found > 30


def test_where_no_theorem_tells_it_nothing_is_said():
    task, own = (
        builtin_task(),
        gc.Law("cosine", lambda u: (u * u * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, 0 * u - 12)),
    )
    assert known_derivatives(law_of("rectangular", 1.7))
    assert known_derivatives(own) is None
    shaky = solve(task, Pencil(line=0.2, dividers=0.2))
    assert shaky.comparison.proved == {}
    assert "proved" not in told_against_exact(shaky)
    assert "| proved bound, mm of paper |" in told_against_exact(solve(task))
    turned = gc.Motion([gc.Return(10, 3.0, "cosine"), gc.Rise(10, 2 * np.pi - 3, "cosine")])
    assert proved_bounds(turned, divide(turned, 12)) == {}
