"""What a construction leaves on the paper: readings, and steps made of marks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from textwrap import wrap
from typing import TYPE_CHECKING, Any, Generic

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.drafting.acts import Act, Drawn
from graphcam.drafting.marks import AngleMark, Dimension, Label, Mark, Points
from graphcam.drafting.meaning import Meaning
from graphcam.former_names import renamed
from graphcam.showing import MAX_LINES, MAX_WIDTH, Plottable, higher_function, value_text

# A construction says what it draws, so both come from here.
from graphcam.words import Caption as Caption, Tell, Words as Words, say as say, sequence

if TYPE_CHECKING:
    from typing_extensions import TypeVar

    from graphcam.drafting.pencil import Pencil
    from graphcam.showing import Axes, Figure

    G = TypeVar("G", covariant=True, default=Any)
    """What lies on the board of a construction."""
else:
    from typing import TypeVar

    # Its default is for type checkers, and before Python 3.13 there is none.
    G = TypeVar("G", covariant=True)


SCALE_NUMBER = say("{mu:.4g}")
"""The number of a scale in the title of a view."""


@dataclass(frozen=True)
class View:
    """One drawing on the sheet with its own origin.

    ``across`` and ``up`` name what its axes measure: views with the same ``across`` stand exactly one under the other,
    views with the same ``up`` exactly side by side, origin to origin.

    answer : what the title says that is only found by drawing, if anything: a sheet is blank there until the
        construction ``found_by`` is drawn
    blank : what of the title with its scale is the answer
    scale : its title with its scale, as {mu} and {unit}, {degrees} or {ratio}, if it says that
    mu_l : its drawing scale [mm/mm], where it has one: diagrams have several, and sketches none
    main : whether the title block bears its scale, whatever else stands on the sheet
    """

    name: str
    title: Caption
    across: str
    up: str
    answer: Caption | None = None
    found_by: str = ""
    blank: Caption = SCALE_NUMBER
    scale: Caption | None = None
    mu_l: float | None = None
    main: bool = False


@dataclass(frozen=True, eq=False)
class Row:
    """One place of a run of like moves: what it is called, what is set there, and what is left on the paper.

    name : as it stands in the table and before the setting, such as "Station 4" or "Rays 3, 10"
    setting : what differs from place to place, such as "11.11 mm × 1.2 = 13.33 mm"; empty where nothing does
    """

    name: Words
    setting: Words
    draws: tuple[Drawn, ...]

    @property
    def caption(self) -> Caption:
        """What the place is called, with its setting, as a line by itself."""
        if not self.setting:
            return say("{name}.", name=self.name)
        return say("{name}: {setting}.", name=self.name, setting=self.setting)


@dataclass(frozen=True, eq=False)
class Part:
    """A part of a step, told once: what to do, as a student would do it with the page beside the board.

    caption : one or more whole sentences: what is drawn, from where to where, by which instrument, set to what
    draws : what is left on the paper, of what may be many places those of this part; what was drawn in order to find
        it belongs to it too; nothing of a part that only says what holds
    rows : of a run of like moves every place with its setting, in the order of the drawing; the caption tells them all
    """

    caption: Caption
    draws: tuple[Drawn, ...] = ()
    rows: tuple[Row, ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Step(Plottable):
    """One move of the draughtsman: what is done, in whole sentences, and the marks it leaves in one view.

    parts : all that is told and drawn, in the order of the drawing; the step's caption is theirs, one after another
    why : the reason, in one sentence that stands alone
    reads : the construction's readings that are taken, or get their scale, with this move
    given : those of the marks that a worksheet shows before anything is drawn: axes, divisions, what the task gives
    under : further marks of a diagram under which no other stands on its page: the numbers of their common axis
    """

    _drawn_in = "construction_drawing.plot"

    title: Caption
    parts: tuple[Part, ...]
    view: View
    marks: tuple[Mark, ...]
    reads: tuple[str, ...] = ()
    given: tuple[Mark, ...] = ()
    why: Caption = field(kw_only=True, default_factory=lambda: Caption(""))
    under: tuple[Mark, ...] = field(kw_only=True, default=())

    @property
    def caption(self) -> Caption:
        """All that the parts tell, one after another."""
        return sequence([part.caption for part in self.parts], " ")

    @property
    def places(self) -> tuple[Part, ...]:
        """The parts as one goes through them: each row of a run counts as one."""
        return tuple(
            place
            for part in self.parts
            for place in ([Part(row.caption, row.draws) for row in part.rows] if part.rows else [part])
        )

    def __repr__(self) -> str:
        said = wrap(str(self.caption), MAX_WIDTH, max_lines=MAX_LINES - 2, placeholder=" ...")
        first = f"Step {str(self.title)!r}, view {self.view.name!r}, marks: {len(self.marks)}"
        return value_text(first, said, ".caption, .marks, .reads")

    @property
    def own_marks(self) -> tuple[Mark, ...]:
        """The marks that the step itself draws: those that are not given."""
        return tuple(mark for mark in self.marks if not any(mark is given for given in self.given))

    def translated(self, tell: Tell) -> Step:
        """The step with every text as ``tell`` gives it.

        >>> step = Step(say("Pole"), (), View("v", say("v"), "phi", "v"), (Label(0j, say("H")),))
        >>> step.translated(lambda words: str(words).upper()).marks[0].text
        'H'
        """
        # What is given stands among the marks too, and is the same object there.
        told = {
            id(mark): replace(mark, text=tell(mark.text)) if isinstance(mark, Label | Dimension | AngleMark) else mark
            for mark in (*self.marks, *self.given, *self.under)
        }
        groups = self.marks, self.given, self.under
        marks, given, under = (tuple(told[id(mark)] for mark in group) for group in groups)
        parts = tuple(
            replace(
                part,
                caption=_plain(part.caption, tell),
                rows=tuple(replace(row, name=tell(row.name), setting=tell(row.setting)) for row in part.rows),
            )
            for part in self.parts
        )
        answer = None if self.view.answer is None else _plain(self.view.answer, tell)
        view = replace(self.view, title=_plain(self.view.title, tell), answer=answer)
        titles = {"title": _plain(self.title, tell), "why": _plain(self.why, tell)}
        return replace(self, parts=parts, view=view, marks=marks, given=given, under=under, **titles)


def _plain(caption: Caption, tell: Tell) -> Caption:
    return Caption("{text}", {"text": tell(caption)})


@dataclass(frozen=True, eq=False, repr=False)
class Reading:
    """A length or an angle read off the paper, and what it stands for.

    paper : mm (an angle: rad), scalar or array; with a pencil that carries samples their axis comes first
    scale : machine units per mm of paper; 1 for an angle, which is itself on every scale
    act : how it was read, or computed from other readings
    """

    paper: NDArray[np.float64]
    scale: float | NDArray[np.floating[Any]]
    unit: str
    act: Act | None = None

    def __repr__(self) -> str:
        return f"Reading {self}"

    def __str__(self) -> str:
        if self.unit == "mm of paper" or np.all(np.asarray(self.scale) == 1):
            return f"{_range(self.paper)} {self.unit}"
        per_mm = f"({self.unit})/mm" if "/" in self.unit else f"{self.unit}/mm"
        return f"{_range(self.paper)} mm × {_range(self.scale)} {per_mm} = {_range(self.value)} {self.unit}"

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

    def at(self, place: int | None) -> Reading:
        """One of several readings; without a place the reading itself.

        >>> reading([10.0, 50.0], 0.6, "mm").at(1).value.item()
        30.0
        """
        return self if place is None else replace(self, paper=self.paper[..., place])


def _range(values: ArrayLike) -> str:
    """A number as text, or the minimum and the maximum of many."""
    values = np.asarray(values)
    if not values.ndim:
        return f"{values:.5g}"
    known = values[np.isfinite(values)]
    return f"[{np.min(known):.5g} ... {np.max(known):.5g}]" if known.size else "[nan]"


def reading(paper: ArrayLike, scale: float | NDArray[np.floating[Any]], unit: str) -> Reading:
    """A :class:`Reading` of lengths on paper [mm] or angles [rad].

    >>> reading(50.0, 0.6, "mm").value.item()
    30.0
    """
    return Reading(np.asarray(paper, dtype=np.float64), scale, unit)


@dataclass(frozen=True, eq=False, repr=False)
class Construction(Plottable, Generic[G]):
    """A textbook construction as a value: what was given, what was read, and how to draw it.

    Attributes
    ----------
    meaning : the construction's name, reason and readings
    givens : the data on the board, including the constructions it started from: a small frozen dataclass
    pencil : the pencil that drew
    readings : what was read off the paper, by name
    points : places on the paper (complex, mm in the view's frame) that the steps and later constructions use, by name
    draw : module-level function that makes the steps
    acts : the acts of drawing, by the name of what each left on the paper

    >>> import graphcam as gc
    >>> gc.solve(gc.builtin_task()).drawn["minimum_radius"]
    Construction 'minimum_radius', steps: 5
      prime_radius: 72.133 mm × 0.6 mm/mm = 43.28 mm
      offset: -16.667 mm × 0.6 mm/mm = -10 mm
      s0: 70.181 mm × 0.6 mm/mm = 42.109 mm
    .readings[name], .steps(); .plot(step) draws it up to a step, .plot() all of it
    """

    _drawn_in = "construction_drawing.plot"

    meaning: Meaning
    givens: G
    pencil: Pencil
    readings: Mapping[str, Reading]
    points: Mapping[str, Points]
    draw: Callable[[Construction[G]], list[Step]]
    acts: Mapping[str, Drawn] = field(default_factory=dict[str, Drawn])

    @property
    def name(self) -> str:
        """The name by which the construction is asked for, as its meaning gives it."""
        return self.meaning.name

    def steps(self) -> list[Step]:
        """The construction step by step, drawn when asked for; with a sampled pencil the first sample is shown."""
        return self.draw(self)

    def __repr__(self) -> str:
        samples = self.pencil.samples
        first = f"Construction {self.name!r}, steps: {len(self.steps())}" + (f", samples: {samples}" if samples else "")
        rows = (f"{name}: {reading}" for name, reading in self.readings.items())
        return value_text(
            first, rows, ".readings[name], .steps(); .plot(step) draws it up to a step, .plot() all of it"
        )

    # A step is what one names first.
    @renamed(axes="ax")
    def plot(  # pyright: ignore[reportIncompatibleMethodOverride]
        self,
        step: int | None = None,
        ax: Axes | Figure | None = None,
        *,
        label: str = "",
        color: str | None = None,
    ) -> Axes:
        """The drawing, all or up to the step of that index, in colour: mm of paper from the origin of its first view.

        Raises
        ------
        DesignError : there is no such step, or the construction draws nothing
        """
        return higher_function("plots.construction_drawing.plot")(self, ax, label, color, step)

    def first(self, name: str) -> Any:
        """The points, or the lengths on paper of the reading, of that name in the first sample: what a step shows."""
        values = self.points[name] if name in self.points else self.readings[name].paper
        return values[0] if self.pencil.samples is not None else values

    def value(self, name: str) -> Any:
        """The machine value of the reading of that name in the first sample."""
        values = self.readings[name].value
        return values[0] if self.pencil.samples is not None else values
