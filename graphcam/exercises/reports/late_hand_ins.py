"""What the reports tell of deadlines and attempts, out of the records."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from graphcam.exercises.course.hand_in_times import shown_time
from graphcam.words import Caption, say

SOURCES = {
    "table": say("from submitted.csv"),
    "name": say("from the names of the files"),
    "file": say("from the times at which the files were changed"),
    "": say("not known"),
}
"""What the time of a hand-in was taken from, in words."""
TIMES = ("submitted", "time_from", "deadline", "hours_late", "earned")
"""Columns of the table of grades, where there is a deadline."""


@dataclass(frozen=True)
class LateReport:
    """The deadlines of a course and how they were kept.

    deadlines, sources : how many students have which, the most frequent first
    late : the records of those that came late
    """

    deadlines: tuple[tuple[str, int], ...]
    sources: tuple[tuple[Caption, int], ...]
    late: tuple[dict[str, Any], ...]


def late_report(records: Sequence[dict[str, Any]]) -> LateReport | None:
    """What the page of a group tells of deadlines; None where there is none."""
    timed = [{**record, "late": _shown(record["late"])} for record in records if "late" in record]
    if not timed:
        return None
    sources = Counter(record["late"]["time_from"] for record in timed).most_common()
    return LateReport(
        tuple(Counter(record["late"]["deadline"] for record in timed).most_common()),
        tuple((SOURCES[source], count) for source, count in sources),
        tuple(record for record in timed if record["late"]["hours"] > 0),
    )


def _shown(late: dict[str, Any]) -> dict[str, Any]:
    """The lateness with its times as people read them."""
    return {**late, "submitted": shown_time(late["submitted"]), "deadline": shown_time(late["deadline"])}


def earned(record: dict[str, Any]) -> float:
    """All marks that a hand-in earned, before anything was lost for lateness."""
    return float(record["late"]["earned"]) if "late" in record else float(record["total"])


def part_left(record: dict[str, Any]) -> float:
    """The part of them that lateness left."""
    return float(record["late"]["part"]) if "late" in record else 1.0


def time_columns(records: Sequence[dict[str, Any]]) -> list[str]:
    """Headings that the table of grades needs for these records."""
    times = TIMES if any("late" in record for record in records) else ()
    return [*times, *(["attempt"] if any("attempts" in record for record in records) else [])]


def time_cells(record: dict[str, Any], columns: Sequence[str]) -> list[Any]:
    """The cells of a record under these headings."""
    late = record.get("late", {})
    cells = {**late, "hours_late": late.get("hours")}
    cells["attempt"] = next((one["attempt"] for one in record.get("attempts", []) if one["counts"]), None)
    return [cells.get(column) for column in columns]
