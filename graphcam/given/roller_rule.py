"""Rules of the schools for the roller radius, such as ``min(0.7 rho, 0.4 r0)``."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.words import Caption, Words, say

DEFAULT_RULE = "min(0.7 rho, 0.4 r0)"


@dataclass(frozen=True)
class NamedRule:
    """A rule of a school: its terms, and where it is taught."""

    rule: str
    source: Caption


NAMED_RULES = {
    "coursework": NamedRule(
        "min(0.65 rho, 0.4 r0)",
        say("coursework guides on the theory of machines: (0.65 to 0.8) ρ and at most 0.4 r₀, the smaller"),
    ),
    "coursework-prime-radius": NamedRule("0.45 r0", say("coursework guides on the theory of machines: 0.45 r₀")),
    "gorbenko": NamedRule("0.7 rho", say("Gorbenko, Teoriya mekhanizmov i mashin (2007), section 9.2: (0.7 to 0.8) ρ")),
    "least-profile-radius": NamedRule(
        "rho - 5",
        say("Chinese courses on the theory of machines: the profile keeps a radius of curvature of 3 to 5 mm at least"),
    ),
    "norton": NamedRule(
        "0.33 rho", say("R. L. Norton, Design of Machinery, chapter 8: ρ is at least 2 to 3 times the roller radius")
    ),
}
"""Rules by name.  Where a school gives a range, the end of it is taken that gives the smaller roller."""
_NUMBER_PATTERN = r"(\d+(?:\.\d+)?)"
_FACTOR_PATTERN = re.compile(rf"{_NUMBER_PATTERN}\s*\*?\s*(rho|r0)")
_MARGIN_PATTERN = re.compile(rf"rho\s*-\s*{_NUMBER_PATTERN}")
_NOTATION_PATTERNS = ((r"(?:ρ|rho)(?:_?min)?", "rho"), (r"r(?:₀|_0)", "r0"), ("[−–]", "-"), ("[·×]", "*"))
"""Patterns of what textbooks write, and what it is in a rule."""
_SEPARATING_COMMA_PATTERN = r"(?<!\d),|,(?!\d)"


@dataclass(frozen=True)
class Candidate:
    """One term of a rule: ``factor`` times rho or r0, less ``margin`` mm; ``source`` of a named rule."""

    text: str
    of: str
    factor: float = 1.0
    margin: float = 0.0
    source: Words = ""

    @property
    def formula_caption(self) -> Caption:
        """The term as a formula.

        >>> [str(term.formula_caption) for term in roller_rule("min(0.7 rho, 0.4 r0, rho - 4)")]
        ['0.7 ρ', '0.4 r₀', 'ρ − 4 mm']
        """
        if self.margin:
            return say("ρ − {margin:g} mm", margin=self.margin)
        return say("{factor:g} {of}", factor=self.factor, of="ρ" if self.of == "rho" else "r₀")

    def __call__(self, rho: float, r0: float) -> float:
        """The radius that this term proposes, in the unit of rho and r0."""
        return self.factor * (rho if self.of == "rho" else r0) - self.margin


def roller_rule(text: str) -> tuple[Candidate, ...]:
    """The terms of a rule; the smallest of what they propose is taken.

    Grammar: ``K rho``, ``K r0``, ``rho - MM`` or ``min(..., ...)`` of these, or a name of :data:`NAMED_RULES`.
    It may be written as in a textbook: ``ρ``, ``ρmin`` and ``rho_min`` are rho, ``r₀`` is r0, a semicolon parts terms,
    and a comma between digits is a decimal one where the terms have no meaning otherwise.

    Raises
    ------
    DesignError : the text is not such a rule

    >>> [term(rho=50.0, r0=40.0) for term in roller_rule("min(0.7 rho, 0.4 r0, rho - 4)")]
    [35.0, 16.0, 46.0]
    >>> [term.text for term in roller_rule("coursework")]
    ['0.65 rho', '0.4 r0']
    >>> [term.text for term in roller_rule("min(0,7ρmin; 0,4 r₀)")]
    ['0.7rho', '0.4 r0']
    """
    if text in NAMED_RULES:
        named = NAMED_RULES[text]
        return tuple(replace(term, source=named.source) for term in roller_rule(named.rule))
    for terms in (readings := list(_readings(text))):
        found = [_candidate(term) for term in terms]
        if all(found):
            return tuple(each for each in found if each)
    wrong = next(term for term in readings[-1] if _candidate(term) is None)
    remedy = say("in place of '{wrong}' write a term such as 0.7 rho, 0.4 r0 or rho - 5", wrong=wrong)
    if re.fullmatch(r"[a-z-]+", text):
        remedy = nearest_word_remedy(text, NAMED_RULES)
    limit = say("'K rho', 'K r0', 'rho - MM', min(..., ...) of these or the name of a rule")
    raise DesignError(say("roller rule"), text, limit, remedy)


def _readings(rule: str) -> Iterator[list[str]]:
    """The terms of a rule, as the commas can be read: between terms, then as decimal ones between digits.

    >>> list(_readings("min(0,7 rho, rho - 5)"))
    [['0', '7 rho', 'rho - 5'], ['0,7 rho', 'rho - 5']]
    """
    inner = re.fullmatch(r"\s*min\s*\((.*)\)\s*", rule)
    if inner is None:
        yield [rule.strip()]
    elif ";" in inner[1]:
        yield [term.strip() for term in inner[1].split(";")]
    else:
        yield [term.strip() for term in inner[1].split(",")]
        yield [term.strip() for term in re.split(_SEPARATING_COMMA_PATTERN, inner[1])]


def _candidate(text: str) -> Candidate | None:
    """The term that a text is, if it is one; a comma in it is a decimal one."""
    term = text.replace(",", ".")
    for written, plain in _NOTATION_PATTERNS:
        term = re.sub(written, plain, term)
    if match := _FACTOR_PATTERN.fullmatch(term):
        return Candidate(term, match[2], factor=float(match[1]))
    if match := _MARGIN_PATTERN.fullmatch(term):
        return Candidate(term, "rho", margin=float(match[1]))
    return None
