"""The command line: each large command has a module, the short ones share one."""

import atexit
import gc
import warnings
from typing import Annotated

import typer
from typer import Option

import graphcam
from graphcam.cli.command_language import in_language_of_machine, use_machine_language
from graphcam.cli.commands import bench, init, notebook, sweep
from graphcam.cli.exercise import exercise
from graphcam.cli.next_steps import show_next_steps
from graphcam.cli.size import size
from graphcam.cli.solve import solve
from graphcam.cli.studio import studio
from graphcam.cli.usage_errors import CommandGroup

app = typer.Typer(
    name="graphcam", cls=CommandGroup, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode="rich"
)


def main() -> None:
    """Run the command line; what libraries warn of is for programmers."""
    warnings.simplefilter("ignore")
    # Python looks through all that was loaded and drawn once more at its end, which takes a tenth of the whole time.
    atexit.register(gc.freeze)
    in_language_of_machine(typer.main.get_command(app))(prog_name="graphcam")


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"graphcam {graphcam.__version__}")
        raise typer.Exit


@app.callback(invoke_without_command=True)
def options(
    context: typer.Context,
    version: Annotated[
        bool, Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Design a cam as on the drawing board: drawn step by step and to scale, and compared with exact values.

    [bold]Examples[/bold]

    graphcam solve   (the built-in coursework task, into graphcam-out)

    graphcam init cam.toml   (a commented task file to change)

    graphcam solve cam.toml --out cam
    """
    use_machine_language()
    if context.invoked_subcommand is None:
        show_next_steps()


for command in (solve, size, studio, notebook, bench, sweep, init):
    app.command()(command)
app.add_typer(exercise)
