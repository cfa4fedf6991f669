"""The part that is made of a cam: sizes from the table ``[part]``, and others that follow from the cam."""

import math
from dataclasses import dataclass

from graphcam.errors import DesignError
from graphcam.given.limits_and_fits import (
    MAX_SHAFT,
    MIN_SHAFT,
    MIN_WALL,
    STANDARD_NAMES,
    KeySection,
    key_section,
    keyway_top,
    shaft_radius,
    standard_diameters,
)
from graphcam.tasks.part_table import PartTable
from graphcam.words import Words, say

DEFAULT_WALL = 0.3
"""The wall between the keyway's bottom and the profile or the hub for which a bore is chosen, as a part of the bore."""
DEFAULT_TOLERANCE_SHARE = 0.0005
"""The default tolerance of the profile, as a part of its maximum diameter."""
ROUNDING_SHARE = 0.5
"""The maximum value of a radius's last decimal, as a part of the tolerance."""
CHAMFERS = (30, 1.6), (10, 1.0), (5, 0.5)
"""Bore diameters, and the chamfers of larger bores [mm]."""
SMALL_CHAMFER_SHARE, MAX_CHAMFER_SHARE = 0.05, 0.2
"""The chamfer as a part of a smaller bore's diameter; its maximum as a part of the bore's length."""
DEFAULT_WIDTH_SHARE = 0.8
"""The default width of the cam, as a part of the bore."""
DEFAULT_MATERIALS = {"iso": "C45 EN ISO 683-1", "gost": say("Steel 45 GOST 1050-2013")}
"""The default material, by the frame of the sheet."""
KEYWAY_STANDARDS = {"iso": "din6885", "gost": "gost23360"}


@dataclass(frozen=True)
class Hub:
    """A hub on one side of the cam [mm]; its length is that of the bore, the cam's width included."""

    diameter: float
    length: float


@dataclass(frozen=True)
class CamPart:
    """The part with all its sizes [mm].

    keyway : None for a bore without one;  key_standard : the name of its standard on the drawing
    table : the task's data for roughness, tolerances, cutter and step
    """

    bore: float
    keyway: KeySection | None
    key_standard: Words
    width: float
    hub: Hub | None
    material: Words
    table: PartTable

    @property
    def length(self) -> float:
        """The length of the bore [mm]."""
        return self.hub.length if self.hub else self.width

    @property
    def keyway_top(self) -> float:
        """The distance from the axis to the keyway's bottom [mm], or to the bore where there is none."""
        return keyway_top(self.bore, self.keyway is not None)

    @property
    def chamfer(self) -> float:
        """The size of the 45° chamfers of the bore [mm]."""
        usual = next((size for least, size in CHAMFERS if self.bore > least), SMALL_CHAMFER_SHARE * self.bore)
        return min(usual, MAX_CHAMFER_SHARE * self.length)

    def mass(self, profile_area: float) -> float:
        """The mass [kg] for a profile of that area [mm^2]; chamfers are left out.

        >>> part = cam_part(PartTable(bore=20, width=10), "iso", 27)
        >>> round(part.mass(6000), 4)
        0.4449
        """
        hole = math.pi * self.bore**2 / 4 + (self.keyway.area(self.bore) if self.keyway else 0.0)
        hub = (math.pi * self.hub.diameter**2 / 4 - hole) * (self.hub.length - self.width) if self.hub else 0.0
        return ((profile_area - hole) * self.width + hub) * self.table.density * 1e-9


def cam_part(table: PartTable, frame: str, least_radius: float) -> CamPart:
    """The part of a cam whose profile has the minimum radius ``least_radius`` mm.

    frame : "iso" or "gost", by whose standards the rest is chosen

    Raises
    ------
    DesignError : bore and keyway leave no wall inside the profile or the hub, the hub is not inside the profile or not
        longer than the cam is wide, or the standards have no key for the bore

    >>> part = cam_part(PartTable(), "iso", 27.0)
    >>> part.bore, part.keyway, part.width
    (28.0, KeySection(width=8.0, height=7.0, depth=3.3), 23.0)
    """
    bore = table.bore if table.bore is not None else _usual_bore(table, least_radius)
    if table.bore is None and table.keyway != "none" and key_section(bore) is None:
        limit = say(
            "large enough for a bore of more than {thinnest_shaft:g} mm, below which the standards have no key",
            thinnest_shaft=MIN_SHAFT,
        )
        found, remedy = (
            say("{radius:.4g} mm", radius=least_radius),
            say("take a larger prime radius, or give part.bore"),
        )
        raise DesignError(say("minimum radius of the profile"), found, limit, remedy)
    keyway = _keyway(table, bore)
    width = table.width if table.width is not None else _usual_width(bore)
    hub = None
    if table.hub_diameter is not None and table.hub_length is not None:
        hub = Hub(table.hub_diameter, table.hub_length)
    standard = STANDARD_NAMES[_standard(table, frame)] if keyway else ""
    part = CamPart(bore, keyway, standard, width, hub, table.material or DEFAULT_MATERIALS[frame], table)
    _check_walls(part, least_radius)
    return part


def profile_tolerance(table: PartTable, greatest_radius: float) -> float:
    """The tolerance of the profile [mm]: as given, else the round value next to the default part of its diameter.

    >>> profile_tolerance(PartTable(), 56.5), profile_tolerance(PartTable(), 500), profile_tolerance(PartTable(), 3)
    (0.05, 0.5, 0.002)
    """
    if table.profile_tolerance is not None:
        return table.profile_tolerance
    usual = math.log10(DEFAULT_TOLERANCE_SHARE * 2 * greatest_radius)
    decade = math.floor(usual)
    nearest = min((1, 2, 5, 10), key=lambda value: abs(math.log10(value) + decade - usual))
    return float(f"{nearest}e{decade}")


def radius_decimals(table: PartTable, greatest_radius: float) -> int:
    """Decimals of computed radii [mm]: at least two, and the last is at most half the profile's tolerance.

    >>> radius_decimals(PartTable(), 56.5), radius_decimals(PartTable(), 3)
    (2, 3)
    """
    return max(2, math.ceil(-math.log10(ROUNDING_SHARE * profile_tolerance(table, greatest_radius)) - 1e-9))


def _standard(table: PartTable, frame: str) -> str:
    return table.keyway if table.keyway not in (None, "none") else KEYWAY_STANDARDS[frame]


def _keyway(table: PartTable, bore: float) -> KeySection | None:
    if table.keyway == "none":
        return None
    section = key_section(bore)
    if section is None and table.keyway is not None:
        limit = say(
            "none for a bore of {bore:g} mm: the standard has keys from {thinnest_shaft:g} to {thickest_shaft:g} mm"
        )
        limit = limit.with_values(bore=bore, thinnest_shaft=MIN_SHAFT, thickest_shaft=MAX_SHAFT)
        raise DesignError("part.keyway", table.keyway, limit, say("write 'none' or change part.bore"))
    return section


def _usual_bore(table: PartTable, least_radius: float) -> float:
    """The largest standard diameter [mm] that leaves the default wall and for which the standards have a key."""
    keyed = table.keyway != "none"
    outer = least_radius if table.hub_diameter is None else min(least_radius, table.hub_diameter / 2)
    standard = [d for d in standard_diameters() if d <= MAX_SHAFT]
    fitting = [d for d in standard if keyway_top(d, keyed) + DEFAULT_WALL * d <= outer]
    return max(fitting, default=standard[0])


def _usual_width(bore: float) -> float:
    """The default width [mm], in whole millimetres or for small cams in round parts of one."""
    step = min(1.0, 10.0 ** math.floor(math.log10(bore)) / 10)
    return round(math.ceil(DEFAULT_WIDTH_SHARE * bore / step - 1e-9) * step, 12)


def _check_walls(part: CamPart, least_radius: float) -> None:
    keyed = part.keyway is not None
    needed = shaft_radius(part.bore, keyed)
    hub = part.hub
    if hub and not hub.diameter / 2 < least_radius:
        limit = say(
            "less than twice the minimum radius of the profile, {least_radius:.4g} mm", least_radius=least_radius
        )
        raise DesignError("part.hub_diameter", hub.diameter, limit, say("take a smaller hub or a larger prime radius"))
    if hub and not hub.length > part.width:
        limit = say("greater than the cam's width of {width:g} mm", width=part.width)
        raise DesignError("part.hub_length", hub.length, limit, say("lengthen the hub or give a smaller part.width"))
    for inside, outer, larger in (
        *([("the hub's radius", hub.diameter / 2, "part.hub_diameter")] if hub else []),
        (say("the minimum radius of the profile"), least_radius, say("prime radius")),
    ):
        if not needed <= outer:
            keyway = say(" with its keyway {depth:g} mm deep", depth=part.keyway.depth) if part.keyway else ""
            found = say("{bore:g} mm{keyway}", bore=part.bore, keyway=keyway)
            limit = say("small enough to leave a wall of {least:g} of the bore inside {inside} of {outer:.4g} mm")
            limit = limit.with_values(least=MIN_WALL, inside=inside, outer=outer)
            fitting = [d for d in standard_diameters() if shaft_radius(d, keyed) <= outer]
            smaller = say("take a smaller bore")
            if fitting:
                smaller = say("take a smaller bore, {fitting:g} mm or less,", fitting=max(fitting))
            remedy = say("{smaller} or a larger {larger}", smaller=smaller, larger=larger)
            raise DesignError("part.bore", found, limit, remedy)
