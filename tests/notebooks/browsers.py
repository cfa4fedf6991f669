"""Pages opened in the installed Chromium."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from chromium import chromium

if TYPE_CHECKING:
    from playwright.sync_api import Page


@contextmanager
def opened(path: Path, site: Path | None = None) -> Generator[tuple[Page, list[str]]]:
    """A page's file in the browser, and what went wrong: messages of its console, and requests for anything else.

    site : the folder whose files the page may ask for too
    """
    with chromium() as browser:
        page = browser.new_page()
        wrong: list[str] = []
        own = (site or path).as_uri()
        page.on("console", lambda said: wrong.append(f"{said.type}: {said.text}"))
        page.on("pageerror", lambda error: wrong.append(f"error: {error}"))
        page.on(
            "request",
            lambda asked: None if asked.url.startswith(("data:", "about:", "blob:", own)) else wrong.append(asked.url),
        )
        page.goto(path.as_uri())
        yield page, wrong
