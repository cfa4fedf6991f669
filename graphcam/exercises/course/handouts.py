"""What a student gets: notebook, file for the answers, worksheet, task file; and what the teacher gets."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import wrap

import nbformat
import nbformat.v4 as nb
from nbformat import NotebookNode

from graphcam.constructions.views import PROFILE
from graphcam.drafting.ink import Step
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.blank_axes import empty_axes
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of, views_of
from graphcam.exercises.definition.exercise import BAR, AskedAnswer, Exercise
from graphcam.exercises.definition.sizes_of_diagrams import sizes_sentence
from graphcam.exercises.definition.variant import Variant, sentence
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reading.drawn_layers import ORIGIN_LAYER
from graphcam.exercises.reading.notebook import ANSWER_TAG
from graphcam.exercises.reading.submission_files import DXF, NOTEBOOK, TOML
from graphcam.notebooks.notebook_execution import PYTHON_METADATA
from graphcam.report.markdown import number
from graphcam.report.sheet_contents import title_block
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Drawing
from graphcam.sheets.tables import Table
from graphcam.tasks.task_writer import task_files
from graphcam.words import Caption, Words, say, say_in, say_many

LINE_LENGTH = 96
"""Letters in a line of the task in ``answers.toml``."""
PRINT_CHECK = say(
    "Measure the rule of 100 mm on this sheet and write its length in mm as {name} in your answers. If it is shorter "
    "than 90 mm, or than 99 mm and your answers have no {name}, print the sheet again at 100 % of its size.",
    name=BAR.name,
)
"""What tells a print that is too small: where its size is not told, right work on one at 99 % keeps its marks, at 98 %
it need not."""
KEY_COLUMNS = (say("name"), say("unit"), say("value"), say_in("of an answer", "tolerance"), say("marks"))
"""The columns of the key's table, as :func:`key_rows` fills them."""


def instructions(variant: Variant) -> str:
    """The exercise's text with the variant's numbers, its lines joined; no space follows a Chinese sign.

    The sizes of the diagrams come last, where the text does not tell them and answers on paper depend on them.
    """
    exercise, sizes = variant.exercise, sizes_sentence(variant)
    told = [sentence(exercise.text, variant.parameters, exercise.tell), *([exercise.tell(sizes)] if sizes else [])]
    joined = " ".join(" ".join(told).split())
    return re.sub("(?<=[，。；：？！]) ", "", joined)


def answer_file(exercise: Exercise, head: Sequence[str] = ()) -> str:
    """``answers.toml`` to fill in: every answer as a comment, so that an empty one is missing and not wrong.

    head : lines of comment that come first
    """
    how = say("Remove the # before an answer and write the number after the = sign, with a decimal point.")
    lines = [*head, f"# {exercise.title}. {exercise.tell(how)}", ""]
    for asked in _told_by_file(exercise):
        blank = "" if asked.kind == "number" else "[[x, y], [x, y]]"
        lines += [f"# {asked.text} {exercise.tell(_answer_form(asked))}", f"# {asked.name} = {blank}", ""]
    return "\n".join(lines)


def answer_file_head(variant: Variant, student: Student) -> list[str]:
    """Whose ``answers.toml`` it is, and the task, as comments.

    The task's lines begin with ##: whatever stands in them, none is taken for an answer whose # was left in.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.variant import drawn
    >>> head = answer_file_head(drawn(find_exercise("integration"), "7", b"", 0), Student("7", "Anna"))
    >>> head[0], head[1][:23]
    ('# 7 Anna', '## The follower rises b')
    """
    # A name is a stranger's, and TOML allows no control characters in comments.
    whose = "".join(sign if sign.isprintable() else " " for sign in f"{student.id} {student.name}".strip())
    return [f"# {whose}", *(f"## {line}" for line in wrap(instructions(variant), LINE_LENGTH)), ""]


def notebook(variant: Variant) -> NotebookNode:
    """A notebook with the task, and a tagged cell of literals for the answers."""
    exercise = variant.exercise
    asked = "\n".join(f"- `{a.name}`: {a.text} {exercise.tell(_answer_form(a))}" for a in _told_by_file(exercise))
    how = say("Write your answers in the next cell: plain numbers with a decimal point, nothing else.")
    blanks = "\n".join(f"{a.name} = None" for a in _told_by_file(exercise))
    cells = [
        nb.new_markdown_cell(f"# {exercise.title}\n\n{instructions(variant)}", id="task"),
        nb.new_markdown_cell(f"{exercise.tell(how)}\n\n{asked}", id="asked"),
        nb.new_code_cell(blanks, id="answers", metadata={"tags": [ANSWER_TAG]}),
    ]
    return nb.new_notebook(cells=cells, metadata=PYTHON_METADATA)


def _told_by_file(exercise: Exercise) -> tuple[AskedAnswer, ...]:
    """The answers, and how long the rule on the sheet is; one that is photographed has bars of its own."""
    text = exercise.tell(say("The length of the rule of 100 mm on your worksheet; left out it counts as 100 mm."))
    return (*exercise.answers, *([] if exercise.paper else [replace(BAR, text=text)]))


def worksheet(variant: Variant, student: Student) -> Drawing:
    """The sheet to draw on: what is given, and the table for the answers."""
    exercise, chain = variant.exercise, board_chain(variant.task)
    steps = [
        (name, step) for name, count in exercise.sheet.items() for step in construction_of(chain, name).steps()[:count]
    ]
    steps += [(name, empty_axes(exercise, chain, name)) for name in exercise.axes]
    # One that is photographed has bars of its own, whose lengths are asked.
    notes = [instructions(variant), *([] if exercise.paper else [exercise.tell(PRINT_CHECK)])]
    return _composed(variant, student, steps, [answer_table(exercise)], notes)


def answer_table(exercise: Exercise) -> Table:
    """The table for the answers, to be filled in."""
    blanks = [say("see the drawing") if asked.layer else " " * 12 for asked in exercise.answers]
    rows = tuple((a.text, a.name, a.unit_caption, blank) for a, blank in zip(exercise.answers, blanks, strict=True))
    return Table(say("Answers"), (say("question"), say("name"), say("unit"), say("answer")), rows)


def key_sheet(variant: Variant, student: Student, answer_key: AnswerKey) -> Drawing:
    """The teacher's sheet: every construction that is asked for, drawn to its end, and the key."""
    exercise, chain = variant.exercise, board_chain(variant.task)
    names = _drawn_for(exercise, tuple(chain))
    steps = [(name, step) for name in names for step in construction_of(chain, name).steps()]
    table = Table(say("Key"), KEY_COLUMNS, tuple(key_rows(exercise, answer_key)))
    return _composed(variant, student, steps, [table], [f"{student.id}: {instructions(variant)}"])


def _drawn_for(exercise: Exercise, order: tuple[str, ...]) -> list[str]:
    """The constructions up to the last one that is asked for; one that stands beside them is drawn alone."""
    asked = {each.construction for each in exercise.answers}
    within = [order.index(name) for name in asked if name in order]
    return [*order[: max(within) + 1 if within else 0], *sorted(asked - set(order))]


def key_rows(exercise: Exercise, answer_key: AnswerKey) -> list[tuple[Words, ...]]:
    """A line an answer: name, unit, value, tolerance, marks."""
    rows: list[tuple[Words, ...]] = []
    for asked in exercise.answers:
        key = answer_key.keys[asked.name]
        value = key.expected.value
        told = number(value, asked.decimals) if isinstance(value, float) else say("see the drawing")
        tolerance = number(key.tolerance, asked.decimals + 1)
        rows.append((asked.name, asked.unit_caption, told, tolerance, say("{marks:g}", marks=asked.marks)))
    return rows


def origins(variant: Variant) -> dict[str, str]:
    """The views in which answers are drawn, by the layer on which a POINT of worksheet.dxf marks the view's origin.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.variant import drawn
    >>> origins(drawn(find_exercise("inversion-translating"), "Anna", b"secret", 0))
    {'ORIGIN': 'profile'}
    """
    chain = board_chain(variant.task)
    drawn = [asked for asked in variant.exercise.answers if asked.kind != "number"]
    views = {asked.layer: views_of(chain, asked) for asked in drawn}
    if len(set().union(*views.values())) == 1:
        return {ORIGIN_LAYER.upper(): next(iter(views.values())).pop()}
    # Points of a construction that is drawn in several views may belong to either, so none is marked for them.
    return {f"{layer}-{ORIGIN_LAYER}".upper(): found.pop() for layer, found in views.items() if len(found) == 1}


def _composed(
    variant: Variant, student: Student, steps: list[tuple[str, Step]], tables: list[Table], notes: list[str]
) -> Drawing:
    task = variant.task
    title = replace(task.title, name=variant.exercise.title, author=student.name or student.id)
    mu_l, tell = board_chain(task).profile_scale.per_mm, variant.exercise.tell
    # The scale of the profile is that of the sheet, though the titles of views tell none: some are to be found.
    profile = {PROFILE.name: mu_l}
    steps = [(name, replace(step, view=replace(step.view, mu_l=profile.get(step.view.name)))) for name, step in steps]
    block = title_block(title, tell, variant.exercise.remark)
    # A worksheet that is photographed has a larger profile than a finished sheet of its format.
    paper = "A1" if variant.exercise.paper else task.drawing.format
    return compose(steps, tables, block, paper, task.drawing.frame, notes, tell=tell)


def _answer_form(asked: AskedAnswer) -> Caption:
    if asked.kind != "number":
        what = say("Points in mm on paper") if asked.kind == "points" else say("A curve in mm on paper")
        return say(
            "({what}, or drawn on the layer {layer} of worksheet.dxf or of another DXF file and handed in as {file}, "
            "its origin marked by a POINT on the layer ORIGIN.)",
            what=what,
            layer=asked.layer,
            file=DXF,
        )
    decimals = say_many("to {count} decimal", "to {count} decimals", asked.decimals)
    if not asked.unit:
        return say("({decimals}.)", decimals=decimals)
    return say("(in {unit}, {decimals}.)", unit=asked.unit_caption, decimals=decimals)


@dataclass(frozen=True)
class Sheets:
    """The sheets of a student's worksheet: as they are printed, and as one draws on them in CAD."""

    printed: Drawing
    in_cad: Drawing


def write_handouts(variant: Variant, student: Student, folder: Path, marked: Sheets | None = None) -> None:
    """Write all that the student gets into a folder.

    marked : the worksheet where it is made to be photographed
    """
    from graphcam.sheets.dxf_renderer import write_dxf
    from graphcam.sheets.matplotlib_renderer import write_pdf

    sheet = marked.in_cad if marked else worksheet(variant, student)
    write_pdf(marked.printed if marked else sheet, folder / "worksheet.pdf")
    layers = dict.fromkeys(asked.layer for asked in variant.exercise.answers if asked.layer)
    write_dxf(sheet, folder / "worksheet.dxf", origins(variant), list(layers))
    answers = answer_file(variant.exercise, answer_file_head(variant, student))
    files = {TOML: answers, NOTEBOOK: nbformat.writes(notebook(variant))}
    for name, text in (files | task_files(variant.task)).items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
