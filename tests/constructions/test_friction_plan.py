"""The force plan with friction at the cam: closing triangles, second order, the pencil's share, and what is drawn."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
import pytest
from boards import SIZES, coursework, order
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.constructions.force_plan import BASE, force_plan
from graphcam.constructions.friction_plan import friction_plan
from graphcam.drafting.acts import Act
from graphcam.drafting.marks import Arrow, Label, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale

LOAD = gc.SpringLoad(mass=0.5, speed_rpm=120, stiffness=2, preload=150, load=12.0)
MU = 0.15
BOTH = over_all("rotation", ["cw", "ccw"])


def measured(law: str = "cycloidal", n: int = 12, pencil: Pencil | None = None, **changes):
    chain = Chain(coursework(law, divisions=n, **changes), pencil or Pencil(), decided=SIZES)
    return chain["pressure_angle"]


def exact(law: str, rotation: str = "cw") -> gc.CamForces:
    cam = gc.Cam(coursework(law).motion, gc.Translating(SIZES.place, SIZES.roller_radius), SIZES.prime_radius, rotation)
    return gc.CamForces(cam, LOAD, friction=MU)


def value(plan: gc.Construction, name: str) -> float:
    return float(plan.readings[name].value)


@BOTH
def test_load_contact_force_and_reaction_are_in_equilibrium(rotation):
    """At every station, of rise and return: N (cos alpha - mu sin alpha) is the load, and T is mu N."""
    angles = measured(rotation=rotation)
    for k in range(1, angles.givens.integrated.givens.stations.u.size - 1):
        plan = friction_plan(angles, LOAD, Pencil(), MU, station=k)
        alpha = float(angles.readings["alpha"].paper[k])
        names = ("load", "normal", "contact", "contact_friction", "along", "side", "reaction")
        load, normal, contact, friction, along, side, reaction = (value(plan, name) for name in names)
        assert normal * (math.cos(alpha) - MU * math.sin(alpha)) == pytest.approx(load, rel=1e-12)
        assert friction == pytest.approx(MU * normal, rel=1e-12)
        assert contact == pytest.approx(math.hypot(normal, friction), rel=1e-12)
        assert (along, side) == pytest.approx((normal * math.cos(alpha), normal * abs(math.sin(alpha))), rel=1e-11)
        assert reaction == pytest.approx(normal * abs(math.sin(alpha) + MU * math.cos(alpha)), rel=1e-10)


@over_all(("name", "of_exact"), [("normal", "normal"), ("contact_friction", "contact_friction")])
@over_all(("law", "quarter"), [("cycloidal", 1), ("3-4-5", 2), ("3-4-5", 3)])
def test_the_drawn_forces_converge_to_the_exact_ones_with_second_order(law, quarter, name, of_exact):
    there = float(getattr(exact(law).at(0, quarter / 4), of_exact))
    parts = np.array([12, 24, 48, 96])
    plans = [friction_plan(measured(law, n), LOAD, Pencil(), MU, station=quarter * n // 4) for n in parts]
    errors = [abs(value(plan, name) - there) for plan in plans]
    assert order(parts, errors) == pytest.approx(2.0, abs=0.15)


def test_the_scatter_is_what_the_pencil_explains():
    """Linear propagation in N: Q, and the lengths that set off the friction, err by the dividers, the normal by the
    protractor."""
    angles, k = measured(), 5
    perfect = friction_plan(angles, LOAD, Pencil(), MU, station=k)
    alpha, load = float(angles.readings["alpha"].paper[k]), float(perfect.readings["load"].paper)
    d = math.cos(alpha) - MU * math.sin(alpha)
    # N = Q/D; a friction that is off by dm changes it by N sin(alpha)/D dm, and dm is a setting over the base.
    slope = load * math.sin(alpha) / d**2 * math.hypot(1, MU) / BASE
    turn = load * (math.sin(alpha) + MU * math.cos(alpha)) / d**2
    for pencil, sigma in (
        (Pencil(dividers=0.2, samples=4000), 0.2 * math.hypot(1 / d, slope)),
        (Pencil(protractor=0.01, samples=4000), 0.01 * turn),
    ):
        drawn = friction_plan(angles, LOAD, pencil, MU, station=k).readings["normal"].paper
        assert drawn.shape == (4000,)
        assert drawn.std() == pytest.approx(sigma, rel=0.05)
        assert drawn.mean() == pytest.approx(float(perfect.readings["normal"].paper), abs=5 * sigma / math.sqrt(4000))


def test_a_trembling_hand_keeps_near_its_bound():
    """Lines beside their places, settings and angles that are off leave every force within half a millimetre."""
    pencil = Pencil(line=0.1, dividers=0.1, protractor=0.003, samples=500, seed=3)
    drawn = friction_plan(measured(), LOAD, pencil, MU, station=5).readings
    perfect = friction_plan(measured(), LOAD, Pencil(), MU, station=5).readings
    for name in ("load", "contact", "normal", "contact_friction", "along", "side", "reaction"):
        off = drawn[name].paper - float(perfect[name].paper)
        assert 0 < off.std() < 0.5
        assert abs(off.mean()) < 0.1


def test_the_formulas_come_to_what_is_drawn():
    angles = measured()
    for plan in (force_plan(angles, LOAD, Pencil()), friction_plan(angles, LOAD, Pencil(), MU)):
        (formula,) = plan.meaning.formulas
        (told,) = formula.values(plan)
        drawn = told.keys() & plan.readings.keys()
        assert len(drawn) == 3
        for name in drawn:
            assert told[name] == pytest.approx(value(plan, name), rel=1e-9)


def test_as_the_friction_vanishes_the_plan_becomes_that_without():
    angles = measured()
    smooth, rubbing = force_plan(angles, LOAD, Pencil()), friction_plan(angles, LOAD, Pencil(), 1e-12)
    for name in ("load", "normal", "along", "side", "reaction"):
        assert value(rubbing, name) == pytest.approx(value(smooth, name), rel=1e-10)


@BOTH
def test_the_arrows_close_and_every_number_is_a_length_times_the_scale(rotation):
    for k in (4, 20):
        plan = friction_plan(measured(rotation=rotation), LOAD, Pencil(), MU, station=k, mu_force=Scale(5.0, "N"))
        steps = plan.steps()
        assert [str(step.title) for step in steps[1:]] == [
            "The contact normal", "The line of the contact force", "The line of the guide's reaction",
            "The triangle of forces",
        ]  # fmt: skip
        force, reaction, normal, friction = (mark for mark in steps[-1].marks if isinstance(mark, Arrow))
        assert force.end == reaction.start == friction.end
        assert (reaction.end, force.start, normal.end) == (0, normal.start, friction.start)
        # Square to one another; the friction points in the cam's sense from the normal.
        turn = cmath.phase((friction.end - friction.start) / (normal.end - normal.start))
        assert turn == pytest.approx(math.pi / 2 if rotation == "ccw" else -math.pi / 2)
        letters = {str(mark.text): mark.at for mark in steps[-1].marks if isinstance(mark, Label)}
        arrows = {"F": force, "R": reaction, "N": normal, "T": friction}
        assert letters == pytest.approx({name: (each.start + each.end) / 2 for name, each in arrows.items()})
        said = str(steps[-1].caption)
        told = [[float(each) for each in row] for row in re.findall(r"([\d.]+) mm × ([\d.]+) = ([\d.]+) N", said)]
        names = ("contact", "reaction", "normal", "contact_friction", "along", "side")
        assert_allclose([row[0] for row in told], [float(plan.readings[name].paper) for name in names], atol=0.051)
        assert_allclose([row[2] for row in told], [value(plan, name) for name in names], atol=0.051)
        assert f"30 · {MU} = 4.50 mm square to the normal, to the {'left' if rotation == 'ccw' else 'right'}" in str(
            steps[2].caption
        )
        for step in steps:
            assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(step.why))
            left = {(part.act, at) for each in step.parts for part in each.draws for at in part.index.tolist()}
            for mark in step.own_marks:
                if getattr(mark, "role", None) is not Role.AXIS:
                    assert isinstance(mark.of, Act), str(step.title)
                    index = [0] if mark.index is None else mark.index.tolist()
                    assert {(mark.of, at) for at in index} <= left, (str(step.title), mark)


def test_a_follower_that_jams_has_no_triangle():
    """The line of the contact force leans so far that it meets the reaction below the head of the load."""
    plan = friction_plan(measured(), LOAD, Pencil(), 5.0, station=6)
    assert math.isnan(value(plan, "normal"))
    assert "jams" in str(plan.steps()[-1].caption)
    assert plan.steps()[-1].marks == ()


def test_a_trembling_chain_carries_its_samples_into_the_plan():
    hands = Pencil(line=0.2, dividers=0.2, division=0.5, samples=20)
    plan = friction_plan(measured(pencil=hands), LOAD, hands, MU)
    assert plan.readings["normal"].value.shape == (20,)
    assert len(plan.steps()) == 5
