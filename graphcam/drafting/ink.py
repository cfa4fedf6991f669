"""What a construction leaves on the paper: readings, and steps made of marks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.drafting.marks import AngleMark, Dimension, Label, Mark, Points

# A construction says what it draws, so both come from here.
from graphcam.words import Caption as Caption, Tell, Words as Words, say as say


@dataclass(frozen=True)
class View:
    """One drawing on the sheet with its own origin.

    ``across`` and ``up`` name what its axes measure: views with the same ``across`` stand exactly one under the other,
    views with the same ``up`` exactly side by side, origin to origin.

    answer : what the title says that is only found by drawing, if anything: a sheet is blank there until the
        construction ``found_by`` is drawn
    """

    name: str
    title: Caption
    across: str
    up: str
    answer: Caption | None = None
    found_by: str = ""


@dataclass(frozen=True, eq=False)
class Step:
    """One move of the draughtsman: what is done, in whole sentences, and the marks it leaves in one view.

    reads : the construction's readings that are taken, or get their scale, with this move
    given : those of the marks that a worksheet shows before anything is drawn: axes, divisions, what the task gives
    """

    title: Caption
    caption: Caption
    view: View
    marks: tuple[Mark, ...]
    reads: tuple[str, ...] = ()
    given: tuple[Mark, ...] = ()

    @property
    def own(self) -> tuple[Mark, ...]:
        """The marks that are not given."""
        return tuple(mark for mark in self.marks if not any(mark is given for given in self.given))

    def told(self, tell: Tell) -> Step:
        """The same step with every text as ``tell`` says it.

        >>> step = Step(say("Pole"), say("The pole stands."), View("v", say("v"), "phi", "v"), (Label(0j, say("H")),))
        >>> step.told(lambda words: str(words).upper()).marks[0].text
        'H'
        """
        # What is given stands among the marks too, and is the same object there.
        told = {
            id(mark): replace(mark, text=tell(mark.text)) if isinstance(mark, Label | Dimension | AngleMark) else mark
            for mark in (*self.marks, *self.given)
        }
        marks, given = (tuple(told[id(mark)] for mark in part) for part in (self.marks, self.given))
        title, caption = _plain(self.title, tell), _plain(self.caption, tell)
        answer = None if self.view.answer is None else _plain(self.view.answer, tell)
        view = replace(self.view, title=_plain(self.view.title, tell), answer=answer)
        return replace(self, title=title, caption=caption, view=view, marks=marks, given=given)


def _plain(caption: Caption, tell: Tell) -> Caption:
    return Caption("{text}", {"text": tell(caption)})


@dataclass(frozen=True, eq=False)
class Reading:
    """A length or an angle read off the paper, and what it stands for.

    paper : mm (an angle: rad), scalar or array; with a pencil that carries samples their axis comes first
    scale : machine units per mm of paper; 1 for an angle, which is itself on every scale
    """

    paper: NDArray[np.float64]
    scale: float | NDArray[np.float64]
    unit: str

    @property
    def value(self) -> NDArray[np.float64]:
        """The machine quantity: scale times paper."""
        scale = np.asarray(self.scale)
        # A scale per sample stands before the axes of one drawing.
        return self.paper * scale.reshape(scale.shape + (1,) * (np.ndim(self.paper) - scale.ndim))

    @property
    def per_mm(self) -> float:
        """The scale in the first sample [unit/mm]."""
        return float(np.ravel(self.scale)[0])


def reading(paper: ArrayLike, scale: float | NDArray[np.float64], unit: str) -> Reading:
    """A :class:`Reading` of what is on the paper.

    >>> reading(50.0, 0.6, "mm").value.item()
    30.0
    """
    return Reading(np.asarray(paper, dtype=np.float64), scale, unit)


@dataclass(frozen=True, eq=False)
class Construction:
    """A textbook construction as a value: what was given, what was read, and how to draw it.

    Attributes
    ----------
    name : of the construction
    givens : what lay on the board, among it the constructions it started from
    readings : what was read off the paper, by name
    points : places on the paper (complex, mm in the view's frame) that the steps and later constructions use, by name
    draw : module-level function that makes the steps
    """

    name: str
    givens: Mapping[str, Any]
    readings: Mapping[str, Reading]
    points: Mapping[str, Points]
    draw: Callable[[Construction], list[Step]]

    def steps(self) -> list[Step]:
        """The construction step by step, drawn when asked for; with a sampled pencil the first sample is shown."""
        return self.draw(self)

    def first(self, name: str) -> Any:
        """The points or the reading's paper of that name in the first sample (or the only one): what a step shows."""
        values = self.points[name] if name in self.points else self.readings[name].paper
        return values[0] if self.givens["pencil"].samples is not None else values

    def value(self, name: str) -> Any:
        """The machine value of a reading in the first sample."""
        values = self.readings[name].value
        return values[0] if self.givens["pencil"].samples is not None else values
