"""An exercise to try, about the cam on the page: the studio's request "sample_exercise", for who has no link to one."""

import base64
import math
from collections.abc import Mapping
from typing import Any

from graphcam.drafting.scale import unit
from graphcam.language import language
from graphcam.report.sheet_contents import names_of
from graphcam.studio.exercise_checks import ITERATIONS, check_of
from graphcam.studio.form_fields import DEGREE_SIGN
from graphcam.studio.held_solutions import held_solution
from graphcam.studio.studio_values import compared_quantities
from graphcam.studio.views_request import TaskRequest, read_request
from graphcam.words import say

ASKED_QUANTITIES = "max_v", "minimum_prime_radius", "max_pressure_angle_rise_deg"
"""The names of the quantities that are asked, as far as a cam has them."""
TOLERANCE_SHARE = 0.02
"""An answer may be off by this part of the exact value: a drawing done with care is nearer."""
SALT = b"an exercise to try"


def sample_exercise(request: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to "sample_exercise": an exercise about a task, as a link of graphcam has one.

    Raises
    ------
    GraphcamError : the task has no solution

    >>> import graphcam as gc
    >>> found = sample_exercise({"task": gc.builtin_task().to_dict()})["exercise"]
    >>> found["upto"], [(asked["name"], asked["unit"]) for asked in found["answers"]][:2]
    ('acceleration', [('max_v', 'mm/rad'), ('minimum_prime_radius', 'mm')])
    """
    wanted = read_request(TaskRequest, request)
    spoken, solution = language(wanted.language), held_solution(wanted.task, wanted.language)
    quantities = solution.comparison.quantities
    there = [quantities[name] for name in ASKED_QUANTITIES if name in quantities]
    asked, names = [each for each in there if math.isfinite(each.exact) and each.exact], names_of(solution)
    # What is given ends before the first construction in which an answer is read.
    read_in = (compared_quantities({name: solution.drawn[name]}) for name in names)
    upto = names[max(next((k for k, read in enumerate(read_in) if read & set(ASKED_QUANTITIES)), 1) - 1, 0)]
    answers = [
        {
            "name": each.name,
            "text": spoken.text(each.title),
            "unit": DEGREE_SIGN if each.unit == "deg" else spoken.text(unit(each.unit)),
            # Three digits, of which the tolerance takes the last.
            "decimals": max(0, 2 - math.floor(math.log10(abs(each.exact)))),
            "check": check_of(each.name, each.exact, TOLERANCE_SHARE * abs(each.exact), SALT),
        }
        for each in asked
    ]
    said = {"title": spoken.text(say("An exercise to try")), "upto": upto, "answers": answers}
    text = say("Draw on from what is given, on paper, at a scale of your own. Read off and type:")
    salt = base64.urlsafe_b64encode(SALT).decode()
    return {"exercise": {**said, "text": spoken.text(text), "salt": salt, "iterations": ITERATIONS}}
