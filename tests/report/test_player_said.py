"""What the step player says in every language: sentences with one full stop, and settings that instruments have."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from players import task_of

import graphcam as gc
from graphcam.language import language, languages
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.step_player import player_of, slides
from graphcam.sheets.player import Slide

pytestmark = pytest.mark.slow

DOUBLED = re.compile(r"\.\.(?!\.)|。。|，，|,,|;;|。\.|\.。|\s[.,;]")
"""Stops that two texts leave where they are joined."""
PLAIN = ("coursework", "arm", "flat", "measured", "arcs")


def texts_of(slide: Slide) -> list[str]:
    """All that is said at a step."""
    parts = [text for part in slide.parts for text in (part.caption, *part.tools)]
    parts += [run.caption for run in slide.runs]
    readings = [text for each in slide.readings for text in (each.title, each.taken, each.value)]
    return [slide.chapter, slide.why, slide.title, slide.caption, slide.reason, *parts, *readings]


@pytest.fixture(scope="module", params=PLAIN)
def told(request) -> dict[str, list[Slide]]:
    """What is said of a task in every language."""
    contents = contents_of(gc.solve(task_of(request.param)))
    return {name: slides(contents, language(name).text)[0] for name in languages()}


def test_no_text_has_a_doubled_stop(told):
    texts = [(name, text) for name, said in told.items() for slide in said for text in texts_of(slide)]
    assert len(texts) > 100
    assert [(name, text) for name, text in texts if DOUBLED.search(text)] == []


def test_no_instrument_is_set_below_zero(told):
    tools = {tool for said in told.values() for slide in said for part in slide.parts for tool in part.tools}
    assert any("°" in tool for tool in tools)
    assert [tool for tool in tools if re.search(r"[-−]\d", tool)] == []


@pytest.mark.parametrize("spoken", ["ru", "zh"])
def test_what_is_announced_is_made_of_sentences(spoken, opened, tmp_path):
    task = task_of("coursework")
    contents = contents_of(gc.solve(replace(task, drawing=replace(task.drawing, language=spoken))))
    file = tmp_path / "player.html"
    file.write_text(player_of(contents, drawing_of(contents)), encoding="utf-8")
    page = opened(file, reduced_motion="reduce")
    announced: list[str] = []
    for _ in range(60):
        announced.append(page.evaluate('document.getElementById("announcement").textContent'))
        page.keyboard.press("ArrowRight")
    assert [text for text in announced if DOUBLED.search(text) or not re.search("[.。:：?？]$", text)] == []
    # A title and what is done; in Chinese both end with its own full stop.
    stop = "。" if spoken == "zh" else "."
    assert max(text.count(stop) for text in announced) >= 2
    assert len({*announced}) > 50
