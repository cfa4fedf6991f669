"""The texts of an exercise file: each is one for all languages, or a table with one for each."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphcam.errors import TaskError, nearest
from graphcam.language import ENGLISH, languages

TEXTS = ("title", "text")
"""The keys of an exercise and of its answers that a student reads."""


def in_language(path: str, tables: Mapping[str, Any], language: str) -> dict[str, Any]:
    """The tables of an exercise file with every text in one language.

    A text that is not there in the language stays English, as one of a catalog does, or else what is there first.

    >>> in_language("", {"title": {"en": "The cam", "ru": "Кулачок"}, "answers": [{"text": "v"}]}, "ru")
    {'title': 'Кулачок', 'answers': [{'text': 'v'}]}

    Raises
    ------
    TaskError : a text is in a language that there is not
    """
    chosen = _chosen(path, "", tables, language)
    if isinstance(answers := tables.get("answers"), list):
        chosen["answers"] = [
            _chosen(path, f"answers[{k}].", each, language) if isinstance(each, dict) else each
            for k, each in enumerate(answers)
        ]
    return chosen


def _chosen(path: str, place: str, table: Mapping[str, Any], language: str) -> dict[str, Any]:
    found = dict(table)
    for key in TEXTS:
        texts = table.get(key)
        if not isinstance(texts, dict) or not texts:
            continue
        for name in texts:
            if name not in languages():
                expected = "a language, one of " + ", ".join(languages())
                raise TaskError(path, f"{place}{key}", name, expected, nearest(name, languages()))
        first = next(iter(texts.values()))
        found[key] = texts.get(language, texts.get(ENGLISH.name, first))
    return found
