"""The player goes part by part, in a page made for it: what is drawn, bold and lit, what is said, how one gets on."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from graphcam.drafting.act_data import WrittenActs
from graphcam.drafting.acts import Act, Kind
from graphcam.sheets.model import Box, Drawing, Group, Page as Sheet, Source, Strokes, Text
from graphcam.sheets.player import PAGE_CAPTIONS, Acts, PartText, ReadingText, RowText, RunText, Slide, player

pytestmark = pytest.mark.slow

RAYS, CHORDS, CURVE = (Act(Kind.JOIN, "integration", name, {}, 3) for name in ("rays", "chords", "curve"))
PLACES = np.arange(3)


def strokes(x: float, y: float, act: Act, role: str = "construction") -> Strokes:
    """Three lines from a place, one for each place of an act."""
    start = complex(x, y) + np.zeros(3)
    return Strokes(start, start + np.array([10, 20, 30]) + 5j, role, Source(act, PLACES))


def number(x: float, y: float, act: Act, place: int) -> Text:
    return Text(complex(x + 10 * place, y), str(place + 1), 2.0, source=Source(act, np.array([place])))


def groups(far: bool) -> tuple[Group, ...]:
    """Rays above, chords below them, and at last a curve; or the chords far away to the right."""
    x, y = (700, 20) if far else (10, 20)
    frame = Strokes(np.array([x + 0j]), np.array([x + 40 + 40j]), "axis")
    return (
        Group("step-01 a", (strokes(10, 60, RAYS), *(number(10, 70, RAYS, k) for k in range(3)))),
        Group("step-02 a", (frame, strokes(x, y, CHORDS), Text(x + 9j, "all", 3.5, source=Source(CHORDS)))),
        Group("step-03 a", (strokes(x, y + 20, CURVE, "result"),)),
    )


def part(k: int) -> PartText:
    return PartText(f"Chord {k}.", (f"dividers {k}.00 mm", "ruler"), [[1, [k]]], [[0, [k]]], [], ("chords", "rays"))


WHOLE = PartText("", (), [], [], [], ("rays",))
READINGS = (
    ReadingText(
        "the chords", "1 mm × 2", "2 mm", (RowText("1", "1", "2", [[1, [0]]]), RowText("2", "2", "4", [[1, [1]]]))
    ),
    ReadingText("the ray", "5 mm", "5", lit=[[0, [2]]]),
)
SLIDES = [
    Slide("Rays", "rays", "The rays", "All rays.", number="1.1", parts=(WHOLE,)),
    Slide(
        "Chords", "chords", "The chords", "All chords.", READINGS, "Why chords.", "2.1", "Because.",
        tuple(map(part, range(3))),
    ),
    Slide("Chords", "chords", "The curve", "A curve.", number="2.2", parts=(WHOLE,)),
]  # fmt: skip


def written(folder: Path, *, far: bool = False, pages: bool = False, slides: list[Slide] = SLIDES) -> Path:
    """The page in a file; on pages, the chords are on a sheet of their own."""
    acts = Acts(WrittenActs(), {RAYS: 0, CHORDS: 1, CURVE: 2}, {0, 1})
    drawn, wide = groups(far), 800.0 if far else 200.0
    sheets = (drawn[:1], drawn[1:]) if pages else (drawn,)
    drawing = Drawing("Made up", tuple(Sheet(wide, 150.0, Box(0, 0, wide, 150), sheet) for sheet in sheets))
    words = {name: str(word) for name, word in PAGE_CAPTIONS.items()}
    file = folder / "parts.html"
    file.write_text(player(drawing, slides, None, words, "en", acts), encoding="utf-8")
    return file


@pytest.fixture
def page(opened, tmp_path) -> Page:
    return opened(written(tmp_path), reduced_motion="reduce")


STATE = """() => {
    const named = (name) => [...document.querySelectorAll(`#stage [data-act].${name}`)]
        .filter((e) => e.getClientRects().length).map((e) => `${e.dataset.act}/${e.dataset.at ?? ""}`).join(" ");
    return {
        address: location.hash.slice(1), counter: document.getElementById("counter").textContent,
        now: named("now"), done: named("done"), lit: named("lit"),
        hidden: [...document.querySelectorAll("#stage [data-act]")].filter((e) => !e.getClientRects().length).length,
        listed: [...document.querySelectorAll(".parts [aria-current]")].map((e) => e.innerText).join(),
        announced: document.getElementById("announcement").textContent,
    };
}"""
BEFORE = {
    "address": "1.1", "counter": "1.1 step 1 of 3", "now": "", "done": "", "lit": "", "hidden": 5, "listed": "",
    "announced": "The rays. All rays.",
}  # fmt: skip
SECOND = {
    "address": "2.1/2", "counter": "2.1 part 2 of 3", "now": "1/1", "done": "1/0", "lit": "0/1 0/1", "hidden": 3,
    "listed": "2\nChord 1.\ndividers 1.00 mm · ruler", "announced": "Chord 1.",
}  # fmt: skip
WHOLE_STEP = {
    "address": "2.1", "counter": "2.1 step 2 of 3", "now": "", "done": "", "lit": "", "hidden": 1, "listed": "",
    "announced": "The chords. All chords.",
}  # fmt: skip


def state(page: Page) -> dict[str, str]:
    return page.evaluate(STATE)


def test_next_draws_part_after_part_and_lights_what_each_is_found_from(page):
    assert state(page) == BEFORE
    page.keyboard.press("ArrowRight")
    first = state(page)
    assert (first["now"], first["lit"], first["hidden"]) == ("1/0", "0/0 0/0", 4)
    assert first["announced"] == "The chords. All chords. Chord 0."
    page.locator("#next").click()
    assert state(page) == SECOND
    page.keyboard.press("ArrowRight")
    # What is not drawn in parts comes with the last that draws of its act.
    assert state(page) | {"hidden": 1, "now": "1/2 1/", "done": "1/0 1/1"} == state(page)
    page.keyboard.press("ArrowRight")
    assert state(page)["address"] == "2.2"
    assert page.locator("#next").is_disabled()


def test_back_shows_a_step_whole_and_then_its_parts(page):
    page.keyboard.press("End")
    page.keyboard.press("ArrowLeft")
    assert state(page) == WHOLE_STEP
    page.keyboard.press("ArrowLeft")
    assert state(page)["address"] == "2.1/3"
    page.keyboard.press("ArrowLeft")
    assert state(page) | {"announced": ""} == SECOND | {"announced": ""}
    for address in ("2.1/1", "1.1", "1.1"):
        page.keyboard.press("ArrowLeft")
        assert state(page)["address"] == address


def test_one_may_skip_to_the_whole_step_and_come_back_to_a_part(page):
    for key, address in (
        ("ArrowRight", "2.1/1"), ("Shift+ArrowRight", "2.1"), ("Shift+ArrowRight", "2.2"), ("Shift+ArrowLeft", "2.1"),
        ("PageUp", "1.1"), ("PageDown", "2.1/1"), ("ArrowRight", "2.1/2"), ("PageUp", "2.1/1"),
    ):  # fmt: skip
        page.keyboard.press(key)
        assert state(page)["address"] == address, key
    page.locator(".parts button").nth(1).click()
    assert state(page) == SECOND
    page.locator(".whole-step").click()
    assert state(page) == WHOLE_STEP
    assert page.locator(".whole-step").get_attribute("aria-pressed") == "true"
    page.locator("#slider").fill("3")
    page.locator("#slider").fill("2")
    assert state(page) == WHOLE_STEP


def test_an_address_says_step_and_part_and_rubbish_is_the_start(opened, tmp_path):
    file = written(tmp_path)
    page = opened(file)
    for address, shown in (
        ("2.1", "2.1"), ("2.1/2", "2.1/2"), ("2.1/9", "2.1"), ("2.1/0", "2.1"), ("2", "2.1"), ("2.5", "1.1"),
        ("2.2", "2.2"), ("9", "1.1"), ("%E0%A4%A", "1.1"), ("2.1/2/3", "2.1/2"), ("-1/x", "1.1"), ("2.1/x", "2.1"),
        ("constructor", "1.1"), ("2.2/1", "2.2"), ("", "1.1"),
    ):  # fmt: skip
        page.evaluate("address => { location.hash = address; }", address)
        page.wait_for_function("shown => location.hash === '#' + shown", arg=shown)
        page.goto("about:blank")
        page.goto(f"{file.as_uri()}#{address}")
        assert state(page)["address"] == shown


def test_a_page_that_draws_a_part_too_many_or_lights_another_ray_is_seen(opened, tmp_path):
    whole = written(tmp_path).read_text(encoding="utf-8")
    for right, wrong in (
        ('own > part ? "later"', 'own > part + 1 ? "later"'),
        ("places.includes(at(piece))", "places.includes(at(piece) + 1)"),
        ("lineOf(items[part])", "lineOf(items[0])"),
    ):
        assert right in whole
        file = tmp_path / "broken.html"
        file.write_text(whole.replace(right, wrong), encoding="utf-8")
        page = opened(file, reduced_motion="reduce")
        page.keyboard.press("ArrowRight")
        page.keyboard.press("ArrowRight")
        assert state(page) != SECOND, wrong


def test_the_list_of_parts_follows_and_the_caption_says_why(page):
    page.keyboard.press("Shift+ArrowRight")
    assert page.locator("article:visible .reason").inner_text() == "Why Because."
    assert page.locator("article:visible .parts li").count() == 3
    page.set_viewport_size({"width": 390, "height": 500})
    for k in range(3):
        page.locator(".parts button").nth(k).evaluate("e => e.click()")
        item, words = (page.locator(s).bounding_box() for s in (".parts [aria-current]", "#words"))
        assert words["y"] - 1 <= item["y"]
        assert item["y"] + item["height"] <= words["y"] + words["height"] + 1


# --- a run ------------------------------------------------------------------------------------------------------------

ROWS = (("0", "0"), ("1", "2.00 mm"), ("2", "4.00 mm"))
RUN = RunText("Draw all chords: chord 2 climbs 4.00 mm.", 1, "Chord", ROWS, ("ruler",))
POLE = replace(part(0), caption="Mark the pole.", draws=[[0, [0]]], lit=[])
TOLD_ONCE = replace(
    SLIDES[1],
    caption="",
    parts=(POLE, *(replace(part(k), caption=f"Chord {name}: {set_to}.") for k, (name, set_to) in enumerate(ROWS))),
    runs=(RUN,),
)


@pytest.fixture
def run_page(opened, tmp_path) -> Page:
    return opened(written(tmp_path, slides=[SLIDES[0], TOLD_ONCE, SLIDES[2]]), reduced_motion="reduce")


def test_a_run_is_told_once_and_its_rows_are_gone_through(run_page):
    run_page.keyboard.press("ArrowRight")
    assert state(run_page)["announced"] == "The chords. Mark the pole."
    for k, (said, now) in enumerate((
        ("Draw all chords: chord 2 climbs 4.00 mm. Chord 0: 0.", "1/0"),
        ("Chord 1: 2.00 mm.", "1/1"),
        ("Chord 2: 4.00 mm.", "1/2 1/"),
    ), 2):  # fmt: skip
        run_page.keyboard.press("ArrowRight")
        found = state(run_page)
        assert (found["address"], found["announced"], found["now"]) == (f"2.1/{k}", said, now)
    run_page.keyboard.press("ArrowRight")
    run_page.keyboard.press("ArrowLeft")
    assert state(run_page)["announced"] == "The chords. Mark the pole. Draw all chords: chord 2 climbs 4.00 mm."
    run_page.keyboard.press("ArrowLeft")
    assert state(run_page)["announced"] == "Draw all chords: chord 2 climbs 4.00 mm. Chord 2: 4.00 mm."


def test_an_address_opens_a_row_and_a_row_is_chosen_with_the_pointer(run_page):
    run_page.evaluate("location.hash = '2.1/4'")
    run_page.wait_for_function("document.querySelector('.row-table [aria-current]') !== null")
    assert state(run_page)["listed"] == "2\n4.00 mm"
    # Who only hears the page is told the whole sentence, and nothing twice.
    named = run_page.get_by_role("button", name="Chord 2: 4.00 mm.", exact=True)
    assert named.get_attribute("aria-current") == "step"
    run_page.locator("article:visible .row-table button").nth(1).click()
    assert state(run_page)["address"] == "2.1/3"
    assert run_page.locator(".row-table .later").count() == 1
    assert run_page.locator("article:visible .run .tools-set").inner_text() == "ruler"
    assert run_page.locator("article:visible .head").inner_text() == "Chord"


@pytest.mark.parametrize(("wide", "columns"), [(1440, 2), (390, 2), (240, 1)])
def test_the_rows_of_a_run_stand_beside_each_other_where_there_is_room(run_page, wide, columns):
    run_page.set_viewport_size({"width": wide, "height": 844})
    run_page.keyboard.press("ArrowRight")
    boxes = [each.bounding_box() for each in run_page.locator("article:visible .row-table button").all()]
    assert len({round(each["x"]) for each in boxes}) >= columns
    words = run_page.locator("#words").bounding_box()
    assert all(each["x"] >= words["x"] and each["x"] + each["width"] <= words["x"] + words["width"] for each in boxes)


def test_the_protocol_tells_a_run_with_its_table(run_page):
    run_page.keyboard.press("p")
    told = run_page.locator("#row-1 td").nth(1).inner_text()
    assert re.sub(r"\s+", " ", told).startswith(
        "Mark the pole. Draw all chords: chord 2 climbs 4.00 mm. Chord 0 0 1 2.00 mm 2 4.00 mm"
    )


# --- two views --------------------------------------------------------------------------------------------------------


def panes(page: Page) -> list[dict[str, float]]:
    return [pane.bounding_box() for pane in page.locator(".stage:visible").all()]


def is_inside(page: Page, selector: str, stage: str) -> bool:
    """Whether all pieces are seen in that pane."""
    return page.evaluate(
        """([selector, stage]) => { const pane = document.querySelector(stage), s = pane.getBoundingClientRect();
        const found = [...pane.querySelectorAll(selector)].filter((e) => e.getClientRects().length);
        return found.length > 0 && found.map((e) => e.getBoundingClientRect()).every((r) =>
            r.left >= s.left - 1 && r.right <= s.right + 1 && r.top >= s.top - 1 && r.bottom <= s.bottom + 1); }""",
        [selector, stage],
    )


def test_two_views_that_stand_near_are_one_picture(page):
    page.keyboard.press("ArrowRight")
    assert len(panes(page)) == 1
    assert is_inside(page, ".now", "#stage")
    assert is_inside(page, ".lit", "#stage")


@pytest.mark.parametrize("where", ["far", "pages"])
def test_two_views_far_from_each_other_are_shown_side_by_side(opened, tmp_path, where):
    page = opened(written(tmp_path, **{where: True}), reduced_motion="reduce")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    assert len(panes(page)) == 2
    assert is_inside(page, ".now", "#stage")
    assert is_inside(page, ".lit", ".stage:not(#stage)")
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map(e => e.id)")
    assert len(ids) == len(set(ids)), "the copy names nothing again"
    page.keyboard.press("Shift+ArrowRight")
    assert len(panes(page)) == 1, "whole, nothing is lit beside it"
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    assert len(panes(page)) == 2
    page.keyboard.press("0")
    assert len(panes(page)) == 1
    page.keyboard.press("f")
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("document.querySelectorAll('.stage:not(#stage) [data-act].now').length") == 1, "it follows"
    page.keyboard.press("ArrowLeft")
    assert len(panes(page)) == 1


# --- readings and marks -----------------------------------------------------------------------------------------------


def pointed(page: Page) -> list[str]:
    return page.evaluate(
        "[...document.querySelectorAll('.pointed')].map(e => `${e.dataset.act}/${e.dataset.at ?? ''}`)"
    )


def test_a_reading_lights_its_marks_under_the_pointer_and_in_focus(page):
    page.keyboard.press("Shift+ArrowRight")
    ray = page.locator("article:visible dl > div").nth(1)
    ray.hover()
    assert pointed(page) == ["0/2", "0/2"], "the ray and its number"
    page.locator("h1").hover()
    assert pointed(page) == []
    ray.focus()
    assert pointed(page) == ["0/2", "0/2"]
    page.locator("article:visible summary").click()
    page.locator("article:visible tbody tr").nth(1).hover()
    assert pointed(page) == ["1/1"]
    page.locator("article:visible tbody tr").nth(0).focus()
    assert pointed(page) == ["1/0"]


def test_a_mark_lights_the_readings_that_were_taken_of_it(page):
    page.keyboard.press("Shift+ArrowRight")
    page.locator("article:visible summary").click()
    lit = "[...document.querySelectorAll('[data-lit].lit')].map(e => e.innerText)"
    for piece, readings in (("[data-act='0'][data-at='2']", 1), ("[data-act='1'][data-at='1']", 1)):
        box = page.locator(f"#stage path{piece}").bounding_box()
        # Near the end, and a little beside the thin line.
        page.mouse.move(box["x"] + box["width"] * 0.95, box["y"] + box["height"] * 0.05 + 3)
        page.wait_for_function(f"() => {lit}.length === {readings}")
    assert re.match(r"2\s+2\s+4", page.evaluate(lit)[0])
    page.locator("h1").hover()
    assert page.evaluate(lit) == []


# --- by itself --------------------------------------------------------------------------------------------------------


def test_the_steps_play_by_themselves_to_the_end(opened, tmp_path):
    page = opened(written(tmp_path))
    page.clock.install()
    page.reload()
    page.locator("#run").click()
    assert page.locator("#run").get_attribute("aria-label") == "Stop playing"
    addresses = []
    for _ in range(15):
        addresses.append(state(page)["address"])
        page.clock.run_for(1000)
    assert list(dict.fromkeys(addresses)) == ["1.1", "2.1/1", "2.1/2", "2.1/3", "2.2"]
    assert page.locator("#run").get_attribute("aria-label") == "Play the steps"
    # From the end it starts again.
    page.keyboard.press(" ")
    assert state(page)["address"] == "1.1"


def seconds_to_the_end(page: Page, pace: str) -> int:
    page.keyboard.press("Home")
    page.locator("#pace").select_option(pace)
    page.locator("#run").click()
    for second in range(100):
        if state(page)["address"] == "2.2":
            return second
        page.clock.run_for(1000)
    raise AssertionError("it does not end")


def test_it_plays_at_three_speeds(opened, tmp_path):
    page = opened(written(tmp_path))
    page.clock.install()
    page.reload()
    slow, normal, fast = (seconds_to_the_end(page, pace) for pace in ("0.5", "1", "4"))
    assert slow > 1.6 * normal
    assert normal > 2 * fast > 0


@pytest.mark.parametrize("act", ["key", "pointer", "wheel"])
def test_it_stops_when_the_reader_acts(opened, tmp_path, act):
    page = opened(written(tmp_path))
    page.clock.install()
    page.reload()
    page.locator("#run").click()
    page.locator("#stage").hover()
    if act == "key":
        page.keyboard.press("ArrowRight")
    elif act == "pointer":
        page.mouse.down()
    else:
        page.mouse.wheel(0, 10)
    page.wait_for_function("() => !document.body.classList.contains('playing')")
    before = state(page)
    page.clock.run_for(60_000)
    assert state(page) == before


# --- the protocol -----------------------------------------------------------------------------------------------------


def test_the_protocol_lists_the_steps_and_goes_there(page):
    page.locator("#list").click()
    assert page.locator("#protocol").is_visible()
    assert not page.locator("#words").is_visible()
    rows = page.locator("#protocol tbody tr").all_inner_texts()
    assert [re.split(r"\s*\t\s*|\n+", row.strip())[:3] for row in rows] == [
        [slide.number, slide.title, slide.caption] for slide in SLIDES
    ]
    assert "the chords: 2 mm" in rows[1]
    page.locator("#row-2").click()
    assert state(page)["address"] == "2.2"
    page.locator("#row-1 button").focus()
    page.keyboard.press("Enter")
    assert state(page) == WHOLE_STEP
    assert page.locator("#protocol .here").get_attribute("id") == "row-1"
    page.keyboard.press("Escape")
    assert page.locator("#words").is_visible()
    assert page.evaluate("document.activeElement.id") == "list"


def test_the_protocol_puts_the_marks_of_a_step_away(page):
    page.keyboard.press("End")
    page.keyboard.press("p")
    box = page.locator("#row-0 input")
    box.focus()
    page.keyboard.press(" ")
    assert not page.locator("#step-01").is_visible()
    assert state(page)["address"] == "2.2", "the row is not gone to"
    page.emulate_media(media="print")
    page.keyboard.press("p")
    assert page.locator("#step-01").is_visible(), "the finished sheet is printed whole"
    page.emulate_media(media="screen")
    page.keyboard.press("p")
    box.click()
    assert page.locator("#step-01").is_visible()


def test_an_open_protocol_is_printed_instead_of_the_sheet(page, tmp_path):
    page.keyboard.press("p")
    page.emulate_media(media="print")
    assert page.locator("#protocol table").is_visible()
    assert not page.locator("#stage").is_visible()
    page.keyboard.press("p")
    assert not page.locator("#protocol").is_visible()
    assert page.locator("#stage").is_visible()
