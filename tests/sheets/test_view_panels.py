"""A view with its title: the room that it needs holds all of it, and the title keeps off the drawing."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import shapely
from scene import SHEETS

from graphcam.drafting.ink import Part, Step, View, say
from graphcam.drafting.marks import Circle, Label, Line, Mark, Role
from graphcam.sheets.formats import Format, Lettering
from graphcam.sheets.model import Box
from graphcam.sheets.sampling import box_of, pieces, sampled
from graphcam.sheets.text_measures import extent, width
from graphcam.sheets.view_panels import Panel, are_disjoint, clusters, panel_origins, panels, shares

LETTERS = Lettering(5.0, 3.5, 2.5)
STAR = 40 * (1 + 0.5 * (-1) ** np.arange(12)) * np.exp(2j * np.pi * np.arange(12) / 12)


def line(*points: complex) -> Line:
    return Line(np.array(points, dtype=complex), Role.CURVE)


def panel(*marks: Mark, title: str = "A view", factor: float = 1.0, **view: str) -> Panel:
    axes = {"across": "x", "up": "y"} | view
    return Panel(View("view", say(title), **axes), marks, LETTERS, factor)


VIEWS = {
    "line": panel(line(0, 60 + 40j)),
    "star": panel(Line(STAR, Role.RESULT, closed=True)),
    "hill": panel(
        line(*(x + 30j * np.exp(-(((x - 70) / 12) ** 2)) for x in range(0, 140, 2))), title="A hill, on a plain"
    ),
    "labelled": panel(line(0, 20 + 5j), Label(20 + 5j, "far to the right", 1 + 0j), Label(0j, "B", -1 + 0j)),
    "reduced": panel(line(0, 300 + 40j), factor=0.5, title="A long one, with a note"),
    "tiny": panel(Circle(5j, 2.0, Role.RESULT), title="A title that is far wider than what it is the title of"),
}
each_view = pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)


@each_view
def test_the_content_holds_all_lines_and_labels_with_3_mm_about_them(view):
    found = Box(view.points.real.min(), view.points.imag.min(), view.points.real.max(), view.points.imag.max())
    assert [view.content.left, view.content.bottom] == pytest.approx([found.left - 3, found.bottom - 3])
    assert [view.content.right, view.content.top] == pytest.approx([found.right + 3, found.top + 3])


def test_a_label_is_part_of_the_content():
    wide, _, _ = extent("far to the right", 3.5)
    assert VIEWS["labelled"].content.right == pytest.approx(20 + 1.2 + wide + 3)
    assert VIEWS["reduced"].content.width == pytest.approx(156)
    assert (panel().content.width, panel().content.height) == (7, 7)


def test_points_lie_a_millimetre_apart_on_all_that_is_drawn():
    points = VIEWS["line"].points
    assert np.abs(np.diff(points)).max() <= 1.0
    assert (points[0], points[-1]) == (0, 60 + 40j)


def above(one, other) -> bool:
    """Whether a text stands a line or more above another."""
    return one.at.imag - other.at.imag >= 1.7 * min(one.height, other.height) - 1e-9


@each_view
def test_a_title_has_its_lines_one_under_the_other(view):
    for upper, lower in pairwise(view.heading):
        assert above(upper, lower) or upper.at.imag == lower.at.imag
    # The base line of the last one is a fifth of a large letter above its lower edge.
    assert min(text.at.imag for text in view.heading) == pytest.approx(0.2 * LETTERS.title)


def test_a_note_follows_behind_a_comma_in_small_letters():
    name, note = panel(line(0, 140 + 1j), title="A hill, on a plain").heading
    assert (name.text, name.height, name.at) == ("A hill", 5.0, 3 + 1j)
    assert (note.text, note.height) == ("on a plain", 3.5)
    # A large letter behind it, on the same base line.
    assert note.at == pytest.approx(3 + width("A hill", 5.0) + 5.0 + 1j)


def test_a_note_that_does_not_fit_stands_below():
    long = "on a plain that goes on for a good while, and on"
    name, *notes = panel(line(0, 60 + 1j), title=f"A hill, {long}").heading
    assert " ".join(note.text for note in notes) == long
    assert {note.height for note in notes} == {3.5}
    assert len(notes) == 2
    # Seventeen large letters are wide enough also over a narrow drawing.
    assert max(width(note.text, 3.5) for note in notes) <= 85.0
    assert [name.at.imag - notes[0].at.imag, notes[0].at.imag - notes[1].at.imag] == pytest.approx([1.7 * 3.5] * 2)
    assert {text.at.real for text in (name, *notes)} == {3}


@pytest.mark.parametrize("over", [0.01, -0.01])
def test_a_note_follows_as_long_as_the_room_is_wide(over):
    wide = width("A hill", 5.0) + 5.0 + width("on a plain that goes on and on and on", 3.5) + over
    found = panel(line(0, wide - 6 + 1j), title="A hill, on a plain that goes on and on and on").heading
    assert wide > 85.0
    assert (found[0].at.imag == found[-1].at.imag) == (over > 0)


@each_view
def test_the_title_stands_in_its_box_and_keeps_off_the_drawing(view):
    texts = view.title(0j)
    box = view.title_box
    letters = box_of(texts)
    # Tails may reach below it, where a millimetre and a half are free.
    assert Box(box.left, box.bottom - 1.5, box.right, box.top).holds(letters)
    assert min(text.at.imag for text in texts) == pytest.approx(box.bottom + 0.2 * LETTERS.title)
    assert box.top - max(text.at.imag for text in texts) >= 1.5 * LETTERS.label
    assert [text.text for text in texts] == [text.text for text in view.heading if text.text]
    for text in texts:
        # Lines may come no nearer to the letters than a millimetre and a half.
        corners = box_of([text])
        near = Box(corners.left - 1.5, corners.bottom - 1.5, corners.right + 1.5, corners.top + 1.5)
        inside = (view.points.real > near.left) & (view.points.real < near.right)
        assert not np.any(inside & (view.points.imag > near.bottom) & (view.points.imag < near.top))
    wide = max(text.at.real + width(text.text, text.height) for text in view.heading)
    assert box.width == pytest.approx(wide + 3)
    assert view.title(50 + 20j)[0].at == pytest.approx(texts[0].at + 50 + 20j)
    assert {text.view for text in texts} == {"view"}
    assert view.box.holds(box)
    assert view.box.holds(view.content)


def test_the_title_begins_over_the_left_end_of_the_drawing_or_at_the_axis_of_a_diagram():
    assert VIEWS["line"].title_box.left == pytest.approx(4.0)
    assert VIEWS["star"].title_box.left == pytest.approx(VIEWS["star"].content.left)
    assert panel(line(10, 60 + 4j)).title_box.left == pytest.approx(7.0)
    # An axis stands at the left if less than a quarter of the drawing lies beyond it.
    assert panel(line(-6.9, 27 + 4j)).title_box.left == pytest.approx(4.0)
    assert panel(line(-7, 27 + 4j)).title_box.left == -10.0


def test_the_title_comes_down_beside_what_is_high():
    """Over the plain before the hill, no lower than the plain leaves room."""
    box, content = VIEWS["hill"].title_box, VIEWS["hill"].content
    assert box.bottom == pytest.approx(content.top - box.height, abs=2)
    assert VIEWS["line"].title_box.bottom == pytest.approx(VIEWS["line"].content.top - 8.5, abs=2)
    flat = panel(line(0, 60))
    assert flat.title_box.bottom == pytest.approx(flat.content.top, abs=2)


@each_view
def test_the_outline_covers_all_that_is_drawn_and_its_title_with_3_mm_about_them(view):
    for shift in (3, -3, 3j, -3j):
        # Where the outline is round it is followed to 0.2 mm.
        points = np.concatenate([view.points, view.title_box.grown(-3).corners]) + 0.93 * shift
        covered = [
            (b.left <= points.real) & (points.real <= b.right) & (b.bottom <= points.imag) & (points.imag <= b.top)
            for b in view.outline
        ]
        assert np.any(covered, axis=0).all()
    assert all(view.box.grown(1e-9).holds(box) for box in view.outline)


def test_the_outline_leaves_the_corners_beyond_it_free_but_nothing_inside_it():
    steep = panel(line(0, 100 + 300j), title="")
    # Below the title it is a triangle.
    covered = shapely.union_all([shapely.box(b.left, b.bottom, b.right, b.top) for b in steep.outline])
    assert covered.area < 0.65 * steep.content.area
    # Between the legs of a V, which a line from one to the other encloses, there is no room.
    legs = panel(line(-50 + 100j, 0, 50 + 100j), title="")
    assert any(Box(-5, 60, 5, 62).meets(box) for box in legs.outline)


@each_view
def test_the_empty_parts_of_a_drawing_are_3_mm_away_from_its_lines(view):
    room = view.hollow
    assert room.corner == view.content.corner
    free = np.argwhere(~room.full)
    for y, x in free:
        low = room.corner + 2 * complex(x, y)
        assert not Box(low.real, low.imag, low.real + 2, low.imag + 2).grown(-1e-6).meets(view.title_box)
        beyond = view.points - low - (1 + 1j)
        # From the middle of the cell a cell and two more.
        assert np.maximum(np.abs(beyond.real), np.abs(beyond.imag)).min() > 4.0
    assert len(free) or view.content.height < 30


def test_a_title_has_a_blank_for_what_is_only_found_by_drawing():
    view = View("v", say("Scale, 1.2 mm"), "x", "y", answer=say("1.2"))
    found = Panel(view, (line(0, 60 + 4j),), LETTERS)
    assert [t.text for t in found.title(0j, answered=True)] == ["Scale", "1.2 mm"]
    assert [t.text for t in found.title(0j, answered=False)] == ["Scale", "_____ mm"]
    plain = Panel(View("v", say("Scale, 1.2 mm"), "x", "y"), (line(0, 60 + 4j),), LETTERS)
    assert [t.text for t in plain.title(0j, answered=False)] == ["Scale", "1.2 mm"]


def named(name: str, across: str, up: str, *marks: Mark) -> Panel:
    return Panel(View(name, say(name), across, up), marks or (line(0, 50 + 20j),), LETTERS)


def test_views_share_an_axis_directly_or_through_others():
    a, b, c, d = named("a", "phi", "a"), named("b", "phi", "s"), named("c", "e", "s"), named("d", "x", "y")
    assert shares(a, [d, b])
    assert not shares(a, [c, d])
    assert shares(b, [c])
    found = [{p.view.name for p in cluster} for cluster in clusters([a, d, c, b])]
    assert found == [{"d"}, {"a", "b", "c"}]
    assert clusters([]) == []


def test_steps_of_one_view_are_one_panel_with_its_last_title():
    def step(name: str, title: str, mark: Mark) -> Step:
        return Step(say("."), (Part(say(".")),), View(name, say(title), "x", "y"), (mark,))

    first, second, third = line(0, 1), line(0, 2), line(0, 3)
    found = panels([step("a", "early", first), step("b", "other", second), step("a", "late", third)], LETTERS)
    assert [(str(p.view.title), p.marks) for p in found] == [("late", (first, third)), ("other", (second,))]


def test_views_on_one_axis_stand_in_columns_and_rows_a_gap_apart():
    marks = {
        "a": line(-10 - 5j, 60 + 30j), "v": line(-20, 90 + 25j), "s": line(0, 70 + 40j), "d": line(-35 - 10j, 20 + 45j),
    }  # fmt: skip
    axes = {"a": ("phi", "a"), "v": ("phi", "v"), "s": ("phi", "s"), "d": ("e", "s")}
    group = [named(name, *axes[name], marks[name]) for name in "avsd"]
    for gap in (4.0, 12.0, -2.0):
        a, v, s, d = origins = panel_origins(group, gap)
        boxes = [p.box.moved(origin) for p, origin in zip(group, origins, strict=True)]
        assert (a.real, a.imag, v.real, s.real) == (0, 0, 0, 0)
        assert d.imag == s.imag
        for upper, lower in ((0, 1), (1, 2)):
            assert boxes[upper].bottom - boxes[lower].top == pytest.approx(gap)
        # The second column begins a gap to the right of the widest of the first.
        assert boxes[3].left - max(box.right for box in boxes[:3]) == pytest.approx(gap)
        assert are_disjoint(boxes) or gap < 0


def test_boxes_are_apart_if_no_two_overlap():
    boxes = [Box(0, 0, 2, 2), Box(2, 0, 4, 2), Box(0, 2, 2, 4)]
    assert are_disjoint(boxes)
    assert not are_disjoint([*boxes, Box(3, 1, 5, 5)])
    assert not are_disjoint([Box(1, 1, 3, 3), *boxes])
    assert are_disjoint([])


@pytest.mark.parametrize(
    ("paper", "letters"),
    [("A1", (5.0, 3.5, 2.5)), ("A2", (5.0, 3.5, 2.5)), ("A3", (3.5, 2.5, 2.5)), ("A4", (3.5, 2.5, 2.5))],
)
def test_letters_are_larger_on_sheets_that_hang_on_a_wall(paper, letters):
    assert Format(paper, "gost").lettering == Lettering(*letters)


@pytest.mark.parametrize(
    ("paper", "wide", "high"), [("A1", 841, 594), ("A2", 594, 420), ("A3", 420, 297), ("A4", 297, 210)]
)
def test_paper_has_the_size_of_iso_216_and_the_margins_of_its_frame(paper, wide, high):
    for orientation, size in (("landscape", (wide, high)), ("portrait", (high, wide))):
        for frame, margin in (("gost", 5), ("iso", 10)):
            if (paper, frame, orientation) not in SHEETS:
                continue
            found = Format(paper, frame, orientation)
            assert found.size == size
            assert found.content == Box(20, margin, size[0] - margin, size[1] - margin)
            assert found.is_upright == (orientation == "portrait")


def test_every_point_of_a_view_is_on_what_it_draws():
    drawn = [sampled(*pieces(e), 1.0) for e in VIEWS["star"]._entities]
    np.testing.assert_array_equal(np.concatenate(drawn), VIEWS["star"].points)


@pytest.mark.parametrize("depth", [3.0, 6.0, 8.0])
@pytest.mark.parametrize("middle", [120.0, 185.0, 250.0])
def test_the_outline_of_a_long_drawing_covers_what_sticks_out_in_its_middle(depth, middle):
    """A curve that errors of drawing let sink below the axis: the hull's directions pass it by."""
    found = panel(line(0j, 370 + 0j), line(370 + 0j, 370 + 40j), line(middle - 40, middle - 1j * depth, middle + 40))
    for point in found.points:
        assert any(
            box.left <= point.real <= box.right and box.bottom <= point.imag <= box.top for box in found.outline
        ), point
