"""The state of the studio in an address: a link shows a cam, without a server that would keep it.

The part after ``#`` is ``1.`` (the version) and, in base64url, the raw deflate of a JSON table: ``b`` the built-in
task from which the task differs, ``d`` the differences by their paths, and what is shown, as :data:`FIELDS` declares
it.  What has its usual value is left out.  The page reads and writes by the same declaration
(``data/studio/address.js``).
"""

import base64
import binascii
import json
import zlib
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, fields
from typing import Any

from graphcam.errors import DesignError
from graphcam.studio.task_paths import changed_task
from graphcam.words import say

VERSION_PREFIX = "#1."
MAX_LENGTH = 2000
"""Characters; longer addresses are cut by some mail programs and learning platforms."""
SAVE_REMEDY = say("save the task file and pass that on")
WHOLE_ADDRESS_REMEDY = say("open the address as it was given, from # to the end")
_RAW_DEFLATE = -15
"""zlib's number for deflate without a header."""


def _told(key: str, kind: str, *usual: Any) -> Any:
    """A field that an address tells under a key: the kind of its value, and the values that the page leaves out."""
    return field(default=None, metadata={"told": (key, kind, usual)})


@dataclass(frozen=True)
class StudioPlace:
    """What an address shows.

    task : as in a request of the engine, with the keys and units of a task file
    built_in : the name of the built-in task from which it is told
    view, beside, step, mode, panel : the names of what is shown; None is the usual one.  Without a view it is the main
        construction; beside it stands what belongs to it, and nothing if that is ""
    part, station : of the step, and of the velocity plan
    phi : cam angle [degrees]; None is the usual one
    swept : the path of the size over which What if is drawn
    colour : the quantity by which the turning profile is coloured
    pin : the task that is pinned beside it; None where there is none
    language : of the page; None is English
    exercise : what is asked of the task, see :mod:`graphcam.exercises.exports.studio_link`; None is nothing
    """

    task: Mapping[str, Any]
    built_in: str = "coursework"
    view: str | None = _told("v", "string", "")
    beside: str | None = _told("w", "string")
    step: str | None = _told("s", "string")
    part: int | None = _told("t", "number")
    station: int | None = _told("q", "number")
    phi: float | None = _told("p", "number", 30)
    mode: str | None = _told("m", "string", "play")
    panel: str | None = _told("o", "string", "sizes", "step")
    swept: str | None = _told("f", "string")
    colour: str | None = _told("c", "string")
    pin: Mapping[str, Any] | None = _told("n", "task")
    exercise: Mapping[str, Any] | None = _told("x", "object")
    language: str | None = _told("l", "string", "en")


FIELDS = tuple(
    (key, each.name, kind, usual) for each in fields(StudioPlace) for key, kind, usual in each.metadata.values()
)
"""What an address says besides the task: key, name, kind of the value, and the values that the page leaves out."""
_KINDS: dict[str, type | tuple[type, ...]] = {"string": str, "number": (int, float), "object": dict, "task": dict}


def address_of(place: StudioPlace, built_in: Mapping[str, Mapping[str, Any]], longest: int = MAX_LENGTH) -> str:
    """The part of an address from ``#`` on.

    built_in : the built-in tasks by their names, in the form of the place's task
    longest : characters that it may have

    Raises
    ------
    DesignError : the task differs so much that the address would be longer

    >>> tasks = {"coursework": {"rotation": "cw", "follower": {"kind": "translating", "offset": -10}}}
    >>> place = StudioPlace({"rotation": "cw", "follower": {"kind": "translating", "offset": 5}}, view="combined")
    >>> address_of(place, tasks)[:3], len(address_of(place, tasks)) < 100
    ('#1.', True)
    >>> place_of(address_of(place, tasks), tasks) == place
    True
    """
    base, state = built_in[place.built_in], dict[str, Any](b=place.built_in)
    state |= {"d": moved} if (moved := dict(differences(base, place.task))) else {}
    for key, name, kind, _ in FIELDS:
        if (value := getattr(place, name)) is not None:
            state[key] = dict(differences(base, value)) if kind == "task" else value
    packer = zlib.compressobj(9, zlib.DEFLATED, _RAW_DEFLATE)
    said = json.dumps(state, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    packed = packer.compress(said.encode()) + packer.flush()
    address = VERSION_PREFIX + base64.urlsafe_b64encode(packed).decode().rstrip("=")
    if len(address) > longest:
        quantity = say("length of the address")
        raise DesignError(quantity, len(address), say("at most {longest} characters", longest=longest), SAVE_REMEDY)
    return address


def place_of(address: str, built_in: Mapping[str, Mapping[str, Any]]) -> StudioPlace:
    """What an address shows, from its ``#`` on.

    Keys that nobody knows are passed over: a newer version may have written them.  Values are checked as typed ones
    are, by who reads the task.

    Raises
    ------
    DesignError : it is no such address

    >>> place_of("#1.nonsense", {})
    Traceback (most recent call last):
    graphcam.errors.DesignError: address is '#1.nonsense', but must be an address of the studio; open the address as \
it was given, from # to the end
    """
    state = _unpacked(address)
    name, moved = state.get("b", "coursework"), state.get("d", {})
    if not isinstance(name, str) or name not in built_in or not isinstance(moved, dict):
        raise _no_address(address)
    shown: dict[str, Any] = {
        field: _with_differences(built_in[name], state[key]) if kind == "task" else state[key]
        for key, field, kind, _ in FIELDS
        if isinstance(state.get(key), _KINDS[kind])
    }
    return StudioPlace(_with_differences(built_in[name], moved), name, **shown)


def _no_address(address: str) -> DesignError:
    shown = address if len(address) <= 60 else address[:60] + "..."
    return DesignError("address", shown, say("an address of the studio"), WHOLE_ADDRESS_REMEDY)


def _unpacked(address: str) -> dict[str, Any]:
    if not address.startswith(VERSION_PREFIX) or len(address) > MAX_LENGTH:
        raise _no_address(address)
    packed = address.removeprefix(VERSION_PREFIX)
    try:
        # Deflate packs a thousand to one at most, so that a short address cannot become a large text.
        said = zlib.decompress(base64.b64decode(packed + "=" * (-len(packed) % 4), b"-_", validate=True), _RAW_DEFLATE)
        state = json.loads(said)
    except (binascii.Error, zlib.error, ValueError, RecursionError):
        raise _no_address(address) from None
    if not isinstance(state, dict):
        raise _no_address(address)
    return state


def differences(old: Any, new: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """The paths at which a task differs from another, with what stands there; None for what is left out."""
    if isinstance(old, Mapping) and isinstance(new, Mapping):
        for key in dict.fromkeys((*old, *new)):
            if key in old and key in new:
                yield from differences(old[key], new[key], f"{path}.{key}" if path else key)
            else:
                yield f"{path}.{key}" if path else key, new.get(key)
    elif _rows(old) and _rows(new) and len(old) == len(new):
        for k, (one, other) in enumerate(zip(old, new, strict=True)):
            yield from differences(one, other, f"{path}[{k}]")
    elif old != new:
        yield path, new


def _rows(value: Any) -> bool:
    """Whether it is a list of tables or of rows, such as phases, of which each is told; points and poles are not."""
    return isinstance(value, list) and all(isinstance(item, Mapping | list) for item in value)


def _with_differences(task: Mapping[str, Any], moved: Mapping[str, Any]) -> dict[str, Any]:
    """The task with other values at some paths; a path that leads nowhere is passed over."""
    found = dict(task)
    for path, value in moved.items():
        with suppress(DesignError):
            found = changed_task(found, {path: value})
    return found
