"""Small circles, crossings of lines and a length between two crosses, from the exercise that asks them to the value."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path

import cv2
import numpy as np
import pypdfium2
import pytest

from graphcam.exercises.course.course_folder import PRINTED_FOLDER, STUDENTS_FOLDER, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.course_making import make
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.photographs.course_photographs import READINGS_FOLDER, ReadingOrder, read_course
from graphcam.photo.printed_page import PrintedPage, PrintedView

pytestmark = pytest.mark.slow

DPI = 200
PER_MM = DPI / 25.4
FINER = 4
"""Fractional bits of a pixel in which OpenCV takes places."""
OFF = 0.25
"""mm, of a mark."""
EXERCISES = Path(__file__).parents[3] / "exercises"


class Handout:
    """The course of one student, who draws on the pages as they come from the printer."""

    def __init__(self, place: Path, exercise: str, changes: Mapping[str, str]) -> None:
        text = (EXERCISES / f"{exercise}.toml").read_text(encoding="utf-8")
        for old, new in changes.items():
            assert text.count(old) == 1
            text = text.replace(old, new)
        (place / "own.toml").write_text(text, encoding="utf-8")
        (place / "secret").write_bytes(b"the secret of the photographs")
        (place / "roster.csv").write_text("id\nAnna\n")
        make(str(place / "own.toml"), place / "roster.csv", place / "secret", place / "course", paper="A3")
        self.place = place
        self.key = AnswerKey.from_json(AnswerKeys(place / "course" / TEACHER_FOLDER).find("Anna"))
        self.pages: dict[int, tuple[np.ndarray, float]] = {}

    def view(self, name: str) -> tuple[int, PrintedView]:
        """The page on which a view is, counted from 0, and the view."""
        for number, path in enumerate(
            sorted((self.place / "course" / TEACHER_FOLDER / PRINTED_FOLDER).glob("Anna-*.json"))
        ):
            page = PrintedPage.from_json(path.read_text(encoding="utf-8"))
            if name in page.views:
                self.pages.setdefault(number, (self.printed(number), page.height))
                return number, page.views[name]
        raise LookupError(name)

    def printed(self, number: int) -> np.ndarray:
        document = pypdfium2.PdfDocument(self.place / "course" / STUDENTS_FOLDER / "Anna" / "worksheet.pdf")
        picture = np.ascontiguousarray(document[number].render(scale=DPI / 72).to_numpy()[..., :3])
        document.close()
        return picture

    def draw(self, view: str, lines: list[np.ndarray]) -> None:
        """Pencil lines of 0.4 mm, from the view's origin."""
        number, where = self.view(view)
        picture, height = self.pages[number]
        layer = np.full(picture.shape[:2], 255, np.uint8)
        for line in lines:
            at = line + where.origin
            pixels = np.stack([at.real, height - at.imag], -1) * PER_MM * 2**FINER
            cv2.polylines(layer, [pixels.round().astype(np.int32)], False, 90, 3, cv2.LINE_AA, FINER)
        soft = cv2.GaussianBlur(layer, (0, 0), 0.8)[..., None] / 255
        picture[:] = np.clip(picture * soft, 0, 245).astype(np.uint8)

    def read(self) -> dict:
        """What goes into answers.toml."""
        (self.place / "scans").mkdir()
        for number, (picture, _) in self.pages.items():
            cv2.imwrite(str(self.place / "scans" / f"{number}.jpg"), picture, [cv2.IMWRITE_JPEG_QUALITY, 92])
        read_course(ReadingOrder([self.place / "scans"], self.place / "course", self.place / "secret"))
        return tomllib.loads((self.place / "course" / READINGS_FOLDER / "Anna" / "answers.toml").read_text())


def ring(place: complex) -> list[np.ndarray]:
    return [place + 0.9 * np.exp(1j * np.linspace(0, 2 * np.pi, 60))]


def cross(place: complex) -> list[np.ndarray]:
    return [place + 1.5 * way * np.array([-1, 1]) for way in (1, 1j)]


@pytest.mark.parametrize(("mark", "drawn"), [("circle", ring), ("cross", cross)])
def test_plotted_points_are_read_as_they_are_marked(tmp_path, mark, drawn):
    handout = Handout(tmp_path, "inversion-arm", {'layer = "ROLLERS"': f'layer = "ROLLERS"\nmark = "{mark}"'})
    right = np.asarray(handout.key.keys["rollers"].expected.value)
    handout.draw("profile", [line for place in right for line in drawn(complex(place))])
    given = np.array(handout.read()["rollers"]) @ [1, 1j]
    assert given.size == right.size
    assert np.abs(given[:, None] - right).min(0).max() < OFF


def test_a_place_is_where_two_lines_cross(tmp_path):
    mark = 'points = "pitch"\nplace = "profile"\nmark = "crossing"\ncomponent = '
    changes = {f'reading = "{axis}"': f'{mark}"{axis}"' for axis in ("x", "y")}
    handout = Handout(tmp_path, "inversion-translating", changes)
    right = complex(*(float(handout.key.keys[name].expected.value) for name in ("x_8", "y_8")))
    ray = right / abs(right)
    handout.draw("profile", [right * np.array([0.2, 1.2]), right + ray * np.exp(1.2j) * np.array([-15, 20])])
    given = handout.read()
    assert abs(complex(given["x_8"], given["y_8"]) - right) < OFF


def test_a_length_is_measured_between_its_two_marks(tmp_path):
    station = 'reading = "s"\nstation = "8"'
    changes = {station: f'{station}\nplace = "displacement"\nmark = "length"'}
    handout = Handout(tmp_path, "inversion-translating", changes)
    key = handout.key.keys["s_8"]
    per_mm, foot, right = key.tolerance / key.tolerance_paper, 60 + 4j, float(key.expected.value)
    handout.draw("displacement", [*cross(foot), *cross(foot + 1j * right / per_mm)])
    assert handout.read()["s_8"] == pytest.approx(right, abs=OFF * per_mm)
