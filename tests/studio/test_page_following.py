"""Between two answers of the engine the drawing follows the hand in the page, near to what the engine will draw."""

from __future__ import annotations

import re
import threading
from typing import Any

import numpy as np
import pytest
from studio_pages import middle, settled, task_of

from graphcam.studio.engine import answer

pytestmark = pytest.mark.slow

SLIDE = """(value) => {
  const slider = document.querySelector("[data-key='follower.offset/range']");
  slider.value = value;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""
FRAMES = "async () => { for (let k = 0; k < 3; k += 1) await new Promise((done) => requestAnimationFrame(done)); }"
LINES = """() => [...document.querySelectorAll("#steps > g path")].map((path) =>
    [path.getAttribute("class"), path.getAttribute("d")])"""
FOLLOWING = "line result", "line curve", "line limit", "opaque result", "opaque limit"
"""The lines for which a view is drawn."""
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def places(lines: list[list[str]]) -> np.ndarray:
    """The places of the lines for which the view is drawn, in their order [mm]."""
    return np.array([float(each) for kind, line in lines if kind in FOLLOWING for each in NUMBER.findall(line)])


def lines_of(view: dict[str, Any]) -> list[list[str]]:
    """The lines of an answer, in the order of its steps."""
    svg = "".join(view["steps"][name]["svg"] for name in view["order"])
    return [list(found) for found in re.findall(r'<path class="([^"]*)"[^>]* d="([^"]*)"', svg)]


def take_hold(page) -> None:
    """The offset's slider is held and moved, with two answers of the engine."""
    page.evaluate("() => dispatchEvent(new PointerEvent('pointerdown'))")
    for offset in (-9.0, -8.5):
        page.evaluate(SLIDE, offset)
        page.wait_for_function("() => studio.quiet()")


@pytest.fixture
def held(served):
    """Lets the engine answer or not."""
    going = threading.Event()
    going.set()

    def answered(request):
        going.wait(20)
        return answer(request)

    def begin():
        served.answering = answered
        return going

    yield begin
    going.set()


@pytest.mark.parametrize("view", ["combined", "profile"])
def test_the_drawing_goes_on_to_where_the_engine_will_draw_it(opened, served, held, view):
    page = opened()
    page.locator(f"#view-{view}").click()
    settled(page)
    going = held()
    take_hold(page)
    before = places(page.evaluate(LINES))
    going.clear()
    page.evaluate(SLIDE, -8.0)
    page.evaluate(FRAMES)
    shown, here = places(page.evaluate(LINES)), served.asked[-1]["views"][0]
    (drawn,) = answer(served.asked[-1] | {"views": [{**here, "have": {}}]})["views"]
    wanted = places(lines_of(drawn))
    # The line through the last two answers comes ten times as near to the engine's drawing as the last answer is.
    assert np.abs(before - wanted).max() > 0.5
    assert np.abs(shown - wanted).max() < 0.1 * np.abs(before - wanted).max()
    assert page.evaluate("() => studio.shown.sizes.offset") == -8.5
    going.set()
    page.evaluate("() => dispatchEvent(new PointerEvent('pointerup'))")
    settled(page)
    assert task_of(page)["follower"]["offset"] == -8.0
    (drawn,) = answer(served.pictures()[-1] | {"views": [{**here, "have": {}}]})["views"]
    assert page.evaluate(LINES) == lines_of(drawn)


def test_a_knob_is_under_the_pointer_before_the_engine_has_answered(opened, held):
    page = opened()
    knob = page.locator(".hand[data-id='combined/A']")
    x, y = middle(knob)
    page.mouse.move(x, y)
    page.mouse.down()
    for k in (40, 60):
        page.mouse.move(x - k, y + k)
        page.wait_for_function("() => studio.quiet()")
    going = held()
    going.clear()
    page.mouse.move(x - 90, y + 90)
    page.evaluate(FRAMES)
    # But for the steps of the sizes.
    assert middle(knob) == pytest.approx((x - 90, y + 90), abs=4)
    going.set()
    page.mouse.up()
    settled(page)


def test_what_is_refused_stays_where_the_last_answer_drew_it(opened, served):
    page = opened()
    take_hold(page)
    before = places(page.evaluate(LINES))
    error = {"field": "follower.offset", "message": "too far", "remedy": ""}
    served.answering = lambda request: {"seq": request["seq"], "ok": False, "error": error}
    page.evaluate(SLIDE, -8.0)
    page.wait_for_function("() => studio.quiet() && document.body.classList.contains('stale')")
    page.evaluate(FRAMES)
    assert np.array_equal(places(page.evaluate(LINES)), before)
    page.evaluate("() => dispatchEvent(new PointerEvent('pointerup'))")


def test_another_view_is_asked_for_while_a_hand_is_down_that_has_not_moved(opened):
    page = opened()
    page.mouse.move(*middle(page.locator(".hand[data-id='combined/A']")))
    page.mouse.down()
    page.keyboard.press("7")
    page.wait_for_function("() => studio.quiet()")
    assert page.evaluate("() => studio.panes[0].names()") != ["combined"]
    page.mouse.up()
    settled(page)
    assert page.evaluate("() => studio.state.past()") == 0
