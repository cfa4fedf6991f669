"""What a notebook of a task tells before its constructions, and what it asks at the end."""

from __future__ import annotations

from graphcam.words import say

FIRST = say(
    "Every construction of this cam step by step: what is done, the drawing so far with the step in colour, and what "
    "is read off it, as millimetres of paper times a scale. It was written by graphcam from the task below."
)
CHECKED = say(
    "Draw it on paper and put your readings here. A cell answers with a hint; how far a careful hand may be off is "
    "taken into account."
)
ERRORS = say(
    "A perfect hand errs only by the method: curves are replaced by chords, and what lies between two stations is "
    "faired. That error falls with the square of the number of parts. A real hand adds a line's place (0.1 to 0.2 "
    "mm), the dividers (0.1 to 0.3 mm), the scale (0.5 mm) and the protractor (0.5°), and passes each error on to "
    "what is drawn from it. More parts make the method better and the hand worse."
)
MOVED = say("More parts, fewer parts: what changes, and what is worth the work?")
QUESTIONS = say(
    "1. Which reading decides the size of this cam, and how would you repeat it more exactly?\n"
    "2. What changes on the drawing if the cam turns the other way?\n"
    "3. Where does the acceleration jump, and what does the mechanism do there?\n"
    "4. Which of the drawn values would you trust to 1 %, and which not to 10 %?"
)
