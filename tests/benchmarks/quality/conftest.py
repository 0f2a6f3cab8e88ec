# SPDX-License-Identifier: MIT
"""A result on a stress scene, made by hand."""

import numpy as np
import pytest

from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.scene_runs import SceneResult

NAN = float("nan")


@pytest.fixture
def scene_result():
    """Makes results of a scene of three frames, the last without the target."""
    return make_result


def make_result(kind="plain", overlaps=(1.0, 0.6, 0.0), counted=(True, True, False), errors=(0.0, 0.2, NAN)):
    """Three frames, the last without the target."""
    gone = np.array([False, False, True])
    seconds = np.array([NAN, 1e-3, 1e-3])
    frames = FrameResults(np.array(overlaps), gone, np.array([1.0, 0.9, 0.2]), ~gone, seconds)
    return SceneResult("x", kind, 0, "color", frames, np.array(errors), np.array(counted), NAN, 1.0, NAN)
