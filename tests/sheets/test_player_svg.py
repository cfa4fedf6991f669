"""The step player's SVG holds the entities of the drawing, at their places."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from programs import count
from scene import drawing

from graphcam.sheets.model import ArcEntity, Circles, Curve, Group, Heads, Stroke, Strokes, Text
from graphcam.sheets.player import Slide, player
from graphcam.sheets.player_svg import group_svg
from graphcam.sheets.styles import STYLES_BY_ROLE

NUMBER = r"-?[\d.]+"
HEIGHT = 297.0


def elements(svg: str) -> list[ET.Element]:
    return list(ET.fromstring(f"<g>{svg}</g>"))


def counted(svg: str) -> int:
    """Sub-paths and texts."""
    return sum(1 if e.tag == "text" else e.attrib["d"].count("M") for e in elements(svg) if e.tag != "tspan")


@pytest.mark.parametrize("paper", ["A1", "A4"])
def test_every_group_has_as_many_entities_as_the_drawing(paper):
    groups = [(group, page.height) for page in drawing(paper).pages for group in page.groups]
    assert len(groups) > 8
    for group, height in groups:
        # Its indices are parts of a text.
        drawn = sum(1 if isinstance(entity, Text) else count(entity) for entity in group.entities)
        assert counted(group_svg(group, height)) == drawn, group.name
        for element in elements(group_svg(group, height)):
            assert set(element.attrib["class"].split()) & {"line", "filled", "opaque", "text"}
            if element.tag == "path":
                assert element.attrib["class"].split()[1] in STYLES_BY_ROLE


def test_a_lost_entity_is_counted():
    whole = Group("step-01 a", (Strokes(np.array([0, 1j]), np.array([5, 5 + 1j]), "curve"),))
    lost = Group("step-01 a", (Strokes(np.array([0j]), np.array([5 + 0j]), "curve"),))
    assert counted(group_svg(lost, HEIGHT)) != sum(count(entity) for entity in whole.entities)


def test_lines_and_texts_lie_where_they_are_drawn():
    """y runs down from the upper edge."""
    group = Group(
        "a",
        (
            Stroke(np.array([10 + 20j, 30.128 + 40j]), "curve", closed=True),
            Heads(np.array([[0, 3 + 1j, 3 - 1j]]), "curve"),
            Text(5 + 7j, "α < 30°", 3.5, "center", np.pi / 2),
        ),
    )
    line, head, text = elements(group_svg(group, HEIGHT))
    assert line.attrib["d"] == "M10 277L30.13 257Z"
    assert head.attrib == {"class": "filled curve", "d": "M0 297L3 296L3 298Z"}
    assert text.attrib["class"] == "text middle"
    assert (text.attrib["x"], text.attrib["y"], text.text) == ("5", "290", "α < 30°")
    assert text.attrib["transform"] == "rotate(-90.00 5 290)"


def test_lengths_are_written_to_a_hundredth_without_idle_digits_or_the_sign_of_nought():
    ends = np.array([-0.004 + 296.5j, 10 + 295.996j, -0.006 + 100.104j, 0.05 + 97j])
    (line,) = elements(group_svg(Group("a", (Stroke(ends, "curve"),)), HEIGHT))
    assert line.attrib["d"] == "M0 0.5L10 1L-0.01 196.9L0.05 200"


def test_round_things_are_round():
    circle, arc = (
        elements(group_svg(Group("a", (entity,)), HEIGHT))[0].attrib["d"]
        for entity in (Circles(np.array([10 + 20j]), 5.0, "curve"), ArcEntity(10 + 20j, 5.0, 0.0, 1.5 * np.pi, "curve"))
    )
    assert circle == "M5 277a5 5 0 1 1 10 0a5 5 0 1 1 -10 0z"
    places = [complex(float(x), HEIGHT - float(y)) for x, y in re.findall(rf"({NUMBER}) ({NUMBER})(?=A|$)", arc)]
    # From the right over the upper left to below.
    assert np.angle(np.array(places) - (10 + 20j)) == pytest.approx([0.0, 0.75 * np.pi, -np.pi / 2], abs=2e-3)
    assert abs(np.array(places) - (10 + 20j)) == pytest.approx(5.0, abs=0.01)


def test_a_smooth_curve_goes_through_its_points():
    points = 50 * np.exp(2j * np.pi * np.arange(60) / 60) + 100 + 100j
    (curve,) = elements(group_svg(Group("a", (Curve(points, "result"),)), HEIGHT))
    numbers = np.array(re.findall(NUMBER, curve.attrib["d"]), dtype=float)
    at = numbers[::2] + 1j * (HEIGHT - numbers[1::2])
    np.testing.assert_allclose(at[::3][:-1], points, atol=0.0075)


def test_nothing_that_is_written_becomes_markup():
    drawn = drawing("A3")
    steps = sum(group.key.startswith("step-") for page in drawn.pages for group in page.groups)
    wicked = "</script><script>alert(1)</script><b>&"
    page = player(drawn, [Slide(wicked, "v", wicked, wicked)] * steps, None, _words(), "en")
    assert "<script>alert" not in page
    assert "<b>" not in page


def _words() -> dict[str, str]:
    from graphcam.sheets.player import PAGE_CAPTIONS

    return {name: str(word) for name, word in PAGE_CAPTIONS.items()}
