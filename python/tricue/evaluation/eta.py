# SPDX-License-Identifier: MIT
"""Remaining time, extrapolated from the finished share of the work."""

from collections.abc import Callable, Sequence
from time import monotonic

from tricue.evaluation.tasks import Task


class RemainingTime:
    """Estimates the remaining time; a task's weight is its share of the work."""

    def __init__(self, weight: Callable[[Task], float], tasks: Sequence[Task]) -> None:
        self._weight = weight
        self._total, self._done = sum(map(weight, tasks)), 0.0
        self._start = monotonic()

    def update(self, task: Task) -> float:
        """Count a task as done; return the estimated remaining seconds."""
        self._done += self._weight(task)
        return (monotonic() - self._start) * (self._total - self._done) / self._done
