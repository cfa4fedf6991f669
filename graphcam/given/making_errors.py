"""How far a cam and its follower may be off as they are made: the waviness of the profile, and tolerances of sizes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, check_number, choice_limit, nearest_word_remedy
from graphcam.given.laws import Floats
from graphcam.words import say

Distribution = Literal["normal", "uniform"]
TOLERANCED_SIZES = "roller_diameter", "offset", "distance", "arm"
"""The sizes that may have a tolerance; each follower has some of them."""
MADE_SIZES = "roller_radius", *TOLERANCED_SIZES[1:], "face_offset"
"""The sizes of which a cam and its follower may be off: of a roller it is the radius that counts."""
DEVIATION_SHARES = {"normal": 1 / 3, "uniform": 1 / math.sqrt(3)}
"""The standard deviation of a size as a part of half its tolerance zone: an end is three of them, or the last value."""
WAVE_DEVIATION = 1 / math.sqrt(2)
"""The standard deviation of a wave with a random phase, as a part of its amplitude."""
MAX_HARMONIC = 10_000
"""Harmonic of a wave: what is shorter is the roughness."""


@dataclass(frozen=True, eq=False)
class Deviations:
    """What is off on cams that were made; the sizes' arrays are shaped alike, (...), one number for each cam.

    harmonics : (k,) of the waves;  waves : (k, ...) complex [mm]: the profile lies the real part of the sum of
        waves * exp(i harmonics theta) too far out, along its normal at the place that is touched at the cam angle theta
    sizes : by how much a size is too large [mm], by its name: "roller_radius", "offset", "distance" (between the
        centres), "arm", "face_offset"

    Raises
    ------
    DesignError : a size has another name

    >>> import graphcam as gc
    >>> gc.Deviations((12,), np.array([0.01]), {"offset": 0.05}).waviness(0.0)[0].tolist()
    0.01
    """

    harmonics: Sequence[int]
    waves: NDArray[np.number]
    sizes: dict[str, Floats | float]

    def __post_init__(self) -> None:
        for name in self.sizes:
            if name not in MADE_SIZES:
                raise DesignError("sizes", name, *choice_limit(name, MADE_SIZES))

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the arrays: one entry for each cam."""
        return np.broadcast_shapes(self.waves.shape[1:], *map(np.shape, self.sizes.values()))

    def waviness(self, theta: Floats | float) -> tuple[Floats, Floats, Floats]:
        """How far the profile lies too far out [mm] at cam angles [rad], and its first two derivatives."""
        theta = np.asarray(theta)
        shape = np.broadcast_shapes(theta.shape, self.waves.shape[1:])
        deviation, slope, bend = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        for n, wave in zip(self.harmonics, self.waves, strict=True):
            turned = wave * np.exp(1j * n * theta)
            deviation += turned.real
            slope -= n * turned.imag
            bend -= n * n * turned.real
        return deviation, slope, bend

    def times(self, share: float) -> Deviations:
        """The deviations multiplied by a factor."""
        return Deviations(self.harmonics, share * self.waves, {name: share * off for name, off in self.sizes.items()})


@dataclass(frozen=True)
class MakingErrors:
    """Tolerances of a cam and its follower, and how what is made scatters within them.

    A wave of the profile has the amplitude that is given and a random phase.  A size scatters about its nominal value:
    a ``normal`` distribution has three standard deviations on either side within the tolerance zone, a ``uniform`` one
    fills it.  All errors are independent.

    Parameters
    ----------
    waviness : mm, the amplitudes of the profile's waves, along its normal;  harmonics : as many, waves per turn
    roller_diameter, offset, distance, arm : mm, the width of the tolerance zone, from the minimum size to the maximum;
        0 is exact.  A flat face has none of them, a translating follower no distance and no arm
    distribution : of the sizes, "normal" or "uniform"

    Raises
    ------
    DesignError : a tolerance is negative or not finite, amplitudes and harmonics are not as many, a harmonic is not
        from 1 to 10000 or occurs twice, the distribution is unknown, or there is no error at all

    >>> import graphcam as gc
    >>> errors = gc.MakingErrors(waviness=(0.01, 0.002), harmonics=(3, 24), roller_diameter=0.02)
    >>> errors.reaches
    {'waviness 3': 0.01, 'waviness 24': 0.002, 'roller_diameter': 0.01}
    """

    waviness: tuple[float, ...] = ()
    harmonics: tuple[int, ...] = ()
    roller_diameter: float = 0.0
    offset: float = 0.0
    distance: float = 0.0
    arm: float = 0.0
    distribution: Distribution = "normal"

    def __post_init__(self) -> None:
        for k, amplitude in enumerate(self.waviness):
            _check_tolerance(f"waviness[{k}]", amplitude)
        if len(self.harmonics) != len(self.waviness):
            found = say("a list of {harmonics}", harmonics=len(self.harmonics))
            wanted = say("a list of {waviness}, as waviness is", waviness=len(self.waviness))
            raise DesignError("harmonics", found, wanted, say("give every amplitude its number of waves per turn"))
        for k, harmonic in enumerate(self.harmonics):
            if not 1 <= harmonic <= MAX_HARMONIC:
                limit = say("from 1 to {highest} waves per turn", highest=MAX_HARMONIC)
                raise DesignError(f"harmonics[{k}]", harmonic, limit)
            if harmonic in self.harmonics[:k]:
                raise DesignError(f"harmonics[{k}]", harmonic, say("given once"), say("give one amplitude for it"))
        for name in TOLERANCED_SIZES:
            _check_tolerance(name, getattr(self, name))
        if self.distribution not in DEVIATION_SHARES:
            limit = say("the size of a follower")
            raise DesignError(
                "distribution", self.distribution, limit, nearest_word_remedy(self.distribution, DEVIATION_SHARES)
            )
        if not self.reaches:
            found = say("left out")
            raise DesignError("waviness", found, say("given where no size has a tolerance"), say("or give a size one"))

    @property
    def reaches(self) -> dict[str, float]:
        """How far each error may be off the nominal [mm]: an amplitude, or half a tolerance zone; none that is 0."""
        waves = {wave_name(n): a for n, a in zip(self.harmonics, self.waviness, strict=True)}
        sizes = {name: getattr(self, name) / 2 for name in TOLERANCED_SIZES}
        return {name: reach for name, reach in (waves | sizes).items() if reach}

    def part(self, name: str) -> float:
        """The standard deviation of one of the errors, as a part of how far it reaches."""
        return DEVIATION_SHARES[self.distribution] if name in TOLERANCED_SIZES else WAVE_DEVIATION

    def sample(self, samples: int, seed: int = 0) -> Deviations:
        """A sample of cams as the workshop may make them; the arrays are (..., samples, 1).

        The random numbers of an error depend only on the seed and its name: adding an error does not change the others.

        >>> import graphcam as gc
        >>> off = gc.MakingErrors((0.01,), (12,), roller_diameter=0.06).sample(100_000)
        >>> abs(off.waves).max().round(9).tolist(), off.sizes["roller_radius"].std().round(4).tolist()
        (0.01, 0.005)
        """
        if samples < 2:
            raise DesignError("samples", samples, say("2 or more"))
        if seed < 0:
            raise DesignError("seed", seed, say("0 or more"))
        waves = [
            a * np.exp(2j * np.pi * _stream(seed, wave_name(n)).random((samples, 1)))
            for n, a in zip(self.harmonics, self.waviness, strict=True)
        ]
        sizes: dict[str, Floats | float] = {}
        for name in TOLERANCED_SIZES:
            stream, half = _stream(seed, name), getattr(self, name) / 2
            if not half:
                continue
            normal = self.distribution == "normal"
            unit = stream.standard_normal((samples, 1)) / 3 if normal else stream.uniform(-1, 1, (samples, 1))
            # What is off by a tolerance of the diameter is the radius, by half of it.
            sizes |= {"roller_radius": half / 2 * unit} if name == "roller_diameter" else {name: half * unit}
        return Deviations(self.harmonics, np.array(waves).reshape(len(waves), samples, 1), sizes)


def wave_name(harmonic: int) -> str:
    """The name of the waviness of one harmonic among the errors."""
    return f"waviness {harmonic}"


def deviations_within(coverage: float) -> float:
    """How many standard deviations on either side of the mean hold that part of a normal distribution.

    >>> round(deviations_within(0.95), 4)
    1.96
    """
    if not 0 < coverage < 1:
        limit = say("between 0 and 1")
        raise DesignError("coverage", coverage, limit, say("0.95 is the band that holds 95 of 100 cams"))
    return NormalDist().inv_cdf((1 + coverage) / 2)


def _stream(seed: int, name: str) -> np.random.Generator:
    return np.random.default_rng([seed, *name.encode()])


def _check_tolerance(name: str, value: float) -> None:
    limit = say("a finite length of 0 mm or more")
    check_number(name, value, limit, say("a tolerance is the width of a zone"), least=0)
