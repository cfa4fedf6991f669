"""The diagram of the pressure angle over the cam angle, from which the greatest angles are read."""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import (
    numbers,
    ordinate,
    phase_ends,
    phases_below,
    phi_axes,
    pieces_of,
    reach,
    station_names,
)
from graphcam.constructions.curve_over_phi import curve_over_phi
from graphcam.constructions.graduation import graduated
from graphcam.constructions.pressure_angle import MeasuredAngles
from graphcam.constructions.time_axis import times_below
from graphcam.constructions.views import ANGLE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.limits import Limits
from graphcam.words import sequence


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
            (Compared("max_pressure_angle_rise_deg", say("pressure angle, rise"), sides="rise_candidates"),),
            Converges("maximum angle, rise", "max_pressure_angle_rise"),
        ),
        "max_return": ReadingMeaning(
            say("maximum α on the return"),
            "max α",
            "rad",
            (Compared("max_pressure_angle_return_deg", say("pressure angle, return"), sides="return_candidates"),),
        ),
    },
    "report.paragraphs.greatest_angles",
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
    axis = hand.found(integrated.givens.diagram, "axis")
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
        hand.read(name, between(origin, read, UP), mu_alpha.per_mm, "rad")
    return hand.finished(AngleDiagramGivens(measured, mu_alpha, limits), _draw, {"curve": curve, **places})


def inside(plotted: Construction[AngleDiagramGivens], phase: str) -> Drawn | None:
    """The maximum inside the rises or the returns where the farthest point is at an end of one, on the other side.

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
    motion, stations, mu_phi, curve = givens.motion, givens.stations, givens.mu_phi, plotted.acts["curve"]
    axis, heights = plotted.acts["acceleration: axis"].first, curve.shown.imag
    axes = (
        *phi_axes(motion, mu_phi, heights, ordinate("α", givens.unit)),
        *graduated(heights, float(np.degrees(plotted.givens.mu_alpha.per_mm))),
        *phases_below(motion, mu_phi, reach(heights)[0]),
        *times_below(phase_ends(motion, mu_phi)[-1], mu_phi, reach(heights)[0], givens.omega),
        *numbers(axis, stations, np.where(heights < 0, UP, -UP)),
    )
    met = say("at {first}, where the acceleration jumps, it has a corner")
    lines, faired = curve_over_phi(givens, showing(plotted), "α", curve, met)
    degrees, names = np.degrees(plotted.givens.measured.first("alpha")), station_names(stations)
    set_off = [
        Part(_SET_OFF[0 if alpha >= 0 else 1].where(name=names[k], alpha=alpha, y=abs(y)), (curve.first[[k]],))
        for k, (alpha, y) in enumerate(zip(degrees.tolist(), curve.shown.imag.tolist(), strict=True))
    ]
    k = min(4, len(names) - 1)
    said = say(
        "At its station set off each angle from the axis with the dividers, {scale:.4g}° a millimetre, positive ones "
        "upward: {alpha:.2f}° at station {name} are {y:.2f} mm. {drawn}"
    ).where(scale=np.degrees(plotted.givens.mu_alpha.per_mm), name=names[k], alpha=degrees[k])
    said = said.where(y=curve.shown.imag[k], drawn=sequence([part.caption for part in faired], " "))
    why = say("Because the maximum usually lies between two stations, it is read off the curve through all of them.")
    marks = (*axes, curve.from_(axis, Role.CONSTRUCTION), curve.dots(Role.CONSTRUCTION), *lines)
    title = say("The pressure angle over the cam angle")
    return Step(title, said, ANGLE, marks, given=axes, why=why, parts=(*set_off, *faired))


_SET_OFF = (
    say("Station {name}: set off {y:.2f} mm upward for {alpha:z.2f}°."),
    say("Station {name}: set off {y:.2f} mm downward for {alpha:.2f}°."),
)


def _draw_greatest(plotted: Construction[AngleDiagramGivens]) -> Step:
    limits = plotted.givens.limits
    marks, parts, told = list[Mark](), list[Part](), list[Caption]()
    inner_marks, inner_parts = list[Mark](), list[Part]()
    for name, said, limit in (("max_rise", _ON_THE_RISE, limits.rise), ("max_return", _ON_THE_RETURN, limits.return_)):
        top, alpha = plotted.acts[name].first, float(np.degrees(plotted.value(name)))
        marks += [
            top.dots(Role.LIMIT),
            top.label(say("{alpha:.1f}°", alpha=alpha), _outward(top)),
        ]
        compared = _NO_LIMIT if limit is None else _compared(abs(alpha), limit, plotted.givens.mu_alpha)
        told.append(said.where(y=top.place.imag, alpha=alpha, compared=compared))
        parts.append(Part(told[-1], (top,)))
        if other := inside(plotted, name.removeprefix("max_")):
            beside = float(np.degrees(plotted.givens.mu_alpha.per_mm)) * other.place.imag
            inner_marks += [other.dots(Role.LIMIT), other.label(say("{alpha:.1f}°", alpha=beside), _outward(other))]
            told.append(_INSIDE.where(y=other.place.imag, alpha=beside))
            inner_parts.append(Part(told[-1], (other,)))
    marks, parts = marks + inner_marks, parts + inner_parts
    found = say(
        "Slide the T-square up and down to the curve until it touches, over the rises and over the returns, and read "
        "the point farthest from the axis. {told}"
    ).where(told=sequence(told, " "))
    why = say(
        "Because the follower may jam if the angle between force and motion is too large, it is compared with "
        "the limit."
    )
    title = say("The maximum pressure angles")
    return Step(title, found, ANGLE, tuple(marks), ("max_rise", "max_return"), why=why, parts=tuple(parts))


def _outward(top: Drawn) -> complex:
    """Away from the axis."""
    return complex(np.sign(top.place.imag) * UP)


def _compared(size: float, limit: float, mu_alpha: Scale) -> Caption:
    """An angle [degrees] against its limit [rad]."""
    beyond = mu_alpha.paper(np.radians(size) - limit)
    said = _KEPT if beyond < -PENCIL_LINE else _JUST if beyond <= PENCIL_LINE else _PASSED
    return said.where(size=size, limit=float(np.degrees(limit)))


_ON_THE_RISE = say("On the rise the farthest point of the curve is at {y:.2f} mm, so α = {alpha:.2f}°: {compared}.")
_ON_THE_RETURN = say("On the return the farthest point of the curve is at {y:.2f} mm, so α = {alpha:.2f}°: {compared}.")
_INSIDE = say(
    "That point is at an end of the phase; inside it, on the other side of the axis, the farthest point is at {y:.2f} "
    "mm, so α = {alpha:.2f}°."
)
_KEPT = say("{size:.2f}° < {limit:.4g}°, within the limit")
_JUST = say("equal to the limit of {limit:.4g}° within drawing accuracy")
_PASSED = say("{size:.2f}° > {limit:.4g}°, the limit is exceeded")
_NO_LIMIT = say("a spring drives the return, so the angle is not limited")
