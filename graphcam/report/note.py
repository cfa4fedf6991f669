"""The coursework note in Markdown: the steps as prose, then tables and conclusions."""

import math
from collections.abc import Callable, Mapping, Sequence

from graphcam.comparison.bounds import CHANGE_TO_ERROR_FACTOR, DEVIATION_COUNT, HAND_COUNT, REFINEMENTS
from graphcam.comparison.quantities import PRINTED_ERROR, UNITS_PER_SPEED
from graphcam.constructions.axes import phase_title
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import unit
from graphcam.given.follower import omega_of
from graphcam.given.impact import Jump, acceleration_jumps, velocity_jumps
from graphcam.given.motion import MovingPhase
from graphcam.report.cautions import CAUTIONS, Known, chapter
from graphcam.report.loads import contact, contact_stress, forces
from graphcam.report.making import errors_of_making
from graphcam.report.markdown import (
    Block,
    Equation,
    Grid,
    blocks,
    formula,
    general,
    number,
    numbers,
    printed_note,
    text,
    warning,
)
from graphcam.report.note_tables import at_stations, budget_table, comparison_table, polar_coordinates
from graphcam.report.sheet_contents import all_constructions
from graphcam.report.sheet_data import ADOPTED_LABEL, SPEED_HEADINGS, conditions, data, phases, sizes
from graphcam.sheets.tables import Table
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.division_warnings import disagreement
from graphcam.solving.solution import Solution
from graphcam.solving.stress_design import STRESS_MEANING
from graphcam.solving.tolerance_design import TOLERANCE_MEANING
from graphcam.tasks.sheet_tables import SheetTable, TitleTable
from graphcam.words import Caption, and_list, say, sequence

Chapter = tuple[Caption, Sequence[Block]]
"""Title and contents of a chapter."""


def note(solution: Solution) -> str:
    """The note of a cam with a motion, in Markdown with formulas in LaTeX.

    >>> import graphcam as gc
    >>> "Round the minimum radius, 43.28 mm, up to r₀ = 44 mm." in note(gc.solve(gc.builtin_task()))
    True
    """
    chapters = constructions(solution)
    if solution.stress and solution.stress.without:
        chapters.append((STRESS_MEANING.title, contact_stress(solution)))
    if solution.tolerances and solution.tolerances.undercut:
        chapters.append((TOLERANCE_MEANING.title, errors_of_making(solution)))
    if solution.task.speed_rpm:
        chapters.append((say("Times, velocities and accelerations"), _at_speed(solution)))
    chapters += [
        (say("Kind of impact"), _impact(solution)),
        (say("Result"), _result(solution)),
        (say("Values at the stations"), at_stations(solution)),
        (say("Polar coordinates"), polar_coordinates(solution)),
        (say("Drawn against exact"), against_exact(solution)),
        *errors_of_the_hand(solution),
    ]
    head = [*heading(solution.task.title, solution.task.drawing), hand_description(solution.chain.pencil)]
    return whole_note(head, chapters, solution)


def whole_note(head: Sequence[Block], chapters: Sequence[Chapter], solution: AnySolution) -> str:
    """The text of the note: head and numbered chapters."""
    tell, parts = solution.tell, list(head)
    for k, (title, said) in enumerate(chapters, 1):
        parts += [f"## {k}. {tell(title)}", *said]
    return printed_note(blocks(*parts, tell=tell) + "\n")


def comparison_file(solution: AnySolution) -> str:
    """The text of a Markdown file with the table of drawn and exact values."""
    title = say("{name}: drawn against exact", name=text(solution.task.title.translated_name(solution.tell)))
    return printed_note(blocks(f"# {solution.tell(title)}", *against_exact(solution), tell=solution.tell) + "\n")


CHAPTER_OPENINGS: Mapping[str, Callable[[Solution], Sequence[Block]]] = {
    "scheme": lambda solution: task_data(solution),
    "contact": contact,
    "turn_forces": forces,
    "contact_stress": contact_stress,
    "tolerances": errors_of_making,
}
"""The paragraphs before the steps of a construction, on what is given or calculated, by its name."""


def constructions(solution: AnySolution) -> list[Chapter]:
    """A chapter for each construction: its reason, its steps with formulas, and cautions."""
    known, of_lift = Known(), solution.chain.board.follower.unit if isinstance(solution, Solution) else "mm"
    chapters: list[Chapter] = []
    for k, (name, drawn) in enumerate(all_constructions(solution).items(), 1):
        why, *steps = chapter(drawn, k, of_lift, known, solution.tell)
        before, after = [], []
        if isinstance(solution, Solution):
            before = CHAPTER_OPENINGS[name](solution) if name in CHAPTER_OPENINGS else []
            after = CAUTIONS[name](solution) if name in CAUTIONS else []
        chapters.append((drawn.meaning.title, [why, *before, *steps, *after]))
    return chapters


def heading(title: TitleTable, drawing: SheetTable) -> list[Block]:
    """The note's title, its author, and the remark on its language."""
    tell = drawing.tell
    lines = [title.organisation, title.document, title.group, title.author, title.checked]
    names = (say("Organisation"), say("Document"), say("Group"), say("Author"), say("Checked by"))
    signed = [f"{tell(name)}: {text(line)}" for name, line in zip(names, lines, strict=True) if line]
    head = tell(say("{name}: calculation note", name=text(title.translated_name(tell))))
    return [f"# {head}", f"*{drawing.remark}*" if drawing.remark else "", "  \n".join(signed)]


def task_data(solution: Solution) -> list[Block]:
    """The chapter on what is given, and what is to be found."""
    roller, given, asked = solution.chain.board.roller_radius != 0, data(solution), conditions(solution)
    rows = tuple((name, say("to be found") if by == ADOPTED_LABEL else value) for name, value, by in given.rows)
    return [
        solution.chain.board.follower.assignment(roller),
        of_sheet(phases(solution)),
        *([of_sheet(asked)] if asked else []),
        Grid(given.title, given.header[:2], rows),
    ]


def hand_description(pencil: Pencil) -> Caption:
    """The sentence on the errors of a pencil."""
    said = [say("Everything below was found on the drawing board: a length in millimetres of paper times a scale.")]
    if pencil.perfect:
        return sequence([*said, say("It was drawn with an ideal pencil.")], " ")
    deviations = (
        (pencil.line, say("{error:g} mm in a line", error=pencil.line)),
        (pencil.dividers, say("{error:g} mm in a setting of the dividers", error=pencil.dividers)),
        (pencil.protractor, say("{error:g}° in an angle", error=math.degrees(pencil.protractor))),
    )
    if errors := [told for deviation, told in deviations if deviation]:
        said.append(say("The drawing errors have standard deviations of {errors}.", errors=and_list(errors)))
    if pencil.division:
        said.append(say("Readings are rounded to {division:g} mm.", division=pencil.division))
    return sequence(said, " ")


SPEED_FORMULA = (
    r"t = \frac{\varphi}{\omega}, \qquad v_{\max} = C_v\,h\,\frac{\omega}{\varphi}, \qquad "
    r"a_{\max} = C_a\,h\,\frac{\omega^2}{\varphi^2}."
)
SPEED_NUMBERS = (
    r"t = \frac{<angle>}{<omega>} = <time>\ \text{<s>}, \qquad v_{\max} = <cv> \cdot <lift> \cdot "
    r"\frac{<omega>}{<angle>} = <v>\ \text{<per_s>}, \qquad a_{\max} = <ca> \cdot <lift> \cdot "
    r"\frac{<omega>^2}{<angle>^2} = <a>\ \text{<per_s>²}."
)
"""The formula with numbers for time, maximum velocity and maximum acceleration of a phase."""


def _greatest(value: float) -> Caption:
    """A maximum over a phase: a dash in a dwell; infinite is the acceleration where the velocity jumps."""
    return general(value) if math.isinf(value) else number(value or math.nan, 3)


def _at_speed(solution: Solution) -> list[Block]:
    motion, rpm, of_lift = solution.cam.motion, solution.task.speed_rpm or 0.0, solution.chain.board.follower.unit
    speeds = solution.comparison.phases(rpm)
    rows = [(phase_title(motion, k), number(p.time, 4), *map(_greatest, p.greatest)) for k, p in enumerate(speeds)]
    k, first = next((k, phase) for k, phase in enumerate(motion.phases) if isinstance(phase, MovingPhase))
    omega, law = general(omega_of(rpm), 5), first.normalised
    values = {
        "s": unit("s"),
        "per_s": unit({"mm": "m/s", "rad": "rad/s"}[of_lift]),
        "angle": general(first.angle, 5),
        "lift": general(first.lift / UNITS_PER_SPEED[of_lift]),
        "cv": general(law.peak_velocity, 5),
        "ca": general(law.peak_acceleration, 5),
        "time": number(speeds[k].time, 4),
        "v": _greatest(speeds[k].max_velocity),
        "a": _greatest(speeds[k].max_acceleration),
    }
    said = say(
        "At $n = {rpm:g}$ rpm the cam turns with $\\omega = 2\\pi n/60 = {omega}$ rad/s. A phase with the "
        "angle $\\varphi$ takes the time $t$; its maximum velocity and acceleration follow from the law's "
        "factors $C_v$ and $C_a$:"
    )
    return [
        said.with_values(rpm=rpm, omega=omega),
        Equation(SPEED_FORMULA),
        say("For the phase {phase}:", phase=phase_title(motion, k)),
        formula(f"$${SPEED_NUMBERS}$$", omega=omega, **values),
        Grid(
            say("Times, maximum velocities and accelerations of the phases"),
            (say("phase"), *SPEED_HEADINGS[of_lift]),
            rows,
        ),
    ]


def _impact(solution: Solution) -> list[Block]:
    motion, of_lift = solution.cam.motion, solution.chain.board.follower.unit
    if rigid := velocity_jumps(motion):
        said = warning(say("The velocity jumps: the impact is rigid."))
        return [said, jumps_sentence(rigid, "v", f"{of_lift}/rad")]
    if soft := acceleration_jumps(motion):
        said = say(
            "The velocity is continuous and the acceleration jumps: the impact is soft. The force on the follower "
            "jumps with the acceleration."
        )
        return [said, jumps_sentence(soft, "a", f"{of_lift}/rad²")]
    return [say("Velocity and acceleration are continuous: there is no impact.")]


def jumps_sentence(jumps: list[Jump], symbol: str, of_symbol: str) -> Grid:
    """The table of a quantity's jumps: where, from which value, to which."""
    header = ("φ", say("{symbol} before", symbol=symbol), say("{symbol} after", symbol=symbol), say("jump"))
    rows = [
        (say("{phi}°", phi=number(math.degrees(jump.phi))), *map(number, (jump.before, jump.after, jump.size)))
        for jump in jumps
    ]
    return Grid(say("Jumps, in {unit}", unit=unit(of_symbol)), header, rows)


def _result(solution: Solution) -> list[Block]:
    built = [say("{name} {value} ({by})", name=name, value=value, by=by) for name, value, by in sizes(solution)]
    said = say("The cam is made with these sizes: {sizes}.", sizes=and_list(built))
    return [said, *_face(solution), *(warning(caution.said) for caution in solution.cautions)]


def _face(solution: Solution) -> list[Caption]:
    """The sentences by which the adopted face follows from the drawn contact; none without a face."""
    if (face := solution.face) is None:
        return []
    (left, right), (needs_left, needs_right) = face.drawn, face.least
    sides = {"left": left, "right": right, "needs_left": needs_left, "needs_right": needs_right}
    said = say(
        "The contact moves {left} mm to the left and {right} mm to the right of the follower's axis. With {margin:g} "
        "mm on each side the face must reach {needs_left} mm to the left and {needs_right} mm to the right: its "
        "minimum width is {width} mm.",
        margin=face.margin,
        **numbers(**sides, width=sum(face.least)),
    )
    (left, right), whole = face.adopted, sum(face.adopted)
    rounded = say(
        "Rounded up, the face is {left:g} + {right:g} mm, {width:g} mm wide.", left=left, right=right, width=whole
    )
    return [sequence([said, rounded], " ")]


def against_exact(solution: AnySolution) -> list[Block]:
    """The table of drawn and exact values, and the explanation of the bound."""
    pencil = solution.chain.pencil
    meaning = say(
        "The bound is an estimate, from redrawing, of how far the drawn value may deviate from the exact one on "
        "this paper: for the finite number of parts it is {factor:g} times the maximum change when every part is "
        "divided into {parts}.",
        factor=CHANGE_TO_ERROR_FACTOR,
        parts=and_list([str(k) for k in REFINEMENTS]),
    )
    hands = say(
        "For drawing errors it includes the bias and {deviations:g} standard deviations of {count} drawings with "
        "the same pencil.",
        deviations=DEVIATION_COUNT,
        count=pencil.samples or HAND_COUNT,
    )
    proved = say(
        "For the double integration a bound is proved beforehand, from the derivatives of the laws alone; it "
        "holds for every drawing with this number of parts and an ideal pencil."
    )
    beforehand = any(math.isfinite(q.proved_paper) for q in solution.comparison.quantities.values())
    meaning = sequence([meaning, *([proved] if beforehand else [])], " ")
    said = [meaning, *([] if pencil.perfect else [hands]), *_verdict(solution), *_other_sides(solution)]
    minus = say("The error is the drawn value minus the exact one.")
    return [minus, comparison_table(solution.comparison.quantities), sequence(said, " ")]


def errors_of_the_hand(solution: AnySolution) -> list[Chapter]:
    """The chapter on the share of each kind of act in the scatter; none without drawing errors."""
    pencil = solution.chain.pencil
    if pencil.perfect:
        return []
    meaning = say(
        "The scatter is the standard deviation on the paper over {count} drawings with the same pencil; of "
        "several values the one that scatters most is given. The bias is how far their mean lies from the drawing "
        "without errors. The other columns show the share of its variance, "
        "in percent, due to each kind of operation. “Together” is the share that errors of several kinds cause "
        "only in combination, for example when they make the eye choose another point.",
        count=pencil.samples or HAND_COUNT,
    )
    title = say("Where the drawing errors come from")
    return [(title, [meaning, Grid(title, *budget_table(solution.chain, pencil))])]


def _verdict(solution: AnySolution) -> list[Caption]:
    """The sentences on which drawn values are within their bounds."""
    quantities = solution.comparison.quantities.values()
    unknown = and_list([q.title for q in quantities if math.isfinite(q.error) and math.isnan(q.tolerance_paper)])
    if outside := disagreement(solution.comparison.quantities, solution.chain.pencil):
        verdict = outside[0]
    elif unknown:
        verdict = say("Every drawn value lies within its bound, where there is one.")
    else:
        verdict = say("Every drawn value lies within its bound.")
    restless = and_list([q.title for q in quantities if not q.settled and q.tolerance_paper > PRINTED_ERROR])
    unsettled = say(
        "Redrawn with more parts, these values do not settle, so that their bounds, twice as wide as the others, are "
        "rough estimates: {names}.",
        names=restless,
    )
    no_bound = say("No bound is known for {names}: more parts show details that these do not.", names=unknown)
    return [verdict, *([unsettled] if restless else []), *([no_bound] if unknown else [])]


def _other_sides(solution: AnySolution) -> list[Caption]:
    """The sentences on signed extremes for which the drawing took the other side as the greater one."""
    quantities = solution.comparison.quantities
    names = [
        quantities[said.name].title
        for construction in solution.drawn.values()
        for reading, said in construction.meaning.compared_readings
        if said.sides and float(construction.value(reading)) * quantities[said.name].exact < 0
    ]
    text = say("Nearly equal on both sides: {names}; the side is compared on which the exact value has its maximum.")
    return [text.with_values(names=and_list(names))] if names else []


def of_sheet(told: Table) -> Grid:
    """A table of the sheet as the note has it."""
    return Grid(told.title, told.header, told.rows)
