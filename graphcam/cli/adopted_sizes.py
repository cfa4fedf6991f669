"""What ``graphcam solve`` says of the sizes of the cam that was drawn, and which of them the task gave."""

from __future__ import annotations

from typing import TYPE_CHECKING

from graphcam.words import Caption, Words, say, sequence

if TYPE_CHECKING:
    from graphcam.solving.arcs_solution import AnySolution
    from graphcam.solving.solution import Solution

GIVEN, FOUND, MINIMUM = say("given"), say("found"), say("minimum")


def adopted_sizes(solution: AnySolution) -> Caption | None:
    """The adopted sizes, each with where it comes from; None of a cam of arcs, whose sizes are all given.

    >>> import graphcam as gc
    >>> print(adopted_sizes(gc.solve(gc.builtin_task())))
    adopted: prime radius 44 mm (found), offset -10 mm (given), roller radius 17 mm (found)
    """
    from graphcam.solving.solution import Solution

    if not isinstance(solution, Solution):
        return None
    return say("adopted: {sizes}", sizes=sequence([*_of_cam(solution), *_of_spring(solution)]))


def _of_cam(solution: Solution) -> list[Caption]:
    chain, board = solution.chain, solution.chain.board
    given = {size.name: size.value for size in board.follower.sizes(board.follower.place, board.roller_radius)}
    said = [_size(say("prime radius"), chain.prime_radius, say("mm"), FOUND if board.prime_radius is None else GIVEN)]
    for size in board.follower.sizes(chain.place, solution.cam.roller_radius):
        if size.value is not None:
            where = FOUND if given[size.name] is None else GIVEN
            said += [_size(size.title, size.value, say("mm"), where)]
    return said


def _of_spring(solution: Solution) -> list[Caption]:
    spring = solution.spring
    if spring is None:
        return []
    from graphcam.drafting.units import unit

    where = MINIMUM if spring.open_preload else GIVEN
    return [_size(say("preload"), spring.load.preload, unit(spring.units[1]), where)]


def _size(name: Words, value: float, of: Words, where: Words) -> Caption:
    # No powers of ten: four digits, and zeros.
    told = float(f"{value:.4g}") if where is MINIMUM else value
    return say("{name} {value:.12g} {unit} ({where})", name=name, value=told, unit=of, where=where)
