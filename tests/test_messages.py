"""What every message keeps to: its words are captions, those about a value have no quotes, and it goes anywhere."""

from __future__ import annotations

import ast
import pickle
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import typer

import graphcam
from graphcam.cli.shared import INPUT_ERROR_STATUS, input_errors
from graphcam.errors import DesignError, GraphcamError, MissingFileError, TaskError, TaskFaultsError, unreadable_error
from graphcam.exercises.course.course_folder import CourseThereError
from graphcam.exercises.key.mistake_separation import MistakeError
from graphcam.exercises.running.isolation_levels import Level
from graphcam.exercises.running.isolation_probe import LevelError
from graphcam.files import OutputError
from graphcam.given.measured import RowError
from graphcam.notebooks.notebook_execution import MissingExtraError, NotebookError
from graphcam.photo.pictures import PhotographError
from graphcam.sheets.page_filling import TooLargeError
from graphcam.words import say

WORDS_OF = {"DesignError": (1, 2, 3), "TaskError": (2, 3, 4), "RowError": (2, 3, 4), "OutputError": (1, 2)}
"""Which arguments of an error are words: its value, if it is told in words, its limit and its remedy."""
FILES = sorted(Path(graphcam.__file__).parent.rglob("*.py"))
SPACE = """
[motion]
lift = 30
rise_angle = [80, 90]
return_angle = 90
[cam]
prime_radius = { start = 40, stop = 60, count = 2000 }
"""


def faults(text: str) -> list[int]:
    """The lines of errors whose words are put together in English, or are no caption."""
    found: list[int] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            words = [node.args[k] for k in WORDS_OF.get(node.func.id, ()) if k < len(node.args)]
            if any(
                isinstance(each, ast.JoinedStr)
                or isinstance(getattr(each, "op", None), ast.Add)
                or " " in constant(each)
                for each in words
            ):
                found.append(node.lineno)
    return found


def constant(node: ast.expr) -> str:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else ""


def test_the_words_of_an_error_are_captions():
    found = {path.name: faults(path.read_text(encoding="utf-8")) for path in FILES if path.name != "errors.py"}
    assert {name: lines for name, lines in found.items() if lines} == {}


def test_the_check_of_words_can_fail():
    assert faults('DesignError("lift", f"{x:g} mm", say("less"))') == [1]
    assert faults('\nTaskError(path, "the table", say("missing"), "a file")') == [2]
    assert faults('DesignError("lift", say("missing"), say("given"))') == []


def doubled(text: str) -> list[int]:
    """The lines of errors whose limit and remedy may list the same words."""
    found: list[int] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in WORDS_OF:
            said = [ast.unparse(argument) for argument in node.args]
            if any(".join(" in each for each in said) and any(each.startswith("nearest(") for each in said):
                found.append(node.lineno)
    return found


def test_limit_and_remedy_do_not_list_the_same_words():
    found = {path.name: doubled(path.read_text(encoding="utf-8")) for path in FILES}
    assert {name: lines for name, lines in found.items() if lines} == {}
    assert doubled('DesignError("kind", kind, "one of " + ", ".join(KINDS), nearest(kind, KINDS))') == [1]
    with pytest.raises(DesignError) as caught:
        graphcam.solve(graphcam.builtin_task()).write("out", files=["html"])
    assert str(caught.value).startswith("files is 'html', but must be a list of kinds among pdf, ")
    assert str(caught.value).count("pdf") == 1


def test_what_somebody_wrote_stands_in_quotes_and_what_is_told_of_it_does_not():
    assert str(DesignError("law", "sine", "known")) == "law is 'sine', but must be known"
    assert str(DesignError("law", say("missing"), "given", "give it")) == "law is missing, but must be given; give it"


def kinds(kind: type[GraphcamError] = GraphcamError) -> Iterator[type[GraphcamError]]:
    for each in kind.__subclasses__():
        yield each
        yield from kinds(each)


SAID = say("at least {length:g} mm", length=3)
MADE: dict[str, GraphcamError] = {
    "DesignError": DesignError(say("prime radius"), say("missing"), SAID, say("enlarge it")),
    "TaskError": TaskError("cam.toml", "lift", 0, SAID, say("give the lift")),
    "TaskFaultsError": TaskFaultsError([TaskError("a", "b", 0, SAID), TaskError("a", "c", 1, SAID)]),
    "MissingFileError": MissingFileError("motion.csv", SAID, kind=say("folder"), where=say("beside it")),
    "OutputError": OutputError("out", SAID),
    "CourseThereError": CourseThereError("week-5"),
    "RowError": RowError(3, say("row"), 2.0, SAID, say("measure it")),
    "TooLargeError": TooLargeError("drawing", 2.0, SAID),
    "MistakeError": MistakeError("offset-sign", DesignError("offset", 0.0, SAID)),
    "PhotographError": PhotographError(say("the picture is blurred"), SAID),
    "LevelError": LevelError(Level.L2, SAID),
    "MissingExtraError": MissingExtraError(SAID, "nbclient"),
    "NotebookError": NotebookError("1 / 0", "division by zero"),
}


def test_an_error_of_every_kind_goes_to_another_process_as_it_is():
    ours = {kind.__name__ for kind in kinds() if kind.__module__.startswith("graphcam")}
    assert ours == MADE.keys()
    for error in MADE.values():
        there = pickle.loads(pickle.dumps(error))
        known, found = ({**vars(each), "errors": None} for each in (error, there))
        assert (type(there), str(there), found) == (type(error), str(error), known)
        assert there.caption == error.caption


def test_programs_read_the_pieces_of_an_error_in_english():
    error = MADE["DesignError"]
    assert isinstance(error, DesignError)
    assert (error.quantity, error.limit, error.remedy) == ("prime radius", "at least 3 mm", "enlarge it")


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (FileNotFoundError(2, "No such file or directory"), "there is no file a.csv; check the name"),
        (
            PermissionError(13, "Permission denied"),
            "a.csv: the roster is not readable (Permission denied), but must be a CSV file; check its permissions",
        ),
        (
            OSError(36, "File name too long"),
            "a.csv: the roster is not readable (File name too long), but must be a CSV file; check the name",
        ),
        (
            ValueError("embedded null byte"),
            "a.csv: the roster is not readable (embedded null byte), but must be a CSV file; check the name",
        ),
    ],
)
def test_a_file_that_cannot_be_read_is_told_in_one_shape(error, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert str(unreadable_error("a.csv", "the roster", "a CSV file", error)) == message


@pytest.mark.parametrize("system", [IsADirectoryError(21, "Is a directory"), PermissionError(13, "Permission denied")])
def test_a_folder_in_place_of_a_file_is_told_as_one(system, tmp_path):
    """Windows calls it a matter of permissions."""
    told = str(unreadable_error(tmp_path, "the roster", "a CSV file", system))
    assert told == f"{tmp_path}: the roster is a folder, but must be a CSV file; name the file in it"


def test_a_missing_file_is_told_alike_by_another_process():
    error = MissingFileError("motion.csv", "check motion.table", where="beside cam.toml")
    assert str(pickle.loads(pickle.dumps(error))) == str(error)
    assert str(error) == "there is no file motion.csv beside cam.toml; check motion.table"


def test_an_error_of_the_system_that_nobody_told_is_one_line_without_its_number(capsys):
    with pytest.raises(typer.Exit) as ended, input_errors():
        raise FileNotFoundError(2, "No such file or directory", "lost.json")
    assert ended.value.exit_code == INPUT_ERROR_STATUS
    assert capsys.readouterr().err == "graphcam: lost.json: No such file or directory\n"


FULL = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (2048, resource.RLIM_INFINITY))
from graphcam.__main__ import main
main()
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="limits of files are those of POSIX")
@pytest.mark.parametrize(
    "words", [["notebook", "--out", "out"], ["sweep", "space.toml", "--out", "out.csv"]], ids=["notebook", "sweep"]
)
def test_a_disk_that_is_full_is_one_line_and_leaves_nothing(words, tmp_path):
    """As a limit on the size of files fills it: the first write beyond it fails."""
    (tmp_path / "space.toml").write_text(SPACE, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "-c", FULL, *words], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ran.returncode == INPUT_ERROR_STATUS
    told = [line for line in ran.stderr.splitlines() if not line.endswith("...")]
    remedy = "choose a folder on another disk, or raise the limit on the size of files"
    assert told == [f"graphcam: the output '{words[-1]}' cannot be written (File too large); {remedy}"]
    assert [path.name for path in tmp_path.iterdir()] == ["space.toml"]


INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)

class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
module = sys.argv.pop(1)
from graphcam.__main__ import main
main()
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends Ctrl-C in another way")
@pytest.mark.parametrize(
    ("module", "words"),
    [
        ("graphcam.sweeps.dataset", ["sweep", "space.toml", "--out", "out.csv"]),
        ("graphcam.exercises.marking.simulate", ["exercise", "simulate", "pressure-angle"]),
        ("graphcam.notebooks.notebook_folder", ["notebook", "--out", "out"]),
    ],
    ids=["sweep", "simulate", "notebook"],
)
def test_ctrl_c_is_one_line_and_status_130_of_every_command(module, words, tmp_path):
    (tmp_path / "space.toml").write_text(SPACE, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, module, *words], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ran.returncode == 130
    assert [line for line in ran.stderr.splitlines() if not line.endswith("...")] == ["graphcam: interrupted"]
    assert [path.name for path in tmp_path.iterdir()] == ["space.toml"]
