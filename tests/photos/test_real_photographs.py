"""Real photographs, as many as have been sent: each is held against what its sender measured with a rule."""

from __future__ import annotations

import tomllib
from pathlib import Path

import cv2
import numpy as np
import pytest

from graphcam.photo.drawn_curves import read_curve
from graphcam.photo.file_intake import UnopenedFile, pictures_in
from graphcam.photo.pencil_ink import ink_of
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import Points, PrintedPage
from graphcam.photo.rectify import rectify
from graphcam.photo.registration import register
from graphcam.photo.tags import find_tags

pytestmark = pytest.mark.slow

REAL = Path(__file__).parent / "real"
PHOTOGRAPHS = sorted(REAL.glob("*.jpg"))


def test_it_is_told_how_to_send_photographs() -> None:
    text = (REAL / "README").read_text(encoding="utf-8")
    assert all(f"\n{step}. " in text for step in range(1, 6))
    # As long as this is so it must be said.
    assert ("there are none yet" in text) == (not PHOTOGRAPHS)
    assert all(path.with_suffix(".toml").is_file() for path in PHOTOGRAPHS)


def test_real_photographs_show_what_their_senders_measured() -> None:
    # Not a test for each: there may be none yet, and that is said above.
    for path in PHOTOGRAPHS:
        said = tomllib.loads(path.with_suffix(".toml").read_text(encoding="utf-8"))
        page = PrintedPage.from_json(path.with_suffix(".page.json").read_text(encoding="utf-8"))
        points = curve_in(path, page, said["view"])
        assert (points is None) == said["refused"], path
        if points is not None:
            parts = [length / abs(end - start) for length, (start, end) in zip(said["bars"], page.bars, strict=True)]
            points = points.real * parts[0] + 1j * points.imag * parts[1]
            for degrees, radius in said["radii"]:
                assert radius_at(points, degrees) == pytest.approx(radius, abs=said["within"]), path


def curve_in(path: Path, page: PrintedPage, name: str) -> Points | None:
    """The curve in a photograph (n,), in mm of the page from the view's origin; None where it is refused."""
    (picture,) = pictures_in([path])
    assert not isinstance(picture, UnopenedFile)
    tags = find_tags(np.asarray(cv2.cvtColor(picture.pixels, cv2.COLOR_BGR2GRAY), np.uint8))
    try:
        registration = register(tags, page, picture.pixels.shape[1::-1], picture.focal)
    except PhotographError:
        return None
    view = page.views[name]
    reading = read_curve(
        ink_of(rectify(picture.pixels, registration, (0, 0, page.width, page.height), 6.0), page), view
    )
    return None if reading.refusal() else reading.points[np.isfinite(reading.points)]


def test_the_radius_is_that_of_the_direction() -> None:
    circle = 2 + 10 * np.exp(2j * np.pi * np.arange(360) / 360)
    assert [radius_at(circle, degrees) for degrees in (0, 90, 180)] == pytest.approx([12, np.sqrt(96), 8], abs=0.01)


def radius_at(points: Points, degrees: float) -> float:
    """How far from the origin a closed curve (n,) runs in a direction."""
    angles = np.degrees(np.angle(points * np.exp(-1j * np.radians(degrees))))
    order = np.argsort(angles)
    return float(np.interp(0.0, angles[order], np.abs(points[order])))
