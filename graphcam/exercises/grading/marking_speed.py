"""How many submissions of an exercise one core reads and marks in a second, at level L0, where nothing is run."""

import json
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphcam.bench.timing import Timer
from graphcam.constructions.chain import Chain
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise, Given
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.grading.grade_one import Assignment, Submission, grade
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.keying import issue
from graphcam.exercises.key.scatter import answers_of
from graphcam.exercises.reading.submission_files import TOML

STUDENT, SECRET = "speed", b"speed"
HANDS = 60
"""Students of each kind."""
DRAWN = 2
"""Decimals of drawn points, mm of paper: nobody measures finer."""


@dataclass(frozen=True)
class MarkingSpeed:
    """Submissions that are read and marked in a second of the processor's time, from their bytes to their records.

    careful : of careful students
    wrong : of students with every mistake of the catalogue, as many with each; there the mistake is looked for
    """

    exercise: str
    careful: float
    wrong: float


def marking_speed(exercise: Exercise, timer: Timer | None = None) -> MarkingSpeed:
    """Measured with simulated students, whose answers are read from an ``answers.toml``, points of a curve too.

    Raises
    ------
    DesignError : no variant can be diagnosed
    """
    timer, assignment = timer or Timer(), Assignment(exercise, SECRET)
    careful, wrong = simulated(exercise)

    def graded(submissions: list[Submission]) -> Callable[[], object]:
        """What grades them all, one after another."""
        return lambda: [grade(assignment, submission) for submission in submissions]

    speeds = (len(each) / timer.seconds(graded(each)) for each in (careful, wrong))
    return MarkingSpeed(exercise.name, *speeds)


def simulated(exercise: Exercise) -> tuple[list[Submission], list[Submission]]:
    """Submissions of one variant: of careful students, and of others with every mistake."""
    variant, answer_key = issue(exercise, STUDENT, SECRET)
    chain = board_chain(variant.task, exercise.hand.pencil(HANDS, seed=1))
    wrong = (_submissions(exercise, answer_key, misconception(name).change(chain)) for name in exercise.misconceptions)
    return _submissions(exercise, answer_key, chain), [one for some in wrong for one in some]


def _submissions(exercise: Exercise, answer_key: AnswerKey, chain: Chain) -> list[Submission]:
    text, drawn = answer_key.to_json(), answers_of(exercise, chain)
    found: list[Submission] = []
    for hand in range(HANDS):
        given = {asked.name: _given(answers[hand]) for asked, answers in zip(exercise.answers, drawn, strict=True)}
        # As a student fills it in, every answer on a line.
        lines = "".join(f"{name} = {json.dumps(answer)}\n" for name, answer in given.items())
        found.append(Submission(STUDENT, STUDENT, {TOML: lines.encode()}, (), text))
    return found


def _given(answer: Given) -> float | list[list[float]]:
    if not isinstance(answer, np.ndarray):
        return float(answer)
    return np.round(np.column_stack([answer.real, answer.imag]), DRAWN).tolist()
