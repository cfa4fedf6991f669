"""The cutting file, replayed by a few lines of its own and read by another program: where the cutter is led."""

from __future__ import annotations

import math
import re
import subprocess
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from over_all import fast_first
from programs import library, program
from scipy.spatial import cKDTree
from test_spline import greatest_distance, sized
from test_undercut import one_loop, random_cam, with_roller

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.workshop.cutter_path import cutting_program
from graphcam.workshop.part_outline import of_cam, outline_of

WORD = re.compile(r"([A-Z])(-?\d+(?:\.\d+)?)")
RADII_AGREE = 0.0005
"""Of a move's start and end about its centre [mm]; controllers ask for 0.002 to 0.013."""


@dataclass
class Replayed:
    """What a controller would do: the rapid's end, and of every cut (start, end, centre or None, sense)."""

    start: complex
    cuts: list[tuple[complex, complex, complex | None, int]]
    feed: float


def replay(text: str) -> Replayed:
    """Execute a program; words that no controller must be asked for are errors."""
    position, motion, feed, start, ended = 0j, None, math.nan, None, False
    cuts = []
    for line in text.splitlines():
        if line.startswith("("):
            assert line.endswith(")")
            assert line.isascii()
            assert not set("()") & set(line[1:-1])
            continue
        assert not ended
        words = [(letter, float(number)) for letter, number in WORD.findall(line)]
        assert " ".join(f"{letter}{number}" for letter, number in WORD.findall(line)) == line
        values = dict(words)
        assert set(values) <= set("GXYIJFM")
        codes = [number for letter, number in words if letter == "G"]
        ended = values.get("M") == 30
        feed = values.get("F", feed)
        if "X" not in values:
            assert ended or codes == [17, 21, 40, 90, 94]
            continue
        (motion,) = codes
        there = complex(values["X"], values["Y"])
        if motion == 0:
            assert start is None  # one rapid, to the beginning
            start = there
        else:
            assert feed > 0
            centre = position + complex(values["I"], values["J"]) if motion in (2, 3) else None
            cuts.append((position, there, centre, {1: 0, 2: -1, 3: 1}[motion]))
        position = there
    assert ended
    return Replayed(start, cuts, feed)


def sampled(cut, count: int = 200) -> np.ndarray:
    start, end, centre, sense = cut
    share = np.linspace(0, 1, count)
    if centre is None:
        return start + share * (end - start)
    turn = sense * ((sense * np.angle((end - centre) / (start - centre))) % (2 * np.pi))
    # As controllers do: the radius goes over from the one to the other.
    radius = abs(start - centre) + share * (abs(end - centre) - abs(start - centre))
    return centre + radius * (start - centre) / abs(start - centre) * np.exp(1j * turn * share)


def ways(cut) -> tuple[complex, complex]:
    """Unit tangents at start and end."""
    start, end, centre, sense = cut
    if centre is None:
        return (end - start) / abs(end - start), (end - start) / abs(end - start)
    return tuple(sense * 1j * (z - centre) / abs(z - centre) for z in (start, end))


def xy(points: np.ndarray) -> np.ndarray:
    return np.stack([points.real, points.imag], axis=-1)


def contour(text: str, count: int = 200) -> np.ndarray:
    """Dense points in order, none twice."""
    return np.concatenate([sampled(cut, count)[:-1] for cut in replay(text).cuts[1:-1]])


CAMS = {
    "random 1": lambda: random_cam(1),
    "random 2": lambda: random_cam(2),
    "random 7": lambda: random_cam(7),
    "random 11": lambda: random_cam(11),
    "flat": lambda: sized(1.0, FlatFaced()),
    "arm": lambda: sized(1.0, Oscillating(80.0, 100.0, 10.0)),
    "far offset": lambda: sized(1.0, Translating(-44.9, 5.0)),
    "tiny": lambda: sized(2 / 45, Translating(0.1, 0.5)),
    "large": lambda: sized(50.0, Translating(400.0, 500.0)),
    "cusp": lambda: with_roller(one_loop("cycloidal", "cw", 0.0), 1.0),
    "corner": lambda: one_loop("3-4-5", "ccw", 0.1),
}


@pytest.fixture(params=fast_first(CAMS, 5))
def cam(request) -> gc.Cam:
    return CAMS[request.param]()


@pytest.mark.parametrize("tolerance", [0.001, 0.005, 0.05])
def test_the_contour_is_the_profile_within_its_tolerance_both_ways(cam, tolerance):
    text = cutting_program(of_cam(cam), tolerance=tolerance)
    followed = contour(text)
    exact = cam.trimmed_profile(40_000)
    assert greatest_distance(xy(followed), exact) <= tolerance
    measured = greatest_distance(exact[::10], xy(contour(text, 1500)))
    assert measured <= tolerance
    said = float(re.search(r"GREATEST DISTANCE FROM THE EXACT WAY ([\d.]+) MM", text)[1])
    assert measured <= said + 1e-4
    assert said <= tolerance


@pytest.mark.parametrize("part", [0.05, 0.4])
def test_a_cutter_leaves_the_profile_uncut_and_nothing_beside_it(cam, part):
    """Its circle touches the exact profile everywhere: its centre is just its radius away."""
    outline = of_cam(cam)
    radius = round(part * min(outline.least_hollow, 50.0, 5 * outline.least_radius), 3)
    followed = contour(cutting_program(outline, cutter_radius=radius, tolerance=0.005))
    exact = cam.trimmed_profile(40_000)
    nearest, _ = cKDTree(exact).query(xy(followed))
    assert nearest.min() >= radius - 0.005
    sides = np.linalg.norm(np.diff(exact, axis=0), axis=1).max()
    assert nearest.max() <= math.hypot(radius + 0.005, sides)
    # Every place of the profile is cut.
    reached, _ = cKDTree(xy(followed)).query(exact[::20])
    gap = np.abs(np.diff(followed)).max()
    assert reached.max() <= math.hypot(radius + 0.005, gap)


@pytest.mark.parametrize("radius", [0.0, 0.3])
def test_moves_join_without_a_kink_close_and_can_be_run_by_any_controller(cam, radius):
    done = replay(cutting_program(of_cam(cam), cutter_radius=radius, feed=250))
    assert done.feed == 250
    assert done.start == done.cuts[0][0]
    lead_in, *around, lead_out = done.cuts
    assert around[0][0] == around[-1][1] == lead_in[1] == lead_out[0]
    for start, end, centre, _ in done.cuts:
        assert start != end
        if centre is not None:
            assert abs(abs(start - centre) - abs(end - centre)) <= RADII_AGREE
    corners = 0
    for before, behind in pairwise(around):
        kink = abs(np.angle(ways(behind)[0] / ways(before)[1]))
        # Four decimals turn a short move by as much as they are long beside it; flat arcs are straight.
        short = min(abs(cut[1] - cut[0]) for cut in (before, behind))
        flat = 2 * 4 * 2e-5 / short
        if kink > 4e-4 / short + flat + 1e-6:
            corners += 1
    sound = radius > 0 or not cam.undercuts()
    assert corners <= (0 if sound else len(cam.undercuts()))
    # Clockwise once around the centre.
    angles = np.unwrap(np.angle(np.concatenate([sampled(cut) for cut in around])))
    assert angles[-1] - angles[0] == pytest.approx(-2 * math.pi, abs=1e-6)


def test_the_leads_stay_clear_of_the_profile(cam):
    for radius in (0.0, 0.3):
        done = replay(cutting_program(of_cam(cam), cutter_radius=radius))
        exact = cam.trimmed_profile(100_000)
        for lead in (done.cuts[0], done.cuts[-1]):
            nearest, _ = cKDTree(exact).query(xy(sampled(lead)))
            assert nearest.min() >= radius - 0.005
            along = sampled(lead)[:: 1 if lead is done.cuts[-1] else -1]
            assert np.all(np.diff(np.abs(along)) > -1e-4)  # it only ever comes nearer, and only goes away


def test_a_cam_of_arcs_is_cut_by_its_own_arcs():
    """Three arcs of the rise and of the return and two circles, the base circle in parts of half a turn."""
    solution = gc.solve(gc.builtin_arcs_task())
    done = replay(cutting_program(outline_of(solution), tolerance=0.001, cutter_radius=5.0))
    assert len(done.cuts) - 2 <= 11
    arcs = {round(abs(start - centre), 3) for start, _, centre, _ in done.cuts[1:-1] if centre is not None}
    cam = solution.cam
    radii = [cam.rho1, cam.rho2, cam.rho3, math.hypot(*cam.A), math.hypot(*cam.D)]
    assert arcs == {round(radius + 5.0, 3) for radius in radii}


def test_a_cutter_too_large_for_a_hollow_is_refused():
    outline = outline_of(gc.solve(gc.builtin_task()))
    limit = outline.least_hollow
    cutting_program(outline, cutter_radius=0.99 * limit)
    with pytest.raises(
        DesignError, match=r"part.cutter_radius is .*, but must be less than 47.97 mm, the minimum radius"
    ):
        cutting_program(outline, cutter_radius=1.01 * limit)


@pytest.mark.parametrize(("said", "about"), [({"tolerance": 0.0005}, "tolerance"), ({"feed": 0.0}, "part.feed")])
def test_what_a_program_cannot_keep_is_refused(said, about):
    with pytest.raises(DesignError, match=f"{about} is"):
        cutting_program(outline_of(gc.solve(gc.builtin_task())), **said)


def test_the_bytes_repeat_and_a_name_is_plain():
    outline = outline_of(gc.solve(gc.builtin_task()))
    first, second = (cutting_program(outline, name="Кулачок (1)") for _ in range(2))
    assert first == second
    assert first.splitlines()[0] == "(GRAPHCAM: CAM PROFILE ??????? ?1?)"


# --- as others read it -----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_parser_of_another_make_finds_the_same_words():
    """gcodeparser's commands and numbers are those of the replay."""
    text = cutting_program(outline_of(gc.solve(gc.builtin_task())), cutter_radius=8.0)
    lines = library("gcodeparser").parse_gcode_lines(text, include_comments=False)
    position, ends = 0j, []
    for line in lines:
        if "X" in line.params:
            centre = complex(line.params.get("I", 0), line.params.get("J", 0)) if line.command[1] in (2, 3) else None
            ends.append((line.command, position, complex(line.params["X"], line.params["Y"]), centre))
            position = ends[-1][2]
    (rapid, _, start, _), *cuts = ends
    done = replay(text)
    assert rapid == ("G", 0)
    assert start == done.start
    senses = {("G", 1): 0, ("G", 2): -1, ("G", 3): 1}
    found = [
        (begin, end, None if centre is None else begin + centre, senses[command])
        for command, begin, end, centre in cuts
    ]
    assert found == done.cuts


CANON = re.compile(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED)\((.*)\)")


@pytest.mark.parametrize("radius", [0.0, 0.3])
def test_the_interpreter_of_linuxcnc_executes_it(cam, radius, tmp_path):
    """It refuses arcs whose radii differ, and what it tells the machine to do are the moves of the replay."""
    text = cutting_program(of_cam(cam), cutter_radius=radius)
    (tmp_path / "profile.ngc").write_text(text)
    out = subprocess.run(
        [program("rs274"), "-g", "profile.ngc"], cwd=tmp_path, check=False, stdin=subprocess.DEVNULL,
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert "PROGRAM_END()" in out.stdout, out.stderr
    done, told = replay(text), CANON.findall(out.stdout)
    numbers = [list(map(float, said.split(", "))) for _, said in told]
    assert complex(*numbers[0][:2]) == pytest.approx(done.start, abs=1e-4)
    assert len(told) == 1 + len(done.cuts)
    for (name, _), values, (_, end, centre, sense) in zip(told[1:], numbers[1:], done.cuts, strict=True):
        assert abs(complex(*values[:2]) - end) <= 1e-4
        assert name == ("STRAIGHT_FEED" if centre is None else "ARC_FEED")
        if centre is not None:
            assert abs(complex(*values[2:4]) - centre) <= 1e-4
            assert values[4] == sense


def test_the_replay_sees_a_wrong_sense_and_a_wrong_centre():
    text = cutting_program(outline_of(gc.solve(gc.builtin_task())))
    exact = gc.solve(gc.builtin_task()).cam.trimmed_profile(20_000)
    lines = text.splitlines()
    k = next(k for k, line in enumerate(lines) if line.startswith("G2"))
    wrong = [*lines[:k], lines[k].replace("G2", "G3"), *lines[k + 1 :]]
    assert greatest_distance(xy(contour("\n".join(wrong))), exact) > 1
    moved = [*lines[:k], lines[k].replace(" I", " I1"), *lines[k + 1 :]]
    assert greatest_distance(xy(contour("\n".join(moved))), exact) > 0.1


@pytest.mark.parametrize(("feed", "said"), [(1234567.0, "1234567"), (0.001, "0.001"), (80.0, "80"), (12.5, "12.5")])
def test_a_feed_is_told_in_digits_alone(feed, said):
    """RS274 knows no powers of ten."""
    text = cutting_program(outline_of(gc.solve(gc.builtin_task())), feed=feed)
    assert re.findall(r"F([\d.e+-]+)$", text, re.MULTILINE) == [said]
    assert f"(FEED {said} MM/MIN," in text
