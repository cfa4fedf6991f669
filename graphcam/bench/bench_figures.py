"""The three figures of the bench, log-log, with the curves labelled where they run."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator
from scipy.optimize import isotonic_regression

from graphcam.bench.convergence import EXACT_ERROR_LIMIT, Series
from graphcam.bench.hand_errors import Hands, PencilError
from graphcam.bench.tradeoff import Method
from graphcam.given.laws import Floats

INK, GREY, FAINT, ACCENT = "#1f2328", "#7d858c", "#e7e9eb", "#b3331f"
BLUE_SHADES = ("#1d4e89", "#3d85c6", "#2a9d8f")
COLOURS = ("#b3331f", "#1d4e89", "#2a9d8f", "#c77d0a", "#7b4b94", "#4d7c2f")
EPS = float(np.finfo(float).eps)
PLOT_SETTINGS: dict[Any, Any] = (
    dict.fromkeys(("text.color", "axes.labelcolor", "xtick.labelcolor", "ytick.labelcolor"), INK)
    | dict.fromkeys(("axes.edgecolor", "xtick.color", "ytick.color"), GREY)
    | dict.fromkeys(("axes.spines.top", "axes.spines.right"), False)
    | {"font.family": "DejaVu Sans", "font.size": 10.0, "pdf.fonttype": 42, "axes.linewidth": 0.8}
    | {"axes.titlesize": 11.5, "axes.titleweight": "bold", "axes.titlelocation": "left"}
)
DPI = 160
PLAIN_FORMATTER = FuncFormatter("{:g}".format)


def save(draw: Callable[..., Figure], path: Path, *shown: Any) -> None:
    """Write a figure as PDF and PNG beside each other."""
    with mpl.rc_context(PLOT_SETTINGS):
        figure = draw(*shown)
        figure.savefig(path.with_suffix(".pdf"), metadata={"CreationDate": None})
        # Laid out once for both.
        figure.set_layout_engine("none")
        figure.savefig(path.with_suffix(".png"), dpi=DPI)


def _note(axes: Axes, text: str, at: tuple[float, float], away: tuple[float, float], **look: Any) -> None:
    """A text at a distance [points] from a place of the diagram."""
    axes.annotate(text, at, xytext=away, textcoords="offset points", **look)


def _draw_order_guide(axes: Axes, ends: tuple[float, float], start: float, order: int) -> None:
    """A line of the order between two places of the axis, with its name."""
    low, high = ends
    axes.plot(ends, [start, start * (high / low) ** -order], color=GREY, lw=0.9, ls=(0, (5, 3)), zorder=1)
    middle = math.sqrt(low * high)
    _note(axes, f"order {order}", (middle, start * (middle / low) ** -order), (5, 5), color=GREY, fontsize=9)


def _ticks_of_parts(axes: Axes, parts: Sequence[int]) -> None:
    axes.xaxis.set_major_locator(FixedLocator([n for n in (3, 6, 12, 24, 48, 96) if parts[0] <= n <= parts[-1]]))
    axes.xaxis.set_major_formatter(PLAIN_FORMATTER)
    axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(axis="y", color=FAINT, lw=0.7)
    axes.set_axisbelow(True)


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
    order, steps = np.argsort(places, kind="stable"), gap * np.arange(places.size)
    out = np.empty_like(places)
    # What is left after equal steps must not fall.
    out[order] = isotonic_regression(places[order] - steps).x + steps
    return out


# --- error against the number of parts -------------------------------------------------------------------------------

FOLLOWER_TITLES = {"translating": "Translating follower", "arm": "Arm", "flat": "Flat face"}
SHOWN_QUANTITIES = (
    *("displacement", "velocity", "minimum prime radius", "pressure angle", "working profile"),
    "minimum radius of curvature",
)
OTHER_ORDER_SERIES = {
    ("translating", "rectangular", "minimum radius of curvature"): "curvature at a jump",
    ("translating", "rectangular", "working profile"): "profile, rectangular",
    ("translating", "cosine", "displacement"): "displacement, cosine",
}
"""What series with other orders are called in the figure: by follower, law, quantity."""
GUIDE_OFFSET_FACTOR = 3.0
"""Each guide to another order starts so many times above its curve as lets both be seen."""
Labelled = list[tuple[Series, str]]


def error_against_parts(series: Sequence[Series]) -> Figure:
    """Every follower under one law, and the other orders that there are."""
    figure = Figure(figsize=(11.5, 8.4), layout="constrained")
    panels = figure.subplots(2, 2)
    by = {(s.follower, s.law, s.quantity): s for s in series}
    laws = [law for _, law, _ in by]
    law = "3-4-5" if "3-4-5" in laws else laws[0]
    for axes, (follower, title) in zip(panels.flat, FOLLOWER_TITLES.items(), strict=False):
        # Without a roller the pitch curve is the profile.
        names = {name: name for name in SHOWN_QUANTITIES} | (
            {"working profile": "profile"} if follower == "flat" else {}
        )
        asked = [(follower, law, "pitch curve" if label == "profile" else name) for name, label in names.items()]
        found = [(by[key], label) for key, label in zip(asked, names.values(), strict=True) if key in by]
        _panel_of_parts(axes, f"{title}, {law}", found, None)
    others = [(by[key], label) for key, label in OTHER_ORDER_SERIES.items() if key in by]
    _panel_of_parts(panels.flat[3], "Translating follower, laws with other orders", others, GUIDE_OFFSET_FACTOR)
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    for axes in panels[1]:
        axes.set_xlabel("parts a phase, n")
    return figure


def _panel_of_parts(axes: Axes, title: str, found: Labelled, above: float | None) -> None:
    """``above`` : how far above each curve the guide to its order starts; None for one of order 2 above all curves."""
    axes.set_title(title)
    axes.set(xscale="log", yscale="log")
    if not found:
        return
    parts, errors = found[0][0].parts, [error for series, _ in found for error in series.errors]
    for (series, _), colour in zip(found, COLOURS, strict=False):
        axes.plot(series.parts, np.maximum(series.errors, EPS / 4), "o-", color=colour, lw=1.6, ms=3.6)
    rounded, top = min(errors) < EPS * 100, 2.5 * max(errors)
    if rounded:
        axes.axhspan(EPS / 1e6, EPS, color=FAINT, lw=0, zorder=0)
        axes.text(parts[0], EPS / 1.6, "ε = 2.2·10⁻¹⁶", color=GREY, va="top", fontsize=9)
    # Room below for the labels of curves that end close together.
    axes.set_ylim(EPS / 30 if rounded else min(errors) / 12, 3 * top)
    guides = {2: top} if above is None else {round(s.order): above * s.errors[0] for s, _ in found if s.order}
    for order, start in guides.items():
        _draw_order_guide(axes, (parts[0], parts[-1]), start, order)
    axes.set_xlim(parts[0] / 1.12, parts[-1] * 6.8)
    _ticks_of_parts(axes, parts)
    at = [max(series.errors[-1], EPS / 4) for series, _ in found]
    orders = ["exact" if s.exact else f"{s.order:.2f}" if s.order else "no order" for s, _ in found]
    _labels_at_the_end(axes, parts[-1], at, [f"{label}, {o}" for (_, label), o in zip(found, orders, strict=True)])


# --- error against time ----------------------------------------------------------------------------------------------


QUESTION_TITLES = {
    "displacement": "Displacement from acceleration",
    "minimum prime radius": "Minimum prime radius",
    "minimum prime radius, arm": "Minimum prime radius of an arm",
    "pressure angle": "Pressure angle",
    "curvature": "Minimum radius of curvature",
    "profile": "Working profile",
}
LABELS = {
    ("displacement", "graphical"): ("graphical", 0.72, (10, 4), "left"),
    ("displacement", "cumulative_trapezoid"): ("cumulative\ntrapezoid", 0.5, (-9, 0), "right"),
    ("displacement", "cumulative_simpson"): ("cumulative\nSimpson", 0.6, (-9, 4), "right"),
    ("displacement", "CubicSpline"): ("cubic spline", 0.6, (11, 0), "left"),
    ("minimum prime radius", "graphical"): ("graphical", 0.72, (10, 4), "left"),
    ("minimum prime radius", "HalfspaceIntersection"): ("half-space\nintersection", 0.5, (-9, -2), "right"),
    ("minimum prime radius", "SLSQP"): ("SLSQP", 0.34, (0, 10), "center"),
    ("minimum prime radius, arm", "graphical"): ("graphical", 0.72, (10, 4), "left"),
    ("minimum prime radius, arm", "HalfspaceIntersection"): ("half-space\nintersection", 0.5, (-9, -2), "right"),
    ("minimum prime radius, arm", "SLSQP"): ("SLSQP", 0.0, (9, 4), "left"),
    ("pressure angle", "graphical"): ("graphical", 0.72, (10, 4), "left"),
    ("pressure angle", "np.gradient"): ("np.gradient", 0.5, (-9, 0), "right"),
    ("curvature", "graphical"): ("graphical", 1.0, (8, 10), "left"),
    ("curvature", "np.gradient"): ("np.gradient", 0.5, (-9, 0), "right"),
    ("profile", "graphical"): ("graphical", 1.0, (8, 10), "left"),
    ("profile", "shapely buffer"): ("polygon\nbuffer", 0.5, (-9, -4), "right"),
}
"""Names of the methods and their places: at which point (0 the first, 1 the last), how far off [pt], how aligned."""
METHOD_ORDERS = {"graphical": 2, "cumulative_simpson": 4}
"""The orders of the methods that have a line of their order in the figure."""


def error_against_time(methods: Sequence[Method], pencils: Sequence[PencilError], pair: float) -> Figure:
    """Graphical, sampled and exact answers to six questions, with floor, order lines and what a pencil leaves."""
    figure = Figure(figsize=(12.6, 10.4), layout="constrained")
    panels = figure.subplots(2, 3, sharey=True)
    times = [pairs for m in methods for pairs in m.pairs]
    for axes, (question, title) in zip(panels.flat, QUESTION_TITLES.items(), strict=True):
        axes.set(xscale="log", yscale="log", xlim=(min(times) / 4, max(times) * 5), ylim=(2e-17, 20))
        axes.set_title(title, pad=34)
        axes.yaxis.set_major_locator(LogLocator(100, numticks=12))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.grid(color=FAINT, lw=0.7)
        axes.set_axisbelow(True)
        _time_axis(axes, pair)
        _draw_pencils(axes, [p for p in pencils if p.question == question])
        _panel_of_time(axes, [m for m in methods if m.question == question])
    for axes in panels[1]:
        axes.set_xlabel("time, in sine–cosine pairs")
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error")
    told = "Red band: scatter of drawings in 12 parts, from one pencil to the other. Short red lines: their bias."
    figure.supxlabel(told, fontsize=9, color=ACCENT)
    return figure


def _draw_pencils(axes: Axes, pencils: Sequence[PencilError]) -> None:
    """The scatter of the pencils as a band, their biases as short lines at its end, and both in figures above."""
    right = axes.get_xlim()[1] / 1.2
    axes.axhspan(pencils[0].scatter, pencils[-1].scatter, color=ACCENT, alpha=0.13, lw=0, zorder=0)
    told = [f"pencil {p.sigma_mm:g} mm: bias {100 * p.bias:.2g} %, scatter {100 * p.scatter:.2g} %" for p in pencils]
    for p in pencils:
        axes.axhline(p.bias, xmin=0.93, color=ACCENT, lw=1.0, zorder=1)
    axes.text(right, 8, "\n".join(told), color=ACCENT, ha="right", va="top", fontsize=8.5)


def _time_axis(axes: Axes, pair: float) -> None:
    """A second axis in milliseconds of this machine."""
    milliseconds, pairs = partial(np.multiply, 1e3 * pair), partial(np.multiply, 1e-3 / pair)
    top = axes.secondary_xaxis("top", functions=(milliseconds, pairs))
    top.set_xlabel("ms on this machine", color=GREY, fontsize=9)
    top.xaxis.set_major_formatter(PLAIN_FORMATTER)
    top.tick_params(labelsize=9, labelcolor=GREY)
    top.spines["top"].set_color(FAINT)


def _panel_of_time(axes: Axes, methods: Sequence[Method]) -> None:
    """The methods of one question."""
    right = axes.get_xlim()[1] / 1.2
    axes.axhline(EPS, color=GREY, lw=1.0, zorder=1)
    axes.text(right, EPS / 1.5, "floor ε", color=GREY, ha="right", va="top", fontsize=9)
    blues = iter(BLUE_SHADES)
    for method in methods:
        t, error = np.array(method.pairs), np.maximum(method.errors, EPS / 2)
        if method.kind == "sampled":
            _curve(axes, method, t, error, color=next(blues), lw=1.5, ms=3.4)
        elif method.kind == "graphical":
            _curve(axes, method, t, error, color=ACCENT, lw=2.2, ms=4.6)
            for k in (method.n.index(n) for n in (12, 96) if n in method.n):
                # Where the curve runs on to the right the number stands on the left.
                on = t[min(k + 1, t.size - 1)] > 1.5 * t[k]
                look = {"color": ACCENT, "fontsize": 8.5, "va": "center", "ha": "right" if on else "left"}
                _note(axes, f"n = {method.n[k]}", (t[k], error[k]), (-7 if on else 7, 1), **look)
        else:
            axes.plot(t, error, "D", color=INK, ms=8, zorder=5)
            _note(axes, "exact", (t[0], error[0]), (0, 10), weight="bold", ha="center", va="bottom")


def _curve(axes: Axes, method: Method, t: Floats, error: Floats, **look: Any) -> None:
    """A method's points, joined, its name, and the slope to which it tends as its time grows with n."""
    axes.plot(t, error, "o-", zorder=4, **look)
    above = np.flatnonzero(error > 100 * EPS)
    # Where the error falls no more there is no order.
    if method.name in METHOD_ORDERS and above.size and error[k := int(above[-1])] < error[k - 1] / 2:
        _draw_order_guide(axes, (t[k], min(4 * t[k], axes.get_xlim()[1] / 2.6)), error[k], METHOD_ORDERS[method.name])
    name, place, away, align = LABELS[method.question, method.name]
    at, weight = round(place * (t.size - 1)), "bold" if method.kind == "graphical" else "normal"
    look = {"color": look["color"], "ha": align, "va": "center", "weight": weight, "linespacing": 0.95}
    _note(axes, name, (t[at], error[at]), away, fontsize=10, **look)


# --- error of the hand -----------------------------------------------------------------------------------------------


def error_of_the_hand(every: Sequence[Hands]) -> Figure:
    """The mean error of many hands against the number of parts, the method's own error, and the best number."""
    figure = Figure(figsize=(8.6, 5.6), layout="constrained")
    axes = figure.subplots()
    axes.set(xscale="log", yscale="log")
    for hands, colour in zip(every, COLOURS, strict=False):
        axes.plot(hands.parts, 100 * np.array(hands.mean), "-", color=colour, lw=2.0)
        if max(hands.method) > EXACT_ERROR_LIMIT:
            axes.plot(hands.parts, 100 * np.array(hands.method), color=colour, lw=1.1, ls=(0, (4, 3)))
        axes.plot(hands.best_parts, 100 * hands.floor, "o", color=colour, ms=8, mec="white", mew=1.2, zorder=5)
    _draw_band_with_notes(axes, every[0], COLOURS[0])
    parts = every[0].parts
    axes.set(xlim=(parts[0] / 1.1, parts[-1] * 4.2), ylim=(0.1, 12.0))
    _ticks_of_parts(axes, parts)
    axes.yaxis.set_major_locator(FixedLocator([0.1, 0.2, 0.5, 1, 2, 5, 10]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter("{:g} %".format))
    axes.set_xlabel("parts a phase")
    axes.set_ylabel("maximum error of the displacement, of the lift")
    axes.set_title("Drawn with a pencil of σ = 0.2 mm: the best number of parts")
    labels = [f"{h.law}: {h.best_parts} parts, {100 * h.floor:.2f} %" for h in every]
    _labels_at_the_end(axes, parts[-1], [100 * h.mean[-1] for h in every], labels, gap=0.05)
    return figure


def _draw_band_with_notes(axes: Axes, hands: Hands, colour: str) -> None:
    """Draw the range of nine drawings in ten under one law, with notes on it, on the dashes and on the dot."""
    high, k = 100 * np.array(hands.high), len(hands.parts) * 3 // 4
    axes.fill_between(hands.parts, 100 * np.array(hands.low), high, color=colour, alpha=0.12, lw=0)
    band = f"nine drawings in ten, {hands.law}"
    axes.text(hands.parts[k], 1.12 * high[k], band, color=colour, ha="right", va="bottom", fontsize=9)
    below = [(n, 100 * error) for n, error in zip(hands.parts, hands.method, strict=True) if error < hands.floor / 3]
    if below:
        without = "ideal pencil:\norder 2"
        _note(axes, without, below[0], (-16, -14), color=colour, ha="right", va="center", fontsize=9)
    best, floor = hands.best_parts, 100 * hands.floor
    look = {"color": colour, "ha": "center", "va": "bottom", "weight": "bold"}
    _note(axes, f"{best} parts:\n{floor:.2f} %", (best, floor), (0, 14), **look)
