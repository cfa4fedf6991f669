"""The teaching modes in a browser: guesses by hand and keys, tours answered by doing, exercises that hide and check."""

from __future__ import annotations

import re

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect
from studio_pages import in_hash, settled, task_of

import graphcam as gc
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.exports.studio_link import exercise_of, studio_address
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.studio.tours import tours, tours_answer

pytestmark = pytest.mark.slow

SALT = b"salt of a page"
WINDOWS = {"desk": (1440, 900, "light"), "phone": (390, 844, "dark")}
each_window = pytest.mark.parametrize("window", WINDOWS.values(), ids=WINDOWS)


def barred(page: Page) -> list[str]:
    found = Axe().run(page).response["violations"]
    return [f"{each['id']}: {[node['target'] for node in each['nodes']]}" for each in found]


def mode(page: Page, name: str, there: str) -> None:
    page.click(f"#modes [data-mode={name}]")
    page.wait_for_selector(there)
    settled(page)


def shown_steps(page: Page) -> list[str]:
    return page.evaluate(
        "() => [...document.querySelectorAll('#steps [data-group]')].map((step) => step.dataset.group)"
    )


def announced(page: Page) -> str:
    return page.inner_text("#announcement")


@pytest.fixture(scope="module")
def issued():
    (both,) = course_variants(find_exercise("least-radius-offset"), ["Anna"], b"secret")
    return both


# --- Predict ---------------------------------------------------------------------------------------------------------


def test_only_what_is_given_is_drawn_until_it_is_constructed(opened):
    page = opened()
    mode(page, "predict", "#construct")
    given = shown_steps(page)
    assert given == ["minimum_radius/velocities-at-the-displacements", "minimum_radius/curves-of-rise-and-return"]
    assert "43.28" not in page.inner_text("body")
    assert page.locator("#tab-values").is_disabled()
    assert page.locator("#sizes").get_attribute("inert") is not None
    page.click("#construct")
    page.wait_for_selector("#judged")
    settled(page)
    assert shown_steps(page)[-1] == "minimum_radius/the-minimum-prime-radius"
    assert "larger than the minimum" in page.inner_text("#judged")
    assert page.inner_text("#judged") in announced(page)
    assert page.locator(".guesses .answer").count() == 1


def test_a_guess_is_moved_by_keys_by_hand_and_by_a_number_alike(opened):
    page = opened()
    mode(page, "predict", "#construct")
    field, knob = page.locator("#card [data-field]"), page.locator(".hand.guess")
    field.fill("80")
    field.press("Tab")
    knob.locator("input").focus()
    page.keyboard.press("ArrowUp")
    expect(field).to_have_value("79.0")
    page.keyboard.press("Shift+ArrowDown")
    expect(field).to_have_value("79.2")
    before = knob.bounding_box()
    assert before
    x, y = before["x"] + 22, before["y"] + 22
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 90, y - 60, steps=4)
    page.mouse.up()
    after = knob.bounding_box()
    assert after
    # It stays on its line.
    assert after["x"] == pytest.approx(before["x"], abs=1)
    assert after["y"] == pytest.approx(before["y"] - 60, abs=2)
    assert float(field.input_value()) < 79


def test_steps_of_the_construction_come_by_key_too(opened):
    page = opened()
    mode(page, "predict", "#construct")
    page.clock.install()
    page.click("#construct")
    page.wait_for_selector("#construct-next")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.wait_for_selector("#judged")
    assert page.evaluate("() => document.activeElement.id") == "judged"


def test_the_next_variant_is_another_task_and_play_shows_all_again(opened):
    page = opened()
    mode(page, "predict", "#construct")
    before = task_of(page)
    page.click("#next-variant")
    page.wait_for_function("(before) => JSON.stringify(studio.state.get().task.motion) !== before", arg="")
    page.wait_for_selector("#construct")
    settled(page)
    assert task_of(page)["motion"] != before["motion"]
    page.click("#modes [data-mode=play]")
    settled(page)
    assert page.locator(".hand.guess").count() == 0
    assert len(shown_steps(page)) > 3
    assert page.inner_text("#card") == ""


@pytest.mark.parametrize("kind", ["angle", "steepest", "sharpest"])
def test_every_question_is_answered(opened, kind):
    page = opened()
    mode(page, "predict", "#construct")
    page.select_option("#predict-kind", kind)
    page.wait_for_function("(kind) => document.getElementById('predict-kind')?.value === kind", arg=kind)
    settled(page)
    page.locator(".hand.guess input").first.focus()
    page.keyboard.press("PageUp")
    page.click("#construct")
    page.wait_for_selector("#judged")
    settled(page)
    assert page.locator(".guesses .answer").count() == 1
    assert page.locator(".hand.guess").is_visible()


# --- Tour ------------------------------------------------------------------------------------------------------------


def test_a_card_is_answered_by_choosing_and_says_why(opened):
    page = opened()
    mode(page, "tour", "[data-tour=offset]")
    page.click("[data-tour=offset]")
    settled(page)
    first = tours_answer({"language": "en"})["tours"][0]["cards"][0]
    # Also a choice that is tried again.
    for k in [1, 2, 1]:
        assert k != first["answer"]
        page.click(f"[data-choice='{k}']")
        reason = f"Not that one. {first['wrong'][k]}"
        assert page.inner_text("#card-told") == announced(page) == reason
    assert page.locator("[data-state=wrong]").count() == 2
    assert first["why"] not in page.inner_text("#card")
    page.click(f"[data-choice='{first['answer']}']")
    assert first["why"] in page.inner_text("#card-told")
    assert first["why"] in announced(page)
    assert page.locator(".progress .here").count() == 1


def test_a_card_is_answered_by_doing(opened):
    page = opened()
    mode(page, "tour", "[data-tour=offset]")
    page.click("[data-tour=offset]")
    page.click("#card-next")
    settled(page)
    card = tours()[0]["cards"][1]
    assert page.evaluate("() => studio.state.get().step") == card["step"]
    page.evaluate("() => studio.change({ 'follower.offset': -4 })")
    settled(page)
    page.wait_for_timeout(500)
    assert card["why"] not in page.inner_text("#card")
    page.evaluate("() => studio.change({ 'follower.offset': 1.5 })")
    page.wait_for_function("(why) => document.getElementById('card').innerText.includes(why)", arg=card["why"])
    settled(page)
    assert task_of(page)["follower"]["offset"] == 1.5


def test_a_tour_gives_back_what_was_there_before_also_after_a_reload(opened):
    page = opened()
    page.evaluate("() => studio.change({ 'follower.offset': -7 })")
    page.evaluate("() => studio.open('profile')")
    settled(page)
    before = task_of(page)
    mode(page, "tour", "[data-tour=face]")
    page.click("[data-tour=face]")
    settled(page)
    assert task_of(page) != before
    page.reload()
    settled(page)
    assert task_of(page) == before
    page.wait_for_selector("[data-tour=face]")
    page.click("[data-tour=face]")
    settled(page)
    page.click("#modes [data-mode=play]")
    settled(page)
    assert task_of(page) == before
    assert page.locator("#builtin").input_value() == "coursework"
    assert page.evaluate("() => studio.state.get().view") == "profile"


def test_a_tour_is_gone_through_to_its_end_by_keys_alone(opened):
    page = opened()
    page.locator("#modes [data-mode=tour]").focus()
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-tour=face]")
    page.locator("[data-tour=face]").focus()
    page.keyboard.press("Enter")
    face = next(tour for tour in tours() if tour["id"] == "face")
    for k, card in enumerate(face["cards"]):
        page.wait_for_function("(ask) => document.getElementById('card').innerText.includes(ask)", arg=card["ask"])
        assert page.evaluate("() => document.activeElement.id") == "card-title", k
        settled(page)
        assert page.evaluate("() => studio.shown.ok")
        page.locator("#card-next").focus()
        page.keyboard.press("Enter")
    page.wait_for_selector("[data-tour=face] :text('seen')")


# --- Exercise --------------------------------------------------------------------------------------------------------


def test_a_link_opens_the_exercise_without_what_is_asked(opened, issued, served):
    variant, key = issued
    page = opened(at=studio_address(variant, key, SALT), config={"opening": "mechanism"})
    page.wait_for_selector("#check")
    settled(page)
    assert task_of(page)["motion"] == variant.task.to_dict()["motion"]
    views = page.evaluate(
        "() => [...document.querySelectorAll('#strip [data-open]:enabled')].map((one) => one.dataset.open)"
    )
    assert views == ["scheme", "acceleration"]
    assert page.locator("#modes :enabled").all_inner_texts() == ["Exercise"]
    text = page.inner_text("body")
    for each in key.keys.values():
        # Not as the end of another number, as 0.83 is of 10.83; with any sign, and with more figures.
        assert not re.search(rf"(?<![\d.]){abs(float(each.expected.value)):.2f}", text)
    page.keyboard.press("a")
    settled(page)
    assert page.locator("#board").is_hidden()
    # Nor was anything asked that tells it; beside the last diagram stands nothing but what is given.
    assert {each["upto"] for each in served.pictures()} == {"acceleration"}
    beside = page.evaluate("() => studio.panes[1].names()")
    assert set(beside) <= {"scheme", "acceleration"}
    # A page that is loaded anew still has its exercise.
    assert in_hash(page)["x"]["upto"] == "acceleration"


def test_answers_are_held_against_hashes_as_marking_holds_them(opened, issued):
    variant, key = issued
    page = opened(config={"exercise": exercise_of(variant, key, SALT), "task": variant.task.to_dict()})
    page.wait_for_selector("#check")
    names = [asked.name for asked in variant.exercise.answers]
    values = {name: float(key.keys[name].expected.value) for name in names}
    wrong = [each.value for each in key.hypotheses["offset-sign"]]
    off = [k for k, name in enumerate(names) if abs(wrong[k] - values[name]) > key.keys[name].tolerance]
    for name in names:
        page.fill(f"input[name={name}]", f"{values[name] + 0.9 * key.keys[name].tolerance:.4f}".replace(".", ","))
    page.fill(f"input[name={names[off[0]]}]", f"{wrong[off[0]]:.4f}")
    page.click("#check")
    page.wait_for_function("() => document.getElementById('checked').innerText")
    assert page.inner_text("#checked") == f"{len(names) - 1} of {len(names)} right."
    row = page.locator(f"[data-answer={names[off[0]]}]")
    assert row.locator(".verdict").inner_text() == "not right"
    assert row.locator(".sentence").inner_text() != ""
    assert row.locator("input").get_attribute("aria-invalid") == "true"


def test_answers_survive_a_reload(opened, issued):
    variant, key = issued
    page = opened(config={"exercise": exercise_of(variant, key, SALT), "task": variant.task.to_dict()})
    fields = page.locator("#card [data-answer] input")
    typed = [f"{12.5 + k}" for k in range(fields.count())]
    for k, text in enumerate(typed):
        fields.nth(k).fill(text)
    page.reload()
    settled(page)
    assert [fields.nth(k).input_value() for k in range(fields.count())] == typed


def test_without_web_cryptography_the_engine_checks(opened, issued):
    variant, key = issued
    page = opened(config={"exercise": exercise_of(variant, key, SALT), "task": variant.task.to_dict()})
    page.wait_for_selector("#check")
    page.evaluate("() => Object.defineProperty(globalThis, 'crypto', { value: undefined })")
    page.fill("input[name=r0]", f"{float(key.keys['r0'].expected.value):.3f}")
    page.fill("input[name=s0]", "much")
    page.keyboard.press("Enter")
    page.wait_for_function("() => document.getElementById('checked').innerText")
    assert page.inner_text("#checked") == "1 of 1 right."
    assert "number" in page.locator("[data-answer=s0] .verdict").inner_text()


def test_without_hashes_answers_are_asked_and_not_checked(opened, issued):
    variant, _ = issued
    page = opened(config={"exercise": exercise_of(variant), "task": variant.task.to_dict()})
    page.wait_for_selector("input[name=r0]")
    assert page.locator("#check").count() == 0
    assert "not checked here" in page.inner_text("#card")


def test_without_a_link_an_exercise_is_explained_and_one_can_be_tried(opened):
    page = opened(config={"opening": "mechanism"}, reduced_motion="reduce")
    before = task_of(page)
    mode(page, "exercise", "#try-exercise")
    assert "a part of the construction is given" in page.inner_text("#card")
    page.click("#try-exercise")
    page.wait_for_selector("#check")
    settled(page)
    found = gc.solve(gc.builtin_task()).comparison.quantities
    page.fill("input[name=max_v]", f"{found['max_v'].exact * 1.015:.1f}")
    page.fill("input[name=minimum_prime_radius]", f"{found['minimum_prime_radius'].exact * 1.05:.1f}")
    page.click("#check")
    page.wait_for_function("() => document.getElementById('checked').innerText")
    assert page.inner_text("#checked") == "1 of 2 right."
    assert page.locator("[data-answer=max_v] .verdict").inner_text() == "right"
    # The other modes stay open, and the cam is the person's own.
    page.click("[data-mode=play]")
    settled(page)
    assert task_of(page) == before
    assert page.locator("#strip [data-open=profile]").is_enabled()
    assert "x" not in in_hash(page)
    mode(page, "exercise", "#try-exercise")


# --- who cannot see or point -----------------------------------------------------------------------------------------


@each_window
def test_axe_core_finds_nothing_in_any_mode(opened, issued, window):
    wide, high, scheme = window
    page = opened("coursework", wide, high, color_scheme=scheme, bypass_csp=True, reduced_motion="reduce")
    mode(page, "predict", "#construct")
    assert barred(page) == [], "a question"
    page.click("#construct")
    page.wait_for_selector("#judged")
    settled(page)
    assert barred(page) == [], "its answer"
    mode(page, "tour", "[data-tour=offset]")
    assert barred(page) == [], "all tours"
    page.click("[data-tour=offset]")
    settled(page)
    page.click("[data-choice='1']")
    assert barred(page) == [], "a wrong choice"
    page.click("[data-choice='0']")
    assert barred(page) == [], "a right choice"
    variant, key = issued
    page = opened("coursework", wide, high, at=studio_address(variant, key, SALT), color_scheme=scheme, bypass_csp=True)
    page.wait_for_selector("#check")
    page.fill("input[name=r0]", "1")
    page.click("#check")
    page.wait_for_function("() => document.getElementById('checked').innerText")
    assert barred(page) == [], "an exercise"


@each_window
def test_no_card_covers_the_drawing_or_is_wider_than_the_window(opened, window):
    wide, high, scheme = window
    page = opened("coursework", wide, high, color_scheme=scheme)
    mode(page, "predict", "#construct")
    assert page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    stage, card = page.locator("#stage").bounding_box(), page.locator("#card").bounding_box()
    assert stage
    assert card
    assert card["x"] >= stage["x"] + stage["width"] or card["y"] >= stage["y"] + stage["height"]
    inner = page.evaluate(
        """() => {
        const right = (one) => one.getBoundingClientRect().right, edge = right(document.getElementById("card"));
        return [...document.querySelectorAll("#card *")].every((one) => right(one) <= edge + 0.5);
        }"""
    )
    assert inner
    knob = page.locator(".hand.guess").bounding_box()
    assert knob
    assert round(knob["width"], 3) >= 44
