"""What a notebook of a task tells of each construction before its steps, and what it asks at the end."""

from __future__ import annotations

from collections.abc import Mapping

from graphcam.report.arcs_report import TITLES as OF_ARCS
from graphcam.report.note import TITLES
from graphcam.words import Caption, say

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
_TOLD = {
    "acceleration": say(
        "The laws of the motion give the *shape* of the acceleration. Its scale stays open: the first ordinate is "
        "chosen, the others follow so that the displacement comes back to the axis."
    ),
    "integration": say(
        "A ray from the pole to an ordinate $y$ has the slope $y/H$; a chord parallel to it across a part $\\Delta "
        "x$ climbs by $y\\,\\Delta x/H$: the area of the part, divided by the pole distance. Twice, and the known "
        "lift fixes the scales: $\\mu_v = \\mu_s/(\\mu_\\varphi H_2)$, $\\mu_a = \\mu_v/(\\mu_\\varphi H_1)$."
    ),
    "minimum_radius": say(
        "The least radius is found before there is a cam, from displacement and velocity alone: every place of the "
        "cam centre sees them under the pressure angles that it would cause (for a flat face: acceleration takes the "
        "place of velocity, and curvature that of the angle)."
    ),
    "pressure_angle": say(
        "The velocity plan and the mechanism contain similar triangles. So the velocity $ds/d\\varphi$ is a length "
        "of the mechanism, and the angle between normal and motion is found without the profile."
    ),
    "angle_diagram": say(
        "The angles of all stations over the cam angle; the greatest lie between stations, on the curve."
    ),
    "inversion": say(
        "The cam is held still and the frame is turned round it, against its rotation. In each position the follower "
        "is moved by its displacement: the places that it takes make the cam."
    ),
    "curvature": say(
        "Three near points of a curve determine the circle that fits it best. The least radius of curvature limits "
        "the roller."
    ),
    "roller": say("The roller must stay below the least radius of curvature, and is chosen by a rule."),
    "working_profile": say("The profile is what touches all positions of the follower: the inner envelope."),
    "scheme": say("The mechanism at the start of the turn."),
    "differentiation": say(
        "The measured displacement, differentiated: a parallel to each chord through the pole cuts off the velocity "
        "in the middle of the interval. Differentiation enlarges every error of the hand."
    ),
    "force_plan": say(
        "Load, contact force and the reaction of the guide are in balance. Three directions and one size are known: "
        "a triangle."
    ),
    "three_arcs": say(
        "Where two circles touch, their centres and the point of touch lie on one line. From this alone the centres "
        "of the three arcs follow with ruler and compass."
    ),
    "arc_roller": say(
        "As long as the roller runs on one arc, cam and follower move as a crank mechanism: the crank from the cam "
        "centre to the arc's centre, the rod from there to the roller. Its plans give velocity and acceleration."
    ),
    "arc_diagrams": say(
        "What was read at the stations, over the cam angle. Where the arcs change, the acceleration jumps."
    ),
}
_NAMES = {**TITLES, **OF_ARCS, "scheme": say("Scheme of the mechanism"), "force_plan": say("Force plan")}
BACKGROUNDS: Mapping[str, tuple[Caption, Caption]] = {name: (_NAMES[name], told) for name, told in _TOLD.items()}
"""Title and background of each construction, by its name."""
