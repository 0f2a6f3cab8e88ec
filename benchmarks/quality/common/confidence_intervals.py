# SPDX-License-Identifier: MIT
"""How much a summary of scores and statuses hangs on which recordings there are.

Lost frames come in long runs of few recordings, so that another recording more, or one less, changes what is
told of all frames by more than most changes of a tracker do.
"""

import math
from collections.abc import Mapping

import numpy as np
from tricue.evaluation.bootstrap import LEVEL, Interval

from benchmarks.quality.common.confidence_summary import summarize
from benchmarks.quality.common.frame_results import Array, FrameResults

DRAWS, SEED = 300, 0


def summary_intervals(recordings: Mapping[str, FrameResults]) -> list[Interval]:
    """Each number of the summary of all frames, with the ends of its LEVEL percentile interval, for which
    whole recordings are drawn; the same for the same frames. With fewer than two recordings there are none.
    """
    names, rng = list(recordings), np.random.default_rng(SEED)
    found = summarize(FrameResults.pooled(list(recordings.values())))
    draws = [rng.choice(names, len(names)) for _ in range(DRAWS if len(names) > 1 else 0)]
    summaries = [summarize(FrameResults.pooled([recordings[name] for name in draw])) for draw in draws]
    numbers = np.array(summaries).reshape(-1, len(found))
    return [Interval(number, *_ends(drawn)) for number, drawn in zip(found, numbers.T, strict=True)]


def _ends(drawn: Array) -> tuple[float, float]:
    """Of the numbers that are known: a draw may have no lost frame."""
    known = drawn[~np.isnan(drawn)]
    if not known.size:
        return math.nan, math.nan
    tail = (1 - LEVEL) / 2
    low, high = np.quantile(known, [tail, 1 - tail]).tolist()
    return low, high
