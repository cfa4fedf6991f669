"""Each check of a foreign reader fails where the file is at fault."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import checks
import ezdxf
import pytest
from pdf_paths import pages
from scene import drawing as scene

from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.matplotlib_renderer import write_pdf
from graphcam.sheets.model import Drawing, Entity, Group, Page, Strokes, Text

A_TENTH = 0.1
"""A fault of the scale: the gauge is so much too long, mm."""


def changed(drawing: Drawing, change: object) -> Drawing:
    """The drawing with every entity changed, or left out where the change gives None."""
    assert callable(change)

    def of_page(page: Page) -> Page:
        groups = ((g, tuple(x for e in g.entities if (x := change(e)) is not None)) for g in page.groups)
        return replace(page, groups=tuple(Group(g.name, entities) for g, entities in groups))

    return Drawing(drawing.title, tuple(of_page(page) for page in drawing.pages))


def too_long(entity: Entity) -> Entity:
    return replace(entity, ends=entity.ends + A_TENTH) if entity.role == "gauge" else entity


def without_axes(entity: Entity) -> Entity | None:
    return None if entity.role == "axis" else entity


def blank(entity: Entity) -> Entity | None:
    return None


def test_a_tenth_of_a_millimetre_on_the_gauge_is_found_in_our_pdf(tmp_path: Path) -> None:
    write_pdf(changed(scene(), too_long), tmp_path / "sheet.pdf")
    (page,) = pages(tmp_path / "sheet.pdf")
    with pytest.raises(AssertionError):
        checks.check_gauge(page, checks.RULER)


def test_a_tenth_of_a_millimetre_on_the_gauge_is_found_in_librecads_pdf(tmp_path: Path) -> None:
    write_dxf(changed(scene(), too_long), tmp_path / "sheet.dxf")
    page = checks.by_librecad(tmp_path / "sheet.dxf", tmp_path)
    with pytest.raises(AssertionError):
        checks.check_gauge(page, checks.LIBRECAD_LENGTH)


def test_a_page_of_another_format_is_found(tmp_path: Path) -> None:
    write_pdf(scene("A3"), tmp_path / "sheet.pdf")
    page, drawn = pages(tmp_path / "sheet.pdf")[0], scene().pages[0]
    with pytest.raises(AssertionError):
        checks.check_page(page, drawn.width, drawn.height, checks.LIBRECAD_PAGE)
    with pytest.raises(AssertionError):
        checks.check_frame(page, drawn, checks.RULER)


def test_an_empty_pdf_is_found(tmp_path: Path) -> None:
    write_pdf(changed(scene(), blank), tmp_path / "sheet.pdf")
    (page,) = pages(tmp_path / "sheet.pdf")
    with pytest.raises(AssertionError):
        checks.check_gauge(page, checks.RULER)
    with pytest.raises(AssertionError):
        checks.check_ink(page, scene().pages[0])
    with pytest.raises(AssertionError):
        checks.check_widths(page)
    with pytest.raises(AssertionError):
        checks.check_words(tmp_path / "sheet.pdf", scene())


def test_a_missing_layer_is_found(tmp_path: Path) -> None:
    write_dxf(changed(scene(), without_axes), tmp_path / "sheet.dxf")
    with pytest.raises(AssertionError):
        checks.check_written(tmp_path / "sheet.dxf", scene())
    page = checks.by_librecad(tmp_path / "sheet.dxf", tmp_path)
    with pytest.raises(AssertionError, match="axis is not printed"):
        checks.check_ink(page, scene().pages[0])


def test_a_text_in_other_letters_is_found(tmp_path: Path) -> None:
    def latin(entity: Entity) -> Entity:
        return replace(entity, text=entity.text.replace("у", "y")) if isinstance(entity, Text) else entity

    write_pdf(changed(scene(), latin), tmp_path / "sheet.pdf")
    with pytest.raises(AssertionError):
        checks.check_words(tmp_path / "sheet.pdf", scene())


def test_a_line_of_another_width_is_found(tmp_path: Path) -> None:
    def frame_as_gauge(entity: Entity) -> Entity:
        return replace(entity, role="gauge") if entity.role in ("frame", "result") else entity

    write_pdf(changed(scene(), frame_as_gauge), tmp_path / "sheet.pdf")
    (page,) = pages(tmp_path / "sheet.pdf")
    with pytest.raises(AssertionError):
        checks.check_widths(page)


def test_arcs_as_chords_of_four_degrees_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The lengths agree so closely that GDAL's own coarse chords would not pass."""
    write_dxf(scene(), tmp_path / "sheet.dxf")
    monkeypatch.setattr(checks, "GDAL_STEP", "4")
    with pytest.raises(AssertionError):
        checks.check_lengths(tmp_path / "sheet.dxf")


def test_an_entity_that_gdal_does_not_know_is_found(tmp_path: Path) -> None:
    write_dxf(scene(), tmp_path / "sheet.dxf")
    document = ezdxf.readfile(tmp_path / "sheet.dxf")
    document.modelspace().add_xline((1, 1), (1, 0), dxfattribs={"layer": "frame-gauge"})
    document.saveas(tmp_path / "sheet.dxf")
    with pytest.raises(AssertionError):
        checks.check_layers(tmp_path / "sheet.dxf")


def test_strokes_are_strokes() -> None:
    """The changes above reach what they are meant for."""
    gauge = [e for g in scene().pages[0].groups for e in g.entities if e.role == "gauge"]
    assert gauge
    assert all(isinstance(e, Strokes) for e in gauge)
