"""Filled polygons are the same in every file: tags and codes are read from prints of all of them."""

from __future__ import annotations

from pathlib import Path

import ezdxf
import numpy as np
import pytest
from hypothesis import given
from hypothesis.extra.numpy import arrays

from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.marked_paper import bar, cells, in_tiles, square
from graphcam.sheets.matplotlib_renderer import write_png
from graphcam.sheets.model import Box, Drawing, Group, Page, Polygons, Strokes, moved_entity
from graphcam.sheets.player_svg import group_svg
from graphcam.sheets.sampling import box_of
from graphcam.sheets.styles import LIGHT_ROLES
from graphcam.sheets.svg_renderer import svg

DARK = np.array([[1, 1, 0], [0, 1, 0], [1, 0, 1]], dtype=bool)
CODE = cells(DARK, 5 + 5j, 2.0)


def page(*entities: Polygons | Strokes, size: tuple[float, float] = (20.0, 15.0)) -> Page:
    return Page(*size, Box(0, 0, *size), (Group("code", entities),))


def area(corners: np.ndarray) -> float:
    """Of polygons, by their corners in order; one whose sides cross has less."""
    return float(np.sum(np.conj(corners) * np.roll(corners, -1, axis=1)).imag / 2)


@given(arrays(bool, (7, 7)).filter(np.any))
def test_all_dark_cells_are_filled_once(dark: np.ndarray):
    found = cells(dark, 1 + 2j, 0.5)
    assert area(found.corners) == pytest.approx(0.25 * dark.sum())
    middles = np.mean(found.corners, axis=1)
    rows = 6 - np.floor((middles.imag - 2) / 0.5).astype(int)
    assert all(dark[row].any() for row in rows)


def test_a_picture_shows_them(tmp_path: Path):
    cv2 = pytest.importorskip("cv2")
    write_png(page(CODE), tmp_path / "page.png", dpi=254)
    picture = cv2.imread(str(tmp_path / "page.png"), cv2.IMREAD_GRAYSCALE)
    # The middles of the cells, 10 pixels to a millimetre.
    seen = [
        [picture[150 - 50 - 20 * (2 - row) - 10, 50 + 20 * column + 10] < 128 for column in range(3)]
        for row in range(3)
    ]
    assert np.array_equal(seen, DARK)
    assert (picture < 128).mean() == pytest.approx(4 * DARK.sum() / 300, rel=0.01)


def test_the_solids_of_a_drawing_are_no_bow_ties(tmp_path: Path):
    write_dxf(Drawing("code", (page(CODE, square(12 + 2j, 3.0, LIGHT_ROLES["grey"])),)), tmp_path / "code.dxf")
    solids = ezdxf.readfile(tmp_path / "code.dxf").modelspace().query("SOLID")
    assert {solid.dxf.layer for solid in solids} == {"code-printed-code", "code-light-grey"}
    # In a SOLID the last two corners change places.
    outlines = [[complex(at.x, at.y) for at in solid.wcs_vertices()] for solid in solids]
    assert sum(area(np.array([outline])) for outline in outlines) == pytest.approx(4 * DARK.sum() + 9)


def test_a_page_and_the_player_have_them_as_paths():
    assert (
        group_svg(Group("code", (square(0j, 2.0, "frame"),)), 10.0)
        == '<path class="filled frame" d="M0 10L2 10L2 8L0 8Z"/>'
    )
    text = svg(page(square(12 + 2j, 3.0, LIGHT_ROLES["colour"])))
    assert '<path fill="#a6e3fa" d="M12 13L15 13L15 10L12 10Z"/>' in text


def test_a_bar_is_ruled():
    line, strokes = bar(1 + 2j, 31 + 2j)
    assert isinstance(line, Strokes)
    assert isinstance(strokes, Strokes)
    assert (line.ends - line.starts).tolist() == [30]
    assert strokes.starts.tolist() == [1 + 2j, 11 + 2j, 21 + 2j, 31 + 2j]
    assert np.abs(strokes.ends - strokes.starts).tolist() == [3.0, 1.5, 1.5, 3.0]


def test_tiles_show_what_lies_on_them():
    whole = page(CODE, moved_entity(CODE, 20.0), square(18 + 1j, 4.0, "frame"), size=(40.0, 15.0))
    left, right = in_tiles(Drawing("code", (whole,)), 20.0).pages
    assert (left.width, right.width) == (20.0, 20.0)
    assert [len(side.groups[0].entities) for side in (left, right)] == [2, 2]
    assert box_of(right.groups[0].entities[:1]) == box_of([CODE])
    assert box_of(right.groups[0].entities[1:]) == Box(-2.0, 1.0, 2.0, 5.0)
