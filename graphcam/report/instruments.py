"""With what the moves of a step are done: the instruments, what they are set to, and where that comes from."""

from collections.abc import Iterable, Mapping

import numpy as np

from graphcam.drafting import units
from graphcam.drafting.acts import Act, Drawn, Floats, Kind, Setting
from graphcam.drafting.euclid import unit
from graphcam.drafting.moves import ActPlaces
from graphcam.drafting.telling import SET
from graphcam.drafting.units import NOTHING
from graphcam.plane import cross
from graphcam.words import Caption, say

INSTRUMENTS: Mapping[str, Caption] = {
    "ruler": say("ruler"),
    "dividers": say("dividers"),
    "compass": say("compass"),
    "protractor": say("protractor"),
    "set square": say("set square"),
    "set squares": say("set squares"),
    "T-square": say("T-square"),
    "curve template": say("French curve"),
}
"""The instruments by the names that kinds of acts give them."""
REACH = 150.0
"""Dividers open so far [mm]; longer lengths are set off with the ruler."""
STRAIGHT = 0.02
"""Points no farther than this from the line through the ends of a piece are joined with the ruler [mm]."""


def instruments(moves: Iterable[ActPlaces]) -> list[Caption]:
    """The instruments of moves in the order in which they are taken up, each with its setting, none twice.

    >>> import graphcam as gc
    >>> from graphcam.drafting.moves import pieces_of
    >>> inversion = gc.solve(gc.builtin_task()).drawn["inversion"]
    >>> [str(said) for said in instruments(pieces_of([inversion.acts["pitch"][4]]))]
    ['dividers 13.33 mm = 11.11 mm × 1.2']
    """
    said = {str(told): told for piece in moves if (told := _instrument(piece)) is not None}
    # One that is set to something is not named without that as well.
    bare = {str(told.values["instrument"]) for told in said.values() if "instrument" in told.values}
    if str(INSTRUMENTS["set squares"]) in said:
        bare.add(str(INSTRUMENTS["set square"]))
    return [told for name, told in said.items() if name not in bare]


def _instrument(piece: ActPlaces) -> Caption | None:
    """With what one move is done; None for what is done by eye or in the head."""
    act, kind = piece.act, piece.act.kind
    if kind is Kind.READ:
        return _read_with(act)
    if not kind.instrument:
        return None
    instrument = INSTRUMENTS["ruler" if kind is Kind.FAIR and _straight(act) else kind.instrument]
    if kind is Kind.ERECT and _level(act.takes["along"]):
        return INSTRUMENTS["T-square"]
    if kind is Kind.LAY_OFF and _swung(piece):
        instrument = INSTRUMENTS["compass"]
    if kind in SET:
        return _set_to(instrument, act.takes[SET[kind]], piece)
    if kind is Kind.PROTRACTOR:
        return _turned_by(instrument, np.degrees(_amounts(act.takes["angle"], piece)))
    return instrument


def _straight(act: Act) -> bool:
    """Whether every piece of a faired curve goes through points of one line."""
    points = act.takes["points"].shown
    ways = [points[piece] - points[piece][0] for piece in act.takes["pieces"] if points[piece].size]
    off = [np.abs(cross(unit(way[-1]), way)).max() for way in ways if abs(way[-1]) > NOTHING]
    return bool(off) and max(off) < STRAIGHT


def _swung(piece: ActPlaces) -> bool:
    """Whether one length is laid off along many rays: an arc."""
    along, amounts = piece.act.takes["along"], _amounts(piece.act.takes["length"], piece)
    rays = isinstance(along, Drawn) and along.act.kind is Kind.PROTRACTOR
    return rays and len(piece.at) > 2 and float(np.ptp(amounts)) < NOTHING


def _level(along: object) -> bool:
    """Whether lines of a given direction are level."""
    return isinstance(along, complex | float | int) and complex(along).imag == 0


def _read_with(act: Act) -> Caption | None:
    """A length is read off a ruler, an angle off a protractor; what is carried over or reckoned is not read again."""
    if "line" in act.takes:
        return INSTRUMENTS["protractor"]
    return INSTRUMENTS["ruler"] if act.takes["length"].ends is not None else None


def _amounts(length: object, piece: ActPlaces) -> Floats:
    """What an instrument is set to at the places of a piece."""
    if isinstance(length, Setting):
        length = length.amount[0] if length.sampled else length.amount
    amounts = np.atleast_1d(np.asarray(length, dtype=np.float64))
    return amounts[list(piece.at)] if amounts.size == piece.act.size else amounts


def _set_to(instrument: Caption, length: object, piece: ActPlaces) -> Caption | None:
    """Dividers or a compass, and the length that they are set to."""
    amounts = np.abs(_amounts(length, piece))
    low, high = float(np.fmin.reduce(amounts)), float(np.fmax.reduce(amounts))
    if not high > NOTHING:
        return None
    if instrument == INSTRUMENTS["dividers"] and high > REACH:
        return INSTRUMENTS["ruler"]
    if high - low > NOTHING:
        return say("{instrument} {low:.2f} to {high:.2f} mm", instrument=instrument, low=low, high=high)
    if source := _source(length, high):
        set_to = say("{instrument} {length:.2f} mm = {source}", source=source)
    else:
        set_to = say("{instrument} {length:.2f} mm")
    return set_to.where(instrument=instrument, length=high)


def _source(length: object, amount: float) -> Caption | None:
    """Where a setting comes from: a reading times a factor, or a machine length in a scale."""
    if not isinstance(length, Setting) or length.reading is None or length.reading.unit == "rad":
        return None
    if length.value is not None:
        scale = float(np.ravel(length.reading.scale)[0])
        said = say("{value:.6g} {unit} : {scale:.5g}")
        return said.where(value=abs(length.value), unit=units.unit(length.reading.unit), scale=scale)
    factor = abs(float(np.ravel(length.factor)[0]))
    return say("{paper:.2f} mm × {factor:.5g}", paper=amount / factor, factor=factor) if factor != 1 else None


def _turned_by(instrument: Caption, degrees: Floats) -> Caption | None:
    """A protractor, and the angle that it is set to."""
    # A protractor has no angles below zero.
    low, high = (float(np.round(bound(np.abs(degrees)), 2)) for bound in (np.fmin.reduce, np.fmax.reduce))
    if high < NOTHING:
        return None
    if high - low > NOTHING:
        return say("{instrument} {low:.2f}° to {high:.2f}°", instrument=instrument, low=low, high=high)
    left = float(np.fmax.reduce(degrees)) > 0
    turned = say("{instrument} {angle:.2f}° anticlockwise") if left else say("{instrument} {angle:.2f}° clockwise")
    return turned.where(instrument=instrument, angle=high)
