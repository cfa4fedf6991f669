"""Sizes of paper by ISO 216, margins by ISO 5457 and GOST 2.301, sizes of lettering by ISO 3098 and GOST 2.304."""

from dataclasses import dataclass

from graphcam.errors import DesignError, choice_limit
from graphcam.sheets.model import Box
from graphcam.words import Words, say

SHEET_SIZES = {"A1": (841.0, 594.0), "A2": (594.0, 420.0), "A3": (420.0, 297.0), "A4": (297.0, 210.0)}
"""Width and height of the sheets in landscape, mm."""
ORIENTATIONS = ("landscape", "portrait")
UPRIGHT_FORMAT = ("A4", "gost")
"""Format and frame of GOST 2.301, which uses sheets A4 upright only, the title block along the short side."""
FRAME_MARGINS = {"gost": (20.0, 5.0, 5.0, 5.0), "iso": (20.0, 10.0, 10.0, 10.0)}
"""The margins between the edge of the paper and the frame [mm]: left, bottom, right, top."""


@dataclass(frozen=True)
class Lettering:
    """Heights of capital letters, mm: titles, labels and dimensions, numbers of divisions and small print."""

    title: float
    label: float
    small: float


@dataclass(frozen=True)
class Format:
    """A sheet of paper with its frame.

    name : "A1" to "A4";  frame : "gost" or "iso"
    orientation : "landscape" or "portrait"; None is landscape, but portrait for A4 of GOST

    Raises
    ------
    DesignError : there is no such format, frame or orientation, or the frame's standard excludes it

    >>> Format("A3", "iso").content
    Box(left=20.0, bottom=10.0, right=410.0, top=287.0)
    >>> Format("A3", "iso", "portrait").size, Format("A4", "gost").size
    ((297.0, 420.0), (210.0, 297.0))
    """

    name: str
    frame: str
    orientation: str | None = None

    def __post_init__(self) -> None:
        known = {"format": SHEET_SIZES, "frame": FRAME_MARGINS, "orientation": ORIENTATIONS}
        for (quantity, names), given in zip(known.items(), (self.name, self.frame, self.orientation), strict=True):
            if given is not None and given not in names:
                raise DesignError(quantity, given, *choice_limit(given, names))
        if self.orientation == "landscape" and self._is_upright_only:
            limit = say("portrait: GOST 2.301 uses A4 in portrait only")
            remedy = say('leave orientation out, or choose another format or frame = "iso"')
            raise DesignError("orientation", self.orientation, limit, remedy)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper [mm]."""
        width, height = SHEET_SIZES[self.name]
        return (height, width) if self.is_upright else (width, height)

    @property
    def is_upright(self) -> bool:
        """Whether the sheet is in portrait format."""
        return self.orientation == "portrait" or self._is_upright_only

    @property
    def description(self) -> Words:
        """Format and orientation, as a message names them.

        >>> str(Format("A3", "iso").description), str(Format("A4", "gost").description)
        ('A3 landscape', 'A4 portrait')
        """
        return say("{name} portrait", name=self.name) if self.is_upright else say("{name} landscape", name=self.name)

    @property
    def _is_upright_only(self) -> bool:
        return (self.name, self.frame) == UPRIGHT_FORMAT

    @property
    def content(self) -> Box:
        """The box inside the frame."""
        (width, height), (left, bottom, right, top) = self.size, FRAME_MARGINS[self.frame]
        return Box(left, bottom, width - right, height - top)

    @property
    def lettering(self) -> Lettering:
        """The heights of letters: A3 and A4 are held in the hand, A1 and A2 hang on a wall."""
        return Lettering(5.0, 3.5, 2.5) if self.name in ("A1", "A2") else Lettering(3.5, 2.5, 2.5)
