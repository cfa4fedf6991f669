"""The sheet of a sized cam: the region of permitted cams over offset and prime radius, and the cam that was found."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Step, View, say
from graphcam.drafting.marks import Arrow, Dots, Label, Line, Mark, Points, Region, Role, Segments
from graphcam.given.laws import Floats
from graphcam.language import ENGLISH, language as language_of
from graphcam.mechanism.sizing import SizedCam
from graphcam.mechanism.sizing_region import FeasibleRegion, feasible_region
from graphcam.sheets.formats import Format
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Drawing
from graphcam.sheets.tables import Table
from graphcam.sheets.title_block import TitleBlock
from graphcam.words import Caption, sequence

REGION = View("sizing", say("Permitted cams, prime radius r₀ over offset e"), across="sizing e", up="sizing r0")
TITLE = say("The smallest cam")
SIZES = {"A1": 600 + 480j, "A2": 340 + 275j, "A3": 195 + 150j, "A4": 115 + 90j}
"""Width and height of the region by format [mm of paper]; its axes have scales of their own."""
TICKS = 6
"""Parts of an axis with numbers, at most."""
MARGIN = 0.05
"""An axis is at least this part of the greatest radius long, so that a range of one size has an axis too."""
BINDING: Mapping[str, Caption] = {
    str(words): words
    for words in (
        *(say("pressure angle on the rise"), say("pressure angle on the return"), say("curvature"), say("stress")),
        *(say("minimum prime radius"), say("maximum prime radius"), say("minimum offset"), say("maximum offset")),
        *(say("minimum roller radius"), say("maximum roller radius")),
        *(say("minimum face width"), say("maximum face width")),
    )
}
"""What can bind, limits and ends of ranges, by their names in :class:`~graphcam.mechanism.sizing.SizedCam`."""


def sizing_sheet(sized: SizedCam, paper: str = "A3", frame: str = "iso", language: str = ENGLISH.name) -> Drawing:
    """A sheet with the permitted region and the values of the cam, for the writers of :mod:`graphcam.sheets`.

    paper : "A1" to "A4"; frame : "gost" or "iso"; language : "en" or "ru"

    Raises
    ------
    DesignError : there is no such format, frame or language
    """
    tell, size = language_of(language).text, SIZES[Format(paper, frame).name]
    steps = [("sizing", step) for step in _steps(sized, feasible_region(sized.problem), size)]
    return compose(steps, [_table(sized)], TitleBlock(name=tell(TITLE)), paper, frame, tell=tell)


ABOVE = say(
    "Above its line each limit is satisfied: the pressure angle, the roller's share of the radius of curvature "
    "with the smallest roller, and the stress with the widest face and the best roller."
)
OVER = say(
    "Above all lines the cams are permitted. The minimum prime radius is r₀ = {r0:.3f} mm at e = {e:.3f} mm; "
    "active there: {binding}."
)


def _steps(sized: SizedCam, region: FeasibleRegion, size: complex) -> list[Step]:
    (e0, e1), (r0, r1) = sized.problem.offset, sized.problem.prime_radius
    span, rise = max(e1 - e0, MARGIN * r1), max(r1 - r0, MARGIN * r1)

    def place(e: Floats | float, radius: Floats | float) -> Points:
        """Places on paper [mm] of an offset and a prime radius [mm]."""
        across, up = (np.asarray(e) - e0) / span, (np.asarray(radius) - r0) / rise
        return np.asarray(across * size.real + UP * up * size.imag)

    kept = ~np.isnan(region.least)
    border, top = place(region.offset[kept], region.least[kept]), place(region.offset[kept], r1)
    lines = {name: place(region.offset, radius)[~np.isnan(radius)] for name, radius in region.by_limit.items()}
    drawn = [(name, line) for name, line in lines.items() if line.size]
    limits = (
        *_axes(size, (e0, e0 + span), (r0, r0 + rise)),
        *(Line(line, Role.CURVE) for _, line in drawn if line.size > 1),
        *(Label(complex(line[line.size // 2]), BINDING[name], towards=UP) for name, line in drawn),
    )
    found, least = complex(place(sized.offset, sized.cam.prime_radius)), sized.cam.prime_radius
    smallest = (
        *([Region(np.concatenate([border, top[::-1]]))] if border.size > 1 else []),
        Dots(np.array([found]), Role.RESULT),
        Label(found, say("r₀ = {r0:.2f}", r0=least), towards=1 - 1j),
    )
    binding = sequence([BINDING[name] for name in sized.binding])
    return [
        Step(say("The limits"), ABOVE, REGION, limits),
        Step(TITLE, replace(OVER, values={"r0": least, "e": sized.offset, "binding": binding}), REGION, smallest),
    ]


def _axes(size: complex, offsets: tuple[float, float], radii: tuple[float, float]) -> tuple[Mark, ...]:
    across, up = size.real + 0j, size.imag * UP
    beyond = 8.0
    return (
        Arrow(0j, across + beyond, Role.SCALE),
        Arrow(0j, up + beyond * UP, Role.SCALE),
        *_ticks(across, offsets, -UP),
        *_ticks(up, radii, -1 + 0j),
        Label(across + beyond, say("e, mm"), towards=1 - 1j),
        Label(up + beyond * UP, say("r₀, mm"), towards=-1 + 0j),
    )


def _ticks(end: complex, span: tuple[float, float], outwards: complex) -> tuple[Mark, ...]:
    """Short strokes with round numbers along an axis from the origin."""
    from matplotlib.ticker import MaxNLocator

    low, high = span
    round_ = np.asarray(MaxNLocator(TICKS, steps=[1, 2, 5, 10]).tick_values(low, high))
    # With the slack of a rounding at either end.
    values = round_[(round_ >= low - 1e-9 * (high - low)) & (round_ <= high + 1e-9 * (high - low))]
    at = (values - low) / (high - low) * end
    labels = (
        Label(complex(x), say("{value:g}", value=float(value)), outwards, small=True)
        for x, value in zip(at, values, strict=True)
    )
    return (Segments(at, at + 1.5 * outwards, Role.SCALE), *labels)


def _table(sized: SizedCam) -> Table:
    """Sizes and limits with what is permitted; a star where that binds."""
    problem, limits = sized.problem, sized.problem.limits
    ranges = (
        (say("prime radius"), sized.cam.prime_radius, problem.prime_radius),
        (say("offset"), sized.offset, problem.offset),
        (say("roller radius"), sized.cam.roller_radius, problem.roller_radius),
        (say("face width"), sized.face_width, problem.face_width),
    )
    rows = [
        (str(name), name, _length(value), say("{low:g} to {high:g}", low=low, high=high))
        for name, value, (low, high) in ranges
    ]
    angle, permitted = math.degrees(sized.max_pressure_angle), math.degrees(max(limits.rise, limits.return_ or 0.0))
    rho, least = sized.min_convex_radius, sized.cam.roller_radius / limits.roller_share
    stress, allowed = say("{stress:.1f} MPa", stress=sized.stress), say("{stress:g}", stress=limits.stress)
    rows += [
        ("pressure angle", say("pressure angle"), say("{angle:.2f}°", angle=angle), say("{angle:g}°", angle=permitted)),
        ("curvature", say("minimum radius of curvature"), _length(rho), say("{length:.3f}", length=least)),
        ("stress", say("contact stress"), stress, allowed),
    ]
    starred = [
        (name, value, sequence([limit, "*"], " ") if any(word in binding for binding in sized.binding) else limit)
        for word, name, value, limit in rows
    ]
    return Table(TITLE, (say("size"), say("value"), say("permitted, * active limit")), tuple(starred))


def _length(value: float) -> Caption:
    return say("{length:.3f} mm", length=value)
