"""Records on disk: one file a student while grading goes on, so that an interrupted run resumes."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
from collections.abc import Generator, Iterable
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import graphcam
from graphcam.exercises.grading.grade_one import Assignment, Submission
from graphcam.files import OutputError


@dataclass(frozen=True)
class Store:
    """A folder of finished records, named after what they were graded with: of another assignment they do not count."""

    folder: Path

    @staticmethod
    def beside(out: Path, assignment: Assignment) -> Store:
        """The store of a run that writes to ``out``."""
        return Store(out.parent / f".{out.name}-{_fingerprint(assignment)}")

    @contextmanager
    def held(self) -> Generator[None]:
        """Keep other runs out meanwhile: two that write the same records, and clear them, break each other.

        Raises
        ------
        OutputError : another run is at it
        """
        import fcntl

        made = not self.folder.parent.exists()
        self.folder.mkdir(parents=True, exist_ok=True)
        with ExitStack() as stack:
            lock = os.open(self.folder, os.O_RDONLY | os.O_CLOEXEC)
            stack.callback(os.close, lock)
            try:
                # The system gives it free when the run ends, however it ends.
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                out = self.folder.with_name(self.folder.name.rpartition("-")[0][1:])
                raise OutputError(out, "another run is grading into it", "wait until it ends") from None
            # Where nothing was graded, nothing is left.
            stack.callback(_remove_empty, (self.folder, self.folder.parent)[: 1 + made])
            yield

    def find(self, submission: Submission) -> dict[str, Any] | None:
        """The record of just this submission, if a former run got so far."""
        try:
            kept = json.loads(self._path(submission).read_bytes())
        except (OSError, ValueError):
            return None
        return kept["record"] if kept["digest"] == submission.digest else None

    def keep(self, submission: Submission, record: dict[str, Any]) -> None:
        """Write a record; it is there whole or not at all."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self._path(submission)
        draft = path.with_name(f"{path.name}.{os.getpid()}.new")
        draft.write_text(json.dumps({"digest": submission.digest, "record": record}), encoding="ascii")
        draft.replace(path)

    def clear(self) -> None:
        """The run is complete."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _path(self, submission: Submission) -> Path:
        # Of any length, and of letters that every file system has.
        return self.folder / f"{hashlib.sha256(os.fsencode(submission.place)).hexdigest()[:32]}.json"


def _remove_empty(folders: Iterable[Path]) -> None:
    for folder in folders:
        with suppress(OSError):
            folder.rmdir()


def _fingerprint(assignment: Assignment) -> str:
    # Of the secret only a digest is left, and of that a part.
    secret = hashlib.sha256(b"graphcam store" + assignment.secret).hexdigest()
    said = [graphcam.__version__, repr(assignment.exercise), secret, assignment.level, repr(assignment.limits)]
    return hashlib.sha256(repr(said).encode()).hexdigest()[:16]
