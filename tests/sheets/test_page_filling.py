"""Pages are filled as a draughtsman fills them: on few sheets, nothing on anything else, and in the middle."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import combinations, pairwise

import numpy as np
import pytest
import shapely
from overlaps import overlaps
from scene import SHEETS, TITLE

import graphcam as gc
from graphcam.drafting.ink import Part, Step, View, say
from graphcam.drafting.marks import Line, Role
from graphcam.sheets.formats import Format, Lettering
from graphcam.sheets.layout import SheetPart, compose, compose_parts, profile_room
from graphcam.sheets.model import Box, Drawing, Strokes, Text
from graphcam.sheets.page_filling import DIAGRAM_GAPS, MAX_EMPTY_SHARE, fill, min_pages
from graphcam.sheets.page_space import OpenPage, blank_page, free_rooms, kept_area
from graphcam.sheets.sampling import box_of
from graphcam.sheets.sheet_frame import taken_boxes
from graphcam.sheets.tables import Block, Table, table_blocks
from graphcam.sheets.view_panels import Panel

LETTERS = Lettering(3.5, 2.5, 2.5)


def view(name: str, wide: float, high: float, across: str = "", up: str = "") -> Panel:
    """A frame of that size in lines, with axes of its own unless they are shared."""
    shown = View(name, say(name), across or f"x {name}", up or f"y {name}")
    return Panel(shown, (rectangle(wide, high),), LETTERS)


def rectangle(wide: float, high: float) -> Line:
    return Line(np.array([0, wide, wide + 1j * high, 1j * high]), Role.CURVE, closed=True)


def block(wide: float, high: float) -> Block:
    return Block((), (), Box(0, 0, wide, high))


def origins(leaves: list[OpenPage]) -> dict[str, tuple[int, complex]]:
    return {name: (k, at) for k, leaf in enumerate(leaves) for name, (_, at) in leaf.views.items()}


MANY = [view("a", 90, 60, "phi", "a"), view("b", 80, 40, "phi", "s"), view("c", 50, 45, "e", "s"), view("d", 100, 90)]
EVERY = [Format(*each) for each in SHEETS]


@pytest.mark.parametrize("sheet", EVERY, ids=repr)
def test_views_that_more_than_fill_a_page_need_another(sheet):
    shown = view("a", 90, 60)
    on_one = int((sheet.content.area - kept_area(sheet)) / shown.box.area)
    assert [min_pages(sheet, [shown] * count) for count in (1, on_one, on_one + 1, 2 * on_one + 2)] == [1, 1, 2, 3]


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
        # The boxes of views have 3 mm of air about what is drawn.
        drawn = [panel.box.grown(-3.0).moved(at) for panel, at in leaf.views.values()]
        assert all(inside.grown(1e-6).holds(box) for box in tables + drawn)
        kept = taken_boxes(sheet, 4.0)
        assert not any(box.grown(-1e-6).meets(other) for box in tables + drawn for other in kept)
        # Six millimetres lie between things that do not belong together, and four between diagrams in line.
        assert not any(a.grown(5.999).meets(b) for a, b in combinations(tables, 2))
        assert not any(a.grown(3.999).meets(b) for a, b in combinations(drawn, 2))
        for panel, at in leaf.views.values():
            for box in (table.grown(4.999) for table in tables):
                assert not box.grown(-2.0).meets(panel.title_box.moved(at))
                there = panel.points + at
                across, up = (box.left < there.real) & (there.real < box.right), (box.bottom < there.imag)
                assert not np.any(across & up & (there.imag < box.top))


def test_what_stands_on_a_page_is_moved_apart_where_that_leaves_less_room_empty():
    sheet = Format("A4", "gost")
    upper, lower, table = view("a", 100, 40), view("b", 60, 30), block(50, 20)
    close = {"a": (upper, 40 + 220j), "b": (lower, 40 + 170j)}
    page = OpenPage(sheet, blank_page(sheet).room, [], [], close, [(table, 130 + 170j)])
    apart = page.spread()
    assert apart.empty_share < 0.7 * page.empty_share
    boxes = [panel.box.moved(at) for panel, at in apart.views.values()] + [table.box.moved(apart.blocks[0][1])]
    assert not any(a.meets(b) for a, b in combinations([*boxes, *taken_boxes(sheet, 0.0)], 2))
    assert all(sheet.content.holds(box) for box in boxes)


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
    # Side by side they are parted where they would take another page.
    assert page_b != page_c or b.imag == c.imag or sheet.name == "A4"
    assert page_b != page_c or c.real > b.real
    assert {"A1": 1, "A2": 1}.get(sheet.name, 3) >= len({page_a, page_b, page_c})


def test_a_page_is_begun_only_where_there_is_no_room_on_the_others():
    sheet = Format("A4", "iso")
    assert len(fill(sheet, [view("a", 100, 80)], [[]])) == 1
    assert len(fill(sheet, [view("a", 100, 80), view("b", 100, 80)], [[]])) == 1
    assert len(fill(sheet, [view(name, 140, 100) for name in "abc"], [[]])) == 3
    assert len(fill(sheet, [view("a", 100, 80)], [[block(60, 30)]])) == 1
    assert len(fill(sheet, [view("a", 230, 90)], [[block(180, 60)]])) == 2
    assert len(fill(sheet, [], [[]])) == 1


def test_of_the_ways_to_set_tables_the_first_is_taken_that_needs_no_further_page():
    sheet = Format("A4", "iso")
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
    box = panel.box.moved(at)
    left, right = box.left - free.left, free.right - box.right
    assert abs(left - right) <= 30.0
    low, high = box.bottom - free.bottom, free.top - box.top
    # The title block takes of the lower part only.
    assert low - high >= -4.0


def test_diagrams_in_a_column_stand_as_far_apart_as_the_page_has_room():
    assert DIAGRAM_GAPS == (24.0, 12.0, 6.0, 2.0, -2.0)
    heights = {46.0: 24.0, 53.0: 12.0, 59.0: 6.0, 62.0: 2.0, 64.0: -2.0}
    for high, gap in heights.items():
        (leaf,) = fill(Format("A3", "gost"), [view(name, 310, high, "phi") for name in "abc"], [[]])
        boxes = [panel.box.moved(at) for panel, at in leaf.views.values()]
        apart = [upper.bottom - lower.top for upper, lower in pairwise(boxes)]
        assert apart == pytest.approx([gap, gap]), high


@pytest.mark.parametrize("sheet", EVERY, ids=repr)
def test_what_a_page_has_room_for_is_known_beforehand(sheet):
    """A view of each of the largest sizes fits, but for the grid on which room is found, and no larger one does."""
    for wide, high in free_rooms(sheet):
        if wide < 160 or high < 60:
            continue  # its title would be wider
        # About a frame there are 3 mm, and above it the title.
        around = view("a", 100, 50).box
        size = wide - around.width + 100, high - around.height + 50
        (leaf,) = fill(sheet, [view("a", size[0] - 4, size[1] - 4)], [[]])
        assert set(leaf.views) == {"a"}
    widest, highest = max(w for w, _ in free_rooms(sheet)), max(h for _, h in free_rooms(sheet))
    for wide, high in ((widest, 20), (50, highest)):
        with pytest.raises(gc.DesignError, match=f"the view 'a' .* on {sheet.description}"):
            fill(sheet, [view("a", wide, high)], [[]])


def test_every_view_keeps_its_size_and_those_that_share_an_axis_are_parted_where_a_page_cannot_take_them():
    sheet = Format("A1", "gost")
    side = [view("a", 500, 60, "phi", "s"), view("b", 500, 60, "e", "s")]
    column = [view(name, 300, 250, "phi") for name in "abc"]
    for views in (side, column):
        leaves = fill(sheet, views, [[]])
        assert len(leaves) == 1
        assert {panel for leaf in leaves for panel, _ in leaf.views.values()} == {*views}
    # On smaller sheets each stands on one of its own.
    leaves = fill(Format("A2", "gost"), column, [[]])
    assert [len(leaf.views) for leaf in leaves] == [1, 1, 1]


def pages_of(sheet: Format, *views: Panel) -> list[str]:
    """The names of the views on each page."""
    return ["".join(leaf.views) for leaf in fill(sheet, views, [[]])]


def test_of_the_cuts_into_the_fewest_pages_that_is_taken_that_leaves_the_least_empty():
    """The second view fits on either page: on the first it fills what would be empty there."""
    sheet = Format("A3", "iso")
    views = [view("a", 360, 60), view("b", 360, 90), view("c", 300, 100), view("d", 60, 40)]
    assert pages_of(sheet, *views) == ["ab", "cd"]
    first, last = fill(sheet, views, [[]])
    assert first.empty_share <= MAX_EMPTY_SHARE + 0.05
    assert last.empty_share < 0.4


def test_views_that_share_an_axis_are_not_parted_without_need():
    """Either cut leaves as much empty."""
    sheet = Format("A3", "gost")
    related = [view("a", 360, 80), view("b", 360, 80, "phi"), view("c", 360, 80, "phi")]
    assert pages_of(sheet, *related) == ["a", "bc"]


def test_what_a_page_uses_are_the_boxes_of_views_and_tables_and_of_the_sheet_itself():
    sheet = Format("A3", "iso")
    (leaf,) = fill(sheet, [view("a", 100, 80)], [[block(60, 20)]])
    covered = leaf.views["a"][0].box.area + 60 * 20 + sum(box.area for box in taken_boxes(sheet, 0.0))
    assert leaf.used == pytest.approx(covered / (390 * 277))
    # A table inside a diagram takes no more of the page.
    diagrams = [view(name, 300, 60, "phi") for name in "ab"]
    (leaf,) = fill(sheet, diagrams, [[block(60, 20)]])
    assert leaf.used == pytest.approx(
        (sum(panel.box.area for panel, _ in leaf.views.values()) + sum(box.area for box in taken_boxes(sheet, 0.0)))
        / (390 * 277)
    )


def test_no_view_stands_on_a_page_before_one_that_the_work_has_before_it():
    sheet = Format("A4", "iso")
    large = [view(name, 230, 90) for name in "abc"]
    assert pages_of(sheet, *large) == ["a", "b", "c"]
    # What is small does not go back to room that is left before.
    assert pages_of(sheet, view("k", 40, 30), *large) == ["ka", "b", "c"]
    assert pages_of(sheet, *large[:2], view("k", 40, 30), large[2]) in (["a", "bk", "c"], ["a", "b", "kc"])
    assert pages_of(sheet, *large, view("k", 40, 30)) == ["a", "b", "ck"]


def test_no_diagram_of_a_column_is_passed_over():
    """The second is too high to stand under the first; the third goes with the second."""
    column = [view("a", 200, 80, "phi"), view("b", 200, 200, "phi"), view("c", 200, 15, "phi")]
    assert pages_of(Format("A3", "gost"), *column) == ["a", "bc"]


def test_a1_puts_views_into_the_corners_of_others_rather_than_on_another_page():
    """Triangles fill half of their boxes; between any two views of the page a straight line can be drawn."""
    sheet = Format("A1", "gost")

    def triangle(name: str, *corners: complex) -> Panel:
        shown = View(name, say(""), f"x {name}", f"y {name}")
        return Panel(shown, (Line(np.array(corners), Role.CURVE, closed=True),), LETTERS)

    def pair(wide: float, high: float) -> list[Panel]:
        return [triangle("a", 0, wide, 1j * high), triangle("b", wide, wide + 1j * high, 30 + 1j * high)]

    (leaf,) = fill(sheet, pair(600, 290), [[]])
    (a, at_a), (b, at_b) = leaf.views.values()
    assert a.box.moved(at_a).common(b.box.moved(at_b)) > 0
    # Six millimetres from line to line, less what the outlines miss.
    assert shapely.distance(*(hull(panel.points + at) for panel, at in leaf.views.values())) >= 5.0
    # On smaller formats the boxes keep off each other.
    assert len(fill(Format("A2", "gost"), pair(400, 200), [[]])) == 2


def hull(points: np.ndarray) -> shapely.Geometry:
    return shapely.convex_hull(shapely.MultiPoint(np.stack([points.real, points.imag], axis=1)))


def middle(leaf: OpenPage, name: str) -> complex:
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
        (name, Step(say("."), (Part(say(".")),), View(name, say(name), f"x {name}", f"y {name}"), marks(wide, high)))
        for name, wide, high in parts
    ]


def test_pages_come_in_the_order_of_their_first_step():
    drawn = compose(steps(("late", 50, 40), ("large", 240, 105), ("wide", 240, 90)), [], TITLE, "A4", "iso")
    named = [[g.name.split()[1] for g in page.groups if g.key.startswith("step")] for page in drawn.pages]
    assert [names[0] for names in named] == sorted((names[0] for names in named), key=["late", "large", "wide"].index)
    assert len(named) > 1


def page_texts(drawn: Drawing, key: str) -> list[str]:
    return [e.text for p in drawn.pages for g in p.groups if g.key == key for e in g.entities if isinstance(e, Text)]


def test_an_unfinished_sheet_shows_what_is_given_and_the_steps_so_far_at_the_same_places():
    axis, curve = (Line(np.array([0, 50 + 10j * k]), Role.CURVE) for k in range(2))
    found = View("s", say("Scale, 1.2 mm"), "phi", "s", answer=say("1.2"), found_by="second")
    first = Step(say("."), (Part(say(".")),), View("a", say("First"), "x", "y"), (axis,))
    second = Step(say("."), (Part(say(".")),), found, (axis, curve), given=(axis,))
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


def test_a_page_knows_where_its_views_stand():
    drawn = compose(steps(("one", 50, 40), ("other", 200, 80)), [], TITLE, "A4", "iso")
    places = {name: (k, at) for k, page in enumerate(drawn.pages) for name, at in page.origins.items()}
    assert set(places) == {"one", "other"}
    for name, (k, at) in places.items():
        (group,) = (g for g in drawn.pages[k].groups if g.name.endswith(f" {name}"))
        assert group.entities[0].points[0] == at


def test_a_table_wider_than_the_sheet_is_broken_into_lines_and_parted_by_its_columns():
    columns = tuple(f"column{k} of" for k in range(30))
    wide = Table("T", columns, (columns, columns))
    room = Format("A4", "gost").content.width - 8 - 4
    drawn = compose([], [wide], TITLE, "A4")
    entities = [e for p in drawn.pages for g in p.groups if g.key == "tables" for e in g.entities]
    said = [e for e in entities if isinstance(e, Text)]
    assert {e.height for e in said} == {2.5}
    parts = sum(e.text.startswith("T, ") for e in said)
    assert {f"T, {k}/{parts}" for k in range(1, parts + 1)} <= {e.text for e in said}
    # The first column stands in each part, in the header and two rows; every other one once.
    words = Counter(e.text.split()[0] for e in said)
    assert words["column0"] == 3 * parts
    assert {words[f"column{k}"] for k in range(1, 30)} == {3}
    borders = [e for e in entities if isinstance(e, Strokes) and e.role == "table"]
    assert len(borders) == parts > 1
    assert all(box_of([e]).width <= room for e in borders)


def test_a_table_higher_than_the_sheet_is_parted_by_its_rows():
    long = Table("T", ("", "value"), tuple((f"row {k}", f"{k}") for k in range(100)), frozenset({(0, 1), (99, 1)}))
    drawn = compose([], [long], TITLE, "A4")
    said = [
        e.text for p in drawn.pages for g in p.groups if g.key == "tables" for e in g.entities if isinstance(e, Text)
    ]
    parts = said.count("value")
    assert parts > 1
    assert {f"T, {k}/{parts}" for k in range(1, parts + 1)} <= set(said)
    assert [said.count(f"row {k}") for k in range(100)] == [1] * 100
    assert overlaps(drawn) == []
    answers = [e for block in table_blocks(long, 2.5, 100.0, 150.0) for e in block.answers]
    assert [e.text for e in answers] == ["0", "99"]


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
        # By GOST 2.104 the first sheet alone says how many there are.
        assert {f"Sheet {number}", *(["Sheets 2"] if number == 1 else ["Sheets"])} <= said
        assert (page.width, page.height, page.frame) == (420, 297, Format("A3", "gost").content)
        assert [g.key for g in page.groups] == ["frame", "titles", f"step-0{number}"]
