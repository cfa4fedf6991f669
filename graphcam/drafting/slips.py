"""By what every act errs: written down here alone, and taken from here by the hand.

======================  ========================================================================================
act                     what is off, as a standard deviation
======================  ========================================================================================
divide                  every new mark along the way: a setting of the dividers; the two ends lie there already
erect                   the line beside its foot: a line
project                 the foot along its line: a line
lay off                 the end along the way: a setting; where there is nothing to lay off nothing is set
parallel,               the line beside its place: a line; its direction: a line over the length of the set
perpendicular           square.  The end of a chord set end to end: a line, along its upright
tangent                 the line across itself, and the touch along it: a line; one that is found with a mirror
                        passes its point a line beside, and its direction is off as by a protractor
bisect                  the line across itself at both crossings of the arcs: a line over the root of two
circle                  the centre, across and up: half a line; the radius: a setting
protractor              the direction: the protractor's error; the line beside its vertex: a line
read                    a length: evenly by half a division each way, once; an angle: the protractor's error
join, cross, fair,      nothing of their own: they pass on what they start from, a crossing both its lines' errors
take, enlarge, given    over the sine of their angle
======================  ========================================================================================
"""

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

from graphcam.drafting.acts import Kind

SQUARE_LENGTH = 150.0
"""Length of a set square [mm]: a line drawn along it is turned by its offset over this."""
PROTRACTOR_RADIUS = 50.0
"""Radius of a protractor [mm], the common one of 100 mm across: at its edge a line's error is an angle's."""
UNIFORM_DEVIATION = 1 / math.sqrt(12)
"""Standard deviation of what lies evenly over one, as the rounding to a division does."""


class Slip(NamedTuple):
    """One error of an act: ``times`` one of a pencil's errors (see :class:`~graphcam.Pencil`)."""

    of: Literal["line", "dividers", "division", "protractor"]
    times: float = 1.0


_LINE_SLIP, _SETTING_SLIP, _ANGLE_SLIP = Slip("line"), Slip("dividers"), Slip("protractor")
_CARRIED_SLIPS = {"across": _LINE_SLIP, "turn": Slip("line", 1 / SQUARE_LENGTH)}

SLIPS: Mapping[Kind, Mapping[str, Slip]] = {
    Kind.DIVIDE: {"along": _SETTING_SLIP},
    Kind.ERECT: {"across": _LINE_SLIP},
    Kind.PROJECT: {"along": _LINE_SLIP},
    Kind.LAY_OFF: {"along": _SETTING_SLIP},
    Kind.PARALLEL: _CARRIED_SLIPS,
    Kind.PERPENDICULAR: _CARRIED_SLIPS,
    Kind.TANGENT: {"across": _LINE_SLIP, "along": _LINE_SLIP, "turn": _ANGLE_SLIP},
    Kind.BISECT: {"one": Slip("line", math.sqrt(0.5)), "other": Slip("line", math.sqrt(0.5))},
    Kind.CIRCLE: {"across": Slip("line", 0.5), "up": Slip("line", 0.5), "radius": _SETTING_SLIP},
    Kind.PROTRACTOR: {"turn": _ANGLE_SLIP, "across": _LINE_SLIP},
    Kind.READ: {"length": Slip("division", UNIFORM_DEVIATION), "turn": _ANGLE_SLIP},
}
"""The errors of every kind of act that has any."""
