"""Jobs shared among processes or machines, in order, or so that a job that kills its worker costs only itself."""

import _thread
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import chain, islice
from typing import Any, TypeVar

from graphcam.errors import installed
from graphcam.words import say

J = TypeVar("J")
R = TypeVar("R")

BATCH_SIZE = 16
"""The number of short jobs that are sent together: little traffic between processes, and still an even load."""
MAX_BATCHES_AHEAD = 3
"""The maximum number of batches under way for each worker: none waits, and not all jobs are in memory."""
JOBS_AHEAD = 128
"""The number of jobs under way at a time where results come in order: it bounds the memory, and feeds a cluster."""
SCHEDULER_SECONDS = 5.0
"""The time in which a scheduler must answer [s]."""
MIN_EXPECTED_WORKERS = 32
"""The number of cluster workers for which jobs are handed out, though fewer may have started."""
SHUTDOWN_SECONDS = 2.0
"""The time that a worker has to clear away when the run has been killed [s]."""
MAX_WINDOWS_PROCESSES = 61
"""The maximum number of processes that can be waited for on Windows."""
_job_in_hand = threading.Event()
"""Set while this process, a worker, does a job."""
_run_killed = threading.Event()
"""Set when this worker's run has been killed, so that it begins no other job."""


@dataclass(frozen=True)
class WorkerPool:
    """A pool of workers for jobs.

    executor : makes a :class:`concurrent.futures.Executor`, a new one after one has broken
    workers : the number of jobs done at once
    close : to be called when all jobs are done
    """

    executor: Callable[[], Executor]
    workers: int
    close: Callable[[], object] = lambda: None


def processes(workers: int, *preloaded: str, fresh: bool = False) -> WorkerPool:
    """A pool of processes on this machine.

    preloaded : modules that the jobs need, loaded once where the processes do not begin as copies of this one
    fresh : whether they never do: a copy of one whose libraries have threads of their own, as OpenCV has, may hang
    """
    # So many Windows waits for at a time.
    workers = min(workers, MAX_WINDOWS_PROCESSES) if sys.platform == "win32" else workers
    return WorkerPool(partial(_process_executor, workers, preloaded, fresh), workers)


def cluster(address: str) -> WorkerPool:
    """A pool of the workers of a dask scheduler; needs the extra ``cluster``.

    Raises
    ------
    OSError : no scheduler answers at the address
    TaskError : dask is not installed
    """
    with installed("--cluster", "dask's distributed", "cluster"):
        from distributed import Client
    try:
        client: Any = Client(address, timeout=SCHEDULER_SECONDS)
    except (OSError, ValueError) as error:
        silent = say("no dask scheduler answers at '{address}' ({error}); start one, or check the address")
        raise OSError(silent.with_values(address=address, error=str(error))) from None
    return WorkerPool(
        partial(client.get_executor, retries=0),
        max(sum(client.nthreads().values()), MIN_EXPECTED_WORKERS),
        client.close,
    )


def worker_pool(workers: int, address: str, *preloaded: str) -> WorkerPool:
    """A pool of processes on this machine, or of the dask scheduler at an address that is not empty."""
    return cluster(address) if address else processes(workers, *preloaded)


@contextmanager
def executor_of(workers: int, address: str = "") -> Generator[Executor | None]:
    """An executor for :func:`ordered_results`: of processes, or of the dask scheduler at an address that is not empty.

    None for a single worker, whose jobs are done here.

    Raises
    ------
    OSError : no scheduler answers at the address
    TaskError : dask is not installed
    """
    if not address and workers == 1:
        yield None
        return
    with closing(worker_pool(workers, address)) as pool, pool.executor() as executor:
        yield executor


def ordered_results(
    executor: Executor | None, function: Callable[[J], R], jobs: Iterable[J], ahead: int = JOBS_AHEAD
) -> Iterator[R]:
    """The results of the function in the order of the jobs, which are taken only as they are needed.

    Unlike ``executor.map``, which takes all of them at once.

    ahead : jobs that are under way at a time; so many results may lie in memory

    >>> list(ordered_results(None, abs, [-1, 2]))
    [1, 2]
    """
    if executor is None:
        yield from map(function, jobs)
        return
    remaining = iter(jobs)
    waiting: deque[Future[R]] = deque()
    try:
        waiting.extend(executor.submit(function, job) for job in islice(remaining, ahead))
        while waiting:
            yield waiting.popleft().result()
            waiting.extend(executor.submit(function, job) for job in islice(remaining, 1))
    finally:
        for future in waiting:
            future.cancel()


def results(
    pool: WorkerPool, function: Callable[[J], R], jobs: Iterable[J], batch: int = BATCH_SIZE
) -> Generator[tuple[J, R | None]]:
    """Each job with its result, in the order of completion; None where the worker died of it.

    function : defined in a module, so that it can be pickled; it does not raise
    batch : the number of jobs that are sent together

    >>> from concurrent.futures import ThreadPoolExecutor
    >>> sorted(results(WorkerPool(ThreadPoolExecutor, 2), abs, [-1, 2]))
    [(-1, 1), (2, 2)]
    """
    suspects: list[J] = []
    waiting = iter(jobs)
    batches = iter(lambda: list(islice(waiting, batch)), [])
    # An executor that breaks takes down with it what others were doing: all of that is suspected.
    for done, found in _batch_results(pool, function, batches, MAX_BATCHES_AHEAD * pool.workers):
        if found is None:
            suspects += done
        else:
            yield from zip(done, found, strict=True)
    # Alone, so that the one that breaks the executor is the guilty one.
    for (job,), found in _batch_results(pool, function, ([suspect] for suspect in suspects), 1):
        yield job, None if found is None else found[0]


def _batch_results(
    pool: WorkerPool, function: Callable[[J], R], batches: Iterator[list[J]], ahead: int
) -> Generator[tuple[list[J], list[R] | None]]:
    """Batches with their results, in the order of completion; None for those under way when their executor broke.

    ahead : the number of batches under way at a time
    """
    while first := next(batches, []):
        with pool.executor() as executor:
            running: dict[Future[list[R]], list[J]] = {executor.submit(_results, function, first): first}
            broken = False
            try:
                while (batch := [] if broken or len(running) >= ahead else next(batches, [])) or running:
                    if batch:
                        try:
                            running[executor.submit(_results, function, batch)] = batch
                        except BrokenExecutor:
                            # Nobody has begun with this one: it is for the next executor.
                            broken, batches = True, chain([batch], batches)
                        continue
                    # Of several the one that was begun first comes first.
                    for future in sorted(wait(running, return_when=FIRST_COMPLETED).done, key=[*running].index):
                        # Whatever came instead of a result: the function itself does not raise.
                        broken = broken or future.exception() is not None
                        yield running.pop(future), None if future.exception() else future.result()
            finally:
                # After an interruption nothing more is begun.
                for future in running:
                    future.cancel()


def _results(function: Callable[[J], R], jobs: list[J]) -> list[R]:
    if threading.current_thread() is not threading.main_thread():
        return [function(job) for job in jobs]
    if _run_killed.is_set():
        os._exit(1)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    _job_in_hand.set()
    try:
        return [function(job) for job in jobs]
    finally:
        _ignore_interrupts()
        _job_in_hand.clear()


def _ignore_interrupts() -> None:
    """Ignore Ctrl-C between jobs: a process interrupted there may hold the locks of the queue, and all would wait."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _process_executor(workers: int, preloaded: tuple[str, ...], fresh: bool = False) -> Executor:
    methods = multiprocessing.get_all_start_methods()
    if sys.platform == "linux" and "fork" in methods and threading.active_count() == 1 and not fresh:
        # All that is loaded is there at once: a new Python takes longer to start than hundreds of students to grade.
        return ProcessPoolExecutor(workers, multiprocessing.get_context("fork"), _start_worker)
    if "forkserver" not in methods:
        return ProcessPoolExecutor(workers, multiprocessing.get_context("spawn"), _start_worker)
    # A fork of a process with threads may hang; the server that forks instead has none, and loads the libraries once.
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(list(preloaded))
    return ProcessPoolExecutor(workers, context, _start_worker)


def _start_worker() -> None:
    """Let this process ignore Ctrl-C between its jobs, and end when the run has been killed."""
    _ignore_interrupts()
    threading.Thread(target=_end_with_the_run, daemon=True).start()


def _end_with_the_run() -> None:
    """End this worker when the run has been killed; otherwise it would wait for jobs for ever."""
    run = multiprocessing.parent_process()
    if run is None:
        return
    run.join()
    _run_killed.set()
    # As by Ctrl-C, so that a student's code that it runs just now is ended too.
    _thread.interrupt_main()
    until = time.monotonic() + SHUTDOWN_SECONDS
    while _job_in_hand.is_set() and time.monotonic() < until:
        time.sleep(0.01)
    os._exit(1)
