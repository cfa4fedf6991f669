"""A stranger's file that asks for all memory, or never comes to an end, ends its worker and is told by its name."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest
from hostile_pictures import pdf_of

from graphcam.exercises.photographs.course_photographs import ReadingOrder, read_course
from graphcam.exercises.photographs.reading_limits import limited

pytestmark = pytest.mark.slow


def drawing_itself(times: int) -> bytes:
    """A PDF whose page shows a form that shows itself, several times: the work doubles with every level."""
    again = b"/F Do " * times
    box = b"/BBox[0 0 595 842]/Resources<</XObject<</F 5 0 R>>>>"
    return pdf_of(
        [
            b"<</Type/Catalog/Pages 2 0 R>>",
            b"<</Type/Pages/Kids[3 0 R]/Count 1>>",
            b"<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]/Contents 4 0 R/Resources<</XObject<</F 5 0 R>>>>>>",
            b"<</Length 5>>stream\n/F Do\nendstream",
            b"<</Type/XObject/Subtype/Form%s/Length %d>>stream\n%s\nendstream" % (box, len(again), again),
        ]
    )


TIMES = pytest.mark.parametrize("times", [2, 3])
READ = """
import sys
from pathlib import Path
from graphcam.exercises.photographs.reading_limits import limited
from graphcam.photo.file_intake import pictures_in
with limited(float(sys.argv[2])) as allow:
    allow(float(sys.argv[3]))
    print([found.name for found in pictures_in([Path(sys.argv[1])])])
"""
BUSY = """
import re, sys
from graphcam.exercises.photographs import reading_limits
sys.modules["resource"] = None  # as on Windows
with reading_limits.limited() as allow:
    allow(0.5)
    re.match("(a+)+$", "a" * 60 + "b")
"""
LARGE = """
from graphcam.exercises.photographs.reading_limits import limited
with limited(0.2) as allow:
    try:
        bytearray(300_000_000)
    except MemoryError:
        print("refused")
bytearray(300_000_000)
print("allowed")
"""


def run(code: str, *given: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code, *map(str, given)], capture_output=True, text=True, timeout=100)


@TIMES
def test_a_pdf_that_asks_for_all_memory_ends_its_process(times, tmp_path):
    file = tmp_path / "scan.pdf"
    file.write_bytes(drawing_itself(times))
    assert run(READ, file, 0.4, 60).returncode not in (0, 1)


@TIMES
def test_where_no_limit_of_memory_is_the_clock_ends_it(times, tmp_path):
    file = tmp_path / "scan.pdf"
    file.write_bytes(drawing_itself(times))
    # Within this time it takes no more than the limit of memory either.
    done = run("import sys; sys.modules['resource'] = None\n" + READ, file, 1, 1)
    assert done.returncode == 1


def test_a_library_that_never_comes_back_is_ended_in_time():
    begun = time.monotonic()
    assert run(BUSY).returncode == 1
    assert time.monotonic() - begun < 60


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="only Linux tells how much a process has taken")
def test_more_memory_than_the_limit_is_refused_and_given_back_after_it():
    assert run(LARGE).stdout.split() == ["refused", "allowed"]


def test_after_reading_nothing_is_limited():
    with limited() as allow:
        allow(0.2)
    # This process would be gone.
    time.sleep(0.4)


def test_the_file_is_told_and_the_others_are_looked_at(course, tmp_path):
    file, other = tmp_path / "endless.pdf", tmp_path / "IMG_1.jpg"
    file.write_bytes(drawing_itself(2))
    other.write_bytes(b"\xff\xd8\xff and no more")
    found = read_course(ReadingOrder([file, other], course.place, course.secret, workers=1))
    assert {photo.name: photo.why for photo in found.photos} == {
        "endless.pdf": "reading it failed, or took more than 20 s or 2 GB of memory",
        "IMG_1.jpg": "the file is damaged or incomplete",
    }
