"""What a solution says of the errors of making: how far s, v and a may be off, and which tolerance matters most."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from graphcam.constructions.axes import degrees
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import unit
from graphcam.errors import DesignError
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.motion_bands import MotionBands, Share, effects_of, half_widths, motion_bands
from graphcam.mechanism.turn_extremes import Places, over_turn
from graphcam.sheets.tables import Table
from graphcam.showing import parts_text
from graphcam.solving.turn_diagrams import TurnDiagram, plain_place, turn_diagrams
from graphcam.tasks.tolerances_table import TolerancesTable
from graphcam.words import Words, say_in

TOLERANCE_MEANING = Meaning(
    "tolerances",
    say("Errors of making"),
    say("No cam is made exactly. What is permitted decides how far the follower may be off, and how much it shakes."),
)
ERROR_NAMES = {
    "roller_diameter": say("roller diameter"),
    "offset": say("offset"),
    "distance": say("centre distance"),
    "arm": say("arm length"),
}
"""What the sizes with a tolerance are called."""


class QuantityUnits(NamedTuple):
    """A quantity as it is told: its symbol, the unit, and how many units one of the API is."""

    symbol: str
    unit: str
    times: float


QUANTITIES_BY_UNIT = {
    "mm": (QuantityUnits("s", "µm", 1e3), QuantityUnits("v", "µm/rad", 1e3), QuantityUnits("a", "mm/rad²", 1.0)),
    "rad": (QuantityUnits("s", "mrad", 1e3), QuantityUnits("v", "mrad/rad", 1e3), QuantityUnits("a", "mrad/rad²", 1e3)),
}
"""The displacement, velocity and acceleration of a follower, by the unit of its lift."""
DIAGRAM_TITLES = (
    say("How far the displacement may be off"),
    say("How far the velocity may be off"),
    say("How far the acceleration may be off"),
)
DIAGRAM_HEADINGS = (
    say("Band of s, μₛ = {mu:g} {unit}/mm"),
    say("Band of v, μᵥ = {mu:g} {unit}/mm"),
    say("Band of a, μₐ = {mu:g} {unit}/mm"),
)
DIAGRAM_REASONS = (
    say("On a steep flank an error of the profile lifts the follower by more than itself."),
    say("Every wave of the profile counts as often as it occurs in a turn."),
    say("The force of inertia grows with the square of the number of waves."),
)
BAND_CAPTION = say(
    "{coverage:g} of 100 mechanisms stay so near to the nominal value, above or below it, at {mu:g} {unit}/mm. The "
    "band is widest at {phi}."
)


@dataclass(frozen=True, eq=False)
class ToleranceDesign:
    """The bands of the motion under the tolerances of a task.

    chain : of the solution;  cam : as designed;  given : the task's table
    """

    chain: Chain
    cam: Cam
    given: TolerancesTable
    __repr__ = parts_text

    @cached_property
    def bands(self) -> MotionBands:
        """The bands of s, v and a."""
        return motion_bands(self.cam, self.given(), coverage=self.given.coverage)

    @cached_property
    def undercut(self) -> bool:
        """Whether the profile has no place for errors: it is undercut."""
        return not self.cam.roller_radius < self.cam.extremes().min_convex_radius[0]

    def check(self) -> None:
        """Check that the follower can follow the waves.

        Raises
        ------
        DesignError : it bridges their hollows
        """
        if self.undercut:
            return
        try:
            _ = self.bands
        except DesignError as error:
            raise DesignError(f"tolerances.{error.quantity}", *error.args[1:]) from None

    @property
    def quantities(self) -> tuple[QuantityUnits, QuantityUnits, QuantityUnits]:
        """The names and units in which s, v and a are told."""
        return QUANTITIES_BY_UNIT[self.chain.board.follower.unit]

    @property
    def drawn(self) -> dict[str, Construction]:
        """The diagrams by their name; none of an undercut profile."""
        return {} if self.undercut else {TOLERANCE_MEANING.name: self._construction}

    @cached_property
    def _construction(self) -> Construction:
        return turn_diagrams(TOLERANCE_MEANING, [self._diagram(k) for k in range(3)], self.chain.pencil)

    def _diagram(self, k: int) -> TurnDiagram:
        """The half-width of the band of s, v or a over the turn."""
        kin, errors, told, widest = self.cam.kinematics, self.bands.errors, self.quantities[k], self.bands.widest[k]

        def half_width(places: Places) -> Any:
            return told.times * half_widths(effects_of(kin, errors, places.values), errors, self.given.coverage)[k]

        top, of_unit = widest._replace(value=told.times * widest.value), unit(told.unit)
        return TurnDiagram(
            f"band_{told.symbol}",
            DIAGRAM_TITLES[k],
            DIAGRAM_HEADINGS[k].with_values(unit=of_unit),
            say("± {symbol}, {unit}", symbol=told.symbol, unit=of_unit),
            told.unit,
            self.cam.motion,
            over_turn(self.cam.motion, half_width),
            BAND_CAPTION.with_values(coverage=100 * self.given.coverage, unit=of_unit, phi=degrees(widest.phi)),
            why=DIAGRAM_REASONS[k],
            marked=((top, say("{value} {unit}", value=significant(top.value), unit=of_unit)),),
        )

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data, in the units of the API but for angles in degrees."""
        if self.undercut:
            return {"bands": None, "errors": None}
        bands, lift = self.bands, self.chain.board.follower.unit
        units = lift, f"{lift}/rad", f"{lift}/rad^2"
        sampled, linear = bands.sample, bands.half_width
        phi = np.degrees(bands.phi).tolist()
        named = zip("sva", units, bands.widest, linear, sampled.low, sampled.high, strict=True)
        return {
            "coverage": bands.coverage,
            "samples": bands.samples,
            "phi_deg": phi,
            "bands": {
                symbol: {
                    "widest": plain_place(top, its_unit),
                    "half_width": half.tolist(),
                    "sampled": {"low": low.tolist(), "high": high.tolist()},
                }
                for symbol, its_unit, top, half, low, high in named
            },
            "errors": {
                share.name: {
                    "reach": {"value": share.reach, "unit": "mm"},
                    "effect": dict(zip("sva", share.effects.tolist(), strict=True)),
                    "share": dict(zip("sva", share.shares.tolist(), strict=True)),
                }
                for share in bands.table()
            },
        }

    def table(self) -> Table:
        """A table of which tolerance matters most, for the sheet and for the working drawing."""
        title = say("Tolerances and what they do")
        if self.undercut:
            return Table(title, ("", ""), ((say("the profile is undercut"), "–"),))
        bands, told = self.bands, self.quantities
        header = (
            say_in("of a size", "tolerance"),
            say("± mm"),
            *(say("{symbol}, {unit}", symbol=each.symbol, unit=unit(each.unit)) for each in told),
            *(say("of {symbol}, %", symbol=each.symbol) for each in told),
        )
        rows = [self._row(share) for share in bands.table()]
        half = [each.times * top.value for each, top in zip(told, bands.widest, strict=True)]
        band = say("band of {coverage:g} %", coverage=100 * bands.coverage)
        rows.append((band, "", *map(significant, half), *(say("{part:.0f}", part=100) for _ in told)))
        found = frozenset((k, column) for k in range(len(rows)) for column in range(2, len(header)))
        return Table(title, header, tuple(rows), found)

    def _row(self, share: Share) -> tuple[Words, ...]:
        effects = [each.times * effect for each, effect in zip(self.quantities, share.effects.tolist(), strict=True)]
        parts = [say("{part:.0f}", part=100 * part) for part in share.shares.tolist()]
        return error_name(share.name), say("{reach:g}", reach=share.reach), *map(significant, effects), *parts


def error_name(name: str) -> Caption:
    """What an error is called.

    >>> str(error_name("waviness 24")), str(error_name("distance"))
    ('waviness, n = 24', 'centre distance')
    """
    return ERROR_NAMES[name] if name in ERROR_NAMES else say("waviness, n = {harmonic}", harmonic=name.split()[1])


def significant(value: float) -> Caption:
    """A number with three digits and no power of ten.

    >>> [str(significant(value)) for value in (1234.5, 12.34, 0.001234, 0.0)]
    ['1234', '12.3', '0.00123', '0']
    """
    decimals = 0 if value == 0 else max(0, 2 - int(np.floor(np.log10(abs(value)))))
    return say("{value:.{decimals}f}", value=value, decimals=decimals)


def most_important(shares: Sequence[Share], k: int) -> Share:
    """The error that brings the greatest part of the variance of s, v or a."""
    return max(shares, key=lambda share: float(share.shares[k]))
