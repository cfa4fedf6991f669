"""Languages: catalogs against the texts of the code, numbers, plurals, and papers without an English word."""

from __future__ import annotations

import ast
import re
import string
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
from over_all import over_all
from russian import english_words
from translations import CATALOGS, MOST_MISSING, PACKAGE, catalog, has_words, singular, texts_of_the_code
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.command_language import language_of_machine
from graphcam.errors import DesignError
from graphcam.language import ENGLISH, language, languages
from graphcam.report.documents import contents_of, drawing_of, note_of, sheet_of
from graphcam.report.note import comparison_file
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Text
from graphcam.studio.studio_page import page
from graphcam.studio.tours import texts_of, tours
from graphcam.tasks.task import SpringTable
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES
from graphcam.words import say, say_in, say_many, sequence

UNREAD = ("vi", "zh")
"""Which languages no native speaker has read yet."""
SIGNS = {
    "ru": ("φ_у", "φ_д.с", "φ_в", "φ_б.с"),
    "vi": ("φ_đ", "φ_x", "φ_v", "φ_g"),
    "zh": ("Φ", "Φₛ", "Φ′", "Φₛ′"),
}
"""What the angles of rise, upper dwell, return and lower dwell are called in the textbooks of a language."""
SHARED = "cos", "sin", "arctan", "rad", "min", "drawing.divisions", "cam.prime_radius"
"""Functions, units and keys of task files, which are the same in every language."""
KEYS = "Page", "Down", "Shift", "JavaScript"
"""What stands on keyboards, and a name."""


def places(template: str) -> set[tuple[str, str]]:
    """The values of a template with their formats; of a value only its name, not which part of it is shown."""
    return {
        (re.split(r"[.\[]", name)[0], spec or "") for _, name, spec, _ in string.Formatter().parse(template) if name
    }


@pytest.mark.parametrize("name", CATALOGS)
def test_translations_show_the_values_of_their_texts(name):
    for message in catalog(name):
        if not message.id:
            continue
        for told in [message.string] if isinstance(message.string, str) else message.string:
            # One that is not translated yet is told in English.
            assert not told or places(told) == places(singular(message.id)), message.id


def imported(module: ast.Module) -> set[str]:
    """What a module takes from those that know captions."""
    froms = [node for node in ast.walk(module) if isinstance(node, ast.ImportFrom)]
    captions = [node for node in froms if node.module in {"graphcam.words", "graphcam.drafting.ink"}]
    return {name.name for node in captions for name in node.names}


@pytest.mark.slow
def test_every_caption_is_written_where_the_tools_of_gettext_find_it():
    found = {singular(message.id) for message in texts_of_the_code()}
    # The texts of the tours stand in a file of data, which is looked through too.
    assert {text for tour in tours() for text in texts_of(tour)} <= found
    for path in PACKAGE.rglob("*.py"):
        if path.name in {"words.py", "ink.py", "tours.py", "help_texts.py"}:
            continue
        module = ast.parse(path.read_text(encoding="utf-8"))
        names = imported(module) & {"say", "say_in", "say_many", "Caption"}
        for call in ast.walk(module):
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in names and call.args:
                assert isinstance(call.args[0], ast.Constant), f"{path}:{call.lineno}"
                template = call.args[1 if call.func.id == "say_in" else 0].value
                # They do not look into an f-string.
                assert template in found or not has_words(template), f"{path}:{call.lineno}"


def test_a_text_that_is_not_in_the_catalog_stays_english_words():
    assert language("ru").text(say("Nobody has translated {x:.1f}.", x=0.5)) == "Nobody has translated 0,5."


def test_a_language_that_is_not_there_is_refused_by_name():
    with pytest.raises(DesignError, match=f"'xx'.*{', '.join(languages())}"):
        language("xx")


def test_captions_are_told_within_captions():
    inner = say("{length:g} mm", length=2.5)
    assert language("ru").text(say("{first} and {last}", first=inner, last="C₁")) == "2,5 мм и C₁"
    assert language("ru").text(sequence(["a", inner], "; ")) == "a; 2,5 мм"


def test_words_of_a_user_are_not_touched():
    assert language("ru").text("mm, 1.5") == "mm, 1.5"
    assert language("ru").text(say("{a}", a="mm, 1.5")) == "mm, 1.5"


@pytest.mark.parametrize(("count", "end"), [(1, "ии"), (2, "иях"), (5, "иях"), (21, "ии")])
def test_russian_chooses_the_plural(count, end):
    said = say_many(
        "The displacement is plotted at {count} station.", "The displacement is plotted at {count} stations.", count
    )
    assert language("ru").text(said).endswith(f"{count} положен{end}.")


def test_a_third_language_is_one_file_more(tmp_path, monkeypatch):
    (tmp_path / "de.po").write_text(
        'msgid ""\nmsgstr "Content-Type: text/plain; charset=utf-8\\n"\n\n'
        'msgctxt "decimal sign"\nmsgid "."\nmsgstr ","\n\n'
        'msgid "Pressure angle"\nmsgstr "Übertragungswinkel"\n\nmsgctxt "here"\nmsgid "rise"\nmsgstr "Anstieg"\n',
        encoding="utf-8",
    )
    monkeypatch.setattr("graphcam.language._folder", lambda: tmp_path)
    language.cache_clear()
    try:
        assert languages() == ("en", "de")
        german = language("de")
        assert german.text(say("Pressure angle")) == "Übertragungswinkel"
        assert german.text(say_in("here", "rise")) == "Anstieg"
        assert german.text(say("rise {x:.1f}", x=1.5)) == "rise 1,5"
    finally:
        language.cache_clear()


TASKS = {name: gc.builtin_task(name) for name in BUILTIN_TASK_NAMES} | {"arcs": gc.builtin_arcs_task()}
TASKS["spring"] = replace(gc.builtin_task(), speed_rpm=300.0, spring=SpringTable(mass=0.5, stiffness=3.0))
HANDS = {"perfect": gc.Pencil(), "hand": gc.Pencil(line=0.2, dividers=0.2, protractor=0.005, division=0.5)}


def in_language(spoken: str, name: str, hand: str = "perfect"):
    task = TASKS[name]
    named = replace(task.title, name="№ 1")  # the name is the user's
    return gc.solve(replace(task, title=named, drawing=replace(task.drawing, language=spoken)), HANDS[hand])


@cache
def own_words(spoken: str) -> frozenset[str]:
    """What a language that is written in Latin letters has of words without an accent."""
    if spoken != "vi":
        return frozenset()
    return frozenset(word for m in catalog(spoken) if m.id for word in re.findall("[A-Za-z]{3,}", singular(m.string)))


def letters_on(solution) -> list[str]:
    pages = sheet_of(solution).pages
    return [e.text for page in pages for group in page.groups for e in group.entities if isinstance(e, Text)]


SHOWN = dict.fromkeys(CATALOGS, tuple(TASKS)) | dict.fromkeys(UNREAD, ("coursework", "spring", "arcs"))
"""The tasks of which all is looked at, by language: every one in a language that is read."""
NOTES = [(spoken, name, "perfect") for spoken in CATALOGS for name in SHOWN[spoken]]
# What errors of the hand add is the same for every task.
NOTES += [(spoken, name, "hand") for spoken in CATALOGS for name in ("spring", "arcs")]


@pytest.mark.slow
@over_all(("spoken", "name", "hand"), NOTES)
def test_a_note_has_no_english_word_and_no_foreign_decimal_sign(spoken, name, hand):
    solution = in_language(spoken, name, hand)
    # A step's number has a point in every language.
    note = re.sub(r"^\*\*\d+\.\d+\. ", "", note_of(solution), flags=re.MULTILINE)
    for text in (note, comparison_file(solution), *solution.warnings):
        assert english_words(text, ("measured", *SHARED), spoken) - own_words(spoken) == set()
        assert re.findall(r"\d,\d" if language(spoken).decimal == "." else r"\d\.\d", text) == []


class Looked(dict[tuple[str, str], tuple[str, ...]]):
    """The translations of a catalog, and what was looked up in it."""

    def __init__(self, told: Mapping[tuple[str, str], tuple[str, ...]]) -> None:
        super().__init__(told)
        self.asked: set[tuple[str, str]] = set()

    def get(self, text: tuple[str, str], default: Any = None) -> Any:
        self.asked.add(text)
        return super().get(text, default)


@pytest.mark.slow
@over_all("spoken", CATALOGS)
def test_what_the_built_in_tasks_show_is_in_their_language_and_takes_no_more_paper(spoken):
    """No English word, no foreign decimal sign; and of all that is looked up nearly all is translated."""
    told = language(spoken).catalog
    looked, pages = Looked(told.told), {}
    foreign = r"\d,\d" if language(spoken).decimal == "." else r"\d\.\d"
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(vars(told), "told", looked)
        for name in SHOWN[spoken]:
            solution = in_language(spoken, name)
            contents = contents_of(solution)
            drawing = drawing_of(contents)
            assert note_of(solution)
            assert player_of(contents, drawing)
            pages[name], texts = len(drawing.pages), [text.text for text in drawing.texts]
            # The name of a file.
            found = {word for text in texts for word in english_words(text, SHARED, spoken)} - own_words(spoken)
            assert found <= {"measured"}, name
            assert [text for text in texts if re.search(foreign, text)] == [], name
    asked = {(context, text) for context, text in looked.asked if context or has_words(text)}
    missing = sorted(text for _, text in asked - looked.keys())
    assert len(asked) > 300
    assert len(missing) <= MOST_MISSING * len(asked), missing
    # Words may be longer; what a spring adds to the coursework takes a second sheet, as in English.
    assert (pages["coursework"], pages["spring"]) == (1, 2)


@pytest.mark.parametrize("spoken", CATALOGS)
def test_a_player_has_no_english_word(spoken):
    solution = in_language(spoken, "coursework")
    contents = contents_of(solution)
    page = player_of(contents, drawing_of(contents))
    shown = re.sub(r"(?s)<(script|style).*?</\1>|<svg.*?</svg>|<[^>]*>|&\w+;", " ", page)
    assert english_words(shown, (*SHARED, *KEYS), spoken) - own_words(spoken) == set()


@pytest.mark.slow
@pytest.mark.parametrize("spoken", languages())
def test_a_translation_that_no_native_speaker_has_read_says_so_where_it_is_shown(spoken):
    solution = in_language(spoken, "flat")
    contents = contents_of(solution)
    remark, lettered = language(spoken).remark, letters_on(solution)
    assert bool(remark) == (spoken in UNREAD)
    # The scripts of the studio's page hold its words in all languages: an address may ask for another one.
    studio = re.sub(r"(?s)<script.*?</script>", "", page({"language": spoken, "builtin": {}}))
    shown = [note_of(solution), player_of(contents, drawing_of(contents)), studio]
    if remark:
        assert lettered.count(remark) == len(sheet_of(solution).pages)
        assert all(remark in text for text in shown)
    else:
        assert not [text for text in (*lettered, *shown) for each in UNREAD if language(each).remark in text]


@pytest.mark.parametrize("spoken", SIGNS)
def test_each_language_names_the_phases_by_their_kind(spoken):
    told = [f"{sign} = {angle}°" for sign, angle in zip(SIGNS[spoken], (80, 45, 60, 175), strict=True)]
    assert set(told) <= set(letters_on(in_language(spoken, "coursework")))


def test_speaking_needs_no_library():
    """Nobody waits for Babel to load: it writes catalogs, and they are read without it."""
    code = "import sys; from graphcam.language import language; language('ru'); sys.exit('babel' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.slow
@pytest.mark.parametrize("spoken", UNREAD)
def test_the_command_line_speaks_no_language_that_has_no_messages(tmp_path, spoken):
    """Half of each sentence would be English."""
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["solve", "--language", spoken, "--out", str(out)])
    assert done.exit_code == 0
    assert "error and estimated bound in mm on paper" in done.output
    assert language(spoken).remark in (out / "note.md").read_text(encoding="utf-8")
    assert language_of_machine({"LANG": f"{spoken}_XX.UTF-8"}) == ENGLISH


@pytest.mark.slow
def test_the_command_line_chooses_the_language(tmp_path):
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["solve", "--language", "ru", "--out", str(out)])
    assert done.exit_code == 0
    assert "## 2. Диаграмма аналога ускорения" in (out / "note.md").read_text(encoding="utf-8")
    refused = CliRunner().invoke(app, ["solve", "--language", "xx"])
    assert refused.exit_code == 2
    assert ", ".join(languages()) in refused.output
