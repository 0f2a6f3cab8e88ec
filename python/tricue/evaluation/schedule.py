# SPDX-License-Identifier: MIT
"""Where tasks run: in this process, in several on this machine (joblib), or on a Dask cluster."""

import time
import warnings
from collections.abc import Callable, Generator, Iterable, Sequence
from concurrent.futures import FIRST_COMPLETED, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from itertools import islice
from typing import Any, NamedTuple

from tricue.doctor.install import install_extra
from tricue.errors import one_line
from tricue.evaluation.interrupts import interrupts_later
from tricue.evaluation.record import Record
from tricue.evaluation.tasks import Task

Perform = Callable[[Task], Record]
CONNECT_TIMEOUT = "10s"  # for a Dask scheduler
GIVING_LIMIT = 2.0  # seconds after which a pool is assumed to be broken


class Finished(NamedTuple):
    """A finished task: its index in the list, and its record or error."""

    task_index: int
    record: Record | None
    error: str = ""


def run_tasks(
    tasks: Sequence[Task], perform: Perform, jobs: int = 1, scheduler: str | None = None
) -> Generator[Finished, None, None]:
    """Run the tasks and yield them as they finish, in any order. Closing the iterator cancels the rest.

    jobs: processes on this machine. scheduler: the address of a Dask scheduler, such as tcp://host:8786,
    whose workers see the data set under the same path. If a worker is lost, its task runs on another.
    ImportError names the missing extra; OSError if no scheduler answers.
    """
    if scheduler is not None:
        return _run_on_cluster(tasks, perform, scheduler)
    if jobs == 1:
        return _run_here(tasks, perform)
    return _run_in_processes(tasks, perform, min(jobs, len(tasks)))  # loky starts all at once


def perform_task(index: int, task: Task, perform: Perform) -> Finished:
    """Perform a task; an error of its sequence is returned, not raised, so that the others continue."""
    try:
        return Finished(index, perform(task))
    except (OSError, ValueError) as error:
        return Finished(index, None, one_line(error))


def perform_in_process(index: int, task: Task, perform: Perform) -> tuple[Finished, set[str]]:
    """Perform a task in another process, and return its warnings, too: printed there, each process would
    repeat them, with lines of source code.
    """
    with warnings.catch_warnings(record=True) as caught:
        found = perform_task(index, task, perform)
    return found, {str(each.message) for each in caught}


def missing_extra(use: str, extra: str) -> ImportError:
    """The error for a use of which the extra is missing."""
    return ImportError(f"{use} needs the extra {extra}: {install_extra(extra)}")


def _run_here(tasks: Sequence[Task], perform: Perform) -> Generator[Finished, None, None]:
    for index, task in enumerate(tasks):
        yield perform_task(index, task, perform)


def _run_in_processes(tasks: Sequence[Task], perform: Perform, jobs: int) -> Generator[Finished, None, None]:
    """A killed process breaks its pool. Its tasks are then repeated one at a time to find the cause."""
    try:
        from joblib.externals.loky import ProcessPoolExecutor  # unlike Python's it needs no main module
    except ImportError:
        raise missing_extra("more than one job", "evaluate") from None
    waiting = list(range(len(tasks)))
    while waiting:
        done = set()
        try:
            with closing(_run_in_pool(tasks, waiting, perform, ProcessPoolExecutor, jobs)) as running:
                for finished in running:
                    done.add(finished.task_index)
                    yield finished
        except BrokenProcessPool:
            interrupted = [index for index in waiting if index not in done][:jobs]
            for index in interrupted:
                yield _run_alone(tasks, index, perform, ProcessPoolExecutor)
            done.update(interrupted)
        waiting = [index for index in waiting if index not in done]


def _run_in_pool(
    tasks: Sequence[Task], indices: Sequence[int], perform: Perform, executor: Any, jobs: int
) -> Generator[Finished, None, None]:
    """Submit in order, as many as there are processes, so that the first unfinished ones are running."""
    left = iter(indices)
    running: set[Any] = set()
    told: set[str] = set()
    pool = executor(jobs)
    try:
        while True:
            with interrupts_later():
                running |= {
                    pool.submit(perform_in_process, index, tasks[index], perform)
                    for index in islice(left, jobs - len(running))
                }
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for finished, messages in (future.result() for future in done):
                for message in sorted(messages - told):
                    warnings.warn(message, UserWarning, stacklevel=2)
                told |= messages
                yield finished
    finally:
        # Running tasks aren't needed. Call it once: a second call, as by ``with``, would undo kill_workers.
        try:
            _wait_until_given(running)
        finally:
            pool.shutdown(kill_workers=bool(running))


def _wait_until_given(futures: Iterable[Any]) -> None:
    """Wait until joblib's thread has handed the tasks to processes, usually at once. If they were killed
    before that, it would print a KeyError.
    """
    deadline = time.monotonic() + GIVING_LIMIT
    while not all(each.running() or each.done() for each in futures) and time.monotonic() < deadline:
        time.sleep(0.001)


def _run_alone(tasks: Sequence[Task], index: int, perform: Perform, executor: Any) -> Finished:
    try:
        with closing(_run_in_pool(tasks, [index], perform, executor, jobs=1)) as finished:
            return next(finished)
    except BrokenProcessPool:
        return Finished(index, None, "its process was killed, twice; was there too little memory?")


def _require_address(address: str) -> None:
    """ValueError for an address that no scheduler can have; Dask would hang and print a traceback."""
    from distributed.comm.addressing import get_address_host_port, parse_address

    try:
        scheme, _ = parse_address(address)
        if scheme != "inproc":  # such an address has no port
            get_address_host_port(address, strict="://" in address)
    except ValueError as error:
        expected = f"scheduler: expected an address such as tcp://HOST:8786, got {address!r}"
        raise ValueError(f"{expected} ({error})") from None


def _run_on_cluster(tasks: Sequence[Task], perform: Perform, address: str) -> Generator[Finished, None, None]:
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise missing_extra("a scheduler", "dask") from None
    _require_address(address)
    with Client(address, timeout=CONNECT_TIMEOUT, set_as_default=False) as client:
        indices = range(len(tasks))
        futures = [
            client.submit(perform_task, index, tasks[index], perform, pure=False, priority=-index)
            for index in indices
        ]
        indices_by_key = {future.key: index for index, future in enumerate(futures)}
        for future in as_completed(futures, loop=client.loop):
            yield _gather(future, indices_by_key[future.key])
            future.release()


def _gather(future: Any, index: int) -> Finished:
    """The result of a future; an error of the cluster, such as a lost worker, becomes the task's error."""
    error = future.exception()
    return future.result() if error is None else Finished(index, None, f"{type(error).__name__}: {error}")
