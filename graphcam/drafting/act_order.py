"""What is done at every place, in order: acts taken apart, and what each piece of them is found from.

An act is recorded once for all stations.  A student draws station by station: what a part of a step draws is followed
back through what its acts took, as far as that does not lie there yet.  So no move can be forgotten by who writes the
steps, and what is taken from elsewhere on the board can be shown beside.
"""

from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from graphcam.drafting.acts import Act, Drawn, Kind, Setting
from graphcam.drafting.ink import Reading, Step
from graphcam.drafting.marks import Mark, Places


@dataclass(frozen=True)
class ActPlaces:
    """Some of the places that an act leaves, or of the values that it reads, by their numbers from 0."""

    act: Act
    at: tuple[int, ...]


def pieces_of(drawn: Iterable[Drawn]) -> list[ActPlaces]:
    """What was drawn as pieces: of each its act, and the numbers of its places there."""
    return [_piece(each.act, each.index) for each in drawn]


def all_places(act: Act) -> ActPlaces:
    """The piece of all places that an act leaves."""
    return ActPlaces(act, tuple(range(act.size)))


def sources(piece: ActPlaces, *, scales: bool = True) -> Iterator[ActPlaces]:
    """The pieces that a piece is found from: what its act takes at the same places, or all of what has other places.

    scales : whether that counts as well in whose scale a machine value is laid off

    >>> from graphcam import Pencil
    >>> from graphcam.drafting.hand import Hand
    >>> from graphcam.drafting.ink import say
    >>> from graphcam.drafting.meaning import Meaning
    >>> hand = Hand(Pencil(), Meaning("rays", say("Rays"), say("From a pole.")))
    >>> pole, heights = hand.given("pole", -40.0), hand.given("heights", [10j, 20j, 30j])
    >>> rays = hand.join("rays", pole, heights)
    >>> [(found.act.name, found.at) for found in sources(*pieces_of([rays[1]]))]
    [('pole', (0,)), ('heights', (1,))]
    """
    act, takes = piece.act, piece.act.takes
    if act.kind is Kind.TAKE:
        yield from _source_places(piece)
    elif act.kind is Kind.PARALLEL and "chains" in takes:
        yield from _in_chains(piece)
    else:
        for value in (_curved(takes) if "pieces" in takes else takes).values():
            yield from _operands(value, act.size, piece.at, scales)


def _curved(takes: Mapping[str, Any]) -> dict[str, Any]:
    """What a curve takes, its points cut to those of its pieces."""
    points = takes["points"]
    kept = np.concatenate([np.arange(points.index.size)[piece] for piece in takes["pieces"]])
    return {**takes, "points": points[kept]}


def _operands(value: Any, size: int, at: tuple[int, ...], scales: bool) -> Iterator[ActPlaces]:
    """The pieces that one operand of an act gives to places ``at``, of the act's ``size`` places."""
    match value:
        case Drawn():
            yield _piece(value.act, _matching(value.index, size, at))
        case Reading(act=Act() as act):
            yield _piece(act, _matching(np.arange(act.size), size, at))
        case Setting():
            own = value.amount.shape[-1] if value.amount.ndim > value.sampled else 1
            matching = tuple(_matching(np.arange(own), size, at).tolist())
            reading = value.reading if scales or value.value is None else None
            for part in (*(value.ends or ()), value.along, reading, *value.given):
                yield from _operands(part, own, matching, scales)
        case tuple() | list():
            for part in value:
                yield from _operands(part, size, at, scales)
        case _:
            return


def _matching(index: Places, size: int, at: tuple[int, ...]) -> Places:
    """The places of an operand that belong to places ``at`` of an act of that ``size``."""
    return index[list(at)] if index.size == size else index


def _source_places(piece: ActPlaces) -> Iterator[ActPlaces]:
    """The places that a piece of chosen ones was chosen from."""
    drawn, which = piece.act.takes["of"], piece.act.takes["which"]
    row = [(each.act, k) for each in drawn for k in each.index.tolist()]
    if which is not None:
        # With samples of its own the choice of the first one is shown.
        of_all = isinstance(which, np.ndarray) and which.ndim > 1
        chosen = np.atleast_1d(np.arange(len(row))[which[0] if of_all else which]).tolist()
        row = [row[k] for k in chosen]
    yield from _gathered(row[k] for k in piece.at)


def _gathered(places: Iterable[tuple[Act, int]]) -> Iterator[ActPlaces]:
    """Pieces that hold single places, one for each act."""
    found: dict[Act, list[int]] = {}
    for act, place in places:
        found.setdefault(act, []).append(place)
    return (ActPlaces(act, tuple(at)) for act, at in found.items())


def _in_chains(piece: ActPlaces) -> Iterator[ActPlaces]:
    """What chords set end to end stand on: their lines, the uprights, and the chords before them."""
    lines, cuts, chains = (piece.act.takes[name] for name in ("lines", "cuts", "chains"))
    yield _piece(cuts.act, cuts.index[list(piece.at)])
    for k in piece.at:
        cut, parts = next(chain for chain in chains if chain[0].start <= k < chain[0].stop)
        if k > cut.start:
            yield ActPlaces(piece.act, tuple(range(cut.start, k)))
            yield _piece(lines.act, lines.index[[parts.start + k - cut.start - 1]])


def _piece(act: Act, index: Places) -> ActPlaces:
    return ActPlaces(act, tuple(index.tolist()))


@dataclass(frozen=True)
class Moves:
    """A part of a step as moves.

    draws : what it draws;  done : all that is done for that, in order;  lit : what is seen of what it is taken from
    closing : what else the step needs, done at its end
    """

    draws: tuple[ActPlaces, ...]
    done: tuple[ActPlaces, ...]
    lit: tuple[ActPlaces, ...]
    closing: tuple[ActPlaces, ...] = ()


@dataclass
class FollowedBoard:
    """What lies on the board, as one step after another is followed.

    visible : the places of acts that can be seen on the finished drawing, see :func:`visible_places`
    lies : those that lie on the board so far
    """

    visible: Mapping[Act, Set[int]]
    lies: dict[Act, set[int]] = field(default_factory=dict[Act, set[int]])

    def followed(self, step: Step, readings: Iterable[Reading] = ()) -> list[Moves]:
        """The parts of a step as moves, or the step as one; what it reads is read at the end of the last."""
        shown = _all_shown(step)
        parts = [pieces_of(part.draws) for part in step.places] or [[]]
        found: list[Moves] = []
        for k, draws in enumerate(parts):
            # What lies there already was found before.
            new = [piece for piece in draws if _remaining_places(piece, self.lies.get(piece.act, frozenset[int]()))]
            done = tuple(self._needed_places(draws))
            closing = tuple(self._needed_places([*shown, *_all_read(readings)])) if k == len(parts) - 1 else ()
            found.append(
                Moves(tuple(draws), done, tuple(self.visible_sources(new if parts != [[]] else shown)), closing)
            )
        return found

    def pass_step(self, step: Step, readings: Iterable[Reading] = ()) -> None:
        """Put all that a step draws and reads on the board, where nothing is told of it."""
        drawn = [piece for part in step.places for piece in pieces_of(part.draws)]
        for _ in self._needed_places([*drawn, *_all_shown(step), *_all_read(readings)]):
            pass

    def _needed_places(self, pieces: Iterable[ActPlaces]) -> Iterator[ActPlaces]:
        """What must be drawn for pieces, in order: what they are found from before themselves."""
        for piece in pieces:
            if new := _remaining_places(piece, self.lies.setdefault(piece.act, set())):
                self.lies[piece.act].update(new.at)
                yield from self._needed_places(sources(new))
                yield new

    def visible_sources(self, pieces: Iterable[ActPlaces]) -> Iterator[ActPlaces]:
        """The visible places that pieces were found from, the pieces themselves left out."""
        own = list(pieces)
        tried: dict[Act, set[int]] = {}
        for piece in own:
            tried.setdefault(piece.act, set()).update(piece.at)
        found = ((piece.act, source) for piece in own for source in sources(piece, scales=False))
        # What is shown once more in another view was done there: that is not looked up again.
        return self._visible(
            (source for act, source in found if "times" not in act.takes or source.act in self.visible), tried
        )

    def visible_pieces(self, pieces: Iterable[ActPlaces]) -> Iterator[ActPlaces]:
        """The visible places of pieces; of what is only thought, those that it was found from."""
        return self._visible(pieces, {})

    def _visible(self, pieces: Iterable[ActPlaces], tried: dict[Act, set[int]]) -> Iterator[ActPlaces]:
        waiting = list(pieces)
        direct = len(waiting)
        for k, piece in enumerate(waiting):
            # Where the stations stand is not looked up once more: every diagram has them.
            if k >= direct and _divides(piece.act):
                continue
            if new := _remaining_places(piece, tried.setdefault(piece.act, set())):
                tried[piece.act].update(new.at)
                visible = self.visible.get(piece.act, frozenset[int]())
                if seen := tuple(place for place in new.at if place in visible):
                    yield ActPlaces(piece.act, seen)
                if thought := tuple(place for place in new.at if place not in visible):
                    # More waits then: the list grows while it is gone through.  A chord stands on those before it, but
                    # it is drawn by its own ray.
                    behind = sources(ActPlaces(piece.act, thought), scales=False)
                    waiting.extend(source for source in behind if source.act is not piece.act)


def _divides(act: Act) -> bool:
    """Whether an act divides an axis, or finds one that was divided before."""
    of = act.takes.get("of") if act.kind is Kind.GIVEN else None
    return act.kind is Kind.DIVIDE or (isinstance(of, Drawn) and of.act.kind is Kind.DIVIDE)


def _remaining_places(piece: ActPlaces, known: Set[int]) -> ActPlaces | None:
    new = tuple(k for k in piece.at if k not in known)
    return ActPlaces(piece.act, new) if new else None


def _all_shown(step: Step) -> list[ActPlaces]:
    return [_shown_places(mark) for mark in step.marks if isinstance(mark.of, Act)]


def _all_read(readings: Iterable[Reading]) -> list[ActPlaces]:
    return [all_places(each.act) for each in readings if each.act is not None]


def _shown_places(mark: Mark) -> ActPlaces:
    assert isinstance(mark.of, Act)
    return all_places(mark.of) if mark.index is None else _piece(mark.of, mark.index)


def visible_places(steps: Iterable[Step]) -> dict[Act, set[int]]:
    """The places of acts that marks of steps show."""
    found: dict[Act, set[int]] = {}
    for step in steps:
        for mark in step.marks:
            if isinstance(mark.of, Act):
                found.setdefault(mark.of, set()).update(_shown_places(mark).at)
    return found
