"""The permitted radius of curvature of the working profile under a roller or a knife edge: exact, drawn by trials."""

import math
from dataclasses import replace

import pytest
from over_all import over_all

import graphcam as gc
from graphcam.constructions.adoption import BLUNT_FACTOR, adoption_step
from graphcam.constructions.views import PROFILE
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import CamTable, DrawingTable, LimitsTable, Task, TranslatingTable

PHASES = DwellTable(60), RiseTable(60, 16, "cycloidal"), DwellTable(180), ReturnTable(60, 16, "rectangular")
SHARP = Task(
    "ccw", MotionTable(PHASES), TranslatingTable(5.0, 12.0), limits=LimitsTable(45, 70, min_curvature_radius=4.0)
)
"""A published limit, whose least radius was found by bisection on dense formulas of their own: 32.0781 mm."""


OPEN_RADIUS = """rotation = "cw"
[motion]
phases = [
  { kind = "rise", angle = 90, lift = 20, law = "cycloidal" },
  { kind = "dwell", angle = 90 },
  { kind = "return", angle = 90, lift = 20, law = "cycloidal" },
  { kind = "dwell", angle = 90 },
]
[follower]
kind = "translating"
"""


def profile_radius(solution: gc.Solution) -> float:
    """The exact minimum radius of curvature of the working profile [mm]."""
    return solution.cam.extremes().min_convex_radius[0] - solution.cam.roller_radius


def changed(name: str, *, roller: float | None, least: float, place: float | None) -> Task:
    """A built-in task with an open prime radius and a permitted radius of curvature."""
    task = gc.builtin_task(name)
    follower = replace(task.follower, roller_radius=roller, **{"offset" if name == "coursework" else "distance": place})
    limits = replace(task.limits, min_curvature_radius=least)
    return replace(task, follower=follower, cam=CamTable(), limits=limits)


def test_the_published_least_radius_is_found_exactly():
    limits = {"rise": math.radians(45), "return_": math.radians(70), "offset": 5.0, "curvature": 4.0}
    found = gc.minimum_radius(SHARP.motion(), gc.Translating(5, 12), "ccw", **limits)
    assert found.prime_radius == pytest.approx(32.0781, abs=5e-5)
    assert found.active == ("curvature",)
    cam = gc.Cam(SHARP.motion(), gc.Translating(5, 12), found.prime_radius)
    assert cam.extremes().min_convex_radius[0] == pytest.approx(16, rel=1e-12)


@over_all(
    "task",
    [
        SHARP,
        changed("coursework", roller=20, least=30, place=-10.0),
        changed("coursework", roller=0, least=45, place=None),
        changed("coursework", roller=None, least=40, place=None),
        changed("arm", roller=12, least=20, place=None),
        changed("arm", roller=12, least=20, place=150.0),
    ],
)
def test_every_trial_adds_what_the_radius_of_curvature_lacks(task):
    """The first radius is that of the angles, the last the first that is read to suffice; the drawing adopts it."""
    solution = gc.solve(task)
    *short, last = solution.chain.trials
    free = replace(task.limits, min_curvature_radius=None)
    angles = gc.solve(replace(task, limits=free, follower=replace(task.follower, roller_radius=0.0)))
    assert short
    assert short[0].prime_radius == angles.cam.prime_radius
    for tried, following in zip(short, [*short[1:], last], strict=True):
        assert tried.rho < tried.needed
        assert tried.prime_radius + tried.too_sharp <= following.prime_radius < tried.prime_radius + tried.too_sharp + 1
    assert last.rho >= last.needed
    assert solution.cam.prime_radius == last.prime_radius
    assert solution.chain["curvature"].value("rho") == pytest.approx(last.rho, rel=1e-12)
    # The drawing reads a bend as well as its divisions permit: where that is too well, it is warned of.
    warned = any("radius of curvature of the profile falls" in each for each in solution.warnings)
    assert warned == (profile_radius(solution) < task.limits.min_curvature_radius - 0.005)


@over_all("roller", [4.0, 12.0, 20.0, 30.0])
@over_all("offset", [0.0, 5.0])
def test_an_open_radius_is_one_on_which_a_given_roller_does_not_undercut(roller, offset):
    limits, drawing = LimitsTable(45, 70), DrawingTable(divisions=48)
    task = replace(SHARP, follower=TranslatingTable(offset, roller), limits=limits, drawing=drawing)
    solution, knife = gc.solve(task), gc.solve(replace(task, follower=TranslatingTable(offset, 0.0)))
    asked = {"rise": math.radians(45), "return_": math.radians(70), "offset": offset, "curvature": 0.0}
    least = gc.minimum_radius(task.motion(), gc.Translating(offset, roller), "ccw", **asked).prime_radius
    blunt = {**asked, "curvature": (BLUNT_FACTOR - 1) * roller}
    most = gc.minimum_radius(task.motion(), gc.Translating(offset, roller), "ccw", **blunt).prime_radius
    assert max(least, knife.cam.prime_radius) <= solution.cam.prime_radius < max(most, knife.cam.prime_radius) + 1.1
    assert solution.cam.undercuts() == []
    # A radius that suffices is told of as without a roller.
    assert (solution.cam.prime_radius == knife.cam.prime_radius) == (solution.chain.trials == ())
    assert bool(solution.chain.trials) == (knife.chain["curvature"].value("rho") < BLUNT_FACTOR * roller)


def test_a_trial_for_a_permitted_radius_says_so_though_it_takes_as_much_as_for_the_roller_alone():
    """20 mm of roller and 3 mm of profile are 1.15 times the roller: what is needed does not tell why."""
    needed = replace(SHARP, follower=TranslatingTable(5.0, 20.0), limits=LimitsTable(45, 70, 3.0))
    for task, said in (
        (needed, "the permitted radius of the profile"),
        (replace(needed, limits=LimitsTable(45, 70)), "1.15 times"),
    ):
        solution = gc.solve(task)
        assert solution.chain.trials[0].needed == pytest.approx(23)
        assert said in str(adoption_step(solution.chain.adopted(), "e", 1.0, PROFILE).parts[1].caption)


def test_a_roller_that_no_radius_at_a_centre_distance_can_have_is_refused():
    with pytest.raises(gc.DesignError, match="goes with it within the permitted") as caught:
        gc.solve(replace(changed("arm", roller=120, least=1, place=150.0), limits=LimitsTable(45)))
    assert str(caught.value.quantity) == "roller radius"


def test_the_warning_names_a_radius_that_keeps_the_limit():
    coarse = gc.solve(SHARP)
    assert any("a prime radius of 33 mm" in each for each in coarse.warnings) == (coarse.cam.prime_radius < 32.0781)
    given = gc.solve(replace(SHARP, cam=CamTable(33.0)))
    assert given.warnings == []
    assert profile_radius(given) >= 4


def test_a_given_radius_that_leaves_the_profile_too_sharp_is_warned_of():
    sharp = gc.solve(replace(SHARP, cam=CamTable(25.0)))
    assert sharp.chain.trials == ()
    assert any("The radius of curvature of the profile falls to" in each for each in sharp.warnings)


def test_an_open_roller_leaves_the_profile_blunt_enough():
    task = replace(SHARP, follower=TranslatingTable(5.0), cam=CamTable(60.0), drawing=DrawingTable(divisions=48))
    free, kept = (gc.solve(replace(task, limits=LimitsTable(45, 70, least))) for least in (None, 25.0))
    assert profile_radius(free) < 25 <= profile_radius(kept)
    assert kept.cam.roller_radius < free.cam.roller_radius


def test_what_no_radius_at_a_centre_distance_has_is_refused():
    with pytest.raises(gc.DesignError) as caught:
        gc.solve(changed("arm", roller=12, least=200, place=150.0))
    assert caught.value.quantity == "limits.min_curvature_radius"
    with pytest.raises(gc.DesignError, match="give the centre distance too"):
        gc.minimum_radius(gc.builtin_task("arm").motion(), gc.Oscillating(80), curvature=3)


@pytest.mark.parametrize(
    ("field", "text"),
    [("follower.roller_radius", "[follower]\nroller_radius = 200"), ("part.bore", "[part]\nbore = 400\n[follower]")],
)
def test_a_size_that_asks_for_a_cam_larger_than_any_page_is_named(field, text, tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(OPEN_RADIUS.replace("[follower]", text))
    with pytest.raises(gc.DesignError, match=r"must be small enough .* on A1 .*; the prime radius found") as caught:
        gc.solve(gc.load_task(path)).write(tmp_path / "out", files=["pdf"])
    assert caught.value.quantity == field
    assert not (tmp_path / "out").exists()
