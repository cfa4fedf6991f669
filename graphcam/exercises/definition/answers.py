"""The answers of a submission, once it has been read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from graphcam.drafting.marks import Points
from graphcam.words import Words

Given = float | Points
"""A number, or points (n,) of the paper: complex, in mm."""


@dataclass(frozen=True, eq=False)
class Answers:
    """The answers by name, untrusted data; an answer that was left out is not among them.

    values : a number, or points and curves (n,) as complex mm of paper; they may be anything that a file can say
    problems : answers that stand there and could not be read: a sentence for the student by the answer's name
    notes : sentences about the submission as a whole
    """

    values: Mapping[str, Given]
    problems: Mapping[str, Words] = field(default_factory=dict[str, Words])
    notes: tuple[Words, ...] = ()
