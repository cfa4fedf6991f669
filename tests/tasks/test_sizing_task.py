"""A task with ranges of sizes: what is sought, what is written, and which faults are refused with what message."""

from __future__ import annotations

import csv
import json
import math
from dataclasses import replace

import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.files import OutputError
from graphcam.tasks.sizing_table import SizingTable
from graphcam.tasks.task_file import builtin_text

TEXT = builtin_text("sizing")
FILES = {"front.csv", "sized.toml", "sizing.dxf", "sizing.json", "sizing.pdf", "sizing.png", "sizing.svg"}


def sizing_of(text: str, tmp_path) -> gc.Sizing:
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    return gc.size_task(gc.load_task(tmp_path / "cam.toml"))


def run(*words):
    return CliRunner().invoke(app, ["size", *map(str, words)])


def test_the_design_source_s_case_is_the_least_base_radius_of_the_shaded_region():
    """Tran Minh Quang, Nguyen Quang Hung 2015: base radius 60..120, e = 20, r = 15, lift 12, 25 degrees, 1500 N/mm2.

    Trust: ranges and limits are printed, motion and force are not.  Independent of the search: the least prime radius
    that the pressure angle permits at that offset, in closed form, and Hertz's width for it.
    """
    task = gc.builtin_task("sizing")
    sizing = gc.size_task(task)
    best = sizing.best
    assert best.problem.ranges["base radius"] == (60, 120)
    assert (best.offset, best.cam.roller_radius, best.problem.motion.lift) == (20, 15, 12)
    least = gc.minimum_radius(task.motion(), gc.Translating(), "ccw", rise=math.radians(25), offset=20.0)
    assert best.radius == pytest.approx(least.prime_radius - 15, rel=1e-11)
    load = gc.SpringLoad(2, 120, 20, preload=5000)
    wide = gc.ContactStress(gc.CamForces(best.cam, load), gc.RollerContact(1.0)).min_width(1500)
    assert best.width == pytest.approx(wide, rel=1e-11)
    assert set(best.active) == {"pressure angle on the rise", "stress"}
    assert best.binding == ("pressure angle on the rise",)


def test_the_sized_task_is_drawn_and_keeps_what_was_asked(tmp_path):
    sizing = gc.size_task(gc.builtin_task("sizing"))
    written = sizing.write(tmp_path / "sized")
    assert {path.name for path in (tmp_path / "sized").iterdir()} == FILES == set(written.values())
    task = gc.load_task(tmp_path / "sized" / "sized.toml")
    assert task == sizing.sized_task
    solution = gc.solve(task)
    # A bend of less than 10 mm on paper is drawn, and told to be too sharp for a pencil.
    assert [said for said in solution.warnings if not said.startswith("On paper ρ is only")] == []
    assert (solution.cam.prime_radius, solution.cam.roller_radius) == (94, 15)
    assert solution.stress.permitted
    assert solution.stress.max_pressure.value == pytest.approx(sizing.adopted.stress, rel=1e-12)


@pytest.mark.slow
def test_the_files_say_the_same(tmp_path):
    sizing = gc.size_task(gc.builtin_task("sizing"), "stress")
    sizing.write(tmp_path)
    said = json.loads((tmp_path / "sizing.json").read_text(encoding="utf-8"))
    assert said["objective"] == "stress"
    assert said["best"]["stress"] == sizing.best.stress == min(cam.stress for cam in sizing.front)
    assert said["task"] == json.loads(json.dumps(gc.builtin_task("sizing").to_dict()))
    with (tmp_path / "front.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["stress"]) for row in rows] == [cam["stress"] for cam in said["front"]]
    assert len(rows) == 11
    # A run in the same folder takes away what the one before wrote, and what is somebody's own stays.
    (tmp_path / "mine.txt").write_text("mine")
    sizing.write(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == FILES | {"mine.txt"}


@pytest.mark.slow
def test_all_files_are_written_or_none(tmp_path, monkeypatch):
    from graphcam.report import sizing_files

    monkeypatch.setattr(sizing_files, "task_files", lambda task: (_ for _ in ()).throw(OSError(28, "disk full", "x")))
    with pytest.raises((OutputError, OSError)):
        gc.size_task(gc.builtin_task("sizing")).write(tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_round_sizes_keep_the_limits_and_are_the_next_ones(tmp_path):
    """No cam whose sizes are one rounding less keeps them all."""
    for rounding in (5.0, 1.0, 0.05):
        text = TEXT.replace('frame = "iso"', f'frame = "iso"\nrounding = {rounding}')
        sizing = sizing_of(text, tmp_path)
        adopted, problem = sizing.adopted, sizing.best.problem
        for value in (adopted.cam.prime_radius, adopted.width):
            assert value / rounding == pytest.approx(round(value / rounding), abs=1e-9)
        assert problem.keeps(adopted.sizes, slack=0.0)
        assert not problem.keeps(
            replace(adopted.sizes, radius=adopted.cam.prime_radius - rounding, width=30), slack=0.0
        )
        assert not problem.keeps(replace(adopted.sizes, width=adopted.width - rounding), slack=0.0)


def test_where_no_round_sizes_are_in_the_ranges_finer_ones_are_taken(tmp_path):
    sizing = sizing_of(TEXT.replace("[60, 120]", "[78.5, 78.9]").replace("[10, 30]", "[23.0, 23.2]"), tmp_path)
    assert (sizing.adopted.radius, sizing.adopted.width) == (78.8, 23.1)


def test_a_size_without_a_range_is_the_task_s_and_an_open_preload_the_least(tmp_path):
    text = TEXT.replace("preload = 5000 ", "# preload ").replace("offset = 20 ", "# offset ")
    text = text.replace("base_radius = [60, 120]", "prime_radius = [40, 120]\noffset = [0, 20]\nroller_radius = 12")
    text = text.replace("speed_rpm = 120", "speed_rpm = 200")
    sizing = sizing_of(text.replace("width = [10, 30]", ""), tmp_path)
    ranges = sizing.best.problem.ranges
    assert ranges == {"prime radius": (40, 120), "offset": (0, 20), "roller radius": (12, 12), "face width": (20, 20)}
    load = sizing.best.problem.load
    assert gc.Contact(sizing.best.problem.motion, load).min_force().value == pytest.approx(0, abs=1e-9)
    assert load.preload > 50


def test_friction_at_the_cam_counts(tmp_path):
    """The greatest stress is the permitted one with friction too: by the stress of the cam itself."""
    text = TEXT.replace("[spring]", "[spring]\nfriction = 0.15")
    found = sizing_of(text, tmp_path).best
    forces = gc.CamForces(found.cam, found.problem.load, friction=0.15)
    stress = gc.ContactStress(forces, gc.RollerContact(found.width)).max_pressure().value
    assert stress == pytest.approx(1500, rel=1e-10)
    assert found.width > gc.size_task(gc.builtin_task("sizing")).best.width + 0.2


def test_the_roller_s_share_of_the_prime_radius_is_kept(tmp_path):
    text = TEXT.replace('"0.8 rho"', '"min(0.8 rho, 0.15 r0)"')
    found = sizing_of(text, tmp_path).best
    assert found.cam.prime_radius == pytest.approx(15 / 0.15, rel=1e-9)
    assert "roller's share of the prime radius" in found.binding


@pytest.mark.slow
def test_a_measured_motion_is_sized_with_its_table(tmp_path):
    from graphcam.report.sizing_files import write_task

    measured, other = gc.builtin_task("measured"), gc.builtin_task("sizing")
    task = replace(measured, speed_rpm=60.0, spring=other.spring, material=other.material)
    sizing = gc.size_task(replace(task, sizing=SizingTable(prime_radius=(26, 29), roller_radius=10.0)))
    assert write_task(sizing, tmp_path) == {"task": "sized.toml", "table": "measured.csv"}
    assert gc.load_task(tmp_path / "sized.toml").motion.table.rows == measured.motion.table.rows
    assert "pressure angle on the rise" in sizing.best.binding


@pytest.mark.slow
def test_the_command_tells_the_cam_its_active_limits_and_the_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cam.toml").write_text(TEXT, encoding="utf-8")
    result = run("cam.toml", "--out", "sized")
    assert result.exit_code == 0
    for line in ("base radius                   78.759 mm   79.000 mm                  60 to 120",
                 "active: pressure angle on the rise, stress", "Radius against stress"):  # fmt: skip
        assert line in result.stdout
    last = result.stdout.splitlines()[-1]
    assert last.startswith("sized: ")
    assert set(last.removeprefix("sized: ").split(", ")) == FILES == {p.name for p in (tmp_path / "sized").iterdir()}


@pytest.mark.slow
def test_json_alone_writes_no_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("--json", "--objective", "stress")
    said = json.loads(result.stdout)
    assert said["objective"] == "stress"
    assert said["best"]["base_radius"] == pytest.approx(120)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["coursework", "arcs"])
def test_a_task_without_ranges_is_told_so(name, tmp_path):
    (tmp_path / "cam.toml").write_text(builtin_text(name), encoding="utf-8")
    result = run(tmp_path / "cam.toml")
    assert result.exit_code == 2
    said = f"graphcam: {tmp_path / 'cam.toml'}: sizing is missing, but must be a table of the task"
    assert result.stderr.splitlines()[-1].startswith(said)


@pytest.mark.parametrize(
    ("text", "field", "said"),
    [
        (TEXT.replace("[60, 120]", "[120, 60]"), "sizing.base_radius", "120 to 60 smaller larger exchange"),
        (TEXT.replace("[60, 120]", "[-60, 120]"), "sizing.base_radius[0]", "-60 greater than 0 mm"),
        (TEXT.replace("[60, 120]", "[60]"), "sizing.base_radius[1]", "missing"),
        (TEXT.replace("[60, 120]", '"60"'), "sizing.base_radius", "'60' a number"),
        (TEXT.replace("[10, 30]", "0"), "sizing.width", "0 greater than 0 mm"),
        (TEXT.replace("base_radius = [60, 120]", ""), "sizing.prime_radius", "missing either base_radius"),
        (TEXT.replace("[sizing]", "[sizing]\nprime_radius = 90"), "sizing.base_radius", "left out either"),
        (TEXT.replace('"size"', '"price"'), "sizing.objective", "'price' 'size' or 'stress'"),
        (TEXT.replace("[sizing]", "[sizing]\nroller = 8"), "sizing.roller", "unknown"),
        (TEXT.replace("offset = 20 ", "#"), "sizing.offset", "missing follower.offset"),
        (TEXT.replace("roller_radius = 15 ", "#"), "sizing.roller_radius", "missing follower.roller_radius"),
        (TEXT.replace("roller_radius = 15 ", "roller_radius = 0 "), "follower.roller_radius", "knife edge"),
        (TEXT.replace("permitted_stress = 1500", "#"), "material.permitted_stress", "missing [sizing]"),
        (TEXT.replace("pressure_angle_rise = 25", "rest = false"), "limits.rest", "false true lower dwell"),
        (
            TEXT.replace('kind = "translating"\noffset = 20             #', 'kind = "flat-faced" #')
            .replace("roller_radius = 15 ", "#").replace("roller_rule", "#").replace("pressure_angle_rise = 25", ""),
            "sizing", "flat-faced translating",
        ),
    ],
)  # fmt: skip
def test_faults_of_the_table_are_told_with_their_field(text, field, said, tmp_path):
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    with pytest.raises(gc.TaskError) as error:
        gc.load_task(tmp_path / "cam.toml")
    assert error.value.field == field
    for word in said.split(" "):
        assert word in str(error.value), (word, str(error.value))


def test_what_cannot_be_met_is_one_message_with_how_near_it_comes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cam.toml").write_text(TEXT.replace("= 1500", "= 700"), encoding="utf-8")
    result = run("cam.toml")
    assert result.exit_code == 2
    assert result.stdout == ""
    # The least stress: of the largest base radius and the widest face.
    assert result.stderr.splitlines()[-1] == (
        "graphcam: cam.toml: stress is 837.86 MPa, but must be at most 700 MPa; no cam in the ranges keeps it, even "
        "without the other limits: the nearest has base radius 120, offset 20, roller radius 15, face width 30 mm; "
        "widen the ranges or permit more"
    )
    assert [path.name for path in tmp_path.iterdir()] == ["cam.toml"]


def test_the_chart_speaks_russian(tmp_path):
    from russian import english_words

    from graphcam.report.sizing_files import chart
    from graphcam.sheets.model import Text

    task = gc.builtin_task("sizing")
    task = replace(task, title=replace(task.title, name="Кулачок"))
    drawing = chart(gc.size_task(task, "stress"), "ru")
    texts = [e.text for page in drawing.pages for g in page.groups for e in g.entities if isinstance(e, Text)]
    assert {"лучший", "Кулачок с наименьшим контактным напряжением"} <= set(texts)
    for text in texts:
        assert english_words(text) == set(), text
