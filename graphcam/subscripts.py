"""Indices in texts: by Unicode where it has their letters (μₐ, r₀), else after an underscore (φ_у, φ_д.с).

So a text can be read wherever it is printed; sheets and pages set the letters lower.
"""

import re
from collections.abc import Iterator
from unicodedata import normalize

# The index of a single Greek letter alone: my_cam.toml has none.
UNDERSCORE_PATTERN = re.compile(r"(?<!\w)([Α-Ωα-ω])_(\w+(?:\.\w+)*)")
SUBSCRIPT_PATTERN = re.compile("[\u2080-\u209c\u1d62-\u1d6a\u2c7c]+")

_SUBSCRIPT_DIGITS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def parts(text: str) -> Iterator[tuple[str, bool]]:
    """The pieces of a text, each with whether it is an index; indices are in plain letters.

    >>> list(parts("μₐ = 2, φ_д.с = 45°"))
    [('μ', False), ('a', True), (' = 2, φ', False), ('д.с', True), (' = 45°', False)]
    """
    end = 0
    for found in re.finditer(f"{UNDERSCORE_PATTERN.pattern}|{SUBSCRIPT_PATTERN.pattern}", text):
        start = found.end(1) if found[1] else found.start()
        if start > end:
            yield text[end:start], False
        yield plain_index(found[2] or found[0]), True
        end = found.end()
    if end < len(text):
        yield text[end:], False


def plain_index(index: str) -> str:
    """An index in letters of full size on the base line.

    >>> plain_index("₂₁"), plain_index("у₁")
    ('21', 'у1')
    """
    return normalize("NFKC", index)


def indexed(name: str) -> str:
    """A name with its digits as an index.

    >>> indexed("C1"), indexed("G")
    ('C₁', 'G')
    """
    return name.translate(_SUBSCRIPT_DIGITS)


def in_html(text: str) -> str:
    """A text of HTML or Markdown, with elements ``sub`` for indices that Unicode has no letters for.

    >>> in_html("φ_у = 80°, r₀")
    'φ<sub>у</sub> = 80°, r₀'
    """
    return UNDERSCORE_PATTERN.sub(lambda found: f"{found[1]}<sub>{plain_index(found[2])}</sub>", text)
