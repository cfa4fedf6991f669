"""When a curve that was read cannot be used: measures of how well it is seen, and sentences for a teacher.

How often these limits decide wrongly is measured by the trial of simulated photographs (tests/photos/trial.py).
"""

from dataclasses import dataclass

from graphcam.photo.bridged_gaps import LONGEST_GAP
from graphcam.words import Words, say

LEAST_SHARE = 0.90
"""Share of its length on which a curve is seen: a half has far less, a faint but whole one more."""
LEAST_COHERENCE = 0.80
"""Median share of the best direction's answer that the curve's own direction has: through a scribble the way jumps."""
MOST_RIVAL = 0.25
"""Share of its length over which a second curve is seen; rays and digits beside a lone curve make less."""
MOST_BEND = 3.5
"""Degrees by which the direction changes from station to station, on average: the way through a scribble turns much."""
MOST_TWIN = 0.06
"""Share of its length along which a second crest runs beside the first."""
MOST_DARKER = 0.10
"""Share of its length along which a line far darker than the curve runs, on it or elsewhere."""
MOST_HIDDEN = 0.10
"""Share of its length that lies under black print, where nothing is seen."""
EMPTY = 0.25
"""Below this share there is nothing that looks like a curve."""


@dataclass(frozen=True)
class Measures:
    """How well a curve is seen.

    share : of its length that is seen
    gap : the longest piece that is not seen, mm
    coherence : median share of the best direction's answer that its own direction has
    rival : share of its length over which a second curve is seen elsewhere
    bend : mean change of its direction from station to station, degrees
    twin : share of its length along which a second line runs within 2 mm
    hidden : share of its length under black print
    contrast : density of its strong places against their surroundings
    length : mm
    darker : share of its length along which a far darker line runs, on it or elsewhere
    """

    share: float
    gap: float
    coherence: float
    rival: float
    bend: float
    twin: float
    hidden: float
    contrast: float
    length: float
    darker: float


def refusal_of(measures: Measures) -> tuple[Words, Words] | None:
    """The reason why a curve cannot be used, and the remedy; None if it can.

    >>> from dataclasses import replace
    >>> good = Measures(.98, 3, .95, .05, 1.5, 0, 0, .3, 300, 0)
    >>> refusal_of(good) is None
    True
    >>> str(refusal_of(replace(good, share=.6, gap=40))[0])
    '60 % of the curve can be seen, and 90 % are needed'
    """
    again = say("draw it as one clear line, or enter it in the review page")
    share = say(
        "{share:.0f} % of the curve can be seen, and {least:.0f} % are needed",
        share=100 * measures.share,
        least=100 * LEAST_SHARE,
    )
    over = say("draw over the faint parts, also along printed lines, and take the photograph again in even light")
    cases = [
        (measures.rival > MOST_RIVAL, _rival(measures), say("erase the one that is not meant")),
        (
            measures.darker > MOST_DARKER,
            _darker(measures),
            say("draw over the whole curve, or erase what is not meant"),
        ),
        (measures.share < EMPTY, say("no curve can be seen"), say("check that this is the right page and in focus")),
        (measures.twin > MOST_TWIN, _twin(measures), say("erase the one that is not meant")),
        (
            measures.coherence < LEAST_COHERENCE or measures.bend > MOST_BEND,
            say("the lines do not form one curve"),
            again,
        ),
        (measures.hidden > MOST_HIDDEN, _hidden(measures), say("enter it in the review page")),
        (measures.share < LEAST_SHARE, share, over),
        (measures.gap > LONGEST_GAP, _gap(measures), over),
    ]
    return next(((why, remedy) for applies, why, remedy in cases if applies), None)


def _rival(measures: Measures) -> Words:
    return say("a second curve is drawn along {share:.0f} % of the first", share=100 * measures.rival)


def _twin(measures: Measures) -> Words:
    return say("two lines run side by side along {share:.0f} % of the curve", share=100 * measures.twin)


def _darker(measures: Measures) -> Words:
    return say("a line far darker than the curve is drawn along {share:.0f} % of it", share=100 * measures.darker)


def _hidden(measures: Measures) -> Words:
    return say("{share:.0f} % of the curve lies under black print", share=100 * measures.hidden)


def _gap(measures: Measures) -> Words:
    return say("a piece of {gap:.0f} mm of the curve cannot be seen", gap=measures.gap)
