"""Units by the names that they have in readings and files, as a language writes them."""

from collections.abc import Mapping

from graphcam.words import Caption, say

UNITS: Mapping[str, Caption] = {
    str(unit): unit
    for unit in (
        *(say("mm"), say("mm/rad"), say("mm/rad²"), say("mm/rad³"), say("rad"), say("rad/rad"), say("rad/rad²")),
        *(say("rad/rad³"), say("deg"), say("m/s³"), say("rad/s³")),
        *(say("mm of paper"), say("m"), say("s"), say("m/s"), say("m/s²"), say("rad/s"), say("rad/s²"), say("N")),
        *(say("N·mm"), say("N/mm"), say("N·mm/rad"), say("MPa")),
        *(say("µm"), say("µm/rad"), say("mrad"), say("mrad/rad"), say("mrad/rad²")),
        *(say("mm/mm"), say("(mm/rad)/mm"), say("(mm/rad²)/mm")),
    )
}

NOTHING = 0.005
"""A length on paper [mm], or an angle [degrees], of less is written as 0.00: it is neither set nor told."""


def unit(name: str) -> Caption:
    """The unit of that name.

    >>> str(unit("mm/rad"))
    'mm/rad'
    """
    return UNITS[name]
