"""DXF files of any CAD program, by ezdxf: units and blocks put right."""

from __future__ import annotations

import io
import logging
from collections.abc import Generator, Iterable
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from graphcam.exercises.reading.answer_values import MAX_POINTS, Points, short_text
from graphcam.exercises.reading.drawn_layers import CadDrawing, Layer
from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.words import say

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic

logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # else a faulty file fills the teacher's terminal
MAX_LINES = 500_000
"""Lines of a file that are read, and MAX_BYTES of a binary one: what ezdxf reads in a few seconds."""
MAX_BYTES = 2_500_000
MAX_ENTITIES = 20_000
"""Entities that are looked at, those in blocks counted each time the block stands there."""
MAX_VERTICES = 400_000
"""Points of all curves together, of bent ones those of the chords in their place."""
MAX_FIT_POINTS = 1000
"""Points that a spline is fitted through: for that ezdxf solves as many equations, each with as many unknowns."""
MAX_BLOCK_DEPTH = 8
FLATNESS = 0.005
"""A curve is replaced by chords that stay so near to it, mm: far below the finest pencil line."""
MAX_COORDINATE = 5000.0
"""mm: no sheet is larger, so farther coordinates come from wrong units."""
BINARY_SIGNATURE = b"AutoCAD Binary DXF"
CURVE_TYPES = {"LINE", "LWPOLYLINE", "POLYLINE", "SPLINE", "ARC", "CIRCLE", "ELLIPSE"}
TEXT_TYPES = {"TEXT", "MTEXT", "DIMENSION", "LEADER", "MULTILEADER", "HATCH", "SOLID", "ATTDEF", "ATTRIB", "VIEWPORT"}
"""What may stand on a layer beside the answer."""


def read_dxf(name: str, data: bytes) -> CadDrawing:
    """The layers of a DXF file, text or binary, in mm.

    The unit of the header counts ($INSUNITS; none means mm), and blocks are dissolved.

    Raises
    ------
    UnreadableError : no DXF, a unit that is no length, more or farther entities than a sheet can hold
    """
    if data.startswith(BINARY_SIGNATURE) and len(data) > MAX_BYTES:
        raise UnreadableError(say("{name} is longer than the {limit} bytes that are read", name=name, limit=MAX_BYTES))
    if data.count(b"\n") > MAX_LINES:
        raise UnreadableError(say("{name} has more than {most} rows", name=name, most=MAX_LINES))
    document = _document(name, data)
    factor = _millimetres(name, document)
    layers: dict[str, Layer] = {}
    try:
        entities = list(islice(_dissolved(document.modelspace(), "0", 0), MAX_ENTITIES + 1))
        if len(entities) > MAX_ENTITIES:
            raise UnreadableError(say("{name} has more than {most} entities", name=name, most=MAX_ENTITIES))
        left = MAX_VERTICES
        with np.errstate(all="ignore"):
            for entity, layer in entities:
                # Programs tell layers neither by capitals nor by a space at the end.
                left -= _add(layers.setdefault(layer.strip().lower(), Layer()), entity, factor)
                if left < 0:
                    raise UnreadableError(say("{answer} has more than {most} points", answer=name, most=MAX_VERTICES))
    except UnreadableError:
        raise
    # What a stranger wrote into a file can make a library stumble anywhere; it is his answer that is lost then.
    except Exception:  # noqa: BLE001
        raise UnreadableError(say("{name} holds an entity that cannot be read", name=name)) from None
    return CadDrawing(layers)


def _document(name: str, data: bytes) -> Drawing:
    from ezdxf import document, recover
    from ezdxf.lldxf.tagger import binary_tags_loader

    if data.startswith(b"AC10"):
        raise UnreadableError(say("{name} is a DWG file; save it as DXF", name=name))
    try:
        # What repairs faults reads text alone.
        if data.startswith(BINARY_SIGNATURE):
            return document.Drawing.load(binary_tags_loader(data))
        return recover.read(io.BytesIO(data))[0]
    except Exception:  # noqa: BLE001  as above
        raise UnreadableError(say("{name} is not a DXF file", name=name)) from None


def _millimetres(name: str, document: Drawing) -> float:
    """How many mm the drawing's unit is."""
    from ezdxf import units

    code = document.header.get("$INSUNITS", 0)
    if code == 0:
        return 1.0
    try:
        return units.conversion_factor(units.InsertUnits(code), units.InsertUnits.Millimeters)
    except (ValueError, TypeError, IndexError):
        unit = short_text(str(code))
        raise UnreadableError(
            say("{name}: the drawing's unit ($INSUNITS {code}) is not a length; set it to mm", name=name, code=unit)
        ) from None


def _dissolved(entities: Iterable[Any], block_layer: str, depth: int) -> Generator[tuple[DXFGraphic, str]]:
    """All entities with the layers they show on; those of blocks in their places.

    An insert itself is given too, each place of an array of them, so that a bomb of blocks that are empty counts.
    """
    for entity in entities:
        own = str(entity.dxf.get("layer", "0"))
        layer = block_layer if own == "0" else own
        if entity.dxftype() != "INSERT":
            yield entity, layer
            continue
        if depth == MAX_BLOCK_DEPTH:
            raise UnreadableError(say("blocks are nested more than {most} deep", most=MAX_BLOCK_DEPTH))
        for single in entity.multi_insert() if entity.mcount > 1 else (entity,):
            yield single, layer
            yield from _dissolved(single.virtual_entities(), layer, depth + 1)


def _add(layer: Layer, entity: DXFGraphic, factor: float) -> int:
    """How many points it adds."""
    kind = entity.dxftype()
    if kind == "POINT":
        layer.points.append(_place(entity.dxf.location, factor))
    elif kind in CURVE_TYPES:
        if kind == "CIRCLE":
            layer.centres.append(_place(entity.ocs().to_wcs(entity.dxf.center), factor))
        layer.curves.append(_curve(entity, factor))
        return layer.curves[-1].size
    elif kind not in TEXT_TYPES and kind != "INSERT":
        layer.strange.add(kind)
    return 1


def _place(at: Any, factor: float) -> complex:
    z = factor * complex(at.x, at.y)
    # NaN fails too.
    if not (abs(z.real) <= MAX_COORDINATE and abs(z.imag) <= MAX_COORDINATE):
        raise UnreadableError(
            say(
                "a point lies {far:.3g} mm from the origin, but no sheet is that large; check the unit of the "
                "drawing ($INSUNITS)",
                far=abs(z),
            )
        )
    return z


def _curve(entity: Any, factor: float) -> Points:
    from ezdxf.path import make_path

    if entity.dxftype() == "SPLINE" and not len(entity.control_points) and len(entity.fit_points) > MAX_FIT_POINTS:
        raise UnreadableError(say("a {kind} has more than {most} points", kind="SPLINE", most=MAX_FIT_POINTS))
    if entity.dxftype() == "POLYLINE":
        # A program that fits a curve to a polyline keeps the corners that it had before.
        drawn = [each for each in entity.vertices if not each.get_flag_state(each.SPLINE_FRAME_CONTROL_POINT)]
        entity.vertices[:] = drawn
    path = make_path(entity)
    # Before it is divided: what is far too large would be divided for long.
    for vertex in path.control_vertices():
        _place(vertex, factor)
    found = [
        _place(vertex, factor) for vertex in islice(path.flattening(FLATNESS / factor, segments=4), MAX_POINTS + 1)
    ]
    if len(found) > MAX_POINTS:
        raise UnreadableError(say("a {kind} has more than {most} points", kind=entity.dxftype(), most=MAX_POINTS))
    if not found:
        raise UnreadableError(say("a {kind} is empty", kind=entity.dxftype()))
    return np.array(found)
