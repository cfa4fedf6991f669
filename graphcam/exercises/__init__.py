"""Exercises that grade themselves: variants, tolerances from the drawing, diagnosis, follow-through.

An :class:`~graphcam.exercises.definition.exercise.Exercise` is a short file.  A
:class:`~graphcam.exercises.definition.variant.Variant` is what one student gets of it.  A
:class:`~graphcam.exercises.key.answer_key.AnswerKey` holds all that marking needs, made once; and
:func:`~graphcam.exercises.marking.marking.mark` is arithmetic on it and the
:class:`~graphcam.exercises.definition.exercise.Answers`.
"""
