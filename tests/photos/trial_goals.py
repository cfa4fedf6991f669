"""What a few photographs, other ones than those of the record, can show of the goals."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
from figures import pooled, rows_of
from measuring import is_bad, is_right, measured
from printed_courses import CourseKind
from scenes import scene_of

SEED = 4
"""Not that of the record."""
COURSES = (
    CourseKind("inversion-translating", "A3", "colour", ("17", "18")),
    CourseKind("inversion-translating", "A4", "grey", ("17", "18")),
    CourseKind("inversion-arm", "A3", "colour", ("17", "18")),
)
"""Fewer than those of the record: courses and prints take longer than a few photographs."""
Photo = dict[str, Any]


def shared_scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that all processes of one run share, so that courses are made once."""
    base = tmp_path_factory.getbasetemp()
    return (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "photographs"


def photographs(numbers: Iterable[int], scratch: Path) -> list[Photo]:
    """What is found out by photographs."""
    return [measured(scene_of(number, SEED, scratch, COURSES), scratch) for number in numbers]


def check_goals(photos: list[Photo]) -> None:
    """Hold photographs against the goals."""
    assert not [photo["crash"] for photo in photos if "crash" in photo]
    accepted = [photo for photo in photos if "whose" in photo and photo.get("refused") != "photo"]
    assert all(photo["whose"] for photo in accepted)
    _registration(accepted)
    for photo in photos:
        if is_bad(photo):
            assert photo.get("photo", {}).get("outcome") != "right", photo
        if photo["kind"] == "careful" and "photo" in photo:
            assert photo["photo"]["total"] >= photo["typed"]["total"], photo
        if photo["kind"] == "mistake" and "photo" in photo and photo["typed"]["told"] == photo["made"]:
            assert photo["photo"]["told"] == photo["made"], photo
    right = [photo for photo in photos if is_right(photo)]
    # One in twenty may be refused; of a few photographs one more.
    assert sum("refused" in photo for photo in right) <= 1 + 0.05 * len(right), right
    for photo in photos:
        if "read" in photo and (is_right(photo) or photo["kind"] == "mistake"):
            assert photo["read"] >= 0.90, photo
    assert {row["check"] for row in rows_of(photos)}


def _registration(photos: list[Photo]) -> None:
    """Registration and curves, of which every photograph has hundreds of places."""
    usual = [photo for photo in photos if photo["kind"] != "too bad"]
    flat = [photo for photo in usual if photo["bend"] == "flat"]
    sharp = [photo for photo in flat if photo["megapixels"] == 12]
    curves = [photo for photo in flat if is_right(photo) or photo["kind"] == "mistake"]
    bent = [photo for photo in usual if photo["bend"] != "flat"]
    for some, name, percent, most in (
        (sharp, "off", 95, 0.05),
        (flat, "off", 95, 0.12),
        (bent, "off", 95, 0.5),
        (flat, "scale", 95, 0.2),
        (curves, "curve", 50, 0.1),
        (curves, "curve", 95, 0.3),
    ):
        measured_ = pooled(some, name, percent)
        assert measured_ is None or measured_ <= most, (name, percent, measured_)
