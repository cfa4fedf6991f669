"""The papers of a course: complete, readable by foreign programs, and nothing of the key in what students get."""

from __future__ import annotations

import csv
import json
import os
import re
import tomllib
from dataclasses import replace

import ezdxf
import nbformat
import numpy as np
import pytest
from issued_variants import SECRET, issued
from over_all import fast_first
from russian import english_words
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.drafting.marks import Segments
from graphcam.errors import TaskError
from graphcam.exercises.course import course_making as make_module
from graphcam.exercises.course.course_making import make, other_scale
from graphcam.exercises.course.handouts import (
    answer_file,
    answer_file_head,
    instructions,
    key_sheet,
    notebook,
    worksheet,
)
from graphcam.exercises.course.roster import Student, folder_name, read_roster
from graphcam.exercises.definition.blank_axes import empty_axes
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.variant import drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reading.notebook import ANSWER_TAG
from graphcam.exercises.reading.submission_files import read_files
from graphcam.files import OutputError
from graphcam.sheets.model import Text
from graphcam.tasks.task_writer import task_files


@pytest.mark.parametrize("name", fast_first(library(), 3))
def test_the_papers_of_text_hold_the_variant_and_no_answer(name, tmp_path):
    variant = drawn(find_exercise(name), "Anna", SECRET, 0)
    read = notebook(variant)
    nbformat.validate(read)
    told = [*(asked.name for asked in variant.exercise.answers), "bar"]
    cell = next(cell for cell in read.cells if ANSWER_TAG in cell.metadata.get("tags", ()))
    assert cell.source.splitlines() == [f"{name} = None" for name in told]
    assert tomllib.loads(answer_file(variant.exercise)) == {}
    filled = answer_file(variant.exercise).replace("\n# ", "\n").splitlines()
    assert {f"{name} =" in " ".join(filled) for name in told} == {True}
    path = tmp_path / "task.toml"
    path.write_text(task_files(variant.task)["task.toml"], encoding="utf-8")
    assert gc.load_task(path) == variant.task
    said = instructions(variant)
    assert "{" not in said
    assert f"{variant.parameters['lift']}" in said


SPOKEN = {"DXF", "POINT", "ORIGIN", "PITCH", "ROLLERS", "worksheet", "answers", "dxf", "min", "bar"}
"""What is called so in every language."""


def english(text: str, exercise: Exercise) -> set[str]:
    return english_words(text, [asked.name for asked in exercise.answers]) - SPOKEN


@pytest.mark.parametrize("name", fast_first(library(), 3))
def test_the_papers_of_a_russian_course_are_russian(name):
    variant = drawn(find_exercise(name, "ru"), "Anna", SECRET, 0)
    cells = notebook(variant).cells
    told = [cell["source"] for cell in cells if cell["cell_type"] == "markdown"]
    for text in (answer_file(variant.exercise), *told, instructions(variant)):
        assert english(text, variant.exercise) == set()
    assert variant.task.drawing.language == "ru"


def test_the_sheets_of_a_russian_course_are_russian():
    exercise, answer_key = find_exercise("inversion-arm", "ru"), issued("inversion-arm")[1]
    variant = drawn(exercise, "Anna", SECRET, answer_key.draw)
    student = Student("анна", "Анна")
    for sheet in (worksheet(variant, student), key_sheet(variant, student, answer_key)):
        texts = [e.text for page in sheet.pages for g in page.groups for e in g.entities if isinstance(e, Text)]
        assert set().union(*(english(text, exercise) for text in texts)) == set()
        assert [text for text in texts if re.search(r"\d\.\d", text)] == []


def test_a_certificate_that_is_none_is_refused():
    with pytest.raises(TaskError, match="make it again"):
        AnswerKey.from_json("{}")
    text = issued("integration")[1].to_json().replace('"format": 4', '"format": 3')
    with pytest.raises(TaskError, match="format 3"):
        AnswerKey.from_json(text)


@pytest.mark.parametrize(
    ("text", "students"),
    [
        ("id,name\ns1,Anna\ns2,Ben\n", [Student("s1", "Anna"), Student("s2", "Ben")]),
        ("name;id\nAnna;s1\n", [Student("s1", "Anna")]),
        ("s1\ns2\n", [Student("s1"), Student("s2")]),
        ('id\n"a,b"\n=1+1\n../x\n', [Student("a,b"), Student("=1+1"), Student("../x")]),
    ],
)
def test_a_roster_is_read(tmp_path, text, students):
    path = tmp_path / "roster.csv"
    path.write_text(text, encoding="utf-8")
    assert read_roster(path) == students


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty"),
        ("id\n", "empty"),
        ("id\na\na\n", "once"),
        ("id\na\nA\n", "once"),
        ('id,name\na,"x\ny"\n', "on one line"),
        ("id\na\x07\n", "on one line"),
        ("id,name\n,Anna\n", "fill in the id of Anna"),
    ],
)
def test_a_wrong_roster_gets_one_message(tmp_path, text, message):
    path = tmp_path / "roster.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(TaskError, match=message):
        read_roster(path)
    with pytest.raises(TaskError, match="roster"):
        read_roster(tmp_path / "nowhere.csv")


def test_the_library_is_listed():
    result = CliRunner().invoke(app, ["exercise", "list"])
    assert result.exit_code == 0
    # Whole, also in a window of 80 columns: they are to be typed.
    assert set(library()) <= set(result.output.split())


def test_wrong_input_of_make_leaves_nothing(tmp_path):
    roster, secret, out = tmp_path / "r.csv", tmp_path / "secret", tmp_path / "out"
    roster.write_text("id\ns1\n", encoding="utf-8")
    secret.write_text("\n", encoding="utf-8")
    arguments = ["--roster", str(roster), "--secret-file", str(secret), "--out", str(out)]
    for name in ("integration", "integratio"):
        result = CliRunner().invoke(app, ["exercise", "make", name, *arguments])
        assert result.exit_code == 2
        assert not out.exists()


@pytest.fixture
def made(tmp_path):
    """A course of one student, made without a secret, and what the command said."""
    (tmp_path / "r.csv").write_text("id\ns1\n", encoding="utf-8")
    out = tmp_path / "week"
    result = CliRunner().invoke(
        app, ["exercise", "make", "integration", "--roster", str(tmp_path / "r.csv"), "--out", str(out)]
    )
    assert result.exit_code == 0, result.output
    return out, result.stdout


@pytest.mark.slow
def test_the_first_course_makes_its_secret_says_so_and_is_graded_with_it(made, tmp_path):
    out, said = made
    secret = out / "teacher" / "secret"
    (line,) = [line for line in said.splitlines() if str(secret) in line]
    assert "Keep the folder 'teacher'" in line
    assert re.fullmatch(rb"[0-9a-f]{64}\n", secret.read_bytes())
    if os.name == "posix":
        assert secret.stat().st_mode & 0o777 == 0o600
    # Nothing of it is handed out.
    handed_out = b"".join(path.read_bytes() for path in (out / "students").rglob("*") if path.is_file())
    assert secret.read_bytes().strip() not in handed_out
    grading = ["exercise", "grade", str(out), "--workers", "1", "--out", str(tmp_path / "grades.csv")]
    assert CliRunner().invoke(app, grading).exit_code == 0
    # The same secret, kept elsewhere, does as well; without it the message names the file and the remedy.
    kept = secret.rename(tmp_path / "kept")
    missing = CliRunner().invoke(app, grading)
    assert missing.exit_code == 2
    assert f"{secret}: the course's secret is missing" in missing.stderr
    assert "--secret-file" in missing.stderr
    assert CliRunner().invoke(app, [*grading, "--secret-file", str(kept)]).exit_code == 0


@pytest.mark.slow
def test_the_same_secret_makes_the_same_variants_again(made, tmp_path):
    out, _ = made
    (tmp_path / "longer.csv").write_text("id\ns1\ns2\n", encoding="utf-8")
    arguments = ["--roster", str(tmp_path / "longer.csv"), "--out", str(tmp_path / "again")]
    arguments += ["--secret-file", str(out / "teacher" / "secret")]
    result = CliRunner().invoke(app, ["exercise", "make", "integration", *arguments])
    assert result.exit_code == 0, result.output
    assert "is new" not in result.stdout
    copy = tmp_path / "again" / "teacher" / "secret"
    assert copy.read_bytes() == (out / "teacher" / "secret").read_bytes()
    assert copy.stat().st_mode & 0o777 == 0o600
    assert f"{copy} is a copy of" in result.stdout
    first, again = (folder / "teacher" / "certificates" / "s1.json" for folder in (out, tmp_path / "again"))
    assert first.read_bytes() == again.read_bytes()


def test_a_secret_that_is_named_must_be_there(tmp_path):
    (tmp_path / "r.csv").write_text("id\ns1\n", encoding="utf-8")
    arguments = [
        "--roster",
        str(tmp_path / "r.csv"),
        "--secret-file",
        str(tmp_path / "old"),
        "--out",
        str(tmp_path / "o"),
    ]
    result = CliRunner().invoke(app, ["exercise", "make", "integration", *arguments])
    assert result.exit_code == 2
    assert f"{tmp_path / 'old'}: the course's secret is missing" in result.stderr
    assert "leave out --secret-file" in result.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"r.csv"}


def test_a_course_that_fails_leaves_no_secret(tmp_path, monkeypatch):
    (tmp_path / "r.csv").write_text("id\ns1\n", encoding="utf-8")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(make_module, "_write_keys", full)
    with pytest.raises(OutputError):
        make_module.make("integration", tmp_path / "r.csv", None, tmp_path / "o")
    assert not (tmp_path / "o").exists()


@pytest.mark.slow
def test_a_course_is_made_whole(tmp_path):
    roster, secret, out = tmp_path / "r.csv", tmp_path / "secret", tmp_path / "out"
    # The typeface of the sheets has no letter of the first one's name.
    students = ["漢字 💣", "../=cmd"]
    roster.write_text("id\n" + "\n".join(students) + "\n", encoding="utf-8")
    secret.write_bytes(SECRET + b"\n")
    arguments = ["--roster", str(roster), "--secret-file", str(secret), "--out", str(out)]
    result = CliRunner().invoke(app, ["exercise", "make", "integration", *arguments])
    assert result.exit_code == 0, result.output
    for student in students:
        folder = out / "students" / folder_name(student)
        assert {path.name for path in folder.iterdir()} == {
            "answers.toml", "answers.ipynb", "task.toml", "worksheet.pdf", "worksheet.dxf"
        }  # fmt: skip
        # What is to be filled in is what is read.
        assert {"answers.toml", "answers.ipynb"} <= read_files(folder)[0].keys()
        answer_key = AnswerKey.from_json(
            (out / "teacher" / "certificates" / f"{folder_name(student)}.json").read_text(encoding="utf-8")
        )
        assert answer_key.student == student
        assert answer_key.alike == ()
        text = "".join(
            path.read_text(encoding="utf-8") for path in folder.iterdir() if path.suffix in (".toml", ".ipynb")
        )
        drawing = ezdxf.readfile(folder / "worksheet.dxf")
        text += " ".join(entity.dxf.text for entity in drawing.modelspace().query("TEXT"))
        for name in ("v_max", "mu_v", "s_max"):
            assert f"{answer_key.keys[name].expected.value:.3f}"[:-1] not in text
        assert (out / "teacher" / "keys" / f"{folder_name(student)}.pdf").stat().st_size > 10_000
    with (out / "teacher" / "keys.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {row["student"] for row in rows} == set(students)
    # A scale is no length on paper.
    assert {row["tolerance_paper_mm"] == "" for row in rows if row["answer"] == "mu_v"} == {True}
    assert all(float(row["tolerance_paper_mm"]) > 0 for row in rows if row["answer"] == "v_2")
    assert json.loads((out / "teacher" / "course.json").read_text())["exercise"] == "integration"
    again = CliRunner().invoke(app, ["exercise", "make", "integration", *arguments])
    assert again.exit_code == 2
    said = f"{out} already holds a course; choose another folder; to keep the variants: --secret-file "
    assert f"{said}{out}/teacher/secret; do not delete {out}/teacher" in again.output


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of the cluster's own closing
def test_processes_and_a_cluster_make_the_same_files(tmp_path):
    from distributed import LocalCluster

    (tmp_path / "secret").write_bytes(SECRET)
    (tmp_path / "roster.csv").write_text("id\nAnna\n../x\nАнна\n", encoding="utf-8")

    def made(name: str, workers: int = 1, cluster: str = "") -> dict[str, bytes]:
        out = tmp_path / name
        people, secret = tmp_path / "roster.csv", tmp_path / "secret"
        assert make("integration", people, secret, out, workers=workers, cluster=cluster) == 3
        return {str(path.relative_to(out)): path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}

    one = made("one")
    assert len([name for name in one if name.endswith("worksheet.pdf")]) == 3
    assert made("two", workers=2) == one
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        assert made("cluster", cluster=cluster.scheduler_address) == one


@pytest.mark.parametrize(
    "name", fast_first((name for name in library() if name not in ("differentiation", "given-cam-positions")), 2)
)
def test_the_diagrams_of_a_variant_find_room_on_its_axes(name):
    """A curve that a hand draws over the empty axes ends neither above nor below them."""
    exercise, answer_key = issued(name)
    chain = board_chain(drawn(exercise, "Anna", SECRET, answer_key.draw).task)
    greatest = chain.acceleration.readings["greatest"].paper.max()
    curves = {
        "acceleration": np.array([greatest, -greatest]),
        "velocity": chain.integration.points["v_curve"].imag,
        "displacement": chain.integration.points["s_curve"].imag,
    }
    if name == "given-cam":
        derived = chain.differentiation.points
        curves = {diagram: derived[diagram[0].replace("d", "s")].imag for diagram in exercise.axes}
    assert exercise.axes
    for diagram in exercise.axes:
        found = [mark for mark in empty_axes(exercise, chain, diagram).marks if isinstance(mark, Segments)]
        lines = max(found, key=lambda mark: np.ptp([*mark.starts.imag, *mark.ends.imag]))
        assert lines.starts.imag.min() <= curves[diagram].min() + 0.01  # a dwell of a given cam is drawn through points
        assert curves[diagram].max() <= lines.ends.imag.max()


@pytest.mark.parametrize(
    ("name", "views"),
    [
        ("integration", ["acceleration", "velocity", "displacement"]),
        ("differentiation", ["measured displacement", "measured velocity", "measured acceleration"]),
        ("inversion-arm", ["acceleration", "velocity", "displacement", "profile"]),
        ("given-cam", ["measured displacement", "measured velocity", "measured acceleration", "analysis"]),
    ],
)
def test_a_worksheet_is_true_to_scale_and_its_diagrams_stand_in_order(name, views):
    exercise, answer_key = issued(name)
    (page,) = worksheet(drawn(exercise, "Anna", SECRET, answer_key.draw), Student("Anna")).pages
    # Only views in true scale have their origins said.
    assert set(page.origins) == set(views)
    origins = [page.origins[view] for view in views[:3]]
    assert len({origin.real for origin in origins}) == 1
    assert [origin.imag for origin in origins] == sorted((origin.imag for origin in origins), reverse=True)
    # A pole of 50 mm stands to the left of the zero, inside the frame.
    assert page.frame.left < origins[0].real - 50
    # Diagrams alone have no scale that the title block could name.
    (frame,) = [group for group in page.groups if group.name == "frame"]
    scales = [e.text for e in frame.entities if isinstance(e, Text) and re.fullmatch(r"[\d.]+:[\d.]+", e.text)]
    assert len(scales) == ("profile" in views)


def test_the_file_for_the_answers_says_whose_it_is_and_what_the_task_was():
    variant = drawn(find_exercise("integration"), "s-1", SECRET, 0)
    head = answer_file_head(variant, Student("s-1", "Anna\nIvanova"))
    assert head[0] == "# s-1 Anna Ivanova"
    assert " ".join(line.removeprefix("## ") for line in head[1:]).strip() == instructions(variant)
    assert tomllib.loads(answer_file(variant.exercise, head)) == {}


def test_a_scale_in_the_text_that_is_not_that_of_the_sheet_is_told():
    variant = drawn(find_exercise("integration"), "s-1", SECRET, 0)
    assert other_scale(variant) is None
    stated = replace(variant.exercise, text="Lay off the cam angle at 2° to 1 mm.")
    said, scale = other_scale(replace(variant, exercise=stated)) or ("", 0.0)
    assert (said, scale) == ("2° to 1 mm", pytest.approx(1.0))


def test_a_copy_of_an_exercise_is_its_file_and_replaces_nothing(tmp_path):
    path = tmp_path / "mine.toml"
    command = ["exercise", "copy", "integration", str(path)]
    assert CliRunner().invoke(app, command).exit_code == 0
    assert replace(find_exercise(str(path)), name="integration") == find_exercise("integration")
    assert CliRunner().invoke(app, command).exit_code == 2
    assert CliRunner().invoke(app, [*command[:-1], str(tmp_path / "mine.txt")]).exit_code == 2


@pytest.mark.parametrize("name", library())
def test_every_worksheet_asks_how_large_it_was_printed(name: str):
    """Where it is not told, right work on a print at 99 % keeps its marks, at 98 % it need not."""
    exercise = find_exercise(name)
    sheet = worksheet(drawn(exercise, "Anna", SECRET, 0), Student("Anna", "Anna"))
    for page in sheet.pages:
        texts = [e.text for group in page.groups for e in group.entities if isinstance(e, Text)]
        assert "100" in texts
        assert any("true to scale" in text for text in texts)
    told = " ".join(e.text for p in sheet.pages for g in p.groups for e in g.entities if isinstance(e, Text))
    told = " ".join(told.split())
    assert "write its length in mm as bar in your answers. If it is shorter than 90 mm, or than 99 mm and your" in told
