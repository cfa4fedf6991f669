"""The diagram of the pressure angle over the cam angle, from which the greatest angles are read."""

from dataclasses import dataclass, replace

import numpy as np

from graphcam.constructions.axes import number_labels, pieces_of, station_names
from graphcam.constructions.curve_over_phi import curve_over_phi
from graphcam.constructions.graduation import graduation_marks
from graphcam.constructions.pressure_angle import MeasuredAngles
from graphcam.constructions.views import ANGLE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.hand import Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, Words, say
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.meaning import ComparedReading, Meaning, ReadingConvergence, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.telling import STATION, introduced_parts, run
from graphcam.given.follower import Limits


@dataclass(frozen=True, eq=False)
class AngleDiagramGivens:
    """The measured angles, the scale in which they are plotted [rad/mm], and what they must keep to."""

    measured: MeasuredAngles
    mu_alpha: Scale
    limits: Limits


MEANING = Meaning(
    "angle_diagram",
    say("Maximum pressure angles"),
    say("The angles of all stations over the cam angle; the maxima lie between stations, on the curve."),
    {
        "max_rise": ReadingMeaning(
            say("maximum α on the rise"),
            "max α",
            "rad",
            (ComparedReading("max_pressure_angle_rise_deg", say("pressure angle, rise"), sides="rise_candidates"),),
            ReadingConvergence("maximum angle, rise", "max_pressure_angle_rise"),
        ),
        "max_return": ReadingMeaning(
            say("maximum α on the return"),
            "max α",
            "rad",
            (
                ComparedReading(
                    "max_pressure_angle_return_deg", say("pressure angle, return"), sides="return_candidates"
                ),
            ),
        ),
    },
    scales={"angle": "max_rise"},
)


PENCIL_LINE = 0.2
"""What lies no farther apart [mm of paper] is told to be alike."""


def angle_diagram(
    measured: MeasuredAngles, mu_alpha: Scale, limits: Limits, pencil: Pencil
) -> Construction[AngleDiagramGivens]:
    """Plot the pressure angles over the cam angle, fair the curve between breaks, and read off the greatest.

    mu_alpha : scale of the pressure angle [rad/mm];  limits : the permitted angles, with which they are compared

    Readings: besides the greatest angles, with their signs, the candidates (..., 2), highest and lowest.
    """
    hand, integrated = Hand(pencil, MEANING), measured.givens.integrated
    motion, stations, origin = integrated.givens.motion, integrated.givens.stations, hand.given("origin")
    axis = hand.earlier_places(integrated.givens.diagram, "axis")
    curve = hand.lay_off("curve", axis, UP, hand.carry(measured.readings["alpha"], 1 / mu_alpha.per_mm))
    ends: dict[str, Drawn] = {}
    for phase, direction in (("rise", 1), ("return", -1)):
        pieces = pieces_of(motion, stations, direction)
        both = (hand.tangent(f"{side} of the {phase}", curve, pieces, up) for side, up in (("top", UP), ("low", -UP)))
        ends[phase] = hand.take(f"{phase}_candidates", *both)
    # Of both ends the one farther from the axis.
    farther = {phase: np.argmax(np.abs(both.points.imag), axis=-1)[..., None] for phase, both in ends.items()}
    places = {f"max_{phase}": hand.take(f"max_{phase}", ends[phase], which=farther[phase])[0] for phase in ends}
    for name, read in (places | {f"{phase}_candidates": both for phase, both in ends.items()}).items():
        hand.read(name, distance_between(origin, read, UP), mu_alpha.per_mm, "rad")
    return hand.finished(AngleDiagramGivens(measured, mu_alpha, limits), _draw, {"curve": curve, **places})


def inner_maximum(plotted: Construction[AngleDiagramGivens], phase: str) -> Drawn | None:
    """The extreme inside the rises or the returns, where the farthest point lies at an end of one, on the other side.

    So it is with a large offset: the angle in the dwell is the larger one, and a maximum of the other sign lies inside.
    None where the farthest point is the only one of interest.

    phase : "rise" or "return"
    """
    farthest, both = plotted.acts[f"max_{phase}"].first.place, plotted.acts[f"{phase}_candidates"].first
    other = both[int(np.argmin(np.abs(both.shown.imag)))]
    given, stations = plotted.givens.measured.givens.integrated.givens, plotted.acts["curve"].first.shown.real
    ends = stations[[k for span in given.stations.phases for k in (span.start, span.stop - 1)]]
    far_at_end, other_at_end = (bool(np.any(np.abs(ends - at.real) < PENCIL_LINE)) for at in (farthest, other.place))
    across = farthest.imag * other.place.imag < 0 and abs(other.place.imag) > PENCIL_LINE
    return other if far_at_end and across and not other_at_end else None


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(plotted: Construction[AngleDiagramGivens]) -> list[Step]:
    return [_draw_curve(plotted), _draw_greatest(plotted)]


def _draw_curve(plotted: Construction[AngleDiagramGivens]) -> Step:
    givens = plotted.givens.measured.givens.integrated.givens
    stations, curve = givens.stations, plotted.acts["curve"]
    axis, heights = plotted.acts["acceleration: axis"].first, curve.shown.imag
    across, up, _, ticks, phi, name, *scale = givens.axes("α", heights)
    read = plotted.readings["max_rise"].act
    # What reaches as far as the angles, or stands on the side that they leave free, would tell them on a worksheet.
    known = (across, ticks, phi, *scale, *givens.phases_under(heights))
    axes = (
        *(*known, replace(up, of=read), replace(name, of=read)),
        *graduation_marks(heights, float(np.degrees(plotted.givens.mu_alpha.per_mm)), of=read),
        *number_labels(axis, stations, np.where(heights < 0, UP, -UP)),
    )
    met = say("at {first}, where the acceleration jumps, it has a corner")
    lines, faired = curve_over_phi(givens, errorless_hand(plotted), "α", curve, met)
    degrees, names = np.degrees(plotted.givens.measured.first("alpha")), station_names(stations)
    k = min(4, len(names) - 1)
    said = say(
        "At its station set off each angle from the axis with the dividers, {scale:.4g}° a millimetre, positive ones "
        "upward: {alpha:.2f}° at station {name} are {y:.2f} mm."
    ).with_values(scale=np.degrees(plotted.givens.mu_alpha.per_mm), name=names[k], alpha=degrees[k], y=heights[k])

    def mm(k: int) -> Words:
        """The angle of a station, and its ordinate in mm of paper."""
        said = say("{alpha:z.2f}°, {y:.2f} mm upward") if degrees[k] >= 0 else say("{alpha:.2f}°, {y:.2f} mm downward")
        return said.with_values(alpha=degrees[k], y=abs(heights[k]))

    set_off = run(said, STATION, names, curve, settings=mm)
    why = say("The maximum usually lies between two stations, so it is read off the curve through all of them.")
    marks = (*axes, curve.segments_from(axis, Role.CONSTRUCTION), curve.dots(Role.CONSTRUCTION), *lines)
    title = say("The pressure angle over the cam angle")
    numbered = Part(say("Number the stations along the axis, clear of the curve."), (axis,))
    return Step(title, (set_off, *faired, numbered), ANGLE, marks, given=known, why=why)


def _draw_greatest(plotted: Construction[AngleDiagramGivens]) -> Step:
    limits = plotted.givens.limits
    marks, parts, inner_marks, inner_parts = list[Mark](), list[Part](), list[Mark](), list[Part]()
    for name, said, limit in (
        ("max_rise", _RISE_CAPTION, limits.rise),
        ("max_return", _RETURN_CAPTION, limits.return_),
    ):
        top, alpha = plotted.acts[name].first, float(np.degrees(plotted.value(name)))
        marks += [top.dots(Role.LIMIT), top.label(say("{alpha:.1f}°", alpha=alpha), _away_from_axis(top))]
        compared = _NO_LIMIT if limit is None else _limit_remark(abs(alpha), limit, plotted.givens.mu_alpha)
        parts.append(Part(said.with_values(y=top.place.imag, alpha=alpha, compared=compared), (top,)))
        if other := inner_maximum(plotted, name.removeprefix("max_")):
            beside = float(np.degrees(plotted.givens.mu_alpha.per_mm)) * other.place.imag
            inner_marks += [
                other.dots(Role.LIMIT),
                other.label(say("{alpha:.1f}°", alpha=beside), _away_from_axis(other)),
            ]
            inner_parts.append(Part(_INSIDE_CAPTIONS[name].with_values(y=other.place.imag, alpha=beside), (other,)))
    found = say(
        "Slide the T-square up and down to the curve until it touches, over the rises and over the returns, and read "
        "the point farthest from the axis."
    )
    why = say(
        "If the angle between force and motion is too large, the follower may jam; so it is compared with the limit."
    )
    title, reads = say("The maximum pressure angles"), ("max_rise", "max_return")
    return Step(title, (*introduced_parts(found, parts), *inner_parts), ANGLE, (*marks, *inner_marks), reads, why=why)


def _away_from_axis(top: Drawn) -> complex:
    return complex(np.sign(top.place.imag) * UP)


def _limit_remark(size: float, limit: float, mu_alpha: Scale) -> Caption:
    """An angle [degrees] against its limit [rad]."""
    beyond = mu_alpha.paper(np.radians(size) - limit)
    said = _WITHIN_LIMIT if beyond < -PENCIL_LINE else _AT_LIMIT if beyond <= PENCIL_LINE else _BEYOND_LIMIT
    return said.with_values(size=size, limit=float(np.degrees(limit)))


_RISE_CAPTION = say("On the rise the farthest point of the curve is at {y:.2f} mm, so α = {alpha:.2f}°: {compared}.")
_RETURN_CAPTION = say(
    "On the return the farthest point of the curve is at {y:.2f} mm, so α = {alpha:.2f}°: {compared}."
)
_INSIDE_CAPTIONS = {
    "max_rise": say(
        "That of the rise is at an end of the phase; inside it, on the other side of the axis, the farthest point is "
        "at {y:.2f} mm, so α = {alpha:.2f}°."
    ),
    "max_return": say(
        "That of the return is at an end of the phase; inside it, on the other side of the axis, the farthest point "
        "is at {y:.2f} mm, so α = {alpha:.2f}°."
    ),
}
_WITHIN_LIMIT = say("{size:.2f}° < {limit:.4g}°, within the limit")
_AT_LIMIT = say("equal to the limit of {limit:.4g}° within drawing accuracy")
_BEYOND_LIMIT = say("{size:.2f}° > {limit:.4g}°, the limit is exceeded")
_NO_LIMIT = say("a spring drives the return, so the angle is not limited")
