"""The files of a solution, written into one folder: all of them, or none."""

from __future__ import annotations

import csv
import json
import math
import warnings
from collections.abc import Callable, Collection, Mapping
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphcam.errors import DesignError, LetteringWarning, suggestion
from graphcam.files import digest, whole_folder
from graphcam.mechanism.profile_spline import profile_spline
from graphcam.report.documents import contents_of, drawing_of, note_of, note_page_of
from graphcam.report.note import comparison_file
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Drawing
from graphcam.sheets.typefaces import missing_characters
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.shown_solution import CUTTING_KINDS, DEFAULT_KINDS, FILE_KINDS, without_answers
from graphcam.solving.solution import Solution
from graphcam.tasks.sheet_tables import check_choice
from graphcam.words import Words, and_chain, say
from graphcam.workshop.profile_files import FILE_NAMES, write_curves

if TYPE_CHECKING:
    from graphcam.workshop.part_contents import PartContents

DXF_KINDS = "plain", "cad"
FONT_PACKAGE = "fonts-noto-cjk"
"""A package of fonts with more characters than any other, for the advice."""
MAX_NAMED_CHARACTERS = 12
"""The maximum number of missing characters that a warning names; a sheet in Chinese has hundreds."""
SHEET_KINDS = "pdf", "svg", "png", "dxf"
SOLUTION_FILE = "solution.json"
"""The name of the file that lists all others."""
PART_KINDS = "pdf", "svg", "dxf"
"""The kinds of files that show the working drawing of the cam."""


def check_choices(
    solution: AnySolution,
    upto: int | str | None = None,
    *,
    dxf: str = "plain",
    files: Collection[str] | None = None,
    working_drawing: bool = False,
) -> None:
    """Refuse, without drawing anything, choices that :func:`write` would refuse.

    Raises
    ------
    DesignError : there is no such step, construction, kind of DXF or kind of file, a working drawing is asked for with
        an unfinished sheet, or there can be no such part
    """
    _check_names(solution, upto, dxf, files, working_drawing=working_drawing)
    if working_drawing:
        _checked_part(solution)


def _check_names(
    solution: AnySolution, upto: int | str | None, dxf: str, files: Collection[str] | None, *, working_drawing: bool
) -> None:
    check_choice("dxf", dxf, DXF_KINDS)
    if upto is not None:
        if working_drawing:
            unfinished = say("left out where the sheet is drawn up to a step"), say("it would give the answers away")
            raise DesignError("working_drawing", say("asked for"), *unfinished)
        contents_of(solution).last_step(upto)
    # A text is a collection of letters, none of which is meant.
    if isinstance(files, str):
        limit = say("a list of kinds")
        raise DesignError("files", files, limit, say("for this one alone write ['{files}']", files=files))
    unknown = [kind for kind in files or () if kind not in FILE_KINDS]
    if unknown:
        limit = say("a list of kinds among {names}", names=", ".join(FILE_KINDS))
        raise DesignError("files", unknown[0], limit, suggestion(unknown[0], FILE_KINDS))


def _checked_part(solution: AnySolution) -> PartContents:
    """The part, after checking that there can be a working drawing of it."""
    # What makes the part is loaded only when it is asked for.
    from graphcam.workshop.part_contents import PartContents

    part = PartContents(solution)
    part.check()
    return part


def write(
    solution: AnySolution,
    directory: Path | str,
    files: Collection[str] | None = None,
    *,
    upto: int | str | None = None,
    per_construction: bool = False,
    dxf: str = "plain",
    working_drawing: bool = False,
    progress: Callable[[Words], None] | None = None,
) -> dict[str, str | None]:
    """Write a solution into a folder, as :meth:`~graphcam.solving.shown_solution.ShownSolution.write` says."""
    _check_names(solution, upto, dxf, files, working_drawing=working_drawing)
    part = _checked_part(solution) if working_drawing else None
    finished, report = upto is None, progress or ignore_progress
    # Solid and program are of the edge of a disk, not of a groove.
    cutting = CUTTING_KINDS if part and part.given.groove_depth is None else ()
    wanted = _wanted_kinds(files, finished=finished, usual=(*DEFAULT_KINDS, *cutting))
    written: dict[str, str | None] = dict.fromkeys(FILE_KINDS)
    contents = contents_of(solution, per_construction=per_construction)
    solution = contents.solution
    with whole_folder(directory, written_before(Path(directory), SOLUTION_FILE)) as folder:
        sheets = [kind for kind in SHEET_KINDS if kind in wanted]
        drawing = None
        if sheets:
            report(say("laying out the sheet"))
            drawing = drawing_of(contents, upto, per_construction=per_construction)
            _warn_of_boxes(drawing)
            written |= write_sheet(drawing, folder, "sheet" if finished else "worksheet", sheets, dxf, report)
        if "player" in wanted:
            report(say("writing the step player"))
            whole = drawing_of(contents) if drawing is None or per_construction else drawing
            (folder / "player.html").write_text(player_of(contents, whole), encoding="utf-8", newline="\n")
            written["player"] = "player.html"
        if finished:
            report(say("writing tables and note"))
        written |= _write_texts(solution, folder, wanted)
        if part:
            written |= _write_part(part, folder, report)
        names, facts = _write_profiles(solution, folder, wanted)
        written |= names | _write_cutting(solution, part, folder, wanted)
        _write_list(solution, folder, written, facts, finished=finished)
    return written


def _wanted_kinds(files: Collection[str] | None, *, finished: bool, usual: Collection[str]) -> list[str]:
    # What is not a sheet holds answers.
    return [kind for kind in (usual if files is None else files) if finished or kind in SHEET_KINDS]


def _write_texts(solution: AnySolution, folder: Path, wanted: Collection[str]) -> dict[str, str]:
    """Write the wanted tables and notes; returns the file names by kind."""
    written: dict[str, str] = {}
    for kind, (name, text) in TEXT_FILES.items():
        if kind in wanted:
            (folder / name).write_text(text(solution), encoding="utf-8", newline="")
            written[kind] = name
    return written


def _write_list(
    solution: AnySolution, folder: Path, files: Mapping[str, str | None], facts: Mapping[str, Any], *, finished: bool
) -> None:
    """Write ``solution.json`` with ``facts`` about its files, and the digests of all other files in the folder."""
    document = {**solution.to_dict(), "files": files, **facts}
    digests = {path.name: digest(path) for path in sorted(folder.iterdir())}
    document = (document if finished else without_answers(document)) | {"written": digests}
    text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
    (folder / SOLUTION_FILE).write_text(text + "\n", encoding="utf-8", newline="\n")


def written_before(folder: Path, names: str) -> dict[str, str]:
    """The files of the last run in a folder with their digests, from its list ``names``; none without a list."""
    try:
        document = json.loads((folder / names).read_bytes())
        return {str(name): str(known) for name, known in document["written"].items()}
    except (OSError, ValueError, TypeError, LookupError, AttributeError, RecursionError):
        return {}


def written_files(folder: Path | str) -> list[str]:
    """The names of all files of the last run in a folder, ``solution.json`` too; none where there was no run."""
    names = [*written_before(Path(folder), SOLUTION_FILE)]
    return [*names, SOLUTION_FILE] if names else names


def _warn_of_boxes(drawing: Drawing) -> None:
    """Warn of the characters of a drawing that are shown as boxes, because no font on the machine has them."""
    if missing := missing_characters(text.text for text in drawing.texts):
        named = " ".join(missing[:MAX_NAMED_CHARACTERS]) + (
            f" and {more} more" if (more := len(missing) - MAX_NAMED_CHARACTERS) > 0 else ""
        )
        said = f"no font on this machine has {named}, shown as boxes; install one that has, such as {FONT_PACKAGE}"
        warnings.warn(said, LetteringWarning, stacklevel=3)


def ignore_progress(_: Words) -> None:
    """Progress that nobody asked for: does nothing."""


def _write_profiles(
    solution: AnySolution, folder: Path, wanted: Collection[str]
) -> tuple[dict[str, str], dict[str, Any]]:
    """Write the wanted files of the exact profile; returns file names by kind, and facts for ``solution.json``."""
    if not isinstance(solution, Solution) or not any(kind in FILE_NAMES for kind in wanted):
        return {}, {}
    try:
        spline = solution.profile_spline if "profile_dxf" in wanted else None
        names = write_curves(solution.cam, spline, folder, wanted)
    except DesignError as error:
        # Where nothing can be cut the solution warns of it; what was asked for is refused.
        if error.quantity.startswith("part."):
            raise
        return {}, {}
    names |= _write_other_curves(solution, folder, wanted)
    if spline is None:
        return names, {}
    told = {"degree": spline.degree, "control_points": len(spline.control), "deviation": spline.deviation}
    return names, {"profile_spline": told}


def _write_other_curves(solution: Solution, folder: Path, wanted: Collection[str]) -> dict[str, str]:
    """Write the wanted files of a groove's outer wall, or of a second cam; returns the file names by kind."""
    part = solution.task.part
    if part is None or (part.groove_depth is None and part.second_roller is None):
        return {}
    from graphcam.workshop.part_contents import PartContents, second_cam

    _ = PartContents(solution).groove  # says what does not fit
    second = second_cam(solution)
    curve, side = ("second", "inner") if second else ("outer", "outer")
    cam = second or solution.cam
    spline = profile_spline(cam, trimmed=True, side=side).turned(cam.table_turn) if "profile_dxf" in wanted else None
    names = write_curves(cam, spline, folder, wanted, curve)
    return {kind.replace("profile", f"profile_{curve}"): name for kind, name in names.items()}


def _write_cutting(
    solution: AnySolution, part: PartContents | None, folder: Path, wanted: Collection[str]
) -> dict[str, str]:
    """Write the wanted files by which a machine cuts the cam; returns the file names by kind."""
    if not any(kind in CUTTING_KINDS for kind in wanted):
        return {}
    from graphcam.workshop.cutting_files import write_cutting
    from graphcam.workshop.part_contents import PartContents

    return write_cutting(part or PartContents(solution), folder, wanted)


def write_sheet(
    drawing: Drawing, folder: Path, stem: str, kinds: Collection[str], dxf: str, report: Callable[[Words], None]
) -> dict[str, str]:
    """Write the drawing in every wanted format, named after the stem; returns the file names by kind."""
    # The renderers take long to load, so they come when there is something to render.
    from graphcam.sheets.cad_renderer import write_cad
    from graphcam.sheets.dxf_renderer import write_dxf
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png
    from graphcam.sheets.svg_renderer import write_svg

    if "pdf" in kinds:
        report(say("writing PDF"))
        write_pdf(drawing, folder / f"{stem}.pdf")
    pictures = {kind: write for kind, write in (("svg", write_svg), ("png", write_png)) if kind in kinds}
    for k, page in enumerate(drawing.pages, 1):
        name = stem if k == 1 else f"{stem}-{k}"
        if pictures:
            names = and_chain([kind.upper() for kind in pictures])
            report(say("writing {names}, page {k} of {pages}", names=names, k=k, pages=len(drawing.pages)))
        for kind, write_page in pictures.items():
            write_page(page, folder / f"{name}.{kind}")
    if "dxf" in kinds:
        report(say("writing DXF"))
        (write_cad if dxf == "cad" else write_dxf)(drawing, folder / f"{stem}.dxf")
    return {kind: f"{stem}.{kind}" for kind in kinds}


def _write_part(part: PartContents, folder: Path, report: Callable[[Words], None]) -> dict[str, str]:
    """Write the working drawing, its DXF with true dimensions and attributes; returns the file names by kind."""
    from graphcam.workshop.working_drawing import working_drawing_of

    report(say("laying out the working drawing"))
    written = write_sheet(working_drawing_of(part), folder, "working-drawing", PART_KINDS, "cad", report)
    return {f"working_drawing_{kind}": name for kind, name in written.items()}


def _csv(solution: AnySolution) -> str:
    text = StringIO(newline="")
    table = csv.writer(text)
    table.writerow(["quantity", "unit", "drawn", "exact", "error", "error_paper_mm", "tolerance_paper_mm"])
    for q in solution.comparison.quantities.values():
        values = (q.drawn, q.exact, q.error, q.error_paper, q.tolerance_paper)
        table.writerow([q.name, q.unit, *(x if math.isfinite(x) else "" for x in values)])
    return text.getvalue()


TEXT_FILES: Mapping[str, tuple[str, Callable[[AnySolution], str]]] = {
    "csv": ("comparison.csv", _csv),
    "md": ("comparison.md", comparison_file),
    "note": ("note.md", note_of),
    "note_html": ("note.html", note_page_of),
}
"""The text files by kind: the name, and the function that makes the text."""
