"""Plots on axes: the curves are those of the values, and the user's figures stay as they were."""

from __future__ import annotations

import subprocess
import sys
from itertools import pairwise

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.figure import Figure

import graphcam as gc
from graphcam.notebooks.explore import changed


@pytest.fixture(scope="module")
def solution():
    return gc.solve(gc.builtin_task())


@pytest.fixture(autouse=True)
def without_a_display():
    pyplot.switch_backend("agg")
    pyplot.close("all")
    yield
    pyplot.close("all")


def line(axes, label):
    return next(line for line in axes.lines if line.get_label() == label).get_xydata()


def things(solution):
    arcs = gc.solve(gc.builtin_arcs_task())
    drawn = solution.drawn["minimum_radius"]
    return [solution, solution.chain, solution.cam, solution.cam.motion, drawn, drawn.steps()[0], arcs.cam, arcs.motion]


def test_given_axes_are_drawn_on_and_returned(solution):
    for thing in things(solution):
        axes = Figure().add_subplot()
        assert thing.plot(ax=axes) is axes
        axes.figure.canvas.draw()
    # No figure was made for it.
    assert pyplot.get_fignums() == []


def test_without_axes_a_new_figure_is_shown(solution):
    backend, settings = mpl.get_backend(), dict(mpl.rcParams)
    for number, thing in enumerate(things(solution), 1):
        axes = thing.plot()
        assert pyplot.gcf() is axes.figure
        assert len(pyplot.get_fignums()) == number
    assert mpl.get_backend() == backend
    assert dict(mpl.rcParams) == settings


@pytest.mark.slow
def test_a_drawing_of_a_notebook_leaves_pyplot_alone(solution):
    for thing in things(solution):
        assert thing._repr_svg_() is not None
    assert pyplot.get_fignums() == []


@pytest.mark.slow
def test_it_works_without_a_display():
    code = "import graphcam as gc; print(gc.solve(gc.builtin_task()).cam.plot().get_title())"
    assert "clockwise" in subprocess.check_output([sys.executable, "-c", code], text=True, env={"PATH": ""})


@pytest.mark.parametrize("task", ["coursework", "flat", "measured"])
def test_the_curves_of_a_motion_are_its_values(task):
    motion = gc.builtin_task(task).motion()
    diagrams = motion.plot().child_axes
    for diagram, k in zip(diagrams, range(4), strict=True):
        phi, drawn = diagram.lines[0].get_xydata().T
        right, left = (motion(np.radians(phi), side)[k] for side in ("right", "left"))
        off = np.minimum(np.abs(drawn - right), np.abs(drawn - left))
        assert off.max() <= 1e-9 * max(1.0, np.abs(drawn).max())
        assert phi[0] == 0
        assert phi[-1] == pytest.approx(360)
        # Where a phase begins there is a line across.
        across = [line.get_xdata()[0] for line in diagram.lines if line.get_linestyle() == "--"]
        assert across == pytest.approx(np.degrees(motion.starts).tolist())


def test_both_sides_of_a_jump_are_drawn():
    motion = gc.builtin_task().motion()
    phi, a = motion.plot().child_axes[2].lines[0].get_xydata().T
    for jump in motion.breaks[1:]:
        (there,) = np.nonzero(np.isclose(phi, np.degrees(jump)))
        assert a[there] == pytest.approx([motion(jump, "left")[2], motion(jump)[2]])


def test_the_curves_of_a_cam_are_its_own(solution):
    cam = solution.cam
    axes = cam.plot()
    assert axes.get_aspect() == 1
    phi = np.radians(np.arange(0, 360, 10.0))
    for name, exact in (("pitch curve", cam.pitch_curve(phi)), ("working profile", cam.profile(phi))):
        drawn = line(axes, name)
        # Each place lies between two neighbouring points of the drawn curve.
        assert max(np.hypot(*(drawn - place).T).min() for place in exact) < 1.0
    assert np.hypot(*line(axes, "prime circle, 44 mm").T) == pytest.approx(44)
    roller = line(axes, "roller, 17 mm") - cam.pitch_curve(0.0)
    assert np.hypot(*roller.T) == pytest.approx(17)


def test_a_flat_face_lies_on_its_cam():
    cam = gc.solve(gc.builtin_task("flat")).cam
    axes = cam.plot()
    assert "pitch curve" not in [line.get_label() for line in axes.lines]
    assert line(axes, "flat face")[:, 1] == pytest.approx(cam.profile(0.0)[1])


def test_a_cam_of_arcs_passes_its_points():
    cam = gc.solve(gc.builtin_arcs_task()).cam
    profile = line(cam.plot(), "profile")
    for point in (cam.A, cam.G, cam.F, cam.D):
        assert np.hypot(*(profile - point).T).min() < 1e-6
    with pytest.raises(gc.DesignError, match="not sound"):
        gc.solve(gc.builtin_arcs_task()).roots[1].plot()


@pytest.mark.slow
def test_a_later_step_shows_more(solution):
    for construction in solution.drawn.values():
        if construction.name == "roller":
            continue
        counts = [len(construction.plot(k).artists) for k in range(len(construction.steps()))]
        assert counts == sorted(set(counts)), construction.name
        pyplot.close("all")


def test_a_construction_is_drawn_in_millimetres_of_paper(solution):
    """What a lecturer adds at a point of the construction stands on it: the views are not moved from step to step."""
    integration = solution.drawn["integration"]
    first, whole = integration.plot(0), integration.plot()
    assert first.get_xlim() == whole.get_xlim()
    assert first.get_ylim() == whole.get_ylim()
    left, right = whole.get_xlim()
    length = solution.drawn["acceleration"].readings["base"].paper
    assert left < -float(integration.givens.poles[0])
    assert right > length
    # Beside the turn stand the poles, and the graduations per radian and per second.
    assert right - left < length + 120


@pytest.mark.parametrize("step", [-1, 9])
def test_a_step_that_is_not_there_is_refused(solution, step):
    with pytest.raises(gc.DesignError, match=f"step is {step}, but must be an index of the steps, 0 to 8"):
        solution.drawn["integration"].plot(step)


def test_words_alone_cannot_be_plotted():
    knife_edge = gc.solve(changed(gc.builtin_task(), {"follower.roller_radius": 0.0}))
    with pytest.raises(gc.DesignError, match="see the captions of the steps"):
        knife_edge.drawn["roller"].plot()


class Drawn(RendererAgg):
    """A renderer that notes the sizes of letters and the widths of lines [points]."""

    def __init__(self, figure):
        super().__init__(*figure.bbox.size, figure.dpi)
        self.sizes = []

    def draw_path(self, gc, path, transform, rgbFace=None):
        self.sizes.append(gc.get_linewidth())

    def draw_text(self, gc, x, y, s, prop, angle, ismath=False, mtext=None):
        self.sizes.append(prop.get_size_in_points())


def test_letters_and_lines_follow_the_axes(solution):
    """A sheet on axes of half the size is half as bold: it is the same drawing, seen smaller."""
    sizes = []
    for part in (1.0, 0.5):
        figure = Figure((16, 8))  # letters of less than a point are none to matplotlib
        axes = solution.plot(figure.add_axes((0, 0, part, part)))
        drawn = Drawn(figure)
        for artist in axes.artists:
            artist.draw(drawn)
        sizes.append(np.array(drawn.sizes))
    large, small = sizes
    assert large.size > 300
    assert np.unique(large).size > 5
    assert small == pytest.approx(large / 2)


def test_the_drawing_of_a_cam_is_laid_out_for_a_screen(solution):
    """Views that have nothing to do with each other fill columns: a band of them would be shown in tiny letters."""
    figure = Figure()
    axes = solution.chain.plot(figure)
    width, height = np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())
    assert 1.0 < width / height < 2.0
    assert width < 1150


def test_one_view_alone_is_the_title_of_its_axes(solution):
    measured = solution.drawn["pressure_angle"]
    assert measured.steps()[3].plot().get_title() == "Velocity plan at station 6, 1:1, μᵥ = 0.01257 (m/s)/mm"
    assert measured.plot().get_title() == ""  # the plan stands beside the combined diagram


def test_axes_in_the_place_of_a_step_are_told_their_name():
    drawn = gc.solve(gc.builtin_task()).drawn["integration"]
    with pytest.raises(gc.DesignError, match=r"step is .*, but must be an index of the steps, 0 to .*ax=\.\.\."):
        drawn.plot(Figure().add_subplot())


def comparable():
    """Pairs of values that one may want on the same axes."""
    spring = gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=200)
    laws = "3-4-5", "cycloidal"
    motions = [
        gc.Motion([gc.Rise(20, 2.0, law), gc.Dwell(1.0), gc.Return(20, 2.0, law), gc.Dwell(REST)]) for law in laws
    ]
    cams = [gc.Cam(motion, gc.Translating(0, 8), 40) for motion in motions]
    forces = [gc.CamForces(cam, spring) for cam in cams]
    yield motions
    yield cams
    yield forces
    yield [gc.ContactStress(each, gc.RollerContact(width=10)) for each in forces]
    yield [gc.motion_bands(cam, gc.MakingErrors(offset=0.05), samples=20) for cam in cams]
    yield [gc.shock_spectrum(law) for law in laws]
    yield [gc.follower_response(law, 3.0) for law in laws]


REST = 2 * np.pi - 5.0


def test_two_values_stand_on_one_pair_of_axes_by_name_and_colour():
    for first, second in comparable():
        axes = first.plot(label="first", color="tab:green")
        assert second.plot(ax=axes, label="second", color="tab:red") is axes
        diagrams = axes.child_axes or [axes]
        named = {line.get_label() for diagram in diagrams for line in diagram.lines}
        assert any("first" in str(name) for name in named), first
        assert any("second" in str(name) for name in named), first
        colours = {line.get_color() for diagram in diagrams for line in diagram.lines}
        assert {"tab:green", "tab:red"} <= colours
        legends = [diagram.get_legend() for diagram in diagrams if diagram.get_legend()]
        assert any("second" in text.get_text() for text in legends[0].get_texts())
        axes.figure.canvas.draw()
        pyplot.close("all")


def test_the_curves_of_forces_and_stress_are_their_values():
    _, _, forces, stresses, *_ = comparable()
    normal, torque = (diagram.lines[0].get_xydata().T for diagram in forces[0].plot().child_axes)
    for (phi, drawn), name in ((normal, "normal"), (torque, "torque")):
        found = [getattr(forces[0].at(np.radians(phi), side=side), name) for side in ("left", "right")]
        assert np.minimum(*(np.abs(drawn - each) for each in found)).max() < 1e-6 * np.abs(drawn).max()
    _, pressure = stresses[0].plot().lines[0].get_xydata().T
    assert pressure.max() == pytest.approx(stresses[0].max_pressure().value, rel=1e-3)


def test_a_drawing_takes_a_colour_and_a_title(solution):
    axes = solution.drawn["integration"].plot(label="Integration", color="tab:red")
    assert axes.get_title() == "Integration"
    assert {artist.colour for artist in axes.artists} == {"tab:red"}
    axes.figure.canvas.draw()


def test_an_array_of_axes_is_told(solution):
    for thing in [*things(solution), *(first for first, _ in comparable())]:
        with pytest.raises(gc.DesignError, match=r"ax is an array of 2 axes, .* write ax=axes\[0\]"):
            thing.plot(ax=Figure().subplots(2))
        with pytest.raises(gc.DesignError, match="ax is of the kind str, but must be axes of matplotlib"):
            thing.plot(ax="left")
        with pytest.raises(TypeError, match="no argument 'axes' any more: write 'ax'"):
            thing.plot(axes=Figure().add_subplot())


@pytest.mark.parametrize(
    ("size", "names", "step"), [((7, 7), "name", 30), ((6, 2), "symbol", 30), ((4.2, 3), "symbol", 60)]
)
def test_on_low_axes_ordinates_have_symbols_and_the_turn_fewer_divisions(size, names, step):
    axes = Figure(figsize=size).add_subplot()
    motion = gc.builtin_task().motion()
    diagrams = motion.plot(ax=axes).child_axes
    assert [each.get_ylabel() for each in diagrams] == (
        ["s", "v", "a", "j"] if names == "symbol" else ["lift s", "v = ds/dφ", "a = dv/dφ", "j = da/dφ"]
    )
    assert np.unique(np.diff(diagrams[-1].get_xticks())).tolist() == [step]
    # No name stands on the next one.
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    boxes = [each.yaxis.label.get_window_extent(canvas.get_renderer()) for each in diagrams]
    assert all(upper.y0 >= lower.y1 for upper, lower in pairwise(boxes))
    assert all(box.x0 >= 0 for box in boxes)
