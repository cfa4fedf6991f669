"""DXF files of any CAD program, by ezdxf: units and blocks put right."""

from __future__ import annotations

import io
import logging
from collections.abc import Generator, Iterable
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from graphcam.exercises.reading.drawn_layers import CadDrawing, Layer
from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.values import MOST_POINTS, Points, shown
from graphcam.words import say

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic

logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # else a faulty file fills the teacher's terminal
MOST_LINES = 500_000
"""Lines of a file that are read, and MOST_BYTES of a binary one: what ezdxf reads in a few seconds."""
MOST_BYTES = 2_500_000
MOST_ENTITIES = 20_000
"""Entities that are looked at, those in blocks counted each time the block stands there."""
MOST_VERTICES = 400_000
"""Points of all curves together, of bent ones those of the chords in their place."""
MOST_FITTED = 1000
"""Points that a spline is fitted through: for that ezdxf solves as many equations, each with as many unknowns."""
DEEPEST_BLOCK = 8
FLAT = 0.005
"""A curve is replaced by chords that stay so near to it, mm: far below the finest pencil line."""
LARGEST = 5000.0
"""mm: no sheet is larger, so farther coordinates come from wrong units."""
BINARY = b"AutoCAD Binary DXF"
CURVES = {"LINE", "LWPOLYLINE", "POLYLINE", "SPLINE", "ARC", "CIRCLE", "ELLIPSE"}
WORDS = {"TEXT", "MTEXT", "DIMENSION", "LEADER", "MULTILEADER", "HATCH", "SOLID", "ATTDEF", "ATTRIB", "VIEWPORT"}
"""What may stand on a layer beside the answer."""


def read_dxf(name: str, data: bytes) -> CadDrawing:
    """The layers of a DXF file, text or binary, in mm.

    The unit of the header counts ($INSUNITS; none means mm), and blocks are dissolved.

    Raises
    ------
    UnreadableError : no DXF, a unit that is no length, more or farther entities than a sheet can hold
    """
    if data.startswith(BINARY) and len(data) > MOST_BYTES:
        raise UnreadableError(say("{name} is longer than the {limit} bytes that are read", name=name, limit=MOST_BYTES))
    if data.count(b"\n") > MOST_LINES:
        raise UnreadableError(say("{name} has more than {most} rows", name=name, most=MOST_LINES))
    document = _document(name, data)
    factor = _millimetres(name, document)
    layers: dict[str, Layer] = {}
    try:
        entities = list(islice(_dissolved(document.modelspace(), "0", 0), MOST_ENTITIES + 1))
        if len(entities) > MOST_ENTITIES:
            raise UnreadableError(say("{name} has more than {most} entities", name=name, most=MOST_ENTITIES))
        left = MOST_VERTICES
        with np.errstate(all="ignore"):
            for entity, layer in entities:
                # Programs tell layers neither by capitals nor by a space at the end.
                left -= _add(layers.setdefault(layer.strip().lower(), Layer()), entity, factor)
                if left < 0:
                    raise UnreadableError(say("{answer} has more than {most} points", answer=name, most=MOST_VERTICES))
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
        if data.startswith(BINARY):
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
        unit = shown(str(code))
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
        if depth == DEEPEST_BLOCK:
            raise UnreadableError(say("blocks stand within blocks more than {most} deep", most=DEEPEST_BLOCK))
        for single in entity.multi_insert() if entity.mcount > 1 else (entity,):
            yield single, layer
            yield from _dissolved(single.virtual_entities(), layer, depth + 1)


def _add(layer: Layer, entity: DXFGraphic, factor: float) -> int:
    """How many points it adds."""
    kind = entity.dxftype()
    if kind == "POINT":
        layer.points.append(_place(entity.dxf.location, factor))
    elif kind in CURVES:
        if kind == "CIRCLE":
            layer.centres.append(_place(entity.ocs().to_wcs(entity.dxf.center), factor))
        layer.curves.append(_curve(entity, factor))
        return layer.curves[-1].size
    elif kind not in WORDS and kind != "INSERT":
        layer.strange.add(kind)
    return 1


def _place(at: Any, factor: float) -> complex:
    z = factor * complex(at.x, at.y)
    # NaN fails too.
    if not (abs(z.real) <= LARGEST and abs(z.imag) <= LARGEST):
        raise UnreadableError(
            say(
                "a point lies {far:.3g} mm from the origin, and no sheet is so large; check the unit of the drawing "
                "($INSUNITS)",
                far=abs(z),
            )
        )
    return z


def _curve(entity: Any, factor: float) -> Points:
    from ezdxf.path import make_path

    if entity.dxftype() == "SPLINE" and not len(entity.control_points) and len(entity.fit_points) > MOST_FITTED:
        raise UnreadableError(say("a {kind} has more than {most} points", kind="SPLINE", most=MOST_FITTED))
    if entity.dxftype() == "POLYLINE":
        # A program that fits a curve to a polyline keeps the corners that it had before.
        drawn = [each for each in entity.vertices if not each.get_flag_state(each.SPLINE_FRAME_CONTROL_POINT)]
        entity.vertices[:] = drawn
    path = make_path(entity)
    # Before it is divided: what is far too large would be divided for long.
    for vertex in path.control_vertices():
        _place(vertex, factor)
    found = [_place(vertex, factor) for vertex in islice(path.flattening(FLAT / factor, segments=4), MOST_POINTS + 1)]
    if len(found) > MOST_POINTS:
        raise UnreadableError(say("a {kind} has more than {most} points", kind=entity.dxftype(), most=MOST_POINTS))
    if not found:
        raise UnreadableError(say("a {kind} is empty", kind=entity.dxftype()))
    return np.array(found)
