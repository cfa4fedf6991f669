"""A sweep into a folder of Parquet parts: the workers write them, and a manifest says which of them are whole.

A part is so many designs in a row, whatever worker computes it: what is read back is the same for any number of workers
and after any interruption.  A run that is started again computes the parts that are missing.
"""

import csv
import json
import math
import socket
import time
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import Executor
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from graphcam import __version__
from graphcam.errors import install_advice
from graphcam.files import OutputError, whole_file
from graphcam.sweeps.design_space import Space
from graphcam.sweeps.pareto_front import FoundBest, joined_front
from graphcam.sweeps.shared_folder import SealedFile, SharedFolder
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, CHUNKS_PER_JOB, JOBS_AHEAD, Columns
from graphcam.words import Caption, Words, say, sequence
from graphcam.workers import WorkerPool, ordered_results, results

MANIFEST_FILE = "_manifest.json"
"""Readers of data sets pass over what begins with an underscore or a dot."""
BLOCK_DESIGNS = CHUNKS_PER_JOB * CHUNK_OF_DESIGNS
"""Designs that a worker has in memory at a time."""
MAX_PART_DESIGNS = 32 * BLOCK_DESIGNS
"""Most designs of a part, seconds of work: what a dead worker loses."""
MIN_PARTS, MAX_PARTS = 256, 10_000
"""Parts of a small space, so that many workers share it, and of a large one, whose manifest stays small."""
SAVE_INTERVAL = 1.0
"""Seconds between two states of the manifest; what a killed run has not recorded is computed again."""
MIN_WORK_PER_SAVE = 20
"""Saving takes at most one part in so many of the time."""
Record = dict[str, Any]


Write = Callable[[Columns], None]


def is_file(place: str) -> bool:
    """Whether results go into one file: the place has an ending, and is neither a folder nor an address.

    >>> is_file("results.csv"), is_file("results"), is_file("s3://bucket/results.d")
    (True, False, False)
    """
    return bool(Path(place).suffix) and "://" not in place and not Path(place).is_dir()


def sweep_to_file(
    space: Space, path: Path | str, executor: Executor | None = None, progress: Callable[[int], None] | None = None
) -> FoundBest:
    """Compute every design of a space and write it, a row each, into a CSV or Parquet file: whole, or not at all.

    Returned is how many keep the limits, and the front of the best of them.

    Where a value does not exist the cell is empty.

    path : ends in .csv or .parquet
    progress : is told how many designs are done

    Raises
    ------
    OutputError : the file cannot be written, has another ending, or is Parquet without pyarrow
    """
    path = Path(path)
    if path.suffix not in _WRITERS_BY_ENDING:
        why = say("the ending is neither .csv nor .parquet")
        raise OutputError(path, why, say("give it one of these, or name a folder"))
    with whole_file(path) as draft, _WRITERS_BY_ENDING[path.suffix](path, draft) as write:
        size, n = CHUNKS_PER_JOB * CHUNK_OF_DESIGNS, len(space)
        blocks = ((k, min(k + size, n)) for k in range(0, n, size))
        found = FoundBest(0)
        for columns in ordered_results(executor, space.results, blocks, JOBS_AHEAD):
            write(columns)
            found = found.with_block(space, columns)
            if progress:
                progress(found.designs)
    return found


@contextmanager
def _csv(path: Path, draft: Path) -> Generator[Write]:
    with draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)

        def write(columns: Columns) -> None:
            if file.tell() == 0:
                writer.writerow(columns)
            writer.writerows(zip(*(map(_cell, column.tolist()) for column in columns.values()), strict=True))

        yield write


def _cell(value: Any) -> Any:
    if isinstance(value, bool):
        return str(value).lower()
    return "" if isinstance(value, float) and math.isnan(value) else value


@contextmanager
def parquet_rows(path: Path | str, draft: Any) -> Generator[Write]:
    """What writes rows into a Parquet file, ``draft``: a path, or a file that is open.

    Raises
    ------
    OutputError : there is no pyarrow
    """
    try:
        import pyarrow as arrow
        from pyarrow import parquet
    except ImportError:
        remedy = say("write a .csv file, or {install_advice}", install_advice=install_advice("parquet"))
        raise OutputError(path, say("there is no pyarrow"), remedy) from None
    writer: Any = None
    try:

        def write(columns: Columns) -> None:
            nonlocal writer
            # NaN becomes an empty cell, as in a CSV file.
            table = arrow.table({name: arrow.array(column, from_pandas=True) for name, column in columns.items()})
            writer = writer or parquet.ParquetWriter(draft, table.schema)
            writer.write_table(table)

        yield write
    finally:
        if writer:
            writer.close()


_WRITERS_BY_ENDING = {".csv": _csv, ".parquet": parquet_rows}


@dataclass(frozen=True)
class Summary:
    """What is known of a sweep without its rows.

    bytes : of all parts
    seconds : that processors spent on them
    feasible : designs within the limits, None where this was not asked
    ranges : least and greatest finite value of every quantity, None where there is none
    front : of the designs within the limits, by column; None where they were not asked for, or an earlier version of
        graphcam began the sweep
    """

    designs: int
    parts: int
    bytes: int
    seconds: float
    feasible: int | None
    ranges: dict[str, list[float] | None]
    front: Columns | None = None

    @property
    def caption(self) -> Caption:
        """How many designs there are, and what they took."""
        designs = say("{designs} designs") if self.feasible is None else say("{designs} designs, {feasible} feasible")
        spent = say("{parts} parts, {bytes} bytes, {seconds:.1f} s of processor time")
        return sequence([each.with_values(**vars(self)) for each in (designs, spent)], "; ")

    def __str__(self) -> str:
        return str(self.caption)

    def rows(self) -> list[list[str]]:
        """The ranges as texts."""
        shown = {name: ("", "") if ends is None else map("{:.6g}".format, ends) for name, ends in self.ranges.items()}
        return [[name, *ends] for name, ends in shown.items()]


def sweep_to_folder(
    space: Space, folder: str, pool: WorkerPool, progress: Callable[[int], None] | None = None
) -> Summary:
    """Compute every design of a space into Parquet parts, or those that an earlier run has left.

    folder : on this machine, or an address that fsspec knows (s3://..., gs://...); all workers must reach it
    progress : is told how many designs are done

    Raises
    ------
    OutputError : the folder cannot be reached or holds something else, or workers failed; parts that are whole stay
    """
    place = SharedFolder.open_folder(folder)
    manifest = _manifest(place, space)
    parts: list[Record] = manifest["parts"]
    save = partial(_save, place, manifest)
    save()
    try:
        _compute_missing(space, place, manifest, pool, save, progress or (lambda done: None))
    finally:
        save()
    if lost := sum(not part["whole"] for part in parts):
        why = say(
            "{lost} of {parts} parts are missing: their workers died or have no graphcam", lost=lost, parts=len(parts)
        )
        raise OutputError(folder, why, say("start again to go on"))
    place.clear_drafts()
    size, seconds = (sum(part[key] for part in parts) for key in ("bytes", "seconds"))
    summary = Summary(len(space), len(parts), size, seconds, **joined_records(parts))
    told = asdict(summary)
    del told["front"]
    manifest |= {"whole": True, "summary": told}
    save()
    front = manifest.get("front")
    return replace(summary, front=front and joined_front([front]))


def _compute_missing(
    space: Space,
    place: SharedFolder,
    manifest: Record,
    pool: WorkerPool,
    save: Callable[[], float],
    progress: Callable[[int], object],
) -> None:
    """Let the workers write what is not whole, and record it as it comes; the front is one for all parts."""
    parts: list[Record] = manifest["parts"]
    done, due = sum(part["stop"] - part["first"] for part in parts if part["whole"]), 0.0
    jobs = ((k, part["file"], part["first"], part["stop"]) for k, part in enumerate(parts) if not part["whole"])
    with closing(results(pool, partial(write_part, space, place, __version__), jobs, batch=1)) as found:
        for (k, _, first, stop), record in found:
            if record is None:
                continue
            if isinstance(record, str | Caption):
                raise OutputError(place.url, record, say("correct that and start again: finished parts are kept"))
            front = record.pop("front", None)
            if front and "front" in manifest:
                fronts = [known for known in (manifest["front"], front) if known]
                manifest["front"] = {name: column.tolist() for name, column in joined_front(fronts).items()}
            parts[k] |= record | {"whole": True}
            done += stop - first
            progress(done)
            if time.monotonic() >= due:
                due = time.monotonic() + max(SAVE_INTERVAL, MIN_WORK_PER_SAVE * save())


def write_part(space: Space, place: SharedFolder, version: str, job: tuple[int, str, int, int]) -> Record | Words:
    """Compute the designs of one part on a worker and write them; what the part holds, or what went wrong."""
    _, file, first, stop = job
    if version != __version__:
        host = socket.gethostname()
        return say(
            "the worker on {host} has graphcam {own}, not {version}", host=host, own=__version__, version=version
        )
    start, blocks, seen = time.thread_time(), list[Record](), FoundBest(0)
    try:
        if MANIFEST_FILE not in place.sizes():
            unseen = say("the worker on {host} does not see it; all workers must share it")
            return unseen.with_values(host=socket.gethostname())
        with place.open_for_writing(file) as opened:
            sealed = SealedFile(opened)
            with parquet_rows(place.url, sealed) as write:
                for k in range(first, stop, BLOCK_DESIGNS):
                    columns = space.results((k, min(k + BLOCK_DESIGNS, stop)))
                    write(columns)
                    blocks.append(_block_record(columns, len(space.varied)))
                    seen = seen.with_block(space, columns)
    except OutputError as error:
        return sequence([error.why, error.advice], "; ")
    except Exception as error:  # noqa: BLE001  every kind of storage fails in its own way, and what is raised is not told
        return f"{type(error).__name__} on {socket.gethostname()}: {error}"
    found = {"front": seen.front, "seconds": time.thread_time() - start}
    return sealed.record() | found | joined_records(blocks)


def _block_record(columns: Columns, varied: int) -> Record:
    """What a summary keeps of a block; the sizes that vary stand first in it."""
    found = dict(list(columns.items())[varied:])
    feasible = found.pop("feasible", None)
    finite = {name: column[np.isfinite(column)] for name, column in found.items()}
    ends = {name: [float(x.min()), float(x.max())] if x.size else None for name, x in finite.items()}
    return {"feasible": None if feasible is None else int(np.count_nonzero(feasible)), "ranges": ends}


def joined_records(records: Sequence[Record]) -> Record:
    """What a summary keeps of blocks, or of parts, taken together.

    >>> joined_records([{"feasible": 3, "ranges": {"max_v": [1.0, 2.0]}}, {"feasible": 1, "ranges": {"max_v": None}}])
    {'feasible': 4, 'ranges': {'max_v': [1.0, 2.0]}}
    """
    counted = [record["feasible"] for record in records if record["feasible"] is not None]
    ends: dict[str, list[float] | None] = {}
    for name in records[0]["ranges"]:
        found = [record["ranges"][name] for record in records if record["ranges"][name]]
        ends[name] = [min(least for least, _ in found), max(most for _, most in found)] if found else None
    return {"feasible": sum(counted) if counted else None, "ranges": ends}


# --- the manifest ----------------------------------------------------------------------------------------------------


def _manifest(place: SharedFolder, space: Space) -> Record:
    """The manifest of an earlier run of the same space, with the parts that are still as recorded; else a new one."""
    sizes = place.sizes()
    # As it is read back: lists in place of tuples.
    wanted = json.loads(json.dumps({"graphcam": __version__, "space": asdict(space)}))
    if MANIFEST_FILE not in sizes:
        if others := sorted(name for name in sizes if not name.startswith(".")):
            why = say("it holds other files, such as {others}", others=others[0])
            raise OutputError(place.url, why, say("choose an empty folder"))
        return wanted | {"designs": len(space), "whole": False, "front": None, "parts": parts_of(len(space))}
    try:
        found = json.loads(place.read(MANIFEST_FILE))
    except ValueError:
        why = say("its {manifest} is no JSON", manifest=MANIFEST_FILE)
        raise OutputError(place.url, why, say("choose an empty folder")) from None
    if different := _difference(found, wanted):
        why = say("it is of another sweep: {different} differs", different=different)
        raise OutputError(place.url, why, say("choose an empty folder"))
    for part in found["parts"]:
        part["whole"] = part["whole"] and sizes.get(part["file"]) == part["bytes"]
    return found | {"whole": False}


def parts_of(n: int) -> list[Record]:
    """The parts of n designs, none of them written: each but the last of whole blocks.

    >>> [part["stop"] for part in parts_of(70_000)], parts_of(10**9)[0]["stop"], parts_of(10**12)[0]["stop"]
    ([32768, 65536, 70000], 1048576, 100007936)
    """
    size = BLOCK_DESIGNS * math.ceil(max(min(MAX_PART_DESIGNS, n / MIN_PARTS), n / MAX_PARTS) / BLOCK_DESIGNS)
    starts = range(0, n, size)
    return [
        {"file": f"part-{k:05d}.parquet", "first": first, "stop": min(first + size, n), "whole": False}
        for k, first in enumerate(starts)
    ]


def _difference(found: Any, wanted: Any, name: str = "") -> str:
    """The name of the first value that is not as wanted; empty where all are."""
    if isinstance(found, dict) and isinstance(wanted, dict):
        inner = (_difference(found.get(key), value, f"{name}.{key}".lstrip(".")) for key, value in wanted.items())
        return next(filter(None, inner), "")
    return "" if found == wanted else name or "form"


def _save(place: SharedFolder, manifest: Record) -> float:
    """Write the manifest; how long this took [s]."""
    start = time.monotonic()
    with place.open_for_writing(MANIFEST_FILE) as file:
        file.write((json.dumps(manifest, indent=1, allow_nan=False) + "\n").encode())
    return time.monotonic() - start
