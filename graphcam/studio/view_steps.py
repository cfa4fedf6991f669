"""The steps of a solution in their views, each with a name that no number and no language changes."""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

from graphcam.drafting.ink import Construction, Step, View
from graphcam.errors import DesignError, among
from graphcam.report.sheet_contents import chapter_numbers, drawn_of, names_of, scaled_steps
from graphcam.sheets.layout import Numbered
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import Caption, Tell, say

SHORT: Mapping[str, Caption] = {
    "scheme": say("Diagram"),
    "acceleration": say("a(φ)"),
    "velocity": say("v(φ)"),
    "displacement": say("s(φ)"),
    "measured acceleration": say("a(φ) measured"),
    "measured velocity": say("v(φ) measured"),
    "measured displacement": say("s(φ) measured"),
    "combined": say("Region"),
    "region": say("Region"),
    "plan": say("Plan"),
    "arm angles": say("Angles"),
    "angle": say("α(φ)"),
    "profile": say("Profile"),
    "curvature": say("Curvature"),
    "cam centre": say("Centre"),
    "forces": say("Forces"),
    "arcs": say("Arcs"),
    "roller": say("Roller"),
    "accelerations": say("Accelerations"),
}
"""What views are called where there is little room; one without a short name bears its title."""


@dataclass(frozen=True, eq=False)
class NamedStep:
    """A step with its names.

    id : construction and title, as "minimum_radius/the-minimum-prime-radius"
    number : in order, from 1, of all steps that are drawn
    """

    id: str
    number: int
    construction: str
    step: Step


@dataclass(frozen=True, eq=False)
class ViewSteps:
    """The steps that are drawn, and what is known of them.

    drawn : the constructions by name;  steps : in order
    """

    drawn: Mapping[str, Construction]
    steps: tuple[NamedStep, ...]

    def of_view(self, name: str) -> list[NamedStep]:
        """The steps in a view."""
        return [each for each in self.steps if each.step.view.name == name]

    @property
    def numbered(self) -> Numbered:
        """The steps with their running numbers and constructions."""
        return tuple((each.number, each.construction, each.step) for each in self.steps)

    @property
    def numbers(self) -> Mapping[int, str]:
        """The numbers within the task, such as "3.2", by the running ones."""
        return chapter_numbers(self.numbered)

    @property
    def views(self) -> dict[str, View]:
        """The views by name, in order; of several titles of one view the last counts."""
        return {each.step.view.name: each.step.view for each in self.steps}

    def drawing_in(self, view: str) -> tuple[str, ...]:
        """The constructions that draw in a view."""
        return tuple(dict.fromkeys(each.construction for each in self.of_view(view)))

    def settling(self, view: str) -> tuple[str, ...]:
        """The constructions that settle the scale of the view."""
        return tuple(name for name, each in self.drawn.items() if view in each.meaning.scales)

    def names(self, tell: Tell) -> list[dict[str, object]]:
        """What an answer says of every view."""
        counts = Counter(each.step.view.name for each in self.steps)
        return [
            {
                "name": name,
                "title": tell(view.title),
                "short": tell(SHORT.get(name, view.title)),
                "steps": counts[name],
            }
            for name, view in self.views.items()
        ]


def view_steps(
    solution: AnySolution,
    only: Collection[str] | None = None,
    silent: Collection[str] = (),
    upto: str | None = None,
) -> ViewSteps:
    """The steps of a solution.

    only : the constructions that are drawn, None for all;  silent : those of them whose steps are not asked for
    upto : the last construction that is shown, in the order in which they are told

    Raises
    ------
    DesignError : there is no such construction
    """
    names = names_of(solution)
    if upto is not None:
        if upto not in names:
            raise DesignError("upto", upto, *among(upto, names))
        names = names[: names.index(upto) + 1]
    drawn = {name: drawn_of(solution, name) for name in names if only is None or name in only}
    return ViewSteps(drawn, tuple(named(scaled_steps(drawn, silent))))


def named(steps: Numbered) -> Iterable[NamedStep]:
    """The steps with their names, "-2" and "-3" behind those of steps alike in one construction."""
    taken = Counter[str]()
    for number, construction, step in steps:
        name = f"{construction}/{slug(step.title.template)}"
        taken[name] += 1
        again = f"-{taken[name]}" if taken[name] > 1 else ""
        yield NamedStep(name + again, number, construction, step)


def slug(template: str) -> str:
    """A title's template in letters that an address takes.

    >>> slug("Pole and rays, {source} to {target}")
    'pole-and-rays-source-to-target'
    """
    return re.sub(r"[^a-z0-9]+", "-", template.lower()).strip("-")
