"""The looks of lines: widths and types by ISO 128 and GOST 2.303, one style for each role."""

from collections.abc import Mapping
from dataclasses import dataclass

from graphcam.drafting.marks import Role

BOLD, THIN = 0.5, 0.25
"""Widths of the two groups of lines [mm], 2:1 by ISO 128, and by GOST 2.303 where thin is s/3 to s/2."""
LIGHT_WIDTH = 0.18
"""The width of light lines that a student draws over [mm]."""
SOLID: tuple[float, ...] = ()
DASHED = (3.0, 1.2)
CENTER = (9.0, 1.4, 1.0, 1.4)
"""Line types: dash, gap, dash, gap... [mm of paper]."""
BLACK, GREY, ACCENT = "#000000", "#5a5a5a", "#b3201c"
"""Ink of results and curves, of construction lines, and of limits, all dark enough for a print in black and white."""


@dataclass(frozen=True)
class Style:
    """Width [mm], pattern [mm] and colour of a line."""

    width: float
    pattern: tuple[float, ...] = SOLID
    colour: str = BLACK


_FINISHED_STYLES: dict[str, Style] = {
    Role.CONSTRUCTION: Style(THIN, colour=GREY),
    Role.HATCH: Style(THIN, colour=GREY),
    Role.DIMENSION: Style(THIN),
    Role.AXIS: Style(THIN, CENTER, GREY),
    Role.HIDDEN: Style(THIN, DASHED, GREY),
    Role.SCALE: Style(THIN),
    Role.CURVE: Style(THIN),
    Role.LIMIT: Style(THIN, colour=ACCENT),
    Role.RESULT: Style(BOLD),
    "frame": Style(BOLD),
    "ruling": Style(THIN),
    "gauge": Style(THIN),
    "table": Style(THIN),
    "text": Style(THIN),
}
CYAN_TINT, GREY_TINT = "#a6e3fa", "#b3b3b3"
"""Tints of 35 % and 30 % for what is drawn over by hand and photographed, lighter than any pencil."""
LIGHT_ROLES: Mapping[str, str] = {"colour": "light colour", "grey": "light grey"}
"""The roles of light lines, by how they are printed: in colours, or in black alone."""
CODE_ROLE = "printed code"
"""The role of the cells of tags and codes."""
FADED_COLOUR, CURRENT_COLOUR = "#9b9b9b", "#0b57a4"
"""Ink of a drawing in progress: of earlier steps, and of the current step."""
FORMER_STEP_STAGE, CURRENT_STEP_STAGE, CURRENT_PART_STAGE = "former", "current", "part"
"""The stages of a drawing in progress; the lines of a current part are bold, since it is shown small."""


def in_progress(role: str, stage: str) -> str:
    """The role of a line in a drawing in progress, by the ``stage`` in which it was drawn.

    >>> STYLES_BY_ROLE[in_progress(Role.RESULT, FORMER_STEP_STAGE)].colour == FADED_COLOUR
    True
    """
    return f"{stage} {role}"


def _current(style: Style) -> Style:
    # A limit keeps its accent: it is told by its colour.
    return style if style.colour == ACCENT else Style(style.width, style.pattern, CURRENT_COLOUR)


def _bold(style: Style) -> Style:
    return Style(BOLD, style.pattern, style.colour)


STYLES_BY_ROLE: dict[str, Style] = {
    **_FINISHED_STYLES,
    LIGHT_ROLES["colour"]: Style(LIGHT_WIDTH, colour=CYAN_TINT),
    LIGHT_ROLES["grey"]: Style(LIGHT_WIDTH, colour=GREY_TINT),
    CODE_ROLE: Style(THIN),
    **{
        in_progress(role, FORMER_STEP_STAGE): Style(THIN, style.pattern, FADED_COLOUR)
        for role, style in _FINISHED_STYLES.items()
    },
    **{in_progress(role, CURRENT_STEP_STAGE): _current(style) for role, style in _FINISHED_STYLES.items()},
    **{in_progress(role, CURRENT_PART_STAGE): _bold(_current(style)) for role, style in _FINISHED_STYLES.items()},
}
"""The style of each role of ink and of the sheet's own roles; all of them also for a drawing in progress.

The names of the sheet's own roles have one word, those that only some sheets have two.
"""
