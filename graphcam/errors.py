"""The errors of graphcam: each names the quantity, its value, what is allowed, and a remedy."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from graphcam.typed_words import meant
from graphcam.words import Caption, Message, Words, message, or_list, say, sequence

CHECK_THE_NAME = say("check the name")
FILE = say("file")
MAX_FAULTS = 10
"""The maximum number of faults of a file that a message tells."""


class GraphcamError(Exception):
    """The base class of every error that graphcam raises on purpose.

    Its ``args`` are what it was given, captions among them; ``str`` is their English text.

    advice : what to do about it; may be empty
    """

    advice: Words = ""

    @property
    def fault(self) -> Words:
        """What is wrong, without the remedy."""
        raise NotImplementedError

    @property
    def remedy(self) -> str:
        """What to do about the error, in English; may be empty."""
        return str(self.advice)

    @property
    def caption(self) -> Message:
        """Fault and remedy as one text, for any language."""
        return message(say("{fault}; {remedy}", fault=self.fault, remedy=self.advice) if self.advice else self.fault)

    def __str__(self) -> str:
        return str(self.caption)

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled_error, (type(self), self.args, self.__dict__)


def _unpickled_error(kind: type[GraphcamError], given: tuple[Any, ...], kept: dict[str, Any]) -> GraphcamError:
    """The error of a pickle, rebuilt in another process from its arguments and attributes."""
    error = kind.__new__(kind, *given)
    error.__dict__ |= kept
    return error


class DesignError(GraphcamError, ValueError):
    """A design that is impossible.

    Parameters
    ----------
    quantity : what is wrong, in the words of the textbook ("prime radius"); the English text afterwards
    value : the value it has; words about it are a caption, which is shown without quotes
    limit : what is allowed ("greater than 0 mm"); the English text afterwards
    remedy : what to do about it; may be empty

    >>> import graphcam as gc
    >>> print(gc.DesignError("lift", -3, "greater than 0 mm", "give the height of the rise"))
    lift is -3, but must be greater than 0 mm; give the height of the rise
    >>> print(DesignError("arm", say("missing"), "given"), DesignError("arm", "12 mm", "a number"), sep="\\n")
    arm is missing, but must be given
    arm is '12 mm', but must be a number
    """

    def __init__(self, quantity: Words, value: object, limit: Words, remedy: Words = "") -> None:
        super().__init__(quantity, value, limit, remedy)
        self.quantity = str(quantity)
        self.value = value
        self.limit = str(limit)
        self.advice = remedy

    @property
    def fault(self) -> Caption:
        """The sentence of quantity, value and limit."""
        return _sentence(*self.args[:3])


class TaskError(GraphcamError):
    """A task file that cannot be used: the file, the field, its value, what was expected, the remedy.

    place : how a message tells the field, with its line; empty tells it as it is

    >>> import graphcam as gc
    >>> print(gc.TaskError("cam.toml", "motion.phases[0].lift", 0, "greater than 0", "give the lift in mm"))
    cam.toml: motion.phases[0].lift is 0, but must be greater than 0; give the lift in mm
    """

    def __init__(
        self, path: Words, field: Words, value: object, expected: Words, remedy: Words = "", *, place: Words = ""
    ) -> None:
        super().__init__(path, field, value, expected, remedy)
        self.place = place or field
        self.path = str(path)
        self.field = str(field)
        self.value = value
        self.expected = str(expected)
        self.advice = remedy

    @property
    def fault(self) -> Caption:
        """The sentence of field, value and what was expected, after the file's name."""
        return Caption("{path}: {fault}", {"path": self.args[0], "fault": self.bare_fault})

    @property
    def bare_fault(self) -> Caption:
        """The sentence without the file's name."""
        return _sentence(self.place, *self.args[2:4])


class TaskFaultsError(TaskError):
    """Several errors of one file, in the order of its lines; field, value and remedy are those of the first.

    errors : two or more

    >>> faults = TaskFaultsError([TaskError("cam.toml", "lift", 0, "more"), TaskError("cam.toml", "law", 3, "text")])
    >>> print(faults)
    cam.toml has 2 faults:
      lift is 0, but must be more
      law is 3, but must be text
    """

    def __init__(self, errors: Sequence[TaskError], more: int = 0) -> None:
        super().__init__(*errors[0].args)
        self.errors = tuple(errors)
        self.more = more

    @property
    def caption(self) -> Message:
        """All faults, one on a line."""
        count = len(self.errors) + self.more
        lines: list[Words] = [say("{path} has {count} faults:", path=self.args[0], count=count)]
        for error in self.errors:
            fault, advice = error.bare_fault, error.advice
            lines.append(say("{fault}; {remedy}", fault=fault, remedy=advice) if advice else fault)
        lines += [say("and {count} more", count=self.more)] if self.more else []
        return message(sequence(lines, "\n  "))


def all_faults(errors: Sequence[TaskError]) -> TaskError:
    """One error for all faults of a file, of which the first ten are told."""
    return errors[0] if len(errors) == 1 else TaskFaultsError(errors[:MAX_FAULTS], len(errors[MAX_FAULTS:]))


class MissingFileError(TaskError):
    """A file or folder that is not where it is looked for.

    kind : what is missing, in a word
    where : where it was looked for, if the path does not say it

    >>> print(MissingFileError("motion.csv", "check motion.table", where="beside cam.toml"))
    there is no file motion.csv beside cam.toml; check motion.table
    """

    def __init__(self, path: str, remedy: Words = CHECK_THE_NAME, *, kind: Words = FILE, where: Words = "") -> None:
        expected = say("a {kind} that is there", kind=kind)
        super().__init__(path, say("the {kind}", kind=kind), say("missing"), expected, remedy)
        self.kind = kind
        self.where = where

    @property
    def fault(self) -> Caption:
        """The sentence that names what is missing, and where."""
        missing = say("there is no {kind} {path}", kind=self.kind, path=self.path)
        return sequence([missing, self.where], " ") if self.where else missing


class LetteringWarning(UserWarning):
    """A drawing has characters that no font on the machine has."""


def _sentence(what: Words, value: object, allowed: Words) -> Caption:
    shown = value if isinstance(value, Caption) else repr(value) if isinstance(value, str) else f"{value}"
    return say("{what} is {shown}, but must be {allowed}", what=what, shown=shown, allowed=allowed)


def install_advice(extra: str) -> Caption:
    """The command that installs an extra, from graphcam's source, as a package index may hold another package.

    The extra is in double quotes, which every shell takes; the pip is the interpreter's own.

    >>> print(install_advice("photo"))
    in the folder of graphcam's source run: python -m pip install ".[photo]"
    """
    return say('in the folder of graphcam\'s source run: python -m pip install ".[{extra}]"', extra=extra)


@contextmanager
def installed(option: str, library: str, extra: str) -> Generator[None]:
    """Turn a failed import in the block into the advice to install the extra that an option needs.

    Raises
    ------
    TaskError : the library is not installed

    >>> with installed("--cluster", "dask", "cluster"):  # doctest: +ELLIPSIS
    ...     import no_such_module
    Traceback (most recent call last):
    graphcam.errors.TaskError: --cluster: dask is not installed, but must be installed; in the folder ...
    """
    try:
        yield
    except ImportError:
        missing = say("not installed")
        raise TaskError(option, library, missing, say("installed"), install_advice(extra)) from None


def unreadable_error(
    path: str | Path, what: Words, expected: Words, error: OSError | ValueError, remedy: Words = CHECK_THE_NAME
) -> TaskError:
    """The error of a file that cannot be read: it is missing, a folder, or what the system says.

    what : the file, as a message names it: "the roster"
    expected : what it must be: "a CSV file"
    remedy : for a missing file, in place of "check the name"

    >>> print(unreadable_error("no.csv", "the roster", "a CSV file", FileNotFoundError()))
    there is no file no.csv; check the name
    >>> print(unreadable_error("a.csv", "the roster", "a CSV file", PermissionError(13, "Permission denied")))
    a.csv: the roster is not readable (Permission denied), but must be a CSV file; check its permissions
    """
    if isinstance(error, FileNotFoundError):
        return MissingFileError(str(path), remedy)
    if isinstance(error, IsADirectoryError | PermissionError) and Path(path).is_dir():
        return TaskError(str(path), what, say("a folder"), expected, say("name the file in it"))
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    denied = isinstance(error, PermissionError)
    advice = say("check its permissions") if denied else CHECK_THE_NAME
    return TaskError(str(path), what, say("not readable ({why})", why=why), expected, advice)


def check_kind(
    quantity: Words, value: object, kinds: type | tuple[type, ...], limit: Words = "", remedy: Words = ""
) -> None:
    """Refuse an argument that is of none of the given kinds.

    limit : what is allowed, in place of the names of the kinds

    Raises
    ------
    DesignError : the value is of another kind

    >>> check_kind("follower", 40, (str, list, dict))
    Traceback (most recent call last):
    graphcam.errors.DesignError: follower is of the kind int, but must be a str, list or dict
    """
    if isinstance(value, kinds):
        return
    names = [kind.__name__ for kind in (kinds if isinstance(kinds, tuple) else (kinds,))]
    a = "an" if names[0][0] in "AEIO" else "a"
    found = say("of the kind {name}", name=type(value).__name__)
    raise DesignError(quantity, found, limit or say("{a} {names}", a=a, names=or_list(names)), remedy)


def check_number(
    quantity: Words,
    value: object,
    limit: Words,
    remedy: Words = "",
    *,
    least: float = -math.inf,
    above: float = -math.inf,
    most: float = math.inf,
) -> None:
    """Refuse an argument that is not a finite number, at least ``least``, greater than ``above``, at most ``most``.

    limit : what is allowed, in words

    Raises
    ------
    DesignError : the value is out of these bounds, or is no number

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
        raise DesignError(quantity, say("missing") if value is None else value, limit, remedy)


_LOOKALIKES = str.maketrans("АВЕКМНОРСТУХасеорхуі", "ABEKMHOPCTYXaceopxyi")
"""Translation table from Cyrillic letters to the Latin ones that look alike."""


def suggestion(word: str, known: Iterable[str]) -> Words:
    """The remedy for an unknown word: the known word that is meant; empty where the table of typed words has none.

    >>> str(suggestion("Cicloidal", ["cosine", "cycloidal"]))
    "did you mean 'cycloidal'?"
    >>> str(suggestion("simple harmonic", ["cosine", "double-harmonic"]))
    "did you mean 'cosine'?"
    >>> str(suggestion("А1", ["A1", "A2"]))
    "its letter 'А' is Cyrillic: type 'A1' in Latin letters"
    >>> suggestion("xyz", ["cosine", "cycloidal"])
    ''
    """
    known = list(known)
    latin = word.translate(_LOOKALIKES)
    if latin != word and (alike := [name for name in known if name.casefold() == latin.casefold()]):
        letter = next(letter for letter, other in zip(word, latin, strict=True) if letter != other)
        return say("its letter '{letter}' is Cyrillic: type '{name}' in Latin letters", letter=letter, name=alike[0])
    name = meant(word, known)
    return say("did you mean '{close}'?", close=name) if name else ""


def choice_limit(word: object, known: Iterable[str]) -> tuple[Caption, Words]:
    """Limit and remedy for a word that is not among the known ones.

    >>> print(DesignError("law", "cicloidal", *choice_limit("cicloidal", ["cosine", "cycloidal"])))
    law is 'cicloidal', but must be one of cosine, cycloidal; did you mean 'cycloidal'?
    """
    known = list(known)
    return say("one of {names}", names=", ".join(known)), suggestion(str(word), known)


def nearest_word_remedy(word: str, known: Iterable[str]) -> Words:
    """The remedy for a mistyped word: the known word that is meant, or all.

    Where the limit lists them already, :func:`suggestion` alone is enough.

    >>> str(nearest_word_remedy("cicloidal", ["cosine", "cycloidal"]))
    "did you mean 'cycloidal'?"
    >>> str(nearest_word_remedy("xyz", ["cosine", "cycloidal"]))
    'known are cosine, cycloidal'
    >>> str(nearest_word_remedy("roller", ["offset", "roller_radius", "roller_rule"]))
    "did you mean 'roller_radius'?"
    """
    known = list(known)
    return suggestion(word, known) or say("known are {names}", names=", ".join(known))


class UnreadableError(Exception):
    """A stranger's file, or a submission, that cannot be read; ``why`` is the sentence that says so.

    >>> print(UnreadableError(say("{name} is empty", name="answers.toml")))
    answers.toml is empty
    """

    def __init__(self, why: Caption) -> None:
        super().__init__(why)
        self.why = why

    def __str__(self) -> str:
        return str(self.why)
