# SPDX-License-Identifier: MIT
"""The stereo head tracker, one update a pair: native, reference, and cv2's trackers on the left image."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.camera.frame import Frame
from tricue.evaluation import baselines, metrics
from tricue.scenes import StereoScene, head

SIZES = ("160x120", "640x480")
OURS = {"native": {}, "reference": {"kernels": "reference"}}
BASELINES = {name: make for name, make in baselines.available().items() if name in ("KCF", "CSRT")}
FRAMES = {"reference": 6}  # of those that take long
USUAL = 60


@cache
def scene(size: str) -> StereoScene:
    """A head in swinging light; made before any clock starts."""
    return head(seed=0, frames=USUAL, camera=size)


def seen(size: str, name: str) -> list[Frame]:
    """What the tracker gets to see; cv2's look at the left image alone."""
    return list(scene(size).frames[: FRAMES.get(name, USUAL)])


def maker(size: str, name: str) -> Callable[[], Any]:
    """How to make the tracker."""
    if name in BASELINES:
        return lambda: BASELINES[name](0)
    return lambda: tricue.create("stereo-head", rig=scene(size).rig, **OURS[name])


@pytest.mark.parametrize("name", [*OURS, *BASELINES])
@pytest.mark.parametrize("size", SIZES)
def bench_stereo_head(benchmark: Any, size: str, name: str) -> None:
    """A round is a pair; init is left out. Both sets of kernels give one track, within 1e-6 px."""
    benchmark.group = f"stereo-head, {size}, one update"
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
