"""What a drawing costs: the readings of each construction alone, and its steps apart."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from graphcam.bench.scenes import FOLLOWERS, scene
from graphcam.bench.timing import Timer
from graphcam.constructions.chain import Chain

PARTS = 12
LAW = "3-4-5"


@dataclass(frozen=True)
class DrawingTime:
    """Times of one construction in sine-cosine pairs; what it starts from is drawn before."""

    follower: str
    construction: str
    readings: float
    steps: float


def drawing_times(timer: Timer, pair: float) -> list[DrawingTime]:
    """Every construction of every follower in 12 parts; ``pair`` is the time of one sine and one cosine [s]."""
    found: list[DrawingTime] = []
    for follower in FOLLOWERS:
        chain = scene(follower, LAW).chain(PARTS)
        for name in chain:
            # The property's own function draws anew, from constructions that the chain keeps.
            draw = vars(Chain)[name].func
            construction = chain[name]
            readings, steps = timer.seconds(partial(draw, chain)), timer.seconds(construction.steps)
            found.append(DrawingTime(follower, name, readings / pair, steps / pair))
    return found
