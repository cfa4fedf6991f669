"""The page bars nobody's way: axe-core finds nothing, all is reached by keys, nothing is wider than the window."""

from __future__ import annotations

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page
from studio_pages import hand, middle, settled, task_of

pytestmark = pytest.mark.slow

WINDOWS = {"desk": (1440, 900), "tablet": (1024, 768), "phone": (390, 844), "narrow": (320, 640)}
each_window = pytest.mark.parametrize("window", WINDOWS.values(), ids=WINDOWS)


def barred(page: Page) -> list[str]:
    """What axe-core finds, with the elements."""
    found = Axe().run(page).response["violations"]
    return [f"{each['id']}: {[node['target'] for node in each['nodes']]}" for each in found]


def in_turn(page: Page):
    """The page in one state after another."""
    yield "as it opens"
    for panel in ("step", "values", "what-if", "sizes"):
        if page.locator(f"#tab-{panel}").is_visible():
            page.locator(f"#tab-{panel}").click()
            settled(page)
            yield panel
    page.keyboard.press("p")
    page.evaluate("() => studio.change({ 'follower.offset': 4 })")
    settled(page)
    yield "with a pinned cam"
    page.locator(".phase-bar button").first.click()
    page.locator("[id='size-follower-offset']").fill("far")
    page.keyboard.press("Enter")
    yield "with a wrong size"
    page.locator("#all").click()
    settled(page)
    yield "the board"
    page.evaluate("() => studio.open('velocity')")
    settled(page)
    yield "a construction and its source"


@pytest.mark.parametrize(
    ("scheme", "window"), [("light", "desk"), ("dark", "tablet"), ("dark", "phone"), ("light", "narrow")]
)
def test_axe_core_finds_nothing(opened, scheme, window):
    # axe-core is put into the page, which the page forbids to all others.
    config = {"opening": "mechanism"}
    page = opened(
        "coursework", *WINDOWS[window], "", config, color_scheme=scheme, bypass_csp=True, reduced_motion="reduce"
    )
    for state in in_turn(page):
        assert barred(page) == [], state


def test_axe_core_would_find_a_handle_without_a_name(opened):
    page = opened(bypass_csp=True)
    page.evaluate("() => document.querySelector('.hand input').removeAttribute('aria-label')")
    assert "label" in str(barred(page))


@each_window
def test_nothing_is_wider_than_the_window(opened, window):
    page = opened("coursework", *window)
    assert page.evaluate("() => document.documentElement.scrollWidth") <= window[0]
    for part in ("#canvas", ".foot", "#panel", "header", ".under"):
        box = page.locator(part).bounding_box()
        assert box
        assert box["width"] > 0
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= window[0] + 1
        assert box["y"] + box["height"] <= window[1] + 1


@each_window
def test_what_is_pressed_is_large_enough(opened, window):
    page = opened("coursework", *window)
    small = page.evaluate(
        """() => [...document.querySelectorAll("button, select, .hand, .border")].filter((e) => e.offsetParent)
        .map((e) => [e.id || e.className, e.offsetWidth, e.offsetHeight])
        .filter(([name, wide, high]) => Math.min(wide, high) < (name === "hand" ? 44 : 24))"""
    )
    # A phase is as wide as it lasts; it can be chosen in other ways.
    assert [each for each in small if each[0] not in ("moves", "dwell", "moves narrow", "dwell narrow tiny")] == []


@pytest.mark.parametrize("spoken", ["en", "ru", "vi", "zh"])
def test_the_words_of_buttons_fit_on_a_narrow_phone(opened, spoken):
    page = opened("coursework", *WINDOWS["narrow"], config={"language": spoken})
    cut = page.evaluate(
        """() => [...document.querySelectorAll("header button, #panels button, .choice button, .rows button")]
        .filter((button) => button.offsetParent && button.scrollWidth > button.clientWidth).map((b) => b.textContent)"""
    )
    assert cut == []


def test_the_drawing_has_more_than_half_of_the_height_of_a_phone(opened):
    page = opened("coursework", 390, 844)
    above = page.evaluate("() => document.querySelector('.work').getBoundingClientRect().height")
    assert above >= 0.5 * 844


def reached(page: Page, presses: int) -> list[str]:
    names = []
    for _ in range(presses):
        page.keyboard.press("Tab")
        names.append(page.evaluate("() => document.activeElement.dataset.key || document.activeElement.id"))
    return names


def test_keys_alone_reach_everything_in_the_order_of_the_page(opened):
    page = opened()
    page.keyboard.press("p")
    page.evaluate("() => studio.change({ 'follower.offset': -8 })")
    settled(page)
    page.evaluate("() => document.activeElement.blur()")
    names = reached(page, 75)
    order = ["undo", "pin", "link", "theme", "follower.offset", "follower.offset/range", "phase/0", "border/0", "save"]
    order += ["strip/combined", "combined/A/0", "combined/D/0", "all", "fit", "previous", "slider", "play", "phi"]
    order += ["tab-values"]
    places = [names.index(name) for name in order]
    assert places == sorted(places)
    # Only handles are stops in the drawing, and a handle with two sizes is one.
    assert "combined/A/1" not in names


def test_all_is_done_by_keys(opened):
    page = opened()
    page.locator("#pin").focus()
    page.keyboard.press("8")
    settled(page)
    assert page.locator("#view-profile").get_attribute("aria-selected") == "true"
    page.keyboard.press("Shift+ArrowLeft")
    assert page.locator("#counter").inner_text() == "10 / 11"
    page.keyboard.press("ArrowRight")
    assert page.locator("#counter").inner_text() == "11 / 11"
    page.keyboard.press("a")
    settled(page)
    assert page.locator("#board .view").count() == 10
    page.keyboard.press("a")
    page.keyboard.press("p")
    assert page.locator("#pin").get_attribute("aria-pressed") == "true"
    page.evaluate("() => document.activeElement.blur()")
    page.keyboard.press(" ")
    page.wait_for_function("() => studio.state.get().phi > 40")
    page.keyboard.press(" ")
    settled(page)
    assert page.evaluate("() => studio.state.get().phi % 0.5") == 0


def test_focus_stays_on_a_handle_when_the_picture_is_drawn_anew(opened):
    page = opened()
    page.evaluate("() => document.querySelector(\".hand[data-id='combined/A'] input\").focus()")
    for key in ("ArrowRight", "PageDown", "Home"):
        page.keyboard.press(key)
        settled(page)
        assert page.evaluate("() => document.activeElement.dataset.key") == "combined/A/0"


def test_the_frame_glides_when_it_must_and_not_for_who_wants_no_motion(opened):
    for motion, frames in (("no-preference", 3), ("reduce", 2)):
        page = opened(reduced_motion=motion)
        page.evaluate("""() => { window.frames_seen = new Set(); const svg = document.getElementById("drawing");
            frames_seen.add(svg.getAttribute("viewBox")); new MutationObserver(() =>
            frames_seen.add(svg.getAttribute("viewBox"))).observe(svg, { attributeFilter: ["viewBox"] }); }""")
        page.evaluate("() => studio.change({ 'cam.prime_radius': 75 })")
        settled(page)
        seen = page.evaluate("() => frames_seen.size")
        assert seen == 2 if frames == 2 else seen >= 3


def test_a_handle_is_a_slider_in_two_directions(opened):
    page = opened()
    knob = hand(page, "combined/A")
    assert knob.get_attribute("role") == "group"
    assert knob.get_attribute("aria-roledescription") == "2D slider"
    sliders = knob.get_by_role("slider")
    assert sliders.count() == 2
    assert sliders.nth(0).get_attribute("aria-valuetext") == "Offset e −10 mm"
    assert sliders.nth(1).get_attribute("aria-orientation") == "vertical"
    assert [sliders.nth(k).get_attribute("tabindex") for k in (0, 1)] == ["0", "-1"]
    assert middle(knob)
    assert task_of(page)["follower"]["offset"] == -10
