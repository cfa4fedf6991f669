"""The command ``graphcam studio``, which opens or writes the page with sliders."""

from __future__ import annotations

import threading
import webbrowser
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Option

from graphcam.cli.command_language import help_text_of, voice
from graphcam.cli.shared import DEFAULT_FOLDER, TaskFile, echo, input_errors, path_option, read_task, short_warnings
from graphcam.errors import DesignError
from graphcam.language import languages
from graphcam.words import say

if TYPE_CHECKING:
    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task

OUT_HELP = help_text_of(
    say("Folder for the files that the page writes; the default is {folder}.", folder=str(DEFAULT_FOLDER))
)
LANGUAGE_HELP = help_text_of(
    say("Language of the page and of what it writes, instead of the task's: {names}.", names=", ".join(languages()))
)
HTML_HELP = "Write the studio as one file that needs no server, and exit."
SITE_HELP = "Write the studio as a folder for a web server, and exit."
PYODIDE_HELP = "Folder with Pyodide and NumPy for browsers, which --html and --site include."
ENDING_NOTE = say("It ends with its last tab, or with Ctrl-C.")


def studio(
    task: TaskFile = None,
    out: Annotated[Path, path_option(metavar="DIR", help=OUT_HELP)] = DEFAULT_FOLDER,
    language: Annotated[str | None, Option(metavar="NAME", help=LANGUAGE_HELP)] = None,
    browser: Annotated[bool, Option("--browser/--no-browser", help="Open the page in the browser.")] = True,
    html: Annotated[Path | None, path_option(metavar="FILE", help=HTML_HELP)] = None,
    site: Annotated[Path | None, path_option(metavar="DIR", help=SITE_HELP)] = None,
    pyodide: Annotated[Path | None, path_option(metavar="DIR", help=PYODIDE_HELP)] = None,
) -> None:
    """Open the studio: change a size, and see the construction and the exact values follow.

    The page is served to this machine only, at an address that contains a secret.  If others use the machine too, give
    --no-browser and open that address yourself.

    [bold]Examples[/bold]

    graphcam studio

    graphcam studio cam.toml --out cam

    graphcam studio cam.toml --no-browser   (prints the address, for you to open)

    graphcam studio cam.toml --html studio.html --pyodide pyodide   (one file for a course page)

    graphcam studio --site public/studio --pyodide pyodide   (a folder for a web server)
    """
    voice().choose(language)
    with input_errors(), short_warnings():
        _check(html, site, pyodide)
        given = _read_task(task, language)
        if pyodide is None:
            _serve(given, out, browser=browser)
        else:
            echo(say("{file} is written", file=str(_write_page(given, html, site, pyodide))))


def _check(html: Path | None, site: Path | None, pyodide: Path | None) -> None:
    """Refuse options that do not go together."""
    if html is not None and site is not None:
        raise DesignError("--site", str(site), say("left out with --html"), say("write one after the other"))
    if (html or site) is not None and pyodide is None:
        asked = "--site" if html is None else "--html"
        limit = say("given with {asked}", asked=asked)
        raise DesignError("--pyodide", say("missing"), limit, say("name the folder with Pyodide and NumPy"))
    if (html or site) is None and pyodide is not None:
        limit = say("left out without --html and --site")
        raise DesignError("--pyodide", str(pyodide), limit, say("the server needs none"))


def _read_task(path: Path | None, spoken: str | None) -> Task | ArcsTask:
    task = read_task(path)
    if spoken is None:
        return task
    return replace(task, drawing=replace(task.drawing, language=spoken))


def _write_page(task: Task | ArcsTask, html: Path | None, site: Path | None, pyodide: Path) -> Path:
    """Write the studio that needs no server; returns the file or folder."""
    from graphcam.studio.worker_page import write_one_file, write_site

    if html is not None:
        write_one_file(html, pyodide, task, task.drawing.language)
        return html
    assert site is not None
    write_site(site, pyodide, task, task.drawing.language)
    return site


def _serve(task: Task | ArcsTask, out: Path, *, browser: bool) -> None:
    """Serve until the last tab is closed."""
    # Loads the engine and the templates: only when the input has been found right.
    from graphcam.studio.local_studio import local_studio, opened_address

    with local_studio(out, task.drawing.language) as server:
        address = opened_address(server, task)
        typer.echo(address)
        echo(ENDING_NOTE)
        if browser:
            # A browser of the terminal returns when it is closed.
            threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
        server.run()
