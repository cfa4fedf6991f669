"""Space files: TOML in, a space of designs out, or one error that says which field is wrong and why."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.sweeps import space as tables
from graphcam.sweeps.space import Space
from graphcam.tasks.task_file import EXAMPLE, Classes, checked, parse_toml, read_content

_REMEDY = "graphcam/data/space.toml in the package is a commented example"

_CLASSES: Classes = {
    (): Space,
    ("motion",): tables.SpaceMotionTable,
    ("cam",): tables.SpaceCamTable,
    ("limits",): tables.SpaceLimitsTable,
}


def load_space(path: str | Path) -> Space:
    """The space of designs in a TOML file.

    Raises
    ------
    TaskError : there is no such file, it is not TOML, or a field is missing, unknown or wrong

    >>> len(load_space(example_space()))
    34850
    """
    try:
        data = parse_toml(str(path), read_content(path))
        return checked(Space, _CLASSES, str(path), data, data)
    except TaskError as error:
        # A task's example is of no use here.
        remedy = _REMEDY if error.remedy.endswith(EXAMPLE) else error.remedy.replace("task file", "space file")
        field = error.field.replace("task file", "space file")
        raise TaskError(error.path, field, error.value, error.expected, remedy) from None


def example_space() -> Path:
    """The space file that comes with graphcam."""
    return Path(str(resources.files("graphcam").joinpath("data", "space.toml")))
