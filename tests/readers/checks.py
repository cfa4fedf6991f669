"""What a foreign reader must find in a file of a drawing; each check fails where it does not."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections import Counter
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing as Document
from ezdxf.entities import LWPolyline
from pdf_paths import PdfPage, pages
from programs import count, program
from scipy.spatial import cKDTree

from graphcam.sheets.model import ArcEntity, Circles, Curve, Drawing, Entity, Heads, Page, Stroke, Strokes, Text
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.text_measures import letters_of, width

RULER = 0.005
"""Our own PDF is true within this, mm."""
LIBRECAD_LENGTH = 0.05
"""LibreCAD's PDF of 100 mm is true within this, mm: 0.05 %."""
LIBRECAD_PAGE = 0.18
"""LibreCAD rounds the page to whole points, mm."""
FULL_LINE = 0.15
"""So near to a place of a full line there is ink, mm: LibreCAD's rounding."""
GDAL_LENGTH = 1e-6
"""GDAL's lengths agree so well, relative."""
GDAL_STEP = "0.05"
"""Degrees of the chords by which GDAL measures arcs: short enough for the above."""


def check_page(page: PdfPage, width: float, height: float, within: float) -> None:
    """The page has its size."""
    assert abs(page.width - width) <= within
    assert abs(page.height - height) <= within


def check_gauge(page: PdfPage, within: float) -> None:
    """There is a level line of 100 mm."""
    starts, ends = page.straight
    assert starts.size, "the page is empty"
    level = np.abs((ends - starts).imag) < within
    lengths = np.abs(ends - starts)[level]
    assert np.min(np.abs(lengths - 100.0)) <= within


def check_frame(page: PdfPage, drawn: Page, within: float) -> None:
    """The frame's outline is where the standard puts it: lines along all four of its sides."""
    starts, ends = page.straight
    box = drawn.frame
    corners = np.array([complex(x, y) for x in (box.left, box.right) for y in (box.bottom, box.top)])
    places = np.concatenate([starts, ends])
    assert all(np.min(np.abs(places - corner), initial=np.inf) <= within for corner in corners)


def check_widths(page: PdfPage) -> None:
    """Lines are drawn in the widths of the styles, and in no others."""
    widths = {round(path.width, 2) for path in page.paths if path.width}
    assert {0.25, 0.5} <= widths <= {style.width for style in STYLES_BY_ROLE.values()}


def check_words(pdf: Path, drawing: Drawing) -> None:
    """pdftotext finds every word of every text, as often as it is written."""
    text = subprocess.run(
        [program("pdftotext"), "-enc", "UTF-8", "-raw", pdf, "-"], check=True, capture_output=True, text=True
    ).stdout
    # A reader may part or join words that stand close together; the letters must all be there.
    found = Counter(re.sub(r"\s", "", text))
    letters = "".join(piece.text for t in texts(drawing) for piece in letters_of(t.text, t.height))
    written = Counter("".join(letters.split()))
    assert found == written


def texts(drawing: Drawing) -> list[Text]:
    """All texts of a drawing."""
    return [e for page in drawing.pages for g in page.groups for e in g.entities if isinstance(e, Text)]


# --- LibreCAD --------------------------------------------------------------------------------------------------------


def by_librecad(dxf: Path, folder: Path) -> PdfPage:
    """The page that LibreCAD prints of a DXF."""
    subprocess.run(
        [program("librecad"), "dxf2pdf", "-t", folder, dxf],
        # It hangs on a file that it cannot read.
        check=False, capture_output=True, timeout=120, env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    printed = folder / f"{dxf.stem}.pdf"
    assert printed.exists(), "LibreCAD printed nothing"
    (page,) = pages(printed)
    return page


def check_ink(page: PdfPage, drawn: Page, *, redrawn: bool = False) -> None:
    """There is ink wherever the drawing has a line, an arrow's head or a text.

    redrawn : whether the reader draws dimension lines anew, by its own overruns; then their texts are looked for alone
    """
    starts, ends = page.straight
    assert starts.size, "the page is empty"
    ink = cKDTree(_xy(_dense(starts, ends)))
    for group in drawn.groups:
        for entity in group.entities:
            if redrawn and entity.role == "dimension":
                continue
            distance, _ = ink.query(_xy(_places(entity)))
            assert np.max(distance) <= _near(entity), f"{group.name}: {entity.role} is not printed"


def _near(entity: Entity) -> float:
    """So near to a place of an entity there is ink, mm."""
    if isinstance(entity, Text):
        # Somewhere about the middle of a text there is a letter.
        return 1.5 * entity.height
    # Of a line type only whole repetitions are printed.
    return max(FULL_LINE, sum(STYLES_BY_ROLE[entity.role].pattern))


def _dense(starts: np.ndarray, ends: np.ndarray, step: float = 0.1) -> np.ndarray:
    counts = np.maximum(1, np.ceil(np.abs(ends - starts) / step)).astype(int)
    line = np.repeat(np.arange(starts.size), counts)
    share = (np.arange(line.size) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[line]
    return np.concatenate([starts[line] + share * (ends - starts)[line], ends])


def _xy(points: np.ndarray) -> np.ndarray:
    return np.column_stack([points.real, points.imag])


def _places(entity: Entity) -> np.ndarray:
    """Some places on an entity."""
    match entity:
        case Strokes(starts=starts, ends=ends):
            return np.concatenate([starts, (starts + ends) / 2, ends])
        case Stroke(points=points):
            return points
        case Curve(points=points):
            return points
        case Circles(centres=centres, radius=radius):
            return np.concatenate([centres + radius * turn for turn in (1, 1j, -1, -1j)])
        case ArcEntity(centre=centre, radius=radius, start=start, end=end):
            return centre + radius * np.exp(1j * np.linspace(start, end, 9))
        case Heads(corners=corners):
            return corners[:, 0]
        case Text():
            shift = {"left": 0.5, "center": 0.0, "right": -0.5}[entity.align] * width(entity.text, entity.height)
            return np.array([entity.at + (shift + 0.5j * entity.height) * np.exp(1j * entity.angle)])


# --- GDAL ------------------------------------------------------------------------------------------------------------


def check_layers(dxf: Path) -> None:
    """GDAL finds as many entities as ezdxf in every layer, and every text letter by letter."""
    document = ezdxf.readfile(dxf)
    ours = Counter(entity.dxf.layer for entity in document.modelspace())
    theirs = _rows(dxf, "select Layer, count(*) n from entities group by Layer")
    assert {row["Layer"]: row["n"] for row in theirs} == ours
    written = Counter(text.dxf.text for text in document.modelspace().query("TEXT"))
    read = _rows(dxf, "select Text, count(*) n from entities where Text is not null group by Text")
    assert {row["Text"]: row["n"] for row in read} == written


def check_lengths(dxf: Path) -> None:
    """The lengths of all curves together agree with what their own equations give."""
    (row,) = _rows(dxf, "select sum(ST_Length(geometry)) length from entities where Text is null "
                   "and ST_Dimension(geometry) = 1")  # fmt: skip
    assert row["length"] == pytest.approx(length(ezdxf.readfile(dxf)), rel=GDAL_LENGTH)


def check_written(dxf: Path, drawing: Drawing) -> None:
    """The DXF holds the layers and the number of entities of the drawing it was written from."""
    found = Counter(entity.dxf.layer for entity in ezdxf.readfile(dxf).modelspace())
    several = len(drawing.pages) > 1
    expected: Counter[str] = Counter()
    for number, page in enumerate(drawing.pages, 1):
        for group in page.groups:
            for entity in group.entities:
                layer = f"p{number}-" * several + re.sub(r"[^\w-]+", "-", group.name)
                expected[f"{layer}-{entity.role}"] += count(entity)
    assert found == expected


def corners(polyline: LWPolyline) -> np.ndarray:
    """The corners of a polyline, the first one again at the end of a closed one."""
    points = [complex(*at) for at in polyline.vertices()]
    return np.array(points + points[:1] * polyline.closed)


def length(document: Document) -> float:
    """The length of all curves of the model space together, by their own equations [mm]."""
    total = 0.0
    for entity in document.modelspace():
        match entity.dxftype():
            case "LINE":
                total += entity.dxf.start.distance(entity.dxf.end)
            case "LWPOLYLINE":
                total += np.sum(np.abs(np.diff(corners(entity))))
            case "CIRCLE":
                total += 2 * np.pi * entity.dxf.radius
            case "ARC":
                turn = (entity.dxf.end_angle - entity.dxf.start_angle) % 360
                total += np.radians(turn) * entity.dxf.radius
            case "SPLINE":
                points = np.array([complex(p.x, p.y) for p in entity.construction_tool().approximate(50_000)])
                total += np.sum(np.abs(np.diff(points)))
            case _:
                pass
    return float(total)


def _rows(dxf: Path, query: str) -> list[dict[str, object]]:
    """The rows of a query of the DXF's entities."""
    out = subprocess.run(
        [program("ogr2ogr"), "--config", "DXF_ENCODING", "UTF-8", "--config", "OGR_ARC_STEPSIZE", GDAL_STEP,
         "--config", "DXF_INLINE_BLOCKS", "NO", "-f", "GeoJSONSeq", "-dialect", "SQLite", "-sql", query,
         "/vsistdout/", dxf],
        check=True, capture_output=True, text=True,
    ).stdout  # fmt: skip
    return [json.loads(line)["properties"] for line in out.splitlines()]
