"""The analysis of a given cam under a stem with a roller or a knife edge, central or offset."""

import numpy as np

from graphcam.constructions import cam_analysis
from graphcam.constructions.cam_analysis import MEANING, Analysis, AnalysisGivens
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import Part, Step, say
from graphcam.drafting.marks import Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.telling import STATION, circle_caption, run
from graphcam.given.follower import sense
from graphcam.words import say_in


def stem_analysis(givens: AnalysisGivens, pencil: Pencil) -> Analysis:
    """Draw the line of the stem in its inverted positions, and measure from the prime circle to the pitch curve.

    Readings: ``s``, ``lift`` [mm], ``alpha``, the phase angles [rad].
    """
    hand, mu_l, e = Hand(pencil, MEANING), givens.mu_l.per_mm, givens.place
    points, curve, prime = cam_analysis.lay_cam(hand, givens)
    base = RIGHT * np.sign(e) if e else UP
    if e:
        hand.circle("offset circle", hand.given("cam centre"), abs(e) / mu_l)
    rays = cam_analysis.inverted_positions(hand, givens, base)
    motion = hand.take("motion", rays)
    if e:
        feet = hand.lay_off("feet", rays, rays, abs(e) / mu_l)
        motion = hand.take("motion", hand.perpendicular("tangents to the circle", rays.turned(np.sign(e)), feet))
    starts, places = hand.cross("starts", motion, prime), hand.meet("places", motion, curve)
    s = distance_between(starts, places, motion)
    hand.read("s", s, mu_l)
    rays, on_joints = _on_joints(hand, givens, points)
    angles = cam_analysis.measure_phases(hand, givens, s, base, rays)
    cam_analysis.read_lift(hand, givens, s, mu_l)
    cam_analysis.measure_angles(hand, givens, motion, places, s, sense(givens.rotation), on_joints, angles)
    return hand.finished(givens, _draw, {"starts": starts, "places": places, "pitch": points})


def _on_joints(hand: Hand, givens: AnalysisGivens, points: Drawn) -> tuple[Drawn, Drawn] | tuple[None, None]:
    """The rays to the line of the stem, to its feet where it is offset, and the line, when it stands on the joints."""
    if not (at := cam_analysis.joints(givens)).size:
        return None, None
    centre, on = hand.given("cam centre"), hand.take("places on the joints", points, which=at)
    if not givens.place:
        rays = hand.join("rays to the joints", centre, on)
        return rays, rays
    # The tangent from a place to a circle: its foot lies on the circle over the way to the centre (Thales).
    middles = hand.divide("middles", centre, on, 0.5)
    circles = hand.circle("circles of Thales", middles, distance_between(centre, middles))
    offset = hand.acts["offset circle"]
    feet = hand.cross("feet on the joints", *((circles, offset) if givens.place > 0 else (offset, circles)))
    return hand.join("rays to the joints", centre, feet), hand.join("lines on the joints", feet, on)


def _draw(drawn: Analysis) -> list[Step]:
    return [
        *cam_analysis.cam_steps(drawn),
        _circles(drawn),
        _positions(drawn),
        _displacements(drawn),
        *cam_analysis.phases_steps(drawn),
        cam_analysis.angles_step(drawn),
    ]


def _circles(drawn: Analysis) -> Step:
    circle, e = drawn.acts.get("offset circle"), drawn.givens.place
    if circle is None:
        return cam_analysis.circles_step(drawn, say("Prime circle"))
    said = circle_caption(say_in("drawn", "the offset circle about A"), "|e|", abs(e), drawn.givens.mu_l.per_mm)
    title, mark = say("Prime circle and offset circle"), circle.drawn_circle(Role.CONSTRUCTION)
    return cam_analysis.circles_step(drawn, title, (Part(said, (circle,)),), (mark,))


def _positions(drawn: Analysis) -> Step:
    motion, starts, places = (drawn.acts[name].first for name in ("motion", "starts", "places"))
    inner = drawn.acts["feet"].shown if drawn.givens.place else cam_analysis.LINES_FROM * starts.shown
    said = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the protractor on "
        "A, divide the turn into {count} equal parts of {step}, counted {against} from the line of the stem, and draw "
        "and number its position at each."
    )
    if drawn.givens.place:
        said = say(
            "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the "
            "protractor on A, divide the offset circle into {count} equal parts of {step}, counted {against} from its "
            "point on the line of the stem, and draw and number the tangent at each, as the line of the stem runs."
        )
    lines = Segments(inner, places.shown, Role.CONSTRUCTION).left_by(motion)
    marks = (lines, *cam_analysis.position_numbers(drawn, starts))
    why = say("Only the motion relative to the cam matters: the stem goes round it and stays on its own line.")
    names = [f"{k}" for k in range(starts.shown.size)]
    rays = drawn.acts["inverted positions"].first
    part = run(said.with_values(**cam_analysis.position_values(drawn)), STATION, names, rays, motion)
    title = say("Inverted positions of the follower's line")
    return Step(title, (part,), cam_analysis.view_of(drawn), marks, why=why)


def _displacements(drawn: Analysis) -> Step:
    motion, starts, places = (drawn.acts[name].first for name in ("motion", "starts", "places"))
    said = say(
        "In every position take with the dividers the length from the prime circle to the pitch curve: it is the "
        "displacement. The longest, at position {k}: {s}."
    )
    why = say("At the start of the rise the centre of the roller, or the edge, lies on the prime circle.")
    marks = (Segments(starts.shown, places.shown, Role.LIMIT).left_by(motion), places.dots(Role.CURVE))
    return cam_analysis.displacement_step(drawn, said, why, marks, places, starts)
