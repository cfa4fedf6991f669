"""The diagram of the pressure angle over the cam angle, from which the greatest angles are read."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import degree_ticks, phase_angle, phase_ends, phi_axes, pieces_of
from graphcam.constructions.integration import rests
from graphcam.constructions.pressure_angle import MeasuredAngles
from graphcam.constructions.views import ANGLE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Dimension, Label, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale


@dataclass(frozen=True, eq=False)
class AngleDiagramGivens:
    """The measured angles, and the scale in which they are plotted [rad/mm]."""

    measured: MeasuredAngles
    mu_alpha: Scale


MEANING = Meaning(
    "angle_diagram",
    say("Greatest pressure angles"),
    say("The angles of all stations over the cam angle; the greatest lie between stations, on the curve."),
    {
        "max_rise": ReadingMeaning(
            say("greatest α on the rise"),
            "max α",
            "rad",
            (Compared("max_pressure_angle_rise_deg", say("pressure angle, rise"), sides="rise_candidates"),),
            Converges("greatest angle, rise", "max_pressure_angle_rise"),
        ),
        "max_return": ReadingMeaning(
            say("greatest α on the return"),
            "max α",
            "rad",
            (Compared("max_pressure_angle_return_deg", say("pressure angle, return"), sides="return_candidates"),),
        ),
    },
    "report.paragraphs.greatest_angles",
    scales={"angle": "max_rise"},
)


def angle_diagram(measured: MeasuredAngles, mu_alpha: Scale, pencil: Pencil) -> Construction[AngleDiagramGivens]:
    """Plot the pressure angles over the cam angle, fair the curve between breaks, and read off the greatest.

    mu_alpha : scale of the pressure angle [rad/mm]

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
    return hand.finished(AngleDiagramGivens(measured, mu_alpha), _draw, {"curve": curve, **places})


def _draw(plotted: Construction[AngleDiagramGivens]) -> list[Step]:
    integrated, hand = plotted.givens.measured.givens.integrated, showing(plotted)
    motion, stations, mu_phi = integrated.givens.motion, integrated.givens.stations, integrated.givens.mu_phi
    curve, ends, extremes = plotted.acts["curve"], phase_ends(motion, mu_phi), ("max_rise", "max_return")
    tops = [complex(plotted.first(name)) for name in extremes]
    greatest = [np.degrees(plotted.value(name)) for name in extremes]
    low = min(0.0, float(np.nanmin(curve.shown.imag))) - 24.0
    axes = (
        *phi_axes(motion, mu_phi, curve.shown.imag, "α"),
        *degree_ticks(mu_phi),
        *(Dimension(a + UP * low, b + UP * low, phase_angle(motion, k)) for k, (a, b) in enumerate(pairwise(ends))),
    )
    curves = (
        *axes,
        curve.dots(Role.CONSTRUCTION),
        *(hand.fair("α", curve.first, [piece]).line(Role.RESULT) for piece in stations.pieces),
        *rests(integrated, curve),
    )
    said = say(
        "The angles are plotted at {scale:.4g}° a millimetre and the curve is faired between the jumps of the "
        "acceleration; in the dwells the angle stays."
    ).where(scale=np.degrees(plotted.givens.mu_alpha.per_mm))
    found = say(
        "The greatest angles are read off the faired curve: {rise:.2f} mm on the rise, which stands for {rise_deg:.2f}"
        "°, and {back:.2f} mm on the return, {back_deg:.2f}°."
    ).where(rise=tops[0].imag, rise_deg=greatest[0], back=tops[1].imag, back_deg=greatest[1])
    told = [
        Label(top, say("{alpha:.1f}°", alpha=alpha), np.sign(top.imag) * UP, of=plotted.readings[name].act)
        for name, top, alpha in zip(extremes, tops, greatest, strict=True)
    ]
    marks = (hand.take("greatest", *(plotted.acts[name].first for name in extremes)).dots(Role.LIMIT), *told)
    return [
        Step(say("The pressure angle over the cam angle"), said, ANGLE, curves, given=axes),
        Step(say("The greatest pressure angles"), found, ANGLE, marks, extremes),
    ]
