"""What the engine is asked in turns: one question at a time, the newest waits, stale answers are dropped."""

from __future__ import annotations

import pytest
from studio_pages import settled, task_of

pytestmark = pytest.mark.slow

# An engine that answers when it is told to.
SLOW = """() => {
    window.waiting = [];
    const ask = (request) => new Promise((done) => waiting.push({ request, done }));
    window.queue = queueOf(ask);
    window.done = [];
    window.picture = (name) => queue.picture(() => ({ name }), (answer) => done.push(answer.name));
}"""
ANSWER = """async () => { const { request, done: tell } = waiting.shift(); tell({ ...request, ok: true });
    await new Promise((done) => setTimeout(done)); }"""


def test_of_many_pictures_one_is_asked_and_the_newest_waits(opened):
    page = opened()
    page.evaluate(SLOW)
    page.evaluate("() => { for (let k = 0; k < 1000; k += 1) picture(k); }")
    assert page.evaluate("() => [waiting.length, queue.waiting()]") == [1, 1]
    page.evaluate(ANSWER)
    page.evaluate(ANSWER)
    assert page.evaluate("() => done") == [0, 999]
    assert page.evaluate("() => [waiting.length, queue.waiting(), queue.busy()]") == [0, 0, False]


def test_an_answer_older_than_what_is_shown_is_dropped(opened):
    page = opened()
    page.evaluate(SLOW)
    page.evaluate("() => { picture('first'); }")
    page.evaluate(ANSWER)
    page.evaluate("() => { picture('second'); picture('third'); }")
    # A wire that repeats what it brought before.
    page.evaluate(ANSWER.replace("...request, ok: true", 'name: "stale", ok: true, seq: 0'))
    page.evaluate(ANSWER)
    assert page.evaluate("() => done") == ["first", "third"]


def test_other_questions_wait_until_no_picture_is_due(opened):
    page = opened()
    page.evaluate(SLOW)
    page.evaluate("""() => { picture("one"); queue.question({ name: "aside" }).then((answer) => done.push(answer.name));
        picture("two"); }""")
    for _ in range(3):
        page.evaluate(ANSWER)
    assert page.evaluate("() => done") == ["one", "two", "aside"]


def test_a_lost_engine_is_told_and_the_state_is_in_the_address(opened):
    page = opened()

    page.evaluate("() => { window.fetch = () => Promise.reject(new Error('gone')); }")
    page.evaluate("() => studio.change({ 'follower.offset': -5 })")
    page.wait_for_selector("#notice:not([hidden])")
    assert page.locator("#notice button").inner_text() == "Start again"
    page.wait_for_timeout(300)
    page.reload()
    settled(page)
    assert task_of(page)["follower"]["offset"] == -5


def test_a_slider_that_is_dragged_shows_its_last_value(opened, served):
    page = opened()
    slider = page.locator("[data-key='follower.offset/range']")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box
    y = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + 0.4 * box["width"], y)
    page.mouse.down()
    for k in range(60):
        page.mouse.move(box["x"] + (0.4 + 0.003 * k) * box["width"], y)
    page.mouse.up()
    settled(page)
    offset = task_of(page)["follower"]["offset"]
    assert offset > -5
    assert page.evaluate("() => studio.shown.sizes.offset") == offset
    assert served.pictures()[-1]["told"]
    assert page.evaluate("() => studio.state.past()") == 1
