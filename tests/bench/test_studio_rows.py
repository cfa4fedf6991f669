"""The section on the studio measures what a drag asks for: another task each time, in every view."""

import pytest

import graphcam as gc
from graphcam.bench.rows import Gauge
from graphcam.bench.studio_rows import dragging, studio_rows
from graphcam.bench.timing import Timer
from graphcam.studio.task_text import plain_task


def test_every_picture_of_a_drag_is_another_one():
    again = dragging(plain_task(gc.builtin_task()), "combined")
    first, second = (again()["sizes"]["offset"] for _ in range(2))
    assert first != second


@pytest.mark.slow
def test_every_view_of_every_task_has_a_row():
    rows = list(studio_rows(Gauge(Timer(0.0, least_runs=1), 0, 0)))
    assert {row.what.partition(",")[0] for row in rows} == {"coursework", "arm", "flat", "measured", "arcs"}
    assert len(rows) == 9 + 10 + 6 + 12 + 8
    assert all(row.unit == "ms" and row.ratio == 1e3 * row.seconds > 0 for row in rows)
