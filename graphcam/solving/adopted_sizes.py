"""What the exact side says of adopted sizes: one rounded up from a drawn minimum may be too small all the same.

A drawn minimum is as good as its divisions.  The size that was adopted stays, because the drawing is honest; a warning
says by how much it misses the exact limit, and names a division and a size with which it would not.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from itertools import product
from typing import Any

from graphcam.constructions.adoption import multiple, steps_up
from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.solving.solution_warnings import PRINT_ROUNDING, Caution, angles_exceeded
from graphcam.words import Caption, Words, and_list, say, sequence

DIVISION_FACTORS = (2, 3, 4)
"""Times as many divisions, of which the first that helps is named."""
MAX_DIVISIONS = 72
"""Divisions of a phase; nobody draws more."""
FURTHER_MULTIPLES = 4
"""How many multiples of the rounding are tried on from the first radius that may help."""
PLACE_MULTIPLES = (0, 1, -1, 2, -2)
"""The multiples to either side of an adopted offset or centre distance that are tried."""
ARITHMETIC_TOLERANCE = 1e-9
"""mm or degrees: what a size that is named as a remedy may miss a limit by, for the arithmetic."""


Sides = tuple[float, float]
"""Lengths to the left and to the right of the follower's axis [mm]."""


@dataclass(frozen=True)
class FaceDesign:
    """A flat face with a margin on each side.

    drawn, exact : how far the contact wanders
    margin : mm, beyond the contact on each side
    rounding : mm, the adopted half-widths are multiples of it
    """

    drawn: Sides
    exact: Sides
    margin: float
    rounding: float

    @property
    def least(self) -> Sides:
        """The drawn half-widths with the margin [mm]."""
        left, right = self.drawn
        return left + self.margin, right + self.margin

    @property
    def adopted(self) -> Sides:
        """The half-widths, rounded up [mm].

        >>> FaceDesign((24.78, 24.08), (25.0, 24.2), 3.0, 1.0).adopted
        (28.0, 28.0)
        """
        left, right = (multiple(steps_up(side, self.rounding), self.rounding) for side in self.least)
        return left, right

    @property
    def wide_enough(self) -> bool:
        """Whether the adopted face has the margin beyond the exact contact too."""
        return all(
            exact + self.margin <= adopted + PRINT_ROUNDING
            for exact, adopted in zip(self.exact, self.adopted, strict=True)
        )

    def to_dict(self) -> dict[str, Any]:
        """The face as plain data [mm]."""
        sides = zip(("left", "right"), self.drawn, self.exact, self.adopted, strict=True)
        told = {side: {"drawn": drawn, "exact": exact, "adopted": adopted} for side, drawn, exact, adopted in sides}
        return {"margin": self.margin, **told, "width": sum(self.adopted)}


def face_design(chain: Chain, exact: Sides, margin: float) -> FaceDesign:
    """The face that a drawing proposes.

    exact : how far the contact wanders, to the left and to the right;  margin : beyond that [mm]
    """
    drawn = chain.perfect["inversion"]
    left, right = (float(drawn.value(f"face_{side}")) for side in ("left", "right"))
    return FaceDesign((left, right), exact, margin, chain.rounding)


def adopted_cautions(chain: Chain, cam: Cam, face: FaceDesign | None = None) -> list[Caution]:
    """What is wrong with the sizes that the drawing proposed; nothing where they satisfy the exact limits.

    chain : whose sizes were adopted;  cam : built with them;  face : of a flat-faced follower, where one is adopted
    """
    return [*_radius(chain, cam), *_roller(chain, cam), *_face(chain, face)]


def _satisfies(cam: Cam, board: Board, slack: float) -> bool:
    """Whether a cam satisfies every limit of the task but for ``slack`` [degrees, mm]."""
    rho = cam.extremes().min_convex_radius[0]
    sharpest = board.follower.conditions.get("curvature")
    if sharpest is None and (permitted := board.needed_profile_radius) is not None:
        roller = _by_rule(board, cam) if board.roller_radius is None else board.roller_radius
        sharpest = permitted + max(roller, 0.0)
    if sharpest is not None and rho < sharpest - slack:
        return False
    return not any(angles_exceeded(cam, board, slack))


# --- prime radius and place ------------------------------------------------------------------------------------------


def _radius(chain: Chain, cam: Cam) -> Iterator[Caution]:
    board = chain.board
    decided = board.prime_radius is not None and board.follower.place is not None
    if decided or _satisfies(cam, board, PRINT_ROUNDING):
        return
    radius, least = chain.prime_radius, _exact_least_radius(chain)
    if board.prime_radius is None and least > radius and chain.trials:
        said = say("The prime radius of {radius:g} mm{there} is smaller than the exact minimum, {least:.5g} mm.")
        said = said.with_values(least=least)
    elif board.prime_radius is None and least > radius:
        drawn = chain.adopted().least
        said = say(
            "The adopted prime radius of {radius:g} mm is smaller than the exact minimum{there}, {least:.5g} mm: the "
            "drawn one, {drawn:.5g} mm, is {short:.3g} mm too small."
        ).with_values(least=least, drawn=drawn, short=least - drawn)
    else:
        said = say("The prime radius of {radius:g} mm{there} does not satisfy the exact limits.")
    remedies = _remedies(chain)
    if board.prime_radius is not None and not remedies:  # it is too small at any place, which is told of a given one
        return
    told = [
        said.with_values(radius=radius, there=_place_words(chain)),
        *_curvature_remarks(cam, board),
        _take(remedies),
    ]
    yield Caution(sequence(told, " "), "prime radius")


def _place_words(chain: Chain) -> Words:
    """The words for the adopted place beside which a radius is told."""
    name = chain.board.follower.place_name
    return (
        PLACE_CAPTIONS[name].with_values(place=chain.place)
        if name in PLACE_CAPTIONS and "curvature" not in chain.board.follower.conditions
        else ""
    )


PLACE_CAPTIONS = {
    "offset": say(" at the offset of {place:g} mm"),
    "distance": say(" at the centre distance of {place:g} mm"),
}


def _limit_arguments(chain: Chain) -> dict[str, Any]:
    """What the exact least radius is asked for at the adopted place."""
    asked = asdict(chain.board.limits) | dict(chain.board.follower.conditions)
    if (permitted := chain.board.needed_profile_radius) is not None:
        asked["curvature"] = permitted
    return asked | ({"offset": chain.place} if "offset" in asked else {})


def _exact_least_radius(chain: Chain) -> float:
    """The exact least prime radius at the adopted place [mm]; NaN where that satisfies no limits."""
    board = chain.board
    # A roller that is open is smaller where the profile would be too sharp.
    follower = board.follower.built(chain.place, board.roller_radius or 0.0)
    with suppress(DesignError):
        return minimum_radius(board.motion, follower, board.rotation, **_limit_arguments(chain)).prime_radius
    return math.nan


def _curvature_remarks(cam: Cam, board: Board) -> list[Caption]:
    """The sentence on a radius of curvature below the permitted one; the pressure angle has a warning of its own."""
    least, rho = board.follower.conditions.get("curvature"), cam.extremes().min_convex_radius[0]
    if not least or rho >= least:
        return []
    return [say("The radius of curvature falls to {rho:.2f} mm; {least:g} mm are required.", rho=rho, least=least)]


def _remedies(chain: Chain) -> list[Words]:
    """What satisfies the exact limits: more divisions, or other sizes."""
    finer = _divisions(
        chain, lambda other: _satisfies(_exact_cam(chain, *_sizes(other)), chain.board, ARITHMETIC_TOLERANCE)
    )
    return [*finer, *_other_sizes(chain)]


def _sizes(chain: Chain) -> tuple[float, float]:
    return chain.prime_radius, chain.place


def _exact_cam(chain: Chain, radius: float, place: float) -> Cam:
    """The exact cam of these sizes, on whose pitch curve a roller has no influence."""
    return Cam(chain.board.motion, chain.board.follower.built(place, 0.0), radius, chain.board.rotation)


def _other_sizes(chain: Chain) -> list[Words]:
    """The next round sizes within the exact limits, none if they are farther."""
    board, step, least = chain.board, chain.rounding, _exact_least_radius(chain)
    first = max(chain.prime_radius, 0.0 if math.isnan(least) else least)
    radii = [multiple(steps_up(first, step) + k, step) for k in range(FURTHER_MULTIPLES)]
    places = [chain.place + step * k for k in PLACE_MULTIPLES]
    radii = radii if board.prime_radius is None else [chain.prime_radius]
    places = places if board.follower.place is None else [chain.place]
    for radius, place in product(radii, places):
        with suppress(DesignError):
            if _satisfies(_exact_cam(chain, radius, place), board, ARITHMETIC_TOLERANCE):
                return [_named_sizes(chain, radius, place)]
    return []


def _named_sizes(chain: Chain, radius: float, place: float) -> Words:
    """The words for these sizes, as far as the task leaves them open."""
    sizes = {"prime_radius": radius} if chain.board.prime_radius is None else {}
    if chain.board.follower.place is None:
        sizes[chain.board.follower.place_name] = place
    return and_list([SIZE_WORDS[name].with_values(length=length) for name, length in sizes.items()])


SIZE_WORDS = {
    "prime_radius": say("a prime radius of {length:g} mm"),
    "offset": say("an offset of {length:g} mm"),
    "distance": say("a centre distance of {length:g} mm"),
    "roller_radius": say("a roller radius of {length:g} mm"),
    "divisions": say("{count} parts in each phase"),
}
"""What a remedy takes, in the words of a drawing."""


# --- roller and face -------------------------------------------------------------------------------------------------


def _roller(chain: Chain, cam: Cam) -> Iterator[Caution]:
    board, adopted = chain.board, chain.roller_radius
    if board.motion.corners:  # of which no roller keeps clear
        return
    if board.roller_radius is not None or not cam.kinematics.takes_roller:
        return
    rho = cam.extremes().min_convex_radius[0]
    most = _by_rule(board, cam)
    if not adopted > most + PRINT_ROUNDING:
        return
    said = say(
        "The adopted roller radius of {radius:g} mm is larger than the rule permits, {most:.5g} mm with the exact "
        "minimum radius of curvature, {rho:.5g} mm. {remedy}"
    )
    smaller = multiple(math.floor(most / chain.rounding + ARITHMETIC_TOLERANCE), chain.rounding)
    takes = [SIZE_WORDS["roller_radius"].with_values(length=smaller)] if smaller > 0 else []
    finer = _divisions(chain, lambda other: other.roller_radius <= _by_rule(board, _exact_cam(chain, *_sizes(other))))
    yield Caution(said.with_values(radius=adopted, most=most, rho=rho, remedy=_take([*finer, *takes])), "roller radius")


def _by_rule(board: Board, cam: Cam) -> float:
    rho = cam.extremes().min_convex_radius[0]
    return min(term(rho=rho, r0=cam.prime_radius) for term in board.roller_rule)


def _face(chain: Chain, face: FaceDesign | None) -> Iterator[Caution]:
    if face is None:
        return
    for adopted, exact, said in zip(face.adopted, face.exact, FACE_REMARKS, strict=True):
        if (least := exact + face.margin) > adopted + PRINT_ROUNDING:
            finer = _divisions(chain, lambda other: face_design(other, face.exact, face.margin).wide_enough)
            wider = say("{length:g} mm", length=multiple(steps_up(least, face.rounding), face.rounding))
            remedy = _take([*finer, wider])
            yield Caution(said.with_values(adopted=adopted, least=least, margin=face.margin, remedy=remedy), "face")


FACE_REMARKS = (
    say(
        "The adopted face, {adopted:g} mm to the left, is smaller than the exact minimum with its margin of "
        "{margin:g} mm, {least:.5g} mm. {remedy}"
    ),
    say(
        "The adopted face, {adopted:g} mm to the right, is smaller than the exact minimum with its margin of "
        "{margin:g} mm, {least:.5g} mm. {remedy}"
    ),
)


# --- remedies --------------------------------------------------------------------------------------------------------


def _divisions(chain: Chain, helps: Callable[[Chain], bool]) -> list[Words]:
    """The number of divisions with which the drawing proposes sizes that satisfy the limits; none if too many."""
    given = chain.board.divisions
    for count in (times * given for times in DIVISION_FACTORS if times * given <= MAX_DIVISIONS):
        with suppress(DesignError):
            if helps(Chain(replace(chain.board, divisions=count, finer={}))):
                return [SIZE_WORDS["divisions"].with_values(count=count)]
    return []


def _take(remedies: list[Words]) -> Caption:
    """The remedies in a sentence, of which there are two at most."""
    match remedies:
        case [first, second]:
            return say("Take {first}, or {second}.", first=first, second=second)
        case [one]:
            return say("Take {one}.", one=one)
        case _:
            return say("Take more divisions, or give the size yourself.")
