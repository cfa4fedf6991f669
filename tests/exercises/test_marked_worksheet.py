"""Worksheets that are photographed: room for all that is drawn, nothing black in it, marks that are found."""

from __future__ import annotations

import json
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from issued_variants import SECRET, answer_lines
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import DesignError, TaskError
from graphcam.exercises.course.course_making import make
from graphcam.exercises.course.handouts import instructions, key_sheet
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise_file import find_exercise, load_exercise
from graphcam.exercises.definition.marked_scale import PROFILE_MARGIN
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.key_making import issue
from graphcam.photo.printed_page import PrintedPage
from graphcam.sheets.marked_paper import MARKED_PAPERS
from graphcam.sheets.matplotlib_renderer import write_pdf, write_png
from graphcam.sheets.model import Box, Drawing, Polygons, Text, bounding_box
from graphcam.sheets.sampling import box_of
from graphcam.sheets.styles import CODE_ROLE, LIGHT_ROLES

pytest.importorskip("segno")

from graphcam.exercises.course.marked_worksheet import marked_sheets

PAPERS = tuple(MARKED_PAPERS)
NAMES = ("inversion-translating", "inversion-arm")
BOTH = pytest.mark.parametrize("name", NAMES)
EACH = pytest.mark.parametrize("paper", PAPERS)


def variant(name: str, paper: str, student: str = "Anna", draw: int = 0, language: str = "en") -> Variant:
    return drawn(find_exercise(name, language, paper=paper), student, SECRET, draw)


def made(name: str, paper: str, student: str = "Anna", draw: int = 0) -> tuple[Drawing, list[PrintedPage]]:
    """The whole sheets."""
    sheets, pages = marked_sheets(variant(name, paper, student, draw), Student(student), SECRET, paper, "colour")
    return sheets.in_cad, pages


@EACH
def test_the_tags_stand_apart_in_white(paper: str):
    marked = MARKED_PAPERS[paper]
    assert len(marked.tags) == {"A1": 12, "A3": 8, "A3-tiles": 14, "A4": 8}[paper]
    quiet = [Box(0, 0, marked.side, marked.side).moved(at).grown(marked.quiet_zone) for at in marked.tags.values()]
    # A printer leaves 4.3 mm of the edge white, and that white counts.
    assert all(marked.box.grown(-4.3).holds(box) for box in quiet)
    assert not any(a.meets(b) for k, a in enumerate(quiet) for b in quiet[:k])
    if marked.seam is not None:
        left = [box for box in quiet if box.right < marked.seam]
        assert len(left) == len(quiet) / 2
        assert all(box.right <= marked.seam - 4.3 or box.left >= marked.seam + 4.3 for box in quiet)


@pytest.mark.parametrize("name", [*NAMES, "given-cam-positions"])
@EACH
def test_all_stands_apart_and_nothing_black_in_a_room(name: str, paper: str):
    marked = MARKED_PAPERS[paper]
    drawing, pages = made(name, paper)
    quiet = [Box(0, 0, marked.side, marked.side).moved(at).grown(marked.quiet_zone) for at in marked.tags.values()]
    for page, printed in zip(drawing.pages, pages, strict=True):
        black = [Box(*edges) for edges in printed.black]
        rooms = [Box(*view.room) for view in printed.views.values()]
        assert not any(room.meets(other) for room in rooms for other in (*black, *quiet))
        assert not any(a.meets(b) for k, a in enumerate(rooms) for b in rooms[:k])
        others = [box for box in black if not any(tag.holds(box) for tag in quiet)]
        assert not any(box.meets(tag) for box in others for tag in quiet)
        assert all(marked.box.holds(box) for box in (*black, *rooms))
        for group in page.groups:
            for entity in group.entities:
                box = box_of([entity])
                assert box is not None
                if group.key.startswith("given"):
                    # The tip of an arrow and the half of a line lie on the edge.
                    assert any(room.grown(0.01).holds(box) for room in rooms)
                    assert entity.role == LIGHT_ROLES["colour"]
        assert set(printed.views) == set(page.origins)


@BOTH
@EACH
def test_the_text_tells_at_which_ordinate_and_poles_the_key_is_drawn(name: str, paper: str):
    one = variant(name, paper)
    board, told = board_chain(one.task).board, instructions(one)
    assert f"{board.ordinate:g} mm for the maximum ordinate" in told
    assert f"H₁ = {board.poles[0]:g} mm and H₂ = {board.poles[1]:g} mm" in told


@EACH
def test_texts_do_not_run_into_one_another(paper: str):
    for name, language in ((NAMES[0], "en"), (NAMES[1], "ru")):
        one = variant(name, paper, language=language)
        sheets, _ = marked_sheets(one, Student("Anna", "Анна Констанция Мария"), SECRET, paper, "grey")
        for page in sheets.in_cad.pages:
            black = [e for group in page.groups if not group.key.startswith("given") for e in group.entities]
            texts = [box for e in black if isinstance(e, Text) and (box := box_of([e]))]
            assert not any(a.meets(b) for k, a in enumerate(texts) for b in texts[:k])
            solid = [box for e in black if isinstance(e, Polygons) and e.role == CODE_ROLE and (box := box_of([e]))]
            assert not any(text.meets(other) for text in texts for other in solid)


@pytest.mark.slow
@BOTH
@EACH
def test_the_room_is_the_same_for_all_and_holds_every_cam(name: str, paper: str):
    exercise = find_exercise(name, paper=paper)
    half, scales, rooms = MARKED_PAPERS[paper].square / 2, set[float](), set[str]()
    for draw in range(12):
        one = drawn(exercise, "Ben", SECRET, draw)
        chain = board_chain(one.task)
        scale = chain.profile_scale.per_mm
        scales.add(scale)
        pitch, roller = np.abs(chain.inversion.points["pitch"]), one.parameters["roller"]
        assert isinstance(roller, float | int)
        assert pitch.max() + roller / scale <= half - PROFILE_MARGIN + 1e-9
        if draw % 6 == 0:
            _, pages = made(name, paper, "Ben", draw)
            rooms.add(json.dumps([{key: view.room for key, view in page.views.items()} for page in pages]))
    assert len(rooms) == 1
    assert scales <= {0.5, 1.0, 2.0}


@EACH
def test_the_profile_is_drawn_at_its_scale(paper: str):
    _, pages = made("inversion-translating", paper)
    one = variant("inversion-translating", paper)
    r0 = one.parameters["r0"]
    assert isinstance(r0, float | int)
    (view, page) = next((page.views["profile"], page) for page in pages if "profile" in page.views)
    assert view.closed
    radii = [np.abs(line - view.origin) for line in page.givens if len(line) > 20 and line[0] == line[-1]]
    wanted = r0 / board_chain(one.task).profile_scale.per_mm
    assert any(np.allclose(radius, wanted, atol=0.021) for radius in radii)
    # The turn is as long as the axis says.
    degrees = {"A1": 1.0, "A3": 2.0, "A3-tiles": 2.0, "A4": 3.0}[paper]
    diagram = next(page.views["displacement"] for page in pages if "displacement" in page.views)
    assert not diagram.closed
    assert (diagram.start, diagram.end) == (0.0, pytest.approx(360 / degrees))


def test_the_diagrams_stand_under_one_another_on_one_page():
    for paper in PAPERS:
        _, pages = made("inversion-arm", paper)
        origins = [pages[0].views[name].origin for name in ("acceleration", "velocity", "displacement")]
        assert len({origin.real for origin in origins}) == 1
        assert origins[0].imag > origins[1].imag > origins[2].imag


@EACH
def test_a_page_is_written_down_whole(paper: str):
    drawing, pages = made("inversion-translating", paper)
    for page in pages:
        again = PrintedPage.from_json(page.to_json())
        assert again.to_json() == page.to_json()
        assert again.tags == page.tags
        assert {abs(end - start) for start, end in page.bars} <= {120.0, 160.0, 170.0, 180.0, 250.0}
        assert all((end - start).imag == 0 or (end - start).real == 0 for start, end in page.bars)
    assert len({page.code for page in pages}) == len(drawing.pages)


@EACH
def test_it_is_printed_in_its_size(tmp_path: Path, paper: str):
    pdfium = pytest.importorskip("pypdfium2")
    sheets, _ = marked_sheets(variant("inversion-translating", paper), Student("Anna"), SECRET, paper, "grey")
    drawing = sheets.printed
    path = tmp_path / "worksheet.pdf"
    write_pdf(drawing, path)
    marked, mm = MARKED_PAPERS[paper], 25.4 / 72
    document = pdfium.PdfDocument(path)
    assert len(document) == len(drawing.pages)
    for number, page in enumerate(drawing.pages):
        width, height = document[number].get_size()
        assert (width * mm, height * mm) == pytest.approx((page.width, page.height), abs=0.01)
        # All tags are one path.
        boxes = [np.array(item.get_bounds()) * mm for item in document[number].get_objects() if item.type == 2]
        edge, far = marked.edge, (page.width - marked.edge, page.height - marked.edge)
        assert any(np.allclose(box, (edge, edge, *far), atol=0.01) for box in boxes)
    document.close()


@pytest.mark.parametrize("paper", ["A4", "A3-tiles"])
def test_tags_and_code_are_found_where_they_are_said(tmp_path: Path, paper: str):
    cv2, zxingcpp = pytest.importorskip("cv2"), pytest.importorskip("zxingcpp")
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    sheets, pages = marked_sheets(variant(NAMES[0], paper), Student("Anna"), SECRET, paper, "grey")
    drawing = sheets.printed
    marked, tiles = MARKED_PAPERS[paper], 2 if MARKED_PAPERS[paper].seam else 1
    found: set[int] = set()
    for k, page in enumerate(drawing.pages[:tiles]):
        write_png(page, tmp_path / "page.png", dpi=127)
        picture = cv2.imread(str(tmp_path / "page.png"), cv2.IMREAD_GRAYSCALE)
        corners, numbers, _ = cv2.aruco.ArucoDetector(family).detectMarkers(picture)
        for quadrangle, number in zip(corners, numbers.ravel().tolist(), strict=True):
            # From the upper left corner on; 5 pixels a millimetre, and pixels are counted from their middles.
            x, y = (quadrangle[0][3] + 0.5) / 5
            at = complex(x, page.height - y) + k * (marked.seam or 0.0)
            assert at == pytest.approx(pages[0].tags[number], abs=0.25)
            found.add(number)
        assert {each.text for each in zxingcpp.read_barcodes(picture)} == {pages[0].code}
    assert found == set(marked.tags)


@pytest.mark.slow
def test_the_drawing_for_cad_has_tags_and_the_origin(tmp_path: Path):
    (tmp_path / "secret").write_bytes(SECRET)
    (tmp_path / "roster.csv").write_text("id\nAnna\n")
    out = tmp_path / "course"
    assert make("inversion-translating", tmp_path / "roster.csv", tmp_path / "secret", out, paper="A3-tiles") == 1
    document = ezdxf.readfile(out / "students" / "Anna" / "worksheet.dxf")
    (origin,) = document.modelspace().query('POINT[layer=="ORIGIN"]')
    pages = [PrintedPage.from_json(path.read_text()) for path in sorted((out / "teacher" / "printed").iterdir())]
    assert [path.name for path in sorted((out / "teacher" / "printed").iterdir())] == ["Anna-1.json", "Anna-2.json"]
    # Pages stand side by side, tiles not apart.
    assert complex(origin.dxf.location.x - 460, origin.dxf.location.y) == pytest.approx(
        pages[1].views["profile"].origin
    )
    assert "PITCH" in document.layers
    codes = [solid for solid in document.modelspace().query("SOLID") if solid.dxf.layer.endswith("printed-code")]
    area = sum(abs((s.dxf.vtx3.x - s.dxf.vtx0.x) * (s.dxf.vtx3.y - s.dxf.vtx0.y)) for s in codes)
    tags = [box for group in made(NAMES[0], "A3")[0].pages[0].groups if group.key == "marks" for box in group.entities]
    assert area > 2 * 14 * 0.5 * 12**2
    assert bounding_box([box for e in tags if (box := box_of([e]))]).right == pytest.approx(412)


@pytest.mark.slow
def test_a_course_on_paper_is_graded_by_the_keys_of_its_paper(tmp_path: Path):
    secret, roster, out = tmp_path / "secret", tmp_path / "roster.csv", tmp_path / "course"
    secret.write_bytes(SECRET)
    roster.write_text("id\nAnna\n")
    arguments = ["--roster", str(roster), "--secret-file", str(secret), "--out", str(out)]
    result = CliRunner().invoke(app, ["exercise", "make", "inversion-arm", *arguments, "--print", "grey"])
    assert result.exit_code == 0, result.output
    said = json.loads((out / "teacher" / "course.json").read_text())
    assert (said["paper"], said["print"]) == ("A3", "grey")
    key = AnswerKey.from_json((out / "teacher" / "certificates" / "Anna.json").read_text())
    answers = {name: each.expected.value for name, each in key.keys.items()}
    points = [[z.real, z.imag] for z in np.ravel(answers.pop("rollers")).tolist()]
    lines = answer_lines({**{name: float(value) for name, value in answers.items()}, "rollers": points})
    (out / "students" / "Anna" / "answers.toml").write_text(lines)
    grades = tmp_path / "grades.csv"
    result = CliRunner().invoke(
        app, ["exercise", "grade", str(out), "--secret-file", str(secret), "--out", str(grades), "--workers", "1"]
    )
    assert result.exit_code == 0, result.output
    assert find_exercise("inversion-arm").marks == pytest.approx(15)
    assert ",15," in grades.read_text().replace('"', "")
    unmarked = ["exercise", "make", "inversion-arm", *arguments[:-1], str(tmp_path / "other"), "--paper", "unmarked"]
    assert CliRunner().invoke(app, unmarked).exit_code == 0
    assert not (tmp_path / "other" / "teacher" / "printed").exists()
    assert "paper" not in json.loads((tmp_path / "other" / "teacher" / "course.json").read_text())


@pytest.mark.slow
@BOTH
@pytest.mark.parametrize("paper", ["A3", "A3-tiles"])
def test_the_key_has_a_sheet_too(name: str, paper: str):
    exercise = find_exercise(name, paper=paper)
    one, key = issue(exercise, "Anna", SECRET)
    assert key_sheet(one, Student("Anna"), key).pages


@pytest.mark.parametrize(
    ("name", "paper", "message"),
    [
        ("integration", "A3", "left out: no paper of this exercise"),
        ("inversion-arm", "A2", "one of A1, A3, A4, A3-tiles"),
        ("inversion-arm", "A4-tiles", "one of A1, A3, A4, A3-tiles"),
    ],
)
def test_a_paper_that_it_is_not_made_for_is_refused(name: str, paper: str, message: str):
    with pytest.raises(DesignError, match=message):
        find_exercise(name, paper=paper)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ('papers = ["A1", "A3", "A4"]', 'papers = ["A5"]', r"papers is A5, but must be one of A1, A3, A4"),
        (
            'layer = "PITCH"',
            'layer = "PITCH"\nplace = "profil"',
            r"answers\[9\].place.* a view of the worksheet.*'profile'",
        ),
        ('layer = "PITCH"', 'layer = "PITCH"\nmark = "cross"', "one of curve for this answer"),
        ('station = "8"\nunit = "deg"', 'station = "8"\nunit = "deg"\nmark = "length"', "name the view it is drawn in"),
        ("version = 5", 'version = 5\npaper = "A3"', "an unknown key"),
    ],
)
def test_what_a_file_says_wrongly_of_its_marks_gets_one_message(tmp_path: Path, before: str, after: str, message: str):
    text = Path("exercises/inversion-translating.toml").read_text(encoding="utf-8")
    assert text.count(before) == 1
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(before, after), encoding="utf-8")
    with pytest.raises(TaskError, match=message):
        load_exercise(path)


def test_place_and_mark_are_kept(tmp_path: Path):
    text = Path("exercises/inversion-arm.toml").read_text(encoding="utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(
        text.replace('layer = "ROLLERS"', 'layer = "ROLLERS"\nplace = "profile"\nmark = "circle"'), encoding="utf-8"
    )
    rollers = load_exercise(path).answers[-1]
    assert (rollers.place, rollers.mark, rollers.mark_form) == ("profile", "circle", "circle")
    assert find_exercise("inversion-arm").answers[-1].mark_form == "cross"
    assert find_exercise("inversion-arm").answers[0].mark_form == ""
