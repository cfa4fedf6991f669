"""The hand that draws one construction, with ruler, compass, set squares, dividers, protractor: none without error.

Every act errs as :mod:`~graphcam.drafting.slips` says, is recorded, and returns what it leaves on the paper.  Points
and lines are :class:`~graphcam.drafting.acts.Drawn`; a direction is one of them, or a given complex number.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from graphcam.drafting import curve, euclid
from graphcam.drafting.acts import Act, Drawn, Floats, Index, Kind, Setting
from graphcam.drafting.ink import Construction, G, Reading, Step
from graphcam.drafting.marks import Points
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil, Stream
from graphcam.drafting.slips import SLIPS
from graphcam.plane_vectors import dot

BISECTION_SHARE = 0.8
"""To bisect a chord the compass is set to this part of it."""

Direction = Drawn | Points | complex
Length = Setting | ArrayLike


def distance_between(start: Drawn, end: Drawn, along: Drawn | complex | None = None) -> Setting:
    """The distance of two places, or the signed part of the way along a direction: taken up with dividers, or read."""
    if along is None:
        a, b = _aligned(_places(start), _places(end))
        amount = np.abs(b - a)
    else:
        a, b, d = _aligned(_places(start), _places(end), _way(along))
        amount = dot(euclid.unit(d), b - a)
    return Setting(amount, ends=(start, end), along=along, sampled=start.sampled or end.sampled)


def calculated_setting(formula: Callable[..., Floats], *given: Setting) -> Setting:
    """What a formula makes, in the head, of lengths or angles that were read or taken up."""
    amount = formula(*(each.amount for each in given))
    return Setting(amount, formula=formula, given=given, sampled=any(each.sampled for each in given))


def _aligned(*given: tuple[Any, bool]) -> list[Any]:
    """Arrays, and of each whether the samples stand first: with stations last in all of them, if any has stations."""
    own = max(array.ndim - sampled for array, sampled in given)
    return [array[..., None] if sampled and array.ndim - 1 < own else array for array, sampled in given]


def _places(drawn: Drawn) -> tuple[Points, bool]:
    return drawn.points, drawn.sampled


def _way(direction: Direction) -> tuple[Points, bool]:
    if isinstance(direction, Drawn):
        return direction.directions, direction.sampled
    return np.asarray(direction), False


def _radii(circle: Drawn) -> tuple[Floats, bool]:
    assert circle.radius is not None
    return circle.radius, circle.sampled


def _amount(length: Length) -> tuple[Floats, bool]:
    if isinstance(length, Setting):
        return length.amount, length.sampled
    return np.asarray(length, dtype=np.float64), False


class Hand:
    """A pencil at work on one construction.

    meaning : the construction's name, reason and readings
    lift : the unit of the lift, in those of its readings
    acts : what was done so far, by the name of what it left
    readings : what was read

    >>> import graphcam as gc
    >>> from graphcam.drafting.ink import say
    >>> hand = Hand(gc.Pencil(), Meaning("triangle", say("Triangle"), say("Three sides are given.")))
    >>> a, b = hand.given("A", 0j), hand.given("B", 6 + 0j)
    >>> above = hand.cross("C", hand.circle("about A", a, 5.0), hand.circle("about B", b, 5.0))
    >>> above.place, [str(left.act.kind) for left in hand.acts.values()]
    ((3+4j), ['given', 'given', 'circle', 'circle', 'cross'])
    """

    def __init__(self, pencil: Pencil, meaning: Meaning, lift: str = "mm") -> None:
        self.pencil, self.meaning, self.lift = pencil, meaning, lift
        self.acts: dict[str, Drawn] = {}
        self.readings: dict[str, Reading] = {}
        self._stream: Stream | None = None

    # --- what lies there ---------------------------------------------------------------------------------------------

    def given(self, name: str, points: ArrayLike = 0j, along: ArrayLike | None = None) -> Drawn:
        """Places, or lines along a direction, that lie on the board before the first act: origin, axes, data."""
        places, direction = np.asarray(points, dtype=np.complex128), None
        if along is not None:
            places, direction = np.broadcast_arrays(places, np.asarray(along, dtype=np.complex128))
        takes = {"points": places, "along": direction}
        return self._record_act(Kind.GIVEN, name, takes, self.pencil.sheets(places), direction)

    def earlier_places(self, construction: Construction, name: str) -> Drawn:
        """Places of a drawing that was made before, by their name there."""
        acts, place = construction.acts, (construction.name, name)
        along = acts[name].along if name in acts else None
        takes = {"place": place, "of": acts.get(name)}
        return self._record_act(Kind.GIVEN, ": ".join(place), takes, construction.points[name], along)

    def take(self, name: str, *drawn: Drawn, which: Index | None = None) -> Drawn:
        """Some of what lies there, to go on with: all of it in a row, or in each sample the places of the index."""
        if len(drawn) == 1 and which is None:
            points, along = drawn[0].points, drawn[0].along
        else:
            points = self._row([each.points for each in drawn])
            along = None if drawn[0].along is None else self._row([each.directions for each in drawn])
        if which is not None:
            points, along = (None if each is None else _chosen_places(each, which) for each in (points, along))
        assert points is not None
        return self._record_act(Kind.TAKE, name, {"of": drawn, "which": which}, points, along)

    def _row(self, parts: Sequence[Points]) -> Points:
        own = self.pencil.samples is not None
        return np.concatenate([part if part.ndim > own else part[..., None] for part in parts], axis=-1)

    def enlarged(self, name: str, drawn: Drawn, origin: Drawn, times: complex, to: complex = 0j) -> Drawn:
        """What is drawn, as another view shows it: about an origin, scaled and turned by ``times``, moved ``to``."""
        points, about = _aligned(_places(drawn), _places(origin))
        takes = {"of": drawn, "origin": origin, "times": times, "to": to}
        along = None if drawn.along is None else drawn.along * times
        radius = None if drawn.radius is None else drawn.radius * abs(times)
        return self._record_act(Kind.ENLARGE, name, takes, to + (points - about) * times, along, radius)

    def mirrored(self, name: str, drawn: Drawn, axis: Drawn) -> Drawn:
        """Places, lines or circles reflected in a line."""
        points, start, way = _aligned(_places(drawn), _places(axis), _way(axis))
        twice = euclid.unit(way) ** 2
        along = None if drawn.along is None else np.conj(drawn.along) * twice
        image = start + np.conj(points - start) * twice
        return self._record_act(Kind.ENLARGE, name, {"of": drawn, "axis": axis}, image, along, drawn.radius)

    def raised(self, name: str, drawn: Drawn, by: Setting) -> Drawn:
        """Places raised by a length each, on an axis that was found only later."""
        points, height = _aligned(_places(drawn), _amount(by))
        return self._record_act(Kind.ENLARGE, name, {"of": drawn, "by": by}, points + euclid.UP * height)

    # --- dividers ----------------------------------------------------------------------------------------------------

    def divide(self, name: str, start: Drawn, end: Drawn, share: ArrayLike) -> Drawn:
        """Places at given shares of the way from start to end; a mark that is new is off by a divider setting."""
        a, b, part = _aligned(_places(start), _places(end), _amount(share))
        points = a + (b - a) * part
        if self.pencil.dividers:
            new = (part > 0) & (part < 1)
            points = points + euclid.unit(b - a) * new * self._errors(Kind.DIVIDE, "along", points)
        return self._record_act(Kind.DIVIDE, name, {"start": start, "end": end, "share": part}, points)

    def lay_off(self, name: str, start: Drawn, along: Direction, length: Length) -> Drawn:
        """Places at a length from start in a direction (of length one), off by a divider setting."""
        a, d, mm = _aligned(_places(start), _way(along), _amount(length))
        if isinstance(along, Drawn):
            d = euclid.unit(d)
        points = a + d * mm
        if self.pencil.dividers:
            # Nothing is set where there is nothing to lay off.
            points = points + d * (mm != 0) * self._errors(Kind.LAY_OFF, "along", points)
        return self._record_act(Kind.LAY_OFF, name, {"start": start, "along": along, "length": length}, points)

    # --- ruler, T-square and set squares -----------------------------------------------------------------------------

    def erect(self, name: str, feet: Drawn, along: Direction = euclid.UP) -> Drawn:
        """Lines of a known direction through places, drawn beside them by a line's offset."""
        return self._through(Kind.ERECT, name, {"feet": feet, "along": along}, feet, along, 1)

    def parallel(self, name: str, to: Drawn, through: Drawn) -> Drawn:
        """Lines through places, carried by set squares: off by an offset and a small turn."""
        return self._through(Kind.PARALLEL, name, {"to": to, "through": through}, through, to, 1)

    def perpendicular(self, name: str, to: Drawn, through: Drawn) -> Drawn:
        """Lines through places, perpendicular to others on the left of their directions."""
        return self._through(Kind.PERPENDICULAR, name, {"to": to, "through": through}, through, to, euclid.UP)

    def _through(
        self, kind: Kind, name: str, takes: Mapping[str, Any], places: Drawn, to: Direction, turn: complex
    ) -> Drawn:
        points, along = np.broadcast_arrays(*_aligned(_places(places), _way(to)))
        along = along * turn
        points = self._with_place_errors(kind, "across", points, along * euclid.UP)
        if self.pencil.line and "turn" in SLIPS[kind]:
            along = euclid.turned_direction(along, self._errors(kind, "turn", points))
        return self._record_act(kind, name, takes, points, along)

    def join(self, name: str, start: Drawn, end: Drawn) -> Drawn:
        """The lines from places to others, with no error but that of the places."""
        a, b = np.broadcast_arrays(*_aligned(_places(start), _places(end)))
        return self._record_act(Kind.JOIN, name, {"start": start, "end": end}, a, b - a)

    def project(self, name: str, points: Drawn | Setting, onto: Drawn) -> Drawn:
        """The feet of places, or of given heights along them, on lines: off along the line by a line's offset."""
        if isinstance(points, Setting):
            q, d, height = _aligned(_places(onto), _way(onto), _amount(points))
            feet = q + euclid.unit(d) * height
        else:
            p, q, d = _aligned(_places(points), _places(onto), _way(onto))
            feet = euclid.foot(p, q, d)
        feet = self._with_place_errors(Kind.PROJECT, "along", feet, d)
        return self._record_act(Kind.PROJECT, name, {"points": points, "onto": onto}, feet)

    def end_to_end(self, name: str, lines: Drawn, cuts: Drawn, chains: Sequence[tuple[slice, slice]]) -> Drawn:
        """Chords set end to end, each parallel to its line, from one upright to the next.

        cuts : feet of the uprights, where the first chord of each chain starts
        chains : for each the slice of its cuts and that of its lines

        Every chord is turned by its set square and its end is off on the upright; the next one starts from there.
        """
        heights = np.zeros(cuts.points.shape)
        for at, parts in chains:
            direction, x = lines.directions[..., parts], cuts.points[..., at].real
            if self.pencil.line:
                direction = euclid.turned_direction(direction, self._errors(Kind.PARALLEL, "turn", direction))
            rises = euclid.climb_along(direction, np.diff(x))
            if self.pencil.line:
                rises = rises + self._errors(Kind.PARALLEL, "across", rises)
            heights[..., at][..., 1:] = np.cumsum(rises, axis=-1)
        takes = {"lines": lines, "cuts": cuts, "chains": tuple(chains)}
        return self._record_act(Kind.PARALLEL, name, takes, cuts.points + euclid.UP * heights)

    def cross(self, name: str, one: Drawn, other: Drawn, *, flat: bool = False) -> Drawn:
        """Where two lines meet; where a ray leaves a circle; where two circles meet, left of the way between centres.

        flat : whether what crosses at less than a degree counts as well, and circles that miss by a little
        """
        p, q = _places(one), _places(other)
        if one.radius is not None:
            p, r, q, s = _aligned(p, _radii(one), q, _radii(other))
            found = euclid.circle_crossing(p, r, q, s, flat=flat)
        elif other.radius is not None:
            p, d, q, r = _aligned(p, _way(one), q, _radii(other))
            found = euclid.ray_to_circle(p, d, q, r)
        else:
            p, d, q, e = _aligned(p, _way(one), q, _way(other))
            found = (euclid.crossing if flat else euclid.readable_crossing)(p, d, q, e)
        return self._record_act(Kind.CROSS, name, {"one": one, "other": other, "flat": flat}, found)

    def meet(self, name: str, one: Drawn, faired: Drawn) -> Drawn:
        """Where rays, or circles about places, meet a curve that was faired, each farthest out; with its directions.

        Of circles those meetings count that lie left of the way from the origin to their centres.
        """
        if one.radius is None:
            reach = curve.along_rays(one.points, euclid.unit(one.directions))
        else:
            reach = curve.on_circles(one.points, one.radius)
        plotted, pieces = faired.act.takes["points"], faired.act.takes["pieces"]
        takes = {"one": one, "curve": faired}
        return self._record_act(Kind.CROSS, name, takes, *curve.meeting(plotted.points, pieces, reach))

    # --- compass and protractor --------------------------------------------------------------------------------------

    def circle(self, name: str, centre: Drawn, radius: Length) -> Drawn:
        """Circles: the centre is pricked off by half a line, the radius is off by a divider setting."""
        points, r = np.broadcast_arrays(*_aligned(_places(centre), _amount(radius)))
        if self.pencil.line:
            across, up = (self._errors(Kind.CIRCLE, way, points) for way in ("across", "up"))
            points = points + across + euclid.UP * up
        if self.pencil.dividers:
            r = r + self._errors(Kind.CIRCLE, "radius", points)
        return self._record_act(Kind.CIRCLE, name, {"centre": centre, "radius": radius}, points, None, r)

    def bisect(self, name: str, start: Drawn, end: Drawn) -> Drawn:
        """The perpendicular bisectors of chords: off at both crossings of the arcs by a line over the root of two."""
        a, b = _aligned(_places(start), _places(end))
        middle, along = euclid.perpendicular_bisector(a, b)
        if self.pencil.line:
            apart = 2 * np.sqrt(BISECTION_SHARE**2 - 0.25) * np.abs(b - a)  # of the two crossings
            one, other = (self._errors(Kind.BISECT, crossing, middle) for crossing in ("one", "other"))
            middle = middle + euclid.unit(b - a) * (one + other) / 2
            along = euclid.turned_direction(along, (other - one) / apart)
        return self._record_act(Kind.BISECT, name, {"start": start, "end": end}, middle, along)

    def protractor(self, name: str, vertex: Drawn, base: Direction, angle: Length) -> Drawn:
        """Lines through places at angles [rad], counter-clockwise from a direction: off by the setting and a line."""
        points, d, turn = np.broadcast_arrays(*_aligned(_places(vertex), _way(base), _amount(angle)))
        along = euclid.turned_direction(d, self._with_angle_errors(Kind.PROTRACTOR, turn))
        points = self._with_place_errors(Kind.PROTRACTOR, "across", points, along * euclid.UP)
        return self._record_act(Kind.PROTRACTOR, name, {"vertex": vertex, "base": base, "angle": angle}, points, along)

    # --- curves ------------------------------------------------------------------------------------------------------

    def tangent(self, name: str, points: Drawn, pieces: Sequence[slice], inward: Direction) -> Drawn:
        """The lines square to ``inward`` that touch a curve, faired piece by piece, from its far side.

        A line is moved along until it touches: it is off across itself, and where it touches along it.
        """
        direction, sampled = _way(inward)
        plotted = points.points[..., None, :] if direction.ndim > sampled else points.points
        touch = self._with_place_errors(
            Kind.TANGENT, "across", curve.farthest_on_pieces(plotted, pieces, direction), direction
        )
        touch = self._with_place_errors(Kind.TANGENT, "along", touch, direction * euclid.UP)
        takes = {"points": points, "pieces": tuple(pieces), "inward": inward}
        return self._record_act(Kind.TANGENT, name, takes, touch, direction * euclid.UP)

    def tangents_at(self, name: str, points: Drawn, rule: Callable[[Points], Points] | None = None) -> Drawn:
        """The tangents of a plotted curve at all its points, by a mirror set across it: off by an angle and a line.

        rule : the directions that the eye sees, from the points and their neighbours; None where the points are some
            of a curve and have them
        """
        along = rule(points.points) if rule else points.directions
        along = euclid.turned_direction(along, self._with_angle_errors(Kind.TANGENT, np.zeros(along.shape)))
        beside = self._with_place_errors(Kind.TANGENT, "across", points.points, along * euclid.UP)
        return self._record_act(Kind.TANGENT, name, {"points": points, "rule": rule}, beside, along)

    def fair(self, name: str, points: Drawn, pieces: Sequence[slice], parts: int = 8) -> Drawn:
        """A smooth curve through plotted points, piece by piece, in so many short chords a part.

        Of lines through the points their angles are faired too, so that between them lies a family of lines.
        """
        along = None
        if points.along is not None:
            first = points.along[..., :1]
            turns: Points = np.angle(points.along / first) + 0j
            along = euclid.turned_direction(first, curve.faired_pieces(turns, pieces, parts).real)
        takes = {"points": points, "pieces": tuple(pieces), "parts": parts}
        return self._record_act(Kind.FAIR, name, takes, curve.faired_pieces(points.points, pieces, parts), along)

    # --- readings ----------------------------------------------------------------------------------------------------

    def carry(self, reading: Reading, factor: Floats | float = 1.0) -> Setting:
        """The lengths on paper, or the angles, of a reading times a factor, which may be one a sample."""
        paper, by = reading.paper, np.asarray(factor)
        own = self.pencil.samples is not None
        by = by[..., None] if own and by.ndim and paper.ndim > 1 else by
        return Setting(paper * by, reading=reading, factor=factor, sampled=own)

    def at_scale(self, value: float, reading: Reading) -> Setting:
        """The length on paper of a machine value, in the scale of a reading."""
        scale = np.asarray(reading.scale)
        return Setting(value / scale, reading=reading, value=value, sampled=bool(scale.ndim))

    def read(
        self, name: str, length: Setting, scale: Floats | float, unit: str = "", *, rounded: bool = True
    ) -> Reading:
        """A length on paper, read off a rule, or reckoned from others; its unit by what the construction says of it."""
        paper = self.pencil.read_off(length.amount) if rounded else length.amount
        return self._record_reading(name, {"length": length}, paper, scale, unit)

    def angle(self, name: str, base: Direction, line: Drawn, sense: int = 1) -> Reading:
        """The angles [rad] from a direction to lines, counter-clockwise or in a sense, measured with a protractor."""
        d, e = _aligned(_way(base), _way(line))
        paper = self._with_angle_errors(Kind.READ, sense * np.angle(e * np.conj(d)))
        return self._record_reading(name, {"base": base, "line": line, "sense": sense}, paper, 1.0, "rad")

    def finished(
        self, givens: G, draw: Callable[[Construction[G]], list[Step]], points: Mapping[str, Drawn | Points]
    ) -> Construction[G]:
        """The construction, with all that was read, the acts, and the places that later ones go on from."""
        places = {name: left.points if isinstance(left, Drawn) else left for name, left in points.items()}
        meaning, taken = self.meaning, self.readings
        if not meaning.readings.keys() <= taken.keys():  # it tells of those that were taken alone
            meaning = replace(meaning, readings={name: of for name, of in meaning.readings.items() if name in taken})
        return Construction(meaning, givens, self.pencil, self.readings, places, draw, self.acts)

    def _record_reading(
        self, name: str, takes: Mapping[str, Any], paper: Floats, scale: Floats | float, unit: str
    ) -> Reading:
        act = Act(Kind.READ, self.meaning.name, name, takes, self._size(paper))
        of = unit or self.meaning.readings[name].unit.replace("lift", self.lift)
        self.readings[name] = Reading(np.asarray(paper, dtype=np.float64), scale, of, act)
        return self.readings[name]

    def _size(self, values: Points | Floats) -> int:
        return math.prod(values.shape[self.pencil.samples is not None :])

    # --- errors ------------------------------------------------------------------------------------------------------

    def _with_place_errors(self, kind: Kind, what: str, points: Points, along: Points) -> Points:
        """Places moved by an act's errors along a direction of any length."""
        return points + euclid.unit(along) * self._errors(kind, what, points) if self.pencil.line else points

    def _with_angle_errors(self, kind: Kind, angles: Floats) -> Floats:
        """Angles with the errors of setting or reading them."""
        return angles + self._errors(kind, "turn", angles) if self.pencil.protractor else angles

    def _errors(self, kind: Kind, what: str, like: Any) -> Floats:
        """Errors of a kind of act, shaped like an array; drawn even where they are zero, to keep the stream in step."""
        if self._stream is None:
            self._stream = self.pencil.stream(self.meaning.name)
        return self.pencil.slips(kind, what, self._stream, like.shape)

    def _record_act(
        self,
        kind: Kind,
        name: str,
        takes: Mapping[str, Any],
        points: Points,
        along: Points | None = None,
        radius: Floats | None = None,
    ) -> Drawn:
        if along is not None and along.shape != points.shape:
            along = np.broadcast_to(along, points.shape)  # one direction for all places
        act = Act(kind, self.meaning.name, name, takes, self._size(points))
        self.acts[name] = Drawn(act, points, along, radius, self.pencil.samples is not None)
        return self.acts[name]


def errorless_hand(construction: Construction) -> Hand:
    """A hand without errors for what the steps only show, such as an enlarged detail."""
    return Hand(Pencil(), construction.meaning)


def _chosen_places(values: Points, which: Index) -> Points:
    if isinstance(which, np.ndarray) and which.ndim == values.ndim:  # other places in every sample
        return np.take_along_axis(values, np.asarray(which, dtype=np.intp), -1)
    return values[..., which]
