"""The library as one thing: short signatures, one name for one thing, words that completion and pyright know."""

from __future__ import annotations

import inspect
import subprocess
import sys
from typing import get_args

import numpy as np
import pytest

import graphcam as gc
from graphcam.given.laws import KNOWN_LAWS, LawName
from graphcam.sweeps.sweep import AnyQuantity
from graphcam.sweeps.sweep_forces import FORCE_QUANTITIES, SOUGHT_FORCES
from graphcam.sweeps.sweep_quantities import BAND_QUANTITIES, QUANTITIES

LONGEST_PARAMETER = 100
"""Letters of a parameter in ``help()``, its kind and default included."""


def signatures():
    for name in gc.__all__:
        value = getattr(gc, name)
        if inspect.isclass(value) and issubclass(value, Exception):
            continue
        named = {name: value} | ({f"{name}.{m}": f for m, f in vars(value).items()} if inspect.isclass(value) else {})
        for called, function in named.items():
            if callable(function) and not called.partition(".")[2].startswith("_"):
                yield called, inspect.signature(function)


def test_signatures_are_short():
    long = {
        (called, parameter.name)
        for called, signature in signatures()
        for parameter in signature.parameters.values()
        if "numpy._typing" in str(parameter) or len(str(parameter)) > LONGEST_PARAMETER
    }
    # The default of "quantities" is all of them; a task's follower is of four kinds, its title is a caption.
    assert long <= {
        ("sweep", "quantities"),
        ("sizing_sheet", "title"),
        ("Task", "follower"),
        ("MinimumRadius", "active"),
    }


def test_literals_are_the_words_that_are_known():
    assert set(get_args(LawName)) == set(KNOWN_LAWS)
    assert set(FORCE_QUANTITIES) == set(SOUGHT_FORCES)
    quantities = {word for part in get_args(AnyQuantity) for word in get_args(part)} or set(get_args(AnyQuantity))
    assert quantities == {*QUANTITIES, *FORCE_QUANTITIES, *BAND_QUANTITIES}


def sample():
    motion = gc.Motion([gc.Rise(30, 2.0), gc.Dwell(1.0), gc.Return(30, 2.0), gc.Dwell(2 * np.pi - 5)])
    cam = gc.Cam(motion, gc.Translating(10, 12), prime_radius=50)
    forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100))
    return cam, forces, gc.ContactStress(forces, gc.RollerContact(10))


def test_results_have_names():
    cam, forces, _ = sample()
    values = cam.motion(1.0)
    assert (values.s, values.v, values.a, values.j) == tuple(values)
    steepest = cam.extremes().pressure_angle_rise
    assert (steepest.value, steepest.phi) == tuple(steepest)
    assert cam.curves(1.0).profile == pytest.approx(cam.profile(1.0))
    assert [span.kind for span in cam.motion.timing] == ["rise", "dwell", "return", "dwell"]
    assert forces.max_normal().value > forces.min_normal().value
    slack = gc.Contact(cam.motion, gc.SpringLoad(0.5, 900, 1, 1)).lost()
    assert slack[0].start < slack[0].end
    sharp = gc.Motion([gc.Rise(30, np.pi / 3), gc.Dwell(np.pi / 2), gc.Return(30, np.pi / 2), gc.Dwell(2 * np.pi / 3)])
    (lost,) = gc.Cam(sharp, gc.Translating(5, 20), 30).undercuts()
    assert (lost.crossing.x, lost.crossing.y) == lost.crossing[2:]


@pytest.mark.parametrize(
    ("ask", "kind", "now"),
    [
        (lambda *_: gc.least_preload, AttributeError, "spring_preload"),
        (lambda cam, *_: cam.plot(axes=None), TypeError, "ax"),
        (lambda cam, forces, stress: forces.greatest_normal, AttributeError, "max_normal"),
        (lambda cam, forces, stress: forces.least_torque, AttributeError, "min_torque"),
        (lambda cam, forces, stress: stress.greatest, AttributeError, "max_pressure"),
        (lambda cam, forces, stress: stress.least_width, AttributeError, "min_width"),
        (lambda *_: gc.RollerContact(10, young1=2e5), TypeError, "young_cam"),
        (lambda *_: gc.RollerContact(10).poisson2, AttributeError, "poisson_follower"),
        (lambda *_: gc.contact_by_elements(10, 10, 10, 10, young=2e5), TypeError, "young1"),
        (lambda *_: gc.size_cam(None, None, face_width=3), TypeError, "width"),
        (lambda *_: gc.shock_spectrum("cosine").greatest, AttributeError, "maximum"),
        (lambda cam, forces, stress: gc.Contact(cam.motion, forces.load).least_force, AttributeError, "min_force"),
    ],
)
def test_a_former_name_tells_the_present_one(ask, kind, now):
    with pytest.raises(kind, match=f"any more: write '{now}'$"):
        ask(*sample())


WRONG = """
import graphcam as gc
gc.Rise(30, 1.0, "cicloidal")
gc.law("3-4-5-6")
gc.Designs(30, 1.0, 1.0, 40, rise_law="cosin")
gc.sweep(gc.grid(lift=30, rise_angle=1.0, return_angle=1.0, prime_radius=[40, 50], follower="translation"))
gc.sweep(gc.Designs(30, 1.0, 1.0, 40), ["max_pressure"])
gc.write_profile(gc.solve(gc.builtin_task()).cam, "out", "igs")
"""
RIGHT = """
import graphcam as gc
motion = gc.Motion([gc.Rise(30, 2.0, "cycloidal"), gc.Dwell(1.0), gc.Return(30, 2.0, gc.law("cosine")), gc.Dwell(1.28)])
found = gc.sweep(gc.grid(lift=30, rise_angle=1.0, return_angle=1.0, prime_radius=[40, 50]), ["max_v", "max_torque"])
print(found.array, motion(1.0).s, gc.Cam(motion, gc.Translating(), 40).extremes().pressure_angle_rise.value)
"""


@pytest.mark.slow
def test_pyright_finds_misspelt_words_in_a_script(tmp_path):
    for name, text in (("wrong", WRONG), ("right", RIGHT)):
        (tmp_path / f"{name}.py").write_text(text)
    asked = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, "wrong.py", "right.py"]
    told = subprocess.run(asked, cwd=tmp_path, capture_output=True, text=True).stdout
    lines = {int(line.split(":")[1]) for line in told.splitlines() if " - error: " in line and "wrong.py:" in line}
    assert lines == {3, 4, 5, 6, 7, 8}, told
    assert not [line for line in told.splitlines() if "right.py:" in line], told
