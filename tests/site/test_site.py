"""The site and the course in it: it builds without a warning, its links lead somewhere, it asks nothing of the network.

The notebooks of the course are executed here, once, from a clean kernel.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import nbformat
import pytest
from browsers import opened
from courses import COURSE, executed, page
from over_all import over_all
from pages import ROOT, SITE
from programs import pyodide_folder

import graphcam as gc

pytestmark = pytest.mark.slow

LARGEST_PICTURE = 300_000
"""Bytes of a picture, as a page of the course holds it."""
FETCHED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}
"""What a browser asks for by itself."""


class Links(HTMLParser):
    """The links and the anchors of a page."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.anchors: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.anchors |= {given["id"]} if given.get("id") else set()
        if address := given.get("href") or given.get("src"):
            (self.fetched if given.get(FETCHED.get(tag, "")) else self.links).append(address)


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """The whole site, of the notebooks as they are executed."""
    notebooks, out = tmp_path_factory.mktemp("notebooks"), tmp_path_factory.mktemp("site")
    for name in COURSE:
        nbformat.write(executed(name), notebooks / f"{name}.ipynb")
    build("--executed", notebooks, "--out", out)
    return out


def build(*options: object) -> None:
    command = [sys.executable, SITE / "build.py", *map(str, options)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def faults(site: Path) -> Iterator[str]:
    """Links within the site that lead nowhere, and whatever is fetched from elsewhere."""
    pages = {path.resolve(): Links(path) for path in site.rglob("*.html")}
    for path, links in pages.items():
        for address in links.links + links.fetched:
            to = urlsplit(address)
            if to.scheme in ("http", "https", "data") or to.netloc:
                if address in links.fetched and to.scheme != "data":
                    yield f"{path.name} fetches {address}"
                continue
            target = (path.parent / unquote(to.path)).resolve() if to.path else path
            if not target.exists():
                yield f"{path.name} leads to {address}"
            elif to.fragment.startswith("1.") and target.parent.name == "studio":
                continue  # a state of the studio
            elif target.name == "player.html" and re.fullmatch(r"\d+\.\d+/\d+", to.fragment):
                continue  # a part of a step
            elif to.fragment and target in pages and unquote(to.fragment) not in pages[target].anchors:
                yield f"{path.name} leads to {address}, which has no such place"


def test_every_link_leads_somewhere_and_nothing_is_fetched_from_elsewhere(site):
    assert list(faults(site)) == []


def test_without_pyodide_there_is_no_studio_and_no_link_into_it(site):
    assert not (site / "studio").exists()
    assert [path for path in site.rglob("*.html") if "studio/index.html" in path.read_text(encoding="utf-8")] == []


def test_with_pyodide_the_site_has_the_studio_and_every_notebook_a_link_into_it(site, tmp_path):
    (tmp_path / "pyodide").mkdir()
    before, site = site, tmp_path / "site"
    build("--no-execute", "--pyodide", pyodide_folder(tmp_path / "pyodide"), "--out", site)
    assert list(faults(site)) == []
    # Besides it has the same pages, whether or not the notebooks are executed.
    pages, others = ({path.relative_to(folder) for path in folder.rglob("*.html")} for folder in (before, site))
    assert others - pages == {Path("studio.html"), Path("studio/index.html")}
    assert pages <= others
    assert {"index.html", "service-worker.js"} <= {path.name for path in (site / "studio").iterdir()}
    links = [Links(site / "course" / f"{name}.html").links for name in COURSE]
    assert [sum(link.startswith("../studio/index.html#1.") for link in of_page) for of_page in links] == [1] * len(
        COURSE
    )
    # The first page that the site lists.
    pages = [link for link in Links(site / "index.html").links if link.endswith(".html") and not link.startswith("#")]
    assert next(link for link in pages if link != "index.html") == "studio.html"


def test_the_gallery_shows_a_sheet_of_every_task_and_its_pictures_are_small(site):
    pictures = {path.stem: path.stat().st_size for path in (site / "_images").glob("*.png")}
    assert set(pictures) >= {path.stem for path in (ROOT / "graphcam" / "data" / "tasks").glob("*.toml")}
    assert max(pictures.values()) <= 300_000


def test_wrong_links_are_found(tmp_path):
    (tmp_path / "page.html").write_text(
        '<a href="gone.html">x</a><a href="#nowhere">x</a><a id="here" href="#here">x</a>'
        '<script src="https://elsewhere/x.js"></script><a href="https://elsewhere">x</a>', encoding="utf-8",
    )  # fmt: skip
    said = list(faults(tmp_path))
    assert len(said) == 3
    assert [word in text for word, text in zip(("gone", "nowhere", "x.js"), said, strict=True)] == [True] * 3


def test_the_reference_has_every_public_name_and_the_course_every_notebook(site):
    pages = [Links(path) for path in (site / "reference").glob("*.html")]
    anchors = set().union(*(page.anchors for page in pages))
    assert {f"graphcam.{name}" for name in gc.__all__} <= anchors
    course = {path.stem for path in (ROOT / "notebooks").glob("[0-9][0-9]_*.py")}
    assert {path.stem for path in (site / "course").glob("[0-9]*.html")} == course


def test_the_player_of_the_first_page_steps_where_it_stands(site):
    """It moves its own boxes, not the page around it."""
    with opened(site / "index.html", site) as (shown, wrong):
        player = shown.frame_locator("figure.player iframe")
        player.locator("#next").wait_for()
        assert shown.evaluate("scrollY") == 0
        player.locator("#next").click()
        stood = shown.evaluate("scrollY")
        for _ in range(8):
            shown.keyboard.press("ArrowRight")
        assert shown.frames[1].evaluate("location.hash") == "#3.2/13"
        assert shown.evaluate("scrollY") == stood
        # And the part is in sight.
        part, words = player.locator(".parts [aria-current=step]"), player.locator("#words")
        (inner, outer) = (found.bounding_box() for found in (part, words))
        assert outer["y"] <= inner["y"]
        assert inner["y"] + inner["height"] <= outer["y"] + outer["height"] + 1
    assert wrong == []


def test_the_summaries_of_the_commands_are_whole(site):
    text = (site / "reference" / "commands.html").read_text(encoding="utf-8")
    assert "draw the sheet, write the note and the tables, compare with exact values." in text
    assert re.findall(r"<li>.*<code.*?</code>: .*\.\.\.</p>", text) == []


@pytest.mark.parametrize("place", ["index", "course/04_shaded_region", "reference/index", "how-to/check-my-drawing"])
def test_a_page_opens_without_a_fault_or_a_request(site, place):
    with opened(site / f"{place}.html", site) as (shown, wrong):
        assert shown.locator("h1").count() == 1
        if place in ("course/04_shaded_region", "reference/index"):
            # A single small letter is as high as the machine's typeface makes it; the highest formula is not that.
            heights = shown.locator("math").evaluate_all("all => all.map(one => one.getBoundingClientRect().height)")
            assert max(heights) > 10
    assert wrong == []


@over_all("name", COURSE)
def test_a_notebook_runs_without_a_warning_and_its_page_stands_alone(name, tmp_path):
    path = tmp_path / f"{name}.html"
    path.write_text(page(name), encoding="utf-8")
    with opened(path) as (shown, wrong):
        assert shown.title() == name
        figures = shown.locator("figure img")
        assert figures.count() >= 4
        alone = figures.evaluate_all("all => all.filter(i => !i.alt || i.alt.length < 20 || !i.naturalWidth).length")
        assert alone == 0
        assert shown.locator("img").count() == figures.count()
    assert wrong == []
    assert max(map(len, re.findall(r"data:image/[^\"]+", page(name)))) <= LARGEST_PICTURE


@over_all("name", COURSE)
def test_the_stills_stand_for_the_sliders(name):
    bundles = [out.data for cell in executed(name).cells for out in cell.get("outputs", ()) if "data" in out]
    sliders = [data for data in bundles if "application/vnd.jupyter.widget-view+json" in data]
    assert sliders
    for data in sliders:
        pictures = re.findall(r'src="([^"]+)"', data["text/html"])
        assert pictures
        assert all(picture in page(name) for picture in pictures)
