"""The constructions one after another, each fed by the readings of those before it.

A construction is drawn when it is first asked for, and with it only what it depends on.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from graphcam.constructions.acceleration import acceleration_diagram
from graphcam.constructions.adoption import (
    BLUNT_FACTOR,
    ROUNDING_SLACK,
    Adoption,
    Trial,
    lies_in,
    multiple,
    nearest_multiple,
    steps_up,
    usual_rounding,
)
from graphcam.constructions.angle_diagram import angle_diagram
from graphcam.constructions.board import Board
from graphcam.constructions.cam_analysis import AnalysisGivens
from graphcam.constructions.drawings import Drawings, DrawnOnce
from graphcam.constructions.fitted_differentiation import given_cam_differentiation, measured_differentiation
from graphcam.constructions.integration import integration
from graphcam.constructions.jerk import jerk
from graphcam.constructions.kinematic_diagram import scheme
from graphcam.constructions.roller import roller_radius
from graphcam.constructions.views import COMBINED, PROFILE
from graphcam.constructions.working_profile import working_profile
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, coarsest_scale, standard_scale
from graphcam.errors import DesignError
from graphcam.given.follower import LIMIT_NAMES, no_prime_radius
from graphcam.given.laid_outline import GivenCamMotion, laid_outline
from graphcam.given.laws import Floats
from graphcam.given.measured import MeasuredMotion
from graphcam.given.motion import FULL_TURN
from graphcam.words import and_chain, say

PHASE_ANGLES_ROOM = complex(58.0, 44.0)
"""What the phase angles and their texts need beside the profile, and above and below it together [mm of paper]."""
FURTHER_MULTIPLES = 5
"""So many multiples of the rounding from the least radius on are tried: a round one is not worth a much larger cam."""
FINER_ROUNDINGS = (1.0, 0.1, 0.01, 0.001)
"""The parts of the rounding that a size is a multiple of, where the region has no room for a rounder one."""
MAX_TRIALS = 30
"""So many prime radii are tried for the curvature of the profile."""
PERFECT_PENCIL = Pencil()
"""The hand on whose drawing the decisions rest."""


def _no_radius(board: Board, trial: Trial) -> DesignError:
    """What to tell where no prime radius within the permitted pressure angles suffices."""
    if trial.too_thin > trial.too_sharp:
        found = say("{length:.4g} mm with keyway and wall", length=trial.shaft)
        return no_prime_radius("part.bore", found, say("take a smaller bore"))
    smaller = say("take a smaller roller")
    if board.min_profile_radius is None:
        return no_prime_radius("roller radius", say("{length:.4g} mm", length=board.roller_radius), smaller)
    return no_prime_radius("limits.min_curvature_radius", board.min_profile_radius, smaller)


@dataclass(frozen=True)
class AdoptedSizes:
    """The sizes that are built [mm]; ``place`` is the follower's offset or centre distance."""

    prime_radius: float
    place: float
    roller_radius: float


@dataclass(frozen=True, eq=False, repr=False)
class Chain(Drawings):
    """All constructions of one cam by name, in the order in which they are drawn.

    What the task leaves open is decided as in a design office: proposed by the drawing and adopted as a round number.
    A decision is not a matter of a trembling hand, so it is taken from the drawing done with a perfect pencil.

    board : the task and the choices
    pencil : the hand that draws
    decided : sizes that were decided before, in place of the proposals
    """

    board: Board
    pencil: Pencil = field(default_factory=Pencil)
    decided: AdoptedSizes | None = None
    _by_others: dict[Pencil, Chain] = field(default_factory=dict["Pencil", "Chain"], init=False)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the follower's constructions, and of those asked for, for a measured motion, and added."""
        motion, drawn = self.board.motion, list(self.board.follower.constructions)
        if isinstance(motion, GivenCamMotion):  # what is asked of a given cam comes first
            drawn[1:1] = ["analysis", "differentiation"]
        elif isinstance(motion, MeasuredMotion):
            drawn.append("differentiation")
        if self.board.jerk_pole is not None:
            drawn.insert(drawn.index("integration") + 1, "jerk")
        return (*drawn, *self.further)

    @DrawnOnce
    def scheme(self) -> Construction:
        """The kinematic diagram and the data."""
        return scheme(self.board, self.pencil)

    @DrawnOnce
    def analysis(self) -> Construction:
        """What a given cam does, by the positions of its follower."""
        board, motion = self.board, self.board.motion
        assert isinstance(motion, GivenCamMotion)
        parts = board.divisions * len(motion.phases) * board.refine
        phi = FULL_TURN * np.arange(parts) / parts
        sizes = self.prime_radius, self.roller_radius, self.place
        outline = laid_outline(motion, FULL_TURN / parts)
        unit = board.follower.unit
        givens = AnalysisGivens(outline, motion, board.rotation, *sizes, phi, self.profile_scale, unit)
        return board.follower.analysis(givens, self.pencil)

    @DrawnOnce
    def acceleration(self) -> Construction:
        """The acceleration over the cam angle, in a scale that is not yet known."""
        board, unit = self.board, self.board.follower.unit
        given = board.motion, board.stations, board.ordinate, board.mu_phi, unit
        return acceleration_diagram(*given, self.pencil, omega=board.omega)

    @DrawnOnce
    def integration(self) -> Construction:
        """Velocity and displacement by two graphical integrations."""
        lowest = "angle_diagram" not in self.names
        combined = self.board.paper.kept_scale(COMBINED.name)
        return integration(self.acceleration, self.board.poles, self.pencil, lowest=lowest, combined=combined)

    @DrawnOnce
    def jerk(self) -> Construction:
        """The jerk by graphical differentiation of the acceleration diagram, where it is asked for."""
        return jerk(self.integration, self.board.jerk_pole or self.board.poles[0], self.pencil)

    @DrawnOnce
    def differentiation(self) -> Construction:
        """Velocity and acceleration of a measured motion by graphical differentiation, at the scales of the others.

        It stands beside the chain, which starts from the acceleration of the fitted motion as from that of a law: the
        errors of a hand, which differentiation enlarges, would else go on into the profile.
        """
        board = self.board
        first, second = board.poles  # of the integrations, which differentiation turns round
        if isinstance(board.motion, GivenCamMotion):
            # The scale is that of a hand without error: one for all samples.
            errorless = self.perfect.analysis.readings["s"].value
            given = self.analysis, errorless, board.mu_phi, (second, first), board.paper
            return given_cam_differentiation(*given, self.pencil)
        parts = board.divisions * len(board.motion.phases) * board.refine
        # Readings scale with the drawn lift, so the scale is that of a hand without error: one for all samples.
        mu_s = Scale(float(self.perfect.integration.readings["s"].scale), board.follower.unit)
        given = board.motion, parts, board.mu_phi, mu_s, (second, first), board.paper
        return measured_differentiation(*given, self.pencil)

    @DrawnOnce
    def minimum_radius(self) -> Construction:
        """The minimum prime radius, and the place of the follower."""
        drawn = self._least_radius(self.board.follower.place)
        # Asked for only where the steps are told: the region is drawn as far as the cam centre that is adopted.
        return replace(drawn, givens=replace(drawn.givens, adopted=self.adopted_if_any, paper=self.board.paper))

    @DrawnOnce
    def pressure_angle(self) -> Construction:
        """The pressure angles at the stations of the adopted cam."""
        follower, rotation = self.board.follower, self.board.rotation
        drawn = follower.pressure_angle(self.integration, rotation, self.prime_radius, self.place, self.pencil)
        # Asked for only where the steps are told: the region of a given cam need not be drawn for its angles.
        board = self.board
        told = {"adopted": self.adopted, "paper": board.paper, "omega": board.omega, "station": board.station}
        return replace(drawn, givens=replace(drawn.givens, **told))

    @DrawnOnce
    def angle_diagram(self) -> Construction:
        """The pressure angle over the cam angle, and its maxima."""
        return angle_diagram(
            self.pressure_angle, self.board.mu_alpha or self.board.mu_phi, self.board.limits, self.pencil
        )

    @DrawnOnce
    def inversion(self) -> Construction:
        """The pitch curve of the adopted cam."""
        follower, rotation, scale = self.board.follower, self.board.rotation, self.profile_scale
        drawn = follower.inversion(self.integration, rotation, self.prime_radius, self.place, scale, self.pencil)
        # Asked for only where the steps are told: the region of a given cam need not be drawn for its profile.
        return replace(drawn, givens=replace(drawn.givens, adopted=self.adopted, paper=self.board.paper))

    @DrawnOnce
    def curvature(self) -> Construction:
        """The minimum radius of curvature of the pitch curve."""
        return self.board.follower.curvature(self, self.pencil)

    @DrawnOnce
    def roller(self) -> Construction:
        """The roller radius that the rule proposes."""
        return roller_radius(self.curvature, self.board.roller_rule, self.board.roller_radius, self.pencil)

    @DrawnOnce
    def working_profile(self) -> Construction:
        """The profile on which the roller runs."""
        # Where the task gives the roller nothing is rounded; a flat face has neither a roller nor a pressure angle.
        rolled = self.roller if self.board.roller_radius is None and "roller" in self.names else None
        measured = self.pressure_angle if "pressure_angle" in self.names else None
        return working_profile(self.inversion, self.roller_radius, self.pencil, rolled, measured)

    # --- decisions ---------------------------------------------------------------------------------------------------

    @property
    def perfect(self) -> Chain:
        """The same drawing without drawing errors."""
        if self.pencil.perfect and self.pencil.samples is None and not self.done:
            return self
        if PERFECT_PENCIL not in self._by_others:
            self._by_others[PERFECT_PENCIL] = replace(self, pencil=PERFECT_PENCIL, done={})
        return self._by_others[PERFECT_PENCIL]

    def by(self, pencil: Pencil) -> Chain:
        """The same task with the same decisions, drawn with another pencil."""
        return self._deciding_alike(replace(self, pencil=pencil, done={}))

    def redrawn(self, refine: int = 1, pencil: Pencil | None = None) -> Chain:
        """The same cam, every part divided in ``refine``, drawn with another pencil; by default without errors."""
        board = self.board if refine == 1 else replace(self.board, refine=refine * self.board.refine)
        return replace(self, board=board, pencil=pencil or Pencil(), decided=self.sizes, done={})

    def continued_from(self, construction: Construction) -> Chain:
        """The chain in which this construction takes the place of the one of its name: what comes later follows it.

        The adopted sizes stay as they were: decisions are those of a hand without error.
        """
        later = self.names[self.names.index(construction.name) :] if construction.name in self.names else ()
        # What was drawn before stays; what comes later, or was not drawn yet, is drawn when it is asked for.
        kept = {name: drawn for name, drawn in self.lying.items() if name not in later}
        done = kept | {construction.name: construction}
        return self._deciding_alike(replace(self, done=done))

    def _deciding_alike(self, other: Chain) -> Chain:
        # The same board is drawn alike by a perfect hand, so what the decisions rest on is not drawn again.
        if other.perfect is not other:
            other._by_others[PERFECT_PENCIL] = self.perfect
        return other

    @property
    def spans(self) -> tuple[slice, ...]:
        """The slice of each moving phase among all stations."""
        return self.board.stations.phases

    @property
    def rounding(self) -> float:
        """The step [mm] of which adopted sizes are multiples."""
        if self.board.rounding is not None:
            return self.board.rounding
        return usual_rounding(self.board.prime_radius or self._proposal("prime_radius"))

    @cached_property
    def place(self) -> float:
        """The adopted offset or centre distance [mm]: as given, else a round number near the one found."""
        return self.decided.place if self.decided else self.perfect._adopted[1]

    @cached_property
    def prime_radius(self) -> float:
        """The adopted prime radius [mm]: as given, else a round number above the minimum at the adopted place."""
        return self.decided.prime_radius if self.decided else self.perfect._adopted[0]

    @property
    def rounded(self) -> bool:
        """Whether the prime radius and the place are multiples of the rounding, where the task leaves them open."""
        board = self.board
        open_ = [self.prime_radius] if board.prime_radius is None else []
        open_ += [self.place] if board.follower.place is None else []
        return all(math.isclose(size, round(size / self.rounding) * self.rounding, rel_tol=1e-9) for size in open_)

    def adopted(self) -> Adoption:
        """How the prime radius and the place came about, with the minimum that was read."""
        board, region = self.board, self.perfect.minimum_radius
        found = None if board.follower.place is not None else float(region.value(board.follower.place_name))
        least, given = float(region.value("prime_radius")), board.prime_radius is not None
        trials = () if self.decided else self.perfect.trials
        if found is None:
            return Adoption(self.prime_radius, self.place, least, None, given, self.rounding, trials=trials)
        there = float(self.perfect._least_radius(self.place).value("prime_radius"))
        return Adoption(self.prime_radius, self.place, there, found, given, self.rounding, least, trials)

    def adopted_if_any(self) -> Adoption | None:
        """How the prime radius and the place came about; None where the region cannot be read."""
        try:
            return self.adopted()
        except DesignError:
            return None

    @property
    def _adopted(self) -> tuple[float, float]:
        """Prime radius and place [mm]: as the pressure angles permit, and larger if the profile would be too sharp."""
        return (self.trials[-1].prime_radius, self.trials[-1].place) if self.trials else self._by_angles

    @cached_property
    def trials(self) -> tuple[Trial, ...]:
        """The prime radii that are tried one after another; the last leaves the profile blunt and thick enough.

        None where neither its curvature nor its bore limits the cam, or the task gives the prime radius; nor where a
        given roller suits the first.
        """
        board = self.board
        if board.prime_radius is not None or (board.needed_profile_radius is None and not board.shaft_radius):
            return ()
        trials = [self._tried(*self._by_angles)]
        while (lacking := max(trials[-1].too_sharp, trials[-1].too_thin)) > ROUNDING_SLACK * self.rounding:
            radius, place = trials[-1].prime_radius + lacking, trials[-1].place
            radius = multiple(steps_up(radius, self.rounding), self.rounding)
            places = self._places(radius)
            if board.follower.place is None:
                place = nearest_multiple(places, place, self.rounding) or place
            if len(trials) == MAX_TRIALS or not lies_in(places, place, self.rounding):
                raise _no_radius(board, trials[-1])
            trials.append(self._tried(radius, place))
        limited = board.min_profile_radius is not None or board.shaft_radius
        return tuple(trials) if limited or len(trials) > 1 else ()

    def _tried(self, radius: float, place: float) -> Trial:
        """The pitch curve with these sizes, drawn by a perfect hand on another sheet, and its sharpest bend.

        For the bore alone it is drawn only where the roller follows from it.
        """
        board = self.board
        same = {name: drawn for name, drawn in self.perfect.lying.items() if name in ("acceleration", "integration")}
        other = replace(self.perfect, decided=AdoptedSizes(radius, place, 0.0), done=same)
        roller = touching = board.roller_radius
        if roller is None or touching is None:
            proposed = float(other.roller.value("roller_radius"))
            roller = self._rounded_roller(proposed) if 0 < proposed < math.inf else 0.0
            # The rule leaves the profile blunt enough, if it leaves a roller at all.
            touching = 0.0 if proposed >= self.rounding else self.rounding
        rho, needed, permitted = math.inf, 0.0, board.min_profile_radius
        if board.needed_profile_radius is not None:
            rho = float(other.curvature.value("rho"))
            needed = BLUNT_FACTOR * touching if permitted is None else touching + permitted
        return Trial(radius, place, rho, needed, radius - roller, board.shaft_radius, by_roller=permitted is None)

    @cached_property
    def _by_angles(self) -> tuple[float, float]:
        """Prime radius and place [mm]: round numbers that go with one another on the region, where it has any."""
        radius, place = self.board.prime_radius, self.board.follower.place
        if radius is not None and place is not None:
            return radius, place
        place = self._rounded_place() if place is None else place
        radius = self._rounded_radius(place) if radius is None else radius
        together = lies_in(self._places(radius), place, self.rounding)
        return (radius, place) if together else self._next_round_sizes() or (radius, place)

    def _rounded_place(self) -> float:
        """The place [mm]: the round number nearest to the one found at which some radius is permitted."""
        found = self._proposal(self.board.follower.place_name) / self.rounding
        nearest = round(found)
        # The region of an arm may end at the distance found: then the circle about the pivot just inside misses it.
        beyond = nearest + (1 if found > nearest else -1)
        rounded = [multiple(count, self.rounding) for count in (nearest, beyond)]
        least = (float(self.perfect._least_radius(place).value("prime_radius")) for place in rounded)
        return next((place for place, radius in zip(rounded, least, strict=True) if not math.isnan(radius)), rounded[0])

    def _rounded_radius(self, place: float) -> float:
        """The next round number [mm] above the minimum radius at a place."""
        given = self.board.follower.place is not None
        least = self.perfect.minimum_radius if given else self.perfect._least_radius(place)
        radius = multiple(steps_up(self._readable(least, "prime_radius"), self.rounding), self.rounding)
        # Without the rest line a large offset leaves no least radius but the offset itself, which no cam can have; nor
        # can it have one of its roller.
        smaller = max(self.board.follower.must_exceed(place), self.board.roller_radius or 0.0)
        stretched = smaller / self.rounding
        return max(radius, multiple(math.floor(stretched + ROUNDING_SLACK) + 1, self.rounding))

    def _next_round_sizes(self) -> tuple[float, float] | None:
        """The next larger round radius with a round place, else with less round numbers [mm]; None if there is none.

        The places that an arm may have at one radius, and the radii at one distance, may lie closer to one another than
        the rounding.
        """
        given = self.board.prime_radius, self.board.follower.place
        for step in (self.rounding * part for part in FINER_ROUNDINGS):
            first = steps_up(self._proposal("prime_radius"), step)
            radii = [multiple(first + k, step) for k in range(FURTHER_MULTIPLES)] if given[0] is None else [given[0]]
            for radius in radii:
                places, place = self._places(radius), given[1]
                if place is None:
                    place = nearest_multiple(places, self._proposal(self.board.follower.place_name), step)
                if place is not None and lies_in(places, place, step):
                    return radius, place
        return None

    def _places(self, radius: float) -> Floats:
        return self.board.follower.places(self.perfect.minimum_radius, radius)

    @cached_property
    def roller_radius(self) -> float:
        """The adopted roller radius [mm]: as given, else the next round number below what the rule proposes."""
        if self.decided:
            return self.decided.roller_radius
        if self.board.roller_radius is not None:
            return self.board.roller_radius
        proposed = float(self.perfect.roller.readings["roller_radius"].value)
        if not proposed > 0:
            remedy = say("give follower.roller_radius or another rule")
            quantity = say("roller radius by the rule")
            raise DesignError(quantity, say("{length:.4g} mm", length=proposed), say("greater than 0 mm"), remedy)
        return self._rounded_roller(proposed)

    def _rounded_roller(self, proposed: float) -> float:
        """The next round number below a proposed roller radius [mm]."""
        # One smaller than the rounding is kept as proposed: rounding it down would leave none.
        return multiple(math.floor(proposed / self.rounding + ROUNDING_SLACK), self.rounding) or proposed

    @property
    def sizes(self) -> AdoptedSizes:
        """All adopted sizes."""
        return AdoptedSizes(self.prime_radius, self.place, self.roller_radius)

    @cached_property
    def profile_scale(self) -> Scale:
        """The largest standard scale at which the pitch curve, with its rollers or the phase angles, fits its room."""
        r0, board = self.prime_radius, self.board
        if (kept := board.paper.kept_scale(PROFILE.name)) is not None:
            return kept
        rollers = board.roller_radius
        if rollers is None:
            rollers = min((term(rho=r0, r0=r0) for term in board.roller_rule), default=0.0)
        width, height, ratios = board.paper.width, board.paper.height, board.paper.ratios
        reach = board.follower.reach(r0, self.place, board.motion, max(rollers, 0.0), board.rotation)
        # The arcs of the phase angles about the curve do not grow with the scale.
        room = min(width, height)
        inner = max(min(width - PHASE_ANGLES_ROOM.real, height - PHASE_ANGLES_ROOM.imag), room / 2)
        within = board.follower.reach(r0, self.place, board.motion, 0.0, board.rotation)
        return coarsest_scale(standard_scale(2 * reach, room, ratios), standard_scale(2 * within, inner, ratios))

    def _least_radius(self, place: float | None) -> Construction:
        board = self.board
        return board.follower.least_radius(self.integration, board.rotation, board.limits, place, self.pencil)

    def _proposal(self, name: str) -> float:
        return self._readable(self.perfect.minimum_radius, name)

    def _readable(self, region: Construction, name: str) -> float:
        """The machine value of a reading that a decision rests on."""
        value = float(region.readings[name].value)
        if math.isnan(value):
            follower, given = self.board.follower, self.board.prime_radius
            missing = [f"follower.{follower.place_name}"] if follower.place is None else []
            missing += ["cam.prime_radius"] if given is None else []
            if slip := self.board.limits.slip():
                way, angle = slip
                limit = say("large enough for lines that cross at a degree or more")
                remedy = say("{angle:g} rad would be {degrees:.0f} degrees: write {degrees:.0f}, or give {names}")
                remedy = remedy.with_values(degrees=math.degrees(angle), angle=angle, names=and_chain(missing))
                found = say("{angle:g} degrees", angle=angle)
                raise DesignError(LIMIT_NAMES[way], found, limit, remedy)
            limit = say("a place within all limits, where lines cross at a degree or more")
            remedy = say("give {names}, or permit larger pressure angles", names=and_chain(missing))
            if "curvature" in follower.conditions:
                remedy = say("give {names}, or permit a smaller radius of curvature", names=and_chain(missing))
            raise DesignError(say("minimum prime radius"), say("unreadable"), limit, remedy)
        if name == "prime_radius" and not value > 0:
            remedy = say("any radius keeps the limits: give cam.prime_radius, or stricter limits")
            quantity = say("minimum prime radius")
            raise DesignError(quantity, say("{length:g} mm", length=value), say("greater than 0 mm"), remedy)
        return value
