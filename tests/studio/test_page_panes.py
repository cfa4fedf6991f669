"""Two panes that belong together: what moves beside its diagrams, a construction beside that from which it is drawn."""

from __future__ import annotations

import math

import pytest
from studio_pages import hand, middle, settled, task_of
from studio_tasks import builtin, rebuilt

import graphcam as gc

pytestmark = pytest.mark.slow

OPENING = {"opening": "mechanism"}
VALUES = "() => [...document.querySelectorAll('#cursors-beside .reading')].map((text) => text.textContent)"
PHI = "() => studio.state.get().phi"
SPLIT = "() => document.getElementById('desk').dataset.split"


def beside(page) -> list[str]:
    """The views that stand in the second pane."""
    return page.evaluate(
        "() => [...new Set([...document.querySelectorAll('.strip .beside')].map((e) => e.dataset.open))]"
    )


def read_off(page) -> dict[str, float]:
    """What the diagrams say where the cursor stands, by the names of their views."""
    texts = [float(text.replace("−", "-").rstrip("°")) for text in page.evaluate(VALUES)]
    return dict(zip(beside(page), texts, strict=True))


def exact(task: gc.Task, phi: float) -> dict[str, float]:
    """The same of the exact motion."""
    cam = gc.solve(task).cam
    s, v, a, *_ = (float(value) for value in cam.motion(math.radians(phi)))
    angle = math.degrees(float(cam.pressure_angle(math.radians(phi))))
    return {"acceleration": a, "velocity": v, "displacement": s, "angle": angle}


def moved(page, name: str, right: float, down: float = 0.0) -> None:
    """A knob moved so many pixels, and not let go."""
    x, y = middle(hand(page, name))
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=6)


def test_the_page_opens_with_a_cam_that_turns_beside_its_diagrams(opened):
    page = opened(config=OPENING)
    assert page.locator("#view-mechanism").get_attribute("aria-selected") == "true"
    assert beside(page) == ["acceleration", "velocity", "displacement", "angle"]
    before, line = page.evaluate(PHI), page.locator("#cursors-beside .cursor")
    page.wait_for_function("before => Math.abs(studio.state.get().phi - before) > 5", arg=before)
    assert page.locator("#play").get_attribute("aria-label") == "Stop"
    # The cursor goes with the cam; it stands still when a knob is taken.
    first = line.get_attribute("d")
    page.wait_for_function(
        "first => document.querySelector('#cursors-beside .cursor').getAttribute('d') !== first", arg=first
    )
    page.locator("#play").click()
    settled(page)
    assert page.evaluate(PHI) % 0.5 == 0


def test_the_cam_stands_still_where_less_motion_or_an_angle_is_asked_for(opened):
    page = opened(config=OPENING, reduced_motion="reduce")
    page.wait_for_timeout(300)
    assert page.evaluate(PHI) == 30
    page.locator("#phi").fill("47")
    settled(page)
    page = opened(config=OPENING, at=page.evaluate("() => location.hash"))
    page.wait_for_timeout(300)
    assert page.evaluate(PHI) == 47


@pytest.mark.parametrize("name", ["coursework", "measured"])
def test_the_diagrams_say_what_the_motion_comes_to_at_the_cursor(opened, name):
    page = opened(name, config=OPENING, reduced_motion="reduce")
    for phi in (30, 62.5, 200):
        page.locator("#phi").fill(str(phi))
        settled(page)
        found, wanted = read_off(page), exact(builtin(name), phi)
        # Of a table the drawn acceleration is that of the smoothed table.
        for view in found:
            if (name, view) != ("measured", "acceleration"):
                assert found[view] == pytest.approx(wanted[view], rel=0.02, abs=0.6), (view, phi)


def test_a_size_that_is_moved_changes_both_panes(opened):
    page = opened(config=OPENING, reduced_motion="reduce")
    body = page.locator("#scene .body")
    cam, s = body.get_attribute("d"), read_off(page)["displacement"]
    moved(page, "displacement/lift", 0, -14)
    page.wait_for_function("cam => document.querySelector('#scene .body').getAttribute('d') !== cam", arg=cam)
    page.mouse.up()
    settled(page)
    task = rebuilt(task_of(page))
    assert task.motion.phases[0].lift > 30
    assert read_off(page)["displacement"] > s
    assert read_off(page)["displacement"] == pytest.approx(exact(task, 30)["displacement"], rel=0.01)


def test_a_border_is_dragged_where_the_diagrams_stand(opened):
    page = opened(config=OPENING, reduced_motion="reduce")
    degree = page.evaluate("() => studio.panes[1].stage.scale(studio.panes[1].stack) / studio.shown.degrees_per_mm")
    moved(page, "displacement/border 1", 10 * degree)
    page.mouse.up()
    settled(page)
    assert [phase["angle"] for phase in task_of(page)["motion"]["phases"]] == [90, 35, 60, 175]


def test_the_cursor_turns_the_cam_at_once_without_the_engine(opened, served):
    page = opened(config=OPENING, reduced_motion="reduce")
    served.asked.clear()
    moved(page, "acceleration/phi", 60)
    phi = page.evaluate(PHI)
    assert phi > 60
    assert page.locator("#scene .cam").get_attribute("transform") == f"rotate({-phi:g})"
    assert served.pictures() == []
    page.keyboard.press("Escape")
    page.mouse.up()
    settled(page)
    assert page.evaluate(PHI) == 30
    assert page.evaluate("() => studio.state.past()") == 0


def test_one_knob_stands_for_the_angle_and_none_covers_another(opened):
    page = opened(config=OPENING, reduced_motion="reduce")
    ids = page.evaluate("() => [...document.querySelectorAll('#hands-beside .hand')].map((hand) => hand.dataset.id)")
    assert [each for each in ids if each.endswith("/phi")] == ["acceleration/phi"]
    for name in ids:
        x, y = middle(hand(page, name))
        on_top = page.evaluate("([x, y]) => document.elementFromPoint(x, y).closest('.hand')?.dataset.id", [x, y])
        assert on_top == name


def test_a_construction_stands_beside_its_source_and_what_is_chosen_stays(opened):
    page = opened(reduced_motion="reduce")
    page.keyboard.press("3")
    settled(page)
    assert beside(page) == ["acceleration"]
    assert page.evaluate(SPLIT) == "rows"
    page.locator("#beside").select_option("profile")
    settled(page)
    page.keyboard.press("5")
    settled(page)
    assert (page.evaluate("() => studio.state.get().view"), beside(page)) == (None, ["profile"])
    assert page.locator("#steps-beside > g").count() == 11
    page.keyboard.press("b")
    settled(page)
    assert (beside(page), page.locator("#stage-beside").is_visible()) == ([], False)
    page.locator("#panes").click()
    settled(page)
    assert len(beside(page)) == 4


def test_panes_come_to_rest_where_each_arrangement_calls_for_the_other(opened):
    # In so low a window the letters of a diagram that is half as wide make it much smaller than it promised to be.
    page = opened(wide=1200, high=600, reduced_motion="reduce")
    page.evaluate("() => studio.open('velocity')")
    settled(page)
    page.evaluate(
        """() => { window.changes = 0; const counted = new MutationObserver(() => { window.changes += 1; });
        counted.observe(document.getElementById("desk"), { attributeFilter: ["data-split"] }); }"""
    )
    page.locator("#beside").select_option("profile")
    settled(page)
    assert page.evaluate("() => changes") <= 2
    assert page.evaluate(SPLIT) == "rows"


def test_the_pinned_cam_stands_behind_in_both_panes(opened):
    page = opened(config=OPENING, reduced_motion="reduce")
    page.keyboard.press("8")
    settled(page)
    page.keyboard.press("p")
    page.evaluate("() => studio.change({ 'motion.phases[0].angle': 90, 'motion.phases[1].angle': 35 })")
    settled(page)
    for pinned in ("#pinned", "#pinned-beside"):
        assert page.locator(f"{pinned} path").count() > 0
    # It has the scales and the places of the present one: both begin at the same height.
    down = "pane => [...document.querySelectorAll(`#${pane} > g`)].map((g) => g.getAttribute('transform'))"
    assert set(page.evaluate(down, "pinned-beside")) <= set(page.evaluate(down, "steps-beside"))


def test_on_a_phone_one_pane_stands_above_the_other(opened):
    page = opened(wide=390, high=844, config=OPENING, reduced_motion="reduce")
    above, below = (page.locator(f"#canvas{suffix}").bounding_box() for suffix in ("", "-beside"))
    assert above
    assert below
    assert above["y"] + above["height"] <= below["y"]
    assert min(above["width"], below["width"]) > 360
    # What is too high is looked at from its top, as wide as the window.
    frame = page.evaluate("() => studio.panes[1].stage.frame()")
    assert frame[2] == pytest.approx(page.evaluate("() => studio.panes[1].stage.whole()")[2], rel=0.02)
    sizes = page.evaluate(
        """() => [...document.querySelectorAll("#canvas-beside text")].map((text) =>
        parseFloat(getComputedStyle(text).fontSize) * document.querySelector("#drawing-beside").getScreenCTM().a)"""
    )
    assert min(sizes) >= 7


@pytest.mark.parametrize("mode", ["predict", "tour"])
def test_no_other_pane_tells_what_is_asked(opened, mode):
    page = opened(config=OPENING, reduced_motion="reduce")
    page.locator(f"[data-mode={mode}]").click()
    settled(page)
    if mode == "predict":
        assert beside(page) == []
    page.locator("[data-mode=play]").click()
    settled(page)
    page.evaluate("() => studio.open('mechanism')")
    settled(page)
    assert len(beside(page)) == 4


COVERED = """() => {
  const boxes = (at) => [...document.querySelectorAll(at)].map((text) => text.getBoundingClientRect());
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  const taken = boxes("#steps-beside text");
  return boxes("#cursors-beside .reading").filter((own) => taken.some((box) => meet(own, box))).length;
}"""


@pytest.mark.parametrize(("wide", "high"), [(390, 844), (1440, 900)])
def test_what_is_read_at_the_cursor_covers_no_letters(opened, wide, high):
    page = opened(wide=wide, high=high, config=OPENING, reduced_motion="reduce")
    assert page.evaluate(COVERED) == 0


def test_on_a_phone_no_diagram_is_cut(opened):
    page = opened(wide=390, high=844, config=OPENING, reduced_motion="reduce")
    bottom = page.evaluate("() => document.getElementById('canvas-beside').getBoundingClientRect().bottom")
    curves = page.evaluate(
        "() => [...document.querySelectorAll('#steps-beside .line.result')].map((line) => line.getBoundingClientRect())"
        ".map(({ top, bottom }) => [top, bottom])"
    )
    assert [top < bottom < end for top, end in curves].count(True) == 0
    assert sum(end <= bottom for _, end in curves) >= 2


def test_a_drawing_of_which_nothing_is_found_is_an_answer(opened):
    page, task = opened(), gc.builtin_arcs_task().to_dict()
    task["arcs"] |= {"A": [-3.0, 36.0]}
    del task["arcs"]["C2"]
    page.evaluate("task => studio.load(task, 'arcs')", task)
    settled(page)
    assert page.evaluate("() => studio.shown.error") is None
    assert "C₂ cannot be read" in page.locator("#panel-step").inner_text()


BANDS = """() => [...document.querySelectorAll("#scene .band")].map((band) =>
    [band.classList[1], parseFloat(band.style.getPropertyValue("--depth")), band.getTotalLength()])"""


@pytest.mark.parametrize(("name", "sharpest"), [("arcs", "17 mm"), ("coursework", "12.7 mm")])
def test_the_profile_is_coloured_by_its_curvature_with_a_bar(opened, name, sharpest):
    page = opened(name, config=OPENING, reduced_motion="reduce")
    assert page.evaluate(BANDS) == []
    page.locator("#colour").select_option("curvature_radius")
    settled(page)
    bands, ends = page.evaluate(BANDS), page.locator(".colour-bar span").all_inner_texts()
    assert ends[1] == sharpest
    # A cam of arcs is nowhere hollow, and has as many depths as radii.
    kinds, straight = {kind for kind, depth, _ in bands if depth}, ends[0] == "straight"
    assert (kinds == {"sharp"}) == straight
    assert straight == (name == "arcs")
    of_arcs = {depth for _, depth, _ in bands}
    assert name != "arcs" or len(of_arcs) <= 6
    around = page.evaluate("() => document.querySelector('#scene .body').getTotalLength()")
    assert sum(length for *_, length in bands) == pytest.approx(around, rel=2e-3)
    page.reload()
    settled(page)
    assert page.evaluate(BANDS) == bands


def test_the_profile_is_coloured_by_the_pressure_angle_where_there_is_one(opened):
    page = opened("flat", config=OPENING, reduced_motion="reduce")
    assert page.locator("#colour option").evaluate_all("(all) => all.map((one) => one.value)") == [
        "",
        "curvature_radius",
    ]
    page = opened(config=OPENING, reduced_motion="reduce")
    page.locator("#colour").select_option("pressure_angle")
    settled(page)
    found = gc.solve(gc.builtin_task()).cam.extremes()
    steepest = max(abs(found.pressure_angle_rise[0]), abs(found.pressure_angle_return[0]))
    assert page.locator(".colour-bar span").all_inner_texts() == ["0°", f"{math.degrees(steepest):.3g}°"]
