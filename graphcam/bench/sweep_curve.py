"""Sweeps into Parquet files by number of designs and of workers: designs per second, and the memory of all processes.

Each is a run of ``graphcam sweep`` of its own, start and imports included, so that its memory is its own too.  Here the
elapsed time counts as well as the processor time, because the workers are processes.
"""

import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam.bench.rows import BenchRow, Section
from graphcam.bench.timing import seconds_of_programs
from graphcam.words import say

DESIGN_COUNTS = (10**5, 10**6, 10**7)
WORKER_COUNTS = (1, 2, 4)
MAX_RUN_TIME = 300.0
"""A run that would take longer [s], at the rate of the one before, is left out."""
SPACE_TEXT = """\
[motion]
lift = 30
rise_angle = 110
dwell_angle = 40
return_angle = 90
[cam]
prime_radius = {{ start = 40, stop = 80, count = 1000 }}
offset = {{ start = -20, stop = 20, count = {offsets} }}
roller_radius = 12
"""


def curve_rows(
    sizes: Sequence[int], workers: Sequence[int] = WORKER_COUNTS, longest: float = MAX_RUN_TIME
) -> Iterator[BenchRow]:
    """Every number of designs with every number of workers, the small ones first.

    >>> [row.what.partition(";")[0] for row in curve_rows([1000, 2000], [1], longest=0.0)]
    ['1e+03 designs, workers: 1']
    """
    for count in workers:
        seconds_each = 0.0
        for designs in sorted(sizes):
            if designs * seconds_each > longest:
                break
            seconds, processor_seconds, peak = swept_file(designs, count)
            seconds_each = seconds / designs
            memory = "" if peak is None else f", {peak / 2**20:.0f} MiB at most"
            what = f"{designs:.0e} designs, workers: {count}; {processor_seconds:.1f} s of processors{memory}"
            yield BenchRow("sweep to Parquet", what, designs / seconds, "designs/s", seconds=seconds)


def swept_file(designs: int, workers: int) -> tuple[float, float, int | None]:
    """One run, into a folder that is gone afterwards: seconds by the clock, seconds of processors, and maximum memory.

    designs : a multiple of 1000

    The memory [bytes] is that of all processes together, pages that they share counted once; None where the system
    does not tell.
    """
    with TemporaryDirectory() as folder:
        space = Path(folder, "space.toml")
        space.write_text(SPACE_TEXT.format(offsets=designs // 1000), encoding="utf-8", newline="\n")
        words = ["sweep", str(space), "--out", str(Path(folder, "results.parquet")), "--workers", str(workers)]
        before, start, peak = seconds_of_programs(), time.perf_counter(), None
        program, quiet = [sys.executable, "-m", "graphcam", *words], subprocess.DEVNULL
        with subprocess.Popen(program, stdout=quiet, stderr=quiet) as run:
            while run.poll() is None:
                if memory := _memory_of_tree(run.pid):
                    peak = max(peak or 0, memory)
                time.sleep(0.02)
        seconds = time.perf_counter() - start
        if run.returncode:
            raise subprocess.CalledProcessError(run.returncode, program)
    return seconds, seconds_of_programs() - before, peak


def _memory_of_tree(process: int) -> int:
    """Bytes of a process and of all that it has begun, by Linux's count of proportional shares; 0 for none."""
    try:
        told = Path(f"/proc/{process}/smaps_rollup").read_text(encoding="ascii")
        begun = [path.read_text(encoding="ascii") for path in Path(f"/proc/{process}/task").glob("*/children")]
    except OSError:
        return 0  # it has ended, or this is no Linux
    own = sum(int(line.split()[1]) for line in told.splitlines() if line.startswith("Pss:")) * 1024
    return own + sum(_memory_of_tree(int(child)) for child in " ".join(begun).split())


CURVE_SECTION = Section(
    "workers",
    say("Sweeps into files"),
    "Runs of graphcam sweep into one Parquet file. Designs a second are by the clock, so other work on the machine "
    "counts; peak memory is that of all processes together.",
    lambda effort: curve_rows(effort.swept),
)
