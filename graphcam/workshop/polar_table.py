"""The polar table of a working drawing: radii of profile and cutter's centre by the angle from the zero mark.

The rows stand a round step apart.  Where a straight line from row to row would leave the exact curve by more than a
stated part of the profile's tolerance, a step is divided, in a round number of parts, until it does not.  Every corner
has a row of its own.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.root_finding import roots
from graphcam.mechanism.kinematics import Complexes
from graphcam.tasks.part_table import PartTable
from graphcam.words import say
from graphcam.workshop.cam_part import profile_tolerance, radius_decimals
from graphcam.workshop.part_outline import Outline

CHORD_TOLERANCE_SHARE = 0.25
"""The maximum distance of a line between rows from the curve, as a part of the profile's tolerance."""
STEP_DIVISIONS = (1, 2, 5, 10, 20, 50, 100)
"""The numbers of equal parts into which a step may be divided."""
MAX_ROWS = 1500
"""The maximum number of rows, which a person may still read."""
CORNER_DECIMALS = 3
"""Decimals of the angle of a corner [degrees]."""
FILES_REMEDY = say("give a larger one; the files of the profile have the curve itself")
MIN_BACKWARD_ANGLE = 1e-12
"""The minimum angle [rad] by which a curve turns back; less is rounding."""


@dataclass(frozen=True, eq=False)
class PolarCurve:
    """The outline, or its parallel curve ``distance`` mm outside, as a radius over the angle from the zero mark.

    Raises
    ------
    DesignError : a ray from the axis meets the curve more than once
    """

    outline: Outline
    distance: float = 0.0

    def __post_init__(self) -> None:
        angles = self.angles
        back = np.flatnonzero(np.diff(angles) < -MIN_BACKWARD_ANGLE)
        if back.size:
            at = say("met more than once by the ray at {value:.1f} degrees", value=math.degrees(angles[back[0]]) % 360)
            limit = say("met once by every ray from the cam centre")
            raise DesignError("profile", at, limit, say("enlarge the prime radius"))

    @cached_property
    def _sampled(self) -> tuple[Floats, Complexes, NDArray[np.intp]]:
        """Dense parameters, points, and numbers of their spans, each (n,)."""
        samples = self.outline.sampled
        points = np.concatenate([points + self.distance * normals for _, points, normals in samples])
        number = np.repeat(np.arange(len(samples)), [at.size for at, *_ in samples])
        return np.concatenate([at for at, *_ in samples]), points, number

    @cached_property
    def angles(self) -> Floats:
        """Dense angles (n,) [rad], in order over one turn."""
        return np.unwrap(np.angle(self._sampled[1]))

    @cached_property
    def turn(self) -> tuple[Floats, Floats, Floats]:
        """Angles [deg] from before 0 to beyond 360, their radii [mm], and cosines of radius and normal, each (n,)."""
        _, points, _ = self._sampled
        normals = np.concatenate([normals for *_, normals in self.outline.sampled])
        lean = np.abs((points.conj() * normals).real) / np.abs(points)
        turn = np.degrees(self.angles) - 360 * np.floor(np.degrees(self.angles[0]) / 360)
        return np.concatenate([turn - 360, turn, turn + 360]), np.tile(np.abs(points), 3), np.tile(lean, 3)

    def radius(self, angle: Floats) -> Floats:
        """The radii [mm] at angles [rad] (n,) from the zero mark."""
        angles = self.angles
        at, _, number = self._sampled
        angle = angles[0] + (angle - angles[0]) % FULL_TURN
        before = np.clip(np.searchsorted(angles, angle, side="right") - 1, 0, angles.size - 2)
        radius = np.empty(angle.shape)
        for k in np.unique(number[before]).tolist():
            here = number[before] == k
            low, ray = before[here], np.exp(-1j * angle[here])
            # The last place of a span has no other behind it.
            high = np.where(number[low + 1] == k, low + 1, low)
            found = roots(lambda at, k=k, ray=ray: (self._point(k, at) * ray).imag, at[low], at[high])
            radius[here] = np.abs(self._point(k, found))
        return radius

    def _point(self, number: int, at: Floats) -> Complexes:
        span = self.outline.spans[number]
        return self.outline.as_seen(span.point(at) + self.distance * span.normal(at))


@dataclass(frozen=True, eq=False)
class PolarTable:
    """The polar table of an outline.

    angles : (n,) from the zero mark [deg], in the outline's sense;  radii : (n,) of the profile [mm]
    cutter : (n,) of the centre of the cutter at the same angles [mm]; None without a cutter
    wall : (n,) of the outer wall of a groove [mm]; None without one
    bound : the maximum distance of a straight line between rows from the curves, along their normals [mm]
    decimals : of the radii
    """

    angles: Floats
    radii: Floats
    cutter: Floats | None
    wall: Floats | None
    bound: float
    decimals: int


def polar_table(outline: Outline, table: PartTable, wall: Outline | None = None) -> PolarTable:
    """The table of an outline, with the step, the tolerance and the cutter that ``[part]`` names.

    wall : the outer wall of a groove

    Raises
    ------
    DesignError : the cutter is larger than a hollow of the profile, a ray from the axis meets the profile more than
        once, or the tolerance is too small for a table

    >>> import graphcam as gc
    >>> from graphcam.workshop.part_outline import of_cam
    >>> rows = polar_table(of_cam(gc.solve(gc.builtin_task()).cam), PartTable(table_step=10))
    >>> rows.angles[:4].tolist(), rows.radii[:4].round(2).tolist()
    ([0.0, 2.0, 4.0, 6.0], [27.0, 27.02, 27.08, 27.18])
    """
    curves = {"radii": PolarCurve(outline)} | ({"wall": PolarCurve(wall)} if wall else {})
    if table.cutter_radius is not None:
        outline.check_cutter(table.cutter_radius)
        curves["cutter"] = PolarCurve(outline, table.cutter_radius)
    allowed = profile_tolerance(table, outline.greatest_radius)
    bound = CHORD_TOLERANCE_SHARE * allowed
    corners = np.degrees(np.angle(outline.corners)) % 360
    angles = _rows([*curves.values()], table.table_step, bound, corners.round(CORNER_DECIMALS))
    if angles.size > MAX_ROWS:
        limit = say("large enough for a table of at most {most} rows, not {size}", most=MAX_ROWS, size=angles.size)
        raise DesignError("part.profile_tolerance", allowed, limit, FILES_REMEDY)
    radii = {name: curve.radius(np.radians(angles)) for name, curve in curves.items()}
    decimals = radius_decimals(table, outline.greatest_radius)
    return PolarTable(angles, radii["radii"], radii.get("cutter"), radii.get("wall"), bound, decimals)


def _rows(curves: list[PolarCurve], step: int, bound: float, corners: Floats) -> Floats:
    """The angles (n,) of the rows [deg], from 0 to below 360, one at each corner."""
    rows: list[Floats] = []
    for start in range(0, 360, step):
        inside = corners[(start < corners) & (corners < start + step)]
        divided = (np.union1d(start + step * np.arange(parts + 1) / parts, inside) for parts in STEP_DIVISIONS)
        near = (row for row in divided if max(_departure(row, *curve.turn) for curve in curves) <= bound)
        row = next(near, None)
        if row is None:
            limit = say("large enough for rows {value:g} degrees apart", value=step / STEP_DIVISIONS[-1])
            raise DesignError("part.profile_tolerance", bound / CHORD_TOLERANCE_SHARE, limit, FILES_REMEDY)
        rows.append(row[:-1])
    return np.concatenate(rows)


def _departure(row: Floats, angles: Floats, radii: Floats, lean: Floats) -> float:
    """The maximum distance of straight lines between the rows from the curve, along its normal [mm]."""
    inside = slice(*np.searchsorted(angles, [row[0], row[-1]]).tolist())
    straight = np.interp(angles[inside], row, np.interp(row, angles, radii))
    return float((lean[inside] * np.abs(radii[inside] - straight)).max(initial=0.0))
