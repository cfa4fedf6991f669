"""Curves in DXF files of any CAD program, by ezdxf: units and blocks put right, pieces joined at their ends."""

from __future__ import annotations

import io
import logging
from collections import deque
from collections.abc import Generator, Iterable
from dataclasses import dataclass, field
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import UnreadableError
from graphcam.words import say

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.entities.dxfgfx import DXFGraphic

logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # else a faulty file fills the teacher's terminal
Points = NDArray[np.complex128]
MAX_POINTS = 20_000
"""Points of one curve."""
MAX_LINES = 500_000
"""Lines of a file that are read, and MAX_BYTES of a binary one: what ezdxf reads in a few seconds."""
MAX_BYTES = 2_500_000
MAX_ENTITIES = 20_000
"""Entities that are looked at, those in blocks counted each time the block stands there."""
MAX_VERTICES = 400_000
"""Points of all curves together, of bent ones those of the chords in their place."""
MAX_FIT_POINTS = 1000
"""Points that a spline is fitted through: for that ezdxf solves as many equations, each with as many unknowns."""
MAX_BLOCK_DEPTH, MAX_SHOWN_LETTERS = 8, 40
FLATNESS = 0.005
"""A curve is replaced by chords that stay so near to it, mm: far below the finest pencil line."""
BEZIERS = 16
"""Bezier curves in place of an arc: one of 90 degrees is off by 3e-4 of its radius, one of 23 degrees by 7e-8."""
MAX_END_GAP = 0.2
"""Ends as near as this meet, mm: the width of a pencil line."""
MAX_PIECES = 5000
"""Pieces that are joined; nobody draws one curve of more."""
MAX_COORDINATE = 5000.0
"""mm: no sheet is larger, so farther coordinates come from wrong units."""
BINARY_SIGNATURE = b"AutoCAD Binary DXF"
CURVE_TYPES = {"LINE", "LWPOLYLINE", "POLYLINE", "SPLINE", "ARC", "CIRCLE", "ELLIPSE"}
TEXT_TYPES = {"TEXT", "MTEXT", "DIMENSION", "LEADER", "MULTILEADER", "HATCH", "SOLID", "ATTDEF", "ATTRIB", "VIEWPORT"}
"""What may stand on a layer beside the answer."""


@dataclass
class Layer:
    """What stands on one layer, mm of paper: points, centres of circles, curves, and kinds that are neither."""

    points: list[complex] = field(default_factory=list[complex])
    centres: list[complex] = field(default_factory=list[complex])
    curves: list[Points] = field(default_factory=list[Points])
    strange: set[str] = field(default_factory=set[str])


def read_layers(name: str, data: bytes, flatness: float = FLATNESS) -> dict[str, Layer]:
    """The layers of a DXF file, text or binary, in mm, by their names in small letters.

    The unit of the header counts ($INSUNITS; none means mm), and blocks are dissolved.

    flatness : curves are replaced by chords that stay so near to them [mm]

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
                left -= _add(layers.setdefault(layer.strip().lower(), Layer()), entity, factor, flatness)
                if left < 0:
                    raise UnreadableError(say("{answer} has more than {most} points", answer=name, most=MAX_VERTICES))
    except UnreadableError:
        raise
    # What a stranger wrote into a file can make a library stumble anywhere; it is his answer that is lost then.
    except Exception:  # noqa: BLE001
        raise UnreadableError(say("{name} holds an entity that cannot be read", name=name)) from None
    return layers


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
        unit = str(code)[:MAX_SHOWN_LETTERS]
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


def _add(layer: Layer, entity: DXFGraphic, factor: float, flatness: float) -> int:
    """How many points it adds."""
    kind = entity.dxftype()
    if kind == "POINT":
        layer.points.append(_place(entity.dxf.location, factor))
    elif kind in CURVE_TYPES:
        if kind == "CIRCLE":
            layer.centres.append(_place(entity.ocs().to_wcs(entity.dxf.center), factor))
        layer.curves.append(_curve(entity, factor, flatness))
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


def _curve(entity: Any, factor: float, flatness: float) -> Points:
    from ezdxf.path import make_path

    if entity.dxftype() == "SPLINE" and not len(entity.control_points) and len(entity.fit_points) > MAX_FIT_POINTS:
        raise UnreadableError(say("a {kind} has more than {most} points", kind="SPLINE", most=MAX_FIT_POINTS))
    if entity.dxftype() == "ARC" and not entity.dxf.radius:
        return np.array([_place(entity.ocs().to_wcs(entity.dxf.center), factor)] * 2)  # a piece of no length
    if entity.dxftype() == "POLYLINE":
        # A program that fits a curve to a polyline keeps the corners that it had before.
        drawn = [each for each in entity.vertices if not each.get_flag_state(each.SPLINE_FRAME_CONTROL_POINT)]
        entity.vertices[:] = drawn
    # A polyline's arcs one by one, since of these each is divided before Bezier curves take its place.
    bulging = entity.dxftype() in {"LWPOLYLINE", "POLYLINE"} and entity.has_arc
    paths = [make_path(part, segments=BEZIERS) for part in (entity.virtual_entities() if bulging else (entity,))]
    # Before it is divided: what is far too large would be divided for long.
    for path in paths:
        for vertex in path.control_vertices():
            _place(vertex, factor)
    flattened = (path.flattening(flatness / factor, segments=4) for path in paths)
    found = [[_place(vertex, factor) for vertex in islice(each, MAX_POINTS + 1)] for each in flattened]
    if sum(map(len, found)) > MAX_POINTS + len(found):
        raise UnreadableError(say("a {kind} has more than {most} points", kind=entity.dxftype(), most=MAX_POINTS))
    if not any(found):
        raise UnreadableError(say("a {kind} is empty", kind=entity.dxftype()))
    return joined_curves("", [np.array(each) for each in found])[0] if bulging else np.array(found[0])


# --- pieces of one curve ----------------------------------------------------------------------------------------------


def one_curve(layer: str, pieces: list[Points]) -> Points:
    """The pieces (n,) each, joined at their ends; a closed curve ends where it begins.

    Raises
    ------
    UnreadableError : they do not make one curve; the sentence says where it breaks

    >>> one_curve("s", [np.array([1 + 1j, 2 + 0j]), np.array([1 + 1j, 0j])])
    array([0.+0.j, 1.+1.j, 2.+0.j])
    """
    joined = joined_curves(layer, pieces)
    if not joined:
        raise UnreadableError(say("there is no curve on the layer {layer}", layer=layer))
    curve, *others = joined
    if others:
        ends = np.array([other[[0, -1]] for other in others])
        gap, at = min((float(np.abs(ends - end).min()), end) for end in curve[[0, -1]].tolist())
        why = say(
            "the layer {layer} holds {count} separate curves instead of one; the nearest gap, {gap:.1f} mm, is at "
            "({x:.1f}, {y:.1f})",
            layer=layer,
            count=len(joined),
            gap=gap,
            x=at.real,
            y=at.imag,
        )
        raise UnreadableError(why)
    return curve


def joined_curves(layer: str, pieces: list[Points], end_gap: float = MAX_END_GAP) -> list[Points]:
    """The curves that the pieces (n,) on a layer make, joined where their ends are no farther apart [mm].

    Raises
    ------
    UnreadableError : too many pieces
    """
    if len(pieces) > MAX_PIECES:
        why = say(
            "the layer {layer} holds more than {most} pieces of a curve; join them to one polyline",
            layer=layer,
            most=MAX_PIECES,
        )
        raise UnreadableError(why)
    left = _distinct(pieces)
    ends, free = np.array([piece[[0, -1]] for piece in left]), np.ones(len(left), dtype=bool)
    found: list[Points] = []
    while free.any():
        found.append(_traced(left, ends, free, end_gap))
    return found


def _traced(pieces: list[Points], ends: Points, free: NDArray[np.bool_], end_gap: float) -> Points:
    """The first free piece, prolonged at both its ends by those that follow there; all these are free no more."""
    first = int(np.argmax(free))
    free[first] = False
    chain = deque([pieces[first]])
    for at_start in (False, True):
        while free.any():
            tail = chain[0][0] if at_start else chain[-1][-1]
            distance = np.where(free[:, None], np.abs(ends - tail), np.inf)
            k, side = divmod(int(np.argmin(distance)), 2)
            if distance[k, side] > end_gap:
                break
            free[k] = False
            if at_start:
                chain.appendleft(pieces[k] if side else pieces[k][::-1])
            else:
                chain.append(pieces[k][::-1] if side else pieces[k])
    return np.concatenate([chain[0], *(piece[1:] for piece in islice(chain, 1, None))])


def _distinct(pieces: list[Points]) -> list[Points]:
    """The pieces without those of no length, and without one that is drawn twice."""
    seen: set[tuple[complex, ...]] = set()
    kept: list[Points] = []
    for piece in pieces:
        marks = [complex(np.round(z, 3)) for z in (piece[0], piece[len(piece) // 2], piece[-1])]
        ends = sorted((marks[0], marks[-1]), key=lambda z: (z.real, z.imag))
        key = tuple(ends + ([marks[1]] if len(piece) > 2 else []))
        if np.ptp(piece.real) + np.ptp(piece.imag) > 0 and key not in seen:
            kept.append(piece)
            seen.add(key)
    return kept
