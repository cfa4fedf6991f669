"""What English is left in a Russian text."""

from __future__ import annotations

import re
from collections.abc import Iterable

KNOWN = {
    # Points and a function of a Russian school's writing, a file, and who wrote of three arcs.
    "ABC", "ABD", "arctg", "csv", "Lanni", "Ceccarelli", "Figliolini",
}  # fmt: skip


def english_words(text: str, names: Iterable[str] = ()) -> set[str]:
    """Latin words of three letters or more, but for TeX's, HTML's and names, which are the same in every language."""
    for name in names:
        text = re.sub(rf"(?<![A-Za-z]){re.escape(name)}(?![A-Za-z])", " ", text)
    return set(re.findall("[A-Za-z]{3,}", re.sub(r"\\[A-Za-z]+|</?sub>", "", text))) - KNOWN
