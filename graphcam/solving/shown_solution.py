"""What a solution of either kind shows of itself: in few lines, as its sheet, as files, as plain data for JSON."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import Any

from graphcam.comparison.quantities import Quantity
from graphcam.given.laws import Floats
from graphcam.showing import MAX_WIDTH, Plottable, higher_function, value_text
from graphcam.words import Words

DEFAULT_KINDS = (
    *("pdf", "svg", "png", "dxf", "csv", "md", "note", "note_html", "player"),
    *("profile_dxf", "profile_csv", "profile_xyz"),
)
"""The kinds of files that a solution is written to if nothing else is said."""
CUTTING_KINDS = "profile_step", "profile_gcode"
"""The kinds of files by which a machine cuts the cam."""
FILE_KINDS = (*DEFAULT_KINDS, *CUTTING_KINDS)
"""All kinds of files that there are."""
UNFINISHED_KEYS = "graphcam", "task", "files"
"""What ``solution.json`` says of an unfinished sheet: no answers."""


class ShownSolution(Plottable):
    """A solution that plots its sheet and writes its files."""

    _drawn_in = "construction_drawing.plot_sheet"

    def write(
        self,
        folder: Path | str,
        files: Collection[str] | None = None,
        *,
        upto: int | str | None = None,
        per_construction: bool = False,
        dxf: str = "plain",
        working_drawing: bool = False,
        progress: Callable[[Words], None] | None = None,
    ) -> dict[str, str | None]:
        """Write the sheet, the step player, the tables, the note and the profile into a folder: all of them, or none.

        The folder is the run's: what the run before wrote into it and this one does not goes, unless somebody has
        changed it since.  Other files stay as they are.  All of them are of the drawing on the sheets, where the region
        of the minimum radius and the profile have the largest standard scales for which the pages have room.

        files : a list of kinds; ``solution.json``, which names the others, always comes along.  The sheet is "pdf",
            "svg", "png" and "dxf"; the table of drawn against exact values "csv" and "md"; the note "note"
            (Markdown) and "note_html" (a page that prints); the step player "player"; the exact profile "profile_dxf"
            (one spline), "profile_csv" and "profile_xyz" (points), "profile_step" (a solid) and "profile_gcode" (a
            program for a machine).  By default all but the last two, and with a working drawing these too
        upto, per_construction : which sheets, as for :func:`~graphcam.report.documents.sheet_of`; an unfinished sheet
            is called "worksheet", and stands alone: what holds answers is not written, nor do they stand in
            ``solution.json``
        dxf : "plain" for every program, or "cad" with true dimensions and an editable title block
        working_drawing : whether the cam as a part is drawn too, with the task's table ``[part]``: PDF, SVG and DXF
        progress : called with what is being done
        returns : the files' names in the folder by kind, None for a kind that there is not

        Raises
        ------
        DesignError : there is no such kind of file, step, construction or kind of DXF, or no such part
        OutputError : the folder cannot be written

        >>> import graphcam as gc
        >>> from tempfile import TemporaryDirectory
        >>> with TemporaryDirectory() as folder:
        ...     written = gc.solve(gc.builtin_task()).write(folder, ["csv", "note"])
        >>> [name for name in written.values() if name]
        ['comparison.csv', 'note.md']
        """
        choices = {"upto": upto, "per_construction": per_construction, "dxf": dxf, "working_drawing": working_drawing}
        return higher_function("report.output_folder.write")(self, folder, files, **choices, progress=progress)

    def _in_lines(self, name: str, mechanism: object, drawn: Iterable[str]) -> str:
        # The last line of the mechanism says how to go on from there.
        *sizes, _ = repr(mechanism).splitlines()
        last = ".drawn[name], .comparison, .to_dict(); .plot() draws the sheet, .write(folder) writes the files"
        rows = [size.strip() for size in sizes] + wrap("drawn: " + ", ".join(drawn), MAX_WIDTH)
        return value_text(f"{type(self).__name__} of {name!r}", rows, last)


def without_answers(document: Mapping[str, Any]) -> dict[str, Any]:
    """What ``solution.json`` says of an unfinished sheet.

    >>> without_answers({"graphcam": "1.0", "task": {}, "quantities": {"max_v": 43.0}, "files": {}})
    {'graphcam': '1.0', 'task': {}, 'files': {}}
    """
    return {key: document[key] for key in UNFINISHED_KEYS}


def plain_number(value: float) -> float | None:
    """A number, or None for one that JSON does not know.

    >>> plain_number(2), plain_number(math.inf)
    (2.0, None)
    """
    return float(value) if math.isfinite(value) else None


def plain_quantities(quantities: Mapping[str, Quantity]) -> dict[str, Any]:
    """Every quantity by name."""
    keys = ("drawn", "exact", "unit", "error", "error_paper", "tolerance_paper")
    return {
        name: {key: q.unit if key == "unit" else plain_number(getattr(q, key)) for key in keys}
        for name, q in quantities.items()
    }


def plain_stations(
    phi: Floats, phase: Sequence[int], pairs: Mapping[str, tuple[Floats, Floats]], pitch: tuple[Floats, Floats]
) -> list[dict[str, Any]]:
    """The stations one after another.

    phi : cam angles [rad];  phase : which phase each belongs to
    pairs : drawn and exact values by name, each (m,);  pitch : drawn and exact points, each (m, 2)
    """
    sides = ("drawn", "exact")
    return [
        {"phi_deg": math.degrees(phi[k]), "phase": phase[k]}
        | {name: {s: plain_number(x[k]) for s, x in zip(sides, pair, strict=True)} for name, pair in pairs.items()}
        | {"pitch": {s: [plain_number(x) for x in points[k]] for s, points in zip(sides, pitch, strict=True)}}
        for k in range(len(phase))
    ]
