"""The cam as a solid with exact faces: the outline, a hub and the bore with its keyway, each drawn out along the axis.

The faces are planes, cylinders, and behind every piece of the profile's spline a surface of linear extrusion; the solid
is a manifold boundary representation (ISO 10303-42), in which every edge belongs to two faces.  No face is closed in
itself, for which readers differ.  Chamfers are left to the drawing.

The file is one of ISO 10303-21 (STEP) by the application protocol 214.  The bytes repeat: the file bears no date.
Sources: ISO 10303-21:2016 (the text), ISO 10303-214:2010 (the schema ``automotive_design``), ISO 10303-42 (geometry and
topology).
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.workshop.biarcs import Move
from graphcam.workshop.cam_part import CamPart
from graphcam.workshop.plane_loops import Loop, PlaneEdge, bore_loop, circle_loop

UP_AXIS, DOWN_AXIS, RIGHT_AXIS = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0)


LENGTH_UNCERTAINTY = 1e-5
"""The distance up to which two points count as one [mm]."""


class StepFile:
    """A STEP file in the making: entities in order, each known by the reference that :meth:`add` returns."""

    def __init__(self) -> None:
        self._lines: list[str] = []

    def add(self, name: str, *values: object) -> str:
        """Add an entity with these values, as :func:`entity_text` writes them; returns its reference."""
        return self.add_text(f"{name}({','.join(map(entity_text, values))})")

    def add_text(self, text: str) -> str:
        """Add an entity that is written out; returns its reference."""
        self._lines.append(text)
        return f"#{len(self._lines)}"

    def point(self, *xyz: float) -> str:
        """Add a point [mm]; returns its reference."""
        return self.add("CARTESIAN_POINT", "''", xyz)

    def direction(self, *xyz: float) -> str:
        """Add a unit vector; returns its reference."""
        return self.add("DIRECTION", "''", xyz)

    def axes(self, origin: tuple[float, ...], axis: tuple[float, ...], across: tuple[float, ...]) -> str:
        """Add a system of axes by its origin, its third axis and its first axis; returns its reference."""
        places = self.point(*origin), self.direction(*axis), self.direction(*across)
        return self.add("AXIS2_PLACEMENT_3D", "''", *places)

    def finish(self, solid: str, name: str, description: str, program: str) -> str:
        """The text of the whole file, with a solid as the shape of a product."""
        self._product(solid, text(name))
        entities = (f"#{k}={line};" for k, line in enumerate(self._lines, 1))
        head = (
            "ISO-10303-21;",
            "HEADER;",
            f"FILE_DESCRIPTION(({text(description)}),'2;1');",
            f"FILE_NAME('profile.step','1970-01-01T00:00:00',(''),(''),{text(program)},'graphcam','');",
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));",
            "ENDSEC;",
            "DATA;",
        )
        return "".join(f"{line}\n" for line in (*head, *entities, "ENDSEC;", "END-ISO-10303-21;"))

    def _product(self, solid: str, name: str) -> None:
        application = self.add("APPLICATION_CONTEXT", "'automotive design'")
        self.add(
            "APPLICATION_PROTOCOL_DEFINITION", "'international standard'", "'automotive_design'", 2000, application
        )
        context = self.add("PRODUCT_CONTEXT", "''", application, "'mechanical'")
        product = self.add("PRODUCT", name, name, "''", [context])
        self.add("PRODUCT_RELATED_PRODUCT_CATEGORY", "'part'", "$", [product])
        formation = self.add("PRODUCT_DEFINITION_FORMATION", "''", "''", product)
        of = self.add("PRODUCT_DEFINITION_CONTEXT", "'part definition'", application, "'design'")
        definition = self.add("PRODUCT_DEFINITION", "'design'", "''", formation, of)
        shape = self.add("PRODUCT_DEFINITION_SHAPE", "''", "''", definition)
        where = self.axes((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
        is_shape = self.add("ADVANCED_BREP_SHAPE_REPRESENTATION", name, [where, solid], self._units())
        self.add("SHAPE_DEFINITION_REPRESENTATION", shape, is_shape)

    def _units(self) -> str:
        """The units millimetre and radian; returns the reference of their context."""
        length = self.add_text("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add_text("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid_angle = self.add_text("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        within = self.add_text(
            f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({real(LENGTH_UNCERTAINTY)}),{length},'distance_accuracy_value','')"
        )
        return self.add_text(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
            f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({within}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))"
            "REPRESENTATION_CONTEXT('',''))"
        )


def entity_text(value: object) -> str:
    """The text of a value of an entity: references and written-out texts stay, other values follow the standard.

    >>> entity_text([1.0, 2.5e-7]), entity_text(True), entity_text(3), entity_text("#7")
    ('(1.,2.5E-07)', '.T.', '3', '#7')
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return ".T." if value else ".F."
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return real(value)
    assert isinstance(value, Iterable)
    items: Sequence[object] = list(value)
    return f"({','.join(map(entity_text, items))})"


def real(value: float) -> str:
    """The text of a real number, which always has a point.

    >>> real(-0.0), real(1e-5), real(1 / 3)
    ('0.', '1.E-05', '0.333333333333333')
    """
    digits, exponent, power = f"{value + 0.0:.15G}".partition("E")
    return digits + ("" if "." in digits else ".") + exponent + power


def text(said: str) -> str:
    r"""The quoted text in ASCII, other letters by their code numbers.

    >>> print(text("cam's"), text("Кулачок №1"))
    'cam''s' '\X2\041A0443043B04300447043E043A\X0\ \X2\2116\X0\1'
    """
    out, other = "", ""
    for c in f"{said}\0":
        if c.isascii():
            if other:
                out += rf"\X2\{other.encode('utf-16-be').hex().upper()}\X0" + "\\"
                other = ""
            out += {"'": "''", "\\": "\\\\", "\0": ""}.get(c, c if c.isprintable() else " ")
        else:
            other += c
    return f"'{out}'"


@dataclass(frozen=True)
class Wall:
    """The faces that stand on a loop, and their lower and upper edges, in order."""

    faces: list[str]
    lower: list[str]
    upper: list[str]


def solid_file(outline: Loop, part: CamPart, zero: float, name: str, description: str, program: str) -> str:
    """The text of the STEP file of the solid; its axis is z, the cam begins at z = 0, and the hub stands on it.

    outline : anticlockwise, in cam coordinates [mm]
    zero : direction of the keyway [rad]
    """
    file = StepFile()
    around = _wall(file, outline, 0.0, part.width)
    bore = _wall(file, bore_loop(part, zero), 0.0, part.length)
    faces = [*around.faces, *bore.faces]
    faces.append(_plane(file, 0.0, DOWN_AXIS, [_reversed_edges(file, around.lower), _reversed_edges(file, bore.lower)]))
    if part.hub:
        hub = _wall(file, circle_loop(part.hub.diameter / 2), part.width, part.length)
        faces += hub.faces
        faces.append(
            _plane(file, part.width, UP_AXIS, [_forward_edges(file, around.upper), _reversed_edges(file, hub.lower)])
        )
        outermost = hub
    else:
        outermost = around
    faces.append(
        _plane(file, part.length, UP_AXIS, [_forward_edges(file, outermost.upper), _forward_edges(file, bore.upper)])
    )
    shell = file.add("CLOSED_SHELL", "''", faces)
    return file.finish(file.add("MANIFOLD_SOLID_BREP", "''", shell), name, description, program)


def _wall(file: StepFile, loop: Loop, low: float, high: float) -> Wall:
    corners = [edge.start for edge in loop]
    below, above = ([_vertex(file, corner, z) for corner in corners] for z in (low, high))
    rising = [
        _edge(file, bottom, top, _line(file, corner, low, UP_AXIS))
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
    """The face in a plane across the axis, with its outer and inner bounds."""
    kinds = "FACE_OUTER_BOUND", "FACE_BOUND"
    made = [
        file.add(kind, "''", file.add("EDGE_LOOP", "''", around), True)
        for kind, around in zip(kinds, bounds, strict=True)
    ]
    return file.add(
        "ADVANCED_FACE", "''", made, file.add("PLANE", "''", file.axes((0.0, 0.0, z), normal, RIGHT_AXIS)), True
    )


def _forward_edges(file: StepFile, edges: list[str]) -> list[str]:
    return [_oriented(file, edge, True) for edge in edges]


def _reversed_edges(file: StepFile, edges: list[str]) -> list[str]:
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
    """The curve of an edge at the height ``z``; the axis of an arc points to where it runs anticlockwise."""
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
        along = file.add("VECTOR", "''", file.direction(*UP_AXIS), 1.0)
        return file.add("SURFACE_OF_LINEAR_EXTRUSION", "''", curve, along), True
    if edge.centre is None:
        x, y, _ = way = _way(edge)
        return file.add("PLANE", "''", file.axes((edge.start.real, edge.start.imag, z), (y, -x, 0.0), way)), True
    # The normal of a cylinder points away from its axis.
    axes = file.axes((edge.centre.real, edge.centre.imag, z), UP_AXIS, RIGHT_AXIS)
    return file.add("CYLINDRICAL_SURFACE", "''", axes, abs(edge.start - edge.centre)), not edge.clockwise


def _arc_axes(file: StepFile, arc: Move, z: float) -> str:
    assert arc.centre is not None
    return file.axes((arc.centre.real, arc.centre.imag, z), DOWN_AXIS if arc.clockwise else UP_AXIS, RIGHT_AXIS)


def _way(line: Move) -> tuple[float, float, float]:
    way = (line.end - line.start) / abs(line.end - line.start)
    return way.real, way.imag, 0.0
