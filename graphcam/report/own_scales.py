"""Scales of their own for the region of the minimum radius and for the profile: as large as the sheets have room.

Each takes the largest standard scale with which the sheets need no more pages.  The region leaves the diagram of s,
beside which it stands in the scale of that diagram, only where it becomes much larger.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphcam.constructions.views import ACCELERATION, COMBINED, DISPLACEMENT, PROFILE, VELOCITY
from graphcam.sheets.layout import PagesOfPart
from graphcam.solving.solution import Solution

MIN_GAINS = {PROFILE.name: 1.01, COMBINED.name: 1.4}
"""So many times larger a view must become to be drawn in a scale of its own, by its name, the main view first."""

INTEGRATED_VIEWS = ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name
"""The names of the views that stand one under the other, for lines go from each to the next."""


def with_own_scales(solution: Solution, parts: Sequence[PagesOfPart]) -> Solution:
    """The solution with its views in the largest standard scales for which as many pages as now have room.

    parts : what stands on the sheets as they are; what a task gives, or was found before, is kept

    >>> import graphcam as gc
    >>> from graphcam.report.documents import contents_of
    >>> task = gc.builtin_task("measured")
    >>> chain = contents_of(gc.solve(task)).solution.chain
    >>> chain.board.paper.held, round(float(chain["integration"].readings["s"].scale), 3)
    ({'combined': 0.2}, 0.565)
    """
    chain = solution.chain
    paper, now = chain.board.paper, {PROFILE.name: chain.profile_scale.per_mm}
    if chain.board.follower.has_own_region:
        now[COMBINED.name] = chain.integration.readings["s"].per_mm
    held = dict(paper.held)
    for name in (name for name in MIN_GAINS if name in now and name not in held):
        for ratio in sorted(ratio for ratio in paper.ratios if ratio * now[name] >= MIN_GAINS[name]):
            tried = {**held, name: 1 / ratio}
            times = {view: now[view] / per_mm for view, per_mm in tried.items()}
            if not all(part.have_room(times, INTEGRATED_VIEWS) for part in parts):
                break
            held = tried
    if held == paper.held:
        return solution
    redrawn = replace(chain, board=replace(chain.board, paper=replace(paper, held=held)), done={})
    # A larger drawing may be read more exactly; what is built stays as it was.
    return replace(solution, chain=redrawn) if redrawn.sizes == chain.sizes else solution
