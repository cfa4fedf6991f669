"""What the reader of dataclasses takes, and what it says of the rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Literal

import pytest

from graphcam.errors import DesignError
from graphcam.tasks.dataclass_reader import (
    ByKind,
    Misfit,
    MissingKey,
    UnknownKey,
    UnknownKind,
    WrongType,
    read_dataclass,
)

NUMBER, FINITE, WHOLE = "a number (without quotes)", "a finite number", "a whole number (without quotes)"


@dataclass(frozen=True)
class Arm:
    length: float
    kind: Literal["arm"] = "arm"

    def __post_init__(self) -> None:
        if self.length <= 0:
            raise DesignError("length", self.length, "greater than 0 mm")


@dataclass(frozen=True)
class Stem:
    kind: Literal["stem"] = "stem"


@dataclass(frozen=True)
class Scene:
    number: float = 0.0
    whole: int = 0
    text: str = ""
    switch: bool = False
    step: Literal[1, 2, 5] = 1
    pair: tuple[float, float] | None = None
    row: tuple[int, ...] = ()
    either: float | str | None = None
    spread: float | tuple[float, float] | None = None
    counts: Mapping[str, int] = field(default_factory=dict)
    follower: Annotated[Arm | Stem, ByKind()] = field(default_factory=Stem)
    arms: tuple[Arm, ...] = ()
    free: Any = None
    renamed: int = field(default=0, metadata={"alias": "named"})
    inner: int = field(default=7, init=False)


TAKEN = {
    "a whole number for a measured one": ("number", 3, 3.0),
    "a number of many digits": ("whole", 10**30, 10**30),
    "one of a few": ("step", 5, 5),
    "a pair": ("pair", [1, 2.5], (1.0, 2.5)),
    "nothing where something may be": ("pair", None, None),
    "a list of any length": ("row", [1, 2, 3], (1, 2, 3)),
    "text where a number may be": ("either", "cosine", "cosine"),
    "a number where a pair may be": ("spread", 1, 1.0),
    "a pair where a number may be": ("spread", [1, 2], (1.0, 2.0)),
    "keys of one's own": ("counts", {"v": 3}, {"v": 3}),
    "a table by its kind": ("follower", {"kind": "arm", "length": 3}, Arm(3.0)),
    "a list of tables": ("arms", [{"length": 3}, {"length": 4}], (Arm(3.0), Arm(4.0))),
    "anything": ("free", {"a": [1, "b"]}, {"a": [1, "b"]}),
}


@pytest.mark.parametrize(("name", "said", "made"), TAKEN.values(), ids=TAKEN)
def test_what_a_file_says_becomes_what_the_hint_says(name, said, made):
    read = read_dataclass(Scene, {name: said})
    assert isinstance(read, Scene)
    assert getattr(read, name) == made
    assert type(getattr(read, name)) is type(made)


REFUSED = {
    "text for a number": ("number", "3", [WrongType(("number",), NUMBER)]),
    "true for a number": ("number", True, [WrongType(("number",), NUMBER)]),
    "nothing for a number": ("number", None, [WrongType(("number",), NUMBER)]),
    "an infinite number": ("number", float("-inf"), [WrongType(("number",), FINITE)]),
    "a number too great for one": ("number", 10**400, [WrongType(("number",), FINITE)]),
    "a broken whole number": ("whole", 3.0, [WrongType(("whole",), WHOLE)]),
    "true for a whole number": ("whole", True, [WrongType(("whole",), WHOLE)]),
    "a number for text": ("text", 3, [WrongType(("text",), "text in quotes")]),
    "a number for a switch": ("switch", 1, [WrongType(("switch",), "true or false")]),
    "none of a few": ("step", 3, [WrongType(("step",), "1, 2 or 5")]),
    "true for one of a few": ("step", True, [WrongType(("step",), "1, 2 or 5")]),
    "half a pair": ("pair", ["a"], [WrongType(("pair", 0), NUMBER), MissingKey(("pair", 1))]),
    "more than a pair": ("pair", [1, "a", 3], [WrongType(("pair",), "a list of 2")]),
    "a table for a list": ("row", {}, [WrongType(("row",), "a list")]),
    "a broken number in a list": ("row", [1, 2.5], [WrongType(("row", 1), WHOLE)]),
    "neither of two": ("either", [1], [WrongType(("either",), f"{NUMBER} or text in quotes")]),
    "nearly one of two": ("spread", [1], [MissingKey(("spread", 1))]),
    "a list for a table": ("counts", [], [WrongType(("counts",), "a table")]),
    "text in a table of numbers": ("counts", {"v": "a"}, [WrongType(("counts", "v"), WHOLE)]),
    "a number for a table by its kind": ("follower", 3, [WrongType(("follower",), "a table")]),
    "no kind": ("follower", {}, [UnknownKind(("follower",))]),
    "a list for a kind": ("follower", {"kind": []}, [UnknownKind(("follower",))]),
    "a kind without its key": ("follower", {"kind": "arm"}, [MissingKey(("follower", "arm", "length"))]),
    "a key of another kind": (
        "follower", {"kind": "stem", "length": 3}, [UnknownKey(("follower", "stem", "length"))],
    ),
    "a name that the file does not have": ("renamed", 1, [UnknownKey(("renamed",))]),
    "what only the code sets": ("inner", 1, [UnknownKey(("inner",))]),
}  # fmt: skip


@pytest.mark.parametrize(("name", "said", "faults"), REFUSED.values(), ids=REFUSED)
def test_what_does_not_fit_is_told_with_its_place(name, said, faults):
    assert in_english(read_dataclass(Scene, {name: said})) == faults


def in_english(faults):
    return [replace(each, expected=str(each.expected)) if isinstance(each, WrongType) else each for each in faults]


def test_every_table_is_read_even_if_another_is_wrong():
    faults = read_dataclass(Scene, {"foo": 1, "arms": [{"length": -3}, {"length": 2}, {}, 4], "whole": "a"})
    assert isinstance(faults, list)
    whole, first, third, fourth, unknown = in_english(faults)
    assert whole == WrongType(("whole",), WHOLE)
    assert isinstance(first, Misfit)
    assert (first.place, first.error.value) == (("arms", 0), -3)
    assert (third, fourth) == (MissingKey(("arms", 2, "length")), WrongType(("arms", 3), "a table"))
    assert unknown == UnknownKey(("foo",))


def test_a_key_may_have_another_name_in_the_file():
    read = read_dataclass(Scene, {"named": 3})
    assert isinstance(read, Scene)
    assert read.renamed == 3
