# SPDX-License-Identifier: MIT
"""How long the rest will take, from how long the finished part of the work took."""

from collections.abc import Callable, Sequence
from time import monotonic

from tricue.evaluation.tasks import Task


class Remaining:
    """The time left, where a task's weight tells its share of the work."""

    def __init__(
        self, weight: Callable[[Task], float], tasks: Sequence[Task], clock: Callable[[], float] = monotonic
    ) -> None:
        self._weight, self._clock = weight, clock
        self._total, self._done = sum(map(weight, tasks)), 0.0
        self._start = clock()

    def after(self, task: Task) -> float:
        """Seconds, now that the task is done, too."""
        self._done += self._weight(task)
        return (self._clock() - self._start) * (self._total - self._done) / self._done
