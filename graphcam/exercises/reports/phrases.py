"""Words that several pages use."""

from __future__ import annotations

from typing import Any

from graphcam.words import Caption, Tell, say

OUTCOMES = {
    "right": say("right"), "follow-through": say("follows from your own values"), "wrong": say("off"),
    "unreadable": say("cannot be read"), "missing": say("not answered"),
}  # fmt: skip


def spoken(words: dict[str, Caption], tell: Tell) -> dict[str, str]:
    """The words in a language."""
    return {name: tell(caption) for name, caption in words.items()}


def given_text(answer: dict[str, Any], tell: Tell) -> str:
    """What was given, in a cell."""
    given = answer["given"]
    if given is None:
        return "–"
    if isinstance(given, list):
        return tell(say("{count} points", count=len(given)))
    return tell(say("{value:.6g}", value=given))
