"""FreeCAD reads the DXF as exact geometry: every line and curve of it, to a thousandth of a millimetre."""

from __future__ import annotations

from pathlib import Path

import checks
import ezdxf
import numpy as np
import pytest
from programs import freecad
from scene import drawing as scene

import graphcam as gc
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


DRAWS = """
import FreeCAD, Part, importDXF, math
FreeCAD.newDocument("cam")
disc = Part.Circle(FreeCAD.Vector(0, 5, 0), FreeCAD.Vector(0, 0, 1), 30)
found = FreeCAD.ActiveDocument.addObject("Part::Feature", "cam")
found.Shape = Part.Wire([disc.toShape(0, math.pi), disc.toShape(math.pi, 2 * math.pi)])
FreeCAD.ActiveDocument.recompute()
importDXF.export([found], {path!r})
print("\\nFOUND", 1, 1)
"""


def test_an_outline_that_freecad_draws_moves_its_follower(tmp_path: Path) -> None:
    freecad(DRAWS.format(path=str(tmp_path / "cam.dxf")), tmp_path)
    follower = '[follower]\nkind = "translating"\noffset = 0\nroller_radius = 10\n'
    (tmp_path / "cam.toml").write_text(f'[outline]\nfile = "cam.dxf"\n{follower}', encoding="utf-8")
    motion = gc.load_task(tmp_path / "cam.toml").motion()
    phi = np.linspace(0, 2 * np.pi, 361)
    there = 5 * np.cos(phi) + np.sqrt(40**2 - (5 * np.sin(phi)) ** 2) - 35
    assert np.abs(motion(phi - motion.zero)[0] - there).max() < THOUSANDTH
