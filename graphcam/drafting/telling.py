"""What acts tell of themselves: to what an instrument is set at every place, and runs of like moves as tables."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphcam.drafting.acts import Drawn, Kind, Setting
from graphcam.drafting.ink import Part, Row
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, ratio_text
from graphcam.words import Caption, Words, say, sequence

SETTING_ROLES = {Kind.LAY_OFF: "length", Kind.CIRCLE: "radius"}
"""The lengths to which dividers or a compass are set, by what the act calls them."""
RULER, FRENCH_CURVE = say("with the ruler"), say("with the French curve")
STATION = say("Station {name}")
"""What a place of most runs is called."""


def setting(drawn: Drawn) -> Words:
    """What the instrument is set to at the one place that an act left, and where that length or angle comes from.

    Empty where the act sets none; "0" where nothing is to be laid off.

    >>> import graphcam as gc
    >>> inversion = gc.solve(gc.builtin_task()).drawn["inversion"]
    >>> str(setting(inversion.acts["pitch"].first[4])), str(setting(inversion.acts["inverted positions"].first[4]))
    ('11.11 mm × 1.2 = 13.33 mm', '26.67°')
    """
    act, k = drawn.act, int(drawn.index[0])
    if act.kind is Kind.PROTRACTOR:
        return say("{angle:g}°", angle=round(abs(float(np.degrees(_amount(act.takes["angle"], k)))), 2))
    if act.kind not in SETTING_ROLES:
        return ""
    length = act.takes[SETTING_ROLES[act.kind]]
    mm = abs(_amount(length, k))
    if mm < NEGLIGIBLE_SIZE:
        return "0"
    if isinstance(length, Setting) and length.reading is not None and length.value is None:
        factor = abs(float(np.ravel(length.factor)[0]))
        if factor != 1:
            said = say("{paper:.2f} mm × {factor:.5g} = {mm:.2f} mm")
            return said.with_values(paper=mm / factor, factor=factor, mm=mm)
    return say("{mm:.2f} mm", mm=mm)


def _amount(amount: object, k: int) -> float:
    """The setting of an instrument at a place, in the first sample [mm, or rad]."""
    if isinstance(amount, Setting):
        amount = amount.amount[0] if amount.sampled else amount.amount
    amounts = np.ravel(np.asarray(amount, dtype=np.float64))
    return float(amounts[k if amounts.size > 1 else 0])


def stretch_caption(first: Words, last: Words) -> Caption:
    """A stretch of a curve by the names of its ends, at the beginning of a row."""
    return say("From {first} to {last}", first=first, last=last)


def circle_caption(circle: Caption, symbol: Words, radius: float, per_mm: float) -> Caption:
    """How a circle is drawn with the compass, with its radius on the machine and on paper.

    circle : what is drawn, about what, as in the case that "draw" needs: "the prime circle about A"
    symbol, radius : of the machine [mm];  per_mm : drawing scale [mm/mm]
    """
    said = say("Set the compass to {paper:.1f} mm ({symbol} = {radius:g} mm at {ratio}) and draw {circle}.")
    values = {"symbol": symbol, "radius": radius, "paper": radius / per_mm, "ratio": ratio_text(per_mm)}
    return said.with_values(circle=circle, **values)


def introduced_parts(said: Caption, parts: Sequence[Part]) -> tuple[Part, ...]:
    """Parts, the first of which begins with what is said of all; where there are none, one part that says it."""
    if not parts:
        return (Part(said),)
    return replace(parts[0], caption=sequence([said, parts[0].caption], " ")), *parts[1:]


Move = tuple[Caption, *tuple[Drawn, ...]]
"""What is done, and what it leaves."""


def move_parts(
    moves: Sequence[Move], values: Mapping[str, Any], first: Sequence[Caption] = (), last: Sequence[Caption] = ()
) -> tuple[Part, ...]:
    """A part for each move, with the values in its places.

    first, last : what else is said in the first part, before it, and in the last one, after it
    """
    told = [[said] for said, *_ in moves]
    told[0][:0], told[-1][len(told[-1]) :] = first, last
    captions = [sequence([each.with_values(**values) for each in said], " ") for said in told]
    return tuple(Part(caption, tuple(draws)) for caption, (_, *draws) in zip(captions, moves, strict=True))


def no_setting(_: int) -> Words:
    """An empty setting, for places that differ in none."""
    return ""


def run(
    caption: Caption,
    called: Caption,
    names: Sequence[Words],
    *drawn: Drawn,
    settings: Callable[[int], Words] | None = None,
) -> Part:
    """A run of like moves at places of these names: one part, with a row for each.

    caption : tells them all
    called : what one place is called, with its ``{name}``: "Station {name}"
    drawn : what is left, of as many places; the instrument's setting is that of the first
    settings : what differs from place to place, where the act does not tell it
    """

    def row(k: int) -> Row:
        """The row of the move of a number."""
        there = tuple(each.first[[k]] for each in drawn)
        return Row(called.with_values(name=names[k]), settings(k) if settings else setting(there[0]), there)

    rows = tuple(map(row, range(len(names))))
    return Part(caption, rows=rows)
