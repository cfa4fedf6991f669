"""One store: what the engine has drawn is the state; what it refuses lives in its field alone."""

from __future__ import annotations

import json

import pytest
from studio_pages import hand, in_hash, middle, settled, task_of

pytestmark = pytest.mark.slow

PHASE_FIELDS = [("phase-lift", "-5"), ("phase-angle_of_phase", "200"), ("phase-ratio", "-1"), ("phase-lift", "abc")]


def commit(page, field, text: str) -> None:
    field.fill(text)
    field.press("Enter")
    settled(page)


def first_phase(page) -> None:
    page.locator(".phase-bar button").nth(0).click()


def messages(page) -> list[str]:
    return page.locator(".error:visible").all_inner_texts()


def is_whole(page) -> bool:
    """Whether nothing is refused, and the address says what is drawn."""
    assert messages(page) == []
    assert page.locator("[aria-invalid='true']").count() == 0
    assert not page.evaluate("() => document.body.classList.contains('stale')")
    found = page.evaluate("async () => (await addressOf(studio.config).read(location.hash)).task")
    return found == task_of(page)


@pytest.mark.parametrize(("key", "text"), PHASE_FIELDS)
def test_what_a_phase_is_refused_is_left_by_undo(opened, key, text):
    page = opened()
    first_phase(page)
    field = page.locator(f"[data-key='{key}']")
    was, before = field.input_value(), task_of(page)
    commit(page, field, text)
    assert len(messages(page)) == 1
    assert field.input_value() == text.replace("-", "−")
    assert field.get_attribute("aria-invalid") == "true"
    assert task_of(page) == before
    page.click("#undo")
    settled(page)
    assert field.input_value() == was
    assert task_of(page) == before
    assert page.evaluate("() => studio.state.past()") == 0
    assert is_whole(page)


@pytest.mark.parametrize(("key", "text"), PHASE_FIELDS)
def test_what_a_phase_is_refused_is_left_by_the_value_that_is_drawn(opened, key, text):
    page = opened()
    first_phase(page)
    field = page.locator(f"[data-key='{key}']")
    was, before = field.input_value(), task_of(page)
    commit(page, field, text)
    page.locator("#slider").focus()
    settled(page)
    assert len(messages(page)) == 1
    commit(page, field, was)
    assert field.input_value() == was
    assert task_of(page) == before
    assert is_whole(page)


def test_a_law_that_is_refused_is_left_by_escape(opened, served):
    page = opened()
    first_phase(page)
    law, before = page.locator("[data-key='phase-law']"), task_of(page)
    was, usual = law.input_value(), served.answering

    def answering(request):
        if request["ask"] == "views" and request["task"] != before:
            error = {"field": "motion.phases[0].law", "message": "not this law", "remedy": ""}
            return {"seq": request["seq"], "ok": False, "error": error}
        return usual(request)

    served.answering = answering
    law.select_option(index=3)
    settled(page)
    assert messages(page) == ["not this law"]
    page.keyboard.press("Escape")
    settled(page)
    assert law.input_value() == was
    assert is_whole(page)


def test_a_refused_size_is_left_by_reload_and_by_another_value(opened):
    page = opened()
    page.evaluate("() => studio.change({ 'cam.prime_radius': 44 })")
    settled(page)
    before, field = task_of(page), page.locator("[id='size-follower-offset']")
    commit(page, field, "-50")
    assert messages(page)
    assert "follower.offset" not in in_hash(page)["d"]
    # Another view shows the same cam, and the field still what was typed.
    page.locator("#view-profile").click()
    settled(page)
    assert messages(page)
    assert field.input_value() == "−50"
    commit(page, page.locator("[id='size-speed_rpm']"), "130")
    assert field.input_value() == "−10"
    assert is_whole(page)
    commit(page, field, "-50")
    page.reload()
    settled(page)
    assert task_of(page) == {**before, "speed_rpm": 130}
    assert page.locator("#form [data-key]").count() > 20
    assert is_whole(page)


def test_an_address_that_cannot_be_drawn_shows_what_can(opened):
    page = opened()
    wrong = {"b": "coursework", "d": {"motion.phases[0].lift": -5}, "n": {"rotation": "no"}}
    letters = page.evaluate("async (data) => `#1.${await packed(data)}`", wrong)
    page.goto("about:blank")
    page = opened(at=letters)
    assert task_of(page)["motion"]["phases"][0]["lift"] == 30
    assert page.locator("#form [data-key]").count() > 20
    assert in_hash(page) == {"b": "coursework"}


def test_lists_say_what_is_shown_after_undo(opened):
    page = opened()
    page.select_option("#builtin", "arm")
    settled(page)
    page.select_option("select[data-key='rotation']", index=0)
    settled(page)
    for name in ("arm", "coursework"):
        page.click("#undo")
        settled(page)
        assert page.locator("#builtin").input_value() == name
        assert is_whole(page)
    assert page.locator("select[data-key='follower.kind'] >> option:checked").inner_text() == "translating"


def test_the_next_hand_is_taken_at_once(opened):
    page = opened()
    for by in (-25, 30):
        x, y = middle(hand(page, "combined/A"))
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + by, y + 20, steps=6)
        page.mouse.up()
        assert not page.evaluate("() => document.body.classList.contains('held')")
    settled(page)
    assert page.evaluate("() => studio.state.past()") == 2
    sizes = page.evaluate("() => studio.shown.sizes")
    assert (sizes["offset"], sizes["prime_radius"]) == (
        task_of(page)["follower"]["offset"],
        task_of(page)["cam"]["prime_radius"],
    )
    assert is_whole(page)


def test_a_lift_keeps_the_cam_closed(opened):
    page = opened()
    first_phase(page)
    commit(page, page.locator("[data-key='phase-lift']"), "40")
    lifts = lambda: [phase.get("lift") for phase in task_of(page)["motion"]["phases"]]  # noqa: E731
    assert lifts() == [40, None, 40, None]
    commit(page, page.locator("[id='size-motion-phases-0-lift']"), "20")
    assert lifts() == [20, None, 20, None]
    page.evaluate("() => studio.open('displacement')")
    settled(page)
    x, y = middle(hand(page, "displacement/lift"))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 30, steps=5)
    page.mouse.up()
    settled(page)
    assert lifts()[0] == lifts()[2] > 20
    assert is_whole(page)


@pytest.fixture
def bare(browser, served):
    """The page in a window in which the network may fail."""
    served.serve("coursework")
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    page = context.new_page()
    page.goto(served.url)
    settled(page)
    yield page
    context.close()


REFUSAL = json.dumps({"ok": False, "error": {"field": "", "message": "graphcam has failed", "remedy": ""}})
FAILURES = {
    "500": {"status": 500, "content_type": "application/json", "body": REFUSAL},
    "413": {"status": 413, "content_type": "application/json", "body": REFUSAL},
    "401": {"status": 401, "content_type": "application/json", "body": REFUSAL},
    "no JSON": {"status": 200, "content_type": "text/plain", "body": "hello"},
    "null": {"status": 200, "content_type": "application/json", "body": "null"},
    "nothing": None,
}


@pytest.mark.parametrize("failure", FAILURES)
def test_whatever_comes_back_the_page_works_on(bare, failure):
    page, before = bare, task_of(bare)

    def answered(route):
        if FAILURES[failure] is None:
            route.abort()
        else:
            route.fulfill(**FAILURES[failure])

    page.route("**/engine", answered)
    x, y = middle(hand(page, "combined/A"))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 20, y + 20, steps=4)
    page.mouse.up()
    page.wait_for_function("() => studio.quiet() && document.body.classList.contains('stale')")
    assert not page.evaluate("() => document.body.classList.contains('held')")
    assert task_of(page) == before
    page.unroute("**/engine")
    if page.locator("#notice button").is_visible():
        page.locator("#notice button").click()
        settled(page)
    page.locator("[id='size-follower-offset']").fill("-12")
    page.locator("[id='size-follower-offset']").press("Enter")
    settled(page)
    assert task_of(page)["follower"]["offset"] == -12
    assert page.locator("#notice").is_hidden()
    assert is_whole(page)


def test_a_copied_link_is_drawn_in_a_new_tab(browser, served, tmp_path):
    import threading

    from graphcam.studio.local_studio import local_studio

    with local_studio(tmp_path) as server:
        thread = threading.Thread(target=server.run)
        thread.start()
        context = browser.new_context(viewport={"width": 1440, "height": 900})
        first = context.new_page()
        first.goto(server.address)
        settled(first)
        second = context.new_page()
        second.goto(first.url)
        settled(second)
        assert second.locator("#notice").is_hidden()
        # Another browser does not know the token, and is told so.
        stranger = browser.new_context()
        third = stranger.new_page()
        third.goto(first.url)
        third.wait_for_selector("#notice:not([hidden])")
        assert "open the address" in third.locator("#notice").inner_text()
        assert third.locator("#told-limits").get_attribute("class") == "over"
        for each in (context, stranger):
            each.close()
        server._ends = {b"": 0.0}
        thread.join()


def test_the_blends_of_constant_velocity_have_fields_and_go_with_the_law(opened):
    page = opened()
    first_phase(page)
    law, blend = page.locator("[data-key='phase-law']"), page.locator("[data-key='phase-second_blend']")
    assert not blend.count()
    law.select_option("constant-velocity")
    settled(page)
    assert blend.input_value() == "0.25"
    commit(page, blend, "0.1")
    settled(page)
    assert task_of(page)["motion"]["phases"][0]["blends"] == [0.25, 0.1]
    commit(page, blend, "0.9")
    settled(page)
    assert messages(page)
    page.keyboard.press("Escape")
    settled(page)
    law.select_option("cycloidal")
    settled(page)
    assert "blends" not in task_of(page)["motion"]["phases"][0]
    assert is_whole(page)
