"""A task with tolerances: what is told and drawn of them, and which faults of the table are refused."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from russian import english_words

import graphcam as gc
from graphcam.report.documents import note_of, sheet_of
from graphcam.sheets.model import Stroke, Text
from graphcam.tasks.sheet_tables import plain_data
from graphcam.tasks.task import CamTable
from graphcam.tasks.task_file import builtin_text, task_from
from graphcam.tasks.task_writer import task_files
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.working_drawing import working_drawing_of

WAVES = "waviness = [0.01, 0.002]\nharmonics = [3, 24]\n"
GIVEN = {
    "coursework": WAVES + "roller_diameter = 0.03\noffset = 0.05\n",
    "arm": WAVES + "distance = 0.05\narm = 0.03\n",
    "flat": WAVES,
}


def loaded(path: Path, name: str, table: str) -> gc.Task:
    file = path / "cam.toml"
    file.write_text(f"{builtin_text(name)}\n[tolerances]\n{table}", encoding="utf-8")
    task = gc.load_task(file)
    assert isinstance(task, gc.Task)
    return task


def texts_of(pages) -> list[str]:
    return [e.text for page in pages for group in page.groups for e in group.entities if isinstance(e, Text)]


@pytest.mark.parametrize("name", GIVEN)
def test_the_bands_that_are_told_are_those_of_the_exact_cam(tmp_path, name):
    solution = gc.solve(loaded(tmp_path, name, GIVEN[name]))
    errors = solution.task.tolerances()
    bands, told = gc.motion_bands(solution.cam, errors), solution.to_dict()["tolerances"]
    sample = solution.tolerances.bands.sample
    json.dumps(told, allow_nan=False)
    assert told["coverage"] == 0.95
    for k, symbol in enumerate("sva"):
        band = told["bands"][symbol]
        assert band["half_width"] == bands.half_width[k].tolist()
        assert band["sampled"]["low"] == sample.low[k].tolist()
        assert band["widest"]["value"] == bands.widest[k].value
        assert math.radians(band["widest"]["phi_deg"]) == pytest.approx(bands.widest[k].phi)
    assert set(told["errors"]) == set(errors.reaches)
    assert sum(error["share"]["a"] for error in told["errors"].values()) == pytest.approx(1.0)


def test_the_table_tells_which_tolerance_matters_most(tmp_path):
    """On the sheet, in the note and on the working drawing stand the same numbers."""
    solution = gc.solve(loaded(tmp_path, "coursework", GIVEN["coursework"]))
    first, *_ = solution.tolerances.bands.table()
    effect = f"{1e3 * first.effects[0]:.1f}"
    on_sheet = texts_of(sheet_of(solution).pages)
    on_drawing = texts_of(working_drawing_of(PartContents(solution)).pages)
    row = ["waviness, n = 3", "0.01", effect, f"{100 * first.shares[0]:.0f}"]
    for texts in (on_sheet, on_drawing):
        assert "Tolerances and what they do" in texts
        assert set(row) <= set(texts)
    note = note_of(solution)
    assert re.search(rf"\| waviness, n = 3 +\| +0\.01 \| +{effect} \|", note)
    assert "Most of the variance of $a$, 99 %, is due to one tolerance: waviness, n = 24." in note
    assert "2000 mechanisms with random errors were solved exactly" in note


def test_the_curve_on_the_sheet_is_the_band_over_the_turn(tmp_path):
    """Read off the sheet, heights times the scale of the title are the half-widths in micrometres."""
    solution = gc.solve(loaded(tmp_path, "coursework", GIVEN["coursework"]))
    pages = sheet_of(solution).pages
    (view,) = [group for page in pages for group in page.groups if group.name.endswith("tolerances 11.1")]
    curve = max((e for e in view.entities if isinstance(e, Stroke)), key=lambda stroke: stroke.points.size)
    (title,) = [text for text in texts_of(pages) if re.fullmatch(r"μ\S* = [\d.]+ µm/mm", text)]
    x, y = curve.points.real, curve.points.imag
    bands = solution.tolerances.bands
    heights = float(title.split()[2]) * (np.interp(bands.phi, (x - x[0]) / 120 * 2 * math.pi, y) - y[0])
    start = gc.motion_bands(solution.cam, bands.errors, [0.0]).half_width[0, 0]
    assert heights == pytest.approx(1e3 * (bands.half_width[0] - start), abs=0.02)


def test_a_profile_that_is_undercut_says_so(tmp_path):
    task = loaded(tmp_path, "coursework", WAVES)
    given = {"cam": CamTable(44.0), "follower": replace(task.follower, roller_radius=35.0)}
    undercut = replace(task, **given)
    solution = gc.solve(undercut)
    assert solution.tolerances.undercut
    assert solution.to_dict()["tolerances"] == {"bands": None, "errors": None}
    assert "The profile is undercut: how errors of making move the follower is not told." in note_of(solution)
    assert "the profile is undercut" in texts_of(sheet_of(solution).pages)


def test_nothing_is_in_russian_by_halves(tmp_path):
    task = loaded(tmp_path, "arm", GIVEN["arm"] + 'distribution = "uniform"\n')
    drawing = replace(task.drawing, language="ru")
    solution = gc.solve(replace(task, drawing=drawing, title=replace(task.title, name="Кулачок")))
    note = note_of(solution)
    said = note[note.index("Погрешности изготовления") :]
    assert "волнистость, n = 24" in said
    assert english_words(said.split("\n## ")[0], ("cos", "sin", "tan")) == set()


def test_a_task_goes_through_its_file(tmp_path):
    task = loaded(tmp_path, "arm", GIVEN["arm"])
    assert task_from(task.to_dict()) == task
    (tmp_path / "again.toml").write_text(task_files(task)["task.toml"], encoding="utf-8")
    assert gc.load_task(tmp_path / "again.toml") == task
    assert plain_data(task.tolerances)["harmonics"] == [3, 24]


@pytest.mark.parametrize(
    ("name", "table", "message"),
    [
        ("coursework", "waviness = [0.01]\nharmonics = [3, 4]", "harmonics is a list of 2, but must be a list of 1"),
        ("coursework", "waviness = [-1.0]\nharmonics = [3]", r"waviness\[0\] is -1.0, but must be a finite"),
        ("coursework", "waviness = [0.01]\nharmonics = [0]", r"tolerances.harmonics\[0\] is 0, but must be from 1 to"),
        ("coursework", "waviness = [0.01]\nharmonics = [2.5]", r"harmonics\[0\] is 2.5, but must be a whole number"),
        ("coursework", "waviness = [1.5]\nharmonics = [60]", r"tolerances.waviness\[0\] is 1.5, but must be less than"),
        ("coursework", "offset = -0.1", "tolerances.offset is -0.1, but must be a finite number greater than 0 mm"),
        ("coursework", "distance = 0.1", "tolerances.distance is 0.1, but must be left out for a follower of kind"),
        ("flat", "roller_diameter = 0.1", "tolerances.roller_diameter is 0.1, but must be left out"),
        ("arm", "offset = 0.1", "it has roller_diameter, distance, arm"),
        ("coursework", "offset = 0.1\ncoverage = 1.2", "tolerances.coverage is 1.2, but must be between 0 and 1"),
        ("coursework", "offset = 0.1\ndistribution = 'gauss'", "tolerances.distribution is 'gauss', but must be"),
        ("coursework", "", "tolerances.waviness is .*left out.*, but must be given where no size has a tolerance"),
        ("coursework", "wavines = [0.1]", "did you mean 'waviness'"),
    ],
)
def test_a_wrong_table_is_told_by_its_field(tmp_path, name, table, message):
    with pytest.raises(gc.GraphcamError, match=message):
        gc.solve(loaded(tmp_path, name, table))


def test_a_knife_edge_takes_no_tolerance_of_its_roller(tmp_path):
    task = loaded(tmp_path, "coursework", WAVES)
    knife = replace(task.follower, roller_radius=0.0)
    with pytest.raises(gc.DesignError, match=r"tolerances\.roller_diameter is 0\.1"):
        replace(task, follower=knife, tolerances=replace(task.tolerances, roller_diameter=0.1))
