"""What is lit beside a part: what it was found from at once, and nothing that was only a scale or lay there."""

from __future__ import annotations

import pytest

import graphcam as gc
from graphcam.drafting.act_order import FollowedBoard, Moves, visible_places


@pytest.fixture(scope="module")
def lit() -> dict[tuple[str, str], list[Moves]]:
    """The moves of the steps of the course work, by construction and title."""
    solution = gc.solve(gc.builtin_task("coursework"))
    names = ("acceleration", "integration", "minimum_radius", "pressure_angle")
    steps = [(name, step) for name in names for step in solution.drawn[name].steps()]
    board = FollowedBoard(visible_places(step for _, step in steps))
    return {(name, str(step.title)): board.followed(step) for name, step in steps}


def names_of(moves: Moves) -> dict[str, tuple[int, ...]]:
    return {piece.act.name: piece.at for piece in moves.lit}


def test_in_whose_scale_a_length_is_laid_off_is_not_lit(lit):
    upright = names_of(lit["minimum_radius", "The minimum prime radius"][0])
    assert set(upright) == {"start of the lift"}
    assert not any(
        "curve" in name for name in names_of(lit["pressure_angle", "The cam centre at the adopted radius"][1])
    )


def test_a_curve_is_lit_by_the_points_of_its_own_piece(lit):
    first, second, *_ = lit["minimum_radius", "Curves of rise and return"]
    assert names_of(first) == {"ends": tuple(range(7))}
    assert names_of(second) == {"ends": tuple(range(6, 13))}


def test_a_part_that_only_reckons_lights_nothing(lit):
    for scale in ("s", "v", "a"):
        assert {moves.lit for moves in lit["integration", f"The scale of {scale}"][:1]} == {()}


def test_the_velocity_of_the_plan_is_lit_in_the_combined_diagram(lit):
    (plan,) = (moves for (_, title), moves in lit.items() if title.startswith("Velocity plan"))
    assert names_of(plan[1]) == {"p": (0,), "ends": (6,), "displacements": (6,)}
