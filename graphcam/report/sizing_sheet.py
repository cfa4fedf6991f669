"""The sheet of a sized cam, with its tables: the region of permitted cams, the best cam, the front beside stress."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Part, Step, View
from graphcam.drafting.marks import Arrow, Dots, Label, Line, Mark, Points, Region, Role, Segments
from graphcam.given.laws import Floats
from graphcam.language import ENGLISH, language as language_of
from graphcam.mechanism.sizing import Across, FeasibleRegion, SizedCam, feasible_region
from graphcam.mechanism.sizing_limits import (
    CURVATURE_LIMIT,
    NO_UNDERCUT_RULE,
    RETURN_LIMIT,
    RISE_LIMIT,
    SHARE_LIMIT,
    STRESS_LIMIT,
)
from graphcam.sheets.formats import Format
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Drawing
from graphcam.sheets.sheet_frame import TitleBlock
from graphcam.sheets.tables import Table
from graphcam.words import Caption, Words, say, sequence

# --- the tables ------------------------------------------------------------------------------------------------------

BINDING_CAPTIONS: Mapping[str, Caption] = {
    str(words): words
    for words in (
        *(say("pressure angle on the rise"), say("pressure angle on the return"), say("curvature"), say("stress")),
        say("roller's share of the prime radius"),
        *(say("minimum prime radius"), say("maximum prime radius"), say("minimum offset"), say("maximum offset")),
        *(say("minimum base radius"), say("maximum base radius")),
        *(say("minimum roller radius"), say("maximum roller radius")),
        *(say("minimum face width"), say("maximum face width")),
    )
}
"""Captions of active limits and ends of ranges, by their names in :class:`~graphcam.mechanism.sizing.SizedCam`."""
SIZE_CAPTIONS: Mapping[str, Caption] = {
    str(words): words
    for words in (say("prime radius"), say("base radius"), say("offset"), say("roller radius"), say("face width"))
}
"""Captions of the sizes, by their names in :class:`~graphcam.mechanism.sizing_limits.SizingProblem`."""
SMALLEST_CAM_TITLE, LEAST_STRESS_TITLE = say("The smallest cam"), say("The cam under the minimum stress")
TITLES_BY_OBJECTIVE = {"size": SMALLEST_CAM_TITLE, "stress": LEAST_STRESS_TITLE}
FRONT_TITLE = say("Radius against stress")


def cam_table(best: SizedCam, adopted: SizedCam | None = None, title: Caption = SMALLEST_CAM_TITLE) -> Table:
    """The table of sizes and limits with the permitted values; a star marks the active ones."""
    cams = [best, adopted] if adopted else [best]
    rows = tuple(
        (said, *columns, sequence([limit, "*"], " ") if _is_binding(name, best) else limit)
        for name, said, columns, limit in (*_sizes(cams), *_limits(cams))
    )
    values = (say("value"),) if adopted is None else (say("best"), say("rounded"))
    return Table(title, (say("size"), *values, say("permitted, * active limit")), rows)


def front_table(front: Sequence[SizedCam]) -> Table:
    """The table of a front's cams: sizes, stress with the widest face, and the least width for the permitted stress."""
    measure = front[0].problem.measure
    header = (
        *(say("{size}, mm", size=SIZE_CAPTIONS[name]) for name in (measure, "offset", "roller radius", "face width")),
        say("stress, MPa"),
        say("minimum width, mm"),
    )
    rows = tuple(
        (
            *(
                say("{value:.2f}", value=round(x, 2) + 0.0)
                for x in (cam.radius, cam.offset, cam.cam.roller_radius, cam.width)
            ),
            say("{value:.1f}", value=cam.stress),
            say("{value:.2f}", value=cam.min_width),
        )
        for cam in front
    )
    return Table(FRONT_TITLE, header, rows)


Row = tuple[str, Caption, list[Words], Words]
"""Name, caption, the value of each cam, and what is permitted."""


def _is_binding(name: str, best: SizedCam) -> bool:
    return bool({name, f"minimum {name}", f"maximum {name}"} & set(best.active))


def _sizes(cams: Sequence[SizedCam]) -> Iterator[Row]:
    problem = cams[0].problem
    values = [problem.values(cam.sizes) for cam in cams]
    for (name, (low, high)), found in zip(problem.ranges.items(), zip(*values, strict=True), strict=True):
        permitted = say("{low:g} to {high:g}", low=low, high=high) if low < high else say("given")
        yield name, SIZE_CAPTIONS[name], [_length(x) for x in found], permitted
        if name == "base radius":
            yield "prime radius", SIZE_CAPTIONS["prime radius"], [_length(cam.cam.prime_radius) for cam in cams], ""


def _limits(cams: Sequence[SizedCam]) -> Iterator[Row]:
    limits = cams[0].problem.limits
    for name, permitted, way in ((RISE_LIMIT, limits.rise, "rise"), (RETURN_LIMIT, limits.return_, "return")):
        if permitted is not None:
            found = [abs(getattr(cam.cam.extremes(), f"pressure_angle_{way}")[0]) for cam in cams]
            angles: list[Words] = [say("{angle:.2f}°", angle=math.degrees(angle)) for angle in found]
            yield name, BINDING_CAPTIONS[name], angles, say("{angle:g}°", angle=math.degrees(permitted))
    terms = [term for term in (*limits.rule, NO_UNDERCUT_RULE) if term.of == "rho"]
    # What holds for the best cam's roller is told.
    least = max((cams[0].cam.roller_radius + term.margin) / term.factor for term in terms)
    found = [_length(cam.min_convex_radius) for cam in cams]
    yield CURVATURE_LIMIT, say("minimum radius of curvature"), found, say("{length:.3f}", length=least)
    for factor in [min(term.factor for term in limits.rule if term.of == "r0")] if SHARE_LIMIT in limits.names else []:
        shares: list[Words] = [say("{share:.3f}", share=cam.cam.roller_radius / cam.cam.prime_radius) for cam in cams]
        yield SHARE_LIMIT, BINDING_CAPTIONS[SHARE_LIMIT], shares, say("{value:g}", value=factor)
    stresses: list[Words] = [say("{stress:.1f} MPa", stress=cam.stress) for cam in cams]
    yield STRESS_LIMIT, say("contact stress"), stresses, say("{stress:g}", stress=limits.stress)


def _length(value: float) -> Words:
    return say("{length:.3f} mm", length=round(value, 3) + 0.0)


# --- the sheet -------------------------------------------------------------------------------------------------------

CHART_SIZES = {"A1": 280 + 230j, "A2": 185 + 150j, "A3": 125 + 105j, "A4": 100 + 80j}
"""Width and height of a chart by format [mm of paper]."""
MIN_AXIS_SHARE = 0.05
"""The minimum span of an axis as a part of the maximum radius, so that a range of one size has an axis too."""
ABOVE_LINE_NOTE = say(
    "Above its line a limit is kept, whatever the others: with the roller that suits it best and with the widest face, "
    "where roller or face are not what the axis shows. Lines that hold the best cam back are drawn in the accent."
)
ABOVE_ALL_LINES_NOTE = say(
    "Over all lines the cams are permitted. The best one: {measure} {radius:.3f} mm, {across} {value:.3f} mm. Active "
    "there: {active}."
)
FRONT_NOTE = say(
    "Every point is a cam with the widest face that none beats in both: a smaller one has more stress, and one of less "
    "stress is larger. The stress falls as the root of the width grows, so a cam below the level line may have a "
    "narrower face."
)
BEST_CAM_LABEL = say("{stress:.0f} MPa, face {width:.1f} mm")
AXIS_LABELS: dict[Across, Caption] = {
    "offset": say("e, mm"),
    "roller radius": say("roller radius, mm"),
    "face width": say("face width, mm"),
}
RADIUS_LABELS = {"prime radius": say("r₀, mm"), "base radius": say("base radius, mm")}
REGION_TITLES: dict[Across, Caption] = {
    "offset": say("Permitted cams, {radius} over the offset e"),
    "roller radius": say("Permitted cams, {radius} over the roller radius"),
    "face width": say("Permitted cams, {radius} over the face width"),
}


MAX_TICKS = 6
"""The maximum number of parts of an axis with numbers."""
AXIS_OVERHANG = 8.0
"""The length of an axis beyond its span [mm of paper]."""
Span = tuple[float, float]


@dataclass(frozen=True)
class ChartAxes:
    """The two axes of a chart.

    size : width and height on paper [mm];  across, up : the values at their ends
    names : of the axes
    """

    size: complex
    across: Span
    up: Span
    names: tuple[Caption, Caption]

    def place(self, across: Floats | float, up: Floats | float) -> Points:
        """Places (n,) on paper [mm] of values."""
        (x0, x1), (y0, y1) = self.across, self.up
        x, y = (np.asarray(across) - x0) / (x1 - x0), (np.asarray(up) - y0) / (y1 - y0)
        return np.asarray(x * self.size.real + UP * y * self.size.imag)

    def marks(self) -> tuple[Mark, ...]:
        """Both axes with their numbers and names."""
        across, up = self.size.real + 0j, self.size.imag * UP
        return (
            Arrow(0j, across + AXIS_OVERHANG, Role.SCALE),
            Arrow(0j, up + AXIS_OVERHANG * UP, Role.SCALE),
            *_ticks(across, self.across, -UP),
            *_ticks(up, self.up, -1 + 0j),
            Label(across + AXIS_OVERHANG, self.names[0], towards=1 - 1j),
            Label(up + AXIS_OVERHANG * UP, self.names[1], towards=-1 + 0j),
        )


def _ticks(end: complex, span: Span, outwards: complex) -> tuple[Mark, ...]:
    """Short strokes with round numbers along an axis, which begins at the origin."""
    low, high = span
    values = round_values(low, high)
    at = (values - low) / (high - low) * end
    labels = (
        Label(complex(x), say("{value:g}", value=float(value)), outwards, small=True)
        for x, value in zip(at, values, strict=True)
    )
    return (Segments(at, at + 1.5 * outwards, Role.SCALE), *labels)


def round_values(low: float, high: float) -> Floats:
    """Round numbers (n,) between the ends of a span.

    >>> round_values(60, 120).tolist()
    [60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0]
    """
    from matplotlib.ticker import MaxNLocator

    round_ = np.asarray(MaxNLocator(MAX_TICKS, steps=[1, 2, 5, 10]).tick_values(low, high))
    # With the slack of a rounding at either end.
    return round_[(round_ >= low - 1e-9 * (high - low)) & (round_ <= high + 1e-9 * (high - low))]


def sizing_sheet(
    sized: SizedCam,
    paper: str = "A3",
    frame: str = "iso",
    language: str = ENGLISH.name,
    *,
    front: Sequence[SizedCam] = (),
    adopted: SizedCam | None = None,
    title: Caption = SMALLEST_CAM_TITLE,
    block: TitleBlock | None = None,
    orientation: str | None = None,
) -> Drawing:
    """The sheet with the permitted region and the values of the cam.

    paper : "A1" to "A4"; frame : "gost" or "iso"; orientation : "landscape" or "portrait"
    language : such as "en"
    front : cams of :func:`~graphcam.mechanism.sizing.pareto_front`, drawn in a chart of their own
    adopted : the cam of round sizes, shown beside the best;  title : of the table;  block : the title block

    Raises
    ------
    DesignError : there is no such format, frame or language
    """
    tell, size = language_of(language).text, CHART_SIZES[Format(paper, frame).name]
    chart = _Chart.of(sized, feasible_region(sized.problem), size)
    steps = [*chart.steps(title), *([_front_step(sized, front, size)] if len(front) > 1 else [])]
    tables = [cam_table(sized, adopted, title), *([front_table(front)] if len(front) > 1 else [])]
    named = [("sizing", step) for step in steps]
    return compose(named, tables, block or TitleBlock(name=tell(title)), paper, frame, (), orientation, tell)


@dataclass(frozen=True, eq=False)
class _Chart:
    """The chart of the permitted region, over the radius and another size."""

    sized: SizedCam
    region: FeasibleRegion
    axes: ChartAxes

    @classmethod
    def of(cls, sized: SizedCam, region: FeasibleRegion, size: complex) -> _Chart:
        """The chart with axes as long as the ranges."""
        problem = sized.problem
        across, radii = problem.ranges[region.across], problem.radius
        spans = _nonzero_span(across, radii[1]), _nonzero_span(radii, radii[1])
        return cls(sized, region, ChartAxes(size, *spans, (AXIS_LABELS[region.across], RADIUS_LABELS[problem.measure])))

    def steps(self, title: Caption) -> list[Step]:
        """The limits, and the best cam among them."""
        problem, across = self.sized.problem, self.region.across
        radius = SIZE_CAPTIONS[problem.measure]
        view = View(
            "sizing",
            REGION_TITLES[across].with_values(radius=radius),
            across=f"sizing {across}",
            up=f"sizing {problem.measure}",
        )
        values = {"measure": radius, "radius": self.sized.radius, "across": SIZE_CAPTIONS[across], "value": self._value}
        values["active"] = sequence([BINDING_CAPTIONS[name] for name in self.sized.active])
        return [
            Step(say("The limits"), (Part(ABOVE_LINE_NOTE),), view, (*self.axes.marks(), *self._limits())),
            Step(title, (Part(ABOVE_ALL_LINES_NOTE.with_values(**values)),), view, self._best_marks()),
        ]

    @property
    def _value(self) -> float:
        """The value of the best cam on the second axis [mm]."""
        problem = self.sized.problem
        values = dict(zip(problem.ranges, problem.values(self.sized.sizes), strict=True))
        return values[self.region.across] + 0.0

    def _limits(self) -> tuple[Mark, ...]:
        marks: list[Mark] = []
        for name, radius in self.region.by_limit.items():
            line = self.axes.place(self.region.values, radius)[~np.isnan(radius)]
            # A limit that the least radius of the range keeps everywhere has no line in the chart.
            if line.size > 1 and np.nanmax(radius) > self.axes.up[0]:
                marks += [
                    Line(line, Role.LIMIT if name in self.sized.active else Role.CURVE),
                    Label(complex(line[line.size // 2]), BINDING_CAPTIONS[name], towards=UP),
                ]
        return (*marks, *self._ends())

    def _ends(self) -> tuple[Mark, ...]:
        (x0, x1), (y0, y1) = self.axes.across, self.axes.up
        across, radius = self.region.across, self.sized.problem.measure
        ends = {
            f"minimum {across}": ((x0, y0), (x0, y1)),
            f"maximum {across}": ((x1, y0), (x1, y1)),
            f"minimum {radius}": ((x0, y0), (x1, y0)),
            f"maximum {radius}": ((x0, y1), (x1, y1)),
        }
        lines = {name: self.axes.place(*np.array(corners, dtype=np.float64).T) for name, corners in ends.items()}
        return tuple(Line(line, Role.LIMIT) for name, line in lines.items() if name in self.sized.active)

    def _best_marks(self) -> tuple[Mark, ...]:
        region, place = self.region, self.axes.place
        kept = ~np.isnan(region.least)
        border, top = place(region.values[kept], region.least[kept]), place(region.values[kept], self.axes.up[1])
        found = complex(place(self._value, self.sized.radius))
        return (
            *([Region(np.concatenate([border, top[::-1]]))] if border.size > 1 else []),
            Dots(np.array([found]), Role.RESULT),
            Label(found, say("{radius:.2f} mm", radius=self.sized.radius), towards=1 - 1j),
        )


def _nonzero_span(span: Span, greatest: float) -> Span:
    """A span with a length, even of one size."""
    low, high = span
    return low, max(high, low + MIN_AXIS_SHARE * greatest)


def _front_step(sized: SizedCam, front: Sequence[SizedCam], size: complex) -> Step:
    problem = sized.problem
    radii, stresses = np.array([(cam.radius, cam.stress) for cam in front]).T
    low, high = stresses.min(), max(stresses.max(), sized.stress)
    round_ = round_values(low, high + 1e-6)
    step = round_[1] - round_[0] if round_.size > 1 else high - low
    axes = ChartAxes(
        size,
        _nonzero_span(problem.radius, problem.radius[1]),
        (float(np.floor(low / step) * step), float(np.ceil(high / step - 1e-6) * step)),
        (RADIUS_LABELS[problem.measure], say("stress, MPa")),
    )
    marks: list[Mark] = [*axes.marks()]
    if axes.up[0] <= problem.limits.stress <= axes.up[1]:
        level = axes.place(np.array(axes.across), problem.limits.stress)
        role = Role.LIMIT if STRESS_LIMIT in sized.active else Role.CURVE
        marks += [Line(level, role), Label(complex(level[1]), say("permitted"), towards=-1 + 1j)]
    points = axes.place(radii, stresses)
    found = complex(axes.place(sized.radius, sized.stress))
    marks += [
        Line(points, Role.CURVE),
        Dots(points),
        Dots(np.array([found]), Role.RESULT),
        Label(complex(points[points.size // 2]), say("face {width:g} mm", width=problem.width[1]), towards=1 + 1j),
        Label(found, BEST_CAM_LABEL.with_values(stress=sized.stress, width=sized.width), towards=1 + 1j),
    ]
    title = say("Stress over {radius}", radius=SIZE_CAPTIONS[problem.measure])
    view = View("front", title, across="front radius", up="front stress")
    return Step(FRONT_TITLE, (Part(FRONT_NOTE),), view, tuple(marks))
