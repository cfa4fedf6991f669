"""A course whose worksheets are made to be photographed, and readings of photographs that nobody took."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from graphcam.exercises.course.course_folder import TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.course_making import make
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.photographs.course_photographs import READINGS_FOLDER, ReadCourse, ReadingOrder, read_course
from graphcam.exercises.photographs.photograph_store import KeptPhotographs
from graphcam.exercises.photographs.read_photo import BARS, TABLE, KeptPicture, ReadAnswer, ReadPhoto

# A process that is forked from one in which OpenCV has threads hangs.
cv2.setNumThreads(1)

STUDENTS = ("Anna", "Boris", "<b>Clara</b>")
BOX = (-116.0, -116.0, 116.0, 116.0)


@dataclass(frozen=True)
class Photographed:
    """A course with photographs that were read."""

    place: Path
    exercise: Exercise

    @property
    def secret(self) -> Path:
        return self.place.parent / "secret"

    @property
    def photos(self) -> Path:
        return self.place / READINGS_FOLDER

    def key(self, student: str) -> AnswerKey:
        return AnswerKey.from_json(AnswerKeys(self.place / TEACHER_FOLDER).find(student))

    def right(self, student: str) -> np.ndarray:
        """The stations of the right curve, or the right points."""
        return np.asarray(self.key(student).keys[self.exercise.answers[-1].name].expected.value)

    def reading(self, student: str, points: np.ndarray | None, **changes: object) -> ReadAnswer:
        closed = self.exercise.answers[-1].kind == "curve"
        answer = ReadAnswer("profile", points, closed=closed, share=0.985, confidence=0.96, measures={"gap": 1.5})
        return replace(answer, **changes)

    def photograph(self, student: str, answer: ReadAnswer | None, name: str = "", **changes: object) -> ReadPhoto:
        """As if a photograph of a student's second page had been read."""
        digest = f"{name or student!r}".encode().hex().ljust(32, "0")[:32]
        pictures = {
            "profile": KeptPicture("0.jpg", BOX),
            TABLE: KeptPicture("1.jpg", (0.0, 0.0, 120.0, 60.0)),
            **{bar: KeptPicture("2.jpg", (0.0, 0.0, 30.0, 16.0)) for bar in BARS},
        }
        photo = ReadPhoto(
            name or f"{student}.jpg", f"{digest}-0", student, 2, 8, 8, 0.31, "plane",
            {} if answer is None else {self.exercise.answers[-1].name: answer}, pictures, (250.0, 180.0),
        )  # fmt: skip
        return replace(photo, **changes)

    def keep(self, *photos: ReadPhoto) -> None:
        kept = KeptPhotographs(self.photos, "by hand")
        for photo in photos:
            answer = next(iter(photo.answers.values()), None)
            drawn = None if answer is None else answer.points
            files = {"0.jpg": drawing(drawn), "1.jpg": grey(360, 180), "2.jpg": grey(90, 48)}
            kept.keep(photo.digest.partition("-")[0], [photo], files if photo.is_identified and not photo.why else {})

    def read(self, **order: object) -> ReadCourse:
        return read_course(ReadingOrder([], self.place, self.secret, **order))  # type: ignore[arg-type]


def grey(width: int, height: int) -> bytes:
    data = cv2.imencode(".jpg", np.full((height, width, 3), 225, np.uint8))[1]
    return data.tobytes()


def drawing(points: np.ndarray | None) -> bytes:
    """A picture of white paper with a pencil line through the points, 3 pixels a mm."""
    canvas = np.full((696, 696, 3), 235, np.uint8)
    if points is not None:
        pixels = np.stack([3 * (points.real - BOX[0]), 3 * (BOX[3] - points.imag)], -1).round().astype(np.int32)
        cv2.polylines(canvas, [pixels], True, (90, 90, 90), 1, cv2.LINE_AA)
    return cv2.imencode(".jpg", canvas)[1].tobytes()


def made(place: Path, name: str) -> Path:
    (place / "secret").write_bytes(b"the secret of scanned sheets")
    (place / "roster.csv").write_text("id\n" + "".join(f"{student}\n" for student in STUDENTS))
    make(name, place / "roster.csv", place / "secret", place / "course", paper="A3")
    return place / "course"


@pytest.fixture(scope="session")
def curves(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return made(tmp_path_factory.mktemp("curves"), "inversion-translating")


@pytest.fixture(scope="session")
def plots(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return made(tmp_path_factory.mktemp("plots"), "inversion-arm")


@pytest.fixture
def course(curves: Path, tmp_path: Path) -> Photographed:
    """Of an exercise that asks for a curve; a copy for each test."""
    return copied(curves, tmp_path, "inversion-translating")


@pytest.fixture
def plotted(plots: Path, tmp_path: Path) -> Photographed:
    """Of an exercise that asks for points."""
    return copied(plots, tmp_path, "inversion-arm")


def copied(source: Path, place: Path, name: str) -> Photographed:
    shutil.copytree(source, place / "course")
    shutil.copy(source.parent / "secret", place / "secret")
    return Photographed(place / "course", find_exercise(name, paper="A3"))


Wobbled = Callable[[np.ndarray], np.ndarray]


@pytest.fixture
def wobbled() -> Wobbled:
    """What a careful hand makes of a curve: a tenth of a mm off."""

    def drawn(points: np.ndarray) -> np.ndarray:
        rng = np.random.default_rng(7)
        angle = np.linspace(0, 2 * np.pi, points.size)
        return points * (1 + 0.1 * np.sin(3 * angle + rng.uniform(0, 6)) / np.abs(points))

    return drawn
