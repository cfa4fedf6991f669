"""Labels that stay near where they were, while a drawing changes under the hand.

Where the packer of :mod:`graphcam.sheets.labels` is free, a label may hop across its point whenever another line takes
its room.  Held, each label takes that of its places which is nearest to where it stood; what it crosses then is not
asked, so no raster of the paper is needed either.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.sheets.expand import Drawn
from graphcam.sheets.writing import Writing

FARTHEST_HOP = 9.0
"""A label that would move farther at once is left out until the hand is lifted [mm]."""
TURN = 10.0
"""What a turn of 1 rad counts beside a way on the paper [mm]."""


@dataclass(frozen=True)
class LabelPlace:
    """Where a label stands: the middle of its box [mm], and the direction of its base line [rad]."""

    centre: complex
    angle: float


def nearest_place(writing: Writing, former: LabelPlace) -> int | None:
    """The place of a text that is nearest to its former one; None if even that is too far away.

    >>> from graphcam.sheets.writing import around
    >>> label = around(0j, "A", 3.5, 1j)
    >>> k = nearest_place(label, LabelPlace(-4 + 0.5j, 0.0))
    >>> bool(label.centres[k].real < -2), nearest_place(label, LabelPlace(90j, 0.0))
    (True, None)
    """
    ways = np.abs(writing.centres - former.centre)
    turned = np.abs(np.angle(np.exp(1j * (writing.angles - former.angle)))) if writing.angles.any() else 0.0
    k = int(np.argmin(ways + TURN * turned))
    return k if ways[k] <= FARTHEST_HOP else None


def held_places(names: Sequence[str], steps: Sequence[Drawn], former: Mapping[str, LabelPlace]) -> list[int | None]:
    """The places that the texts of all steps keep; None for those that are new, and for those that would hop.

    names : of the texts of all steps, one step's after the other's
    """
    writings = (writing for _, of_one in steps for writing in of_one)
    return [
        nearest_place(writing, former[name]) if name in former else None
        for name, writing in zip(names, writings, strict=True)
    ]


def label_places(
    names: Sequence[str], steps: Sequence[Drawn], places: Sequence[int | None], former: Mapping[str, LabelPlace]
) -> dict[str, LabelPlace]:
    """Where the texts stand now, by name; one that was left out keeps its former place, so that it may come back."""
    writings = (writing for _, of_one in steps for writing in of_one)
    return dict(former) | {
        name: LabelPlace(complex(writing.centres[k]), float(writing.angles[k]))
        for name, writing, k in zip(names, writings, places, strict=True)
        if k is not None
    }
