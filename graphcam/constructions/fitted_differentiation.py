"""Differentiation on a sheet: the scale of the displacement and the poles with which its diagrams fit the paper."""

import math
from dataclasses import replace

import numpy as np

from graphcam.constructions.differentiation import MEANING, DifferentiationGivens, differentiation
from graphcam.drafting.euclid import UP, division_points
from graphcam.drafting.ink import Construction, say
from graphcam.drafting.meaning import ComparedReading
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Paper, Scale
from graphcam.given.laws import Floats
from graphcam.given.measured import IntegratedMotion, MeasuredMotion
from graphcam.given.motion import FULL_TURN, Motion, wrap

MAX_LIFT = 50.0
"""The lift is drawn as large as it fits under this height [mm of paper]."""
HEIGHT_SHARE, ROUND_POLES = 0.65, (60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0, 5.0)
"""No derivative is higher than this part of the sheet: else its pole is one of these, shorter than the usual one."""
SHORT_POLE, HIGH_ERRORS = 12.0, 5.0
"""From a shorter pole rays are hardly drawn; and of many ordinates the errors add so many standard deviations to the
highest above the lowest."""
ENLARGEMENTS, DEGREES_PER_MM = (1, 2, 3, 4, 5, 10), (0.1, 0.2, 0.25, 0.5, 1, 2, 5)
"""So many times a length is stepped off in the diagram of the displacement; and the scales of an angle there."""
GIVEN_CAM_MEANING = replace(
    MEANING,
    why=say(
        "The displacement that was measured on the cam, differentiated: a parallel to each chord through the pole cuts "
        "off the velocity in the middle of the interval. Differentiation amplifies every drawing error, and where the "
        "acceleration jumps the chords round the jump off."
    ),
    readings={
        **MEANING.readings,
        "max_v": replace(
            MEANING.readings["max_v"],
            compared=(ComparedReading("measured_max_v", say("measured maximum v"), exact="max_v"),),
        ),
        "max_a": replace(
            MEANING.readings["max_a"],
            compared=(ComparedReading("measured_max_a", say("measured maximum a"), exact="max_a"),),
        ),
    },
    scales_found_by="",
)
"""Of the differentiation of what a given cam does."""


def _poles_on(
    paper: Paper, heights: Floats, width: float, poles: tuple[float, float], line: float
) -> tuple[float, float]:
    """The poles, or shorter ones at which the derivatives fit the paper, with the errors that the chords enlarge.

    heights : over a turn in equal parts of a width, each off by about ``line`` [mm of paper]
    """
    found, off = list[float](), line
    for usual in poles:
        slopes, off = np.diff(heights, append=heights[:1]) / width, math.sqrt(2) * off / width
        steepest = float(np.ptp(slopes)) + HIGH_ERRORS * off
        possible = [usual, *(pole for pole in ROUND_POLES if pole < usual)]
        fits = (pole for pole in possible if pole * steepest <= HEIGHT_SHARE * paper.height)
        found.append(next(fits, possible[-1]))
        heights, off = found[-1] * slopes, found[-1] * off
    return found[0], found[1]


def measured_differentiation(
    motion: Motion, parts: int, mu_phi: Scale, mu_s: Scale, poles: tuple[float, float], paper: Paper, pencil: Pencil
) -> Construction[DifferentiationGivens]:
    """Differentiate the drawn curve of a measured motion over its turn, in equal parts, by chords.

    parts : of the turn;  paper : what the diagrams find on the sheet;  the others as in :func:`differentiation`
    """
    turn = FULL_TURN / mu_phi.per_mm
    x = division_points(0j, turn + 0j, parts).real[:-1]
    s = motion(x * mu_phi.per_mm)[0] / mu_s.per_mm
    poles, rows = _poles_on(paper, s, turn / parts, poles, pencil.line), None
    # Of measured accelerations there are no rows of displacements.
    if isinstance(motion, MeasuredMotion) and not isinstance(motion, IntegratedMotion):
        rows = wrap(motion.phi - motion.zero) / mu_phi.per_mm + UP * motion.measured / mu_s.per_mm
    return differentiation(x, s, mu_phi, mu_s, poles, pencil, turn=turn, rows=rows)


def given_cam_differentiation(
    analysis: Construction, errorless: Floats, mu_phi: Scale, poles: tuple[float, float], paper: Paper, pencil: Pencil
) -> Construction[DifferentiationGivens]:
    """Differentiate the displacements that were measured on a given cam, by chords.

    analysis : with the reading ``s`` at equal parts of the turn
    errorless : what a hand without error measures [mm or rad], for the scale of the diagram
    paper : what the diagrams find on the sheet
    """
    s, phi = analysis.readings["s"], analysis.givens.phi
    # As the dividers take them, or so many times: an angle in a round number of degrees a millimetre.
    measured = s.per_mm if s.unit == "rad" else analysis.givens.mu_l.per_mm  # whatever scale it is read by
    steps = np.radians(DEGREES_PER_MM) if s.unit == "rad" else measured / np.array(ENLARGEMENTS)
    fits = [mu for mu in sorted(steps.tolist()) if np.ptp(errorless) / mu <= MAX_LIFT] or [float(steps.max())]
    turn, meaning = FULL_TURN / mu_phi.per_mm, GIVEN_CAM_MEANING

    def poles_at(mu: float) -> tuple[float, float]:
        """The poles [mm of paper] at a scale of the displacement."""
        # What was measured on the cam is off by about two lines, which the diagram enlarges.
        off = pencil.line * max(1.0, 2 * measured / mu)
        return _poles_on(paper, errorless / mu, turn / phi.size, poles, off)

    on_paper = [(mu, poles_at(mu)) for mu in fits]
    # Rather a smaller displacement than a pole that is too short to draw rays from.
    per_mm, poles = next((found for found in on_paper if min(found[1]) >= SHORT_POLE), on_paper[-1])
    mu_s = Scale(per_mm * s.per_mm / measured, s.unit)
    return differentiation(phi / mu_phi.per_mm, s, mu_phi, mu_s, poles, pencil, turn=turn, meaning=meaning)
