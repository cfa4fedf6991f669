"""The catalogue of mistakes: each is the drawing of a student who does everything right but for that one thing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from graphcam.constructions.chain import Chain
from graphcam.constructions.law_names import LAW_TITLES
from graphcam.drafting.ink import Caption, say
from graphcam.errors import DesignError, nearest
from graphcam.exercises.definition import mistakes

Change = Callable[[Chain], Chain]


@dataclass(frozen=True)
class Misconception:
    """A mistake by its name in an exercise's file.

    said : to the student, what was probably done and what is right; it holds no number of the key
    change : from the right drawing to the one with the mistake
    """

    name: str
    said: Caption
    change: Change


@dataclass(frozen=True)
class _Entry:
    said: Caption
    make: Callable[[str], Change]
    takes: str = ""


def _plain(change: Change) -> Callable[[str], Change]:
    return lambda argument: change


CATALOGUE: dict[str, _Entry] = {
    "wrong-law": _Entry(
        say("The diagram looks drawn by another law of motion ({argument}): read in the task which law is asked."),
        mistakes.wrong_law,
        "the name of a law",
    ),
    "laws-swapped": _Entry(
        say("The laws of rise and return look exchanged: each phase has its own."),
        _plain(mistakes.laws_swapped),
    ),
    "ordinates-equal": _Entry(
        say(
            "Both ordinates look chosen freely: only one is chosen, the other follows from the areas that "
            "must be equal."
        ),
        _plain(mistakes.ordinates_equal),
    ),
    "ordinates-swapped": _Entry(
        say("The ratio of the ordinates looks turned round: the shorter phase has the longer ordinate."),
        _plain(mistakes.ordinates_swapped),
    ),
    "end-ordinate": _Entry(
        say(
            "The ordinate at the end of each part looks taken for the one at its middle, where the chord has its slope."
        ),
        _plain(mistakes.end_ordinate),
    ),
    "degree-for-radian": _Entry(
        say("The scale of the cam angle looks taken in degrees: derivatives are per radian, so it counts in rad/mm."),
        mistakes.degree_for_radian,
        "integration or differentiation",
    ),
    "pole-forgotten": _Entry(
        say(
            "The pole distance looks left out of a scale: a longer pole makes a flatter curve, and the scale "
            "makes up for it."
        ),
        mistakes.pole_forgotten,
        "integration or differentiation",
    ),
    "scale-forgotten": _Entry(
        say("A length looks given as it was measured on paper: times its scale it is the value that was asked."),
        mistakes.scale_forgotten,
        "a construction and its reading, such as integration.v",
    ),
    "slope-inverted": _Entry(
        say("The slope looks turned upside down: it is the rise over the run."),
        _plain(mistakes.slope_inverted),
    ),
    "chord-at-its-end": _Entry(
        say("The slope of a chord looks set down at its end: it belongs to the middle of the part."),
        _plain(mistakes.chord_at_its_end),
    ),
    "offset-sign": _Entry(
        say("The offset looks laid off on the other side of the cam centre."),
        _plain(mistakes.offset_sign),
    ),
    "rotation-sense": _Entry(
        say("The cam looks turned in the other sense: v is turned by 90° in the sense of the cam's rotation."),
        _plain(mistakes.rotation_sense),
    ),
    "numbering-sense": _Entry(
        say("The positions look numbered with the rotation: by inversion the frame goes round against it."),
        _plain(mistakes.numbering_sense),
    ),
    "base-circle": _Entry(
        say("The base circle looks taken for the prime circle: the prime circle runs through the roller's centre."),
        _plain(mistakes.base_circle),
    ),
    "offset-circle": _Entry(
        say("The displacements look laid off from the offset circle: they start at the prime circle."),
        _plain(mistakes.offset_circle),
    ),
    "polar-angle": _Entry(
        say("Cam angles look used as polar angles of the points: a point does not lie on the ray of its cam angle."),
        _plain(mistakes.polar_angle),
    ),
    "unequal-scales": _Entry(
        say(
            "The tangent's angle looks laid off where v and s have different scales: redraw v in the scale of"
            " s, or correct the angle."
        ),
        _plain(mistakes.unequal_scales),
    ),
    "limits-swapped": _Entry(
        say("The permitted angles of rise and return look exchanged."),
        _plain(mistakes.limits_swapped),
    ),
    "limit-from-the-horizontal": _Entry(
        say("The permitted angle looks laid off from the wrong axis: it is measured from the line of motion."),
        _plain(mistakes.limit_from_the_horizontal),
    ),
    "diameter-for-radius": _Entry(
        say("A diameter looks given for the radius of curvature."),
        _plain(mistakes.diameter_for_radius),
    ),
    "rule-greater": _Entry(
        say("The greater of the rule's candidates looks taken: the smaller one is the limit."),
        _plain(mistakes.rule_greater),
    ),
}
"""Every misconception that an exercise may name, by that name."""


def misconception(name: str) -> Misconception:
    """The misconception of that name, "wrong-law: cosine" with its argument after a colon.

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
    return Misconception(
        name, replace(entry.said, values={"argument": LAW_TITLES.get(argument, argument)}), entry.make(argument)
    )
