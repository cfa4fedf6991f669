"""The cam as a solid with exact faces: the outline, a hub and the bore with its keyway, each drawn out along the axis.

The faces are planes, cylinders, and behind every piece of the profile's spline a surface of linear extrusion; the solid
is a manifold boundary representation (ISO 10303-42), in which every edge belongs to two faces.  No face is closed in
itself, for which readers differ.  Chamfers are left to the drawing.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.workshop.biarcs import Move
from graphcam.workshop.cam_part import CamPart
from graphcam.workshop.plane_loops import Loop, PlaneEdge, bore_loop, circle_loop
from graphcam.workshop.step_file import StepFile

UP, DOWN, RIGHT = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0)


@dataclass(frozen=True)
class Wall:
    """The faces that stand on a loop, and their edges below and above, in order."""

    faces: list[str]
    lower: list[str]
    upper: list[str]


def solid_file(outline: Loop, part: CamPart, zero: float, name: str, description: str, program: str) -> str:
    """The solid as a STEP file; the axis is z, the cam stands from z = 0 upwards, and the hub on it.

    outline : anticlockwise, in cam coordinates [mm]
    zero : direction of the keyway [rad]
    """
    file = StepFile()
    around = _wall(file, outline, 0.0, part.width)
    bore = _wall(file, bore_loop(part, zero), 0.0, part.length)
    faces = [*around.faces, *bore.faces]
    faces.append(_plane(file, 0.0, DOWN, [_backwards(file, around.lower), _backwards(file, bore.lower)]))
    if part.hub:
        hub = _wall(file, circle_loop(part.hub.diameter / 2), part.width, part.length)
        faces += hub.faces
        faces.append(_plane(file, part.width, UP, [_forwards(file, around.upper), _backwards(file, hub.lower)]))
        outermost = hub
    else:
        outermost = around
    faces.append(_plane(file, part.length, UP, [_forwards(file, outermost.upper), _forwards(file, bore.upper)]))
    shell = file.add("CLOSED_SHELL", "''", faces)
    return file.finish(file.add("MANIFOLD_SOLID_BREP", "''", shell), name, description, program)


def _wall(file: StepFile, loop: Loop, low: float, high: float) -> Wall:
    corners = [edge.start for edge in loop]
    below, above = ([_vertex(file, corner, z) for corner in corners] for z in (low, high))
    rising = [
        _edge(file, bottom, top, _line(file, corner, low, UP))
        for bottom, top, corner in zip(below, above, corners, strict=True)
    ]
    wall = Wall([], [], [])
    for k, edge in enumerate(loop):
        then = (k + 1) % len(loop)
        curve = _curve(file, edge, low)
        wall.lower.append(_edge(file, below[k], below[then], curve))
        wall.upper.append(_edge(file, above[k], above[then], _curve(file, edge, high)))
        around = [
            _oriented(file, wall.lower[-1], True),
            _oriented(file, rising[then], True),
            _oriented(file, wall.upper[-1], False),
            _oriented(file, rising[k], False),
        ]
        bound = file.add("FACE_OUTER_BOUND", "''", file.add("EDGE_LOOP", "''", around), True)
        surface, outwards = _surface(file, edge, curve, low)
        wall.faces.append(file.add("ADVANCED_FACE", "''", [bound], surface, outwards))
    return wall


def _plane(file: StepFile, z: float, normal: tuple[float, float, float], bounds: list[list[str]]) -> str:
    """The face in a plane across the axis: its outer bound and the inner one."""
    kinds = "FACE_OUTER_BOUND", "FACE_BOUND"
    made = [
        file.add(kind, "''", file.add("EDGE_LOOP", "''", around), True)
        for kind, around in zip(kinds, bounds, strict=True)
    ]
    return file.add("ADVANCED_FACE", "''", made, file.add("PLANE", "''", file.axes((0.0, 0.0, z), normal, RIGHT)), True)


def _forwards(file: StepFile, edges: list[str]) -> list[str]:
    return [_oriented(file, edge, True) for edge in edges]


def _backwards(file: StepFile, edges: list[str]) -> list[str]:
    return [_oriented(file, edge, False) for edge in reversed(edges)]


def _oriented(file: StepFile, edge: str, forwards: bool) -> str:
    return file.add("ORIENTED_EDGE", "''", "*", "*", edge, forwards)


def _edge(file: StepFile, start: str, end: str, curve: str) -> str:
    return file.add("EDGE_CURVE", "''", start, end, curve, True)


def _vertex(file: StepFile, at: complex, z: float) -> str:
    return file.add("VERTEX_POINT", "''", file.point(at.real, at.imag, z))


def _line(file: StepFile, at: complex, z: float, way: tuple[float, float, float]) -> str:
    along = file.add("VECTOR", "''", file.direction(*way), 1.0)
    return file.add("LINE", "''", file.point(at.real, at.imag, z), along)


def _curve(file: StepFile, edge: PlaneEdge, z: float) -> str:
    """The curve of an edge at a height; an arc's axis points to where it runs anticlockwise."""
    if not isinstance(edge, Move):
        knots, times = np.unique(edge.knots, return_counts=True)
        points = [file.point(point.real, point.imag, z) for point in edge.control.tolist()]
        form, no = ".UNSPECIFIED.", False
        values = points, form, no, no, times.tolist(), knots.tolist(), form
        return file.add("B_SPLINE_CURVE_WITH_KNOTS", "''", edge.degree, *values)
    if edge.centre is None:
        return _line(file, edge.start, z, _way(edge))
    return file.add("CIRCLE", "''", _arc_axes(file, edge, z), abs(edge.start - edge.centre))


def _surface(file: StepFile, edge: PlaneEdge, curve: str, z: float) -> tuple[str, bool]:
    """The surface behind an edge, and whether its normal points out of the solid, which is to the right of the edge."""
    if not isinstance(edge, Move):
        along = file.add("VECTOR", "''", file.direction(*UP), 1.0)
        return file.add("SURFACE_OF_LINEAR_EXTRUSION", "''", curve, along), True
    if edge.centre is None:
        x, y, _ = way = _way(edge)
        return file.add("PLANE", "''", file.axes((edge.start.real, edge.start.imag, z), (y, -x, 0.0), way)), True
    # The normal of a cylinder points away from its axis.
    axes = file.axes((edge.centre.real, edge.centre.imag, z), UP, RIGHT)
    return file.add("CYLINDRICAL_SURFACE", "''", axes, abs(edge.start - edge.centre)), not edge.clockwise


def _arc_axes(file: StepFile, arc: Move, z: float) -> str:
    assert arc.centre is not None
    return file.axes((arc.centre.real, arc.centre.imag, z), DOWN if arc.clockwise else UP, RIGHT)


def _way(line: Move) -> tuple[float, float, float]:
    way = (line.end - line.start) / abs(line.end - line.start)
    return way.real, way.imag, 0.0
