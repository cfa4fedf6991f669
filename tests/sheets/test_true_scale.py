"""PDF, SVG and DXF are read back by other means than they were written, and measured."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
import zlib
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath
from scene import drawing

from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.matplotlib_renderer import write_pdf, write_png
from graphcam.sheets.model import Drawing
from graphcam.sheets.svg_renderer import write_svg
from graphcam.sheets.text_measures import points_size
from graphcam.sheets.typefaces import lettering_file

MM = 72 / 25.4
RULER = 0.005
"""A length on the sheet is true within this, mm."""
FORMATS = {"A1": (841, 594), "A2": (594, 420), "A3": (420, 297), "A4": (297, 210)}
LINE = re.compile(rb"(-?[\d.]+) (-?[\d.]+) m\s+(-?[\d.]+) (-?[\d.]+) l")


def pdf_contents(path: Path) -> list[bytes]:
    """The unpacked streams of a PDF."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", path.read_bytes(), re.DOTALL)
    unpacked = []
    for stream in streams:
        try:
            unpacked.append(zlib.decompress(stream))
        except zlib.error:
            continue
    return unpacked


def lengths(pattern: re.Pattern[bytes], content: bytes) -> np.ndarray:
    ends = np.array([[float(number) for number in match] for match in pattern.findall(content)])
    return np.hypot(ends[:, 2] - ends[:, 0], ends[:, 3] - ends[:, 1]) / MM


@pytest.mark.parametrize("paper", FORMATS)
@pytest.mark.parametrize("frame", ["gost", "iso"])
def test_pdf_page_and_gauge(tmp_path: Path, paper: str, frame: str) -> None:
    drawn = drawing(paper, frame)
    write_pdf(drawn, tmp_path / "sheet.pdf")
    boxes = re.findall(rb"/MediaBox \[ ?([\d. ]+)\]", (tmp_path / "sheet.pdf").read_bytes())
    assert len(boxes) == len(drawn.pages)
    for box in boxes:
        left, bottom, right, top = (float(number) / MM for number in box.split())
        assert (left, bottom) == (0, 0)
        # A4 of GOST stands upright.
        wide, high = (210, 297) if (paper, frame) == ("A4", "gost") else FORMATS[paper]
        assert abs(right - wide) < RULER
        assert abs(top - high) < RULER
    pages = [content for content in pdf_contents(tmp_path / "sheet.pdf") if b" m" in content and b" l" in content]
    assert sum(bool(np.any(np.abs(lengths(LINE, content) - 100) < RULER)) for content in pages) >= len(drawn.pages)


def test_svg_size_gauge_and_groups(tmp_path: Path) -> None:
    drawn = drawing()
    write_svg(drawn.pages[0], tmp_path / "sheet.svg")
    root = ET.parse(tmp_path / "sheet.svg").getroot()
    assert (root.get("width"), root.get("height")) == ("841mm", "594mm")
    # One unit is one millimetre.
    assert root.get("viewBox") == "0 0 841 594"
    space = {"svg": "http://www.w3.org/2000/svg"}
    frame = root.find(".//svg:g[@id='frame']", space)
    assert frame is not None
    outlines = "".join(path.get("d", "") for path in frame.iter("{http://www.w3.org/2000/svg}path"))
    level = [float(end) - float(start) for start, end in re.findall(r"M(-?[\d.]+) -?[\d.]+H(-?[\d.]+)", outlines)]
    assert np.any(np.abs(np.abs(level) - 100) < RULER)
    for group in drawn.pages[0].groups:
        assert len(root.findall(f".//svg:g[@id='{group.key}']", space)) == 1


def test_svg_keeps_texts_as_texts(tmp_path: Path) -> None:
    write_svg(drawing().pages[0], tmp_path / "sheet.svg")
    texts = [[*e.itertext()] for e in ET.parse(tmp_path / "sheet.svg").iter("{http://www.w3.org/2000/svg}text")]
    assert {"Cam mechanism", "ТММ.01.02", "угол", "7′"} <= {"".join(text) for text in texts}
    # An index is a part of its own.
    assert ["φ", "1", " = 80°"] in texts
    assert ["μ", "a", " = 1.2 (mm/rad²)/mm"] in texts


def test_png_has_its_dots_an_inch(tmp_path: Path) -> None:
    write_png(drawing("A4").pages[0], tmp_path / "sheet.png", dpi=100)
    head = (tmp_path / "sheet.png").read_bytes()[:24]
    size = int.from_bytes(head[16:20]), int.from_bytes(head[20:24])
    assert np.allclose(size, np.array([210, 297]) / 25.4 * 100, atol=1)


def test_dxf_gauge_units_and_page(tmp_path: Path) -> None:
    write_dxf(drawing(), tmp_path / "sheet.dxf")
    document = ezdxf.readfile(tmp_path / "sheet.dxf")
    lines = document.modelspace().query('LINE[layer=="frame-gauge"]')
    assert [line.dxf.start.distance(line.dxf.end) for line in lines] == pytest.approx([100.0], abs=1e-9)
    assert document.units == ezdxf.units.MM
    assert document.header["$PSVPSCALE"] == 1.0
    assert document.paperspace().dxf.paper_width == 841


def test_line_widths_are_those_of_the_standard(tmp_path: Path) -> None:
    write_pdf(drawing(), tmp_path / "sheet.pdf")
    widths = {
        round(float(width) / MM, 3)
        for content in pdf_contents(tmp_path / "sheet.pdf")
        for width in re.findall(rb"(?:^|\s)([\d.]+) w\s", content)
    }
    assert {0.25, 0.5} <= widths <= {0.0, 0.25, 0.5}


@pytest.mark.parametrize("height", [2.5, 3.5, 5.0])
def test_capitals_are_as_high_as_said(height: float) -> None:
    outline = TextPath((0, 0), "H", size=points_size(height), prop=FontProperties(fname=lettering_file()))
    assert np.ptp(outline.vertices[:, 1]) / MM == pytest.approx(height, abs=0.01)


@pytest.mark.parametrize("paper", ["A1", "A4"])
def test_two_runs_write_the_same_bytes(tmp_path: Path, paper: str) -> None:
    def write(run: str) -> list[bytes]:
        drawn: Drawing = drawing(paper)
        write_pdf(drawn, tmp_path / f"{run}.pdf")
        write_svg(drawn.pages[0], tmp_path / f"{run}.svg")
        write_png(drawn.pages[0], tmp_path / f"{run}.png", dpi=50)
        write_dxf(drawn, tmp_path / f"{run}.dxf")
        return [(tmp_path / f"{run}{kind}").read_bytes() for kind in (".pdf", ".svg", ".png", ".dxf")]

    assert [a == b for a, b in zip(write("first"), write("second"), strict=True)] == [True] * 4
