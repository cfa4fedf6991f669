"""The state in the address: what differs from the built-in task, in letters that come back as they were."""

from __future__ import annotations

import random

import pytest
from studio_pages import in_hash, settled, task_of
from studio_tasks import BUILT_IN, plain_task

pytestmark = pytest.mark.slow

TEXTS = (
    "#counter",
    "#drawing-title",
    "#drawing-title-beside",
    "#sweep-size option:checked",
    "#panel-step [aria-current]",
)
SEEN = f"() => {list(TEXTS)}.map((found) => document.querySelector(found)?.textContent)"
BACK = """async (state) => { const { write, read } = addressOf(studio.config);
    const found = await read(await write({ view: null, step: null, phi: 30, mode: "play", pin: null, ...state }));
    return found; }"""


SHOWN = {
    "view": "plan",
    "beside": "",
    "step": "plan/α",
    "part": 0,
    "station": 4,
    "phi": 77.5,
    "mode": "tour",
    "panel": "what-if",
    "swept": "follower.offset",
    "exercise": {"k": [1]},
}


def changed(task, numbers: random.Random):
    """A task with other numbers in it, with keys taken away and added."""
    if isinstance(task, dict):
        kept = {key: changed(value, numbers) for key, value in task.items() if numbers.random() > 0.1}
        return kept | ({"more": numbers.choice(["φ", -1.5, [1, 2], {"deep": "er"}])} if numbers.random() < 0.2 else {})
    if isinstance(task, list):
        return [changed(value, numbers) for value in task[: numbers.randint(1, len(task))]] if task else task
    return round(numbers.uniform(-99, 99), 3) if isinstance(task, int | float) and numbers.random() < 0.5 else task


@pytest.mark.parametrize("seed", range(3))
def test_any_task_comes_back_out_of_its_address(opened, seed):
    page, numbers = opened(), random.Random(seed)
    for k in range(40):
        name = BUILT_IN[k % len(BUILT_IN)]
        # A measured table differs in too much for an address.
        task = plain_task(name) if name == "measured" else changed(plain_task(name), numbers)
        found = page.evaluate(BACK, {"name": name, "task": task, "pin": task, **SHOWN})
        assert found["task"] == found["pin"] == task
        assert found == {"name": name, "task": task, "pin": task, **SHOWN}


def test_only_what_differs_is_in_the_address(opened):
    page = opened()
    assert in_hash(page) == {"b": "coursework"}
    page.keyboard.press("8")
    page.evaluate(
        "() => studio.change({ 'motion.phases[0].angle': 90, 'motion.phases[1].angle': 35, 'follower.offset': null })"
    )
    settled(page)
    differs = {"motion.phases[0].angle": 90, "motion.phases[1].angle": 35, "follower.offset": None}
    assert in_hash(page) == {"b": "coursework", "d": differs, "v": "profile"}


def test_an_address_shows_both_panes_the_part_and_what_if(opened):
    page = opened(config={"opening": "mechanism"}, reduced_motion="reduce")
    assert in_hash(page) == {"b": "coursework", "v": "mechanism"}
    page.keyboard.press("3")
    page.locator("#beside").select_option("profile")
    page.locator("#next").focus()
    page.keyboard.press("Home")
    page.keyboard.press("ArrowRight")
    page.locator("#tab-what-if").click()
    page.locator("#sweep-size").select_option("limits.pressure_angle_rise")
    settled(page)
    said, shown = in_hash(page), page.evaluate(SEEN)
    assert (said["v"], said["w"], said["o"], said["f"]) == (
        *("velocity", "profile", "what-if", "limits.pressure_angle_rise"),
    )
    address = page.url
    page.goto("about:blank")
    page.goto(address)
    settled(page)
    assert page.evaluate(SEEN) == shown
    assert in_hash(page) == said


def test_an_address_of_before_opens_the_construction_that_it_opened(opened):
    page = opened(config={"opening": "mechanism"}, at="#1.q1ZKUrJSSs4vLSpOLc8vylaqBQA")
    assert page.locator("#view-combined").get_attribute("aria-selected") == "true"


def test_an_address_shows_its_state_and_makes_no_entries_in_the_history(opened, served):
    page = opened()
    page.keyboard.press("8")
    page.keyboard.press("ArrowLeft")
    page.evaluate("() => studio.change({ 'follower.offset': -6 })")
    page.keyboard.press("p")
    settled(page)
    said, step, entries = page.url, page.locator("#counter").inner_text(), page.evaluate("() => history.length")
    page.evaluate("() => studio.change({ 'follower.offset': -4 })")
    settled(page)
    assert page.evaluate("() => history.length") == entries
    page.goto("about:blank")
    page.goto(said)
    settled(page)
    assert task_of(page)["follower"]["offset"] == -6
    assert page.locator("#view-profile").get_attribute("aria-selected") == "true"
    assert page.locator("#counter").inner_text() == step
    assert page.locator("#pin").get_attribute("aria-pressed") == "true"


def test_a_token_is_taken_out_of_the_address_and_the_state_behind_it_kept(opened):
    page = opened()
    page.evaluate("() => studio.change({ 'follower.offset': -6 })")
    settled(page)
    state = page.evaluate("() => location.hash").removeprefix("#")
    page = opened(at=f"#t=secret&{state}")
    assert "secret" not in page.url
    assert page.evaluate("() => localStorage.token") == "secret"
    assert task_of(page)["follower"]["offset"] == -6


@pytest.mark.parametrize("said", ["#1.", "#1.nonsense!", "#2.abc", "#1.q1ZKUrJSSs4v", "#station"])
def test_an_address_that_says_nothing_shows_the_task_of_the_page(opened, said):
    page = opened(at=said)
    assert task_of(page)["follower"]["offset"] == -10


def test_unknown_keys_are_passed_over(opened):
    page = opened()
    letters = page.evaluate(
        "async () => `#1.${await packed({ b: 'coursework', z: 9, v: 7, p: 'no', d: { 'follower.offset': -3 } })}`"
    )
    page.evaluate("hash => { location.hash = hash; }", letters)
    page.wait_for_function("() => studio.state.get().task.follower.offset === -3")
    settled(page)
    assert page.evaluate("() => studio.state.get().phi") == 30


def test_a_state_that_is_too_long_leaves_the_address(opened):
    page = opened("measured")
    page.evaluate(
        "() => studio.load({ ...studio.state.get().task, title: { name: Array.from({ length: 3000 }, () => "
        "String.fromCharCode(97 + Math.floor(26 * Math.random()))).join('') } })"
    )
    settled(page)
    assert in_hash(page) == {"b": "measured"}
    page.locator("#link").click()
    page.wait_for_function("() => document.getElementById('announcement').textContent.includes('too long')")


SAID = """() => [document.documentElement.lang, document.title, document.body.innerText,
    ...[...document.querySelectorAll("[title], [aria-label]")].flatMap((each) =>
        [each.getAttribute("title"), each.getAttribute("aria-label")])]"""


@pytest.mark.parametrize("language", ["ru", "vi", "zh"])
def test_an_address_in_another_language_says_what_a_page_in_it_does(opened, language):
    own = opened(config={"language": language}, reduced_motion="reduce")
    address = "#" + own.url.partition("#")[2]
    assert in_hash(own)["l"] == language
    told = own.evaluate(SAID)
    english = opened(reduced_motion="reduce")
    assert english.evaluate(SAID) != told
    english = opened(at=address, reduced_motion="reduce")
    assert english.evaluate(SAID) == told
    assert in_hash(english)["l"] == language
