"""The step player in a real browser: what is seen, said and answered at every step, printed, and turned."""

from __future__ import annotations

import math
import re
import subprocess

import numpy as np
import pytest
from players import Solved, outside, watch
from playwright.sync_api import Locator, Page
from programs import program

import graphcam as gc
from graphcam.sheets.model import Text
from graphcam.sheets.player import Slide

pytestmark = pytest.mark.slow

MECHANISMS = ("coursework", "arm", "flat", "arcs", "knife")
each_mechanism = pytest.mark.parametrize("name", MECHANISMS)
MM = 96 / 25.4
"""CSS pixels in a millimetre."""


SEEN = """() => {
    const all = (selector) => [...document.querySelectorAll(selector)];
    const shown = (selector) => all(selector).filter((e) => e.checkVisibility());
    const texts = (selector) => shown(selector).map((e) => e.innerText);
    const page = shown("#stage svg.page");
    return {
        steps: all("#stage g.step").filter((g) => getComputedStyle(g).display !== "none").map((g) => g.id),
        current: all("#stage g.step.current").map((g) => g.id),
        titles: page.flatMap((svg) => [...svg.querySelectorAll("[data-view]")])
            .filter((g) => getComputedStyle(g).display !== "none").map((g) => g.dataset.view),
        frames: page.map((svg) => svg.querySelectorAll("g.frame").length),
        page: page.map((svg) => svg.id),
        chapter: texts("article .chapter"), title: texts("article h2 .name"), number: texts("article h2 .number"),
        said: texts("article :is(.caption, .parts .said)"),
        why: texts("article .reason > span"), readings: texts("article dt"), values: texts("article dd strong"),
        announced: document.getElementById("announcement").textContent,
        counter: document.getElementById("counter").textContent,
    };
}"""


def seen(page: Page) -> dict:
    """What is drawn and said."""
    return page.evaluate(SEEN)


def said_of(slide: Slide) -> list[str]:
    """What is told of a step: its caption, if it has one, and its parts; a run once."""
    told = [(run or part).caption for _, part, run in slide.listed if run or part]
    return [slide.caption, *told] if slide.caption else told


def step_keys(count: int) -> list[str]:
    return [f"step-{k:02d}" for k in range(1, count + 1)]


def check_step(page: Page, solved: Solved, k: int) -> None:
    """That at step k (from 0), shown whole, steps 0 to k are drawn and no other, and that its words stand beside it."""
    slide, now, key = solved.slides[k], seen(page), f"step-{k + 1:02d}"
    on = next(n for n, p in enumerate(solved.drawing.pages, 1) if any(group.key == key for group in p.groups))
    assert sorted(now.pop("steps")) == step_keys(k + 1)
    # A view is named when something stands in it.
    views = {e.view for g in solved.drawing.pages[on - 1].groups for e in g.entities if isinstance(e, Text) and e.view}
    assert set(now.pop("titles")) == views & {slide.view for slide in solved.slides[: k + 1]}
    assert now == {
        "current": [key], "frames": [1], "page": [f"page-{on}"],
        "chapter": [slide.chapter], "title": [slide.title], "said": said_of(slide),
        "number": [slide.number], "why": [slide.reason] if slide.reason else [],
        "readings": [reading.title for reading in slide.readings], "values": [r.value for r in slide.readings],
        "announced": f"{slide.title}. {slide.caption or ' '.join(said_of(slide))}",
        "counter": f"{slide.number} step {k + 1} of {len(solved.slides)}",
    }  # fmt: skip


@pytest.mark.parametrize("name", ["arcs", "measured", "pages"])
def test_every_step_shows_itself_and_those_before_it(solved, opened, name):
    found = solved(name)
    page = opened(found.file, reduced_motion="reduce")
    if len(found.slides[0].parts) > 1:
        page.keyboard.press("Shift+ArrowRight")
    for k in range(len(found.slides)):
        check_step(page, found, k)
        page.keyboard.press("Shift+ArrowRight")
    check_step(page, found, len(found.slides) - 1)


def test_the_check_of_a_step_can_fail(solved, browser, tmp_path):
    """A player that shows one step too many is caught, and so is one that says another step's caption."""
    found = solved("flat")
    for right, wrong in (
        ('"later", j > current', '"later", j > current + 1'),
        ("j !== current)", "j !== current + 1)"),
    ):
        assert right in found.text
        broken = tmp_path / "broken.html"
        broken.write_text(found.text.replace(right, wrong), encoding="utf-8")
        page = browser.new_page()
        page.goto(f"{broken.as_uri()}#{found.slides[0].number}")
        with pytest.raises(AssertionError):
            check_step(page, found, 0)
        page.close()


def test_a_request_or_an_error_would_be_noticed(solved, browser, tmp_path):
    found, complaints = solved("flat"), []
    for wrong in (
        '<img src="https://example.org/a.png">',
        "<script>nobody()</script>",
        "<script>console.log(1)</script>",
    ):
        file = tmp_path / "broken.html"
        file.write_text(found.text.replace("<noscript>", f"{wrong}<noscript>"), encoding="utf-8")
        page = browser.new_page()
        watch(page, file, complaints)
        page.goto(file.as_uri())
        assert complaints, wrong
        complaints.clear()
        page.close()
    assert outside("https://example.org/", file)


@each_mechanism
def test_one_file_holds_everything_in_a_megabyte(solved, name):
    text = solved(name).text
    assert len(text.encode()) <= 1_000_000
    # A namespace has the name of a place, and is none.
    text = text.replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?://|@import|url\((?!data:)", text)
    assert not re.search(r"<(?:img|link|iframe|script)\b[^>]*\b(?:src|href)=(?!\"data:)", text)


def test_keys_go_through_the_steps_and_the_constructions(solved, opened):
    found = solved("coursework")
    page, last = opened(found.file), len(found.slides) - 1
    starts = [k for k, slide in enumerate(found.slides) if k == 0 or found.slides[k - 1].chapter != slide.chapter]
    for key, k in (
        ("Shift+ArrowLeft", 0), ("Shift+ArrowRight", 1), ("Shift+ArrowDown", 2), ("Shift+ArrowUp", 1),
        ("PageDown", starts[2]), ("PageDown", starts[3]), ("PageUp", starts[2]),
        ("End", last), ("ArrowRight", last), ("Home", 0), ("PageUp", 0),
    ):  # fmt: skip
        page.keyboard.press(key)
        assert page.locator("#number").inner_text() == found.slides[k].number, key
        assert page.url.split("#")[1].split("/")[0] == found.slides[k].number


def test_the_slider_the_buttons_and_the_contents_go_there_too(solved, opened):
    found = solved("coursework")
    page = opened(found.file)
    page.locator("#slider").fill("7")
    check_step(page, found, 6)
    page.locator("#slider").focus()
    page.keyboard.press("Shift+ArrowRight")
    check_step(page, found, 7)
    for button, k in (("whole-on", 8), ("whole-back", 7)):
        page.locator(f"#{button}").click()
        check_step(page, found, k)
    page.keyboard.press("Home")
    assert page.locator("#previous").is_disabled()
    chapters = list(dict.fromkeys(slide.chapter for slide in found.slides))
    assert page.locator(".breakpoint > button").all_inner_texts() == chapters
    page.get_by_role("button", name=chapters[2], exact=True).click()
    k = next(k for k, slide in enumerate(found.slides) if slide.chapter == chapters[2])
    assert page.locator("#number").inner_text() == found.slides[k].number
    page.reload()
    assert page.locator("#number").inner_text() == found.slides[k].number, "the address says the step"


def test_everything_has_a_name_and_shows_where_the_focus_is(solved, opened):
    page = opened(solved("pages").file)
    for selector in ("button", "input", "select", "svg[role=img]", "[role=group]", "[role=tablist]"):
        for element in page.locator(selector).all():
            name = element.evaluate(
                """e => e.getAttribute('aria-label') || e.innerText || e.labels?.[0]?.innerText
                || document.getElementById(e.getAttribute('aria-labelledby')?.split(' ')[0])?.textContent"""
            )
            assert name, element.evaluate("e => e.outerHTML")
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")
    assert len(ids) == len(set(ids))
    for _ in range(16):
        page.keyboard.press("Tab")
        style = page.evaluate("getComputedStyle(document.activeElement).outlineStyle")
        assert style == "solid", page.evaluate("document.activeElement.outerHTML")


def inside_stage(page: Page, element: Locator) -> bool:
    return element.evaluate(
        """e => { const r = e.getBoundingClientRect(), s = document.getElementById('stage').getBoundingClientRect();
        return r.left >= s.left - 1 && r.right <= s.right + 1 && r.top >= s.top - 1 && r.bottom <= s.bottom + 1; }"""
    )


@pytest.mark.parametrize("window", [(390, 844), (1280, 800), (1920, 1080)])
def test_the_step_is_looked_at_closely_and_the_sheet_as_a_whole(solved, opened, window):
    found = solved("coursework")
    page = opened(found.file, *window, reduced_motion="reduce")
    for k in range(1, len(found.slides) + 1, 3):
        page.locator("#slider").fill(str(k))
        lines = page.locator("#stage g.step.current path").all()
        assert all(inside_stage(page, line) for line in lines[:: len(lines) // 30 + 1])
    page.keyboard.press("0")
    assert inside_stage(page, page.locator("#stage .paper"))
    whole = page.locator("#stage .paper").bounding_box()["width"]
    page.keyboard.press("+")
    assert page.locator("#stage .paper").bounding_box()["width"] == pytest.approx(1.25 * whole, rel=1e-3)
    before = page.locator("#stage .paper").bounding_box()
    box = page.locator("#stage").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y - 20)
    page.mouse.up()
    after = page.locator("#stage .paper").bounding_box()
    assert (after["x"] - before["x"], after["y"] - before["y"]) == pytest.approx((30, -20), abs=0.5)
    page.mouse.wheel(0, -200)
    page.wait_for_function(
        "w => document.querySelector('#stage .paper').getBoundingClientRect().width > 1.3 * w", arg=after["width"]
    )
    told, stage = page.locator("article:visible h2").bounding_box(), page.locator("#stage").bounding_box()
    if window[0] < 800:
        assert told["y"] > stage["y"] + stage["height"], "in a narrow window the words stand under the drawing"
    else:
        assert told["x"] > stage["x"] + stage["width"]


def test_light_and_dark_and_back(solved, opened):
    def paper(page: Page) -> str:
        return page.evaluate("getComputedStyle(document.querySelector('.paper')).fill")

    light, dark = (opened(solved("flat").file, color_scheme=scheme) for scheme in ("light", "dark"))
    assert paper(light) == "rgb(255, 255, 255)"
    assert paper(dark) != paper(light)
    ground = paper(dark)
    for page, turned in ((light, ground), (dark, "rgb(255, 255, 255)")):
        page.locator("#theme").click()
        assert paper(page) == turned
        page.locator("#theme").click()
        assert paper(page) != turned


def test_who_wants_no_motion_gets_none(solved, opened):
    still, moving = (opened(solved("flat").file, reduced_motion=wish) for wish in ("reduce", "no-preference"))
    duration = "getComputedStyle(document.querySelector('.camera')).transitionDuration"
    assert still.evaluate(duration) == "0s"
    assert moving.evaluate(duration) != "0s"
    still.keyboard.press("m")
    first = still.locator("#scene .cam").get_attribute("transform")
    still.wait_for_timeout(200)
    assert still.locator("#scene .cam").get_attribute("transform") == first


@pytest.mark.parametrize(("name", "size"), [("coursework", (841, 594)), ("pages", (420, 297))])
def test_it_prints_as_the_finished_sheet(solved, opened, tmp_path, name, size):
    found = solved(name)
    # Wherever the reader is, and however near.
    page = opened(found.file, color_scheme="dark")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("+")
    page.keyboard.press("m")
    page.emulate_media(media="print")
    assert sorted(seen(page)["steps"]) == step_keys(len(found.slides))
    boxes = [page.locator(f"#page-{k}").bounding_box() for k in range(1, len(found.drawing.pages) + 1)]
    assert [(b["width"] / MM, b["height"] / MM) for b in boxes] == [pytest.approx(size, abs=0.05)] * len(boxes)
    gauge = page.evaluate("document.querySelector('path.gauge').getBoundingClientRect().width")
    assert gauge / MM == pytest.approx(100, abs=0.01)
    colours = set(page.evaluate("[...document.querySelectorAll('.step .line')].map(e => getComputedStyle(e).stroke)"))
    assert colours == {"rgb(0, 0, 0)", "rgb(90, 90, 90)", "rgb(179, 32, 28)"}
    page.pdf(path=tmp_path / "print.pdf", prefer_css_page_size=True, print_background=True)
    about = subprocess.check_output([program("pdfinfo"), tmp_path / "print.pdf"], text=True)
    assert int(re.search(r"Pages:\s+(\d+)", about)[1]) == len(found.drawing.pages)
    wide, high = (float(x) * 25.4 / 72 for x in re.search(r"Page size:\s+([\d.]+) x ([\d.]+)", about).groups())
    # The browser counts paper in whole pixels.
    assert (wide, high) == pytest.approx(size, abs=0.5)


# --- the mechanism ----------------------------------------------------------------------------------------------------


def turn_to(page: Page, degrees: float) -> None:
    page.evaluate(
        """d => { const e = document.getElementById('phi'); e.value = d;
        e.dispatchEvent(new Event('input', { bubbles: true })); }""",
        degrees,
    )


class Mechanism:
    """What is drawn of the mechanism, and what is said of it."""

    def __init__(self, page: Page) -> None:
        names = ("roller", "contact", "cam", "motion", "normal", "rod")
        self.attributes = page.evaluate(
            """names => Object.fromEntries(names.map(name => [name,
            Object.fromEntries(
                [...document.querySelector(`#scene .${name}`).attributes].map(a => [a.name, a.value]))]))""",
            names,
        )
        self.profile = _points(page.locator("#scene .cam .body").get_attribute("d"))
        self.said = page.evaluate(
            """() => Object.fromEntries([...document.querySelectorAll('[id^=live-]')].map(
            e => [e.id.slice(5), e.textContent]))"""
        )
        self.said["beside"] = page.locator("#scene .alpha").text_content().removeprefix("α = ")

    def centre(self, name: str) -> complex:
        return complex(float(self.attributes[name]["cx"]), float(self.attributes[name]["cy"]))

    def line(self, name: str) -> np.ndarray:
        return _points(self.attributes[name]["d"])

    def value(self, name: str) -> float:
        return float(re.match(r"-?[\d.]+", self.said[name].replace("−", "-"))[0])


def _points(path: str) -> np.ndarray:
    values = np.array(re.findall(r"-?[\d.]+(?:e-?\d+)?", path), dtype=float)
    return values[::2] + 1j * values[1::2]


def exact(solution, phi: float) -> tuple[complex, complex, float]:
    """Trace point and touched point in the frame, and pressure angle, by the exact side's own functions."""
    arcs = isinstance(solution, gc.ArcsSolution)
    cam, sigma = (solution.motion, solution.motion.sigma) if arcs else (solution.cam, solution.cam.sigma)
    turned = np.exp(1j * sigma * phi)
    trace = complex(*cam.pitch_curve(phi)) * turned
    alpha = float(cam.pressure_angle(phi))
    if arcs:
        return trace, trace - cam.roller_radius * trace / abs(trace) * np.exp(1j * sigma * alpha), alpha
    return trace, complex(*cam.profile(phi)) * turned, alpha


def check_mechanism(page: Page, solved: Solved, degrees: float) -> None:
    """That the drawn follower stands where the exact side says, touches the drawn cam, and shows its pressure angle."""
    turn_to(page, degrees)
    solution, expected, phi = solved.solution, solved.scene, math.radians(degrees)
    now = Mechanism(page)
    trace, touched, alpha = exact(solution, phi)
    at, contact = now.centre("roller"), now.centre("contact")
    assert at.imag == pytest.approx(trace.imag, abs=1e-3)
    assert at.real == pytest.approx(0 if expected.kind == "face" else trace.real, abs=1e-3)
    assert contact == pytest.approx(touched, abs=2e-3)
    turned = float(re.fullmatch(r"rotate\((.+)\)", now.attributes["cam"]["transform"])[1])
    assert turned == pytest.approx(expected.sigma * degrees)
    # The drawn profile, turned as it is drawn, passes through the contact.
    assert distance(contact, now.profile * np.exp(1j * math.radians(turned))) < 0.02
    motion, normal = now.line("motion"), now.line("normal")
    angle = float(np.angle((normal[1] - normal[0]) / (motion[1] - motion[0]))) * expected.sigma
    assert math.degrees(angle) == pytest.approx(math.degrees(alpha), abs=0.02)
    if expected.kind == "face":  # it has no pressure angle that could change
        assert "pressure_angle" not in now.said
        assert now.said["beside"] == ""
    else:
        assert now.value("pressure_angle") == pytest.approx(math.degrees(alpha), abs=0.0056)
        assert now.value("beside") == pytest.approx(math.degrees(alpha), abs=0.056)
    s, v, *_ = (solution.motion if isinstance(solution, gc.ArcsSolution) else solution.cam.motion)(phi)
    unit = math.degrees(1) if expected.kind == "arm" else 1.0
    assert now.value("displacement") == pytest.approx(unit * float(s), abs=0.0056)
    assert now.value("velocity") == pytest.approx(float(v), abs=0.0056)
    if expected.kind == "arm":
        assert abs(now.line("rod") - [expected.pivot, trace]).max() < 1e-3


def distance(point: complex, closed: np.ndarray) -> float:
    """From a point to a closed polyline."""
    a, b = closed, np.roll(closed, -1)
    share = np.clip(((point - a) * np.conj(b - a)).real / np.maximum(np.abs(b - a) ** 2, 1e-30), 0, 1)
    return float(np.abs(a + share * (b - a) - point).min())


@each_mechanism
def test_the_mechanism_stands_where_the_exact_side_says(solved, opened, name):
    found = solved(name)
    page = opened(found.file)
    page.keyboard.press("m")
    assert page.locator("#mechanism").is_visible()
    for degrees in (0, 0.5, 40, 79.5, 125.5, 150, 222, 359.5, 360):
        check_mechanism(page, found, degrees)


def test_a_misplaced_follower_would_be_seen(solved, browser, tmp_path):
    found = solved("coursework")
    for right, wrong in (
        ("const trace = arrays.trace[k]", "const trace = arrays.trace[k + 1]"),
        ("mechanism.sigma * phi", "-mechanism.sigma * phi"),
        ("const angle = arrays.pressure_angle[k]", "const angle = -arrays.pressure_angle[k]"),
    ):
        assert right in found.text
        broken = tmp_path / "broken.html"
        broken.write_text(found.text.replace(right, wrong), encoding="utf-8")
        page = browser.new_page()
        page.goto(broken.as_uri())
        page.keyboard.press("m")
        with pytest.raises(AssertionError):
            check_mechanism(page, found, 40)
        page.close()


BOXES = """() => [".roller", ".rod", ".normal", ".alpha"].map(
    (part) => ({ part, ...document.querySelector(`#scene ${part}`).getBoundingClientRect().toJSON() }))"""


@each_mechanism
def test_everything_that_moves_stays_in_the_picture(solved, opened, name):
    found = solved(name)
    page = opened(found.file)
    page.keyboard.press("m")
    # The picture is as high as the window lets it be, or as wide.
    left, top, wide, high = (float(x) for x in page.locator("#scene").get_attribute("viewBox").split())
    reach = np.abs(found.scene.profile).max()
    assert left < -reach < reach < left + wide
    assert top < -reach < reach < top + high
    stage = page.locator("#mechanism .stage").bounding_box()
    for degrees in range(0, 360, 24):
        turn_to(page, degrees)
        for box in page.evaluate(BOXES):
            assert box["left"] >= stage["x"], (degrees, box)
            assert box["top"] >= stage["y"], (degrees, box)
            assert box["right"] <= stage["x"] + stage["width"], (degrees, box)
            assert box["bottom"] <= stage["y"] + stage["height"], (degrees, box)


def test_it_turns_until_it_is_stopped(solved, opened):
    page = opened(solved("coursework").file)
    page.keyboard.press("m")
    page.locator("#speed").select_option("40")
    page.locator("#play").click()
    page.wait_for_function("() => Number(document.getElementById('phi').value) > 20")
    page.locator("#play").click()
    assert page.locator("#play").get_attribute("aria-label") == "Turn"
    stopped = page.locator("#phi").input_value()
    page.wait_for_timeout(150)
    assert page.locator("#phi").input_value() == stopped
    page.locator("#phi").focus()
    keys = {"Home": 0, "ArrowRight": 1, "PageUp": 16, "PageDown": 1, "ArrowLeft": 0, "End": 360}
    for key, degrees in keys.items():
        page.keyboard.press(key)
        assert page.locator("#phi").input_value() == str(degrees)
    page.keyboard.press("m")
    assert page.locator("#construction").is_visible()
