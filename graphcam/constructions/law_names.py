"""What the motion laws are called."""

from collections.abc import Mapping

from graphcam.given.laws import DECLARED_LAWS
from graphcam.given.motion import Dwell, Motion
from graphcam.given.motion_law import Law
from graphcam.words import Caption, Words, say

LAW_TITLES: Mapping[str, Caption] = {
    str(title): title
    for title in (
        *(law.title for law in DECLARED_LAWS.values()),
        *(say("constant-velocity"), say("measured"), say("given cam"), say("polynomial"), say("spline")),
    )
}
"""What the laws are called; one that is not among them, as one of one's own, by its name."""


def law_name(law: Law) -> Words:
    """The name of a law, as captions give it.

    >>> import graphcam as gc
    >>> str(law_name(gc.law("cosine"))), str(law_name(gc.law("3-4-5")))
    ('cosine', '3-4-5')
    """
    return say("uniform velocity") if all(law.velocity_jumps) else LAW_TITLES.get(law.name, law.name)


def law_title(motion: Motion, k: int) -> Words:
    """The name of a phase's law, with the ratio of its two parts where they are unequal; nothing for a dwell."""
    phase = motion.phases[k]
    if isinstance(phase, Dwell):
        return ""
    law = phase.normalised
    name = law_name(law)
    return say("{law}, ratio {ratio:g}", law=name, ratio=law.ratio) if law.ratio != 1 else name
