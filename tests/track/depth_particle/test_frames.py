# SPDX-License-Identifier: MIT
"""That the same measurements and times give the same track in every layout and encoding."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import DepthParticleTracker, Frame
from tricue.scenes import DepthScene

LAYOUTS: dict[str, Callable[[NDArray[np.float32]], NDArray[np.generic]]] = {
    "NaN": lambda depth: depth.copy(),
    "0": lambda depth: np.nan_to_num(depth, nan=0.0),
    "infinity": lambda depth: np.where(np.isnan(depth), np.float32(np.inf), depth),
    "negative": lambda depth: np.where(np.isnan(depth), np.float32(-1), depth),
    "float64": lambda depth: depth.astype(np.float64),
    "Fortran": np.asfortranarray,
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_all_encodings_of_no_measurement_are_the_same(name, passing: DepthScene, follow, pass_by):
    """NaN, 0, infinity, below 0, float64 and another memory order give the same track bit for bit."""
    frames = [Frame(depth=LAYOUTS[name](f.depth), timestamp=f.timestamp) for f in passing.frames]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, seed=5)
    assert follow(tracker, frames, passing.boxes[0]) == pass_by(seed=5)


@pytest.mark.parametrize(("dtype", "scale"), [(np.uint16, 0.001), (np.uint16, 0.0002), (np.int32, 0.001)])
def test_integers_with_a_scale_are_meters(dtype, scale, passing: DepthScene, follow):
    """Integers with depth_scale give the track of the same meters as floats, bit for bit."""
    counts = [np.rint(np.nan_to_num(f.depth) / scale).astype(dtype) for f in passing.frames]
    ours, theirs = (
        follow(DepthParticleTracker(intrinsics=passing.intrinsics, seed=5), frames, passing.boxes[0])
        for frames in (
            [Frame(depth=each, depth_scale=scale) for each in counts],
            [Frame(depth=each.astype(np.float32) * np.float32(scale)) for each in counts],
        )
    )
    assert ours == theirs


def test_color_beside_the_depth_changes_nothing(passing: DepthScene, follow, pass_by):
    """A color channel, of another size too, is ignored."""
    picture = np.random.default_rng(0).integers(0, 256, (20, 30, 3), np.uint8)
    frames = [Frame(color=picture, depth=f.depth, timestamp=f.timestamp) for f in passing.frames]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, seed=5)
    assert follow(tracker, frames, passing.boxes[0]) == pass_by(seed=5)


@pytest.mark.parametrize("rate", [15, 30])
def test_timestamps_are_the_rate(rate, passing: DepthScene, follow):
    """Frames with timestamps 1 / rate apart give the track of frames without any at that rate.

    With i / rate, differences are off by a rounding of i / rate, 2.2e-16 s of 2.4 s at most: a share of 7e-15
    of a frame. It goes into drift and noise as meters (velocity and position_noise times seconds), and from
    there, as in a step on other kernels, into log weights that are 200 times as steep a meter at most, which
    is 1e-12 px a frame, carried on over 36 frames: 1e-9 px, unless a resampled index or a sample crosses its
    border, a chance of about 1e-4.
    """
    bare = [Frame(depth=frame.depth) for frame in passing.frames]
    timed = [Frame(depth=f.depth, timestamp=i / rate) for i, f in enumerate(passing.frames)]
    ours, theirs = (
        follow(DepthParticleTracker(intrinsics=passing.intrinsics, seed=2, rate=r), frames, passing.boxes[0])
        for frames, r in ((bare, rate), (timed, 7))
    )
    # The first frame has no time before it, and no step to take.
    assert np.abs(np.subtract([t.box for t in ours], [t.box for t in theirs])).max() <= 1e-9
    assert [t.status for t in ours] == [t.status for t in theirs]


def test_time_matters(passing: DepthScene, follow):
    """At another rate the same frames give another track: somebody's speed is in meters a second."""
    boxes = [
        follow(DepthParticleTracker(seed=2, rate=rate), [Frame(depth=f.depth) for f in passing.frames], None)[
            -1
        ].box
        for rate in (5, 15)
    ]
    assert boxes[0] != boxes[1]


@pytest.mark.parametrize(
    "stamps", [(0.0, 0.0, 0.0), (2.0, 1.0, 0.0), (None, 0.5, None), (0.0, 1e9, 2e9)], ids=str
)
def test_irregular_timestamps_are_accepted(stamps, passing: DepthScene, follow):
    """Times that stand still, run back, come now and then, or leap by years leave the target followed."""
    frames = [Frame(depth=f.depth, timestamp=t) for f, t in zip(passing.frames, stamps, strict=False)]
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics)
    tracks = follow(tracker, frames, passing.boxes[0])
    assert min(track.box.iou(box) for track, box in zip(tracks, passing.boxes[:3], strict=True)) > 0.5
