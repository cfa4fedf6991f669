"""From scans of worksheets to graded answers by the command itself, whatever else lies in the folder."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pypdfium2
import pytest
from PIL import Image
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.exercises.course.course_folder import PRINTED_FOLDER, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.course_making import make
from graphcam.exercises.course.photo_reports import photo_pictures
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.photographs import course_photographs as run, photo_files
from graphcam.exercises.photographs.course_photographs import ReadingOrder, read_course
from graphcam.exercises.photographs.photograph_store import KeptPhotographs
from graphcam.exercises.reports.unrolled_drawings import key_line
from graphcam.photo.printed_page import PrintedPage
from graphcam.workers import WorkerPool

pytestmark = pytest.mark.slow

DPI = 200
NAME = "pitch"


@pytest.fixture
def threads(monkeypatch: pytest.MonkeyPatch) -> None:
    """A thread in place of processes, which do not hear what a test changes."""
    monkeypatch.setattr(run, "processes", lambda *_, **__: WorkerPool(partial(ThreadPoolExecutor, 1), 1))


@pytest.fixture(scope="session")
def scans(curves: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The second pages of Anna and Boris: hers with the right curve, his with a foreign one."""
    place = tmp_path_factory.mktemp("scans")
    for student, factor in (("Anna", 1.0), ("Boris", 0.7)):
        page = PrintedPage.from_json((curves / TEACHER_FOLDER / PRINTED_FOLDER / f"{student}-2.json").read_text())
        key = AnswerKey.from_json(AnswerKeys(curves / TEACHER_FOLDER).find(student))
        line = factor * key_line(key.keys[NAME].expected) + page.views["profile"].origin
        picture = rendered(curves / "students" / student / "worksheet.pdf", 1)
        draw(picture, line, page.height)
        cv2.imwrite(str(place / f"IMG_{ord(student[0])}.jpg"), picture, [cv2.IMWRITE_JPEG_QUALITY, 92])
    return place


def rendered(pdf: Path, page: int) -> np.ndarray:
    document = pypdfium2.PdfDocument(pdf)
    picture = np.ascontiguousarray(document[page].render(scale=DPI / 72).to_numpy()[..., :3])
    document.close()
    return picture


def draw(picture: np.ndarray, line: np.ndarray, height: float) -> None:
    """A pencil line, 0.4 mm wide."""
    per_mm = DPI / 25.4
    pixels = np.stack([line.real, height - line.imag], -1) * per_mm * 16
    layer = np.full(picture.shape[:2], 255, np.uint8)
    cv2.polylines(layer, [pixels.round().astype(np.int32)], True, 110, 3, cv2.LINE_AA, 4)
    soft = cv2.GaussianBlur(layer, (0, 0), 0.8)[..., None] / 255
    picture[:] = np.clip(picture * soft, 0, 245).astype(np.uint8)


def command(*words: object):
    return CliRunner().invoke(app, ["exercise", *map(str, words)])


def read(course, *photographs: object, **options: object):
    named = [word for name, value in options.items() for word in (f"--{name}", value)]
    return command("read", *photographs, "--course", course.place, "--secret-file", course.secret, *named)


def lines_of(course) -> list[dict[str, str]]:
    with (course.photos / "report.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_from_scans_to_marks_and_feedback(course, scans, tmp_path):
    done = read(course, scans, workers=1, review=tmp_path / "review.html")
    assert done.exit_code == 0, done.output
    assert "2 photographs of 2 students, 0 refused; to check: 1 student" in done.output
    assert "to check: Boris: pitch" in done.output
    status = {line["student"]: line["status"] for line in lines_of(course)}
    assert status == {"Anna": "counts", "Boris": "to check"}
    given = np.array(tomllib.loads((course.photos / "Anna" / "answers.toml").read_text())[NAME]) @ [1, 1j]
    off = course.key("Anna").keys[NAME].expected.distances(given, "curve")
    assert np.percentile(off, 95) < 0.3
    assert tomllib.loads((course.photos / "Boris" / "answers.toml").read_text()) == {}
    grading = ("--secret-file", course.secret, "--out", tmp_path / "g" / "grades.csv", "--feedback", tmp_path / "pages")
    graded = command("grade", course.photos, *grading, "--workers", 1)
    assert graded.exit_code == 0, graded.output
    records = {one["student"]: one for one in json.loads((tmp_path / "g" / "grades.json").read_text())}
    outcome = {student: record["answers"][-1]["outcome"] for student, record in records.items()}
    assert outcome == {"Anna": "right", "Boris": "missing"}
    assert any("pitch is not marked: it lies" in note for note in records["Boris"]["notes"])
    page = (tmp_path / "pages" / "Anna.html").read_text()
    own, right = (photo_pictures(course.photos / "Anna", right=shown) for shown in (False, True))
    assert own[0] in page
    assert right[0] not in page
    graded = command("grade", course.photos, *grading, "--workers", 1, "--show-right")
    page = (tmp_path / "pages" / "Anna.html").read_text()
    assert right[0] in page


def test_a_photograph_is_read_once_whatever_it_is_called(course, scans, tmp_path, monkeypatch, threads):
    first = scans / "IMG_65.jpg"
    assert read(course, first, workers=1).exit_code == 0
    (tmp_path / "sent").mkdir()
    (tmp_path / "sent" / "again.png.txt").write_bytes(first.read_bytes())

    def broken(*_: object) -> None:
        raise AssertionError("read again")

    monkeypatch.setattr(photo_files, "read_photograph", broken)
    found = read_course(ReadingOrder([tmp_path / "sent"], course.place, course.secret))
    assert [photo.name for photo in found.photos] == ["IMG_65.jpg"]
    assert not found.photos[0].why


def test_a_page_on_two_taped_sheets_is_read_off_photographs_of_both(tmp_path, threads):
    (tmp_path / "secret").write_bytes(b"the secret of the tiles")
    (tmp_path / "roster.csv").write_text("id\nAnna\n")
    place = tmp_path / "course"
    make("inversion-translating", tmp_path / "roster.csv", tmp_path / "secret", place, paper="A3-tiles")
    page = PrintedPage.from_json((place / TEACHER_FOLDER / PRINTED_FOLDER / "Anna-2.json").read_text())
    expected = AnswerKey.from_json(AnswerKeys(place / TEACHER_FOLDER).find("Anna")).keys[NAME].expected
    pdf = place / "students" / "Anna" / "worksheet.pdf"
    picture = np.hstack([rendered(pdf, 2), rendered(pdf, 3)])
    draw(picture, key_line(expected) + page.views["profile"].origin, page.height)
    # Each shows the tags beyond the seam too.
    for name, part in (("left.jpg", picture[:, : 250 * DPI // 25]), ("right.jpg", picture[:, 170 * DPI // 25 :])):
        cv2.imwrite(str(tmp_path / name), part)
    files = [tmp_path / "left.jpg", tmp_path / "right.jpg"]
    found = read_course(ReadingOrder(files[:1], place, tmp_path / "secret"))
    assert found.students[0].answers[-1].status == "not seen"
    assert "left.jpg shows one of the two sheets of page 2" in str(found.students[0].notes[0])
    found = read_course(ReadingOrder(files, place, tmp_path / "secret"))
    assert found.students[0].pages[2].name == "left.jpg + right.jpg"
    assert np.percentile(expected.distances(np.asarray(found.students[0].values()[NAME]), "curve"), 95) < 0.3


def test_what_is_no_photograph_is_told_and_the_rest_goes_on(course, scans, tmp_path):
    sent = tmp_path / "sent"
    sent.mkdir()
    whole = (scans / "IMG_65.jpg").read_bytes()
    (sent / "b.jpg").write_bytes(whole)
    (sent / "a.jpg").write_bytes(whole[:3000])
    (sent / "c.jpg").write_bytes(b"")
    (sent / "d.png").write_text("no picture")
    (sent / "e.pdf").write_bytes(b"%PDF-1.4 nothing")
    (sent / "notes.txt").write_text("passed over")
    os.mkfifo(sent / "f.jpg")
    (sent / "g.jpg").symlink_to("g.jpg")
    Image.new("RGB", (900, 600), "white").save(sent / "h.jpg")
    done = read(course, sent, workers=2)
    assert done.exit_code == 0, done.output
    status = {Path(line["photograph"]).name: line["status"] for line in lines_of(course)}
    refused = dict.fromkeys(("a.jpg", "c.jpg", "d.png", "e.pdf", "f.jpg", "g.jpg", "h.jpg"), "refused")
    assert status == {"b.jpg": "counts", **refused}
    assert all(line["why"] and line["remedy"] for line in lines_of(course) if line["status"] == "refused")


DEADLY = """
import json, os, signal, sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
import cv2
from graphcam.exercises.photographs import course_photographs as run, photo_files
from graphcam.exercises.photographs.course_photographs import ReadingOrder, read_course
from graphcam.workers import WorkerPool

cv2.setNumThreads(1)
really = photo_files.read_photograph

def deadly(sheets, exercise, photograph, digest, prefix):
    if photograph.name == "IMG_66.jpg":
        os.kill(os.getpid(), signal.SIGKILL)
    return really(sheets, exercise, photograph, digest, prefix)

photo_files.read_photograph = deadly
run.processes = lambda *_, **__: WorkerPool(partial(ProcessPoolExecutor, 1, get_context("fork")), 1)
scans, place, secret = map(Path, sys.argv[1:])
found = read_course(ReadingOrder([scans / "IMG_66.jpg", scans / "IMG_65.jpg"], place, secret, workers=1))
print(json.dumps({photo.name: photo.why for photo in found.photos}))
"""
"""In a process of its own, from which workers can be forked as it is: it has no threads."""


def test_one_photograph_that_kills_its_worker_costs_only_itself(course, scans):
    command = [sys.executable, "-c", DEADLY, scans, course.place, course.secret]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {
        "IMG_65.jpg": "",
        "IMG_66.jpg": "reading it failed, or took more than 20 s or 2 GB of memory",
    }
    # It was not kept, so it is tried again.
    files = [scans / "IMG_66.jpg", scans / "IMG_65.jpg"]
    found = read_course(ReadingOrder(files, course.place, course.secret, workers=1))
    assert {photo.student for photo in found.photos} == {"Anna", "Boris"}


def test_an_error_that_none_foresaw_is_told_like_any_other(course, scans, monkeypatch, threads):
    def broken(*_: object) -> None:
        raise ZeroDivisionError("nobody thought of it")

    monkeypatch.setattr(photo_files, "read_photograph", broken)
    found = read_course(ReadingOrder([scans / "IMG_65.jpg"], course.place, course.secret, workers=1))
    assert [photo.why for photo in found.photos] == ["it cannot be read (ZeroDivisionError: nobody thought of it)"]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"photo": "nothing.jpg"}, "nothing.jpg; check the name"),
        (
            {"course": "elsewhere"},
            "the course is without teacher/course.json, but must be a folder of a course; name the folder",
        ),
        ({"secret": "roster.csv"}, "the secret is another one"),
        ({"out": "secret"}, "it is a file; name a folder for the readings"),
        ({"review": "."}, "it is a folder"),
        ({"secret": "lost"}, "lost; name the file with the secret that the course was made with"),
        ({"corrections": "nothing.json"}, "check the name"),
    ],
)
def test_wrong_input_ends_with_one_message_and_status_2(course, change, message):
    place = course.place.parent
    (place / "roster.csv").write_text("id\nAnna\n")
    options = {name: place / value for name, value in change.items() if name in ("out", "review", "corrections")}
    photos = [place / change["photo"]] if "photo" in change else []
    words = [word for name, value in options.items() for word in (f"--{name}", value)]
    where = (
        "--course",
        place / change.get("course", "course"),
        "--secret-file",
        place / change.get("secret", "secret"),
    )
    done = command("read", *photos, *where, *words)
    assert done.exit_code == 2
    said = " ".join(done.output.split())
    assert said.startswith("graphcam: ")
    assert message in said.replace("(it is", "it is").replace(");", ";")
    assert not course.photos.exists()


def test_a_course_without_marks_is_told(course):
    shutil.rmtree(course.place / "teacher" / "printed")
    done = command("read", "--course", course.place, "--secret-file", course.secret)
    assert done.exit_code == 2
    assert "make the course with --paper A3" in done.output


def test_without_the_libraries_the_extra_is_named(course, monkeypatch):
    monkeypatch.setitem(sys.modules, "zxingcpp", None)
    done = command("read", "--course", course.place, "--secret-file", course.secret)
    assert done.exit_code == 2
    assert 'pip install ".[photo]"' in done.output


def test_two_runs_do_not_write_the_same_files(course):
    with KeptPhotographs(course.photos, "").lock():
        done = command("read", "--course", course.place, "--secret-file", course.secret)
    assert done.exit_code == 2
    assert "another run reads photographs into it" in done.output


def test_pictures_of_a_folder_that_no_teacher_made_are_not_shown(tmp_path):
    folder = tmp_path / "Anna"
    folder.mkdir()
    (folder / "report.json").write_text('{"overlays": [{"own": "a.jpg"}, {"own": "../secret"}, {"own": "link"}]}')
    (folder / "a.jpg").write_bytes(b"a")
    (tmp_path / "secret").write_bytes(b"s")
    (folder / "link").symlink_to(tmp_path / "secret")
    assert photo_pictures(folder, right=False) == []
    (tmp_path / ".photographs").mkdir()
    assert len(photo_pictures(folder, right=False)) == 1
