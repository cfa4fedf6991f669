"""A page as PDF, printed by the browser that is installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from graphcam.files import OutputError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")
"""Programs of Chromium's family, by the names they are installed under."""
NO_BROWSER = (
    "there is no Chromium to print it",
    "install Chromium or Chrome, or print the page of --html from your browser",
)
"""Why there is no PDF, and what to do."""
LONGEST = 120
"""Seconds that printing may take."""


def browser() -> str | None:
    """The path of an installed Chromium, or None."""
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def print_pdf(page: Path, pdf: Path) -> None:
    """Print a page's file as PDF.

    Raises
    ------
    OutputError : there is no Chromium, or it cannot print the page
    """
    program = browser()
    if program is None:
        raise OutputError(pdf, *NO_BROWSER)
    with tempfile.TemporaryDirectory() as profile:
        options = ["--headless", "--disable-gpu", f"--user-data-dir={profile}", "--no-pdf-header-footer"]
        # Chromium does not start its sandbox for the superuser.
        options += ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        command = [program, *options, f"--print-to-pdf={pdf.resolve()}", page.resolve().as_uri()]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise OutputError(pdf, f"{Path(program).name}: {error}") from error
    if done.returncode or not pdf.exists():
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise OutputError(pdf, f"{Path(program).name} says: {last}", "print the page of --html from your browser")
