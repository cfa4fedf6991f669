"""The files of a solution, and those of its exact profile, which CAD and CAM programs import.

``profile.csv`` is a table, ``profile.xyz`` a curve through points (x, y, z = 0 on each line, closed), ``profile.dxf``
one B-spline, all in mm with the cam centre at the origin.  All three hold the profile that can be cut: what a roller
too large would lose is left out.
"""

import csv
import json
import math
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from io import StringIO
from pathlib import Path

import numpy as np

from graphcam.errors import DesignError, nearest
from graphcam.files import whole_folder
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.spline import profile_spline
from graphcam.mechanism.undercut import CutProfile, trimmed_profile
from graphcam.report.documents import contents_of, drawing_of, note_of
from graphcam.report.note import comparison_file
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Drawing
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.shown_solution import FILES
from graphcam.solving.solution import Solution
from graphcam.tasks.sheet_tables import one_of

POINTS = 720
"""On the profile: one for every half degree of the cam angle."""
NAMES = {"profile_dxf": "profile.dxf", "profile_csv": "profile.csv", "profile_xyz": "profile.xyz"}
DXF = "plain", "cad"
"""Kinds of DXF."""
SHEETS = "pdf", "svg", "png", "dxf"
"""The kinds of files that show the sheet."""


def write_profile(cam: Cam, folder: Path, kinds: Collection[str] = tuple(NAMES)) -> dict[str, str]:
    """Write those of the three files into a folder that are wanted; returns their names by kind.

    Raises
    ------
    DesignError : no profile can be told that could be cut
    """
    from graphcam.sheets.dxf_renderer import write_spline

    wanted = {kind: name for kind, name in NAMES.items() if kind in kinds}
    if not wanted:
        return {}
    cut, spline = trimmed_profile(cam.envelope, POINTS), profile_spline(cam, trimmed=True)
    if "profile_dxf" in wanted:
        write_spline(spline.control, spline.knots, folder / wanted["profile_dxf"], layer="profile")
    if "profile_csv" in wanted:
        _write_csv(cut, folder / wanted["profile_csv"])
    if "profile_xyz" in wanted:
        _write_xyz(cut, folder / wanted["profile_xyz"])
    return wanted


def _write_csv(cut: CutProfile, path: Path) -> None:
    x, y = cut.points.T
    columns = np.degrees(cut.phi), x, y, np.hypot(x, y), np.degrees(np.arctan2(y, x)) % 360
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["phi_deg", "x", "y", "radius", "angle_deg"])
        table.writerows([f"{value:.9f}" for value in row] for row in zip(*columns, strict=True))


def _write_xyz(cut: CutProfile, path: Path) -> None:
    closed = np.append(cut.points, cut.points[:1], axis=0)
    lines = (f"{x:.9f}\t{y:.9f}\t{0:.9f}\n" for x, y in closed.tolist())
    path.write_text("".join(lines), encoding="ascii", newline="\n")


def check_choices(
    solution: AnySolution, upto: int | str | None = None, *, dxf: str = "plain", files: Collection[str] | None = None
) -> None:
    """Refuse what :func:`write` would refuse of its choices, without drawing anything.

    Raises
    ------
    DesignError : there is no such step, construction, kind of DXF or kind of file
    """
    one_of("dxf", dxf, DXF)
    if upto is not None:
        contents_of(solution).last_step(upto)
    # A text is a collection of letters, none of which is meant.
    if isinstance(files, str):
        raise DesignError("files", files, "a list of kinds", f"for this one alone write ['{files}']")
    unknown = [kind for kind in files or () if kind not in FILES]
    if unknown:
        raise DesignError("files", unknown[0], f"a list of kinds among {', '.join(FILES)}", nearest(unknown[0], FILES))


def write(
    solution: AnySolution,
    directory: Path | str,
    files: Collection[str] | None = None,
    *,
    upto: int | str | None = None,
    per_construction: bool = False,
    dxf: str = "plain",
    progress: Callable[[str], None] | None = None,
) -> dict[str, str | None]:
    """Write a solution into a folder, as :meth:`~graphcam.solving.shown_solution.ShownSolution.write` says."""
    check_choices(solution, upto, dxf=dxf, files=files)
    wanted, report = FILES if files is None else files, progress or unheard
    written: dict[str, str | None] = dict.fromkeys(FILES)
    contents = contents_of(solution)
    with whole_folder(directory) as folder:
        sheets = [kind for kind in SHEETS if kind in wanted]
        drawing = None
        if sheets:
            report("laying out the sheet")
            drawing = drawing_of(contents, upto, per_construction=per_construction)
            written |= _write_sheet(drawing, folder, "sheet" if upto is None else "worksheet", sheets, dxf, report)
        if "player" in wanted and upto is None:
            report("writing the step player")
            whole = drawing_of(contents) if drawing is None or per_construction else drawing
            (folder / "player.html").write_text(player_of(contents, whole), encoding="utf-8")
            written["player"] = "player.html"
        report("writing tables and note")
        for kind, (name, text) in TABLES.items():
            if kind in wanted:
                (folder / name).write_text(text(solution), encoding="utf-8", newline="")
                written[kind] = name
        if isinstance(solution, Solution):
            # Where none can be cut the solution warns of it.
            with suppress(DesignError):
                written |= write_profile(solution.cam, folder, wanted)
        text = json.dumps(solution.to_dict() | {"files": written}, indent=2, ensure_ascii=False, allow_nan=False)
        (folder / "solution.json").write_text(text + "\n", encoding="utf-8")
    return written


def unheard(_: str) -> None:
    """What hears of the progress where nobody asks for it."""


def _write_sheet(
    drawing: Drawing, folder: Path, stem: str, kinds: Collection[str], dxf: str, report: Callable[[str], None]
) -> dict[str, str]:
    """The drawing in every format that is wanted, its files named after the stem."""
    # The renderers take long to load, so they come when there is something to render.
    from graphcam.sheets.cad_renderer import write_cad
    from graphcam.sheets.dxf_renderer import write_dxf
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png, write_svg

    if "pdf" in kinds:
        report("writing PDF")
        write_pdf(drawing, folder / f"{stem}.pdf")
    pictures = {kind: write for kind, write in (("svg", write_svg), ("png", write_png)) if kind in kinds}
    for k, page in enumerate(drawing.pages, 1):
        name = stem if k == 1 else f"{stem}-{k}"
        if pictures:
            report(f"writing {' and '.join(map(str.upper, pictures))}, page {k} of {len(drawing.pages)}")
        for kind, write_page in pictures.items():
            write_page(page, folder / f"{name}.{kind}")
    if "dxf" in kinds:
        report("writing DXF")
        (write_cad if dxf == "cad" else write_dxf)(drawing, folder / f"{stem}.dxf")
    return {kind: f"{stem}.{kind}" for kind in kinds}


def _csv(solution: AnySolution) -> str:
    text = StringIO(newline="")
    table = csv.writer(text)
    table.writerow(["quantity", "unit", "drawn", "exact", "error", "error_paper_mm", "tolerance_paper_mm"])
    for q in solution.comparison.quantities.values():
        values = (q.drawn, q.exact, q.error, q.error_paper, q.tolerance_paper)
        table.writerow([q.name, q.unit, *(x if math.isfinite(x) else "" for x in values)])
    return text.getvalue()


TABLES: Mapping[str, tuple[str, Callable[[AnySolution], str]]] = {
    "csv": ("comparison.csv", _csv),
    "md": ("comparison.md", comparison_file),
    "note": ("note.md", note_of),
}
"""The files of text: name, and what stands in it."""
