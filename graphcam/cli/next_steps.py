"""What ``graphcam`` alone shows: what to do next."""

from __future__ import annotations

import typer

import graphcam

NEXT = (
    ("See what it does", ("graphcam solve",), "the built-in coursework task, into the folder graphcam-out"),
    (
        "Draw a task of your own",
        ("graphcam init cam.toml", "graphcam solve cam.toml --out cam"),
        "in the file every key is explained",
    ),
    ("Move a size and watch", ("graphcam studio",), "a page in your browser"),
    ("Learn it step by step", ("graphcam notebook cam.toml --out lesson",), "the task as a notebook"),
    (
        "Give it to a group",
        ("graphcam exercise list", "graphcam exercise make pressure-angle --roster roster.csv --out week-5"),
        "a variant for each student, with answer keys",
    ),
    (
        "Choose among many cams",
        ("graphcam init space.toml --sweep", "graphcam sweep space.toml --out results.csv"),
        "every combination of sizes",
    ),
)
"""What somebody may want, the commands for it, and what they do."""


def show_next_steps() -> None:
    """Print what to do next, for somebody who has just installed graphcam."""
    lines = [f"graphcam {graphcam.__version__}: cams drawn as on the drawing board, beside their exact values.", ""]
    for want, commands, what in NEXT:
        lines += [f"{want} ({what}):", *(f"    {command}" for command in commands)]
    lines += ["", "All commands: graphcam --help.  Options of one, with examples: graphcam solve --help."]
    typer.echo("\n".join(lines))
