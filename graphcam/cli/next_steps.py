"""What ``graphcam`` without a command shows: what to do next."""

import graphcam
from graphcam.cli.shared import echo
from graphcam.words import say

SUGGESTIONS = (
    (say("See what it does"), ("graphcam solve",), say("the built-in coursework task, into the folder graphcam-out")),
    (
        say("Draw a task of your own"),
        ("graphcam init cam.toml", "graphcam solve cam.toml --out cam"),
        say("in the file every key is explained"),
    ),
    (say("Move a size and watch"), ("graphcam studio",), say("a page in your browser")),
    (say("Learn it step by step"), ("graphcam notebook cam.toml --out lesson",), say("the task as a notebook")),
    (
        say("Give it to a group"),
        ("graphcam exercise list", "graphcam exercise make pressure-angle --roster roster.csv --out week-5"),
        say("a variant for each student, with answer keys"),
    ),
    (
        say("Choose among many cams"),
        ("graphcam init space.toml --sweep", "graphcam sweep space.toml --out results.csv"),
        say("every combination of sizes"),
    ),
)
"""For each thing to do next: its heading, the commands for it, and what they do."""


def show_next_steps() -> None:
    """Print what to do next, for somebody who has just installed graphcam."""
    name = f"graphcam {graphcam.__version__}"
    echo(say("{name}: cams drawn as on the drawing board, beside their exact values.", name=name))
    echo("")
    for want, commands, what in SUGGESTIONS:
        echo(say("{want} ({what}):", want=want, what=what))
        for command in commands:
            echo(f"    {command}")
    echo("")
    echo(say("All commands: graphcam --help.  Options of one, with examples: graphcam solve --help."))
