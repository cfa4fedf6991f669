"""The catalogue of mistakes: each is the drawing of a student who does everything right but for that one thing.

A mistake is a function from the right drawing to a wrong one, with what is said to who made it.  Most change what was
given to one construction and go on from there; some change how a length was read.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.law_names import LAW_TITLES
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.errors import DesignError, nearest
from graphcam.exercises.definition.drawn_answers import construction_of, read_as, rescaled, with_ordinates
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import LAWS
from graphcam.given.limits import Limits
from graphcam.given.motion import Dwell, Motion, Phase

Change = Callable[[Chain], Chain]
M = TypeVar("M", bound=Callable[..., Any])


@dataclass(frozen=True)
class CatalogueEntry:
    """A mistake of the catalogue.

    said : to the student; ``{argument}`` stands for the argument
    change : the change itself, or of a mistake that takes an argument the function that makes it of that
    takes : what the argument is; empty where there is none
    """

    said: Caption
    change: Callable[..., Any]
    takes: str


CATALOGUE: dict[str, CatalogueEntry] = {}
"""Every misconception that an exercise may name, by that name: the function's, with hyphens."""


def usual(said: Caption, takes: str = "") -> Callable[[M], M]:
    """Enter a function of this module into the catalogue."""

    def entered(mistake: M) -> M:
        """Under its own name."""
        CATALOGUE[mistake.__name__.replace("_", "-")] = CatalogueEntry(said, mistake, takes)
        return mistake

    return entered


@usual(
    say("The diagram looks drawn by another law of motion ({argument}): read in the task which law is asked."),
    takes="the name of a law",
)
def wrong_law(law: str) -> Change:
    """All moving phases by another law."""
    if law not in LAWS:
        raise DesignError("law", law, "one of the known laws", nearest(law, LAWS))

    def by_law(phase: Phase) -> Phase:
        """The phase by that law; a dwell has none."""
        return phase if isinstance(phase, Dwell) else type(phase)(phase.lift, phase.angle, law)

    return lambda chain: _moved_by(chain, [by_law(phase) for phase in chain.board.motion.phases])


@usual(say("The laws of rise and return look exchanged: each phase has its own."))
def laws_swapped(chain: Chain) -> Chain:
    """The law of the first moving phase in the second, and that of the second in the first."""
    phases = list(chain.board.motion.phases)
    first, second = [k for k, phase in enumerate(phases) if not isinstance(phase, Dwell)][:2]
    a, b = phases[first], phases[second]
    assert not isinstance(a, Dwell)
    assert not isinstance(b, Dwell)
    phases[first], phases[second] = replace(a, law=b.law, ratio=b.ratio), replace(b, law=a.law, ratio=a.ratio)
    return _moved_by(chain, phases)


def _moved_by(chain: Chain, phases: list[Phase]) -> Chain:
    return _redrawn(chain, replace(chain.board, motion=Motion(phases)))


@usual(
    say("Both ordinates look chosen freely: only one is chosen, the other follows from the areas that must be equal.")
)
def ordinates_equal(chain: Chain) -> Chain:
    """Every phase drawn with the ordinate that was chosen for the first rise."""
    return _other_ordinates(chain, lambda ratio: 1 / ratio)


@usual(say("The ratio of the ordinates looks turned round: the shorter phase has the longer ordinate."))
def ordinates_swapped(chain: Chain) -> Chain:
    """The ratio of the other phases' ordinates to the chosen one turned round."""
    return _other_ordinates(chain, lambda ratio: 1 / ratio**2)


def _other_ordinates(chain: Chain, change: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Chain:
    # The greatest ordinate of every phase over the chosen one, and what the mistake makes of it.
    ratio = chain.acceleration.readings["greatest"].paper / chain.board.ordinate
    return chain.going_on_from(with_ordinates(chain.acceleration, change(ratio)))


@usual(
    say("The ordinate at the end of each part looks taken for the one at its middle, where the chord has its slope.")
)
def end_ordinate(chain: Chain) -> Chain:
    """The ordinate at the end of each part in place of the one at its middle."""
    before = chain.acceleration.readings["before"].paper
    ends = before[..., chain.board.stations.left + 1]
    return chain.going_on_from(read_as(chain.acceleration, "middles", ends))


@usual(
    say("The scale of the cam angle looks taken in degrees: derivatives are per radian, so it counts in rad/mm."),
    takes="integration or differentiation",
)
def degree_for_radian(name: str) -> Change:
    """The scale of the cam angle in degrees a millimetre in the scales of v and a of the construction of that name."""
    return lambda chain: _wrong_scales(chain, name, (math.degrees(1), math.degrees(1)))


@usual(
    say(
        "The pole distance looks left out of a scale: a longer pole makes a flatter curve, and the scale "
        "makes up for it."
    ),
    takes="integration or differentiation",
)
def pole_forgotten(name: str) -> Change:
    """The scales of v and a without the pole distances in the construction of that name."""

    def forgotten(chain: Chain) -> Chain:
        """The chain with those scales."""
        first, second = chain.board.poles if name == "differentiation" else chain.board.poles[::-1]
        return _wrong_scales(chain, name, (1 / first, 1 / second))

    return forgotten


def _wrong_scales(chain: Chain, name: str, divisors: tuple[float, float]) -> Chain:
    """The scale of v divided by the first number, that of a by both."""
    v = rescaled_by(construction_of(chain, name), "v", 1 / divisors[0])
    return chain.going_on_from(rescaled_by(v, "a", 1 / divisors[1]))


def rescaled_by(construction: Construction, name: str, factor: float) -> Construction:
    """The construction with a scale, and those that follow from it, times a factor."""
    return rescaled(construction, name, np.asarray(construction.readings[name].scale) * factor)


@usual(
    say("A length looks given as it was measured on paper: times its scale it is the value that was asked."),
    takes="a construction and its reading, such as integration.v",
)
def scale_forgotten(place: str) -> Change:
    """A length on paper taken for the value; ``place`` is a construction and its reading, joined by a point."""
    name, _, reading = place.partition(".")

    def forgotten(chain: Chain) -> Chain:
        """The chain that goes on from the millimetres themselves."""
        construction = construction_of(chain, name)
        return chain.going_on_from(rescaled(construction, reading, np.ones_like(construction.readings[reading].scale)))

    return forgotten


@usual(say("The slope looks turned upside down: it is the rise over the run."))
def slope_inverted(chain: Chain) -> Chain:
    """Run over rise for rise over run: every ordinate H/(rise/run)."""
    derived = chain.differentiation
    v = derived.readings["v"].paper
    with np.errstate(divide="ignore"):
        return chain.going_on_from(read_as(derived, "v", derived.givens.poles[0] ** 2 / v))


@usual(say("The slope of a chord looks set down at its end: it belongs to the middle of the part."))
def chord_at_its_end(chain: Chain) -> Chain:
    """The value of a chord set down at its end: in the middle of the next part stands the mean of two chords."""
    derived = chain.differentiation
    v = derived.readings["v"].paper
    return chain.going_on_from(read_as(derived, "v", (v + np.roll(v, 1, axis=-1)) / 2))


@usual(say("The offset looks laid off on the other side of the cam centre."))
def offset_sign(chain: Chain) -> Chain:
    """The follower's line on the other side of the cam centre."""
    follower = chain.board.follower
    if follower.place is None or follower.place_name != "offset":
        raise DesignError("offset", "not given", "given where its sign is to be mistaken")
    return _redrawn(chain, replace(chain.board, follower=DrawnTranslating(-follower.place)))


@usual(say("The cam looks turned in the other sense: v is turned by 90° in the sense of the cam's rotation."))
def rotation_sense(chain: Chain) -> Chain:
    """The cam turned in the other sense."""
    return _redrawn(chain, replace(chain.board, rotation=_other(chain.board.rotation)))


@usual(say("The positions look numbered with the rotation: by inversion the frame goes round against it."))
def numbering_sense(chain: Chain) -> Chain:
    """The positions of the follower numbered with the rotation."""
    return _inverted(chain, chain.prime_radius, _other(chain.board.rotation))


@usual(say("The base circle looks taken for the prime circle: the prime circle runs through the roller's centre."))
def base_circle(chain: Chain) -> Chain:
    """The circle of the profile's least radius where the prime circle is asked."""
    # The scale of the profile stays what it is, so the task's own prime radius does not change.
    board, radius = chain.board, chain.prime_radius - chain.roller_radius
    measured = board.follower.pressure_angle(chain.integration, board.rotation, radius, chain.place, chain.pencil)
    return _inverted(chain.going_on_from(measured), radius, board.rotation)


@usual(say("The displacements look laid off from the offset circle: they start at the prime circle."))
def offset_circle(chain: Chain) -> Chain:
    """The displacements laid off from the points where the tangents touch the circle e."""
    # A hair more than the circle e itself, which a tangent meets in one point or, by rounding, in none.
    return _inverted(chain, abs(chain.place) * (1 + 1e-9), chain.board.rotation)


@usual(say("Cam angles look used as polar angles of the points: a point does not lie on the ray of its cam angle."))
def polar_angle(chain: Chain) -> Chain:
    """The points of the pitch curve, at their radii, on the rays of the cam angles from the first of them on."""
    inverted, stations = chain.inversion, chain.board.stations
    pitch = inverted.points["pitch"]
    rays = np.exp(-1j * sense(chain.board.rotation) * (stations.phi - stations.phi[0]))
    placed = np.abs(pitch) * (pitch / np.abs(pitch))[..., :1] * rays
    readings = {
        **inverted.readings,
        "x": replace(inverted.readings["x"], paper=placed.real),
        "y": replace(inverted.readings["y"], paper=placed.imag),
        "polar_angle": replace(inverted.readings["polar_angle"], paper=np.angle(placed)),
    }
    return chain.going_on_from(replace(inverted, readings=readings, points={**inverted.points, "pitch": placed}))


@usual(
    say(
        "The tangent's angle looks laid off where v and s have different scales: redraw v in the scale of s, "
        "or correct the angle."
    )
)
def unequal_scales(chain: Chain) -> Chain:
    """The lengths of v from its own diagram laid off beside s, in the scale of v."""
    integrated, board = chain.integration, chain.board
    laid_off = rescaled(integrated, "v", np.asarray(integrated.readings["s"].scale))
    place = board.follower.place
    region = board.follower.least_radius(laid_off, board.rotation, board.limits, place, chain.pencil)
    return chain.going_on_from(region)


@usual(say("The permitted angles of rise and return look exchanged."))
def limits_swapped(chain: Chain) -> Chain:
    """The rise at the return's permitted angle, the return at the rise's."""
    limits = chain.board.limits
    if limits.return_ is None:
        raise DesignError("limits", "without one of the return", "two where they are to be swapped")
    return _redrawn(chain, replace(chain.board, limits=Limits(limits.return_, limits.rise, limits.rest)))


@usual(say("The permitted angle looks laid off from the wrong axis: it is measured from the line of motion."))
def limit_from_the_horizontal(chain: Chain) -> Chain:
    """The permitted angles laid off from the axis across the motion."""
    limits = chain.board.limits
    back = None if limits.return_ is None else math.pi / 2 - limits.return_
    return _redrawn(chain, replace(chain.board, limits=Limits(math.pi / 2 - limits.rise, back, limits.rest)))


@usual(say("A diameter looks given for the radius of curvature."))
def diameter_for_radius(chain: Chain) -> Chain:
    """The radius of curvature doubled."""
    return chain.going_on_from(read_as(chain.curvature, "rho", 2 * chain.curvature.readings["rho"].paper))


@usual(say("The greater of the rule's candidates looks taken: the smaller one is the limit."))
def rule_greater(chain: Chain) -> Chain:
    """The greatest of what the rule for the roller proposes."""
    greatest = chain.roller.readings["candidates"].paper.max(axis=-1)
    return chain.going_on_from(read_as(chain.roller, "roller_radius", greatest))


def _other(rotation: Rotation) -> Rotation:
    return "cw" if rotation == "ccw" else "ccw"


def _redrawn(chain: Chain, board: Board) -> Chain:
    """Everything drawn from the start with other givens; the diagrams stay where the motion does."""
    same = board.motion is chain.board.motion
    done = {"acceleration": chain.acceleration, "integration": chain.integration} if same else {}
    return replace(chain, board=board, done=done)


def _inverted(chain: Chain, prime_radius: float, rotation: Rotation) -> Chain:
    """The inversion alone drawn otherwise."""
    follower = chain.board.follower
    inverted = follower.inversion(
        chain.integration, rotation, prime_radius, chain.place, chain.profile_scale, chain.pencil
    )
    return chain.going_on_from(inverted)


@dataclass(frozen=True)
class Misconception:
    """A mistake by its name in an exercise's file.

    said : to the student, what was probably done and what is right; it holds no number of the key
    change : from the right drawing to the one with the mistake
    """

    name: str
    said: Caption
    change: Change


def misconception(name: str) -> Misconception:
    """The misconception of that name.

    Raises
    ------
    DesignError : there is none, or its argument is missing or superfluous

    >>> misconception("offset-sign").name
    'offset-sign'
    """
    key, _, argument = (part.strip() for part in name.partition(":"))
    if key not in CATALOGUE:
        raise DesignError("misconception", key, "one of the catalogue", nearest(key, CATALOGUE))
    entry = CATALOGUE[key]
    if bool(argument) != bool(entry.takes):
        wanted = f"followed by a colon and {entry.takes}" if entry.takes else "without an argument"
        raise DesignError("misconception", name, wanted)
    said = replace(entry.said, values={"argument": LAW_TITLES.get(argument, argument)})
    return Misconception(name, said, entry.change(argument) if entry.takes else entry.change)
