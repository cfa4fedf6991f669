"""The files of a solution."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

from graphcam.errors import DesignError
from graphcam.files import whole_folder
from graphcam.report.contents import last_step
from graphcam.report.documents import contents_of, note_of, sheet_of
from graphcam.report.note import comparison_file
from graphcam.report.profile_files import write_profile
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Drawing
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.solution import FILES, Solution
from graphcam.tasks.sheet_tables import one_of

DXF = "plain", "cad"
"""Kinds of DXF."""


def check_choices(solution: AnySolution, upto: int | str | None = None, *, dxf: str = "plain") -> None:
    """Refuse what :func:`write` would refuse of its choices, without drawing anything.

    Raises
    ------
    DesignError : there is no such step, construction or kind of DXF
    """
    one_of("dxf", dxf, DXF)
    if upto is not None:
        last_step(contents_of(solution), upto)


def write(
    solution: AnySolution,
    directory: Path | str,
    progress: Callable[[str], None] | None = None,
    upto: int | str | None = None,
    *,
    per_construction: bool = False,
    dxf: str = "plain",
) -> dict[str, str | None]:
    """Write the sheet, the tables, the note and ``solution.json`` into a folder: all of them, or none.

    upto, per_construction : which sheets, as for :func:`~graphcam.report.documents.sheet_of`; an unfinished sheet is
        called "worksheet", and has no step player, which shows the finished one
    dxf : "plain" for every program, or "cad" with true dimensions and an editable title block
    returns : the files' names in the folder by kind, None for a kind that there is not

    Raises
    ------
    DesignError : there is no such step, construction or kind of DXF
    OutputError : the folder cannot be written
    """
    check_choices(solution, upto, dxf=dxf)

    def report(line: str) -> None:
        if progress:
            progress(line)

    with whole_folder(directory) as folder:
        report("laying out the sheet")
        drawing = sheet_of(solution, upto, per_construction=per_construction)
        stem = "sheet" if upto is None else "worksheet"
        _write_sheet(drawing, folder, stem, dxf, report)
        if upto is None:
            report("writing the step player")
            page = player_of(solution, sheet_of(solution) if per_construction else drawing)
            (folder / "player.html").write_text(page, encoding="utf-8")
        report("writing tables and note")
        _write_csv(solution, folder / "comparison.csv")
        (folder / "comparison.md").write_text(comparison_file(solution), encoding="utf-8")
        (folder / "note.md").write_text(note_of(solution), encoding="utf-8")
        files: dict[str, str | None] = dict.fromkeys(FILES) | {
            **{kind: f"{stem}.{kind}" for kind in ("pdf", "svg", "png", "dxf")},
            "csv": "comparison.csv", "md": "comparison.md", "note": "note.md",
            "player": "player.html" if upto is None else None,
        }  # fmt: skip
        if isinstance(solution, Solution):
            files |= _profile(solution, folder)
        document = solution.to_dict() | {"files": files}
        text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
        (folder / "solution.json").write_text(text + "\n", encoding="utf-8")
    return files


def _write_sheet(drawing: Drawing, folder: Path, stem: str, dxf: str, report: Callable[[str], None]) -> None:
    """The drawing in every format, its files named after the stem."""
    # The renderers take long to load, so they come when there is something to render.
    from graphcam.sheets.cad_renderer import write_cad
    from graphcam.sheets.dxf_renderer import write_dxf
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png, write_svg

    report("writing PDF")
    write_pdf(drawing, folder / f"{stem}.pdf")
    for k, page in enumerate(drawing.pages, 1):
        name = stem if k == 1 else f"{stem}-{k}"
        report(f"writing SVG and PNG, page {k} of {len(drawing.pages)}")
        write_svg(page, folder / f"{name}.svg")
        write_png(page, folder / f"{name}.png")
    report("writing DXF")
    (write_cad if dxf == "cad" else write_dxf)(drawing, folder / f"{stem}.dxf")


def _profile(solution: Solution, folder: Path) -> dict[str, str]:
    """The files of the exact profile; none where none can be cut, of which the solution warns."""
    try:
        return write_profile(solution.cam, folder)
    except DesignError:
        return {}


def _write_csv(solution: AnySolution, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["quantity", "unit", "drawn", "exact", "error", "error_paper_mm", "tolerance_paper_mm"])
        for q in solution.comparison.quantities.values():
            values = (q.drawn, q.exact, q.error, q.error_paper, q.tolerance_paper)
            table.writerow([q.name, q.unit, *(x if math.isfinite(x) else "" for x in values)])
