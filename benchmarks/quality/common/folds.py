# SPDX-License-Identifier: MIT
"""Cross-validation by recordings: what is fitted on some recordings is tested on another."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.quality.common.frame_results import Flags
from benchmarks.quality.common.groups import recording


class Fold(NamedTuple):
    """N samples: some to fit on, the others, which are from one recording, to test on."""

    recording: str
    fit: Flags
    """(N,) the samples to fit on."""
    judge: Flags
    """(N,) all others."""


def leave_one_out(sequences: Sequence[str]) -> Iterator[Fold]:
    """A fold for each recording, in the order of their first samples.

    sequences: (N,) the name of each sample's sequence; sequences of one recording are left out together.
    ValueError if all samples are from one recording.
    """
    recordings = np.array([recording(each) for each in sequences])
    names = list(dict.fromkeys(recordings.tolist()))
    if len(names) < 2:
        raise ValueError(f"sequences: expected those of two recordings or more, got {len(names)}")
    for name in names:
        judge = recordings == name
        yield Fold(name, ~judge, judge)
