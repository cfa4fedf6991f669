"""Mistakes in the diagrams over the cam angle: laws, phases, ordinates, scales, poles, slopes, stations."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, say
from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.exercises.definition.catalogue import DIAGRAM_ARGUMENT, LAW_ARGUMENT, READING_ARGUMENT, Change, catalogued
from graphcam.exercises.definition.drawn_answers import construction_of, redrawn, rescaled, with_ordinates, with_reading
from graphcam.given.laid_outline import GivenCamMotion
from graphcam.given.laws import LAWS, canonical_law
from graphcam.given.motion import Dwell, Motion, Phase, Return, Rise

Moving = Rise | Return


@catalogued(
    say(
        "You seem to have drawn the diagram by another law of motion ({argument}): check in the task which law "
        "is required."
    ),
    takes=LAW_ARGUMENT,
)
def wrong_law(law: str) -> Change:
    """All moving phases by another law."""
    if canonical_law(law) not in LAWS:
        raise DesignError("law", law, say("one of the known laws"), nearest_word_remedy(law, LAWS))

    def by_law(phase: Phase) -> Phase:
        """The phase by that law; a dwell has none."""
        return phase if isinstance(phase, Dwell) else type(phase)(phase.lift, phase.angle, canonical_law(law))

    return lambda chain: _with_phases(chain, [by_law(phase) for phase in chain.board.motion.phases])


@catalogued(say("You seem to have exchanged the laws of rise and return: each phase has its own."))
def laws_swapped(chain: Chain) -> Chain:
    """The law of the first moving phase in the second, and that of the second in the first."""
    return _two_phases(chain, lambda own, other: replace(own, law=other.law, ratio=other.ratio))


@catalogued(say("You seem to have exchanged the cam angles of rise and return: each phase has its own."))
def angles_swapped(chain: Chain) -> Chain:
    """The first moving phase over the angle of the second, and the second over that of the first."""
    return _two_phases(chain, lambda own, other: replace(own, angle=other.angle))


@catalogued(say("You seem to have drawn half the lift: the follower rises by the whole lift."))
def lift_halved(chain: Chain) -> Chain:
    """All moving phases with half of their lift."""
    return _two_phases(chain, lambda own, _: replace(own, lift=own.lift / 2))


def _two_phases(chain: Chain, change: Callable[[Moving, Moving], Moving]) -> Chain:
    """The first two moving phases changed: each by itself and the other."""
    phases = list(chain.board.motion.phases)
    first, second = [k for k, phase in enumerate(phases) if not isinstance(phase, Dwell)][:2]
    a, b = phases[first], phases[second]
    assert not isinstance(a, Dwell)
    assert not isinstance(b, Dwell)
    phases[first], phases[second] = change(a, b), change(b, a)
    return _with_phases(chain, phases)


def _with_phases(chain: Chain, phases: list[Phase]) -> Chain:
    if isinstance(chain.board.motion, GivenCamMotion):
        raise DesignError("motion", say("by a given cam"), say("by phases where one is to be mistaken"))
    return redrawn(chain, replace(chain.board, motion=Motion(phases)))


@catalogued(
    say(
        "You seem to have chosen both ordinates freely: only one is chosen, the other follows because the areas "
        "must be equal."
    )
)
def ordinates_equal(chain: Chain) -> Chain:
    """Every phase drawn with the ordinate that was chosen for the first rise."""
    return _other_ordinates(chain, lambda ratio: 1 / ratio)


@catalogued(say("You seem to have inverted the ratio of the ordinates: the shorter phase has the longer ordinate."))
def ordinates_swapped(chain: Chain) -> Chain:
    """The ratio of the other phases' ordinates to the chosen one turned round."""
    return _other_ordinates(chain, lambda ratio: 1 / ratio**2)


def _other_ordinates(chain: Chain, change: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> Chain:
    # The greatest ordinate of every phase over the chosen one, and what the mistake makes of it.
    ratio = chain.acceleration.readings["greatest"].paper / chain.board.ordinate
    return chain.continued_from(with_ordinates(chain.acceleration, change(ratio)))


@catalogued(
    say(
        "You seem to have used the ordinate at the end of each part instead of the one at its middle, where the "
        "chord has its slope."
    )
)
def end_ordinate(chain: Chain) -> Chain:
    """The ordinate at the end of each part in place of the one at its middle."""
    before = chain.acceleration.readings["before"].paper
    ends = before[..., chain.board.stations.left + 1]
    return chain.continued_from(with_reading(chain.acceleration, "middles", ends))


@catalogued(
    say(
        "You seem to have used the scale of the cam angle in degrees: derivatives are per radian, so it must be "
        "in rad/mm."
    ),
    takes=DIAGRAM_ARGUMENT,
)
def degree_for_radian(name: str) -> Change:
    """The scale of the cam angle in degrees a millimetre in the scales of v and a of the construction of that name."""
    return lambda chain: other_scales(chain, name, (math.degrees(1), math.degrees(1)))


@catalogued(
    say(
        "You seem to have left the pole distance out of a scale: a longer pole distance makes a flatter curve, "
        "and the scale compensates for it."
    ),
    takes=DIAGRAM_ARGUMENT,
)
def pole_forgotten(name: str) -> Change:
    """The scales of v and a without the pole distances in the construction of that name."""

    def forgotten(chain: Chain) -> Chain:
        """The chain in which no scale is divided by its pole distance."""
        # Differentiation turns the integrations round: in either the velocity has the second pole.
        first, second = chain.board.poles[::-1]
        return other_scales(chain, name, (1 / first, 1 / second))

    return forgotten


def other_scales(chain: Chain, name: str, divisors: tuple[float, float]) -> Chain:
    """The scale of v divided by the first number, that of a by both."""
    v = rescaled_by(construction_of(chain, name), "v", 1 / divisors[0])
    return chain.continued_from(rescaled_by(v, "a", 1 / divisors[1]))


def rescaled_by(construction: Construction, name: str, factor: float) -> Construction:
    """The construction with a scale, and those that follow from it, times a factor."""
    return rescaled(construction, name, np.asarray(construction.readings[name].scale) * factor)


@catalogued(
    say("You seem to have given a length as measured on paper: multiply it by its scale."),
    takes=READING_ARGUMENT,
)
def scale_forgotten(place: str) -> Change:
    """A length on paper taken for the value; ``place`` is a construction and its reading, joined by a point."""
    name, _, reading = place.partition(".")

    def forgotten(chain: Chain) -> Chain:
        """The chain in which that reading is told without its scale."""
        construction = construction_of(chain, name)
        return chain.continued_from(rescaled(construction, reading, np.ones_like(construction.readings[reading].scale)))

    return forgotten


@catalogued(say("You seem to have inverted the slope: it is the rise over the run."))
def slope_inverted(chain: Chain) -> Chain:
    """Run over rise for rise over run: every ordinate H/(rise/run)."""
    derived = chain.differentiation
    v = derived.readings["v"].paper
    with np.errstate(divide="ignore"):
        return chain.continued_from(with_reading(derived, "v", derived.givens.poles[0] ** 2 / v))


@catalogued(say("You seem to have plotted the slope of a chord at its end: it belongs to the middle of the part."))
def chord_at_its_end(chain: Chain) -> Chain:
    """The value of a chord set down at its end: in the middle of the next part stands the mean of two chords."""
    derived = chain.differentiation
    v = derived.readings["v"].paper
    return chain.continued_from(with_reading(derived, "v", (v + np.roll(v, 1, axis=-1)) / 2))


@catalogued(
    say(
        "You seem to have exchanged the two pole distances on the drawing, while the scales are computed with "
        "the right ones."
    ),
    takes=DIAGRAM_ARGUMENT,
)
def poles_swapped(name: str) -> Change:
    """The diagrams of the construction of that name drawn with each other's pole, and read with the scales given."""

    def swapped(chain: Chain) -> Chain:
        """The chain with both diagrams so drawn."""
        drawn = construction_of(redrawn(chain, replace(chain.board, poles=chain.board.poles[::-1])), name)
        for reading in ("v", "a"):
            given = np.asarray(construction_of(chain, name).readings[reading].scale)
            drawn = rescaled(drawn, reading, given)
        return chain.continued_from(drawn)

    return swapped


@catalogued(
    say("You seem to have read the diagrams one station too late: count the stations, or the parts, as the task does."),
    takes=DIAGRAM_ARGUMENT,
)
def station_too_late(name: str) -> Change:
    """The ordinate of the next station at every station, in the diagrams of the construction of that name."""

    def late(chain: Chain) -> Chain:
        """The chain with both diagrams so read."""
        drawn = construction_of(chain, name)
        read = ("s", "v") if name == "integration" else ("rise", "v")
        for reading in read:
            drawn = with_reading(drawn, reading, np.roll(drawn.readings[reading].paper, -1, axis=-1))
        return chain.continued_from(drawn)

    return late
