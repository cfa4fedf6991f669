"""The follower's motion over one revolution: phases one after another, and the values at any cam angle."""

from __future__ import annotations

import inspect
import math
import reprlib
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import pairwise
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.laws import Floats, LawName, Side, canonical_law, law, law_of_return
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Piece, Piecewise, chunks, dwell_formula, in_phase
from graphcam.showing import Plottable, value_text
from graphcam.words import Words, bare_caption, say

CLOSURE_TOLERANCE = 1e-9
"""How far the angles may miss a full turn (rad), and the lifts zero (relative to the maximum)."""
FULL_TURN = 2 * math.pi
SHORTEST_PHASE = 1e-10
"""A phase that leaves less of the turn than this [rad] is lost in the rounding of the places where phases begin."""
NEAR_TURN_SHARE = 0.02
"""So much of a turn angles may miss it and still be meant for one, where another unit or argument is looked for."""


def _check_positive(angle: float) -> None:
    check_number("angle", angle, say("a finite number greater than 0 rad"), above=0)


def _check_turn(angle: float, remedy: Words) -> None:
    """Check that a phase is no longer than a turn: an angle in degrees is told from one in radians by that."""
    if angle > FULL_TURN + CLOSURE_TOLERANCE:
        raise DesignError("angle", say("{angle:.6g} rad", angle=angle), say("at most a full turn, 2 pi rad"), remedy)


class DegreesWarning(UserWarning):
    """A cam angle in radians that looks like degrees."""


@cache
def _warn_of_degrees() -> None:
    """Tell once that cam angles are radians, with the user's line."""
    frame, level = inspect.currentframe(), 1
    while frame and frame.f_back and frame.f_globals["__name__"].startswith("graphcam."):
        frame, level = frame.f_back, level + 1
    told = "cam angles are radians here; a whole number beyond 2 pi looks like degrees: write gc.cam_angle(60) for 60°"
    warnings.warn(told, DegreesWarning, stacklevel=level)


def angles_of(given: ArrayLike) -> Floats:
    """Cam angles as an array.

    Raises
    ------
    DesignError : they are no numbers

    >>> angles_of("60 deg")
    Traceback (most recent call last):
    graphcam.errors.DesignError: cam angle is '60 deg', but must be a number, or an array of numbers
    """
    try:
        return np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        found = bare_caption(reprlib.repr(given))
        raise DesignError(say("cam angle"), found, say("a number, or an array of numbers")) from None


def wrap(phi: ArrayLike) -> Floats:
    """The cam angles in [0, 2 pi); NaN and infinities give NaN.

    >>> wrap([-0.25, 7.0]).round(3).tolist()
    [6.033, 0.717]
    """
    phi = angles_of(phi)
    if phi.size and phi.min() >= 0 and phi.max() < FULL_TURN:
        return phi  # the usual case, and the remainder is dear
    if phi.size == 1 and float(phi.item()).is_integer():
        _warn_of_degrees()
    with np.errstate(invalid="ignore"):
        turned = np.mod(phi, FULL_TURN)
    return np.where(turned < FULL_TURN, turned, turned - FULL_TURN)  # a tiny negative angle rounds up to a full turn


def cam_angle(angle: ArrayLike, turn: float = 360.0) -> Floats:
    """The cam angle [rad] in [0, 2 pi) of an angle given in degrees, or in a unit of which ``turn`` make a turn.

    It is reduced before it becomes radians: a thousand million turns in radians are known to a millionth of a degree.

    >>> import graphcam as gc
    >>> (gc.cam_angle(37.5 + 360e9) == gc.cam_angle(37.5)).item(), gc.cam_angle(-0.25, turn=1.0).item() / math.pi
    (True, 1.5)
    """
    with np.errstate(invalid="ignore"):
        return wrap(np.mod(angles_of(angle), turn) * (FULL_TURN / turn))


def _check_side(side: str) -> None:
    if side not in ("right", "left"):
        raise DesignError("side", side, say("'right' or 'left'"))


@dataclass(frozen=True)
class Dwell:
    """A dwell over ``angle`` radians of the cam.

    >>> import graphcam as gc
    >>> gc.Dwell(angle=math.pi)
    Dwell(angle=3.141592653589793)
    """

    angle: float
    kind: ClassVar[str] = "dwell"
    direction: ClassVar[int] = 0

    def __post_init__(self) -> None:
        _check_positive(self.angle)
        _check_turn(self.angle, f"write math.radians({self.angle:.6g}) if it is in degrees")

    @property
    def lift(self) -> float:
        """A dwell lifts nothing."""
        return 0.0


@dataclass(frozen=True)
class MovingPhase:
    """What a rise and a return have in common: a lift [mm] by a law over an angle [rad]."""

    kind: ClassVar[str]
    direction: ClassVar[int]

    lift: float
    angle: float
    law: LawName | Law = "3-4-5"
    ratio: float = 1.0

    def __post_init__(self) -> None:
        check_number("lift", self.lift, say("a finite number greater than 0 mm"), above=0)
        _check_positive(self.angle)
        in_degrees = say("write math.radians({angle:.6g}) if it is in degrees", angle=self.angle)
        swapped = say(
            "{in_degrees}, or {swapped} if the two are swapped", in_degrees=in_degrees, swapped=_swapped_arguments(self)
        )
        remedy = swapped if self.lift <= FULL_TURN else in_degrees
        _check_turn(self.angle, remedy)
        object.__setattr__(self, "law", canonical_law(self.law))
        _ = self.normalised  # says at once if there is no such law

    @cached_property
    def normalised(self) -> Law:
        """The phase's law on [0, 1]: the one of that name, or the given one."""
        return law(self.law, self.ratio)

    @property
    def peak_acceleration(self) -> float:
        """The maximum |a| [mm/rad^2; of an arm 1/rad], infinite where the velocity jumps."""
        return self.normalised.peak_acceleration * self.lift / self.angle**2

    @property
    def steady_acceleration(self) -> float:
        """The maximum |a| between blows [mm/rad^2; of an arm 1/rad], which can be drawn."""
        return self.normalised.steady_acceleration * self.lift / self.angle**2


@dataclass(frozen=True)
class Rise(MovingPhase):
    """A phase that lifts the follower by ``lift`` over ``angle`` radians: s = lift f(u).

    lift : mm; of an arm rad;  angle : rad;  law : one of :data:`graphcam.LAWS`, or a :class:`graphcam.Law` of one's own
    ratio : |first part's acceleration| / |second part's|, of a law that may have unequal parts

    >>> import graphcam as gc
    >>> gc.Rise(30, math.radians(120), "cycloidal")
    Rise(lift=30, angle=2.0943951023931953, law='cycloidal', ratio=1.0)
    >>> gc.Rise(30, 120)
    Traceback (most recent call last):
    graphcam.errors.DesignError: angle is 120 rad, but must be at most a full turn, 2 pi rad; write ...
    """

    kind: ClassVar[str] = "rise"
    direction: ClassVar[int] = 1


@dataclass(frozen=True)
class Return(MovingPhase):
    """A phase that lowers the follower by ``lift`` over ``angle`` radians: s = lift (1 - f(u)).

    ``ratio`` is |first part's acceleration| / |second part's|, in time, as in a rise.  By the name of a law without a
    dwell, "double-harmonic" or "eighth-degree", it mirrors the rise.

    >>> import graphcam as gc
    >>> gc.Return(lift=30, angle=math.radians(90), law="rectangular", ratio=2.0).normalised.name
    'rectangular'
    """

    kind: ClassVar[str] = "return"
    direction: ClassVar[int] = -1

    @cached_property
    def normalised(self) -> Law:
        """The phase's law on [0, 1] of the way down: the one of that name, or the given one."""
        return law_of_return(self.law, self.ratio)


Phase = Rise | Dwell | Return


class MotionValues(NamedTuple):
    """The displacement [mm; of an arm rad] and its derivatives by the cam angle, arrays of one shape."""

    s: Floats
    v: Floats
    a: Floats
    j: Floats


class PhaseSpan(NamedTuple):
    """The kind of a phase, and the cam angles [rad] from which and to which it lasts."""

    kind: str
    start: float
    end: float


class Blow(NamedTuple):
    """Where v jumps, or as good as jumps: the cam angle [rad], and the maximum a there with its sign [mm/rad^2]."""

    phi: float
    acceleration: float


@dataclass(frozen=True, eq=False, repr=False)
class Motion(Plottable):
    """The motion s(phi) of a follower over one revolution of the cam.

    Call it with cam angles in radians for (s, v, a, j), the displacement and its derivatives by phi; for degrees write
    ``motion(gc.cam_angle(60))``.

    Parameters
    ----------
    phases : rises, dwells and returns in order; the angles sum to 2 pi and the lifts to zero, both to 1e-9

    Raises
    ------
    DesignError : there is no rise or no return, or the angles or the lifts do not close

    >>> import graphcam as gc
    >>> from math import pi
    >>> motion = gc.Motion([gc.Rise(30, pi / 2), gc.Dwell(pi / 2), gc.Return(30, pi, "cosine")])
    >>> motion
    Motion with a lift of 30 (mm; of an arm, rad)
      rise by 30 over 90°, 3-4-5
      dwell over 90°
      return by 30 over 180°, cosine
    motion(phi) gives s, v, a and j at phi in rad; .plot() draws them
    >>> s, v, a, j = motion(gc.cam_angle([45, 180]))
    >>> s.tolist()
    [15.0, 30.0]
    """

    _drawn_in = "motion_curves.plot"

    phases: Sequence[Phase]
    starts: Floats = field(init=False)
    """(k,) cam angle at which each phase begins"""
    levels: Floats = field(init=False)
    """(k + 1,) displacement at which each phase begins, and the last one ends; the lowest is 0"""
    first_piece: NDArray[np.intp] = field(init=False, repr=False)
    """(k + 1,) number of each phase's first piece, and the count of all"""
    _piecewise: Piecewise = field(init=False, repr=False)
    """s and its derivatives over the turn: the pieces of the laws, and the dwells"""

    def __post_init__(self) -> None:
        check_kind("phases", self.phases, Iterable, say("a list of rises, dwells and returns"))
        phases = tuple(self.phases)
        for phase in phases:
            check_kind("phase", phase, (Rise, Dwell, Return))
        angles = [phase.angle for phase in phases]
        steps = [phase.direction * phase.lift for phase in phases]
        for direction, found, remedy in (
            (1, say("without a rise"), say("add a rise")),
            (-1, say("without a return"), say("add a return")),
        ):
            if all(phase.direction != direction for phase in phases):
                raise DesignError("motion", found, say("one with a rise and a return"), remedy)
        turn = math.fsum(angles)
        if abs(turn - FULL_TURN) > CLOSURE_TOLERANCE:
            total = say("{turn:.6g} rad ({degrees:.10g} degrees)", turn=turn, degrees=math.degrees(turn))
            quantity = say("sum of the phase angles")
            raise DesignError(quantity, total, say("2 pi rad (360 degrees)"), _remedy(phases, turn))
        closing = math.fsum(steps)
        if abs(closing) > CLOSURE_TOLERANCE * max(1.0, max(map(abs, steps))):
            remedy = say("make the lifts of rises and returns equal")
            quantity = say("sum of rises less returns")
            raise DesignError(quantity, say("{length:.10g} mm", length=closing), say("0 mm"), remedy)
        heights = [math.fsum(steps[:k]) for k in range(len(phases))]
        heights.append(heights[0])  # closed by definition: what the sum misses is rounding
        object.__setattr__(self, "phases", phases)
        starts = np.array([math.fsum(angles[:k]) for k in range(len(phases))])
        _check_lengths(phases, starts)
        levels = np.array(heights) - min(heights)
        parts = [
            _pieces(phase, (start, end), (float(below), float(above)))
            for phase, (start, end), (below, above) in zip(
                phases, pairwise([*starts.tolist(), FULL_TURN]), pairwise(levels), strict=True
            )
        ]
        object.__setattr__(self, "starts", starts)
        object.__setattr__(self, "levels", levels)
        object.__setattr__(self, "first_piece", np.cumsum([0, *map(len, parts)]))
        object.__setattr__(self, "_piecewise", Piecewise([piece for part in parts for piece in part]))

    @cached_property
    def lift(self) -> float:
        """The maximum displacement [mm]."""
        return float(self.levels.max())

    @cached_property
    def blows(self) -> tuple[Blow, ...]:
        """The blows, in which v jumps or as good as jumps, in order.

        >>> import graphcam as gc
        >>> uniform = gc.constant_velocity_law(0, 0)
        >>> gc.Motion([gc.Rise(30, 2.0, uniform), gc.Return(30, FULL_TURN - 2, "cosine")]).blows
        (Blow(phi=0.0, acceleration=inf), Blow(phi=2.0, acceleration=-inf))
        """
        return tuple(
            Blow(float(start) + phase.angle * end, phase.direction * (1 - 2 * end) * phase.peak_acceleration)
            for start, phase in zip(self.starts, self.phases, strict=True)
            if isinstance(phase, MovingPhase)
            for end, blow in enumerate(phase.normalised.blows)
            if blow
        )

    @property
    def corners(self) -> list[float]:
        """The cam angles [rad] of the blows in which v falls: there the cam has a corner."""
        return [*dict.fromkeys(blow.phi for blow in self.blows if blow.acceleration < 0)]

    def in_blow(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> NDArray[np.bool_]:
        """Whether fractions u of phases lie in a blow, where the velocity jumps; where it ends, as the side has it."""
        low, high = self._steady[np.asarray(phase, dtype=np.intp)].T
        u = np.asarray(u)
        return (u < low) | (u >= high) if side == "right" else (u <= low) | (u > high)

    @cached_property
    def _steady(self) -> Floats:
        """(k, 2) between which fractions of each phase there is no blow."""
        steady = [phase.normalised.steady if isinstance(phase, MovingPhase) else (0.0, 1.0) for phase in self.phases]
        low, high = np.array(steady).T
        return np.stack([np.where(low > 0, low, -np.inf), np.where(high < 1, high, np.inf)], axis=1)

    @cached_property
    def reference(self) -> tuple[int, float]:
        """The phase whose acceleration sets the scale of a drawing, and its maximum.

        The first rise; where its velocity jumps, so that it has none that could be drawn, the first phase that has one;
        else the first rise again, with the acceleration of the rectangular law.

        >>> import graphcam as gc
        >>> uniform = gc.constant_velocity_law(0, 0)
        >>> gc.Motion([gc.Rise(30, 2.0, uniform), gc.Return(30, FULL_TURN - 2, uniform)]).reference
        (0, 30.0)
        """
        moving = [(k, phase) for k, phase in enumerate(self.phases) if isinstance(phase, MovingPhase)]
        rises_first = sorted(moving, key=lambda each: each[1].direction < 0)
        rise = rises_first[0]
        for k, phase in (rise, *moving):
            if phase.steady_acceleration > 0:
                return k, phase.steady_acceleration
        return rise[0], 4 * rise[1].lift / rise[1].angle ** 2

    @cached_property
    def directions(self) -> Floats:
        """(k,) the direction of each phase: +1 of a rise, -1 of a return, 0 of a dwell."""
        return np.array([float(phase.direction) for phase in self.phases])

    @property
    def timing(self) -> list[PhaseSpan]:
        """The kind of every phase, and the cam angles [rad] from which and to which it lasts."""
        ends = [*self.starts.tolist(), FULL_TURN]
        return [PhaseSpan(phase.kind, *span) for phase, span in zip(self.phases, pairwise(ends), strict=True)]

    @property
    def origin(self) -> float:
        """The cam angle [rad], of what the motion was made of, at which its first phase begins; 0 for given phases."""
        return 0.0

    def __repr__(self) -> str:
        last = "motion(phi) gives s, v, a and j at phi in rad; .plot() draws them"
        return value_text(f"{type(self).__name__} {self._summary()}", map(_in_words, self.phases), last)

    def _summary(self) -> str:
        return f"with a lift of {self.lift:.6g} (mm; of an arm, rad)"

    @property
    def breaks(self) -> Floats:
        """The cam angles [rad] where a derivative may jump: starts of phases (0 among them), the laws' inner breaks."""
        inner = [
            start + phase.angle * b
            for start, phase in zip(self.starts, self.phases, strict=True)
            if not isinstance(phase, Dwell)
            for b in phase.normalised.breaks
        ]
        return np.unique(np.concatenate([self.starts, inner]))

    def __call__(self, phi: ArrayLike, side: Side = "right") -> MotionValues:
        """(s, v, a, j) at cam angles phi [rad], any real numbers, each shaped like phi.

        At a break the value of the named side is returned; elsewhere the sides agree.  NaN stays NaN.
        """
        phi = angles_of(phi)
        _check_side(side)
        flat = phi.ravel()
        out = np.empty((4, flat.size))
        for here in chunks(flat.size):
            turned = wrap(flat[here])
            if side == "left":
                turned = np.where(turned == 0, FULL_TURN, turned)
            self._fill(turned, side, out[:, here])
        return MotionValues(*out.reshape(4, *phi.shape))

    def _fill(self, turned: Floats, side: Side, out: Floats) -> None:
        """Write the values at angles in [0, 2 pi], (n,), into ``out``, (4, n)."""
        self._piecewise.fill(turned, side, out)

    def at(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> MotionValues:
        """(s, v, a, j) at the fraction u in [0, 1] of a phase, so that both its ends belong to it; NaN outside.

        phase : index of the phase, one or as many as there are u

        >>> import graphcam as gc
        >>> motion = gc.Motion([gc.Rise(30, 1.0, "rectangular"), gc.Return(30, FULL_TURN - 1, "rectangular")])
        >>> motion.at([0, 1], [1.0, 0.0])[2].round(3).tolist()
        [-120.0, -4.299]
        """
        _check_side(side)
        index, fraction = np.broadcast_arrays(np.asarray(phase, dtype=np.intp), np.asarray(u, dtype=np.float64))
        shape, index, flat = index.shape, index.ravel(), fraction.ravel()
        out = np.empty((4, flat.size))
        for here in chunks(flat.size):
            u = in_phase(flat[here])
            edges = self._edges[index[here]]
            passed = edges <= u[:, None] if side == "right" else edges < u[:, None]
            piece = self.first_piece[index[here]] + np.count_nonzero(passed, axis=1)
            self._piecewise.gather(piece, np.where(self._from_end[piece], 1 - u, u), out[:, here])
        return MotionValues(*out.reshape(4, *shape))

    def angle_at(self, phase: ArrayLike, u: ArrayLike) -> Floats:
        """The cam angle [rad] at the fraction u of a phase.

        >>> import graphcam as gc
        >>> motion = gc.Motion([gc.Rise(30, 1.0), gc.Return(30, FULL_TURN - 1)])
        >>> motion.angle_at(0, [0.5, 1.0]).tolist()
        [0.5, 1.0]
        """
        index = np.asarray(phase, dtype=np.intp)
        # Its rounding must not reach into the next phase, where a value that jumps is another.
        ends = np.append(self.starts[1:], FULL_TURN)
        return np.minimum(self.starts[index] + np.asarray(u) * self.angles[index], ends[index])

    @cached_property
    def angles(self) -> Floats:
        """(k,) the angle of each phase [rad]."""
        return np.array([phase.angle for phase in self.phases])

    @cached_property
    def _edges(self) -> Floats:
        """(k, most) the fractions of each phase at which its pieces meet, and NaN."""
        most = int(np.max(np.diff(self.first_piece))) - 1
        edges = np.full((len(self.phases), most), np.nan)
        for row, phase in zip(edges, self.phases, strict=True):
            if isinstance(phase, MovingPhase):
                row[: len(phase.normalised.edges)] = phase.normalised.edges
        return edges

    @cached_property
    def _from_end(self) -> NDArray[np.bool_]:
        """(p,) whether a piece is seen from the end of its phase."""
        return np.array([piece.length < 0 for piece in self._piecewise.pieces])


def _check_lengths(phases: Sequence[Phase], starts: Floats) -> None:
    """That every phase can be told from the rounding of the places where phases begin."""
    for phase, length in zip(phases, np.diff(starts, append=FULL_TURN), strict=True):
        if not length >= SHORTEST_PHASE:
            limit = say("long enough to be told from rounding, {shortest:g} rad", shortest=SHORTEST_PHASE)
            found = say("{angle:.6g} rad", angle=phase.angle)
            raise DesignError("angle", found, limit, say("leave the phase out"))


def _remedy(phases: Sequence[Phase], turn: float) -> Words:
    """What to do about phases that do not sum to a turn."""
    moving = next(phase for phase in phases if isinstance(phase, MovingPhase))
    lifts = math.fsum(phase.angle if isinstance(phase, Dwell) else phase.lift for phase in phases)
    if abs(lifts - FULL_TURN) < NEAR_TURN_SHARE * FULL_TURN:
        return say("the lifts make a turn: name the arguments, {swapped}", swapped=_swapped_arguments(moving))
    off = f"{abs(math.degrees(turn) - 360):.10g}"
    if turn < FULL_TURN:
        return say("lengthen a dwell by {off} degrees", off=off)
    return say("shorten a dwell by {off} degrees", off=off)


def _swapped_arguments(phase: MovingPhase) -> str:
    """A phase with its first two arguments the other way round, as one would write it."""
    return f"{type(phase).__name__}(lift={phase.angle:.6g}, angle={phase.lift:.6g})"


def _in_words(phase: Phase) -> str:
    over = f"over {math.degrees(phase.angle):.6g}°"
    if isinstance(phase, Dwell):
        return f"{phase.kind} {over}"
    law = phase.normalised
    ratio = f", ratio {law.ratio:g}" if law.ratio != 1 else ""
    return f"{phase.kind} by {phase.lift:.6g} {over}, {law.name}{ratio}"


def _pieces(phase: Phase, ends: tuple[float, float], levels: tuple[float, float]) -> list[Piece]:
    """The pieces of a phase between two cam angles [rad] and two displacements."""
    if isinstance(phase, Dwell):
        return [Piece(dwell_formula, ends[0], ends[0], 1.0, levels[0], (0, 0, 0, 0))]
    h, angle, up = phase.lift, phase.angle, phase.direction > 0
    # A return is measured from its lower end, where the missing lift keeps its digits.
    low = levels[0] if up else levels[1]
    units = [phase.direction * h / angle**n for n in range(4)]
    pieces: list[Piece] = []
    for formula, start, origin, length, base, (c0, c1, c2, c3) in phase.normalised.pieces:
        factors = c0 * units[0], c1 * units[1], c2 * units[2], c3 * units[3]
        level = low + h * (base if up else 1 - base)
        pieces.append(Piece(formula, ends[0] + angle * start, ends[int(origin)], angle * length, level, factors))
    return pieces
