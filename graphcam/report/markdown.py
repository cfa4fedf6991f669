"""Markdown: numbers, texts, numbered formulas and tables as a note prints them."""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any

from graphcam.language import MINUS_SIGN, SUPERSCRIPTS
from graphcam.subscripts import in_html
from graphcam.words import Caption, Tell, Words, say, sequence

FINEST_READING = 0.01
"""The smallest length on paper that can be read [mm]."""


def digits(per_mm: float) -> int:
    """The number of decimals of a value whose scale is ``per_mm``: those of the finest reading on paper.

    >>> digits(0.48), digits(2.0), digits(500.0)
    (3, 2, 0)
    """
    return max(0, math.ceil(-math.log10(FINEST_READING * per_mm)))


def number(value: float, digits: int = 2, *, sign: bool = False) -> Caption:
    """A number with so many decimals, a dash in place of NaN, and no minus before zero.

    >>> [str(x) for x in (number(2.345, 1), number(float("nan")), number(-0.001), number(0.5, sign=True))]
    ['2.3', '–', '0.00', '+0.50']
    """
    if not math.isfinite(value):
        return say("–")
    return say("{value:{sign}.{digits}f}", value=round(value, digits) + 0.0, sign="+" if sign else "-", digits=digits)


def numbers(**values: float) -> dict[str, Caption]:
    """The values by their names, as numbers with two decimals.

    >>> str(say("r = {r}, e = {e}", **numbers(r=17, e=-10)))
    'r = 17.00, e = -10.00'
    """
    return {name: number(float(value)) for name, value in values.items()}


def general(value: float, digits: int = 6) -> Caption:
    """A number with so many significant digits, without needless zeros."""
    if math.isinf(value):
        return say("∞")
    return say("{value:.{digits}g}", value=value, digits=digits)


def warning(sentence: Words) -> Caption:
    """A sentence as a warning, in bold."""
    return say("**{sentence}**", sentence=sentence)


def text(plain: str) -> str:
    """A text with its Markdown characters escaped.

    >>> text("Cam *A* | 2")
    'Cam \\\\*A\\\\* \\\\| 2'
    """
    return re.sub(r"([\\`*_\[\]<>|#$~])", r"\\\1", plain)


FORMULA_PATTERN = re.compile(r"((?<!\\)\$\$?[^$]+\$\$?)")


def printed_note(note: str) -> str:
    """A note as Markdown: indices become elements of HTML, and commands of TeX within formulas.

    A decimal comma in a formula gets braces, without which a gap would follow it.

    >>> printed_note("φ_у = 1,5, $r = −1,5·10⁵$ mm, \\\\$2,5")
    'φ<sub>у</sub> = 1,5, $r = -1{,}5 \\\\cdot 10^{5}$ mm, \\\\$2,5'
    """
    return "".join(_in_tex(part) if k % 2 else in_html(part) for k, part in enumerate(FORMULA_PATTERN.split(note)))


def _in_tex(tex: str) -> str:
    tex = re.sub(r"(?<=\d),(?=\d)", "{,}", tex).replace(MINUS_SIGN, "-")
    raised = {high: low for low, high in zip("0123456789-", SUPERSCRIPTS, strict=True)}
    power = rf"·10([{SUPERSCRIPTS}]+)"
    return re.sub(power, lambda found: f" \\cdot 10^{{{''.join(raised[c] for c in found[1])}}}", tex)


def formula(tex: str, **values: Any) -> Caption:
    r"""A formula in TeX, in which a name in angle brackets is the place of a value.

    >>> str(formula("$\\frac{<s:.2f>}{<n>}$", s=3, n="2"))
    '$\\frac{3.00}{2}$'
    """
    parts = re.split(r"<(\w+)(:[^<>]+)?>", tex)
    told: list[Words] = []
    for literal, name, form in zip(parts[::3], [*parts[1::3], ""], [*parts[2::3], None], strict=True):
        told += [literal, *([_value(values[name], form)] if name else [])]
    return sequence(told, "")


def _value(value: Any, form: str | None) -> Words:
    if form is None or isinstance(value, str | Caption):
        return value if isinstance(value, str | Caption) else say("{value}", value=value)
    if not math.isfinite(value):
        return say("–")
    if form.endswith("f"):
        return number(value, int(form[2:-1]))
    # The template is a number alone, without words to translate.
    return Caption(template="{value" + form + "}", values={"value": value + 0.0})


@dataclass(frozen=True)
class Equation:
    """A numbered formula on a line of its own; ``tex`` without dollars."""

    tex: Words


@dataclass(frozen=True)
class Grid:
    """A numbered table with its title; with ``of_words`` all columns are aligned to the left."""

    title: Words
    header: Sequence[Words]
    rows: Iterable[Sequence[Words]]
    of_words: bool = False


Block = Words | Equation | Grid
"""A paragraph, a formula or a table."""


def blocks(*parts: Block, tell: Tell = str) -> str:
    """The blocks as Markdown, one under the other, tables and formulas numbered; empty blocks are left out.

    >>> blocks("One.", "", Equation("x = 1"), say("Two."))
    'One.\\n\\n$$x = 1 \\\\tag{1}$$\\n\\nTwo.'
    """
    formulas, tables = count(1), count(1)

    def told(block: Block) -> str:
        """The Markdown of a block with its number."""
        if isinstance(block, Equation):
            return f"$${tell(block.tex)} \\tag{{{next(formulas)}}}$$"
        if isinstance(block, Grid):
            title = say("Table {number}. {title}", number=next(tables), title=block.title)
            return f"*{tell(title)}*\n\n{table(block.header, block.rows, tell, of_words=block.of_words)}"
        return tell(block)

    return "\n\n".join(told(part) for part in parts if part)


def table(header: Sequence[Words], rows: Iterable[Sequence[Words]], tell: Tell = str, *, of_words: bool = False) -> str:
    """A table in Markdown: the first column to the left, the others to the right, each as wide as its widest cell.

    of_words : all columns to the left

    >>> print(table(("law", "C"), [("cosine", "4.93"), ("2-3", "6")]))
    | law    |    C |
    | :----- | ---: |
    | cosine | 4.93 |
    | 2-3    |    6 |
    """
    told = [[tell(cell) for cell in row] for row in (header, *rows)]
    widths = [max(3, *(len(row[k]) for row in told)) for k in range(len(header))]

    sides = ["<", *((">", "<")[of_words] for _ in widths[1:])]

    def line(cells: Sequence[str]) -> str:
        """The text of a row."""
        return (
            "| " + " | ".join(f"{c:{side}{width}}" for c, side, width in zip(cells, sides, widths, strict=True)) + " |"
        )

    rules = (
        ":" + "-" * (width - 1) if side == "<" else "-" * (width - 1) + ":"
        for side, width in zip(sides, widths, strict=True)
    )
    return "\n".join([line(told[0]), line([*rules]), *(line(row) for row in told[1:])])
