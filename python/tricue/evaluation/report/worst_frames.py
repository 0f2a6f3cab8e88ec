# SPDX-License-Identifier: MIT
"""The frames of a run that the report shows: the first one, and the worst ones."""

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation.rows import ScoredRun

MAX_WORST_FRAMES = 4
"""Per run, besides the first frame."""
_SPACINGS = 8
"""Two of them are at least this fraction, 1 / _SPACINGS, of the run's length apart."""


def worst_frames(run: ScoredRun) -> list[int]:
    """The first frame and at most MAX_WORST_FRAMES worst ones, in order, counted from the run's start.

    The worst frames have the lowest overlaps; among equals the earliest. A frame without the target counts as
    overlap 0 if its status is TRACKED. They are an eighth of the run apart, so that one loss doesn't take up
    all pictures.
    """
    overlaps = _ranked_overlaps(run)
    spacing = max(2, len(overlaps) // _SPACINGS)
    chosen = [0]
    for index in np.argsort(overlaps, kind="stable").tolist():
        if len(chosen) > MAX_WORST_FRAMES or np.isnan(overlaps[index]):
            break
        if min(abs(index - other) for other in chosen) >= spacing:
            chosen.append(index)
    return sorted(chosen)


def _ranked_overlaps(run: ScoredRun) -> NDArray[np.float64]:
    """(N,) overlaps, 0 in frames without the target that are TRACKED, NaN where unknown."""
    return np.where(run.absent & run.tracked, 0.0, np.where(run.absent, np.nan, run.overlaps))
