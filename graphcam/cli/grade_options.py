"""Options of ``graphcam exercise grade``: whose answers are graded, how marks are made, and what the pages show."""

from pathlib import Path
from typing import Annotated

from typer import Option

from graphcam.cli.shared import named

SecretFile = Annotated[
    Path | None, Option(parser=named, metavar="F", help="The course's secret, if not the one in its folder 'teacher'.")
]
Roster = Annotated[
    Path | None,
    Option(parser=named, metavar="CSV", help="The students, instead of the roster the course was made for."),
]
Overrides = Annotated[
    Path | None,
    Option(parser=named, metavar="CSV", help="Marks by hand, instead of overrides.csv in the teacher's folder."),
]
FollowThrough = Annotated[
    float | None, Option(metavar="PART", help="Of its marks, for what follows from a student's own answers.")
]
Near = Annotated[float | None, Option(metavar="K", help="An answer earns a part of its marks up to K tolerances off.")]
Caps = Annotated[
    list[str] | None, Option(metavar="MISTAKE=PART", help="Part of all marks left with a mistake; again for more.")
]
Deadline = Annotated[
    str, Option(metavar="TIME", help="2026-12-01T23:59, in the zone of this machine, or with one: +01:00.")
]
Late = Annotated[
    str, Option(metavar="PART/day", help="Lost per started day (or hour), to a minimum part: 0.1/day:0.5.")
]
Attempts = Annotated[
    str, Option(metavar="last|best", help="Which attempt counts; best:3 is the best of the first three.")
]
Anonymous = Annotated[
    bool, Option("--anonymous", help="Pages show names made from the secret; a table tells you whose they are.")
]
ShowRight = Annotated[
    bool, Option("--show-right", help="Students' pages show what is right; not before the last deadline.")
]
