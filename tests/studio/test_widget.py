"""The studio as a widget: the task goes both ways, requests are answered, and stills stand where no kernel runs."""

from __future__ import annotations

import json
import re
import subprocess
import sys

import pytest

import graphcam as gc
from graphcam.studio.task_text import plain_task
from graphcam.studio.widget import WIDGET_VIEW, StudioWidget

pytestmark = pytest.mark.slow

TASK = plain_task(gc.builtin_task())


@pytest.fixture
def widget(monkeypatch):
    """A widget of the coursework, and what it has sent to the page."""
    one = gc.studio(view="profile")
    one.sent = []
    monkeypatch.setattr(one, "send", one.sent.append)
    return one


def run(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.parametrize(
    "before",
    [
        "",
        "import graphcam.studio.engine",
        "import graphcam.studio.engine as engine; engine.answer",
        "from graphcam.studio import engine",
        "gc.studio",
    ],
)
def test_the_room_is_a_function_whatever_was_imported_before(before):
    code = f"import graphcam as gc\n{before}\nprint(callable(gc.studio), gc.studio.__name__, gc.studio is gc.studio)\n"
    code += "import graphcam.studio.engine\nprint(callable(gc.studio), graphcam.studio.engine.answer.__name__)"
    assert run(code).splitlines() == ["True graphcam.studio True", "True answer"]


def test_the_room_alone_loads_no_widget_and_the_function_says_what_it_lacks():
    loaded = run(
        "import graphcam as gc, sys\ngc.studio\nprint({'anywidget', 'ipywidgets', 'numpy'} & set(sys.modules))"
    )
    assert loaded == "set()"
    code = "import sys\nsys.modules['anywidget'] = None\nimport graphcam as gc\n"
    code += "try: gc.studio()\nexcept gc.TaskError as e: print(e)"
    assert run(code).endswith('pip install ".[notebooks]"')


def test_the_task_goes_both_ways(widget):
    assert widget.task == TASK
    assert widget.given == gc.builtin_task()
    # As the page sets it: plain data over the wire.
    moved = json.loads(json.dumps(TASK))
    moved["follower"]["offset"] = -12.5
    widget.set_state({"task": moved})
    assert widget.changes == {"follower.offset": -12.5}
    assert gc.solve(widget.given).cam.follower.offset == -12.5
    widget.changes = {"cam.prime_radius": 50, "motion.phases[0].law": "cosine"}
    assert widget.task["cam"] == {"prime_radius": 50}
    assert widget.task["follower"]["offset"] == -10
    assert widget.given.motion.phases[0].law == "cosine"
    widget.task = gc.builtin_task("flat")
    assert widget.task["follower"]["kind"] == "flat-faced"
    assert "follower.kind" in widget.changes
    widget.changes = {}
    assert widget.task == TASK


def test_a_moved_task_is_told_to_the_page_once(widget):
    told = []
    widget.observe(lambda change: told.append(change["name"]), ["task", "changes"])
    widget.changes = {"follower.offset": 5}
    assert told.count("task") == 1
    widget.set_state({"task": widget.task})
    assert told.count("task") == 1


def test_a_request_of_the_page_is_answered_to_the_frame_that_asked(widget):
    request = {"seq": 7, "task": TASK, "views": [{"name": "profile"}]}
    widget._handle_custom_msg({"frame": "a", "id": 3, "request": request}, [])
    widget._handle_custom_msg({"frame": "b", "id": 1, "request": {"seq": 8, "task": {"rotation": "up"}}}, [])
    first, second = widget.sent
    assert (first["frame"], first["id"], first["response"]["seq"], first["response"]["ok"]) == ("a", 3, 7, True)
    assert (second["frame"], second["id"], second["response"]["ok"]) == ("b", 1, False)
    json.dumps(widget.sent, allow_nan=False)


def test_what_is_no_task_opens_no_studio():
    with pytest.raises(gc.TaskError, match="rotation is 'up'"):
        gc.studio({**TASK, "rotation": "up"})


def test_the_page_in_the_frame_knows_task_and_view(widget):
    config = json.loads(re.search(r'id="config">(.*?)</script>', widget.page, re.DOTALL)[1])
    assert (config["transport"], config["id"], config["task"], config["view"]) == ("parent", "widget", TASK, "profile")
    assert "http-equiv" not in widget.page


def test_stills_stand_where_no_kernel_runs():
    stills = {"r₀ = 30 mm": {"cam.prime_radius": 30}, "r₀ = 60 mm": {"cam.prime_radius": 60}}
    bundle, _ = gc.studio(view="profile", stills=stills)._repr_mimebundle_()
    assert set(bundle) == {WIDGET_VIEW, "text/html", "text/plain"}
    assert bundle["text/html"].count("<img") == 2
    assert all(says in bundle["text/html"] for says in stills)
    sources = re.findall(r'src="([^"]+)"', bundle["text/html"])
    assert len(set(sources)) == 2
    assert max(map(len, sources)) < 300_000
    # Scales of the profile: larger where the cam is smaller.
    assert re.findall(r"<figcaption>(.*?)</figcaption>", bundle["text/html"]) == [
        "Cam profile, 2.5:1",
        "Cam profile, 1:1",
    ]


def test_without_stills_the_task_as_it_is_stands_there(widget):
    before = widget.html
    widget.changes = {"cam.prime_radius": 60}
    assert before.count("<img") == 1
    assert "Cam profile, 2:1" in before
    assert "Cam profile, 1:1" in widget.html


@pytest.mark.parametrize("name", ["arm", "flat", "measured"])
def test_every_task_has_a_widget_and_a_still(name):
    widget = gc.studio(gc.builtin_task(name))
    assert isinstance(widget, StudioWidget)
    assert widget.html.count("<img") == 1


def test_arcs_have_a_widget_and_a_still():
    assert gc.studio(gc.builtin_arcs_task(), view="acceleration").html.count("<img") == 1
