"""The CAD variant: dimensions that measure, a title block that can be edited, layouts that show the sheet 1:1."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.addons.drawing import Frontend, RenderContext
from ezdxf.addons.drawing.config import BackgroundPolicy, ColorPolicy, Configuration
from ezdxf.addons.drawing.matplotlib import MatplotlibBackend
from ezdxf.document import Drawing as Document
from ezdxf.entities import Dimension
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from over_all import fast_first
from scene import TITLE, drawing
from scipy.ndimage import binary_dilation

from graphcam.drafting.ink import Part, Step, View, say
from graphcam.drafting.marks import AngleMark
from graphcam.sheets.cad_renderer import write_cad
from graphcam.sheets.dxf_renderer import write_dxf
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Angle, Drawing, Length, Text


@pytest.fixture
def document(tmp_path: Path) -> Document:
    write_cad(drawing(), tmp_path / "sheet.dxf")
    return ezdxf.readfile(tmp_path / "sheet.dxf")


def texts(drawn: Drawing) -> list[Text]:
    return [e for page in drawn.pages for group in page.groups for e in group.entities if isinstance(e, Text)]


def test_audit_is_clean(document: Document) -> None:
    auditor = document.audit()
    assert (len(auditor.errors), len(auditor.fixes)) == (0, 0)


def test_every_dimension_measures_what_is_drawn(document: Document) -> None:
    """Lengths in mm of paper, angles in degrees; the text is the drawing's own, because scales differ.

    The text of an angle, and one with an index, stands beside it: not every reader would set it there.
    """
    expected = []
    for text in texts(drawing()):
        match text.of:
            case Length(start=start, end=end):
                expected.append((" " if re.search("[₀-₉]", text.text) else text.text, abs(end - start)))
            case Angle(start=start, end=end):
                expected.append((" ", np.degrees(end - start)))
            case None:
                pass
    found = [(d.dxf.text, measured(d)) for d in document.modelspace().query("DIMENSION")]
    assert [text for text, _ in found] == [text for text, _ in expected]
    assert [value for _, value in found] == pytest.approx([value for _, value in expected], abs=1e-9)
    assert "30°" in [text.dxf.text for text in document.modelspace().query("TEXT")]
    assert any(text != " " for text, _ in found)


def measured(dimension: Dimension) -> float:
    """What a dimension measures; ezdxf tells an angle the other way round than it draws it."""
    value = dimension.get_measurement()
    return 360 - value if dimension.dimtype == 2 else value


def test_an_angle_of_half_a_turn_and_more_stays_as_it_is_drawn(tmp_path: Path) -> None:
    """Two lines measure less than 180°: a DIMENSION would say what is left of the turn."""
    angles = AngleMark(0j, 20.0, 0.0, np.radians(200), "200°"), AngleMark(0j, 30.0, 0.0, np.radians(160), "160°")
    step = Step(say("Angles"), (Part(say("Two.")),), View("profile", say("Profile"), "x", "y"), angles)
    write_cad(compose([("angles", step)], [], TITLE), tmp_path / "angles.dxf")
    space = ezdxf.readfile(tmp_path / "angles.dxf").modelspace()
    assert [round(measured(d), 9) for d in space.query("DIMENSION")] == [160]
    assert {"160°", "200°"} <= {text.dxf.text for text in space.query("TEXT")}
    arcs = [arc for arc in space.query("ARC") if arc.dxf.radius == 20]
    assert [(arc.dxf.end_angle - arc.dxf.start_angle) % 360 for arc in arcs] == pytest.approx([200])


def test_no_line_of_a_dimension_is_drawn_twice(tmp_path: Path, document: Document) -> None:
    write_dxf(drawing(), tmp_path / "plain.dxf")
    plain = ezdxf.readfile(tmp_path / "plain.dxf").modelspace()

    def steps(space: object, kind: str) -> int:
        return len(space.query(f'{kind}[layer ? "step.*-dimension"]'))  # type: ignore[attr-defined]

    measured = [text.of for text in texts(drawing()) if text.of]
    triangles = sum(type(line).__name__ == "Heads" for of in measured for line in of.lines)
    assert steps(plain, "SOLID") - steps(document.modelspace(), "SOLID") == triangles == 2 * len(measured)


def test_title_block_has_attributes(document: Document) -> None:
    (block,) = document.modelspace().query("INSERT")
    entries = {attribute.dxf.tag: attribute.dxf.text for attribute in block.attribs}
    assert entries["AUTHOR"] == TITLE.author
    assert entries["ORGANISATION"] == TITLE.organisation
    assert entries["SCALE"] == TITLE.scale
    assert " ".join(text for tag, text in entries.items() if tag.startswith("NAME")) == TITLE.name
    # The number stands in its field and upside down in the corner.
    assert [text for tag, text in entries.items() if tag.startswith("NUMBER")] == [TITLE.number] * 2
    definitions = document.blocks.get(block.dxf.name).query("ATTDEF")
    assert {d.dxf.tag for d in definitions} == set(entries)
    # Their texts stand over the block, since some readers show no attribute.
    assert all(each.is_invisible for each in (*block.attribs, *definitions))
    shown = " ".join(text.dxf.text for text in document.modelspace().query('TEXT[layer == "frame-text"]'))
    assert all(word in shown for entry in entries.values() for word in entry.split())


def picture(file: Path) -> np.ndarray:
    """The ink (rows, columns) of a file as ezdxf's drawing add-on shows it, two pixels for a mm."""
    figure = Figure(figsize=(841 / 25.4, 594 / 25.4), dpi=50.8)
    axes = figure.add_axes((0, 0, 1, 1))
    document = ezdxf.readfile(file)
    shown = Configuration(background_policy=BackgroundPolicy.WHITE, color_policy=ColorPolicy.BLACK)
    backend = MatplotlibBackend(axes, adjust_figure=False)
    Frontend(RenderContext(document), backend, shown).draw_layout(document.modelspace(), finalize=False)
    axes.set(xlim=(0, 841), ylim=(0, 594), aspect="auto")
    axes.axis("off")
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., 0] < 200


@pytest.mark.parametrize("left_out", fast_first([None, 'TEXT[layer=="frame-text"]', "DIMENSION"]))
def test_the_add_on_shows_the_same_picture_of_both_variants(tmp_path: Path, left_out: str | None) -> None:
    """Ink within 2 mm of ink; without the texts of the title block, or without the dimensions, there is a gap."""
    write_dxf(drawing(), tmp_path / "plain.dxf")
    write_cad(drawing(), tmp_path / "cad.dxf")
    document = ezdxf.readfile(tmp_path / "cad.dxf")
    for entity in document.modelspace().query(left_out) if left_out else ():
        document.modelspace().delete_entity(entity)
    document.saveas(tmp_path / "cad.dxf")
    plain, cad = picture(tmp_path / "plain.dxf"), picture(tmp_path / "cad.dxf")
    assert plain.any()
    gaps = [one & ~binary_dilation(other, iterations=4) for one, other in ((plain, cad), (cad, plain))]
    assert gaps[0].any() == (left_out is not None)
    assert not gaps[1].any()


@pytest.mark.parametrize("paper", ["A1", "A3"])
def test_every_page_has_a_layout_that_shows_it_1_to_1(tmp_path: Path, paper: str) -> None:
    drawn = drawing(paper)
    write_cad(drawn, tmp_path / "sheet.dxf")
    document = ezdxf.readfile(tmp_path / "sheet.dxf")
    assert not document.audit().fixes
    names = document.layout_names_in_taborder()
    assert names == ["Model", *(f"Sheet {k}" for k in range(1, len(drawn.pages) + 1))]
    for name, page in zip(names[1:], drawn.pages, strict=True):
        layout = document.paperspace(name)
        assert (layout.dxf.paper_width, layout.dxf.paper_height) == (page.width, page.height)
        window = layout.query("VIEWPORT").last
        assert window.dxf.view_height == window.dxf.height == page.height
        assert window.dxf.width == page.width


def test_two_runs_write_the_same_bytes(tmp_path: Path) -> None:
    for run in ("first.dxf", "second.dxf"):
        write_cad(drawing("A4"), tmp_path / run)
    assert (tmp_path / "first.dxf").read_bytes() == (tmp_path / "second.dxf").read_bytes()


SEEDED = """
import sys
from pathlib import Path
import numpy as np
from scene import drawing
from graphcam.sheets.cad_renderer import write_cad
from graphcam.sheets.dxf_renderer import write_dxf, write_spline

place = Path(sys.argv[1])
write_dxf(drawing("A3"), place / "plain.dxf")
write_cad(drawing("A3"), place / "cad.dxf")
control = np.array([[0.0, 0], [1, 2], [3, 2], [4, 0]])
write_spline(control, np.repeat([0.0, 1], 4), place / "profile.dxf", "profile", {})
"""


@pytest.mark.slow
def test_another_process_writes_the_same_bytes_whatever_the_order_of_its_sets(tmp_path: Path) -> None:
    """Of these two seeds the sets of ezdxf have two orders."""
    written: list[dict[str, bytes]] = []
    for seed in (0, 4):
        place = tmp_path / str(seed)
        place.mkdir()
        environment = {**os.environ, "PYTHONHASHSEED": str(seed), "PYTHONPATH": os.pathsep.join(sys.path)}
        subprocess.run([sys.executable, "-c", SEEDED, place], env=environment, check=True)
        written.append({path.name: path.read_bytes() for path in place.iterdir()})
    assert written[0].keys() == {"plain.dxf", "cad.dxf", "profile.dxf"}
    assert all(each == written[0] for each in written)
