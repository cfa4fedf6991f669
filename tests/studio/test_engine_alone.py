"""The engine with nothing but what a browser has: the standard library, NumPy and the archive that the page carries."""

from __future__ import annotations

import io
import json
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from studio_tasks import BUILT_IN, plain_task

from graphcam.studio.engine import answer
from graphcam.studio.pyodide_parts import ENGINE_LIBRARIES, ROOMS_ABOVE, engine_archive

ALONE = """
import json
from graphcam.studio.engine import answer
print(json.dumps([answer(request) for request in json.load(sys.stdin)]))
print(*sorted({name.partition(".")[0] for name in sys.modules}))
"""


def run_alone(folder: Path, code: str, said: str = "") -> list[str]:
    """The lines that a program writes which finds no library but those."""
    zipfile.ZipFile(io.BytesIO(engine_archive())).extractall(folder)
    for beside in Path(np.__file__).parents[1].glob("numpy*"):
        if not beside.name.endswith(".dist-info"):
            (folder / beside.name).symlink_to(beside)
    program = f"import sys; sys.path.insert(0, {str(folder)!r})\n{code}"
    ran = subprocess.run(
        [sys.executable, "-I", "-S", "-c", program], input=said, check=False, capture_output=True, text=True
    )
    assert ran.stderr == ""
    return ran.stdout.splitlines()


def whole(name: str, language: str) -> dict:
    """A request of everything."""
    wanted = dict.fromkeys(("told", "values", "warnings", "form", "mechanism"), True)
    asked = {"seq": 1, "language": language, "task": plain_task(name), **wanted}
    views = [view["name"] for view in answer({**asked, "views": []})["names"]]
    return {**asked, "views": [{"name": view, "px_per_mm": 2.0} for view in views]}


def timeless(answered: dict) -> dict:
    return {key: value for key, value in json.loads(json.dumps(answered)).items() if key != "ms"}


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "ru"])
def test_the_engine_alone_answers_as_among_all_libraries(language, tmp_path):
    requests = [whole(name, language) for name in BUILT_IN]
    told, loaded = run_alone(tmp_path, ALONE, json.dumps(requests))
    answers = json.loads(told)
    assert [timeless(each) for each in answers] == [timeless(answer(request)) for request in requests]
    assert all(each["ok"] for each in answers)
    foreign = set(loaded.split()) - sys.stdlib_module_names - {"graphcam", "numpy", *ENGINE_LIBRARIES}
    # What NumPy's own compiled modules enter, and what -c is.
    assert {name for name in foreign if "cython" not in name} <= {"__main__"}


def test_a_letter_beyond_the_table_is_a_box_where_no_font_can_be_opened(tmp_path):
    code = "from graphcam.sheets.text_measures import width; print(width('漢字', 3.5) == 2 * width('□', 3.5))"
    assert run_alone(tmp_path, code) == ["True"]


def test_the_archive_has_no_more_than_the_engine_can_use():
    names = zipfile.ZipFile(io.BytesIO(engine_archive())).namelist()
    assert {name.split("/")[0] for name in names if ".dist-info" not in name} == {
        "graphcam", "lazy_loader", "tomli_w",
    }  # fmt: skip
    assert not {name.split("/")[1] for name in names if name.startswith("graphcam/")} & ROOMS_ABOVE
    assert sum("LICEN" in name for name in names) == len(ENGINE_LIBRARIES)
    assert not [name for name in names if name.endswith((".ttf", ".html", ".js", ".css", ".pyc"))]
    assert engine_archive() == engine_archive()
