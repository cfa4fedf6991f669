"""What a solution of either kind shows of itself: in few lines, as its sheet, and as files."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from textwrap import wrap

from graphcam.showing import WIDTH, Shown, from_above, in_lines

FILES = ("pdf", "svg", "png", "dxf", "csv", "md", "note", "player", "profile_dxf", "profile_csv", "profile_xyz")
"""The kinds of files that a solution is written to."""


class ShownSolution(Shown):
    """A solution that plots its sheet and writes its files."""

    _drawn_in = "sheet_page"

    def write(
        self,
        folder: Path | str,
        files: Collection[str] | None = None,
        *,
        upto: int | str | None = None,
        per_construction: bool = False,
        dxf: str = "plain",
        progress: Callable[[str], None] | None = None,
    ) -> dict[str, str | None]:
        """Write the sheet, the step player, the tables, the note and the profile into a folder: all of them, or none.

        files : kinds among :data:`FILES`, by default all; ``solution.json``, which names the others, always comes along
        upto, per_construction : which sheets, as for :func:`~graphcam.report.documents.sheet_of`; an unfinished sheet
            is called "worksheet", and has no step player, which shows the finished one
        dxf : "plain" for every program, or "cad" with true dimensions and an editable title block
        progress : hears what is being done
        returns : the files' names in the folder by kind, None for a kind that there is not

        Raises
        ------
        DesignError : there is no such kind of file, step, construction or kind of DXF
        OutputError : the folder cannot be written

        >>> import graphcam as gc
        >>> from tempfile import TemporaryDirectory
        >>> with TemporaryDirectory() as folder:
        ...     written = gc.solve(gc.builtin_task()).write(folder, ["csv", "note"])
        >>> [name for name in written.values() if name]
        ['comparison.csv', 'note.md']
        """
        choices = {"upto": upto, "per_construction": per_construction, "dxf": dxf, "progress": progress}
        return from_above("report.output_folder.write")(self, folder, files, **choices)

    def _in_lines(self, name: str, mechanism: object, drawn: Iterable[str]) -> str:
        # The last line of the mechanism says how to go on from there.
        *sizes, _ = repr(mechanism).splitlines()
        last = ".drawn[name], .comparison, .to_dict(); .plot() draws the sheet, .write(folder) writes the files"
        rows = [size.strip() for size in sizes] + wrap("drawn: " + ", ".join(drawn), WIDTH)
        return in_lines(f"{type(self).__name__} of {name!r}", rows, last)
