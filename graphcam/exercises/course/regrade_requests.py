"""Questions of students about their marks: a table that a teacher keeps and answers by marks given by hand."""

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from graphcam.exercises.course.recognition import Recognition
from graphcam.exercises.course.student_table import student_lines
from graphcam.words import say

REQUESTS = "regrade-requests.csv"
"""The teacher's table of the questions."""


@dataclass(frozen=True)
class RegradeRequest:
    """A student's question about one answer, or about the whole hand-in."""

    student: str
    answer: str
    question: str


def read_requests(path: Path, answers: Collection[str], known: Recognition) -> list[RegradeRequest]:
    """The questions, from a CSV file with the columns student, answer and question.

    answers : names that there are;  known : who handed in

    Raises
    ------
    TaskError : the file cannot be read, or a line of it names a student or an answer that there is not, or asks nothing
    """
    found: list[RegradeRequest] = []
    columns = ("student", "answer", "question")
    for line in student_lines(path, say("the table of requests"), columns, known, say("who handed in")):
        if line["answer"] not in answers:
            raise line.wrong("answer", say("one of {names}", names=", ".join(answers)), say("check the name"))
        if not line["question"]:
            raise line.wrong("question", say("a text"), say("give the question, or delete the line"))
        found.append(RegradeRequest(line.student, line["answer"], " ".join(line["question"].split())))
    return found
