"""A second population of students, of habits and instruments: nothing of it sets any tolerance.

graphcam's own hands err by normal deviations, one more so than another.  These err by what they do: each rounds as
they are used to, reads past the worn end of a rule, holds a protractor that is off by the same everywhere, sets the
pencil to one side of the ruler, reckons with three figures, cuts the tops of curves with a French curve, and has paper
that was printed a little too small or has shrunk.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.acts import Floats, Kind
from graphcam.drafting.pencil import Pencil, Stream
from graphcam.drafting.slips import SLIPS
from graphcam.exercises.definition.drawn_answers import (
    drawn_answer,
    is_length,
    rescaled,
    with_own_answers,
    with_reading,
)
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.key.answer_scatter import curve_of

DIVISIONS = (0.2, 0.5, 0.5, 1.0)
"""To what a student rounds a length [mm]: one in four guesses fifths, one reads whole millimetres."""
TOPS = ("max_v", "max_a")
"""Readings at the top of a curve that is faired."""
LOST_AT_TOP = 0.008
"""The part of it that a French curve cuts off at most."""


@dataclass(frozen=True)
class OtherStudents(Pencil):
    """Many students, each with habits of their own."""

    line: float = 0.2
    dividers: float = 0.2
    division: float = 0.5
    protractor: float = math.radians(0.4)

    def own(self, of: str) -> Floats:
        """A number from 0 to 1 for every student (samples,), another for every habit."""
        assert self.samples is not None
        return np.random.default_rng([self.seed, *of.encode()]).uniform(size=self.samples)

    @cached_property
    def paper(self) -> Floats:
        """By what all lengths of every student's sheet are longer when they are read (samples,)."""
        return 1 + 0.004 * (2 * self.own("moisture") - 1)

    def slips(self, kind: Kind, what: str, stream: Stream, shape: tuple[int, ...]) -> Floats:
        """What is off in an act: a side that the student always errs to, and a chance within even limits."""
        slip = SLIPS[kind][what]
        chance, side = stream.uniform(-1, 1, shape), 2 * self.own(f"side {slip.of}") - 1
        if slip.of == "protractor":
            side, width = side * math.radians(0.3), np.radians(0.25 + 0.5 * self.own(slip.of) ** 2)
        else:
            side, width = side * 0.05, 0.15 + 0.3 * self.own(slip.of) ** 2
        along = (-1, *(1,) * (len(shape) - 1))
        return slip.times * (side.reshape(along) + width.reshape(along) * chance)

    def read_off(self, lengths: Floats) -> Floats:
        """Rounded as the student is used to; one in ten reads past a worn end, 0.3 mm too much."""
        along = (-1, *(1,) * (lengths.ndim - 1))
        division = np.array(DIVISIONS)[(4 * self.own("division")).astype(int)].reshape(along)
        worn = np.where(self.own("worn") < 0.1, 0.3, 0.0).reshape(along)
        return np.round((lengths + np.sign(lengths) * worn) / division) * division


def three_figures(values: Floats) -> Floats:
    """Rounded to three figures, as on a slide rule."""
    size = 10.0 ** (np.floor(np.log10(np.maximum(np.abs(values), 1e-12))) - 2)
    return np.round(values / size) * size


def on_printed_axis(right: Chain, hands: OtherStudents, printed: float) -> Chain:
    """The drawing on an axis of the cam angle that was printed smaller, and read by the scale that stands there.

    All else a student lays off by an own rule, which is as long as it should be.
    """
    if printed == 1.0:
        return right.by(hands)
    mu_phi = right.board.mu_phi
    board = replace(right.board, mu_phi=replace(mu_phi, per_mm=mu_phi.per_mm / printed))
    chain = Chain(board, hands)
    drawn = chain.integration
    if "analysis" in chain.names:
        # The outline of a given cam is printed smaller too: all is as on a true print with a larger roller and offset.
        givens = right.analysis.givens
        roller, place = givens.roller_radius / printed, givens.place / printed
        prime = givens.prime_radius - givens.roller_radius + roller
        larger = replace(givens, roller_radius=roller, place=place, prime_radius=prime)
        analysis = board.follower.analysis(larger, hands)
        pitch = {**analysis.points, "pitch": printed * analysis.points["pitch"]}
        analysis = with_reading(analysis, "s", printed * analysis.readings["s"].paper)
        chain = chain.continued_from(replace(analysis, points=pitch))
        drawn = chain.differentiation
    for name in ("v", "a"):
        drawn = rescaled(drawn, name, np.asarray(drawn.readings[name].scale) / printed)
    return chain.continued_from(drawn)


def on_printed_sheet(exercise: Exercise, right: Chain, hands: OtherStudents, printed: float) -> Chain:
    """The drawing on a worksheet of which not only that axis was printed smaller, but all that it shows."""
    shown, board = exercise.sheet, right.board
    if printed == 1.0:
        return right.by(hands)
    if "differentiation" in shown:
        drawn = right.by(hands).differentiation
        return right.by(hands).continued_from(with_reading(drawn, "rise", printed * drawn.readings["rise"].paper))
    if "acceleration" in shown:
        # Printed ordinates of 98 % are those of a diagram that was begun with 98 % of its ordinate.
        right = Chain(replace(board, ordinate=printed * board.ordinate))
    return about_printed_circles(exercise, on_printed_axis(right, hands, printed), printed)


def about_printed_circles(exercise: Exercise, chain: Chain, printed: float) -> Chain:
    """The drawing whose profile stands about the circles of the worksheet, where it shows any."""
    if "inversion" not in exercise.sheet or printed == 1.0:
        return chain
    # They are those of another cam, drawn at the scale of this one.
    board = chain.board
    follower = replace(board.follower, place=printed * chain.place)
    paper = replace(board.paper, held={**board.paper.held, "profile": chain.profile_scale.per_mm})
    other = Chain(replace(board, follower=follower, prime_radius=printed * chain.prime_radius, paper=paper))
    return chain.continued_from(other.by(chain.pencil).continued_from(chain.integration).inversion)


def answers_of_others(exercise: Exercise, right: Chain, hands: OtherStudents, printed: float = 1.0) -> list[Answers]:
    """What each of them hands in who draws everything right, on sheets printed at that size."""
    assert hands.samples is not None
    chain = on_printed_sheet(exercise, right, hands, printed)
    columns: dict[str, np.ndarray] = {}
    for asked in exercise.answers:
        if asked.kind != "number":
            points = curve_of(chain, asked) if asked.kind == "curve" else drawn_answer(chain, asked)
            columns[asked.name] = points * hands.paper[:, None]
            continue
        value = np.asarray(drawn_answer(chain, asked), dtype=np.float64)
        if is_length(chain, asked):
            value = value * hands.paper
        if asked.reading in TOPS and asked.of != "scale":
            value = value * (1 - LOST_AT_TOP * hands.own("curve"))
        if asked.of != "paper" and not asked.points:
            value = three_figures(value)
        columns[asked.name] = np.broadcast_to(np.round(value, asked.decimals), (hands.samples,))
        if asked.of == "scale":
            # What is reckoned later is reckoned with the rounded scale.
            chain = about_printed_circles(exercise, with_own_answers(chain, asked, columns[asked.name]), printed)
    numbers = {asked.name for asked in exercise.answers if asked.kind == "number"}
    return [
        Answers({name: float(values[k]) if name in numbers else values[k] for name, values in columns.items()})
        for k in range(hands.samples)
    ]
