"""Entities apart by places: what leads to a corner belongs to its place, round a closed line as well."""

from __future__ import annotations

import numpy as np
import pytest

from graphcam.drafting.acts import Act, Kind
from graphcam.sheets.model import Curve, Source, Stroke, by_place

CORNERS = np.array([0j, 4 + 0j, 4 + 3j, 3j])
SOURCE = Source(Act(Kind.TAKE, "inversion", "pitch curve", {}, 4), np.arange(4))


@pytest.mark.parametrize(
    "closed", [Stroke(CORNERS, "curve", True, SOURCE), Curve(CORNERS, "result", SOURCE)], ids=["stroke", "curve"]
)
def test_the_pieces_of_a_closed_line_go_once_round_it(closed):
    pieces = dict(by_place(closed))
    assert set(pieces) == {0, 1, 2, 3}
    for place, piece in pieces.items():
        assert isinstance(piece, Stroke)
        assert not piece.closed
        assert piece.role == closed.role
        assert piece.points.tolist() == [CORNERS[place - 1], CORNERS[place]]
