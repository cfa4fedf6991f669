"""The note as a page that prints: its Markdown as HTML, with formulas that a browser draws without a script."""

import re
from html import escape
from importlib import resources

from graphcam.report.markdown import FORMULA

COMMA = re.compile(r"<mn>(\d+)</mn><mrow><mo>&#x0002C;</mo></mrow><mn>(\d+)</mn>")
"""A decimal comma, which is no operator with a gap behind it."""
TAG = re.compile(r"\\tag\{(\d+)\}")
TABLE = re.compile("<table>(?=(.*?)</thead>)", re.DOTALL)
WIDE = 7
"""Tables that have more of "<th" than this in their heads, the head itself counted, have smaller letters."""


def mathml(latex: str, display: str = "inline") -> str:
    r"""A formula in LaTeX as MathML; display : "inline" or "block".

    >>> mathml(r"0{,}5")
    '<math xmlns="http://www.w3.org/1998/Math/MathML" display="inline"><mrow><mn>0,5</mn></mrow></math>'
    """
    # The engine of the studio runs where there is no such library.
    from latex2mathml.converter import convert

    return COMMA.sub(r"<mn>\1,\2</mn>", convert(latex.strip(), display=display))


def note_page(note: str, language: str) -> str:
    """A note in Markdown as a page that stands alone.

    >>> page = note_page("# Cam\\n\\nWith $r$:\\n\\n$$s = r \\\\tag{1}$$\\n", "en")
    >>> "<h1>Cam</h1>" in page, page.count("<math"), '<span class="number">(1)</span>' in page
    (True, 2, True)
    """
    import mistune

    parts = FORMULA.split(note)
    source = "".join(_formula(part) if k % 2 else part for k, part in enumerate(parts))
    body = str(mistune.create_markdown(escape=False, plugins=["table"])(source))
    body = TABLE.sub(lambda found: '<table class="wide">' if found[1].count("<th") > WIDE else "<table>", body)
    css = resources.files("graphcam").joinpath("data", "note", "note.css").read_text(encoding="utf-8")
    title = escape(re.sub(r"\\(.)", r"\1", note.partition("\n")[0].removeprefix("# ")))
    head = f'<meta charset="utf-8"><title>{title}</title>\n<style>\n{css}</style>'
    return f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n{head}\n</head>\n<body>\n{body}</body>\n</html>\n'


def _formula(tex: str) -> str:
    """A formula between its dollars: within a line, or on lines of its own with its number."""
    if not tex.startswith("$$"):
        return mathml(tex.strip("$"))
    tex = tex.strip("$")
    number = "".join(f'<span class="number">({found})</span>' for found in TAG.findall(tex))
    # What stands side by side may also stand one below the other.
    lines = "".join(mathml(r"\displaystyle " + part) for part in TAG.sub("", tex).split(r"\qquad"))
    return f'<div class="formula"><span class="lines">{lines}</span>{number}</div>'
