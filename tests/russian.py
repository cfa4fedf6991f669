"""What English is left in a Russian text."""

from __future__ import annotations

import re

KNOWN = {
    # Points and a function of a Russian school's writing, the rule's own word, a file, and who wrote of three arcs.
    "ABC", "arctg", "rho", "csv", "Lanni", "Ceccarelli", "Figliolini",
}  # fmt: skip


def english_words(text: str) -> set[str]:
    """Latin words of three letters or more, but for TeX's."""
    return set(re.findall("[A-Za-z]{3,}", re.sub(r"\\[A-Za-z]+", "", text))) - KNOWN
