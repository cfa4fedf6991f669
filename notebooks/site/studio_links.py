"""Links from the pages of the course into the studio, each with the task of its notebook in the address."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.task_paths import changed_task
from graphcam.studio.task_text import built_in_tasks

FOLDER = "studio"
"""Where the studio stands on the site."""
COURSE = {"motion.phases[0].law": "3-4-5", "motion.phases[2].law": "3-4-5"}
"""What the task of the course, task.toml, changes of the built-in one."""
SMOOTH = {"motion.phases[0].law": "cycloidal", "motion.phases[2].law": "cycloidal"}
TASKS: Mapping[str, tuple[str, str, Mapping[str, Any]]] = {
    "01_motion_laws": ("coursework", "acceleration", COURSE),
    "02_graphical_integration": ("coursework", "velocity", COURSE),
    "03_pressure_angle": ("coursework", "angle", COURSE),
    "04_shaded_region": (
        "coursework", "combined", {**COURSE, "follower.offset": None, "limits.pressure_angle_return": 50}),
    "05_inversion": ("coursework", "profile", {**COURSE, "cam.prime_radius": 40, "follower.roller_radius": 16}),
    "06_curvature_and_roller": (
        "coursework", "profile", {**SMOOTH, "cam.prime_radius": 30, "follower.roller_radius": 8}),
    "07_how_exact": ("coursework", "combined", COURSE),
    "08_three_arcs": ("arcs", "acceleration", {}),
    "09_keeping_contact": (
        "coursework", "forces", {**COURSE, "speed_rpm": 400, "spring": {"mass": 0.5, "stiffness": 3}}),
    "10_coursework": ("coursework", "profile", COURSE),
    "11_stress_below_the_surface": ("coursework", "profile", {}),
    "12_cycloidal_at_speed": ("coursework", "acceleration", SMOOTH),
    "13_given_cam": ("arcs", "acceleration", {}),
}  # fmt: skip
"""For each notebook the built-in task, the view that it is about, and what it changes of the task."""


def place(name: str) -> StudioPlace:
    """What the studio shows of a notebook's task."""
    built_in, view, changes = TASKS[name]
    return StudioPlace(changed_task(built_in_tasks()[built_in], changes), built_in, view)


def try_it(name: str) -> str:
    """The link on a notebook's page, which stands in a folder beside the studio's."""
    return _link(f"../{FOLDER}", place(name), "Try it in the studio: move the sizes of this page's cam")


def studio_page() -> str:
    """The page of the site about the studio, in Markdown."""
    cams = {name: task["title"]["name"] for name, task in built_in_tasks().items()}
    links = [f"- {_link(FOLDER, StudioPlace(built_in_tasks()[name], name), title)}" for name, title in cams.items()]
    return "\n".join([
        "# The studio", "",
        "Move a size, and see the construction and the exact values follow. It runs in your browser alone: nothing is",
        "installed, nothing is sent, and after the first visit it works without a network. Begin with", "", *links, "",
    ])  # fmt: skip


def _link(folder: str, shown: StudioPlace, text: str) -> str:
    address = address_of(shown, built_in_tasks())
    return f'<a class="studio" href="{folder}/index.html{address}">{escape(text)}</a>'
