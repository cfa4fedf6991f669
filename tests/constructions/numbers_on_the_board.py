"""Which numbers stand on the board when a part of a step is drawn, and those that it tells though they do not.

A number may be told that the task gives, that an instrument of the part is set to, that was read before or is read in
the step, that can be measured on what the part draws beside what it is drawn from, or that the sentence reckons from
such numbers.  What is meant by a number is told by the unit behind it: one of mm is a length, one of degrees an angle.

``python tests/constructions/numbers_on_the_board.py --seed 1 --size 100``, with ``tests``, ``tests/comparison`` and
``tests/mechanism`` on the path, looks through the steps of random tasks.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import combinations, pairwise, product
from string import Formatter
from typing import Any

import numpy as np
from random_tasks import random_arm_task, random_flat_task, random_task

import graphcam as gc
from graphcam.constructions.axes import BROKEN_DWELL
from graphcam.constructions.curvature import CAREFUL_ERROR
from graphcam.drafting.act_order import ActPlaces, FollowedBoard, sources, visible_places
from graphcam.drafting.acts import Act, Drawn, Kind, Setting
from graphcam.drafting.hand import BISECTION_SHARE
from graphcam.drafting.ink import Construction, Part, Reading, Step
from graphcam.drafting.marks import Dots, Line, Mark, Segments
from graphcam.drafting.scale import Scale
from graphcam.errors import DesignError
from graphcam.given.motion import MovingPhase
from graphcam.report.sheet_contents import all_constructions, chapter_numbers, steps_of
from graphcam.words import Caption, Words

CHOSEN = 0.0, 1.0, 2.0, 0.5, BISECTION_SHARE, CAREFUL_ERROR
"""What a construction chooses once for all."""
FULL = 90.0, 180.0, 360.0
READ = 0.05
"""mm: so near to a number the end of an exact curve is read."""
MOST = 70
FEW = 14
"""Of so many places the distances of all pairs are measured, and of so few the directions."""


# --- what a text tells ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Told:
    """A number in a text: its value, and how far the value may lie beside a true one for its last digit."""

    value: float
    tolerance: float
    start: int
    end: int
    literal: bool = False


NUMBER = re.compile(r"(?<![\w′.])[−-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w′]|\.\d)")


def numbers_in(words: Words) -> tuple[str, list[Told]]:
    """The text in English, and the numbers in it: of its values, and those that were written into it."""
    text, found = "", list[Told]()

    def write(words: Words, *, of_value: bool) -> None:
        nonlocal text
        if isinstance(words, str):
            _written(words, of_value=of_value)
            return
        template = words.plural if words.plural and words.count != 1 else words.template
        for literal, name, spec, _ in Formatter().parse(template):
            _written(literal, of_value=False)
            if name is None:
                continue
            value = words.values[name] if name in words.values else Formatter().get_field(name, (), words.values)[0]
            if isinstance(value, Caption | str):
                write(value, of_value=True)
            else:
                said = format(value, spec or "")
                found.append(
                    Told(float(value), _unit_of(said, spec or "", value) / 2, len(text), len(text) + len(said))
                )
                text += said

    def _written(literal: str, *, of_value: bool) -> None:
        nonlocal text
        for match in NUMBER.finditer(literal):
            said = match.group().replace("−", "-")
            # Names of stations are whole numbers.
            if of_value and "." not in said and not literal[match.end() :].lstrip().startswith(("°", "mm")):
                continue
            tolerance = 0.5 * 10.0 ** -len(said.partition(".")[2])
            at = len(text) + match.start(), len(text) + match.end()
            found.append(Told(float(said), tolerance if of_value else 0.0, *at, literal=not of_value))
        text += literal

    write(words, of_value=False)
    return text, found


def _unit_of(said: str, spec: str, value: Any) -> float:
    """What one more in the last digit of a number stands for; of a whole number nothing."""
    if isinstance(value, int | np.integer):
        return 0.0
    if spec.endswith("f"):
        return 10.0 ** -len(said.partition(".")[2])
    digits = int(spec[1:-1]) if re.fullmatch(r"\.\d+g", spec) else 6
    # One that was rounded before, as an angle is to hundredths of a degree.
    if digits == 6 and abs(value - round(value, 2)) < 1e-12:
        return 10.0 ** -(len(said.partition(".")[2]) or 2)
    return 10.0 ** (math.floor(math.log10(abs(value))) + 1 - digits) if value else 0.0


# --- what is known ----------------------------------------------------------------------------------------------------


@dataclass
class Known:
    """Numbers that stand on the board: lengths of paper and machine, angles in degrees, others, and about where."""

    lengths: list[float] = field(default_factory=list)
    angles: list[float] = field(default_factory=list)
    others: list[float] = field(default_factory=list)
    counts: list[float] = field(default_factory=list)
    spans: list[tuple[float, float]] = field(default_factory=list)

    def add(self, values: Any, kind: str = "others") -> None:
        flat = np.ravel(np.asarray(values, dtype=np.float64))
        getattr(self, kind).extend(np.abs(flat[np.isfinite(flat)]).tolist())

    def joined(self, *others: Known) -> Known:
        every = (self, *others)
        return Known(
            *(
                [x for each in every for x in getattr(each, name)]
                for name in ("lengths", "angles", "others", "counts", "spans")
            )
        )

    def of(self, unit: str) -> np.ndarray:
        """Those that a number with this unit behind it may be."""
        if unit == "mm":
            return np.array(self.lengths + self.others)
        if unit == "°":
            return np.array(self.angles + self.others)
        return np.array(self.lengths + self.angles + self.others + self.counts)


def plain_numbers(value: Any, seen: set[int] | None = None) -> Iterator[float]:
    """The numbers in plain data, such as a task: of its tables, and in its texts."""
    seen = set() if seen is None else seen
    if isinstance(value, bool) or value is None or id(value) in seen:
        return
    if isinstance(value, int | float | np.floating | np.integer):
        yield float(value)
    elif isinstance(value, np.ndarray):
        if value.dtype.kind in "fi":
            yield from np.ravel(value).astype(float).tolist()
    elif isinstance(value, str):
        yield from (float(said) for said in re.findall(r"\d+(?:\.\d+)?", value))
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from plain_numbers(each, seen)
    elif isinstance(value, tuple | list | set | frozenset):
        for each in value:
            yield from plain_numbers(each, seen)
    elif dataclasses.is_dataclass(value):
        seen.add(id(value))
        for each in dataclasses.fields(value):
            yield from plain_numbers(getattr(value, each.name), seen)


def given(solution: Any) -> Known:
    """What the task gives, with where its phases end, the angular velocity, and the constants of its laws."""
    known, task = Known(), solution.task
    known.add(list(plain_numbers(task)))
    known.add(CHOSEN)
    known.add(FULL, "angles")
    if rpm := getattr(task, "speed_rpm", None):
        omega = math.pi * rpm / 30
        known.add([omega, 2 * math.pi / omega])
    if isinstance(solution, gc.Solution):
        motion = solution.cam.motion
        angles = np.degrees([phase.angle for phase in motion.phases])
        known.add([angles, np.cumsum(angles)], "angles")
        lifts = np.array([phase.lift for phase in motion.phases])
        known.add([lifts, np.cumsum(lifts)], "lengths")
        known.add(np.degrees([lifts, np.cumsum(lifts)]), "angles")
        known.add([phase.normalised.peak_acceleration for phase in motion.phases if isinstance(phase, MovingPhase)])
    return known


@dataclass
class Board:
    """What has been drawn and read so far.

    lies : what acts left, by the acts
    """

    lies: dict[Act, Drawn] = field(default_factory=dict)
    read: Known = field(default_factory=Known)
    scales: set[float] = field(default_factory=set)

    def take(self, value: Any) -> None:
        """Remember what acts left, with all that they were found from."""
        match value:
            case Drawn():
                root = value.root
                if root.act not in self.lies:
                    self.lies[root.act] = root
                    for each in root.act.takes.values():
                        self.take(each)
            case Setting():
                for each in (*(value.ends or ()), value.along, *value.given):
                    self.take(each)
                if isinstance(value.reading, Reading):
                    self.take(value.reading)
            case Reading(act=Act() as act):
                for each in act.takes.values():
                    self.take(each)
            case tuple() | list():
                for each in value:
                    self.take(each)
            case _:
                pass

    def reading(self, read: Reading, samples: int | None) -> None:
        """A reading that is taken."""
        for known, per_mm in _said(read, samples):
            self.read = self.read.joined(known)
            self.scales.update(per_mm)


def _said(read: Reading, samples: int | None) -> Iterator[tuple[Known, list[float]]]:
    known = Known()
    paper = read.paper if samples is None else read.paper[0]
    if read.unit == "rad" and read.per_mm == 1:
        known.add(np.degrees(paper), "angles")
        yield known, []
        return
    known.add(paper, "lengths")
    value = paper * read.per_mm
    kind = "lengths" if read.unit.startswith("mm") else "others"
    known.add(value, kind)
    if "rad" in read.unit:
        known.add(np.degrees(value), "angles")
        known.add(math.degrees(read.per_mm))
    known.add(read.per_mm)
    yield known, [read.per_mm]


def settings(value: Any, k: int | None, size: int) -> Iterator[tuple[str, np.ndarray | float]]:
    """The numbers that an act is done with at a place: what instruments are set to, and where that comes from."""
    match value:
        case bool() | None:
            return
        case Setting():
            amount = value.amount[0] if value.sampled else value.amount
            at = _at(amount, k, size)
            yield "lengths", at
            yield "angles", np.degrees(at)
            if k and at.size == 1 < np.size(amount):
                yield "angles", np.degrees(at - _at(amount, k - 1, size))
            factor = np.ravel(value.factor)[:1]
            yield "others", factor
            if value.reading is not None:
                yield "lengths", at / factor
            if value.value is not None:
                yield "others", value.value
                yield "angles", math.degrees(value.value)
            for each in value.given:
                yield from settings(each, k, size)
        case int() | float() | np.floating() | np.integer():
            yield "lengths", float(value)
            yield "angles", math.degrees(value)
            yield "others", float(value)
        case np.ndarray() if value.dtype.kind == "f":
            at = _at(value, k, size)
            yield "lengths", at
            yield "angles", np.degrees(at)
            if k and at.size == 1 < value.size:
                yield "angles", np.degrees(at - _at(value, k - 1, size))
        case complex() | np.complexfloating():
            yield "lengths", np.array([value.real, value.imag, abs(value)])
            yield "others", abs(value)
            yield "angles", math.degrees(np.angle(value))
        case Scale():
            yield "others", value.per_mm
        case tuple() | list():
            for each in value:
                yield from settings(each, k, size)
        case _:
            return


def _at(amount: np.ndarray, k: int | None, size: int) -> np.ndarray:
    amounts = np.ravel(np.asarray(amount, dtype=np.float64))
    return amounts[[k]] if k is not None and amounts.size == size > 1 else amounts


def measured(board: Board, pieces: Iterable[ActPlaces], marks: Iterable[Mark], scales: Iterable[float]) -> Known:
    """What can be measured on pieces of the drawing and on marks that no act left, and what is set for the pieces."""
    known, places, ways, beside = Known(), list[complex](), list[complex](), list[complex]()
    for mark in marks:
        places += (of_mark := [complex(each) for each in _places_of(mark)])
        for top in (max, min) if isinstance(mark, Line) else ():
            end = abs(top(each.imag for each in of_mark))
            known.spans += [((end - READ) * per_mm, (end + READ) * per_mm) for per_mm in scales]
    for piece in dict.fromkeys(pieces):
        left = board.lies.get(piece.act)
        for k in piece.at:
            for value in piece.act.takes.values():
                for kind, amount in settings(value, k, piece.act.size):
                    known.add(amount, kind)
        if len(piece.at) > 1:
            known.add(range(1, len(piece.at) + 1), "counts")
        if left is None:
            continue
        first, at = left.first, [k for k in piece.at if k < left.shown.size]
        shown = left.shown[at]
        places += shown.tolist()
        beside += np.diff(shown).tolist()
        if first.along is not None:
            along = np.broadcast_to(np.atleast_1d(first.along), left.shown.shape)[at]
            ways += along.tolist()
            places += (shown + along).tolist()
        if first.radius is not None:
            known.add(np.broadcast_to(np.atleast_1d(first.radius), left.shown.shape)[at], "lengths")
    points = np.array(list(dict.fromkeys(each for each in places if np.isfinite(each))), dtype=np.complex128)
    few = points.size <= MOST
    pairs = (points[:, None] - points[None, :])[np.triu_indices(points.size, 1)] if few else np.diff(points)
    flat = np.concatenate([f(each) for each in (points, pairs, np.array(beside)) for f in (np.real, np.imag, np.abs)])
    known.add(flat, "lengths")
    if any(piece.act.kind is Kind.BISECT for piece in pieces):
        known.add(BISECTION_SHARE * np.abs(pairs), "lengths")
    turns = np.degrees(np.angle(np.array([*ways, *points, *(pairs if points.size <= FEW else ())])))
    if turns.size <= FEW**2:
        turns = np.append(turns, turns[:, None] - turns[None, :])
    known.add([turns % 180, 180 - turns % 180, turns % 360, 360 - turns % 360, abs(90 - turns % 180)], "angles")
    for per_mm in scales:
        known.add(flat * per_mm, "lengths" if few else "others")
        known.add(np.degrees(flat * per_mm), "angles")
    return known


def _places_of(mark: Mark) -> Iterable[complex]:
    """The places of a mark that shows a curve or points."""
    match mark:
        case Line(points=points) | Dots(points=points):
            return np.ravel(points).tolist()
        case Segments(starts=starts, ends=ends):
            return [*np.ravel(starts).tolist(), *np.ravel(ends).tolist()]
        case _:
            return ()


# --- what a sentence reckons ------------------------------------------------------------------------------------------

SENTENCE = re.compile(r"(?<=[.!?])\s+(?=[A-ZΑ-Ω])")
SYMBOL = re.compile(r"([^\W\d_][^\s()=:,;]*) = (?:[^=;:]* = )?$")
SIGN = re.compile(r"[=×·/+−-]|\bof\b|\d [ρr]\b")
SHOWN = re.compile(r"[(\d][\d.()²³ ×·/+−-]*[×·/+−-][\d.()²³ ×·/+−-]*[\d)²³](?= = )")
UNITS = re.compile(r"(?<=\d)(?: mm|°)")


def unknown(words: Words, known: Known, symbols: dict[str, list[float]]) -> list[str]:
    """The numbers of a text, with their sentence, that are neither known nor reckoned there from such numbers.

    symbols : what letters in the sentences stand for, to which those are added that the text tells
    """
    return stray(*numbers_in(words), known, symbols)


def stray(text: str, every: list[Told], known: Known, symbols: dict[str, list[float]]) -> list[str]:
    """The same of a text and its numbers."""
    bounds = [0, *(match.end() for match in SENTENCE.finditer(text)), len(text)]
    found = list[str]()
    for start, end in pairwise(bounds):
        sentence = text[start:end]
        here = [each for each in every if start <= each.start < end]
        open_ = [each for each in here if not each.literal and not _is_known(each, text, known)]
        told = [each.value for each in here if each not in open_]
        told += [value for name, values in symbols.items() if _occurs(name, sentence) for value in values]
        open_ = [each for each in open_ if not _shown(each, text[start:], here, start)]
        while new := [each for each in open_ if _reckoned(each, told, sentence)]:
            told += [each.value for each in new]
            open_ = [each for each in open_ if each not in new]
        if "mm is" in sentence:
            lengths = np.outer([each.value for each in here if each not in open_], known.lengths)
            open_ = [each for each in open_ if not np.any(np.abs(lengths - each.value) <= each.tolerance)]
        for each in here:
            if each not in open_ and (named := SYMBOL.search(text[: each.start])):
                symbols[named.group(1)] = [each.value]
        found += [f"{text[each.start : each.end]} in “{sentence.strip()}”" for each in open_]
    return found


def _occurs(name: str, sentence: str) -> bool:
    return bool(re.search(rf"(?<!\w){re.escape(name)}(?![^\W²³])", sentence))


def _shown(told: Told, sentence: str, here: list[Told], start: int) -> bool:
    """Whether the arithmetic that stands before the number makes it."""
    upto = sentence[: told.start - start]
    for each in reversed([each for each in here if each.end <= told.start]):
        at = slice(each.start - start, each.end - start)
        upto = upto[: at.start] + f"{each.value:.12f}" + upto[at.stop :]
    last = next(reversed(list(SHOWN.finditer(UNITS.sub("", upto)))), None)
    if last is None:
        return False
    signs = {"×": "*", "·": "*", "−": "-", "²": "**2", "³": "**3"}
    try:
        made = eval("".join(signs.get(letter, letter) for letter in last.group()), {}, {})
    except (SyntaxError, TypeError, ZeroDivisionError):
        return False
    return abs(abs(made) - abs(told.value)) <= told.tolerance + 1e-6 * abs(told.value)


def _is_known(told: Told, text: str, known: Known) -> bool:
    behind = re.match(r"\s?(mm|°)(?![\w/])", text[told.end :])
    pool = known.of(behind.group(1) if behind else "")
    if any(low <= abs(told.value) <= high for low, high in known.spans):
        return True
    return bool(np.any(np.abs(pool - abs(told.value)) <= told.tolerance + 1e-9 * abs(told.value)))


def _reckoned(told: Told, operands: list[float], sentence: str) -> bool:
    """Whether a sentence makes a number as a product, a quotient, a sum, or as the angle of a tangent."""
    values = [abs(x) for x in dict.fromkeys(operands) if x]
    slack, wanted = told.tolerance + 1e-9 * abs(told.value), abs(told.value)
    if not wanted:
        return True
    logs = np.log(values) if values else np.zeros(0)
    exponents = (1, -1, *((2, -2) if "²" in sentence else ()), *((3, -3) if "³" in sentence else ()))
    for n in range(1, min(4, len(values), len(SIGN.findall(sentence))) + 1):
        powers = np.array(list(product(exponents, repeat=n)))
        signs = np.array(list(product((1, -1), repeat=n)))
        for chosen in combinations(range(len(values)), n):
            made = np.exp(powers @ logs[list(chosen)])
            every = [made, np.abs(signs @ np.array(values)[list(chosen)])]
            every += [100 * made] if "%" in sentence else []
            every += [np.degrees(np.arctan(made))] if "arctan" in sentence else []
            if np.any(np.abs(np.concatenate(every) - wanted) <= slack):
                return True
    return False


Judged = Callable[[Words, Known, dict[str, list[float]]], list[str]]

# --- the walk ---------------------------------------------------------------------------------------------------------


def places_of(step: Step) -> list[tuple[Words, list[Part]]]:
    """What is told in a step, each with the places that it tells of."""
    found = list[tuple[Words, list[Part]]]()
    for part in step.parts:
        rows = [Part(row.caption, row.draws) for row in part.rows]
        found += [(part.caption, rows or [part]), *((row.caption, [row]) for row in rows)]
    return found


def not_on_the_board(solution: Any, judged: Judged = unknown) -> Iterator[tuple[str, str, str]]:
    """Every number of a solution's steps that is told though it does not stand on the board: step, name, number.

    judged : says it of a text
    """
    drawn = all_constructions(solution)
    steps = steps_of(drawn)
    numbers, data = chapter_numbers(steps), given(solution)
    # A broken dwell has a length that the drawing chooses, as it chooses a round scale.
    data.add([BROKEN_DWELL])
    followed, board = FollowedBoard(visible_places([step for _, _, step in steps])), Board()
    for construction in drawn.values():
        for left in construction.acts.values():
            board.take(left)
    taken, rpm = _taken(board), getattr(solution.task, "speed_rpm", None)
    symbols = {"π": [math.pi], "m/s": [1000.0], "mm is": [], "ω": [math.pi * rpm / 30] if rpm else []}
    for number, name, step in steps:
        construction = drawn[name]
        reads = [construction.readings[read] for read in step.reads]
        for part in step.places:
            for each in part.draws:
                board.take(each)
        symbols["mm is"] = [step.view.mu_l] if step.view.mu_l else []
        scales = list(_scales(construction, step))
        board.scales.update(scales)
        data.add(scales)
        data.add([each for each in vars(construction.givens).values() if isinstance(each, float)])
        for read in reads:
            board.reading(read, construction.pencil.samples)
        moves = followed.followed(step, reads)
        of_place = dict(zip(((*map(_key, place.draws),) for place in step.places), moves, strict=False))
        shown = [_shown_by(mark) for mark in step.marks if isinstance(mark.of, Act)]
        whole = [*shown, *(piece for each in moves for piece in (*each.done, *each.closing))]
        before = list[ActPlaces]()
        for words, places in places_of(step):
            pieces = [piece for place in places for piece in _pieces_of(place, of_place)]
            if not any(place.draws for place in places):
                pieces = whole
            pieces += [ActPlaces(act, (0,)) for piece in pieces for act in taken.get(piece.act, ())]
            marks = [] if construction.acts else step.marks
            own = measured(board, [*before, *pieces], marks, board.scales)
            if len(places) == 1:
                before += [ActPlaces(each.act, (*each.index.tolist(),)) for each in places[0].draws]
            own.add(_stepped_off(construction, words), "lengths")
            own.add(_read_again(construction), "lengths")
            if name != "scheme":
                for found in judged(words, data.joined(board.read, own), symbols):
                    yield numbers[number], name, found


def _read_again(construction: Construction) -> list[float]:
    """The least radius [mm] that is read once more, at the place that was rounded."""
    adopted = getattr(construction.givens, "adopted", lambda: None)()
    return [adopted.least] if adopted is not None else []


def _stepped_off(construction: Construction, words: Words) -> list[float]:
    """The eighths of parts that a sentence steps off; of other points so far apart the chord and the radius [mm]."""
    told = re.search(r"step off ([\d.]+) parts( instead)?", str(words))
    if told is None or construction.name != "curvature":
        return []
    apart, inverted, curve = round(8 * float(told[1])), construction.givens.inverted, construction.acts["drawn curve"]
    found, ways, first = [(math.inf, 0.0)], -1 if inverted.givens.rotation == "ccw" else 1, 0
    for piece in curve.act.takes["pieces"] if told[2] else ():
        places = curve.first.shown[first : first + 8 * (piece.stop - piece.start - 1) + 1].tolist()
        first += len(places)
        for a, b, c in zip(places, places[apart:], places[2 * apart :], strict=False):
            turned = ways * ((b - a).conjugate() * (c - b)).imag
            if turned > 0:
                found.append((abs(a - b) * abs(b - c) * abs(c - a) / (2 * turned), (abs(a - b) + abs(b - c)) / 2))
    radius, chord = min(found)
    return [apart / 8, *([chord, radius * inverted.givens.mu_l.per_mm] if told[2] else [])]


def _taken(board: Board) -> dict[Act, list[Act]]:
    """The single places that are taken of what acts left."""
    found: dict[Act, list[Act]] = {}

    def follow(act: Act, place: Act) -> None:
        for value in act.takes.values():
            for each in value if isinstance(value, tuple) else (value,):
                if isinstance(each, Drawn):
                    found.setdefault(each.act, []).append(place)
                    if each.act.kind in (Kind.TAKE, Kind.ENLARGE, Kind.FAIR):
                        follow(each.act, place)

    for act in board.lies:
        if act.size == 1:
            follow(act, act)
    return found


def _shown_by(mark: Mark) -> ActPlaces:
    assert isinstance(mark.of, Act)
    return ActPlaces(mark.of, tuple(range(mark.of.size) if mark.index is None else mark.index.tolist()))


def _scales(construction: Construction, step: Step) -> Iterator[float]:
    """The scales that are chosen: of what lies on the board, and of the view."""
    own = [each for each in vars(construction.givens).values() if isinstance(each, Scale)]
    own += [diagram.mu for diagram in getattr(construction.givens, "diagrams", ())]
    for per_mm in (*(each.per_mm for each in own), *([step.view.mu_l] if step.view.mu_l else [])):
        yield per_mm
        yield 1 / per_mm
    if not construction.acts:
        yield math.radians(3)  # a turn is 120 mm long


def _key(drawn: Drawn) -> tuple[int, tuple[int, ...]]:
    return id(drawn.act), tuple(drawn.index.tolist())


def _pieces_of(place: Part, of_place: Mapping[Any, Any]) -> Iterator[ActPlaces]:
    """What a place draws, what that is found from, and the places of the same acts before."""
    for each in place.draws:
        piece = ActPlaces(each.act, tuple(each.index.tolist()))
        yield piece
        yield from sources(piece)
        if len(piece.at) == 1 and piece.at[0]:
            yield ActPlaces(piece.act, (piece.at[0] - 1,))
    if moves := of_place.get((*map(_key, place.draws),)):
        yield from (*moves.done, *moves.lit, *moves.closing)


def share_found(solution: Any, times: float) -> float:
    """Of the numbers that are told so many times as great as they are, the share that is found."""
    tried = [*not_on_the_board(solution, lambda words, known, symbols: tried_off(words, known, symbols, times))]
    return sum(found == "found" for *_, found in tried) / len(tried)


def tried_off(words: Words, known: Known, symbols: dict[str, list[float]], times: float) -> list[str]:
    """For every fifth number, whether it is found when told so many times as great, if that is seen at all."""
    text, every = numbers_in(words)
    before, results = {*stray(text, every, known, dict(symbols))}, list[str]()
    for k, told in enumerate(every):
        if (
            k % 5 == len(text) % 5
            and not told.literal
            and told.tolerance
            and abs(told.value * (times - 1)) > 2 * told.tolerance
        ):
            moved = [replace(each, value=each.value * times) if j == k else each for j, each in enumerate(every)]
            results.append("found" if {*stray(text, moved, known, dict(symbols))} - before else "missed")
    stray(text, every, known, symbols)
    return results


def main() -> None:
    """Print what random tasks tell though it does not stand on the board."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=100)
    chosen = parser.parse_args()
    kinds = (random_task, random_arm_task, random_flat_task)
    count = 0
    for k in range(chosen.size):
        with suppress(DesignError):
            for where, name, found in not_on_the_board(gc.solve(kinds[k % 3](chosen.seed * 10_000 + k))):
                count += 1
                sys.stdout.write(f"{kinds[k % 3].__name__}({chosen.seed * 10_000 + k}), {where}, {name}: {found}\n")
    sys.stdout.write(f"{chosen.size} tasks: {count} numbers do not stand on the board\n")
    sys.exit(count > 0)


if __name__ == "__main__":
    main()
