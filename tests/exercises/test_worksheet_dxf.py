"""Who draws in worksheet.dxf is understood wherever the drawing goes from there, or hears what to change."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import checks
import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing
from ezdxf.math import Matrix44
from issued_variants import SECRET, issued, key
from programs import program
from test_drawn_answers import data_of, handed_in, pitch_of, vertices

from graphcam.exercises.course.handouts import origins, worksheet
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.variant import drawn
from graphcam.sheets.dxf_renderer import write_dxf

NAME, LAYER = "inversion-translating", "PITCH"
Curve = np.ndarray


@pytest.fixture(scope="module")
def sheet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    exercise, answer_key = issued(NAME)
    variant = drawn(exercise, "Anna", SECRET, answer_key.draw)
    path = tmp_path_factory.mktemp("papers") / "worksheet.dxf"
    write_dxf(worksheet(variant, Student("Anna")), path, origins(variant), [LAYER])
    return path


def centre(document: Drawing) -> complex:
    (mark,) = document.modelspace().query('POINT[layer=="ORIGIN"]')
    return complex(mark.dxf.location.x, mark.dxf.location.y)


def test_the_mark_is_the_cam_centre_of_the_sheet(sheet: Path):
    """The prime circle, which is given, stands about it in the scale of the profile."""
    document, (exercise, answer_key) = ezdxf.readfile(sheet), issued(NAME)
    inversion = board_chain(drawn(exercise, "Anna", SECRET, answer_key.draw).task)["inversion"]
    circles = {
        round(circle.dxf.radius, 6)
        for circle in document.modelspace().query("CIRCLE")
        if abs(complex(circle.dxf.center.x, circle.dxf.center.y) - centre(document)) < 1e-9
    }
    assert round(answer_key.parameters["r0"] / inversion.givens.mu_l.per_mm, 6) in circles
    assert LAYER in document.layers
    assert not document.modelspace().query(f'*[layer=="{LAYER}"]')


def polyline(document: Drawing, curve: Curve, layer: str = LAYER) -> None:
    document.modelspace().add_lwpolyline(vertices(curve), dxfattribs={"layer": layer})


def spline(document: Drawing, curve: Curve) -> None:
    document.modelspace().add_spline(vertices(curve), dxfattribs={"layer": LAYER})


def old_polyline(document: Drawing, curve: Curve) -> None:
    document.modelspace().add_polyline2d(vertices(curve), dxfattribs={"layer": LAYER})


def in_a_block(document: Drawing, curve: Curve) -> None:
    """As a group that was made a block about a base point of its own."""
    document.blocks.new("CURVE", base_point=(10, 20)).add_lwpolyline(vertices(curve))
    document.modelspace().add_blockref("CURVE", (10, 20), dxfattribs={"layer": LAYER})


def moved(document: Drawing) -> Drawing:
    for entity in document.modelspace():
        entity.translate(-120.5, 33.25, 0)
    return document


def in_inches(document: Drawing) -> Drawing:
    """Scaled, as a program does that changes the unit of a drawing."""
    for entity in document.modelspace():
        entity.transform(Matrix44.scale(1 / 25.4))
    document.header["$INSUNITS"] = 1
    return document


def whole_as_a_block(document: Drawing) -> Drawing:
    """Everything, the mark too, copied into another drawing as one block."""
    other = ezdxf.new("R2018")
    other.header["$INSUNITS"] = 4
    block = other.blocks.new("SHEET")
    for entity in document.modelspace():
        if entity.dxftype() in ("POINT", "LWPOLYLINE", "LINE", "CIRCLE"):
            block.add_entity(entity.copy())
    other.modelspace().add_blockref("SHEET", (77, -8), dxfattribs={"layer": "SHEETS"})
    return other


def same(document: Drawing) -> Drawing:
    return document


UNDERSTOOD: dict[str, tuple[Callable[[Drawing, Curve], None], Callable[[Drawing], Drawing]]] = {
    "a polyline": (polyline, same),
    "a polyline of the old kind": (old_polyline, same),
    "a spline": (spline, same),
    "a block": (in_a_block, same),
    "moved": (polyline, moved),
    "in inches": (spline, in_inches),
    "a block, moved and in inches": (in_a_block, lambda document: in_inches(moved(document))),
    "the sheet as a block": (polyline, whole_as_a_block),
}


@pytest.mark.parametrize("case", UNDERSTOOD)
@pytest.mark.parametrize("hand", ["careful", "offset-sign"])
def test_what_is_drawn_in_the_worksheet_earns_what_its_points_earn(sheet: Path, case: str, hand: str):
    exercise, answer_key = issued(NAME)
    wrong = {asked.name: value.value for asked, value in
             zip(exercise.answers, answer_key.hypotheses["offset-sign"], strict=True)}  # fmt: skip
    curve = np.asarray(key(answer_key)["pitch"]) + (0.25 - 0.2j) if hand == "careful" else np.asarray(wrong["pitch"])
    document = ezdxf.readfile(sheet)
    draw, edit = UNDERSTOOD[case]
    draw(document, curve + centre(document))
    record = handed_in({"answers.dxf": data_of(edit(document), "asc")})
    as_text = handed_in({"answers.toml": f"pitch = {[list(pair) for pair in vertices(curve)]}".encode()})
    assert pitch_of(record).marks == pitch_of(as_text).marks
    assert pitch_of(record).outcome == pitch_of(as_text).outcome == ("right" if hand == "careful" else "wrong")
    # A spline bends between the points, which the same points joined by lines do not.
    assert pitch_of(record).deviation == pytest.approx(pitch_of(as_text).deviation, abs=0.5)
    assert record.notes == ()


def on_layer_0(document: Drawing) -> Drawing:
    for entity in document.modelspace().query(f'*[layer=="{LAYER}"]'):
        entity.dxf.layer = "0"
    return document


def without_the_mark(document: Drawing) -> Drawing:
    for entity in list(document.modelspace()):
        if entity.dxftype() == "POINT":
            document.modelspace().delete_entity(entity)
    return document


def without_the_mark_near_zero(document: Drawing) -> Drawing:
    """Moved so that the cam centre lies 6 mm beside the drawing's own zero."""
    at = centre(document)
    for entity in document.modelspace():
        entity.translate(6 - at.real, -at.imag, 0)
    return without_the_mark(document)


REFUSED = {
    "another layer": (on_layer_0, "nothing on the layer PITCH"),
    "no mark": (without_the_mark, "mark the origin of the paper by a POINT on the layer ORIGIN"),
    "no mark, near the zero": (without_the_mark_near_zero, "seems to be moved as a whole, and has no origin marked"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_understood_says_why(sheet: Path, case: str):
    document = ezdxf.readfile(sheet)
    polyline(document, np.asarray(key(issued(NAME)[1])["pitch"]) + centre(document))
    edit, reason = REFUSED[case]
    record = handed_in({"answers.dxf": data_of(edit(document), "asc")})
    assert pitch_of(record).outcome == "unreadable"
    assert pitch_of(record).marks == 0
    assert any(reason in str(sentence) for sentence in record.feedback)


@pytest.mark.parametrize("shift", [8 + 0j, 7j, -5 - 7j])
def test_a_drawing_moved_against_its_mark_earns_nothing_and_hears_it(sheet: Path, shift: complex):
    document = ezdxf.readfile(sheet)
    polyline(document, np.asarray(key(issued(NAME)[1])["pitch"]) + centre(document) + shift)
    record = handed_in({"answers.dxf": data_of(document, "asc")})
    assert (pitch_of(record).outcome, pitch_of(record).marks) == ("wrong", 0)
    assert any("seems to be moved as a whole relative to the POINT" in str(note) for note in record.notes)


def test_a_drawing_of_another_shape_is_not_called_moved(sheet: Path):
    document = ezdxf.readfile(sheet)
    polyline(document, 1.1 * np.asarray(key(issued(NAME)[1])["pitch"]) + centre(document))
    record = handed_in({"answers.dxf": data_of(document, "asc")})
    assert pitch_of(record).outcome == "wrong"
    assert record.notes == ()


def test_a_file_that_another_program_wrote_anew_is_understood(sheet: Path, tmp_path: Path):
    document = ezdxf.readfile(sheet)
    polyline(document, np.asarray(key(issued(NAME)[1])["pitch"]) + centre(document))
    drawing, again = tmp_path / "drawn.dxf", tmp_path / "answers.dxf"
    document.saveas(drawing)
    only = ["-where", "Layer in ('ORIGIN', 'PITCH')"]
    subprocess.run([program("ogr2ogr"), "-f", "DXF", again, drawing, *only], check=True)
    # GDAL says inches whatever it was given: that is heard of, and once it is put right all is well.
    refused = handed_in({"answers.dxf": again.read_bytes()})
    assert pitch_of(refused).marks == 0
    assert any("check the unit of the drawing" in str(note) for note in refused.notes)
    inches = b"$INSUNITS\n 70\n     1"
    assert inches in again.read_bytes()
    record = handed_in({"answers.dxf": again.read_bytes().replace(inches, inches[:-1] + b"4")})
    assert pitch_of(record).outcome == "right"
    assert pitch_of(record).deviation == pytest.approx(0, abs=1e-3)
    assert record.notes == ()


def test_librecad_shows_the_answer_where_it_is_read(sheet: Path, tmp_path: Path):
    """A dash that begins at every place of the curve is printed there, counted from the corner of the sheet."""
    document = ezdxf.readfile(sheet)
    places = np.asarray(key(issued(NAME)[1])["pitch"]) + centre(document)
    for place in vertices(places):
        document.modelspace().add_lwpolyline([place, (place[0] + 1, place[1]), place], dxfattribs={"layer": LAYER})
    document.saveas(tmp_path / "drawn.dxf")
    starts, ends = checks.by_librecad(tmp_path / "drawn.dxf", tmp_path).straight
    ink = np.concatenate([starts, ends])
    assert max(np.min(np.abs(ink - place)) for place in places) <= checks.FULL_LINE
