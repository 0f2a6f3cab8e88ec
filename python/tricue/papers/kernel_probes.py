# SPDX-License-Identifier: MIT
"""Kernels that are looked at while a tracker runs on them: their time, and what noise in one of them does."""

from collections import defaultdict
from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.kernels import Kernels
from tricue.track.base.track import Track

MODULES = {
    "color_bins": "search",
    "ellipse_search": "search",
    "ellipse_histogram": "search",
    "histogram_mean": "search",
    "shift_histogram": "search",
    "sad_disparity": "disparity",
    "back_project": "filter",
    "kalman_predict": "filter",
    "kalman_update": "filter",
}
"""What each kernel of the stereo head tracker belongs to, Moreno et al. 2002, figures 1 and 3(d)."""


class WatchedKernels:
    """A set of kernels that does the same, adds up the time in each module, and may disturb disparities.

    noise: standard deviation, pixels, of what is added to each disparity that is back-projected. In the
    stereo head tracker that is the one that was measured in the ellipse, in each frame: the search for the
    head and the gates before it see it undisturbed, and the tracker isn't told.
    """

    def __init__(self, kernels: Kernels, noise: float = 0.0, seed: int = 0) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._kernels, self._noise, self._rng = kernels, noise, np.random.default_rng(seed)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        kernel: Callable[..., Any] = getattr(self._kernels, name)
        module = MODULES[name]

        def timed(*arguments: Any, **keywords: Any) -> Any:
            start = perf_counter()
            try:
                return kernel(*arguments, **keywords)
            finally:
                self.seconds[module] += perf_counter() - start

        setattr(self, name, timed)  # so that it is made once
        return timed

    def back_project(self, pixels: NDArray[np.float64], *others: Any) -> Any:
        """As the kernel, of pixels (N, 3) whose disparities, the last column, are disturbed."""
        disturbed = pixels + self._rng.normal(0, 1, pixels.shape) * [0.0, 0.0, self._noise]
        start = perf_counter()
        try:
            return self._kernels.back_project(disturbed, *others)
        finally:
            self.seconds[MODULES["back_project"]] += perf_counter() - start


class Watched:
    """A tracker on watched kernels; one without kernels, as a peer, runs as it is, without times."""

    def __init__(self, tracker: Any, noise: float = 0.0, seed: int = 0) -> None:
        self._tracker = tracker
        self._kernels: WatchedKernels | None = None
        if hasattr(tracker, "_k"):  # where a tracker keeps the set that it runs on
            self._kernels = tracker._k = WatchedKernels(tracker._k, noise, seed)

    def init(self, frame: Frame, box: Box) -> Track:
        track: Track = self._tracker.init(frame, box)
        self._updates: list[dict[str, float]] = []
        return track

    def update(self, frame: Frame) -> Track:
        if self._kernels is not None:
            self._kernels.seconds.clear()
        track: Track = self._tracker.update(frame)
        self._updates.append({} if self._kernels is None else dict(self._kernels.seconds))
        return track

    def seconds(self, updates: NDArray[np.float64]) -> dict[str, float]:
        """Of an update, in each module and outside of them, as "rest": medians over the updates since the
        last init, of which each took ``updates`` (M - 1,) seconds as a whole.
        """
        names = sorted(set().union(*self._updates))
        spent = np.array([[each.get(name, 0.0) for name in names] for each in self._updates])
        rest = updates - spent.sum(axis=1)
        return dict(zip([*names, "rest"], np.median(np.c_[spent, rest], axis=0).tolist(), strict=True))
