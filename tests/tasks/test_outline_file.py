"""Outlines of given cams from DXF files: lines and arcs, polylines, splines, blocks, units; and what is no outline."""

import math

import ezdxf
import numpy as np
import pytest
from ezdxf import units
from ezdxf.math import BSpline, global_bspline_interpolation
from over_all import over_all
from test_point_outline import CLOSE, CLOSE_SLOPE

import graphcam as gc

FOLLOWER = '[follower]\nkind = "translating"\noffset = 4\nroller_radius = 9\n'
CAM = gc.cam_by_radii(base_radius=28, flank_radius=90, lift=14, ascent=math.radians(68), dwell=0.4)


def degrees(z):
    return math.degrees(np.angle(z))


def parts_on(space, scale=1.0, layer="0"):
    """The parts of the cam as lines and arcs, from the start of the flank on clockwise."""
    parts = list(CAM.arcs())
    for part, following in zip(parts, [*parts[1:], parts[0]], strict=True):
        start, end = part.point * scale, following.point * scale
        if math.isinf(part.radius):
            space.add_line((start.real, start.imag), (end.real, end.imag), {"layer": layer})
            continue
        centre = part.centre * scale
        space.add_arc(
            (centre.real, centre.imag),
            part.radius * scale,
            degrees(end - centre),
            degrees(start - centre),
            dxfattribs={"layer": layer},
        )


def polyline_on(space, scale=1.0):
    """The same as one polyline with bulges."""
    parts, corners = list(CAM.arcs()), []
    for part, following in zip(parts, [*parts[1:], parts[0]], strict=True):
        turned = -np.mod(np.angle((part.point - part.centre) / (following.point - part.centre)), 2 * math.pi)
        corners.append((part.point.real * scale, part.point.imag * scale, math.tan(turned / 4)))
    space.add_lwpolyline(corners, "xyb", close=True)


def disc_spline_on(space):
    angle = np.linspace(0, 2 * math.pi, 361)
    z = 30 * np.exp(1j * angle) + 5
    curve: BSpline = global_bspline_interpolation([(w.real, w.imag) for w in z], 3)
    space.add_spline().apply_construction_tool(curve)


def loaded(tmp_path, draw, head="", unit=units.MM):
    """The task of an outline that is drawn into a DXF file."""
    document = ezdxf.new(units=unit)
    draw(document)
    document.saveas(tmp_path / "cam.dxf")
    text = f'rotation = "ccw"\n[outline]\nfile = "cam.dxf"\n{head}\n{FOLLOWER}'
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    return gc.load_task(tmp_path / "cam.toml")


def in_a_block(document):
    block = document.blocks.new("CAM")
    parts_on(block)
    document.modelspace().add_blockref("CAM", (0, 0))


@over_all(
    ("draw", "unit"),
    [
        (lambda document: parts_on(document.modelspace()), units.MM),
        (lambda document: parts_on(document.modelspace(), 1 / 25.4), units.IN),
        (lambda document: polyline_on(document.modelspace()), units.MM),
        (in_a_block, 0),
    ],
)
def test_lines_arcs_and_polylines_move_the_follower_as_the_cam_by_radii_does(tmp_path, draw, unit):
    motion = loaded(tmp_path, draw, unit=unit).motion()
    exact = gc.outline_motion(CAM, gc.Translating(4, 9))
    # The drawing has the start of the flank on the x-axis, the closed form under the follower.
    turned = math.acos(4 / 37)
    phi = np.linspace(0, 2 * math.pi, 1441)
    s, v = motion(phi + turned - motion.zero)[:2]
    there, slope = exact(phi)[:2]
    assert np.abs(s - there).max() < CLOSE * exact.lift
    assert np.abs(v - slope).max() < CLOSE_SLOPE * np.abs(slope).max()


def test_a_spline_is_read(tmp_path):
    motion = loaded(tmp_path, lambda document: disc_spline_on(document.modelspace())).motion()
    e, r, offset = 5.0, 39.0, 4.0
    phi = np.linspace(0, 2 * math.pi, 361)
    there = e * np.sin(phi) + np.sqrt(r**2 - (offset - e * np.cos(phi)) ** 2)
    s = motion(phi - motion.zero)[0]
    assert np.abs((s - s.min()) - (there - there.min())).max() < 1e-3


def test_the_profile_that_graphcam_writes_is_an_outline(tmp_path):
    cam = gc.solve(gc.builtin_task()).cam
    (tmp_path / "out").mkdir()
    gc.write_profile(cam, tmp_path / "out")
    text = (
        f'rotation = "{cam.rotation}"\n[outline]\nfile = "out/profile.dxf"\n[follower]\nkind = "translating"\n'
        f"offset = {cam.follower.offset}\nroller_radius = {cam.roller_radius}\n"
    )
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    found, phi = gc.load_task(tmp_path / "cam.toml").motion(), np.linspace(0, 2 * math.pi, 721)
    assert np.abs(found(phi - found.zero)[0] - cam.motion(phi)[0]).max() < 2e-3
    assert found.prime_radius == pytest.approx(cam.prime_radius, abs=1e-3)


def bored(document):
    parts_on(document.modelspace(), layer="PROFILE")
    document.modelspace().add_circle((0, 0), 8, {"layer": "bore"})


def test_the_layer_chooses_the_loop(tmp_path):
    assert loaded(tmp_path, bored, 'layer = "profile"').motion().lift == pytest.approx(14, abs=0.1)


def test_dust_beside_the_outline_is_passed_over(tmp_path):
    """Programs leave arcs without a radius, and lines shorter than the gap that closes a loop."""

    def dusty(document):
        disc_spline_on(document.modelspace())
        document.modelspace().add_arc((40, 0), 0, 0, 0)
        document.modelspace().add_line((50, 0), (50.01, 0))

    assert loaded(tmp_path, dusty).motion().lift == pytest.approx(10, abs=0.1)


def square(document):
    document.modelspace().add_lwpolyline([(30, 0), (0, 30), (-30, 0), (0, -30)], close=True)


def half(document):
    document.modelspace().add_arc((0, 0), 30, 0, 180)


def nearly_closed(document):
    document.modelspace().add_arc((0, 5), 30, 0, 180)
    document.modelspace().add_arc((0, 5), 30, 180.2, 359.9)


@over_all(
    ("draw", "head", "said"),
    [
        (
            bored,
            "",
            "2 closed loops: 1 on the layer profile, 1 on the layer bore, but must be one closed loop",
        ),
        (bored, 'layer = "cam"', "layer is 'cam', but must be one of .*bore, profile"),
        (bored, "layer = 3", "outline.layer is 3"),
        (half, "", r"open on the layer 0, by 60 mm at .*join its ends"),
        (nearly_closed, "", r"open on the layer 0, by 0\.\d+ mm at .*join its ends"),
        (lambda document: None, "", "without a curve"),
        (lambda document: document.modelspace().add_line((9, 0), (9, 0.01)), "", r"open on the layer 0, by 0\.01 mm"),
        (
            square,
            "",
            r"bent by 90° in a corner at .* smooth all around; round it by an arc",
        ),
        (lambda document: document.modelspace().add_circle((90, 0), 8), "", "beside the cam centre"),
        (lambda document: document.modelspace().add_circle((0, 0), 8), "", "round about the cam centre"),
        (lambda document: document.modelspace().add_circle((0, 1e6), 8), "", "check the unit"),
    ],
)
def test_drawings_that_are_no_outline_are_told(tmp_path, draw, head, said):
    with pytest.raises(gc.GraphcamError, match=said):
        loaded(tmp_path, draw, head)


def test_files_that_are_no_dxf_are_told(tmp_path):
    (tmp_path / "cam.toml").write_text(f'[outline]\nfile = "cam.dxf"\n{FOLLOWER}', encoding="utf-8")
    with pytest.raises(gc.GraphcamError, match=r"there is no file cam\.dxf"):
        gc.load_task(tmp_path / "cam.toml")
    (tmp_path / "cam.dxf").write_bytes(b"nothing")
    with pytest.raises(gc.GraphcamError, match=r"is not to be read, .* one closed loop; cam\.dxf is not a DXF file"):
        gc.load_task(tmp_path / "cam.toml")


def chords_on(space):
    """The same as a polyline of short chords without bulges, as programs write that have no arcs."""
    points = []
    for part, following in zip(CAM.arcs(), [*CAM.arcs()[1:], CAM.arcs()[0]], strict=True):
        way = -1 if part.radius > 0 else 1
        turned = way * (way * np.angle(following.outward / part.outward) % (2 * math.pi))
        shares = np.arange(40) / 40
        points += (part.centre + part.radius * part.outward * np.exp(1j * turned * shares)).tolist()
    space.add_lwpolyline([(z.real, z.imag) for z in points], close=True)


@over_all("draw", [parts_on, polyline_on, chords_on])
def test_arcs_of_a_drawing_are_known_as_such(tmp_path, draw):
    """So its motion is that of the radii: the same accelerations, and the same jumps."""
    motion = loaded(tmp_path, lambda document: draw(document.modelspace())).motion()
    exact = gc.outline_motion(CAM, gc.Translating(4, 9))
    phi = np.linspace(0, 2 * math.pi, 3601)
    assert np.abs(np.array(motion(phi)[:3]) - np.array(exact(phi)[:3])).max() < 0.02
    assert np.degrees(motion.breaks) == pytest.approx(np.degrees(exact.breaks), abs=1e-3)
