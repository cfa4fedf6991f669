"""Acts as plain data, as a page can carry them: with it alone a second draughtsman lands on the same readings.

Written down is what an act takes: which act's places, lines or circles, at which stations, set to what, in which
direction.  What it leaves, and lengths that are taken up with dividers, are not: they are found by drawing.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphcam.drafting.act_order import ActPlaces
from graphcam.drafting.acts import Act, Drawn, Setting
from graphcam.drafting.ink import Reading

Plain = Any
"""What JSON knows: numbers, texts, lists, and objects of these; a complex number is a list of two."""
DECIMALS = 9
"""Decimals of mm and of rad."""


@dataclass
class WrittenActs:
    """Rows of acts, each with a number from 0; of hands with samples the first one's.

    formulas : what is reckoned in the head, or seen by eye, by number; a page holds what comes of it alone

    >>> from graphcam import Pencil
    >>> from graphcam.drafting.hand import Hand
    >>> from graphcam.drafting.ink import say
    >>> from graphcam.drafting.meaning import Meaning
    >>> hand = Hand(Pencil(), Meaning("axis", say("Axis"), say("It is given.")))
    >>> record = WrittenActs()
    >>> record.number(hand.lay_off("P", hand.given("origin"), -1, 40.0).act)
    0
    >>> record.rows[0]["takes"], record.rows[1]["name"]
    ({'start': {'act': 1}, 'along': -1, 'length': 40.0}, 'origin')
    """

    rows: list[dict[str, Plain]] = field(default_factory=list[dict[str, Plain]])
    formulas: list[Callable[..., Any]] = field(default_factory=list[Callable[..., Any]])
    _numbers: dict[Act, int] = field(default_factory=dict[Act, int])

    def number(self, act: Act) -> int:
        """The number of an act, which is written down first with all that it stands on."""
        if act not in self._numbers:
            self._numbers[act] = len(self.rows)
            row: dict[str, Plain] = {"kind": str(act.kind), "construction": act.construction, "name": act.name}
            self.rows.append(row)
            row["takes"] = {key: self._source_data(act, key, value) for key, value in act.takes.items()}
        return self._numbers[act]

    def piece(self, piece: ActPlaces) -> list[Plain]:
        """A piece as plain data: the number of its act and those of its places, None for all of them."""
        return [self.number(piece.act), None if len(piece.at) == piece.act.size else list(piece.at)]

    def _source_data(self, act: Act, key: str, value: Any) -> Plain:
        if not callable(value):
            return self._value_data(value)
        # What the eye sees of a curve is written down as it is seen.
        return {**self._formula(value), "seen": _array(value(act.takes["points"].first.points))}

    def _formula(self, formula: Callable[..., Any]) -> Plain:
        self.formulas.append(formula)
        return {"formula": len(self.formulas) - 1}

    def _value_data(self, value: Any) -> Plain:
        match value:
            case Drawn():
                return self._drawn_data(value)
            case Setting():
                return self._setting(value)
            case Reading(act=Act() as act):
                return {"reading": self.number(act)}
            case slice():
                return {"slice": [value.start, value.stop]}
            case tuple() | list():
                return [self._value_data(each) for each in value]
            case np.ndarray():
                return {"array": _array(value), "single": value.ndim == 0}
            case _:
                return _number(value)

    def _drawn_data(self, drawn: Drawn) -> Plain:
        if drawn.whole is None:
            return {"act": self.number(drawn.act)}
        part: dict[str, Plain] = {"whole": self._drawn_data(drawn.whole), "turn": _number(complex(drawn.turn))}
        if drawn.at is not None:
            part["at"] = self._value_data(drawn.at if isinstance(drawn.at, int | slice) else np.asarray(drawn.at))
        return part

    def _setting(self, setting: Setting) -> Plain:
        if setting.ends is not None:
            return {"between": self._value_data(setting.ends), "along": self._value_data(setting.along)}
        if setting.formula is not None:
            amount = setting.amount[0] if setting.sampled else setting.amount
            reckoned = {"reckoned": self._formula(setting.formula), "given": self._value_data(setting.given)}
            return reckoned | {"set to": _array(amount)}
        found: dict[str, Plain] = {"carried": self._value_data(setting.reading), "factor": _first_value(setting.factor)}
        return (
            found
            if setting.value is None
            else found | {"value": setting.value, "scale": _first_value(setting.reading.scale)}
        )


def _first_value(value: Any) -> float:
    return float(np.ravel(np.asarray(value))[0])


def _array(values: Any) -> list[Plain]:
    return [_number(each) for each in np.ravel(values).tolist()]


def _number(value: Any) -> Plain:
    """A number as it is written, a length that is nowhere as None; other things as they are."""
    if isinstance(value, complex):
        return [_number(value.real), _number(value.imag)]
    if isinstance(value, float):
        return round(value, DECIMALS) if np.isfinite(value) else None if np.isnan(value) else str(value)
    return value
