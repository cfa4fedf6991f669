"""Adopting sizes as in a design office: round numbers, as far as the drawn region has any."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

import numpy as np

from graphcam.drafting.ink import Caption, Part, Step, View, say
from graphcam.drafting.scale import UNLIMITED, Paper
from graphcam.given.laws import Floats
from graphcam.words import sequence

ROUNDING_SLACK = 1e-9
"""A reading this close to a multiple, in parts of it, is that multiple."""


BLUNT_FACTOR = 1.15
"""Times the radius of a given roller, the sharpest bend suffices as it is drawn: three points read it too large."""
SAME_RADIUS = 1e-4
"""A radius that differs by less, in parts of it, is told as the same."""


def multiple(count: int, step: float) -> float:
    """So many steps [mm], without the rounding error of a product.

    >>> 7 * 0.1, multiple(7, 0.1)
    (0.7000000000000001, 0.7)
    """
    # Divided rather than multiplied where the step is a fraction: 7 * 0.1 is not 0.7, but 7 / 10 is.
    return count * step if step >= 1 else count / round(1 / step)


def usual_rounding(radius: float) -> float:
    """The step [mm] that sizes are rounded to where none is given: the largest power of ten below r0/10, at most 1.

    >>> usual_rounding(43.28), usual_rounding(4.3)
    (1.0, 0.1)
    """
    return min(1.0, 10.0 ** math.floor(math.log10(radius / 10)))


def steps_up(value: float, step: float) -> int:
    """The number of steps that reach a value: a multiple that was read is not raised.

    >>> steps_up(43.28, 1.0), steps_up(44 + 1e-12, 1.0)
    (44, 44)
    """
    return math.ceil(value / step - ROUNDING_SLACK)


def lies_in(stretches: Floats, place: float, step: float) -> bool:
    """Whether a place lies in one of the stretches (k, 2), but for rounding of the arithmetic."""
    low, high = stretches.T
    return bool(np.any((low <= place + ROUNDING_SLACK * step) & (place - ROUNDING_SLACK * step <= high)))


def nearest_multiple(stretches: Floats, wanted: float, step: float) -> float | None:
    """The multiple of ``step`` inside one of the stretches (k, 2) that is nearest to ``wanted``; None if there is none.

    >>> nearest_multiple(np.array([[81.2, 83.7], [90.1, 90.8]]), 88.0, 1.0)
    83.0
    >>> nearest_multiple(np.array([[90.1, 90.8]]), 88.0, 1.0)
    """
    places: list[float] = []
    for low, high in stretches.tolist():
        # Inside, and not at the end: there the limits may be broken by a rounding, or the mechanism be stretched out.
        first, last = math.floor(low / step + ROUNDING_SLACK) + 1, math.ceil(high / step - ROUNDING_SLACK) - 1
        if first <= last:
            places.append(multiple(min(max(round(wanted / step), first), last), step))
    return min(places, key=lambda place: abs(place - wanted), default=None)


# --- what is told of it ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Trial:
    """A prime radius that was tried for the curvature of the profile and for its bore, with what was read [mm].

    rho : of the sharpest bend of the pitch curve;  needed : by the roller and the permitted radius of the profile
    base : radius of the base circle;  shaft : what the bore takes of it, 0 where the task gives none
    by_roller : whether it is needed by the roller alone, as no radius of the profile is permitted
    """

    prime_radius: float
    place: float
    rho: float
    needed: float
    base: float
    shaft: float
    by_roller: bool

    @property
    def roller(self) -> float:
        """Radius of the roller."""
        return self.prime_radius - self.base

    @property
    def too_sharp(self) -> float:
        """How much larger rho should be; 0 where it is large enough, or where no bend can be read."""
        return max(0.0, self.needed - self.rho) if self.rho < math.inf else 0.0

    @property
    def too_thin(self) -> float:
        """How much larger the base circle should be for the shaft."""
        return max(0.0, self.shaft - self.base)


@dataclass(frozen=True)
class Adoption:
    """How the prime radius and the follower's place came about [mm].

    prime_radius, place : as adopted
    least : the least prime radius at the adopted place, as a hand without error reads it; NaN where it cannot be read
    found : the place that the region proposes; None where the task gives it
    given : whether the task gives the prime radius
    rounding : sizes are adopted in multiples of this
    proposed : the least prime radius at the place that the region proposes; None where the task gives it
    trials : the prime radii that were tried for the curvature of the profile and its bore, where there are such limits
    """

    prime_radius: float
    place: float
    least: float
    found: float | None
    given: bool
    rounding: float
    proposed: float | None = None
    trials: tuple[Trial, ...] = ()


def nothing_adopted() -> Adoption | None:
    """None: what is drawn on its own, with sizes that are only tried, adopts nothing."""
    return None


@dataclass(frozen=True, eq=False, kw_only=True)
class ChainSettings:
    """What a construction knows only where it is drawn as one of a chain.

    adopted : tells how the sizes came about that are taken in the end; None where they are not known
    paper : for views of its own
    """

    adopted: Callable[[], Adoption | None] = nothing_adopted
    paper: Paper = UNLIMITED


def adoption_step(adopted: Adoption, symbol: str, mu: float, view: View) -> Step:
    """The step that adopts the sizes, before anything is drawn with them.

    symbol : of the place;  mu : mm of the machine to a millimetre of paper of the view
    """
    on_paper = say("On paper r₀ is {r0:g}/{mu:.5g} = {paper:.2f} mm.")
    on_paper = on_paper.with_values(r0=adopted.prime_radius, mu=mu, paper=adopted.prime_radius / mu)
    by_angles = adopted.trials[0].prime_radius if adopted.trials else adopted.prime_radius
    told = [*_of_the_radius(replace(adopted, prime_radius=by_angles), symbol)]
    *parts, last = [Part(sequence(told, " ")), *(Part(_of_trial(*pair)) for pair in _with_next(adopted.trials))]
    parts.append(Part(sequence([last.caption, on_paper], " ")))
    if adopted.found is not None:
        place = say("The value found, {symbol} = {found:.5g} mm, is rounded to {place:g} mm.")
        parts.insert(0, Part(place.with_values(symbol=symbol, found=adopted.found, place=adopted.place)))
    why = say("A round size is easily made and measured, and a radius larger than the minimum stays within the limits.")
    if adopted.given:
        why = say("The limits are satisfied only if the given radius is not smaller than the minimum permitted one.")
    return Step(say("The adopted prime radius"), tuple(parts), view, (), why=why)


def _with_next(trials: Sequence[Trial]) -> list[tuple[Trial, Trial | None]]:
    return [*zip_longest(trials, trials[1:])]


PROFILE_TRIAL = say(
    "Draw the pitch curve for r₀ = {r0:g} mm on another sheet: its sharpest bend has ρ = {rho:.4g} mm, but the roller "
    "and the permitted radius of the profile take {needed:g} mm. Add what is lacking, {lacking:.4g} mm, to r₀, and "
    "round it up to {next:g} mm."
)
ROLLER_TRIAL = say(
    "Draw the pitch curve for r₀ = {r0:g} mm on another sheet: its sharpest bend has ρ = {rho:.4g} mm, less than "
    "{factor:g} times the radius of the roller, {needed:g} mm: three points read a sharp bend too large, and the "
    "profile may be undercut. Add what is lacking, {lacking:.4g} mm, to r₀, and round it up to {next:g} mm.",
    factor=BLUNT_FACTOR,
)


def _of_trial(trial: Trial, following: Trial | None) -> Caption:
    """A sentence or two on a radius that is tried, and on the next if it is too small."""
    told: list[Caption] = []
    if following is None:
        if trial.needed:
            told.append(
                say(
                    "With r₀ = {r0:g} mm the sharpest bend of the pitch curve has ρ = {rho:.4g} mm; {needed:g} mm "
                    "suffice."
                )
            )
        if trial.shaft:
            told.append(
                say(
                    "With r₀ = {r0:g} mm the base circle has a radius of {base:.4g} mm; the shaft, its keyway and a "
                    "wall take {shaft:.4g} mm."
                )
            )
    elif trial.too_sharp >= trial.too_thin:
        said = ROLLER_TRIAL if trial.by_roller else PROFILE_TRIAL
        told.append(said.with_values(lacking=trial.too_sharp, next=following.prime_radius))
    else:
        told.append(
            say(
                "With r₀ = {r0:g} mm the base circle has a radius of {base:.4g} mm, but the shaft, its keyway and a "
                "wall take {shaft:.4g} mm. Add what is lacking, {lacking:.4g} mm, to r₀, and round it up to {next:g} "
                "mm."
            ).with_values(lacking=trial.too_thin, next=following.prime_radius)
        )
    values = {"r0": trial.prime_radius, "rho": trial.rho, "needed": trial.needed}
    values |= {"base": trial.base, "shaft": trial.shaft}
    return sequence([each.with_values(**values) for each in told], " ")


def _of_the_radius(adopted: Adoption, symbol: str) -> list[Caption]:
    """Sentences on the adopted radius, against the minimum that was found, or read again at the rounded place.

    >>> [str(said) for said in _of_the_radius(Adoption(44.0, -10.0, 43.2804, None, False, 1.0), "e")]
    ['Round the minimum radius, 43.28 mm, up to r₀ = 44 mm.']
    >>> [str(said) for said in _of_the_radius(Adoption(17.0, 102.0, 16.248, 102.12, False, 1.0, 16.222), "c")]
    ['Round the minimum radius, 16.222 mm, up to r₀ = 17 mm.']
    >>> [str(said) for said in _of_the_radius(Adoption(18.0, 102.0, 17.02, 102.12, False, 1.0, 16.98), "c")]
    ['Read the minimum radius again at c = 102 mm: 17.02 mm.', 'Round the minimum radius, 17.02 mm, up to r₀ = 18 mm.']
    """
    told = _against(adopted, adopted.least)
    if adopted.proposed is None:
        return [told]
    found = _against(adopted, adopted.proposed)
    if found.template == told.template:
        return [found]
    at = say("Read the minimum radius again at {symbol} = {place:g} mm: {least:.5g} mm.")
    return [at.with_values(symbol=symbol, place=adopted.place, least=adopted.least), told]


def _against(adopted: Adoption, least: float) -> Caption:
    """A sentence on the adopted radius, against a minimum permitted one [mm].

    >>> str(_against(Adoption(61.0, 150.0, 32.81, None, True, 1.0), 32.81))
    'The task gives r₀ = 61 mm, which is larger than the minimum permitted radius, 32.81 mm.'
    """
    r0 = adopted.prime_radius
    if math.isnan(least):
        told = say("The task gives r₀ = {r0:g} mm.") if adopted.given else say("Take r₀ = {r0:g} mm.")
    elif math.isclose(r0, least, rel_tol=SAME_RADIUS):
        told = say("Take r₀ = {r0:g} mm, which is the minimum permitted radius itself.")
    elif adopted.given and r0 < least:
        told = say(
            "The task gives r₀ = {r0:g} mm, smaller than the minimum permitted radius, {least:.5g} mm: a limit "
            "is exceeded."
        )
    elif adopted.given:
        told = say("The task gives r₀ = {r0:g} mm, which is larger than the minimum permitted radius, {least:.5g} mm.")
    elif adopted.trials and adopted.trials[0].roller >= least:
        told = say(
            "Take r₀ = {r0:g} mm, larger than the radius of the roller; the minimum by the pressure angles is "
            "{least:.5g} mm."
        )
    elif math.isclose(r0, multiple(steps_up(least, adopted.rounding), adopted.rounding)):
        told = say("Round the minimum radius, {least:.5g} mm, up to r₀ = {r0:g} mm.")
    else:
        told = say("Take r₀ = {r0:g} mm, a round value that goes with it; the minimum is {least:.5g} mm.")
    return told.with_values(r0=r0, least=least)
