"""What can go wrong, said once: every error names the quantity, its value and what is allowed."""

from __future__ import annotations

import difflib
import math
import unicodedata
from collections.abc import Generator, Iterable, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any


class GraphcamError(Exception):
    """The base class of every error that graphcam raises on purpose."""


class DesignError(GraphcamError, ValueError):
    """A design that is impossible.

    Parameters
    ----------
    quantity : what is wrong, in the words of the textbook ("prime radius")
    value : the value it has
    limit : what is allowed ("greater than 0 mm")
    remedy : what to do about it; may be empty

    >>> import graphcam as gc
    >>> print(gc.DesignError("lift", -3, "greater than 0 mm", "give the height of the rise"))
    lift is -3, but must be greater than 0 mm; give the height of the rise
    """

    def __init__(self, quantity: str, value: object, limit: str, remedy: str = "") -> None:
        super().__init__(quantity, value, limit, remedy)
        self.quantity = quantity
        self.value = value
        self.limit = limit
        self.remedy = remedy

    def __str__(self) -> str:
        return _sentence(self.quantity, self.value, self.limit, self.remedy)


class TaskError(GraphcamError):
    """A task file that cannot be used: the file, the field, its value, what was expected, the remedy.

    >>> import graphcam as gc
    >>> print(gc.TaskError("cam.toml", "motion.phases[0].lift", 0, "greater than 0", "give the lift in mm"))
    cam.toml: motion.phases[0].lift is 0, but must be greater than 0; give the lift in mm
    """

    def __init__(self, path: str, field: str, value: object, expected: str, remedy: str = "") -> None:
        super().__init__(path, field, value, expected, remedy)
        self.path = path
        self.field = field
        self.value = value
        self.expected = expected
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.path}: {_sentence(self.field, self.value, self.expected, self.remedy)}"


class MissingFileError(TaskError):
    """A file or folder that is not where it is looked for.

    kind : what is missing, in a word
    where : where it was looked for, if the path does not say it

    >>> print(MissingFileError("motion.csv", "check motion.table", where="beside cam.toml"))
    there is no file motion.csv beside cam.toml; check motion.table
    """

    def __init__(self, path: str, remedy: str = "check the name", *, kind: str = "file", where: str = "") -> None:
        super().__init__(path, f"the {kind}", Unquoted("missing"), f"a {kind} that is there", remedy)
        self.kind = kind
        self.where = where

    def __str__(self) -> str:
        if self.where:
            return f"there is no {self.kind} {self.path} {self.where}; {self.remedy}"
        return f"there is no {self.kind} {self.path}; {self.remedy}"

    def __reduce__(self) -> tuple[Any, ...]:
        return _missing_file, (self.path, self.remedy, self.kind, self.where)


def _missing_file(path: str, remedy: str, kind: str, where: str) -> MissingFileError:
    """The error again, in another process."""
    return MissingFileError(path, remedy, kind=kind, where=where)


class Unquoted(str):
    """Words about a value, which a message shows without the quotes of a text that somebody wrote.

    >>> print(DesignError("arm", Unquoted("missing"), "given"), DesignError("arm", "12 mm", "a number"), sep="\\n")
    arm is missing, but must be given
    arm is '12 mm', but must be a number
    """

    __slots__ = ()
    __repr__ = str.__str__


class LetteringWarning(UserWarning):
    """A drawing has characters that no font on the machine has."""


def _sentence(what: str, value: object, allowed: str, remedy: str) -> str:
    shown = repr(value) if isinstance(value, str) else f"{value}"
    return f"{what} is {shown}, but must be {allowed}" + (f"; {remedy}" if remedy else "")


def install_advice(extra: str) -> str:
    """How an extra is installed: from the source that graphcam came from, as any index may hold another package.

    In double quotes, which every shell takes, and by the interpreter's own pip.

    >>> print(install_advice("photo"))
    in the folder of graphcam's source run: python -m pip install ".[photo]"
    """
    return f'in the folder of graphcam\'s source run: python -m pip install ".[{extra}]"'


@contextmanager
def installed(option: str, library: str, extra: str) -> Generator[None]:
    """An import of what an option needs and an extra brings.

    Raises
    ------
    TaskError : it is not there

    >>> with installed("--cluster", "dask", "cluster"):  # doctest: +ELLIPSIS
    ...     import no_such_module
    Traceback (most recent call last):
    graphcam.errors.TaskError: --cluster: dask is not installed, but must be installed; in the folder ...
    """
    try:
        yield
    except ImportError:
        missing = Unquoted("not installed")
        raise TaskError(option, library, missing, "installed", install_advice(extra)) from None


def unreadable(path: str | Path, what: str, expected: str, error: OSError | ValueError, remedy: str = "") -> TaskError:
    """The error of a file that cannot be read: it is missing, a folder, or what the system says.

    what : the file, as a message names it: "the roster"
    expected : what it must be: "a CSV file"
    remedy : of a missing one, in place of "check the name"

    >>> print(unreadable("no.csv", "the roster", "a CSV file", FileNotFoundError()))
    there is no file no.csv; check the name
    >>> print(unreadable("a.csv", "the roster", "a CSV file", PermissionError(13, "Permission denied")))
    a.csv: the roster is not readable (Permission denied), but must be a CSV file; check its permissions
    """
    if isinstance(error, FileNotFoundError):
        return MissingFileError(str(path), remedy or "check the name")
    if isinstance(error, IsADirectoryError | PermissionError) and Path(path).is_dir():
        return TaskError(str(path), what, Unquoted("a folder"), expected, "name the file in it")
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    denied = isinstance(error, PermissionError)
    advice = "check its permissions" if denied else "check the name"
    return TaskError(str(path), what, Unquoted(f"not readable ({why})"), expected, advice)


def check_kind(quantity: str, value: object, kinds: type | tuple[type, ...], limit: str = "", remedy: str = "") -> None:
    """That an argument is of a kind that a function can use.

    limit : what is allowed, in place of the names of the kinds

    Raises
    ------
    DesignError : it is another thing

    >>> check_kind("follower", 40, (str, list, dict))
    Traceback (most recent call last):
    graphcam.errors.DesignError: follower is of the kind int, but must be a str, list or dict
    """
    if isinstance(value, kinds):
        return
    *first, last = [kind.__name__ for kind in (kinds if isinstance(kinds, tuple) else (kinds,))]
    names = f"{', '.join(first)} or {last}" if first else last
    article = "an" if names[0] in "AEIO" else "a"
    found = f"of the kind {type(value).__name__}"
    raise DesignError(quantity, Unquoted(found), limit or f"{article} {names}", remedy)


def check_number(
    quantity: str,
    value: object,
    limit: str,
    remedy: str = "",
    *,
    least: float = -math.inf,
    above: float = -math.inf,
    most: float = math.inf,
) -> None:
    """That an argument is a finite number, at least one number, greater than another and at most a third.

    limit : what is allowed, in words

    Raises
    ------
    DesignError : it is not, or it is no number

    >>> check_number("lift", "20", "a finite number greater than 0 mm", above=0)
    Traceback (most recent call last):
    graphcam.errors.DesignError: lift is '20', but must be a finite number greater than 0 mm
    """
    number: Any = value
    try:
        allowed = bool(-math.inf < number < math.inf and least <= number <= most and number > above)
    except (TypeError, ValueError):  # no number, or many
        allowed = False
    if not allowed:
        raise DesignError(quantity, Unquoted("missing") if value is None else value, limit, remedy)


_LOOKALIKES = str.maketrans("АВЕКМНОРСТУХасеорхуі", "ABEKMHOPCTYXaceopxyi")
"""Cyrillic letters that look like Latin ones."""


def meant(word: str, known: Iterable[str], called: Mapping[str, Iterable[str]] | None = None) -> str:
    """A remedy for a word that is none of those known: which of them is meant; empty where none is near.

    called : what else a known word is called, as by a textbook or in another language

    >>> meant("Cicloidal", ["cosine", "cycloidal"])
    "did you mean 'cycloidal'?"
    >>> meant("simple harmonic", ["cosine", "double-harmonic"], {"cosine": ["simple harmonic"]})
    "did you mean 'cosine'?"
    >>> meant("А1", ["A1", "A2"])
    "its letter 'А' is Cyrillic: type 'A1' in Latin letters"
    >>> meant("xyz", ["cosine", "cycloidal"])
    ''
    """
    known = list(known)
    names = {other.casefold(): name for name in known for other in (called or {}).get(name, ())}
    names |= {name.casefold(): name for name in known}
    latin = word.translate(_LOOKALIKES)
    if latin != word and (name := names.get(latin.casefold())):
        letter = next(letter for letter, other in zip(word, latin, strict=True) if letter != other)
        return f"its letter '{letter}' is Cyrillic: type '{name}' in Latin letters"
    near = difflib.get_close_matches(unicodedata.normalize("NFKC", word).casefold(), names, n=1)
    alike, begun = names.get(word.casefold()), [name for name in known if name.startswith(f"{word}_")]
    close = [alike] if alike else begun or [names[other] for other in near]
    return f"did you mean '{close[0]}'?" if close else ""


def nearest(word: str, known: Iterable[str], called: Mapping[str, Iterable[str]] | None = None) -> str:
    """A remedy for a mistyped word: the known word that is meant, or all of them; ``called`` as in :func:`meant`.

    Where the limit lists them already, :func:`meant` alone is enough.

    >>> nearest("cicloidal", ["cosine", "cycloidal"])
    "did you mean 'cycloidal'?"
    >>> nearest("xyz", ["cosine", "cycloidal"])
    'known are cosine, cycloidal'
    >>> nearest("roller", ["offset", "roller_radius", "roller_rule"])
    "did you mean 'roller_radius'?"
    """
    known = list(known)
    return meant(word, known, called) or "known are " + ", ".join(known)
