# SPDX-License-Identifier: MIT
"""The depth particle tracker, one update a frame: native, reference, and cv2's on the depth as a picture."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.camera.frame import Frame
from tricue.evaluation import baselines, metrics
from tricue.evaluation.tracker_spec import pictured
from tricue.scenes import DepthScene, walker

SIZES = {"176x144": "tof", "640x480": "rgbd"}
OURS = {"native": {}, "reference": {"kernels": "reference"}}
BASELINES = {name: make for name, make in baselines.available().items() if name in ("KCF", "CSRT")}
FRAMES = {"reference": 8}  # of those that take long
USUAL = 60


@cache
def scene(size: str) -> DepthScene:
    """A walker; made before any clock starts."""
    return walker(seed=0, frames=USUAL, camera=SIZES[size])


@cache
def seen(size: str, name: str) -> list[Frame]:
    """What the tracker gets to see."""
    frames = list(scene(size).frames) if name in OURS else list(map(pictured(), scene(size).frames))
    return frames[: FRAMES.get(name, USUAL)]


def maker(size: str, name: str) -> Callable[[], Any]:
    """How to make the tracker."""
    if name in BASELINES:
        return lambda: BASELINES[name](0)
    return lambda: tricue.create("depth-particle", intrinsics=scene(size).intrinsics, **OURS[name])


@pytest.mark.parametrize("name", [*OURS, *BASELINES])
@pytest.mark.parametrize("size", SIZES)
def bench_depth_particle(benchmark: Any, size: str, name: str) -> None:
    """A round is a frame; init is left out. Both sets of kernels give one track, within 1e-6 px."""
    benchmark.group = f"depth-particle, {size}, one update"
    boxes = []
    tracker = maker(size, name)()
    tracker.init(seen(size, name)[0], scene(size).boxes[0])
    feed = iter(seen(size, name)[1:])
    benchmark.pedantic(
        lambda frame: boxes.append(tracker.update(frame).box),
        setup=lambda: ((next(feed),), {}),
        rounds=len(seen(size, name)) - 1,
    )
    truth = np.array(scene(size).boxes[1 : 1 + len(boxes)])
    benchmark.extra_info["overlap above 0.5"] = float(np.mean(metrics.overlaps(np.array(boxes), truth) > 0.5))
    if name == "reference":
        assert np.abs(np.array(boxes) - native_track(size)[: len(boxes)]).max() < 1e-6


def native_track(size: str) -> Any:
    """The native track's boxes after the first frame."""
    tracker = maker(size, "native")()
    tracker.init(seen(size, "native")[0], scene(size).boxes[0])
    return np.array([tracker.update(frame).box for frame in seen(size, "native")[1:]])
