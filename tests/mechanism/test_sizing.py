"""The smallest cam: exact limits, the closed form where the pressure angle alone binds, and a brute-force grid."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import graphcam as gc
from graphcam.mechanism.sizing_region import feasible_region

DEG = math.pi / 180


def motion_of(lift: float, angles: tuple[float, ...], law: str = "3-4-5") -> gc.Motion:
    rise, dwell, back, rest = (angle * DEG for angle in angles)
    return gc.Motion([gc.Rise(lift, rise, law), gc.Dwell(dwell), gc.Return(lift, back, law), gc.Dwell(rest)])


def constant(force: float) -> gc.SpringLoad:
    return gc.SpringLoad(0, 0, 0, preload=force)


# Tran Minh Quang, Nguyen Quang Hung 2015: lift 12, base radius 60..120, offset up to 20, roller 15, 25 degrees, 1500
# N/mm^2.  Motion and force are chosen here so that both limits are felt.
TRAN = {
    "prime_radius": (75.0, 135.0), "offset": (0.0, 20.0), "roller_radius": (15.0, 15.0), "face_width": (10.0, 20.0),
    "permitted_stress": 1500.0, "rise": 25 * DEG,
}  # fmt: skip
CASES = {
    "2015, angle": (motion_of(12, (18, 60, 60, 222)), constant(4000), TRAN),
    "2015, stress": (motion_of(12, (24, 60, 60, 216)), constant(11000), TRAN),
    "angle and stress": (
        motion_of(12, (40, 60, 40, 220)), constant(6000),
        {"prime_radius": (30, 90), "offset": (-20, 20), "roller_radius": (8, 15), "face_width": (10, 30),
         "permitted_stress": 1500.0},
    ),
    "both angles": (
        motion_of(12, (40, 60, 40, 220)), constant(6000),
        {"prime_radius": (30, 90), "offset": (-20, 20), "roller_radius": (8, 15), "face_width": (10, 30),
         "permitted_stress": 1500.0, "return_": 25 * DEG},
    ),
    "spring": (
        motion_of(25, (70, 60, 80, 150), "cycloidal"), gc.SpringLoad(2, 600, 20, preload=3000),
        {"prime_radius": (40, 100), "offset": (0, 30), "roller_radius": (10, 20), "face_width": (8, 16),
         "permitted_stress": 1000.0},
    ),
    "jumps": (
        motion_of(25, (70, 60, 80, 150), "rectangular"), gc.SpringLoad(2, 600, 20, preload=3000),
        {"prime_radius": (40, 160), "offset": (0, 30), "roller_radius": (10, 20), "face_width": (8, 12),
         "permitted_stress": 800.0, "roller_rule": "0.7 rho"},
    ),
}  # fmt: skip
SIZED: dict[str, gc.SizedCam] = {}


def sized(name: str) -> gc.SizedCam:
    if name not in SIZED:
        motion, load, asked = CASES[name]
        SIZED[name] = gc.size_cam(motion, load, **asked)
    return SIZED[name]


@pytest.mark.parametrize("name", CASES)
def test_no_limit_is_exceeded_by_the_exact_extremes(name):
    """By the cam's own extremes, stress and ranges: what another program would look at."""
    (_, load, asked), found = CASES[name], sized(name)
    extremes = found.cam.extremes()
    assert abs(extremes.pressure_angle_rise[0]) <= asked.get("rise", 25 * DEG) * (1 + 1e-12)
    if asked.get("return_"):
        assert abs(extremes.pressure_angle_return[0]) <= asked["return_"] * (1 + 1e-12)
    share = float(asked.get("roller_rule", "0.8 rho").split()[0])
    assert found.cam.roller_radius <= share * extremes.min_convex_radius[0] * (1 + 1e-12)
    stress = gc.ContactStress(gc.CamForces(found.cam, load), gc.RollerContact(found.face_width)).greatest().value
    assert stress <= asked["permitted_stress"] * (1 + 1e-12)
    assert found.stress == pytest.approx(stress, rel=1e-14)
    sizes = (found.cam.prime_radius, found.offset, found.cam.roller_radius, found.face_width)
    names = ("prime_radius", "offset", "roller_radius", "face_width")
    for size, (low, high) in zip(sizes, (asked[name] for name in names), strict=True):
        assert low - 1e-12 <= size <= high + 1e-12


@pytest.mark.parametrize("name", CASES)
def test_a_smaller_cam_exceeds_a_limit(name):
    """A thousandth of a mm less of prime radius, whatever the neighbouring offset and roller: none is permitted."""
    (motion, load, asked), found = CASES[name], sized(name)
    if "least prime radius" in found.binding:  # nothing smaller is in the range
        assert found.cam.prime_radius == pytest.approx(asked["prime_radius"][0], rel=1e-12)
        return
    radius, limit = found.cam.prime_radius - 1e-3, asked.get("rise", 25 * DEG)
    share = float(asked.get("roller_rule", "0.8 rho").split()[0])
    width, steps = asked["face_width"][1], np.array([-0.1, -0.003, 0.0, 0.003, 0.1])
    for e in np.unique(np.clip(found.offset + steps, *asked["offset"])):
        for roller in np.unique(np.clip(found.cam.roller_radius + steps[1:4], *asked["roller_radius"])):
            cam = gc.Cam(motion, gc.Translating(e, roller), radius, "ccw")
            extremes = cam.extremes()
            kept = (
                abs(extremes.pressure_angle_rise[0]) <= limit
                and abs(extremes.pressure_angle_return[0]) <= (asked.get("return_") or math.pi)
                and roller <= share * extremes.min_convex_radius[0]
                and gc.ContactStress(gc.CamForces(cam, load), gc.RollerContact(width)).greatest().value
                <= asked["permitted_stress"]
            )
            assert not kept


def test_where_pressure_angles_alone_bind_the_closed_form_is_met():
    motion, _, asked = CASES["both angles"]
    least = gc.minimum_radius(motion, gc.Translating(), "ccw", rise=25 * DEG, return_=asked["return_"])
    assert sized("both angles").cam.prime_radius == pytest.approx(least.prime_radius, rel=1e-11)
    assert sized("both angles").offset == pytest.approx(least.offset, abs=1e-8)
    assert set(sized("both angles").binding) == {"pressure angle on the rise", "pressure angle on the return"}
    tran = sized("2015, angle")
    fixed = gc.minimum_radius(CASES["2015, angle"][0], gc.Translating(), "ccw", rise=25 * DEG, offset=tran.offset)
    assert tran.cam.prime_radius == pytest.approx(fixed.prime_radius, rel=1e-11)
    assert tran.binding[0] == "pressure angle on the rise"


def test_what_binds_is_named():
    assert "stress" in sized("2015, stress").binding
    assert "greatest face width" in sized("2015, stress").binding
    assert {"pressure angle on the rise", "stress"} < set(sized("angle and stress").binding)
    easy = gc.size_cam(motion_of(12, (120, 60, 120, 60)), constant(1000), **TRAN)
    assert easy.cam.prime_radius == 75
    assert set(easy.binding) == {"least prime radius", "least face width"} | set(easy.binding) & {"least offset"}


def test_the_cam_of_a_mirror_has_the_offset_on_the_other_side():
    motion, load, asked = CASES["angle and stress"]
    mirrored = gc.size_cam(motion, load, **asked, rotation="cw")
    assert mirrored.cam.prime_radius == pytest.approx(sized("angle and stress").cam.prime_radius, abs=1e-6)
    assert mirrored.offset == pytest.approx(-sized("angle and stress").offset, abs=1e-5)


def test_the_cam_that_was_found_is_the_lowest_point_of_the_region():
    for name in ("angle and stress", "spring"):
        found = sized(name)
        region = feasible_region(found.problem, parts=40)
        assert np.nanmin(region.least) >= found.cam.prime_radius - 2e-3
        assert np.nanmin(region.least) == pytest.approx(found.cam.prime_radius, abs=np.diff(region.values)[0])
        for border in region.by_limit.values():
            assert np.all((region.least >= border - 1e-6) | np.isnan(region.least) | np.isnan(border))


def test_the_sheet_of_the_region_is_drawn(tmp_path):
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png
    from graphcam.sheets.model import Text

    drawing = gc.sizing_sheet(sized("angle and stress"))
    assert len(drawing.pages) == 1
    texts = [e.text for page in drawing.pages for g in page.groups for e in g.entities if isinstance(e, Text)]
    for words in ("Permitted cams", "stress", "41.12 mm", "1500 *"):
        assert any(words in text for text in texts), words
    write_pdf(drawing, tmp_path / "region.pdf")
    write_png(drawing.pages[0], tmp_path / "region.png")
    assert (tmp_path / "region.pdf").read_bytes().startswith(b"%PDF")


def test_the_sheet_of_the_region_speaks_russian():
    from russian import english_words

    from graphcam.report.sizing_tables import BINDING
    from graphcam.sheets.model import Text

    for name in ("angle and stress", "spring"):
        # What binds is told by its name.
        assert set(sized(name).binding) <= BINDING.keys()
        drawing = gc.sizing_sheet(sized(name), frame="gost", language="ru")
        texts = [e.text for page in drawing.pages for g in page.groups for e in g.entities if isinstance(e, Text)]
        assert "угол давления на удалении" in texts
        for text in texts:
            assert english_words(text) == set()
            assert not re.search(r"\d\.\d", text)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"prime_radius": (75, 70)}, "range of the prime radius is '75 to 70 mm'"),
        ({"face_width": (0, 70)}, "range of the face width is '0 to 70 mm'"),
        ({"offset": (0, 80)}, "range of the offset is 'up to 80 mm', but must be less than the least prime radius"),
        ({"roller_radius": (10, 90)}, "range of the roller radius is 'up to 90 mm'"),
        ({"rise": 0.0}, "permitted pressure angle on the rise is '0 degrees'"),
        ({"permitted_stress": 0.0}, "permitted stress is 0.0"),
        ({"roller_rule": "rho / 2"}, "roller rule is 'rho / 2'"),
        ({"prime_radius": None}, "prime_radius and base_radius is 'neither given'"),
        ({"base_radius": (60, 120)}, "prime_radius and base_radius is 'both given'"),
        ({"objective": "price"}, "objective is 'price', but must be 'size' or 'stress'"),
        ({"friction": -0.1}, "friction is -0.1"),
        ({"rotation": "left"}, "rotation is 'left'"),
    ],
)  # fmt: skip
def test_problems_without_a_solution_are_refused_with_reason(change, message):
    with pytest.raises(gc.DesignError, match=message):
        gc.size_cam(motion_of(12, (60, 60, 60, 180)), constant(4000), **(TRAN | change))


def test_a_load_that_does_not_keep_contact_is_refused():
    with pytest.raises(gc.DesignError, match=r"least contact force is .* preload the spring"):
        gc.size_cam(motion_of(12, (40, 60, 40, 220)), gc.SpringLoad(2, 900, 5, preload=10), **TRAN)


# --- brute force -----------------------------------------------------------------------------------------------------


def brute_force(motion: gc.Motion, load: gc.SpringLoad, asked: dict) -> tuple[float, float]:
    """The least prime radius of a million cams, and the grid's step of it, straight from the textbook's formulas."""
    counts = {"prime_radius": 50, "offset": 25, "roller_radius": 20, "face_width": 40}
    axes = {name: np.linspace(*asked[name], n) for name, n in counts.items()}
    inside = [
        motion.at(k, np.linspace(0, 1, 121), side) for k in range(len(motion.phases)) for side in ("left", "right")
    ]
    s, v, a, _ = (np.concatenate(parts) for parts in zip(*inside, strict=True))
    direction = np.repeat([phase.direction for phase in motion.phases for _ in range(2)], 121)
    omega = load.speed_rpm * math.pi / 30
    q = load.mass * a * omega**2 / 1000 + load.preload + load.stiffness * s
    r0, e = np.meshgrid(axes["prime_radius"], axes["offset"], indexing="ij")
    r0, e = r0[..., None], e[..., None]
    d, y = np.sqrt(r0**2 - e**2) + s, v - e
    alpha = np.arctan(y / d)
    kappa = (d**2 + y**2 + y * v - d * a) / (d**2 + y**2) ** 1.5
    steep = {1: asked.get("rise", 25 * DEG), -1: asked.get("return_") or math.pi}
    angle_kept = np.all([(np.abs(alpha) <= steep[k]) | (direction != k) for k in steep], axis=(0, -1))
    modulus = 1 / (2 * (1 - 0.3**2) / 206000)
    permitted = np.zeros((*r0.shape[:2], counts["roller_radius"], counts["face_width"]), dtype=bool)
    for k, roller in enumerate(axes["roller_radius"]):
        rho = np.divide(1, kappa, out=np.full_like(kappa, np.inf), where=kappa > 0)
        fits = np.all(roller <= float(asked.get("roller_rule", "0.8 rho").split()[0]) * rho, axis=-1)
        # 1/R = 1/(rho - r) + 1/r for the working profile
        bend = kappa / np.where(kappa * roller < 1, 1 - kappa * roller, np.nan) + 1 / roller
        at_unit_width = np.sqrt(np.max(q / np.cos(alpha) * modulus * bend / math.pi, axis=-1))
        stress = at_unit_width[..., None] / np.sqrt(axes["face_width"])
        permitted[:, :, k] = (angle_kept & fits)[..., None] & (stress <= asked["permitted_stress"])
    assert permitted.size == 1_000_000
    kept = permitted.any(axis=(1, 2, 3))
    return float(axes["prime_radius"][kept].min()), float(np.diff(axes["prime_radius"])[0])


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_no_cam_of_a_million_is_smaller(name):
    motion, load, asked = CASES[name]
    least, step = brute_force(motion, load, asked)
    found = sized(name).cam.prime_radius
    # The grid looks at places of the turn only, so it may let pass what exceeds a limit between them by a little.
    between_places = 1e-2
    assert least >= found - between_places
    assert least <= found + 2 * step
