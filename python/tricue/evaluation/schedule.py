# SPDX-License-Identifier: MIT
"""Where tasks run: in this process, in several of this machine (joblib), on a Dask cluster. One code path."""

from collections.abc import Callable, Generator, Sequence
from contextlib import closing
from typing import Any, NamedTuple

from tricue.errors import one_line
from tricue.evaluation.record import Record
from tricue.evaluation.tasks import Task

Perform = Callable[[Task], Record]
CONNECT_TIMEOUT = "10s"  # to a Dask scheduler
NEEDED = "needs the extra: pip install 'tricue[{}]'"


class Finished(NamedTuple):
    """A task that ended: its place in the list, and its record, or the error that kept it from one."""

    place: int
    record: Record | None
    error: str = ""


def completed(
    tasks: Sequence[Task], perform: Perform, jobs: int = 1, scheduler: str | None = None
) -> Generator[Finished, None, None]:
    """The tasks as they end, in whatever order. Closing the iterator gives up those that haven't.

    jobs: processes of this machine. scheduler: the address of a Dask scheduler, such as tcp://host:8786,
    whose workers see the data set under the same path. A task that was on a lost worker runs on another.
    ImportError names the extra that is missing; OSError where no scheduler answers.
    """
    if scheduler is not None:
        return _on_cluster(tasks, perform, scheduler)
    return _here(tasks, perform) if jobs == 1 else _in_processes(tasks, perform, jobs)


def finished(index: int, task: Task, perform: Perform) -> Finished:
    """Perform a task; an error of its sequence is told, not raised, for the others go on."""
    try:
        return Finished(index, perform(task))
    except (OSError, ValueError) as error:
        return Finished(index, None, one_line(error))


def _here(tasks: Sequence[Task], perform: Perform) -> Generator[Finished, None, None]:
    for index, task in enumerate(tasks):
        yield finished(index, task, perform)


def _in_processes(tasks: Sequence[Task], perform: Perform, jobs: int) -> Generator[Finished, None, None]:
    try:
        from joblib import Parallel, delayed
    except ImportError:
        raise ImportError(f"--jobs above 1 {NEEDED.format('evaluate')}") from None
    parallel = Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)
    calls = (delayed(finished)(index, task, perform) for index, task in enumerate(tasks))
    with closing(parallel(calls)) as results:
        yield from results


def _on_cluster(tasks: Sequence[Task], perform: Perform, address: str) -> Generator[Finished, None, None]:
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise ImportError(f"--scheduler {NEEDED.format('dask')}") from None
    with Client(address, timeout=CONNECT_TIMEOUT, set_as_default=False) as client:
        indices = range(len(tasks))
        futures = [
            client.submit(finished, index, tasks[index], perform, pure=False, priority=-index)
            for index in indices
        ]
        places = {future.key: index for index, future in enumerate(futures)}
        for future in as_completed(futures, loop=client.loop):
            yield _gathered(future, places[future.key])
            future.release()


def _gathered(future: Any, index: int) -> Finished:
    """Its result; an error of the cluster's, such as that every worker died on it, is the task's."""
    error = future.exception()
    return future.result() if error is None else Finished(index, None, f"{type(error).__name__}: {error}")
