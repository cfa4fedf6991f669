"""Values that show themselves: few lines in a terminal, a drawing in a notebook."""

from __future__ import annotations

import ast
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from over_all import fast_first

import graphcam as gc
from graphcam.showing import MAX_LINES, Plottable, higher_function, value_text
from graphcam.solving.spring_design import SpringDesign

SVG = "{http://www.w3.org/2000/svg}"
PACKAGE = Path(gc.__file__).parent
TASKS = ("coursework", "arm", "flat", "measured", "arcs")


@pytest.fixture(scope="module", params=fast_first(TASKS))
def solution(request):
    return gc.solve(gc.builtin_arcs_task() if request.param == "arcs" else gc.builtin_task(request.param))


def values(solution):
    """Everything of a solution that shows itself, and its readings."""
    constructions = list(solution.drawn.values())
    motion = solution.motion if isinstance(solution, gc.ArcsSolution) else solution.cam.motion
    readings = [reading for construction in constructions for reading in construction.readings.values()]
    steps = [step for construction in constructions for step in construction.steps()]
    return [solution, solution.chain, solution.cam, motion, *constructions, *steps, *readings]


def test_few_lines_say_what_it_is(solution):
    for value in values(solution):
        lines = repr(value).splitlines()
        assert 1 <= len(lines) <= MAX_LINES, repr(value)
        assert max(map(len, lines)) <= 130, repr(value)
        assert lines[0].startswith((type(value).__name__, "Cam")), lines[0]


def test_few_lines_of_what_holds_others(solution):
    parts = [solution.task, solution.comparison, solution.comparison.bounds]
    if isinstance(solution, gc.Solution):
        load = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100)
        parts += [gc.Contact(solution.cam.motion, load), SpringDesign(solution.chain, solution.cam, load, False)]
        if isinstance(solution.cam.follower, gc.Translating):
            forces = gc.CamForces(solution.cam, load)
            parts += [forces, gc.ContactStress(forces, gc.RollerContact(width=15))]
    for value in parts:
        lines = repr(value).splitlines()
        assert lines[0].startswith(type(value).__name__)
        assert 2 <= len(lines) <= MAX_LINES
        assert max(map(len, lines)) <= 130, repr(value)


def test_a_task_is_told_by_what_it_asks():
    assert repr(gc.builtin_task()).splitlines() == [
        "Task 'Cam mechanism'",
        "  turns cw at 120 rpm, translating follower",
        "  rise 80°, dwell 45°, return 60°, dwell 175°",
        "gc.solve(task) designs the cam; .to_dict() tells all",
    ]
    assert "measured, measured.csv" in repr(gc.builtin_task("measured"))


@pytest.mark.parametrize("samples", [1, 50])
def test_few_lines_of_a_hand_that_draws_many_times(samples):
    pencil = gc.Pencil(line=0.2, dividers=0.2, samples=samples)
    drawn = gc.solve(gc.builtin_task(), pencil).drawn
    for construction in drawn.values():
        assert len(repr(construction).splitlines()) <= MAX_LINES
        assert f"samples: {samples}" in repr(construction)


def test_a_construction_tells_its_readings_as_millimetres_times_a_scale():
    drawn = gc.solve(gc.builtin_task()).drawn
    assert "prime_radius: 72.133 mm × 0.6 mm/mm = 43.28 mm" in repr(drawn["minimum_radius"])
    assert "v: [-66.667 ... 50] mm × 0.85944 (mm/rad)/mm = [-57.296 ... 42.972] mm/rad" in repr(drawn["integration"])
    # A length that stands for itself, and an angle, have no scale.
    assert "greatest: [50 ... 88.889] mm of paper" in repr(drawn["acceleration"])
    assert repr(drawn["pressure_angle"].readings["alpha"]) == "Reading [-0.86075 ... 0.51804] rad"


def test_what_cannot_be_read_is_told_as_such():
    nothing = gc.Reading(np.full(3, np.nan), 0.5, "mm")
    assert repr(nothing) == "Reading [nan] mm × 0.5 mm/mm = [nan] mm"


def test_a_solution_is_told_without_drawing_it():
    solution = gc.solve(gc.builtin_task())
    repr(solution), repr(solution.chain)
    assert "working_profile" not in solution.chain.lying
    assert solution.chain["working_profile"] is solution.chain.lying["working_profile"]
    assert "comparison" not in solution.__dict__


def test_many_rows_are_cut_short():
    lines = value_text("many", map(str, range(20)), "go on").splitlines()
    assert len(lines) == MAX_LINES
    assert lines[-2:] == ["  and 15 more", "go on"]


def shown(value):
    """What a notebook shows of a value, read as XML: the texts and the number of paths."""
    root = ElementTree.fromstring(value._repr_svg_())
    assert root.tag == f"{SVG}svg"
    return ["".join(text.itertext()) for text in root.iter(f"{SVG}text")], len(list(root.iter(f"{SVG}path")))


def test_a_notebook_shows_what_is_drawn(solution):
    for construction in solution.drawn.values():
        texts, paths = shown(construction)
        views = {str(step.view.title).partition(",")[0].split()[0] for step in construction.steps() if step.marks}
        assert all(any(view in text for text in texts) for view in views), construction.name
        assert paths > 3
    finished, paths = shown(solution)
    assert solution.task.title.name.split()[0] in " ".join(finished)
    assert paths > 50


def test_a_notebook_shows_cams_motions_and_steps():
    solution = gc.solve(gc.builtin_task())
    texts, _ = shown(solution.cam)
    assert {"pitch curve", "working profile", "prime circle, 44 mm", "roller, 17 mm", "cam centre"} <= set(texts)
    texts, _ = shown(solution.cam.motion)
    assert {"lift s", "v = ds/dφ", "a = dv/dφ", "j = da/dφ"} <= set(texts)
    assert [text for text in texts if text in ("rise", "dwell", "return")] == ["rise", "dwell", "return", "dwell"]
    first, last = solution.drawn["minimum_radius"].steps()[::4]
    assert shown(first) != shown(last)
    assert {"Acceleration", "Velocity", "Displacement"} <= set(shown(solution.chain)[0])
    sound, other = gc.solve(gc.builtin_arcs_task()).roots
    assert {"A", "G", "F", "D", "C1", "C3"} <= set(shown(sound)[0])
    assert other._repr_svg_() is None


@pytest.mark.slow
def test_functions_of_rooms_above_are_there():
    """They are named in words, which no type checker reads."""
    named: set[str] = set()
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "higher_function":
                named |= {node.args[0].value} if isinstance(node.args[0], ast.Constant) else set()
    assert {"report.output_folder.write", "plots.figures.svg_of"} <= named
    kinds = [getattr(gc, name) for name in dir(gc)]
    drawn = {kind._drawn_in for kind in kinds if isinstance(kind, type) and issubclass(kind, Plottable)}
    assert drawn == {
        "cam_outline.plot", "cam_outline.plot_arcs", "construction_drawing.plot", "construction_drawing.plot_sheet",
        "force_curves.plot", "force_curves.plot_stress",
        "motion_curves.plot", "motion_curves.plot_bands", "response_curves.plot", "response_curves.plot_spectrum",
    }  # fmt: skip
    for function in named | {f"plots.{function}" for function in drawn}:
        assert callable(higher_function(function))
