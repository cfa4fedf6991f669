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

from graphcam.errors import DesignError, choice_limit
from graphcam.words import Caption, Message, Words, message, say, say_in

MINUS_SIGN = "−"
"""The minus of printed numbers, which is as wide as a plus."""
SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
"""The digits and the minus of exponents."""
DECIMAL_SIGN = say_in("decimal sign", ".")
"""The decimal sign, which a catalog translates as it does every text."""
ERROR_TEMPLATE = "{what} is {shown}, but must be {allowed}"
"""The template of an error's sentence; a language whose catalog has it can tell messages."""
UNREVIEWED_NOTE = say("This translation has not yet been read by a native speaker.")


_LINE_PATTERN = re.compile(r'(?:(msgctxt|msgid|msgid_plural|msgstr(?:\[\d+\])?)\s*)?"(.*)"\s*')
_PLURAL_PATTERN = re.compile(r"^Plural-Forms:.*plural\s*=\s*([^;\n]+)", re.MULTILINE)
_UNREVIEWED_PATTERN = re.compile(r"^X-Read-By-Native-Speaker: *no *$", re.MULTILINE)
_ESCAPE_PATTERN = re.compile(r"\\(.)")
_ESCAPE_VALUES = {"n": "\n", "t": "\t", "r": "\r"}
Entry = dict[str, str]
"""An entry of a ``.po`` file: its strings by keyword ("msgid", "msgstr[1]")."""


def one_or_many(count: int) -> int:
    """The number of the plural form for a count by the rule of English, for a catalog that states no rule."""
    return int(count != 1)


@dataclass(frozen=True)
class Catalog:
    """The translations of one language.

    told : by context (empty where there is none) and text, its translations: one, or one for each plural form
    plural : gives the number of the plural form for a count
    unread : whether its header says ``X-Read-By-Native-Speaker: no``
    """

    told: Mapping[tuple[str, str], tuple[str, ...]] = field(default_factory=dict[tuple[str, str], tuple[str, ...]])
    plural: Callable[[int], int] = one_or_many
    unread: bool = False

    def translation(self, text: str, context: str = "") -> str:
        """The translation of a text; the text itself where there is none."""
        return self.told.get((context, text), (text,))[0]

    def plural_translation(self, one: str, many: str, count: int) -> str:
        """The translation of a text for a count, in its plural form."""
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
    """The entries of a file that are not fuzzy, their split strings joined."""
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
    return _ESCAPE_PATTERN.sub(lambda sign: _ESCAPE_VALUES.get(sign[1], sign[1]), quoted) if "\\" in quoted else quoted


@dataclass(frozen=True)
class Language:
    """A language: it translates captions and writes their numbers.

    name : as in a task file, such as "en"
    catalog : translations of the templates; what it lacks stays English

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
        """The decimal sign."""
        return self._template(DECIMAL_SIGN)

    @property
    def remark(self) -> str:
        """A remark for readers that no native speaker has read the translation; empty where one has."""
        return self.text(UNREVIEWED_NOTE) if self.catalog.unread else ""

    @cached_property
    def has_messages(self) -> bool:
        """Whether the command line has messages in this language: English, or the catalog translates them."""
        return self.name == ENGLISH.name or ("", ERROR_TEMPLATE) in self.catalog.told

    def text(self, words: Words) -> str:
        """The translated text; a message that the catalog has only in part stays English as a whole."""
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
    """A value in a template: a caption is translated, a number gets its decimal sign and a true minus.

    typed : numbers stay as they are typed, as in a message
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
    """A number with its power of ten in print form.

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
    """The names of the available languages: English, and every one with a catalog.

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
        raise DesignError("language", name, *choice_limit(name, languages()))
    return Language(name, read_catalog((_folder() / f"{name}.po").read_text(encoding="utf-8")))
