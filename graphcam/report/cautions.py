"""The note's chapter on a construction: its steps as prose, and cautions below them."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from math import ceil

import numpy as np

from graphcam.constructions.acceleration import moving_phases
from graphcam.constructions.angle_diagram import inner_maximum
from graphcam.constructions.axes import degrees, part_names, phase_title, station_names
from graphcam.constructions.graduation import scale_at_speed
from graphcam.constructions.law_names import law_title
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.drafting.meaning import Formula, Symbol, per_mm
from graphcam.drafting.scale import UNITS, unit
from graphcam.errors import DesignError
from graphcam.given.follower import Limits
from graphcam.given.impact import acceleration_jumps
from graphcam.report.markdown import Block, Equation, Grid, digits, formula, general, number, numbers, warning
from graphcam.report.sheet_contents import chapter_numbers, steps_of
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Tell, Words, and_list, say, sequence

LAST_DIGIT = 0.005
"""The difference that is not seen in print: lengths [mm] and angles [degrees] have two decimals."""
ONE_DEGREE = math.radians(1)


def ordinates(solution: Solution) -> Iterator[Block]:
    """The table of the phases, with the factors of their laws and the ordinates that follow."""
    diagram, motion, stations = solution.drawn["acceleration"], solution.cam.motion, solution.chain.board.stations
    phases, index = moving_phases(motion, stations), stations.phase[stations.last].tolist()
    rows = [
        (
            *(phase_title(motion, i), law_title(motion, i), general(phase.normalised.peak_acceleration)),
            *(general(phase.lift), degrees(phase.angle), number(y)),
        )
        for i, phase, y in zip(index, phases, diagram.first("greatest"), strict=True)
    ]
    lift = say("h, {unit}", unit=unit(diagram.givens.unit))
    header = (say("phase"), say("law"), "C", lift, "φ", say("y, mm of paper"))
    yield Grid(say("Maximum ordinates of the phases"), header, rows)


def lift_in_degrees(solution: Solution) -> Iterator[Block]:
    """The paragraph on the lift of an arm in degrees, as a protractor has it."""
    if solution.drawn["integration"].readings["s"].unit == "rad":
        said = say("The displacement $s$ is the angle of the arm: in degrees the lift is {lift}°.")
        yield said.with_values(lift=general(math.degrees(solution.cam.motion.lift)))


def sensitivity(solution: Solution) -> Iterator[Block]:
    """The paragraph on what an ideal pencil reads, and on the gain of one more permitted degree, both drawn again."""
    chain, limits = solution.chain, solution.chain.board.limits
    if (least := chain.adopted().least) and not chain.pencil.perfect and not math.isnan(least):
        yield say("The ideal pencil gives {radius} mm.", radius=number(least))
    if "pressure_angle" not in solution.drawn:
        return
    try:
        wider = Limits(limits.rise + ONE_DEGREE, limits.return_ and limits.return_ + ONE_DEGREE, limits.rest)
    except DesignError:
        yield say("The permitted angle is so large that one degree more cannot be drawn.")
        return
    again = replace(chain, board=replace(chain.board, limits=wider)).minimum_radius
    least, then = (float(c.value("prime_radius")) for c in (chain.minimum_radius, again))
    if not math.isnan(then - least):
        yield say(
            "If every permitted angle is raised by 1°, the minimum radius is {then} mm: it changes by {change} mm "
            "per degree.",
            **numbers(then=then, change=then - least),
        )


def permitted_bend(solution: Solution) -> Iterator[Block]:
    """The paragraph on the minimum radius of curvature of the profile, beside the permitted one."""
    least = solution.task.limits.min_curvature_radius
    if least is None:
        return
    if float(solution.drawn["curvature"].value("rho")) - solution.cam.roller_radius < least - LAST_DIGIT:
        yield warning(say("At least {least:g} mm is required: the condition is not satisfied.", least=least))
    else:
        yield say("At least {least:g} mm is required: the condition is satisfied.", least=least)


def ideal_roller_radius(solution: Solution) -> Iterator[Block]:
    """The paragraph on the roller radius that the rule gives with an ideal pencil."""
    if not solution.chain.pencil.perfect and solution.chain.board.roller_radius is None:
        perfect = float(solution.chain.perfect.roller.value("roller_radius"))
        yield say("The ideal pencil gives {radius} mm.", radius=number(perfect))


INSIDE_CAPTIONS = {
    "rise": say("Inside the rise, at φ = {at}°, the maximum is {alpha}°; the larger one is at an end of the phase."),
    "return": say(
        "Inside the return, at φ = {at}°, the maximum is {alpha}°; the larger one is at an end of the phase."
    ),
}
EXACT_CAPTIONS = {
    "rise": say("The limit of the rise is satisfied as drawn; exactly the angle is {exact}°, {over}° over."),
    "return": say("The limit of the return is satisfied as drawn; exactly the angle is {exact}°, {over}° over."),
}
EXCEEDED_CAPTIONS = {
    "rise": say("On the rise only {limit} are permitted, so the limit is exceeded: {why}."),
    "return": say("On the return only {limit} are permitted, so the limit is exceeded: {why}."),
}


def greatest_angles(solution: Solution) -> Iterator[Block]:
    """The paragraph on the maximum angles inside the phases, and on why and by how much a limit is exceeded."""
    plotted, board, extremes = solution.drawn["angle_diagram"], solution.chain.board, solution.cam.extremes()
    exactly = {"rise": extremes.pressure_angle_rise[0], "return": extremes.pressure_angle_return[0]}
    for name, limit, driven in (("rise", board.limits.rise, 1), ("return", board.limits.return_, -1)):
        if other := inner_maximum(plotted, name):
            alpha = math.degrees(other.place.imag * plotted.givens.mu_alpha.per_mm)
            phi = math.degrees(board.mu_phi.value(other.place.real))
            yield INSIDE_CAPTIONS[name].with_values(at=number(phi, 1), alpha=number(alpha))
        if limit is None:
            continue
        angle, over = float(plotted.value(f"max_{name}")), math.degrees(abs(exactly[name]) - limit)
        unlimited = driven * exactly[name] < 0 and not board.limits.rest  # the angle at the low rest
        if math.degrees(abs(angle)) > math.degrees(limit) + LAST_DIGIT:
            yield warning(
                EXCEEDED_CAPTIONS[name].with_values(limit=degrees(limit), why=_why_exceeded(name, angle, solution))
            )
        elif over > LAST_DIGIT and not unlimited:
            yield EXACT_CAPTIONS[name].with_values(exact=number(math.degrees(abs(exactly[name]))), over=number(over))


def _why_exceeded(name: str, angle: float, solution: Solution) -> Caption:
    chain, least = solution.chain, float(solution.drawn["minimum_radius"].value("prime_radius"))
    given = chain.board.prime_radius
    if given is not None and given < least:
        said = say("the given prime radius of {given:g} mm is smaller than the minimum, {least} mm")
        return said.with_values(given=given, least=number(least))
    if (angle < 0) == (name == "rise") and not chain.board.limits.rest:
        return say("it is the angle in the lower dwell, which this task does not limit")
    if not chain.pencil.perfect:
        return say("the drawing errors exceed the amount by which the prime radius was rounded up")
    if given is not None:
        return say("at the adopted offset the given prime radius is too small")
    return say("with so few parts the diagrams agree no better")


def undercut(solution: Solution) -> Iterator[Block]:
    """The paragraph on whether the profile is undercut, and the remedy."""
    if "roller" not in solution.drawn:
        return
    rho, radius = float(solution.drawn["curvature"].value("rho")), solution.chain.roller_radius
    lost = ~np.isnan(solution.drawn["working_profile"].first("covered"))
    if lost.any():
        names = [name for name, gone in zip(station_names(solution.chain.board.stations), lost, strict=True) if gone]
        yield warning(
            say(
                "The profile is undercut at the stations {stations}: the follower cannot follow the required motion "
                "there. Take a smaller roller or a larger prime radius.",
                stations=and_list(names),
            )
        )
    elif radius >= rho:
        said = say(
            "The roller is not smaller than the minimum radius of curvature, {rho} mm: the profile is undercut "
            "or pointed there. Take a smaller roller or a larger prime radius."
        )
        yield warning(said.with_values(rho=number(rho)))
    elif radius and math.isfinite(rho):
        yield say("The roller is smaller than ρ = {rho} mm, so the profile is not undercut.", rho=number(rho))


def jerks(solution: Solution) -> Iterator[Block]:
    """The jerk: its maximum over time at a speed, all parts drawn and exact, and where it is infinite."""
    c, board = solution.drawn["jerk"], solution.chain.board
    read, of_lift = c.readings["j"], board.follower.unit
    if board.omega is not None:
        at = scale_at_speed(1.0, "j", board.omega, of_lift)
        value = general(at.per_mm * float(c.value("max_j")), 4)
        yield say("At the given speed the maximum finite jerk is {value} {unit}.", value=value, unit=unit(at.unit))
    phi, drawn, exact = np.degrees(c.value("j_at")).tolist(), c.value("j").tolist(), solution.exact_jerk.tolist()
    places = digits(read.per_mm)
    rows = [
        (name, number(at), number(value, places), number(truth, places + 1))
        for name, at, value, truth in zip(part_names(board.stations), phi, drawn, exact, strict=True)
    ]
    header = (say("part"), "φ", say("{name} drawn", name="j"), say("{name} exact", name="j"))
    title = say("Jerk in the middles of the parts, in {unit}", unit=unit(f"{of_lift}/rad³"))
    yield Grid(title, header, rows)
    jumps = acceleration_jumps(solution.cam.motion)
    if not jumps:
        yield say("The acceleration nowhere jumps: the jerk is finite everywhere.")
        return
    yield say(
        "Where the acceleration jumps, at {places}, the jerk is infinite; an arrow stands for it in the diagram. It "
        "cannot be read off: what counts there is the jump itself, told below with the kind of impact.",
        places=sequence([degrees(jump.phi) for jump in jumps]),
    )


CAUTIONS: Mapping[str, Callable[[Solution], Iterator[Block]]] = {
    "acceleration": ordinates,
    "integration": lift_in_degrees,
    "minimum_radius": sensitivity,
    "curvature": permitted_bend,
    "roller": ideal_roller_radius,
    "angle_diagram": greatest_angles,
    "working_profile": undercut,
    "jerk": jerks,
}
"""The paragraphs below the steps, by the name of the construction."""


MAX_COLUMN_PAIRS = 3
"""The maximum number of pairs of columns in a table of places."""
MAX_LINE_LETTERS, PAIR_GAP_LETTERS = 108, 5
"""The maximum number of letters in a line of a table, and the letters lost between the columns of a pair."""
MIN_TABLE_ROWS = 4
"""The number of places up to which the paragraph itself names them, without a table."""

Known = set[tuple[str, str]]
"""Symbols of formulas, each with its meaning."""


def chapter(drawn: Construction, number: int, of_lift: str, known: Known, tell: Tell) -> Iterator[Block]:
    """The chapter: why the construction is drawn, and its steps in order with the formulas of their readings.

    number : of the chapter;  of_lift : the unit of the lift
    known : the symbols that earlier formulas explained; those of this chapter are added
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
    """A step as one paragraph, with its formulas and the tables of its longer runs."""
    parts = step.parts
    runs = [part for part in parts if len({tell(row.setting) for row in part.rows}) > 1]
    short, long = ([part for part in runs if (len(part.rows) > MIN_TABLE_ROWS) is many] for many in (False, True))
    said = [each for part in parts for each in (part.caption, *(_short_run_rows(part, tell) if part in short else ()))]
    whole = sequence([*said, *([step.why] if str(step.why) else [])], " ")
    yield say("**{number}. {title}.** {said}", number=number, title=step.title, said=whole)
    yield from (_places(step.title, part, tell) for part in long)


def _short_run_rows(part: Part, tell: Tell) -> Iterator[Caption]:
    """The rows of a short run, without those that have no setting or whose numbers the sentence has already."""
    said = tell(part.caption)
    for row in part.rows:
        setting = tell(row.setting)
        measured = any(letter.isdigit() for letter in setting)
        if setting and not (tell(row.caption) in said or (measured and f" {setting}" in said)):
            yield row.caption


def _places(title: Caption, part: Part, tell: Tell) -> Grid:
    """The table of a run's settings, in as many columns side by side as there is room for."""
    told = [(tell(row.name), tell(row.setting)) for row in part.rows]
    # A few long cells may be broken.
    widths = sorted(len(name) + len(setting) + PAIR_GAP_LETTERS for name, setting in told)
    beside = max(1, min(MAX_COLUMN_PAIRS, MAX_LINE_LETTERS // widths[-1 - len(told) // 8]))
    long = ceil(len(told) / beside)
    columns = [told[start : start + long] for start in range(0, len(told), long)]
    columns = [column + [("", "")] * (long - len(column)) for column in columns]
    rows = [sum(line, ()) for line in zip(*columns, strict=True)]
    return Grid(title, (say("place"), say("setting")) * len(columns), rows, of_words=True)


def _formula(said: Formula, drawn: Construction, of_lift: str, known: Known) -> Iterator[Block]:
    """A formula in general, its legend, and the formula with the numbers; nothing where there is none."""
    units = {"mm": unit("mm"), "rad_per_mm": per_mm("rad")}
    applied = [units | dict(each) for each in said.values(drawn)] if said.values else [units]
    if not applied:
        return
    new = [symbol for symbol in said.symbols if (symbol.tex, str(symbol.caption)) not in known]
    known.update((symbol.tex, str(symbol.caption)) for symbol in new)
    yield Equation(formula(said.general + (",", ".")[not new], **applied[0]))
    if new:
        yield say("where {symbols}.", symbols=sequence([_symbol_legend(symbol, of_lift) for symbol in new], "; "))
    if said.numbers:
        yield from (formula(f"$${said.numbers}.$$", **each) for each in applied)


def _symbol_legend(symbol: Symbol, of_lift: str) -> Caption:
    of = symbol.unit.replace("lift", of_lift)
    values: dict[str, Words] = {"symbol": f"${symbol.tex}$", "meaning": symbol.caption}
    if not of:
        return say("{symbol} is {meaning}", **values)
    told = unit(of) if of in UNITS else per_mm(of.removesuffix("/mm").strip("()")) if of.endswith("/mm") else of
    return say("{symbol} is {meaning}, {unit}", **values, unit=told)
