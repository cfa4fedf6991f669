"""The cam centre of an arm enlarged, where it lies near the end of the arm on the drawing of the arm positions."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from graphcam.constructions.arm_positions import ArmPositions
from graphcam.constructions.region import Boundary
from graphcam.constructions.region_picture import MARGIN, RegionPicture
from graphcam.constructions.views import CAM_CENTRE, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import showing
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Label, Line, Mark, Points, Region, Role
from graphcam.drafting.scale import Ratios, Scale, ratio_text, standard_scale

SMALL, ENLARGED = 30.0, 60.0
"""Where the adopted prime radius is shorter than this on the arm positions, it is shown at the largest standard scale
at which it is not longer than that [mm]."""
ASIDE = 20.0
"""So far beside the places that it shows the region is hatched [mm]."""


def detail_scale(prime_radius: float, mu_l: Scale, ratios: Ratios) -> Scale | None:
    """The scale of the detail for an adopted prime radius [mm], or None where the arm positions are large enough.

    >>> from graphcam.drafting.scale import ISO_5455
    >>> [detail_scale(radius, Scale(1.0, "mm"), ISO_5455) for radius in (12.0, 61.0)]
    [Scale(per_mm=0.2, unit='mm'), None]
    """
    if mu_l.paper(prime_radius) >= SMALL:
        return None
    scale = standard_scale(prime_radius, ENLARGED, ratios)
    return scale if scale.per_mm < mu_l.per_mm else None


def region_enlarged(
    region: ArmPositions,
    scale: Scale,
    lines: Sequence[Boundary],
    bind: Sequence[tuple[Drawn, Caption]],
    adopted: Sequence[complex],
) -> Step:
    """The region about the cam centre found.

    lines : all that bound it;  bind : those on which the cam centre lies, with their names
    adopted : the cam centre that is taken in the end, on the arm positions: the region is hatched as far as there
    """
    hand, start, centre = showing(region), region.acts["start"].first, region.acts["centre"].first[0]
    times = region.givens.mu_l.per_mm / scale.per_mm
    b, a = (hand.enlarged(name, drawn, start, times) for name, drawn in (("B₀", start), ("A₀", centre)))
    shown: Points = np.array([b.place, a.place, *((place - start.place) * times for place in adopted)])
    left, right, bottom = shown.real.min() - ASIDE, shown.real.max() + ASIDE, shown.imag.min() - MARGIN
    picture = RegionPicture(float(left), float(right), float(bottom), 0.0)
    enlarged = [Boundary("", (line.touch - start.place) * times, line.inward) for line in lines]
    permitted = hand.given("permitted places", picture.permitted(enlarged))
    marks: list[Mark] = [Region(permitted.points).left_by(permitted), *(b.dots(Role.CONSTRUCTION), b.label("B₀", UP))]
    through = list[Drawn]()
    for k, (line, name) in enumerate(bind):
        drawn = hand.enlarged(f"line {k} through A₀", line, start, times)
        through.append(drawn)
        way = complex(unit(np.asarray(a.place - drawn.place)))
        above, below = min(abs(a.place - drawn.place), abs(a.place)), (a.place.imag - bottom) / max(-way.imag, 0.5)
        ends = a.place + way * np.array([-above, below])
        marks.append(Line(ends, Role.LIMIT).left_by(drawn))
        marks.append(Label(complex(ends[1]), name, way, small=True).left_by(drawn))
    marks += [a.dots(Role.RESULT), a.label("A₀", 1 + 0j if a.place.real > 0 else -1 + 0j)]
    first = say("Draw B₀ and A₀ again at {ratio}, {paper:.1f} mm from one another.")
    first = first.where(ratio=ratio_text(scale.per_mm), paper=abs(a.place))
    second = say("Draw the lines on which A₀ lies, and hatch again the region that no line cuts off.")
    return Step(
        *(say("The cam centre enlarged"), (Part(first, (b, a)), Part(second, (*through, permitted)))),
        *(at_scale(CAM_CENTRE, scale), tuple(marks)),
        why=say("At the scale of the arm, points so close to its end cannot be told apart."),
    )


def adopted_enlarged(measured: Construction[Any], scale: Scale, label: Caption) -> Step:
    """The adopted cam centre in the same drawing."""
    hand, start, centre = showing(measured), measured.acts["start"].first, measured.acts["centre"].first
    a = hand.enlarged("A", centre, start, measured.givens.mu_l.per_mm / scale.per_mm)
    said = say("Mark A in the enlarged drawing too, {paper:.1f} mm from B₀.", paper=abs(a.place))
    return Step(
        *(say("The adopted cam centre enlarged"), (Part(said, (a,)),), at_scale(CAM_CENTRE, scale)),
        (a.dots(Role.RESULT), a.label(label, -UP)),
        why=say("The enlarged drawing shows that A lies in the hatched region."),
    )
