"""Exercises that grade themselves: variants, tolerances from the drawing, diagnosis, follow-through.

An :class:`~graphcam.exercises.exercise.Exercise` is a short file.  A
:class:`~graphcam.exercises.variant.Variant` is what one student gets of it.  A
:class:`~graphcam.exercises.certificate.Certificate` holds all that marking needs, made once; and
:func:`~graphcam.exercises.marking.mark` is arithmetic on it and the
:class:`~graphcam.exercises.answers.Answers`.
"""
