"""Languages: English as it is written in the code, every other one from a catalog ``data/languages/NAME.po``.

A catalog is an ordinary gettext file, and it is there when its file is: nothing else names the languages.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from gettext import GNUTranslations, NullTranslations
from importlib import resources
from io import BytesIO
from numbers import Real
from pathlib import Path
from typing import Any

from graphcam.errors import DesignError
from graphcam.words import Caption, Words

MINUS = "−"
"""As wide as a plus; a hyphen is what a program reads."""


@dataclass(frozen=True)
class Language:
    """A language: how it says captions, and how it writes numbers.

    name : as in a task file, "en"
    decimal : what stands before the decimals
    translations : of the templates; what a catalog leaves out stays English

    >>> from graphcam.words import say
    >>> russian = language("ru")
    >>> russian.text(say("{value:.2f} {unit}", value=1.5, unit=say("mm")))
    '1,50 мм'
    >>> ENGLISH.text(say("{value:.2f} {unit}", value=-1.5, unit=say("mm")))
    '−1.50 mm'
    """

    name: str
    decimal: str = "."
    translations: NullTranslations = field(default_factory=NullTranslations, repr=False, compare=False)

    def text(self, words: Words) -> str:
        """What somebody who speaks the language writes."""
        if isinstance(words, str):
            return words
        template = self._template(words)
        # Texts alone are written in every language as they are.
        if all(isinstance(value, str) for value in words.values.values()):
            return template.format_map(words.values)
        return template.format_map({name: _Written(value, self) for name, value in words.values.items()})

    def _template(self, caption: Caption) -> str:
        one, many, context = caption.template, caption.plural, caption.context
        if not one:  # the catalog's own header stands there
            return ""
        if many:
            return self.translations.ngettext(one, many, caption.count)
        return self.translations.pgettext(context, one) if context else self.translations.gettext(one)


class _Written:
    """A value in a place of a template: a caption in the language, a number with its decimal sign and a true minus."""

    __slots__ = ("language", "value")

    def __init__(self, value: Any, language: Language) -> None:
        self.value, self.language = value, language

    def __getattr__(self, name: str) -> _Written:
        return _Written(getattr(self.value, name), self.language)

    def __format__(self, format_spec: str) -> str:
        value = self.value
        if isinstance(value, (str, Caption)):
            return format(self.language.text(value), format_spec)
        written = format(value, format_spec).replace(".", self.language.decimal)
        return written.replace("-", MINUS) if isinstance(value, Real) else written


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
        raise DesignError("language", name, "one of " + ", ".join(languages()))
    # Only another language needs Babel.
    from babel import Locale
    from babel.messages.mofile import write_mo
    from babel.messages.pofile import read_po

    with (_folder() / f"{name}.po").open("rb") as file:
        catalog = read_po(file, locale=name)
    compiled = BytesIO()
    write_mo(compiled, catalog)
    compiled.seek(0)
    return Language(name, Locale.parse(name).number_symbols["latn"]["decimal"], GNUTranslations(compiled))
