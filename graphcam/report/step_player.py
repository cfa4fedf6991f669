"""The step player of a solution: its sheet step by step with what is read off, and its mechanism."""

from itertools import groupby

from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.ink import Construction, Step, say
from graphcam.language import language
from graphcam.report.documents import contents_of, scene_of
from graphcam.report.mechanism_view import mechanism_view
from graphcam.sheets.model import Drawing
from graphcam.sheets.player import WORDS, ReadingText, Slide, player
from graphcam.solving.arcs_solution import AnySolution
from graphcam.words import Tell


def player_of(solution: AnySolution, drawing: Drawing) -> str:
    """The page of HTML.

    drawing : the solution's finished sheet, all of it
    """
    spoken = language(solution.task.drawing.language)
    words = {name: spoken.text(word) for name, word in WORDS.items()}
    turning = mechanism_view(scene_of(solution), spoken.text, spoken.decimal)
    return player(drawing, slides(solution, spoken.text), turning, words, spoken.name)


def slides(solution: AnySolution, tell: Tell = str) -> list[Slide]:
    """What is said of each step of the sheet, in order."""
    sheets = contents_of(solution)
    chapters = groupby(sheets.steps, key=lambda step: step[1])
    return [
        _slide(sheets.drawn[name], step, tell, opens=k == 0)
        for name, steps in chapters
        for k, (_, _, step) in enumerate(steps)
    ]


def _slide(construction: Construction, step: Step, tell: Tell, *, opens: bool) -> Slide:
    """What is said of a step; that which opens a chapter says why the construction is drawn."""
    title, why = (tell(said) for said in (construction.meaning.title, construction.meaning.why))
    read = tuple(_reading(row, tell) for row in rows(construction, step))
    return Slide(title, step.view.name, tell(step.title), tell(step.caption), read, why if opens else "")


def _reading(row: ReadingRow, tell: Tell) -> ReadingText:
    taken, _, value = tell(row.said()).rpartition(" = ")
    title = tell(row.title)
    if not row.places:
        return ReadingText(title, taken, value)
    at = say("{title}, greatest of {count}", title=title, count=len(row.places))
    return ReadingText(tell(at), taken, value, tuple(_line(row, k, tell) for k in range(len(row.places))))


def _line(row: ReadingRow, place: int, tell: Tell) -> tuple[str, str, str]:
    """One value of many: where, on paper, value."""
    if row.paper[place] != row.paper[place]:
        return row.places[place], "–", "–"
    taken, _, value = tell(row.said(place)).rpartition(" = ")
    return row.places[place], taken.partition(" × ")[0], value
