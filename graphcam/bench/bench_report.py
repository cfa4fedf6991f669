"""The whole report: what is measured with how much effort, and the same as plain data for strict JSON."""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from functools import partial
from typing import Any

from graphcam.bench.bound_rows import BOUNDS
from graphcam.bench.convergence import PARTS, Series, convergence
from graphcam.bench.exact_rows import EXACT
from graphcam.bench.hand_errors import PARTS as PENCIL_PARTS, SIGMA, BudgetRow, Hands, bands, budgets, by_hand
from graphcam.bench.load_rows import LOADS
from graphcam.bench.measured_rows import MEASURED
from graphcam.bench.peers import Peer, peers
from graphcam.bench.rows import BenchRow, Gauge, Section
from graphcam.bench.scenes import BENCH_LAWS, FOLLOWERS, scene
from graphcam.bench.solve_rows import WAITING
from graphcam.bench.studio_rows import STUDIO
from graphcam.bench.sweep_curve import CURVE, SIZES as SWEPT
from graphcam.bench.timing import Timer
from graphcam.bench.tradeoff import LAW, Method, TimedSizes, tradeoff
from graphcam.words import Words, say

SECTIONS: tuple[Section, ...] = (EXACT, LOADS, BOUNDS, MEASURED, WAITING, STUDIO, CURVE)
"""The tables of measured figures and goals, in order."""
DRAWN_PARTS, DRAWN_LAW = 12, "3-4-5"


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
        chain = scene(follower, DRAWN_LAW).chain(DRAWN_PARTS)
        for name in chain:
            # The function itself draws anew, from constructions that the chain keeps.
            readings, steps = timer.seconds(partial(chain.own[name], chain)), timer.seconds(chain[name].steps)
            found.append(DrawingTime(follower, name, readings / pair, steps / pair))
    return found


PAIR_STATIONS = 100_000
"""Sines and cosines over which the unit of time is measured."""


@dataclass(frozen=True)
class Effort:
    """How much is measured: parts, hands, stations, seconds for every measurement of a time, designs of sweeps."""

    parts: tuple[int, ...]
    laws: tuple[str, ...]
    hands: int
    pencil_parts: tuple[int, ...]
    sizes: TimedSizes
    law_stations: int
    cam_stations: int
    budget: float
    swept: tuple[int, ...] = ()


STEP_BY_FOUR = (6, 12, 24, 48, 96, 384, 1536, 6144, 24576, 98304)
"""Parts, each time twice and then four times as many."""
STEP_BY_THREE = (12, 36, 120, 360, 1080, 3240, 9720, 29160)
CORNERS = (24, 96, 360, 1440, 5760, 23040)
FULL = Effort(
    *(PARTS, BENCH_LAWS, 2000, PENCIL_PARTS),
    TimedSizes(STEP_BY_FOUR, STEP_BY_FOUR[:7], STEP_BY_FOUR, STEP_BY_THREE, STEP_BY_THREE[:4], CORNERS),
    *(100_000, 1_000_000, 0.2, SWEPT),
)
FEWER = replace(FULL.sizes, graphical=STEP_BY_FOUR[:8], profile=STEP_BY_FOUR[:6], integrators=STEP_BY_FOUR[:9])
FEWEST = replace(FEWER, half_planes=STEP_BY_THREE[:6], buffer=CORNERS[:5])
QUICK = replace(FULL, hands=1000, budget=0.02, swept=(), sizes=FEWEST)


@dataclass(frozen=True)
class Report:
    """Everything that was measured.

    pair : the time of one sine and one cosine on this machine [s], the unit of all times
    bands : between which relative errors nine hands in ten stay, by the question of the methods
    rows : figures and goals, by the keys of the sections
    budgets : what makes the readings of every follower scatter
    rendering : times of laying out and rendering the sheet of the built-in task, in pairs
    """

    pair: float
    series: tuple[Series, ...]
    hands: tuple[Hands, ...]
    bands: Mapping[str, tuple[float, float]]
    budgets: tuple[BudgetRow, ...]
    methods: tuple[Method, ...]
    rows: Mapping[str, tuple[BenchRow, ...]]
    peers: tuple[Peer, ...]
    drawing: tuple[DrawingTime, ...]
    rendering: Mapping[str, float]

    def to_dict(self) -> dict[str, Any]:
        """Ratios and errors as plain data: times are in sine-cosine pairs, no seconds are kept."""
        return _plain(
            {
                "unit_of_time": "one sine and one cosine of 1e5, in the same run",
                "convergence": [
                    asdict(s) | {"exact": s.exact, "order": s.order, "n2_error": s.constant} for s in self.series
                ],
                "pencil": [
                    asdict(h) | {"sigma_mm": SIGMA, "best_parts": h.best, "floor": h.floor, "band": list(h.band)}
                    for h in self.hands
                ],
                "pencil_bands": dict(self.bands),
                "error_budgets": [asdict(b) for b in self.budgets],
                "error_against_time": [asdict(m) for m in self.methods],
                **{key: [_without_seconds(row) for row in rows] for key, rows in self.rows.items()},
                "peers": [asdict(p) for p in self.peers],
                "drawing": [asdict(d) for d in self.drawing],
                "rendering": dict(self.rendering),
            }
        )


def measure(
    effort: Effort, rendering: Callable[[Timer], Mapping[str, float]], progress: Callable[[Words], None]
) -> Report:
    """Measure everything; ``rendering`` gives the times of the sheet [s], which this side knows nothing of."""
    timer = Timer(effort.budget)
    pair = timer.pairs(PAIR_STATIONS) / PAIR_STATIONS
    progress(say("error against the number of parts"))
    series = tuple(convergence(effort.parts, effort.laws))
    progress(say("drawing error"))
    hands = tuple(by_hand(law, effort.hands, effort.pencil_parts) for law in effort.laws)
    hands_of = bands(LAW, effort.hands), tuple(budgets(LAW))
    progress(say("error against time"))
    methods = tuple(tradeoff(effort.sizes, timer, pair))
    gauge = Gauge(timer, effort.law_stations, effort.cam_stations, effort.swept)
    rows: dict[str, tuple[BenchRow, ...]] = {}
    for section in SECTIONS:
        progress(section.title.lower())
        rows[section.key] = tuple(section.measured(gauge))
    progress(say("other packages"))
    others = tuple(peers(timer))
    progress(say("readings and steps"))
    drawing = tuple(drawing_times(timer, pair))
    progress(say("rendering"))
    rendered = {name: seconds / pair for name, seconds in rendering(timer).items()}
    return Report(pair, series, hands, *hands_of, methods, rows, others, drawing, rendered)


def _without_seconds(row: BenchRow) -> dict[str, Any]:
    return {key: value for key, value in asdict(row).items() if key != "seconds"} | {"goal_met": row.goal_met}


def _plain(value: Any) -> Any:
    """Lists, dictionaries and numbers; None for what is not finite."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
