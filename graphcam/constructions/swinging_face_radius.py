"""The least radius under an oscillating flat face: where the cam centre may lie below the positions of the face.

With w = 1 + sigma v the profile has the radius of curvature rho = c (K sin(psi) + L cos(psi)) - f, where
K = (2 w - 1)/w^2 and L = a/w^3.  Now c sin(psi) and c cos(psi) are how far the cam centre lies square to the line
through the pivot and along it.  So in every position rho is just the permitted one on a straight line: square to the
vector N with the parts K and L, at (rho + f)/|N| from the pivot.  The cam centre must lie beyond all these lines, on
the circle about the pivot with the centre distance.

Textbooks find this radius by trial, drawing one profile after another.  These lines are linear in the place of the cam
centre, as those of an arm at its permitted pressure angles are, so one drawing does for all radii.
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.adoption import ChainSettings
from graphcam.constructions.arm_positions import turning_angle
from graphcam.constructions.axes import clear_numbers, number_labels, station_names
from graphcam.constructions.flat_minimum_radius import (
    dwell_stations,
    jump_stations,
    order_with_jumps,
    smooth_pieces,
)
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS
from graphcam.constructions.swinging_face_inversion import FACE_OFFSET, SWINGING_PSI0
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.acts import Setting
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, View, Words, say
from graphcam.drafting.marks import Arc, Dimension, Line, Role, Segments
from graphcam.drafting.meaning import (
    DISTANCE,
    R0,
    RHO,
    SIGMA,
    A,
    Formula,
    Meaning,
    ReadingMeaning,
    S,
    Symbol,
    V,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.telling import STATION, run
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.words import sequence

POSITIONS = replace(REGION, title=say("Positions of the face: the minimum radius"))
UNIT_LENGTH = 40.0
"""The length on the paper of a vector N with K = 1 and L = 0 [mm]."""
LONGEST_VECTOR = 2.0
"""A vector N that were so many times as long is drawn shorter: 2, 5, 10 times and so on."""
LINE_LENGTH, LINE_OVERHANG = 30.0, 12.0
"""How far a limit line is drawn before the circle of the cam centre, and beyond it [mm]."""


@dataclass(frozen=True, eq=False)
class SwingingLeastGivens(ChainSettings):
    """The diagrams, the face with its pivot, the least permitted radius of curvature [mm], the drawing scale [mm/mm].

    distance, face_offset : c and f [mm]
    """

    integrated: Integrated
    rotation: Rotation
    least_curvature: float
    distance: float
    face_offset: float
    mu_l: Scale


SwingingRegion = Construction[SwingingLeastGivens]


def _enough_radius(region: SwingingRegion) -> Values:
    """The formula's values: how far the cam centre lies below the face at rest, and the radius that is left of it."""
    depth, f = float(region.value("depth")), region.givens.face_offset
    yield {"depth": depth, "f": abs(f), "minus": "-" if f >= 0 else "+", "r0": depth - f}


FORMULAS = (
    Formula(
        r"\rho = c\left(K\sin\psi + L\cos\psi\right) - f, \qquad K = \frac{1 + 2\sigma v}{(1 + \sigma v)^2}, \qquad "
        r"L = \frac{a}{(1 + \sigma v)^3}, \qquad \psi = \psi_0 + s",
        symbols=(RHO, DISTANCE, FACE_OFFSET, SWINGING_PSI0, S, V, A, SIGMA),
    ),
    Formula(
        r"r_0 = c\sin\psi_0 - f",
        r"r_0 = <depth:.3f> <minus> <f:g> = <r0:.3f>\ \text{<mm>}",
        _enough_radius,
        (R0, Symbol(r"c\sin\psi_0", say("how far A lies below the face at rest"), "mm")),
        of="prime_radius",
    ),
)


MEANING = Meaning(
    "minimum_radius",
    say("Minimum prime radius"),
    say(
        "No pressure angle limits this cam, but the curvature of its profile. In every position of the face the places "
        "of the cam centre at which the radius of curvature is just the permitted one lie on a straight line: the cam "
        "centre must lie beyond all these lines."
    ),
    {"prime_radius": LEAST_RADIUS, "depth": ReadingMeaning(say("cam centre below the face at rest"), "c·sin ψ₀", "mm")},
    FORMULAS,
)


def swinging_face_least_radius(
    integrated: Integrated,
    rotation: Rotation,
    least_curvature: float,
    distance: float,
    face_offset: float,
    mu_l: Scale,
    pencil: Pencil,
) -> SwingingRegion:
    """Find the place of the cam centre on its circle about the pivot that is highest of those beyond all limit lines.

    integrated : of an angle s [rad];  least_curvature, distance, face_offset : mm;  mu_l : drawing scale [mm/mm]
    """
    hand = Hand(pencil, MEANING)
    s, *others = (integrated.readings[name] for name in ("s", "v", "a", "a_before"))
    pivot, carried = hand.given("pivot"), [hand.carry(each, each.scale) for each in others]
    positions = hand.protractor("positions", pivot, -RIGHT, hand.carry(s, -s.scale))
    # At a jump of the acceleration there are two lines: those before the jumps stand after all others.
    jumps, count = jump_stations(integrated), integrated.givens.stations.u.size
    lines = positions[np.append(np.arange(count), jumps)]
    along, square = (
        calculated_setting(partial(_factor, sense(rotation), jumps, part), *carried) for part in ("along", "square")
    )
    aside = hand.lay_off("ends along", pivot, lines, along)
    vectors = hand.lay_off("N", aside, lines.turned(1j), square)
    normals = hand.join("normals", pivot, vectors)
    permitted = (least_curvature + face_offset) / mu_l.per_mm
    by_length = partial(_distance_of_line, permitted, sense(rotation), jumps)
    far = calculated_setting(by_length, distance_between(pivot, vectors), *carried)
    touched = hand.lay_off("feet", pivot, normals, far)
    limits = hand.perpendicular("limits", normals, touched).turned(-1)
    moving = hand.take("limits in order", limits, which=order_with_jumps(integrated))
    pieces = smooth_pieces(integrated)
    rests = dwell_stations(integrated)
    between = hand.fair("limits between", moving, pieces[: len(pieces) - rests.size])
    circle = hand.circle("circle of the centre", pivot, distance / mu_l.per_mm)
    found = [hand.cross("centres", between, circle)]
    if rests.size:
        # Where the follower rests N is square to the face, and of the length one.
        feet = hand.lay_off("feet at rest", pivot, positions[rests].turned(1j), permitted)
        found.append(hand.cross("centres at rest", hand.parallel("limits at rest", positions[rests], feet), circle))
    candidates = hand.take("candidates", *found)
    # A line that does not meet the circle leaves no place for the centre: its NaN counts as the lowest.
    lowest = np.argmin(candidates.points.imag, axis=-1)[..., None]
    centre = hand.take("A", candidates, which=lowest)[0]
    depth = distance_between(pivot, centre, -UP)
    hand.read("depth", depth, mu_l.per_mm)
    radius = calculated_setting(partial(_radius_below, face_offset / mu_l.per_mm), depth)
    hand.read("prime_radius", radius, mu_l.per_mm)
    givens = SwingingLeastGivens(integrated, rotation, least_curvature, distance, face_offset, mu_l)
    return hand.finished(givens, _draw, {"A": centre})


def _factors(sigma: int, jumps: NDArray[np.intp], v: Floats, a: Floats, before: Floats) -> tuple[Floats, Floats]:
    """K and L, and once more before every jump."""
    v, a = (np.concatenate([one, other[..., jumps]], axis=-1) for one, other in ((v, v), (a, before)))
    w = 1 + sigma * v
    return (2 * w - 1) / w**2, a / w**3


def _times_shorter(square: Floats, along: Floats) -> Floats:
    """By how much a vector N with the parts K and L is drawn shorter.

    >>> _times_shorter(np.array([1.0, 1.0, 0.5]), np.array([0.0, 3.0, -60.0])).tolist()
    [1.0, 2.0, 50.0]
    """
    times = np.maximum(np.hypot(square, along) / LONGEST_VECTOR, 1.0)
    decade = 10.0 ** np.floor(np.log10(times))
    return decade * np.select([times <= k * decade for k in (1, 2, 5)], [1.0, 2.0, 5.0], 10.0)


def _factor(sigma: int, jumps: NDArray[np.intp], part: str, v: Floats, a: Floats, before: Floats) -> Floats:
    """The parts of N on the paper [mm], L along the face and K square to it, and once more before every jump."""
    square, along = _factors(sigma, jumps, v, a, before)
    return UNIT_LENGTH * (along if part == "along" else square) / _times_shorter(square, along)


def _distance_of_line(
    permitted: float, sigma: int, jumps: NDArray[np.intp], length: Floats, v: Floats, a: Floats, before: Floats
) -> Floats:
    """How far a limit line passes from the pivot [mm of paper], for the length of its N as it is drawn."""
    return permitted * UNIT_LENGTH / (length * _times_shorter(*_factors(sigma, jumps, v, a, before)))


def _radius_below(offset: float, depth: Floats) -> Floats:
    return np.maximum(depth - offset, 0.0)


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(region: SwingingRegion) -> list[Step]:
    return [_positions_step(region), _vectors_step(region), _lines_step(region), _centre_step(region)]


def _view(region: SwingingRegion) -> View:
    return at_scale(POSITIONS, region.givens.mu_l)


def _shown_lines(region: SwingingRegion) -> tuple[list[Words], NDArray[np.intp], NDArray[np.intp]]:
    """The names of all limit lines, their numbers among them, and the stations that they belong to."""
    integrated = region.givens.integrated
    names, jumps = station_names(integrated.givens.stations), jump_stations(integrated)
    at = np.append(np.arange(len(names)), jumps)
    named: list[Words] = [*names, *(say("{name} before the jump", name=names[k]) for k in jumps)]
    return named, np.arange(at.size), at


def _positions_step(region: SwingingRegion) -> Step:
    givens, (pivot, positions) = region.givens, (region.acts[name].first for name in ("pivot", "positions"))
    integrated = givens.integrated
    s, factor, names = (
        integrated.first("s"),
        np.degrees(integrated.readings["s"].per_mm),
        station_names(integrated.givens.stations),
    )
    k = int(np.argmax(s))
    said = say(
        "Mark the pivot C on the right. Draw the line through it at rest horizontally to the left, and from there, "
        "upwards (clockwise), with the protractor the line of every station at its displacement. Station {name}: "
        "{turn}."
    ).with_values(name=names[k], turn=turning_angle(s[k], factor))
    length = givens.mu_l.paper(givens.distance)
    ends = positions.shown + length * unit(positions.directions)
    lowest = positions[int(np.argmin(s))]
    marks = (
        *(pivot.dots(), pivot.label("C", 1 + 0j)),
        Segments(positions.shown, ends, Role.CONSTRUCTION).left_by(positions),
        Line(np.array([0j, complex(-length)]), Role.AXIS).left_by(lowest),
    )
    why = say("The displacement of the face is the angle through which it turns about its pivot.")
    turns = run(said, STATION, names, positions, settings=lambda n: turning_angle(s[n], factor))
    return Step(say("Positions of the face"), (turns,), _view(region), marks, why=why)


def _vectors_step(region: SwingingRegion) -> Step:
    integrated, sigma = region.givens.integrated, sense(region.givens.rotation)
    aside, vectors, normals = (region.acts[name].first for name in ("ends along", "N", "normals"))
    named, every, at = _shown_lines(region)
    stations = integrated.givens.stations
    times = _shortenings(region)
    along, square = (
        _first(region.acts[name].act.takes["length"]) / UNIT_LENGTH * times for name in ("ends along", "N")
    )
    v = integrated.first("v") * integrated.readings["v"].per_mm

    def factors(n: int) -> Caption:
        """The factors K and L of a station, and how they are shortened, as a caption."""
        said = say("σv = {v:.4f}: K = {square:.4f}, L = {along:.4f}")
        if times[n] > 1:
            said = say("σv = {v:.4f}: K = {square:.4f}, L = {along:.4f}, both laid off {times:g} times shorter")
        values = {"square": float(square[n]), "along": float(along[n]), "times": float(times[n])}
        return said.with_values(v=sigma * float(v[at[n]]), **values)

    k = int(np.argmax(np.abs(along)))
    said = say(
        "Read the velocity and the acceleration of every station and calculate K and L; where the acceleration jumps, "
        "L has two values. From C lay off {unit:g} mm × L along the line of the station, away from C where L is "
        "positive, and from there {unit:g} mm × K square to it, downwards, to N. Station {name}: {factors}."
    ).with_values(unit=UNIT_LENGTH, name=named[k], factors=factors(k))
    rows = tuple(
        Row(STATION.with_values(name=named[n]), factors(n), (aside[[n]], vectors[[n]], normals[[n]]))
        for n in every.tolist()
    )
    count = stations.u.size
    marks = (
        normals.segments(Role.CONSTRUCTION),
        vectors.dots(Role.CURVE),
        *number_labels(
            vectors[:count],
            stations,
            vectors.shown[:count],
            shown=clear_numbers(vectors.shown[:count], stations, np.array([0j])),
        ),
    )
    why = say(
        "Measured square to the line through the pivot and along it, A lies c·sin ψ and c·cos ψ from C: K and L are "
        "their factors in the radius of curvature."
    )
    return Step(say("The factors of the curvature"), (Part(said, rows=rows),), _view(region), marks, why=why)


def _shortenings(region: SwingingRegion) -> Floats:
    """By how much every vector N is drawn shorter."""
    integrated = region.givens.integrated
    read = (integrated.first(name) * integrated.readings[name].per_mm for name in ("v", "a", "a_before"))
    return _times_shorter(*_factors(sense(region.givens.rotation), jump_stations(integrated), *read))


def _first(length: Setting) -> Floats:
    return length.amount[0] if length.sampled else length.amount


def _lines_step(region: SwingingRegion) -> Step:
    givens, touched = region.givens, region.acts["feet"].first
    limits, circle = region.acts["limits"].first, region.acts["circle of the centre"].first
    named, every, _ = _shown_lines(region)
    permitted, times = givens.least_curvature + givens.face_offset, _shortenings(region)
    length = np.abs(region.acts["N"].first.shown) * times
    far = permitted / givens.mu_l.per_mm * UNIT_LENGTH / length

    def laid_off(n: int) -> Caption:
        """The length laid off on a line [mm of paper], as a caption."""
        return say("{far:.2f} mm", far=float(far[n]))

    k = int(np.argmin(_ends_on(region).imag[: len(named)]))
    said = say(
        "The radius of curvature must be at least ρ = {least:g} mm. On every CN lay off from C, towards N, "
        "(ρ + f)/μ × {unit:g} mm/CN = {paper:.2f} mm × {unit:g} mm/CN, and draw the normal to CN there with two set "
        "squares. Station {name}: {far:.2f} mm. A must lie on the side away from C."
    ).with_values(
        least=givens.least_curvature,
        unit=UNIT_LENGTH,
        paper=permitted / givens.mu_l.per_mm,
        name=named[k],
        far=float(far[k]),
    )
    if abs(permitted) < 1e-9:
        said = say(
            "The radius of curvature must be at least ρ = {least:g} mm, and ρ + f is zero: draw through C the normal "
            "to every CN with two set squares. A must lie below it."
        ).with_values(least=givens.least_curvature)
    elif times.max() > 1:
        shorter = say("A vector that is laid off shorter counts with its whole length.")
        said = sequence([said, shorter], " ")
    rows = tuple(
        Row(STATION.with_values(name=named[n]), laid_off(n), (touched[[n]], limits[[n]])) for n in every.tolist()
    )
    parts, marks = [Part(said, rows=rows)], [_strokes(region, "limits")]
    if "limits at rest" in region.acts:
        rests = say(
            "In the dwells K = 1 and L = 0: there the line is parallel to the face, {paper:.2f} mm below C."
        ).with_values(paper=permitted / givens.mu_l.per_mm)
        parts.append(Part(rests, (region.acts["limits at rest"].first,)))
        marks.append(_strokes(region, "limits at rest"))
    assert circle.radius is not None
    why = say("On this line ρ = c·(K·sin ψ + L·cos ψ) − f has the permitted value, and beyond it a larger one.")
    return Step(say("The limit lines"), tuple(parts), _view(region), tuple(marks), why=why)


def _ends_on(region: SwingingRegion, name: str = "limits") -> NDArray[np.complexfloating[Any, Any]]:
    """Where limit lines meet the circle of the cam centre."""
    lines = region.acts[name].first
    radius, way = region.givens.mu_l.paper(region.givens.distance), unit(np.atleast_1d(lines.directions))
    sign = -1 if name == "limits" else 1  # as they are recorded, before they are reversed
    away = sign * way
    along = -(lines.shown.conj() * away).real
    square = np.abs(lines.shown + along * away)
    return lines.shown + (along + np.sqrt(radius**2 - square**2)) * away


def _strokes(region: SwingingRegion, name: str) -> Segments:
    """The limit lines about the circle on which the cam centre lies."""
    lines, ends = region.acts[name].first, _ends_on(region, name)
    way = unit(ends - lines.shown)
    return Segments(ends - LINE_LENGTH * way, ends + LINE_OVERHANG * way, Role.LIMIT).left_by(lines)


def _centre_step(region: SwingingRegion) -> Step:
    givens, centre = region.givens, region.acts["A"].first[0]
    circle, mu = region.acts["circle of the centre"].first, region.givens.mu_l.per_mm
    depth, r0, f = float(region.value("depth")), float(region.value("prime_radius")), givens.face_offset
    assert circle.radius is not None
    said = say(
        "Set the compass to {paper:.1f} mm (c = {distance:g} mm at {ratio}) and draw the arc about C across the lines. "
        "Between the stations the lines change smoothly: the one that meets the arc farthest down leaves the highest "
        "place to the cam centre. Mark it A₀."
    ).with_values(paper=float(np.asarray(circle.radius)), distance=givens.distance, ratio=ratio_text(mu))
    measured = _radius_caption(f).with_values(paper=depth / mu, mu=mu, depth=depth, r0=r0, f=abs(f))
    # The arc meets all lines.
    met = [_ends_on(region, name) for name in ("limits", "limits at rest") if name in region.acts]
    turns = np.angle(-np.concatenate([*met, [centre.place, -1.0]]))
    foot = complex(centre.place.real)
    marks = (
        Arc(
            0j,
            abs(centre.place),
            np.pi + float(np.nanmin(turns)) - 0.1,
            np.pi + float(np.nanmax(turns)) + 0.1,
            Role.CONSTRUCTION,
        ).left_by(circle),
        *(centre.dots(Role.RESULT), centre.label("A₀", -1 - 1j)),
        Dimension(foot, centre.place, say("{depth:.2f}", depth=depth), -12.0, of=region.readings["depth"].act),
    )
    why = say("The face at rest lies on the horizontal through C, f beside it, and touches the prime circle about A.")
    parts = Part(said, (circle, centre)), Part(measured)
    return Step(say("The minimum prime radius"), parts, _view(region), marks, ("depth", "prime_radius"), why=why)


def _radius_caption(f: float) -> Caption:
    if f == 0:
        return say("A₀ lies {paper:.2f} mm below the face at rest: r₀ = {paper:.2f} mm × {mu:.5g} = {r0:.3f} mm.")
    if f > 0:
        return say(
            "A₀ lies {paper:.2f} mm × {mu:.5g} = {depth:.3f} mm below the horizontal through C: r₀ = {depth:.3f} − "
            "{f:g} = {r0:.3f} mm."
        )
    return say(
        "A₀ lies {paper:.2f} mm × {mu:.5g} = {depth:.3f} mm below the horizontal through C: r₀ = {depth:.3f} + "
        "{f:g} = {r0:.3f} mm."
    )
