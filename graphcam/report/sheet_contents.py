"""The sheets of a solution: which steps, tables and notes go on them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from graphcam.constructions.differentiation import VIEWS as DIFFERENTIATED
from graphcam.drafting.ink import Caption, Step, say
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import unit
from graphcam.report.contents import Contents, drawing
from graphcam.report.sheet_data import comparison, data, phases_at_speed
from graphcam.sheets.formats import Format
from graphcam.sheets.model import Drawing
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


def sheet(solution: Solution) -> Drawing:
    """The finished sheet."""
    return drawing(contents(solution))


def contents(solution: Solution) -> Contents:
    """What stands on its sheets: every construction, the data, the scales, and drawn against exact values."""
    task, paper = solution.task, solution.task.drawing
    titles = _titles(solution)
    steps = [(name, _titled(step, titles)) for name, c in solution.drawn.items() for step in c.steps()]
    results = [comparison(solution.comparison.quantities)]
    if solution.spring:
        steps += solution.spring.steps()
        results.append(solution.spring.table())
    return Contents(
        steps=tuple(steps),
        givens=(data(solution), phases_at_speed(solution)),
        results=tuple(results),
        notes=tuple(solution.warnings),
        title=title_block(task.title, solution.chain.profile_scale, paper.tell),
        sheet=Format(paper.format, paper.frame, paper.orientation),
        tell=paper.tell,
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


def _titled(step: Step, titles: dict[str, Caption]) -> Step:
    title = titles.get(step.view.name, step.view.title)
    if step.view.name not in SCALED:
        return replace(step, view=replace(step.view, title=title))
    answer = say("{mu:.4g}", mu=title.values["mu"])
    return replace(step, view=replace(step.view, title=title, answer=answer, found_by="integration"))


def _titles(solution: Solution) -> dict[str, Caption]:
    """The views' titles with their scales."""
    readings = solution.drawn["integration"].readings
    mu_phi = math.degrees(solution.chain.board.mu_phi.per_mm)

    def scale(name: str) -> dict[str, object]:
        return {"mu": float(np.ravel(readings[name].scale)[0]), "unit": unit(readings[name].unit)}

    return {
        "acceleration": say("Acceleration a, μₐ = {mu:.4g} ({unit})/mm", **scale("a")),
        "velocity": say("Velocity v, μᵥ = {mu:.4g} ({unit})/mm", **scale("v")),
        "displacement": say("Displacement s, μₛ = {mu:.4g} {unit}/mm", **scale("s")),
        "angle": say("Pressure angle α, μ = {mu:g}°/mm", mu=mu_phi),
        "combined": say("Least radius, μₛ = {mu:.4g} {unit}/mm", **scale("s")),
        "profile": say("Cam profile, {ratio}", ratio=ratio_text(solution.chain.profile_scale.per_mm)),
    }
