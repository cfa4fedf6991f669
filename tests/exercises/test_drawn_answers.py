"""An answer drawn in CAD earns what the same points earn as text, however the drawing is made; or a reason is given."""

from __future__ import annotations

import io
import random
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from ezdxf import recover
from ezdxf.document import Drawing
from issued_variants import SECRET, issued, key

from graphcam.exercises.grading.grade_one import Assignment, Submission, grade, read_submission
from graphcam.exercises.marking.record import MarkedAnswer, Record

NAME, LAYER = "inversion-translating", "PITCH"
AWAY = 210 + 148j
"""Where the origin lies on a sheet whose own zero is its corner."""
Curve = np.ndarray


def vertices(curve: Curve) -> list[tuple[float, float]]:
    return [(z.real, z.imag) for z in curve.tolist()]


def new(unit: int = 4) -> Drawing:
    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = unit
    return document


def polyline(document: Drawing, curve: Curve, layer: str = LAYER) -> Drawing:
    document.modelspace().add_lwpolyline(vertices(curve), dxfattribs={"layer": layer})
    return document


def origin(document: Drawing, at: complex, layer: str = "ORIGIN") -> Drawing:
    document.modelspace().add_point((at.real, at.imag), dxfattribs={"layer": layer})
    return document


def lines(curve: Curve) -> Drawing:
    """Drawn piece by piece, in any order and to either side."""
    document = origin(new(), 0j)
    pieces = [(a, b) if k % 3 else (b, a) for k, (a, b) in enumerate(pairwise(curve))]
    random.Random(1).shuffle(pieces)
    for start, end in pieces:
        document.modelspace().add_line(*vertices(np.array([start, end])), dxfattribs={"layer": LAYER})
    return document


def spline(curve: Curve) -> Drawing:
    document = origin(new(), 0j)
    document.modelspace().add_spline(vertices(curve), dxfattribs={"layer": LAYER})
    return document


def spline_of_control_points(curve: Curve) -> Drawing:
    document = origin(new(), 0j)
    document.modelspace().add_cad_spline_control_frame(vertices(curve), dxfattribs={"layer": LAYER})
    return document


def fitted_polyline(curve: Curve) -> Drawing:
    """As AutoCAD keeps one that a curve was fitted to: the corners it had, and the curve through them."""
    document = origin(new(), 0j)
    drawn = document.modelspace().add_polyline2d([], dxfattribs={"layer": LAYER, "flags": 4})
    drawn.append_vertices(vertices(1.2 * curve[::3]), dxfattribs={"flags": 16})
    drawn.append_vertices(vertices(curve), dxfattribs={"flags": 8})
    return document


def polyline_with_arcs(curve: Curve) -> Drawing:
    """Bent between the points as the curve is, an arc about the cam centre in the dwell."""
    document = origin(new(), 0j)
    bulges = issued(NAME)[1].keys["pitch"].expected.bulge.tolist()
    bent = [(x, y, bulge) for (x, y), bulge in zip(vertices(curve), bulges, strict=True)]
    assert max(map(abs, bulges)) > 0.05
    document.modelspace().add_polyline2d(bent, format="xyb", dxfattribs={"layer": LAYER})
    return document


def of_release_12(curve: Curve) -> Drawing:
    """Without a unit, without light polylines."""
    document = origin(ezdxf.new("R12"), 0j)
    document.modelspace().add_polyline2d(vertices(curve), dxfattribs={"layer": LAYER})
    return document


def from_below(curve: Curve) -> Drawing:
    """Drawn in a plane that looks down: x to the left."""
    document = origin(new(), 0j)
    below = {"layer": LAYER, "extrusion": (0, 0, -1)}
    document.modelspace().add_lwpolyline(vertices(-curve.conj()), dxfattribs=below)
    return document


def circle_for_the_origin(curve: Curve) -> Drawing:
    document = polyline(new(), curve + AWAY)
    document.modelspace().add_circle((AWAY.real, AWAY.imag), 1.5, dxfattribs={"layer": "Origin "})
    return document


def nested_block(curve: Curve) -> Drawing:
    """The curve at half size in a block on layer 0, in another block that is turned, inserted at its full size."""
    document = origin(new(), 0j)
    inner, outer = document.blocks.new("CAM"), document.blocks.new("ASSEMBLY")
    inner.add_lwpolyline(vertices((curve - 5) * -1j / 2))
    outer.add_blockref("CAM", (2.5, 0), dxfattribs={"rotation": 90})
    place = {"layer": LAYER, "xscale": 2, "yscale": 2}
    document.modelspace().add_blockref("ASSEMBLY", (0, 0), dxfattribs=place)
    return document


def mirrored_block(curve: Curve) -> Drawing:
    document = origin(new(), 0j)
    document.blocks.new("CAM").add_lwpolyline(vertices(-curve.conj()), dxfattribs={"layer": LAYER})
    document.modelspace().add_blockref("CAM", (0, 0), dxfattribs={"xscale": -1})
    return document


def edited(curve: Curve) -> Drawing:
    """Written, read, moved with its origin, written as an older version, read again."""
    document = again(lines(curve), "asc")
    for entity in document.modelspace():
        entity.translate(30, -20, 0)
    document.dxfversion = "R2000"
    return again(document, "asc")


def beside_words(curve: Curve) -> Drawing:
    document = origin(polyline(new(), curve), 0j)
    document.modelspace().add_text("pitch curve", dxfattribs={"layer": LAYER})
    document.modelspace().add_circle((0, 0), 20, dxfattribs={"layer": "BASE"})
    return document


UNDERSTOOD: dict[str, Callable[[Curve], Drawing]] = {
    "millimetres": lambda curve: origin(polyline(new(), curve), 0j),
    "no unit": lambda curve: origin(polyline(new(0), curve), 0j),
    "inches": lambda curve: origin(polyline(new(1), curve / 25.4), 0j),
    "metres": lambda curve: origin(polyline(new(6), curve / 1000), 0j),
    "a moved origin": lambda curve: origin(polyline(new(), curve + AWAY), AWAY),
    "a moved origin in inches": lambda curve: origin(polyline(new(1), (curve + AWAY) / 25.4), AWAY / 25.4),
    "an origin for the layer alone": lambda curve: origin(
        origin(polyline(new(), curve + AWAY), AWAY, "PITCH-ORIGIN"), 0j),
    "a layer in small letters": lambda curve: origin(polyline(new(), curve, "pitch"), 0j),
    "a layer with a space at its end": lambda curve: origin(polyline(new(), curve, "Pitch "), 0j),
    "a polyline that a curve was fitted to": fitted_polyline,
    "a polyline of arcs": polyline_with_arcs,
    "release 12": of_release_12,
    "seen from below": from_below,
    "a circle for the origin": circle_for_the_origin,
    "lines in any order": lines,
    "a spline through the points": spline,
    "a spline of control points": spline_of_control_points,
    "a block in a block": nested_block,
    "a mirrored block": mirrored_block,
    "words beside it": beside_words,
    "edited and saved again": edited,
}  # fmt: skip


def scattered(count: int) -> Drawing:
    """Pieces that meet nowhere."""
    document = origin(new(), 0j)
    for k in range(count):
        document.modelspace().add_line((k % 100, k // 100), (k % 100 + 0.4, k // 100), dxfattribs={"layer": LAYER})
    return document


REFUSED: dict[str, tuple[Callable[[Curve], Drawing], str]] = {
    "a moved origin without a mark": (
        lambda curve: polyline(new(), curve + AWAY), "mark the origin of the paper by a POINT on the layer ORIGIN"),
    "a mark that is not the origin": (
        lambda curve: origin(polyline(new(), curve), AWAY), "check that it marks the origin of this drawing"),
    "two origins": (
        lambda curve: origin(origin(polyline(new(), curve), 0j), AWAY), "must hold one POINT, the origin, but holds 2"),
    "another layer": (
        lambda curve: polyline(new(), curve, "PROFILE"), "nothing on the layer PITCH; its layers are profile"),
    "inches that the drawing does not tell": (
        lambda curve: polyline(new(4), curve / 25.4), "set the unit of the drawing ($INSUNITS) to mm"),
    "inches for millimetres": (
        lambda curve: polyline(new(1), curve), "set the unit of the drawing ($INSUNITS) to mm"),
    "miles": (lambda curve: polyline(new(3), curve), "check the unit of the drawing"),
    "no length for a unit": (lambda curve: polyline(new(99), curve), "set it to mm"),
    "points for a curve": (lambda curve: origin(new(), curve[0], LAYER), "there is no curve on the layer PITCH"),
    "five hundred pieces": (lambda curve: scattered(500), "holds 500 separate curves instead of one"),
    "five thousand pieces": (lambda curve: scattered(5001), "join them to one polyline"),
    "two curves": (
        lambda curve: polyline(polyline(new(), curve[:12]), curve[14:]), "2 separate curves instead of one"),
}  # fmt: skip


def data_of(document: Drawing, form: str) -> bytes:
    if form == "bin":
        stream = io.BytesIO()
        document.write(stream, fmt="bin")
        return stream.getvalue()
    text = io.StringIO()
    document.write(text)
    return document.encode(text.getvalue())


def again(document: Drawing, form: str) -> Drawing:
    return recover.read(io.BytesIO(data_of(document, form)))[0]


def handed_in(files: dict[str, bytes]) -> Record:
    exercise, answer_key = issued(NAME)
    return grade(Assignment(exercise, SECRET), Submission("Anna", "Anna", files, (), answer_key.to_json())).record


def numbers(values: dict[str, Any]) -> bytes:
    return "".join(f"{name} = {value!r}\n" for name, value in values.items() if isinstance(value, float)).encode()


def pitch_of(record: Record) -> MarkedAnswer:
    return next(answer for answer in record.answers if answer.name == "pitch")


def hands() -> dict[str, dict[str, Any]]:
    """All answers of a student with a careful hand, and of one who took the offset to the other side."""
    exercise, answer_key = issued(NAME)
    right = key(answer_key)
    names = [asked.name for asked in exercise.answers]
    wrong = {name: expected.value for name, expected in
             zip(names, answer_key.hypotheses["offset-sign"], strict=True)}  # fmt: skip
    return {"careful": right | {"pitch": right["pitch"] + (0.25 - 0.2j)}, "offset-sign": wrong}


@pytest.mark.parametrize(("form", "hand"), [("asc", "careful"), ("bin", "offset-sign")])
@pytest.mark.parametrize("case", UNDERSTOOD)
def test_a_drawing_earns_what_its_points_earn(case: str, form: str, hand: str):
    values = hands()[hand]
    pairs = [list(pair) for pair in vertices(values["pitch"])]
    as_text = handed_in({"answers.toml": numbers(values) + f"pitch = {pairs}".encode()})
    drawing = data_of(UNDERSTOOD[case](values["pitch"]), form)
    as_drawing = handed_in({"answers.toml": numbers(values), "answers.dxf": drawing})
    assert [(one.name, one.outcome, one.marks) for one in as_drawing.answers] == [
        (one.name, one.outcome, one.marks) for one in as_text.answers
    ]
    assert pitch_of(as_text).outcome == ("right" if hand == "careful" else "follow-through")
    found = as_drawing.diagnosis.misconception if as_drawing.diagnosis else "careful"
    assert found == hand
    assert as_drawing.notes == as_text.notes == ()
    # A spline bends between the points, which the same points joined by lines do not.
    bend = 0.5 if "spline" in case or "arcs" in case else 1e-4
    assert pitch_of(as_drawing).deviation == pytest.approx(pitch_of(as_text).deviation, abs=bend)


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_understood_says_what_to_do(case: str):
    values = hands()["careful"]
    build, remedy = REFUSED[case]
    record = handed_in({"answers.toml": numbers(values), "answers.dxf": data_of(build(values["pitch"]), "asc")})
    # The drawing alone is lost, and the student hears what to change.
    assert pitch_of(record).outcome in ("unreadable", "missing")
    assert record.total == record.of - pitch_of(record).of
    assert remedy in " ".join([*record.feedback, *record.notes])


def test_an_origin_that_is_not_marked_is_the_zero_of_the_drawing_and_noted():
    values = hands()["careful"]
    record = handed_in({"answers.dxf": data_of(polyline(new(), values["pitch"]), "asc")})
    assert pitch_of(record).outcome == "right"
    assert any("marks no origin" in note for note in record.notes)


def test_a_curve_displaced_by_less_is_wrong_where_it_is_farthest_off():
    """The check of the place does not hide an error of the drawing: 5 mm to the right are 5 mm off."""
    values = hands()["careful"]
    record = handed_in({"answers.dxf": data_of(origin(polyline(new(), key(issued(NAME)[1])["pitch"] + 5), 0j), "asc")})
    pitch = pitch_of(record)
    assert pitch.outcome == "wrong"
    assert pitch.off_paper == pytest.approx(5.0, abs=0.5)
    assert pitch.station is not None
    spot = values["pitch"][pitch.station]
    # Farthest off where the curve stands across the displacement.
    assert abs(spot.real) > 2 * abs(spot.imag)


def test_the_folder_is_read_as_the_command_reads_it(tmp_path: Path):
    exercise, answer_key = issued(NAME)
    (tmp_path / "answers.dxf").write_bytes(data_of(UNDERSTOOD["inches"](key(answer_key)["pitch"]), "bin"))
    record = grade(Assignment(exercise, SECRET), read_submission("Anna", tmp_path, answer_key.to_json())).record
    assert pitch_of(record).marks == pitch_of(record).of
