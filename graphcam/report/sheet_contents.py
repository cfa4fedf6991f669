"""The sheets of a solution: which steps, tables and notes go on them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import unit
from graphcam.report.contents import Contents
from graphcam.report.sheet_data import comparison, data, phases_at_speed
from graphcam.sheets.title_block import TitleBlock
from graphcam.solving.solution import Solution
from graphcam.tasks.sheet_tables import TitleTable
from graphcam.words import Tell

UNNAMED = say("Cam mechanism")
"""The name that a task gives itself if its file gives none."""


def motion_contents(solution: Solution) -> Contents:
    """What stands on its sheets: every construction, the data, the scales, and drawn against exact values."""
    spring, drawn = solution.spring, dict(solution.drawn)
    results = [comparison(solution.comparison.quantities)]
    if spring:
        drawn |= spring.drawn
        results.append(spring.table())
    title = title_block(solution.task.title, solution.chain.profile_scale, solution.tell)
    return Contents(
        solution, title, drawn, scaled_steps(drawn), (data(solution), phases_at_speed(solution)), tuple(results)
    )


def title_name(title: TitleTable, tell: Tell) -> str:
    """What the drawing is called: as in the task, or as every task is that does not say."""
    return tell(UNNAMED) if title.name == str(UNNAMED) else title.name


def title_block(title: TitleTable, scale: Scale, tell: Tell = str) -> TitleBlock:
    """What the title block says: the task's table, and the scale of the profile where the task names none."""
    return TitleBlock(
        name=title_name(title, tell),
        number=title.document,
        organisation=title.organisation,
        group=title.group,
        author=title.author,
        checked=title.checked,
        mass=title.mass,
        scale=tell(ratio_text(scale.per_mm)) if title.scale is None else title.scale,
    )


def scaled_steps(drawn: Mapping[str, Construction]) -> tuple[tuple[str, Step], ...]:
    """The steps with their constructions' names; the titles of their views say the scales that were settled."""
    settled = {view: by for by in drawn.values() for view in by.meaning.scales}
    return tuple((name, _scaled(step, settled.get(step.view.name))) for name, c in drawn.items() for step in c.steps())


def _scaled(step: Step, by: Construction | None) -> Step:
    """The step with its view's title, whose scale is an answer if drawing finds it."""
    if by is None:
        return step
    view, read = step.view, by.readings[by.meaning.scales[step.view.name]]
    mu = read.per_mm
    if view.scale is not None:
        values = {"unit": unit(read.unit), "degrees": math.degrees(mu), "ratio": ratio_text(mu)}
        view = replace(view, title=view.scale.where(mu=mu, **values))
    if found_by := by.meaning.scales_found_by:
        view = replace(view, answer=say("{mu:.4g}", mu=view.title.values["mu"]), found_by=found_by)
    return replace(step, view=view)
