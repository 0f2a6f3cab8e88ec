# SPDX-License-Identifier: MIT
"""The disparity of an ellipse without its margin."""

import numpy as np
import pytest
from tricue import StereoHeadTracker
from tricue import kernels as kernel_sets
from tricue.track.stereo_head.disparity import measure_disparity
from tricue.track.stereo_head.prepared_pair import PreparedPair

DEFAULT = StereoHeadTracker.Params()


@pytest.mark.parametrize("x", [60.0, 60.3, 60.5])
@pytest.mark.parametrize("axes", [(1.9, 2.4), (2.4, 3.1), (6.0, 8.0)])
def test_the_margin_leaves_enough_of_a_small_head(axes: tuple[float, float], x: float) -> None:
    """A head of 4x5 pixels, as at 6 m, is still measured, wherever it lies between the pixels."""
    wide = np.random.default_rng(3).integers(0, 200, (80, 140, 3), dtype=np.uint8)
    left, right = (np.ascontiguousarray(wide[:, at : at + 120]) for at in (10, 17))
    k = kernel_sets.load("native")
    pair = PreparedPair.of(k, left, right, np.inf, None, DEFAULT)
    found = measure_disparity(k, pair, (x, 44.2, *axes), (3, 11), DEFAULT)
    assert found is not None
    assert found.disparity == pytest.approx(7, abs=0.1)
