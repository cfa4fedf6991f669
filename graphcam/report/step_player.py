"""The step player of a solution: its sheet step by step with instruments and readings, and its mechanism."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, takewhile
from typing import Any, Protocol

import numpy as np

from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.act_data import WrittenActs
from graphcam.drafting.act_order import ActPlaces, FollowedBoard, Moves, all_places, visible_places
from graphcam.drafting.acts import Act, Drawn, Floats, Kind, Setting
from graphcam.drafting.euclid import unit
from graphcam.drafting.ink import Construction, Reading, Row, Step, say
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, UNITS
from graphcam.drafting.telling import SETTING_ROLES
from graphcam.language import language
from graphcam.plane_vectors import cross
from graphcam.report.documents import scene_of
from graphcam.report.mechanism_view import mechanism_view
from graphcam.report.sheet_contents import Contents, scales_found
from graphcam.sheets.layout import Numbered
from graphcam.sheets.model import Drawing
from graphcam.sheets.player import PAGE_CAPTIONS, Acts, PartText, Pieces, ReadingText, RowText, RunText, Slide, player
from graphcam.words import Caption, Tell

INSTRUMENTS: Mapping[str, Caption] = {
    "ruler": say("ruler"),
    "dividers": say("dividers"),
    "compass": say("compass"),
    "protractor": say("protractor"),
    "set square": say("set square"),
    "set squares": say("set squares"),
    "T-square": say("T-square"),
    "curve template": say("French curve"),
}
"""Captions of the instruments, by their names in kinds of acts."""
MAX_DIVIDER_OPENING = 150.0
"""The maximum opening of dividers [mm]; longer lengths are set off with the ruler."""
STRAIGHTNESS = 0.02
"""The maximum distance of points from a line [mm] for which they are joined with the ruler."""


def instruments(moves: Iterable[ActPlaces]) -> list[Caption]:
    """The instruments of moves in the order of use, each with its setting, none twice.

    >>> import graphcam as gc
    >>> from graphcam.drafting.act_order import pieces_of
    >>> inversion = gc.solve(gc.builtin_task()).drawn["inversion"]
    >>> [str(said) for said in instruments(pieces_of([inversion.acts["pitch"][4]]))]
    ['dividers 13.33 mm = 11.11 mm × 1.2']
    """
    said = {str(told): told for piece in moves if (told := _instrument(piece)) is not None}
    # One that is set to something is not named without that as well.
    bare = {str(told.values["instrument"]) for told in said.values() if "instrument" in told.values}
    if str(INSTRUMENTS["set squares"]) in said:
        bare.add(str(INSTRUMENTS["set square"]))
    return [told for name, told in said.items() if name not in bare]


def _instrument(piece: ActPlaces) -> Caption | None:
    """The instrument of one move; None for what is done by eye or in the head."""
    act, kind = piece.act, piece.act.kind
    if kind is Kind.READ:
        return _reading_instrument(act)
    if not kind.instrument:
        return None
    instrument = INSTRUMENTS["ruler" if kind is Kind.FAIR and _is_straight(act) else kind.instrument]
    if kind is Kind.ERECT and _level(act.takes["along"]):
        return INSTRUMENTS["T-square"]
    if kind is Kind.LAY_OFF and _is_arc(piece):
        instrument = INSTRUMENTS["compass"]
    if kind in SETTING_ROLES:
        return _set_instrument(instrument, act.takes[SETTING_ROLES[kind]], piece)
    if kind is Kind.PROTRACTOR:
        return _protractor_setting(instrument, np.degrees(_amounts(act.takes["angle"], piece)))
    return instrument


def _is_straight(act: Act) -> bool:
    points = act.takes["points"].shown
    ways = [points[piece] - points[piece][0] for piece in act.takes["pieces"] if points[piece].size]
    off = [np.abs(cross(unit(way[-1]), way)).max() for way in ways if abs(way[-1]) > NEGLIGIBLE_SIZE]
    return bool(off) and max(off) < STRAIGHTNESS


def _is_arc(piece: ActPlaces) -> bool:
    """Whether a move lays one length off along many rays, as an arc does."""
    along, amounts = piece.act.takes["along"], _amounts(piece.act.takes["length"], piece)
    rays = isinstance(along, Drawn) and along.act.kind is Kind.PROTRACTOR
    return rays and len(piece.at) > 2 and float(np.ptp(amounts)) < NEGLIGIBLE_SIZE


def _level(along: object) -> bool:
    """Whether lines of a given direction are level."""
    return isinstance(along, complex | float | int) and complex(along).imag == 0


def _reading_instrument(act: Act) -> Caption | None:
    """The instrument of a reading: ruler or protractor; None for a value that is transferred or calculated."""
    if "line" in act.takes:
        return INSTRUMENTS["protractor"]
    return INSTRUMENTS["ruler"] if act.takes["length"].ends is not None else None


def _amounts(length: object, piece: ActPlaces) -> Floats:
    """The settings of an instrument at the places of a piece."""
    if isinstance(length, Setting):
        length = length.amount[0] if length.sampled else length.amount
    amounts = np.atleast_1d(np.asarray(length, dtype=np.float64))
    return amounts[list(piece.at)] if amounts.size == piece.act.size else amounts


def _set_instrument(instrument: Caption, length: object, piece: ActPlaces) -> Caption | None:
    amounts = np.abs(_amounts(length, piece))
    low, high = float(np.fmin.reduce(amounts)), float(np.fmax.reduce(amounts))
    if not high > NEGLIGIBLE_SIZE:
        return None
    if instrument == INSTRUMENTS["dividers"] and high > MAX_DIVIDER_OPENING:
        return INSTRUMENTS["ruler"]
    if high - low > NEGLIGIBLE_SIZE:
        return say("{instrument} {low:.2f} to {high:.2f} mm", instrument=instrument, low=low, high=high)
    if source := _source(length, high):
        set_to = say("{instrument} {length:.2f} mm = {source}", source=source)
    else:
        set_to = say("{instrument} {length:.2f} mm")
    return set_to.with_values(instrument=instrument, length=high)


def _source(length: object, amount: float) -> Caption | None:
    """The origin of a setting: a reading times a factor, or a machine length in a scale."""
    if not isinstance(length, Setting) or length.reading is None or length.reading.unit == "rad":
        return None
    if length.value is not None:
        scale = float(np.ravel(length.reading.scale)[0])
        said = say("{value:.6g} {unit} : {scale:.5g}")
        return said.with_values(value=abs(length.value), unit=UNITS[length.reading.unit], scale=scale)
    factor = abs(float(np.ravel(length.factor)[0]))
    return say("{paper:.2f} mm × {factor:.5g}", paper=amount / factor, factor=factor) if factor != 1 else None


def _protractor_setting(instrument: Caption, degrees: Floats) -> Caption | None:
    # A protractor has no angles below zero.
    low, high = (float(np.round(bound(np.abs(degrees)), 2)) for bound in (np.fmin.reduce, np.fmax.reduce))
    if high < NEGLIGIBLE_SIZE:
        return None
    if high - low > NEGLIGIBLE_SIZE:
        return say("{instrument} {low:.2f}° to {high:.2f}°", instrument=instrument, low=low, high=high)
    left = float(np.fmax.reduce(degrees)) > 0
    turned = say("{instrument} {angle:.2f}° anticlockwise") if left else say("{instrument} {angle:.2f}° clockwise")
    return turned.with_values(instrument=instrument, angle=high)


def player_of(contents: Contents, drawing: Drawing) -> str:
    """The player's page of HTML.

    drawing : the whole finished sheet of these contents
    """
    solution = contents.solution
    spoken = language(solution.task.drawing.language)
    words = {name: spoken.text(word) for name, word in PAGE_CAPTIONS.items()}
    turning = mechanism_view(scene_of(solution), spoken.text, spoken.decimal)
    said, acts = slides(contents, spoken.text)
    return player(drawing, said, turning, words, spoken.name, acts)


def slides(contents: Contents, tell: Tell = str) -> tuple[list[Slide], Acts]:
    """The slides of all steps, in order, and the acts by which the sheet is drawn."""
    record, found = WrittenActs(), scales_found(contents.drawn, contents.steps)
    answers = {step.view.name: tell(step.view.answer) for _, _, step in contents.steps if step.view.answer}
    said = [
        replace(slide, finds={view: answers[view] for view, step in found.items() if step == number})
        for number, slide in step_slides(contents.drawn, contents.steps, contents.numbers, record, tell)
    ]
    marks = (mark for _, _, step in contents.steps for mark in step.marks)
    shown = {mark.of: record.number(mark.of) for mark in marks if isinstance(mark.of, Act)}
    return said, Acts(record, shown, drawn_in_parts(said))


class ActNumbers(Protocol):
    """A numbering of acts, by which a page knows what it shows."""

    def number(self, act: Act) -> int:
        """The number of an act."""
        ...

    def piece(self, piece: ActPlaces) -> list[Any]:
        """Places of an act as [number of the act, numbers of the places, or None for all of them]."""
        ...


def step_slides(
    drawn: Mapping[str, Construction],
    steps: Numbered,
    numbers: Mapping[int, str],
    record: ActNumbers,
    tell: Tell = str,
    asked: Callable[[Step], bool] = lambda _: True,
) -> Iterator[tuple[int, Slide]]:
    """The slides of the steps that are asked for, each with its running number.

    numbers : of the steps within the task, such as "3.2", by the running ones
    record : numbers the acts
    """
    every = [step for _, _, step in steps]
    telling = _Telling(tell, FollowedBoard(visible_places(every)), record, _views(every))
    for name, of_one in groupby(steps, key=lambda step: step[1]):
        for k, (number, _, step) in enumerate(of_one):
            if asked(step):
                yield number, telling.slide(drawn[name], step, numbers[number], opens=k == 0)
            else:
                telling.board.pass_step(step, (drawn[name].readings[read] for read in step.reads))


def drawn_in_parts(slides: Iterable[Slide]) -> set[int]:
    """The numbers of the acts that parts of these slides draw or highlight piece by piece."""
    pieces = (piece for slide in slides for part in slide.parts for piece in (*part.draws, *part.lit))
    return {number for number, places in pieces if places is not None}


def _views(steps: Iterable[Step]) -> dict[Act, str]:
    """The name of the view in which an act is shown first, by act."""
    found: dict[Act, str] = {}
    for step in steps:
        for mark in step.marks:
            if isinstance(mark.of, Act):
                found.setdefault(mark.of, step.view.name)
    return found


def run_text(caption: str, first: int, rows: Sequence[tuple[str, str]]) -> RunText:
    """A run for the page: the text for all its places, and its table of names and settings."""
    head = _head([name for name, _ in rows])
    alike = len({setting for _, setting in rows}) == 1
    shown = tuple((name[len(head) :], "" if alike else setting) for name, setting in rows)
    return RunText(caption, first, head.strip(), shown, ())


def _head(names: Sequence[str]) -> str:
    """The words at the beginning of all names, if each name goes on behind them.

    >>> _head(["Station 0", "Station 12′"]), _head(["Ray 3", "Rays 4, 9"])
    ('Station ', '')
    """
    alike = takewhile(lambda words: len({*words}) == 1, zip(*(name.split(" ")[:-1] for name in names), strict=False))
    return "".join(f"{words[0]} " for words in alike)


def _of_all(parts: Iterable[PartText]) -> tuple[str, ...]:
    first, *others = (part.tools for part in parts)
    return tuple(tool for tool in first if all(tool in tools for tools in others))


@dataclass(frozen=True)
class _Telling:
    """The state of telling the steps one after another.

    tell : translates all texts;  board, record : the drawing and the acts so far
    views : the names of the views in which acts are shown
    """

    tell: Tell
    board: FollowedBoard
    record: ActNumbers
    views: Mapping[Act, str]

    def slide(self, construction: Construction, step: Step, number: str, *, opens: bool) -> Slide:
        """The slide of a step; that which opens a chapter also gives the reason of the construction."""
        tell, read = self.tell, {name: construction.readings[name] for name in step.reads}
        moves = self.board.followed(step, read.values())
        captions, runs = self._said(step) if step.parts else ([""], [])
        parts = tuple(self._part(*part, step) for part in zip(captions, moves, strict=True))
        title, why = (tell(said) for said in (construction.meaning.title, construction.meaning.why))
        return Slide(
            title,
            step.view.name,
            tell(step.title),
            "" if len(step.places) > 1 else tell(step.caption),
            tuple(text for row in rows(construction, step) for text in self._reading(row, read[row.name])),
            why if opens else "",
            number=number,
            reason=tell(step.why),
            parts=parts,
            runs=tuple(replace(run, tools=_of_all(parts[run.first : run.first + len(run.rows)])) for run in runs),
            reads={name: self.record.number(each.act) for name, each in read.items() if each.act is not None},
        )

    def _said(self, step: Step) -> tuple[list[str], list[RunText]]:
        """The texts for all places of a step, and its runs."""
        said, runs = list[str](), list[RunText]()
        for part in step.parts:
            if not part.rows:
                said.append(self.tell(part.caption))
                continue
            rows = [(self.tell(row.name), self.tell(row.setting)) for row in part.rows]
            runs.append(run_text(self.tell(part.caption), len(said), rows))
            said += [self.tell(Row(name, setting, ()).caption) for name, setting in rows]
        return said, runs

    def _part(self, caption: str, moves: Moves, step: Step) -> PartText:
        draws, lit, done = (self._pieces(found) for found in (moves.draws, moves.lit, moves.done + moves.closing))
        tools = tuple(self.tell(said) for said in instruments(moves.done or moves.closing))
        shown = (self.views[piece.act] for piece in moves.lit if piece.act in self.views)
        return PartText(caption, tools, draws, lit, done, tuple(dict.fromkeys((step.view.name, *shown))))

    def _pieces(self, pieces: Iterable[ActPlaces]) -> Pieces:
        return [self.record.piece(piece) for piece in pieces]

    def _reading(self, row: ReadingRow, read: Reading) -> Iterator[ReadingText]:
        """The texts of a reading; of several values the extremes, the last of them with all values."""
        tell = self.tell
        if not row.places:
            taken, _, value = tell(row.caption()).rpartition(" = ")
            yield ReadingText(tell(row.title), taken, value, lit=self._lit(read), name=row.name)
            return
        lines = tuple(self._line(row, read, k) for k in range(len(row.places)))
        _, last = row.extremes[-1]
        for what, k in row.extremes:
            title = say("{title}, {extreme}", title=row.title, extreme=row.extreme_caption(what, k))
            taken, _, value = tell(row.caption(k)).rpartition(" = ")
            yield ReadingText(tell(title), taken, value, lines if k == last else (), self._lit(read, k), row.name)

    def _lit(self, read: Reading, *places: int) -> Pieces:
        """The visible pieces from which a reading is taken, at all or some places."""
        if read.act is None:
            return []
        return self._pieces(
            self.board.visible_pieces([ActPlaces(read.act, places) if places else all_places(read.act)])
        )

    def _line(self, row: ReadingRow, read: Reading, place: int) -> RowText:
        """One value of many: its place, length on paper, and value."""
        name = self.tell(row.places[place])
        if row.paper[place] != row.paper[place]:
            return RowText(name, "–", "–")
        taken, _, value = self.tell(row.caption(place)).rpartition(" = ")
        return RowText(name, taken.partition(" × ")[0], value, self._lit(read, place))
