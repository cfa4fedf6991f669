"""Drawings that LibreCAD made, of the parts that come with it, are read as outlines, or it is told what they lack."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from programs import program

import graphcam as gc
from graphcam.errors import TaskError
from graphcam.tasks.outline_file import outline_from_dxf


def library() -> Path:
    return Path(program("librecad")).parents[1] / "share" / "librecad" / "library"


def test_an_ellipse_of_librecad_moves_its_follower(tmp_path: Path) -> None:
    """Semi-axes of 400 and 300 mm; at the cam angle 0 the long one lies across the follower."""
    drawn = (library() / "plan" / "architect" / "Table-coffee-E.dxf").read_bytes()
    assert b"dxfrw" in drawn[:40]  # the library by which LibreCAD writes
    (tmp_path / "cam.dxf").write_bytes(drawn)
    follower = '[follower]\nkind = "flat-faced"\n'
    (tmp_path / "cam.toml").write_text(f'[outline]\nfile = "cam.dxf"\n{follower}', encoding="utf-8")
    motion, phi = gc.load_task(tmp_path / "cam.toml").motion(), np.linspace(0, 2 * np.pi, 361)
    # The support function of an ellipse.
    there = np.hypot(400 * np.sin(phi), 300 * np.cos(phi)) - 300
    assert np.abs(motion(phi - motion.zero)[0] - there).max() < 0.01


@pytest.mark.slow
def test_a_drawing_of_the_library_is_an_outline_or_is_told_why_not() -> None:
    """Of all drawings one in three."""
    read, told = 0, list[str]()
    for path in sorted(library().rglob("*.dxf"))[::3]:
        try:
            outline_from_dxf(path, path.name, None)
            read += 1
        except TaskError as error:
            told.append(f"{error}")
    assert read >= 5
    assert len(told) >= 40
    assert [each for each in told if ", but must be " not in each] == []
