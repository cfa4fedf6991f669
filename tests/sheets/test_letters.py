"""Every character of a sheet is drawn as itself in every reader: by its outlines and its dots, not by its number."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib.resources import files
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from chromium import chromium
from fontTools.pens.boundsPen import BoundsPen
from fontTools.ttLib import TTFont
from matplotlib.font_manager import FontProperties
from matplotlib.image import imread
from matplotlib.path import Path as Outline
from matplotlib.textpath import TextPath
from programs import missing, program
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.errors import LetteringWarning
from graphcam.report.documents import sheet_of
from graphcam.report.markdown import FORMULA_PATTERN
from graphcam.sheets import typefaces
from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.matplotlib_renderer import write_pdf, write_png
from graphcam.sheets.model import Box, Drawing, Group, Page, Text
from graphcam.sheets.sampling import corners
from graphcam.sheets.sheet_frame import TitleBlock, title_block
from graphcam.sheets.svg_renderer import svg
from graphcam.sheets.text_measures import extent, index_height, letters_of, points_size, width, wrap

RUSSIAN, GREEK = "АБВГДЕЁЖЗИЙКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдеёжзийклмнопрстуфхцчшщъыьэюя", "αβγδεμνπρστφψωΔΣ"
LETTERS = f"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789{RUSSIAN}{GREEK}°×–±²³≤≥⌀№′″−+=.,:;()/*«»"
HEIGHT, CELL, DOTS = 10.0, 20.0, 6
"""Letters of so many mm in cells of so many mm, and dots to a mm."""
COLUMNS, ROWS = 20, 14
PAPER = Box(0, 0, COLUMNS * CELL, ROWS * CELL)
LACKING = "\ufffd"
"""What LibreCAD draws for a character that its font has not: a small diamond."""


def cell_of(k: int) -> complex:
    """The lower left corner of a letter's cell."""
    return complex(k % COLUMNS * CELL, PAPER.top - (1 + k // COLUMNS) * CELL)


def page_of(letters: str) -> Page:
    """Every letter in a cell of its own."""
    texts = (Text(cell_of(k) + complex(CELL / 2, 6), letter, HEIGHT, "center") for k, letter in enumerate(letters))
    return Page(PAPER.right, PAPER.top, PAPER, (Group("letters", tuple(texts)),))


def cells(ink: np.ndarray, letters: str) -> dict[str, np.ndarray]:
    """The dots of each letter's cell; the ink is a picture of the page, True where it is black."""
    side = int(CELL * DOTS)
    return {
        letter: ink[(k // COLUMNS) * side : (k // COLUMNS + 1) * side, (k % COLUMNS) * side : (k % COLUMNS + 1) * side]
        for k, letter in enumerate(letters)
    }


def printed(pdf: Path) -> np.ndarray:
    """The ink of a PDF's first page, by Poppler."""
    stem = pdf.with_suffix("")
    subprocess.run([program("pdftoppm"), "-r", f"{DOTS * 25.4:g}", "-singlefile", "-png", pdf, stem], check=True)
    return imread(f"{stem}.png")[:, :, 0] < 0.5


def likeness(one: np.ndarray, other: np.ndarray) -> float:
    """The ink that two pictures share, of all ink, each moved to its upper left corner."""
    one, other = map(trimmed, (one, other))
    high, wide = (max(a, b) for a, b in zip(one.shape, other.shape, strict=True))
    one, other = (np.pad(ink, ((0, high - ink.shape[0]), (0, wide - ink.shape[1]))) for ink in (one, other))
    return float(np.sum(one & other) / np.sum(one | other))


def trimmed(ink: np.ndarray) -> np.ndarray:
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    assert rows.size, "nothing is drawn"
    return ink[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


@cache
def outline(letter: str) -> np.ndarray:
    """The dots of a letter by the outlines of its face alone."""
    face = typefaces.face_of(letter)
    path = TextPath((0, 0), letter, prop=FontProperties(fname=face, size=points_size(HEIGHT)))
    box, scale = path.get_extents(), 25.4 / 72
    x, y = (
        np.arange(low * scale * DOTS, high * scale * DOTS) / (scale * DOTS)
        for low, high in (box.intervalx, box.intervaly)
    )
    points = np.column_stack([each.ravel() for each in np.meshgrid(x, y[::-1])])
    inside = np.zeros(len(points), dtype=bool)
    # Counters run the other way round: what lies in an even number of loops is blank.
    for loop in path.to_polygons():
        inside ^= Outline(loop).contains_points(points)
    return inside.reshape(len(y), len(x))


@pytest.fixture(scope="module")
def shown() -> str:
    """Every character of the built-in sheets in English and Russian that is drawn, and some alphabets."""
    found = set(LETTERS)
    for language in ("en", "ru"):
        for name in ("coursework", "arm", "flat"):
            task = gc.builtin_task(name)
            solution = gc.solve(replace(task, drawing=replace(task.drawing, language=language, format="A3")))
            found |= {
                letter
                for text in texts_of(sheet_of(solution))
                for piece in letters_of(text, 3.5)
                for letter in piece.text
            }
    return "".join(sorted(found - {" "}))


def texts_of(drawing: Drawing) -> Iterator[str]:
    return (e.text for p in drawing.pages for g in p.groups for e in g.entities if isinstance(e, Text))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pdf", "svg", "png"])
def test_every_letter_is_drawn_by_its_own_outlines(kind, shown, tmp_path):
    page, file = page_of(shown), tmp_path / f"letters.{kind}"
    if kind == "pdf":
        write_pdf(Drawing("", (page,)), file)
        ink = printed(file)
    elif kind == "png":
        write_png(page, file, dpi=DOTS * 25.4)
        ink = imread(file)[:, :, 0] < 0.5
    else:
        ink = in_chromium(svg(page))
    alike = {letter: likeness(dots, outline(letter)) for letter, dots in cells(ink, shown).items()}
    # Lines are some four dots wide, and their edges fall anywhere.
    assert {letter: share for letter, share in alike.items() if share < 0.6} == {}


def test_a_letter_that_is_drawn_as_a_box_is_found(tmp_path):
    write_pdf(Drawing("", (page_of("□H"),)), tmp_path / "box.pdf")
    box, letter = cells(printed(tmp_path / "box.pdf"), "□H").values()
    assert likeness(letter, outline("H")) > 0.6 > 0.4 > likeness(box, outline("H"))


def in_chromium(picture: str) -> np.ndarray:
    """The ink of an SVG in a browser, on a machine that has none of its letters but those that it brings."""
    with chromium() as browser:
        wide, high = int(PAPER.right * DOTS), int(PAPER.top * DOTS)
        page = browser.new_page(viewport={"width": wide, "height": high})
        sized = re.sub(r'width="\d+mm" height="\d+mm"', f'width="{wide}" height="{high}"', picture, count=1)
        page.set_content(f'<body style="margin:0">{sized[sized.index("<svg") :]}</body>')
        page.evaluate("document.fonts.ready")
        shot = page.screenshot()
    return imread(BytesIO(shot))[:, :, 0] < 0.5


@pytest.mark.slow
def test_librecad_has_every_letter_in_its_own_font(shown, tmp_path):
    letters = f"{LACKING}→{shown}"
    write_dxf(Drawing("", (page_of(letters),)), tmp_path / "letters.dxf")
    subprocess.run(
        [program("librecad"), "dxf2pdf", "-t", tmp_path, tmp_path / "letters.dxf"],
        check=False, capture_output=True, timeout=120, env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    drawn = cells(printed(tmp_path / "letters.pdf"), letters)
    lacking = {letter for letter in letters if likeness(drawn[letter], drawn[LACKING]) > 0.4}
    # The test finds what the font has not, and the sheets have none of it.
    assert lacking == {LACKING, "→"}
    assert not lacking & set(shown)


# --- what no face of the machine has, and what only the machine's own faces have -------------------------------------


@pytest.fixture
def forgotten():
    """Nothing that was looked up with other faces stays known."""

    def forget() -> None:
        for known in (typefaces.face_of, typefaces.glyph, letters_of, extent):
            known.cache_clear()

    forget()
    yield
    forget()


TITLED = replace(gc.builtin_task(), title=replace(gc.builtin_task().title, name="凸轮 mechanism"))


@pytest.mark.usefixtures("forgotten")
def test_what_no_face_has_is_a_box_of_its_width_and_named_in_one_warning(monkeypatch, tmp_path):
    monkeypatch.setattr(typefaces, "installed", lambda: ())
    with pytest.warns(LetteringWarning, match=r"no font on this machine has 凸 轮,.*install") as warned:
        gc.solve(TITLED).write(tmp_path / "out", files=["pdf", "svg"])
    assert len(warned) == 1
    assert width("凸轮", 3.5) == 2 * width("□", 3.5)
    assert "□□ mechanism" in letters_in(tmp_path / "out" / "sheet.pdf")


@pytest.mark.slow
@pytest.mark.usefixtures("forgotten")
def test_the_command_tells_in_one_line_what_is_a_box(monkeypatch, tmp_path):
    monkeypatch.setattr(typefaces, "installed", lambda: ())
    text = (files("graphcam") / "data" / "tasks" / "coursework.toml").read_text(encoding="utf-8")
    (tmp_path / "cam.toml").write_text(text.replace("Cam mechanism", "凸轮"), encoding="utf-8")
    done = CliRunner().invoke(app, ["solve", str(tmp_path / "cam.toml"), "--out", str(tmp_path / "out")])
    assert done.exit_code == 0
    assert [line for line in done.stderr.splitlines() if "凸" in line] == [
        "warning: no font on this machine has 凸 轮, shown as boxes; install one that has, such as fonts-noto-cjk"
    ]


@pytest.mark.usefixtures("forgotten")
def test_chinese_is_drawn_by_a_face_of_the_machine_and_stays_in_its_field(tmp_path):
    if typefaces.face_of("凸") is None:
        missing("no font with Chinese is installed")
    page = page_of("凸轮")
    write_pdf(Drawing("", (page,)), tmp_path / "chinese.pdf")
    alike = [
        likeness(dots, outline(letter)) for letter, dots in cells(printed(tmp_path / "chinese.pdf"), "凸轮").items()
    ]
    assert min(alike) > 0.6
    assert "unicode-range: U+51F8, U+8F6E" in svg(page)
    texts = [e for e in title_block("gost", 0j, TitleBlock(name="凸轮机构" * 12), 1, 1) if isinstance(e, Text)]
    name = [corners(e) for e in texts if "凸" in e.text]
    assert all(box.real.min() >= 65 and box.real.max() <= 135 and box.imag.min() >= 15 for box in name)


@pytest.mark.usefixtures("forgotten")
def test_the_machines_faces_are_asked_only_for_what_the_shipped_ones_lack(monkeypatch):
    def asked() -> tuple[Path, ...]:
        raise AssertionError("all fonts of the machine are looked for")

    monkeypatch.setattr(typefaces, "installed", asked)
    assert all(typefaces.face_of(letter) for letter in LETTERS + "√→∆")


def letters_in(pdf: Path) -> str:
    return subprocess.run(
        [program("pdftotext"), "-enc", "UTF-8", "-raw", pdf, "-"], check=True, capture_output=True, text=True
    ).stdout


# --- indices and signs -----------------------------------------------------------------------------------------------


def test_an_index_is_a_size_smaller_and_stands_half_below_the_line():
    for text, said in (("μₐ = 2", ["μ", "a", " = 2"]), ("φ_д.с = 45°", ["φ", "д.с", " = 45°"]), ("v₂₁", ["v", "21"])):
        first, index, *_ = found = letters_of(text, 3.5)
        assert [piece.text for piece in found] == said
        assert (first.height, index.height) == (3.5, 2.5)
        assert (first.start.imag, index.start.imag) == (0, -1.25)
        assert all(b.start.real == pytest.approx(a.start.real + a.width) for a, b in pairwise(found))
    assert [index_height(height) for height in (2.5, 3.5, 5.0, 7.0)] == [1.8, 2.5, 3.5, 5.0]
    # Names of files and of users have none.
    assert [piece.text for piece in letters_of("my_cam.toml, a_b", 3.5)] == ["my_cam.toml, a_b"]


@pytest.mark.parametrize("language", ["en", "ru"])
def test_a_minus_on_a_sheet_is_as_wide_as_a_plus(language):
    assert width("−", 3.5) == width("+", 3.5)
    task = gc.builtin_task()
    drawing = sheet_of(gc.solve(replace(task, drawing=replace(task.drawing, language=language))))
    said = list(texts_of(drawing))
    # A hyphen stands between numbers of stations.
    assert [text for text in said if re.search(r"(?<![\d′])-\d", text)] == []
    assert any(re.fullmatch(r"−49[.,]3°", text) for text in said)


def test_numbers_that_programs_read_keep_their_hyphen(tmp_path):
    gc.solve(gc.builtin_task()).write(tmp_path / "out", files=["csv"])
    assert ",-49.3" in (tmp_path / "out" / "comparison.csv").read_text(encoding="utf-8")
    gc.solve(gc.builtin_task("arm")).write(tmp_path / "out", files=["note"])
    note = (tmp_path / "out" / "note.md").read_text(encoding="utf-8")
    assert "−80.0" in note
    formulas = FORMULA_PATTERN.split(note)[1::2]
    assert any("= -45.00" in formula for formula in formulas)
    assert not any("−" in formula for formula in formulas)


def test_the_letters_that_were_added_to_the_face_are_its_own():
    """Its Russian was taken out by its maker, who left black boxes; the exception of its licence is kept."""
    with TTFont(typefaces.lettering_file()) as face:
        glyphs, names = face.getGlyphSet(), face.getBestCmap()

        def bounds(letter: str) -> tuple[float, ...]:
            pen = BoundsPen(glyphs)
            glyphs[names[ord(letter)]].draw(pen)
            return pen.bounds

        for new, old in (("−", "-"), ("Э", "Є"), ("э", "є"), ("Ё", "Ë"), ("ё", "ë"), ("з", "ε")):
            (left, low, right, high), (left_0, low_0, right_0, high_0) = bounds(new), bounds(old)
            assert (right - left, low, high) == pytest.approx((right_0 - left_0, low_0, high_0), abs=1)
        # The small letters without strokes upwards are of one height.
        tops = [bounds(letter)[3] for letter in "авгежзиклмнопстухцчшщъыьэюя"]
        assert max(tops) - min(tops) < 20
        assert not {"GPOS", "GSUB"} & set(face.keys())
    licence = typefaces.lettering_file().with_name("osifont-licence.txt").read_text(encoding="utf-8")
    assert "As a special exception" in licence
    assert "GNU LESSER GENERAL PUBLIC LICENSE" in licence


@pytest.mark.parametrize("height", [1.8, 2.5, 3.5])
@pytest.mark.parametrize("count", range(1, 9))
def test_a_line_takes_words_to_the_last_one_that_has_room(height: float, count: int):
    text = "the cam φ₁ of μₐ = 2 and 37.5 mm 漢 − longer instruction (s₂') радиус φ_у кулачка"
    words = text.split()
    # As wide as a line exactly, which rounding must not break, and a hair less.
    exact = width(" ".join(words[:count]), height)
    for room in (exact, exact - 1e-4):
        lines = wrap("  ".join(words), height, room)
        assert " ".join(lines).split() == words
        for line, following in pairwise(lines):
            assert width(line, height) <= room or " " not in line
            assert width(f"{line} {following.split()[0]}", height) > room
    assert wrap(" ".join(words), height, exact)[0] == " ".join(words[:count])
