"""Task to solution: the constructions, drawn; the same cam, exact; and the two beside each other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphcam import __version__
from graphcam.comparison.quantities import Comparison, exact_minimum, transmission_deg
from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.graduation import SYMBOLS, scale_at_speed, time_scale
from graphcam.constructions.working_profile import low_dwells
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import BrokenScale
from graphcam.errors import DesignError
from graphcam.given.impact import acceleration_jumps
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.profile_spline import ProfileSpline, profile_spline
from graphcam.solving.adopted_sizes import FaceDesign, adopted_cautions, face_design
from graphcam.solving.division_warnings import coarse_divisions, disagreement, unreadable_bend
from graphcam.solving.shown_solution import FILE_KINDS, ShownSolution, plain_number, plain_quantities, plain_stations
from graphcam.solving.solution_warnings import Caution, closed_turn, less_round, title_scale, unit_slips, warnings_of
from graphcam.solving.spring_design import SpringDesign
from graphcam.solving.stress_design import StressDesign
from graphcam.solving.tolerance_design import ToleranceDesign
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.task import Task
from graphcam.words import Tell, say


@dataclass(frozen=True, eq=False, repr=False)
class Solution(ShownSolution):
    """A solved task: its drawing and its exact cam.

    Attributes
    ----------
    task : as given
    chain : the drawn side, whose constructions are drawn when they are first asked for
    cam : the exact side, with the sizes that the drawing proposed and the design adopted
    """

    task: Task
    chain: Chain
    cam: Cam

    def __repr__(self) -> str:
        return self._in_lines(self.task.title.name, self.cam, self.drawn)

    @property
    def drawn(self) -> Mapping[str, Construction]:
        """The constructions by name, in order."""
        return self.chain

    @cached_property
    def comparison(self) -> Comparison:
        """The comparison of the drawn quantities with the exact ones."""
        return Comparison(self.chain, self.cam)

    @cached_property
    def warnings(self) -> list[str]:
        """What is wrong with the adopted cam or its drawing, as sentences; none if they are sound and agree."""
        beyond = [*unreadable_bend(self.drawn), *disagreement(self.comparison.quantities, self.chain.pencil)]
        return [self.tell(said) for said in (*(caution.said for caution in self.cautions), *beyond)]

    @cached_property
    def cautions(self) -> list[Caution]:
        """What is wrong with the adopted cam, as captions with the places where it is seen."""
        found = warnings_of(self.cam, self.chain.board, self.comparison.least[0])
        spring = self.spring.cautions if self.spring else ()
        found += [*coarse_divisions(self.chain), *adopted_cautions(self.chain, self.cam, self.face)]
        stress = self.stress.cautions if self.stress else ()
        scale = title_scale(self.task, self.chain.profile_scale)
        return [
            *found,
            *spring,
            *stress,
            *unit_slips(self.task),
            *closed_turn(self.task),
            *less_round(self.chain),
            *scale,
        ]

    @property
    def tell(self) -> Tell:
        """Says texts in the language of the task."""
        return self.task.drawing.tell

    @cached_property
    def spring(self) -> SpringDesign | None:
        """What the task's spring does, if it has one."""
        spring, speed = self.task.spring, self.task.speed_rpm
        if spring is None or speed is None:
            return None
        return SpringDesign(self.chain, self.cam, spring(speed), spring.preload is None, spring.friction)

    @cached_property
    def face(self) -> FaceDesign | None:
        """The face that is built, if the task asks for a margin beside the contact."""
        margin = getattr(self.task.follower, "face_margin", None)
        if margin is None:
            return None
        exact = self.comparison.exact
        return face_design(self.chain, (exact["face_left"], exact["face_right"]), margin)

    @cached_property
    def stress(self) -> StressDesign | None:
        """The stress between cam and follower, if the task has materials."""
        if self.task.material is None or self.spring is None:
            return None
        return StressDesign(self.chain, self.spring.forces, self.task.material)

    @cached_property
    def tolerances(self) -> ToleranceDesign | None:
        """How far the motion may be off as the cam is made, if the task has tolerances."""
        given = self.task.tolerances
        return None if given is None else ToleranceDesign(self.chain, self.cam, given)

    @cached_property
    def profile_spline(self) -> ProfileSpline:
        """The profile that can be cut, as one spline with the degree and the control points that the part asks for.

        Raises
        ------
        DesignError : there is no profile that can be cut, or its spline takes more control points, or fewer
        """
        part = self.task.part or PartTable()
        degree, count = part.spline_degree, part.spline_control_points
        try:
            spline = profile_spline(self.cam, degree=degree, control_points=count, trimmed=True)
        except DesignError as error:
            if error.quantity != "control_points":
                raise
            raise DesignError("part.spline_control_points", count, error.args[2], say("or leave it out")) from None
        return spline.turned(self.cam.table_turn)

    def to_dict(self) -> dict[str, Any]:
        """The solution as plain data for strict JSON: angles in degrees, None where a value does not apply."""
        sizes = self.chain.board.follower.sizes(self.chain.place, self.cam.roller_radius)
        follower = {size.name: size.value for size in sizes}
        origin = self.cam.motion.origin
        return {
            "graphcam": __version__,
            "task": self.task.to_dict(),
            "cam": {"prime_radius": self.cam.prime_radius, **follower, "rotation": self.cam.rotation},
            "phases": [
                {"kind": kind, "begins_deg": math.degrees(start + origin), "ends_deg": math.degrees(end + origin)}
                for kind, start, end in self.cam.motion.timing
            ],
            "scales": self.scales,
            "quantities": plain_quantities(self.comparison.quantities),
            "stations": self._stations(),
            "low_dwells": self._low_dwells(),
            "warnings": [str(caution.said) for caution in self.cautions],
            **({"face": self.face.to_dict()} if self.face else {}),
            **({"jerk": self._plain_jerk()} if "jerk" in self.drawn else {}),
            **({"spring": self.spring.to_dict()} if self.spring else {}),
            **({"contact_stress": self.stress.to_dict()} if self.stress else {}),
            **({"tolerances": self.tolerances.to_dict()} if self.tolerances else {}),
            "files": dict.fromkeys(FILE_KINDS),
        }

    def _low_dwells(self) -> list[dict[str, Any]]:
        """The arcs of the lower dwells on the working profile: their angles, which are those of the dwells."""
        profile, motion = self.drawn["working_profile"], self.cam.motion
        dwells = low_dwells(profile.givens.inverted)
        angles = np.degrees(profile.value("low_dwells")).tolist() if dwells else []
        return [
            {"phase": k, "angle_deg": {"drawn": plain_number(drawn), "exact": math.degrees(motion.phases[k].angle)}}
            for (k, *_), drawn in zip(dwells, angles, strict=True)
        ]

    @property
    def _lift(self) -> tuple[float, str]:
        """How many units of a lift in files one of the API is, and their name: an arm's lift is in degrees there."""
        return (math.degrees(1), "deg") if self.chain.board.follower.unit == "rad" else (1.0, "mm")

    @property
    def scales(self) -> dict[str, Any]:
        """What a millimetre of paper stands for in the diagrams, by the names of their axes."""
        readings, (factor, unit) = self.chain["integration"].readings, self._lift
        scales = {name: readings[name].per_mm for name in ("s", "v", "a")}
        third = self.drawn["jerk"].readings["j"] if "jerk" in self.drawn else None
        mu_phi = self.chain.board.mu_phi
        # Of a broken axis the places where its stretches end, from which any cam angle on it is interpolated.
        ends = zip(mu_phi.values, mu_phi.places, strict=True) if isinstance(mu_phi, BrokenScale) else ()
        broken = [{"phi_deg": round(math.degrees(phi), 9), "paper": round(place, 9)} for phi, place in ends]
        return {
            "phi": {
                "per_mm": math.degrees(mu_phi.per_mm),
                "unit": "deg",
                **({"broken_axis": broken} if broken else {}),
            },
            "s": {"per_mm": factor * scales["s"], "unit": unit},
            "v": {"per_mm": scales["v"], "unit": readings["v"].unit},
            "a": {"per_mm": scales["a"], "unit": readings["a"].unit},
            **({} if third is None else {"j": {"per_mm": third.per_mm, "unit": third.unit}}),
            **self._scales_at_speed(scales | ({} if third is None else {"j": third.per_mm})),
        }

    def _scales_at_speed(self, scales: Mapping[str, float]) -> dict[str, Any]:
        """The scales over time, where the task gives a speed."""
        board = self.chain.board
        if board.omega is None:
            return {}
        of_time = {"t": time_scale(board.mu_phi, board.omega)}
        of_time |= {
            f"{name}_at_speed": scale_at_speed(scales[name], name, board.omega, board.follower.unit)
            for name in SYMBOLS
            if name in scales
        }
        return {name: {"per_mm": scale.per_mm, "unit": scale.unit} for name, scale in of_time.items()}

    @cached_property
    def exact_jerk(self) -> Floats:
        """(p,) the exact jerk in the middle of every part of the moving phases, per radian of the cam."""
        stations, left = self.chain.board.stations, self.chain.board.stations.left
        return self.cam.motion.at(stations.phase[left], (stations.u[left] + stations.u[left + 1]) / 2)[3]

    def _plain_jerk(self) -> dict[str, Any]:
        """The jerk in the middles of the parts, and where the acceleration jumps, so that it is infinite."""
        drawn, unit = self.drawn["jerk"], self.drawn["jerk"].readings["j"].unit
        rows = zip(np.degrees(drawn.value("j_at")).tolist(), drawn.value("j").tolist(), self.exact_jerk, strict=True)
        return {
            "unit": unit,
            "parts": [{"phi_deg": phi, "j": {"drawn": value, "exact": float(exact)}} for phi, value, exact in rows],
            "infinite": [
                {"phi_deg": math.degrees(jump.phi), "a_before": jump.before, "a_after": jump.after}
                for jump in acceleration_jumps(self.cam.motion)
            ],
        }

    def _stations(self) -> list[dict[str, Any]]:
        stations, (factor, _) = self.chain.board.stations, self._lift
        exact, drawn = self.comparison.exact_stations, self.comparison.drawn_stations
        s, v, a, _ = exact.values
        alpha = np.where(np.isnan(drawn["alpha"]), np.nan, exact.pressure_angle)  # a flat face has none
        pairs = {
            "s": (factor * drawn["s"], factor * s),
            "v": (drawn["v"], v),
            "a": (drawn["a"], a),
            "pressure_angle_deg": (np.degrees(drawn["alpha"]), np.degrees(alpha)),
            "transmission_angle_deg": (transmission_deg(drawn["alpha"]), transmission_deg(alpha)),
        }
        pitch = np.stack([drawn["x"], drawn["y"]], axis=-1), exact.pitch
        return plain_stations(stations.phi, stations.phase.tolist(), pairs, pitch)


def solved_on(
    board: Board, task: Task, pencil: Pencil | None = None, done: Mapping[str, Construction] | None = None
) -> Solution:
    """The solution of a task on a drawing board, whose scales may be other than the task's own.

    pencil : by default an ideal one
    done : constructions that lie on such a board already, by their names

    Raises
    ------
    DesignError : there is no such cam

    >>> import graphcam as gc
    >>> from graphcam.solving.task_board import board_of
    >>> solution = solved_on(board_of(gc.builtin_task()), gc.builtin_task())
    >>> solution.cam.prime_radius, solution.cam.follower
    (44.0, Translating(offset=-10.0, roller_radius=17.0))
    >>> round(float(solution.drawn["minimum_radius"].readings["prime_radius"].value), 2)
    43.28
    """
    chain = Chain(board, pencil or Pencil(), done=done or {})
    try:
        follower = chain.board.follower.built(chain.place, chain.roller_radius)
        cam = Cam(task.motion(), follower, chain.prime_radius, task.rotation)
    except DesignError:
        # Where no cam centre can be read because there is none, the exact side knows the reason and a way out.
        if board.prime_radius is None or board.follower.place is None:
            exact_minimum(board)
        raise
    solution = Solution(task, chain, cam)
    if solution.spring:
        solution.spring.check()
    if solution.tolerances:
        solution.tolerances.check()
    return solution
