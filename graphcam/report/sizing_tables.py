"""The tables of a sized cam, for its sheet and for the command line."""

import math
from collections.abc import Iterator, Mapping, Sequence

from graphcam.mechanism.sizing import SizedCam
from graphcam.mechanism.sizing_limits import (
    CURVATURE_LIMIT,
    NO_UNDERCUT_RULE,
    RETURN_LIMIT,
    RISE_LIMIT,
    SHARE_LIMIT,
    STRESS_LIMIT,
)
from graphcam.sheets.tables import Table
from graphcam.words import Caption, Words, say, sequence

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
