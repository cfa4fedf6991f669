"""The studio in Firefox, steered by its own protocol: from the local server, and as one file with WebAssembly."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from firefox import Firefox, firefox_in
from programs import pyodide_folder
from studio_pages import Engine

import graphcam as gc
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.task_text import built_in_tasks
from graphcam.studio.worker_page import write_one_file

pytestmark = pytest.mark.slow

SETTLED = "return Boolean(window.studio && document.querySelector('#drawing [data-group]') && studio.quiet())"
OFFSET = "return studio.state.get().task.follower.offset"
DRAWN = "return document.getElementById('drawing').innerHTML"


@pytest.fixture(scope="module")
def firefox(tmp_path_factory) -> Iterator[Firefox]:
    with firefox_in(tmp_path_factory.mktemp("firefox")) as client:
        yield client


def moved_by_keys(firefox: Firefox) -> None:
    """A key on the slider of the offset moves it, the picture follows, and undo brings both back."""
    firefox.wait(SETTLED)
    before, drawn = firefox.script(OFFSET), firefox.script(DRAWN)
    firefox.script("document.querySelector('[data-key=\"follower.offset/range\"]').focus()")
    slider = firefox.do("WebDriver:GetActiveElement")["value"]
    (key,) = slider.values()
    firefox.do("WebDriver:ElementSendKeys", id=key, text="\ue014")
    firefox.wait(f"{OFFSET.replace('return ', 'return (')}) > {before}")
    firefox.wait(SETTLED)
    assert firefox.script(DRAWN) != drawn
    firefox.script("document.getElementById('undo').click()")
    firefox.wait(f"{OFFSET.replace('return ', 'return (')}) === {before}")
    firefox.wait(SETTLED)


def test_a_size_is_moved_by_a_key(firefox):
    engine = Engine()
    engine.serve()
    firefox.do("WebDriver:Navigate", url=engine.url)
    moved_by_keys(firefox)
    engine.close()


@pytest.mark.slow
def test_the_one_file_works_without_a_server(firefox, tmp_path_factory):
    page = Path(tmp_path_factory.mktemp("one-file"), "studio.html")
    write_one_file(page, pyodide_folder(tmp_path_factory.mktemp("pyodide")), gc.builtin_task())
    # Not the cam that turns: its picture is never at rest.
    shown = address_of(StudioPlace(built_in_tasks()["coursework"], view="combined"), built_in_tasks())
    firefox.do("WebDriver:Navigate", url=page.as_uri() + shown)
    # Before the engine is there a picture made beforehand is shown.
    firefox.wait("return studio.stats.length > 0")
    moved_by_keys(firefox)
