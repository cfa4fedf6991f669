"""What people type for the words that graphcam reads: one table of synonyms, one slip of a key, a word that is begun.

The table is ``data/typed_words.toml``.  Capitals, hyphens, underscores and spaces do not count.
"""

import re
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import resources

MIN_LETTERS_OF_SLIP = 4
"""A shorter word is another word after one slip of a key."""
MIN_LETTERS_OF_SYNONYM = 7
"""A shorter synonym is not recognised with a slip of a key."""
Synonyms = Mapping[str, tuple[str, ...]]
_ENDINGS = re.compile(r"(?<=\w{4})(?:ый|ий|ой|ая|яя|ое|ее|ые|ие|ого|его|ому|ему|ым|им|ом|ем|ую|юю)\b")
"""Endings of Russian adjectives: a law is masculine, an acceleration neuter."""
_GENERIC_WORDS = re.compile(
    r"\b(?:law|motion|curve|profile|follower|закон|движения|движение|толкатель|Gesetz|quy luật)\b|规律|曲线",
    re.IGNORECASE,
)
"""Words that may stand beside the name of a law or of a kind."""
_WORD_PATTERN = re.compile(r"[^\W_]+")


@cache
def table() -> Mapping[str, Synonyms]:
    """Synonyms by the word that graphcam reads, by their section."""
    path = resources.files("graphcam").joinpath("data", "typed_words.toml")
    read = tomllib.loads(path.read_text(encoding="utf-8"))
    return {section: {name: tuple(words) for name, words in named.items()} for section, named in read.items()}


@cache
def plain(word: str) -> str:
    """A word without capitals, accents of width, hyphens, underscores and spaces; a sign alone stays.

    >>> plain("Flat-Faced"), plain("roller_radius"), plain("°")
    ('flatfaced', 'rollerradius', '°')
    """
    folded = unicodedata.normalize("NFKC", word).casefold().replace("ё", "е")
    return "".join(_WORD_PATTERN.findall(folded)) or word.strip()


@cache
def names_of(word: str, section: str = "") -> tuple[str, ...]:
    """The words of graphcam that a word is a synonym of, in one section or in all but those of numbers.

    >>> names_of("линейно убывающее ускорение"), names_of("acw"), names_of("cw")
    (('2-3',), ('ccw',), ())
    """
    sections = (
        [section] if section else [name for name in table() if name not in ("half", "double", "omega", "columns")]
    )
    called = plain(word)
    return tuple(
        dict.fromkeys(name for each in sections for name, words in table()[each].items() if called in map(plain, words))
    )


def meant(word: str, known: Iterable[str]) -> str:
    """The known word that is meant; empty where none is, or where it may be two.

    >>> meant("ACW", ["ccw", "cw"]), meant("cicloidal", ["cosine", "cycloidal"]), meant("step", ["rise", "dwell"])
    ('ccw', 'cycloidal', '')
    """
    known = list(dict.fromkeys(known))
    bare = _GENERIC_WORDS.sub("", word).strip()
    if bare and bare != word and (name := meant(bare, known)):
        return name
    if alike := [name for name in known if plain(name) == plain(word)]:
        return alike[0]
    if called := [name for name in names_of(word) if name in known]:
        return called[0] if len(called) == 1 else ""
    whole = len(word) >= MIN_LETTERS_OF_SLIP and not any(letter.isdigit() for letter in word)
    if begun := [name for name in known if whole and plain(name).startswith(plain(word))]:
        return begun[0] if len(begun) == 1 else ""
    spelled = {name: name for name in known}
    spelled |= {
        other: name
        for words in table().values()
        for name in words
        if name in known
        for other in words[name]
        if len(other) >= MIN_LETTERS_OF_SYNONYM
    }
    bare = _ENDINGS.sub("", unicodedata.normalize("NFKC", word).casefold().replace("ё", "е"))
    stems = {name for other, name in spelled.items() if _ENDINGS.sub("", other.casefold().replace("ё", "е")) == bare}
    near = stems or {name for other, name in spelled.items() if _is_slip(word, other)}
    return near.pop() if len(near) == 1 else ""


def _is_slip(word: str, other: str) -> bool:
    """Whether a word is another one after one slip of a key, or one in each of several parts of it."""
    # A number is another name, not a slip.
    if re.findall(r"\d", word) != re.findall(r"\d", other):
        return False
    if _one_slip(plain(word), plain(other)):
        return True
    parts = [_WORD_PATTERN.findall(text.casefold()) for text in (word.replace("_", " "), other.replace("_", " "))]
    return len(parts[0]) == len(parts[1]) > 1 and all(
        one == two or _one_slip(one, two) for one, two in zip(*parts, strict=True)
    )


def _one_slip(word: str, other: str) -> bool:
    """Whether one letter is left out, added, mistaken, or exchanged with the next."""
    if max(len(word), len(other)) < MIN_LETTERS_OF_SLIP or abs(len(word) - len(other)) > 1:
        return False
    ahead = next((k for k, (a, b) in enumerate(zip(word, other, strict=False)) if a != b), min(len(word), len(other)))
    one, two = word[ahead:], other[ahead:]
    exchanged = one[:2] == two[1::-1] and one[2:] == two[2:]
    return exchanged or one[1:] == two[1:] or one[1:] == two or one == two[1:]
