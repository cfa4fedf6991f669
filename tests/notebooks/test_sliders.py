"""Sliders and the stills in their place."""

from __future__ import annotations

import sys
import warnings

import pytest

from graphcam.notebooks.construction_stages import Picture
from graphcam.notebooks.explore import WIDGET_VIEW, Slider, explore


def draw(parts, pole):
    return Picture("<svg/>", f"{parts} parts, pole {pole}")


SLIDERS = {"parts": Slider("parts", (4, 12, 24), 12, (4, 24)), "pole": Slider("pole", (30, 40), 40)}


def test_without_ipywidgets_the_stills_stand_and_nobody_warns(monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bundle = explore(draw, **SLIDERS)._repr_mimebundle_()
    assert set(bundle) == {"text/html", "text/plain"}
    assert 'alt="4 parts, pole 40"' in bundle["text/html"]
    assert 'alt="24 parts, pole 40"' in bundle["text/html"]


@pytest.mark.slow
def test_a_slider_redraws():
    exploration = explore(draw, **SLIDERS)
    box = exploration._widget()
    parts, pole, picture = box.children
    assert 'alt="12 parts, pole 40"' in picture.value
    parts.value = 24
    pole.value = 30
    assert 'alt="24 parts, pole 30"' in picture.value
    assert WIDGET_VIEW in exploration._repr_mimebundle_()


def test_a_slider_alone_shows_its_start():
    assert explore(lambda n: draw(n, 1), n=Slider("n", (1, 2), 2)).html.count("<img") == 1
