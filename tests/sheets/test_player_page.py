"""The player's page holds every sheet at its size, every step with its place on it, and the letters for all words."""

from __future__ import annotations

import base64
import html
import json
import re
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest
from fontTools.ttLib import TTFont

from graphcam.sheets.model import Box, Drawing, Entity, Group, Page, Strokes, Text
from graphcam.sheets.player import PAGE_CAPTIONS, ReadingText, RowText, Slide, player
from graphcam.sheets.text_measures import extent
from graphcam.sheets.typefaces import lettering_file

SAID = {name: str(word) for name, word in PAGE_CAPTIONS.items()}


def box(left: float, bottom: float, right: float, top: float) -> Entity:
    """A line from corner to corner."""
    return Strokes(np.array([complex(left, bottom)]), np.array([complex(right, top)]), "curve")


TITLES = (
    Text(60 + 80j, "of a", 3.5, view="a"),
    Text(5 + 9j, "of b", 3.5, view="b"),
    Text(60 + 75j, "a too", 3.5, view="a"),
)
FIRST = Page(
    200.0, 100.0, Box(0, 0, 200, 100),
    (
        Group("frame", (Text(5 + 5j, "Ж", 3.5),)),
        Group("titles", TITLES),
        Group("step-01 x", (box(50, 40, 90, 60),)),
        Group("step-02 x", (box(80, 50, 120, 70),)),
        Group("step-03 y", (box(2, 3, 30, 20),)),
    ),
)  # fmt: skip
SECOND = Page(
    150.0, 300.0, Box(0, 0, 150, 300), (Group("step-04 z", (box(100, 280, 149, 299),)), Group("step-05 w", ()))
)
READING = ReadingText("title Ω", "taken ψ", "30 ю", (RowText("4", "12.5", "3"),))
SLIDES = [
    Slide("One", "a", "first é", "caption ñ"),
    Slide("One", "a", "second", "caption", (READING,)),
    Slide("Two", "b", "third", "caption"),
    Slide("Two", "c", "fourth", "caption"),
    Slide("Two", "empty", "fifth", "caption"),
]


@pytest.fixture(scope="module")
def page() -> str:
    return player(Drawing("The title", (FIRST, SECOND)), SLIDES, None, SAID, "en")


def data(page: str) -> dict:
    (text,) = re.findall(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.DOTALL)
    return json.loads(html.unescape(text))


def test_every_step_knows_its_sheet_and_the_box_of_its_view(page):
    """From the upper left corner, 8 mm about drawing and title, not beyond the sheet; steps of a view have one box."""
    found = data(page)["steps"]
    title = round(100 - 8 - 80 - extent("of a", 3.5)[2], 1)
    assert [step["group"] for step in found] == [f"step-0{k}" for k in range(1, 6)]
    assert [step["page"] for step in found] == [0, 0, 0, 1, 1]
    assert [step["view"] for step in found] == ["a", "a", "b", "c", "empty"]
    assert [step["box"] for step in found] == [
        [42, title, 86, 68 - title],
        [42, title, 86, 68 - title],
        [0, 72, 38, 28],
        [92, 0, 58, 28],
        # Of a step that draws nothing it is the whole sheet.
        [0, 0, 150, 300],
    ]


def test_every_sheet_has_its_size_and_its_groups(page):
    sizes = re.findall(r'class="page" id="page-(\d)" viewBox="0 0 (\S+) (\S+)"', page)
    assert sizes == [("1", "200", "100"), ("2", "150", "300")]
    assert len(re.findall(r'<path class="line curve"', page)) == 4


def test_titles_of_several_views_appear_with_their_own_view(page):
    groups = re.findall(r'<g id="page-1-titles-(\w)" class="titles" data-view="(\w)">(.*?)</g>', page, re.DOTALL)
    titles = [(key, view, re.findall(r">([^<]+)</text>", body)) for key, view, body in groups]
    assert titles == [("a", "a", ["of a", "a too"]), ("b", "b", ["of b"])]


def test_what_a_title_says_of_a_scale_appears_with_the_step_that_finds_it():
    slides = [*SLIDES[:1], replace(SLIDES[1], finds={"a": "a too"}), *SLIDES[2:]]
    found = player(Drawing("The title", (FIRST, SECOND)), slides, None, SAID, "en")
    groups = re.findall(r'<g id="page-1-(titles-\S+)" class="titles" data-view="(\w)"( data-since="1")?>', found)
    assert groups == [("titles-a", "a", ""), ("titles-b", "b", ""), ("titles-a-scale", "a", ' data-since="1"')]


def test_the_typeface_has_all_letters_that_are_shown_and_not_many_more(page):
    fonts = [TTFont(BytesIO(base64.b64decode(font))) for font in re.findall(r"base64,([\w+/=]+)", page)]
    letters = {chr(code) for font in fonts for code in font.getBestCmap()}
    shown = [*SAID.values(), "The title", "Ж", "of a", "of b", "a too", READING.title, READING.taken, READING.value]
    shown += [text for slide in SLIDES for text in (slide.chapter, slide.title, slide.caption)]
    assert set("".join(shown)) <= letters
    assert not {"漢", "ẞ", "Ŝ", "√"} & letters


def test_the_typeface_bears_no_date_of_its_own(page):
    font, *_ = re.findall(r"base64,([\w+/=]+)", page)
    cut = TTFont(BytesIO(base64.b64decode(font)))
    assert cut["head"].modified == TTFont(lettering_file())["head"].modified
    assert "FFTM" not in cut


def test_the_same_page_is_written_twice(page):
    assert player(Drawing("The title", (FIRST, SECOND)), SLIDES, None, SAID, "en") == page


def test_what_turns_brings_its_own_two_scripts_and_words_in_it_end_none(page):
    mechanism = {"box": [0, 0, 1, 1], "about": "</script><i>", "live": [], "phases": [], "step": 1}
    moving = player(Drawing("The title", (FIRST, SECOND)), SLIDES, mechanism, SAID, "en")
    assert "<i>" not in moving
    assert data(moving)["mechanism"] == mechanism
    assert data(page)["mechanism"] is None
    assert moving.count("<script") == page.count("<script") + 2
