"""The files of the exact profile, which CAD and CAM programs import.

``profile.csv`` is a table, ``profile.xyz`` a curve through points (x, y, z = 0 on each line, closed), ``profile.dxf``
one B-spline, all in mm with the cam centre at the origin.  They hold the profile that can be cut: what a roller too
large would lose is left out.
"""

import csv
from collections.abc import Collection
from pathlib import Path
from typing import Literal

import numpy as np

from graphcam.given.motion import wrap
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.conjugate_cam import ConjugateCam
from graphcam.mechanism.profile_spline import ProfileSpline
from graphcam.mechanism.undercut import CutProfile, trimmed_profile
from graphcam.plane_vectors import turned

PROFILE_POINTS = 720
"""The number of points on the profile, one for each half degree of the cam angle."""
FILE_NAMES = {"profile_dxf": "profile.dxf", "profile_csv": "profile.csv", "profile_xyz": "profile.xyz"}


def write_curves(
    cam: Cam | ConjugateCam,
    spline: ProfileSpline | None,
    folder: Path,
    kinds: Collection[str] = tuple(FILE_NAMES),
    curve: Literal["", "outer", "second"] = "",
) -> dict[str, str]:
    """Write the wanted ones of the three files into a folder; returns the file names by kind.

    spline : of the profile that can be cut, for the DXF; None where that is not wanted
    curve : "outer" for the other wall of a groove, whose files are named profile-outer, "second" for a second cam

    Raises
    ------
    DesignError : no profile can be cut
    """
    from graphcam.sheets.dxf_renderer import write_spline

    wanted = {
        kind: name.replace("profile", f"profile-{curve}" if curve else "profile")
        for kind, name in FILE_NAMES.items()
        if kind in kinds
    }
    if spline and "profile_dxf" in wanted:
        told = {"greatest distance from the exact profile, mm": f"{spline.deviation:.2g}"}
        write_spline(spline.control, spline.knots, folder / wanted["profile_dxf"], layer="profile", told=told)
    tables = {
        kind: write for kind, write in (("profile_csv", _write_csv), ("profile_xyz", _write_xyz)) if kind in kinds
    }
    if tables:
        envelope = cam.outer_wall if curve == "outer" else cam.envelope
        cut = _from_table_zero(cam, trimmed_profile(envelope, PROFILE_POINTS))
        for kind, write in tables.items():
            write(cut, folder / wanted[kind])
    return wanted


def _from_table_zero(cam: Cam | ConjugateCam, cut: CutProfile) -> CutProfile:
    """The profile with the cam angles of the table that the motion was made of, and turned so."""
    return CutProfile(wrap(cut.phi + cam.motion.origin), turned(cut.points, cam.table_turn), cut.corner)


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
