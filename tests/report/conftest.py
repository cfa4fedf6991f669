"""What the tests of the step player share: solved tasks with their players, and a browser that opens these."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from chromium import chromium
from players import Solved, watch

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """The solved tasks by name, each solved when it is asked for."""
    folder, found = tmp_path_factory.mktemp("players"), {}

    def of(name: str) -> Solved:
        return found.setdefault(name, None) or found.update({name: Solved(name, folder)}) or found[name]

    return of


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


@pytest.fixture
def opened(browser):
    """Opens a file in a window of its own, and at the end sees that the page complained of nothing and asked nobody."""
    complaints: list[str] = []
    contexts = []

    def of(file: Path, wide: int = 1280, high: int = 800, **settings) -> Page:
        context = browser.new_context(viewport={"width": wide, "height": high}, **settings)
        contexts.append(context)
        page = context.new_page()
        watch(page, file, complaints)
        page.goto(file.as_uri())
        return page

    yield of
    for context in contexts:
        context.close()
    assert complaints == []
