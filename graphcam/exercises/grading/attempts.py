"""Which of a student's attempts counts: the last or the best of all, or of so many."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from graphcam.drafting.ink import Caption, say
from graphcam.errors import DesignError
from graphcam.exercises.course.hand_ins import MOST_ATTEMPTS, HandIn
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.marking.record import is_handed_in


@dataclass(frozen=True)
class AttemptRule:
    """The rule by which an attempt counts.

    which : of those that may count;  first : so many may count, None where all may
    """

    which: Literal["last", "best"] = "last"
    first: int | None = None

    def counting(self, totals: Sequence[float]) -> int:
        """The index of the attempt that counts, of attempts in their order with so many marks each.

        Of equal ones the later counts.

        >>> AttemptRule("best").counting([4, 7, 7, 2]), AttemptRule("last", 2).counting([4, 7, 7, 2])
        (2, 1)
        """
        candidates = range(len(totals))[: self.first]
        return max(candidates, key=lambda k: (totals[k] if self.which == "best" else 0.0, k))


LAST = AttemptRule()
"""The rule by which the last of all attempts counts."""


def attempt_rule_of(text: str) -> AttemptRule:
    """A rule as it is written on the command line.

    Raises
    ------
    DesignError : it is none

    >>> attempt_rule_of("best:3")
    AttemptRule(which='best', first=3)
    """
    found = re.fullmatch(r"(last|best)(?::([1-9]\d{0,3}))?", text.strip())
    if not found or int(found[2] or 1) > MOST_ATTEMPTS:
        allowed = say(
            "last or best, perhaps with how many may count, at most {most}, such as best:3", most=MOST_ATTEMPTS
        )
        raise DesignError("--attempts", text, allowed)
    return AttemptRule("best" if found[1] == "best" else "last", int(found[2]) if found[2] else None)


def counted(
    exercise: Exercise, hand_ins: Sequence[HandIn], records: Sequence[dict[str, Any]], rule: AttemptRule
) -> list[dict[str, Any]]:
    """A record for each student: that of the attempt that counts; all attempts stand under its "attempts".

    records : one a hand-in, in their order, which is that of the attempts
    """
    by_student: dict[str, list[tuple[HandIn, dict[str, Any]]]] = {}
    for one, record in zip(hand_ins, records, strict=True):
        by_student.setdefault(one.student, []).append((one, record))
    return [_counted(exercise, made, rule) for made in by_student.values()]


def _counted(exercise: Exercise, made: Sequence[tuple[HandIn, dict[str, Any]]], rule: AttemptRule) -> dict[str, Any]:
    if len(made) == 1:
        return made[0][1]
    # A late attempt has to be better than one in time by what it loses.
    totals = [record["total"] * record.get("late", {}).get("part", 1.0) for _, record in made]
    # An attempt without any answer is none, whenever it came.
    answered = [k for k, (_, record) in enumerate(made) if is_handed_in(record)] or list(range(len(made)))
    chosen = answered[rule.counting([totals[k] for k in answered])]
    one, record = made[chosen]
    listed = [
        {
            "attempt": each.attempt,
            "submitted": found.get("late", {}).get("submitted"),
            "total": found["total"],
            "counts": k == chosen,
        }
        for k, (each, found) in enumerate(made)
    ]
    if rule == LAST and chosen != len(made) - 1:
        said = say("{count} attempts were handed in; the last one with answers counts", count=len(made))
    else:
        said = _note(len(made), one.attempt, rule)
    note = exercise.tell(said)
    return {**record, "notes": [*record["notes"], note], "attempts": listed}


def _note(count: int, number: int, rule: AttemptRule) -> Caption:
    if rule.first is not None and count > rule.first:
        return say(
            "{count} attempts were handed in, of which the first {first} may count; attempt {number} counts",
            count=count,
            number=number,
            first=rule.first,
        )
    if rule.which == "best":
        return say(
            "{count} attempts were handed in; the best one, attempt {number}, counts", count=count, number=number
        )
    return say("{count} attempts were handed in; the last one counts", count=count)
