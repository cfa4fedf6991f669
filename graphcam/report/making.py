"""The note on the errors of making."""

import numpy as np

from graphcam.constructions.axes import degrees
from graphcam.drafting.scale import unit
from graphcam.given.making_errors import deviations_within
from graphcam.report.markdown import Block, Equation, Grid, number, warning
from graphcam.solving.solution import Solution
from graphcam.solving.tolerance_design import ERROR_NAMES, ToleranceDesign, error_name, most_important, significant
from graphcam.words import Caption, and_list, say

SLIDING_FORMULA = (
    r"\Delta s = \frac{\delta + \Delta r}{\cos\alpha} + \sigma\,\Delta e\,\tan\alpha,\qquad "
    r"\delta = A\cos(n\varphi + \beta)."
)
SWINGING_FORMULA = (
    r"\Delta s = \frac{1}{l}\left(\frac{\delta + \Delta r}{\cos\alpha} - \Delta c\,\frac{\sin(\psi - \alpha)}"
    r"{\cos\alpha} - \Delta l\,\tan\alpha\right),\qquad \delta = A\cos(n\varphi + \beta)."
)
ON_A_SWINGING_FACE = (
    r"\Delta s = \frac{1 + \sigma v}{c\cos\psi}\left(\delta - \Delta c\,\sin\psi\right),\qquad "
    r"\delta = A\cos(n\varphi + \beta)."
)
ON_A_FACE = r"\Delta s = \delta = A\cos(n\varphi + \beta)."
MOVED_BY_ERRORS = {
    (False, True): SLIDING_FORMULA,
    (False, False): ON_A_FACE,
    (True, True): SWINGING_FORMULA,
    (True, False): ON_A_SWINGING_FACE,
}
"""How errors of making move the follower, by whether it swings, and whether it takes a roller."""
SPREAD_CAPTIONS = {
    "normal": say("A size is normally distributed, with three standard deviations on either side within its zone."),
    "uniform": say("A size is uniformly distributed in its zone."),
}
VARIANCE_CAPTION = say("Most of the variance of ${symbol}$, {part:.0f} %, is due to one tolerance: {name}.")


def errors_of_making(solution: Solution) -> list[Block]:
    """The chapter on the bands of the motion, the most important tolerance, and a sample of solved mechanisms."""
    design = solution.tolerances
    assert design is not None
    if design.undercut:
        return [warning(say("The profile is undercut: how errors of making move the follower is not told."))]
    kin = solution.cam.kinematics
    law = MOVED_BY_ERRORS[kin.swings, kin.takes_roller]
    first = say(
        "An error of the profile along its normal, $\\delta$, and errors of the sizes move the follower, to the first "
        "order, by"
    )
    waves = say(
        "A wave that occurs $n$ times in a turn moves the velocity by up to $n$ times and the acceleration by up to "
        "$n^2$ times as much: short waves are not seen in the displacement, but they shake the follower."
    )
    bands = say(
        "Independent errors add as the squares. The bands hold {coverage:g} of 100 mechanisms: {deviations} standard "
        "deviations on either side, and never more than all errors at their ends at once. A wave has a random phase.",
        coverage=100 * design.given.coverage,
        deviations=number(deviations_within(design.given.coverage), 2),
    )
    told = design.table()
    below = say(
        "The table says, where each band is widest, how far each tolerance alone moves $s$, $v$ and $a$ at the most, "
        "and which part of the variance is due to it."
    )
    names = design.given().reaches
    sizes = [SPREAD_CAPTIONS[design.given.distribution]] if names.keys() & ERROR_NAMES.keys() else []
    rows = Grid(told.title, told.header, told.rows)
    return [first, Equation(law), waves, bands, *sizes, below, rows, *_matters(design), _solved(design)]


def _matters(design: ToleranceDesign) -> list[Caption]:
    shares = design.bands.table()
    if len(shares) == 1:
        return []
    return [
        VARIANCE_CAPTION.with_values(symbol=told.symbol, part=100 * float(most.shares[k]), name=error_name(most.name))
        for k, told in enumerate(design.quantities)
        for most in [most_important(shares, k)]
    ]


def _solved(design: ToleranceDesign) -> Caption:
    bands, rows = design.bands, list[Caption]()
    for k, told in enumerate(design.quantities):
        at = int(np.argmax(bands.sample.half_width[k]))
        rows.append(
            say(
                "${symbol}$ ± {sampled} {unit} at {phi} (± {linear} {unit} to the first order)",
                symbol=told.symbol,
                sampled=significant(told.times * float(bands.sample.half_width[k, at])),
                linear=significant(told.times * float(bands.half_width[k, at])),
                unit=unit(told.unit),
                phi=degrees(round(float(bands.phi[at]), 6)),
            )
        )
    return say(
        "As a check, {samples} mechanisms with random errors were solved exactly, for the place where each follower "
        "touches its wavy profile. Where their bands are widest, they are {bands}. Where one wave dominates, the first "
        "order takes a band too wide.",
        samples=bands.samples,
        bands=and_list(rows),
    )
