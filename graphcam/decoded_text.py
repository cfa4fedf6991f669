"""The text of a file that somebody gives; of another kind of file it is told what it is and what to do."""

from pathlib import Path

from graphcam.errors import TaskError
from graphcam.words import Words, say

SAVE_AS_UTF_8 = say("save the file as UTF-8")
_SIGNATURES: tuple[tuple[bytes, Words], ...] = (
    (b"PK\x03\x04", say("an Excel workbook or another Office document")),
    (b"\xd0\xcf\x11\xe0", say("an Excel workbook or another Office document")),
    (b"%PDF", say("a PDF")),
    (b"\x89PNG", say("a picture")),
    (b"\xff\xd8\xff", say("a picture")),
)
"""How files begin that are no text, and what they are."""
_UTF_16_MARKS = b"\xff\xfe", b"\xfe\xff"
MIN_CYRILLIC_SHARE = 0.9
"""So many of the letters beyond ASCII are Cyrillic where a text is in Windows-1251."""


def decoded_text(path: str | Path, what: Words, content: bytes, expected: Words, remedy: Words) -> str:
    """The text of a file in UTF-8, with or without a mark of its order of bytes.

    what, expected, remedy : of the message for a file that is no text: "the roster", "a CSV file", "save it as CSV"

    Raises
    ------
    TaskError : it is no text, or in another encoding

    >>> decoded_text("a.csv", "the table", b"PK\\x03\\x04", "a CSV file", "save it as CSV")
    Traceback (most recent call last):
    graphcam.errors.TaskError: a.csv: the table is an Excel workbook or another Office document, but must be ...
    """
    for begin, found in _SIGNATURES:
        if content.startswith(begin):
            raise TaskError(str(path), what, found, expected, remedy)
    if content.startswith(_UTF_16_MARKS) or 4 * content.count(0) > len(content):
        raise TaskError(str(path), what, say("text in UTF-16"), say("text in UTF-8"), SAVE_AS_UTF_8)
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        where = say("line {line}", line=line)
        raise TaskError(str(path), where, _encoding(content), say("text in UTF-8"), SAVE_AS_UTF_8) from None


def _encoding(content: bytes) -> Words:
    letters = bytes(byte for byte in content if byte > 127).decode("cp1251", errors="replace")
    cyrillic = sum("\u0400" <= letter <= "\u04ff" for letter in letters)
    if cyrillic >= MIN_CYRILLIC_SHARE * len(letters):
        return say("in another encoding, Windows-1251 by its letters")
    return say("in another encoding")
