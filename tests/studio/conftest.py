"""A browser, and the page of the studio in it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from chromium import chromium
from studio_pages import Engine, settled

if TYPE_CHECKING:
    from playwright.sync_api import Browser


# Two that are steered at a time are one too many, and other folders have their own.
@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


@pytest.fixture(scope="session")
def served() -> Iterator[Engine]:
    engine = Engine()
    yield engine
    engine.close()


@pytest.fixture
def opened(browser, served):
    """Opens the page in a window of its own; at the end sees that it complained of nothing and asked nobody else."""
    complaints: list[str] = []
    contexts = []

    def of(
        name: str = "coursework", wide: int = 1440, high: int = 900, at: str = "", config=None, settle=True, **settings
    ):
        served.serve(name, **(config or {}))
        context = browser.new_context(viewport={"width": wide, "height": high}, **settings)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: complaints.append(message.text))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: foreign(request.url) and complaints.append(request.url))
        page.goto(served.url + at)
        if settle:
            settled(page)
        return page

    def foreign(url: str) -> bool:
        return not url.startswith((served.url, "data:", f"blob:{served.url}"))

    yield of
    for context in contexts:
        context.close()
    assert complaints == []
