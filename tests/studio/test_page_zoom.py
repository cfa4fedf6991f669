"""A detail of the drawing, chosen with the wheel, the fingers or keys; it stays while a size is moved."""

from __future__ import annotations

import pytest
from studio_pages import frame_of, hand, middle, settled, task_of

pytestmark = pytest.mark.slow
PLACE = 500, 420


LETTERS = 0.01
"""The part by which a frame may differ from what it was: letters of another size reach farther out of a drawing."""


def frame(page) -> tuple[float, float, float, float]:
    left, top, wide, high = map(float, frame_of(page).split())
    return left, top, wide, high


def under(page, x: float, y: float) -> list[float]:
    """What of the drawing stands at a place of the window [mm]."""
    return page.evaluate("([x, y]) => studio.stage.toDrawing(x, y)", [x, y])


def test_the_wheel_brings_closer_what_stands_under_the_pointer(opened):
    page = opened()
    page.locator("#view-combined").click()
    settled(page)
    whole, before = frame(page), under(page, *PLACE)
    page.mouse.move(*PLACE)
    page.mouse.wheel(0, -400)
    page.wait_for_function("() => document.querySelector('#stage').classList.contains('detailed')")
    assert frame(page)[2] == pytest.approx(whole[2] / 2.718281828)
    assert under(page, *PLACE) == pytest.approx(before, abs=1e-6)
    page.mouse.down()
    page.mouse.move(PLACE[0] + 60, PLACE[1] - 40, steps=4)
    page.mouse.up()
    assert under(page, PLACE[0] + 60, PLACE[1] - 40) == pytest.approx(before, abs=1e-6)
    page.mouse.wheel(0, 1000)
    page.wait_for_function("() => !document.querySelector('#stage').classList.contains('detailed')")
    assert frame(page) == pytest.approx(whole)
    # All of it is not dragged away.
    page.mouse.down()
    page.mouse.move(*PLACE, steps=3)
    page.mouse.up()
    assert frame(page) == pytest.approx(whole)


def test_no_detail_lies_beside_the_drawing_or_is_closer_than_twenty_times(opened):
    page = opened()
    page.locator("#view-profile").click()
    settled(page)
    left, _, wide, _ = page.evaluate("() => studio.stage.whole()")
    for _ in range(30):
        page.locator("#closer").click()
    assert frame(page)[2] == pytest.approx(wide / 20, rel=LETTERS)
    page.evaluate("() => studio.stage.shift({ x: 1000, y: 0 })")
    x, _, w, _ = frame(page)
    assert x + w / 2 == pytest.approx(left, rel=LETTERS)
    page.keyboard.press("0")
    settled(page)
    assert frame(page) == pytest.approx(page.evaluate("() => studio.stage.whole()"))


def dragged_to(page, name: str, mm: tuple[float, float]):
    """The task after a handle was dragged to a place of the drawing, and then undone again."""
    x, y = page.evaluate("at => studio.stage.toScreen(at)", list(mm))
    stage = page.locator("#stage").bounding_box()
    page.mouse.move(*middle(hand(page, name)))
    page.mouse.down()
    page.mouse.move(stage["x"] + x, stage["y"] + y, steps=6)
    page.mouse.up()
    settled(page)
    found = task_of(page)
    page.keyboard.press("Control+z")
    settled(page)
    return found


def test_a_handle_dragged_to_a_place_does_the_same_in_a_detail_which_stays(opened):
    page = opened()
    page.locator("#view-combined").click()
    settled(page)
    before = task_of(page)
    x, y = under(page, *middle(hand(page, "combined/A")))
    place = x - 4, y + 6
    in_whole = dragged_to(page, "combined/A", place)
    page.evaluate("([x, y]) => studio.stage.zoomAbout(2, { x, y })", [x, y])
    detail = frame(page)
    assert dragged_to(page, "combined/A", place) == in_whole != before
    assert frame(page) == detail


def test_plus_and_minus_are_keys_and_other_views_stay_whole(opened):
    page = opened()
    page.locator("#view-combined").click()
    settled(page)
    whole = frame(page)
    page.keyboard.press("+")
    page.keyboard.press("+")
    assert frame(page)[2] == pytest.approx(whole[2] / 1.25**2)
    page.locator("#view-profile").click()
    settled(page)
    other = frame(page)
    page.locator("#view-combined").click()
    settled(page)
    assert frame(page)[2] == pytest.approx(whole[2] / 1.25**2)
    page.keyboard.press("-")
    page.keyboard.press("-")
    page.keyboard.press("-")
    assert frame(page) == pytest.approx(whole, rel=LETTERS)
    page.locator("#view-profile").click()
    settled(page)
    assert frame(page) == pytest.approx(other, rel=LETTERS)


def test_two_fingers_bring_closer_and_the_page_does_not_scroll(opened):
    page = opened(wide=390, high=844, has_touch=True, is_mobile=True)
    page.locator("#view-combined").click()
    settled(page)
    whole = frame(page)
    session = page.context.new_cdp_session(page)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})

    touch("touchStart", (180, 200), (200, 200))
    for far in range(10, 60, 10):
        touch("touchMove", (180 - far, 200), (200 + far, 200))
    touch("touchEnd")
    assert frame(page)[2] < whole[2] / 2
    assert page.evaluate("() => [scrollX, scrollY, visualViewport.scale]") == [0, 0, 1]
