# SPDX-License-Identifier: MIT
import numpy as np

from benchmarks.quality.common import identity_samples
from benchmarks.quality.common.identity_samples import Kind, collect
from benchmarks.quality.common.sequence_runs import find_tasks


def test_samples_of_a_followed_target(folders, monkeypatch):
    """It is never lost; where it is covered, and elsewhere, the first frame's filter responds less. What
    changed against the running means is 0 in the first frame of a run.
    """
    monkeypatch.setattr(identity_samples, "FRAMES_BEFORE_COVER", 5)
    monkeypatch.setattr(identity_samples, "COVER_CHANCE", 0.3)
    monkeypatch.setattr(identity_samples, "MIN_FRAMES", 10)
    samples = collect(find_tasks([], folders, ["there"])[0])
    response = samples.features[:, 3]
    means = [response[samples.kinds == kind].mean() for kind in (Kind.GOOD, Kind.COVERED, Kind.ELSEWHERE)]
    assert means[0] > 3 * max(means[1:])
    change = samples.features[:, 4:]
    np.testing.assert_array_equal(change[0], 0)
    covered = change[samples.kinds == Kind.COVERED]
    assert covered[:, 3].max() < 0


def test_a_sequence_that_is_too_short_has_none(folders):
    """The arrays are empty, and can be joined with others."""
    samples = collect(find_tasks([], folders, ["gap"])[0])
    assert samples.kinds.shape == (0,)
    assert samples.features.shape == (0, 8)
