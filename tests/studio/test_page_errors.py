"""A wrong size: the message stands beside its field, the last good picture stays, and undo goes back."""

from __future__ import annotations

import pytest
from studio_pages import settled, task_of

pytestmark = pytest.mark.slow

OFFSET = "[id='size-follower-offset']"


def typed(page, field: str, text: str) -> None:
    page.locator(field).fill(text)
    page.keyboard.press("Enter")
    settled(page)


@pytest.fixture
def page(opened):
    found = opened()
    found.evaluate("() => studio.change({ 'cam.prime_radius': 44 })")
    settled(found)
    return found


def drawing(page) -> str:
    return page.evaluate("() => document.getElementById('steps').innerHTML")


def test_the_message_stands_beside_the_field_and_the_picture_stays(page):
    before = drawing(page)
    typed(page, OFFSET, "-50")
    error = page.locator(f"{OFFSET} >> xpath=ancestor::div[contains(@class, 'size')] >> .error")
    assert "50" in error.inner_text()
    assert error.get_attribute("role") == "alert"
    field = page.locator(OFFSET)
    assert field.get_attribute("aria-invalid") == "true"
    assert field.get_attribute("aria-describedby") == error.get_attribute("id")
    assert field.input_value().replace("−", "-") == "-50"
    assert drawing(page) == before
    assert page.locator("#told-limits").inner_text() == "Not drawn: see the field"
    assert not page.locator(".hand").first.is_visible()


def test_a_good_size_takes_the_message_away(page):
    typed(page, OFFSET, "-50")
    typed(page, OFFSET, "-8")
    assert page.locator("[aria-invalid='true']").count() == 0
    assert not page.locator(".error:visible").count()
    assert page.locator(".hand").first.is_visible()
    assert page.locator(OFFSET).input_value() == "−8"


def test_undo_skips_what_was_refused(page):
    typed(page, OFFSET, "-50")
    typed(page, OFFSET, "-60")
    page.locator("body").click(position={"x": 5, "y": 5})
    page.keyboard.press("Control+z")
    settled(page)
    assert task_of(page)["follower"]["offset"] == -10
    assert page.locator("[aria-invalid='true']").count() == 0
    assert page.locator(OFFSET).input_value() == "−10"


def test_what_is_no_number_is_refused_at_once(page):
    typed(page, OFFSET, "left")
    assert page.locator(OFFSET).input_value() == "left"
    assert page.locator(".error:visible").inner_text() == "This is not a number."
    assert task_of(page)["follower"]["offset"] == -10
    page.locator(OFFSET).press("Escape")
    assert page.locator(OFFSET).input_value() == "−10"


def test_an_error_without_a_field_is_in_the_line_under_the_drawing(opened, served):
    page = opened()

    def refused(request):
        error = {"field": "somewhere else", "message": "no cam is drawn today", "remedy": "come tomorrow"}
        return {"seq": request.get("seq"), "ok": False, "error": error}

    served.answering = refused
    page.evaluate("() => studio.change({ 'follower.offset': -5 })")
    page.wait_for_function("() => document.body.classList.contains('stale')")
    assert page.locator("#told-limits").inner_text() == "no cam is drawn today; come tomorrow"


def test_a_file_that_is_no_task_is_refused_and_a_good_one_opened(opened, served):
    page = opened()
    task = {"task": {**task_of(page), "follower": {"kind": "translating", "offset": 3}}}

    def answering(request):
        if request["ask"] != "open":
            return served_before(request)
        if "[" in request["text"]:
            return {"seq": request["seq"], "ok": True, **task}
        return {"seq": request["seq"], "ok": False, "error": {"field": "", "message": "this is no task", "remedy": ""}}

    served_before, served.answering = served.answering, answering
    page.locator("#file").set_input_files({"name": "a.toml", "mimeType": "text/plain", "buffer": b"nothing"})
    page.wait_for_function("() => document.getElementById('written').textContent === 'this is no task'")
    page.locator("#file").set_input_files({"name": "b.toml", "mimeType": "text/plain", "buffer": b"[follower]"})
    page.wait_for_function("() => studio.state.get().task.follower.offset === 3")
    settled(page)
    assert page.locator("#written").inner_text() == "b.toml"
    assert page.evaluate("() => studio.state.past()") == 1


def test_a_border_that_is_refused_from_the_drawing_is_red_in_the_bar(opened):
    """A knob of a diagram moves borders too: the message stands under the bar, and the border that was moved is red."""
    page = opened()
    page.evaluate("() => studio.change({ 'motion.phases[1].angle': 500, 'motion.phases[2].angle': -395 })")
    page.wait_for_selector("#phases-error:visible")
    red = "() => [...document.querySelectorAll('#form [aria-invalid]')].map((input) => input.dataset.key)"
    assert page.evaluate(red) == ["border/1"]
    page.click("#undo")
    settled(page)
    assert page.evaluate(red) == []
