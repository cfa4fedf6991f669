"""The links from the course into the studio: each shows the task and the view of its notebook."""

from __future__ import annotations

import re
import sys
from importlib import import_module

import pytest
from courses import COURSE
from pages import SITE

import graphcam as gc
from graphcam.notebooks import changed
from graphcam.studio.address import place_of
from graphcam.studio.task_text import built_in_tasks
from graphcam.studio.views_answer import views_answer
from graphcam.tasks.task_file import task_from


@pytest.fixture
def links(monkeypatch):
    monkeypatch.syspath_prepend(SITE)
    yield import_module("studio_links")
    del sys.modules["studio_links"]


def addresses(text: str) -> list[str]:
    return re.findall(r'href="((?:\.\./)?studio/index\.html)(#1\.[\w-]+)"', text)


@pytest.mark.parametrize("name", COURSE)
def test_a_notebook_leads_to_a_view_of_its_cam(links, name):
    ((page, address),) = addresses(links.try_it(name))
    assert page == "../studio/index.html"
    place = place_of(address, built_in_tasks())
    assert place == links.place(name)
    drawn = views_answer({"task": place.task, "views": [{"name": place.view}]})
    assert place.view in [each["name"] for each in drawn["names"]]
    assert drawn["views"][0]["order"]


# What a notebook shows in its own widget.
OWN = re.compile(r'gc\.studio\(\w+, view="([\w ]+)"')


@pytest.mark.parametrize("name", COURSE)
def test_link_and_widget_of_a_notebook_show_the_same_view(links, name):
    text = (SITE.parent / f"{name}.py").read_text(encoding="utf-8")
    assert [view for view in OWN.findall(text) if view != links.TASKS[name][1]] == []


def test_links_show_the_tasks_that_the_notebooks_solve(links):
    course = gc.load_task(SITE.parent / "task.toml")
    for name in ("01_motion_laws", "02_graphical_integration", "03_pressure_angle", "07_how_exact", "10_coursework"):
        assert task_from(dict(links.place(name).task)) == course
    region = changed(course, {"follower.offset": None, "limits.pressure_angle_return": 50.0})
    assert task_from(dict(links.place("04_shaded_region").task)) == region
    cam, profile = gc.solve(course).cam, task_from(dict(links.place("05_inversion").task))
    assert (profile.cam.prime_radius, profile.follower.roller_radius) == (cam.prime_radius, cam.roller_radius)


def test_the_page_of_the_studio_leads_to_every_built_in_task(links):
    found = [place_of(address, built_in_tasks()) for _, address in addresses(links.studio_page())]
    assert {place.built_in: place.task for place in found} == built_in_tasks()
