"""The combined diagram of displacement and velocity, in which a translating follower's cam centre is found.

At every displacement s_i on the line of motion, v_i is laid off turned by 90 degrees in the sense of the cam's
rotation, to D_i, in the scale of s or both in a larger one.  Seen from a cam centre A, the angle between A D_i and the
line of motion is the pressure angle.
"""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from graphcam.constructions.axes import AXIS_OVERHANG, number_labels, pieces_of, sense_caption, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import COMBINED, MINIMUM_RADIUS, at_scale
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, View, say
from graphcam.drafting.marks import Line, Role
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, ratio_text
from graphcam.drafting.telling import STATION, run, setting, stretch_caption
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.words import say_in, sequence


def combined_view(integrated: Integrated) -> View:
    """The view of the combined diagram: beside that of s, in whose scale it is, or with a drawing scale of its own."""
    own = integrated.givens.combined
    if own is None:
        return COMBINED
    alone = replace(COMBINED, up=COMBINED.name, title=MINIMUM_RADIUS, answer=ratio_text(own.per_mm))
    return at_scale(replace(alone, found_by=integrated.name), own)


def combined_scale(integrated: Integrated) -> Floats | float:
    """The scale of the combined diagram [mm/mm]: its own, or that of s, which may be one a sample."""
    own = integrated.givens.combined
    return integrated.readings["s"].scale if own is None else own.per_mm


def combined_length(hand: Hand, integrated: Integrated, length: float) -> Setting | float:
    """A length [mm] on the paper of the combined diagram."""
    own = integrated.givens.combined
    return hand.at_scale(length, integrated.readings["s"]) if own is None else length / own.per_mm


def velocities(hand: Hand, integrated: Integrated, rotation: Rotation) -> Drawn:
    """The ends of v, laid off at the displacements in one scale, turned by 90 degrees in the sense of the cam."""
    s, v, scale = integrated.readings["s"], integrated.readings["v"], combined_scale(integrated)
    line = hand.given("line of motion", along=UP)
    # The heights are projected across from the displacement diagram; the segments are set with dividers, in its scale.
    if integrated.givens.combined is None:
        heights = hand.project("displacements", hand.carry(s), line)
    else:
        heights = hand.lay_off("displacements", line, UP, hand.carry(s, s.scale / scale))
    return hand.lay_off("ends", heights, -sense(rotation) * RIGHT, hand.carry(v, v.scale / scale))


def offset_line(hand: Hand, start: Drawn, integrated: Integrated, offset: float) -> Drawn:
    """The line on which the cam centre lies at an offset [mm]: downwards."""
    foot = hand.lay_off("offset", start, -RIGHT, combined_length(hand, integrated, offset))
    return hand.erect("line of the offset", foot, -UP)


# --- the steps -------------------------------------------------------------------------------------------------------

WORKED_SHARE = 1 / 3
"""So far through the first rise stands the station that is told in full."""


def side_caption(x: float) -> Caption:
    """The side on which something lies, the right if ``x`` is positive.

    >>> str(side_caption(-2.0))
    'to the left'
    """
    return say_in("aside", "to the left") if x < 0 else say_in("aside", "to the right")


def worked_station(integrated: Integrated) -> int:
    """The station that is told in full: one of the first rise, with a length to lay off."""
    stations, v = integrated.givens.stations, integrated.first("v")
    first = stations.moving == stations.moving[pieces_of(integrated.givens.motion, stations, 1)[0].start]
    return int(np.argmin(np.where(first & (v > np.max(v) / 10), np.abs(stations.u - WORKED_SHARE), np.inf)))


def displacement_step(region: Construction[Any], bottom: float) -> Step:
    """The step that lays the displacements off up the line of motion, and at each the velocity."""
    integrated, heights, ends = region.givens.integrated, region.acts["displacements"], region.acts["ends"]
    stations, start, x = integrated.givens.stations, region.acts["start of the lift"].first, ends.shown.real
    s, own = _displacements(integrated), integrated.givens.combined
    # The ends of a phase lie on the line of motion, several in one place: their numbers stand above it or below.
    rising = np.array([integrated.givens.motion.phases[k].direction for k in stations.phase])
    apart = np.where(s > np.mean(s), UP, -UP) - sense(region.givens.rotation) * rising
    # How far it goes on down to the cam centre is found by drawing, and up in a scale of its own.
    top = float(ends.shown.imag.max()) + AXIS_OVERHANG
    given = top if own is None else float(np.max(integrated.first("s"))) + AXIS_OVERHANG
    lift = Line(UP * np.array([0.0, given]), Role.AXIS)
    marks = (
        *(lift, Line(UP * np.array([bottom, 0.0]), Role.AXIS)),
        *(() if own is None else (Line(UP * np.array([given, top]), Role.AXIS),)),
        *(
            ends.segments_from(heights, Role.CONSTRUCTION),
            heights.dots(Role.CONSTRUCTION),
            ends.dots(Role.CONSTRUCTION),
        ),
        # Beside the line of motion, away from the rest line; it stands there before the numbers look for room.
        start.label("B₀", towards=sense(region.givens.rotation) - UP),
        *number_labels(ends, stations, np.where(np.abs(x) > 1, np.sign(x) + 0j, apart)),
    )
    base = say("Draw the line of motion vertical with a set square and mark B₀ on it, where the lift starts.")

    def set_off(k: int) -> Caption:
        """How far up s and how far aside v are laid off at station k."""
        up = say("{s:.2f} mm up", s=s[k]) if own is None else say("s {set} up", set=setting(heights.first[[k]]))
        up = say("at B₀") if abs(s[k]) < NEGLIGIBLE_SIZE else up
        at = ends.first[[k]]
        v_there = (
            say("v = 0")
            if abs(x[k]) < NEGLIGIBLE_SIZE
            else say("v {set} {side}", set=setting(at), side=side_caption(x[k]))
        )
        return say("{up}, {v_there}", up=up, v_there=v_there)

    stationed = run(_laying_off(region), STATION, station_names(stations), heights, ends, settings=set_off)
    why = say(
        "Seen from a cam centre, the end of v lies at the pressure angle to the line of motion, as the velocity plan "
        "will show."
    )
    title = say("Velocities at the displacements")
    return Step(title, (Part(base, (start,)), stationed), combined_view(integrated), marks, given=(lift,), why=why)


def _displacements(integrated: Integrated) -> Floats:
    """The displacements at the stations as they are laid off [mm of paper]."""
    own, s = integrated.givens.combined, integrated.first("s")
    return s if own is None else s * (integrated.readings["s"].per_mm / own.per_mm)


def _laying_off(region: Construction[Any]) -> Caption:
    """Sentences on how all stations are laid off, and one of them in full."""
    integrated, ends, sigma = region.givens.integrated, region.acts["ends"], sense(region.givens.rotation)
    k, longest = worked_station(integrated), float(np.abs(ends.shown.real).max())
    scale = float(np.ravel(combined_scale(integrated))[0])
    carried = say(
        "Carry every displacement s to the line of motion, upwards from B₀, with the dividers or, from a "
        "diagram level with it, across with the T-square. From every mark lay v off horizontally with the "
        "dividers, {rise} on a rise and {back} on a return: v turned by 90° with the cam, {rotation}. "
        "Multiply every ordinate of v by μᵥ/μₛ = {factor:.5g}, so that it has the scale of s."
    )
    if integrated.givens.combined is not None:
        carried = say(
            "The diagram has a scale of its own, {ratio}: {scale:g} mm/mm. Multiply every ordinate of s by "
            "μₛ/{scale:g} = {times:.5g} and lay it off on the line of motion, upwards from B₀, with the dividers. From "
            "every mark lay v off horizontally, {rise} on a rise and {back} on a return: v turned by 90° with the cam, "
            "{rotation}. Multiply every ordinate of v by μᵥ/{scale:g} = {factor:.5g}, so that both have one scale."
        ).with_values(ratio=ratio_text(scale), scale=scale, times=integrated.readings["s"].per_mm / scale)
    said = [
        carried.with_values(
            rise=side_caption(-sigma),
            back=side_caption(sigma),
            rotation=sense_caption(region.givens.rotation),
            factor=integrated.readings["v"].per_mm / scale,
        )
    ]
    if integrated.first("v")[k] > NEGLIGIBLE_SIZE:
        worked = say("Station {name}: mark it {s:.2f} mm up and lay off {set}.", s=_displacements(integrated)[k])
        said.append(worked.with_values(name=station_names(integrated.givens.stations)[k], set=setting(ends.first[[k]])))
    return sequence([*said, say("The longest measures {longest:.1f} mm.", longest=longest)], " ")


def curves_step(region: Construction[Any]) -> Step:
    """The step that draws the curves through the ends, from jump to jump of the acceleration."""
    integrated, hand, ends = region.givens.integrated, errorless_hand(region), region.acts["ends"]
    stations = integrated.givens.stations
    names, pieces = station_names(stations), stations.pieces
    curves = [hand.fair("curve", ends.first, [piece]) for piece in pieces]
    # Two ends have no curve.
    tools = [
        say("with the ruler") if piece.stop - piece.start == 2 else say("with the French curve") for piece in pieces
    ]
    through = tuple(
        Row(stretch_caption(names[piece.start], names[piece.stop - 1]), tool, (curve,))
        for piece, tool, curve in zip(pieces, tools, curves, strict=True)
    )
    said = [say("Join the ends of v in their order, from jump to jump of the acceleration.")]
    if met := [names[a.stop - 1] for a, b in pairwise(pieces) if a.stop - 1 == b.start]:
        said.append(say("There is a corner at {names}, where the acceleration jumps.", names=sequence(met)))
    said.append(say("In a dwell v is zero, so the curves start and end on the line of motion."))
    why = say("The limits must be satisfied between the stations too.")
    marks = tuple(curve.line(Role.RESULT) for curve in curves)
    title = say("Curves of rise and return")
    return Step(title, (Part(sequence(said, " "), rows=through),), combined_view(integrated), marks, why=why)


def offset_caption(offset: float, mu: float) -> Caption:
    """How the upright of the cam centre at an offset [mm] is found, at ``mu`` mm to a millimetre of paper."""
    said = say(
        "With e = {e:g} mm the follower moves {size:g} mm {side} of the cam centre, so draw a vertical "
        "{size:g}/{mu:.5g} = {paper:.2f} mm {other} of B₀."
    )
    size = abs(offset)
    return said.with_values(
        e=offset, size=size, side=side_caption(offset), mu=mu, paper=size / mu, other=side_caption(-offset)
    )
