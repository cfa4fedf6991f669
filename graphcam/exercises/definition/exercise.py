"""What an exercise is: a task with open parameters, the answers asked, and the mistakes it can tell."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

from graphcam.drafting.marks import Points
from graphcam.drafting.scale import UNITS
from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.exercises.definition.marked_formats import PAPER_NAMES
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.given.plausible_ranges import check_positive
from graphcam.language import ENGLISH, language, languages
from graphcam.tasks.sheet_tables import check_choice
from graphcam.words import Tell, Words, say

Kind = Literal["number", "points", "curve"]
Of = Literal["value", "paper", "scale"]
Diagram = Literal["acceleration", "velocity", "displacement"]
Drawn = Literal["", "curve", "cross", "circle", "crossing", "length"]
Value = float | str
"""A parameter's value: a number, or a word such as a law's name."""
STEP_DIGITS = 9
"""Decimals to which a parameter's value is rounded, so that 3 steps of 0.1 are 0.3."""


@dataclass(frozen=True)
class Parameter:
    """What differs between students: a number from ``start`` to ``stop`` in steps, or one of some ``choices``.

    >>> Parameter(start=24, stop=30, step=2).values
    (24, 26, 28, 30)
    """

    start: float | None = None
    stop: float | None = None
    step: float | None = None
    choices: tuple[float | str, ...] | None = None

    def __post_init__(self) -> None:
        grid = (self.start, self.stop, self.step)
        if (self.choices is None) == (None in grid):
            found = say("given in neither or in both ways")
            raise DesignError("parameter", found, say("given by start, stop and step, or by choices"))
        if self.choices is not None and not self.choices:
            raise DesignError("choices", say("empty"), say("a list of one or more"))
        if self.choices is None:
            check_positive("step", self.step, "")
            if self.stop is not None and self.start is not None and self.stop < self.start:
                raise DesignError("stop", self.stop, say("at least start, {start:g}", start=self.start))

    @cached_property
    def values(self) -> tuple[Value, ...]:
        """All values, in order."""
        if self.choices is not None:
            return tuple(choice if isinstance(choice, str) else _number(choice) for choice in self.choices)
        assert self.start is not None
        assert self.stop is not None
        assert self.step is not None
        count = int((self.stop - self.start) / self.step + 1e-6) + 1
        return tuple(_number(self.start + k * self.step) for k in range(count))


def _number(value: float) -> float:
    """Whole numbers whole, so that a sheet says 30 and not 30.0."""
    rounded = round(value, STEP_DIGITS)
    return int(rounded) if rounded == int(rounded) else rounded


@dataclass(frozen=True)
class AskedAnswer:
    """One answer: where in the drawing it is read, and how it is given.

    name : key of the answer in the student's file
    text : what is asked, in a sentence
    construction : name of the construction, as in :class:`~graphcam.constructions.chain.Chain`
    reading : of the construction; or points : the name of its points
    station : of a reading or points with several places: a station's name such as "4" or "4'" (second moving phase);
        for ordinates in the middle of a part the number of the part, for one a phase that of the moving phase
    of : of a reading its machine "value", its length on "paper", or its "scale" (machine units per mm)
    component : of points that are asked as a number, their "x" or "y" [mm of paper]
    unit : as the student gives it; "deg" turns radians into degrees
    decimals : to which the student rounds
    marks : for this answer
    kind : a "number", plotted "points", or a "curve"; points and curves are in mm of paper
    layer : of a DXF file, for points and curves
    place : the view of the worksheet in which it is drawn and read off a photograph; by default that of its
        construction, if this has but one
    mark : how it is drawn there: a "curve", points as a "cross", as a "circle" or as the "crossing" of two lines, or
        the "length" between two marked points; by default a curve is a curve, and points are crosses
    """

    name: str
    text: str
    construction: str
    reading: str = ""
    points: str = ""
    station: str = ""
    of: Of = "value"
    component: Literal["", "x", "y"] = ""
    unit: str = ""
    decimals: int = 1
    marks: float = 1.0
    kind: Kind = "number"
    layer: str = ""
    place: str = ""
    mark: Drawn = ""

    def __post_init__(self) -> None:
        check_positive("marks", self.marks, "")
        if bool(self.reading) == bool(self.points):
            limit = say("given where there are no points")
            raise DesignError("reading", self.reading, limit, say("name a reading or points"))
        if self.kind == "number" and self.points and not self.component:
            raise DesignError("component", self.component, say("x or y where points are asked as a number"))
        if self.kind != "number" and not (self.points and self.layer):
            raise DesignError("points", self.points, say("given with a layer where a {kind} is asked", kind=self.kind))
        if self.layer and not re.fullmatch(r"[\w-]+", self.layer):
            raise DesignError("layer", self.layer, say("of letters, digits, hyphens and underscores"))
        if self.mark not in (marks := MARKS[self.kind if self.kind != "number" or not self.points else "place"]):
            said = ", ".join(mark for mark in marks if mark)
            limit = say("one of {said} for this answer", said=said)
            raise DesignError("mark", self.mark, limit, say("leave it out for the usual one"))
        if self.mark and self.kind == "number" and not self.place:
            limit = say("given where a number has a mark")
            raise DesignError("place", self.place, limit, say("name the view it is drawn in"))

    @property
    def mark_form(self) -> Drawn:
        """The form of a mark on the worksheet; empty for what is written down."""
        return self.mark or DEFAULT_MARKS[self.kind]

    @property
    def unit_caption(self) -> Words:
        """The unit as a language writes it; one that only this exercise has stays as its file writes it."""
        return UNITS.get(self.unit, self.unit)


MARKS: Mapping[str, tuple[str, ...]] = {
    "number": ("", "length"),
    "place": ("", "cross", "circle", "crossing"),
    "points": ("", "cross", "circle", "crossing"),
    "curve": ("", "curve"),
}
"""How an answer may be drawn, by its kind; the "place" is a coordinate of a point."""
DEFAULT_MARKS: Mapping[Kind, Drawn] = {"number": "", "points": "cross", "curve": "curve"}
"""How one is drawn where the file does not say."""
BAR = AskedAnswer("bar", "", "worksheet", reading="bar", unit="mm")
"""What a file of answers may tell beside them: how long the worksheet's rule of 100 mm is on the student's print."""


@dataclass(frozen=True)
class Exercise:
    """An exercise as its file says it.

    name : of the file
    language : in which its texts are, and in which it speaks to students
    version : goes into every variant, so that a changed exercise draws new ones
    title, text : for the student; ``{lift}`` in the text stands for a parameter's value
    parameters : by name
    task : template of a task file's tables: the text "{lift}" stands for a parameter's value, "{rest}" for the angle
        that is missing of 360 degrees
    answers : in the order of the construction, which is the order in which mistakes travel
    misconceptions : names from the catalogue of :mod:`~graphcam.exercises.definition.mistakes`, with an argument
        after a colon where one is taken ("wrong-law: cosine")
    alike : pairs of them that the answers need not tell from one another: both are named then
    axes, sheet : what the student's worksheet shows: empty axes of diagrams over the cam angle, and so many steps of
        each construction, which are then given
    hand : the students for whom the tolerances are made, the table ``[hand]``
    papers : for which worksheets can be made that are photographed: "A1", "A3", "A4"; "A3" takes two sheets of A4 too
    paper : the one that this is for, whose scales it has; empty for that of its task and a worksheet without tags
    careful : part of those who draw everything right who may lose any point
    policy : what answers that are not right earn, the table ``[marks]``
    """

    title: str
    text: str
    parameters: Mapping[str, Parameter]
    task: Mapping[str, Any]
    answers: tuple[AskedAnswer, ...]
    misconceptions: tuple[str, ...] = ()
    alike: tuple[tuple[str, str], ...] = ()
    axes: tuple[Diagram, ...] = ()
    sheet: Mapping[str, int] = field(default_factory=dict[str, int])
    hand: HandTable = field(default_factory=HandTable)
    careful: float = 0.02
    # Its table in the file has a name that is taken here.
    policy: MarksPolicy = field(default_factory=MarksPolicy, metadata={"alias": "marks"})
    papers: tuple[str, ...] = ()
    version: int = 1
    name: str = ""
    paper: str = ""
    language: str = ENGLISH.name

    def __post_init__(self) -> None:
        check_choice("language", self.language, languages())
        if not self.answers:
            raise DesignError("answers", say("empty"), say("a list of one or more"))
        for paper in self.papers:
            check_choice("papers", paper, PAPER_NAMES)
        names = [asked.name for asked in self.answers]
        doubled = sorted({name for name in names if names.count(name) > 1})
        if doubled:
            raise DesignError("answers", doubled[0], say("named once each"))
        if BAR.name in map(str.casefold, names):
            limit = say("another name: with {name} students tell how large their worksheet was printed", name=BAR.name)
            raise DesignError("answers", BAR.name, limit)
        for asked in self.answers:
            check_choice("kind", asked.kind, ("number", "points", "curve"))
        named = [("marks.caps", name) for name in self.policy.caps]
        named += [("alike", name) for pair in self.alike for name in pair]
        for where, name in named:
            if name not in self.misconceptions:
                remedy = nearest_word_remedy(name, self.misconceptions) if self.misconceptions else say("list it there")
                raise DesignError(where, name, say("one of the misconceptions of this exercise"), remedy)

    @property
    def tell(self) -> Tell:
        """Says texts in its language."""
        return language(self.language).text

    @property
    def remark(self) -> str:
        """A remark for the exercise's readers on its language; mostly none."""
        return language(self.language).remark

    @property
    def marks(self) -> float:
        """The marks of all answers together."""
        return sum(asked.marks for asked in self.answers)


Given = float | Points
"""A number, or points (n,) of the paper: complex, in mm."""


@dataclass(frozen=True, eq=False)
class Answers:
    """The answers by name, untrusted data; an answer that was left out is not among them.

    values : a number, or points and curves (n,) as complex mm of paper; they may be anything that a file can say
    problems : answers that stand there and could not be read: a sentence for the student by the answer's name
    notes : sentences about the submission as a whole
    """

    values: Mapping[str, Given]
    problems: Mapping[str, Words] = field(default_factory=dict[str, Words])
    notes: tuple[Words, ...] = ()
