"""Sentences as data: a template and its values, kept apart so that each language can translate the template.

Templates are written in English, and literally where they are used, so that the tools of gettext find them.  A plain
``str`` among the values is the same in every language: the name of a point, a formula's symbol, what a user wrote.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Caption:
    """A text in which numbers, symbols and other captions stand.

    template : English, in the style of :meth:`str.format`
    values : by the names of the template's places
    context : distinguishes templates that are alike in English but not in every language
    plural : the template for any ``count`` but 1, if the two differ

    >>> str(Caption("The pole distance is {h:.1f} mm.", {"h": 40}))
    'The pole distance is 40.0 mm.'
    """

    template: str
    values: Mapping[str, Any] = field(default_factory=dict[str, Any])
    context: str = ""
    plural: str = ""
    count: int = 1

    def __str__(self) -> str:
        template = self.plural if self.plural and self.count != 1 else self.template
        return template.format(**self.values)

    def __hash__(self) -> int:
        # Types of fields that are marked with a caption have to be hashed; values need not be hashable.
        return hash((self.template, self.context))

    def with_values(self, **values: Any) -> Caption:
        """The caption with these values besides those that it has.

        >>> str(say("The ray is {length:.1f} mm long.").with_values(length=3.14))
        'The ray is 3.1 mm long.'
        """
        return Caption(self.template, {**self.values, **values}, self.context, self.plural, self.count)


@dataclass(frozen=True)
class Message(Caption):
    """A caption about typed input: numbers stand in it as they were typed, in every language."""


Words = str | Caption
"""A text: the same in every language (``str``), or translated (``Caption``)."""
Tell = Callable[[Words], str]
"""A translator of texts, such as :meth:`graphcam.language.Language.text`; ``str`` gives English."""


def say(template: str, /, **values: Any) -> Caption:
    """A caption from a template in the style of :meth:`str.format` and its values.

    >>> str(say("Rise {number}", number=1))
    'Rise 1'
    """
    return Caption(template, values)


def say_in(context: str, template: str, /, **values: Any) -> Caption:
    """A caption whose meaning depends on a ``context``, for words that are ambiguous in English.

    >>> str(say_in("of a title block", "Sheet {number}", number=2))
    'Sheet 2'
    """
    return Caption(template, values, context)


def say_many(one: str, many: str, count: int, /, **values: Any) -> Caption:
    """A caption about a number of things, which stands in its place ``{count}``.

    >>> str(say_many("{count} part", "{count} parts", 1)), str(say_many("{count} part", "{count} parts", 12))
    ('1 part', '12 parts')
    """
    return Caption(one, {**values, "count": count}, "", many, count)


def sequence(items: Sequence[Words], separator: str = ", ") -> Caption:
    """A caption of texts one after another.

    >>> str(sequence([say("One."), say("Two.")], " "))
    'One. Two.'
    """
    names = [f"item{k}" for k in range(len(items))]
    return Caption(separator.join(f"{{{name}}}" for name in names), dict(zip(names, items, strict=True)))


def message(words: Words) -> Message:
    """The words as a message.

    >>> str(message(say("at most {most:g} mm", most=-0.5)))
    'at most -0.5 mm'
    """
    caption = bare_caption(words) if isinstance(words, str) else words
    return Message(caption.template, caption.values, caption.context, caption.plural, caption.count)


def bare_caption(text: str) -> Caption:
    """A caption of what somebody wrote, which a message shows without quotes.

    >>> str(bare_caption("[a, b]"))
    '[a, b]'
    """
    return Caption("{text}", {"text": text})


def or_list(items: Sequence[Words]) -> Words:
    """Texts joined as alternatives, with "or" before the last.

    >>> str(or_list(["a", "b", "c"])), str(or_list(["a"]))
    ('a, b or c', 'a')
    """
    *first, last = items
    return say("{first} or {last}", first=sequence(first), last=last) if first else last


def and_chain(items: Sequence[Words]) -> Words:
    """Texts joined with "and" between each two.

    >>> str(and_chain(["a", "b", "c"])), str(and_chain(["a"]))
    ('a and b and c', 'a')
    """
    first, *others = items
    for last in others:
        first = say("{first} and {last}", first=first, last=last)
    return first


def and_list(items: Sequence[Words]) -> Words:
    """Texts joined as a list, with commas and "and" before the last.

    >>> str(and_list(["a", "b", "c"])), str(and_list(["a"])), str(and_list([]))
    ('a, b and c', 'a', '')
    """
    *first, last = items or [""]
    return say("{first} and {last}", first=sequence(first), last=last) if first else last
