"""Options of ``graphcam exercise grade``: whose answers are graded, how marks are made, and what the pages show."""

from pathlib import Path
from typing import Annotated

from typer import Option

from graphcam.cli.shared import named

SecretFile = Annotated[
    Path | None,
    Option(parser=named, metavar="F", help="The course's secret, if it is not in the course's folder 'teacher'."),
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
    float | None,
    Option(
        metavar="PART", help="Part of an answer's marks for a correct follow-through from the student's own answers."
    ),
]
Near = Annotated[
    float | None, Option(metavar="K", help="An answer that is up to K tolerances off earns part of its marks.")
]
Caps = Annotated[
    list[str] | None,
    Option(
        metavar="MISTAKE=PART", help="Maximum part of all marks with this mistake; repeat the option for more mistakes."
    ),
]
Deadline = Annotated[
    str, Option(metavar="TIME", help="2026-12-01T23:59, in the time zone of this machine, or with a time zone: +01:00.")
]
Late = Annotated[
    str,
    Option(metavar="PART/day", help="Part of the marks lost per day (or hour) begun, down to a minimum: 0.1/day:0.5."),
]
Attempts = Annotated[
    str, Option(metavar="last|best", help="Which attempt counts; best:3 is the best of the first three.")
]
Anonymous = Annotated[
    bool,
    Option("--anonymous", help="Pages show names made from the secret instead of ids; a table says whose they are."),
]
ShowRight = Annotated[
    bool, Option("--show-right", help="Students' pages show the right answers; not before the last deadline.")
]
