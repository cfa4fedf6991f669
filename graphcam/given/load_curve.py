"""A load over the turn: a table of cam angles and forces, with straight lines between its rows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.given.laws import Floats
from graphcam.given.motion import CLOSURE_TOLERANCE, FULL_TURN, wrap
from graphcam.words import say


@dataclass(frozen=True)
class LoadCurve:
    """A load that depends on the cam angle; between two rows it is linear.

    phi : (n,) cam angles [rad], each greater than the one before, from 0 to a full turn
    force : (n,) the load there [N], positive where it presses the follower on the cam; the last as the first

    Raises
    ------
    DesignError : of the quantity ``load``: the rows do not cover the turn, are out of order, or do not close

    >>> import graphcam as gc
    >>> from math import radians
    >>> press = gc.LoadCurve(np.radians([0, 90, 100, 360]), [20, 20, 120, 20])
    >>> press(np.radians([45, 95, 360])).round(9).tolist()
    [20.0, 70.0, 20.0]
    """

    phi: Sequence[float]
    force: Sequence[float]

    def __post_init__(self) -> None:
        phi, force = (tuple(np.asarray(each, dtype=np.float64).ravel().tolist()) for each in (self.phi, self.force))
        object.__setattr__(self, "phi", phi)
        object.__setattr__(self, "force", force)
        if len(phi) != len(force) or not all(map(math.isfinite, (*phi, *force))):
            found = say("a table of {phi} angles and {force} loads", phi=len(phi), force=len(force))
            raise DesignError("load", found, say("rows of finite numbers"))
        if len(phi) < 2 or abs(phi[0]) > CLOSURE_TOLERANCE or abs(phi[-1] - FULL_TURN) > CLOSURE_TOLERANCE:
            covered = say("without a row")
            if phi:
                covered = say("from {degrees} to {degrees2}", degrees=_degrees(phi[0]), degrees2=_degrees(phi[-1]))
            remedy = say("begin the table with a row at 0 degrees and end it with one at 360")
            found = say("a table {covered}", covered=covered)
            raise DesignError("load", found, say("a table that covers the turn, from 0 to 360 degrees"), remedy)
        for before, after in pairwise(phi):
            if not before < after:
                found = say(
                    "a table with {degrees} after {degrees2}", degrees=_degrees(after), degrees2=_degrees(before)
                )
                remedy = say("a jump is a steep line between two rows that lie close together")
                raise DesignError("load", found, say("a table whose angles grow from row to row"), remedy)
        if not math.isclose(force[0], force[-1], rel_tol=CLOSURE_TOLERANCE, abs_tol=CLOSURE_TOLERANCE):
            found = say("{force:g} N at 0 degrees and {force2:g} N at 360", force=force[0], force2=force[-1])
            remedy = say("a turn ends as the next begins")
            raise DesignError("load", found, say("the same at both"), remedy)

    def __call__(self, phi: Floats | float) -> Floats:
        """The load [N] at cam angles [rad], any real numbers; NaN for NaN."""
        return np.interp(wrap(phi), self.phi, self.force)


Load = float | LoadCurve
"""A load along the motion: the same over the turn [N], or one that depends on the cam angle."""


def load_at(load: Load, phi: Floats | float) -> Floats | float:
    """A load [N] at cam angles [rad]."""
    return load(phi) if isinstance(load, LoadCurve) else load


def knots_of(load: Load) -> tuple[float, ...]:
    """The cam angles [rad] at which the load's slope may jump."""
    return tuple(load.phi) if isinstance(load, LoadCurve) else ()


def check_load(load: Load) -> None:
    """Check that a load of one number is finite.

    Raises
    ------
    DesignError : it is not
    """
    if not isinstance(load, LoadCurve):
        check_number("load", load, say("a finite number of N, or a table over the turn"))


def largest(load: Load) -> float:
    """The maximum magnitude of a load [N].

    >>> largest(-3.0)
    3.0
    """
    return max(map(abs, load.force)) if isinstance(load, LoadCurve) else abs(load)


def _degrees(angle: float) -> str:
    return f"{math.degrees(angle):.6g} degrees"
