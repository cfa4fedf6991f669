"""The kinematic diagram and the data: what is given, and what is to be found, before the first line is drawn."""

from __future__ import annotations

from dataclasses import dataclass

from graphcam.constructions.axes import degrees, phase_title
from graphcam.constructions.board import Board
from graphcam.constructions.law_names import law_title
from graphcam.constructions.views import SCHEME
from graphcam.drafting.ink import Caption, Construction, Part, Step, Words, say
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.motion import Motion
from graphcam.words import and_list, sequence


@dataclass(frozen=True, eq=False)
class SchemeGivens:
    """What lies on the board before the first line."""

    board: Board


MEANING = Meaning(
    "scheme",
    say("Kinematic diagram"),
    say(
        "The kinematic diagram shows how the links are joined, and names the points and the sizes. It is a "
        "sketch, not to scale, with a simplified cam, because the profile is only found at the end."
    ),
)
REASON = say("Everything that follows is drawn from these data and uses the point names of this diagram.")


def scheme(board: Board, pencil: Pencil) -> Construction[SchemeGivens]:
    """Draw cam, follower and frame, with the data of the task."""
    return Construction(MEANING, SchemeGivens(board), pencil, {}, {}, _draw)


def _draw(drawn: Construction[SchemeGivens]) -> list[Step]:
    board = drawn.givens.board
    marks = board.follower.scheme(board.rotation, board.roller_radius)
    said = sequence(data_sentences(board), " ")
    # All of it is given, so that it stands on a worksheet too.
    return [Step(say("Kinematic diagram and data"), (Part(said),), SCHEME, marks, given=marks, why=REASON)]


PROFILE_LIMIT = say("The radius of curvature of the profile is to be at least {least:g} mm.")


def data_sentences(board: Board) -> list[Caption]:
    """Sentences on what the task gives and asks for."""
    follower, r0, least = board.follower, board.prime_radius, board.min_profile_radius
    phases = sequence([_phase(board.motion, k, follower.unit) for k in range(len(board.motion.phases))], "; ")
    return [
        *follower.described(board.rotation, board.roller_radius),
        *([] if r0 is None else [say("The prime radius is r₀ = {radius:g} mm.", radius=r0)]),
        say("One turn of the cam: {phases}.", phases=phases),
        follower.limited(board.limits),
        *([] if least is None else [PROFILE_LIMIT.with_values(least=least)]),
        say("To be found: {sizes}.", sizes=and_list(_open_sizes(board))),
    ]


def _phase(motion: Motion, k: int, unit: str) -> Caption:
    phase, named = motion.phases[k], {"phase": phase_title(motion, k), "angle": degrees(motion.phases[k].angle)}
    if not phase.lift:
        return say("{phase} = {angle}", **named)
    lift = degrees(phase.lift) if unit == "rad" else say("{length:g} mm", length=phase.lift)
    return say("{phase} = {angle} by {lift} (law: {law})", **named, lift=lift, law=law_title(motion, k))


SYMBOLS = {
    "offset": say("offset e"),
    "distance": say("centre distance c"),
    "roller_radius": say("roller radius r"),
}
"""The sizes of a follower that a task may leave open, by their names."""


def _open_sizes(board: Board) -> list[Words]:
    """The names of the sizes that the task leaves open, and of the profile."""
    follower = board.follower
    has = [size.name for size in follower.sizes(0.0, 0.0) if size.value is not None]
    given = {size.name: size.value for size in follower.sizes(follower.place, board.roller_radius)}
    radius = [say("prime radius r₀")] if board.prime_radius is None else []
    return [*radius, *(SYMBOLS.get(name, name) for name in has if given[name] is None), say("the profile of the cam")]
