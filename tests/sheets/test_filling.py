"""Pages are filled as a draughtsman fills them: on few sheets, nothing on anything else, and in the middle."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations, pairwise

import numpy as np
import pytest
from scene import TITLE

from graphcam.drafting.ink import Step, View, say
from graphcam.drafting.marks import Line, Role
from graphcam.sheets.box import Box
from graphcam.sheets.filling import GAPS, Leaf, fill
from graphcam.sheets.formats import MARGINS, ORIENTATIONS, SIZES, Format, Lettering
from graphcam.sheets.frame import taken
from graphcam.sheets.layout import SheetPart, compose, compose_parts, profile_room
from graphcam.sheets.model import Drawing, Strokes, Text
from graphcam.sheets.panels import Panel
from graphcam.sheets.sampling import box_of
from graphcam.sheets.tables import Block, Table, table_block

LETTERS = Lettering(3.5, 2.5, 2.5)


def view(name: str, wide: float, high: float, across: str = "", up: str = "") -> Panel:
    """A frame of that size in lines, with axes of its own unless they are shared."""
    shown = View(name, say(name), across or f"x {name}", up or f"y {name}")
    return Panel(shown, (rectangle(wide, high),), LETTERS)


def rectangle(wide: float, high: float) -> Line:
    return Line(np.array([0, wide, wide + 1j * high, 1j * high]), Role.CURVE, closed=True)


def block(wide: float, high: float) -> Block:
    return Block((), (), Box(0, 0, wide, high))


def origins(leaves: list[Leaf]) -> dict[str, tuple[int, complex]]:
    return {name: (k, at) for k, leaf in enumerate(leaves) for name, (_, at) in leaf.views.items()}


MANY = [view("a", 90, 60, "phi", "a"), view("b", 80, 40, "phi", "s"), view("c", 50, 45, "e", "s"), view("d", 100, 90)]
EVERY = [Format(paper, frame, lie) for paper in SIZES for frame in MARGINS for lie in ORIENTATIONS]


@pytest.mark.parametrize("sheet", EVERY, ids=repr)
def test_everything_stands_once_inside_the_border_and_on_nothing_else(sheet):
    blocks = [block(70, 30), block(40, 20), block(60, 12)]
    leaves = fill(sheet, MANY, [blocks])
    names = [name for leaf in leaves for name in leaf.views]
    assert sorted(names) == list("abcd")
    assert [b for leaf in leaves for b, _ in leaf.blocks] == blocks or len(leaves) > 1
    assert sum(len(leaf.blocks) for leaf in leaves) == 3
    inside = sheet.content.grown(-4.0)
    for leaf in leaves:
        tables = [b.box.moved(at) for b, at in leaf.blocks]
        covered = [box.moved(at) for panel, at in leaf.views.values() for box in panel.footprint]
        assert all(inside.grown(1e-6).holds(box) for box in tables + covered)
        kept = taken(sheet, 4.0)
        assert not any(box.grown(-1e-6).meets(other) for box in tables + covered for other in kept)
        # Six millimetres lie between things that do not belong together.
        assert not any(a.grown(5.999).meets(b) for a, b in combinations(tables, 2))
        for panel, at in leaf.views.values():
            for box in (table.grown(5.999) for table in tables):
                assert not box.meets(panel.title_box.moved(at))
                there = panel.points + at
                across, up = (box.left < there.real) & (there.real < box.right), (box.bottom < there.imag)
                assert not np.any(across & up & (there.imag < box.top))


def test_tables_stand_six_millimetres_apart():
    (leaf,) = fill(Format("A3", "iso"), [], [[block(70, 30), block(40, 30), block(60, 30)]])
    column = sorted((b.box.moved(at) for b, at in leaf.blocks), key=lambda box: box.bottom)
    assert [upper.bottom - lower.top for lower, upper in pairwise(column)] == [6.0, 6.0]


@pytest.mark.parametrize("sheet", EVERY, ids=repr)
def test_views_that_share_an_axis_stand_in_line_wherever_they_stand_together(sheet):
    found = origins(fill(sheet, MANY, [[]]))
    (page_a, a), (page_b, b), (page_c, c) = (found[name] for name in "abc")
    assert page_a != page_b or a.real == b.real
    assert page_a != page_b or a.imag > b.imag
    assert page_b != page_c or b.imag == c.imag
    assert page_b != page_c or c.real > b.real
    assert {"A1": 1, "A2": 1}.get(sheet.name, 3) >= len({page_a, page_b, page_c})


def test_a_page_is_begun_only_where_there_is_no_room_on_the_others():
    sheet = Format("A4", "gost")
    assert len(fill(sheet, [view("a", 100, 80)], [[]])) == 1
    assert len(fill(sheet, [view("a", 100, 80), view("b", 100, 80)], [[]])) == 1
    assert len(fill(sheet, [view(name, 140, 100) for name in "abc"], [[]])) == 3
    assert len(fill(sheet, [view("a", 100, 80)], [[block(60, 30)]])) == 1
    assert len(fill(sheet, [view("a", 230, 120)], [[block(180, 60)]])) == 2
    assert len(fill(sheet, [], [[]])) == 1


def test_of_the_ways_to_set_tables_the_first_is_taken_that_needs_no_further_page():
    sheet = Format("A4", "gost")
    large, small = [block(190, 60)], [block(90, 12)]
    (leaf,) = fill(sheet, [view("a", 230, 80)], [large, small])
    assert [b for b, _ in leaf.blocks] == small
    (leaf,) = fill(sheet, [view("a", 100, 50)], [small, large])
    assert [b for b, _ in leaf.blocks] == small


@pytest.mark.parametrize(
    "sheet", [Format("A2", "gost"), Format("A3", "iso"), Format("A4", "iso", "portrait")], ids=repr
)
def test_what_stands_alone_on_a_page_stands_in_the_middle_of_what_is_free(sheet):
    (leaf,) = fill(sheet, [view("a", 60, 40)], [[]])
    panel, at = leaf.views["a"]
    free = sheet.content.grown(-4.0)
    footprint = [box.moved(at) for box in panel.footprint]
    left, right = min(b.left for b in footprint) - free.left, free.right - max(b.right for b in footprint)
    assert abs(left - right) <= 30.0
    low, high = min(b.bottom for b in footprint) - free.bottom, free.top - max(b.top for b in footprint)
    # The title block takes of the lower part only.
    assert low - high >= -4.0


def test_diagrams_in_a_column_stand_as_far_apart_as_the_page_has_room():
    assert GAPS == (24.0, 12.0, 6.0, 2.0, -2.0)
    heights = {60.0: 24.0, 64.0: 12.0, 70.0: 6.0, 73.0: 2.0, 76.0: -2.0}
    for high, gap in heights.items():
        (leaf,) = fill(Format("A3", "gost"), [view(name, 100, high, "phi") for name in "abc"], [[]])
        boxes = [panel.box.moved(at) for panel, at in leaf.views.values()]
        apart = [upper.bottom - lower.top for upper, lower in pairwise(boxes)]
        assert apart == pytest.approx([gap, gap]), high


def test_what_is_larger_than_a_page_is_reduced_by_a_standard_ratio_with_all_that_shares_its_axes():
    sheet = Format("A4", "gost")
    for wide, factor in ((240, 1.0), (270, 1 / 2), (530, 1 / 2.5), (20000, 1 / 100), (30000, 1e-3)):
        (leaf,) = fill(sheet, [view("a", wide, 20)], [[]])
        assert leaf.views["a"][0].factor == factor
    leaves = fill(sheet, [view("a", 400, 20, "phi"), view("b", 50, 20, "phi"), view("c", 50, 20)], [[]])
    factors = {name: panel.factor for leaf in leaves for name, (panel, _) in leaf.views.items()}
    assert factors == {"a": 0.5, "b": 0.5, "c": 1.0}


def test_a1_parts_columns_before_it_reduces_and_never_what_stands_one_under_the_other():
    sheet = Format("A1", "gost")
    side = [view("a", 500, 60, "phi", "s"), view("b", 500, 60, "e", "s")]
    leaves = fill(sheet, side, [[]])
    assert {panel.factor for leaf in leaves for panel, _ in leaf.views.values()} == {1.0}
    column = [view(name, 300, 250, "phi") for name in "abc"]
    (leaf,) = fill(sheet, column, [[]])
    assert {panel.factor for panel, _ in leaf.views.values()} == {0.5}
    # On smaller sheets each stands on one of its own instead.
    leaves = fill(Format("A2", "gost"), [view(name, 300, 250, "phi") for name in "abc"], [[]])
    assert [len(leaf.views) for leaf in leaves] == [1, 1, 1]
    assert {panel.factor for leaf in leaves for panel, _ in leaf.views.values()} == {1.0}


def middle(leaf: Leaf, name: str) -> complex:
    panel, at = leaf.views[name]
    return at + complex(panel.content.left + panel.content.right, panel.content.bottom + panel.content.top) / 2


@pytest.mark.parametrize(
    ("sheet", "sides"),
    [
        # The largest drawing, then the small one; on A1 the cam stands at the upper right, on standing ones below.
        (Format("A1", "gost"), (1, 1)),
        (Format("A1", "gost", "portrait"), (-1, -1)),
        (Format("A2", "gost"), (-1, 0)),
        (Format("A2", "gost", "portrait"), (0, 1)),
    ],
    ids=repr,
)
def test_the_largest_drawing_leaves_the_most_room(sheet, sides):
    """Diagrams in its neighbourhood stand on the other side."""
    scale = 1 if sheet.name == "A1" else 0.7
    diagrams = [view(name, 200 * scale, 100 * scale, "phi") for name in "ab"]
    (leaf,) = fill(sheet, [*diagrams, view("cam", 250 * scale, 200 * scale), view("plan", 50, 40)], [[]])
    away = middle(leaf, "cam") - middle(leaf, "a")
    across, up = sides
    assert not across or np.sign(away.real) == across or np.sign(away.imag) == up
    assert sum(len(leaf.views) for leaf in [leaf]) == 4


def steps(*parts: tuple[str, float, float]) -> list[tuple[str, Step]]:
    def marks(wide: float, high: float) -> tuple[Line, ...]:
        return rectangle(wide, high), rectangle(wide / 2, high / 2)

    return [
        (name, Step(say("."), say("."), View(name, say(name), f"x {name}", f"y {name}"), marks(wide, high)))
        for name, wide, high in parts
    ]


def test_pages_come_in_the_order_of_their_first_step():
    drawn = compose(steps(("late", 50, 40), ("large", 240, 105), ("wide", 240, 90)), [], TITLE, "A4")
    named = [[g.name.split()[1] for g in page.groups if g.key.startswith("step")] for page in drawn.pages]
    assert [names[0] for names in named] == sorted((names[0] for names in named), key=["late", "large", "wide"].index)
    assert len(named) > 1


def page_texts(drawn: Drawing, key: str) -> list[str]:
    return [e.text for p in drawn.pages for g in p.groups if g.key == key for e in g.entities if isinstance(e, Text)]


def test_an_unfinished_sheet_shows_what_is_given_and_the_steps_so_far_at_the_same_places():
    axis, curve = (Line(np.array([0, 50 + 10j * k]), Role.CURVE) for k in range(2))
    found = View("s", say("Scale, 1.2 mm"), "phi", "s", answer=say("1.2"), found_by="second")
    first = Step(say("."), say("."), View("a", say("First"), "x", "y"), (axis,))
    second = Step(say("."), say("."), found, (axis, curve), given=(axis,))
    table = Table("T", ("q", "v"), (("lift", "30"),), frozenset({(0, 1)}))
    part = SheetPart(((1, "first", first), (2, "second", second)), (table,), ("A note.",))
    sheet = Format("A3", "gost")
    whole = compose_parts([part], TITLE, sheet)
    assert page_texts(whole, "tables") == ["T", "q", "v", "lift", "30", "1. A note."]
    assert {"1.2 mm"} <= set(page_texts(whole, "titles"))
    for upto, drawn_steps, counts in (
        (0, ["second"], [1]),
        (1, ["first", "second"], [1, 1]),
        (2, ["first", "second"], [1, 2]),
    ):
        partly = compose_parts([part], TITLE, sheet, upto)
        groups = {g.name.split()[1]: g for p in partly.pages for g in p.groups if g.key.startswith("step")}
        assert list(groups) == drawn_steps
        assert [len(g.entities) for g in groups.values()] == counts
        # Unfinished, it holds neither answers in tables nor notes.
        assert page_texts(partly, "tables") == ["T", "q", "v", "lift"]
        assert ("1.2 mm" in page_texts(partly, "titles")) == (upto >= 2)
        assert ("_____ mm" in page_texts(partly, "titles")) == (upto < 2)
        for name, group in groups.items():
            (there,) = (g for p in whole.pages for g in p.groups if g.name.endswith(f" {name}"))
            for entity, same in zip(group.entities, there.entities, strict=False):
                np.testing.assert_array_equal(entity.points, same.points)


def test_a_page_knows_where_its_views_stand_true_to_scale():
    drawn = compose(steps(("true", 50, 40), ("reduced", 900, 20)), [], TITLE, "A4")
    places = {name: (k, at) for k, page in enumerate(drawn.pages) for name, at in page.origins.items()}
    assert set(places) == {"true"}
    k, at = places["true"]
    (group,) = (g for g in drawn.pages[k].groups if g.name.endswith(" true"))
    assert group.entities[0].points[0] == at


def test_a_table_wider_than_the_sheet_is_set_in_smaller_letters():
    columns = tuple(f"column of many {k}" for k in range(30))
    wide = Table("T", columns, (columns,))
    room = Format("A4", "gost").content.width - 8 - 4
    drawn = compose([], [wide], TITLE, "A4")
    entities = [e for p in drawn.pages for g in p.groups if g.key == "tables" for e in g.entities]
    assert box_of(e for e in entities if isinstance(e, Strokes)).width == pytest.approx(room, rel=1e-6)
    (height,) = {e.height for e in entities if isinstance(e, Text)}
    assert height == pytest.approx(2.5 * room / table_block(wide, 2.5).box.width)


def test_notes_are_180_mm_wide_at_most_and_no_wider_than_the_sheet():
    long = "word " * 150
    for paper, orientation, room in (("A1", "landscape", 180.0), ("A4", "portrait", 180.0 - 7)):
        drawn = compose([], [], TITLE, paper, notes=[long], orientation=orientation)
        texts = [
            e for p in drawn.pages for g in p.groups if g.key == "tables" for e in g.entities if isinstance(e, Text)
        ]
        box = box_of(texts)
        assert box.width <= room
        assert box.width > room - 25


@pytest.mark.parametrize(
    ("paper", "frame", "orientation", "room"),
    [
        ("A1", "gost", "landscape", (808 - 424, 576 - 170)),
        ("A1", "iso", "landscape", (803 - 424, 566 - 170)),
        ("A1", "gost", "portrait", (561 - 185, 823 - 445)),
        # Above the title block or beside it, whichever leaves the larger square.
        ("A2", "gost", "landscape", (561 - 185, 402 - 12)),
        ("A2", "iso", "portrait", (382, 566 - 36 - 12)),
        ("A3", "gost", "landscape", (387, 279 - 55 - 12)),
        ("A4", "iso", "landscape", (259, 182 - 36 - 12)),
        ("A4", "gost", "portrait", (177, 279 - 55 - 12)),
    ],
)
def test_the_room_for_the_profile_is_what_diagrams_and_title_block_leave(paper, frame, orientation, room):
    assert profile_room(paper, frame, orientation) == room


def test_parts_stand_on_sheets_of_their_own_that_are_numbered_through():
    parts = [SheetPart(((k, name, step),)) for k, (name, step) in enumerate(steps(("a", 50, 40), ("b", 40, 40)), 1)]
    drawn = compose_parts(parts, replace(TITLE, name="Cam"), Format("A3", "gost"))
    assert len(drawn.pages) == 2
    assert drawn.title == "Cam"
    for number, page in enumerate(drawn.pages, 1):
        said = {e.text for g in page.groups if g.key == "frame" for e in g.entities if isinstance(e, Text)}
        assert {f"Sheet {number}", "Sheets 2"} <= said
        assert (page.width, page.height, page.frame) == (420, 297, Format("A3", "gost").content)
        assert [g.key for g in page.groups] == ["frame", "titles", f"step-0{number}"]
