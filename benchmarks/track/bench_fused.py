# SPDX-License-Identifier: MIT
"""The fused tracker, one whole update a frame: by channels, native and reference, and cv2's on the color."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import baselines, metrics
from tricue.scenes.stress.scene import StressScene, stress_scene
from tricue.track.base.track import Status

SEES = ("color", "color and depth", "pair")
CHANNELS = {"color and depth": "rgbd", "pair": "stereo"}
BASELINES = {
    name: make for name, make in baselines.available().items() if name in ("CSRT", "KCF", "MedianFlow")
}
FRAMES = {"reference": 8}  # of those that take long
USUAL = 60
GROUP = "fused, 320x240, one update"


@cache
def scene(channels: str, seed: int = 0) -> StressScene:
    """A target that comes or goes, its size changing 1:2 in these frames; made before any clock starts."""
    pytest.importorskip("skimage", reason="needs scikit-image: pip install tricue[demo]")
    return stress_scene("scale", seed=seed, channels=channels)


def scene_of(name: str) -> StressScene:
    """What a tracker sees; the frames' color is the same in all."""
    return scene(CHANNELS.get(name, "color"))


def seen(name: str) -> list[Frame]:
    """The frames for a tracker."""
    return list(scene_of(name).frames[: FRAMES.get(name, USUAL)])


def maker(name: str) -> Callable[[], Any]:
    """How to make the tracker."""
    if name in BASELINES:
        return lambda: BASELINES[name](0)
    camera: dict[str, Any] = {"rig": scene_of(name).rig} if name == "pair" else {}
    if name == "color and depth":
        camera["intrinsics"] = scene_of(name).intrinsics
    kernels = "reference" if name == "reference" else "native"
    return lambda: tricue.create("fused", kernels=kernels, **camera)


@pytest.mark.benchmark(group=GROUP)
@pytest.mark.parametrize("name", [*SEES, "reference", *BASELINES])
def bench_fused(benchmark: Any, name: str) -> None:
    """A round is a frame; init is left out. Both sets of kernels give one track, within a tenth of a pixel: a
    sample that is rounded to another level of 255 changes what is learnt.
    """
    boxes = []
    tracker = maker(name)()
    tracker.init(seen(name)[0], Box(*scene_of(name).boxes[0].tolist()))
    feed = iter(seen(name)[1:])
    benchmark.pedantic(
        lambda frame: boxes.append(tracker.update(frame).box),
        setup=lambda: ((next(feed),), {}),
        rounds=len(seen(name)) - 1,
    )
    truth = scene_of(name).boxes[1 : 1 + len(boxes)]
    benchmark.extra_info["overlap above 0.5"] = float(np.mean(metrics.overlaps(np.array(boxes), truth) > 0.5))
    if name == "reference":
        assert np.abs(np.array(boxes) - native_track()[: len(boxes)]).max() < 0.1


@pytest.mark.benchmark(group=GROUP)
def bench_fused_lost(benchmark: Any) -> None:
    """A round is a frame in which the tracker, on color, looks for its target everywhere: another room, in
    which the target isn't. It stays lost.
    """
    tracker = maker("color")()
    tracker.init(seen("color")[0], Box(*scene("color").boxes[0].tolist()))
    elsewhere = scene("color", seed=1).frames[:USUAL]
    feed = iter(elsewhere)
    while tracker.update(next(feed)).status is not Status.LOST:
        pass
    searched = list(feed)
    feed = iter(searched)
    statuses = []
    benchmark.pedantic(
        lambda frame: statuses.append(tracker.update(frame).status),
        setup=lambda: ((next(feed),), {}),
        rounds=len(searched),
    )
    assert len(searched) >= USUAL // 2
    assert set(statuses) == {Status.LOST}


def native_track() -> Any:
    """The native track's boxes after the first frame, on color alone as the reference's."""
    tracker = maker("color")()
    tracker.init(seen("color")[0], Box(*scene("color").boxes[0].tolist()))
    return np.array([tracker.update(frame).box for frame in seen("color")[1:]])
