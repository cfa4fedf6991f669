"""The files by which a machine cuts the cam: the part as a solid, and a program of G-code.

``profile.step`` and ``profile.ngc`` are in mm with the cam centre at the origin, as the files of the profile are.
"""

from collections.abc import Collection
from pathlib import Path

from graphcam import __version__
from graphcam.errors import DesignError
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.tasks.part_table import PartTable
from graphcam.words import say
from graphcam.workshop.cam_part import CamPart, profile_tolerance
from graphcam.workshop.cutter_path import MIN_TOLERANCE, cutter_path, cutting_program
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.part_outline import Outline
from graphcam.workshop.plane_loops import Loop, spline_loop
from graphcam.workshop.solid import solid_file

FILE_NAMES = {"profile_step": "profile.step", "profile_gcode": "profile.ngc"}
PROGRAM_TOLERANCE_SHARE = 0.1
"""The tolerance of the program, as a part of the profile's."""
ARC_TOLERANCE = 1e-6
"""The tolerance for the arcs of a cam of arcs [mm]."""


def write_cutting(contents: PartContents, folder: Path, kinds: Collection[str]) -> dict[str, str]:
    """Write the solid and the program into a folder, those of the wanted kinds; returns the file names by kind.

    Raises
    ------
    DesignError : no profile can be cut, the part cannot be made of this cam, or the cutter does not
        reach into its hollows
    """
    texts = {"profile_step": solid_text, "profile_gcode": program_text}
    written = {kind: (name, texts[kind](contents)) for kind, name in FILE_NAMES.items() if kind in kinds}
    for name, text in written.values():
        (folder / name).write_text(text, encoding="ascii", newline="\n")
    return {kind: name for kind, (name, _) in written.items()}


def solid_text(contents: PartContents) -> str:
    """The text of the STEP file of a cam, as the part that its task describes.

    >>> import graphcam as gc
    >>> solid_text(PartContents(gc.solve(gc.builtin_arcs_task()))).count("CYLINDRICAL_SURFACE")
    12
    """
    _check_edge(contents)
    around, near = _outline_loop(contents)
    return solid_around(around, near, contents.part, contents.outline.zero, contents.solution.task.title.name)


def _check_edge(contents: PartContents) -> None:
    """Refuse a groove: solid and program are of the edge of a disk."""
    if contents.given.groove_depth is not None:
        limit = say("left out for a solid or a program")
        remedy = say("make the groove from profile.dxf and profile-outer.dxf")
        raise DesignError("part.groove_depth", contents.given.groove_depth, limit, remedy)


def solid_around(around: Loop, near: float, part: CamPart, zero: float, name: str) -> str:
    """The text of the STEP file of a part with the outline ``around``, which is exact within ``near`` mm."""
    said = f"cam, in mm; greatest distance from the exact profile {near:.2g} mm"
    return solid_file(around, part, zero, name, said, f"graphcam {__version__}")


def _outline_loop(contents: PartContents) -> tuple[Loop, float]:
    """The outline as edges and its error [mm]: the arcs of a cam of arcs, otherwise the spline."""
    solution = contents.solution
    if isinstance(solution, ArcsSolution):
        path = cutter_path(contents.outline, 0.0, ARC_TOLERANCE)
        return [move.reversed() for move in reversed(path.contour)], path.error
    return spline_loop(solution.profile_spline), solution.profile_spline.deviation


def program_text(contents: PartContents) -> str:
    """The G-code for a cam, with the cutter and the feed of its task.

    >>> import graphcam as gc
    >>> program_text(PartContents(gc.solve(gc.builtin_task()))).splitlines()[3]
    '(TOLERANCE 0.005 MM, GREATEST DISTANCE FROM THE EXACT WAY 0.0050 MM)'
    """
    _check_edge(contents)
    return program_around(contents.outline, contents.given, contents.solution.task.title.name)


def program_around(outline: Outline, table: PartTable, name: str) -> str:
    """The G-code around an outline, with the cutter and the feed of a table ``[part]``."""
    allowed = PROGRAM_TOLERANCE_SHARE * profile_tolerance(table, outline.greatest_radius)
    return cutting_program(
        outline,
        cutter_radius=table.cutter_radius or 0.0,
        tolerance=max(allowed, MIN_TOLERANCE),
        feed=table.feed,
        name=name,
    )
