"""The table ``[part]`` of a task file: the cam as a part that a workshop makes."""

from dataclasses import dataclass
from typing import Literal

from graphcam.errors import DesignError
from graphcam.tasks.number_limits import check_limits
from graphcam.tasks.units import Density, Feed, Length, Roughness, Size
from graphcam.words import say

Keyway = Literal["din6885", "gost23360", "none"]
BoreTolerance = Literal["H6", "H7", "H8", "H9"]
TableStep = Literal[1, 2, 5, 10]
SplineDegree = Literal[2, 3, 4, 5]


@dataclass(frozen=True)
class PartTable:
    """``[part]``: the cam as a part, for its working drawing (graphcam solve --working-drawing).

    name : of the part, in its title block; left out: Cam
    number : of its drawing
    bore : mm, for which an open prime radius leaves room; left out: the largest standard one that leaves enough wall
    keyway : "din6885", "gost23360" or "none"; left out: by the frame
    width : mm, of the cam; left out: 0.8 of the bore, in round millimetres
    hub_diameter : mm, of a hub on one side; leave out both for a plain disk
    hub_length : mm over all, the cam's width included
    groove_depth : mm, of a groove in the face of a disk, in which the roller runs; left out: it runs on the edge
    second_roller : mm, [x, y] of the centre of a roller that holds the follower back on a second cam, with the follower
        lowest: from the cam centre, a stem along y, an arm's pivot on x; left out: one cam
    second_roller_radius : mm; left out: that of the first
    material : left out: carbon steel C45, in a gost frame by its Russian name
    density : kg/m^3, for the mass
    hardness : of the profile; "" if it is not hardened
    hardness_depth : of the hardened layer; left out: a usual one
    profile_roughness : Ra in micrometres, of the profile
    bore_roughness : Ra in micrometres, of the bore
    roughness : Ra in micrometres, of all other faces
    profile_tolerance : mm, of the profile of a line, ISO 1101; left out: 0.0005 of the diameter, a round value
    bore_tolerance : "H6", "H7", "H8" or "H9"
    cutter_radius : mm, of a cutter, for a column with the positions of its centre
    table_step : degrees, 1, 2, 5 or 10, from row to row of the note's table of the exact profile; that of the working
        drawing has rows between where the profile needs them
    feed : mm/min, of the cutter in the program of G-code
    spline_degree : of the profile's spline in DXF and STEP: 2 to 5
    spline_control_points : left out: as many as half a micrometre takes; the error is given in solution.json

    Raises
    ------
    DesignError : a value that cannot be, alone or together with another

    >>> PartTable(bore=20, hub_diameter=36)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    graphcam.errors.DesignError: hub_length is missing, but must be given where there is hub_diameter; ...
    """

    name: str | None = None
    number: str | None = None
    bore: Size | None = None
    keyway: Keyway | None = None
    width: Size | None = None
    hub_diameter: Size | None = None
    hub_length: Size | None = None
    groove_depth: Size | None = None
    second_roller: tuple[Length, Length] | None = None
    second_roller_radius: Size | None = None
    material: str | None = None
    density: Density = 7850.0
    hardness: str = "45...50 HRC"
    hardness_depth: str | None = None
    profile_roughness: Roughness = 0.8
    bore_roughness: Roughness = 1.6
    roughness: Roughness = 3.2
    profile_tolerance: Size | None = None
    bore_tolerance: BoreTolerance = "H7"
    cutter_radius: Size | None = None
    table_step: TableStep = 5
    feed: Feed = 100.0
    spline_degree: SplineDegree = 3
    spline_control_points: int | None = None

    def __post_init__(self) -> None:
        check_limits(self)
        self._check_words()
        self._check_hub()
        self._check_second()

    def _check_words(self) -> None:
        for name in ("name", "number", "material", "hardness", "hardness_depth"):
            if not (text := getattr(self, name) or "").isprintable():
                raise DesignError(name, text, say("printable text on one line"))

    def _check_second(self) -> None:
        """Refuse a second roller beside a groove, which holds the follower itself, or one that is nowhere."""
        if self.second_roller_radius is not None and self.second_roller is None:
            limit = say("left out where there is no {there}", there="second_roller")
            raise DesignError("second_roller_radius", self.second_roller_radius, limit, say("give its place too"))
        if self.second_roller is not None and self.groove_depth is not None:
            limit = say("left out where there is {there}", there="groove_depth")
            raise DesignError("second_roller", say("given"), limit, say("a groove holds the roller on both sides"))

    def _check_hub(self) -> None:
        """Refuse a hub with one size alone, or one that does not reach beyond what it surrounds."""
        diameter, length = self.hub_diameter, self.hub_length
        if (diameter is None) != (length is None):
            missing, there = ("hub_diameter", "hub_length") if diameter is None else ("hub_length", "hub_diameter")
            allowed = say("given where there is {there}", there=there)
            raise DesignError(missing, say("missing"), allowed, say("leave out both for a cam without"))
        for name, outer, inner in (("hub_diameter", diameter, "bore"), ("hub_length", length, "width")):
            limit = getattr(self, inner)
            if outer is not None and limit is not None and outer <= limit:
                allowed = say("greater than the {inner} of {limit:g} mm", inner=inner, limit=limit)
                raise DesignError(name, outer, allowed, say("enlarge it or leave the hub out"))
