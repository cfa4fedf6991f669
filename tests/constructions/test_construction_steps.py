"""What a reader sees: every step of every construction says in whole sentences what is drawn, and draws it."""

from __future__ import annotations

import dataclasses
import math
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from boards import (
    arm_board,
    arm_motion,
    arm_motion_of,
    board_of,
    coursework,
    flat_board,
    flat_motion,
    limits,
    motion_of,
)
from over_all import over_all

from graphcam.constructions import views
from graphcam.constructions.chain import Board, Chain
from graphcam.drafting.ink import Caption, Step, View
from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import LAWS
from graphcam.given.roller_rule import roller_rule

SEVERAL = motion_of(
    (10, 40, "3-4-5"), (0, 20), (20, 80, "cosine"), (-25, 60, "2-3"), (15, 60, "cycloidal"), (-20, 100, "triangular")
)
UNDERCUT = motion_of((30, 60, "3-4-5"), (0, 30), (-30, 60, "3-4-5"))
BOARDS: dict[str, Board] = {
    **{law: coursework(law) for law in LAWS},
    "unequal parts": coursework("rectangular", 2.5),
    "turning ccw": coursework("3-4-5", rotation="ccw", offset=10.0),
    "unfavourable offset": coursework("3-4-5", offset=10.0),
    "central": coursework("3-4-5", offset=0.0),
    "free offset": coursework("3-4-5", offset=None),
    "form closure": coursework("3-4-5", offset=None, limits=limits(30, 40)),
    "no rest line": coursework("3-4-5", offset=None, limits=limits(30, rest=False)),
    "large offset, no rest line": coursework("3-4-5", offset=-60.0, limits=limits(30, rest=False)),
    "limit of 89.5 degrees": coursework("3-4-5", offset=0.0, limits=limits(89.5)),
    "knife edge": coursework("3-4-5", roller_radius=0.0),
    "all given": coursework("cosine", prime_radius=50.0, roller_radius=12.0),
    "another rule": coursework("cosine", roller_rule=roller_rule("rho - 4")),
    "dwell first": board_of(motion_of((0, 30), (30, 80, "3-4-5"), (0, 40), (-30, 100, "cosine"))),
    "return first": board_of(motion_of((-30, 80, "3-4-5"), (0, 40), (30, 100, "cosine"))),
    "no dwell": board_of(motion_of((30, 180, "cosine"), (-30, 180, "3-4-5")), offset=0.0),
    "several rises": board_of(SEVERAL),
    "below the start": board_of(motion_of((10, 40, "3-4-5"), (-30, 100, "cosine"), (20, 80, "cosine"))),
    "undercut": board_of(UNDERCUT, rotation="ccw", offset=5.0, prime_radius=30.0, roller_radius=20.0, divisions=24),
    "tiny lift": board_of(motion_of((1e-3, 100, "3-4-5"), (-1e-3, 100, "3-4-5")), offset=None),
    **{f"3-4-5 in {n}": coursework("3-4-5", divisions=n) for n in (2, 3)},
    **{f"rectangular in {n}": coursework("rectangular", divisions=n) for n in (1, 2, 3, 96)},
}
ARMS: dict[str, Board] = {
    **{f"arm, {lift} degrees": arm_board(arm_motion("3-4-5", lift), None) for lift in (5.0, 40.0)},
    **{f"arm, {law}": arm_board(arm_motion(law), rotation="cw") for law in [*LAWS][::3]},
    "arm, all given": arm_board(arm_motion("cosine"), prime_radius=50.0, roller_radius=12.0),
    "arm, form closure": arm_board(arm_motion("cosine"), None, limits=limits(45, 40)),
    "arm, no rest line": arm_board(arm_motion("cosine"), None, limits=limits(45, rest=False)),
    "arm, large swing, no rest line": arm_board(arm_motion("cosine", 60.0), None, limits=limits(15, rest=False)),
    "arm, limits that nothing keeps": arm_board(arm_motion("cosine"), 30.0, limits=limits(20), prime_radius=85.0),
    "arm, knife edge": arm_board(arm_motion("2-3"), roller_radius=0.0),
    "arm, undercut": arm_board(arm_motion("3-4-5", 30.0), 120.0, prime_radius=40.0, roller_radius=30.0, divisions=24),
    "arm, several rises": arm_board(
        arm_motion_of((8, 60, "3-4-5"), (0, 20), (12, 80, "cosine"), (-12, 60, "2-3"), (-8, 100, "cycloidal")), None
    ),
    "arm, dwell first": arm_board(arm_motion_of((0, 30), (20, 80, "3-4-5"), (0, 40), (-20, 100, "cosine")), None),
    "arm, return first": arm_board(arm_motion_of((-20, 80, "3-4-5"), (0, 40), (20, 100, "cosine")), None),
    **{f"arm, rectangular in {n}": arm_board(arm_motion("rectangular"), None, divisions=n) for n in (1, 2, 3)},
    "arm of 1 m": arm_board(arm_motion("cosine"), None, 1000.0),
}
FLATS: dict[str, Board] = {
    **{f"flat, {law}": flat_board(flat_motion(law)) for law in [*LAWS][1::3]},
    "flat, unequal parts": flat_board(flat_motion("rectangular", 2.5), rotation="cw"),
    "flat, given": flat_board(flat_motion("cosine"), prime_radius=60.0),
    "flat, too small": flat_board(flat_motion("cycloidal"), prime_radius=15.0),
    "flat, slow": flat_board(motion_of((2, 170, "cosine"), (-2, 170, "cosine"))),
    "flat, any radius will do": flat_board(motion_of((1, 180, "2-3"), (-1, 180, "2-3")), 0.0, prime_radius=20.0),
    "flat, several rises": flat_board(SEVERAL),
    "flat, dwell first": flat_board(motion_of((0, 30), (30, 80, "3-4-5"), (0, 40), (-30, 100, "cosine"))),
    "flat, return first": flat_board(motion_of((-30, 80, "3-4-5"), (0, 40), (30, 100, "cosine"))),
    **{f"flat, rectangular in {n}": flat_board(flat_motion("rectangular"), divisions=n) for n in (1, 2, 3)},
}
BOARDS |= ARMS | FLATS
"""Every follower, kind of law and hand, and what is hard to draw; every law where the follower is a translating one."""
NAMES = over_all("name", BOARDS)
HANDS = [
    Pencil(),
    Pencil(line=0.2, dividers=0.2, division=0.5, protractor=math.radians(0.5), seed=1),
    Pencil(line=0.2, dividers=0.2, protractor=math.radians(0.5), samples=3, seed=2),
]
every_hand = over_all(
    ("name", "pencil"),
    [(name, HANDS[0]) for name in BOARDS] + [(name, each) for name in [*BOARDS][::8] for each in HANDS[1:]],
)
"""Every board by the ideal pencil, every eighth by the others."""


@cache
def steps_of(board: Board, pencil: Pencil) -> list[Step]:
    return [step for construction in Chain(board, pencil).values() for step in construction.steps()]


@every_hand
def test_every_step_has_a_title_and_whole_sentences(name, pencil):
    for step in steps_of(BOARDS[name], pencil):
        title, caption = str(step.title), str(step.caption)
        assert re.fullmatch(r"[A-Z].*[^.\s]", title), title
        assert re.fullmatch(r"[A-Z].*\.", caption), caption
        for text in (title, caption):
            assert not re.search(r"\b(nan|inf|None)\b|[{}\n]|  |[( ],|\(\)|\s\.", text), text


@every_hand
def test_every_mark_lies_on_the_paper(name, pencil):
    """No mark has a place, a radius or an angle that is not finite; text has no trace of one either."""
    for step in steps_of(BOARDS[name], pencil):
        for mark in step.marks:
            for key, value in fields(mark).items():
                if isinstance(value, str | Caption):
                    assert not re.search(r"\b(nan|inf)\b", str(value)), (str(step.title), mark)
                else:
                    assert np.isfinite(value).all(), (str(step.title), type(mark).__name__, key)


def fields(mark: Any) -> dict[str, Any]:
    names = {entry.name for entry in dataclasses.fields(mark)} - {"of", "index"}
    return {name: getattr(mark, name) for name in names}


def everything(step: Step) -> str:
    """What is said of a step, and in the rows of its runs."""
    rows = [str(row.caption) for part in step.parts for row in part.rows]
    return " ".join([str(step.caption), *rows])


def test_the_captions_carry_the_numbers_of_the_built_in_task():
    """Paper millimetres, the scale and the value stand in the sentence."""
    chain = Chain(coursework())
    captions = {name: " ".join(everything(step) for step in chain[name].steps()) for name in chain}
    mu_s = float(chain["integration"].readings["s"].scale)
    expected = {
        "acceleration": [
            "360.0 mm",
            "0.01745 rad/mm",
            "(80°/60°)² = 88.9 mm",
            "rise φ₁ rectangular, return φ₃ rectangular",
        ],
        "integration": ["H₁ = 40.0 mm", "H₂ = 40.0 mm", f"mm = {mu_s:.5g} mm/mm", "known lift of 30 mm"],
        "minimum_radius": [
            "at 30° to",
            "× 0.6 = 43.280 mm = r₀",
            "e = -10.000 mm",
            "42.109 mm = s₀",
            "spring",
            "here at 6.",
        ],
        "pressure_angle": ["43.28 mm, up to r₀ = 44 mm", "44/0.6 = 73.33 mm", "e = -10 mm", "Ray 4: 20.64°", "40.68°"],
        "angle_diagram": ["1° a millimetre"],
        "inversion": [
            *("Set the compass to 44.0 mm (r₀ = 44 mm at 1:1)", "Set the compass to 10.0 mm (|e| = 10 mm at 1:1)"),
            *(
                "With e = -10 mm draw the vertical from the left end of",
                "up to the prime circle: line 0",
                "The cam turns clockwise",
                "follower the other way, anticlockwise",
            ),
            *("6.67° in φ₁, 5° in φ₃", "station 4 at 26.67°"),
            *("0.6 mm × 1 = 0.6 mm here", "station 4: 11.11 mm × 0.6 = 6.67 mm", "In the dwell φ₂: compass 73.5 mm"),
        ],
        "curvature": [
            "here station 0′, at φ = 125.0°",
            "step off 0.875 parts before and after it",
            "P is the image of the point of the curve there",
            "OB measures 60.07 mm",
            "ρ = 30.036 mm",
            "may be off by 56 %",
            "step off 1.75 parts instead: with chords of 11.4 mm ρ may be off by 14 %, and they give ρ = 30.3 mm",
        ],
        "roller": ["0.4 r₀ = 17.60 mm"],
        "working_profile": [
            *("Round 17.60 mm down to 17 mm", "Set the compass to 17.0 mm (r = 17 mm at 1:1)"),
            "80°, 45°, 60°, 175°",
            *("29.7° (29.7° in the diagram)", "I 57.3 mm from A, 49.3° (49.3° in the diagram)"),
        ],
    }
    for name, parts in expected.items():
        for part in parts:
            assert part in captions[name], (part, captions[name])


def test_the_steps_of_the_chain_draw_every_view():
    seen = {step.view.name for step in steps_of(BOARDS["3-4-5"], Pencil())}
    arms = {views.REGION.name, views.ARM_ANGLES.name, views.CAM_CENTRE.name}
    # Drawn with a spring, where it is asked for, and of a given cam.
    others = {*arms, views.FORCES.name, views.JERK.name, views.ANALYSIS.name}
    assert seen == {v.name for v in vars(views).values() if isinstance(v, View)} - others


def test_a_place_of_the_sharpest_bend_inside_a_dwell_is_named_so():
    board = board_of(motion_of((2, 120, "3-4-5"), (0, 60), (-2, 120, "3-4-5")), offset=0.0, prime_radius=46.0)
    chain = Chain(board)
    moving, resting = chain["curvature"].readings["rho_candidates"].value
    caption = str(chain["curvature"].steps()[0].caption)
    assert ("the middle of a dwell" in caption) == bool(resting < moving)
    slow = board_of(motion_of((30, 160, "3-4-5"), (-30, 160, "3-4-5")), offset=0.0, prime_radius=15.0)
    assert "the middle of a dwell" in str(Chain(slow)["curvature"].steps()[0].caption)


def test_where_the_moving_phases_have_too_few_points_only_the_rests_are_compared_and_it_is_said():
    """In two parts a rectangular phase jumps between them: no three points lie on a smooth piece."""
    phases = (30, 80, "rectangular"), (0, 45), (-30, 60, "rectangular")
    for parts in (2, 12):
        curved = Chain(board_of(motion_of(*phases), divisions=parts, prime_radius=44.0))["curvature"]
        caption = str(curved.steps()[0].caption)
        assert ("only the dwells are compared" in caption) == (parts == 2)
        assert ("the middle of a dwell (φ₄)" in caption) == (parts == 2)


@pytest.mark.parametrize(
    ("board", "expected"),
    [
        (
            arm_board(arm_motion("rectangular", 15.0), 150.0, 125.0, prime_radius=61.0, roller_radius=15.0),
            {
                "integration": ["known lift of 0.261799 rad"],
                "minimum_radius": [
                    "At 1:1 the arm is 125.0 mm long",
                    "The largest angle is 15.00°",
                    "on the rise away from C",
                    "the line at 45° to its normal",
                ],
                "pressure_angle": ["At 1:2 draw AC horizontally, 75.0 mm long", "ψ₀ + s = 23.45° + 7.50° = 30.95°"],
                "inversion": ["r₀ = 61 mm", "c = 150 mm", "= 7.50°, a chord of 8.18 mm"],
            },
        ),
        (
            flat_board(flat_motion("3-4-5"), rotation="cw"),
            {
                "minimum_radius": [
                    "set square at 45°",
                    "arctan(μₐ/μₛ) = 64.0°",
                    "ρ = 8 mm: r₀ = 8 + 28.038 = 36.038 mm",
                ],
                "inversion": [
                    "Round the minimum radius, 36.038 mm, up to r₀ = 37 mm",
                    "The cam turns clockwise",
                    "on a rise to the left, seen from the cam centre",
                    "26.77 mm and 32.12 mm",
                ],
                "curvature": ["crossing of the axes straight down"],
            },
        ),
    ],
    ids=["arm", "flat"],
)
def test_the_captions_carry_the_numbers_of_arm_and_flat_face(board, expected):
    chain = Chain(board)
    for name, parts in expected.items():
        caption = " ".join(everything(step) for step in chain[name].steps())
        for part in parts:
            assert part in caption, caption


def test_only_a_flat_face_has_no_pressure_angle_and_no_roller():
    arm, flat = (Chain(board) for board in (arm_board(arm_motion("cosine")), flat_board(flat_motion("cosine"))))
    assert set(arm) == set(Chain(coursework()))
    assert set(arm) - set(flat) == {"pressure_angle", "angle_diagram", "roller"}
