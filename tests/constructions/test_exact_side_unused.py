"""The drawn side takes nothing from the exact side: while it draws, every function of ``mechanism`` raises."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import pytest
from boards import arm_board, arm_motion, coursework, flat_board, flat_motion, limits
from over_all import over_all

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.given.laws import LAWS


class Leak(BaseException):
    """Not an Exception, so that no handler can swallow it."""


@contextmanager
def exact_side_forbidden() -> Iterator[None]:
    """Every call of a function of graphcam.mechanism raises, however the caller got hold of it."""

    def refuse(frame: FrameType, event: str, _: object) -> None:
        module = frame.f_globals.get("__name__", "")
        if event == "call" and (module == "graphcam.mechanism" or module.startswith("graphcam.mechanism.")):
            raise Leak(f"{module}.{frame.f_code.co_qualname}")

    before = sys.getprofile()
    sys.setprofile(refuse)
    try:
        yield
    finally:
        sys.setprofile(before)


def test_the_guard_catches_every_way_into_the_exact_side():
    motion = coursework().motion
    cam = gc.Cam(motion, gc.Translating(10), 50)
    for call in (
        lambda: gc.Cam(motion, gc.Translating(10), 50),
        lambda: gc.minimum_radius(motion, gc.Translating()),
        lambda: cam.pitch_curve(0.0),
        cam.extremes,
        lambda: cam.pressure_angle(0.0),
        lambda: gc.MinimumRadius(1.0, 0.0, ()),
    ):
        with exact_side_forbidden(), pytest.raises(Leak, match=r"graphcam\.mechanism"):
            call()


@over_all("law", LAWS)
def test_the_chain_and_all_its_steps_are_drawn_without_the_exact_side(law):
    with exact_side_forbidden():
        chain = Chain(coursework(law, offset=None, limits=limits(30, 40)))
        for construction in chain.values():
            construction.steps()
        assert chain.sizes.prime_radius > 0


def test_a_trembling_hand_needs_it_as_little():
    hands = gc.Pencil(line=0.2, dividers=0.2, division=0.5, protractor=math.radians(0.5), samples=10)
    with exact_side_forbidden():
        for construction in Chain(coursework("3-4-5"), hands).values():
            construction.steps()


@over_all("law", [*LAWS][::4])
def test_neither_arm_nor_flat_face_needs_it(law):
    hands = gc.Pencil(line=0.2, dividers=0.2, division=0.5, protractor=math.radians(0.5), samples=3)
    for board in (arm_board(arm_motion(law), None, limits=limits(45, 45)), flat_board(flat_motion(law))):
        for pencil in (gc.Pencil(), hands):
            with exact_side_forbidden():
                chain = Chain(board, pencil)
                for construction in chain.values():
                    construction.steps()
                assert chain.sizes.prime_radius > 0
