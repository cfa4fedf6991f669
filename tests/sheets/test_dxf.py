"""The DXF holds what the model holds, and the auditor has nothing to say."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing as Document
from programs import count
from scene import drawing, oval

from graphcam.sheets.dxf_renderer import PAGE_GAP, write_dxf
from graphcam.sheets.model import Curve, Drawing, Page, Text
from graphcam.sheets.smooth_curves import bezier
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.text_measures import letters_of


def written(drawn: Drawing, path: Path) -> Document:
    write_dxf(drawn, path)
    return ezdxf.readfile(path)


@pytest.mark.parametrize("paper", ["A1", "A3"])
def test_audit_is_clean_and_layers_are_complete(tmp_path: Path, paper: str) -> None:
    drawn = drawing(paper)
    document = written(drawn, tmp_path / "sheet.dxf")
    auditor = document.audit()
    assert (len(auditor.errors), len(auditor.fixes)) == (0, 0)
    found = Counter(entity.dxf.layer for entity in document.modelspace())
    expected: Counter[str] = Counter()
    for number, page in enumerate(drawn.pages, 1):
        prefix = f"p{number}-" if len(drawn.pages) > 1 else ""
        for group in page.groups:
            for entity in group.entities:
                expected[f"{prefix}{group.name.replace(' ', '-')}-{entity.role}"] += count(entity)
    assert found == expected
    assert all(layer in document.layers for layer in found)


def test_layers_carry_width_and_line_type(tmp_path: Path) -> None:
    document = written(drawing(), tmp_path / "sheet.dxf")
    for layer in document.layers:
        if (role := layer.dxf.name.rsplit("-", 1)[-1]) in STYLES_BY_ROLE:
            assert layer.dxf.lineweight == round(100 * STYLES_BY_ROLE[role].width)
    types = {layer.dxf.linetype for layer in document.layers}
    assert types == {"Continuous", "CONTINUOUS", "CENTER", "DASHED"} & types >= {"CENTER", "DASHED"}


def test_texts_keep_their_letters_and_height(tmp_path: Path) -> None:
    drawn = drawing()
    document = written(drawn, tmp_path / "sheet.dxf")
    texts = [e for g in drawn.pages[0].groups for e in g.entities if isinstance(e, Text)]
    model = Counter((piece.text.strip(), piece.height) for e in texts for piece in letters_of(e.text, e.height))
    assert Counter((t.dxf.text, t.dxf.height) for t in document.modelspace().query("TEXT")) == model
    # An index is a text of its own, a size smaller.
    assert {("φ", 3.5), ("1", 2.5), ("= 80°", 3.5)} <= set(model)


def test_profile_is_one_clamped_spline(tmp_path: Path) -> None:
    document = written(drawing(), tmp_path / "sheet.dxf")
    (spline,) = document.modelspace().query("SPLINE")
    assert spline.dxf.flags == 0
    assert spline.dxf.degree == 3
    assert len(spline.weights) == 0
    assert tuple(spline.control_points[0]) == tuple(spline.control_points[-1])
    knots = list(spline.knots)
    assert knots[:4] == [knots[0]] * 4
    assert knots[-4:] == [knots[-1]] * 4


def test_spline_follows_the_curve(tmp_path: Path) -> None:
    """Between its points too, within 0.001 mm: an ellipse tells by its equation."""
    document = written(drawing(), tmp_path / "sheet.dxf")
    (spline,) = document.modelspace().query("SPLINE")
    points = np.array([complex(p.x, p.y) for p in spline.construction_tool().approximate(4001)])
    points -= (points.real.max() + points.real.min()) / 2 + 1j * (points.imag.max() + points.imag.min()) / 2
    f = (points.real / 60) ** 2 + (points.imag / 45) ** 2 - 1
    gradient = 2 * np.hypot(points.real / 60**2, points.imag / 45**2)
    assert np.max(np.abs(f / gradient)) < 0.001


def test_smooth_curve_is_of_fourth_order() -> None:
    def error(n: int) -> float:
        control = bezier(oval(n))
        middle = (control[0:-1:3] + 3 * control[1::3] + 3 * control[2::3] + control[3::3]) / 8
        return float(np.max(np.abs((middle.real / 60) ** 2 + (middle.imag / 45) ** 2 - 1)))

    counts = np.array([100, 200, 400])
    slope, _ = np.polyfit(np.log(counts), np.log([error(n) for n in counts]), 1)
    assert slope == pytest.approx(-4, abs=0.1)


def test_corner_stays_a_corner(tmp_path: Path) -> None:
    """A square with dense points bends only in its corners: nothing rings beside them."""
    side = np.arange(20) / 20
    square = np.concatenate([side, 1 + 1j * side, 1 - side + 1j, 1j * (1 - side)]) * 100
    drawn = drawing()
    page = drawn.pages[0]
    group = type(page.groups[0])("cam", (Curve(square, "result"),))
    document = written(Drawing("", (Page(page.width, page.height, page.frame, (group,)),)), tmp_path / "square.dxf")
    assert not document.audit().errors
    (spline,) = document.modelspace().query("SPLINE")
    points = np.array([complex(p.x, p.y) for p in spline.construction_tool().approximate(2001)]) - (50 + 50j)
    assert np.max(np.abs(np.maximum(np.abs(points.real), np.abs(points.imag)) - 50)) < 1e-9


def test_the_header_says_where_the_drawing_lies(tmp_path: Path) -> None:
    """A program that zooms to the extents of the file shows the sheet."""
    drawn = drawing("A3")
    header = written(drawn, tmp_path / "sheet.dxf").header
    wide = sum(page.width for page in drawn.pages) + PAGE_GAP * (len(drawn.pages) - 1)
    assert tuple(header["$EXTMIN"]) == (0, 0, 0)
    assert tuple(header["$EXTMAX"]) == (wide, drawn.pages[0].height, 0)
