"""Worksheets of variants with other answers differ in the text of the task alone, not by a hair in what is drawn."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from over_all import over_all

from graphcam.exercises.course.handouts import worksheet
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.sheets.model import Page

FILES = (Path(__file__).parents[2] / "exercises").glob("*.toml")
NAMES = sorted({file.stem for file in FILES} - {"differentiation", "given-cam-positions"})
"""The exercises; two give all that their answers depend on, as a curve or as a cam turned to where the roller is."""
ANNA = Student("s1", "Anna")
IN_THE_TEXT = {"law_up", "law_down", "limit_up", "limit_down", "factor", "roller", "pole", "pole_1", "pole_2"}
IN_THE_TEXT |= {"pole_s", "pole_v"}
"""Parameters on which answers depend, and which only the text of the task names."""
GIVEN_AS_DRAWN = {"integration": {"law_up", "law_down"}, "given-cam": {"roller"}}
"""Of which an exercise draws something: the acceleration that is integrated; the cam, turned to where the roller is."""
LIFT_IN_THE_TEXT = {"acceleration-and-scales", "integration", "least-radius", "least-radius-offset", "pressure-angle"}
"""Exercises without a profile or a curve, whose scale would go with the lift."""


def drawn_on(page: Page) -> dict[str, str]:
    """What stands on a page besides the text of the task, to the last digit."""
    return {group.name: repr(group.entities) for group in page.groups if group.name != "tables"}


@over_all("name", NAMES)
def test_a_worksheet_tells_no_answer(name: str) -> None:
    exercise = find_exercise(name)
    first, *others = (drawn(exercise, "Anna", b"secret", k) for k in range(6))
    names = (IN_THE_TEXT - GIVEN_AS_DRAWN.get(name, set())) | ({"lift"} if name in LIFT_IN_THE_TEXT else set())
    # Every parameter that may differ does, in a variant that is else the same.
    values = {
        each: next(v.parameters[each] for v in others if v.parameters[each] != first.parameters[each])
        for each in names & first.parameters.keys()
    }
    assert values
    changed: Variant = replace(first, parameters={**first.parameters, **values})
    before, after = ([drawn_on(page) for page in worksheet(each, ANNA).pages] for each in (first, changed))
    assert before == after
    told = [worksheet(each, ANNA).pages[0].groups for each in (first, changed)]
    assert repr(told[0]) != repr(told[1])  # the text names them
