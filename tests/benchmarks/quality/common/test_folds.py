# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common.folds import leave_one_out


def test_each_recording_is_left_out_once():
    """Every sample is judged once, by a fit on no sample of its recording: sequences of one recording are
    left out together, wherever their samples stand.
    """
    names = ["Couple", "Panda", "Panda", "Gull", "StreetWalker", "Couple"]
    folds = list(leave_one_out(names))
    assert [fold.recording for fold in folds] == ["Couple", "Panda", "Gull"]
    np.testing.assert_array_equal(folds[0].judge, [True, False, False, False, True, True])
    np.testing.assert_array_equal(np.sum([fold.judge for fold in folds], axis=0), 1)
    for fold in folds:
        np.testing.assert_array_equal(fold.fit, ~fold.judge)


@pytest.mark.parametrize("names", [[], ["Gull", "Gull"], ["Couple", "StreetWalker"]])
def test_one_recording_cannot_be_split(names):
    """There is nothing to fit on without another."""
    with pytest.raises(ValueError, match="expected those of two recordings or more"):
        list(leave_one_out(names))
