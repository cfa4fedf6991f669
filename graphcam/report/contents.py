"""What stands on the sheets of a solution, and which of it is drawn: finished, half done, or a blank worksheet."""

from collections.abc import Mapping
from dataclasses import dataclass

from graphcam.drafting.ink import Construction, Step
from graphcam.errors import DesignError
from graphcam.sheets.layout import Part
from graphcam.sheets.tables import Table
from graphcam.sheets.title_block import TitleBlock
from graphcam.solving.arcs_solution import AnySolution


@dataclass(frozen=True, eq=False)
class Contents:
    """What stands on the sheets of a solution.

    drawn : the constructions by name
    steps : (name of the construction, step), in order
    givens, results : tables that stand with the first construction, and with the last
    """

    solution: AnySolution
    title: TitleBlock
    drawn: Mapping[str, Construction]
    steps: tuple[tuple[str, Step], ...]
    givens: tuple[Table, ...]
    results: tuple[Table, ...]

    @property
    def notes(self) -> tuple[str, ...]:
        """The sentences that are numbered on the sheet."""
        return tuple(self.solution.warnings)

    @property
    def constructions(self) -> tuple[str, ...]:
        """The names of the constructions, in order."""
        return tuple(dict.fromkeys(name for name, _ in self.steps))


def last_step(contents: Contents, upto: int | str) -> int:
    """The number of the last step that is drawn.

    Raises
    ------
    DesignError : there is no such step or construction
    """
    count, names = len(contents.steps), contents.constructions
    if isinstance(upto, str) and upto in names:
        return max(number for number, (name, _) in enumerate(contents.steps, 1) if name == upto)
    if isinstance(upto, int) and 0 <= upto <= count:
        return upto
    known = f"a number of steps from 0 to {count}, or one of {', '.join(names)}"
    raise DesignError("upto", upto, known)


def _numbered(contents: Contents) -> tuple[tuple[int, str, Step], ...]:
    return tuple((number, name, step) for number, (name, step) in enumerate(contents.steps, 1))


def whole(contents: Contents) -> Part:
    """All of it as one part."""
    return Part(_numbered(contents), contents.givens + contents.results, contents.notes)


def parts(contents: Contents) -> list[Part]:
    """A part for each construction that draws something."""
    drawing = list(dict.fromkeys(name for name, step in contents.steps if step.marks))
    return [_part(contents, name, first=name == drawing[0], last=name == drawing[-1]) for name in drawing]


def _part(contents: Contents, construction: str, *, first: bool, last: bool) -> Part:
    """A construction, with what was drawn before in its views."""
    steps = _numbered(contents)
    own = [(number, step) for number, name, step in steps if name == construction]
    views = {step.view.name for _, step in own if step.marks}
    shown = tuple(row for row in steps if row[0] <= own[-1][0] and row[2].view.name in views)
    tables = (contents.givens if first else ()) + (contents.results if last else ())
    return Part(shown, tables, contents.notes if last else ())
