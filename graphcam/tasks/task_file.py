"""Task files: TOML in, a task out, or one error that says which field is wrong and why."""

import dataclasses
import math
import tomllib
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

from graphcam.decoded_text import decoded_text
from graphcam.errors import (
    MAX_FAULTS,
    DesignError,
    MissingFileError,
    TaskError,
    TaskFaultsError,
    all_faults,
    check_kind,
    choice_limit,
    unreadable_error,
)
from graphcam.given.table_file import Turn, read_table
from graphcam.tasks import motion_tables
from graphcam.tasks.arcs_task import ArcsTable, ArcsTask
from graphcam.tasks.dataclass_reader import (
    Classes,
    MissingKey,
    Place,
    UnknownKey,
    classes_of,
    read_dataclass,
)
from graphcam.tasks.file_faults import EXAMPLE_REMEDY, fault_error, line_in, place_words, shown_value
from graphcam.tasks.outline_file import outline_from_dxf
from graphcam.tasks.task import Task
from graphcam.tasks.task_remedies import key_remedy, toml_fault
from graphcam.tasks.toml_lines import lines_of
from graphcam.tasks.units import numbers_in_units
from graphcam.words import Words, say

BUILTIN_TASK_NAMES = ("coursework", "arm", "flat", "swinging-face", "measured")
"""Names of the built-in tasks; "arcs" is one more, a cam of three circular arcs."""
SIZING_TASK_NAME = "sizing"
"""The name of the built-in task with a table ``[sizing]``."""
THE_FILE = say("the task file")
_Checked = TypeVar("_Checked")
OUTLINE_KEYS = tuple(each.name for each in dataclasses.fields(motion_tables.OutlineTable))
"""The keys of a table ``[outline]``, which stands for a motion with the table of a given cam."""
_RADII_KEYS = {each.name for each in dataclasses.fields(motion_tables.RadiiTable)} - {"dwell"}
"""The keys by which a table ``[arcs]`` gives a cam by its radii, and not by its points."""
_POINT_KEYS = {each.name for each in dataclasses.fields(ArcsTable)} - {"dwell"}
"""The keys by which it gives a cam by its points."""


def load_task(path: str | Path) -> Task | ArcsTask:
    """The task in a TOML file; with a table ``[arcs]`` it is a cam of three circular arcs.

    Raises
    ------
    TaskError : there is no such file, it is not TOML, or fields are missing, unknown or wrong; all faults are told, in
        the order of the file's lines

    >>> import graphcam as gc
    >>> from tempfile import TemporaryDirectory
    >>> text = '''
    ... rotation = "ccw"
    ... [motion]
    ... phases = [{ kind = "rise", angle = 120, lift = 30, law = "2-3" },
    ...   { kind = "return", angle = 240, lift = 30, law = "2-3" }]
    ... [follower]
    ... kind = "flat-faced"
    ... '''
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cam.toml").write_text(text, encoding="utf-8")
    ...     task = gc.load_task(Path(folder, "cam.toml"))
    >>> task.motion().lift, task.rotation
    (30.0, 'ccw')
    """
    check_kind("path", path, (str, Path))
    return _parse(str(path), read_content(path), Path(path).parent)


def read_content(path: str | Path) -> bytes:
    """The bytes of a file.

    Raises
    ------
    TaskError : there is no such file, or it cannot be read
    """
    try:
        return Path(path).read_bytes()
    except (OSError, ValueError) as error:
        remedy = say("check the name; {example}", example=EXAMPLE_REMEDY)
        raise unreadable_error(path, THE_FILE, say("a TOML file"), error, remedy) from None


@contextmanager
def other_file(kind: Words, example: Words) -> Generator[None]:
    """Give errors in the block the kind and the example of a file that is no task file."""
    try:
        yield
    except MissingFileError as error:
        raise MissingFileError(error.path, say("check the name; {example}", example=example)) from None
    except TaskError as error:
        for each in error.errors if isinstance(error, TaskFaultsError) else (error,):
            each.place = say("the {kind}", kind=kind) if each.place == THE_FILE else each.place
            each.advice = example if each.remedy.endswith(str(EXAMPLE_REMEDY)) else each.advice
        raise


def task_of(path: str, data: dict[str, Any]) -> Task:
    """The task in a table of a TOML file, without texts with units; ``path`` is for the messages.

    Raises
    ------
    TaskError : a field is missing, unknown or wrong
    """
    task = _task(path, data, data)
    if not isinstance(task, Task):
        raise TaskError(path, "arcs", say("a table"), say("left out"), say("this takes a task with phases of motion"))
    for place, number in numbers_in_units(task):
        remedy = say("only task files may have units")
        raise TaskError(path, place, number.text, say("a number (without quotes)"), remedy)
    return task


def task_from(data: dict[str, Any], name: str = "task") -> Task | ArcsTask:
    """The task in plain data with the keys and units of a file; a measured table stands in them itself.

    name : of the task in messages

    Raises
    ------
    TaskError : a field is missing, unknown or wrong, or ``motion.table`` names a file

    >>> import graphcam as gc
    >>> task_from(gc.builtin_task().to_dict()) == gc.builtin_task()
    True
    """
    if isinstance(motion := data.get("motion"), dict) and isinstance(table := motion.get("table"), str):
        remedy = say("no file is read here: give the rows of the table")
        raise TaskError(name, "motion.table", table, say("a table with file, column and rows"), remedy)
    return _task(name, data, data)


def builtin_task(name: str = "coursework") -> Task:
    """A task that comes with graphcam, by its name in :data:`BUILTIN_TASK_NAMES`; "sizing" has ranges of sizes.

    >>> import graphcam as gc
    >>> gc.builtin_task().follower().offset
    -10.0
    """
    known = (*BUILTIN_TASK_NAMES, SIZING_TASK_NAME)
    if name not in known:
        raise DesignError(say("built-in task"), name, *choice_limit(name, known))
    task = _parse(f"{name}.toml", builtin_text(name).encode(), _built_in_folder())
    assert isinstance(task, Task)
    return task


def builtin_arcs_task() -> ArcsTask:
    """The task of a cam of three circular arcs that comes with graphcam.

    >>> import graphcam as gc
    >>> gc.builtin_arcs_task().arcs.rho1
    17.0
    """
    task = _parse("arcs.toml", builtin_text("arcs").encode(), _built_in_folder())
    assert isinstance(task, ArcsTask)
    return task


def builtin_text(name: str) -> str:
    """The text of the file of a built-in task.

    >>> 'rotation = "cw"' in builtin_text("coursework")
    True
    """
    known = (*BUILTIN_TASK_NAMES, SIZING_TASK_NAME, "arcs")
    if name not in known:
        raise DesignError(say("built-in task"), name, *choice_limit(name, known))
    return (_built_in_folder() / f"{name}.toml").read_text(encoding="utf-8")


def _built_in_folder() -> Path:
    return Path(str(resources.files("graphcam").joinpath("data", "tasks")))


def _parse(path: str, content: bytes, folder: Path) -> Task | ArcsTask:
    read = read_toml(path, content)
    return _task(path, read.data, _with_table(path, read.data, folder), read)


@dataclass(frozen=True)
class ReadToml:
    """The tables of a TOML file, the line of every key and entry, and the faults of its lines that could be mended."""

    data: dict[str, Any]
    lines: Mapping[Place, int] = field(default_factory=dict[Place, int])
    faults: tuple[tuple[int, TaskError], ...] = ()


def parse_toml(path: str, content: bytes) -> dict[str, Any]:
    """The tables of a TOML file.

    Raises
    ------
    TaskError : it is not TOML, or empty
    """
    read = read_toml(path, content)
    if read.faults:
        raise all_faults([fault for _, fault in read.faults])
    return read.data


def read_toml(path: str, content: bytes) -> ReadToml:
    """The tables of a TOML file; lines whose fault is plain are read as if it were mended, so that all are told.

    Raises
    ------
    TaskError : it is not TOML, or empty
    """
    text = decoded_text(path, THE_FILE, content, say("a TOML file"), say("copy its text into a plain text editor"))
    faults: list[tuple[int, TaskError]] = []
    while True:
        try:
            data = tomllib.loads(text)
            break
        except (ValueError, RecursionError) as error:
            line, fault, mended = toml_fault(path, text, error, EXAMPLE_REMEDY)
            faults.append((line, fault))
            if not mended or len(faults) > MAX_FAULTS:
                raise all_faults([fault for _, fault in faults]) from None
            text = mended
    if not data:
        raise TaskError(path, THE_FILE, say("empty"), say("a TOML file"), EXAMPLE_REMEDY)
    return ReadToml(data, lines_of(text), tuple(faults))


def _with_table(path: str, data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The data with the rows of a table's file in place of its name; an outline is the table of a motion."""
    motion, key = data.get("motion"), "motion.table"
    if isinstance(outline := data.get("outline"), dict):
        motion, key = _of_outline(path, outline, data), "outline.file"
    if not isinstance(motion, dict) or "table" not in motion:
        return data
    name = motion["table"]
    if not isinstance(name, str):
        raise TaskError(path, key, shown_value(name), say("text in quotes"), say("name the CSV file of the table"))
    try:
        if key == "outline.file" and name.lower().endswith(".dxf"):
            table = outline_from_dxf(folder / name, name, motion.pop("layer", None))
        else:
            table = read_table(folder / name, name, motion_tables.tolerance_in(motion), Turn.given_in(motion))
    except MissingFileError:
        raise MissingFileError(name, say("check {key}", key=key), where=say("beside {path}", path=path)) from None
    if key == "outline.file" and table.column != "outline":
        limit, remedy = say("points of a cam"), say("name its columns x_mm,y_mm or angle_deg,radius_mm")
        raise TaskError(path, key, say("the table of a motion"), limit, remedy)
    whole = {each: value for each, value in data.items() if each != "outline"}
    rotation = {"rotation": "ccw"} if table.column == "outline" else {}
    return {**rotation, **whole, "motion": {**motion, "table": dataclasses.asdict(table)}}


def _of_outline(path: str, outline: dict[str, Any], data: dict[str, Any]) -> dict[str, Any]:
    """The table ``[motion]`` that says the same as a table ``[outline]``."""
    for other in ("motion", "arcs"):
        if other in data:
            limit = say("left out where there is an outline")
            raise TaskError(path, other, shown_value(data[other]), limit, say("give one of the two"))
    for key, value in outline.items():
        if key not in OUTLINE_KEYS:
            remedy = key_remedy(key, value, OUTLINE_KEYS, data)
            raise TaskError(path, f"outline.{key}", say("an unknown key"), say("one that is known"), remedy)
    if "file" not in outline:
        remedy = say("name the file of the cam's points, CSV or DXF")
        raise TaskError(path, "outline.file", say("missing"), say("given"), remedy)
    layer, drawn = outline.get("layer", ""), str(outline["file"]).lower().endswith(".dxf")
    if "layer" in outline and not (isinstance(layer, str) and drawn):
        limit = say("the name of a layer, with a DXF file alone")
        raise TaskError(path, "outline.layer", shown_value(layer), limit, say("delete it"))
    return {"table": outline["file"], **{key: value for key, value in outline.items() if key != "file"}}


def _task(path: str, data: dict[str, Any], whole: dict[str, Any], read: ReadToml | None = None) -> Task | ArcsTask:
    """The task that ``whole`` describes; errors use the words of the file's ``data``."""
    expected = say("a task, with phases of motion: 'graphcam init FILE' writes one")
    if isinstance(motion := data.get("motion"), dict) and "rise_angle" in motion:
        raise TaskError(path, say("the file"), say("a space of designs"), expected, say("'graphcam sweep' takes it"))
    if isinstance(data.get("answers"), list):
        raise TaskError(path, say("the file"), say("an exercise"), expected, say("'graphcam exercise make' takes it"))
    arcs = data.get("arcs")
    if isinstance(arcs, dict) and arcs.keys() & _RADII_KEYS:
        if "D" in arcs:
            limit = say("given by radii or by points, not by both")
            raise TaskError(path, "arcs", say("with base_radius and D"), limit, say("delete one of the two"))
        if "motion" in data:
            limit = say("left out where the cam is given")
            raise TaskError(path, "motion", shown_value(data["motion"]), limit, say("give one of the two"))
        # The radii of a given cam are a motion, of which ``[arcs]`` is the table.
        whole = {"rotation": "ccw", **whole, "motion": {"radii": arcs}}
        del whole["arcs"]
        return checked_table(Task, classes_of(Task), path, data, whole, read)
    if isinstance(arcs, dict) and not arcs.keys() & _POINT_KEYS:
        limit = say("a table with base_radius, or with D")
        remedy = say("of an eccentric disc with the radius R write base_radius = R - e and lift = 2 e")
        raise TaskError(path, "arcs", say("without both"), limit, remedy)
    if arcs is not None:
        return checked_table(ArcsTask, classes_of(ArcsTask), path, data, whole, read)
    return checked_table(Task, classes_of(Task), path, data, whole, read)


def checked_table(
    kind: type[_Checked],
    classes: Classes,
    path: str,
    data: dict[str, Any],
    whole: dict[str, Any],
    toml: ReadToml | None = None,
) -> _Checked:
    """The dataclass that ``whole`` describes; errors use the words of the file's ``data``.

    classes : the class of each table of the file, by its place without numbers
    toml : the file as it was read, for the lines and faults of its text

    Raises
    ------
    TaskError : a field is missing, unknown or wrong
    """
    read, toml = read_dataclass(kind, whole), toml or ReadToml(data)
    found: list[tuple[float, TaskError]] = [*toml.faults]
    if isinstance(read, list):
        errors = [(fault, fault_error(path, data, classes, fault)) for fault in read]
        # A misspelt key is why the right one is missing.
        meant = {error.remedy for fault, error in errors if isinstance(fault, UnknownKey)}
        for fault, error in errors:
            key = fault.place[-1] if fault.place else ""
            if isinstance(fault, MissingKey) and any(f"'{key}'" in remedy or f"{key} =" in remedy for remedy in meant):
                continue
            line = line_in(toml.lines, error.field)
            error.place = place_words(error.place, line)
            found.append((line or math.inf, error))
    elif not found:
        return read
    found.sort(key=lambda each: each[0])
    raise all_faults([error for _, error in found])
