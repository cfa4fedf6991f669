"""The outline of a given cam from a drawing of a CAD program: the one closed loop of a DXF file, as points."""

from pathlib import Path

import numpy as np

from graphcam.dxf_curves import Points, joined_curves, read_layers
from graphcam.errors import DesignError, TaskError, UnreadableError, unreadable_error
from graphcam.given.arc_loop import arc_loop
from graphcam.given.point_outline import MAX_POINTS, cam_through_points
from graphcam.given.table_file import CurveTable
from graphcam.words import Caption, say, sequence

FLATNESS = 2e-5
"""A curve is replaced by points whose chords stay so near to it [mm]."""
END_GAP = 0.02
"""Ends as near as this meet [mm]."""
MAX_CORNER, CORNER_REACH = 20.0, 0.1
"""Where an outline turns by more [degrees] from so far before to so far behind a place [mm], it has a corner."""
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
        found, limit = say("not to be read"), say("a DXF file with one closed loop")
        raise TaskError(str(path), say("the outline"), found, limit, error.why) from None
    # A speck is shorter than the gap that closes a loop.
    loops = [each for each in curves if abs(each[1][-1] - each[1][0]) <= END_GAP < np.abs(each[1] - each[1][0]).max()]
    if len(loops) != 1:
        raise _not_one(path, curves, loops)
    corners = loops[0][1][:-1]
    _check_smooth(path, corners)
    try:
        on_arcs = arc_loop(cam_through_points(corners).points) is not None
        rows = corners if on_arcs else _dense(corners)
        cam_through_points(rows)
    except DesignError as error:
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
    at, ends = longest[-1], np.concatenate([curve[[0, -1]] for _, curve in curves])
    gap = np.sort(np.abs(ends - at))[1]  # to the nearest end of a curve, its own start among them
    found = say("open on the layer {layer}, by {gap:.3g} mm at ({x:.2f}, {y:.2f})")
    found = found.with_values(layer=on, gap=gap, x=at.real, y=at.imag)
    return TaskError(str(path), say("the outline"), found, limit, say("join its ends"))


def _check_smooth(path: Path, corners: Points) -> None:
    """Check that a closed curve has no corner: the spline through its points would swing on either side of one."""
    ends = np.append(corners, corners[0])
    along = np.append(0.0, np.cumsum(np.abs(np.diff(ends))))
    behind, ahead = (np.interp((along[:-1] + way) % along[-1], along, ends) for way in (-CORNER_REACH, CORNER_REACH))
    turns = np.abs(np.degrees(np.angle((ahead - corners) * np.conj(corners - behind))))
    k = int(np.argmax(turns))
    if turns[k] > MAX_CORNER:
        found = say("bent by {angle:.3g}° in a corner at ({x:.2f}, {y:.2f})")
        found = found.with_values(angle=turns[k], x=corners[k].real, y=corners[k].imag)
        limit, remedy = say("smooth all around"), say("round it by an arc")
        raise TaskError(str(path), say("the outline"), found, limit, remedy)


def _dense(corners: Points) -> Points:
    """The points of a closed curve, and more between them where it is straight for long."""
    ends = np.append(corners, corners[:1])
    lengths = np.abs(np.diff(ends))
    step = max(float(lengths.sum()) / POINT_COUNT, 4 * float(lengths.sum()) / MAX_POINTS)
    parts = np.maximum(np.ceil(lengths / step), 1).astype(int)
    k = np.repeat(np.arange(lengths.size), parts)
    share = (np.arange(k.size) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[k]
    return ends[k] + share * (ends[k + 1] - ends[k])
