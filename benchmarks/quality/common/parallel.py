# SPDX-License-Identifier: MIT
"""Tasks in several processes."""

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

from tricue.evaluation.schedule import missing_extra

Task = TypeVar("Task")
Result = TypeVar("Result")


def run_parallel(run: Callable[[Task], Result], tasks: Iterable[Task], jobs: int) -> Iterator[Result]:
    """The results in the tasks' order; jobs: processes. ImportError says what is missing."""
    if jobs == 1:
        yield from map(run, tasks)
        return
    try:
        from joblib import Parallel, delayed
    except ImportError:
        raise missing_extra("more than one job", "evaluate") from None
    parallel = Parallel(n_jobs=jobs, return_as="generator", batch_size=1)
    yield from parallel(delayed(run)(task) for task in tasks)
