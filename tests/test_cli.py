"""The command line around the main job, whose place a small one takes here."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from io import StringIO
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest
import typer
from over_all import fast_first
from typer.testing import CliRunner

import graphcam
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS, file_kind, print_files
from graphcam.errors import DesignError
from graphcam.files import whole_folder
from graphcam.report.output_folder import written_files
from graphcam.sweeps.design_space import load_space
from graphcam.tasks.task_file import builtin_text

QUANTITIES = {
    "max_v": {"drawn": 42.9, "exact": 42.97183463481174, "unit": "mm/rad", "error": -0.0718, "error_paper": -0.1,
              "tolerance_paper": 0.2},
    "max_pressure_angle_return_deg": {"drawn": None, "exact": None, "unit": "deg", "error": None, "error_paper": None,
                                      "tolerance_paper": None},
}  # fmt: skip


class Solution:
    warnings = ()

    def __init__(self, task: graphcam.Task) -> None:
        self.task = task

    def to_dict(self):
        return {"graphcam": graphcam.__version__, "task": self.task.to_dict(), "quantities": QUANTITIES, "files": {}}

    def write(self, folder, *, progress, **choices):
        with whole_folder(folder) as draft:
            (draft / "cam.pdf").write_text("a sheet")
            (draft / "solution.json").write_text(json.dumps(self.to_dict()))
        progress("PDF")
        return {"pdf": "cam.pdf", "player": None}


@pytest.fixture
def asked(monkeypatch):
    """What the command line asked of the rooms below."""
    calls = []
    solving, report = ModuleType("graphcam.solving.solve"), ModuleType("graphcam.report.output_folder")

    def solve(task, pencil=None):
        if task.follower.kind != "translating":
            raise DesignError("follower", task.follower.kind, "translating", "the others are not there yet")
        calls.append((task, pencil))
        return Solution(task)

    solving.solve, report.check_choices = solve, lambda solution, upto, dxf, working_drawing: None
    documents = ModuleType("graphcam.report.documents")
    documents.contents_of = lambda solution, per_construction: SimpleNamespace(solution=solution)
    monkeypatch.setitem(sys.modules, documents.__name__, documents)
    report.written_files = lambda folder: sorted(path.name for path in folder.iterdir())
    for module in (solving, report):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    return calls


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return lambda *words: CliRunner().invoke(app, [str(word) for word in words])


def files(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def test_without_a_word_the_coursework_is_solved_into_its_folder(run, asked, tmp_path):
    result = run("solve")
    assert result.exit_code == 0
    assert asked == [(graphcam.builtin_task(), None)]
    assert files(tmp_path) == ["graphcam-out/cam.pdf", "graphcam-out/solution.json"]
    told = result.stdout.split("graphcam-out: 2 files\n")[1]
    assert told == "  solution.json: all of it, for programs\n  cam.pdf\n"
    row = next(line for line in result.stdout.splitlines() if "max_v" in line)
    assert row.split()[-4:] == ["42.900", "42.972", "-0.100", "0.200"]
    assert result.stderr == "drawing and computing ...\nPDF ...\n"


def test_json_is_printed_alone_and_writes_nothing(run, asked, tmp_path):
    result = run("solve", "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout)["quantities"] == QUANTITIES
    assert result.stderr == ""
    assert files(tmp_path) == []


def test_json_with_a_folder_writes_and_names_the_files(run, asked, tmp_path):
    result = run("solve", "--json", "--out", "here")
    assert json.loads(result.stdout)["files"] == {"pdf": "cam.pdf", "player": None}
    assert files(tmp_path) == ["here/cam.pdf", "here/solution.json"]


def test_options_reach_the_rooms_below(run, asked):
    run("init", "cam.toml")
    result = run("solve", "cam.toml", "--pencil", "0.2", "--seed", "7", "--divisions", "24", "--out", "out")
    assert result.exit_code == 0
    task, pencil = asked[0]
    assert task.drawing.divisions == 24
    assert task.motion == graphcam.builtin_task().motion
    assert pencil == graphcam.Pencil.of(0.2, seed=7)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--pencil", "-0.1"], "--pencil is -0.1, but must be"),
        (["--pencil", "nan"], "--pencil is nan, but must be"),
        (["--pencil", "inf"], "--pencil is inf, but must be"),
        (["--pencil", "0.1", "--seed", "-1"], "--seed is -1, but must be"),
        (["--divisions", "0"], "divisions is 0, but must be"),
        (["--out", "/dev/null/out"], "the output '/dev/null/out' cannot be written"),
        (["--out", "file"], "the output 'file' cannot be written"),
        (["--out", "file/below"], "the output 'file/below' cannot be written"),
        (["flat.toml"], "flat.toml: follower is 'flat-faced', but must be translating; the others are not there yet"),
    ],
)
def test_wrong_input_ends_with_one_message(run, asked, tmp_path, words, message):
    (tmp_path / "file").write_text("")
    (tmp_path / "flat.toml").write_text(
        'rotation = "cw"\n[follower]\nkind = "flat-faced"\n[motion]\nphases = [\n'
        '{ kind = "rise", angle = 180, lift = 3, law = "2-3" },\n'
        '{ kind = "return", angle = 180, lift = 3, law = "2-3" }]\n'
    )
    result = run("solve", *words)
    assert result.exit_code == INPUT_ERROR_STATUS
    assert result.stdout == ""
    said = [line for line in result.stderr.splitlines() if not line.endswith("...")]
    assert len(said) == 1
    assert said[0].startswith(f"graphcam: {message}")
    assert files(tmp_path) == ["file", "flat.toml"]


@pytest.mark.parametrize("words", [["solv"], ["solve", "--divisions", "many"], ["solve", "a", "b"], ["init"], ["--x"]])
def test_wrong_usage_has_the_same_status(run, asked, words):
    result = run(*words)
    assert result.exit_code == INPUT_ERROR_STATUS
    assert result.stderr.startswith("graphcam: ")
    assert len(result.stderr.splitlines()) == 1
    assert asked == []


def test_a_fault_of_graphcam_is_not_called_the_users(run, asked, monkeypatch):
    def fail(*_):
        raise ZeroDivisionError

    monkeypatch.setattr(sys.modules["graphcam.solving.solve"], "solve", fail)
    assert isinstance(run("solve").exception, ZeroDivisionError)


def test_init_writes_a_task_once(run, asked, tmp_path):
    result = run("init", "my cam.toml")
    assert result.exit_code == 0
    assert result.stdout == "my cam.toml is written; use it with: graphcam solve 'my cam.toml'\n"
    assert graphcam.load_task(tmp_path / "my cam.toml") == graphcam.builtin_task()
    (tmp_path / "my cam.toml").write_text("changed")
    again = run("init", "my cam.toml")
    assert again.exit_code == INPUT_ERROR_STATUS
    assert again.stderr.startswith("graphcam: the output 'my cam.toml' cannot be written (it already exists)")
    assert (tmp_path / "my cam.toml").read_text() == "changed"


def test_init_writes_a_space_that_can_be_swept(run, tmp_path):
    result = run("init", "space.toml", "--sweep")
    assert result.stdout == "space.toml is written; use it with: graphcam sweep space.toml --out results.csv\n"
    assert len(load_space(tmp_path / "space.toml")) > 1000


def test_graphcam_alone_shows_commands_that_there_are(run):
    result = run()
    assert result.exit_code == 0
    commands = [line.split()[1:] for line in result.stdout.splitlines() if line.startswith("    graphcam ")]
    assert len(commands) == len(set(map(tuple, commands))) >= 6
    for words in commands:
        command = typer.main.get_command(app)
        for word in words:
            if word in getattr(command, "commands", {}):
                command = command.commands[word]
        # The rest is as the command wants it.
        assert command.make_context("graphcam", words[2 if words[0] == "exercise" else 1 :])


class Terminal(StringIO):
    def isatty(self):
        return True


def test_the_files_are_links_in_a_terminal_and_plain_elsewhere(tmp_path, monkeypatch):
    names = ["sheet-2.svg", "sheet.pdf", "player.html", "solution.json", "sheet.svg"]
    plain, linked = StringIO(), Terminal()
    monkeypatch.setenv("TERM", "xterm-256color")
    for stream in (plain, linked):
        monkeypatch.setattr(sys, "stdout", stream)
        print_files(tmp_path / "a b", names)
    assert "\x1b" not in plain.getvalue()
    assert "  sheet.pdf, sheet.svg, sheet-2.svg: the sheet, true to scale\n" in plain.getvalue()
    first = f"{tmp_path / 'a b' / 'player.html'} (in a browser), then {tmp_path / 'a b' / 'sheet.pdf'} (print at 100 %)"
    assert plain.getvalue().endswith(f"Open first: {first}\n")
    targets = set(re.findall(r"\x1b\]8;[^;]*;([^\x1b]+)\x1b", linked.getvalue()))
    assert targets == {(tmp_path / "a b").as_uri(), *((tmp_path / "a b" / name).as_uri() for name in names)}


def test_all_files_that_a_run_writes_are_told(tmp_path):
    """Of every kind and every page; a file of the user's own is none."""
    (tmp_path / "mine.txt").write_text("mine")
    task = graphcam.builtin_task()
    solution = graphcam.solve(replace(task, drawing=task.drawing.on("A3")))
    solution.write(tmp_path, files=["png", "csv", "player"])
    names = written_files(tmp_path)
    assert sorted(names) == sorted(path.name for path in tmp_path.iterdir() if path.name != "mine.txt")
    assert {"solution.json", "sheet-2.png"} <= set(names)
    assert all(file_kind(name) for name in names)


def test_the_version(run):
    assert run("--version").stdout == f"graphcam {graphcam.__version__}\n"


def test_the_help_shows_what_stands_in_brackets(run):
    assert "task's table [part]" in " ".join(run("solve", "--help").stdout.replace("│", " ").split())


@pytest.mark.parametrize("command", [[], ["solve"], ["init"]])
def test_the_examples_of_the_help_run(run, asked, tmp_path, command):
    shown = run(*command, "--help").stdout.splitlines()
    examples = [line.strip().split("   ")[0] for line in shown if line.strip().startswith("graphcam ")]
    assert examples
    for example in examples:
        if "init" not in example:
            run("init", "cam.toml")
        words = shlex.split(example.split(" > ")[0])[1:]
        result = run(*words)
        assert result.exit_code == 0, (example, result.output)
        (tmp_path / "cam.toml").unlink(missing_ok=True)


INTERRUPTED = """
import os, signal, sys

# What runs in the background of a shell would not hear.
signal.signal(signal.SIGINT, signal.default_int_handler)

class Interrupting:
    "Sends what Ctrl-C sends when a module is about to be loaded."
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting())
module, sys.argv[1:] = sys.argv[1], ["solve", "--out", "out"]
from graphcam.__main__ import main
main()
"""


@pytest.mark.parametrize(
    "module",
    fast_first(["graphcam.cli", "graphcam.report.output_folder", "typer", "graphcam.cli.solve", "numpy", "numpy.linalg",
     "graphcam.tasks.task", "graphcam.tasks.dataclass_reader", "matplotlib", "ezdxf"], 2),
)  # fmt: skip
def test_an_interruption_is_one_line_from_the_first_moment(module, tmp_path):
    ran = subprocess.run([sys.executable, "-c", INTERRUPTED, module], cwd=tmp_path, capture_output=True, text=True)
    assert [line for line in ran.stderr.splitlines() if not line.endswith("...")] == ["graphcam: interrupted"]
    assert ran.returncode == 130
    assert files(tmp_path) == []


@pytest.mark.slow
def test_a_full_disk_under_the_standard_output_is_one_line(tmp_path):
    with Path("/dev/full").open("w") as full:
        words = [sys.executable, "-m", "graphcam", "solve", "--json"]
        ran = subprocess.run(words, cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True)
    assert ran.returncode == INPUT_ERROR_STATUS
    assert ran.stderr == "graphcam: the standard output cannot be written (No space left on device)\n"


def test_who_starts_it_deaf_to_interruptions_is_not_interrupted(tmp_path):
    """As a shell does with what runs in the background."""
    deaf = INTERRUPTED.replace(
        "class Interrupting", "signal.signal(signal.SIGINT, signal.SIG_IGN)\n\nclass Interrupting"
    )
    deaf = deaf.replace('["solve", "--out", "out"]', '["--version"]')
    ran = subprocess.run([sys.executable, "-c", deaf, "typer"], cwd=tmp_path, capture_output=True, text=True)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, f"graphcam {graphcam.__version__}\n", "")


@pytest.mark.parametrize(
    "words",
    [
        ["solve", "--out", ""],
        ["solve", ""],
        ["notebook", "--out", ""],
        ["bench", "--out", ""],
        ["sweep", "space.toml", "--out", ""],
        ["init", ""],
        ["exercise", "simulate", "inversion-translating", "--out", ""],
        ["exercise", "make", "inversion-translating", "--roster", "r.csv", "--secret-file", "s", "--out", ""],
        ["exercise", "grade", "", "--secret-file", "s", "--out", "grades.csv"],
        ["exercise", "grade", ".", "--secret-file", "s", "--out", ""],
        ["exercise", "grade", ".", "--secret-file", "s", "--out", "grades.csv", "--feedback", ""],
        ["exercise", "export", "inversion-translating", "--format", "moodle", "--out", ""],
    ],
)
def test_a_place_without_a_name_is_refused(run, tmp_path, words):
    result = run(*words)
    assert result.exit_code == INPUT_ERROR_STATUS
    assert " is '', but must be the name of a file or folder ('.' is the current one); " in result.stderr
    assert files(tmp_path) == []


@pytest.mark.slow
def test_solve_says_what_was_adopted_and_where_it_comes_from(run, tmp_path):
    """What the task gives, what was found, and a preload left open, which is the minimum; a worksheet tells nothing."""
    spring = "\n[spring]\nmass = 5\nstiffness = 3\n"
    Path("cam.toml").write_text(builtin_text("coursework") + spring, encoding="utf-8")
    said = run("solve", "cam.toml", "--out", "out").stdout
    assert re.search(
        r"^adopted: prime radius 44 mm \(found\), offset −10 mm \(given\), roller radius 17 mm \(found\), "
        r"preload \d[\d.]* N \(minimum\)$",
        said,
        re.MULTILINE,
    )
    # What to open first stands last, where one looks.
    assert said.splitlines()[-1].startswith("Open first")
    assert "adopted" not in run("solve", "cam.toml", "--out", "out", "--worksheet").stdout


@pytest.mark.parametrize("said", [["--pencil", "0,2"], ["--pencil", "0.2mm"], ["--seeds", "4"]])
def test_a_wrong_option_is_told_in_the_language_of_the_task(run, tmp_path, said):
    (tmp_path / "cam.toml").write_text('[drawing]\nlanguage = "ru"\n')
    result = run("solve", str(tmp_path / "cam.toml"), *said)
    assert result.exit_code == INPUT_ERROR_STATUS
    assert "а должно быть" in result.stderr
