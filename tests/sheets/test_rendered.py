"""Every renderer draws every entity where it is, as wide as its role says, on the first page and on the second."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.document import Drawing as Document
from matplotlib.backend_bases import RendererBase
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath
from scene import drawing

from graphcam.drafting.marks import Role
from graphcam.sheets import sampling
from graphcam.sheets.cad_renderer import write_cad
from graphcam.sheets.dxf_renderer import write_dxf, write_spline
from graphcam.sheets.matplotlib_renderer import _figure, draw_on, write_png
from graphcam.sheets.model import (
    Angle,
    ArcEntity,
    Box,
    Circles,
    Curve,
    Drawing,
    Entity,
    Group,
    Heads,
    Length,
    Page,
    Stroke,
    Strokes,
    Text,
)
from graphcam.sheets.player import group_svg, roles_css
from graphcam.sheets.smooth_curves import bezier
from graphcam.sheets.styles import ACCENT, BLACK, CENTER, DASHED, GREY, STYLES_BY_ROLE
from graphcam.sheets.svg_renderer import svg
from graphcam.sheets.text_measures import letters_of, points_size, width
from graphcam.sheets.typefaces import lettering_file

POINT = 72 / 25.4
OVAL = 60 * np.cos(t := 2 * np.pi * np.arange(60) / 60) + 40j * np.sin(t) + 100 + 80j
ENTITIES: dict[str, Entity] = {
    "lines": Strokes(np.array([10 + 20j, 30j]), np.array([50 + 60j, 40 + 30j]), Role.CONSTRUCTION),
    "line": Stroke(np.array([10, 40 + 10j, 60]) + 5j, Role.AXIS),
    "closed": Stroke(np.array([10, 40 + 10j, 60 + 40j]) + 5j, Role.HIDDEN, closed=True),
    "curve": Curve(OVAL, Role.RESULT),
    "circles": Circles(np.array([100 + 50j, 150 + 60j]), 12.0, Role.CURVE),
    "dots": Circles(np.array([100 + 50j, 150 + 60j]), 0.75, Role.CURVE, opaque=True),
    "arc": ArcEntity(80 + 90j, 30.0, 0.4, 2.9, Role.LIMIT),
    "heads": Heads(np.array([[10, 14 + 1j, 14 - 1j], [30 + 9j, 34 + 10j, 34 + 8j]]) + 20j, Role.DIMENSION),
}
TEXTS = [
    Text(100 + 50j, "left", 3.5),
    Text(100 + 60j, "middle", 5.0, "center"),
    Text(100 + 70j, "right", 2.5, "right"),
    Text(60 + 70j, "turned", 3.5, "center", 0.6),
]
PAGE = Page(210.0, 148.0, Box(20, 5, 205, 143), (Group("step-01 a", (*ENTITIES.values(), *TEXTS)),))


def linework(starts: np.ndarray, ends: np.ndarray) -> shapely.MultiLineString:
    return shapely.MultiLineString([((a.real, a.imag), (b.real, b.imag)) for a, b in zip(starts, ends, strict=True)])


def of(entity: Entity) -> shapely.MultiLineString:
    """What the entity draws, in straight pieces; a curve as its cubic pieces go."""
    if isinstance(entity, Curve):
        return polyline(cubic(bezier(entity.points)))
    return linework(*sampling.pieces(entity))


def polyline(points: np.ndarray) -> shapely.MultiLineString:
    return linework(points[:-1], points[1:])


def cubic(control: np.ndarray, parts: int = 12) -> np.ndarray:
    """Points on a chain of cubic pieces."""
    u = np.linspace(0, 1, parts, endpoint=False)[:, None]
    a, b, c, d = (control[k::3][: (len(control) - 1) // 3] for k in range(4))
    return np.append(
        ((1 - u) ** 3 * a + 3 * u * (1 - u) ** 2 * b + 3 * u * u * (1 - u) * c + u**3 * d).T.ravel(), d[-1]
    )


def xy(point: Any) -> tuple[float, float]:
    return point[0], point[1]


def alike(one: shapely.Geometry, other: shapely.Geometry, tolerance: float = 0.03) -> bool:
    return one.hausdorff_distance(other) < tolerance and one.length == pytest.approx(other.length, rel=tolerance / 10)


class Recorder(RendererBase):
    """Keeps what it is told to draw."""

    def __init__(self, dpi: float = 100.0, upside_down: bool = False, size: tuple[float, float] = (0, 0)) -> None:
        super().__init__()
        self.dpi, self.upside_down, self.size = dpi, upside_down, size
        self.paths: list[dict[str, Any]] = []
        self.texts: list[tuple[str, complex, float, float, str]] = []

    def flipy(self):
        return self.upside_down

    def get_canvas_width_height(self):
        return self.size

    def draw_path(self, gc, path, transform, rgbFace=None):
        (_, dashes), clip = gc.get_dashes(), gc.get_clip_rectangle()
        drawn = [p[:, 0] + 1j * p[:, 1] for p in transform.transform_path(path).to_polygons(closed_only=False)]
        self.paths.append(
            {
                "points": drawn,
                "width": gc.get_linewidth(),
                "colour": to_hex(gc.get_rgb()),
                "dashes": None if dashes is None else list(dashes),
                "fill": None if rgbFace is None else to_hex(rgbFace),
                "join": gc.get_joinstyle(),
                "cap": gc.get_capstyle(),
                "snap": gc.get_snap(),
                "simplified": path.should_simplify,
                "clip": None if clip is None else clip.bounds,
            }
        )

    def draw_text(self, gc, x, y, s, prop, angle, ismath=False, mtext=None):
        self.texts.append((s, complex(x, y), prop.get_size_in_points(), angle, to_hex(gc.get_rgb())))


def recorded(page: Page, **how: Any) -> Recorder:
    recorder = Recorder(**how)
    _figure(page).draw(recorder)
    # The paper itself comes first.
    recorder.paths = recorder.paths[1:]
    return recorder


@pytest.mark.parametrize("name", ENTITIES)
def test_matplotlib_draws_an_entity_where_it_is_as_its_role_looks(name):
    entity, style = ENTITIES[name], STYLES_BY_ROLE[ENTITIES[name].role]
    found = recorded(Page(210.0, 148.0, PAGE.frame, (Group("step-07 a", (entity,)),)))
    ((drawn),) = found.paths
    lines = [points * 25.4 / 100 for points in drawn["points"]]
    there = linework(np.concatenate([p[:-1] for p in lines]), np.concatenate([p[1:] for p in lines]))
    assert alike(there, of(entity), 0.1)
    filled = name == "heads"
    assert drawn["width"] == pytest.approx(0.0 if filled else style.width * POINT)
    assert drawn["colour"] == style.colour
    assert drawn["dashes"] == (pytest.approx([mm * POINT for mm in style.pattern]) if style.pattern else None)
    assert drawn["fill"] == {"heads": style.colour, "dots": "#ffffff"}.get(name)
    assert (drawn["join"], drawn["cap"]) == ("miter" if filled else "round", "butt")
    # Neither moved to whole dots nor thinned out.
    assert (drawn["snap"], drawn["simplified"], drawn["clip"]) == (False, False, None)


@pytest.mark.parametrize("upside_down", [False, True])
def test_matplotlib_sets_texts_by_the_left_end_of_their_base_line(upside_down):
    found = recorded(PAGE, upside_down=upside_down, size=(900.0, 700.0))
    assert len(found.texts) == 4
    for text, (said, at, size, angle, colour) in zip(TEXTS, found.texts, strict=True):
        share = {"left": 0.0, "center": 0.5, "right": 1.0}[text.align]
        begins = (text.at - share * width(text.text, text.height) * np.exp(1j * text.angle)) / 25.4 * 100
        assert at == pytest.approx(complex(begins.real, 700.0 - begins.imag) if upside_down else begins)
        assert (said, size, colour) == (text.text, pytest.approx(points_size(text.height)), BLACK)
        assert angle == pytest.approx(math.degrees(text.angle))


def test_neighbours_of_one_role_are_one_path_and_later_ones_lie_above():
    group = (ENTITIES["lines"], ENTITIES["lines"], ENTITIES["heads"], ENTITIES["lines"])
    found = recorded(Page(210.0, 148.0, PAGE.frame, (Group("a", group), Group("b", group[:1]))))
    assert [len(path["points"]) for path in found.paths] == [4, 2, 2, 2]


@pytest.mark.parametrize(("origin", "factor"), [(0j, 1.0), (30 + 20j, 2.0)])
def test_a_page_on_axes_grows_and_shrinks_with_them(origin, factor):
    page = Page(200.0, 100.0, Box(0, 0, 200, 100), (Group("a", (ENTITIES["lines"], ENTITIES["line"], TEXTS[3])),))
    figure = Figure(figsize=(10, 6), dpi=80)
    axes = figure.add_axes((0.1, 0.2, 0.5, 0.5))
    draw_on(axes, page, origin, factor)
    axes.apply_aspect()
    assert axes.get_xlim() == (pytest.approx(-origin.real / factor), pytest.approx((200 - origin.real) / factor))
    assert axes.get_ylim() == (pytest.approx(-origin.imag / factor), pytest.approx((100 - origin.imag) / factor))
    assert axes.get_aspect() == 1.0
    recorder = Recorder(dpi=80)
    for artist in axes.artists:
        artist.draw(recorder)
    # 5 inches for 200 mm.
    times = 5 * 25.4 / 200
    lines, line = recorder.paths
    assert lines["width"] == pytest.approx(times * 0.25 * POINT)
    assert line["dashes"] == pytest.approx([times * mm * POINT for mm in CENTER])
    assert lines["clip"] == axes.bbox.bounds
    dots = times / 25.4 * 80
    corner = complex(*axes.transData.transform((-origin.real / factor, -origin.imag / factor)))
    starts = [points[0] for points in lines["points"]]
    np.testing.assert_allclose((np.array(starts) - corner) / dots, ENTITIES["lines"].starts, atol=1e-9)
    ((_, at, size, angle, _),) = recorder.texts
    assert size == pytest.approx(points_size(times * 3.5))
    assert angle == pytest.approx(math.degrees(0.6))
    begins = TEXTS[3].at - width("turned", 3.5) / 2 * np.exp(0.6j)
    assert (at - corner) / dots == pytest.approx(begins)


def test_a_page_beside_a_plot_asks_for_no_room_of_its_own():
    figure = Figure(figsize=(4, 3), layout="constrained")
    axes = figure.add_subplot()
    draw_on(axes, PAGE)
    assert not any(artist.get_in_layout() for artist in axes.artists)


def test_a_picture_has_a_hundred_dots_an_inch_unless_it_is_said(tmp_path):
    write_png(PAGE, tmp_path / "page.png")
    head = (tmp_path / "page.png").read_bytes()[16:24]
    size = int.from_bytes(head[:4]), int.from_bytes(head[4:])
    assert np.allclose(size, np.array([210, 148]) / 25.4 * 100, atol=1)


@pytest.mark.parametrize("name", ENTITIES)
def test_an_svg_of_its_own_has_the_looks_of_the_role_as_attributes(name):
    entity, style = ENTITIES[name], STYLES_BY_ROLE[ENTITIES[name].role]
    root = ET.fromstring(svg(Page(210.0, 148.0, PAGE.frame, (Group("step-07 a", (entity,)),))))
    (group,) = root.findall("{*}g")
    (drawn,) = group
    assert group.get("id") == "step-07"
    (inside,) = ET.fromstring(f"<g>{group_svg(Group('a', (entity,)), 148.0)}</g>")
    assert drawn.get("d") == inside.get("d")
    filled = name == "heads"
    assert drawn.get("fill") == {"heads": style.colour, "dots": "#ffffff"}.get(name, "none")
    assert drawn.get("stroke") == (None if filled else style.colour)
    assert float(drawn.get("stroke-width", 0)) == (0 if filled else style.width)
    dashes = " ".join(f"{mm:g}" for mm in style.pattern)
    assert drawn.get("stroke-dasharray", "") == dashes
    assert drawn.get("class") is None


def test_an_svg_bears_the_size_of_its_own_page():
    root = ET.fromstring(svg(PAGE))
    assert (root.get("width"), root.get("height")) == ("210mm", "148mm")


TWO = Drawing("Two", (PAGE, Page(105.0, 148.0, Box(20, 5, 100, 143), PAGE.groups), PAGE))
LEFT = {"p1": 0.0, "p2": 250.0, "p3": 395.0}
"""Where the pages begin: 40 mm lie between them."""


@pytest.fixture(scope="module")
def plain(tmp_path_factory) -> Document:
    path = tmp_path_factory.mktemp("dxf") / "two.dxf"
    write_dxf(TWO, path)
    return ezdxf.readfile(path)


def lines_of(entity: Any) -> np.ndarray:
    """Points along an entity of a DXF file."""
    match entity.dxftype():
        case "LINE":
            return np.array([complex(*xy(entity.dxf.start)), complex(*xy(entity.dxf.end))])
        case "LWPOLYLINE":
            points = np.array([complex(*point) for point in entity.get_points("xy")])
            return np.append(points, points[0]) if entity.closed else points
        case "CIRCLE" | "ARC" | "SPLINE":
            return np.array([complex(*xy(point)) for point in entity.flattening(0.002)])
        case "SPLINE":
            return np.array([complex(*xy(point)) for point in entity.flattening(0.002)])
        case _:
            corners = [entity.dxf.get(f"vtx{k}") for k in range(3)]
            return np.array([complex(*xy(point)) for point in (*corners, corners[0])])


@pytest.mark.parametrize("page", LEFT)
@pytest.mark.parametrize("name", ENTITIES)
def test_dxf_holds_every_entity_where_it_is_on_every_page(plain, page, name):
    entity = ENTITIES[name]
    layer = f"{page}-step-01-a-{entity.role}"
    found = [lines_of(e) - LEFT[page] for e in plain.modelspace().query(f'*[layer=="{layer}"]')]
    whole = [e for e in ENTITIES.values() if e.role == entity.role]
    there = linework(np.concatenate([p[:-1] for p in found]), np.concatenate([p[1:] for p in found]))
    assert alike(there, shapely.union_all([of(e) for e in whole]), 0.03)
    assert there.length == pytest.approx(sum(of(e).length for e in whole), rel=2e-3)


@pytest.mark.parametrize("page", LEFT)
def test_dxf_sets_every_text_at_its_place(plain, page):
    found = {t.dxf.text: t for t in plain.modelspace().query(f'TEXT[layer=="{page}-step-01-a-text"]')}
    assert len(found) == 4
    for text in TEXTS:
        entity = found[text.text]
        start, end = outline_ends(text)
        assert complex(*xy(entity.dxf.insert)) == pytest.approx(start + LEFT[page], abs=1e-3)
        assert complex(*xy(entity.dxf.align_point)) == pytest.approx(end + LEFT[page], abs=1e-3)
        # Whatever font a program has, its letters are as wide as ours.
        assert entity.dxf.halign == 5
        assert (entity.dxf.height, entity.dxf.rotation) == (text.height, pytest.approx(math.degrees(text.angle)))


def outline_ends(text: Text) -> tuple[complex, complex]:
    """Where the outlines of a text begin and end on its base line."""
    font = FontProperties(fname=lettering_file(), size=points_size(text.height))
    box = TextPath((0, 0), text.text, prop=font).get_extents()
    shift = {"left": 0.0, "center": 0.5, "right": 1.0}[text.align] * width(text.text, text.height)
    return tuple(text.at + (end - shift) * np.exp(1j * text.angle) for end in (box.x0 / POINT, box.x1 / POINT))


def test_dxf_layers_show_colour_width_and_line_type_of_their_role(plain):
    for entity in ENTITIES.values():
        layer, style = plain.layers.get(f"p1-step-01-a-{entity.role}"), STYLES_BY_ROLE[entity.role]
        assert layer.dxf.lineweight == 100 * style.width
        assert layer.dxf.color == {BLACK: 7, GREY: 8, ACCENT: 1}[style.colour]
        assert layer.dxf.linetype == {CENTER: "CENTER", DASHED: "DASHED", (): "CONTINUOUS"}[style.pattern]
    for name, pattern in (("CENTER", CENTER), ("DASHED", DASHED)):
        (total,) = (tag.value for tag in plain.linetypes.get(name).pattern_tags.tags if tag.code == 40)
        assert total == pytest.approx(sum(pattern))
        assert [abs(x) for x in plain.linetypes.get(name).simplified_line_pattern()] == pytest.approx(list(pattern))
        drawn = [tag.value for tag in plain.linetypes.get(name).pattern_tags.tags if tag.code == 49]
        assert drawn == pytest.approx([mm if k % 2 == 0 else -mm for k, mm in enumerate(pattern)])


def test_dxf_opens_on_the_whole_sheet_in_millimetres(plain):
    wide = 395.0 + 210.0
    header = plain.header
    assert [header[name] for name in ("$MEASUREMENT", "$LTSCALE", "$LWDISPLAY", "$PSVPSCALE")] == [1, 1.0, 1, 1.0]
    assert (tuple(header["$EXTMIN"]), tuple(header["$EXTMAX"])) == ((0, 0, 0), (wide, 148, 0))
    assert (xy(header["$LIMMIN"]), xy(header["$LIMMAX"])) == ((0, 0), (wide, 148))
    (window,) = plain.viewports.get("*Active")
    assert (window.dxf.height, xy(window.dxf.center)) == (148, (wide / 2, 74))
    paper = plain.paperspace().dxf
    assert (paper.paper_width, paper.paper_height) == (210, 148)
    assert [paper.get(f"{side}_margin") for side in ("left", "right", "top", "bottom")] == [0, 0, 0, 0]
    assert header["$DIMTXSTY"] == plain.modelspace().query("TEXT").first.dxf.style


def test_dxf_marks_the_origins_of_views_and_has_layers_to_draw_on(tmp_path):
    pages = PAGE, Page(105.0, 148.0, PAGE.frame, (), {"profile": 30 + 40j})
    write_dxf(Drawing("", pages), tmp_path / "a.dxf", {"ORIGIN": "profile", "NONE": "other"}, ["PITCH"])
    document = ezdxf.readfile(tmp_path / "a.dxf")
    (point,) = document.modelspace().query("POINT")
    assert (xy(point.dxf.location), point.dxf.layer) == ((280, 40), "ORIGIN")
    assert document.layers.get("ORIGIN").dxf.color == 1
    assert "PITCH" in document.layers
    assert "NONE" not in document.layers
    assert (document.header["$PDMODE"], document.header["$PDSIZE"]) == (34, 3.0)
    write_dxf(Drawing("", pages), tmp_path / "b.dxf")
    assert not ezdxf.readfile(tmp_path / "b.dxf").modelspace().query("POINT")


def test_a_spline_alone_fills_the_window(tmp_path):
    control = np.array([[10.0, 5.0], [20, 40], [60, 45], [50, 15]])
    write_spline(control, np.array([0.0] * 4 + [1.0] * 4), tmp_path / "a.dxf", "CAM", {"made by": "hand"})
    document = ezdxf.readfile(tmp_path / "a.dxf")
    (spline,) = document.modelspace()
    assert [xy(point) for point in spline.control_points] == [tuple(point) for point in control]
    assert (list(spline.knots), spline.dxf.degree, spline.dxf.layer) == ([0.0] * 4 + [1.0] * 4, 3, "CAM")
    assert (tuple(document.header["$EXTMIN"]), tuple(document.header["$EXTMAX"])) == ((10, 5, 0), (60, 45, 0))
    (window,) = document.viewports.get("*Active")
    # A tenth more than its height, about its middle.
    assert (window.dxf.height, xy(window.dxf.center)) == (pytest.approx(44), (35, 25))
    assert document.header["$MEASUREMENT"] == 1


START, END, FOOT = 20 + 30j, 50 + 70j, 20 + 30j + 10 * (-0.8 + 0.6j)
MEASURED = (
    Text(30 + 60j, "50", 3.5, "center", math.atan2(40, 30), of=Length(START, END, FOOT, ())),
    Text(90 + 60j, "40°", 2.5, "center", of=Angle(80 + 50j, 20.0, 0.2, 0.9, ())),
    Text(90 + 90j, "180°", 2.5, "center", of=Angle(80 + 50j, 30.0, 0.0, math.pi, ())),
)


@pytest.fixture(scope="module")
def cad(tmp_path_factory) -> Document:
    path = tmp_path_factory.mktemp("cad") / "two.dxf"
    frame = Group("frame", (ENTITIES["lines"], Text(100 + 10j, "Anna", 3.5, "center", field="author")))
    page = Page(210.0, 148.0, PAGE.frame, (frame, Group("step-01 a", MEASURED)))
    write_cad(Drawing("", (page, page)), path)
    return ezdxf.readfile(path)


@pytest.mark.parametrize(("page", "left"), [("p1", 0.0), ("p2", 250.0)])
def test_cad_dimensions_stand_where_they_are_drawn(cad, page, left):
    length, angle = cad.modelspace().query(f'DIMENSION[layer=="{page}-step-01-a-text"]')
    assert length.dxf.angle == pytest.approx(math.degrees(math.atan2(40, 30)))
    for name, at in (("defpoint2", START), ("defpoint3", END)):
        assert complex(*xy(length.dxf.get(name))) == pytest.approx(at + left)
    # The dimension line runs through the foot.
    line = complex(*xy(length.dxf.defpoint)) - FOOT - left
    assert abs((line / (END - START)).imag) < 1e-9
    assert length.get_measurement() == pytest.approx(50)
    # ezdxf measures an angle the other way round than it draws it.
    assert 360 - angle.get_measurement() == pytest.approx(math.degrees(0.7))
    ends = [complex(*xy(angle.dxf.get(f"defpoint{k}"))) - left - (80 + 50j) for k in ("2", "3", "")]
    assert ends[0] == pytest.approx(0)
    arc = complex(*xy(angle.dxf.defpoint5)) - left - (80 + 50j)
    assert (abs(arc), np.angle(arc)) == (pytest.approx(20), pytest.approx(0.55))
    for dimension, text in ((length, MEASURED[0]), (angle, MEASURED[1])):
        # In the middle of its letters, which stand over the middle of the base line.
        middle = text.at + 1j * np.exp(1j * text.angle) * text.height / 2 + left
        assert complex(*xy(dimension.dxf.text_midpoint)) == pytest.approx(middle)
        assert dimension.dxf.text_rotation == pytest.approx(math.degrees(text.angle))
        assert dimension.override().get("dimtxt") == text.height
        # The text of an angle stands over it.
        assert (dimension.dxf.text, dimension.dxf.dimstyle) == (text.text if dimension is length else " ", "GRAPHCAM")


def test_half_a_turn_is_no_dimension_between_two_lines(cad):
    assert {d.dxf.text for d in cad.modelspace().query("DIMENSION")} == {"50", " "}
    assert {t.dxf.text for t in cad.modelspace().query('TEXT[layer=="p1-step-01-a-text"]')} == {"180°", "40°"}


def test_cad_dimensions_look_as_on_the_sheet(cad):
    style = cad.dimstyles.get("GRAPHCAM").dxf
    found = {
        name: style.get(name) for name in ("dimasz", "dimexo", "dimexe", "dimgap", "dimscale", "dimlfac", "dimtad")
    }
    assert found == {
        "dimasz": 3.5, "dimexo": 1.0, "dimexe": 2.0, "dimgap": 0.8, "dimscale": 1.0, "dimlfac": 1.0, "dimtad": 1,
    }  # fmt: skip


def test_cad_frames_are_blocks_whose_entries_stand_on_their_page(cad):
    first, second = cad.modelspace().query("INSERT")
    assert (xy(first.dxf.insert), xy(second.dxf.insert)) == ((0, 0), (250, 0))
    assert (first.dxf.name, second.dxf.name) == ("p1-FRAME", "p2-FRAME")
    for placed, left in ((first, 0.0), (second, 250.0)):
        (entry,) = placed.attribs
        assert (entry.dxf.tag, entry.dxf.text, entry.dxf.height) == ("AUTHOR", "Anna", 3.5)
        assert complex(*xy(entry.dxf.align_point)) == pytest.approx(100 + 10j + left)
        assert len(cad.blocks.get(placed.dxf.name).query("LINE")) == 2


def test_cad_layouts_show_one_page_each(cad):
    for k, left in ((1, 0.0), (2, 250.0)):
        layout = cad.paperspace(f"Sheet {k}")
        paper, window = layout.dxf, layout.query("VIEWPORT").last.dxf
        assert (paper.paper_width, paper.paper_height) == (210, 148)
        assert [paper.get(f"{side}_margin") for side in ("left", "right", "top", "bottom")] == [0, 0, 0, 0]
        assert (xy(window.center), window.width, window.height) == ((105, 74), 210, 148)
        assert (xy(window.view_center_point), window.view_height) == ((left + 105, 74), 148)


def test_entries_in_several_lines_are_numbered(tmp_path):
    texts = [Text(10 + 1j * k, word, 3.5, field="name") for k, word in enumerate(("a", "b", "c"))]
    page = Page(210.0, 148.0, PAGE.frame, (Group("frame", tuple(texts)),))
    write_cad(Drawing("", (page,)), tmp_path / "a.dxf")
    (placed,) = ezdxf.readfile(tmp_path / "a.dxf").modelspace().query("INSERT")
    assert [(a.dxf.tag, a.dxf.text) for a in placed.attribs] == [("NAME", "a"), ("NAME_2", "b"), ("NAME_3", "c")]


def svg_paths(entity: Entity, height: float = 148.0) -> list[np.ndarray]:
    """The sub-paths of the player's SVG, arcs as shapely flattens them."""
    (path,) = ET.fromstring(f"<g>{group_svg(Group('a', (entity,)), height)}</g>")
    found = []
    for part in re.findall(r"M[^M]*", path.attrib["d"]):
        numbers = np.array(re.findall(r"-?[\d.]+", part), dtype=float)
        found.append(numbers)
    return found


def test_the_player_draws_whole_circles_and_arcs():
    for centre, numbers in zip((100 + 50j, 150 + 60j), svg_paths(ENTITIES["circles"]), strict=True):
        # From the left by half turns of its radius to the right and back.
        x, y, *halves = numbers
        assert (x, 148 - y) == (centre.real - 12, centre.imag)
        assert halves == [12, 12, 0, 1, 1, 24, 0, 12, 12, 0, 1, 1, -24, 0]
    ((*start, r1, r2, turn, large, sweep, x, y, _, _, _, _, sweep2, x2, y2),) = svg_paths(ENTITIES["arc"])
    assert (r1, r2, turn, large, sweep, sweep2) == (30, 30, 0, 0, 0, 0)
    points = np.array([complex(*start), complex(x, y), complex(x2, y2)])
    expected = 80 + 90j + 30 * np.exp(1j * np.array([0.4, 1.65, 2.9]))
    np.testing.assert_allclose(points.real + 1j * (148 - points.imag), expected, atol=0.01)


def test_the_player_sets_texts_at_their_size():
    texts = ET.fromstring(f"<g>{group_svg(Group('a', (*TEXTS, Text(0j, 'r', 2.0, role='former text'))), 148.0)}</g>")
    classes = ["text", "text middle", "text end", "text middle", "text former text"]
    assert [e.attrib["class"] for e in texts] == classes
    for text, element in zip(TEXTS, texts, strict=False):
        assert float(element.attrib["font-size"]) == pytest.approx(points_size(text.height) / POINT, abs=6e-4)
        assert (float(element.attrib["x"]), 148 - float(element.attrib["y"])) == (text.at.real, text.at.imag)
    assert [e.attrib.get("transform") for e in texts][:4] == [None, None, None, "rotate(-34.38 60 78)"]


def test_the_player_has_a_look_for_every_role():
    rules = dict(re.findall(r"^\.page \.([\w-]+)\{(.*)\}$", roles_css(), re.MULTILINE))
    assert set(rules) == {role for role in STYLES_BY_ROLE if " " not in role}
    assert rules[Role.AXIS] == f"--width:0.25px;--print:{GREY};stroke-dasharray:9 1.4 1 1.4;"
    assert rules[Role.RESULT] == f"--width:0.5px;--print:{BLACK};"


def test_the_whole_scene_is_on_the_same_places_in_dxf_and_model(tmp_path: Path):
    drawn = drawing("A4")
    write_dxf(drawn, tmp_path / "a.dxf")
    space = ezdxf.readfile(tmp_path / "a.dxf").modelspace()
    left = 0.0
    for number, page in enumerate(drawn.pages, 1):
        found = {t.dxf.text: t for t in space.query("TEXT") if t.dxf.layer.startswith(f"p{number}-tables")}
        for group in page.groups:
            for text in group.entities if group.key == "tables" else ():
                if isinstance(text, Text):
                    first, *_ = letters_of(text.text, text.height)
                    at = complex(*xy(found[first.text].dxf.insert))
                    assert at.imag == pytest.approx(text.at.imag)
                    if text.align == "left":
                        assert 0 <= at.real - left - text.at.real < 0.3 * text.height
        left += page.width + 40
