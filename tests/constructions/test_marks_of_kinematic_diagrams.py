"""The kinematic diagram: a sketch of the task that tells its data, and nothing that is to be found."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from boards import arm_board, arm_motion, coursework, flat_board, flat_motion, limits
from over_all import over_all

from graphcam.constructions.chain import Chain
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dimension, Dots, Label, Line, Role, Segments

BOARDS = {
    "offset": coursework(),
    "offset open": replace(coursework(roller_radius=12.0), follower=DrawnTranslating(None)),
    "ccw, to the right": replace(coursework(rotation="ccw", prime_radius=50.0), follower=DrawnTranslating(8.0)),
    "central": replace(coursework(limits=limits(25, 60)), follower=DrawnTranslating(0.0)),
    "knife edge": coursework(roller_radius=0.0),
    "arm": arm_board(arm_motion("3-4-5")),
    "arm, all open": arm_board(arm_motion("cosine"), None, rotation="cw"),
    "arm, knife edge": arm_board(arm_motion("cosine"), roller_radius=0.0),
    "flat": flat_board(flat_motion("3-4-5")),
}
every = over_all("name", BOARDS)
EXACT = 1e-9


def diagram(name):
    (step,) = Chain(BOARDS[name]).scheme.steps()
    return step


def of(name, kind, role=None):
    return [m for m in diagram(name).marks if isinstance(m, kind) and (role is None or m.role is role)]


def texts(name):
    return {str(mark.text) for mark in of(name, (Label, Dimension))}


def place(name, text):
    (label,) = (label for label in of(name, Label) if str(label.text) == text)
    return label.at


def sigma(name):
    return 1 if BOARDS[name].rotation == "ccw" else -1


@every
def test_it_is_given_and_nothing_in_it_was_found(name):
    step = diagram(name)
    assert step.marks == step.given
    assert step.own_marks == ()
    board = BOARDS[name]
    # Whatever the other sizes come to, it is the same.
    other = replace(board, limits=limits(20, 50), divisions=8)
    (again,) = Chain(other).scheme.steps()
    assert [repr(mark) for mark in again.marks] == [repr(mark) for mark in step.marks]


@every
def test_it_is_the_first_construction(name):
    assert next(iter(Chain(BOARDS[name]))) == "scheme"


@every
def test_the_cam_is_two_circles_with_their_common_tangents(name):
    base, nose = of(name, Arc, Role.RESULT)
    (flanks,) = of(name, Segments, Role.RESULT)
    assert base.centre == 0
    assert base.radius > nose.radius
    assert flanks.starts.size == 2
    for start, end in zip(flanks.starts, flanks.ends, strict=True):
        assert abs(start) == pytest.approx(base.radius)
        assert abs(end - nose.centre) == pytest.approx(nose.radius)
        for centre, touch in ((0, start), (nose.centre, end)):
            assert ((end - start) * np.conj(touch - centre)).real == pytest.approx(0, abs=EXACT)
    for arc, ends in ((base, flanks.starts), (nose, flanks.ends)):
        assert {complex(np.round(arc.centre + cmath.rect(arc.radius, at), 9)) for at in (arc.start, arc.end)} == {
            complex(np.round(end, 9)) for end in ends
        }
    # They go round the back of the base circle, and round the tip of the nose.
    assert cmath.rect(1, (base.start + base.end) / 2) == pytest.approx(-nose.centre / abs(nose.centre))
    assert cmath.rect(1, (nose.start + nose.end) / 2) == pytest.approx(nose.centre / abs(nose.centre))


@every
def test_the_follower_stands_low_and_the_cam_turns_its_nose_under_it(name):
    b, (base, nose) = place(name, "B"), of(name, Arc, Role.RESULT)
    rollers = [circle for circle in of(name, Circle) if circle.centre == b]
    assert len(rollers) == ("knife edge" not in name and name != "flat")
    assert abs(b) == pytest.approx(base.radius + sum(roller.radius for roller in rollers))
    assert abs(b - nose.centre) > nose.radius + sum(roller.radius for roller in rollers) + 5
    touch = cmath.phase(b)
    assert (touch - base.start) % (2 * math.pi) < base.end - base.start, "on the base circle, not beside it"
    turned = nose.centre * cmath.exp(1j * sigma(name) * math.radians(120))
    assert cmath.phase(turned) == pytest.approx(touch)
    (arrow,) = (arc for arc in of(name, Arc, Role.CURVE) if arc.centre == 0)
    assert arrow.arrow == ("end" if sigma(name) > 0 else "start")
    assert arrow.radius < base.radius
    omega = place(name, "ω")
    assert abs(omega) == pytest.approx(arrow.radius)
    assert cmath.phase(omega) == pytest.approx((arrow.start + arrow.end) / 2)


@every
def test_the_points_and_bearings_are_named(name):
    assert place(name, "A") == 0
    hinges = {circle.centre for circle in of(name, Circle) if circle.radius == 1.2}
    assert hinges == ({0, place(name, "C")} if "arm" in name else {0})
    supports = [line.points for line in of(name, Line, Role.CURVE) if line.points.size == 4]
    for hinge, support in zip(sorted(hinges, key=abs), supports, strict=True):
        np.testing.assert_allclose(support - hinge, [-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j])


@over_all("name", [name for name in BOARDS if "arm" not in name])
def test_a_stem_slides_in_its_guide_on_the_line_of_motion(name):
    b = place(name, "B")
    (motion, *upright), (arrow,) = of(name, Line, Role.AXIS), of(name, Arrow)
    assert set(motion.points.real) == {b.real}
    assert motion.points[0].imag < -16 < b.imag + 30 < motion.points[1].imag
    walls = [
        line.points - b for line in of(name, Line, Role.CURVE) if line.points.size == 2 and np.ptp(line.points.imag)
    ]
    stem, left, right = walls
    assert (stem[0], stem[1].real) == (0, 0)
    np.testing.assert_allclose([*left.real, *right.real], [-2.2, -2.2, 2.2, 2.2])
    assert stem[1].imag > left[1].imag > left[0].imag > 5
    for wall, strokes in zip((left, right), of(name, Segments, Role.HATCH)[1:], strict=True):
        np.testing.assert_allclose(strokes.starts.real - b.real, wall[0].real)
        assert ((strokes.ends - strokes.starts).real * wall[0].real > 0).all(), (
            "the frame is hatched away from the stem"
        )
    assert arrow.end - arrow.start == pytest.approx(8j)
    offset = {"offset": -1, "offset open": -1, "ccw, to the right": 1, "knife edge": -1}.get(name, 0)
    assert np.sign(b.real) == offset
    dimensions = of(name, Dimension)
    assert len(upright) == len(dimensions) == abs(offset)
    for line, dimension in zip(upright, dimensions, strict=True):
        assert set(line.points.real) == {0}
        assert {dimension.start.real, dimension.end.real} == {0, b.real}


@over_all("name", ["arm", "arm, all open", "arm, knife edge"])
def test_the_arm_joins_its_end_to_the_pivot_and_rises_away_from_the_cam(name):
    b, c = place(name, "B"), place(name, "C")
    (rod,) = (line for line in of(name, Line, Role.CURVE) if line.points.size == 2)
    assert tuple(rod.points) == (b, c)
    assert tuple(of(name, Line, Role.AXIS)[0].points) == (0, c)
    (swing,) = (arc for arc in of(name, Arc) if arc.centre == c)
    assert swing.radius == pytest.approx(abs(b - c))
    tip = c + cmath.rect(swing.radius, swing.start if swing.arrow == "start" else swing.end)
    assert abs(tip) > abs(b) + 1
    # The tip of a knife edge is the trace point.
    wedges = [line.points[1] for line in of(name, Line, Role.CURVE) if line.closed]
    assert complex(wedges[0] if wedges else of(name, Dots)[0].points[0]) == b


SIZES = {
    "offset": {"e = 10", "r"},
    "offset open": {"e", "r = 12"},
    "ccw, to the right": {"e = 8", "r"},
    "central": {"r"},
    "knife edge": {"e = 10"},
    "arm": {"l = 100", "c = 120", "r"},
    "arm, all open": {"l = 100", "c", "r"},
    "arm, knife edge": {"l = 100", "c = 120"},
    "flat": set(),
}


@every
def test_sizes_that_are_given_bear_their_numbers_and_the_others_their_symbols(name):
    roller = {"3"} if any(size[0] == "r" for size in SIZES[name]) else set()
    assert texts(name) - {"A", "B", "C", "ω"} == SIZES[name] | {"0", "1", "2"} | roller
    assert of(name, AngleMark) == []


CAPTIONS = {
    "offset": (
        r"clockwise about A .* roller .*on the left, at the offset e = -10 mm\. One turn of the cam: rise φ₁ = 80° by "
        r"30 mm \(law: rectangular\); dwell φ₂ = 45°; return φ₃ = 60° by 30 mm \(law: rectangular\); dwell φ₄ = 175°\. "
        r".* at most 30° on a rise; .* not limited\. To be found: prime radius r₀, roller radius r and the profile"
    ),
    "offset open": r"turns about B\. The roller radius is r = 12 mm\. .*To be found: prime radius r₀, offset e and ",
    "ccw, to the right": r"anticlockwise .*on the right, at the offset e = 8 mm\. The prime radius is r₀ = 50 mm\.",
    "central": r"passes through A\. .* at most 25° on a rise and 60° on a return\.",
    "knife edge": r"its knife edge is B\. .*To be found: prime radius r₀ and the profile of the cam\.$",
    "arm": (
        r"The arm is l = 100 mm long\. The pivot is c = 120 mm from A\. One .*rise φ₁ = 90° by 20° \(law: 3-4-5\);.* "
        r"at most 45°.*To be found: prime radius r₀, roller radius r and the profile of the cam\.$"
    ),
    "arm, all open": r"^The cam turns clockwise .*found: prime radius r₀, centre distance c, roller radius r and ",
    "arm, knife edge": r"the knife edge on it is B\. .*To be found: prime radius r₀ and the profile of the cam\.$",
    "flat": r"flat-faced .*at least 8 mm\. To be found: prime radius r₀ and the profile of the cam\.$",
}


@every
def test_the_caption_tells_the_data_and_what_is_to_be_found(name):
    said = str(diagram(name).caption)
    assert re.search(CAPTIONS[name], said), said
    assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(diagram(name).why))
