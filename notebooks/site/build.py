"""Builds the site: ``python notebooks/site/build.py``, or with ``--no-execute`` in a minute.

The pages of this folder, the notebooks with their outputs, the gallery of sheets and the reference of the public names
are laid together in a temporary folder; Sphinx makes the site of it, and a warning fails the build.
"""

from __future__ import annotations

import argparse
import inspect
import re
import runpy
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterable
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from types import ModuleType
from typing import Any

import jupytext
import nbformat
from docstrings import public_names
from graded_page import graded_page
from nbformat import NotebookNode
from PIL import Image
from sphinx.cmd.build import build_main
from studio_links import FOLDER, studio_page, try_it
from task_file_page import task_file_page

import graphcam as gc
from graphcam.bench.hard_cases import computed_rows, drawn_rows, hard_cases_page
from graphcam.notebooks.notebook_execution import execute

HERE = Path(__file__).parent
COURSE = HERE.parent
NOTEBOOKS = sorted(COURSE.glob("[0-9][0-9]_*.py"))
NEEDED = "task.toml", "hard_cases.toml"
"""What the notebooks read beside them."""
CONTENTS_PATTERN = re.compile(r"# (\d+\. .*?) \*\*Aim\..*\*\*You need\*\* (.*)\*\*Time:\*\* ([^.]*)")
"""Title, needs and time in a notebook's first cell."""
GALLERY = {
    "coursework": "A translating roller follower: constant acceleration, the cam turns clockwise.",
    "arm": "An oscillating follower.",
    "flat": "A flat-faced follower.",
    "swinging-face": "An oscillating flat-faced follower.",
    "measured": "A motion given as a measured table.",
    "arcs": "A cam of three circular arcs.",
    "sizing": "The smallest cam within ranges and limits, by graphcam size.",
}
"""The built-in tasks, and what is seen on their sheets."""
SHEET_DPI = 60
"""Of the gallery's pictures: small to load, and the captions can still be read."""
COLOURS = 32
PICTURES = "graded.png", "bench-time.png"
"""Of README, which the first page shows too."""
GROUPS = {
    "motion": ("Motions, followers, loads", ("given",)),
    "exact": ("Exact values", ("mechanism", "comparison")),
    "drawn": ("The drawing board", ("drafting", "constructions")),
    "tasks": ("Tasks and solutions", ("tasks", "solving", "report", "workshop", "sweeps", "studio")),
    "errors": ("Errors", ("errors",)),
}
"""The pages of the reference: title, and the rooms whose public names stand there."""
SUBJECTS = {
    "Laws and motions": "LAWS law Law Rise Dwell Return Motion cam_angle DegreesWarning",
    "Laws and motions of your own": "boundary_law boundary_motion BoundaryMotion MotionPoint PolynomialPart SplinePart "
    "constant_velocity_law sampled_law",
    "Measured motions and given cams": "measured_motion MeasuredMotion integrated_motion IntegratedMotion cam_by_radii "
    "ArcOutline cam_through_points PointOutline outline_motion OutlineMotion TracedMotion three_arc_cam ThreeArcCam ArcMotion",
    "Followers and the cam": "Translating Oscillating FlatFaced OscillatingFlat Cam Undercut largest_roller face_width "
    "FaceWidth face_reach FaceReach ConjugateCam circumradius",
    "Least sizes": "Limits minimum_radius MinimumRadius ArmMinimumRadius FlatMinimumRadius size_cam SizedCam size_task "
    "Sizing sizing_sheet radius_sensitivity",
    "Many designs": "Designs grid sweep Swept",
    "Springs, forces and torque": "SpringLoad ArmLoad ArmSpring LoadCurve Guide spring_preload SpringPreload Contact "
    "CamForces jamming_margin mean_torque",
    "Contact stress": "RollerContact ContactStress hertz_line_contact LineContact contact_by_elements ElementContact",
    "Vibration": "follower_response FollowerResponse shock_spectrum ShockSpectrum FollowerTrain VibratingFollower TrainMotion",
    "Manufacturing": "MakingErrors Deviations MadeCam sensitivities Sensitivities motion_bands MotionBands profile_spline "
    "ProfileSpline write_profile",
    "Tasks and the drawing board": "Task ArcsTask load_task builtin_task builtin_arcs_task solve Solution ArcsSolution "
    "Construction Step Reading Scale Pencil studio",
    "Errors": "GraphcamError DesignError TaskError",
}
"""The public names by subject."""


def stored(path: Path) -> NotebookNode:
    """A notebook as it is stored, without outputs."""
    return jupytext.read(path)


def run(path: Path) -> NotebookNode:
    """A notebook with its outputs, from a clean kernel."""
    print(f"executing {path.stem}", flush=True)
    return execute(jupytext.read(path), COURSE)


def build(
    out: Path,
    notebook: Callable[[Path], NotebookNode] = run,
    sheets: Iterable[str] = GALLERY,
    pyodide: Path | None = None,
) -> int:
    """Build the site into the folder; 0 where nothing is wrong.

    notebook : reads a notebook of the course, with its outputs if the site shall show them
    sheets : the built-in tasks of the gallery whose sheets are drawn
    pyodide : folder with Pyodide and NumPy, of which the studio is made; without it the site has no studio
    """
    with tempfile.TemporaryDirectory(prefix="graphcam-site-") as folder:
        source = Path(folder) / "source"
        shutil.copytree(HERE / "pages", source)
        for name in PICTURES:
            shutil.copy(COURSE.parent / ".readme" / name, source)
        shutil.copy(COURSE.parent / "exercises" / "README.md", source / "exercises.md")
        for name in NEEDED:
            shutil.copy(COURSE / name, source / "course" / name)
        for path in NOTEBOOKS:
            lesson = notebook(path)
            if pyodide:
                lesson.cells[0].source += f"\n\n{try_it(path.stem)}"
            lesson.cells[0].source += f"\n\n{{download}}`Download this notebook <{path.stem}.ipynb>`"
            nbformat.write(lesson, source / "course" / f"{path.stem}.ipynb")
        write_contents(source / "course" / "index.md")
        if pyodide:
            write_studio(source, out / FOLDER, pyodide)
        write_gallery(source / "gallery", sheets)
        write_published(source / "gallery")
        write_reference(source / "reference")
        page = hard_cases_page(computed_rows(), drawn_rows())
        (source / "hard-cases.md").write_text(page, encoding="utf-8")
        write_shown(out)
        return build_main(
            ["-q", "-W", "--keep-going", "-b", "html", "-c", str(HERE), "-d", f"{folder}/doctrees", str(source), str(out)]
        )


def write_contents(index: Path) -> None:
    """The table of the course on its page: what each notebook is about, what it needs, how long it takes."""
    rows = ["| notebook | you need | time |", "|---|---|---|"]
    for path in NOTEBOOKS:
        first = " ".join(stored(path).cells[0].source.split())
        title, needs, time = CONTENTS_PATTERN.search(first).groups()  # pyright: ignore[reportOptionalMemberAccess]
        rows.append(f"| [{title.strip()}]({path.stem}.ipynb) | {needs.strip()} | {time.strip()} |")
    text = index.read_text(encoding="utf-8")
    index.write_text(text.replace("\n```{toctree}", "\n" + "\n".join(rows) + "\n\n```{toctree}", 1), encoding="utf-8")


def write_shown(out: Path) -> None:
    """What the first page shows in frames: the step player of the coursework task, and a graded page."""
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        gc.solve(gc.builtin_task()).write(folder, files=["player"])
        shutil.copy(Path(folder) / "player.html", out)
    (out / "graded.html").write_text(graded_page(), encoding="utf-8")


def write_studio(source: Path, out: Path, pyodide: Path) -> None:
    """The studio in its folder, and its page, the first that the site lists."""
    from graphcam.studio.worker_page import write_site

    write_site(out, pyodide, gc.builtin_task())
    (source / "studio.md").write_text(studio_page(), encoding="utf-8")
    index = (source / "index.md").read_text(encoding="utf-8")
    listed = index.replace("\ninstallation\n", "\nstudio\ninstallation\n", 1)
    (source / "index.md").write_text(listed, encoding="utf-8")


def write_gallery(folder: Path, drawn: Iterable[str]) -> None:
    """The page of sheets, and their pictures."""
    from graphcam.report.documents import sheet_of
    from graphcam.report.sizing_files import chart
    from graphcam.sheets.matplotlib_renderer import write_png
    from graphcam.solving.solve import solve

    page = [(folder / "index.md").read_text(encoding="utf-8")]
    for name, caption in GALLERY.items():
        page += [f"## {caption.rstrip('.')}", f"Task: `graphcam/data/tasks/{name}.toml`"]
        if name in drawn:
            task = gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name)
            # A task with ranges is sized, and its sheet is the chart.
            drawing = chart(gc.size_task(task)) if name == "sizing" else sheet_of(solve(task))
            for number, sheet in enumerate(drawing.pages, 1):
                picture = folder / (f"{name}.png" if number == 1 else f"{name}-{number}.png")
                write_png(sheet, picture, SHEET_DPI)
                # Thin lines in a few colours: a palette says them in a third of the bytes.
                Image.open(picture).convert("RGB").quantize(COLOURS).save(picture, optimize=True)
                page += [f"[![The sheet: {caption}]({picture.name})]({picture.name})"]
    (folder / "index.md").write_text("\n\n".join(page) + "\n", encoding="utf-8")


def write_reference(folder: Path) -> None:
    """A page for each group of public names, so that no name is left out, one of the commands, one of the task file."""
    if missing := set(gc.__all__) ^ set(" ".join(SUBJECTS.values()).split()):
        raise SystemExit(f"SUBJECTS and the public names differ: {', '.join(sorted(missing))}")
    index = folder / "index.md"
    before, conventions, after = index.read_text(encoding="utf-8").partition("## Conventions")
    index.write_text(f"{before}{names_by_subject()}\n{conventions}{after}", encoding="utf-8")
    left = set(gc.__all__)
    for page, (title, rooms) in GROUPS.items():
        names = [name for name in gc.__all__ if room_of(name) in rooms]
        left -= set(names)
        text = [f"# {title}", *(entry(name) for name in names)]
        (folder / f"{page}.md").write_text("\n\n".join(text) + "\n", encoding="utf-8")
    if left:
        raise SystemExit(f"the reference has no page for {', '.join(sorted(left))}: see GROUPS")
    (folder / "commands.md").write_text(commands(), encoding="utf-8")
    (folder / "task-file.md").write_text(task_file_page(), encoding="utf-8")


def names_by_subject() -> str:
    """Tables of all public names by subject, with one sentence each.

    >>> "| {py:obj}`Cam <graphcam.Cam>` | A disk cam that gives the motion to the follower. |" in names_by_subject()
    True
    """
    text = ["## By subject"]
    for subject, names in SUBJECTS.items():
        rows = [f"| {{py:obj}}`{name} <graphcam.{name}>` | {first_sentence(name)} |" for name in names.split()]
        text += [f"### {subject}", "\n".join(["| name | |", "|---|---|", *rows])]
    return "\n\n".join(text) + "\n"


def first_sentence(name: str) -> str:
    """The first sentence of what a public name is for.

    >>> first_sentence("mean_torque").endswith(".")
    True
    """
    if name == "LAWS":
        return "The names of all motion laws."
    told = inspect.getdoc(getattr(gc, name)) or ""
    sentence = re.split(r"(?<=\.)\s", " ".join(told.split("\n\n")[0].split()))[0].rstrip(".:") + "."
    return re.sub(r":\w+:`~?([^`]+)`", r"`\1`", sentence).replace("``", "`").replace("|", "\\|")


def write_published(folder: Path) -> None:
    """The page of published examples: each script, and what it prints."""
    page = [(folder / "published.md").read_text(encoding="utf-8")]
    for path in sorted((folder / "published").glob("*.py")):
        script, printed = path.read_text(encoding="utf-8"), StringIO()
        with redirect_stdout(printed):
            runpy.run_path(str(path))
        title = script.splitlines()[0].strip('"')
        page += [f"## {title}", f"```python\n{script.strip()}\n```", f"```text\n{printed.getvalue().strip()}\n```"]
    (folder / "published.md").write_text("\n\n".join(page) + "\n", encoding="utf-8")


def room_of(name: str) -> str:
    """The room, or the module beside the rooms, in which a public name stands."""
    return public_names()[name].split(".")[1]


def entry(name: str) -> str:
    """What Sphinx is asked to say of a public name."""
    thing = getattr(gc, name)
    if isinstance(thing, ModuleType):
        # A room that can be called: what it does then is told by its function.
        return f'<span id="graphcam.{name}"></span>\n\n```{{eval-rst}}\n.. autofunction:: graphcam.{name}.open_{name}\n```'
    if not callable(thing):
        return f"```{{py:data}} graphcam.{name}\n\n`{thing}`\n```"
    options = ":members:\n" if isinstance(thing, type) else ""
    return f"```{{eval-rst}}\n.. auto{'class' if options else 'function'}:: graphcam.{name}\n   {options}```"


def commands() -> str:
    """The help of every command."""
    import typer
    from typer.cli import get_docs_for_click

    from graphcam.cli import app

    command = whole_summaries(typer.main.get_command(app))
    text = get_docs_for_click(obj=command, ctx=typer.Context(command, info_name="graphcam"), name="graphcam")
    text = text.replace("# `graphcam`", "# Commands", 1).replace("[bold]", "**").replace("[/bold]", "**")
    # An example is a paragraph: a command, and perhaps what it is for.
    return re.sub(r"^(graphcam .+?)(   \(.+\))?$", r"`\1`\2", text, flags=re.MULTILINE)


def whole_summaries(command: Any) -> Any:
    """A command with its summary, and those of its commands, as long as they are: without one Click cuts at 45 letters."""
    command.short_help = (command.short_help or command.help or "").split("\n\n")[0].replace("\n", " ")
    for inner in getattr(command, "commands", {}).values():
        whole_summaries(inner)
    return command


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description="Build the site.")
    parser.add_argument("--out", type=Path, default=Path("build/site"), help="folder for the site")
    ways = parser.add_mutually_exclusive_group()
    ways.add_argument("--no-execute", action="store_true", help="notebooks without outputs, no sheets: for a quick look")
    ways.add_argument("--executed", type=Path, metavar="DIR", help="folder of the notebooks, executed before (.ipynb)")
    pyodide = "folder with Pyodide and NumPy: the site has the studio, and every notebook a link into it"
    parser.add_argument("--pyodide", type=Path, metavar="DIR", help=pyodide)
    asked = parser.parse_args()
    if asked.no_execute:
        status = build(asked.out, stored, (), asked.pyodide)
    elif asked.executed:
        read = lambda path: nbformat.read(asked.executed / f"{path.stem}.ipynb", as_version=4)  # noqa: E731
        status = build(asked.out, read, pyodide=asked.pyodide)
    else:
        status = build(asked.out, pyodide=asked.pyodide)
    print(f"{asked.out / 'index.html'}: {'done' if status == 0 else 'the site has faults'}")
    return status


if __name__ == "__main__":
    sys.exit(main())
