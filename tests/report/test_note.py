"""The coursework note: what a student hands in must be complete, and agree with the drawing."""

from __future__ import annotations

import re
from dataclasses import replace
from math import degrees, hypot, radians, tan

import pytest

from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import LAWS
from graphcam.language import ENGLISH
from graphcam.report.documents import contents_of, note_of
from graphcam.report.note import comparison_file, note
from graphcam.solving.solve import solve
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task import CamTable, LimitsTable, SpringTable, Task, TitleTable, TranslatingTable
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

WARNING = re.compile(r"^\*\*(?!\d)", re.MULTILINE)
NOT_NUMBERS = re.compile(r"\b(nan|inf|None)\b|-0\.0+\b")


def four_phases(lift: float, angles: tuple[float, ...], laws: tuple[str, str]) -> MotionTable:
    up, high, down, low = angles
    rise, back = RiseTable(up, lift, laws[0]), ReturnTable(down, lift, laws[1])
    return MotionTable((rise, DwellTable(high), back, DwellTable(low)))


def task_of(law: str, **changes) -> Task:
    motion = four_phases(30, (80, 45, 60, 175), (law, law))
    return replace(builtin_task(), motion=motion, **changes)


SEVERAL_RISES = MotionTable((
    RiseTable(60, 10, "cycloidal"), DwellTable(30), RiseTable(60, 15, "cosine"), ReturnTable(90, 25, "3-4-5"),
    DwellTable(120),
))  # fmt: skip
TASKS = {
    **{law: (task_of(law), None) for law in LAWS},
    "given radius": (task_of("3-4-5", cam=CamTable(70.0)), None),
    "free offset, form closure": (
        task_of("cycloidal", follower=TranslatingTable(), limits=LimitsTable(30, 40)), None
    ),
    "no speed": (task_of("2-3", speed_rpm=None), None),
    "knife edge": (task_of("3-4-5", follower=TranslatingTable(10.0, 0.0)), None),
    "several rises": (replace(builtin_task(), motion=SEVERAL_RISES), None),
    "unreadable": (task_of("2-3", cam=CamTable(60.0), limits=LimitsTable(0.5)), None),
    "a hand": (task_of("3-4-5"), Pencil(line=0.2, dividers=0.2)),
    "many hands": (task_of("3-4-5"), Pencil(line=0.2, dividers=0.2, division=0.5, protractor=0.01, samples=5)),
}  # fmt: skip


@pytest.fixture(scope="module")
def builtin():
    return solve(builtin_task())


@pytest.fixture(scope="module")
def builtin_note(builtin):
    return note(builtin)


@pytest.mark.parametrize("name", TASKS)
def test_every_note_is_well_formed(name):
    text = note(solve(*TASKS[name]))
    assert not NOT_NUMBERS.search(text)
    assert text.count("$") % 2 == 0
    headings = re.findall(r"^## (\d+)\. ", text, re.MULTILINE)
    assert headings == [str(k + 1) for k in range(len(headings))]
    # The rows of a table are as wide as its head, cell for cell.
    for block in text.split("\n\n"):
        if block.startswith("| "):
            assert len({tuple(m.start() for m in re.finditer(r"\|", line)) for line in block.splitlines()}) == 1
    assert text.endswith("\n")


@pytest.mark.parametrize(
    "told",
    [
        # closure: 4 h/60^2 over 4 h/80^2 times 50 mm
        "= 88.89\\ \\text{mm}.$$",
        "$$\\mu_\\varphi = \\frac{360^\\circ}{360.00}\\cdot\\frac{\\pi}{180^\\circ} = 0.017453\\ \\text{rad/mm}.$$",
        # v = 2h/F = 42.97 at half the lift: 42.97 - 15 tan 30 = 34.31
        "\\ge 42.97 - 15.00\\tan 30^\\circ = 34.31\\ \\text{mm}.$$",
        "$$r_0 = \\sqrt{s_0^2 + e^2}, \\tag{9}$$",
        "r_0 = \\sqrt{42.11^2 + 10.00^2} = 43.28",
        "Round the minimum radius, 43.28 mm, up to r₀ = 44 mm.",
        "A spring drives the return (force closure)",
        "0.4 r₀ = 17.60 mm",
        "Round 17.60 mm down to 17 mm",
        "the impact is soft",
        "| rise φ₁   | 0.1111 |  0.540 |   9.720 |",
        "Every drawn value lies within its bound.",
        "*Table 1. Motion*",
        "where $\\mu_s$ is the scale of the displacement, mm/mm; $y_s$ is the maximum ordinate of s, mm of paper.",
    ],
)
def test_the_builtin_note_tells(builtin_note, told):
    assert told in builtin_note


def test_the_builtin_note_warns_of_nothing(builtin_note):
    assert not WARNING.search(builtin_note)


def test_one_more_degree_is_worth_two_millimetres(builtin_note):
    """The rise's tangent touches at half the lift, so s0 = (2h/F - e)/tan(A) - h/2."""
    radii = [hypot((60 / radians(80) - 10) / tan(radians(angle)) - 15, 10) for angle in (30, 31)]
    told = f"the minimum radius is {radii[1]:.2f} mm: it changes by −{radii[0] - radii[1]:.2f} mm per degree"
    assert told in builtin_note


def test_every_step_of_the_drawing_is_told_once(builtin_note, builtin):
    steps = [step for construction in builtin.drawn.values() for step in construction.steps()]
    assert len(re.findall(r"^\*\*\d+\.\d+\. ", builtin_note, re.MULTILINE)) == len(steps)
    for step in steps:
        assert builtin_note.count(f"{ENGLISH.text(step.title)}.** {ENGLISH.text(step.parts[0].caption)}") == 1
        assert all(ENGLISH.text(part.caption) in builtin_note for part in step.parts)
        assert ENGLISH.text(step.why) in builtin_note


def test_every_place_of_a_run_with_settings_of_its_own_is_told(builtin_note, builtin):
    cells = {cell.strip() for cell in re.split(r"[|\n]", builtin_note)}
    steps = (step for construction in builtin.drawn.values() for step in construction.steps())
    runs = (part for step in steps for part in step.parts if len({str(row.setting) for row in part.rows}) > 1)
    for run, row in ((each, row) for each in runs for row in each.rows):
        name, setting = ENGLISH.text(row.name), ENGLISH.text(row.setting)
        # What is set nowhere but as is said of all places needs no sentence of its own.
        told = not setting or ENGLISH.text(row.caption) in builtin_note or f" {setting}" in ENGLISH.text(run.caption)
        assert told or {name, setting} <= cells


def test_no_sentence_tells_of_nothing(builtin_note):
    prose = "\n".join(line for line in builtin_note.splitlines() if not line.startswith("|"))
    assert not re.search(r"(?<![\d.])0\.00 mm", prose)


def test_formulas_and_tables_are_numbered_and_letters_explained_once(builtin_note):
    for numbers in (r"\\tag\{(\d+)\}\$\$", r"^\*Table (\d+)\. "):
        found = re.findall(numbers, builtin_note, re.MULTILINE)
        assert len(found) > 10
        assert found == [str(k + 1) for k in range(len(found))]
    told = re.findall(r"(?:where |; )(\$[^$]+\$ is [^;$]*)(?=;|\.\n)", builtin_note)
    assert len(told) > 25
    assert len(set(told)) == len(told)


def test_a_step_has_the_number_that_it_has_on_the_sheet_and_its_chapter_that_of_the_note():
    solution = solve(replace(builtin_task(), speed_rpm=300.0, spring=SpringTable(mass=0.5, stiffness=3.0)))
    contents, said = contents_of(solution), note(solution)
    numbered = re.findall(r"^\*\*(\d+\.\d+)\. (.*?)\.\*\* ", said, re.MULTILINE)
    assert numbered == [(contents.numbers[k], str(step.title)) for k, _, step in contents.steps]
    chapters = re.findall(r"^## (.*)", said, re.MULTILINE)
    assert chapters[0] == "1. Kinematic diagram"
    assert chapters[10:13] == ["11. Contact force", "12. Forces over the turn", "13. Force plan"]


def test_short_runs_are_told_beside_their_sentence_but_for_what_it_tells_itself():
    said = note_of(solve(builtin_arcs_task()))
    (angles,) = re.findall(r"^\*\*2\.2\. .*", said, re.MULTILINE)
    assert "26.888° at G" in angles
    assert "Line O" not in angles
    (joints,) = re.findall(r"^\*\*2\.1\. .*", said, re.MULTILINE)
    assert "From G: on the line from C₃." in joints
    # OK of the station of the plan, and a normal acceleration of the rod: 76.42 mm squared over 54 mm.
    assert "$$v_{10} = 0.5 \\cdot 19.26 = 9.629\\ \\text{mm/rad}.$$" in said
    assert "$$CN_{10} = \\frac{76.42^2}{54.00} = 108.16\\ \\text{mm}" in said


def test_of_a_hand_the_note_says_what_was_adopted_instead():
    """Sizes are those of a hand without error, so the note must not round this hand's readings to them."""
    text = note(solve(*TASKS["a hand"]))
    assert re.search(r"The ideal pencil gives 39\.\d\d mm\.", text)
    assert "The ideal pencil gives 16.00 mm." in text


def test_a_least_radius_that_cannot_be_read_is_said_to_be_so():
    text = note(solve(*TASKS["unreadable"]))
    assert "No cam centre can be read" in text.split("## 4. ")[1].split("## 5. ")[0]
    assert "mm per degree" not in text


def test_too_small_a_given_radius_is_warned_of():
    limits = LimitsTable(30, 30)
    text = note(solve(task_of("cycloidal", cam=CamTable(50.0), limits=limits)))
    assert "The task gives r₀ = 50 mm, smaller than the minimum permitted radius" in text
    assert "**On the return only 30° are permitted, so the limit is exceeded: the given prime radius of 50 mm" in text


def test_an_angle_at_rest_that_is_not_limited_is_told_of():
    limits = LimitsTable(30, rest=False)
    text = note(solve(task_of("cosine", follower=TranslatingTable(-39.0), limits=limits)))
    assert "so the limit is exceeded: it is the angle in the lower dwell, which this task does not limit.**" in text


def test_a_limit_that_only_the_drawing_keeps_is_told_of():
    """The radius is rounded up to so little more that the exact rise, which peaks between stations, exceeds 30°."""
    task = task_of("cycloidal", limits=LimitsTable(30))
    solution = solve(replace(task, drawing=replace(task.drawing, divisions=6, rounding=0.01)))
    exact = degrees(solution.cam.extremes().pressure_angle_rise[0])
    assert exact > 30.05
    told = f"The limit of the rise is satisfied as drawn; exactly the angle is {exact:.2f}°, {exact - 30:.2f}° over."
    assert told in note(solution)


def test_too_large_a_roller_is_warned_of():
    """The pitch curve's least radius of curvature at r0 = 30 is far under 20: cusps, a known case."""
    motion = four_phases(30, (60, 30, 60, 210), ("3-4-5", "3-4-5"))
    task = replace(
        builtin_task(), rotation="ccw", motion=motion, cam=CamTable(30.0), follower=TranslatingTable(5.0, 20.0)
    )
    text = note(solve(task))
    assert "the contact point lies inside another roller circle and is left out: the profile is undercut" in text
    assert "**The profile is undercut at the stations" in text
    covered = text.split("Polar coordinates\n")[1].split("##")[0]
    assert re.search(r"\|\s+– \|\s+– \|$", covered, re.MULTILINE)  # no point of the profile is left there


SOLVED = {
    # Solved problem, roller follower, harmonic, lift 50, 120/30/60, 100 rpm: 0.39 and 0.785 m/s, 6.17 and 24.67 m/s^2
    "valve": (
        four_phases(50, (120, 30, 60, 150), ("cosine", "cosine")), 100.0,
        "| rise φ₁   | 0.2000 |  0.393 |   6.169 |", "| return φ₃ | 0.1000 |  0.785 |  24.674 |",
    ),
    # Lift 30, constant acceleration 120, dwell 30, harmonic 90, 800 rpm: 2.400 and 2.513 m/s, 192.0 and 421.1 m/s^2
    "knife": (
        four_phases(30, (120, 30, 90, 120), ("rectangular", "cosine")), 800.0,
        "| rise φ₁   | 0.0250 |  2.400 | 192.000 |", "| return φ₃ | 0.0187 |  2.513 | 421.103 |",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", SOLVED)
def test_speeds_of_solved_problems(name):
    motion, speed, *rows = SOLVED[name]
    text = note(solve(replace(builtin_task(), motion=motion, speed_rpm=speed)))
    assert all(row in text for row in rows)


def test_without_a_speed_there_are_no_times():
    assert "Times, velocities" not in note(solve(task_of("cosine", speed_rpm=None)))


def sprung(preload: float | None) -> str:
    """The chapter on the spring of Voloder, Cohodar and Karic: it needs 69.2296 N just before 45 degrees."""
    motion = four_phases(30, (45, 45, 45, 225), ("cosine", "cosine"))
    follower, spring = TranslatingTable(0.0), SpringTable(0.2, 3.0, preload)
    text = note(solve(replace(builtin_task(), motion=motion, speed_rpm=550, follower=follower, spring=spring)))
    chapter = re.split(r"^## \d+\. ", text.split(". Contact force\n")[1], flags=re.MULTILINE)[0]
    assert not NOT_NUMBERS.search(chapter)
    return chapter


def test_an_open_preload_is_told_to_be_the_least_one():
    text = sprung(None)
    assert "A preload of at least 69.23 N keeps contact over the whole turn; it is needed at φ = 45°." in text
    assert "The preload is adopted as $F_0 = 69.23$ N. The minimum contact force is 0.00 N, just before 45°." in text
    assert not WARNING.search(text)


def test_a_loss_of_contact_is_warned_of():
    text = sprung(60.0)
    assert "The preload is given as $F_0 = 60.00$ N. The minimum contact force is −9.23 N, just before 45°." in text
    assert re.search(r"\*\*Contact is lost, φ = 39\.20\d*° to 45° and 90° to 95\.79\d*°: the", text)


@pytest.mark.parametrize(
    ("pencil", "advice"),
    [
        (Pencil(), "draw such a value with more parts."),
        (Pencil(line=0.2), "this is the scatter of the drawing errors, which seldom exceeds 3 standard deviations."),
    ],
)
def test_what_lies_outside_its_bound_is_blamed_on_the_parts_or_on_the_hand(pencil, advice):
    solution = solve(task_of("3-4-5"), pencil)
    smaller = replace(solution, cam=replace(solution.cam, prime_radius=solution.cam.prime_radius - 8))
    assert re.search(rf"Outside the bound: .*pressure angle, rise.*; {advice}", comparison_file(smaller))


def test_without_a_spring_there_is_no_chapter_on_it(builtin_note):
    assert ". Spring\n" not in builtin_note


def test_titles_are_not_taken_for_markup():
    title = TitleTable(name="Cam *A* | $2", author="N. _N_")
    text = note(solve(replace(builtin_task(), title=title)))
    assert text.startswith("# Cam \\*A\\* \\| \\$2: calculation note\n\nAuthor: N. \\_N\\_\n")
