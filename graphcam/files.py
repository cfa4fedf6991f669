"""Output that is written as a whole or not at all.

Files are written in drafts, hidden folders, before they go to their place.  A run holds a lock on its draft, which the
system gives free when the run ends, however it ends: so the next run tells a draft that a killed one has left from one
that is still being written.
"""

import errno
import hashlib
import os
import shutil
import sys
import tempfile
from collections.abc import Generator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from types import MappingProxyType

from graphcam.errors import GraphcamError
from graphcam.file_locks import LOCK_SUFFIX, lock as hold
from graphcam.words import Caption, Words, say

REMEDIES: Mapping[int | None, Words] = {
    errno.ENOSPC: say("make room on the disk, or choose a folder on another one"),
    errno.EDQUOT: say("delete some of your files there, or choose a folder on another disk"),
    errno.EROFS: say("choose a folder on a disk that can be written to"),
    errno.EACCES: say("choose a folder in which you may write, or change its permissions"),
    errno.EPERM: say("choose a folder in which you may write, or change its permissions"),
    errno.ENAMETOOLONG: say("choose a shorter name"),
    errno.EFBIG: say("choose a folder on another disk, or raise the limit on the size of files"),
    errno.EIO: say("check the disk, or choose a folder on another one"),
}
"""The remedy for an error of the system, by its ``errno``."""
DEFAULT_REMEDY = say("choose another place")
"""The remedy for any other error of the system."""
EXISTING_FILE_FAULT = say("it already exists"), say("choose another name, or remove that file first")
"""Fault and remedy for a new file that exists already."""
NO_FORMER_FILES: Mapping[str, str] = MappingProxyType({})


FOLDER_PREFIX = ".graphcam-draft-"
"""The prefix of the names of draft folders."""


@contextmanager
def draft_folder(place: Path) -> Generator[Path]:
    """A new folder inside an existing place, removed at the end; drafts that killed runs left there are removed too.

    Raises
    ------
    OSError : no folder can be made there

    >>> with tempfile.TemporaryDirectory() as place:
    ...     with draft_folder(Path(place)) as draft:
    ...         _ = (draft / "a.txt").write_text("a")
    ...     list(Path(place).iterdir())
    []
    """
    clear_drafts(place)
    draft, lock = _new_draft(place)
    try:
        yield draft
    finally:
        # Some systems do not remove what is still open.
        os.close(lock)
        shutil.rmtree(draft, ignore_errors=True)


def _new_draft(place: Path) -> tuple[Path, int]:
    """A new draft folder, and the file descriptor of its lock."""
    while True:
        draft = Path(tempfile.mkdtemp(prefix=FOLDER_PREFIX, dir=place))
        lock: int | None = None
        with suppress(FileNotFoundError, BlockingIOError):
            lock = os.open(draft / LOCK_SUFFIX, os.O_RDWR | os.O_CREAT)
            hold(lock)
            if os.path.lexists(draft / LOCK_SUFFIX):
                return draft, lock
        # Before it was held, another run took it for one that a killed run left, and cleared it.
        if lock is not None:
            os.close(lock)


def clear_drafts(place: Path) -> None:
    """Remove the drafts in a place whose runs have ended."""
    with suppress(OSError):
        for path in list(place.glob(f"{FOLDER_PREFIX}*")):
            if path.is_dir() and not path.is_symlink():
                _remove_folder(path)


def _remove_folder(draft: Path) -> None:
    with suppress(OSError):
        lock = os.open(draft / LOCK_SUFFIX, os.O_RDWR | os.O_CREAT)
        try:
            ended = hold(lock)
            if ended:
                shutil.rmtree(draft, ignore_errors=True)
        finally:
            os.close(lock)
        # Windows removes nothing that is open; nor does it now, if a new run has opened it meanwhile.  Elsewhere it is
        # gone, and what is there by now is another run's.
        if ended and sys.platform == "win32":
            (draft / LOCK_SUFFIX).unlink()
            draft.rmdir()


class OutputError(GraphcamError):
    """A folder or file that cannot be written.

    >>> print(OutputError("/proc/out", "No such file or directory"))
    the output '/proc/out' cannot be written (No such file or directory); choose another place
    """

    def __init__(self, path: str | Path, why: Words, remedy: Words = DEFAULT_REMEDY) -> None:
        super().__init__(path, why, remedy)
        self.path = path
        self.why = why
        self.advice = remedy

    @property
    def fault(self) -> Caption:
        """The sentence that names the output and why it cannot be written."""
        return say("the output '{path}' cannot be written ({why})", path=str(self.path), why=self.why)


@contextmanager
def whole_folder(
    folder: str | Path, former: Mapping[str, str] = NO_FORMER_FILES, *, first: str = ""
) -> Generator[Path]:
    """A temporary folder whose files move into ``folder`` when all of them are written.

    On an error nothing is left behind: neither the files nor a folder that was made for them.  Files that ``folder``
    held before stay, but for those of the same names.

    former : files of a run before that go when the new ones come, with their :func:`digest`; one that somebody has
        changed since is his own, and stays
    first : what moves before all others: without it they are of no use if the run is killed between

    Raises
    ------
    OutputError : the folder cannot be made or written, or is a file

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as place:
    ...     with whole_folder(Path(place, "out")) as draft:
    ...         _ = (draft / "a.txt").write_text("a")
    ...     sorted(path.name for path in Path(place, "out").iterdir())
    ['a.txt']
    """
    if folder == "":
        raise OutputError(folder, say("it has no name"), say("name a folder; '.' is the current one"))
    folder = Path(folder)
    fresh = _is_missing(folder)
    # In the folder itself, so that each file moves by a rename within one file system; where it is to come, if there
    # is none yet: then all moves by one rename, and a run that is killed leaves all or nothing.
    with _draft(folder, folder.parent if fresh else folder) as draft:
        new, old = draft / "new", draft / "old"
        new.mkdir()
        old.mkdir()
        yield new
        if fresh and _is_missing(folder):
            new.rename(folder)
        else:
            _exchange(new, old, folder, former, first)


@contextmanager
def whole_file(path: str | Path) -> Generator[Path]:
    """A temporary file beside ``path`` that takes its place when it is written.

    On an error nothing is left behind, and a file that was there before stays.

    Raises
    ------
    OutputError : the file cannot be written

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as place:
    ...     with whole_file(Path(place, "a.txt")) as draft:
    ...         _ = draft.write_text("a")
    ...     sorted(path.name for path in Path(place).iterdir())
    ['a.txt']
    """
    path = Path(path)
    # In a folder of its own, because readers and writers of some formats look at the ending.
    with _draft(path, path.parent) as folder:
        draft = folder / path.name
        yield draft
        draft.replace(path)


@contextmanager
def _draft(target: Path, place: Path) -> Generator[Path]:
    """A temporary folder in a place, which is made if need be; after an error neither is left."""
    made = _missing_folders(place)
    try:
        with ExitStack() as drafts:
            try:
                if target != place and target.is_dir():
                    raise OutputError(target, say("it is a folder"))
                place.mkdir(parents=True, exist_ok=True)
                draft = drafts.enter_context(draft_folder(place))
            except (OSError, ValueError) as error:
                raise _output_error(target, error) from error
            try:
                yield draft
            except OSError as error:
                if _error_concerns((target, draft), error):
                    raise _output_error(target, error) from error
                raise
    except BaseException:
        _remove(made)
        raise


def _is_missing(path: Path) -> bool:
    """Whether there is nothing at a path that could be one."""
    try:
        path.lstat()
    except FileNotFoundError:
        return True
    except (OSError, ValueError):
        return False
    return False


def _error_concerns(places: Sequence[Path], error: OSError) -> bool:
    """Whether an error of the system is about some places: it names a file there, or names none and is about a disk."""
    if error.filename is None:
        return error.errno in REMEDIES
    named = Path(os.fsdecode(error.filename)).absolute()
    return any(named.is_relative_to(place.absolute()) for place in places)


def check_new(path: str | Path) -> None:
    """Refuse, before long work, a new file that exists already or whose folder does not exist.

    Raises
    ------
    OutputError : the file is there already, or its folder is not
    """
    if os.path.lexists(path):
        raise OutputError(path, *EXISTING_FILE_FAULT)
    if not Path(path).parent.is_dir():
        raise OutputError(path, say("its folder does not exist"), say("make the folder first"))


def write_new(path: str | Path, text: str) -> None:
    """Write a text file that must not be there yet.

    Raises
    ------
    OutputError : the file is there already, or cannot be written
    """
    try:
        with Path(path).open("x", encoding="utf-8", newline="\n") as file, ExitStack() as on_error:
            on_error.callback(os.unlink, path)
            file.write(text)
            file.flush()
            on_error.pop_all()
    except FileExistsError as error:
        raise OutputError(path, *EXISTING_FILE_FAULT) from error
    except (OSError, ValueError) as error:
        raise _output_error(path, error) from error


def digest(path: Path) -> str:
    """The SHA-256 of a file's bytes, in hexadecimal, which tells whether the file has changed."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _exchange(new: Path, old: Path, folder: Path, former: Mapping[str, str], first: str) -> None:
    """Move all files from ``new`` into the folder; what they replace, and former files, move into ``old``.

    If one cannot be moved, all go back to where they were.
    """
    names = sorted((path.name for path in new.iterdir()), key=lambda name: (name != first, name))
    for name in names:
        # A folder of the same name cannot be replaced by a file: say so before the first file has moved.
        if (folder / name).is_dir():
            raise OutputError(folder, say("{name} is a folder there", name=name))
    replaced = [name for name in names if os.path.lexists(folder / name)]
    replaced += [name for name in former if name not in names and _unchanged(folder, name, former[name])]
    moves = [*((folder / name, old / name) for name in replaced), *((new / name, folder / name) for name in names)]
    begun: list[tuple[Path, Path]] = []
    try:
        for source, target in moves:
            begun.append((source, target))
            source.replace(target)
    except BaseException:
        for source, target in reversed(begun):
            # The last one may not have moved.
            with suppress(OSError):
                target.replace(source)
        raise


def _unchanged(folder: Path, name: str, known: str) -> bool:
    """Whether a file in the folder itself, not a link to one elsewhere, is still what it was."""
    path = folder / name
    try:
        return Path(name).name == name and path.is_file() and not path.is_symlink() and digest(path) == known
    except OSError:
        return False


def _missing_folders(folder: Path) -> list[Path]:
    """The folders on the path to ``folder`` that do not exist yet, the innermost first."""
    missing: list[Path] = []
    for path in (folder, *folder.parents):
        try:
            if path.exists():
                break
        except (OSError, ValueError):
            break
        missing.append(path)
    return missing


def _remove(made: list[Path]) -> None:
    for path in made:
        try:
            path.rmdir()
        except (OSError, ValueError):
            return


def _output_error(path: str | Path, error: OSError | ValueError) -> OutputError:
    if isinstance(error, OSError):
        # Some libraries put the number of the error into words of their own.
        why = os.strerror(error.errno) if error.errno in REMEDIES and error.errno else error.strerror
        return OutputError(path, why or str(error), REMEDIES.get(error.errno, DEFAULT_REMEDY))
    return OutputError(path, str(error))
