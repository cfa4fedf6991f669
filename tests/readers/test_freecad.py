"""FreeCAD reads the DXF as exact geometry: every line and curve of it, to a thousandth of a millimetre."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import checks
import ezdxf
import numpy as np
import pytest
from scene import drawing as scene

from graphcam.sheets.dxf_renderer import write_dxf

FREECAD = shutil.which("freecadcmd") or shutil.which("FreeCADCmd")
THOUSANDTH = 1e-3
MARK = "FOUND"
SCRIPT = """
import FreeCAD, Import
FreeCAD.newDocument("sheet")
Import.readDXF({path!r})
edges = [edge for found in FreeCAD.ActiveDocument.Objects for edge in found.Shape.Edges]
print("\\n{mark}", len(edges), repr(sum(edge.Length for edge in edges)))
"""


@pytest.mark.slow
# Large, and in no other way needed: it is not among the programs that CI installs.
@pytest.mark.skipif(FREECAD is None, reason="FreeCAD is not installed")
def test_freecad_finds_every_edge(tmp_path: Path) -> None:
    write_dxf(scene(), tmp_path / "sheet.dxf")
    (tmp_path / "read.py").write_text(SCRIPT.format(path=str(tmp_path / "sheet.dxf"), mark=MARK))
    # Its own Python must not meet ours.
    clean = {key: value for key, value in os.environ.items() if key not in ("VIRTUAL_ENV", "PYTHONPATH")}
    out = subprocess.run(
        [str(FREECAD), tmp_path / "read.py"], check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True,
        timeout=300, env=clean | {"QT_QPA_PLATFORM": "offscreen"},
    ).stdout  # fmt: skip
    (line,) = (line for line in out.splitlines() if line.startswith(MARK))
    _, edges, length = line.split()
    document = ezdxf.readfile(tmp_path / "sheet.dxf")
    assert float(length) == pytest.approx(checks.length(document), abs=THOUSANDTH)
    single = len(document.modelspace().query("LINE CIRCLE ARC SPLINE"))
    sides = [np.diff(checks.corners(polyline)) for polyline in document.modelspace().query("LWPOLYLINE")]
    assert int(edges) == single + sum(map(len, sides))
