"""The force plan of an arm: closing triangles parallel to the arm positions, second order, the pencil's share."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from boards import order
from over_all import over_all

import graphcam as gc
from graphcam.constructions.arm_force_plan import FORMULAS, arm_force_plan
from graphcam.drafting.acts import Act
from graphcam.drafting.marks import Arrow, Label, Line, Role
from graphcam.drafting.pencil import Pencil
from graphcam.given.spring_load import PlacedArmLoad
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import CamTable, DrawingTable, OscillatingTable, Task

TORSION = gc.ArmLoad(inertia=900, speed_rpm=150, stiffness=4000, preload=3000, load=8.0, damping=20.0)
AT_A_POINT = gc.ArmLoad(900, 150, stiffness=6, preload=150, acceleration=40, at=gc.ArmSpring(70.0, (130.0, -40.0)))
LOADS = over_all("load", [TORSION, AT_A_POINT])
BOTH = over_all("rotation", ["cw", "ccw"])
NAMES = "load", "normal", "along", "side", "reaction"


@lru_cache(maxsize=2)
def solved(rotation: str = "ccw", n: int = 12, law: str = "3-4-5", pencil: Pencil | None = None) -> gc.Solution:
    phases = RiseTable(75, 15, law), DwellTable(60), ReturnTable(90, 15, "cycloidal"), DwellTable(135)
    follower = OscillatingTable(125.0, 150.0, 12.0)
    task = Task(rotation, MotionTable(phases), follower, cam=CamTable(61.0), drawing=DrawingTable(divisions=n))
    return gc.solve(task, pencil)


def plan_of(load: gc.ArmLoad, k: int | None = None, pencil: Pencil | None = None, **board):
    return arm_force_plan(solved(**board).chain["pressure_angle"], load, pencil or Pencil(), station=k)


def value(plan: gc.Construction, name: str) -> float:
    return float(plan.readings[name].value)


@LOADS
@BOTH
def test_load_contact_force_and_reaction_are_in_equilibrium(rotation, load):
    """At every station, of rise and return: l F cos(alpha) is the torque of the drawn s, v, a."""
    chain = solved(rotation).chain
    angles, integrated = chain["pressure_angle"], chain["integration"]
    placed = PlacedArmLoad(load, 125.0, 150.0, float(angles.readings["psi0"].value))
    for k in range(1, chain.board.stations.u.size - 1):
        plan = plan_of(load, k, rotation=rotation)
        alpha = float(angles.readings["alpha"].paper[k])
        s, v, a = (np.array(float(integrated.readings[name].value[k])) for name in ("s", "v", "a"))
        torque = float(placed.force((s, v, a, np.zeros(()))))
        found, normal, along, side, reaction = (value(plan, name) for name in NAMES)
        assert 125 * found == pytest.approx(torque, rel=1e-12)
        assert normal * math.cos(alpha) == pytest.approx(found, rel=1e-12) == along
        assert side == pytest.approx(normal * abs(math.sin(alpha)), rel=1e-9) == pytest.approx(reaction, rel=1e-9)


@LOADS
@over_all("name", ["load", "normal", "side"])
def test_the_drawn_forces_converge_to_the_exact_ones_with_second_order(name, load):
    parts = np.array([12, 24, 48, 96])
    for law, quarter in (("cycloidal", 1), ("3-4-5", 3)):
        exact = gc.CamForces(solved().cam, load) if law == "3-4-5" else gc.CamForces(solved(law=law).cam, load)
        at = exact.at(0, quarter / 4)
        there = {"load": float(at.load) / 125, "normal": float(at.normal), "side": abs(float(at.side))}[name]
        plans = [plan_of(load, quarter * int(n) // 4, n=int(n), law=law) for n in parts]
        assert order(parts, [abs(value(plan, name) - there) for plan in plans]) == pytest.approx(2.0, abs=0.2)


def test_the_scatter_is_what_the_pencil_explains():
    """Linear propagation: the length of Q by the dividers; every line by its offset, across itself."""
    perfect = plan_of(TORSION, 6)
    alpha = float(solved().chain["pressure_angle"].readings["alpha"].paper[6])
    sigma = 0.2 / math.cos(alpha)
    drawn = plan_of(TORSION, 6, Pencil(dividers=0.2, samples=4000)).readings["normal"].paper
    assert drawn.std() == pytest.approx(sigma, rel=0.05)
    assert drawn.mean() == pytest.approx(float(perfect.readings["normal"].paper), abs=5 * sigma / math.sqrt(4000))
    hand = Pencil(line=0.1, dividers=0.1, protractor=0.003, samples=500, seed=3)
    for name in NAMES:
        off = plan_of(TORSION, 6, hand).readings[name].paper - float(perfect.readings[name].paper)
        assert 0 < off.std() < 0.5
        assert abs(off.mean()) < 0.1


@BOTH
def test_the_lines_are_parallel_to_those_of_the_arm_positions(rotation):
    """R along the arm, Q square to it, F along A D: by the places that the exact side has."""
    cam = solved(rotation).cam
    for k in (4, 20):
        plan = plan_of(TORSION, k, rotation=rotation)
        stations = solved(rotation).chain.board.stations
        values = cam.motion.at(int(stations.phase[k]), float(stations.u[k]))
        arm = complex(cam.kinematics.point(values)) - 150
        # In the arm positions the arm at rest lies level: the frame is turned by psi0 there.
        turn = cmath.exp(1j * cam.kinematics.psi0)
        load, *_, last = plan.steps()
        (q,) = (mark for mark in load.marks if isinstance(mark, Arrow))
        force, reaction = (mark for mark in last.marks if isinstance(mark, Arrow))
        assert (q.end, force.end, reaction.end) == (force.start, reaction.start, 0)
        assert abs(((q.end - q.start) / (arm * turn)).real) < 1e-3
        assert abs(((reaction.end - reaction.start) / (arm * turn)).imag) < 1e-3 * abs(reaction.start)
        normal = complex(cam.kinematics.normal(values))
        assert cmath.phase((force.end - force.start) / (normal * turn)) == pytest.approx(0, abs=0.01)


@BOTH
@LOADS
def test_the_steps_say_in_sentences_what_was_read(rotation, load):
    for k in (4, 20):
        plan = plan_of(load, k, rotation=rotation)
        steps = plan.steps()
        assert len(steps) == 4
        said = str(steps[-1].caption)
        told = [[float(each) for each in row] for row in re.findall(r"([\d.]+) mm × ([\d.]+) = ([\d.]+) N", said)]
        read = [plan.readings[name] for name in ("normal", "reaction", "along", "side")]
        assert [row[0] for row in told] == pytest.approx([float(each.paper) for each in read], abs=0.051)
        assert [row[2] for row in told] == pytest.approx([float(each.value) for each in read], abs=0.051)
        first = str(steps[0].caption)
        assert f"{value(plan, 'load'):.1f} N. At μ_F" in first
        named = "(?:inertia|preload|spring|damping|load P)"
        terms = re.findall(rf"{named} (?:[^,:=]+ = )?(?:([^,:=]+) = )?(-?\d+) N·mm", first)
        assert sum(float(torque) for _, torque in terms) == pytest.approx(125 * value(plan, "load"), abs=2.0)
        # A torque that is told with its factors is their product.
        told = {reckoned: float(torque) for reckoned, torque in terms if reckoned}
        assert len(told) == (2 if load is TORSION else 0)
        for reckoned, torque in told.items():
            factors = [float(each) for each in re.findall(r"[\d.]+", reckoned.replace("²", "").removesuffix("/1000"))]
            product = math.prod(factors) * (factors[1] / 1000 if reckoned.endswith("/1000") else 1.0)
            assert product == pytest.approx(torque, abs=0.51)
        for step in steps:
            assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(step.why))
            assert step.view.name == "forces"
            left = {(part.act, at) for each in step.parts for part in each.draws for at in part.index.tolist()}
            for mark in step.own_marks:
                if getattr(mark, "role", None) is not Role.AXIS:
                    assert isinstance(mark.of, Act), str(step.title)
                    index = [0] if mark.index is None else mark.index.tolist()
                    assert {(mark.of, at) for at in index} <= left, (str(step.title), mark)
        names = {str(mark.text): mark for mark in steps[-1].marks if isinstance(mark, Label)}
        corner = next(mark for mark in steps[-1].marks if isinstance(mark, Arrow)).end
        # F is named outside of the triangle: away from the tail of Q.
        assert (names["F"].towards * (names["F"].at - 0).conjugate()).real > 0
        assert (names["R"].towards * (corner / 2 - names["F"].at).conjugate()).real > 0


def test_no_triangle_where_the_load_does_not_press():
    plan = plan_of(replace(TORSION, preload=-9000.0), 6)
    assert math.isnan(value(plan, "normal"))
    assert "does not press" in str(plan.steps()[-1].caption)
    assert plan.steps()[-1].marks == ()
    assert "in the sense of the rise" in str(plan.steps()[0].caption)
    (formula,) = FORMULAS
    assert formula.values
    assert list(formula.values(plan)) == []
    (there,) = formula.values(plan_of(TORSION, 6))
    assert there["normal"] == pytest.approx(math.hypot(there["load"], there["reaction"]))
    assert all(isinstance(mark, Line) for step in plan.steps()[2:3] for mark in step.own_marks)


def test_a_trembling_chain_carries_its_samples_into_the_plan():
    hands = Pencil(line=0.2, dividers=0.2, division=0.5, samples=20)
    plan = arm_force_plan(solved(pencil=hands).chain["pressure_angle"], AT_A_POINT, hands)
    assert plan.readings["normal"].value.shape == (20,)
    assert plan.readings["normal"].value.std() > 0
    assert len(plan.steps()) == 4
