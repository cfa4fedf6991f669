"""The assignment: what a task file says, as frozen dataclasses with the same keys and units (degrees, mm, rpm).

A table that stands for something of :mod:`graphcam.given` converts when it is called: ``task.motion.phases`` mirrors
the file, ``task.motion()`` is the :class:`~graphcam.given.motion.Motion` in radians.  So every value is checked where
it is given a meaning, once, whether it comes from a file or from Python.
"""

from __future__ import annotations

import dataclasses
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from textwrap import shorten
from typing import Annotated, Any, ClassVar, Literal, Self

from graphcam.errors import DesignError
from graphcam.given.follower import (
    FlatFaced,
    Follower,
    Limits,
    Oscillating,
    OscillatingFlat,
    Rotation,
    Translating,
    sense,
)
from graphcam.given.impact import NO_FORCE, velocity_jumps
from graphcam.given.laid_outline import GivenCamMotion
from graphcam.given.roller_rule import DEFAULT_RULE, Candidate, roller_rule
from graphcam.showing import MAX_WIDTH, value_text
from graphcam.tasks.dataclass_reader import ByKeys, ByKind
from graphcam.tasks.declared_numbers import About, Fixed, Ruled
from graphcam.tasks.material_table import MaterialTable
from graphcam.tasks.motion_tables import MotionTable
from graphcam.tasks.number_limits import Within, check_limits
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.sheet_tables import Format, SheetTable, TitleTable, plain_data
from graphcam.tasks.sizing_table import SizingTable
from graphcam.tasks.spring_tables import ArmSpringTable, SpringTable
from graphcam.tasks.tolerances_table import TolerancesTable
from graphcam.tasks.units import Length, PaperLength, PermittedAngle, Size, SizeOrZero, Speed, check_turning
from graphcam.words import Words, say

ANGLE_RANGE = Fixed(15.0, 60.0, 1.0)
"""Of permitted pressure angles [degrees]; beyond, a follower jams or needs no limit."""
MAX_DIVISIONS = 1000
"""The maximum number of parts of a phase; more cannot be drawn apart."""
Divisions = Annotated[int, Within(1, MAX_DIVISIONS, say("from 1 to {most} parts per phase", most=MAX_DIVISIONS))]
LARGER_RADIUS_REMEDY = say("or a larger cam.prime_radius")
NO_FACE_REMEDY = "a flat face square to its motion has no pressure angle; give limits.min_curvature_radius"

GIVEN_CAM_KEYS = {
    "roller radius": "follower.roller_radius",
    "offset": "follower.offset",
    "centre distance": "follower.distance",
    "base_radius": "arcs.base_radius",
    "flank_radius": "arcs.flank_radius",
    "tolerance": "motion.tolerance",
}
"""The keys of what a follower of a given cam may lack, by their quantities."""
SWINGING_FACE_REMEDY = "under a face that swings the curvature limits the cam; give limits.min_curvature_radius"


class _FollowerTable(ABC):
    """The properties of ``[follower]`` that a task uses; each kind states what differs from a stem with a roller."""

    roller_radius: float | None
    without: ClassVar[Mapping[str, str]] = {}
    """The limits that this follower does not have, each with the remedy."""
    swings: ClassVar[bool] = False
    """Whether the follower turns about a pivot, so that its spring exerts a moment."""
    drawn_on_given_cam: ClassVar[bool] = True
    """Whether the drawing analyses what a given cam does to it."""
    sought: ClassVar[tuple[str, ...]] = ()
    """The sizes for which ranges may be given; a follower without any cannot be sized."""
    takes_corners: ClassVar[bool] = True
    """Whether it runs over a corner of the cam; a flat face can touch none."""
    made_to: ClassVar[tuple[str, ...]] = ("roller_diameter", "offset")
    """The sizes of this kind of follower that may have a tolerance."""
    roller_rule: str

    def __post_init__(self) -> None:
        self()
        check_limits(self)
        roller_rule(self.roller_rule)

    @abstractmethod
    def __call__(self) -> Follower:
        """The follower."""

    @property
    def made_sizes(self) -> tuple[str, ...]:
        """The sizes that may have a tolerance on this follower: a knife edge has no roller."""
        return tuple(name for name in self.made_to if name != "roller_diameter" or self.roller_radius != 0)

    @property
    def placed(self) -> Self:
        """The table with its place on a given cam: a stem whose offset is open is central."""
        return self

    @property
    def lift_unit(self) -> float:
        """The unit of the phases' lift in the API: 1 mm, or a degree [rad]."""
        return math.radians(1) if self.swings else 1.0

    @property
    def column(self) -> str:
        """The name of the column of displacements in a measured table."""
        return "s_deg" if self.swings else "s_mm"

    def check(self, prime_radius: float) -> None:
        """Refuse sizes that leave no room on a given prime radius [mm], whatever the motion."""
        if (self.roller_radius or 0.0) >= prime_radius:
            limit = say("less than the prime radius of {prime_radius:g} mm", prime_radius=prime_radius)
            remedy = say("take a smaller roller {or_larger}", or_larger=LARGER_RADIUS_REMEDY)
            raise DesignError("follower.roller_radius", self.roller_radius, limit, remedy)


@dataclass(frozen=True)
class TranslatingTable(_FollowerTable):
    """``[follower]`` of kind "translating", a stem.

    offset : mm, of the follower's line to the right of the cam centre; 0 for a central follower; left out: found with
        the minimum radius
    roller_radius : mm, 0 for a knife edge; left out: chosen by the rule
    roller_rule : "K rho", "K r0", "rho - MM" or min(..., ...) of these: rho is the minimum radius of curvature of the
        pitch curve, r0 the prime radius; or a name: "coursework" is min(0.65 rho, 0.4 r0), "coursework-prime-radius"
        0.45 r0, "gorbenko" 0.7 rho, "least-profile-radius" rho - 5, "norton" 0.33 rho
    """

    offset: Annotated[Length | None, say("Offset e"), Ruled()] = None
    roller_radius: Annotated[SizeOrZero | None, say("Roller radius r"), Ruled()] = None
    roller_rule: str = DEFAULT_RULE
    kind: Literal["translating"] = "translating"
    sought = "offset", "roller_radius"

    def __call__(self) -> Translating:
        """The follower; an open offset and an open roller radius are 0: a central follower, a knife edge."""
        return Translating(self.offset or 0.0, self.roller_radius or 0.0)

    @property
    def placed(self) -> Self:
        """The table with an offset."""
        return replace(self, offset=self.offset or 0.0)

    def check(self, prime_radius: float) -> None:
        """Refuse sizes that leave no room on a given prime radius [mm], the offset first."""
        if abs(self.offset or 0.0) >= prime_radius:
            limit = say("less than the prime radius of {prime_radius:g} mm in magnitude", prime_radius=prime_radius)
            remedy = say("take a smaller offset {or_larger}", or_larger=LARGER_RADIUS_REMEDY)
            raise DesignError("follower.offset", self.offset, limit, remedy)
        super().check(prime_radius)


@dataclass(frozen=True)
class OscillatingTable(_FollowerTable):
    """``[follower]`` of kind "oscillating", an arm.

    The arm's pivot lies to the right of the cam centre, level with it, and the arm above the line through both. A rise
    always turns the arm clockwise: with rotation = "ccw" arm and cam turn in opposite senses on the rise, with "cw" in
    the same sense. An ordinary rise has a positive pressure angle with "ccw" and a negative one with "cw"; limits bound
    its magnitude.

    arm : mm, its length
    distance : mm, from the cam centre to the pivot; left out: found with the prime radius
    roller_radius : mm, as of a translating follower
    roller_rule : as of a translating follower
    lift : of the phases: "angle" in degrees, or "arc" in mm along the arc of the arm's end
    """

    arm: Annotated[Size, say("Arm length l"), Ruled()]
    distance: Annotated[Size | None, say("Centre distance c"), Ruled()] = None
    roller_radius: Annotated[SizeOrZero | None, say("Roller radius r"), Ruled()] = None
    roller_rule: str = DEFAULT_RULE
    lift: Literal["angle", "arc"] = "angle"
    kind: Literal["oscillating"] = "oscillating"
    swings = True
    made_to = "roller_diameter", "distance", "arm"

    @property
    def lift_unit(self) -> float:
        """The unit of the phases' lift [rad]: a degree, or a mm of arc."""
        return math.radians(1) if self.lift == "angle" else 1 / self.arm

    @property
    def column(self) -> str:
        """The name of the column of displacements in a measured table."""
        return "s_deg" if self.lift == "angle" else "s_mm"

    def __call__(self) -> Oscillating:
        """The follower; an open roller radius is 0: a knife edge."""
        return Oscillating(self.arm, self.distance, self.roller_radius or 0.0)


@dataclass(frozen=True)
class FlatFacedTable(_FollowerTable):
    """``[follower]`` of kind "flat-faced", a face square to its motion.

    face_margin : mm, of the face beyond the contact, on each side; the face is then rounded up; left out: no face
    """

    face_margin: SizeOrZero | None = None
    kind: Literal["flat-faced"] = "flat-faced"
    takes_corners = False
    roller_radius = 0.0
    roller_rule = DEFAULT_RULE
    made_to = ()
    without: ClassVar = {"pressure_angle_rise": NO_FACE_REMEDY, "pressure_angle_return": NO_FACE_REMEDY}

    def __call__(self) -> FlatFaced:
        """The follower."""
        return FlatFaced()


@dataclass(frozen=True)
class OscillatingFlatTable(_FollowerTable):
    """``[follower]`` of kind "oscillating-flat", a flat face on a pivot.

    Its pivot lies where an arm's would; the lifts of the phases are in degrees; a rise turns it clockwise.

    distance : mm, from the cam centre to the pivot; must be given
    face_offset : mm, of the face from the line through the pivot, towards the cam centre if positive
    """

    distance: Annotated[Size, say("Centre distance c"), Ruled()]
    face_offset: Annotated[Length, say("Face offset f"), Ruled()] = 0.0
    kind: Literal["oscillating-flat"] = "oscillating-flat"
    takes_corners = False
    roller_radius = 0.0
    roller_rule = DEFAULT_RULE
    swings = True
    drawn_on_given_cam = False
    made_to = ("distance",)
    without: ClassVar = {"pressure_angle_rise": SWINGING_FACE_REMEDY, "pressure_angle_return": SWINGING_FACE_REMEDY}

    def __post_init__(self) -> None:
        check_limits(self)
        self()

    def __call__(self) -> OscillatingFlat:
        """The follower."""
        return OscillatingFlat(self.distance, self.face_offset)

    def check(self, prime_radius: float) -> None:
        """Refuse a pivot that the face on a given prime radius [mm] cannot have."""
        together = prime_radius + self.face_offset
        if not together > 0:
            limit = say(
                "greater than {least:g} mm, so that the line through the pivot passes above A", least=-prime_radius
            )
            remedy = say("bring the face nearer to its pivot or take a larger cam.prime_radius")
            raise DesignError("follower.face_offset", self.face_offset, limit, remedy)
        if not together < self.distance:
            limit = say("greater than {sum:g} mm, the prime radius and the face offset together", sum=together)
            remedy = say("move the pivot away or take a smaller cam.prime_radius")
            raise DesignError("follower.distance", self.distance, limit, remedy)


FollowerTable = Annotated[TranslatingTable | OscillatingTable | FlatFacedTable | OscillatingFlatTable, ByKind()]
FOLLOWER_TABLES: dict[str, type[_FollowerTable]] = {
    table.kind: table for table in (TranslatingTable, OscillatingTable, FlatFacedTable, OscillatingFlatTable)
}
"""The tables of the followers by their kind."""


def table_of(follower: Mapping[str, Any]) -> type[_FollowerTable]:
    """The table of a follower as a file says it, whether it is right or not; the first where its kind is unknown.

    >>> table_of({"kind": "flat-faced"}).__name__, table_of({"kind": 3}).__name__
    ('FlatFacedTable', 'TranslatingTable')
    """
    kind = follower.get("kind")
    return FOLLOWER_TABLES.get(kind, TranslatingTable) if isinstance(kind, str) else TranslatingTable


@dataclass(frozen=True)
class CamTable:
    """``[cam]``: its size.

    prime_radius : mm, of the pitch curve in the lower dwell; left out: the minimum, rounded up
    """

    prime_radius: Annotated[Size | None, say("Prime radius r₀"), Ruled()] = None

    def __post_init__(self) -> None:
        check_limits(self)


@dataclass(frozen=True)
class LimitsTable:
    """``[limits]``: what the cam must satisfy.

    pressure_angle_rise : degrees, maximum pressure angle on a rise; left out: 30, for an arm 45
    pressure_angle_return : degrees, on a return; left out: force closure, where a spring drives the return
    min_curvature_radius : mm, of the working profile, convex parts only under a roller; left out: no limit
    rest : whether the limits also hold for the pressure angle in the lower dwell
    """

    pressure_angle_rise: Annotated[PermittedAngle | None, say("Permitted pressure angle, rise"), ANGLE_RANGE] = None
    pressure_angle_return: Annotated[PermittedAngle | None, say("Permitted pressure angle, return"), ANGLE_RANGE] = None
    min_curvature_radius: Annotated[
        Size | None, say("Minimum radius of curvature of the profile"), Fixed(0.5, 50.0, 0.5)
    ] = None
    rest: bool = True

    def __post_init__(self) -> None:
        self()
        check_limits(self)

    def __call__(self) -> Limits:
        """The permitted pressure angles in radians."""
        rise, back = self.pressure_angle_rise, self.pressure_angle_return
        given = {} if rise is None else {"rise": math.radians(rise)}
        return Limits(return_=None if back is None else math.radians(back), rest=self.rest, **given)


@dataclass(frozen=True)
class DrawingTable(SheetTable):
    """``[drawing]``: divisions, scales and rounding of the constructions, and the sheet.

    divisions : equal parts per phase; of a measured motion, stations lie on rows if this divides a phase's steps; left
        out: 12, and up to 48 in a phase whose acceleration lasts less than such a part
    ordinate : mm on paper, the maximum ordinate of the first rise's acceleration; left out: the longest round one at
        which the whole diagram suits the sheet
    poles : mm on paper, pole distances of the integrations, acceleration to velocity and on to lift; left out: 40 where
        a degree is a millimetre (A1), less in proportion, or what suits the sheet
    rounding : mm, adopted sizes are rounded to multiples of it; left out: a tenth of r0 or less, at most 1
    jerk : whether the jerk is drawn too, by differentiation of the acceleration diagram
    profile_scale : a standard scale at which the cam's profile is drawn; left out: the largest that
        suits the sheet
    whole_turn : whether the diagrams show the whole turn to scale; left out: long dwells are broken and the scale is
        finer where parts would be narrower than 5 mm
    """

    divisions: Annotated[Divisions | None, say("Divisions of a phase"), Fixed(4, 36, 1)] = None
    ordinate: Annotated[PaperLength | None, say("Maximum ordinate of the first rise"), Ruled()] = None
    poles: (
        tuple[
            Annotated[PaperLength, say("Pole distance H₁"), Fixed(10.0, 80.0, 1.0)],
            Annotated[PaperLength, say("Pole distance H₂"), Fixed(10.0, 80.0, 1.0)],
        ]
        | None
    ) = None
    rounding: Size | None = None
    jerk: bool = False
    profile_scale: str | None = None
    whole_turn: bool = False

    def on(self, format_: Format) -> Self:
        """The table for another format; ordinate, poles and scale are left open, as the given ones suit this one.

        >>> DrawingTable("A1", ordinate=50, poles=(40, 40)).on("A3").ordinate is None
        True
        """
        return replace(super().on(format_), ordinate=None, poles=None, profile_scale=None)


@dataclass(frozen=True)
class Task:
    """A design task, with the tables of its file.

    rotation : sense in which the cam turns, "cw" or "ccw"
    speed_rpm : rpm, speed of the cam; left out: velocities and accelerations per radian of the cam

    Raises
    ------
    DesignError : an impossible value, alone or together with another

    >>> import graphcam as gc
    >>> from graphcam.tasks.motion_tables import ReturnTable, RiseTable
    >>> phases = (RiseTable(120, 30, "3-4-5"), ReturnTable(240, 30, "cosine"))
    >>> task = gc.Task("ccw", MotionTable(phases), TranslatingTable(offset=10))
    >>> task.motion().lift, task.follower().offset, round(task.limits().rise, 6)
    (30.0, 10, 0.523599)
    """

    rotation: Rotation
    motion: MotionTable
    follower: FollowerTable
    speed_rpm: Annotated[Speed | None, say("Speed"), About(300.0)] = None
    title: TitleTable = field(default_factory=TitleTable)
    cam: CamTable = field(default_factory=CamTable)
    limits: LimitsTable = field(default_factory=LimitsTable)
    spring: Annotated[SpringTable | ArmSpringTable, ByKeys()] | None = None
    material: MaterialTable | None = None
    tolerances: TolerancesTable | None = None
    sizing: SizingTable | None = None
    drawing: DrawingTable = field(default_factory=DrawingTable)
    part: PartTable | None = None

    def __repr__(self) -> str:
        cam = "given by" if self.motion.gives_cam else "measured,"
        other = f"{cam} {self.motion.table.file}" if self.motion.table else ""
        other = other or ", ".join(f"{part.kind} of {len(part.points)} points" for part in self.motion.parts or ())
        other = other or ("given by its radii" if self.motion.radii else "")
        phases = ", ".join(f"{phase.kind} {phase.angle:g}°" for phase in self.motion.phases or ())
        turns = f"turns {self.rotation}" + (f" at {self.speed_rpm:g} rpm" if self.speed_rpm else "")
        rows = f"{turns}, {self.follower.kind} follower", shorten(other or phases, MAX_WIDTH, placeholder=" ...")
        return value_text(f"Task {self.title.name!r}", rows, "gc.solve(task) designs the cam; .to_dict() tells all")

    def __post_init__(self) -> None:
        sense(self.rotation)
        check_limits(self)
        self._inform_tables()
        self._check_limits()
        if self.cam.prime_radius is not None:
            self.follower.check(self.cam.prime_radius)
        self._check_spring()
        if self.tolerances is not None:
            self.tolerances.check(self.follower.kind, self.follower.made_sizes)
        if self.material is not None and self.spring is None:
            reason = say("without a force there is no contact stress")
            raise DesignError("spring", say("missing"), say("given where there is a material"), reason)
        self._check_sizing()
        self._check_blows()

    def _check_blows(self) -> None:
        """Refuse what a velocity that jumps leaves no sense."""
        motion = self.motion()
        if self.drawing.jerk and motion.blows:
            limit = say("false where the velocity jumps")
            raise DesignError("drawing.jerk", True, limit, say("there the acceleration itself is infinite"))
        if motion.corners and not self.follower.takes_corners:
            found = say(
                "a motion whose velocity falls at once at {phi:.6g} degrees", phi=math.degrees(motion.corners[0])
            )
            limit = say("one of continuous velocity for a follower of kind {kind}", kind=self.follower.kind)
            remedy = say("the cam has a corner there, which no flat face can touch: give law blends, or take a roller")
            raise DesignError("motion", found, limit, remedy)

    def _check_sizing(self) -> None:
        """Refuse ranges without the limits that they need, and sizes with neither a range nor a value."""
        if self.sizing is None:
            return
        if not self.follower.sought:
            left_out = say("left out for a follower of kind {kind}", kind=self.follower.kind)
            remedy = say("sizes are sought for a translating follower with a roller")
            raise DesignError("sizing", say("given"), left_out, remedy)
        if self.material is None or self.material.permitted_stress is None:
            remedy = say("give the stress [MPa] that cam and roller last under, and a [spring]")
            found = say("missing")
            raise DesignError("material.permitted_stress", found, say("given where there is a [sizing]"), remedy)
        for name in self.follower.sought:
            if getattr(self.sizing, name) is None and getattr(self.follower, name) is None:
                remedy = say("or give follower.{name}", name=name)
                raise DesignError(f"sizing.{name}", say("missing"), say("given as a range in mm"), remedy)
        if self.sizing.roller_radius is None and not self.follower.roller_radius:
            remedy = say("a knife edge has no stress that could be kept")
            raise DesignError("follower.roller_radius", 0.0, say("greater than 0 mm where there is a [sizing]"), remedy)
        if not self.limits.rest:
            remedy = say("a range of offsets needs the limit in the lower dwell")
            raise DesignError("limits.rest", False, say("true where there is a [sizing]"), remedy)

    def _check_spring(self) -> None:
        if self.spring is None:
            return
        if self.speed_rpm is None:
            limit = say("given where there is a spring")
            raise DesignError("speed_rpm", say("missing"), limit, say("the force of inertia grows with the speed"))
        if velocity_jumps(self.motion()):
            raise DesignError("spring", say("given"), say("left out where the velocity jumps"), NO_FORCE)
        if self.follower.swings and not self.spring.swings:
            remedy = say("give spring.inertia in kg mm^2, about the pivot")
            raise DesignError("spring.mass", getattr(self.spring, "mass", None), say("left out for an arm"), remedy)
        if self.spring.swings and not self.follower.swings:
            left_out = say("left out for a follower of kind {kind}", kind=self.follower.kind)
            remedy = say("give spring.mass")
            raise DesignError("spring.inertia", getattr(self.spring, "inertia", None), left_out, remedy)

    def _check_limits(self) -> None:
        for key, reason in self.follower.without.items():
            left_out = say("left out for a follower of kind {kind}", kind=self.follower.kind)
            if (value := getattr(self.limits, key)) is not None:
                raise DesignError(f"limits.{key}", value, left_out, reason)

    def _inform_tables(self) -> None:
        """Set what a table takes from the follower: the unit of the lift, and the usual limits."""
        motion, column = dataclasses.replace(self.motion), self.follower.column
        object.__setattr__(motion, "lift_unit", self.follower.lift_unit)
        if motion.table is not None and motion.table.column not in (column, "a", "outline"):
            remedy = say("measure what the follower does, and name the column so")
            quantity = say("motion.table (column)")
            raise DesignError(quantity, motion.table.column, say("{column} for this follower", column=column), remedy)
        check_turning(motion, turning=column == "s_deg", path="motion")
        object.__setattr__(self, "motion", motion)
        if motion.gives_cam:
            self._inform_of_given_cam(motion)
        if self.limits.pressure_angle_rise is None and "pressure_angle_rise" not in self.follower.without:
            limits = dataclasses.replace(self.limits, pressure_angle_rise=self.follower().usual_limit_deg)
            object.__setattr__(self, "limits", limits)

    def _inform_of_given_cam(self, motion: MotionTable) -> None:
        """Set the follower that a given cam moves, and check that it has all its sizes and can follow."""
        if self.cam.prime_radius is not None:
            limit, remedy = say("left out where the cam is given"), say("it is the base radius and the roller together")
            raise DesignError("cam.prime_radius", self.cam.prime_radius, limit, remedy)
        if self.follower.roller_radius is None:
            limit = say("given where the cam is given")
            raise DesignError("follower.roller_radius", say("missing"), limit, say("0 is a knife edge"))
        if not self.follower.drawn_on_given_cam:
            limit = say("a stem, an arm, or a flat face on a stem where a given cam is drawn")
            remedy = say("take another follower, or in Python gc.outline_motion, which knows this one too")
            raise DesignError("follower.kind", self.follower.kind, limit, remedy)
        object.__setattr__(self, "follower", self.follower.placed)
        object.__setattr__(motion, "follows", (self.follower(), self.rotation))
        try:
            motion()
        except DesignError as error:
            key: Words = GIVEN_CAM_KEYS.get(str(error.quantity), "") or error.args[0]
            if motion.radii is None and str(key).startswith("arcs"):
                key = say("base radius")  # of the points, which no key gives
            raise DesignError(key, *error.args[1:]) from None

    @property
    def prime_radius(self) -> float | None:
        """The prime radius [mm] that is given, or that a given cam has; None is open."""
        motion = self.motion() if self.motion.gives_cam else None
        return motion.prime_radius if isinstance(motion, GivenCamMotion) else self.cam.prime_radius

    @property
    def roller_terms(self) -> tuple[Candidate, ...]:
        """The terms of the rule for the roller radius, and what the permitted curvature of the profile leaves.

        >>> import graphcam as gc
        >>> sharp = dataclasses.replace(gc.builtin_task(), limits=LimitsTable(min_curvature_radius=4.0))
        >>> [term.text for term in sharp.roller_terms]
        ['0.7 rho', '0.4 r0', 'rho - 4']
        """
        least = self.limits.min_curvature_radius
        profile = [] if least is None else [Candidate(f"rho - {least:g}", "rho", margin=least)]
        return (*roller_rule(self.follower.roller_rule), *profile)

    def to_dict(self) -> dict[str, Any]:
        """The task with the keys of its file, as plain lists, numbers and text; what is open is left out.

        >>> import graphcam as gc
        >>> from graphcam.tasks.motion_tables import ReturnTable, RiseTable
        >>> phases = (RiseTable(120, 30, "2-3"), ReturnTable(240, 30, "2-3"))
        >>> gc.Task("cw", MotionTable(phases), FlatFacedTable()).to_dict()["motion"]["phases"][0]
        {'kind': 'rise', 'angle': 120, 'lift': 30, 'law': '2-3', 'ratio': 1.0}
        """
        said = plain_data(self)
        if self.motion.table is not None:
            said["motion"]["table"] = self.motion.table.file
        return said
