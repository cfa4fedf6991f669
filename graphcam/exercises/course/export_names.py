"""Names of folders and files as learning systems pack what was handed in: whose it is, which file, which attempt."""

import re
from dataclasses import dataclass

MOODLE = re.compile(r"(?P<whose>.+)_\d+_assignsubmission_(?:file|onlinetext)(?:_(?P<file>.*))?", re.DOTALL)
"""Name_1234_assignsubmission_file_, a folder, or with the name of the file behind it; the number is nobody's id."""
BLACKBOARD = re.compile(
    r"(?P<whose>.+)_attempt_(?P<attempt>\d{4}(?:-\d\d){5})(?:_(?P<file>.+)|\.(?P<info>txt))?", re.DOTALL
)
"""Assignment_username_attempt_2026-11-20-12-30-00_answers.toml; the one that ends .txt tells about the attempt."""
CANVAS = re.compile(r"(?P<whose>[^_]+)(?:_LATE)?_(?P<number>\d+)_\d+_(?P<file>.+)", re.DOTALL)
"""lastfirst_12345_67890_answers.toml: the number of the user, then that of the submission."""


@dataclass(frozen=True)
class ExportName:
    """What the name of a folder or file says.

    whose : texts of which one is the student's id, address or name
    file : as it was called when it was handed in; empty of a folder, and of a file that holds no answers
    attempt : greater of a later one; empty where there is but one
    """

    whose: tuple[str, ...]
    file: str = ""
    attempt: str = ""


def export_name(name: str) -> ExportName | None:
    """What the name says; None of one that no learning system gives.

    >>> export_name("Anna Berg_1234_assignsubmission_file_")
    ExportName(whose=('Anna Berg',), file='', attempt='')
    >>> export_name("berganna_LATE_12345_67890_answers.toml")
    ExportName(whose=('berganna', '12345'), file='answers.toml', attempt='')
    >>> export_name("Cams_1_aberg_attempt_2026-11-20-12-30-00_answers.dxf").whose
    ('aberg', '1_aberg', 'Cams_1_aberg')
    >>> export_name("Anna Berg")
    """
    if found := MOODLE.fullmatch(name):
        return ExportName((found["whose"],), found["file"] or "")
    if found := BLACKBOARD.fullmatch(name):
        # Both the assignment and the user may have underscores in their names.
        parts = found["whose"].split("_")
        whose = tuple("_".join(parts[k:]) for k in reversed(range(len(parts))))
        return ExportName(whose, found["file"] or "", found["attempt"])
    if found := CANVAS.fullmatch(name):
        return ExportName((found["whose"], found["number"]), found["file"])
    return None
