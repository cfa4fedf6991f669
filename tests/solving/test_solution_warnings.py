"""What a solution warns of, and where the warnings can be read."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import DesignError
from graphcam.report.documents import sheet_of
from graphcam.report.note import note
from graphcam.sheets.model import Text
from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task, builtin_text, load_task

# The case "undercut" of tests/data/cases.toml.
UNDERCUT = """
rotation = "ccw"
[motion]
phases = [
  { kind = "rise", angle = 60, lift = 30, law = "3-4-5" },
  { kind = "dwell", angle = 30 },
  { kind = "return", angle = 60, lift = 30, law = "3-4-5" },
  { kind = "dwell", angle = 210 },
]
[follower]
kind = "translating"
offset = 5
roller_radius = 20
[cam]
prime_radius = 30
"""


@pytest.fixture
def solved(tmp_path):
    """The solution of the task, with a text in it replaced by another."""

    def solved(old: str = "", new: str = ""):
        path = tmp_path / "cam.toml"
        path.write_text(UNDERCUT.replace(old, new) if old else UNDERCUT)
        return solve(load_task(path))

    return solved


def test_the_builtin_cam_is_sound():
    assert solve(builtin_task()).warnings == []


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("coursework", "lift = 30", "lift = 0.03", "The lift of 0.03 mm looks like metres: if so, give 30, in mm."),
        ("arm", "lift = 15", "lift = 0.2618", "The lift of 0.2618° looks like radians: if so, give 15, in degrees."),
        (
            "coursework", "angle_rise = 30", "angle_rise = 0.7\n[cam]\nprime_radius = 60",
            "The permitted pressure angle of 0.7° looks like radians: if so, give 40.1, in degrees.",
        ),
        ("coursework", "lift = 30", "lift = 0.3", ""),
    ],
)  # fmt: skip
def test_values_that_look_like_another_unit_are_drawn_and_warned_of(name, old, new, said, tmp_path):
    path = tmp_path / "cam.toml"
    assert old in builtin_text(name)
    path.write_text(builtin_text(name).replace(old, new), encoding="utf-8")
    solution = solve(load_task(path))
    assert [str(warning) for warning in solution.warnings if "looks like" in str(warning)] == ([said] if said else [])
    assert solution.chain.prime_radius > 0


def test_undercut_limits_and_prime_radius_are_warned_of_in_this_order(solved):
    first, second, third = solved().warnings
    for said in (
        "with a roller of 20 mm", "between the cusps at 42.22° and 54.12°, and is lost from 36.66° to 58.62°",
        "96.54° and 104.01°", "Every roller smaller than 16.645 mm avoids the cusps.",
    ):  # fmt: skip
        assert said in first
    assert second.startswith("The pressure angle reaches ")
    assert "° on the rise, at " in second
    assert third.startswith("The given prime radius of 30 mm is smaller than the minimum permitted one, ")


def test_the_remedy_is_one(solved):
    """The angles stay as they are, but the profile can be cut."""
    warned = solved("= 20", "= 16.645").warnings
    assert len(warned) == 2
    assert not any("cut" in sentence for sentence in warned)
    assert "cut" in solved("= 20", "= 16.646").warnings[0]


def test_a_return_under_force_closure_is_not_limited(solved):
    assert not any("return" in sentence for sentence in solved().warnings)
    warned = solved("[cam]", "[limits]\npressure_angle_return = 30\n[cam]").warnings
    assert any("° on the return, at " in sentence for sentence in warned)


def test_a_flat_face_on_too_small_a_cam(solved):
    translating = UNDERCUT[UNDERCUT.index('kind = "translating"') :]
    first, *_ = solved(translating, 'kind = "flat-faced"\n[cam]\nprime_radius = 10\n').warnings
    assert "by the flat face on a prime radius of 10 mm" in first
    assert first.endswith("Enlarge the prime radius.")


def test_sheet_and_note_tell_the_warnings(solved):
    solution = solved()
    written = note(solution)
    assert all(f"**{sentence}**" in written for sentence in solution.warnings)
    entities = [entity for page in sheet_of(solution).pages for group in page.groups for entity in group.entities]
    texts = " ".join(entity.text for entity in entities if isinstance(entity, Text))
    assert all(sentence in texts for sentence in solution.warnings)


def test_the_command_line_prints_them_on_standard_error(tmp_path):
    path = tmp_path / "cam.toml"
    path.write_text(UNDERCUT)
    result = CliRunner().invoke(app, ["solve", str(path), "--json"])
    assert result.exit_code == 0
    assert result.stderr.count("warning: ") == 3
    assert "warning: " not in result.stdout
    assert [f"warning: {each}" in result.stderr for each in json.loads(result.stdout)["warnings"]] == [True] * 3


ARM = """
rotation = "ccw"
[motion]
phases = [
  { kind = "rise", angle = 58, lift = 35, law = "2-3" },
  { kind = "dwell", angle = 24 },
  { kind = "return", angle = 58, lift = 35, law = "2-3" },
  { kind = "dwell", angle = 220 },
]
[follower]
kind = "oscillating"
arm = 47
distance = 144
[limits]
pressure_angle_rise = 48
pressure_angle_return = 21
"""


def test_sizes_that_could_not_be_round_are_told(tmp_path):
    """At this centre distance no whole millimetre lies on the arc that the limits leave; five further out one does."""
    path = tmp_path / "arm.toml"
    for distance, told in ((144, True), (149, False)):
        path.write_text(ARM.replace("144", f"{distance}"))
        solution = solve(load_task(path))
        said = [text for text in solution.warnings if text.startswith("No combination of multiples of 1 mm")]
        assert bool(said) == told
        assert not told or f"{solution.cam.prime_radius:g} mm with the centre distance 144 mm is adopted" in said[0]


@pytest.mark.parametrize(
    ("said", "given", "told"),
    [
        ("5:1", None, True),
        ("М 5 : 1", None, True),
        ("2:1", None, False),
        ("2 : 1", None, False),
        ("see views", None, False),
        (None, None, False),
        ("1:1", "1:1", False),
        ("2:1", "1:1", True),
    ],
)
def test_a_title_block_that_tells_another_scale_than_the_drawn_one_is_told(said, given, told):
    """Built in, the profile is drawn at 2:1; ``title.scale`` does not change that, ``drawing.profile_scale`` does."""
    task = builtin_task()
    title, drawing = replace(task.title, scale=said), replace(task.drawing, profile_scale=given)
    solution = solve(replace(task, title=title, drawing=drawing))
    assert solution.chain.profile_scale.per_mm == (1.0 if given else 0.5)
    warned = [text for text in solution.warnings if text.startswith("The title block says")]
    assert bool(warned) == told
    assert not told or f"drawn at {given or '2:1'}:" in warned[0]


@pytest.mark.parametrize("given", ["3:1", "2", "large", ""])
def test_only_standard_scales_are_drawn(given):
    task = builtin_task()
    with pytest.raises(DesignError, match=r"a standard drawing scale, such as 10:1, 5:1, 4:1, 2.5:1") as raised:
        solve(replace(task, drawing=replace(task.drawing, profile_scale=given)))
    assert raised.value.quantity == "drawing.profile_scale"


ROUNDED = """
rotation = "ccw"
[motion]
phases = [
  {{ kind = "rise", angle = {rise}, lift = 20, law = "modified-sine" }},
  {{ kind = "dwell", angle = {high} }},
  {{ kind = "return", angle = {back}, lift = 20, law = "modified-sine" }},
  {{ kind = "dwell", angle = {low} }},
]
[follower]
kind = "translating"
roller_radius = 10
[cam]
prime_radius = 60
"""


@pytest.mark.parametrize(
    ("angles", "sentence", "lengths"),
    [
        (
            # Sevenths of a turn, to four decimals.
            ("51.4286", "102.8571", "102.8571", "102.8571"),
            "The phase angles sum to 359.9999°: φ2 takes up the missing 0.0001°.",
            (51.4286, 102.8572, 102.8571, 102.8571),
        ),
        (
            # Of 0.83 s: 0.17, 0.2, 0.23, 0.23 s.
            ("73.735", "86.747", "99.759", "99.7595"),
            "The phase angles sum to 360.0005°: φ4 is shortened by 0.0005°.",
            (73.735, 86.747, 99.759, 99.759),
        ),
        (("51.4286", "102.8572", "102.8571", "102.8571"), "", (51.4286, 102.8572, 102.8571, 102.8571)),
    ],
)
def test_what_rounded_angles_miss_of_a_turn_is_taken_up_by_the_longest_dwell_and_told(
    angles, sentence, lengths, tmp_path
):
    path = tmp_path / "cam.toml"
    path.write_text(ROUNDED.format(**dict(zip(("rise", "high", "back", "low"), angles, strict=True))))
    task = load_task(path)
    solution = solve(task)
    assert [warning for warning in solution.warnings if "sum to" in warning] == ([sentence] if sentence else [])
    assert [math.degrees(phase.angle) for phase in solution.cam.motion.phases] == pytest.approx(lengths, abs=1e-9)
    assert [phase["angle"] for phase in task.to_dict()["motion"]["phases"]] == [float(angle) for angle in angles]


def test_a_roller_that_leaves_no_room_for_a_shaft_is_warned_of(solved):
    flat = solved("prime_radius = 30", "prime_radius = 400").warnings
    assert flat == []
    assert any("leaves a base circle of 2 mm" in warning for warning in solved("= 20", "= 28").warnings)


NO_RADIUS = """
rotation = "{rotation}"
[motion]
phases = [
  {{ kind = "dwell", angle = 60 }},
  {{ kind = "rise", angle = 120, lift = 24, law = "rectangular" }},
  {{ kind = "dwell", angle = 90 }},
  {{ kind = "return", angle = 90, lift = 24, law = "cosine" }},
]
[follower]
kind = "oscillating"
arm = 55
{distance}
roller_radius = 10
[limits]
pressure_angle_rise = 35
pressure_angle_return = 70
"""


def test_where_no_radius_satisfies_the_limits_the_message_has_ways_out_that_do(tmp_path):
    """At 60 mm the least maximum on the rise is 38.81 degrees, by radii in steps of 0.05 mm."""
    path = tmp_path / "arm.toml"
    path.write_text(NO_RADIUS.format(rotation="ccw", distance="distance = 60"))
    with pytest.raises(DesignError) as refused:
        solve(load_task(path))
    assert str(refused.value) == (
        "centre distance is 60 mm, but must be one at which the pressure angle can keep its limits over the whole "
        "swing; leave it open: the minimum prime radius has a centre distance of 64.5481 mm, or turn the cam the other "
        "way, with a minimum prime radius of 17.349 mm"
    )
    for rotation, distance in (("ccw", ""), ("cw", "distance = 60")):
        path.write_text(NO_RADIUS.format(rotation=rotation, distance=distance))
        assert not [warning for warning in solve(load_task(path)).warnings if "permitted" in warning]
