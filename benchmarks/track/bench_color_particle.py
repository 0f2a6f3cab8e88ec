# SPDX-License-Identifier: MIT
"""The color particle tracker, one update a frame: native, reference, and what a user would take instead."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.evaluation import baselines, metrics
from tricue.evaluation.one_pass import AnyTracker
from tricue.scenes import Scene, face_over_clutter

MAKERS: dict[str, Callable[[], AnyTracker]] = {
    "native": lambda: tricue.create("color-particle", seed=0),
    "reference": lambda: tricue.create("color-particle", seed=0, kernels="reference"),
    **{name: (lambda make=make: make(0)) for name, make in baselines.available().items()},
}


@pytest.fixture(scope="module")
def scene() -> Scene:
    """Figure 1's scene, made before any clock starts."""
    pytest.importorskip("skimage", reason="needs scikit-image: pip install tricue[demo]")
    return face_over_clutter(seed=0)


@pytest.mark.benchmark(group="color-particle, 320x240, one update")
@pytest.mark.parametrize("name", MAKERS)
def bench_color_particle(benchmark: Any, name: str, scene: Scene) -> None:
    """A round is a frame; init is left out. Both sets of kernels give one track, within 1e-9 px."""
    boxes = []

    def frames() -> Any:
        for frame in scene.frames[1:]:
            yield (frame,), {}

    tracker = MAKERS[name]()
    tracker.init(scene.frames[0], scene.boxes[0])
    feed = frames()
    benchmark.pedantic(
        lambda frame: boxes.append(tracker.update(frame).box),
        setup=lambda: next(feed),
        rounds=len(scene.frames) - 1,
    )
    truth = np.array(scene.boxes[1 : 1 + len(boxes)])
    benchmark.extra_info["overlap above 0.5"] = float(np.mean(metrics.overlaps(np.array(boxes), truth) > 0.5))
    if name == "reference":
        assert np.abs(np.array(boxes) - native_track(scene)[: len(boxes)]).max() < 1e-9


def native_track(scene: Scene) -> Any:
    """The native track's boxes after the first frame."""
    tracker = MAKERS["native"]()
    tracker.init(scene.frames[0], scene.boxes[0])
    return np.array([tracker.update(frame).box for frame in scene.frames[1:]])
