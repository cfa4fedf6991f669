"""The sheets of a solution: which steps, tables and notes go on them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from graphcam.constructions.differentiation import VIEWS as DIFFERENTIATED
from graphcam.drafting.ink import Caption, Reading, Step, say
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import unit
from graphcam.report.contents import Contents
from graphcam.report.sheet_data import comparison, data, phases_at_speed
from graphcam.sheets.title_block import TitleBlock
from graphcam.solving.solution import Solution
from graphcam.tasks.sheet_tables import TitleTable
from graphcam.words import Tell

SCALED = frozenset(
    {"acceleration", "velocity", "displacement", "combined", *(view.name for view in DIFFERENTIATED.values())}
)
"""The views whose scale is fixed by the lift when all has been integrated; that of the cam angle is chosen."""
UNNAMED = say("Cam mechanism")
"""The name that a task gives itself if its file gives none."""


def motion_contents(solution: Solution) -> Contents:
    """What stands on its sheets: every construction, the data, the scales, and drawn against exact values."""
    titles, spring, drawn = _titles(solution), solution.spring, dict(solution.drawn)
    results = [comparison(solution.comparison.quantities)]
    if spring:
        drawn |= spring.drawn
        results.append(spring.table())
    steps = [(name, _scaled(step, titles)) for name, c in drawn.items() for step in c.steps()]
    title = title_block(solution.task.title, solution.chain.profile_scale, solution.tell)
    return Contents(solution, title, drawn, tuple(steps), (data(solution), phases_at_speed(solution)), tuple(results))


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


def titled(step: Step, titles: Mapping[str, Caption]) -> Step:
    """The step with the title that its view has on the sheet."""
    return replace(step, view=replace(step.view, title=titles.get(step.view.name, step.view.title)))


def _scaled(step: Step, titles: Mapping[str, Caption]) -> Step:
    """The step with its view's title, whose scale is an answer if the integration finds it."""
    step = titled(step, titles)
    if step.view.name not in SCALED:
        return step
    answer = say("{mu:.4g}", mu=step.view.title.values["mu"])
    return replace(step, view=replace(step.view, answer=answer, found_by="integration"))


def _titles(solution: Solution) -> dict[str, Caption]:
    """The views' titles with their scales."""
    s, v, a = (solution.drawn["integration"].readings[name] for name in ("s", "v", "a"))
    return {
        **diagram_titles(solution.chain.board.mu_phi, s, v, a),
        "combined": say("Least radius, μₛ = {mu:.4g} {unit}/mm", **_scale(s)),
        "profile": say("Cam profile, {ratio}", ratio=ratio_text(solution.chain.profile_scale.per_mm)),
    }


def diagram_titles(mu_phi: Scale, s: Reading, v: Reading, a: Reading) -> dict[str, Caption]:
    """The titles of the diagrams over the cam angle, with the scales of what is read there."""
    return {
        "acceleration": say("Acceleration a, μₐ = {mu:.4g} ({unit})/mm", **_scale(a)),
        "velocity": say("Velocity v, μᵥ = {mu:.4g} ({unit})/mm", **_scale(v)),
        "displacement": say("Displacement s, μₛ = {mu:.4g} {unit}/mm", **_scale(s)),
        "angle": say("Pressure angle α, μ = {mu:g}°/mm", mu=math.degrees(mu_phi.per_mm)),
    }


def _scale(read: Reading) -> dict[str, object]:
    return {"mu": read.per_mm, "unit": unit(read.unit)}
