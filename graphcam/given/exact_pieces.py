"""Pieces of a motion as polynomials in rational numbers, one behind the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from graphcam.given.exact_polynomials import Exact, derivative, moved, rounded, sign_changes, value


@dataclass(frozen=True)
class ExactPiece:
    """One polynomial of a motion: s at start + width y for y in [0, 1], in rational numbers.

    start, width : cam angle [rad], of a law fractions of the phase
    """

    start: Fraction
    width: Fraction
    p: Exact

    @property
    def end(self) -> Fraction:
        """Where the piece ends."""
        return self.start + self.width

    def at(self, place: Fraction, order: int = 0) -> Fraction:
        """A derivative by the angle."""
        return value(derivative(self.p, order) if order else self.p, (place - self.start) / self.width) / (
            self.width**order
        )

    def about(self, place: Fraction, scale: Fraction) -> Exact:
        """The coefficients in y of s at place + scale y; a negative scale looks back."""
        return moved(self.p, (place - self.start) / self.width, scale / self.width)


def between(pieces: Sequence[ExactPiece], start: Fraction, end: Fraction) -> list[ExactPiece]:
    """The pieces, or the parts of them, from one place to another.

    >>> line = ExactPiece(Fraction(0), Fraction(1), (Fraction(0), Fraction(1)))
    >>> [(str(piece.start), str(piece.end)) for piece in between([line], Fraction(1, 4), Fraction(1, 2))]
    [('1/4', '1/2')]
    """
    found: list[ExactPiece] = []
    for piece in pieces:
        low, high = max(piece.start, start), min(piece.end, end)
        if (low, high) == (piece.start, piece.end):
            found.append(piece)
        elif low < high:
            found.append(ExactPiece(low, high - low, rounded(piece.about(low, high - low))))
    return found


def turning_places(pieces: Sequence[ExactPiece]) -> list[tuple[Fraction, ExactPiece]]:
    """Where the velocity changes its sign, with the piece that the place lies in, or ends."""
    found: list[tuple[Fraction, ExactPiece]] = []
    before = 0
    for piece in pieces:
        sign, places = sign_changes(derivative(piece.p))
        if before * sign < 0:
            found.append((piece.start, piece))
        found += [(piece.start + piece.width * y, piece) for y in places]
        if sign:
            before = sign * (-1) ** len(places)
    return found
