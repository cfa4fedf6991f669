"""The questions of students as the page of a group shows them: with the answer, its marks and what was decided."""

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from graphcam.exercises.course.regrade_requests import RegradeRequest
from graphcam.exercises.course.roster import folder_name
from graphcam.words import Caption, say


@dataclass(frozen=True)
class AnsweredRequest:
    """A question and what there is about it.

    given : what the student answered;  marks, of : as they are now
    decided : what the teacher gave by hand for it; None while the question is open
    link : the student's page; empty where there is none
    """

    request: RegradeRequest
    given: Caption
    marks: float
    of: float
    decided: Mapping[str, Any] | None
    link: str


def answered(
    requests: Sequence[RegradeRequest],
    records: Sequence[dict[str, Any]],
    links: Mapping[str, str],
) -> Iterator[AnsweredRequest]:
    """The questions, those that are open first.

    links : to the students' pages, by student
    """
    by_student = {record["student"]: record for record in records}
    found = [_answered(one, by_student[one.student], links.get(one.student, "")) for one in requests]
    yield from (one for one in found if one.decided is None)
    yield from (one for one in found if one.decided is not None)


def _answered(request: RegradeRequest, record: dict[str, Any], link: str) -> AnsweredRequest:
    decided = next((one for one in record.get("overrides", []) if one["answer"] == request.answer), None)
    answer = next((one for one in record["answers"] if one["name"] == request.answer), None)
    if answer is None:
        return AnsweredRequest(request, say("–"), record["total"], record["of"], decided, link)
    return AnsweredRequest(request, _given(answer["given"]), answer["marks"], answer["of"], decided, link)


def _given(value: Any) -> Caption:
    if isinstance(value, list):
        return say("{count} points", count=len(value))
    return say("–") if value is None else say("{value:.6g}", value=value)


def page_links(students: Sequence[str], pages: Path | None, beside: Path) -> dict[str, str]:
    """Links to the students' pages in a folder, from a page in another one.

    >>> page_links(["a/b"], Path("out/pages"), Path("out"))
    {'a/b': 'pages/a%252Fb.html'}
    >>> page_links(["a"], None, Path("out"))
    {}
    """
    if pages is None:
        return {}
    # Absolute, as the one may have been named from elsewhere.
    way = os.path.relpath(pages.absolute(), beside.absolute())
    return {student: quote(f"{way}/{folder_name(student)}.html".replace(os.sep, "/")) for student in students}
