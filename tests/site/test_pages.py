"""The how-tos are true: their commands run, their files exist, their code does what they say."""

from __future__ import annotations

import ast
import io
import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from babel.messages.pofile import read_po, write_po
from mpmath import mp, mpf
from pages import BLOCK, HOW_TO, PAGES, ROOT, blocks, files, paths, rows, text_of

import graphcam as gc
from graphcam.given.declared_laws import DeclaredLaw
from graphcam.given.stations import divide
from graphcam.sweeps.dataset import parts_of

pytestmark = pytest.mark.slow

WITH_COMMANDS = [page for page in HOW_TO if blocks(page, "bash")]
NAMED = "5-6-7-8-9"


def test_every_page_is_written_for_somebody_and_says_what_to_do():
    for page in (
        "sheets-for-my-group",
        "grade-a-group",
        "write-an-exercise",
        "check-my-drawing",
        "make-the-cam",
        "draw-a-measured-motion",
        "sweep-many-cams",
        "design-in-python",
        "add-a-law",
        "add-a-field",
        "add-a-language",
        "add-a-construction",
        "add-a-follower",
    ):
        assert f"how-to/{page}.md" in HOW_TO
    for page in HOW_TO:
        assert text_of(page).startswith("# ")
        assert blocks(page, "bash") or blocks(page, "sh"), page


@pytest.mark.parametrize("page", sorted(str(path.relative_to(PAGES)) for path in PAGES.rglob("*.md")))
def test_the_files_that_a_page_names_are_there(page):
    missing = [path for path in paths(page) if not (ROOT / path).exists()]
    assert missing == []


@pytest.mark.parametrize("page", [page for page in (*HOW_TO, "architecture.md") if rows(page)])
def test_what_a_table_says_of_a_file_stands_in_it(page):
    for path, names in rows(page).items():
        held = (ROOT / path).read_text(encoding="utf-8")
        assert [name for name in names if name not in held] == [], path


@pytest.mark.parametrize("page", WITH_COMMANDS)
def test_the_commands_of_a_page_run_in_order(page, tmp_path):
    for name, text in files(page).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    graphcam = f'graphcam() {{ "{sys.executable}" -W error::UserWarning -m graphcam "$@"; }}'
    script = "\n".join(["set -euo pipefail", graphcam, *blocks(page, "bash")])
    done = subprocess.run(
        ["bash", "-c", script], cwd=tmp_path, capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "warning" not in done.stderr


def test_the_measured_motion_of_its_page_has_the_phases_that_the_page_tells(tmp_path):
    for name, text in files("how-to/draw-a-measured-motion.md").items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    task = gc.load_task(tmp_path / "cam.toml")
    motion = task.motion()
    assert np.degrees(motion.angles).round(6).tolist() == [130, 50, 120, 60]
    rise = divide(motion, task.drawing.divisions).phi[: task.drawing.divisions + 1]
    assert np.isclose(rise[:, None], motion.phi).any(axis=1).all()


ON_WINDOWS_TOO = {"graphcam", "jupyter", "mkdir", "npm", "pybabel", "pytest", "python"}
"""Programs that a page may call: they are the same in PowerShell and in the Command Prompt."""


def not_on_windows(line: str) -> str:
    """Why a line of a page is no command on Windows; empty where it is one."""
    command = line.split("  #")[0]
    if command.split()[0] not in ON_WINDOWS_TOO or command.startswith("mkdir -"):
        return "program"
    return next((sign for sign in ("'", "\\", "$", "|", "&&", "<<", "~/") if sign in command), "")


def test_the_commands_of_the_pages_exist_on_windows():
    texts = [text_of(page) for page in HOW_TO]
    texts += [(ROOT / folder / "README.md").read_text(encoding="utf-8") for folder in ("exercises", "notebooks")]
    lines = [line for text in texts for found in BLOCK.finditer(text) if found["language"] in ("bash", "sh")
             for line in found["text"].splitlines() if line]  # fmt: skip
    assert len(lines) > 40
    assert [(line, why) for line in lines if (why := not_on_windows(line))] == []


@pytest.mark.parametrize(
    "line",
    ["head -c 32 /dev/urandom > secret", "mkdir -p build", "python -m pip install '.[photo]'", "graphcam solve \\"],
)
def test_a_command_that_windows_has_not_would_be_found(line):
    assert not_on_windows(line)


def commands_for_developers() -> list[str]:
    return [line for page in HOW_TO for block in blocks(page, "sh") for line in block.splitlines()]


def test_developers_are_sent_to_tests_that_are_there():
    given = [line.split() for line in commands_for_developers()]
    assert given
    for program, *arguments in given:
        assert program in ("pytest", "python", "graphcam", "pybabel", "mkdir", "npm")
        if program in ("pytest", "python"):
            assert all((ROOT / path).exists() for path in arguments)


def followed(page: str, folder: Path, script: str = "") -> str:
    """What the last file of a page prints, or a script of ours, in a folder that holds the page's files."""
    for name, text in files(page).items():
        (folder / name).write_text(text, encoding="utf-8")
    command = [sys.executable, "-W", "error::UserWarning", "-c", script or (folder / [*files(page)][-1]).read_text()]
    beside = (ROOT / "tests" / room for room in ("", "constructions", "comparison", "mechanism"))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, *beside, folder)))}
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, env=environment)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_construction_of_the_page_is_drawn_compared_and_shown(tmp_path):
    """From its one file and its one line; the drawn value lies within its bound of the exact one."""
    page = "how-to/add-a-construction.md"
    *shown, numbers = followed(page, tmp_path).splitlines()
    assert shown[0] == "Construction 'steepest_chord', steps: 2"
    _, exact, error, bound = map(float, numbers.split())
    assert exact == pytest.approx(2 * 30 / math.radians(60))  # a return of 30 mm in 60 degrees, twice its mean
    assert 0 < abs(error) <= bound
    pages = [path.read_text(encoding="utf-8") for path in (tmp_path / "look").glob("sheet*.svg")]
    assert sum("The steepest chord" in page for page in pages) == 1
    assert "The follower is fastest" in (tmp_path / "look" / "player.html").read_text(encoding="utf-8")


def test_the_construction_of_the_page_has_the_order_of_error_that_it_says(tmp_path):
    script = """
from steepest_chord import MEANING, steepest_chord
from graphcam.bench.convergence import series_of
from graphcam.bench.bench_followers import scene
where = scene("translating", "cycloidal")
draw = lambda chain: steepest_chord(chain.integration, 40.0, chain.pencil)
chains = {n: where.chain(n).adding(MEANING, draw) for n in (12, 24, 48, 96)}
print(next(s.order for s in series_of(where, chains) if s.construction == "steepest_chord"))
"""
    assert float(followed("how-to/add-a-construction.md", tmp_path, script)) == pytest.approx(2.0, abs=0.1)


def test_the_construction_of_the_page_keeps_what_every_construction_owes(tmp_path):
    """Its parts draw all its marks, and each mark lies on what its act left."""
    script = """
import graphcam as gc
from steepest_chord import steepest_chord
from test_acts import ON_THE_FIGURE, beside, figure_of, own_marks
from test_parts import left_out
for name in ("coursework", "arm", "flat"):
    steps = steepest_chord(gc.solve(gc.builtin_task(name)).chain.integration, 40.0, gc.Pencil()).steps()
    assert [left_out(step) for step in steps] == [[], []], name
    for step in steps:
        for mark in own_marks(step):
            assert beside(mark, mark.of, figure_of(mark.of)) < ON_THE_FIGURE, (name, mark)
print("kept")
"""
    assert followed("how-to/add-a-construction.md", tmp_path, script).strip() == "kept"


@pytest.mark.parametrize(
    ("page", "module", "construction"),
    [
        ("add-a-construction", "steepest_chord", "steepest_chord(s, 40.0, gc.Pencil())"),
        ("add-a-follower", "drawn_leaning", 'leaning_inversion(s, "cw", 50, -10, 0.3, Scale(1.0, "mm"), gc.Pencil())'),
    ],
)
def test_what_the_page_draws_can_be_drawn_again_from_its_acts(page, module, construction, tmp_path):
    """By the board that shares no code with the acts."""
    script = f"""
import numpy as np
import graphcam as gc
from graphcam.drafting.scale import Scale
from replay import followed
from {module} import *
s = gc.solve(gc.builtin_task()).chain.integration
drawn = {construction}
readings, _ = followed(drawn)
print(max(np.abs(np.ravel(r.paper) - readings[name]).max() for name, r in drawn.readings.items()))
"""
    assert float(followed(f"how-to/{page}.md", tmp_path, script)) < 1e-9


def test_the_follower_of_the_page_is_drawn_as_it_is_computed(tmp_path):
    """Every quantity within its bound; the law is drawn exactly, and so is the pitch curve."""
    *quantities, pitch, _ = followed("how-to/add-a-follower.md", tmp_path).splitlines()
    assert len(quantities) == 8
    for line in quantities:
        _, _, _, error, bound = line.split()
        assert abs(float(error)) <= float(bound), line
    assert max(map(float, pitch.split()[1:])) < 1e-9


@pytest.fixture(scope="module")
def with_german(tmp_path_factory):
    """A clone in which the page on languages was followed: its commands, and its translations put into the catalog."""
    page, clone = "how-to/add-a-language.md", tmp_path_factory.mktemp("clone")
    for folder in ("graphcam", "exercises", "tests"):
        shutil.copytree(ROOT / folder, clone / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", clone)
    # The programs lie beside the interpreter, whether or not its environment is activated.
    beside = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": beside, "PYTHONPATH": str(clone)}

    def run(script: str) -> subprocess.CompletedProcess[str]:
        graphcam = f'graphcam() {{ "{sys.executable}" -m graphcam "$@"; }}'
        command = ["bash", "-euc", f"{graphcam}\n{script}"]
        return subprocess.run(command, cwd=clone, capture_output=True, text=True, check=False, env=environment)

    begin, look, check, update = blocks(page, "sh")
    assert run(begin).returncode == 0
    path = clone / "graphcam" / "data" / "languages" / "de.po"
    catalog, said = (read_po(io.BytesIO(text)) for text in (path.read_bytes(), blocks(page, "po")[0].encode()))
    for message in said:
        if message.id:
            assert catalog[message.id].string == ""
            catalog[message.id].string = message.string
    with path.open("wb") as file:
        write_po(file, catalog)
    return clone, run, (look, check, update)


def test_the_language_of_the_page_is_spoken_where_it_is_translated(with_german):
    clone, run, (look, _, update) = with_german
    done = run(look)
    assert done.returncode == 0, done.stderr
    page = (clone / "deutsch" / "player.html").read_text(encoding="utf-8")
    assert "Pol und Strahlen, a nach v" in page
    assert "Pole and rays, a to v" not in page
    assert "Shaded region" in page or "Minimum radius" in page
    assert run(update).returncode == 0
    kept = (clone / "graphcam" / "data" / "languages" / "de.po").read_text(encoding="utf-8")
    assert 'msgstr "Pol und Strahlen, {source} nach {target}"' in kept


def test_the_check_of_the_page_names_what_is_not_translated_yet(with_german):
    _, run, (_, check, _) = with_german
    done = run(check)
    assert done.returncode == 1
    assert re.search(r"^de: \d+ texts lacking, 0 left over$", done.stdout, re.MULTILINE)
    failed = [line.split(" - ")[0] for line in done.stdout.splitlines() if line.startswith("FAILED")]
    assert any("test_language.py" in line for line in failed)
    assert [line for line in failed if not re.search(r"[\[-]de[\]-]", line)] == []


@pytest.fixture(scope="module")
def cells():
    """What the notebook of the page has computed, and the law that it adds to the package."""
    *in_a_notebook, module = blocks("how-to/add-a-law.md", "python")
    computed, added = {}, {}
    exec("\n".join(in_a_notebook), computed)
    exec(module, added)
    (declared,) = (value for value in added.values() if isinstance(value, DeclaredLaw))
    assert declared.name == NAMED
    return computed, declared.make(1.0)


def test_the_laws_of_the_page_are_the_polynomial_that_it_names(cells):
    """Against the integral of 630 u^4 (1 - u)^4, term by term and at 50 digits."""
    terms = [(5, 126), (6, -420), (7, 540), (8, -315), (9, 70)]
    u = np.linspace(0, 1, 41)
    computed, added = cells
    for law in (computed["law"], added):
        with mp.workdps(50):
            for k, value in enumerate(law(u)):
                exact = [sum(c * mpf(math.perm(n, k)) * mpf(x) ** (n - k) for n, c in terms) for x in u]
                np.testing.assert_allclose(value, np.array(exact, dtype=float), rtol=1e-12, atol=1e-13 * 10**k)
        fine = law(np.linspace(0, 1, 100_001))
        assert fine[1].max() == pytest.approx(law.peak_velocity, rel=1e-9)
        assert np.abs(fine[2]).max() == pytest.approx(law.peak_acceleration, rel=1e-8)


LANDED = """
from dataclasses import replace
import graphcam as gc
from graphcam.bench.reference import law_eps
from graphcam.comparison.double_integration import proved_bounds
from graphcam.studio.sizes_form import form_of
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
phases = RiseTable(120, 30, NAMED), DwellTable(30), ReturnTable(110, 30, NAMED), DwellTable(100)
solution = gc.solve(replace(gc.builtin_task(), motion=MotionTable(phases)))
bounds = proved_bounds(solution.cam.motion, solution.chain.board.stations)
assert bounds["max_v"] > 0 and bounds["max_a"] > 0
assert law_eps(NAMED) < 200
(phases,) = (field["phases"] for field in form_of(solution, str) if field["kind"] == "phases")
(choices,) = (field["choices"] for field in phases[0]["fields"] if field["kind"] == "choice")
assert NAMED in [choice["value"] for choice in choices]
"""
"""What the other rooms make of a law that has landed."""


@pytest.mark.slow
def test_the_law_of_the_page_lands_by_one_file_and_its_place_in_the_list(tmp_path):
    for folder in ("graphcam", "exercises", "tests"):
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    listed = tmp_path / "graphcam/given/laws.py"
    text = listed.read_text(encoding="utf-8")
    (tmp_path / "graphcam/given/law_5_6_7_8_9.py").write_text(blocks("how-to/add-a-law.md", "python")[-1], "utf-8")
    for before, line in (
        ("from graphcam.given.motion_law", "from graphcam.given.law_5_6_7_8_9 import POLYNOMIAL_5_6_7_8_9\n"),
        ("*TEXTBOOK_LAWS,", "POLYNOMIAL_5_6_7_8_9, "),
    ):
        assert text.count(before) == 1
        text = text.replace(before, line + before)
    listed.write_text(text, encoding="utf-8")
    tests = "given/test_laws.py", "given/test_motion.py", "comparison/test_double_integration.py"
    for command in (
        ["-c", LANDED.replace("NAMED", repr(NAMED))],
        ["-m", "pytest", "-q", "-p", "no:cacheprovider", *(f"tests/{name}" for name in tests)],
    ):
        done = subprocess.run(
            [sys.executable, *command], cwd=tmp_path, capture_output=True, text=True, check=False,
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
        )  # fmt: skip
        assert done.returncode == 0, done.stdout + done.stderr


def test_least_radius_sweep_and_task_of_the_page_take_its_laws(cells):
    computed, _ = cells
    f, f1 = computed["law"](np.linspace(0, 1, 200_001), 1)
    slope = math.tan(math.radians(30))
    steepest = (f1 * 30 / 2.0 - f * 30 * slope).max()
    # Rise and rest bind: the apex of the region, half as high as the line meets the axis of v.
    assert computed["least"].prime_radius == pytest.approx(math.hypot(steepest / 2, steepest / 2 / slope), rel=1e-9)
    assert np.all(np.diff(computed["swept"]["max_pressure_angle_rise"]) < 0)
    assert computed["solution"].to_dict()["task"]["motion"]["phases"][0]["law"] == NAMED
    assert computed["sudden"].jumps == (0.4,)
    assert computed["sampled"](0.5)[0] == pytest.approx(0.5, abs=1e-12)


def test_the_conditions_of_the_page_are_met(cells):
    computed, _ = cells
    assert computed["late"](0.52)[0] == pytest.approx(0.5, rel=1e-14)
    assert computed["steady"].peak_velocity == pytest.approx(2 / 1.5, rel=1e-14)
    s, v, *_ = computed["by_conditions"]([math.pi / 3, 3.4, 4.0])
    assert (s.tolist(), float(v[0])) == (pytest.approx([15, 22, 8], rel=1e-14), pytest.approx(25, rel=1e-14))
    assert [phase.kind for phase in computed["by_conditions"].phases] == ["rise", "dwell", "return", "dwell"]


# --- many cams -------------------------------------------------------------------------------------------------------

MANY = "how-to/sweep-many-cams.md"


def test_the_parts_of_the_page_are_read_as_it_says(tmp_path):
    script = """
import runpy, subprocess, sys
command = [sys.executable, "-m", "graphcam", "sweep", "space.toml", "--out", "results", "--workers", "2"]
subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
runpy.run_path("read.py")
"""
    permitted, radius, rows = followed(MANY, tmp_path, script).split()
    assert int(rows) == 17 * 2 * 161 * 9
    assert 0 < int(permitted) < int(rows)
    assert 40 <= float(radius) < 80


def test_the_search_of_the_page_ends_in_the_front_of_the_whole_grid(tmp_path):
    script = """
import itertools
import numpy as np
import search as s

def pairs(cams, radii, strokes):
    best = s.front(radii, strokes)
    return sorted(zip(cams[best].tolist(), radii[best], strokes[best]))

cams = np.array([*itertools.product(range(33), repeat=3)])
radii = s.least_radii(cams)
whole = pairs(cams, radii, s.ANGLES[cams[:, 0]] + s.ANGLES[cams[:, 1]])
for s.NEAR in (1.0, 1.02, 1.05):
    s.computed = 0
    print(pairs(*s.search()) == whole, s.computed)
some = np.random.default_rng(3).choice(len(cams), 12)
every = np.arange(0, s.RADII.size, 8)
for cam, radius in zip(cams[some], radii[some]):
    permitted = s.swept(np.repeat(cam[None], every.size, axis=0), s.RADII[every], "feasible")
    print((permitted == (s.RADII[every] >= radius)).all(), s.RADII.size * len(cams))
"""
    missed, near, nearer, *monotone = (line.split() for line in followed(MANY, tmp_path, script).splitlines())
    assert missed[0] == "False"
    assert [line[0] for line in (near, nearer, *monotone)] == ["True"] * 14
    assert f"{int(nearer[1]):,} of {round(int(monotone[0][1]) / 1e6)} million" in text_of(MANY)


def test_what_a_sweep_takes_follows_from_what_a_design_takes():
    text = text_of(MANY)
    all_of_them, most, feasible, few = map(
        float,
        re.search(
            r"took (\S+) µs and at most (\S+) bytes.*?quantities, (\S+) µs and (\S+) bytes", text, re.DOTALL
        ).groups(),
    )
    for designs, row in ((10**9, "10⁹"), (10**12, "10¹²")):
        cells = re.search(rf"\| {row} \| (.*) \|", text)[1].replace(",", "").split(" | ")
        parts, hours, size, hours_feasible, size_feasible = (float(cell.split()[0]) for cell in cells)
        assert parts == len(parts_of(designs))
        unit = designs / 1e9
        for told, micros in ((hours, all_of_them), (hours_feasible, feasible)):
            assert told == pytest.approx(designs * micros * 1e-6 / 3600, rel=0.05)
        for told, each in ((size, most), (size_feasible, few)):
            assert told == each
        assert {cell.split()[1] for cell in cells if " " in cell} == {"GB" if unit == 1 else "TB"}


def test_the_sized_cam_of_the_page_is_held_back_by_both_limits_and_its_message_is_the_real_one(tmp_path):
    page = "how-to/size-a-cam.md"
    active, first, *_, last = followed(page, tmp_path).splitlines()
    assert {"pressure angle on the rise", "stress"} < set(ast.literal_eval(active))
    assert (first, last[:8]) == ("41.6 mm, 1500 MPa, or a face of 30.0 mm", "90.0 mm,")
    narrow = files(page)["cam.toml"].replace("[30, 90]", "[30, 40.5]")
    (tmp_path / "narrow.toml").write_text(narrow, encoding="utf-8")
    with pytest.raises(gc.DesignError) as error:
        gc.size_task(gc.load_task(tmp_path / "narrow.toml"))
    assert " ".join(f"graphcam: {error.value}".split()) in " ".join(text_of(page).split())


def test_the_given_cam_of_the_page_moves_its_followers_as_it_says(tmp_path):
    page = "how-to/analyse-a-given-cam.md"
    first, roller, *_ = followed(page, tmp_path, files(page)["other.py"]).splitlines()
    assert first == "nose 20.203 mm, its centre 22.797 mm from the cam's"
    start, apex = ast.literal_eval(roller)
    assert f"begins with {start} mm/s² and has −{-apex} mm/s² at the apex" in text_of(page)
    lifts = re.findall(r"lift (\S+) mm", followed(page, tmp_path))
    assert lifts == ["10.000"] * 3
    assert "All three have a lift of 10 mm" in text_of(page)


def test_the_cam_of_the_page_is_designed_in_python_as_it_says(tmp_path):
    """The printed lines are those of the page, and the table and the profile are those of the cam."""
    page = "how-to/design-in-python.md"
    assert len(files(page)["design.py"].splitlines()) <= 25
    assert followed(page, tmp_path).replace(os.sep, "/") == blocks(page, "text")[0]
    table = np.genfromtxt(tmp_path / "motion.csv", delimiter=",", names=True)
    assert (table["s"].max(), table["phi_deg"].size) == (20, 180)
    profile = np.genfromtxt(tmp_path / "profile" / "profile.csv", delimiter=",", names=True)
    assert profile["radius"].min() == pytest.approx(30, abs=1e-6)
    assert profile["radius"].max() == pytest.approx(50, abs=1e-6)


def test_the_stress_of_the_page_is_permitted_and_the_elements_agree(tmp_path):
    most, by_elements = followed("how-to/check-the-contact-stress.md", tmp_path).splitlines()
    assert 500 < float(most.split()[0]) < 1000
    assert float(by_elements.split()[0]) == pytest.approx(float(most.split()[0]), rel=0.005)


def test_the_bands_of_the_page_are_those_of_solved_mechanisms(tmp_path):
    *bands, most = followed("how-to/choose-the-tolerances.md", tmp_path).splitlines()
    for said in bands:
        linear, solved = (float(number) for number in re.findall(r"\d+\.\d+", said))
        # Where one wave dominates the first order is up to 1.96/sqrt(2) times too wide.
        assert linear / 1.39 < solved < 1.03 * linear
    assert most == "for s: waviness 3"
