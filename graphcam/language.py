"""Languages: English as it is written in the code, every other one from a catalog ``data/languages/NAME.po``.

A catalog is an ordinary gettext file, and it is there when its file is: nothing else names the languages.
"""

from __future__ import annotations

import gettext
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import resources
from numbers import Real
from pathlib import Path
from typing import Any

from graphcam.errors import DesignError, among
from graphcam.words import Caption, Message, Words, message, say, say_in

MINUS_SIGN = "−"
"""As wide as a plus; a hyphen is what a program reads."""
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
"""The digits and the minus of a power of ten."""
DECIMAL_SIGN = say_in("decimal sign", ".")
"""What stands before the decimals, which a catalog tells as it does every text."""
SENTENCE = "{what} is {shown}, but must be {allowed}"
"""That of an error; a language that has it can tell messages."""
UNREVIEWED_NOTE = say("This translation has not yet been read by a native speaker.")


_LINE_PATTERN = re.compile(r'(?:(msgctxt|msgid|msgid_plural|msgstr(?:\[\d+\])?)\s*)?"(.*)"\s*')
_PLURAL_PATTERN = re.compile(r"^Plural-Forms:.*plural\s*=\s*([^;\n]+)", re.MULTILINE)
_UNREVIEWED_PATTERN = re.compile(r"^X-Read-By-Native-Speaker: *no *$", re.MULTILINE)
_ESCAPE_PATTERN = re.compile(r"\\(.)")
_ESCAPE_VALUES = {"n": "\n", "t": "\t", "r": "\r"}
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

    def translation(self, text: str, context: str = "") -> str:
        """A text in the language; one that is not translated stays as it is."""
        return self.told.get((context, text), (text,))[0]

    def plural_translation(self, one: str, many: str, count: int) -> str:
        """A text that depends on a count."""
        forms = self.told.get(("", one))
        return forms[self.plural(count)] if forms else (one, many)[one_or_many(count)]


def read_catalog(text: str) -> Catalog:
    r"""The catalog in the text of a ``.po`` file; what is marked as fuzzy is left out, as the tools of gettext do.

    >>> catalog = read_catalog('msgctxt "of a cam"\nmsgid "rise"\nmsgstr "Anstieg"\n')
    >>> catalog.translation("rise", "of a cam"), catalog.translation("rise")
    ('Anstieg', 'rise')
    """
    told: dict[tuple[str, str], tuple[str, ...]] = {}
    rule, unread = None, False
    for entry in _entries(text):
        forms = tuple(entry[key] for key in sorted(entry) if key.startswith("msgstr"))
        if entry["msgid"] and all(forms):
            told[entry.get("msgctxt", ""), entry["msgid"]] = forms
        elif not entry["msgid"]:  # the header
            rule, unread = _PLURAL_PATTERN.search(forms[0]), _UNREVIEWED_PATTERN.search(forms[0]) is not None
    return Catalog(told, gettext.c2py(rule[1]) if rule else one_or_many, unread)


def _entries(text: str) -> Iterator[Entry]:
    """The entries of a file that are not fuzzy, with their strings put together."""
    entry: Entry = {}
    keyword, fuzzy, next_fuzzy = "", False, False
    for line in text.splitlines():
        if line.startswith("#,"):
            next_fuzzy = "fuzzy" in line
        if (found := _LINE_PATTERN.fullmatch(line)) is None:
            continue
        begun = found[1]
        if begun in ("msgctxt", "msgid") and "msgid" in entry:
            if not fuzzy:
                yield entry
            entry = {}
        if begun and not entry:
            fuzzy, next_fuzzy = next_fuzzy, False
        keyword = begun or keyword
        entry[keyword] = entry.get(keyword, "") + _unescaped(found[2])
    if "msgid" in entry and not fuzzy:
        yield entry


def _unescaped(quoted: str) -> str:
    """What stands between quotes."""
    return _ESCAPE_PATTERN.sub(lambda sign: _ESCAPE_VALUES.get(sign[1], sign[1]), quoted) if "\\" in quoted else quoted


@dataclass(frozen=True)
class Language:
    """A language: how it says captions, and how it writes numbers.

    name : as in a task file, "en"
    catalog : of the templates; what it leaves out stays English

    >>> from graphcam.words import say
    >>> russian = language("ru")
    >>> russian.text(say("{value:.2f} {unit}", value=1.5, unit=say("mm")))
    '1,50 мм'
    >>> ENGLISH.text(say("{value:.2f} {unit}", value=-1.5, unit=say("mm")))
    '−1.50 mm'
    """

    name: str
    catalog: Catalog = field(default_factory=Catalog, repr=False, compare=False)

    @cached_property
    def decimal(self) -> str:
        """What stands before the decimals."""
        return self._template(DECIMAL_SIGN)

    @property
    def remark(self) -> str:
        """What whoever reads the language should know of the translation; empty where a native speaker has read it."""
        return self.text(UNREVIEWED_NOTE) if self.catalog.unread else ""

    @cached_property
    def has_messages(self) -> bool:
        """Whether the command line can speak it: its catalog has the messages too, or it is that of the code."""
        return self.name == ENGLISH.name or ("", SENTENCE) in self.catalog.told

    def text(self, words: Words) -> str:
        """What somebody who speaks the language writes; half a message in it would be English, and is so as a whole."""
        if isinstance(words, str):
            return words
        if isinstance(words, Message) and not self.has_messages:
            return str(words)
        template, typed = self._template(words), isinstance(words, Message)
        # Texts alone are written in every language as they are.
        if all(isinstance(value, str) for value in words.values.values()):
            return template.format_map(words.values)
        return template.format_map({name: _Written(value, self, typed) for name, value in words.values.items()})

    def _template(self, caption: Caption) -> str:
        if caption.plural:
            return self.catalog.plural_translation(caption.template, caption.plural, caption.count)
        return self.catalog.translation(caption.template, caption.context)


class _Written:
    """A value in a place of a template: a caption in the language, a number with its decimal sign and a true minus.

    typed : numbers stand as they are typed
    """

    __slots__ = ("language", "typed", "value")

    def __init__(self, value: Any, language: Language, typed: bool) -> None:
        self.value, self.language, self.typed = value, language, typed

    def __getattr__(self, name: str) -> _Written:
        return _Written(getattr(self.value, name), self.language, self.typed)

    def __repr__(self) -> str:
        return repr(self.value)

    def __format__(self, format_spec: str) -> str:
        value = self.value
        if isinstance(value, Caption):
            value = self.language.text(message(value) if self.typed else value)
        if isinstance(value, str) or self.typed:
            return format(value, format_spec)
        written = format(value, format_spec).replace(".", self.language.decimal)
        return _power(written).replace("-", MINUS_SIGN) if isinstance(value, Real) else written


def _power(number: str) -> str:
    """A number with its power of ten as it is written, not as a program reads it.

    >>> _power("2.008e+05"), _power("1e-09"), _power("12.5")
    ('2.008·10⁵', '1·10⁻⁹', '12.5')
    """
    mantissa, e, power = number.partition("e")
    if not e or not power.lstrip("+-").isdecimal():
        return number
    return mantissa + "·10" + str(int(power)).translate(str.maketrans("0123456789-", SUPERSCRIPTS))


ENGLISH = Language("en")


def _folder() -> Path:
    return Path(str(resources.files("graphcam").joinpath("data", "languages")))


def languages() -> tuple[str, ...]:
    """The names of the languages there are: English, and every one that has a catalog.

    >>> {"en", "ru"} <= set(languages())
    True
    """
    return (ENGLISH.name, *sorted(path.stem for path in _folder().glob("*.po")))


@cache
def language(name: str) -> Language:
    """The language of that name.

    Raises
    ------
    DesignError : there is no such language
    """
    if name == ENGLISH.name:
        return ENGLISH
    if name not in languages():
        raise DesignError("language", name, *among(name, languages()))
    return Language(name, read_catalog((_folder() / f"{name}.po").read_text(encoding="utf-8")))
