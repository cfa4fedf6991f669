"""A construction step by step in a notebook: the drawing so far, the current step in colour, its text, its readings."""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING
from urllib.parse import quote

from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.errors import DesignError
from graphcam.plots.step_board import board_of
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.sheet_contents import all_constructions, chapters_of
from graphcam.report.step_player import player_of, run_text
from graphcam.sheets.model import Page
from graphcam.sheets.svg_renderer import svg
from graphcam.solving.arcs_solution import AnySolution
from graphcam.subscripts import in_html
from graphcam.words import Tell, say, sequence

if TYPE_CHECKING:
    from IPython.display import HTML
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHEET_DPI = 65
"""The resolution [dots an inch] at which a sheet of A1 fills a screen."""
SHADE_COUNT = 16
BESIDE_RATIO = 0.6
"""Height to width of a drawing, above which it stands beside the text on paper."""
SAFE_IN_ADDRESS = " /:;=,()+'"
"""Signs that stand as they are in the address of a picture."""


@dataclass(frozen=True)
class Picture:
    """An image with its caption.

    image : the content of the file, SVG as text or PNG as bytes
    alt : the text in place of the image, for screen readers
    caption : the line below it; may be empty

    >>> print(Picture("<svg/>", "a blank sheet", "Nothing").html)
    <figure><img src="data:image/svg+xml,%3Csvg/%3E" alt="a blank sheet"><figcaption>Nothing</figcaption></figure>
    """

    image: str | bytes
    alt: str
    caption: str = ""

    @property
    def html(self) -> str:
        """The picture as a figure of a web page, the image inside."""
        below = f"<figcaption>{escape(self.caption)}</figcaption>" if self.caption else ""
        if isinstance(self.image, str):
            # A text in an address is shorter than its base64.
            source = "data:image/svg+xml," + quote(self.image, safe=SAFE_IN_ADDRESS)
        else:
            source = f"data:image/png;base64,{base64.b64encode(self.image).decode()}"
        return f'<figure><img src="{source}" alt="{escape(self.alt)}">{below}</figure>'

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/html": self.html, "text/plain": self.alt}


def picture_of_page(page: Page, alt: str, caption: str = "") -> Picture:
    """The picture of a page of a sheet; a PNG, since an SVG with so many lines is larger."""
    from PIL import Image

    from graphcam.sheets.matplotlib_renderer import write_png

    drawn, image = BytesIO(), BytesIO()
    write_png(page, drawn, SHEET_DPI)
    # A drawing has few inks: so many shades are enough for their edges, and make a third of the file.
    Image.open(drawn).convert("RGB").quantize(SHADE_COUNT).save(image, "png", optimize=True)
    return Picture(image.getvalue(), alt, caption)


def chart(across: str, up: str, height: float = 3.0) -> tuple[Figure, Axes]:
    """An empty matplotlib figure and its axes, for what is plotted rather than drawn.

    across, up : the labels of the axes
    height : of the figure [inches], which is 7 wide

    >>> chart("φ, °", "s, mm")[1].get_xlabel()
    'φ, °'
    """
    from matplotlib.figure import Figure

    figure = Figure((7.0, height))
    axes = figure.subplots()
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(visible=True, color="#dddddd", linewidth=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    return figure, axes


def picture_of(figure: Figure, alt: str, caption: str = "") -> Picture:
    """The picture of a matplotlib figure: for charts, which are no constructions.

    >>> from matplotlib.figure import Figure
    >>> picture_of(Figure((1, 1)), "an empty chart").image.startswith("<?xml")
    True
    """
    from graphcam.plots.figures import figure_svg

    return Picture(figure_svg(figure), alt, caption)


@dataclass(frozen=True, eq=False, repr=False)
class Stage:
    """One step of a construction for a notebook.

    number : of the step, within its task such as "3.2", or of a construction alone such as "2."
    step : its texts
    page : the drawing so far; None for a step of words alone, before which nothing was drawn
    reads : the readings that are taken off the paper with this step
    tell : translates all texts
    strip : some of its parts, by index, each with the drawing so far
    """

    number: str
    step: Step
    page: Page | None
    reads: tuple[ReadingRow, ...]
    tell: Tell
    strip: Mapping[int, Page] = field(default_factory=dict[int, Page])

    def __repr__(self) -> str:
        return f"Stage {self.number} {self.tell(self.step.title)}"

    @property
    def picture(self) -> Picture | None:
        """The drawing so far with the current step in colour."""
        if self.page is None:
            return None

        title, view = self.tell(self.step.title), self.tell(self.step.view.title)
        said = {"view": view, "number": self.number.rstrip("."), "title": title, "caption": self.step.caption}
        alt = say("{view}. Drawn so far, step {number} in colour: {title}. {caption}", **said)
        return Picture(svg(self.page, ""), self.tell(alt), f"{view}: {title[0].lower()}{title[1:]}")

    @property
    def pictures(self) -> list[Picture]:
        """The drawing as far as each part of the strip, that part in colour."""
        number, places = self.number.rstrip("."), self.step.places
        alt = say("Drawn up to part {part} of step {number}, which is in colour: {caption}", number=number)
        # A sentence of the list above is not said again.
        said, bare = say("Part {part} of {count}: {caption}"), say("Part {part} of {count}")
        found: list[Picture] = []
        for k, page in self.strip.items():
            told = {"part": k + 1, "count": len(places), "caption": places[k].caption}
            words = (alt, said if _is_row(self.step, k) else bare)
            found.append(Picture(svg(page, ""), *(self.tell(each.with_values(**told)) for each in words)))
        return found

    @property
    def html(self) -> str:
        """Title, instructions part by part, and the reason; some parts side by side; the whole step; readings."""
        title, why = (in_html(escape(self.tell(said))) for said in (self.step.title, self.step.why))
        parts = "".join(f"<li>{self._told(part)}</li>" for part in self.step.parts)
        words = f"<h4>{self.number} {title}</h4><ol>{parts}</ol>" + (f'<p class="why">{why}</p>' if why else "")
        if len(self.step.places) > 1:
            words += f'<div class="stills">{"".join(picture.html for picture in self.pictures)}</div>'
        shown = self.picture.html if self.picture else ""
        read = "".join(f"<li>{_reading(row, self.tell)}</li>" for row in self.reads)
        readings = f'<ul class="readings">{read}</ul>' if read else ""
        beside = " beside" * bool(self.page and self.page.height > BESIDE_RATIO * self.page.width)
        return f'<section class="step{beside}">{words}{shown}{readings}</section>'

    def _told(self, part: Part) -> str:
        """A part in words, a run of like parts with its table, as HTML."""
        said = in_html(escape(self.tell(part.caption)))
        rows = [(self.tell(row.name), self.tell(row.setting)) for row in part.rows]
        run = run_text("", 0, rows) if rows else None
        if run is None or not run.settings:
            return said
        cells = (f"<li><b>{in_html(escape(name))}</b> {in_html(escape(setting))}</li>" for name, setting in run.rows)
        head = f"<p>{in_html(escape(run.head))}</p>" if run.head else ""
        return f'{said}{head}<ul class="rows">{"".join(cells)}</ul>'

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {
            "text/html": self.html,
            "text/plain": f"{self.number} {self.tell(self.step.title)}: {self.tell(self.step.caption)}",
        }


def _is_row(step: Step, place: int) -> bool:
    inside = [bool(part.rows) for part in step.parts for _ in part.rows or (part,)]
    return inside[place]


def _reading(row: ReadingRow, tell: Tell) -> str:
    """A reading as mm x mu = value, in HTML; of several values the extremes, and all of them to be unfolded."""
    if not row.paper.ndim:
        return in_html(escape(tell(say("{title} = {said}", title=row.title, said=row.caption()))))
    lines = "".join(
        f"<li>{in_html(escape(tell(place)))}: {escape(tell(row.caption(k)))}</li>" for k, place in enumerate(row.places)
    )
    extremes = [say("{at} = {said}", at=row.extreme_caption(what, k), said=row.caption(k)) for what, k in row.extremes]
    first = say("{title}: {extremes}", title=row.title, extremes=sequence(extremes, "; "))
    return f"<details><summary>{escape(tell(first))}</summary><ul>{lines}</ul></details>"


def stages(
    construction: Construction,
    tell: Tell | None = None,
    on: Construction | None = None,
    within: AnySolution | None = None,
) -> Iterator[Stage]:
    """The steps of a construction, each with the drawing so far; see :func:`show_steps`."""
    tell = tell or (within.tell if within else str)
    chapter = chapters_of(all_constructions(within)).get(construction.name) if within else None
    of_view, drawn = board_of(construction, tell, on).by_view, Counter[str]()
    for number, step in enumerate(construction.steps(), 1):
        name = step.view.name
        board, k = of_view.get(name), drawn[name]
        drawn[name] += 1
        strip = {part: board.page(k, part) for part in shown_parts(board.drawing_parts(k))} if board else {}
        numbered = f"{number}." if chapter is None else f"{chapter}.{number}"
        page = board.page(k) if board else None
        empty = page is None or not any(group.entities for group in page.groups)
        yield Stage(numbered, step, None if empty else page, tuple(rows(construction, step)), tell, strip)


def shown_parts(parts: Sequence[int]) -> list[int]:
    """Of the parts that draw something those shown beside the whole: the first and the middle one, which fill a line.

    >>> [shown_parts(range(count)) for count in (0, 1, 2, 3, 24)], shown_parts([1, 2, 5])
    ([[], [], [0], [0, 1], [0, 12]], [1, 2])
    """
    return [parts[0], parts[len(parts) // 2]][: len(parts) - 1] if parts else []


def drawing(construction: Construction, view: str | None = None, tell: Tell = str) -> Picture:
    """The finished drawing of a construction in one of its views, by default the first.

    >>> import graphcam as gc
    >>> drawing(gc.solve(gc.builtin_task()).drawn["minimum_radius"]).caption
    'Displacement and velocity: the minimum radius'

    Raises
    ------
    DesignError : the construction draws nothing in that view
    """
    of_view = board_of(construction, tell).by_view
    if view is not None and view not in of_view:
        raise DesignError("view", view, say("one of {names}", names=", ".join(of_view)))
    board = of_view[view] if view is not None else next(iter(of_view.values()))
    title = str(board.steps[-1].view.title)
    return Picture(svg(board.page(), ""), f"{title}. {board.steps[-1].caption}", title)


def show_steps(
    construction: Construction,
    *numbers: int,
    within: AnySolution | None = None,
    tell: Tell | None = None,
    on: Construction | None = None,
) -> None:
    """Show steps of a construction in a notebook, by their places in it from 1; without a number all of them.

    within : the solution that it belongs to, in which the steps have numbers such as "3.2"
    tell : translates all texts; by default into the language of that solution's task
    on : a construction over which this one is drawn, though it does not start from it
    """
    from IPython.display import display

    for number, stage in enumerate(stages(construction, tell, on, within), 1):
        if not numbers or number in numbers:
            display(stage)


FRAME_HEIGHT = 720
"""The height of the frame with the player, in pixels of a page."""


def player(solution: AnySolution) -> HTML:
    """The step player of a solution, as a frame that holds the whole page.

    >>> import graphcam as gc
    >>> player(gc.solve(gc.builtin_task())).data.startswith('<div class="player"><iframe')
    True
    """
    from IPython.display import HTML

    contents = contents_of(solution)
    page = escape(player_of(contents, drawing_of(contents)))
    title = escape(solution.tell(say("Step player")))
    frame = f'<iframe title="{title}" style="width: 100%; height: {FRAME_HEIGHT}px" srcdoc="{page}"></iframe>'
    return HTML(f'<div class="player">{frame}</div>')
