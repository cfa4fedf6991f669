"""Words that several pages use."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from graphcam.drafting.ink import Caption, say

Speaker = Callable[[Caption], str]

OUTCOMES = {
    "right": say("right"), "follow-through": say("follows from your own values"), "wrong": say("off"),
    "unreadable": say("cannot be read"), "missing": say("not answered"),
}  # fmt: skip


def spoken(words: dict[str, Caption], speak: Speaker) -> dict[str, str]:
    """The words in a language."""
    return {name: speak(caption) for name, caption in words.items()}


def given_text(answer: dict[str, Any], speak: Speaker) -> str:
    """What was given, in a cell."""
    given = answer["given"]
    if given is None:
        return "–"
    if isinstance(given, list):
        return speak(say("{count} points", count=len(given)))
    return speak(say("{value:.6g}", value=given))
