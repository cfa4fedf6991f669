"""The table ``[motion]`` of a task file: phases in degrees and mm, parts by conditions, or a measured motion."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Literal

from graphcam.errors import DesignError
from graphcam.given.arc_loop import arc_loop
from graphcam.given.boundary_motion import BoundaryMotion, boundary_motion
from graphcam.given.boundary_parts import DERIVATIVE_NAMES, MotionPoint, PolynomialPart, SplinePart
from graphcam.given.cam_by_radii import ArcOutline, Straight, cam_by_radii
from graphcam.given.follower import FlatFaced, Follower, Rotation
from graphcam.given.laid_outline import GivenCamMotion
from graphcam.given.laws import canonical_law
from graphcam.given.motion import FULL_TURN, NEAR_TURN_SHARE, Dwell, Motion, Phase, Return, Rise
from graphcam.given.motion_law import Law
from graphcam.given.outline_motion import outline_motion
from graphcam.given.point_outline import cam_through_points
from graphcam.given.polynomial_law import CONSTANT_VELOCITY, constant_velocity_law
from graphcam.given.table_file import CurveTable, Turn
from graphcam.tasks.dataclass_reader import ByKind, ByName
from graphcam.tasks.declared_numbers import About, Fixed
from graphcam.tasks.number_limits import Positive, Within, check_limits
from graphcam.tasks.units import (
    LIFT,
    Acceleration,
    Angle,
    Jerk,
    Length,
    Lift,
    PartOfTurn,
    PhaseAngle,
    PhaseLift,
    Velocity,
)
from graphcam.words import Words, say

ANGLE_CLOSURE = 1e-9
"""A sum of phase angles that misses a turn by no more [degrees] is a turn: rounding of the arithmetic."""
ROUNDED_CLOSURE = 1e-3
"""So much may be missing where the angles of a file were rounded [degrees]: the longest dwell takes it up."""

TWO_TURNS = 720.0
"""The maximum angle [degrees] at which a part may end, as a part may pass the end of the turn."""


AngleInMotion = Annotated[
    Angle,
    Within(
        0.0, TWO_TURNS, say("from 0 to {two_turns:g} degrees", two_turns=TWO_TURNS), say("count the cam angle from 0")
    ),
]


@dataclass(frozen=True)
class PointTable:
    """Conditions on the motion at a cam angle; what is left out is free.

    angle : degrees of the cam
    s : mm (degrees for an arm), the lift there
    v : mm/rad (deg/rad for an arm), its first derivative by the cam angle
    a : mm/rad^2 (deg/rad^2 for an arm), its second
    j : mm/rad^3 (deg/rad^3 for an arm), its third
    """

    angle: AngleInMotion
    s: Lift | None = None
    v: Velocity | None = None
    a: Acceleration | None = None
    j: Jerk | None = None

    def __post_init__(self) -> None:
        check_limits(self)
        self()

    def __call__(self, unit: float = 1.0) -> MotionPoint:
        """The point in radians, its values times ``unit`` (radians per degree for an arm, else 1)."""
        values = {name: None if (x := getattr(self, name)) is None else x * unit for name in DERIVATIVE_NAMES}
        return MotionPoint(math.radians(self.angle), **values)


@dataclass(frozen=True)
class PolynomialTable:
    """The polynomial through points, of the degree that all their conditions need.

    points : with conditions
    degree : left out: that of the conditions
    """

    points: tuple[PointTable, ...]
    degree: int | None = None
    kind: Literal["polynomial"] = "polynomial"

    def __post_init__(self) -> None:
        self()

    def __call__(self, unit: float = 1.0) -> PolynomialPart:
        """The part in radians, its values times ``unit``."""
        return _polynomial(self, unit)


@dataclass(frozen=True)
class SplineTable:
    """The B-spline of a degree through points.

    points : with conditions
    degree : of its pieces
    knots : degrees, of the inner knots; left out: they are chosen
    """

    points: tuple[PointTable, ...]
    degree: int = 5
    knots: tuple[AngleInMotion, ...] | None = None
    kind: Literal["spline"] = "spline"

    def __post_init__(self) -> None:
        check_limits(self)
        self()

    def __call__(self, unit: float = 1.0) -> SplinePart:
        """The part in radians, its values times ``unit``."""
        return _spline(self, unit)


PartOfMotion = Annotated[PolynomialTable | SplineTable, ByKind()]


# Kept, because a task asks for its motion in several places, and to solve for a part takes its time.


@lru_cache(maxsize=64)
def _polynomial(table: PolynomialTable, unit: float) -> PolynomialPart:
    return PolynomialPart([point(unit) for point in table.points], table.degree)


@lru_cache(maxsize=64)
def _spline(table: SplineTable, unit: float) -> SplinePart:
    knots = None if table.knots is None else tuple(map(math.radians, table.knots))
    return SplinePart([point(unit) for point in table.points], table.degree, knots)


@dataclass(frozen=True)
class DwellTable:
    """A phase of rest.

    angle : degrees of the cam
    """

    angle: PhaseAngle
    kind: Literal["dwell"] = "dwell"

    def __post_init__(self) -> None:
        check_limits(self)

    def __call__(self, unit: float = 1.0) -> Dwell:
        """The phase in radians; ``unit`` has no effect, since a dwell has no lift."""
        return Dwell(math.radians(self.angle))


@dataclass(frozen=True)
class _MovingTable:
    """A phase that moves the follower.

    angle : degrees of the cam
    lift : mm (degrees for an arm)
    law : "rectangular" (constant acceleration), "triangular", "cosine", "cycloidal", "trapezoidal",
        "modified-trapezoidal", "modified-sine", "2-3", "3-4-5", "4-5-6-7"; for a rise and a return without a dwell
        between "double-harmonic", "eighth-degree"; "constant-velocity" between two blends; a textbook's name does too:
        "SHM", "UARM", "parabolic", "uniform velocity"
    ratio : only for "rectangular", "triangular", "cycloidal", "modified-trapezoidal", "modified-sine": the first part's
        acceleration over the second's
    blends : only for "constant-velocity": the fractions of the phase that they take; left out: a quarter each; with
        [0, 0] the velocity jumps, which is the uniform velocity of the textbooks
    """

    angle: PhaseAngle
    lift: PhaseLift
    law: Annotated[str | Law, ByName()]
    ratio: float = 1.0
    blends: tuple[float, float] | None = None

    moves: ClassVar[type[Rise] | type[Return]]

    def __post_init__(self) -> None:
        check_limits(self)
        object.__setattr__(self, "law", canonical_law(self.law))
        if self.blends is not None and self.law != CONSTANT_VELOCITY:
            left_out = say("left out for the law '{law}'", law=getattr(self.law, "name", self.law))
            remedy = say("they are those of '{constant_velocity}'", constant_velocity=CONSTANT_VELOCITY)
            raise DesignError("blends", list(self.blends), left_out, remedy)
        self()

    def __call__(self, unit: float = 1.0) -> Rise | Return:
        """The phase in radians, its lift times ``unit`` (radians per degree for an arm, else 1)."""
        law = constant_velocity_law(*self.blends) if self.blends else canonical_law(self.law)
        return self.moves(self.lift * unit, math.radians(self.angle), law, self.ratio)


@dataclass(frozen=True)
class RiseTable(_MovingTable):
    """A rise of ``lift`` mm (degrees for an arm) over ``angle`` degrees, by a law of graphcam or of your own."""

    kind: Literal["rise"] = "rise"
    moves = Rise


@dataclass(frozen=True)
class ReturnTable(_MovingTable):
    """A return by ``lift`` mm (degrees for an arm) over ``angle`` degrees by a law."""

    kind: Literal["return"] = "return"
    moves = Return


PhaseTable = Annotated[RiseTable | DwellTable | ReturnTable, ByKind()]


@dataclass(frozen=True)
class RadiiTable:
    """``[arcs]``: in place of [motion] and [cam], a cam that is given by its radii, and whose motion is asked for.

    base_radius : mm, of the base circle
    flank_radius : mm, negative of a hollow flank; or "straight", a tangent cam
    nose_radius : mm; of flank_radius, nose_radius, lift and ascent three are given, of an eccentric cam lift alone
    lift : mm, from the base circle to the apex
    ascent : degrees from the start of the flank to the apex
    dwell : degrees for which the follower is held up
    """

    base_radius: Annotated[Length, say("Base radius"), About(30.0)]
    flank_radius: Annotated[Length | Straight | None, say("Flank radius"), About(60.0)] = None
    nose_radius: Annotated[Length | None, say("Nose radius"), About(20.0)] = None
    lift: Annotated[Length | None, say("Lift"), About(15.0)] = None
    ascent: Annotated[PartOfTurn | None, say("Angle of ascent"), Fixed(0.0, 180.0, 1.0)] = None
    dwell: Annotated[PartOfTurn, say("Upper dwell"), Fixed(0.0, 180.0, 1.0)] = 0.0

    def __post_init__(self) -> None:
        check_limits(self)
        self()

    def __call__(self) -> ArcOutline:
        """The outline of the cam."""
        ascent = None if self.ascent is None else math.radians(self.ascent)
        dwell = math.radians(self.dwell)
        return cam_by_radii(self.base_radius, self.flank_radius, self.nose_radius, self.lift, ascent, dwell)


@dataclass(frozen=True)
class OutlineTable:
    """``[outline]``: in place of [motion], [arcs] and [cam], points of a cam are given, as it lies at the cam angle 0.

    file : a table with the columns x_mm,y_mm from the cam centre, or angle_deg,radius_mm, in any unit; or a drawing,
        "cam.dxf"; where it is of arcs and lines, the motion is exact
    tolerance : mm, how far the follower may pass the points; about 4.5 times the scatter of a measured cam
    layer : of a drawing with several closed loops; left out: the only one
    """

    file: str
    tolerance: Length = 0.01
    layer: str | None = None


@dataclass(frozen=True)
class MotionTable:
    """``[motion]``: the follower's motion over one revolution, by phases, by conditions, or as it was measured.

    phases : one after another, each a "rise", "dwell" or "return"; their angles sum to 360 degrees, their rises and
        returns to 0; what rounding leaves, less than 0.001 degrees, the longest dwell takes up
    table : of a measured motion, in place of phases: a CSV file beside this one; its header is phi_deg,s_mm (of an arm
        phi_deg,s_deg) or phi_deg,a (accelerations, mm per rad^2), its rows cover one turn; phi_rad, s_in and s_thou
        (inches, thousandths) are read too
    tolerance : mm (degrees for an arm), by which the motion may miss a row: 4.5 times their scatter (sd) or more, which
        is 1.5 times an error that is told as 3 sigma; left out: 0.01
    parts : polynomials and splines through points with conditions, in place of phases; where they leave a gap the
        follower dwells
    radii : of a given cam, in place of phases; a file gives them as a table ``[arcs]``
    symmetric : whether the table is half of the cam, which goes back in mirror image and dwells for the rest of the
        turn
    per_cam_degree : degrees of the table for one of the cam, 2 for crank degrees of a four-stroke engine; left out: 1

    ``lift_unit`` is what one unit of lift is in the API: 1 mm, or for an arm 1 degree or 1 mm of arc in radians; it and
    ``follows``, the follower that a given cam moves and its sense of rotation, are set by the task.
    """

    phases: tuple[PhaseTable, ...] | None = None
    table: CurveTable | None = None
    tolerance: Annotated[Lift | None, say("Tolerance of the fit"), Fixed(0.002, 0.2, 0.001)] = None
    parts: tuple[PartOfMotion, ...] | None = None
    radii: RadiiTable | None = None
    symmetric: bool | None = None
    per_cam_degree: Annotated[float, Positive("degrees")] | None = None
    lift_unit: float = field(default=1.0, init=False, repr=False, compare=False)
    follows: tuple[Follower, Rotation] = field(default=(FlatFaced(), "ccw"), init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        table = self.table and self.table.file
        ways = {"phases": self.phases, "table": table, "parts": self.parts, "radii": self.radii}
        given = [name for name, value in ways.items() if value is not None]
        if not given:
            raise DesignError("phases", say("missing"), say("given"))
        if len(given) > 1:
            limit = say("left out where there are phases")
            if given[0] == "table":
                limit = say("left out where there is a table")
            raise DesignError(given[1], ways[given[1]], limit, say("give one of the two"))
        if self.tolerance is not None and self.table is None:
            left_out = say("left out where there is no table")
            raise DesignError("tolerance", self.tolerance, left_out, say("{given} are kept exactly", given=given[0]))
        check_limits(self)
        for name, value in (("symmetric", self.symmetric), ("per_cam_degree", self.per_cam_degree)):
            if value is not None and (self.table is None or self.gives_cam):
                raise DesignError(name, value, say("left out where there is no table"), say("delete it"))
        if self.phases is not None:
            if not self.phases:
                raise DesignError("phases", say("an empty list"), say("a list with a rise and a return"))
            turn = math.fsum(phase.angle for phase in self.phases)
            if abs(turn - 360) > ROUNDED_CLOSURE:
                raise DesignError(say("sum of the phase angles"), turn, say("360 degrees"), _remedy(turn, self.phases))
        if not self.gives_cam:
            self()

    @property
    def gives_cam(self) -> bool:
        """Whether a cam is given, of which the motion is asked for."""
        return self.radii is not None or (self.table is not None and self.table.column == "outline")

    @property
    def closed(self) -> tuple[int, float] | None:
        """The phase that takes up what rounded angles leave of the turn, and how much [degrees]; None if nothing.

        >>> thirds = RiseTable(120, 30, "2-3"), DwellTable(119.9999), ReturnTable(120, 30, "2-3")
        >>> number, missing = MotionTable(thirds).closed
        >>> number, round(missing, 6)
        (1, 0.0001)
        """
        return _closed(self.phases or ())

    def __call__(self) -> Motion:
        """The motion, in radians and mm (an arm's lift in radians too)."""
        if self.gives_cam and (cam := self.radii or self.table):
            return _of_given_cam(cam, self.tolerance, *self.follows)
        if self.table is not None:
            return self.table(self.tolerance, self.lift_unit, Turn(bool(self.symmetric), self.per_cam_degree or 1.0))
        if self.parts is not None:
            return _by_conditions(self.parts, self.lift_unit)
        return _motion(tuple(self.phases or ()), self.lift_unit)


def tolerance_in(motion: Mapping[str, Any]) -> float | None:
    """The tolerance in a file's table ``[motion]``; None where there is none, or no number.

    >>> tolerance_in({"tolerance": "5 um"}), tolerance_in({"tolerance": "small"})
    (0.005, None)
    """
    said = motion.get("tolerance")
    read = LIFT.number(said) if isinstance(said, str) else said
    return read if isinstance(read, int | float) else None


def _remedy(turn: float, phases: tuple[PhaseTable, ...]) -> Words:
    """The remedy for phase angles [degrees] whose sum ``turn`` is not 360."""
    if abs(turn - FULL_TURN) < NEAR_TURN_SHARE * FULL_TURN:
        return say("about 2 pi: give the angles in degrees, not in radians")
    off, dwells = f"{abs(360 - turn):.10g}", [isinstance(phase, DwellTable) for phase in phases]
    which = say("a dwell") if any(dwells) or not phases else say("a phase")
    if turn > 360:
        return say("{off} deg are too many: shorten {which}", off=off, which=which)
    if dwells and dwells[-1]:
        return say("{off} deg are missing: lengthen {which}", off=off, which=which)
    told = say('{off} deg are missing: add {{ kind = "dwell", angle = {off} }} at the end, or lengthen {which}')
    return told.with_values(off=off, which=which)


def _closed(tables: tuple[PhaseTable, ...]) -> tuple[int, float] | None:
    missing = 360 - math.fsum(table.angle for table in tables)
    if not tables or abs(missing) <= ANGLE_CLOSURE:
        return None
    # Without a dwell the longest phase takes it up.
    return max(range(len(tables)), key=lambda k: (tables[k].kind == "dwell", tables[k].angle)), missing


@lru_cache(maxsize=16)  # because a task asks for its motion in several places
def _motion(tables: tuple[PhaseTable, ...], unit: float) -> Motion:
    closed = list(tables)
    if closing := _closed(tables):
        k, missing = closing
        closed[k] = replace(closed[k], angle=closed[k].angle + missing)
    phases: list[Phase] = [table(unit) for table in closed]
    return Motion(phases)


@lru_cache(maxsize=16)
def _of_given_cam(
    cam: RadiiTable | CurveTable, tolerance: float | None, follower: Follower, rotation: Rotation
) -> GivenCamMotion:
    if isinstance(cam, RadiiTable):
        return outline_motion(cam(), follower, rotation)
    outline = cam_through_points(cam.rows)
    loop = arc_loop(outline.points) if tolerance is None or tolerance > 0 else None
    if loop is not None:
        return outline_motion(loop, follower, rotation)
    return outline_motion(outline, follower, rotation, tolerance)


@lru_cache(maxsize=16)
def _by_conditions(tables: tuple[PartOfMotion, ...], unit: float) -> BoundaryMotion:
    return boundary_motion([table(unit) for table in tables])
