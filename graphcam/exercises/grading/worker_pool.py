"""Work shared out among processes or machines, so that every job gives one result, also one that kills its worker."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import Any, TypeVar

J = TypeVar("J")
R = TypeVar("R")

BATCH = 16
"""Short jobs that travel together: less talk between processes, and still an even load."""
AHEAD = 3
"""Batches a worker that are on their way: none waits, and not all jobs are in memory."""


LAST_MOMENTS = 2.0
"""Seconds that a worker has to clear away when the run has been killed."""
_working = threading.Event()
"""Whether this process, a worker, has a job in hand."""
_over = threading.Event()
"""Whether its run has been killed, so that no other job is begun."""


@dataclass(frozen=True)
class WorkerPool:
    """Where the work is done.

    executor : makes a :class:`concurrent.futures.Executor`, a new one after one has broken
    workers : how many jobs it does at once
    close : to be called when all work is done
    """

    executor: Callable[[], Executor]
    workers: int
    close: Callable[[], object] = lambda: None


def processes(workers: int) -> WorkerPool:
    """Processes on this machine."""
    return WorkerPool(partial(_pool, workers), workers)


def cluster(address: str) -> WorkerPool:
    """The workers of a dask scheduler; needs the extra ``cluster``.

    Raises
    ------
    OSError : there is no scheduler at the address
    """
    from distributed import Client

    client: Any = Client(address)
    return WorkerPool(partial(client.get_executor, retries=0), max(sum(client.nthreads().values()), 1), client.close)


def results(
    pool: WorkerPool, work: Callable[[J], R], jobs: Iterable[J], batch: int = BATCH
) -> Generator[tuple[J, R | None]]:
    """Every job with its result as they come, or with None where the worker died of it.

    work : a module-level function that does not raise
    batch : jobs that travel together

    >>> from concurrent.futures import ThreadPoolExecutor
    >>> sorted(results(WorkerPool(ThreadPoolExecutor, 2), abs, [-1, 2]))
    [(-1, 1), (2, 2)]
    """
    suspects: list[J] = []
    waiting = iter(jobs)
    batches = iter(lambda: list(islice(waiting, batch)), [])
    for first in batches:
        # An executor that breaks takes down with it what others were doing: all of that is suspected.
        for done, found in _until_broken(pool, work, first, batches):
            if found is None:
                suspects += done
            else:
                yield from zip(done, found, strict=True)
    yield from _one_by_one(pool, work, suspects)


def _until_broken(
    pool: WorkerPool, work: Callable[[J], R], first: list[J], batches: Iterator[list[J]]
) -> Generator[tuple[list[J], list[R] | None]]:
    with pool.executor() as executor:
        running: dict[Future[list[R]], list[J]] = {executor.submit(_each, work, first): first}
        broken = False
        try:
            while running:
                while not broken and len(running) < AHEAD * pool.workers and (batch := next(batches, [])):
                    try:
                        running[executor.submit(_each, work, batch)] = batch
                    except BrokenExecutor:
                        broken = True
                        yield batch, None
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    # Whatever came instead of a result: the work itself does not raise.
                    broken = broken or future.exception() is not None
                    yield running.pop(future), None if future.exception() else future.result()
        finally:
            # After an interruption nothing more is begun.
            for future in running:
                future.cancel()


def _one_by_one(pool: WorkerPool, work: Callable[[J], R], suspects: list[J]) -> Generator[tuple[J, R | None]]:
    """Alone, so that the one that breaks the executor is the guilty one."""
    left = deque(suspects)
    while left:
        with pool.executor() as executor:
            future: Future[list[R]] | None = executor.submit(_each, work, [left[0]])
            while future is not None:
                job = left.popleft()
                broken = future.exception() is not None
                yield job, None if broken else future.result()[0]
                future = _taken(executor, work, left[0]) if left and not broken else None


def _taken(executor: Executor, work: Callable[[J], R], job: J) -> Future[list[R]] | None:
    """The job in the executor's hands; None where that has broken since the last one."""
    try:
        return executor.submit(_each, work, [job])
    except BrokenExecutor:
        return None


def _each(work: Callable[[J], R], jobs: list[J]) -> list[R]:
    if threading.current_thread() is not threading.main_thread():
        return [work(job) for job in jobs]
    if _over.is_set():
        os._exit(1)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    _working.set()
    try:
        return [work(job) for job in jobs]
    finally:
        _deaf()
        _working.clear()


def _deaf() -> None:
    """Between its jobs a process does not hear Ctrl-C: it may hold the locks of the queue, and all would wait."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _pool(workers: int) -> Executor:
    if sys.platform == "linux" and threading.active_count() == 1:
        # All that is loaded is there at once: a new Python takes longer to start than hundreds of students to grade.
        return ProcessPoolExecutor(workers, multiprocessing.get_context("fork"), _begin)
    # A fork of a process with threads may hang; the server that forks instead has none, and loads the libraries once.
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["graphcam.exercises.grading.grade_one"])
    return ProcessPoolExecutor(workers, context, _begin)


def _begin() -> None:
    _deaf()
    _end_with_the_run()


def _end_with_the_run() -> None:
    """End this worker when the run has been killed: by itself it waits for jobs for ever."""
    run = multiprocessing.parent_process()

    def watch() -> None:
        if run is None:
            return
        run.join()
        _over.set()
        # As by Ctrl-C, so that a student's code that it runs just now is ended too.
        os.kill(os.getpid(), signal.SIGINT)
        until = time.monotonic() + LAST_MOMENTS
        while _working.is_set() and time.monotonic() < until:
            time.sleep(0.01)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
