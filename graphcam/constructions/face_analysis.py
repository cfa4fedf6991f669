"""The analysis of a given cam under a flat face on a stem, square to its motion."""

from dataclasses import replace

import numpy as np

from graphcam.constructions import cam_analysis
from graphcam.constructions.cam_analysis import Analysis, AnalysisGivens
from graphcam.drafting.euclid import UP, unit
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import Step, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.telling import run

FACE_OVERHANG = 5.0
"""How far a face is drawn beyond the place where it touches, and beyond its ray [mm of paper]."""


MEANING = replace(
    cam_analysis.MEANING,
    why=say(
        "The cam is held still and the face goes round it, against the cam's rotation. In every position the face "
        "touches the outline, and its distance from the cam centre tells how far the follower has moved."
    ),
    readings={name: cam_analysis.MEANING.readings[name] for name in ("s", "lift", "phase_angles", "rise_angle")},
)
"""Of the analysis under a face square to its motion: the pressure angle is zero, and none is measured."""


def face_analysis(givens: AnalysisGivens, pencil: Pencil) -> Analysis:
    """Bring the face to the outline square to every ray, and measure from the prime circle to the face.

    Readings: ``s``, ``lift`` [mm], the phase angles [rad]; the pressure angle is zero.
    """
    hand, mu_l = Hand(pencil, MEANING), givens.mu_l.per_mm
    points, _, prime = cam_analysis.lay_cam(hand, givens)
    motion = hand.take("motion", cam_analysis.inverted_positions(hand, givens, UP))
    starts, faces = hand.cross("starts", motion, prime), hand.tangent("faces", points, givens.outline.pieces, motion)
    feet = hand.cross("feet", faces, motion)
    s = distance_between(starts, feet, motion)
    hand.read("s", s, mu_l)
    rays = None
    if (at := cam_analysis.joints(givens)).size:
        on = hand.take("places on the joints", hand.acts["normals"], which=at)
        rays = hand.parallel("rays to the joints", on, hand.given("cam centre"))
    cam_analysis.measure_phases(hand, givens, s, UP, rays)
    cam_analysis.read_lift(hand, givens, s, mu_l)
    return hand.finished(givens, _draw, {"starts": starts, "feet": feet})


def _draw(drawn: Analysis) -> list[Step]:
    return [
        *cam_analysis.cam_steps(drawn),
        cam_analysis.circles_step(drawn, say("Prime circle")),
        _rays(drawn),
        _faces(drawn),
        *cam_analysis.phases_steps(drawn),
    ]


def _rays(drawn: Analysis) -> Step:
    motion, starts, rays = (drawn.acts[name].first for name in ("motion", "starts", "inverted positions"))
    said = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the protractor on "
        "A, divide the turn into {count} equal parts of {step}, counted {against} from the vertical, and draw and "
        "number a ray through each."
    ).with_values(**cam_analysis.position_values(drawn))
    marks = (
        Segments(cam_analysis.LINES_FROM * starts.shown, starts.shown, Role.CONSTRUCTION).left_by(motion),
        *cam_analysis.position_numbers(drawn, starts),
    )
    why = say("Seen from the cam, the follower goes round the other way and meets the same points of the cam.")
    part = run(said, say("Ray {name}"), [f"{k}" for k in range(starts.shown.size)], rays, motion)
    return Step(say("Rays of the inverted positions"), (part,), cam_analysis.view_of(drawn), marks, why=why)


def _faces(drawn: Analysis) -> Step:
    motion, faces, feet, starts = (drawn.acts[name].first for name in ("motion", "faces", "feet", "starts"))
    across = unit(feet.shown - faces.shown)
    along = np.where(np.isnan(across), unit(faces.directions), across)
    said = say(
        "On every ray slide the set square outward, with one edge along the ray and the other across it, until this "
        "edge touches the outline: it is the face. Take with the dividers the length on the ray from the prime circle "
        "to the face: it is the displacement. The longest, at position {k}: {s}."
    )
    why = say("The face is square to the motion, so its distance from the cam centre is r₀ + s.")
    beyond = FACE_OVERHANG * along
    marks = (
        Segments(faces.shown - beyond, feet.shown + beyond, Role.CONSTRUCTION).left_by(faces),
        Segments(starts.shown, feet.shown, Role.LIMIT).left_by(motion),
        faces.dots(Role.CURVE),
    )
    return cam_analysis.displacement_step(drawn, said, why, marks, faces, feet)
