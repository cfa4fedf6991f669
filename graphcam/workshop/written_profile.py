"""The exact profile of a cam as files for CAD and machines, without a task; for own laws and measured motions too."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields
from pathlib import Path
from typing import Any, Literal, get_args

from graphcam.errors import DesignError, check_kind, nearest_word_remedy, suggestion
from graphcam.files import whole_folder
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.conjugate_cam import ConjugateCam
from graphcam.mechanism.profile_spline import ProfileSpline, profile_spline
from graphcam.tasks.part_table import PartTable
from graphcam.words import say
from graphcam.workshop import cutting_files, profile_files
from graphcam.workshop.cam_part import cam_part
from graphcam.workshop.part_outline import of_cam
from graphcam.workshop.plane_loops import spline_loop

FileKind = Literal["csv", "dxf", "xyz", "step", "gcode"]
FILE_KINDS: tuple[FileKind, ...] = get_args(FileKind)
CURVE_KINDS = "csv", "dxf", "xyz"
"""The kinds that show the profile as a curve alone."""
SPLINE_KINDS = "dxf", "step"
"""The kinds that show the profile as a spline."""


def write_profile(
    cam: Cam | ConjugateCam,
    folder: Path | str,
    kinds: FileKind | Collection[FileKind] = ("csv", "dxf"),
    *,
    name: str = "Cam",
    groove: bool = False,
    **part: Any,
) -> dict[str, Path]:
    """Write the exact working profile into a folder, in mm with the cam centre at the origin: all files, or none.

    Parameters
    ----------
    cam : any cam, what its roller undercuts is left out of the profile; or the second cam of a conjugate pair
    folder : is made if it is not there; other files in it stay
    kinds : of these, several or one: "csv" (720 points with cam angle and polar coordinates), "dxf" (one spline),
        "xyz" (a closed curve through the same points), "step" (a solid with bore and keyway), "gcode" (a program)
    name : of the part, in the STEP file and the program
    groove : whether the roller runs in a groove: then there are also curves of its outer wall, by "outer csv" and so on
    part : what the solid, the program and the spline take from the table ``[part]`` of a task file, by the same names:
        bore, keyway, width, hub_diameter, hub_length [mm]; cutter_radius [mm], feed [mm/min], profile_tolerance [mm];
        spline_degree, spline_control_points.  What is left out follows from the cam's size

    Returns
    -------
    dict : the files by their kind; of a groove those of its outer wall too

    Raises
    ------
    DesignError : there is no such kind or no such size of a part, a groove is asked for as a solid, no profile can be
        told that could be cut, the part cannot be made of this cam, or the cutter does not reach into its hollows
    OutputError : the folder cannot be written

    >>> from math import radians
    >>> from tempfile import TemporaryDirectory
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> with TemporaryDirectory() as place:
    ...     for kind, path in gc.write_profile(cam, place, ["csv", "step", "gcode"], bore=20, cutter_radius=8).items():
    ...         print(kind, path.name, path.stat().st_size > 1000)
    csv profile.csv True
    step profile.step True
    gcode profile.ngc True
    """
    check_kind("cam", cam, (Cam, ConjugateCam))
    wanted = [kinds] if isinstance(kinds, str) else list(kinds)
    for kind in wanted:
        if kind not in FILE_KINDS:
            raise DesignError(
                "kinds", kind, say("of {names}", names=", ".join(FILE_KINDS)), suggestion(kind, FILE_KINDS)
            )
        if groove and kind not in CURVE_KINDS:
            raise DesignError("kinds", kind, say("of {names}, for a groove", names=", ".join(CURVE_KINDS)))
    table, names = _part_table(part), {f"profile_{kind}" for kind in wanted}
    splined = any(kind in SPLINE_KINDS for kind in wanted)
    spline = _spline(cam, table) if splined else None
    wall = _spline(cam, table, "outer") if splined and groove else None
    with whole_folder(folder) as draft:
        written = profile_files.write_curves(cam, spline, draft, names)
        outer = profile_files.write_curves(cam, wall, draft, names, "outer") if groove else {}
        for kind, text in _texts(cam, spline, table, name, names).items():
            written[kind] = cutting_files.FILE_NAMES[kind]
            (draft / written[kind]).write_text(text, encoding="ascii", newline="\n")
    made = {kind: Path(folder) / written[f"profile_{kind}"] for kind in wanted}
    return made | {f"outer {kind}": Path(folder) / outer[f"profile_{kind}"] for kind in wanted if groove}


def _part_table(part: dict[str, Any]) -> PartTable:
    known = [field.name for field in fields(PartTable)]
    for key in part:
        if key not in known:
            found = say("{key} = {part!r}", key=key, part=part[key])
            raise DesignError("part", found, say("what a table [part] has"), nearest_word_remedy(key, known))
    return PartTable(**part)


def _spline(cam: Cam | ConjugateCam, table: PartTable, side: Literal["inner", "outer"] = "inner") -> ProfileSpline:
    degree, count = table.spline_degree, table.spline_control_points
    return profile_spline(cam, degree=degree, control_points=count, trimmed=True, side=side).turned(cam.table_turn)


def _texts(
    cam: Cam | ConjugateCam, spline: ProfileSpline | None, table: PartTable, name: str, wanted: set[str]
) -> dict[str, str]:
    """The contents of the wanted files by which a machine cuts the cam, by their kinds."""
    texts: dict[str, str] = {}
    if not wanted & cutting_files.FILE_NAMES.keys():
        return texts
    outline = of_cam(cam)
    if spline is not None and "profile_step" in wanted:
        made, around = cam_part(table, "iso", outline.least_radius), spline_loop(spline)
        texts["profile_step"] = cutting_files.solid_around(around, spline.deviation, made, outline.zero, name)
    if "profile_gcode" in wanted:
        texts["profile_gcode"] = cutting_files.program_around(outline, table, name)
    return texts
