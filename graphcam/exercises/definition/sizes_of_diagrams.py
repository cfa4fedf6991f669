"""The sizes on which lengths on paper depend, in a sentence for students where the exercise's own text tells none."""

import re

from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.words import Caption, say

INTEGRATED = ("acceleration", "integration")
"""Constructions whose lengths on paper go with the chosen ordinate."""


def tells_sizes(exercise: Exercise) -> bool:
    """Whether the text of an exercise names ordinate and poles of its diagrams, as its task has them."""
    drawing = exercise.task.get("drawing", {})
    given = [*([drawing["ordinate"]] if "ordinate" in drawing else []), *drawing.get("poles", ())]
    numbers = {*re.findall(r"[\d.]+|\{\w+\}", exercise.text)}
    return bool(given) and all(f"{each}" in numbers for each in given)


def sizes_sentence(variant: Variant) -> Caption | None:
    """What students must know to draw at the scales of the key; None where the text tells it, or nothing asks it.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.variant import drawn
    >>> str(sizes_sentence(drawn(find_exercise("inversion-arm", paper="A3"), "Anna", b"secret", 0)))
    'Choose 30 mm for the maximum ordinate of the first rise, and integrate with the poles H₁ = 20 mm and H₂ = 20 mm.'
    >>> sizes_sentence(drawn(find_exercise("integration"), "Anna", b"secret", 0))
    """
    exercise = variant.exercise
    on_paper = {asked.construction for asked in exercise.answers if asked.of != "value" or asked.points}
    if on_paper.isdisjoint(INTEGRATED) or tells_sizes(exercise):
        return None
    board = board_chain(variant.task).board
    said = say(
        "Choose {ordinate:g} mm for the maximum ordinate of the first rise, and integrate with the poles "
        "H₁ = {first:g} mm and H₂ = {second:g} mm."
    )
    return said.with_values(ordinate=board.ordinate, first=board.poles[0], second=board.poles[1])
