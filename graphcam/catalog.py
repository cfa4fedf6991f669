"""Catalogs of gettext, read as they are written: the translations in a ``.po`` file, and its rule of plurals."""

from __future__ import annotations

import gettext
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

_LINE = re.compile(r'(?:(msgctxt|msgid|msgid_plural|msgstr(?:\[\d+\])?)\s*)?"(.*)"\s*')
_PLURAL = re.compile(r"^Plural-Forms:.*plural\s*=\s*([^;\n]+)", re.MULTILINE)
_UNREAD = re.compile(r"^X-Read-By-Native-Speaker: *no *$", re.MULTILINE)
_ESCAPED = re.compile(r"\\(.)")
_MEANING = {"n": "\n", "t": "\t", "r": "\r"}
Entry = dict[str, str]
"""What one entry of a file says, by the keyword: "msgid", "msgstr[1]"."""


def one_or_many(count: int) -> int:
    """The rule of plurals of a catalog that states none: that of English."""
    return int(count != 1)


@dataclass(frozen=True)
class Catalog:
    """The texts of one language by those of the code.

    told : by context (empty where there is none) and text, its translations: one, or one for each plural form
    plural : the number of the form that a count takes
    unread : whether its header says ``X-Read-By-Native-Speaker: no``
    """

    told: Mapping[tuple[str, str], tuple[str, ...]] = field(default_factory=dict[tuple[str, str], tuple[str, ...]])
    plural: Callable[[int], int] = one_or_many
    unread: bool = False

    def say(self, text: str, context: str = "") -> str:
        """A text in the language; one that is not translated stays as it is."""
        return self.told.get((context, text), (text,))[0]

    def say_many(self, one: str, many: str, count: int) -> str:
        """A text that depends on a count."""
        forms = self.told.get(("", one))
        return forms[self.plural(count)] if forms else (one, many)[one_or_many(count)]


def read_catalog(text: str) -> Catalog:
    r"""The catalog in the text of a ``.po`` file; what is marked as fuzzy is left out, as the tools of gettext do.

    >>> catalog = read_catalog('msgctxt "of a cam"\nmsgid "rise"\nmsgstr "Anstieg"\n')
    >>> catalog.say("rise", "of a cam"), catalog.say("rise")
    ('Anstieg', 'rise')
    """
    told: dict[tuple[str, str], tuple[str, ...]] = {}
    rule, unread = None, False
    for entry in _entries(text):
        forms = tuple(entry[key] for key in sorted(entry) if key.startswith("msgstr"))
        if entry["msgid"] and all(forms):
            told[entry.get("msgctxt", ""), entry["msgid"]] = forms
        elif not entry["msgid"]:  # the header
            rule, unread = _PLURAL.search(forms[0]), _UNREAD.search(forms[0]) is not None
    return Catalog(told, gettext.c2py(rule[1]) if rule else one_or_many, unread)


def _entries(text: str) -> Iterator[Entry]:
    """The entries of a file that are not fuzzy, with their strings put together."""
    entry: Entry = {}
    keyword, fuzzy, next_fuzzy = "", False, False
    for line in text.splitlines():
        if line.startswith("#,"):
            next_fuzzy = "fuzzy" in line
        if (found := _LINE.fullmatch(line)) is None:
            continue
        begun = found[1]
        if begun in ("msgctxt", "msgid") and "msgid" in entry:
            if not fuzzy:
                yield entry
            entry = {}
        if begun and not entry:
            fuzzy, next_fuzzy = next_fuzzy, False
        keyword = begun or keyword
        entry[keyword] = entry.get(keyword, "") + _plain(found[2])
    if "msgid" in entry and not fuzzy:
        yield entry


def _plain(quoted: str) -> str:
    """What stands between quotes."""
    return _ESCAPED.sub(lambda sign: _MEANING.get(sign[1], sign[1]), quoted) if "\\" in quoted else quoted
