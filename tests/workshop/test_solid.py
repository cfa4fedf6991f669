"""The cam as a solid: its topology by Euler and Poincaré, its faces as another kernel and FreeCAD read them."""

from __future__ import annotations

import math
import re
from collections import Counter
from dataclasses import dataclass

import numpy as np
import pytest
from programs import freecad, library
from test_gcode import CAMS
from test_spline import along, greatest_distance, sized

import graphcam as gc
from graphcam.given.follower import Translating
from graphcam.mechanism.profile_spline import profile_spline
from graphcam.tasks.part_table import PartTable
from graphcam.workshop.cam_part import CamPart, cam_part
from graphcam.workshop.cutting_files import solid_text
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.part_outline import of_cam
from graphcam.workshop.plane_loops import spline_loop
from graphcam.workshop.solid import solid_file

ENTITY = re.compile(r"#(\d+)=(.*);")
PARTS = {
    "keyway": PartTable(),
    "plain bore": PartTable(keyway="none"),
    "hub": PartTable(bore=12.0, hub_diameter=24.0, hub_length=30.0, width=10.0),
}


@dataclass(frozen=True)
class Entities:
    """What stands in a STEP file, by number: names, and the numbers that each refers to."""

    names: dict[int, str]
    refers: dict[int, list[int]]
    texts: dict[int, str]

    def of(self, name: str) -> list[int]:
        return [number for number, found in self.names.items() if found == name]


def read(text: str) -> Entities:
    lines = text.splitlines()
    assert lines[0] == "ISO-10303-21;"
    assert lines[-1] == "END-ISO-10303-21;"
    found = {int(m[1]): m[2] for line in lines if (m := ENTITY.fullmatch(line))}
    assert list(found) == list(range(1, len(found) + 1))
    names = {number: said.partition("(")[0] for number, said in found.items()}
    refers = {number: [int(n) for n in re.findall(r"#(\d+)", said)] for number, said in found.items()}
    for number, others in refers.items():
        assert all(other < number for other in others)  # none is missing
    return Entities(names, refers, found)


def made(cam: gc.Cam, table: PartTable, deviation: float = 1e-5) -> tuple[str, CamPart]:
    outline = of_cam(cam)
    part = cam_part(table, "iso", outline.least_radius)
    loop = spline_loop(profile_spline(cam, deviation, trimmed=True))
    return solid_file(loop, part, outline.zero, "cam", "a cam", "graphcam"), part


@pytest.fixture(params=CAMS)
def cam(request) -> gc.Cam:
    return CAMS[request.param]()


@pytest.mark.parametrize("kind", PARTS)
def test_the_shell_is_closed_and_has_one_hole(kind):
    """Every edge belongs to two faces, once each way, and V - E + F - (L - F) = 2 (1 - 1)."""
    text, _ = made(sized(1.0, Translating(8.0, 10.0)), PARTS[kind])
    file = read(text)
    uses = Counter(file.refers[number][0] for number in file.of("ORIENTED_EDGE"))
    assert set(uses) == set(file.of("EDGE_CURVE"))
    assert set(uses.values()) == {2}
    ways = Counter((file.refers[n][0], file.texts[n].endswith(".T.)")) for n in file.of("ORIENTED_EDGE"))
    assert set(ways.values()) == {1}
    vertices, edges, faces, loops = (
        len(file.of(name)) for name in ("VERTEX_POINT", "EDGE_CURVE", "ADVANCED_FACE", "EDGE_LOOP")
    )
    assert vertices - edges + faces - (loops - faces) == 0
    (shell,) = file.of("CLOSED_SHELL")
    assert sorted(file.refers[shell]) == file.of("ADVANCED_FACE")


def test_it_is_a_product_of_ap214_in_millimetres_and_its_bytes_repeat():
    solution = gc.solve(gc.builtin_task())
    text = solid_text(PartContents(solution))
    assert "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));" in text
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    assert re.search(r"greatest distance from the exact profile 0\.0004\d mm", text)
    assert text == solid_text(PartContents(gc.solve(gc.builtin_task())))
    assert text.isascii()


def test_a_spline_cut_at_its_corners_is_the_same_curve(cam):
    spline = profile_spline(cam, trimmed=True)
    edges = spline_loop(spline)
    assert len(edges) >= 2
    assert len(edges) >= len(cam.undercuts())
    from scipy.interpolate import BSpline

    points = []
    for edge, then in zip(edges, [*edges[1:], edges[0]], strict=True):
        assert edge.end == then.start
        _, times = np.unique(edge.knots[edge.degree + 1 : -edge.degree - 1], return_counts=True)
        assert times.max(initial=0) < edge.degree  # smooth inside
        curve = BSpline(edge.knots, edge.control, edge.degree)
        points.append(curve(np.linspace(edge.knots[0], edge.knots[-1], 2000))[:-1])
    around = np.concatenate(points)
    dense = along(spline)
    size = np.abs(dense).max()
    assert (
        greatest_distance(np.stack([around.real, around.imag], axis=-1), dense) <= 1e-4 * size
    )  # what the polygon cuts off
    area = np.sum(np.imag(np.conj(around) * np.roll(around, -1))) / 2
    assert area > 0  # anticlockwise


# --- as another kernel reads it --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Solid:
    """What Open CASCADE finds: volume, box (2, 3), number of faces, areas of the plane faces, points of the outline."""

    volume: float
    box: np.ndarray
    faces: int
    loops: list[np.ndarray]


@pytest.fixture(scope="module")
def kernel():
    gmsh = library("gmsh")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    yield gmsh
    gmsh.finalize()


def found(gmsh, text: str, folder) -> Solid:
    (folder / "a.step").write_text(text)
    gmsh.clear()
    (solid,) = gmsh.model.occ.importShapes(str(folder / "a.step"), highestDimOnly=True)
    gmsh.model.occ.synchronize()
    assert solid[0] == 3
    box = np.array(gmsh.model.occ.getBoundingBox(*solid)).reshape(2, 3)
    faces = gmsh.model.getEntities(2)
    bottom = [f for f in faces if abs(gmsh.model.occ.getCenterOfMass(*f)[2]) < 1e-9]
    (bottom,) = bottom
    edges = []
    for _, tag in gmsh.model.getBoundary([bottom], oriented=False):
        low, high = (ends[0] for ends in gmsh.model.getParametrizationBounds(1, tag))
        points = np.array(gmsh.model.getValue(1, tag, np.linspace(low, high, 5_000))).reshape(-1, 3)
        edges.append(points[:, 0] + 1j * points[:, 1])
    return Solid(gmsh.model.occ.getMass(*solid), box, len(faces), chained(edges))


def chained(edges: list[np.ndarray]) -> list[np.ndarray]:
    """Edges in any order and sense as closed loops."""
    loops = []
    while edges:
        loop = [edges.pop()]
        while abs(loop[-1][-1] - loop[0][0]) > 1e-6:
            k, edge = next(
                (k, way)
                for k, edge in enumerate(edges)
                for way in (edge, edge[::-1])
                if abs(way[0] - loop[-1][-1]) < 1e-6
            )
            edges.pop(k)
            loop.append(edge)
        loops.append(np.concatenate([edge[:-1] for edge in loop]))
    return loops


def enclosed(loop: np.ndarray) -> float:
    return abs(np.sum(np.imag(np.conj(loop) * np.roll(loop, -1)))) / 2


@pytest.mark.parametrize("kind", PARTS)
def test_another_kernel_finds_one_solid_of_the_exact_volume(kernel, tmp_path, kind):
    """Area of the profile by the shoelace formula of dense exact points, of bore and keyway by their own formulas."""
    cam = sized(1.0, Translating(8.0, 10.0))
    text, part = made(cam, PARTS[kind], deviation=1e-6)
    solid = found(kernel, text, tmp_path)
    exact = cam.trimmed_profile(400_000)
    profile = enclosed(exact[:, 0] + 1j * exact[:, 1])
    hole = math.pi * part.bore**2 / 4 + (part.keyway.area(part.bore) if part.keyway else 0.0)
    areas = sorted(map(enclosed, solid.loops))
    assert areas == pytest.approx([hole, profile], rel=1e-6)
    volume = (profile - hole) * part.width
    if part.hub:
        volume += (math.pi * part.hub.diameter**2 / 4 - hole) * (part.hub.length - part.width)
    assert solid.volume == pytest.approx(volume, rel=1e-6)
    # In millimetres.  Its box reaches to the control points of a spline, beyond the curve.
    assert solid.box[:, 2] == pytest.approx([0, part.length], abs=1e-6)
    outer = max(solid.loops, key=enclosed)
    assert [np.ptp(outer.real), np.ptp(outer.imag)] == pytest.approx(np.ptp(exact, axis=0).tolist(), abs=1e-4)


def test_the_kernels_outline_is_the_exact_profile(kernel, tmp_path, cam):
    table = PartTable(keyway="none")
    text, part = made(cam, table, deviation=0.0005)
    solid = found(kernel, text, tmp_path)
    outer = max(solid.loops, key=enclosed)
    points = np.stack([outer.real, outer.imag], axis=-1)
    exact = cam.trimmed_profile(400_000)
    assert greatest_distance(points, exact) <= 0.0005
    # By its own integration, too: within what the deviation may come to all around.
    volume = (enclosed(exact[:, 0] + 1j * exact[:, 1]) - math.pi * part.bore**2 / 4) * part.width
    around = np.abs(np.diff(outer)).sum() * part.width
    assert solid.volume == pytest.approx(volume, rel=5e-6, abs=0.0005 * around)


def test_a_cam_of_arcs_has_the_faces_of_its_arcs(kernel, tmp_path):
    solution = gc.solve(gc.builtin_arcs_task())
    solid = found(kernel, solid_text(PartContents(solution)), tmp_path)
    motion = solution.cam.motion(0.0, solution.motion.dwell)
    phi = np.linspace(0, 2 * math.pi, 400_000, endpoint=False)
    exact = motion.pitch_curve(phi)
    outer = max(solid.loops, key=enclosed)
    assert greatest_distance(np.stack([outer.real, outer.imag], axis=-1), exact) <= 1e-5
    assert enclosed(outer) == pytest.approx(enclosed(exact[:, 0] + 1j * exact[:, 1]), rel=1e-6)


SCRIPT = """
import Part

pytestmark = pytest.mark.slow
shape = Part.Shape()
shape.read({path!r})
box = shape.optimalBoundingBox(False)
print("\\nFOUND", shape.ShapeType, shape.isValid(), shape.isClosed(), len(shape.Solids), len(shape.Faces),
    repr(shape.Volume), repr(box.XLength), repr(box.YLength), repr(box.ZLength))
"""


@pytest.mark.parametrize("kind", PARTS)
def test_freecad_finds_one_valid_closed_solid(tmp_path, kind):
    cam = sized(1.0, Translating(8.0, 10.0))
    text, part = made(cam, PARTS[kind])
    (tmp_path / "a.step").write_text(text)
    kind_of, valid, closed, solids, faces, *sizes = freecad(SCRIPT.format(path=str(tmp_path / "a.step")), tmp_path)
    assert [kind_of, valid, closed, solids] == ["Solid", "True", "True", "1"]
    assert int(faces) == len(read(text).of("ADVANCED_FACE"))
    across = np.ptp(cam.trimmed_profile(100_000), axis=0)
    assert [float(size) for size in sizes[1:]] == pytest.approx([*across, part.length], abs=1e-3)
