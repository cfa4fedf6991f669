"""Many cams of one kind: rise, dwell, return and dwell, with every size a number or one for each cam."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import MISSING, dataclass, fields
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.given.follower import FOLLOWERS_BY_KIND, Follower, Kind, Rotation, swing_remedy
from graphcam.given.laws import LAWS, Floats, LawName, canonical_law
from graphcam.given.motion import CLOSURE_TOLERANCE, FULL_TURN, Dwell, Motion, Phase, Return, Rise
from graphcam.given.motion_law import Law
from graphcam.mechanism.cam import Cam
from graphcam.words import and_chain, bare_caption, say

Size = float | Sequence[float] | NDArray[Any]
"""A size of all designs, or one for each."""
Part = slice | NDArray[np.integer[Any]] | NDArray[np.bool_]
_COMMON_SIZES = "lift", "rise_angle", "dwell_angle", "return_angle", "prime_radius"
_FOLLOWER_SIZES = "offset", "arm", "distance", "face_offset", "roller_radius"
SIZE_NAMES = (*_COMMON_SIZES, *_FOLLOWER_SIZES)
"""The sizes of a design."""
OWN_SIZE_NAMES = {kind: tuple(size.name for size in fields(follower)) for kind, follower in FOLLOWERS_BY_KIND.items()}
"""The sizes of each kind of follower."""
NEEDED_SIZE_NAMES = {
    kind: tuple(size.name for size in fields(follower) if size.default in (MISSING, None))
    for kind, follower in FOLLOWERS_BY_KIND.items()
}
"""Those without which a cam of that kind cannot be made."""


@dataclass(frozen=True, eq=False)
class Designs:
    """Cams with a rise, a high dwell, a return, and a low dwell for the rest of the turn.

    Every field but the follower is one value for all cams or an array of n; arrays of different lengths do not fit.

    Parameters
    ----------
    lift, prime_radius, roller_radius : mm; the lift of an arm is an angle [rad]
    rise_angle, dwell_angle, return_angle : rad; a dwell may be 0
    offset : mm, of a translating follower;  arm, distance : mm, an arm's length and centre distance
    face_offset : mm, of an oscillating flat face towards the cam centre, from the line through its pivot
    rise_law, return_law : names of :data:`graphcam.LAWS`, or :class:`graphcam.Law` of your own
    rotation : "ccw" or "cw"
    follower : the kind: "translating", "oscillating", or "flat-faced" and "oscillating-flat", which have no roller

    Raises
    ------
    DesignError : the lengths differ, a law, rotation or follower is unknown, a size is given that the follower does not
        have, or arm or distance is left out.  A number that no cam can have is not an error: that cam's extremes are
        NaN

    >>> import graphcam as gc
    >>> designs = gc.Designs(lift=30, rise_angle=2.0, return_angle=1.5, prime_radius=[40, 50, 60], rise_law="cycloidal")
    >>> len(designs), designs.cam(1).prime_radius
    (3, 50.0)
    """

    lift: Size
    rise_angle: Size
    return_angle: Size
    prime_radius: Size
    dwell_angle: Size = 0.0
    offset: Size = 0.0
    arm: Size = 0.0
    distance: Size = 0.0
    roller_radius: Size = 0.0
    rise_law: LawName | Law | Sequence[LawName | Law] | NDArray[Any] = "3-4-5"
    return_law: LawName | Law | Sequence[LawName | Law] | NDArray[Any] = "3-4-5"
    rotation: Rotation | Sequence[Rotation] | NDArray[Any] = "ccw"
    follower: Kind = "translating"
    face_offset: Size = 0.0

    def __post_init__(self) -> None:
        for name in SIZE_NAMES:
            object.__setattr__(self, name, _numbers(name, getattr(self, name)))
        for name in ("rise_law", "return_law"):
            object.__setattr__(self, name, _choices(name, getattr(self, name), LAWS, Law))
        object.__setattr__(self, "rotation", _choices("rotation", self.rotation, ("ccw", "cw")))
        _choices("follower", self.follower, tuple(OWN_SIZE_NAMES))
        sizes = {array.size for array in self._columns.values() if array.ndim}
        if len(sizes) > 1:
            found = and_chain([bare_caption(str(size)) for size in sorted(sizes)])
            remedy = say("give one number for all cams, or one for each")
            raise DesignError(say("number of designs"), found, say("the same in every array"), remedy)
        self._check_follower()

    def _check_follower(self) -> None:
        own, a = OWN_SIZE_NAMES[self.follower], "an" if self.follower.startswith("o") else "a"
        for name in _FOLLOWER_SIZES:
            given = bool(np.any(getattr(self, name)))
            if given and name not in own:
                found = say("given")
                raise DesignError(name, found, say("left out for {a} {follower} follower", a=a, follower=self.follower))
            if not given and name in NEEDED_SIZE_NAMES[self.follower]:
                raise DesignError(name, say("left out"), say("a length in mm, or one for each cam"))

    @property
    def _columns(self) -> dict[str, NDArray[Any]]:
        """The fields that may differ from cam to cam."""
        return {field.name: getattr(self, field.name) for field in fields(self) if field.name != "follower"}

    @property
    def varied(self) -> dict[str, NDArray[Any]]:
        """The columns (n,) in which the cams differ, by the names of the fields."""
        return {name: column for name, column in self._columns.items() if column.ndim}

    def __len__(self) -> int:
        return max(array.size for array in self._columns.values())

    def part(self, which: Part) -> Self:
        """Some of the cams, by a slice, by their numbers or by a mask.

        >>> import graphcam as gc
        >>> len(gc.Designs(30, 2.0, 1.5, prime_radius=np.arange(40, 60)).part(slice(0, 5)))
        5
        """
        some = copy(self)  # what was checked need not be checked again
        for name, column in self._columns.items():
            if column.ndim:
                object.__setattr__(some, name, column[which])
        return some

    def column(self, name: str) -> NDArray[Any]:
        """(n,) the values of one field; those that do not differ are not stored n times."""
        return np.broadcast_to(getattr(self, name), len(self))

    @property
    def sigma(self) -> Floats:
        """(n,) the sense in which each cam turns, +1 or -1."""
        return np.where(self.column("rotation") == "ccw", 1.0, -1.0)

    @property
    def low_dwell(self) -> Floats:
        """(n,) the angle of the low dwell [rad]; 0 for what rounding leaves, negative where the phases do not fit."""
        rest = FULL_TURN - (self.column("rise_angle") + self.column("dwell_angle") + self.column("return_angle"))
        return np.where(np.abs(rest) <= CLOSURE_TOLERANCE, 0.0, rest)

    @property
    def possible(self) -> NDArray[np.bool_]:
        """(n,) where lift and angles make a motion: all finite, of the right sign, and within a turn."""
        lift, rise, back, dwell = map(self.column, ("lift", "rise_angle", "return_angle", "dwell_angle"))
        return (lift > 0) & (lift < np.inf) & (rise > 0) & (back > 0) & (dwell >= 0) & (self.low_dwell >= 0)

    def check_units(self) -> None:
        """Check that angles are no degrees (beyond a turn in every design) and that sizes are positive.

        Raises
        ------
        DesignError : no angle of one kind is within a turn, no lift of the arms is, or no size of one kind is positive

        >>> import graphcam as gc
        >>> gc.Designs(lift=30, rise_angle=120, return_angle=90, prime_radius=[40, 50]).check_units()
        Traceback (most recent call last):
        graphcam.errors.DesignError: rise_angle is 120 rad, but must be at most a full turn, 2 pi rad; write ...
        """
        for name in ("rise_angle", "dwell_angle", "return_angle"):
            angle = float(np.min(getattr(self, name), initial=np.inf))
            if FULL_TURN + CLOSURE_TOLERANCE < angle < np.inf:
                remedy = say("write math.radians({angle:.6g}) if it is in degrees", angle=angle)
                found = say("{angle:.6g} rad", angle=angle)
                raise DesignError(name, found, say("at most a full turn, 2 pi rad"), remedy)
        radians, lengths = "a finite number greater than 0 rad", "a finite number greater than 0 mm"
        for name, limit in (
            ("lift", say("a finite number greater than 0")),
            ("rise_angle", radians),
            ("return_angle", radians),
            ("prime_radius", lengths),
        ):
            most = float(np.max(getattr(self, name), initial=-np.inf))
            if -np.inf < most <= 0:
                raise DesignError(name, most, limit)
        lift = float(np.min(self.lift, initial=np.inf))
        if FOLLOWERS_BY_KIND[self.follower].lift_unit == "rad" and FULL_TURN < lift < np.inf:
            remedy = swing_remedy(lift, "swing the arm less")
            raise DesignError("lift", say("{lift:.6g} rad", lift=lift), say("at most a full turn, 2 pi rad"), remedy)

    def cam(self, k: int) -> Cam:
        """One of the cams.

        Raises
        ------
        DesignError : there is no such cam
        """
        sizes = {name: float(self.column(name)[k]) for name in SIZE_NAMES}
        rise_law, return_law, rotation = (self.column(name).item(k) for name in ("rise_law", "return_law", "rotation"))
        low = float(self.low_dwell[k])
        phases: list[Phase] = [Rise(sizes["lift"], sizes["rise_angle"], rise_law)]
        phases += [Dwell(sizes["dwell_angle"])] if sizes["dwell_angle"] else []
        phases += [Return(sizes["lift"], sizes["return_angle"], return_law)]
        phases += [Dwell(low)] if low else []
        own = {name: sizes[name] for name in OWN_SIZE_NAMES[self.follower]}
        follower: Follower = FOLLOWERS_BY_KIND[self.follower](**own)
        return Cam(Motion(phases), follower, sizes["prime_radius"], rotation)


def _numbers(name: str, values: ArrayLike) -> Floats:
    try:
        array = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise DesignError(name, values, say("a number, or one for each cam")) from None
    return _one_axis(name, array)


def _choices(name: str, values: Any, known: tuple[str, ...], own: type | tuple[()] = ()) -> NDArray[Any]:
    """Names that are known, or objects of your own."""
    array = np.asarray(values)
    for word in dict.fromkeys(array.ravel().tolist()):
        if isinstance(meant := canonical_law(word), str) and meant != word:
            array = np.where(array == word, meant, array)
        if not isinstance(word, own) and meant not in known:
            raise DesignError(name, word, say("a name that graphcam knows"), nearest_word_remedy(str(word), known))
    return _one_axis(name, array)


def _one_axis(name: str, array: NDArray[Any]) -> NDArray[Any]:
    if array.ndim > 1:
        found = say("an array of shape {shape}", shape=array.shape)
        raise DesignError(name, found, say("a number, or one for each cam"), say("ravel() it"))
    return array
