"""The analysis of a given cam under an arm with a roller or a knife edge."""

import numpy as np

from graphcam.constructions import cam_analysis
from graphcam.constructions.arm_positions import arc_through
from graphcam.constructions.cam_analysis import MEANING, Analysis, AnalysisGivens
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Part, Step, say
from graphcam.drafting.marks import Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.telling import STATION, circle_caption, run
from graphcam.words import say_in


def arm_analysis(givens: AnalysisGivens, arm: float, pencil: Pencil) -> Analysis:
    """Strike the arc of the arm from every inverted pivot, and measure the angle from its lowest position.

    arm : mm

    Readings: ``s``, ``lift``, ``alpha``, the phase angles [rad].
    """
    hand, mu_l = Hand(pencil, MEANING, givens.unit), givens.mu_l.per_mm
    points, curve, prime = cam_analysis.lay_cam(hand, givens)
    circle = hand.circle("pivot circle", hand.given("cam centre"), givens.place / mu_l)
    pivots = hand.cross("pivots", cam_analysis.inverted_positions(hand, givens, RIGHT), circle)
    arcs = hand.circle("arcs of the arm", pivots, arm / mu_l)
    # To the left of the way from the cam centre to the pivot: above the line of centres.
    starts, places = (
        hand.cross("starts", prime, arcs, flat=True),
        hand.meet("places", arcs, curve),
    )
    arms = hand.join("arms", pivots, places)
    s = hand.carry(hand.angle("s", hand.join("arms at rest", pivots, starts), arms, -1))
    rays, on_joints = _on_joints(hand, givens, points, arm / mu_l)
    angles = cam_analysis.measure_phases(hand, givens, s, RIGHT, rays)
    cam_analysis.read_lift(hand, givens, s, 1.0)
    motion = hand.perpendicular("motion", arms.turned(-1), places)
    cam_analysis.measure_angles(hand, givens, motion, places, s, 1, on_joints, angles)
    return hand.finished(givens, _draw, {"starts": starts, "places": places, "pitch": points})


def _on_joints(
    hand: Hand, givens: AnalysisGivens, points: Drawn, arm: float
) -> tuple[Drawn, Drawn] | tuple[None, None]:
    """The rays to the pivot, and the line of motion, when the arm stands on the joints."""
    if not (at := cam_analysis.joints(givens)).size:
        return None, None
    on = hand.take("places on the joints", points, which=at)
    pivots = hand.cross("pivots on the joints", hand.circle("arcs to the pivot", on, arm), hand.acts["pivot circle"])
    motion = hand.perpendicular("lines on the joints", hand.join("arms on the joints", on, pivots), on)
    return hand.join("rays to the joints", hand.given("cam centre"), pivots), motion


def _draw(drawn: Analysis) -> list[Step]:
    circle, c = drawn.acts["pivot circle"], drawn.givens.place
    said = circle_caption(say_in("drawn", "the circle of the pivot about A"), "c", c, drawn.givens.mu_l.per_mm)
    mark = circle.drawn_circle(Role.CONSTRUCTION)
    return [
        *cam_analysis.cam_steps(drawn),
        cam_analysis.circles_step(drawn, say("Prime circle and pivot circle"), (Part(said, (circle,)),), (mark,)),
        _pivots(drawn),
        _displacements(drawn),
        *cam_analysis.phases_steps(drawn),
        cam_analysis.angles_step(drawn),
    ]


def _pivots(drawn: Analysis) -> Step:
    pivots, rays = (drawn.acts[name].first for name in ("pivots", "inverted positions"))
    said = say(
        "The cam turns {rotation}; hold it still and step the pivot round A the other way, {against}. Set the "
        "protractor on A, divide the pivot circle into {count} equal parts of {step}, counted {against} from the "
        "horizontal to the right of A, and number the pivots."
    ).with_values(**cam_analysis.position_values(drawn))
    marks = (
        pivots.dots(Role.CONSTRUCTION),
        pivots[0].label("C", UP * complex(pivots.shown[0])),
        *cam_analysis.position_numbers(drawn, pivots),
    )
    why = say("The frame, seen from the cam, turns against the cam's rotation, and the pivot turns with it.")
    part = run(said, STATION, [f"{k}" for k in range(pivots.shown.size)], rays, pivots)
    return Step(say("Inverted positions of the pivot"), (part,), cam_analysis.view_of(drawn), marks, why=why)


def _displacements(drawn: Analysis) -> Step:
    pivots, starts, places, arcs = (
        drawn.acts[name].first for name in ("pivots", "starts", "places", "arcs of the arm")
    )
    said = say(
        "From every pivot strike the arc of the arm across the prime circle and across the pitch curve, left of the "
        "way from A to the pivot. The angle at the pivot between these two positions of the arm is the displacement; "
        "measure it with the protractor. The largest, at position {k}: {s}."
    )
    why = say("The displacement of an arm is the angle through which it has turned from its lowest position.")
    both = np.stack([starts.shown, places.shown], axis=-1)
    marks = (
        *(arc_through(arcs[k], both[k]) for k in range(pivots.shown.size)),
        drawn.acts["arms"].first.segments(Role.CONSTRUCTION),
        places.dots(Role.CURVE),
    )
    return cam_analysis.displacement_step(drawn, said, why, marks, places, starts)
