"""The player bars nobody's way: axe-core finds nothing, the drawing keeps half of the window, letters can be read."""

from __future__ import annotations

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

pytestmark = pytest.mark.slow

WINDOWS = {"desk": (1440, 900), "twice as near": (720, 450), "phone": (390, 844)}
each_window = pytest.mark.parametrize("window", WINDOWS.values(), ids=WINDOWS)


def barred(page: Page) -> list[str]:
    """What axe-core finds, with the elements."""
    found = Axe().run(page).response["violations"]
    return [f"{each['id']}: {[node['target'] for node in each['nodes']]}" for each in found]


@pytest.mark.parametrize(
    ("scheme", "window"),
    [
        ("light", "desk"),
        ("dark", "phone"),
        pytest.param("dark", "desk", marks=pytest.mark.slow),
        pytest.param("light", "phone", marks=pytest.mark.slow),
    ],
)
def test_axe_core_finds_nothing(solved, opened, scheme, window):
    # axe-core is put into the page, which the page forbids to all others.
    page = opened(solved("coursework").file, *WINDOWS[window], color_scheme=scheme, bypass_csp=True)
    page.emulate_media(reduced_motion="reduce")
    for key in ("ArrowRight", "End", "p", "m"):
        page.keyboard.press(key)
        assert barred(page) == [], key


def test_axe_core_would_find_a_pale_caption_and_a_lost_landmark(solved, opened):
    page = opened(solved("coursework").file, bypass_csp=True)
    page.evaluate("document.querySelectorAll('.caption, .said').forEach((e) => { e.style.color = '#ccc'; })")
    assert "color-contrast" in str(barred(page))
    page.evaluate("document.querySelector('main').setAttribute('role', 'tabpanel')")
    assert "landmark-one-main" in str(barred(page))


def test_next_comes_before_the_contents(solved, opened):
    page = opened(solved("coursework").file)
    reached = []
    for _ in range(30):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.id || document.activeElement.closest('nav')?.tagName"))
    assert reached.index("next") < reached.index("words") < reached.index("NAV")


def test_who_is_in_the_words_scrolls_them_by_keys(solved, opened):
    page = opened(solved("coursework").file, 720, 450, reduced_motion="reduce")
    page.locator("#words").focus()
    before = page.url
    page.keyboard.press("PageDown")
    page.wait_for_function("() => document.getElementById('words').scrollTop > 50")
    assert page.url == before
    page.keyboard.press("ArrowRight")
    assert page.url != before


def box(page: Page, selector: str) -> dict[str, float]:
    found = page.locator(selector).bounding_box()
    assert found
    return found


@pytest.mark.parametrize("window", [*WINDOWS.values(), (736, 736), (360, 640), (320, 568)])
@pytest.mark.parametrize("tab", ["construction", "mechanism"])
def test_the_drawing_keeps_half_of_the_window_and_nothing_covers_another(solved, opened, window, tab):
    page = opened(solved("pages").file, *window)
    if tab == "mechanism":
        page.keyboard.press("m")
    assert box(page, f"#{tab} .desk")["height"] >= 0.5 * window[1] - 1
    parts = [f"#{tab} .desk", f"#{tab} .foot", f"#{tab} .words:visible", "header"]
    parts += ["#construction .zoom"] if tab == "construction" else []
    boxes = [box(page, part) for part in parts]
    for k, a in enumerate(boxes):
        assert a["width"] > 0
        assert a["x"] + a["width"] <= window[0] + 1
        assert a["y"] + a["height"] <= window[1] + 1
        for b in boxes[k + 1 :]:
            across = min(a["x"] + a["width"], b["x"] + b["width"]) - max(a["x"], b["x"])
            down = min(a["y"] + a["height"], b["y"] + b["height"]) - max(a["y"], b["y"])
            assert min(across, down) < 1
    if tab == "construction":
        counter, tools = box(page, "#place"), box(page, "#follow")
        assert counter["x"] + counter["width"] <= tools["x"] or counter["y"] >= tools["y"] + tools["height"]
        row = box(page, "#construction .zoom")
        assert row["y"] <= tools["y"]
        assert tools["y"] + tools["height"] <= row["y"] + row["height"], "the buttons are cut off"


LETTERS = """() => [...document.querySelectorAll("#stage .page:not(.away) :is(.step, .titles) text")]
    .filter((e) => !e.closest(".later, .away") && !e.classList.contains("crowded"))
    .map((e) => {
        const matrix = e.getScreenCTM(), { x, y, width, height } = e.getBBox(), turned = e.hasAttribute("transform");
        return { text: e.textContent, pixels: parseFloat(getComputedStyle(e).fontSize) * Math.hypot(matrix.a, matrix.b),
            grown: parseFloat(getComputedStyle(e).fontSize) > 1.001 * Number(e.getAttribute("font-size")),
            at: [Number(e.getAttribute("x")), Number(e.getAttribute("y"))], box: [x, y, width, height], turned };
    })"""


def meet(a: dict, b: dict) -> bool:
    """Whether two level texts overlap by more than the air about letters."""
    (ax, ay, aw, ah), (bx, by, bw, bh) = a["box"], b["box"]
    across, down = min(ax + aw, bx + bw) - max(ax, bx), min(ay + ah, by + bh) - max(ay, by)
    return across > 0.1 * min(aw, bw) and down > 0.5 * min(ah, bh)


@each_window
def test_letters_of_a_step_can_be_read_and_grown_ones_leave_each_other_room(solved, opened, window):
    found = solved("coursework")
    page = opened(found.file, *window, reduced_motion="reduce")
    for slide in found.slides[::4]:
        page.evaluate("number => { location.hash = number; }", slide.number)
        page.wait_for_function("n => document.getElementById('number').textContent === n", arg=slide.number)
        page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
        letters = page.evaluate(LETTERS)
        assert letters
        assert min(each["pixels"] for each in letters) >= 8.9
        grown = [each for each in letters if each["grown"] and not each["turned"]]
        assert not [(a["text"], b["text"]) for k, a in enumerate(grown) for b in grown[k + 1 :] if meet(a, b)]


def test_letters_stay_where_they_name_something(solved, opened):
    """A text that grew stands on the same place, and on the whole sheet none has grown."""
    page = opened(solved("coursework").file, 720, 450, reduced_motion="reduce")
    page.keyboard.press("End")
    near = {(each["text"], *each["at"]) for each in page.evaluate(LETTERS)}
    page.keyboard.press("0")
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    letters = page.evaluate(LETTERS)
    assert near <= {(each["text"], *each["at"]) for each in letters}
    assert not any(each["grown"] for each in letters)
