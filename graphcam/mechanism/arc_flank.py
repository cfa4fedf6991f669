"""The flank of a cam of three circular arcs, A to G to F to D: what a follower on it asks for."""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.three_arcs import Point, ThreeArcs
from graphcam.mechanism.kinematics import Complexes
from graphcam.words import Caption, bare, say

FIT = 1e-3
"""How far given points may miss the arcs, as a part of their distance from the cam centre: printed data are rounded."""
NAMES = ("AG", "GF", "FD")
"""The arcs of the flank, in the order in which the rise meets them."""


@dataclass(frozen=True, eq=False)
class ArcFlank:
    """One root of a three-arc cam; points are (2,) arrays in cam coordinates [mm].

    Attributes
    ----------
    given : the data it was found from
    A, D : where the first and the last arc touch the circles about the cam centre, found from their centres
    F, G : where the arcs touch each other
    C1, C2, C3 : centres of the arcs from F to D, from A to G and from G to F; C3 is NaN where the flank is straight
    rho1, rho2, rho3 : radii [mm]; rho3 is inf where the flank is straight
    hollow : whether the arc from G to F bends away from the cam
    sound : whether the profile can be built: F, C1, C3 and G, C3, C2 lie in these orders on their lines
    reason : why it is sound or not, in whole sentences
    """

    given: ThreeArcs
    A: Floats
    D: Floats
    F: Floats
    G: Floats
    C1: Floats
    C2: Floats
    C3: Floats
    rho1: float
    rho2: float
    rho3: float
    hollow: bool
    sound: bool
    reason: Caption

    @property
    def why(self) -> str:
        """The reason in English."""
        return str(self.reason)

    @property
    def straight(self) -> bool:
        """Whether the flank from G to F is a straight line."""
        return math.isinf(self.rho3)

    def outward_normals(self) -> Complexes:
        """Unit normals away from the cam in A, G, F and D."""
        a, g, f, d, c1, c2 = (complex(*getattr(self, name)) for name in ("A", "G", "F", "D", "C1", "C2"))
        return np.array([a / abs(a), (g - c2) / self.rho2, (f - c1) / self.rho1, d / abs(d)])

    def check(self) -> None:
        """Check that it is sound, and that A and D lie where their arcs touch the circles about the cam centre.

        Raises
        ------
        DesignError : it is not, or they do not
        """
        if not self.sound:
            raise DesignError("root", say("not sound"), say("one that can be built"), self.why)
        if not np.dot(self.A, self.A - self.C2) > 0:
            limit = say("so that the second arc goes around the cam centre")
            raise DesignError("C2", _shown(self.C2), limit, say("move C2"))
        for name, arc, centre in (("A", "second", "C2"), ("D", "first", "C1")):
            found, given = getattr(self, name), getattr(self.given, name)
            if not np.all(np.isfinite(found)):
                limit = say("on the line from the cam centre to {name}", name=name)
                raise DesignError(centre, _shown((0, 0)), limit, say("move {centre}", centre=centre))
            if given is not None and not math.dist(found, given) <= FIT * math.hypot(*given):
                where = say(
                    "{shown}, where the {arc} arc touches a circle about the cam centre", shown=_shown(found), arc=arc
                )
                remedy = say("make {name} and {centre} agree, or leave {centre} out", name=name, centre=centre)
                raise DesignError(name, _shown(given), where, remedy)

    def turning(self) -> int:
        """sigma: +1 where the normal turns clockwise from A to D, -1 where it turns the other way.

        Raises
        ------
        DesignError : it does not turn the same way along every arc
        """
        outward = self.outward_normals()
        turning = np.angle(outward[1:] * np.conj(outward[:-1]))
        sigma = -1 if turning.sum() > 0 else 1
        for name, angle in zip(NAMES, -sigma * turning, strict=True):
            if not angle > 0:
                limit = say("greater than 0, in the sense from A to D")
                found = say("{degrees:.4g} degrees", degrees=math.degrees(angle))
                raise DesignError(say("angle of the arc {name}", name=name), found, limit, say("move G or C1"))
        return sigma


def _shown(point: Point) -> Caption:
    x, y = point
    return bare(f"({x + 0.0:.6g}, {y + 0.0:.6g})")  # with no sign at 0
