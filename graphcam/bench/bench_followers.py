"""What the bench draws: three followers under four laws, each with its exact counterpart."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from math import radians
from typing import Any

from graphcam.comparison.quantities import Comparison
from graphcam.constructions.board import Board, DrawnFollower
from graphcam.constructions.chain import AdoptedSizes, Chain
from graphcam.constructions.drawn_arm import DrawnOscillating
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import GOST_2_302, Paper, Scale
from graphcam.given.follower import Limits, Rotation
from graphcam.given.laws import canonical_law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.roller_rule import DEFAULT_RULE, roller_rule
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import LeastRadius, minimum_radius

FOLLOWER_KINDS = ("translating", "arm", "flat")
BENCH_LAWS = ("cycloidal", "3-4-5", "rectangular", "cosine")
MAIN_LAW = "cycloidal"
"""The law under which times are compared."""
LIFT = 30.0
"""The lift of the translating and the flat-faced follower [mm]."""
ARM = 100.0
"""Length of the arm [mm]; its centre distance is left open where the minimum radius is sought."""
PERMITTED_ANGLE = radians(30)
"""The permitted pressure angle of the translating follower [rad]."""


@dataclass(frozen=True, eq=False)
class BenchFollower:
    """One follower under one law, with sizes that do not depend on the drawing: what converges is one cam's drawing."""

    follower: str
    law: str
    board: Board
    sizes: AdoptedSizes

    def chain(self, parts: int, pencil: Pencil | None = None) -> Chain:
        """The drawing in so many parts a phase; nothing of it is drawn yet."""
        return Chain(replace(self.board, divisions=parts), pencil or Pencil(), self.sizes)

    @property
    def cam(self) -> Cam:
        """The exact cam of the follower."""
        follower = self.board.follower.built(self.sizes.place, self.sizes.roller_radius)
        return Cam(self.board.motion, follower, self.sizes.prime_radius, self.board.rotation)

    @cached_property
    def exact(self) -> Mapping[str, float]:
        """The exact counterparts of what is read, by name; they do not depend on the number of parts."""
        return Comparison(self.chain(self.board.divisions), self.cam).exact

    def exact_least_radius(self) -> LeastRadius:
        """The exact minimum prime radius."""
        board = self.board
        follower = board.follower.built(board.follower.place, 0.0)
        conditions: dict[str, Any] = asdict(board.limits) | dict(board.follower.conditions)
        return minimum_radius(board.motion, follower, board.rotation, **conditions)


def motion_of(law: str, lift: float, rise: float, dwell: float, back: float) -> Motion:
    """Rise, dwell, return, and a dwell for the rest of the turn; the angles in degrees."""
    up, top, down = radians(rise), radians(dwell), radians(back)
    bottom = FULL_TURN - sum((up, top, down))
    return Motion(
        [Rise(lift, up, canonical_law(law)), Dwell(top), Return(lift, down, canonical_law(law)), Dwell(bottom)]
    )


def scene(follower: str, law: str) -> BenchFollower:
    """The translating follower is that of the built-in coursework task.

    >>> scene("arm", "3-4-5").cam.follower
    Oscillating(arm=100.0, distance=120.0, roller_radius=10.0)
    """
    rule, mu_phi = roller_rule(DEFAULT_RULE), Scale(radians(1), "rad")
    # Prime radius and roller radius are left open, and so is what they are rounded to.
    drawing = None, None, rule, 12, 50.0, (40.0, 40.0), mu_phi, None, Paper(330.0, 330.0, GOST_2_302)
    motion, drawn, limit, rotation, sizes = _given(follower, law)
    return BenchFollower(follower, law, Board(motion, drawn, rotation, Limits(limit, None, True), *drawing), sizes)


def _given(follower: str, law: str) -> tuple[Motion, DrawnFollower, float, Rotation, AdoptedSizes]:
    if follower == "translating":
        motion, sizes = motion_of(law, LIFT, 80, 45, 60), AdoptedSizes(46.0, -10.0, 12.0)
        return motion, DrawnTranslating(-10.0), PERMITTED_ANGLE, "cw", sizes
    if follower == "arm":
        motion, arm = motion_of(law, radians(20), 90, 40, 80), DrawnOscillating(ARM, None, Scale(1.0, "mm"))
        return motion, arm, radians(45), "ccw", AdoptedSizes(50.0, 120.0, 10.0)
    return motion_of(law, LIFT, 120, 30, 100), DrawnFlatFaced(8.0), PERMITTED_ANGLE, "ccw", AdoptedSizes(60.0, 0.0, 0.0)


def free_scene(law: str) -> BenchFollower:
    """The translating follower with its offset left open and both pressure angles limited: the minimum radius alone."""
    fixed = scene("translating", law)
    board = replace(fixed.board, follower=DrawnTranslating(None), limits=Limits(PERMITTED_ANGLE, PERMITTED_ANGLE, True))
    return replace(fixed, board=board)
