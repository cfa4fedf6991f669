"""The three figures of the bench, log-log, with the curves labelled where they run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator
from numpy.typing import ArrayLike

from graphcam.bench.convergence import Series
from graphcam.bench.measuring import Report
from graphcam.given.laws import Floats
from graphcam.sheets.fonts import FAMILY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INK, GREY, FAINT, ACCENT = "#1f2328", "#7d858c", "#e7e9eb", "#b3331f"
BLUES = ("#1d4e89", "#3d85c6", "#2a9d8f")
COLOURS = ("#b3331f", "#1d4e89", "#2a9d8f", "#c77d0a", "#7b4b94", "#4d7c2f")
EPS = float(np.finfo(float).eps)
SETTINGS: dict[Any, Any] = {
    "font.family": FAMILY, "font.size": 10.0, "axes.edgecolor": GREY, "axes.labelcolor": INK, "text.color": INK,
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK, "axes.linewidth": 0.8,
    "axes.titlesize": 11.5, "axes.titleweight": "bold", "axes.titlelocation": "left", "pdf.fonttype": 42,
    "axes.spines.top": False, "axes.spines.right": False,
}  # fmt: skip
DPI = 160


def save(draw: Callable[[Report], Figure], report: Report, path: Path) -> None:
    """Write a figure as PDF and PNG beside each other."""
    with mpl.rc_context(SETTINGS):
        figure = draw(report)
        figure.savefig(path.with_suffix(".pdf"), metadata={"CreationDate": None})
        figure.savefig(path.with_suffix(".png"), dpi=DPI)


# --- error against the number of parts -------------------------------------------------------------------------------

SHOWN = (
    "displacement", "velocity", "least prime radius", "pressure angle", "working profile", "least curvature radius",
)  # fmt: skip
OTHERS = (
    ("rectangular", "least curvature radius", "curvature at a jump"),
    ("rectangular", "working profile", "profile, rectangular"),
    ("cosine", "displacement", "displacement, cosine"),
)
"""Series of the translating follower with other orders: law, quantity, what it is called in the figure."""

GUIDE_ABOVE = 3.0


def error_against_parts(report: Report) -> Figure:
    """Every follower under one law, and the other orders that there are."""
    figure = Figure(figsize=(11.5, 8.4), layout="constrained")
    panels = figure.subplots(2, 2)
    law = "3-4-5" if any(s.law == "3-4-5" for s in report.series) else report.series[0].law
    by = {(s.follower, s.law, s.quantity): s for s in report.series}
    for axes, follower, title in zip(
        panels.flat, ("translating", "arm", "flat"), ("Translating follower", "Arm", "Flat face"), strict=False
    ):
        flat = follower == "flat"
        shown = [("pitch curve" if flat and name == "working profile" else name) for name in SHOWN]
        found = [(by[follower, law, name], "profile" if flat and name == "pitch curve" else name)
                 for name in shown if (follower, law, name) in by]  # fmt: skip
        _panel_of_parts(axes, f"{title}, {law}", found, {2: 0.0})
    others = [(by["translating", law, name], label) for law, name, label in OTHERS if ("translating", law, name) in by]
    # Each guide starts as far above its curve as lets both be seen.
    guides = {round(s.order): GUIDE_ABOVE * s.errors[0] for s, _ in others if s.order}
    _panel_of_parts(panels.flat[3], "Translating follower, laws with other orders", others, guides)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    for axes in panels[1]:
        axes.set_xlabel("parts a phase, n")
    return figure


def _panel_of_parts(axes: Axes, title: str, found: Sequence[tuple[Series, str]], guides: dict[int, float]) -> None:
    """``guides`` are the lines' orders with their errors at the least n, 0 for above all curves."""
    axes.set_title(title)
    axes.set(xscale="log", yscale="log")
    parts = found[0][0].parts if found else (6, 96)
    for (series, _), colour in zip(found, COLOURS, strict=False):
        axes.plot(series.parts, np.maximum(series.errors, EPS / 4), "o-", color=colour, lw=1.6, ms=3.6)
    if not found:
        return
    greatest = max(max(series.errors) for series, _ in found)
    least = min(min(series.errors) for series, _ in found)
    if least < EPS * 100:
        _floor(axes, parts[0])
    top = 2.5 * greatest
    # Room below for the labels of curves that end close together.
    axes.set_ylim(EPS / 30 if least < EPS * 100 else least / 12, 3 * top)
    for order, start in guides.items():
        _guide(axes, parts, order, start or top)
    axes.set_xlim(parts[0] / 1.12, parts[-1] * 6.8)
    _ticks_of_parts(axes, parts)
    at = [max(series.errors[-1], EPS / 4) for series, _ in found]
    labels = [f"{label}, {_order_text(series)}" for series, label in found]
    _labels_at_the_end(axes, parts[-1], at, labels)


def _guide(axes: Axes, parts: Sequence[int], order: int, start: float) -> None:
    """A line of that order, beside the curves so that it is not mistaken for one."""
    n = np.array([parts[0], parts[-1]], dtype=float)
    axes.plot(n, start * (n / n[0]) ** -order, color=GREY, lw=0.9, ls=(0, (5, 3)), zorder=1)
    middle = float(np.sqrt(n[0] * n[1]))
    axes.text(middle * 1.06, start * (middle / n[0]) ** -order, f"order {order}", color=GREY, fontsize=9, va="bottom")


def _order_text(series: Series) -> str:
    return "exact" if series.exact else f"{series.order:.2f}" if series.order else "no order"


def _ticks_of_parts(axes: Axes, parts: Sequence[int]) -> None:
    axes.xaxis.set_major_locator(FixedLocator([n for n in (3, 6, 12, 24, 48, 96) if parts[0] <= n <= parts[-1]]))
    axes.xaxis.set_major_formatter(FuncFormatter(_plain))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(axis="y", color=FAINT, lw=0.7)
    axes.set_axisbelow(True)


def _plain(value: float, _: int | None = None) -> str:
    return f"{value:g}"


def _percent(value: float, _: int | None = None) -> str:
    return f"{value:g} %"


def _labels_at_the_end(
    axes: Axes, x: float, values: Sequence[float], labels: Sequence[str], gap: float = 0.062
) -> None:
    """Labels beside the last points, moved apart to ``gap`` of the axis and joined to their points by thin lines."""
    low, high = np.log(axes.get_ylim())
    shares = spread((np.log(values) - low) / (high - low), gap)
    for value, share, label, colour in zip(values, shares, labels, COLOURS, strict=False):
        y = float(np.exp(low + share * (high - low)))
        axes.plot([x * 1.04, x * 1.22], [value, y], color=colour, lw=0.7)
        axes.text(x * 1.27, y, label, color=colour, va="center", fontsize=9)


def spread(places: Floats, gap: float) -> Floats:
    """The places moved apart to a gap of at least ``gap``, in their order and about where they were.

    >>> spread(np.array([0.5, 0.5]), 0.1).round(3).tolist()
    [0.45, 0.55]
    """
    order = np.argsort(places, kind="stable")
    steps = gap * np.arange(places.size)
    # What is left after equal steps must not fall: pool neighbours that do (isotonic regression).
    pools: list[list[float]] = []
    for place in (places[order] - steps).tolist():
        pools.append([place])
        while len(pools) > 1 and np.mean(pools[-2]) > np.mean(pools[-1]):
            last = pools.pop()
            pools[-1] += last
    level = np.concatenate([np.full(len(pool), np.mean(pool)) for pool in pools])
    out = np.empty_like(places)
    out[order] = level + steps
    return out


def _floor(axes: Axes, x: float) -> None:
    axes.axhspan(EPS / 1e6, EPS, color=FAINT, lw=0, zorder=0)
    axes.text(x, EPS / 1.6, "ε = 2.2·10⁻¹⁶", color=GREY, va="top", fontsize=9)


# --- error against time ----------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Spot:
    """Where a method's label stands: at which of its points (0 the first, 1 the last), and how far from it [points]."""

    at: float
    away: tuple[float, float]
    align: str = "left"


QUESTIONS = {
    "displacement": "Displacement from acceleration",
    "least radius": "Least prime radius",
    "profile": "Working profile",
}
SPOTS = {
    ("displacement", "graphical"): Spot(0.72, (10, 4)),
    ("displacement", "cumulative_trapezoid"): Spot(0.5, (-9, 0), "right"),
    ("displacement", "cumulative_simpson"): Spot(0.6, (-9, 4), "right"),
    ("displacement", "CubicSpline"): Spot(0.6, (11, 0)),
    ("least radius", "graphical"): Spot(0.72, (10, 4)),
    ("least radius", "HalfspaceIntersection"): Spot(0.5, (-9, -2), "right"),
    ("least radius", "SLSQP"): Spot(0.34, (0, 10), "center"),
    ("profile", "graphical"): Spot(1.0, (8, 10)),
    ("profile", "shapely buffer"): Spot(0.5, (-9, -4), "right"),
}
NAMES = {"cumulative_trapezoid": "cumulative\ntrapezoid", "cumulative_simpson": "cumulative\nSimpson",
         "CubicSpline": "cubic spline", "HalfspaceIntersection": "half-space\nintersection", "SLSQP": "SLSQP",
         "shapely buffer": "polygon\nbuffer"}  # fmt: skip
ORDERS = {"graphical": 2, "cumulative_simpson": 4}
"""Of the methods that an order line goes with."""
LOWEST, HIGHEST = 2e-17, 0.6


def error_against_time(report: Report) -> Figure:
    """Graphical, sampled and exact answers to three questions, with floor, order lines and pencil band."""
    figure = Figure(figsize=(12.6, 5.4), layout="constrained")
    panels = figure.subplots(1, 3, sharey=True)
    times = [pairs for m in report.methods for pairs in m.pairs]
    limits = min(times) / 4, max(times) * 5
    for axes, (question, title) in zip(panels, QUESTIONS.items(), strict=True):
        axes.set(xscale="log", yscale="log", xlim=limits, ylim=(LOWEST, HIGHEST))
        axes.set_title(title, pad=34)
        axes.set_xlabel("time, in sine–cosine pairs")
        axes.yaxis.set_major_locator(LogLocator(100, numticks=12))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.grid(color=FAINT, lw=0.7)
        axes.set_axisbelow(True)
        _here(axes, report.pair)
        _panel_of_time(axes, report, question)
    panels[0].set_ylabel("relative error")
    return figure


def _here(axes: Axes, pair: float) -> None:
    """A second axis in milliseconds of this machine."""

    def milliseconds(pairs: ArrayLike) -> Floats:
        return np.asarray(pairs) * pair * 1e3

    def pairs(milliseconds: ArrayLike) -> Floats:
        return np.asarray(milliseconds) / pair / 1e3

    top = axes.secondary_xaxis("top", functions=(milliseconds, pairs))
    top.set_xlabel("ms on this machine", color=GREY, fontsize=9)
    top.xaxis.set_major_formatter(FuncFormatter(_plain))
    top.tick_params(labelsize=9, labelcolor=GREY)
    top.spines["top"].set_color(FAINT)


def _panel_of_time(axes: Axes, report: Report, question: str) -> None:
    right = axes.get_xlim()[1]
    low, high = report.bands[question]
    axes.axhspan(low, high, color=ACCENT, alpha=0.13, lw=0, zorder=0)
    axes.text(right / 1.2, high * 1.25, "by hand, pencil σ = 0.2 mm", color=ACCENT, ha="right", va="bottom", fontsize=9)
    axes.axhline(EPS, color=GREY, lw=1.0, zorder=1)
    axes.text(right / 1.2, EPS / 1.5, "floor ε", color=GREY, ha="right", va="top", fontsize=9)
    blues = iter(BLUES)
    for method in (m for m in report.methods if m.question == question):
        t, error = np.array(method.pairs), np.maximum(method.errors, EPS / 2)
        if method.kind == "exact":
            axes.plot(t, error, "D", color=INK, ms=8, zorder=5)
            axes.annotate("exact", (t[0], error[0]), xytext=(0, 10), textcoords="offset points", weight="bold",
                          ha="center", va="bottom")  # fmt: skip
            continue
        graphical = method.kind == "graphical"
        colour = ACCENT if graphical else next(blues)
        axes.plot(t, error, "o-", color=colour, lw=2.2 if graphical else 1.5, ms=4.6 if graphical else 3.4, zorder=4)
        if method.name in ORDERS:
            _order_line(axes, t, error, ORDERS[method.name])
        _label(axes, question, method.name, t, error, colour)
        if graphical:
            for n in (12, 96):
                if n in method.n:
                    k = method.n.index(n)
                    axes.annotate(f"n = {n}", (t[k], error[k]), xytext=(7, 1), textcoords="offset points", color=colour,
                                  fontsize=8.5, va="center")  # fmt: skip


def _order_line(axes: Axes, t: Floats, error: Floats, order: int) -> None:
    """The slope to which a method tends as its time grows with n, through its last point above the floor."""
    above = np.flatnonzero(error > 100 * EPS)
    if above.size == 0:
        return
    k = int(above[-1])
    ends = np.array([t[k], min(t[k] * 4.0, axes.get_xlim()[1] / 2.6)])
    line = error[k] * (ends / t[k]) ** -order
    axes.plot(ends, line, color=GREY, lw=1.0, ls=(0, (5, 3)), zorder=2)
    middle = float(np.sqrt(ends[0] * ends[1])), float(np.sqrt(line[0] * line[1]))
    axes.annotate(f"order {order}", middle, xytext=(5, 5), textcoords="offset points", color=GREY, fontsize=9)


def _label(axes: Axes, question: str, name: str, t: Floats, error: Floats, colour: str) -> None:
    spot = SPOTS.get((question, name), Spot(1.0, (8, 6)))
    k = round(spot.at * (t.size - 1))
    axes.annotate(NAMES.get(name, name), (t[k], error[k]), xytext=spot.away, textcoords="offset points", color=colour,
                  ha=spot.align, va="center", fontsize=10, weight="bold" if name == "graphical" else "normal",
                  linespacing=0.95)  # fmt: skip


# --- error of the hand -----------------------------------------------------------------------------------------------


def error_of_the_hand(report: Report) -> Figure:
    """The mean error of many hands against the number of parts, the method's own error, and the best number."""
    figure = Figure(figsize=(8.6, 5.6), layout="constrained")
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log")
    drawn_exactly = 1e-9
    ends: list[float] = []
    for k, (hands, colour) in enumerate(zip(report.hands, COLOURS, strict=False)):
        mean, method = 100 * np.array(hands.mean), 100 * np.array(hands.method)
        if k == 0:
            axes.fill_between(hands.parts, 100 * np.array(hands.low), 100 * np.array(hands.high), color=colour,
                              alpha=0.12, lw=0)  # fmt: skip
        axes.plot(hands.parts, mean, "-", color=colour, lw=2.0)
        if method.max() > drawn_exactly:
            axes.plot(hands.parts, method, color=colour, lw=1.1, ls=(0, (4, 3)))
        best = hands.parts.index(hands.best)
        axes.plot(hands.best, mean[best], "o", color=colour, ms=8, mec="white", mew=1.2, zorder=5)
        ends.append(float(mean[-1]))
    _notes_by_hand(axes, report)
    parts = report.hands[0].parts
    axes.set(xlim=(parts[0] / 1.1, parts[-1] * 4.2), ylim=(0.1, 12.0))
    _ticks_of_parts(axes, parts)
    axes.yaxis.set_major_locator(FixedLocator([0.1, 0.2, 0.5, 1, 2, 5, 10]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(_percent))
    axes.set_xlabel("parts a phase")
    axes.set_ylabel("greatest error of the displacement, of the lift")
    axes.set_title("Drawn by a hand with σ = 0.2 mm: the best number of parts")
    labels = [f"{h.law}: {h.best} parts, {100 * h.floor:.2f} %" for h in report.hands]
    _labels_at_the_end(axes, parts[-1], ends, labels, gap=0.05)
    return figure


def _notes_by_hand(axes: Axes, report: Report) -> None:
    """What band, dashes and dots are, said at the first law."""
    hands, colour = report.hands[0], COLOURS[0]
    k = len(hands.parts) * 3 // 4
    axes.text(hands.parts[k], 112 * hands.high[k], f"nine hands in ten, {hands.law}", color=colour, ha="right",
              va="bottom", fontsize=9)  # fmt: skip
    below = [(n, 100 * error) for n, error in zip(hands.parts, hands.method, strict=True) if error < hands.floor / 3]
    if below:
        axes.annotate("without the hand:\norder 2", below[0], xytext=(-16, -14), textcoords="offset points",
                      color=colour, ha="right", va="center", fontsize=9)  # fmt: skip
    axes.annotate(f"{hands.best} parts:\n{100 * hands.floor:.2f} %", (hands.best, 100 * hands.floor), xytext=(0, 14),
                  textcoords="offset points", color=colour, ha="center", va="bottom", weight="bold")  # fmt: skip
