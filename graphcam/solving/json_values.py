"""A solution as plain data for strict JSON: None where a value does not apply or is infinite."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from graphcam.comparison.quantities import Quantity
from graphcam.given.laws import Floats


def plain_number(value: float) -> float | None:
    """A number, or None for one that JSON does not know.

    >>> plain_number(2), plain_number(math.inf)
    (2.0, None)
    """
    return float(value) if math.isfinite(value) else None


def plain_quantities(quantities: Mapping[str, Quantity]) -> dict[str, Any]:
    """Every quantity by name."""
    keys = ("drawn", "exact", "unit", "error", "error_paper", "tolerance_paper")
    return {
        name: {key: q.unit if key == "unit" else plain_number(getattr(q, key)) for key in keys}
        for name, q in quantities.items()
    }


def plain_stations(
    phi: Floats, phase: Sequence[int], pairs: Mapping[str, tuple[Floats, Floats]], pitch: tuple[Floats, Floats]
) -> list[dict[str, Any]]:
    """The stations one after another.

    phi : cam angles [rad];  phase : which phase each belongs to
    pairs : drawn and exact values by name, each (m,);  pitch : drawn and exact points, each (m, 2)
    """
    sides = ("drawn", "exact")
    return [
        {"phi_deg": math.degrees(phi[k]), "phase": phase[k]}
        | {name: {s: plain_number(x[k]) for s, x in zip(sides, pair, strict=True)} for name, pair in pairs.items()}
        | {"pitch": {s: [plain_number(x) for x in points[k]] for s, points in zip(sides, pitch, strict=True)}}
        for k in range(len(phase))
    ]
