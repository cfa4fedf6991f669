"""The polar table against references that know nothing of how it is found: rays cut short by rollers and faces."""

from __future__ import annotations

import numpy as np
import pytest
from over_all import fast_first

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.tasks.part_table import PartTable
from graphcam.workshop.part_outline import of_cam, outline_of
from graphcam.workshop.polar_table import PolarCurve, PolarTable, polar_table

FINE = np.linspace(0, 2 * np.pi, 200_001)


def solved(name: str) -> gc.Solution:
    solution = gc.solve(gc.builtin_task(name))
    assert isinstance(solution, gc.Solution)
    return solution


def undercut() -> gc.Cam:
    rise, back = gc.Rise(30, np.radians(60)), gc.Return(30, np.radians(90))
    motion = gc.Motion([rise, gc.Dwell(np.radians(90)), back, gc.Dwell(np.radians(120))])
    return gc.Cam(motion, gc.Translating(offset=5, roller_radius=20), prime_radius=30)


def cams() -> dict[str, gc.Cam]:
    named = {name: solved(name).cam for name in ("coursework", "arm", "measured", "flat")}
    # A favourable offset, the other rotation, and a roller that undercuts.
    return named | {"undercut": undercut()}


def ray_angles(cam: gc.Cam, angles_deg: np.ndarray) -> np.ndarray:
    """Directions in cam coordinates: from where the follower meets the cam at angle 0, against the rotation."""
    x, y = cam.profile(0.0)
    return np.arctan2(y, x) - cam.sigma * np.radians(angles_deg)


def by_rollers(cam: gc.Cam, directions: np.ndarray, wider: float = 0.0) -> np.ndarray:
    """How far a ray goes before it enters the roller in any of its places, which a cutter of its size has cleared.

    With ``wider`` it goes to the centre of a cutter of that radius instead, beyond all circles about roller centres.
    """
    pitch = cam.pitch_curve(FINE) @ [1, 1j]
    reach = cam.roller_radius - wider
    radii = np.empty(directions.shape)
    for k, direction in enumerate(directions):
        seen = pitch * np.exp(-1j * direction)
        near = (np.abs(seen.imag) <= abs(reach)) & (seen.real > 0)
        radii[k] = np.min(seen.real[near] - np.sqrt(reach**2 - seen.imag[near] ** 2))
    return radii


def by_faces(cam: gc.Cam, directions: np.ndarray) -> np.ndarray:
    """How far a ray goes before it meets the flat face in any of its places."""
    phi = FINE
    height = cam.prime_radius + cam.motion(phi)[0]
    radii = np.empty(directions.shape)
    for k, direction in enumerate(directions):
        along = np.cos(direction - (np.pi / 2 - cam.sigma * phi))
        radii[k] = np.min(height[along > 0.05] / along[along > 0.05])
    return radii


@pytest.mark.parametrize("name", ["coursework", "arm", "measured", "flat", "undercut"])
def test_radii_are_those_at_which_a_ray_meets_the_follower(name: str) -> None:
    cam = cams()[name]
    rows = polar_table(of_cam(cam), PartTable(table_step=10))
    some = slice(0, None, 7)
    reference = (by_faces if name == "flat" else by_rollers)(cam, ray_angles(cam, rows.angles[some]))
    assert np.abs(rows.radii[some] - reference).max() < 0.0005


def test_radii_of_arcs_lie_on_their_circles() -> None:
    solution = gc.solve(gc.builtin_arcs_task())
    assert isinstance(solution, gc.ArcsSolution)
    cam, motion = solution.cam, solution.motion
    rows = polar_table(outline_of(solution), PartTable())
    start = complex(*cam.A) / np.hypot(*cam.A)
    points = rows.radii * start * np.exp(-1j * motion.sigma * np.radians(rows.angles))
    # The return is the rise's mirror image in the middle of the upper dwell.
    middle = start * np.exp(-1j * motion.sigma * (motion.rise + motion.dwell / 2))
    mirrored = middle**2 * points.conj()
    circles = [(complex(*c), rho) for c, rho in ((cam.C1, cam.rho1), (cam.C2, cam.rho2), (cam.C3, cam.rho3))]
    circles += [(0j, np.hypot(*cam.A)), (0j, np.hypot(*cam.D))]
    off = [np.abs(np.abs(z - c) - rho) for z in (points, mirrored) for c, rho in circles]
    assert np.min(off, axis=0).max() < 1e-9
    assert rows.radii.min() == pytest.approx(np.hypot(*cam.A))
    assert rows.radii.max() == pytest.approx(np.hypot(*cam.D), abs=1e-9)


@pytest.mark.parametrize("cutter", [6.0, 25.0])
@pytest.mark.parametrize("name", ["coursework", "arm"])
def test_a_cutter_s_centre_is_as_far_outside_as_its_radius(name: str, cutter: float) -> None:
    cam = cams()[name]
    outline = of_cam(cam)
    rows = polar_table(outline, PartTable(table_step=10, cutter_radius=cutter))
    assert rows.cutter is not None
    centres = rows.cutter * np.exp(1j * np.radians(rows.angles))
    profile = cam.profile(FINE) @ [1, 1j]
    zero = complex(*cam.profile(0.0))
    seen = profile * zero.conjugate() / abs(zero)
    seen = seen.conj() if cam.sigma > 0 else seen
    assert [np.abs(seen - centre).min() for centre in centres[::9]] == pytest.approx(
        [cutter] * len(centres[::9]), abs=1e-4
    )


@pytest.mark.parametrize("cutter", fast_first([8.0, None]))
@pytest.mark.parametrize("step", [1, 2, 5, 10])
@pytest.mark.parametrize("name", ["coursework", "flat", "undercut"])
def test_a_straight_line_between_rows_keeps_the_stated_bound(name: str, step: int, cutter: float | None) -> None:
    outline = of_cam(cams()[name])
    rows = polar_table(outline, PartTable(table_step=step, cutter_radius=cutter))  # type: ignore[arg-type]
    assert rows.bound == 0.25 * 0.05
    between = np.linspace(0, 360, 9001)[:-1] + 0.013
    for distance, radii in ((0.0, rows.radii), (cutter, rows.cutter)):
        if radii is not None and distance is not None:
            straight = np.interp(between, np.append(rows.angles, 360), np.append(radii, radii[0]))
            exact = PolarCurve(outline, distance).radius(np.radians(between))
            slope = np.gradient(exact, np.radians(between))
            # Along the normal, to which the radius leans where it changes fast.
            along_normal = np.abs(straight - exact) * exact / np.hypot(exact, slope)
            away = np.ones(between.shape, dtype=bool)
            for corner in outline.corners:
                away &= np.abs(between - np.degrees(np.angle(corner)) % 360) > 0.2
            assert along_normal[away].max() <= rows.bound * 1.01


def test_rows_stand_a_step_apart_and_closer_where_the_radius_changes_fast() -> None:
    rows = polar_table(of_cam(cams()["coursework"]), PartTable(table_step=10))
    gaps = np.diff(np.append(rows.angles, 360))
    assert set(range(0, 360, 10)) <= set(rows.angles.tolist())
    assert gaps.max() == 10
    change = np.abs(np.diff(np.append(rows.radii, rows.radii[0])))
    assert gaps[change > 0.3].max() <= 2
    assert np.all(change[gaps == 10] < 0.05)


def test_a_finer_tolerance_asks_for_more_rows_and_more_decimals() -> None:
    outline = of_cam(cams()["coursework"])
    coarse, fine = (polar_table(outline, PartTable(profile_tolerance=t)) for t in (0.05, 0.01))
    assert (coarse.decimals, fine.decimals) == (2, 3)
    assert fine.angles.size > 1.5 * coarse.angles.size
    with pytest.raises(DesignError, match="profile_tolerance is 1e-06, but must be large enough"):
        polar_table(outline, PartTable(profile_tolerance=1e-6))


def test_a_cutter_larger_than_the_hollow_is_refused() -> None:
    outline = of_cam(cams()["coursework"])
    # The flank's hollow, by three points of the profile each.
    points = outline.points[::3]
    a, b, c = points, np.roll(points, -1), np.roll(points, -2)
    area = ((b - a).conj() * (c - a)).imag
    hollow = (area < -1e-12) & (np.abs(b - a) > 1e-3) & (np.abs(c - b) > 1e-3)
    radius = np.abs((b - a) * (c - b) * (a - c))[hollow] / (2 * np.abs(area[hollow]))
    assert outline.least_hollow == pytest.approx(radius.min(), rel=0.01)
    with pytest.raises(DesignError, match=r"part.cutter_radius is 60, but must be less than 47\.97 mm, the minimum"):
        polar_table(outline, PartTable(cutter_radius=60))


def test_a_corner_is_kept_by_table_and_cutter() -> None:
    outline = of_cam(undercut())
    assert len(outline.corners) == 1
    (corner,) = outline.corners
    at = np.angle(corner) % (2 * np.pi)
    assert PolarCurve(outline).radius(np.array([at]))[0] == pytest.approx(abs(corner), abs=1e-9)
    # The centre of the cutter goes around the corner on a circle about it.
    angles = at + np.linspace(-0.02, 0.02, 9)
    centres = PolarCurve(outline, 8.0).radius(angles) * np.exp(1j * angles)
    distance = np.abs(centres - corner)
    assert distance.min() >= 8.0 - 1e-9
    assert np.count_nonzero(distance < 8.0 + 1e-9) >= 4


@pytest.mark.parametrize("name", ["coursework", "arm", "measured", "flat", "undercut"])
def test_area_is_that_of_a_fine_polygon(name: str) -> None:
    cam = cams()[name]
    polygon = cam.trimmed_profile(40_000) @ [1, 1j]
    expected = abs(np.sum((polygon.conj() * np.roll(polygon, -1)).imag)) / 2
    outline = of_cam(cam)
    assert outline.area == pytest.approx(expected, rel=1e-6)


def test_the_table_begins_where_the_follower_stands_and_rises_with_it() -> None:
    for name in ("coursework", "arm", "flat"):
        rows: PolarTable = polar_table(of_cam(cams()[name]), PartTable())
        assert rows.radii[0] == pytest.approx(rows.radii.min())
        assert np.all(np.diff(rows.radii[:15]) > 0), "against the rotation the profile rises first"
