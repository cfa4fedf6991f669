"""Tables to and from spreadsheets: no text of a stranger is taken for a formula."""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from functools import lru_cache
from pathlib import Path

from graphcam.decoded_text import decoded_text
from graphcam.errors import TaskError, unreadable_error
from graphcam.words import Words, say

FORMULA_STARTS = ("=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠")
"""What makes a spreadsheet calculate a text instead of showing it; the wide forms count as the plain ones do."""
_FORMULA_AFTER_SEPARATOR = re.compile(r"([;\t\r\n][\s\"']*)(?=[=+\-@＝＋－＠])")
"""A formula behind what separates cells or rows where the comma is decimal: there the file opens with other cells."""


def cell(value: object) -> str:
    """A cell: numbers as they are, text such that no spreadsheet takes it for a formula.

    >>> cell(2.5), cell(-1.0), cell("-1"), cell(" =1+1"), cell(None), cell(True)
    ('2.5', '-1', "'-1", "' =1+1", '', 'yes')
    >>> cell("\\u200b\\xa0=1")[0], cell("\\u202bAnna")[0] == "'"
    ("'", False)
    >>> cell("a;=1+1"), cell("Anna; Ben")
    ("a;'=1+1", 'Anna; Ben')
    """
    if isinstance(value, str):
        return _guarded(value)
    if value is None:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return f"{value:.10g}"
    return _guarded(str(value))


# A table says the same few names and outcomes in every row.
@lru_cache(maxsize=4096)
def _guarded(text: str) -> str:
    """A text such that no spreadsheet takes it for a formula."""
    # Surrogates that a folder's name may hold cannot be written.
    text = text.encode("utf-8", "backslashreplace").decode()
    text = _FORMULA_AFTER_SEPARATOR.sub(r"\1'", text)
    # What is not seen may stand before it: spaces of all kinds, marks of the direction of writing.
    seen = next((letter for letter in text if letter.isprintable() and not letter.isspace()), "")
    return f"'{text}" if seen in FORMULA_STARTS or text.startswith(FORMULA_STARTS) else text


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A CSV file's text: all cells in quotes, and none a formula.

    >>> print(table(("id", "marks"), [("=1", 2.5)]), end="")
    "id","marks"
    "'=1","2.5"
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n", quoting=csv.QUOTE_ALL)
    writer.writerow([cell(name) for name in head])
    writer.writerows([cell(value) for value in row] for row in rows)
    return text.getvalue()


def read_table(path: str | Path, what: Words) -> list[tuple[int, list[str]]]:
    """The rows of a CSV file that hold anything, each with the number of its line.

    The cells stand apart by commas or semicolons, whichever the first line has more of.

    what : the table, as a message names it: "the roster"

    Raises
    ------
    TaskError : the file cannot be read, or it is no CSV file in UTF-8
    """
    try:
        data = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        raise unreadable_error(path, what, say("a CSV file"), error) from None
    text = decoded_text(path, what, data, say("a CSV file in UTF-8"), say("save it as CSV UTF-8"))
    first = text.partition("\n")[0]
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=";" if first.count(";") > first.count(",") else ",")
    try:
        return [(reader.line_num, row) for row in reader if any(value.strip() for value in row)]
    except csv.Error as error:
        remedy = say("save it again from the spreadsheet")
        found = say("not readable ({error})", error=str(error))
        raise TaskError(str(path), what, found, say("a CSV file"), remedy) from None
