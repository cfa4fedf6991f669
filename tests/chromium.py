"""The installed Chromium, steered by Playwright."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser, sync_playwright
from programs import program


@contextmanager
def chromium() -> Iterator[Browser]:
    """A browser without a window; two of them are not steered at a time."""
    path = program("chromium")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(
            executable_path=path, args=["--no-sandbox", "--disable-background-networking"]
        )
        yield started
        started.close()
