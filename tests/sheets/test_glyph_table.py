"""The table of glyphs against the fonts, and against what is drawn."""

from __future__ import annotations

import json
import unicodedata
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib import get_data_path
from measured_glyphs import measured_glyphs
from over_all import over_all

import graphcam as gc
from graphcam.report.documents import sheet_of
from graphcam.sheets.model import Text
from graphcam.sheets.typefaces import ALPHABET, GLYPHS_FILE, glyph_table, lettering_file, shipped
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES

pytestmark = pytest.mark.slow

TASKS = {name: gc.builtin_task(name) for name in BUILTIN_TASK_NAMES} | {"arcs": gc.builtin_arcs_task()}


def test_the_table_is_what_the_fonts_say():
    said = json.loads(lettering_file().with_name(GLYPHS_FILE).read_text(encoding="utf-8"))
    assert said == json.loads(json.dumps(measured_glyphs()))


def test_the_second_face_is_that_of_matplotlib():
    assert shipped()[1] == Path(get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")


def test_every_letter_of_an_alphabet_is_in_the_table():
    assigned = [letter for letter in ALPHABET if unicodedata.category(letter) != "Cn"]
    assert [letter for letter in assigned if glyph_table().face(letter) is None] == []


@over_all(("name", "language"), zip(TASKS, ["ru", "en"] * 3, strict=False))
def test_every_letter_that_is_drawn_is_in_the_table(name, language):
    task = TASKS[name]
    sheet = sheet_of(gc.solve(replace(task, drawing=replace(task.drawing, language=language))))
    drawn = {
        letter for p in sheet.pages for g in p.groups for e in g.entities if isinstance(e, Text) for letter in e.text
    }
    assert len(drawn) > 50
    assert {letter for letter in drawn if glyph_table().face(letter) is None} == set()
