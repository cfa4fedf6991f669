"""The contents of the working drawing: the part, its exact outline, its polar table, notes, and the title block."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphcam.constructions.axes import degrees, sense_caption
from graphcam.drafting.scale import ratio_text
from graphcam.errors import DesignError
from graphcam.given.follower import Rotation
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.conjugate_cam import ConjugateCam
from graphcam.sheets.sheet_frame import TitleBlock
from graphcam.sheets.tables import Table
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.tasks.part_table import PartTable
from graphcam.words import Caption, Tell, Words, say
from graphcam.workshop.cam_part import CamPart, cam_part, radius_decimals
from graphcam.workshop.part_outline import Groove, Outline, of_cam, outline_of
from graphcam.workshop.part_views import size
from graphcam.workshop.polar_table import PolarTable, polar_table


@dataclass(frozen=True, eq=False)
class PartContents:
    """The cam of a solution as a part: what its drawing and its files contain.

    Each is computed when it is first used, since the G-code needs no bore, and the solid no table.

    second : whether it is the second cam of a conjugate pair

    >>> import graphcam as gc
    >>> contents = PartContents(gc.solve(gc.builtin_task()))
    >>> contents.part.bore, contents.table.bound
    (28.0, 0.0125)
    """

    solution: AnySolution
    second: bool = False

    @property
    def given(self) -> PartTable:
        """The table ``[part]`` of the task."""
        return self.solution.task.part or PartTable()

    @cached_property
    def cam(self) -> Cam | ConjugateCam | None:
        """The cam; None of three arcs.

        Raises
        ------
        DesignError : as for :func:`second_cam`
        """
        first = None if isinstance(self.solution, ArcsSolution) else self.solution.cam
        return second_cam(self.solution) if self.second else first

    @cached_property
    def outline(self) -> Outline:
        """The exact profile; the second cam of a pair has the zero mark of the first, so that one key times both.

        Raises
        ------
        DesignError : no profile can be cut
        """
        first = outline_of(self.solution)
        return replace(of_cam(self.cam), zero=first.zero) if self.second and self.cam else first

    @cached_property
    def groove(self) -> Groove | None:
        """The groove in which the roller runs, if the task gives one.

        Raises
        ------
        DesignError : there is no roller, or none that fits the hollows of its path
        """
        if self.given.groove_depth is None:
            return None
        cam = _cam_with_roller(self.solution, "part.groove_depth")
        return Groove(self.given.groove_depth, replace(of_cam(cam, cam.outer_wall), zero=self.outline.zero))

    @property
    def reach(self) -> float:
        """The maximum radius of the part [mm]."""
        return self.groove.disk_radius if self.groove else self.outline.greatest_radius

    @property
    def mass(self) -> float:
        """The mass of the part [kg]."""
        if self.groove is None:
            return self.part.mass(self.outline.area)
        hollow = (self.groove.wall.area - self.outline.area) * self.groove.depth * self.given.density * 1e-9
        return self.part.mass(math.pi * self.groove.disk_radius**2) - hollow

    @cached_property
    def part(self) -> CamPart:
        """The sizes of the part, as :func:`~graphcam.workshop.cam_part.cam_part` settles them.

        Raises
        ------
        DesignError : the part is impossible
        """
        # Both cams of a pair stand on one shaft.
        pair = [self, replace(self, second=not self.second)] if self.given.second_roller else [self]
        part = cam_part(self.given, self.frame, min(each.outline.least_radius for each in pair))
        if self.groove and not self.groove.depth < part.width:
            limit = say("less than the cam's width of {width:g} mm", width=part.width)
            raise DesignError("part.groove_depth", self.groove.depth, limit, say("give a larger part.width"))
        return part

    @cached_property
    def table(self) -> PolarTable:
        """The polar table of the outline.

        Raises
        ------
        DesignError : as for :func:`~graphcam.workshop.polar_table.polar_table`
        """
        return polar_table(self.outline, self.given, self.groove and self.groove.wall)

    @property
    def frame(self) -> str:
        """The frame of the sheet, which also chooses the standards."""
        return self.solution.task.drawing.frame

    @property
    def tell(self) -> Tell:
        """Translates texts into the language of the task."""
        return self.solution.tell

    def check(self) -> None:
        """Refuse a part of which there can be no working drawing.

        Raises
        ------
        DesignError : as for outline, part and table, or it weighs next to nothing
        """
        _ = self.part, self.table
        if self.mass < MIN_MASS:
            limit = say("at least {least:g} kg", least=MIN_MASS)
            found = say("{mass:.1g} kg", mass=self.mass)
            raise DesignError(say("mass of the cam"), found, limit, say("check the units of its sizes"))
        if self.given.second_roller is not None and not self.second:
            replace(self, second=True).check()

    def title(self, scale: float) -> TitleBlock:
        """The title block of the part, with the drawing's scale."""
        given, tell = self.solution.task.title, self.tell
        mass, usual = self.mass, say("Second cam") if self.second else say("Cam")
        # Three digits at least, and no powers of ten.
        decimals = max(0, 2 - math.floor(math.log10(mass)))
        told = say("{mass:.{decimals}f}") if self.frame == "gost" else say("{mass:.{decimals}f} kg")
        return TitleBlock(
            name=f"{self.given.name} 2" if self.given.name and self.second else self.given.name or tell(usual),
            number=f"{self.given.number}-2" if self.given.number and self.second else self.given.number or "",
            table="part",
            organisation=given.organisation,
            group=given.group,
            author=given.author,
            checked=given.checked,
            material=tell(self.part.material),
            mass=tell(told.with_values(mass=mass, decimals=decimals)),
            scale=tell(ratio_text(1 / scale)),
            remark=self.solution.task.drawing.remark,
        )


DEFAULT_DEPTH = say("1.2...1.6 mm")
"""The depth of hardening that is usual for induction."""
MIN_MASS = 0.001
"""The minimum mass of a cam [kg]: a lighter one is a slip of units, or is made otherwise than by this drawing."""
REFERENCE_NOTE = say("* Dimensions for reference.")
"""What GOST 2.307 has said of the sizes with an asterisk; in ISO 129-1 they stand in brackets."""
GENERAL_TOLERANCES = {
    "iso": say("General tolerances ISO 2768-mK."),
    "gost": say("General tolerances GOST 30893.1: H14, h14, ±IT14/2."),
}
"""The note on sizes without a tolerance, by the frame."""
MAX_PHASES = 8
"""The maximum number of phases that the table of data names."""
PHASE_NAMES = {"rise": say("rise"), "dwell": say("dwell"), "return": say("return")}


def second_cam(solution: AnySolution) -> ConjugateCam | None:
    """The second cam of a conjugate pair, if the task's part names its roller.

    Raises
    ------
    DesignError : the follower has no roller, or the second one does not hold it back, or is too large
    """
    given = solution.task.part or PartTable()
    if given.second_roller is None:
        return None
    cam = _cam_with_roller(solution, "part.second_roller")
    radius = cam.roller_radius if given.second_roller_radius is None else given.second_roller_radius
    try:
        return ConjugateCam(cam, given.second_roller, radius)
    except DesignError as error:
        name = {"at": "part.second_roller", "roller_radius": "part.second_roller_radius"}[error.quantity]
        raise DesignError(name, *error.args[1:]) from None


def _cam_with_roller(solution: AnySolution, key: str) -> Cam:
    """The cam of a solution whose follower has a roller; the key of the part is of no use without one."""
    if isinstance(solution, ArcsSolution) or not solution.cam.roller_radius:
        limit = say("left out, except for a cam with a roller that is given by a motion")
        raise DesignError(key, say("given"), limit, say("delete it"))
    return solution.cam


def requirements(contents: PartContents) -> list[Caption]:
    """The technical requirements: the notes above the title block."""
    part, outline = contents.part, contents.outline
    return [
        *([REFERENCE_NOTE] if contents.frame == "gost" else []),
        *_hardness(part),
        GENERAL_TOLERANCES[contents.frame],
        say("Break sharp edges 0.3 × 45°, not the corners of the profile.")
        if outline.corners
        else say("Break sharp edges 0.3 × 45°."),
        *_keyway(part),
        say("Both ends of the bore are chamfered {chamfer} × 45°.", chamfer=size(part.chamfer)),
        _zero(contents),
        *_groove(contents),
        say("θ is counted against the rotation, so the follower meets the profile in the order of the table."),
        say(
            "The radii of the table are exact: computed, not measured on a drawing. Interpolated linearly, they "
            "are within {bound:g} mm of the exact profile before rounding.",
            bound=round(contents.table.bound, 6),
        ),
        *_cutter(part),
        _contact_caption(contents),
        *([say("The profile is the part that can be cut: an undercut leaves a corner.")] if outline.corners else []),
        say(
            "In the files of the profile the zero mark lies at {angle} from the x axis.",
            angle=degrees(round(outline.zero % (2 * math.pi), 7)),
        ),
    ]


def _hardness(part: CamPart) -> list[Caption]:
    if not (hardness := part.table.hardness):
        return []
    depth = DEFAULT_DEPTH if part.table.hardness_depth is None else part.table.hardness_depth
    said = say("Profile hardened to {hardness}, depth {depth}.") if depth else say("Profile hardened to {hardness}.")
    return [said.with_values(hardness=hardness, depth=depth)]


def _keyway(part: CamPart) -> list[Caption]:
    if part.keyway is None:
        return []
    b, h = size(part.keyway.width), size(part.keyway.height)
    least, most = (size(radius) for radius in part.keyway.fillets)
    said = say("Keyway {standard} for a key {b} × {h}, radius of its corners {least}...{most} mm.")
    return [said.with_values(standard=part.key_standard, b=b, h=h, least=least, most=most)]


def _zero(contents: PartContents) -> Caption:
    part, outline = contents.part, contents.outline
    if contents.second:
        return say(
            "The zero mark, θ = 0°, is scribed on the face where that of the first cam stands, so that one key, or one "
            "mark, times both cams; the second roller lies elsewhere."
        )
    if not outline.zero_met:
        return say(
            "The zero mark, θ = 0°, is scribed on the face, over the middle of a keyway; the point at which the "
            "follower would meet the cam at cam angle 0 is lost to the undercut."
        )
    if part.keyway is None:
        return say("The zero mark, θ = 0°, is scribed on the face; there the follower meets the cam at cam angle 0.")
    return say(
        "The zero mark, θ = 0°, is scribed on the face over the middle of the keyway; there the follower meets the cam "
        "at cam angle 0."
    )


def _groove(contents: PartContents) -> list[Caption]:
    if contents.groove is None:
        return []
    told = say(
        "The roller runs in a groove {depth} mm deep: r is the radius of its inner wall and r₂ that of its outer wall "
        "at the same θ. Tolerance, roughness and hardness of the profile hold for both walls."
    )
    return [told.with_values(depth=size(contents.groove.depth))]


def _cutter(part: CamPart) -> list[Caption]:
    radius = part.table.cutter_radius
    if radius is None:
        return []
    told = say("R is the radius of the centre of a cutter of radius {radius} mm at the same θ.", radius=size(radius))
    return [told]


def _contact_caption(contents: PartContents) -> Caption:
    solution = contents.solution
    if not isinstance(solution, ArcsSolution) and not solution.cam.kinematics.takes_roller:
        return say("The profile works with a flat-faced follower.")
    roller = (solution.motion if isinstance(solution, ArcsSolution) else contents.cam or solution.cam).roller_radius
    if not roller:
        return say("The profile works with a knife edge.")
    return say("The profile works with a roller of radius {radius} mm, and with no other.", radius=size(roller))


def cam_data(contents: PartContents) -> Table:
    """The table of the cam's data that the profile depends on."""
    solution, outline = contents.solution, contents.outline
    rows: list[tuple[Words, Words]] = [*_sizes(contents)]
    rows += [(say("lift"), _lift(solution)), (say("rotation"), sense_caption(_rotation(solution)))]
    if solution.task.speed_rpm:
        rows.append((say("speed"), say("{rpm:g} rpm", rpm=solution.task.speed_rpm)))
    decimals = radius_decimals(contents.given, outline.greatest_radius)
    rows.append((say("minimum radius of the profile"), _mm(round(outline.least_radius, decimals))))
    rows.append((say("maximum radius of the profile"), _mm(round(outline.greatest_radius, decimals))))
    timing = solution.motion.timing if isinstance(solution, ArcsSolution) else solution.cam.motion.timing
    rows += [(PHASE_NAMES[kind], degrees(round(end - start, 9))) for kind, start, end in timing[:MAX_PHASES]]
    return Table(say("Data of the cam"), ("", ""), tuple(rows))


def tolerance_data(solution: AnySolution) -> list[Table]:
    """Tables of the errors of motion by the task's tolerances, the most important first; none without tolerances."""
    design = None if isinstance(solution, ArcsSolution) else solution.tolerances
    return [replace(design.table(), answers=frozenset())] if design and not design.undercut else []


def _mm(length: float) -> Caption:
    return say("{length} mm", length=size(length))


def _rotation(solution: AnySolution) -> Rotation:
    return solution.rotation if isinstance(solution, ArcsSolution) else solution.cam.rotation


def _lift(solution: AnySolution) -> Words:
    if isinstance(solution, ArcsSolution):
        return _mm(solution.motion.lift)
    if solution.chain.board.follower.unit == "rad":
        return degrees(solution.cam.motion.lift)
    return _mm(solution.cam.motion.lift)


def _sizes(contents: PartContents) -> list[tuple[Words, Words]]:
    solution = contents.solution
    if isinstance(cam := contents.cam, ConjugateCam):
        at = say("({x}, {y}) mm", x=size(cam.at[0]), y=size(cam.at[1]))
        return [(say("second roller, with the follower lowest"), at), (say("roller radius"), _mm(cam.roller_radius))]
    if isinstance(solution, ArcsSolution):
        motion = solution.motion
        return [(say("prime radius r₀"), _mm(motion.prime_radius)), (say("roller radius"), _mm(motion.roller_radius))]
    follower = solution.chain.board.follower.sizes(solution.chain.place, solution.cam.roller_radius)
    told = [(each.title, _mm(each.value)) for each in follower if each.value is not None]
    return [(say("prime radius r₀"), _mm(solution.cam.prime_radius)), *told]


def polar_rows(table: PolarTable, tell: Tell) -> list[tuple[str, ...]]:
    """The rows of the polar table, the head first, in the language of the drawing."""
    columns = {"r": table.radii, "r₂": table.wall, "R": table.cutter}
    told = {"θ": [tell(_angle(angle)) for angle in table.angles]}
    told |= {
        name: [tell(_radius(radius, table.decimals)) for radius in radii]
        for name, radii in columns.items()
        if radii is not None
    }
    return [tuple(tell(name) for name in told), *zip(*told.values(), strict=True)]


def side_by_side_table(rows: Sequence[tuple[str, ...]], columns: int, tell: Tell) -> Table:
    """A table of these rows, the head first, in so many columns side by side."""
    head, *cells = rows
    high = math.ceil(len(cells) / columns)
    cells += [("",) * len(head)] * (high * columns - len(cells))
    parted = (tuple(cell for k in range(columns) for cell in cells[k * high + j]) for j in range(high))
    return Table(tell(say("Polar table (θ in °, radii in mm)")), head * columns, tuple(parted))


def _angle(angle: float) -> Caption:
    return say("{angle:g}", angle=float(np.round(angle, 6)))


def _radius(radius: float, decimals: int) -> Caption:
    return say("{radius:.{decimals}f}", radius=radius, decimals=decimals)
