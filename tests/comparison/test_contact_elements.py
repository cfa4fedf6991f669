"""Hertz's line contact by finite elements, and the stresses below the surface by Johnson's formulas (section 4.2)."""

import math
import sys

import numpy as np
import pytest

from graphcam.comparison.contact_elements import ElementContact, ElementStresses, contact_by_elements
from graphcam.errors import DesignError, TaskError

SHAPES = {"convex": 30.0, "flat": math.inf, "concave": -40.0}
ROLLER = 15.0


def contact(shape: str = "convex", parts: int = 10, force: float = 1000.0) -> ElementContact:
    return contact_by_elements(force, 20, SHAPES[shape], ROLLER, parts=parts)


@pytest.mark.parametrize("shape", SHAPES)
def test_pressure_and_half_width_are_those_of_hertz(shape):
    found = contact(shape)
    assert found.peak_pressure == pytest.approx(found.hertz.peak_pressure, rel=0.002)
    assert found.half_width == pytest.approx(found.hertz.half_width, rel=0.002)
    # All over the strip it is half an ellipse, but for the element at the edge.
    a, p0 = found.hertz.half_width, found.hertz.peak_pressure
    inside = found.x < 0.9 * a
    assert found.pressure[inside] == pytest.approx(p0 * np.sqrt(1 - (found.x[inside] / a) ** 2), abs=0.01 * p0)
    assert (found.pressure[found.x > a * 1.1] == 0).all()


@pytest.mark.slow
def test_errors_fall_with_the_square_of_the_elements_size():
    parts = np.array([5, 10, 20])
    found = [contact(parts=int(count)) for count in parts]
    for name in ("peak_pressure", "half_width"):
        errors = [abs(getattr(each, name) / getattr(each.hertz, name) - 1) for each in found]
        order = -np.polyfit(np.log(parts), np.log(errors), 1)[0]
        assert order > 1.8, name


def test_the_pressure_bears_the_force():
    found = contact()
    steps = np.diff(found.x)
    half = found.pressure[0] * steps[0] / 2 + (found.pressure[1:-1] * (steps[:-1] + steps[1:]) / 2).sum()
    assert 2 * 20 * half == pytest.approx(1000, rel=1e-12)


def on_axis(body: ElementStresses) -> np.ndarray:
    """The elements beside the common normal, from the surface down to two half-widths, where the mesh is even."""
    beside = np.flatnonzero(body.x < 1.001 * body.x.min())
    return beside[np.argsort(body.depth[beside])]


@pytest.mark.slow
@pytest.mark.parametrize("which", [0, 1])
def test_stresses_on_the_axis_are_johnsons(which):
    found = contact(parts=20)
    body, a, p0 = found.bodies[which], found.hertz.half_width, found.hertz.peak_pressure
    line = on_axis(body)
    line = line[body.depth[line] < 2 * a]
    z = body.depth[line] / a
    root = np.sqrt(1 + z * z)
    assert body.along[line] / p0 == pytest.approx(-1 / root, abs=0.0015)
    assert body.across[line] / p0 == pytest.approx(-((1 + 2 * z * z) / root - 2 * z), abs=0.006)
    assert body.out[line] == pytest.approx(0.3 * (body.across[line] + body.along[line]))


@pytest.mark.parametrize(("name", "size", "depth"), [("max_shear", 0.3003, 0.786), ("von_mises", 0.5578, 0.704)])
def test_the_most_stressed_place_lies_below_the_surface(name, size, depth):
    found = contact(parts=20)
    for body in found.bodies:
        values, line = getattr(body, name), on_axis(body)
        most = line[values[line].argmax()]
        assert values[most] == values.max()
        assert values[most] / found.hertz.peak_pressure == pytest.approx(size, rel=0.006)
        # A maximum is flat: so near as one element.
        assert body.depth[most] / found.hertz.half_width == pytest.approx(depth, abs=0.05)


@pytest.mark.slow
def test_bodies_that_end_differ_from_half_spaces_the_more_the_wider_they_touch():
    """At twice the half-width twice as far."""
    off = []
    for force in (1000, 4000, 16000):
        found = contact(parts=20, force=force)
        body = found.bodies[0]
        off.append(body.max_shear.max() / found.hertz.peak_pressure - 0.30028)
    assert off == sorted(off)
    assert off[2] - off[1] == pytest.approx(2 * (off[1] - off[0]), rel=0.1)


@pytest.mark.parametrize(
    ("changes", "quantity"),
    [
        ({"force": 0.0}, "force"),
        ({"force": math.nan}, "force"),
        ({"force": math.inf}, "force"),
        ({"force": 1e8}, "force"),
        ({"width": 0.0}, "width"),
        ({"radius1": -10.0}, "pair of radii"),
        ({"radius2": 0.0}, "radius2"),
        ({"young1": -1.0}, "young1"),
        ({"poisson1": 0.5}, "poisson1"),
        ({"poisson1": math.nan}, "poisson1"),
        ({"parts": 3}, "parts"),
    ],
)
def test_what_cannot_be_is_refused(changes, quantity):
    given = {"force": 1000.0, "width": 20.0, "radius1": 30.0, "radius2": 15.0} | changes
    with pytest.raises(DesignError) as refused:
        contact_by_elements(**given)
    assert refused.value.quantity == quantity


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "skfem", None)
    with pytest.raises(TaskError, match=r'pip install "\.\[fem\]"'):
        contact()
