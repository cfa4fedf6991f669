"""The outline of a given cam from a drawing of a CAD program: the one closed loop of a DXF file, as points."""

from pathlib import Path

import numpy as np

from graphcam.dxf_curves import Points, joined_curves, read_layers
from graphcam.errors import TaskError, UnreadableError, unreadable_error
from graphcam.given.measured import RowError
from graphcam.given.point_outline import MAX_POINTS, cam_through_points
from graphcam.given.table_file import CurveTable
from graphcam.words import Caption, say, sequence

FLATNESS = 2e-5
"""A curve is replaced by points whose chords stay so near to it [mm]."""
END_GAP = 0.02
"""Ends as near as this meet [mm]."""
POINT_COUNT = 720
"""A straight part has at least so many points for a length as that of the whole outline."""


def outline_from_dxf(path: Path, name: str, layer: str | None) -> CurveTable:
    """The points of the closed loop in a DXF file, on a layer if one is named.

    path : where the file is;  name : how the task calls it

    Raises
    ------
    TaskError : it is no DXF file, has no such layer, no closed loop or several, or the loop is no outline of a cam
    """
    try:
        data = path.read_bytes()
    except (OSError, ValueError) as error:
        what, kind = say("the outline"), say("a DXF file")
        raise unreadable_error(path, what, kind, error, say("check {key}", key="outline.file")) from None
    try:
        curves = _curves(name, data, path, layer)
    except UnreadableError as error:
        raise TaskError(str(path), say("the outline"), error.why, say("a DXF file with one closed loop")) from None
    loops = [(on, curve) for on, curve in curves if abs(curve[-1] - curve[0]) <= END_GAP]
    if len(loops) != 1:
        raise _not_one(path, curves, loops)
    rows = _dense(loops[0][1][:-1])
    try:
        cam_through_points(rows)
    except RowError as error:
        raise TaskError(str(path), *error.args) from None
    return CurveTable(name, "outline", tuple((z.real, z.imag) for z in rows.tolist()))


def _curves(name: str, data: bytes, path: Path, layer: str | None) -> list[tuple[str, Points]]:
    """The curves of a drawing with the names of their layers."""
    layers = read_layers(name, data, FLATNESS)
    if layer is not None and layer.strip().lower() not in layers:
        there = ", ".join(sorted(layers)) or say("none")
        raise TaskError(str(path), say("layer"), layer, say("one of {names}", names=there), say("name one of them"))
    read = layers if layer is None else {layer: layers[layer.strip().lower()]}
    return [(on, curve) for on, drawn in read.items() for curve in joined_curves(on, drawn.curves, END_GAP)]


def _not_one(path: Path, curves: list[tuple[str, Points]], loops: list[tuple[str, Points]]) -> TaskError:
    """The error for a drawing without a closed loop, or with several."""
    limit = say("one closed loop")
    if loops:
        counts = {on: sum(other == on for other, _ in loops) for on, _ in loops}
        held = [say("{count} on the layer {layer}", count=count, layer=on) for on, count in counts.items()]
        found: Caption = say("{count} closed loops: {held}", count=len(loops), held=sequence(held, ", "))
        remedy = say("name the layer of the outline alone: outline.layer")
        return TaskError(str(path), say("the outline"), found, limit, remedy)
    if not curves:
        return TaskError(str(path), say("the outline"), say("without a curve"), limit, say("draw the outline"))
    on, longest = max(curves, key=lambda each: float(np.abs(np.diff(each[1])).sum()))
    gap, at = abs(longest[-1] - longest[0]), longest[-1]
    found = say("open on the layer {layer}, by {gap:.3g} mm at ({x:.2f}, {y:.2f})")
    found = found.with_values(layer=on, gap=gap, x=at.real, y=at.imag)
    return TaskError(str(path), say("the outline"), found, limit, say("join its ends"))


def _dense(corners: Points) -> Points:
    """The points of a closed curve, and more between them where it is straight for long."""
    ends = np.append(corners, corners[:1])
    lengths = np.abs(np.diff(ends))
    step = max(float(lengths.sum()) / POINT_COUNT, 4 * float(lengths.sum()) / MAX_POINTS)
    parts = np.maximum(np.ceil(lengths / step), 1).astype(int)
    k = np.repeat(np.arange(lengths.size), parts)
    share = (np.arange(k.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[k]
    return ends[k] + share * (ends[k + 1] - ends[k])
