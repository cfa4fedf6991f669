"""Markdown: numbers, texts and tables as a note prints them."""

import math
import re
from collections.abc import Iterable, Sequence

from graphcam.indices import in_html
from graphcam.language import MINUS
from graphcam.words import Caption, Tell, Words, say, sequence


def number(value: float, digits: int = 2, *, sign: bool = False) -> Caption:
    """A number with so many decimals, a dash where there is none, no minus before zero.

    >>> [str(x) for x in (number(2.345, 1), number(float("nan")), number(-0.001), number(0.5, sign=True))]
    ['2.3', '–', '0.00', '+0.50']
    """
    if not math.isfinite(value):
        return say("–")
    return say("{value:{sign}.{digits}f}", value=round(value, digits) + 0.0, sign="+" if sign else "-", digits=digits)


def numbers(**values: float) -> dict[str, Caption]:
    """Numbers with two decimals, by name.

    >>> str(say("r = {r}, e = {e}", **numbers(r=17, e=-10)))
    'r = 17.00, e = -10.00'
    """
    return {name: number(float(value)) for name, value in values.items()}


def text(plain: str) -> str:
    """A text of the user's, so that nothing in it is taken for markup.

    >>> text("Cam *A* | 2")
    'Cam \\\\*A\\\\* \\\\| 2'
    """
    return re.sub(r"([\\`*_\[\]<>|#$~])", r"\\\1", plain)


FORMULA = re.compile(r"((?<!\\)\$\$?[^$]+\$\$?)")


def printed(note: str) -> str:
    """A note as Markdown has it: indices as elements of HTML, and within formulas what TeX knows.

    There a decimal comma would be followed by a gap but for its braces.

    >>> printed("φ_у = 1,5, $r = −1,5$ mm, \\\\$2,5")
    'φ<sub>у</sub> = 1,5, $r = -1{,}5$ mm, \\\\$2,5'
    """
    return "".join(_in_tex(part) if k % 2 else in_html(part) for k, part in enumerate(FORMULA.split(note)))


def _in_tex(tex: str) -> str:
    return re.sub(r"(?<=\d),(?=\d)", "{,}", tex).replace(MINUS, "-")


def formula(tex: str, **values: Words) -> Caption:
    r"""A formula in TeX, which keeps its braces to itself: a value stands where its name does in angle brackets.

    >>> str(formula("$\\frac{<s>}{2}$", s=number(3)))
    '$\\frac{3.00}{2}$'
    """
    parts = re.split(r"<(\w+)>", tex)
    return sequence([values[part] if k % 2 else part for k, part in enumerate(parts)], "")


def blocks(*parts: Words, tell: Tell = str) -> str:
    """Paragraphs, tables and formulas one under the other; empty ones are left out.

    >>> blocks("One.", "", say("Two."))
    'One.\\n\\nTwo.'
    """
    return "\n\n".join(tell(part) for part in parts if part)


def table(header: Sequence[Words], rows: Iterable[Sequence[Words]], tell: Tell = str) -> str:
    """A table: the first column to the left, the others to the right, every column as wide as its widest cell.

    >>> print(table(("law", "C"), [("cosine", "4.93"), ("2-3", "6")]))
    | law    |    C |
    | :----- | ---: |
    | cosine | 4.93 |
    | 2-3    |    6 |
    """
    told = [[tell(cell) for cell in row] for row in (header, *rows)]
    widths = [max(3, *(len(row[k]) for row in told)) for k in range(len(header))]

    def line(cells: Sequence[str]) -> str:
        """A row, the first cell to the left and the others to the right."""
        first, *rest = zip(cells, widths, strict=True)
        return "| " + " | ".join([f"{first[0]:<{first[1]}}", *(f"{cell:>{width}}" for cell, width in rest)]) + " |"

    ruler = [":" + "-" * (widths[0] - 1), *("-" * (width - 1) + ":" for width in widths[1:])]
    return "\n".join([line(told[0]), line(ruler), *(line(row) for row in told[1:])])
