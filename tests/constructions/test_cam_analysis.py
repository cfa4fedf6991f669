"""The drawn analysis of a given cam against the exact motion that its arcs give the follower."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from boards import order
from over_all import over_all, over_seeds
from replay import followed, off
from test_outline_motion import random_cam

import graphcam as gc
from graphcam.constructions.arm_analysis import arm_analysis
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.face_analysis import face_analysis
from graphcam.constructions.stem_analysis import stem_analysis
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.laid_outline import laid_outline
from graphcam.report.note import comparison_file
from graphcam.tasks.task_file import task_from

FULL_TURN = 2 * math.pi
PARTS = 36, 72, 144
ON_PAPER = 1e-6
"""mm of paper: an error of less is rounding."""
ROUNDED = {"base_radius": 30, "flank_radius": 120, "nose_radius": 10, "lift": 12}
TANGENT = {"base_radius": 28, "ascent": 70, "lift": 15, "flank_radius": "straight"}
TASKS = {
    "central": {"arcs": TANGENT, "follower": {"kind": "translating", "offset": 0, "roller_radius": 16}},
    "knife edge": {"arcs": ROUNDED, "follower": {"kind": "translating", "offset": 8, "roller_radius": 0}},
    "dwell": {"arcs": ROUNDED | {"dwell": 20}, "rotation": "cw",
              "follower": {"kind": "translating", "offset": -8, "roller_radius": 6}},
    "eccentric": {"arcs": {"base_radius": 30, "lift": 12},
                  "follower": {"kind": "translating", "offset": 5, "roller_radius": 8}},
    "flat": {"arcs": ROUNDED, "follower": {"kind": "flat-faced"}},
    "arm": {"arcs": ROUNDED | {"dwell": 20}, "rotation": "cw",
            "follower": {"kind": "oscillating", "arm": 80, "distance": 95, "roller_radius": 10}},
}  # fmt: skip
MU_L = Scale(0.5, "mm")


def analysis_of(follower, motion, parts):
    """The analysis in so many parts of the turn, at 2:1, by a hand without error."""
    pencil = Pencil()
    roller, place = getattr(follower, "roller_radius", 0.0), getattr(follower, "offset", 0.0)
    if isinstance(follower, gc.Oscillating):
        place = follower.distance
    unit = "rad" if isinstance(follower, gc.Oscillating) else "mm"
    phi = FULL_TURN * np.arange(parts) / parts
    laid = laid_outline(motion, FULL_TURN / parts)
    givens = AnalysisGivens(laid, motion, motion.rotation, motion.prime_radius, roller, place, phi, MU_L, unit)
    if isinstance(follower, gc.Oscillating):
        return arm_analysis(givens, follower.arm, pencil)
    return (face_analysis if isinstance(follower, gc.FlatFaced) else stem_analysis)(givens, pencil)


def random_analysis(seed):
    """A random cam by radii with its follower and its analyses in more and more parts; None where none is drawn."""
    found = random_cam(np.random.default_rng(seed))
    if found is None or isinstance(found[1], gc.OscillatingFlat):
        return None
    _, follower, _, motion = found
    return motion, follower, [analysis_of(follower, motion, parts) for parts in PARTS]


@over_seeds(12)
def test_the_measured_displacement_comes_to_that_of_the_arcs(seed):
    """In the third order or better, where the curve has a corner in none of its parts."""
    if (found := random_analysis(seed)) is None:
        return
    motion, follower, drawn = found
    size = follower.arm if isinstance(follower, gc.Oscillating) else 1.0
    errors = [size / MU_L.per_mm * np.abs(each.value("s") - motion(each.givens.phi)[0]).max() for each in drawn]
    assert errors[-1] < 0.01
    assert errors[-1] < ON_PAPER or order(PARTS, errors) > 1.8


@over_seeds(12)
def test_the_phase_angles_and_the_lift_are_those_of_the_motion(seed):
    if (found := random_analysis(seed)) is None:
        return
    motion, _, drawn = found
    angles = np.array([phase.angle for phase in motion.phases])
    assert drawn[-1].value("phase_angles") == pytest.approx(angles, abs=math.radians(0.2))
    assert float(drawn[-1].value("lift")) == pytest.approx(motion.lift, rel=3e-3)
    assert drawn[-1].value("phase_angles").sum() == pytest.approx(FULL_TURN)


@over_seeds(12)
def test_the_pressure_angles_are_those_of_the_cam(seed):
    if (found := random_analysis(seed)) is None or isinstance(found[1], gc.FlatFaced):
        return
    motion, follower, drawn = found
    cam = gc.Cam(motion, follower, motion.prime_radius, motion.rotation)
    extremes, last = cam.extremes(), drawn[-1]
    assert np.abs(last.value("alpha") - cam.pressure_angle(last.givens.phi)).max() < math.radians(0.1)
    for way, (exact, _) in (("rise", extremes.pressure_angle_rise), ("return", extremes.pressure_angle_return)):
        assert abs(float(last.value(f"max_{way}"))) == pytest.approx(abs(exact), abs=math.radians(0.5))


def test_most_random_cams_are_analysed():
    assert sum(random_analysis(seed) is not None for seed in range(40)) > 20


@over_all("rotation", ["ccw", "cw"])
@over_all(
    ("follower", "lift", "prime_radius"),
    [
        (gc.Translating(6, roller_radius=10), 12.0, 50.0),
        (gc.Translating(0, roller_radius=0), 12.0, 50.0),
        (gc.Oscillating(80, 100, 10), 0.15, 50.0),
        (gc.FlatFaced(), 12.0, 60.0),
    ],
)
def test_an_outline_by_points_is_analysed_like_one_of_arcs(rotation, follower, lift, prime_radius):
    """Points of the profile of a law's cam give the displacements of the law back."""
    parts = [(gc.Rise, 100, "3-4-5"), (gc.Dwell, 40, ""), (gc.Return, 100, "cycloidal"), (gc.Dwell, 120, "")]
    phases = [
        kind(math.radians(angle)) if not law else kind(lift, math.radians(angle), law) for kind, angle, law in parts
    ]
    profile = gc.Cam(gc.Motion(phases), follower, prime_radius, rotation).profile(np.radians(np.arange(360)))
    motion = gc.outline_motion(gc.cam_through_points(profile), follower, rotation)
    drawn = analysis_of(follower, motion, 72)
    size = follower.arm if isinstance(follower, gc.Oscillating) else 1.0
    assert size * np.abs(drawn.value("s") - gc.Motion(phases)(drawn.givens.phi + motion.zero)[0]).max() < 2e-3
    angles = np.array([phase.angle for phase in motion.phases])
    assert drawn.value("phase_angles") == pytest.approx(angles, abs=math.radians(0.5))
    assert [str(step.caption) for step in drawn.steps()]
    if not isinstance(follower, gc.FlatFaced):
        cam = gc.Cam(motion, follower, motion.prime_radius, rotation)
        assert np.abs(drawn.value("alpha") - cam.pressure_angle(drawn.givens.phi)).max() < math.radians(0.1)


def test_the_mirror_finds_the_maximum_angle_of_a_tangent_cam_where_flank_and_nose_meet():
    """tan(alpha) there is v over r0 + s: base radius 28, roller 16, ascent 70 degrees, lift 15."""
    solution = gc.solve(task_from(TASKS["central"]))
    angle = math.degrees(float(solution.drawn["analysis"].value("max_rise")))
    assert angle == pytest.approx(math.degrees(math.atan(22.7971 * math.sin(math.radians(70)) / 44)), abs=1e-3)


@over_all("name", TASKS)
def test_what_is_measured_lies_within_its_bounds(name):
    solution = gc.solve(task_from(TASKS[name]))
    measured = [each for key, each in solution.comparison.quantities.items() if key.startswith("measured")]
    assert len(measured) == (4 if name == "flat" else 6)
    assert [each.name for each in measured if each.is_beyond_bound] == []


@over_all("name", ["central", "dwell", "flat", "arm"])
@over_all("seed", [1, 2, 3])
def test_what_a_trembling_hand_measures_lies_within_its_bounds(name, seed):
    pencil = gc.Pencil(line=0.1, dividers=0.1, protractor=math.radians(0.2), seed=seed)
    solution = gc.solve(task_from(TASKS[name]), pencil=pencil)
    measured = [each for key, each in solution.comparison.quantities.items() if key.startswith("measured")]
    assert [each.name for each in measured if not abs(each.error_paper) > 0] == []
    assert [each.name for each in measured if each.is_beyond_bound] == []


@over_all("name", TASKS)
def test_hands_without_error_measure_alike_and_hands_that_err_scatter(name):
    chain = gc.solve(task_from(TASKS[name])).chain
    perfect, many = chain["analysis"], chain.by(Pencil(line=0.1, dividers=0.1, protractor=0.003, samples=8))["analysis"]
    alike = chain.by(Pencil(samples=2))["analysis"]
    for key, read in perfect.readings.items():
        assert alike.readings[key].value == pytest.approx(np.stack([read.value] * 2), abs=1e-12)
        assert many.readings[key].value.shape == (8, *read.value.shape)
        assert np.ptp(many.readings[key].value, axis=0).max() > 0
    assert [str(step.caption) for step in pickle.loads(pickle.dumps(many)).steps()]


@over_all("name", TASKS)
def test_a_second_board_measures_the_same(name):
    drawn = gc.solve(task_from(TASKS[name])).drawn["analysis"]
    readings, _ = followed(drawn)
    for key, read in drawn.readings.items():
        assert off(read.paper, readings[key]) < 1e-9, key


@over_all("name", TASKS)
def test_the_displacement_that_was_measured_is_the_one_that_is_differentiated(name):
    """Raised by a millimetre at one station, it is so in the diagram too, and in its velocity."""
    chain = gc.solve(task_from(TASKS[name])).chain
    analysis, before = chain["analysis"], chain["differentiation"]
    s = analysis.readings["s"]
    assert before.points["s"].imag * before.givens.mu_s.per_mm == pytest.approx(s.value, abs=1e-12)
    raised = replace(s, paper=s.paper + 0.1 * (np.arange(s.paper.size) == 5))
    other = replace(analysis, readings={**analysis.readings, "s": raised})
    after = chain.continued_from(other)["differentiation"]
    changed = np.flatnonzero(np.abs(after.readings["v"].paper - before.readings["v"].paper) > 1e-9)
    assert changed.tolist() == [4, 5]


def test_the_analysis_comes_first_and_starts_from_nothing_but_the_outline():
    chain = gc.solve(task_from(TASKS["central"])).chain
    assert list(chain)[:3] == ["scheme", "analysis", "differentiation"]
    alone = replace(chain, done={})
    _ = alone["differentiation"]
    assert set(alone.lying) == {"analysis", "differentiation"}


@over_all("name", TASKS)
def test_drawn_and_exact_are_compared_in_words(name):
    """Of what every follower has measured, and of no pressure angle where a face has none."""
    said = comparison_file(gc.solve(task_from(TASKS[name])))
    assert ("measured maximum α" in said) == (name != "flat")
    assert "measured lift" in said


def test_of_two_strokes_a_turn_the_angles_are_measured_between_turns_that_follow_one_another(tmp_path):
    """An ellipse about its centre lifts the follower twice a turn, and each of the four phases is a quarter of it."""
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    rows = "".join(f"{x!r},{y!r}\n" for x, y in np.stack([40 * np.cos(angle), 32 * np.sin(angle)], axis=-1).tolist())
    (tmp_path / "cam.csv").write_text("x,y\n" + rows, encoding="utf-8")
    text = 'rotation = "ccw"\n[outline]\nfile = "cam.csv"\n[follower]\nkind = "translating"\nroller_radius = 10\n'
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    drawn = gc.solve(gc.load_task(tmp_path / "cam.toml")).drawn["analysis"]
    assert np.degrees(drawn.value("phase_angles")) == pytest.approx([90] * 4, abs=1)
