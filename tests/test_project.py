"""What the package promises as a whole: light to import, complete when installed, checked as the README says."""

from __future__ import annotations

import inspect
import json
import re
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

import graphcam

ROOT = Path(__file__).parents[1]
HEAVY = {"matplotlib", "ezdxf", "nbconvert", "pydantic", "typer", "rich", "babel"}


def loaded_by(code: str) -> set[str]:
    code = f"import sys\n{code}\nimport json\nprint(json.dumps(list(sys.modules)))"
    return set(json.loads(subprocess.check_output([sys.executable, "-c", code], cwd=ROOT)))


def test_importing_graphcam_loads_no_other_library():
    loaded = loaded_by("import graphcam")
    assert {"numpy"} & loaded == set()
    loaded = loaded_by("import graphcam\ngraphcam.Cam, graphcam.minimum_radius, graphcam.Pencil, graphcam.Construction")
    assert "numpy" in loaded
    assert HEAVY & loaded == set()
    # Not a single part of scipy: not even what scipy itself always loads.
    assert {name for name in loaded if name.startswith("scipy")} == set()


def test_a_task_by_hand_needs_no_reader_of_files():
    assert HEAVY & loaded_by("import graphcam\ngraphcam.Task") == set()
    assert "pydantic" in loaded_by("import graphcam\ngraphcam.builtin_task()")


def test_public_names_stand_and_are_documented():
    for name in graphcam.__all__:
        assert name in dir(graphcam)
        if callable(thing := getattr(graphcam, name)):
            assert inspect.getdoc(thing), name
    with pytest.raises(AttributeError, match="nonsense"):
        graphcam.nonsense  # noqa: B018


def test_a_look_at_the_package_shows_public_names_only():
    code = "import graphcam\nprint(*(name for name in dir(graphcam) if not name.startswith('_')))"
    names = set(subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True).split())
    assert names == set(graphcam.__all__)
    assert {"Cam", "Motion", "Solution", "solve"} <= names


def readme_commands() -> dict[str, str]:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return dict(re.findall(r"^<!-- (.+) -->\n```bash\n(.+)\n```$", text, re.MULTILINE))


def test_the_checks_run_the_commands_of_the_readme():
    commands = readme_commands()
    script = (ROOT / ".ci" / "run").read_text()
    assert set(re.findall(r'^run_readme "(.+)"$', script, re.MULTILINE)) == set(commands)
    solve, test = commands["install and solve"], commands["install and test"]
    assert solve.endswith("graphcam solve")
    assert test.endswith("pytest -n auto --dist loadfile")
    # As the script reads them: the function itself, on this README.
    function = re.search(r"^readme_command\(\) \{.*?^\}", script, re.MULTILINE | re.DOTALL)
    assert function
    for name, command in commands.items():
        code = f'{function[0]}\nreadme_command "{name}"'
        assert subprocess.check_output(["bash", "-c", code], cwd=ROOT, text=True) == f"{command}\n"


def test_a_commit_is_checked_as_a_clone_is():
    hooks = (ROOT / ".pre-commit-config.yaml").read_text()
    script = (ROOT / ".ci" / "run").read_text()
    for command in ("ruff check", "ruff format --check", "pyright --project pyproject.toml", "lint-imports"):
        assert f"entry: {command}," in hooks
        assert re.search(rf"^step {command}( \.)?$", script, re.MULTILINE)


def test_the_wheel_holds_tasks_and_types(tmp_path):
    from hatchling.builders.wheel import WheelBuilder

    wheel = next(WheelBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"]))
    held = set(zipfile.ZipFile(wheel).namelist())
    assert {f"graphcam/data/tasks/{name}.toml" for name in ("coursework", "arm", "flat")} <= held
    assert {"graphcam/py.typed", "graphcam/data/commented.toml", "graphcam/cli/solve.py"} <= held
    assert "graphcam/exercises/library/whole-cam.toml" in held
    assert {name.split("/")[0] for name in held} == {"graphcam", f"graphcam-{graphcam.__version__}.dist-info"}


def test_there_is_one_version():
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {graphcam.__version__}\n" in citation
    assert "version" not in tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_the_top_level_holds_what_it_should():
    allowed = {"pyproject.toml", "README.md", "graphcam", "notebooks", "tests", "exercises", "LICENSE", "CHANGELOG.md",
               "CITATION.cff"}  # fmt: skip
    made = {"graphcam-out", "build", "dist"}
    found = {path.name for path in ROOT.iterdir() if not path.name.startswith(".")}
    assert found - made == allowed
