"""What a construction leaves on the paper: readings, captions and steps."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from graphcam.drafting.hand import Hand, distance_between
from graphcam.drafting.ink import Caption, Construction, Part, Reading, Step, View, reading, say
from graphcam.drafting.marks import Line, Role
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil

BOARD = View("board", say("Board"), across="x", up="y")
LINE = Meaning("line", say("Line"), say("The shortest way."), {"length": ReadingMeaning(say("length"), "l", "mm")})


def one_line(construction: Construction) -> list[Step]:
    line = Line(np.array([0j, complex(construction.first("length"))]), Role.RESULT)
    return [
        Step(say("A line"), (Part(say("It measures {mm:.1f} mm.", mm=construction.first("length"))),), BOARD, (line,))
    ]


def drawn(pencil: Pencil) -> Construction:
    hand = Hand(pencil, LINE)
    start = hand.given("start")
    hand.read("length", distance_between(start, hand.lay_off("end", start, 1, 20.0)), 0.5)
    return hand.finished(None, one_line, {})


def test_a_value_is_scale_times_paper():
    assert reading([10.0, 20.0], 0.6, "mm").value.tolist() == [6.0, 12.0]
    assert reading(50, 0.6, "mm").value == 30.0


def test_every_sample_has_its_own_scale():
    paper = np.arange(12.0).reshape(2, 3, 2)
    scale = np.array([1.0, 10.0])
    assert_array_equal(Reading(paper, scale, "mm").value, paper * scale[:, None, None])
    assert_array_equal(Reading(paper[:, 0, 0], scale, "mm").value, [0.0, 60.0])


def test_a_caption_keeps_its_numbers_apart_from_its_words():
    caption = say("The pole lies {distance:.1f} mm to the left.", distance=40)
    assert str(caption) == "The pole lies 40.0 mm to the left."
    assert str(Caption("Полюс отстоит на {distance:.2f} мм.", caption.values)) == "Полюс отстоит на 40.00 мм."


def test_the_first_sample_is_shown():
    many = drawn(Pencil(dividers=0.2, samples=4))
    assert many.readings["length"].paper.shape == (4,)
    assert many.first("length") == many.readings["length"].paper[0]
    assert many.value("length") == many.first("length") / 2
    assert many.steps()[0].marks[0].points[1] == many.first("length")
    alone = drawn(Pencil())
    assert alone.first("length") == 20.0
    assert str(alone.steps()[0].caption) == "It measures 20.0 mm."


def test_what_is_drawn_is_not_changed_afterwards():
    construction = drawn(Pencil())
    with pytest.raises(dataclasses.FrozenInstanceError):
        construction.name = "another"
    with pytest.raises(dataclasses.FrozenInstanceError):
        construction.readings["length"].scale = 2.0
