"""All files of a graded course, written together."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.folder_names import folder_name
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.grades import long_table, wide_table
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.student_page import student_page
from graphcam.files import whole_folder


def write_reports(
    out: Path, exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[str]:
    """The grades, wide into ``out`` and long beside it, the records and the report on the group; their names.

    Raises
    ------
    OutputError : they cannot be written
    """
    texts = {
        out.name: wide_table(records),
        f"{out.stem}-long.csv": long_table(records),
        # A line a record.
        f"{out.stem}.json": "[" + ",\n ".join(json.dumps(record, allow_nan=False) for record in records) + "]\n",
        f"{out.stem}.html": group_page(exercise, records, answer_keys),
    }
    with whole_folder(out.parent) as draft:
        for name, text in texts.items():
            (draft / name).write_text(text, encoding="utf-8", newline="")
    return list(texts)


def write_feedback(
    folder: Path, exercise: Exercise, records: Sequence[dict[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> None:
    """A page for every student, under the student's name as a file's name.

    Raises
    ------
    OutputError : they cannot be written
    """
    with whole_folder(folder) as draft:
        for record in records:
            text = student_page(exercise, record, answer_keys.get(record["student"]))
            (draft / f"{folder_name(record['student'])}.html").write_text(text, encoding="utf-8")
