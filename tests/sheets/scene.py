"""A small sheet with every kind of mark, like a solution's but made without one."""

from __future__ import annotations

import numpy as np

from graphcam.drafting.ink import Part, Step, View, say
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dimension, Dots, Label, Line, Region, Role, Segments
from graphcam.sheets.formats import FRAME_MARGINS, ORIENTATIONS, SHEET_SIZES, UPRIGHT_FORMAT
from graphcam.sheets.layout import compose
from graphcam.sheets.model import Drawing
from graphcam.sheets.sheet_frame import TitleBlock
from graphcam.sheets.tables import Table

ACCELERATION = View("acceleration", say("Acceleration a, μₐ = 1.2 (mm/rad²)/mm"), across="phi", up="a")
DISPLACEMENT = View("displacement", say("Displacement s"), across="phi", up="s")
COMBINED = View("combined", say("Minimum radius"), across="offset", up="s")
PROFILE = View("profile", say("Cam profile, 1:1"), across="x", up="y")
SHEETS = [
    (paper, frame, lie)
    for lie in ORIENTATIONS
    for paper in SHEET_SIZES
    for frame in FRAME_MARGINS
    if (paper, frame, lie) != (*UPRIGHT_FORMAT, "landscape")
]
"""Every format, frame and orientation in which it is used."""
TITLE = TitleBlock(name="Cam mechanism", number="ТММ.01.02", organisation="Кафедра ТММ", author="Ivanova", scale="1:1")


def oval(n: int = 400) -> np.ndarray:
    """A smooth closed curve."""
    t = 2 * np.pi * np.arange(n) / n
    return 60 * np.cos(t) + 45j * np.sin(t)


DRAWN_AT = {"A1": 1.0, "A2": 1.0, "A3": 0.6, "A4": 0.3}
"""What the scene is drawn at, so that its largest view fits a page."""


def steps(ordinate: float = 50.0, size: float = 1.0) -> list[tuple[str, Step]]:
    """Steps of four views, drawn smaller if they are to fit; the ordinates of the diagrams can be chosen."""
    x = np.linspace(0, 360, 121)
    up, s, x = size * ordinate * np.cos(np.radians(x)), 25 * size * (1 - np.cos(np.radians(x))), size * x
    stations = x[::10] + 1j * s[::10]
    acceleration = (
        Arrow(0j, x[-1] + 10 + 0j, Role.SCALE), Arrow(-1j * up.max(), 1j * (up.max() + 8), Role.SCALE),
        Line(x + 1j * up, Role.RESULT),
        *(Label(complex(at), str(k), towards=-1j, small=True) for k, at in enumerate(x[::10])),
        Dimension(-40 + 0j, 0j, "H₁ = 40", aside=-8.0),
        Segments(np.full(5, -40 + 0j), 10j * np.arange(5), Role.CONSTRUCTION),
    )  # fmt: skip
    displacement = (
        Arrow(0j, x[-1] + 10 + 0j, Role.SCALE), Arrow(0j, 1j * (s.max() + 8), Role.SCALE), Line(x + 1j * s, Role.CURVE),
        Dots(stations), Segments(stations.real + 0j, stations, Role.CONSTRUCTION),
        Dimension(x[60] + 0j, complex(x[60], s[60]), f"{s[60]:.1f}"), Dimension(0j, 5 + 0j, "5", aside=-12.0),
    )  # fmt: skip
    combined = (
        Line(size * np.array([0, 60 + 25j, 50j, -60 + 25j]), Role.CURVE, closed=True),
        Region(size * np.array([0, 60 - 100j, -60 - 100j])), Line(size * np.array([0, 60 - 100j]), Role.LIMIT),
        Label(-70j * size, "A"), AngleMark(0j, 40.0 * size, -np.pi / 2, -np.pi / 2 + 0.5, "30°"),
        Circle(-70j * size, 12.0 * size, Role.HIDDEN),
    )  # fmt: skip
    curve = size * oval()
    profile = (
        Line(curve, Role.RESULT, closed=True),
        Line(size * np.array([-80, 80]) + 0j, Role.AXIS), Line(size * np.array([-70j, 70j]), Role.AXIS),
        Circle(0j, 30.0 * size, Role.CONSTRUCTION), Arc(0j, 20.0 * size, 0.5, 2.0, Role.CURVE, arrow="end"),
        Dots(np.array([0j])),
        AngleMark(0j, 75.0 * size, 0.0, 1.4, "φ₁ = 80°"), AngleMark(0j, 75.0 * size, 1.4, 1.45, "φ₂ = 3°"),
        *(Label(complex(at), f"{k}′", towards=complex(at), small=True) for k, at in enumerate(curve[::20])),
    )  # fmt: skip
    scenes = ((ACCELERATION, acceleration), (DISPLACEMENT, displacement), (COMBINED, combined), (PROFILE, profile))
    told = (Part(say(".")),)
    return [(view.name, Step(say("{n}", n=n), told, view, marks[n::2])) for view, marks in scenes for n in range(2)]


TABLE = Table("Data", ("quantity", "value"), (("lift", "30 mm"), ("prime radius r₀", "44 mm"), ("угол", "80°")))


def drawing(paper: str = "A1", frame: str = "gost") -> Drawing:
    """The scene laid out."""
    drawn = steps(size=DRAWN_AT[paper])
    return compose(drawn, [TABLE], TITLE, paper, frame, notes=["Every length is in millimetres of paper."])
