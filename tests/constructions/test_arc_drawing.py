"""Cams of three arcs on the drawing board: ruler and compass against the exact side, hands, hard cases, sentences."""

from __future__ import annotations

import cmath
import math
import re

import numpy as np
import pytest
from over_all import over_all
from test_construction_steps import HANDS, fields
from test_exact_side_unused import exact_side_forbidden
from three_arcs import EXAMPLE, given, sound_data

import graphcam as gc
from graphcam.constructions.arc_chain import ArcBoard, ArcChain
from graphcam.drafting.ink import Caption
from graphcam.drafting.marks import Arc, Dots
from graphcam.drafting.scale import GOST_2_302, Paper, Scale
from graphcam.given.three_arcs import ThreeArcs
from graphcam.mechanism.three_arc_cam import three_arc_cam

ROUNDING = 1e-11
"""Of lengths, as a part of the largest one."""
DEGREE_A_MM, PAPER = Scale(math.radians(1), "rad"), Paper(370.0, 370.0, GOST_2_302)
every_hand = over_all("pencil", HANDS)


def board_of(data: dict, roller: float = 10.0, dwell: float = 40.0, divisions: int = 4) -> ArcBoard:
    return ArcBoard(ThreeArcs(**data), math.radians(dwell), roller, divisions, DEGREE_A_MM, PAPER)


@over_all("roller", [0.0, 10.0, 60.0])
def test_the_drawing_s_scale_leaves_room_for_the_roller_all_about_the_cam(roller):
    """At the next larger standard scale cam and roller would not fit into their 370 mm."""
    board = board_of(CASES["case 2"], roller)
    reach = 2 * (math.hypot(*board.given.D) + 2 * roller)
    assert reach / board.mu_l.per_mm <= 370
    larger = min(ratio for ratio in GOST_2_302 if ratio > 1 / board.mu_l.per_mm)
    assert reach * larger > 370


CASES = {f"case {k}": given(EXAMPLE, *out) for k, out in enumerate([(), ("C2",), ("C1",), ("C1", "C2")], 1)}
MIRRORED = {k: v if k == "rho1" else (-v[0], v[1]) for k, v in EXAMPLE.items()}


USABLE = math.radians(60)
"""Of the pressure angle; a cam near 90 degrees has places that cannot be read."""


def usable() -> list[tuple[dict, gc.ArcMotion]]:
    found = []
    for data in sound_data(40, seed=21):
        cam = three_arc_cam(**given(data))[0]
        try:
            motion = cam.motion(4.0, 0.2)
        except gc.DesignError:
            continue
        if motion.max_pressure_angle()[0] < USABLE:
            found.append((given(data), motion))
    return found


@over_all("name", CASES)
def test_ruler_and_compass_find_both_roots_exactly(name):
    drawn = ArcChain(board_of(CASES[name]))["three_arcs"]
    cam, other = three_arc_cam(**CASES[name])
    for point in ("C1", "C2", "C3", "F"):
        for k, axis in enumerate("xy"):
            assert abs(float(drawn.value(f"{point}_{axis}")) - getattr(cam, point)[k]) < ROUNDING * 100
            if point in ("C3", "F"):
                assert abs(float(drawn.value(f"other_{point}_{axis}")) - getattr(other, point)[k]) < ROUNDING * 100
    assert float(drawn.value("rho3")) == pytest.approx(cam.rho3, rel=ROUNDING)
    assert float(drawn.value("base")) == pytest.approx(math.hypot(*cam.A), rel=ROUNDING)
    assert float(drawn.value("outer")) == pytest.approx(math.hypot(*cam.D), rel=ROUNDING)


def test_crank_and_rod_give_velocity_and_acceleration_without_an_error_of_method():
    """With three parts an arc as with any number: what is drawn is the exact value."""
    readable = 0
    for data, motion in usable():
        chain = ArcChain(board_of(data, roller=4.0, dwell=math.degrees(0.2), divisions=3))
        rolled, stations = chain["arc_roller"], chain.stations
        if np.isnan(rolled.value("lift")):  # bisector and line cross at less than a degree
            continue
        readable += 1
        phi, (s, v, a, _) = motion.at(stations.arc, stations.u)
        steep = 1 / math.cos(motion.max_pressure_angle()[0]) ** 5
        size = steep * (motion.prime_radius + motion.cam.rho2)
        for name, exact in (
            ("phi", phi),
            ("s", s),
            ("v", v),
            ("a", a),
            ("alpha", np.arctan2(v, motion.prime_radius + s)),
        ):
            assert np.abs(rolled.value(name) - exact).max() < ROUNDING * size, name
        off = rolled.value("x") + 1j * rolled.value("y") - motion.pitch_curve(phi) @ [1, 1j]
        assert np.abs(off).max() < ROUNDING * size
    assert readable > 10


def test_the_plan_is_a_crank_drive():
    """CN . CB = CK^2 (Euclid VI.8), MN is square to the rod, and K, M lie where velocity and acceleration are read."""
    rolled = ArcChain(board_of(EXAMPLE))["arc_roller"]
    b, c, k, n, m, ray = (rolled.first(name) for name in ("B", "C", "K", "N", "M", "ray"))
    assert np.abs(np.abs(n - c) * np.abs(b - c) - np.abs(k - c) ** 2).max() < 1e-9
    assert np.abs(((m - n) * np.conj(b - c)).real).max() < 1e-9
    assert np.abs((k * np.conj(ray)).real).max() < 1e-12
    assert np.abs((m * np.conj(ray)).imag).max() < 1e-9


def test_a_cam_turned_the_other_way_is_the_mirror_image():
    right, left = ArcChain(board_of(EXAMPLE)), ArcChain(board_of(MIRRORED))
    for name in ("s", "v", "a", "alpha", "phi", "y"):
        assert np.allclose(right["arc_roller"].value(name), left["arc_roller"].value(name), atol=1e-11)
    assert np.allclose(right["arc_roller"].value("x"), -left["arc_roller"].value("x"), atol=1e-11)


def test_the_greatest_pressure_angle_inside_an_arc_is_read_to_the_third_order():
    """The parabola through three points is off by the third derivative: n^3 |error| stays below 5e-4 rad."""
    exact, at = three_arc_cam(**EXAMPLE)[0].motion(10.0, math.radians(40)).max_pressure_angle()
    edges = three_arc_cam(**EXAMPLE)[0].motion(10.0).edges
    assert edges[1] < at < edges[2]
    for n in range(2, 33):
        drawn = float(ArcChain(board_of(EXAMPLE, divisions=n))["arc_diagrams"].value("max_alpha"))
        assert abs(drawn - exact) * n**3 < 5e-4


def test_a_flank_that_is_almost_straight_has_no_readable_centre():
    """The bisector crosses the line at less than a degree: NaN, and the step says so."""
    data = {"D": (40, 20), "G": (0, 30), "rho1": 5, "C1": (20, 24.9), "C2": (0, -50)}
    drawn = ArcChain(board_of(data))["three_arcs"]
    assert np.isnan(float(drawn.value("C3_x")))
    assert np.isnan(float(drawn.value("F_x")))
    assert np.isfinite(float(drawn.value("other_C3_x")))
    said = [str(step.caption) for step in drawn.steps()]
    assert sum("cannot be read" in caption for caption in said) == 1
    assert not any(re.search(r"\bnan\b", caption) for caption in said)


def test_a_second_arc_that_is_almost_straight_leaves_nothing_to_draw():
    flat = {"D": (51.68, 25), "G": (20.0, 39.9), "rho1": 14, "A": (0, 40)}
    assert three_arc_cam(**flat)[0].sound
    chain = ArcChain(board_of(flat))
    assert np.isnan(chain["three_arcs"].value("C2_y"))
    assert np.isnan(chain["arc_diagrams"].value("max_a"))
    captions = [str(step.caption) for construction in chain.values() for step in construction.steps()]
    assert any("C₂ cannot be read" in caption for caption in captions)
    assert any("centre that can be read (C₂ and C₃)" in caption for caption in captions)


@every_hand
@over_all("name", [*CASES, "mirrored", "knife edge", "no dwell"])
def test_every_step_says_what_is_drawn_and_draws_it(name, pencil):
    data = CASES.get(name, MIRRORED if name == "mirrored" else EXAMPLE)
    board = board_of(data, roller=0.0 if name == "knife edge" else 10.0, dwell=0.0 if name == "no dwell" else 40.0)
    views = set()
    for construction in ArcChain(board, pencil).values():
        for step in construction.steps():
            views.add(step.view.name)
            caption = str(step.caption)
            assert caption[0].isupper()
            assert caption.endswith(".")
            assert re.search(r"\d", caption) or step.view.name == "scheme"
            assert not re.search(r"\b(nan|inf)\b", caption)
            for mark in step.marks:
                for key, value in fields(mark).items():
                    if not isinstance(value, str | Caption):
                        assert np.isfinite(value).all(), (str(step.title), type(mark).__name__, key)
    assert views == {
        "arcs",
        "roller",
        "plan",
        "accelerations",
        "acceleration",
        "velocity",
        "displacement",
        "angle",
        "scheme",
    }


def test_captions_carry_the_numbers_of_the_example():
    said = " ".join(str(step.caption) for c in ArcChain(board_of(EXAMPLE)).values() for step in c.steps())
    for part in (
        "G = (22.24, 37.84) mm", "C₃ = (12.003, -14.394) mm", "F = (46.834, 25.855) mm", "C₃′ = (20.977, 31.395) mm",
        "F, C₁, C₃ and G, C₃, C₂: the arcs touch internally", "26.888° at G", "which is 15.004 mm",
    ):  # fmt: skip
        assert part in said, part
    for name, part in (("case 2", "Bisect AG: compass 35.75 mm"), ("case 3", "step 34.00 mm off from D towards O: C₁")):
        drawn = ArcChain(board_of(CASES[name]))["three_arcs"]
        assert part in " ".join(str(step.caption) for step in drawn.steps())


def test_the_arcs_of_the_profile_join_without_a_gap():
    """Each arc of the closed outline ends where another begins, and all of them go round once."""
    arcs = [m for m in ArcChain(board_of(EXAMPLE))["three_arcs"].steps()[-1].marks if isinstance(m, Arc)]
    ends = np.array([a.centre + a.radius * np.exp(1j * np.array([a.start, a.end])) for a in arcs])
    assert len(arcs) == 8
    for end in ends.ravel():
        assert np.count_nonzero(np.abs(ends - end) < 1e-9) == 2
    assert sum(a.end - a.start for a in arcs) == pytest.approx(2 * math.pi, abs=1e-12)


def test_the_roller_stands_on_the_drawn_profile():
    steps = ArcChain(board_of(EXAMPLE))["arc_roller"].steps()
    profile = [m for m in steps[0].marks if isinstance(m, Arc)][:8]
    rise, back = [m.points for m in steps[2].marks if isinstance(m, Dots)]
    mu_l = board_of(EXAMPLE).mu_l.per_mm
    for point in np.concatenate([rise, back]):
        away = [abs(abs(point - a.centre) - a.radius) for a in profile]
        assert min(abs(distance - 10 / mu_l) for distance in away) < 1e-9


# --- hands -----------------------------------------------------------------------------------------------------------


def test_nothing_is_taken_from_the_exact_side():
    for pencil in HANDS:
        with exact_side_forbidden():
            for construction in ArcChain(board_of(CASES["case 4"]), pencil).values():
                construction.steps()


def slopes_of_rho3() -> dict[str, float]:
    """By how much rho3 changes with each given length, all in mm of paper: by differences."""
    h = 1e-4

    def rho3(**moved) -> float:
        return three_arc_cam(**(EXAMPLE | moved))[0].rho3

    def slope(name: str, step) -> float:
        return (rho3(**{name: np.add(EXAMPLE[name], step)}) - rho3(**{name: np.subtract(EXAMPLE[name], step)})) / (
            2 * h
        )

    points = {f"{p}_{axis}": slope(p, way) for p in ("G", "C1", "C2") for axis, way in (("x", (h, 0)), ("y", (0, h)))}
    return points | {"rho1": slope("rho1", h)}


def test_dividers_scatter_c3_as_the_crossing_says():
    """Two settings a point, across and up, but none for a length of nothing; and one for P."""
    sigma = 0.1
    chain = ArcChain(board_of(EXAMPLE), gc.Pencil(dividers=sigma, samples=2000, seed=3))
    scatter = chain["three_arcs"].readings["rho3"].paper.std()
    slopes = slopes_of_rho3()
    del slopes["C2_x"]  # it lies on the upright axis
    assert scatter == pytest.approx(sigma * math.hypot(*slopes.values()), rel=0.06)


def test_lines_scatter_c3_as_the_crossing_says():
    """The uprights stand beside their feet; the bisector is off at both crossings, sqrt(0.39) of the chord from it."""
    sigma = 0.1
    chain = ArcChain(board_of(EXAMPLE), gc.Pencil(line=sigma, samples=2000, seed=3))
    arcs, slopes = ArcChain(board_of(EXAMPLE))["three_arcs"], slopes_of_rho3()
    c1, p, c3, g, c2 = (complex(arcs.points[name]) for name in ("C1", "P", "C3", "G", "C2"))
    far = abs(c3 - (c1 + p) / 2) / (abs(p - c1) * math.sqrt(0.8**2 - 0.5**2))  # in parts of the crossings' distance
    offset = math.hypot((1 + far) / 2, (1 - far) / 2) / math.sqrt(2)
    crossing = abs(math.sin(cmath.phase((c2 - g) / (1j * (p - c1)))))
    expected = math.hypot(offset / crossing, *(slopes[f"{point}_x"] for point in ("G", "C1", "C2")))
    assert chain["three_arcs"].readings["rho3"].paper.std() == pytest.approx(sigma * expected, rel=0.06)


def test_readings_are_shaped_by_samples_and_repeat():
    hands = gc.Pencil(line=0.2, dividers=0.2, protractor=0.005, division=0.5, samples=4, seed=5)
    one, again = (ArcChain(board_of(EXAMPLE), hands) for _ in range(2))
    for name in one:
        for key, read in one[name].readings.items():
            assert read.paper.shape[0] == 4, key
            assert np.array_equal(read.paper, again[name].readings[key].paper, equal_nan=True)
