"""What the package promises as a whole: light to import, complete when installed, checked as the README says."""

from __future__ import annotations

import ast
import inspect
import json
import re
import subprocess
import sys
import tomllib
import zipfile
from collections import Counter
from dataclasses import fields
from pathlib import Path
from typing import get_args

import pytest

import graphcam
from graphcam.given.follower import FOLLOWER_CLASSES, FOLLOWERS_BY_KIND, Follower, Kind
from graphcam.mechanism.followers import EXACT_FUNCTIONS
from graphcam.solving.task_board import drawn_follower
from graphcam.studio.predictions import SEEDED_TASKS
from graphcam.studio.sizes_form import KINDS as KIND_NAMES_IN_FORM
from graphcam.sweeps.design_space import SpaceCamTable
from graphcam.sweeps.designs import Designs
from graphcam.tasks.declared_numbers import declared
from graphcam.tasks.task import FOLLOWER_TABLES
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_task

ROOT = Path(__file__).parents[1]
HEAVY = {"matplotlib", "ezdxf", "nbconvert", "typer", "rich", "babel"}


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


def test_reading_a_task_loads_no_other_library():
    loaded = loaded_by("import graphcam\ngraphcam.builtin_task()")
    assert "graphcam.tasks.dataclass_reader" in loaded
    assert HEAVY & loaded == set()


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


def test_no_advice_names_a_package_index():
    """What an index has under the name may be somebody else's: all is installed from the source."""
    places = [*ROOT.glob("*.md"), *(ROOT / ".github").rglob("*.md")]
    places += [p for room in ("graphcam", "notebooks", "exercises") for p in (ROOT / room).rglob("*")]
    texts = [path for path in places if path.suffix in {".py", ".md", ".toml", ".po", ".html", ".js", ".ipynb"}]
    named = re.compile(r"(?:pip|uv|pipx|conda) (?:\w+ )*['\"]?graphcam\b")
    assert [str(path) for path in texts if named.search(path.read_text(encoding="utf-8"))] == []
    assert named.search("pip install 'graphcam[photo]'")


def test_a_commit_is_checked_as_a_clone_is():
    hooks = (ROOT / ".pre-commit-config.yaml").read_text()
    script = (ROOT / ".ci" / "run").read_text()
    for command in ("ruff check", "ruff format --check", "pyright --project pyproject.toml", "lint-imports"):
        assert f"entry: {command}," in hooks
        assert re.search(rf"^ *step {command}( \.)?$", script, re.MULTILINE)


def test_the_wheel_holds_tasks_and_types(tmp_path):
    from hatchling.builders.wheel import WheelBuilder

    wheel = next(WheelBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"]))
    held = set(zipfile.ZipFile(wheel).namelist())
    assert {f"graphcam/data/tasks/{name}.toml" for name in ("coursework", "arm", "flat")} <= held
    assert {"graphcam/py.typed", "graphcam/data/examples.toml", "graphcam/cli/solve.py"} <= held
    assert "graphcam/exercises/library/whole-cam.toml" in held
    assert "graphcam/data/fonts/osifont.ttf" in held
    course = {path.name for path in (ROOT / "notebooks").glob("[0-9][0-9]_*.ipynb")} | {"hard_cases.toml"}
    assert {name.split("/")[-1] for name in held if name.startswith("graphcam/notebooks/course/")} == course
    licences = f"graphcam-{graphcam.__version__}.dist-info/licenses"
    others = ("graphcam/data/fonts/osifont-licence.txt", "graphcam/data/studio/vendor/lit-html-licence.txt")
    assert {f"{licences}/{name}" for name in ("LICENSE", *others)} <= held
    assert "graphcam/data/studio/vendor/lit-html.js" in held
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


FOLLOWER_CLASS = re.compile(r"(Drawn)?(Translating|Oscillating|FlatFaced|OscillatingFlat)(Table|Kinematics)?$")
KINDS = set(FOLLOWERS_BY_KIND)
MAY_ASK = {
    *("mechanism/translating.py", "mechanism/oscillating.py", "mechanism/flat_faced.py"),
    *("mechanism/oscillating_flat.py", "constructions/drawn_swinging_face.py"),
    *("constructions/drawn_translating.py", "constructions/drawn_arm.py", "constructions/drawn_flat_face.py"),
}
"""The followers' own files."""


def asked_followers(code: str) -> set[str]:
    """The follower classes and kinds that a module tells apart, by isinstance, type, match or a comparison of kinds."""
    asked: list[ast.AST] = []
    for node in ast.walk(ast.parse(code)):
        match node:
            case ast.Call(func=ast.Name("isinstance" | "issubclass"), args=[_, classes]):
                asked.append(classes)
            case ast.MatchClass(cls=name):
                asked.append(name)
            case ast.Compare(left=ast.Call(func=ast.Name("type")), comparators=classes):
                asked += classes
            case ast.Compare(left=ast.Attribute(attr="kind" | "follower"), comparators=kinds):
                asked += kinds
            case _:
                pass
    parts = [part for node in asked for part in ast.walk(node)]
    names = {str(getattr(part, key, "")) for part in parts for key in ("id", "attr", "value")}
    return {name for name in names if FOLLOWER_CLASS.match(name) or name in KINDS}


def test_nobody_but_the_followers_own_files_asks_which_follower_it_is():
    package = Path(graphcam.__file__).parent
    modules = {path.relative_to(package).as_posix(): path for path in package.rglob("*.py")}
    asking = {name: asked_followers(path.read_text(encoding="utf-8")) for name, path in modules.items()}
    assert set(modules) >= MAY_ASK
    assert {name: asked for name, asked in asking.items() if asked and name not in MAY_ASK} == {}


def test_every_list_of_followers_has_every_follower():
    for listed in (FOLLOWER_TABLES, KIND_NAMES_IN_FORM, SEEDED_TASKS):
        assert listed.keys() == FOLLOWERS_BY_KIND.keys()
    assert set(get_args(Kind)) == FOLLOWERS_BY_KIND.keys()
    assert EXACT_FUNCTIONS.keys() == set(FOLLOWER_CLASSES) == set(get_args(Follower))
    assert {builtin_task(name).follower.kind for name in BUILTIN_TASK_NAMES} == FOLLOWERS_BY_KIND.keys()
    for kind, follower in FOLLOWERS_BY_KIND.items():
        names = {field.name for field in fields(follower)}
        assert names <= {field.name for field in fields(Designs)} & {field.name for field in fields(SpaceCamTable)}
        table = FOLLOWER_TABLES[kind]
        assert table in drawn_follower.registry
        numbers = {name for name, number in declared(table).items() if number.held}
        assert numbers
        assert all(declared(table)[name].name for name in numbers & names)


HOMES = {"given/follower.py", "tasks/task.py", "tasks/arcs_task.py"}
"""Where the kinds are declared: the followers, and the tables that a file has for them."""
DEFAULTS = {"sweeps/designs.py", "sweeps/design_space.py"}
"""Where one is what is meant if nothing is said."""
TEXTS = {"studio/sizes_form.py"}
"""Where a name that users see is the same word."""


def test_the_kinds_of_followers_are_named_at_home_alone():
    """The bench chooses its cases by name."""
    package, naming = Path(graphcam.__file__).parent, set[str]()
    for path in package.rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        docs = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        named = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and id(node) not in docs}
        if {word for word in named if isinstance(word, str)} & KINDS:
            naming.add(path.relative_to(package).as_posix())
    assert {name for name in naming if not name.startswith("bench/")} == HOMES | DEFAULTS | TEXTS


@pytest.mark.parametrize(
    "code",
    [
        "isinstance(cam.follower, Translating)",
        "isinstance(a, str | graphcam.Oscillating)",
        "issubclass(kind, (str, DrawnFlatFaced))",
        "type(follower) is OscillatingTable",
        "match table:\n    case FlatFacedTable(): pass",
        "solution.task.follower.kind == 'flat-faced'",
        "designs.follower in ('oscillating', 'translating')",
    ],
)
def test_asking_which_follower_it_is_would_be_found(code):
    assert asked_followers(code)
    assert not asked_followers("isinstance(phase, Dwell) or asked.kind == 'number'")


PACKAGE = ROOT / "graphcam"


def test_no_module_bears_the_name_of_another():
    # The modules of the command line bear their commands' names.
    paths = [path for path in PACKAGE.rglob("*.py") if path.parent != PACKAGE / "cli" and path.stem != "__init__"]
    counts = Counter(path.stem for path in paths)
    assert [name for name, count in counts.items() if count > 1] == []


def test_no_class_bears_the_name_of_another():
    lines = [line for path in PACKAGE.rglob("*.py") for line in path.read_text(encoding="utf-8").splitlines()]
    counts = Counter(found[1] for line in lines if (found := re.match(r" *class (\w+)[:(\[]", line)))
    assert [name for name, count in counts.items() if count > 1] == []


@pytest.mark.parametrize(("wrong", "right"), [("Translatng", "Translating"), ("cam", "Cam"), ("sweeep", "sweep")])
def test_a_misspelt_public_name_is_told_the_nearest(wrong, right):
    with pytest.raises(AttributeError, match=f"graphcam has no name '{wrong}'; did you mean '{right}'"):
        getattr(graphcam, wrong)
    assert not hasattr(graphcam, "nothing_of_the_kind")
