"""A handle that is dragged: the picture follows and stays in its place, and the drag is one entry of undo."""

from __future__ import annotations

import json

import pytest
from studio_pages import frame_of, hand, in_hash, middle, settled, task_of

pytestmark = pytest.mark.slow

DIAGRAMS = "acceleration", "velocity", "displacement", "angle"
MOVES = 40


def drag(page, name: str, by: tuple[float, float], moves: int = MOVES, each=lambda: None) -> None:
    """Take hold of a handle and move it in steps; the hand stays down."""
    x, y = middle(hand(page, name))
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, moves + 1):
        page.mouse.move(x + by[0] * k / moves, y + by[1] * k / moves)
        each()


def place_of(page, name: str) -> list[float]:
    """Where a handle lies in the drawing [mm], y downwards."""
    return page.evaluate("name => studio.shown.handles.find((one) => one.id === name).at", name)


def test_a_drag_is_one_entry_and_the_frame_stays(opened):
    page = opened()
    before, frames = task_of(page), set()
    drag(page, "combined/A", (-45, 60), each=lambda: frames.add(frame_of(page)))
    assert len(frames) == 1
    page.mouse.up()
    settled(page)
    after = task_of(page)
    assert after["follower"]["offset"] > before["follower"]["offset"]
    assert after["cam"]["prime_radius"] > 44
    assert page.evaluate("() => studio.state.past()") == 1
    offset, radius = after["follower"]["offset"], after["cam"]["prime_radius"]
    assert in_hash(page)["d"] == {"follower.offset": offset, "cam.prime_radius": radius}
    page.keyboard.press("Control+z")
    settled(page)
    assert task_of(page) == before
    page.keyboard.press("Control+Shift+z")
    settled(page)
    assert task_of(page) == after


def test_the_place_of_release_is_what_is_shown(opened, served):
    page = opened()
    drag(page, "combined/A", (-30, 40))
    page.mouse.up()
    settled(page)
    last = [each for each in served.pictures() if each.get("drag") and each["told"]]
    assert len(last) == 1
    sizes = page.evaluate("() => studio.shown.sizes")
    assert sizes["offset"] == task_of(page)["follower"]["offset"]
    assert sizes["prime_radius"] == task_of(page)["cam"]["prime_radius"]
    # Where the hand let go, but for the steps of the sizes and their magnets.
    assert place_of(page, "combined/A") == pytest.approx(last[0]["drag"]["to"], abs=2.5)


def test_where_the_place_of_release_is_refused_the_last_good_picture_is_told_whole(opened):
    """What the hand made of it before is the state, though it was drawn without its words and values."""
    page = opened()
    drag(page, "combined/A", (-30, 40))
    page.wait_for_function("() => studio.quiet() && !document.querySelector('#steps [data-act]')")

    def answered(route):
        asked = json.loads(route.request.post_data)
        error = {"quantity": "prime radius", "message": "too flat", "remedy": "", "fields": []}
        refused = {"ok": False, "error": error}
        if asked.get("told") and asked.get("drag"):
            route.fulfill(status=200, content_type="application/json", body=json.dumps(refused))
        else:
            route.continue_()

    page.route("**/engine", answered)
    page.mouse.up()
    settled(page)
    page.unroute("**/engine")
    assert page.evaluate("() => document.querySelectorAll('#steps [data-act]').length") > 0
    sizes = page.evaluate("() => studio.shown.sizes")
    assert sizes["prime_radius"] == task_of(page)["cam"]["prime_radius"]
    assert "too flat" in page.locator("#told-limits").inner_text()


def test_escape_gives_the_old_sizes_back(opened):
    page = opened()
    before, place = task_of(page), middle(hand(page, "combined/A"))
    drag(page, "combined/A", (-40, 50))
    page.wait_for_function("() => studio.state.get().task.cam?.prime_radius > 44")
    page.keyboard.press("Escape")
    page.mouse.up()
    settled(page)
    assert task_of(page) == before
    assert page.evaluate("() => studio.state.past()") == 0
    assert middle(hand(page, "combined/A")) == pytest.approx(place, abs=0.5)


def test_a_click_on_a_handle_changes_nothing(opened):
    page = opened()
    before = task_of(page)
    page.mouse.click(*middle(hand(page, "combined/A")))
    settled(page)
    assert task_of(page) == before
    assert page.evaluate("() => studio.state.past()") == 0


def test_while_the_hand_is_down_only_both_panes_are_drawn_and_nothing_is_told(opened, served):
    page = opened()
    served.asked.clear()
    drag(page, "combined/tangent rise", (20, 0))
    held = list(served.asked)
    assert held
    assert {view["name"] for each in held for view in each["views"]} == {"combined", *DIAGRAMS}
    assert not any(each["told"] or each["form"] or each["values"] for each in held)
    assert all(each["hold"] for each in held)
    page.mouse.up()
    settled(page)


def test_a_drag_by_touch_moves_the_size_and_not_the_page(opened):
    page = opened(wide=390, high=844, has_touch=True)
    x, y = middle(hand(page, "combined/A"))
    wire = page.context.new_cdp_session(page)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        wire.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})

    touch("touchStart", (x, y))
    for k in range(1, 11):
        touch("touchMove", (x - 2 * k, y + 3 * k))
    touch("touchEnd")
    settled(page)
    assert task_of(page)["cam"]["prime_radius"] > 44
    assert page.evaluate("() => [scrollX, scrollY]") == [0, 0]


def test_the_cam_is_turned_by_hand(opened):
    page = opened()
    page.locator("#view-mechanism").click()
    settled(page)
    x, y = middle(hand(page, "mechanism/phi"))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y + 60, steps=10)
    page.mouse.up()
    settled(page)
    phi = page.evaluate("() => studio.state.get().phi")
    assert phi != 30
    # A clockwise cam turns by the angle that is told.
    assert page.locator("#scene .cam").get_attribute("transform") == f"rotate({-phi:g})"
    assert page.evaluate("() => studio.state.past()") == 0


def test_keys_move_a_handle_along_the_screen(opened):
    page = opened()
    page.evaluate("() => document.querySelector(\".hand[data-id='combined/A'] input\").focus()")
    x, _ = place_of(page, "combined/A")
    for _ in range(4):
        page.keyboard.press("ArrowRight")
    settled(page)
    # To the right on the screen is a smaller offset here; four keys in a row are one entry.
    assert task_of(page)["follower"]["offset"] == -12
    assert page.evaluate("() => studio.state.past()") == 1
    right, _ = place_of(page, "combined/A")
    assert right > x
    low, radius = place_of(page, "combined/A")[1], page.evaluate("() => studio.shown.sizes.prime_radius")
    page.keyboard.press("ArrowDown")
    settled(page)
    assert task_of(page)["cam"]["prime_radius"] == radius + 0.5
    assert page.evaluate("() => document.activeElement.dataset.axis") == "1"
    assert place_of(page, "combined/A")[1] > low
    page.keyboard.press("Shift+ArrowDown")
    settled(page)
    assert task_of(page)["cam"]["prime_radius"] == pytest.approx(radius + 0.6)


def test_a_number_is_typed_at_a_handle(opened):
    page = opened()
    hand(page, "combined/A").dblclick()
    fields = page.locator("#typed input")
    assert fields.count() == 2
    fields.first.fill("-7,5")
    page.keyboard.press("Enter")
    settled(page)
    assert task_of(page)["follower"]["offset"] == -7.5
    assert task_of(page)["cam"] == {}


def test_the_live_region_speaks_once_on_release(opened):
    page = opened()
    page.evaluate("""() => { window.heard = []; new MutationObserver(() =>
        heard.push(document.getElementById("announcement").textContent)).observe(document.getElementById("announcement"),
        { childList: true, characterData: true, subtree: true }); }""")
    drag(page, "combined/A", (-20, 30))
    assert page.evaluate("() => heard") == []
    page.mouse.up()
    settled(page)
    (heard,) = page.evaluate("() => heard")
    assert heard.startswith(f"Offset e {str(task_of(page)['follower']['offset']).replace('-', '−')} mm")


# --- what ends where it began is let go -------------------------------------------------------------------------------

SLIDER, BORDER = '[data-key="follower.offset/range"]', '[data-border="0"]'


def is_held(page) -> bool:
    return page.evaluate("() => document.body.classList.contains('held')")


def begun(page, control: str) -> tuple[float, float]:
    """Press the pointer where a control stands, and move it away."""
    knob = page.locator(control)
    knob.scroll_into_view_if_needed()
    box = knob.bounding_box()
    share = 0.5
    if control == SLIDER:
        share = knob.evaluate("one => (one.value - one.min) / (one.max - one.min)")
    inset = 8 if control == SLIDER else 0
    x, y = box["x"] + inset + (box["width"] - 2 * inset) * share, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y, steps=5)
    page.wait_for_timeout(100)
    assert is_held(page)
    return x, y


def still_works(page) -> None:
    """Whether nothing is held, and a change by the form arrives."""
    settled(page)
    assert not is_held(page)
    past = page.evaluate("() => studio.state.past()")
    field = page.locator('input[data-key="follower.offset"]')
    field.fill("-25")
    field.press("Enter")
    settled(page)
    assert task_of(page)["follower"]["offset"] == -25
    assert page.evaluate("() => studio.state.past()") == past + 1


@pytest.mark.parametrize("control", [SLIDER, BORDER])
def test_what_is_moved_out_and_back_is_let_go(opened, control):
    page = opened()
    before = task_of(page)
    x, y = begun(page, control)
    page.mouse.move(x, y, steps=5)
    page.wait_for_timeout(100)
    page.mouse.up()
    settled(page)
    if control == SLIDER:
        assert task_of(page) == before
        assert page.evaluate("() => studio.state.past()") == 0
    still_works(page)


def test_a_handle_moved_out_and_back_is_let_go(opened):
    page = opened()
    before, start = task_of(page), middle(hand(page, "combined/A"))
    drag(page, "combined/A", (-30, 40))
    page.mouse.move(*start)
    page.mouse.up()
    # The radius that was found is given now.
    settled(page)
    radius = task_of(page)["cam"].pop("prime_radius")
    assert task_of(page) | {"cam": {}} == before
    assert radius == pytest.approx(43, abs=0.5)
    assert page.evaluate("() => studio.state.past()") == 1
    still_works(page)


def test_a_slider_whose_pointer_is_taken_away_is_let_go(opened):
    page = opened()
    begun(page, SLIDER)
    page.evaluate("() => dispatchEvent(new PointerEvent('pointercancel'))")
    page.wait_for_timeout(50)
    assert not is_held(page)
    page.mouse.up()
    settled(page)


def test_a_slider_that_is_moved_is_one_entry(opened):
    page = opened()
    before = task_of(page)["follower"]["offset"]
    x, y = begun(page, SLIDER)
    # A key that has nothing to do with it does not end the drag.
    page.keyboard.press("Shift")
    page.mouse.move(x + 45, y, steps=5)
    page.mouse.up()
    settled(page)
    assert task_of(page)["follower"]["offset"] != before
    assert page.evaluate("() => studio.state.past()") == 1


def test_of_knobs_that_cover_each_other_the_nearest_is_taken(opened):
    """Two borders of phases that lie a few degrees apart, each taken on its own side."""
    page = opened("arm", config={"opening": "mechanism"}, reduced_motion="reduce")
    places = {
        name: middle(page.locator(f"#hands-beside .hand[data-id='displacement/border {name}']")) for name in (1, 2)
    }
    (left, height), (right, _) = sorted(places.values())
    assert right - left < 22  # less than a knob is wide
    angles = [phase["angle"] for phase in task_of(page)["motion"]["phases"]]
    for k, x in enumerate((left - 4, right + 4)):
        page.mouse.move(x, height)
        page.mouse.down()
        page.mouse.move(x + (-12, 12)[k], height, steps=3)
        page.mouse.up()
        settled(page)
        now = [phase["angle"] for phase in task_of(page)["motion"]["phases"]]
        changed = [j for j, (old, new) in enumerate(zip(angles, now, strict=True)) if old != new]
        assert changed == [k, k + 1]
        page.click("#undo")
        settled(page)
