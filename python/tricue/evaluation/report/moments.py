# SPDX-License-Identifier: MIT
"""Which frames of a run are worth a picture: the start, and the worst moments."""

import numpy as np
from numpy.typing import NDArray

from tricue.evaluation.rows import Judged

MOST = 4  # worst moments of a run
_APART = 8  # of a run's frames, the part by which two moments lie apart at least


def moments(run: Judged, most: int = MOST) -> list[int]:
    """The first frame and at most ``most`` worst ones, rising, counted from the run's start.

    The lowest overlaps come first, of equal ones the earliest; a frame without the target in which the
    tracker claims to see it counts as overlap 0. Moments lie an eighth of the run apart, so that one loss
    doesn't take all pictures.
    """
    overlaps = judged_overlaps(run)
    apart = max(2, len(overlaps) // _APART)
    chosen = [0]
    for index in np.argsort(overlaps, kind="stable").tolist():
        if len(chosen) > most or np.isnan(overlaps[index]):
            break
        if min(abs(index - other) for other in chosen) >= apart:
            chosen.append(index)
    return sorted(chosen)


def judged_overlaps(run: Judged) -> NDArray[np.float64]:
    """(N,) overlaps, 0 in frames without the target that are said to be TRACKED, NaN where nothing tells."""
    return np.where(run.absent & run.tracked, 0.0, np.where(run.absent, np.nan, run.overlaps))
