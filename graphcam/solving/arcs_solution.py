"""Task to solution, of a cam of three circular arcs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphcam import __version__
from graphcam.comparison.quantities import ArcsComparison
from graphcam.constructions.arc_chain import CENTRES_ROOM, ArcBoard, ArcChain
from graphcam.drafting.euclid import READABLE_CROSSING
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NO_HELD_SCALES, Scale
from graphcam.errors import DesignError
from graphcam.given.follower import Rotation, omega_of
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.three_arc_cam import ThreeArcCam, three_arc_cam
from graphcam.solving.division_warnings import disagreement
from graphcam.solving.shown_solution import FILE_KINDS, ShownSolution, plain_number, plain_quantities, plain_stations
from graphcam.solving.solution import Solution
from graphcam.solving.solution_warnings import Caution
from graphcam.solving.task_board import diagram_room, largest_drawn, profile_paper
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.words import Tell, say

POINT_NAMES = ("A", "D", "F", "G", "C1", "C2", "C3")
VIEW_SHARE = 0.9
"""The share of the room for a profile, for each of the two views of the cam."""


@dataclass(frozen=True, eq=False, repr=False)
class ArcsSolution(ShownSolution):
    """A solved cam of three circular arcs.

    Attributes
    ----------
    task : as given
    chain : the drawn side, whose constructions are drawn when they are first asked for
    roots : the exact side, the sound root first
    motion : what the roller does on the sound one
    """

    task: ArcsTask
    chain: ArcChain
    roots: tuple[ThreeArcCam, ThreeArcCam]
    motion: ArcMotion

    def __repr__(self) -> str:
        return self._in_lines(self.task.title.name, self.motion, self.drawn)

    @property
    def cam(self) -> ThreeArcCam:
        """The cam of the sound root."""
        return self.roots[0]

    @property
    def drawn(self) -> Mapping[str, Construction]:
        """The constructions by name, in order."""
        return self.chain

    @cached_property
    def comparison(self) -> ArcsComparison:
        """The comparison of the drawn quantities with the exact ones."""
        return ArcsComparison(self.chain, self.cam, self.motion)

    @property
    def warnings(self) -> list[str]:
        """That the arcs cannot be drawn, or that drawn and exact do not agree; what is not sound is refused."""
        beyond = disagreement(self.comparison.quantities, self.chain.pencil)
        return [self.tell(said) for said in (*(caution.said for caution in self.cautions), *beyond)]

    @property
    def cautions(self) -> list[Caution]:
        """That lines cross too flatly for one of the centres to be read, and with it what is drawn from there."""
        drawn = self.drawn["three_arcs"]
        unread = [(name, rho) for name, rho in (("C₂", "rho2"), ("C₃", "rho3")) if np.isnan(drawn.value(rho)).any()]
        if not unread:
            return []
        said = say(
            "{centre} cannot be drawn: the lines to it cross at less than {angle:g}°, {radius:.0f} mm away. What is "
            "drawn from there is not read either; move G or A."
        )
        (name, rho), radii = unread[0], {"rho2": self.cam.rho2, "rho3": self.cam.rho3}
        values = {"centre": name, "angle": math.degrees(READABLE_CROSSING), "radius": abs(radii[rho])}
        return [Caution(said.with_values(**values), "drawing")]

    @property
    def tell(self) -> Tell:
        """Says texts in the language of the task."""
        return self.task.drawing.tell

    @property
    def rotation(self) -> Rotation:
        """The sense in which the cam turns when the roller runs from A to D."""
        return "ccw" if self.motion.sigma > 0 else "cw"

    def to_dict(self) -> dict[str, Any]:
        """The solution as plain data for strict JSON: angles in degrees, None where a value does not apply."""
        return {
            "graphcam": __version__,
            "task": self.task.to_dict(),
            "cam": {
                "prime_radius": self.motion.prime_radius,
                "offset": 0.0,
                "roller_radius": self.motion.roller_radius,
                "rotation": self.rotation,
                "roots": [_root(root) for root in self.roots],
            },
            "scales": self.scales,
            "quantities": plain_quantities(self.comparison.quantities),
            "stations": self._stations(),
            "warnings": self.warnings,
            "files": dict.fromkeys(FILE_KINDS),
        }

    @property
    def scales(self) -> dict[str, Any]:
        """What a millimetre of paper stands for in the diagrams, by the names of their axes."""
        board, readings = self.chain.board, self.drawn["arc_diagrams"].readings
        tops = {name: readings[reading] for name, reading in (("s", "lift"), ("v", "max_v"), ("a", "max_a"))}
        return {
            "phi": {"per_mm": math.degrees(board.mu_phi.per_mm), "unit": "deg"},
            **{name: {"per_mm": top.per_mm, "unit": top.unit} for name, top in tops.items()},
        }

    def _stations(self) -> list[dict[str, Any]]:
        """The stations of the rise; their phase is the number of the arc."""
        phi, (s, v, a, _), alpha, pitch = self.comparison.exact_stations
        drawn = self.comparison.drawn_stations
        pairs = {
            "s": (drawn["s"], s),
            "v": (drawn["v"], v),
            "a": (drawn["a"], a),
            "pressure_angle_deg": (np.degrees(drawn["alpha"]), np.degrees(alpha)),
        }
        read = np.stack([drawn["x"], drawn["y"]], axis=-1)
        return plain_stations(phi, self.chain.stations.arc.tolist(), pairs, (read, pitch))


def solve_arcs(
    task: ArcsTask, pencil: Pencil | None = None, held: Mapping[str, float] = NO_HELD_SCALES
) -> ArcsSolution:
    """Solve a task: draw its constructions with the pencil (by default an ideal one) and compute the cam exactly.

    held : scales that views keep, as :class:`~graphcam.drafting.scale.Paper` has them

    Raises
    ------
    DesignError : the data give no sound cam, or the roller cannot run on it

    >>> import graphcam as gc
    >>> solution = solve_arcs(gc.builtin_arcs_task())
    >>> solution.cam.F.round(3).tolist(), round(float(solution.drawn["three_arcs"].readings["F_x"].value), 3)
    ([46.834, 25.855], 46.834)
    """
    given, drawing = task.arcs(), task.drawing
    roots = three_arc_cam(given.D, given.G, given.rho1, given.A, given.C1, given.C2)
    if not roots[0].sound:
        remedy = say("{why} Move G or a centre.", why=roots[0].why)
        raise DesignError(say("three-arc cam"), say("not sound"), say("one that can be built"), remedy)
    diagrams = diagram_room(drawing)
    extent = _extent(roots, math.hypot(*given.D) + 2 * task.follower.roller_radius)
    board = ArcBoard(
        given=given,
        dwell=math.radians(task.arcs.dwell),
        roller_radius=task.follower.roller_radius,
        divisions=drawing.divisions,
        mu_phi=Scale(math.radians(diagrams.degrees_per_mm), "rad"),
        paper=replace(profile_paper(drawing, VIEW_SHARE), held=held),
        extent=extent,
        page=largest_drawn(drawing, extent, CENTRES_ROOM),
        heights={"a": diagrams.a, "v": diagrams.v, "s": diagrams.s},
        omega=None if task.speed_rpm is None else omega_of(task.speed_rpm),
    )
    motion = roots[0].motion(board.roller_radius, board.dwell)
    return ArcsSolution(task, ArcChain(board, pencil or Pencil()), roots, motion)


def _extent(roots: Sequence[ThreeArcCam], outer: float) -> complex:
    """The width + i height [mm] of a circle about the cam centre and of the arcs' centres of all roots."""
    centres = np.array([getattr(root, name) for root in roots for name in ("C1", "C2", "C3")])
    centres = centres[np.isfinite(centres).all(axis=1)]
    low, high = np.minimum(centres.min(axis=0), -outer), np.maximum(centres.max(axis=0), outer)
    return complex(*(high - low).tolist())


AnySolution = Solution | ArcsSolution


def _root(root: ThreeArcCam) -> dict[str, Any]:
    points = {name: [plain_number(x) for x in getattr(root, name)] for name in POINT_NAMES}
    radii = {name: plain_number(getattr(root, name)) for name in ("rho1", "rho2", "rho3")}
    return {**points, **radii, "sound": root.sound, "why": root.why}
