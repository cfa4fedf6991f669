"""FreeCAD reads the DXF as exact geometry: every line and curve of it, to a thousandth of a millimetre."""

from __future__ import annotations

from pathlib import Path

import checks
import ezdxf
import numpy as np
import pytest
from programs import freecad
from scene import drawing as scene

from graphcam.sheets.dxf_renderer import write_dxf

pytestmark = pytest.mark.slow

THOUSANDTH = 1e-3
SCRIPT = """
import FreeCAD, Import
FreeCAD.newDocument("sheet")
Import.readDXF({path!r})
edges = [edge for found in FreeCAD.ActiveDocument.Objects for edge in found.Shape.Edges]
print("\\nFOUND", len(edges), repr(sum(edge.Length for edge in edges)))
"""


def test_freecad_finds_every_edge(tmp_path: Path) -> None:
    write_dxf(scene(), tmp_path / "sheet.dxf")
    edges, length = freecad(SCRIPT.format(path=str(tmp_path / "sheet.dxf")), tmp_path)
    document = ezdxf.readfile(tmp_path / "sheet.dxf")
    assert float(length) == pytest.approx(checks.length(document), abs=THOUSANDTH)
    single = len(document.modelspace().query("LINE CIRCLE ARC SPLINE"))
    sides = [np.diff(checks.corners(polyline)) for polyline in document.modelspace().query("LWPOLYLINE")]
    assert int(edges) == single + sum(map(len, sides))
