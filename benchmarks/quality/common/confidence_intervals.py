# SPDX-License-Identifier: MIT
"""How much a summary of scores and statuses depends on the choice of recordings.

Lost frames come in long runs in a few recordings, so one recording more or less changes the summary of all
frames by more than most changes of a tracker do.
"""

import math
from collections.abc import Mapping

import numpy as np
from tricue.evaluation.bootstrap import LEVEL, Interval

from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.frame_results import Array, FrameResults

DRAWS, SEED = 300, 0


def summary_intervals(recordings: Mapping[str, FrameResults]) -> list[Interval]:
    """Each number of the summary of all frames, with its bootstrap percentile interval of level LEVEL.

    Whole recordings are drawn, always with the same seed. With fewer than two recordings, intervals are NaN.
    """
    names, rng = list(recordings), np.random.default_rng(SEED)
    found = summarize(FrameResults.pooled(list(recordings.values())))
    draws = [rng.choice(names, len(names)) for _ in range(DRAWS if len(names) > 1 else 0)]
    summaries = [summarize(FrameResults.pooled([recordings[name] for name in draw])) for draw in draws]
    numbers = np.array(summaries).reshape(-1, len(found))
    return [Interval(number, *_ends(drawn)) for number, drawn in zip(found, numbers.T, strict=True)]


def _ends(drawn: Array) -> tuple[float, float]:
    """The interval of the numbers that aren't NaN: a draw may have no lost frame."""
    known = drawn[~np.isnan(drawn)]
    if not known.size:
        return math.nan, math.nan
    tail = (1 - LEVEL) / 2
    low, high = np.quantile(known, [tail, 1 - tail]).tolist()
    return low, high
