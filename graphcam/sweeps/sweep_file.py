"""A sweep into a file: block by block, so that its length does not matter to the memory."""

import csv
import math
from collections.abc import Callable, Generator
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from graphcam.errors import install_advice
from graphcam.files import OutputError, whole_file
from graphcam.sweeps.front import FoundBest
from graphcam.sweeps.space import Space
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, CHUNKS_PER_JOB, JOBS_AHEAD, Columns
from graphcam.words import say
from graphcam.workers import in_order

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
    if path.suffix not in _WRITERS:
        why = say("the ending is neither .csv nor .parquet")
        raise OutputError(path, why, say("give it one of these, or name a folder"))
    with whole_file(path) as draft, _WRITERS[path.suffix](path, draft) as write:
        size, n = CHUNKS_PER_JOB * CHUNK_OF_DESIGNS, len(space)
        blocks = ((k, min(k + size, n)) for k in range(0, n, size))
        found = FoundBest(0)
        for columns in in_order(executor, space.results, blocks, JOBS_AHEAD):
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
            """Add the rows of some designs, after the names of the columns if they are the first."""
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


_WRITERS = {".csv": _csv, ".parquet": parquet_rows}
