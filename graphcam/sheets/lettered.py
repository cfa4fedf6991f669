"""Steps that stand on a page get their letters: every text finds its place when every line stands."""

from __future__ import annotations

from collections.abc import Sequence

from graphcam.drafting.marks import Role
from graphcam.sheets.box import Box
from graphcam.sheets.expand import Drawn
from graphcam.sheets.hatching import interrupted
from graphcam.sheets.labels import place
from graphcam.sheets.model import Entity, Text

Entities = Sequence[Entity]


def lettered(steps: Sequence[Drawn], beside: Entities, inside: Box) -> list[list[Entity]]:
    """The entities of every step with its texts, which keep off all steps and what else stands ``beside`` them.

    steps : from :func:`graphcam.sheets.expand.expand`, in the order in which they are drawn
    inside : the box that no text leaves
    """
    lines = [*beside, *(entity for entities, _ in steps for entity in entities)]
    placed = iter(place([writing for _, writings in steps for writing in writings], lines, inside))
    return [[*entities, *(e for _ in writings for e in next(placed))] for entities, writings in steps]


def shading_parted(steps: Sequence[Entities]) -> list[tuple[Entity, ...]]:
    """The same steps, their shading interrupted where a text of any of them stands."""
    texts = [e for entities in steps for e in entities if isinstance(e, Text)]
    return [tuple(interrupted(e, texts) if e.role == Role.HATCH else e for e in entities) for entities in steps]
