"""The note as a page: its formulas are drawn, its units are those of its language, and it prints."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace

import pytest
from chromium import chromium
from over_all import over_all
from programs import program

import graphcam as gc
from graphcam.drafting.scale import UNITS
from graphcam.language import ENGLISH, language, languages
from graphcam.report.documents import contents_of, drawing_of, mathml, note_of, note_page
from graphcam.report.markdown import FORMULA_PATTERN
from graphcam.report.step_player import player_of
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, SIZING_TASK_NAME
from graphcam.words import say

pytestmark = pytest.mark.slow

NAMES = (*BUILTIN_TASK_NAMES, SIZING_TASK_NAME, "arcs")
OTHERS = [name for name in languages() if name != ENGLISH.name]
A4 = 210 / 25.4 * 96
"""The width of a page in pixels of CSS."""


@pytest.fixture(scope="module")
def solutions():
    tasks = {name: gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name) for name in NAMES}
    return {name: gc.solve(task) for name, task in tasks.items()}


def spoken(solution, name: str):
    """The same solution in a language."""
    return replace(solution, task=replace(solution.task, drawing=replace(solution.task.drawing, language=name)))


@over_all("name", NAMES)
def test_every_formula_is_drawn_in_every_language(solutions, name):
    for each in languages():
        note = note_of(spoken(solutions[name], each))
        formulas = FORMULA_PATTERN.findall(note)
        assert formulas
        for formula in formulas:
            drawn = mathml(formula.strip("$"))
            assert "\\" not in drawn.replace("\\tag", "")
            assert "merror" not in drawn
        page = note_page(note, each)
        assert page.count("<math") >= len(formulas)
        assert f'<html lang="{each}">' in page
        assert "$" not in re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL)
        assert page.count("<table") == len(re.findall(r"^\| :?-", note, re.MULTILINE))


def foreign_units(name: str) -> re.Pattern[str]:
    """Words of English units that a language writes otherwise."""
    told = language(name)
    english = [str(unit) for unit in UNITS.values()]
    words = {word for unit in english for word in re.findall(r"[A-Za-zµ]+", unit) if len(word) > 1 or unit == word}
    own = {word for unit in UNITS.values() for word in re.findall(r"[A-Za-zµ]+", told.text(unit))}
    # A letter alone may be a symbol.
    known = [word for word in words - own if len(word) > 1 and word not in {"of", "paper"}]
    return re.compile(rf"(?<![\w\\-])({'|'.join(sorted(known))})(?![\w-])") if known else re.compile(r"(?!)")


@over_all("name", NAMES)
@over_all("to", OTHERS)
def test_units_of_a_note_are_those_of_the_language(solutions, name, to):
    note, foreign = note_of(spoken(solutions[name], to)), foreign_units(to)
    assert [note[max(0, m.start() - 30) : m.end() + 10] for m in foreign.finditer(note)] == []


@over_all(("name", "to"), [(NAMES[k % len(NAMES)], to) for k, to in enumerate([*OTHERS, *OTHERS])])
def test_units_of_a_sheet_and_its_player_are_those_of_the_language(solutions, name, to):
    solution = spoken(solutions[name], to)
    contents = contents_of(solution)
    drawing, foreign = drawing_of(contents), foreign_units(to)
    player = player_of(contents, drawing)
    player = re.sub(r"<style.*?</style>|<script(?![^>]*json).*?</script>", "", player, flags=re.DOTALL)
    texts = {"player": player, "sheet": "\n".join(text.text for text in drawing.texts)}
    for what, text in texts.items():
        found = [text[max(0, m.start() - 30) : m.end() + 10] for m in foreign.finditer(text)]
        assert not found, (what, found[:5])


def test_russian_units_are_not_latin():
    assert foreign_units("ru").findall("10 mm, 2 мм, 0.5 rad, 30 deg, 5 MPa") == ["mm", "rad", "deg", "MPa"]


@pytest.mark.parametrize(
    ("number", "english", "russian"),
    [(200800.0, "2.008e+05", "2,008·10⁵"), (-1.5e-7, "-1.5e-07", "−1,5·10⁻⁷"), (12.5, "12.5", "12,5")],
)
def test_powers_of_ten_are_written_as_a_hand_writes_them(number, english, russian):
    said = say("{value:.4g}", value=number)
    assert (str(said), language("ru").text(said)) == (english, russian)


@pytest.mark.parametrize("to", ["en", "ru"])
def test_the_page_prints_on_a4_and_nothing_runs_over_its_edge(solutions, tmp_path, to):
    with chromium() as browser:
        for name in NAMES:
            page = browser.new_page(viewport={"width": round(A4), "height": 1100})
            path = tmp_path / f"{name}.html"
            path.write_text(note_page(note_of(spoken(solutions[name], to)), to), encoding="utf-8")
            page.goto(path.as_uri())
            page.emulate_media(media="print")
            # So wide are the lines of print: 210 mm less both margins.
            page.set_viewport_size({"width": round(A4 * 170 / 210), "height": 1100})
            wide = page.evaluate(
                "[...document.querySelectorAll('table, .formula, .formula math, p')]"
                ".filter(e => e.getBoundingClientRect().right > innerWidth + 1).map(e => e.textContent.slice(0, 80))"
            )
            assert wide == [], name
            pdf = tmp_path / f"{name}.pdf"
            page.pdf(path=str(pdf), prefer_css_page_size=True)
            page.close()
            subprocess.run([program("pdftoppm"), "-r", "30", "-png", str(pdf), str(tmp_path / name)], check=True)
            assert len(list(tmp_path.glob(f"{name}-*.png"))) >= 5
