"""Sheets of random tasks and of the built-in ones: nothing is in the way of a text, no text is too small.

Every length measures what is written at it, by the scales that are printed, and pages are well used.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import combinations

import pytest
from layout_goals import MAX_EMPTY_SHARE, empty_share
from over_all import over_seeds
from overlaps import overlaps
from random_sheets import KINDS, LANGUAGES, built_in, drawn_task, on_sheet, solved
from scene import SHEETS
from test_pages import check_pages
from test_paper_lengths import check_drawing

import graphcam as gc
from graphcam.report.documents import contents_of, drawing_of, sheet_of
from graphcam.sheets.model import Angle, Drawing, Length, Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.tasks.task_file import builtin_task

pytestmark = pytest.mark.slow

LEAST_HEIGHT = 2.5
"""Of letters by ISO 3098 and GOST 2.304 on these sheets, mm; the printed form of a title block is smaller."""

CROWDED = {47: "центральный (e = 0)", 59: "r₀ мин = 35,69"}
"""Texts for which there is no place off every line: among the lines of a region of a few centimetres."""


def check(drawing: Drawing, crowded: str = "") -> None:
    assert [each for each in overlaps(drawing, width=0.0) if each.kind != "line" or each.text != crowded] == []
    assert too_small(drawing) == []
    assert wrong_lengths(drawing) == []
    assert wrong_angles(drawing) == []
    for page in drawing.pages:
        tables = [e for g in page.groups if g.key == "tables" for e in g.entities if isinstance(e, Strokes)]
        boxes = [box for e in tables if e.role == "table" and (box := box_of([e]))]
        assert not any(a.meets(b) for a, b in combinations(boxes, 2))
        for group in page.groups:
            if group.key != "frame" and (box := box_of(e for e in group.entities if not isinstance(e, Text))):
                assert page.frame.holds(box), "nothing is drawn outside the frame"


def texts(drawing: Drawing) -> Iterator[Text]:
    """All that is written, but for the frame with its title block."""
    for page in drawing.pages:
        for group in page.groups:
            if group.key != "frame":
                yield from (e for e in group.entities if isinstance(e, Text) and e.text)


def too_small(drawing: Drawing) -> list[str]:
    """Texts in letters that are lower than any of the standards."""
    return [text.text for text in texts(drawing) if text.height < LEAST_HEIGHT - 1e-9]


def wrong_lengths(drawing: Drawing) -> list[tuple[str, float]]:
    """Lengths on paper that are written as plain numbers, and what they measure [mm], where the two differ."""
    found: list[tuple[str, float]] = []
    for text in texts(drawing):
        if isinstance(text.of, Length) and (said := re.fullmatch(r"(\d+)([.,]\d+)?", text.text)):
            number, measured = float(text.text.replace(",", ".")), abs(text.of.end - text.of.start)
            digits = len(said[2] or ".") - 1
            if abs(measured - number) > 0.5000001 * 10**-digits:
                found.append((text.text, measured))
    return found


def wrong_angles(drawing: Drawing) -> list[tuple[str, float]]:
    """Angles that are written at arcs, and what those measure [degrees], where the two differ."""
    found: list[tuple[str, float]] = []
    for text in texts(drawing):
        if isinstance(text.of, Angle) and (said := re.fullmatch(r"(?:.* = )?[-−]?(\d+(?:[.,](\d+))?)°", text.text)):
            number, measured = float(said[1].replace(",", ".")), math.degrees(text.of.end - text.of.start)
            if abs(number - measured) > 0.5000001 * 10 ** -len(said[2] or ""):
                found.append((text.text, measured))
    return found


def most_empty(drawing: Drawing) -> float:
    """The largest empty rectangle as a part of its frame; of several pages the last one may be empty."""
    return max((empty_share(page) for page in drawing.pages[:-1]), default=0.0)


SPARSE = {("measured", "A2", "gost", "landscape"): 0.22, ("arcs", "A4", "iso", "landscape"): 0.24}
"""Sheets that keep a larger empty rectangle, because the views stand in the order of the work."""
SOME = (*range(0, 60, 13), *CROWDED)
"""Numbers with every follower, most sheets and both languages."""


@over_seeds(SOME)
def test_sheets_of_random_tasks(seed: int) -> None:
    """Nothing is in the way: on the finished sheet, and on some blank ones and those of one construction each."""
    contents = contents_of(solved(seed))
    solution, sheet = contents.solution, drawing_of(contents)
    check(sheet, CROWDED.get(seed, ""))
    check_drawing(solution, sheet)
    assert all(share > 0.35 for share in check_pages(solution, sheet.pages)[:-1])
    assert most_empty(sheet) <= (0.3 if seed == 56 else MAX_EMPTY_SHARE)
    if seed % 56 == 0:
        check(sheet_of(solution, 0))
        check(sheet_of(solution, per_construction=True))


@over_seeds(range(0, 15, 3))
def test_sheets_of_built_in_tasks(seed: int) -> None:
    name, sheet = built_in(seed)
    contents = contents_of(on_sheet(name, sheet))
    solution, drawing = contents.solution, drawing_of(contents)
    check_drawing(solution, drawing)
    assert all(share > 0.35 for share in check_pages(solution, drawing.pages)[:-1])
    assert most_empty(drawing) <= SPARSE.get((name, *sheet), MAX_EMPTY_SHARE)


def test_the_corpus_holds_every_sheet_in_every_language() -> None:
    tasks = [drawn_task(number, number).drawing for number in range(60)]
    for language in LANGUAGES:
        said = {(each.format, each.frame) for each in tasks if each.language == language}
        assert said == {(paper, frame) for paper, frame, _ in SHEETS}
    assert {(each.format, each.frame, each.orientation) for each in tasks} == set(SHEETS)
    assert {number % len(KINDS) for number in SOME} == set(range(len(KINDS)))
    assert {drawn_task(number, number).drawing.language for number in SOME} == set(LANGUAGES)
    assert {built_in(number)[1] for number in range(15)} == set(SHEETS)
    assert len({built_in(number) for number in range(75)}) == 75


@pytest.fixture(scope="module")
def sound() -> Drawing:
    return sheet_of(gc.solve(builtin_task()))


def changed(drawing: Drawing, change: Callable[[Text], Text | None]) -> Drawing:
    """The same drawing with the first text that a change does not leave alone."""
    for p, page in enumerate(drawing.pages):
        for g, group in enumerate(page.groups):
            for k, e in enumerate(group.entities):
                if group.key != "frame" and isinstance(e, Text) and e.text and (other := change(e)):
                    entities = (*group.entities[:k], other, *group.entities[k + 1 :])
                    groups = (*page.groups[:g], replace(group, entities=entities), *page.groups[g + 1 :])
                    pages = (*drawing.pages[:p], replace(page, groups=groups), *drawing.pages[p + 1 :])
                    return replace(drawing, pages=pages)
    raise AssertionError("nothing was changed")


def test_a_text_that_is_moved_onto_another_or_onto_a_line_is_found(sound: Drawing) -> None:
    some = next(text for text in texts(sound) if text.text == "H₁ = 40")
    moved = changed(sound, lambda text: replace(text, at=some.at) if text.text == "P₁" else None)
    assert ("P₁", "H₁ = 40") in {(o.text, o.other) for o in overlaps(moved, 0.0)} | {
        (o.other, o.text) for o in overlaps(moved, 0.0)
    }
    assert isinstance(some.of, Length)
    foot = some.of.foot
    # A text on the line of its own dimension, which is thin.
    struck = changed(sound, lambda text: replace(text, at=complex(text.at.real, foot.imag)) if text is some else None)
    assert ("H₁ = 40", "dimension") in {(o.text, o.other) for o in overlaps(struck, 0.0)}
    assert overlaps(struck) == []


def test_letters_that_are_too_low_are_found(sound: Drawing) -> None:
    low = changed(sound, lambda text: replace(text, height=2.4) if text.text == "P₁" else None)
    assert (too_small(sound), too_small(low)) == ([], ["P₁"])


def test_an_angle_that_is_another_than_is_written_is_found(sound: Drawing) -> None:
    def turn(text: Text) -> Text | None:
        """The pressure angle of the velocity plan, a tenth of a degree more."""
        if text.text != "α = 29.7°" or not isinstance(text.of, Angle):
            return None
        return replace(text, of=replace(text.of, end=text.of.end + math.radians(0.1)))

    assert wrong_angles(sound) == []
    assert [said for said, _ in wrong_angles(changed(sound, turn))] == ["α = 29.7°"]


def test_a_length_that_is_a_tenth_of_a_millimetre_wrong_is_found(sound: Drawing) -> None:
    def stretch(text: Text) -> Text | None:
        """A dimension of 50.0 whose end is moved."""
        if text.text != "50.0" or not isinstance(text.of, Length):
            return None
        way = (text.of.end - text.of.start) / abs(text.of.end - text.of.start)
        return replace(text, of=replace(text.of, end=text.of.end + 0.1 * way))

    assert wrong_lengths(sound) == []
    assert [said for said, _ in wrong_lengths(changed(sound, stretch))] == ["50.0"]


def test_degrees_stand_under_the_lowest_diagram_of_every_page() -> None:
    """The coursework on A3, whose diagrams stand on two pages."""
    task = builtin_task()
    drawing = sheet_of(gc.solve(replace(task, drawing=replace(task.drawing, format="A3", ordinate=None, poles=None))))
    over_phi = [page for page in drawing.pages if {"velocity", "displacement"} & {*page.origins}]
    assert len(over_phi) == 2
    for page in over_phi:
        written = [e.text for group in page.groups for e in group.entities if isinstance(e, Text)]
        assert written.count("360°") == 1
