"""Random walks through the studio: whatever is done, form, picture, address and the engine say the same at every rest.

python tests/studio/walks.py --walks 20 --operations 40 --seed 1 [--firefox]
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, cast

from chromium import chromium
from firefox import FirefoxPage, firefox_in
from studio_pages import Engine, middle, settled, task_of

from graphcam.studio.engine import answer
from graphcam.studio.task_paths import value_at

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

TYPED = "-1", "0", "5", "12.5", "33", "44", "60", "200", "1e9", "abc", "", "-0,5", "7"
KEYS = "ArrowRight", "ArrowLeft", "PageUp", "Home", "End"


def choose(numbers: random.Random, found: Locator) -> Locator | None:
    """One of the elements that can be used."""
    seen = [one for one in found.all() if one.is_visible() and one.is_enabled()]
    return numbers.choice(seen) if seen else None


def typed(page: Page, numbers: random.Random) -> str:
    field = choose(numbers, page.locator("#form input[type=text]"))
    if field is None:
        return "nothing to type"
    text = numbers.choice(TYPED)
    field.fill(text)
    field.press(numbers.choice(["Enter", "Tab"]))
    return f"type {text!r} at {field.get_attribute('data-key')}"


def chosen(page: Page, numbers: random.Random) -> str:
    chosen_list = choose(numbers, page.locator("#form select, #builtin, #beside, #sweep-size"))
    if chosen_list is None:
        return "nothing to choose"
    k = numbers.randrange(chosen_list.evaluate("(list) => list.options.length"))
    chosen_list.select_option(index=k)
    return f"choose {k} at {chosen_list.get_attribute('data-key') or 'the tasks'}"


def pulled(page: Page, numbers: random.Random) -> str:
    """A knob or a slider that is moved, at times back to where it was, or with Escape."""
    thing = choose(numbers, page.locator(".hand, #form .size > input[type=range], .border"))
    if thing is None:
        return "nothing to move"
    # A knob goes with a cam that turns, and never rests.
    thing.evaluate("(element) => element.scrollIntoView({ block: 'nearest' })")
    x, y = middle(thing)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + numbers.uniform(-90, 90), y + numbers.uniform(-60, 60), steps=4)
    end = numbers.choice(["", "", "back", "Escape"])
    if end == "back":
        page.mouse.move(x, y, steps=2)
    elif end:
        page.keyboard.press(end)
    page.mouse.up()
    return f"move {thing.get_attribute('data-id') or thing.get_attribute('data-key') or 'a border'} {end}"


def pressed(page: Page, numbers: random.Random) -> str:
    name = numbers.choice(["#undo", "#undo", "#redo", "phase", "view", "given", "#panes", "#play", "tab", "#pin"])
    several = {
        "tab": "#panels button",
        "phase": ".phase-bar button",
        "view": "#strip button",
        "given": ".choice button",
    }
    found = several.get(name, name)
    if (button := choose(numbers, page.locator(found))) is None:
        return f"no {name}"
    # A phase of a degree is too narrow for a pointer.
    button.focus()
    page.keyboard.press("Enter")
    return f"press {name}"


def keyed(page: Page, numbers: random.Random) -> str:
    key = numbers.choice([*KEYS, "Escape", "Escape"])
    page.keyboard.press(key)
    return key


def loaded(page: Page, numbers: random.Random) -> str:
    page.reload()
    return "reload"


OPERATIONS = typed, typed, typed, chosen, pulled, pulled, pulled, pressed, pressed, keyed, loaded
READ = "async () => (await addressOf(studio.config).read(location.hash))?.task ?? null"
FORM = """() => [...document.querySelectorAll("#form .size > .row input[type=text]")]
    .filter((one) => !one.hidden && !one.closest(".phases")).map((one) => [one.dataset.key, typedNumber(one.value)])"""
# A plan goes on from station to station while the cam turns.
PANES = """() => studio.state.get().board ? [] : studio.panes.flatMap(({ names, gallery }) => names()
    .filter((name) => name !== "mechanism" && !(name === "plan" && document.body.matches(".turning")))
    .map((name) => [name, gallery.view(name)]).map(([name, view]) => [
    name, Boolean(view?.plain), view ? view.order.map((id) => view.steps[id].svg).join("") : ""]))"""
RESULT = re.compile(r'class="line result"[^>]* d="([^"]*)"')


@lru_cache(maxsize=256)
def answer_to(request: str) -> Any:
    """The engine's answer to a request as text; of what most operations leave as it is it is known."""
    return answer(json.loads(request))


def drawn_again(task: Mapping[str, Any], asked: Sequence[Mapping[str, Any]], shown: Collection[Any]) -> Any:
    """The views that are shown, as the page has asked for them last: their size says how large their letters are."""
    # A pinned cam is asked for without a station.
    for request in (each for each in reversed(asked) if "station" in each):
        views = [view for view in request["views"] if (view["name"], view.get("plain")) in shown]
        if shown and len(views) == len(shown):
            anew = [{**view, "have": {}} for view in views]
            place = {name: request[name] for name in ("phi", "station")}
            return answer_to(json.dumps({"task": task, "views": anew, "told": True, **place})).get("views", [])
    return []


def contradictions(page: Page, asked: Sequence[Mapping[str, Any]]) -> list[str]:
    """What disagrees at rest; of what is refused there is a message.

    asked : what the page has asked of the engine: a view is drawn again with letters of the same size
    """
    task, found = task_of(page), list[str]()
    engine = answer_to(json.dumps({"task": task, "views": [], "told": True}))
    if not engine["ok"]:
        return [f"the state cannot be drawn: {engine['error']['message']}"]
    if page.evaluate("() => studio.shown.sizes") != engine["sizes"]:
        found.append("the picture is of another cam")
    shown = {(name, plain): svg for name, plain, svg in page.evaluate(PANES)}
    for view in drawn_again(task, asked, set(shown)):
        svg = shown.pop((view["name"], view["plain"]), "")
        if RESULT.findall(svg) != RESULT.findall("".join(step["svg"] for step in view["steps"].values())):
            found.append(f"a pane shows {view['name']} of another cam")
    found += [f"a pane shows {name}, which cannot be drawn" for name, _ in shown]
    if page.evaluate(READ) != task:
        found.append("the address is of another cam")
    refused = page.evaluate("() => [...document.querySelectorAll('.error')].some((each) => each.checkVisibility())")
    if refused != page.evaluate(
        "() => !document.getElementById('form').querySelector('[aria-invalid=true]') === false"
    ):
        found.append("a field is red without a word, or the other way round")
    if not refused:
        for key, value in page.evaluate(FORM):
            there: Any = value_at(task, key)
            if there is not None and abs(value - there) > 1e-6:
                found.append(f"{key} shows {value}, the task has {there}")
    if page.evaluate("() => document.body.classList.contains('held')"):
        found.append("a hand is held for good")
    return found


def walk(page: Page, asked: Sequence[Mapping[str, Any]], seed: int, operations: int) -> list[str]:
    """The contradictions of a walk, with what was done before the first.

    asked : what the page has asked of the engine, which becomes longer
    """
    numbers, done = random.Random(seed), list[str]()
    for _ in range(operations):
        done.append(numbers.choice(OPERATIONS)(page, numbers))
        settled(page)
        if found := contradictions(page, asked):
            return [f"seed {seed}, {' | '.join(done[-4:])}: {each}" for each in found]
    return []


@contextmanager
def pages(*, in_firefox: bool) -> Iterator[Callable[[], Page]]:
    """Opens pages, one after the other."""
    if in_firefox:
        with TemporaryDirectory() as folder, firefox_in(Path(folder)) as client:
            yield lambda: cast("Page", FirefoxPage(client))
    else:
        with chromium() as browser:

            def opened() -> Page:
                """A page that has time: a busy machine is slow, and no page is stuck for it."""
                page = browser.new_page(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
                page.set_default_timeout(120_000)
                return page

            yield opened


def main() -> None:
    """Walk so often, and say what was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name, usual in (("walks", 10), ("operations", 40), ("seed", 0)):
        parser.add_argument(f"--{name}", type=int, default=usual)
    parser.add_argument("--firefox", action="store_true")
    asked = parser.parse_args()
    engine, stuck = Engine(), 0
    with pages(in_firefox=asked.firefox) as opened:
        for seed in range(asked.seed, asked.seed + asked.walks):
            engine.serve(opening="mechanism")
            page = opened()
            page.goto(engine.url)
            settled(page)
            found = walk(page, engine.asked, seed, asked.operations)
            stuck += bool(found)
            sys.stdout.write("\n".join(found or [f"seed {seed}: right"]) + "\n")
            sys.stdout.flush()
            page.close()
    engine.close()
    sys.exit(f"{stuck} of {asked.walks} walks end in contradictions" if stuck else 0)


if __name__ == "__main__":
    main()
