"""The widget's frame in a browser: a page around it plays the notebook, this process the kernel."""

from __future__ import annotations

import json
from importlib.resources import files

import pytest

import graphcam as gc
from graphcam.studio.engine import answer

pytestmark = pytest.mark.slow

NOTEBOOK = """<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><title>notebook</title>
<div id="a"></div>
<script type="module">
const state = %s, hearing = {}, sent = [];
const call = (name, ...given) => [...(hearing[name] || [])].forEach((heard) => heard(...given));
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
window.model = {
  saved: 0,
  get: (name) => state[name],
  set(name, value) { if (!same(state[name], value)) { state[name] = value; call(`change:${name}`); } },
  save_changes() { this.saved += 1; },
  send(body) { window.kernel(JSON.stringify(body)).then((text) => call("msg:custom", JSON.parse(text))); },
  on(names, heard) { for (const name of names.split(" ")) (hearing[name] ||= []).push(heard); },
  off(names, heard) {
    for (const name of names.split(" ")) hearing[name] = hearing[name].filter((one) => one !== heard);
  },
};
%s
const end = render({ model: window.model, el: document.getElementById("a") });
window.end = () => { end(); return Object.values(hearing).flat().length; };
</script>"""


def kernel(text: str) -> str:
    letter = json.loads(text)
    return json.dumps({"frame": letter["frame"], "id": letter["id"], "response": answer(letter["request"])})


@pytest.fixture
def notebook(browser, tmp_path):
    """The page of a notebook with the widget, the frame in it, and what went wrong."""
    widget = gc.studio(view="profile")
    state = {name: getattr(widget, name) for name in ("task", "view", "page", "title", "height")}
    script = (files("graphcam") / "data" / "studio" / "widget.js").read_text(encoding="utf-8")
    told, path = json.dumps(state).replace("<", "\\u003c"), tmp_path / "notebook.html"
    path.write_text(NOTEBOOK % (told, script.replace("export default", "//")), encoding="utf-8")
    page, wrong = browser.new_page(), []
    page.on("console", lambda said: wrong.append(said.text))
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.on("request", lambda asked: asked.url.startswith("http") and wrong.append(asked.url))
    page.expose_function("kernel", kernel)
    page.goto(path.as_uri())
    page.wait_for_selector("iframe")
    frame = page.frames[1]
    frame.wait_for_function("() => window.studio?.quiet() && document.querySelectorAll('#steps .step').length > 5")
    yield page, frame, wrong
    page.close()


def test_the_page_asks_the_kernel_and_the_task_goes_both_ways(notebook):
    page, frame, wrong = notebook
    assert frame.evaluate("studio.state.get().view") == "profile"
    # The kernel moves a size, and the page follows.
    page.evaluate("model.set('task', { ...model.get('task'), cam: { prime_radius: 60 } })")
    frame.wait_for_function("() => studio.quiet() && studio.state.get().task.cam?.prime_radius === 60")
    frame.wait_for_function("() => document.getElementById('drawing-title').textContent.includes('1:1')")
    # The page moves one, and the notebook knows; what it has said itself does not come back to it.
    saved = page.evaluate("model.saved")
    frame.evaluate("studio.change({ 'follower.offset': -12.5 })")
    page.wait_for_function("() => model.get('task').follower.offset === -12.5")
    frame.wait_for_function("() => studio.quiet()")
    assert page.evaluate("model.get('task').cam.prime_radius") == 60
    assert page.evaluate("model.saved") == saved + 1
    frame.evaluate("studio.open('combined')")
    page.wait_for_function("() => model.get('view') !== 'profile'")
    # What the kernel has moved can be undone as what was moved by hand.
    frame.locator("#undo").click()
    frame.locator("#undo").click()
    page.wait_for_function("() => model.get('task').cam?.prime_radius === undefined")
    assert wrong == []


def test_a_frame_that_is_shown_again_shows_what_was_moved(notebook):
    page, _, wrong = notebook
    page.evaluate("model.set('task', { ...model.get('task'), cam: { prime_radius: 60 } })")
    # A notebook that moves an output loads its frame anew.
    page.evaluate("() => { const one = document.querySelector('iframe'); document.body.append(one); }")
    page.wait_for_timeout(200)
    frame = page.frames[-1]
    frame.wait_for_function("() => window.studio?.quiet() && studio.state.get().task.cam?.prime_radius === 60")
    assert page.evaluate("window.end()") == 0
    assert wrong == []
