"""What to do about a fault of a task file, where other books and programs say it otherwise than graphcam.

Each remedy is empty where nothing better is known than the commented example.
"""

from collections.abc import Iterable, Mapping
from typing import Any

from graphcam.errors import meant, nearest
from graphcam.given.follower import SENSES
from graphcam.given.law_words import LAW_WORDS
from graphcam.words import Words, say

FOUND = ("offset", "prime_radius", "roller_radius", "distance")
"""Keys that may be left out, because graphcam finds what they say."""
BASE_RADIUS = ("base_radius", "base_circle_radius", "base_circle")
"""What the radius is called where it is that of the working profile."""
CALLED = {**SENSES, **LAW_WORDS, "gost": ("ГОСТ",), "iso": ("ИСО",)}
"""What else words of a task file are called."""


def key_remedy(key: str, value: Any, known: Iterable[str], data: Mapping[str, Any]) -> Words:
    """The remedy for a key that its table does not have.

    known : the keys that it has;  data : the whole file

    >>> follower = {"kind": "translating", "roller_radius": 15}
    >>> print(key_remedy("base_radius", 80, ["prime_radius"], {"follower": follower}))
    graphcam takes the prime radius, of the pitch curve: prime_radius = base_radius + roller_radius = 95
    """
    if key in BASE_RADIUS and "arcs" not in data:
        return _radius_remedy(key, value, data.get("follower"))
    if key == "closure":
        return say("leave out limits.pressure_angle_return for force closure, give it for form closure")
    return nearest(key, known, CALLED)


def _radius_remedy(key: str, value: Any, follower: Any) -> Words:
    """How the prime radius follows from the radius of the base circle."""
    said: Mapping[str, Any] = follower if isinstance(follower, dict) else {}
    roller = 0 if said.get("kind") == "flat-faced" else said.get("roller_radius")
    radius = say("graphcam takes the prime radius, of the pitch curve: prime_radius = {key}", key=key)
    if roller == 0:
        return radius
    if not isinstance(value, int | float) or not isinstance(roller, int | float):
        return say("{radius} + roller_radius", radius=radius)
    return say("{radius} + roller_radius = {value:g}", radius=radius, value=value + roller)


def value_remedy(key: str, value: Any, choices: Iterable[str]) -> Words:
    """The remedy for a value of another type than its key's.

    choices : the words that it may be

    >>> print(value_remedy("format", "a3", ["A3", "A4"]), value_remedy("offset", "auto", ()), sep="\\n")
    did you mean 'A3'?
    or leave it out to let it be found
    """
    if not isinstance(value, str):
        return ""
    return say("or leave it out to let it be found") if key in FOUND else meant(value, choices, CALLED)


def missing_remedy(key: str, data: Mapping[str, Any]) -> Words:
    """The remedy for a key of the file that must be there.

    >>> print(missing_remedy("rotation", {"follower": {"kind": "flat-faced"}}))
    write rotation = "cw" or "ccw", as the cam turns in your task
    """
    if key != "rotation":
        return ""
    remedy = say('write rotation = "cw" or "ccw", as the cam turns in your task')
    follower = data.get("follower")
    if not (isinstance(follower, dict) and follower.get("kind") == "translating"):
        return remedy
    # The sign of the offset's term in the pressure angle: tan(alpha) = (v - sigma e)/(s0 + s).
    return say(
        '{remedy}: an offset greater than 0 lowers the pressure angle of the rise with "ccw", one below 0 with "cw"',
        remedy=remedy,
    )
