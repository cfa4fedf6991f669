"""The drawn force plan against the exact forces: closing triangles, second order, and the pencil's share."""

from __future__ import annotations

import math

import numpy as np
import pytest
from boards import SIZES, coursework, order
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.constructions.force_plan import BASE, force_plan, round_scale
from graphcam.drafting.euclid import READABLE_CROSSING
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale

LOAD = gc.SpringLoad(mass=0.5, speed_rpm=120, stiffness=2, preload=150)
GUIDE = gc.Guide(friction=0.12, overhang=60, length=90)


def measured(law: str = "cycloidal", n: int = 12, pencil: Pencil | None = None, **changes):
    chain = Chain(coursework(law, divisions=n, **changes), pencil or Pencil(), decided=SIZES)
    return chain["pressure_angle"]


def exact(law: str, rotation: str = "cw") -> gc.CamForces:
    cam = gc.Cam(coursework(law).motion, gc.Translating(SIZES.place, SIZES.roller_radius), SIZES.prime_radius, rotation)
    return gc.CamForces(cam, LOAD, GUIDE)


def value(plan: gc.Construction, name: str) -> float:
    return float(plan.readings[name].value)


@over_all("guide", [None, GUIDE])
@over_all("rotation", ["cw", "ccw"])
def test_load_contact_force_and_reaction_are_in_equilibrium(rotation, guide):
    """The triangle closes: the parts along and across the motion balance, and the friction acts against the motion."""
    angles = measured(rotation=rotation)
    stations = angles.givens.integrated.givens.stations
    for k in range(1, stations.u.size - 1):
        plan = force_plan(angles, LOAD, Pencil(), guide, station=k)
        alpha = abs(float(angles.readings["alpha"].paper[k]))
        rising = 1 if stations.phase[k] == 0 else -1
        normal, side, friction = (value(plan, name) for name in ("normal", "side", "friction"))
        assert side == pytest.approx(normal * math.sin(alpha), rel=1e-12)
        assert value(plan, "along") == pytest.approx(normal * math.cos(alpha), rel=1e-12)
        assert value(plan, "along") == pytest.approx(value(plan, "load") + rising * friction, rel=1e-12)
        if guide:
            s = float(angles.givens.integrated.readings["s"].value[k])
            assert friction == pytest.approx(side * 0.12 * (1 + 2 * (60 - s) / 90), rel=1e-12)


@over_all("name", ["normal", "side", "friction"])
@over_all(("law", "quarter"), [("cycloidal", 1), ("cycloidal", 3), ("3-4-5", 2), ("3-4-5", 3)])
def test_the_drawn_forces_converge_to_the_exact_ones_with_second_order(law, name, quarter):
    there = getattr(exact(law).at(0, quarter / 4), name)
    parts = np.array([12, 24, 48, 96])
    errors = []
    for n in parts:
        plan = force_plan(measured(law, n), LOAD, Pencil(), GUIDE, station=quarter * n // 4)
        errors.append(abs(value(plan, name) - abs(float(there))))
    assert order(parts, errors) == pytest.approx(2.0, abs=0.15)


def test_the_scatter_is_what_the_pencil_explains():
    """Linear propagation: a length of Q, and the two that make the slope of R, err by the dividers; the direction of F
    by the protractor; its line beside the head of Q is cut at the angle that it makes with R."""
    angles, k = measured(), 5
    perfect = force_plan(angles, LOAD, Pencil(), GUIDE, station=k)
    mu, alpha = perfect.givens.mu_force, float(angles.readings["alpha"].paper[k])
    s = float(angles.givens.integrated.readings["s"].value[k])
    share = 0.12 * (1 + 2 * (60 - s) / 90)
    denominator = math.cos(alpha) - share * math.sin(alpha)
    load = value(perfect, "load") / mu.per_mm
    slope = load * math.sin(alpha) / denominator**2 * math.hypot(1, share) / BASE
    for pencil, sigma in (
        (Pencil(dividers=0.2, samples=4000), 0.2 * math.hypot(1 / denominator, slope)),
        (
            Pencil(protractor=0.01, samples=4000),
            load * 0.01 * (math.sin(alpha) + share * math.cos(alpha)) / denominator**2,
        ),
        (Pencil(line=0.2, samples=4000), 0.2 * (math.sin(alpha) + share * math.cos(alpha)) / denominator),
    ):
        drawn = force_plan(angles, LOAD, pencil, GUIDE, station=k).readings["normal"].paper
        assert drawn.shape == (4000,)
        assert drawn.std() == pytest.approx(sigma, rel=0.05)
        assert drawn.mean() == pytest.approx(float(perfect.readings["normal"].paper), abs=4 * sigma / math.sqrt(4000))


def test_a_trembling_chain_carries_its_samples_into_the_plan():
    hands = Pencil(line=0.2, dividers=0.2, division=0.5, samples=20)
    plan = force_plan(measured(pencil=hands), LOAD, hands, GUIDE)
    assert plan.readings["normal"].value.shape == (20,)
    assert plan.readings["normal"].value.std() > 0
    assert len(plan.steps()) == 4


def test_a_jamming_follower_has_no_triangle():
    tight = gc.Guide(friction=1.2, overhang=60, length=20)
    plan = force_plan(measured(), LOAD, Pencil(), tight)
    assert math.isnan(value(plan, "normal"))
    assert "jams" in str(plan.steps()[-1].caption)
    # Just below the jamming angle the lines still cross, at less than a degree: no hand could read it.
    angles = measured()
    alpha = float(angles.readings["alpha"].paper[5])
    s = float(angles.givens.integrated.readings["s"].value[5])
    almost = gc.Guide(1 / math.tan(alpha + READABLE_CROSSING / 2) / (1 + 2 * (60 - s) / 90), 60, 90)
    assert math.isnan(value(force_plan(angles, LOAD, Pencil(), almost, station=5), "normal"))


def test_no_triangle_where_nothing_presses():
    plan = force_plan(measured(), gc.SpringLoad(0.0, 0.0, 0.0, preload=-10), Pencil())
    assert math.isnan(value(plan, "normal"))


def test_the_steps_say_in_sentences_what_was_read():
    plan = force_plan(measured(), LOAD, Pencil(), GUIDE)
    captions = [str(step.caption) for step in plan.steps()]
    assert len(captions) == 4
    assert all(text[0].isupper() and text.endswith(".") for text in captions)
    assert f"{value(plan, 'normal'):.1f} N" in captions[-1]
    assert {step.view.name for step in plan.steps()} == {"forces"}


def test_the_scale_of_forces_is_round_and_can_be_chosen():
    for load in (0.3, 99.0, 160.0, 2500.0, 2501.0):
        scale = round_scale(load)
        assert 20 < load / scale.per_mm <= 50
    plan = force_plan(measured(), LOAD, Pencil(), mu_force=Scale(4.0, "N"))
    assert value(plan, "load") == pytest.approx(4 * float(plan.readings["load"].paper))
