"""The table of a trial: a row a check, with its goal and what the photographs measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from measuring import is_bad, is_right
from scenes import RIGHT

Photo = dict[str, Any]
POINT = 0.5
"""Marks from which on a drawing was given, or lost, a point: a curve that is right in part earns a part."""
ROUNDING = 1e-6


def rows_of(records: Sequence[Photo]) -> list[dict[str, Any]]:
    """The rows of the table."""
    rows = [*_registration(records), *_curves(records), *_marks(records), *_marking(records), *_refusing(records)]
    return [*rows, *_costs(records), _reasons(records)]


def row(check: str, goal: str, value: float | None, count: int, *, met: bool | None = None) -> dict[str, Any]:
    """One row; without a value nothing was measured."""
    return {"check": check, "goal": goal, "measured": None if value is None else round(value, 4), "of": count} | (
        {} if met is None or value is None else {"met": met}
    )


def _at_most(check: str, limit: float, value: float | None, count: int, unit: str = "") -> dict[str, Any]:
    return row(check, f"<= {limit:g}{unit}", value, count, met=value is not None and value <= limit)


def _at_least(check: str, limit: float, value: float | None, count: int) -> dict[str, Any]:
    return row(check, f">= {limit:g}", value, count, met=value is not None and value >= limit)


def pooled(photos: Iterable[Photo], name: str, percent: float) -> float | None:
    """A percentile of errors over all photographs, out of the quantiles that are kept of each."""
    values = [value for photo in photos for value in photo.get(name, ())]
    return float(np.percentile(values, percent)) if values else None


def _greatest(photos: Iterable[Photo], name: str) -> float | None:
    return max((photo[name] for photo in photos if name in photo), default=None)


def _mean(values: Sequence[float]) -> float | None:
    return float(np.mean(values)) if values else None


def _part(some: int, of: int) -> float | None:
    return some / of if of else None


def _registration(records: Sequence[Photo]) -> list[dict[str, Any]]:
    seen = [photo for photo in records if "off" in photo and photo["kind"] != "too bad"]
    flat, bent = _split(seen, lambda photo: photo["bend"] == "flat")
    pairs = [photo for photo in records if "seam" in photo]
    twelve, five, scans = (_of(flat, megapixels) for megapixels in (12, 5, 0))
    return [
        _at_most("registration, flat, 12 MP: p95", 0.05, pooled(twelve, "off", 95), len(twelve), " mm"),
        _at_most("registration, flat, 12 MP: max", 0.1, _greatest(twelve, "most off"), len(twelve), " mm"),
        _at_most("registration, flat, 5 MP: p95", 0.12, pooled(five, "off", 95), len(five), " mm"),
        _at_most("registration, scans at 200 dpi: p95", 0.12, pooled(scans, "off", 95), len(scans), " mm"),
        _at_most("registration, curl or fold: p95, or refused", 0.5, pooled(bent, "off", 95), len(bent), " mm"),
        _at_most("scale at 75 mm by the measured bars: p95", 0.2, pooled(flat, "scale", 95), len(flat), " mm"),
        _at_most("two sheets of A4, at the seam: p95", 0.2, pooled(pairs, "seam", 95), len(pairs), " mm"),
        row("two sheets of A4, beyond the seam: p95", "none", pooled(pairs, "beyond", 95), len(pairs)),
    ]


def _curves(records: Sequence[Photo]) -> list[dict[str, Any]]:
    read = [photo for photo in records if "curve" in photo and (is_right(photo) or photo["kind"] == "mistake")]
    flat, bent = _split(read, lambda photo: photo["bend"] == "flat")
    shares = [photo["read"] for photo in read]
    diagrams = [photo for photo in records if photo["kind"] == "diagram" and "curve" in photo]
    return [
        _at_most("curve, flat: median", 0.1, pooled(flat, "curve", 50), len(flat), " mm"),
        _at_most("curve, flat: p95", 0.3, pooled(flat, "curve", 95), len(flat), " mm"),
        _at_most("curve, curl or fold: p95", 0.5, pooled(bent, "curve", 95), len(bent), " mm"),
        _at_least("share of the drawn curve that is read: mean", 0.95, _mean(shares), len(read)),
        _at_least("share of the drawn curve that is read: least", 0.90, min(shares, default=None), len(read)),
        _at_most("displacement curve: p95", 0.3, pooled(diagrams, "curve", 95), len(diagrams), " mm"),
    ]


def _marks(records: Sequence[Photo]) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for megapixels, goals in ((12, (0.9, 0.5, 0.25, 0.2)), (5, None)):
        photos = [photo for photo in records if photo["megapixels"] == megapixels and "marks" in photo]
        wanted, found = (sum(photo[name] for photo in photos) for name in ("marks", "found"))
        false = _mean([photo["false"] for photo in photos])
        points, crossings = (pooled(photos, name, 95) for name in ("point errors", "crossings"))
        count = sum(len(photo["crossings"]) for photo in photos)
        at = f"{megapixels} MP"
        if goals is None:
            rows += [
                row(f"plotted points, {at}: recall", "none", _part(found, wanted), wanted),
                row(f"plotted points, {at}: false ones a photograph", "none", false, len(photos)),
                row(f"plotted points, {at}: p95", "none", points, found),
                row(f"crossings at 30 degrees and more, {at}: p95", "none", crossings, count),
            ]
            continue
        rows += [
            _at_least(f"plotted points, {at}: recall", goals[0], _part(found, wanted), wanted),
            _at_most(f"plotted points, {at}: false ones a photograph", goals[1], false, len(photos)),
            _at_most(f"plotted points, {at}: p95", goals[2], points, found, " mm"),
            _at_most(f"crossings at 30 degrees and more, {at}: p95", goals[3], crossings, count, " mm"),
        ]
    return rows


def _marking(records: Sequence[Photo]) -> list[dict[str, Any]]:
    taken = [photo for photo in records if "photo" in photo]
    careful = [photo for photo in taken if photo["kind"] == "careful"]
    losing = sum(photo["photo"]["total"] < photo["typed"]["total"] - ROUNDING for photo in careful)
    rollers = [photo for photo in taken if photo["kind"] == "rollers"]
    losing_rollers = sum(photo["photo"]["total"] < photo["typed"]["total"] - ROUNDING for photo in rollers)
    wrong = [photo for photo in records if photo["kind"] == "mistake" or is_bad(photo)]
    given = sum(photo["photo"]["drawn"] >= photo["typed"]["drawn"] + POINT for photo in wrong if "photo" in photo)
    told = [photo for photo in taken if photo["kind"] == "mistake" and photo["typed"]["told"] == photo["made"]]
    right = sum(photo["photo"]["told"] == photo["made"] for photo in told)
    return [
        _at_most("careful hands losing a point by the photograph", 0.01, _part(losing, len(careful)), len(careful)),
        _at_most("the same, plotted points", 0.01, _part(losing_rollers, len(rollers)), len(rollers)),
        _at_most("wrong drawings given a point by the photograph", 0.005, _part(given, len(wrong)), len(wrong)),
        _at_least("mistakes told, where the typed answers tell them", 0.97, _part(right, len(told)), len(told)),
    ]


def _refusing(records: Sequence[Photo]) -> list[dict[str, Any]]:
    bad = [photo for photo in records if is_bad(photo)]
    accepted = sum(photo.get("photo", {}).get("outcome") == "right" for photo in bad)
    right = [photo for photo in records if is_right(photo)]
    mistakes = [photo for photo in records if photo["kind"] == "mistake"]
    rollers = [photo for photo in records if photo["kind"] == "rollers"]
    diagrams = [photo for photo in records if photo["kind"] == "diagram"]
    poor = [photo for photo in records if photo["kind"] == "too bad"]
    seen = [photo for photo in records if "whose" in photo and photo.get("refused") != "photo"]
    whose = sum(photo["whose"] for photo in seen)
    rows = [
        _at_most("what is no right drawing marked as right", 0.01, _part(accepted, len(bad)), len(bad)),
        _at_most("right drawings refused", 0.05, _part(_refused(right), len(right)), len(right)),
        row("mistakes refused", "none", _part(_refused(mistakes), len(mistakes)), len(mistakes)),
        row("displacement curves refused", "none", _part(_refused(diagrams), len(diagrams)), len(diagrams)),
        row("plotted points refused", "none", _part(_refused(rollers), len(rollers)), len(rollers)),
        row("photographs that nobody can read refused", "none", _part(_refused(poor), len(poor)), len(poor)),
        _at_least("code and marks read among accepted", 1.0, _part(whose, len(seen)), len(seen)),
        row("a second curve along right ones that are read: greatest share", "none", *_rival(records)),
    ]
    for kind in dict.fromkeys(photo["kind"] for photo in bad):
        of_kind = [photo for photo in bad if photo["kind"] == kind]
        rows.append(row(f"  {kind}: refused", "none", _part(_refused(of_kind), len(of_kind)), len(of_kind)))
    return rows


def _rival(records: Sequence[Photo]) -> tuple[float | None, int]:
    """What stands beside curves that are drawn alone: rays, digits, what an eraser left."""
    kinds = (*RIGHT, "mistake", "diagram")
    read = [photo["measures"] for photo in records if photo["kind"] in kinds and "refused" not in photo]
    shares = [measures["rival"] for measures in read if measures]
    return max(shares, default=None), len(shares)


def _costs(records: Sequence[Photo]) -> list[dict[str, Any]]:
    twelve = [photo for photo in records if photo["megapixels"] == 12 and "seconds" in photo]
    all_ = [photo for photo in records if "seconds" in photo]
    seconds, memory = ([photo[name] for photo in each] for name, each in (("seconds", twelve), ("memory", all_)))
    crashes = sum("crash" in photo for photo in records)
    return [
        _at_most("CPU a photograph of 12 MP: mean", 6, _mean(seconds), len(twelve), " s"),
        row("CPU a photograph of 12 MP: greatest", "none", max(seconds, default=None), len(twelve)),
        _at_most("memory beside the program itself: greatest", 600, max(memory, default=None), len(all_), " MB"),
        _at_most("crashes", 0, float(crashes), len(records)),
    ]


def _reasons(records: Sequence[Photo]) -> dict[str, Any]:
    """Why how many were refused."""
    reasons = Counter(f"{photo['kind']}: {photo['why']}" for photo in records if photo.get("refused"))
    return {"check": "reasons of refusals", "reasons": dict(reasons.most_common())}


def _refused(photos: Sequence[Photo]) -> int:
    return sum("refused" in photo for photo in photos)


def _split(photos: Sequence[Photo], takes: Callable[[Photo], bool]) -> tuple[list[Photo], list[Photo]]:
    return [photo for photo in photos if takes(photo)], [photo for photo in photos if not takes(photo)]


def _of(photos: Sequence[Photo], megapixels: int) -> list[Photo]:
    return [photo for photo in photos if photo["megapixels"] == megapixels]


def table_of(rows: Sequence[dict[str, Any]]) -> str:
    """The rows as a table of Markdown."""
    lines = ["| check | goal | measured | of | met |", "|---|---|---|---|---|"]
    for each in rows:
        if "reasons" in each:
            continue
        met = {True: "yes", False: "NO", None: ""}[each.get("met")]
        value = "" if each["measured"] is None else f"{each['measured']:g}"
        lines.append(f"| {each['check'].strip()} | {each['goal']} | {value} | {each['of']} | {met} |")
    return "\n".join(lines)
