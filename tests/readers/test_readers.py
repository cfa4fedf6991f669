"""PDF and DXF of the built-in sheets and of a working drawing in other programs: poppler, PDFium, LibreCAD, GDAL."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import checks
import ezdxf
import pytest
from pdf_paths import pages
from scene import drawing as scene

import graphcam
from graphcam.report.documents import sheet_of
from graphcam.sheets.cad_renderer import write_cad
from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.matplotlib_renderer import write_pdf
from graphcam.sheets.model import Drawing, Page
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.working_drawing import working_drawing_of

pytestmark = pytest.mark.slow

TASKS = Path(graphcam.__file__).parent / "data" / "tasks"


@cache
def sheet(task: str) -> Drawing:
    return sheet_of(graphcam.solve(graphcam.load_task(TASKS / f"{task}.toml")))


@pytest.fixture(params=("scene", "part", "coursework", "arcs"))
def drawing(request: pytest.FixtureRequest) -> Drawing:
    if request.param == "part":
        return working_drawing_of(PartContents(graphcam.solve(graphcam.builtin_task())))
    return scene() if request.param == "scene" else sheet(request.param)


def has_scale_bar(page: Page) -> bool:
    """Whether there is one, as on every sheet but the working drawing of a part."""
    return any(entity.role == "gauge" for group in page.groups for entity in group.entities)


def test_our_pdf_is_true_to_scale_and_has_every_word(drawing: Drawing, tmp_path: Path) -> None:
    write_pdf(drawing, tmp_path / "sheet.pdf")
    found = pages(tmp_path / "sheet.pdf")
    for page, drawn in zip(found, drawing.pages, strict=True):
        checks.check_page(page, drawn.width, drawn.height, checks.RULER)
        if has_scale_bar(drawn):
            checks.check_gauge(page, checks.RULER)
        checks.check_frame(page, drawn, checks.RULER)
        checks.check_widths(page)
    checks.check_words(tmp_path / "sheet.pdf", drawing)


def test_librecad_prints_everything_true_to_scale(drawing: Drawing, tmp_path: Path) -> None:
    if len(drawing.pages) > 1:
        drawing = Drawing(drawing.title, drawing.pages[:1])
    write_dxf(drawing, tmp_path / "sheet.dxf")
    page = checks.by_librecad(tmp_path / "sheet.dxf", tmp_path)
    (drawn,) = drawing.pages
    checks.check_page(page, drawn.width, drawn.height, checks.LIBRECAD_PAGE)
    if has_scale_bar(drawn):
        checks.check_gauge(page, checks.LIBRECAD_LENGTH)
    checks.check_ink(page, drawn)


def test_librecad_prints_the_cad_variant_in_its_place_too(drawing: Drawing, tmp_path: Path) -> None:
    """The entries of the title block among them, and every text of a dimension within its height."""
    drawing = Drawing(drawing.title, drawing.pages[:1])
    write_cad(drawing, tmp_path / "sheet.dxf")
    checks.check_ink(checks.by_librecad(tmp_path / "sheet.dxf", tmp_path), drawing.pages[0], redrawn=True)


def test_librecad_prints_the_angles_that_the_cad_variant_measures(tmp_path: Path) -> None:
    """It passes over angles by three points, and would print the same page without them."""
    printed: list[int] = []
    for k in (0, 1):
        file = tmp_path / f"{k}.dxf"
        write_cad(scene(), file)
        document = ezdxf.readfile(file)
        angles = [d for d in document.modelspace().query("DIMENSION") if d.dimtype in (2, 5)]
        assert len(angles) >= 2
        for angle in angles[k:]:
            document.modelspace().delete_entity(angle)
        document.saveas(file)
        printed.append(checks.by_librecad(file, tmp_path).straight[0].size)
    assert printed[1] > printed[0]


def test_gdal_counts_and_measures_every_entity(drawing: Drawing, tmp_path: Path) -> None:
    write_dxf(drawing, tmp_path / "sheet.dxf")
    checks.check_written(tmp_path / "sheet.dxf", drawing)
    checks.check_layers(tmp_path / "sheet.dxf")
    checks.check_lengths(tmp_path / "sheet.dxf")
