"""The note's chapter on a construction: its steps as prose, with its formulas and the numbers put in."""

from collections.abc import Iterator
from math import ceil

from graphcam.drafting.formulas import Formula, Symbol, per_mm
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.drafting.units import UNITS, unit
from graphcam.report.markdown import Block, Equation, Grid, formula
from graphcam.report.sheet_contents import chapter_numbers, steps_of
from graphcam.words import Caption, Tell, Words, say, sequence

MOST_BESIDE = 3
"""So many pairs of columns a table of places has at the most."""
WIDEST, BETWEEN = 108, 5
"""So many letters stand in a line of a table, and so many are lost between the columns of a pair."""
FEW = 4
"""So many places are told in the paragraph itself."""

Known = set[tuple[str, str]]
"""Letters with what they stand for."""


def chapter(drawn: Construction, number: int, of_lift: str, known: Known, tell: Tell) -> Iterator[Block]:
    """Why it is drawn, and its steps in order, each with the formulas of the readings that it takes.

    number : of the chapter;  of_lift : the unit of the lift
    known : the letters that earlier formulas explained, and then those of this chapter too
    """
    yield drawn.meaning.why
    steps = steps_of({drawn.name: drawn})
    numbers = chapter_numbers(steps)
    first = {name: k for k, _, step in reversed(steps) for name in step.reads}
    for k, _, step in [(0, "", None), *steps]:
        if step is not None:
            yield from _step(f"{number}.{numbers[k].partition('.')[2]}", step, tell)
        for each in drawn.meaning.formulas:
            if k == (first.get(each.of, len(steps)) if each.of else 0):
                yield from _formula(each, drawn, of_lift, known)


def _step(number: str, step: Step, tell: Tell) -> Iterator[Block]:
    """A step in one paragraph, and the tables of its longer runs."""
    parts = step.parts
    runs = [part for part in parts if len({tell(row.setting) for row in part.rows}) > 1]
    short, long = ([part for part in runs if (len(part.rows) > FEW) is many] for many in (False, True))
    said = [each for part in parts for each in (part.caption, *(_beside(part, tell) if part in short else ()))]
    whole = sequence([*said, *([step.why] if str(step.why) else [])], " ")
    yield say("**{number}. {title}.** {said}", number=number, title=step.title, said=whole)
    yield from (_places(step.title, part, tell) for part in long)


def _beside(part: Part, tell: Tell) -> Iterator[Caption]:
    """The rows of a short run, but for those without a setting and those whose numbers its sentence has."""
    said = tell(part.caption)
    for row in part.rows:
        setting = tell(row.setting)
        measured = any(letter.isdigit() for letter in setting)
        if setting and not (tell(row.caption) in said or (measured and f" {setting}" in said)):
            yield row.caption


def _places(title: Caption, part: Part, tell: Tell) -> Grid:
    """The settings of a run, in as many columns side by side as there is room for."""
    told = [(tell(row.name), tell(row.setting)) for row in part.rows]
    # A few long cells may be broken.
    widths = sorted(len(name) + len(setting) + BETWEEN for name, setting in told)
    beside = max(1, min(MOST_BESIDE, WIDEST // widths[-1 - len(told) // 8]))
    long = ceil(len(told) / beside)
    columns = [told[start : start + long] for start in range(0, len(told), long)]
    columns = [column + [("", "")] * (long - len(column)) for column in columns]
    rows = [sum(line, ()) for line in zip(*columns, strict=True)]
    return Grid(title, (say("place"), say("setting")) * len(columns), rows, of_words=True)


def _formula(said: Formula, drawn: Construction, of_lift: str, known: Known) -> Iterator[Block]:
    """A formula in general, what its letters are, and what it comes to with the numbers; nothing where it has none."""
    units = {"mm": unit("mm"), "rad_per_mm": per_mm("rad")}
    applied = [units | dict(each) for each in said.values(drawn)] if said.values else [units]
    if not applied:
        return
    new = [symbol for symbol in said.symbols if (symbol.tex, str(symbol.caption)) not in known]
    known.update((symbol.tex, str(symbol.caption)) for symbol in new)
    yield Equation(formula(said.general + (",", ".")[not new], **applied[0]))
    if new:
        yield say("where {symbols}.", symbols=sequence([_explained(symbol, of_lift) for symbol in new], "; "))
    if said.numbers:
        yield from (formula(f"$${said.numbers}.$$", **each) for each in applied)


def _explained(symbol: Symbol, of_lift: str) -> Caption:
    of = symbol.unit.replace("lift", of_lift)
    values: dict[str, Words] = {"symbol": f"${symbol.tex}$", "meaning": symbol.caption}
    if not of:
        return say("{symbol} is {meaning}", **values)
    told = unit(of) if of in UNITS else per_mm(of.removesuffix("/mm").strip("()")) if of.endswith("/mm") else of
    return say("{symbol} is {meaning}, {unit}", **values, unit=told)
