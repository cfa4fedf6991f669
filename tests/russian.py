"""What English is left in a text that is told in another language."""

from __future__ import annotations

import re
from collections.abc import Iterable

from translations import words_lacking

KNOWN = {
    # Points and a function of a Russian school's writing, a file, and who wrote of three arcs.
    "ABC", "ABD", "arctg", "csv", "Lanni", "Ceccarelli", "Figliolini",
}  # fmt: skip


def english_words(text: str, names: Iterable[str] = (), spoken: str = "ru") -> set[str]:
    """Latin words of three letters or more, but for TeX's, HTML's and names, which are the same in every language.

    What the catalog of the language lacks is told in English: its words are none that were forgotten.
    """
    for name in names:
        text = re.sub(rf"(?<![A-Za-z]){re.escape(name)}(?![A-Za-z])", " ", text)
    found = set(re.findall("[A-Za-z]{3,}", re.sub(r"\\[A-Za-z]+|</?sub>", "", text))) - KNOWN
    return found - words_lacking(spoken) if found else found
