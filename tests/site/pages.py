"""The pages of the site as they are written: their blocks, and the files and names they speak of."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
SITE = ROOT / "notebooks" / "site"
PAGES = SITE / "pages"
HOW_TO = [*sorted(str(path.relative_to(PAGES)) for path in (PAGES / "how-to").glob("*.md")), "first-sheet.md"]
BLOCK = re.compile(r"(?:^`(?P<file>[\w.-]+)`:\n\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
OF_THE_SOURCE = r"(?:graphcam|tests|notebooks|exercises)/[\w/.-]*\w"


def text_of(page: str) -> str:
    return (PAGES / page).read_text(encoding="utf-8")


def blocks(page: str, language: str) -> list[str]:
    """The fenced blocks in a language."""
    return [found["text"] for found in BLOCK.finditer(text_of(page)) if found["language"] == language]


def files(page: str) -> dict[str, str]:
    """The files that a page tells the reader to write."""
    return {found["file"]: found["text"] for found in BLOCK.finditer(text_of(page)) if found["file"]}


def paths(page: str) -> set[str]:
    """The files and folders of the source that a page names."""
    return set(re.findall(rf"`({OF_THE_SOURCE})`", text_of(page)))


def rows(page: str) -> dict[str, list[str]]:
    """Of the tables of files: what a page says stands in each file, by the code in the row."""
    found = re.findall(rf"^\| `({OF_THE_SOURCE})` \| (.+) \|$", text_of(page), re.MULTILINE)
    return {path: [name.strip('"') for name in re.findall(r"`([^`]+)`", said)] for path, said in found}
