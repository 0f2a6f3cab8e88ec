# SPDX-License-Identifier: MIT
"""Rows of trackers for docs/benchmarks.md: tricue's with both sets of kernels, and cv2's, in turns."""

from collections.abc import Callable, Iterator
from functools import cache, partial
from typing import Any

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue.camera.box import Box
from tricue.evaluation import baselines, metrics
from tricue.evaluation.frame_views import depth_as_picture
from tricue.evaluation.one_pass import AnyTracker, Run, run
from tricue.scenes import (
    DepthScene,
    Scene,
    StereoScene,
    WalkScene,
    face_over_clutter,
    head,
    overtaking,
    walker,
)

ROUNDS = 12
DEPTH_FRAMES, FEW = 60, 8  # in depth; for trackers that take over 50 ms per frame
STEREO_FRAMES = 100
WALK_FRAMES = 100
SLOW = 3  # rounds for trackers that take over 2 ms per frame
Make = Callable[[], AnyTracker]


@cache
def scene() -> Scene:
    """The scene that color trackers are timed on."""
    return face_over_clutter(seed=0)


def tracker_rows(scene: Scene) -> Iterator[str]:
    """A line per tracker; they take turns in every round."""
    makers = {"color-particle": ours(), "color-particle, reference": ours(kernels="reference")}
    makers["fused"] = partial(tricue.create, "fused")
    makers |= {name: (lambda make=make: make(0)) for name, make in baselines.available().items()}
    times: dict[str, list[NDArray[np.float64]]] = {name: [] for name in makers}
    overlap = {}
    for turn in range(ROUNDS):
        for name, make in makers.items():
            if turn >= SLOW and np.median(times[name][0]) > 2e-3:
                continue
            result = run(make(), scene.frames, scene.boxes[0])
            times[name].append(result.seconds)
            overlap[name] = np.mean(metrics.overlaps(result.boxes, np.array(scene.boxes)) > 0.5)
    best = {name: np.min(each, axis=0).mean() for name, each in times.items()}
    for name, mean in sorted(best.items(), key=lambda item: item[1]):
        p50, p99 = np.percentile(times[name], [50, 99]) * 1e3
        ratio = mean / best["color-particle"]
        yield f"| {name} | {1 / mean:,.0f} | {p50:.3f} | {p99:.3f} | {ratio:.2f} | {overlap[name]:.0%} |"


def depth_rows() -> Iterator[str]:
    """A line per size and tracker in depth."""
    for size, camera in (("176x144", "tof"), ("640x480", "rgbd")):
        scene = walker(seed=0, frames=DEPTH_FRAMES, camera=camera)
        runs = depth_runs(scene)
        best = {name: np.min([each.seconds for each in found], axis=0).mean() for name, found in runs.items()}
        for name, found in runs.items():
            p50, p99 = np.percentile([each.seconds for each in found], [50, 99]) * 1e3
            held = np.mean(metrics.overlaps(found[0].boxes, scene.boxes[: len(found[0].boxes)]) > 0.5)
            ratio = best[name] / best["depth-particle"]
            times = f"{1 / best[name]:,.0f} | {p50:.3f} | {p99:.3f} | {ratio:.2f}"
            yield f"| {size} | {name} | {times} | {held:.0%} |"


def depth_runs(scene: DepthScene) -> dict[str, list[Run]]:
    """The trackers' runs, in turn over the rounds; slow ones sit out the later."""
    make = partial(tricue.create, "depth-particle", intrinsics=scene.intrinsics)
    pictures = list(map(depth_as_picture(), scene.frames))
    entries: dict[str, tuple[Make, Any, int]] = {
        "depth-particle": (make, scene.frames, ROUNDS),
        "depth-particle, reference": (partial(make, kernels="reference"), scene.frames[:FEW], 1),
    }
    entries |= {
        name: (partial(baseline, 0), pictures, SLOW)
        for name, baseline in baselines.available().items()
        if name in ("KCF", "CSRT")
    }
    return in_turn(entries, scene.boxes[0])


def stereo_rows() -> Iterator[str]:
    """A line per size and tracker in stereo."""
    for size in ("160x120", "640x480"):
        scene = head(0, STEREO_FRAMES, size)
        yield from pair_lines(size, scene, "stereo-head", {})


def walker_rows() -> Iterator[str]:
    """A line per size and tracker that follows a walker."""
    alone = {"flow alone": {"cues": ("flow",)}, "disparity alone": {"cues": ("disparity",)}}
    for size in ("160x120", "640x480"):
        scene = overtaking(0, WALK_FRAMES, size)
        yield from pair_lines(size, scene, "flow-depth", alone)


def pair_lines(
    size: str, scene: StereoScene | WalkScene, tracker: str, variants: dict[str, dict[str, Any]]
) -> Iterator[str]:
    """A line per tracker of stereo pairs: tricue's, its variants, its reference, and OpenCV's."""
    runs = stereo_runs(scene, tracker, variants)
    best = {name: np.min([each.seconds for each in found], axis=0).mean() for name, found in runs.items()}
    for name, found in runs.items():
        p50, p99 = np.percentile([each.seconds for each in found], [50, 99]) * 1e3
        count = len(found[0].boxes)
        held = np.mean(metrics.overlaps(found[0].boxes, scene.boxes[:count]) > 0.5)
        ratio = best[name] / best[tracker]
        times = f"{1 / best[name]:,.0f} | {p50:.3f} | {p99:.3f} | {ratio:.2f}"
        yield f"| {size} | {name} | {times} | {held:.0%} | {off(found[0], scene)} |"


def off(found: Run, scene: StereoScene | WalkScene) -> str:
    """The median error of the position as a share of the distance; "" without positions."""
    if np.isnan(found.positions).any():
        return ""
    truth = scene.positions[: len(found.positions)]
    shares = np.linalg.norm(found.positions - truth, axis=1) / np.linalg.norm(truth, axis=1)
    return f"{np.median(shares):.1%}"


def stereo_runs(
    scene: StereoScene | WalkScene, tracker: str, variants: dict[str, dict[str, Any]]
) -> dict[str, list[Run]]:
    """The trackers' runs, in turn over the rounds; slow ones sit out the later."""
    make = partial(tricue.create, tracker, rig=scene.rig)
    entries: dict[str, tuple[Make, Any, int]] = {tracker: (make, scene.frames, ROUNDS)}
    entries |= {
        f"{tracker}, {name}": (partial(make, **keywords), scene.frames, ROUNDS)
        for name, keywords in variants.items()
    }
    entries[f"{tracker}, reference"] = (partial(make, kernels="reference"), scene.frames[:FEW], 1)
    entries |= {
        name: (partial(baseline, 0), scene.frames, SLOW)
        for name, baseline in baselines.available().items()
        if name in ("KCF", "CSRT")
    }
    return in_turn(entries, scene.boxes[0])


def in_turn(entries: dict[str, tuple[Make, Any, int]], box: Box) -> dict[str, list[Run]]:
    """The runs of each entry, (maker, frames, number of rounds), taking turns."""
    runs: dict[str, list[Run]] = {name: [] for name in entries}
    for turn in range(ROUNDS):
        for name, (make, frames, rounds) in entries.items():
            if turn < rounds:
                runs[name].append(run(make(), frames, box))
    return runs


def ours(**parameters: Any) -> Make:
    """A maker of color-particle with these parameters."""
    return lambda: tricue.create("color-particle", **{"seed": 0} | parameters)


def size_rows(scene: Scene) -> Iterator[str]:
    """A line per frame size."""
    for scale in (0.5, 1, 2):
        frames = [cv2.resize(frame.color, None, fx=scale, fy=scale) for frame in scene.frames]
        box = Box(*(scale * number for number in scene.boxes[0]))
        rates = [rate(ours(particles=count), frames, box) for count in (100, 300, 1000)]
        size = f"{frames[0].shape[1]}x{frames[0].shape[0]}"
        yield f"| {size} | " + " | ".join(f"{each:,.0f}" for each in rates) + " |"


def rate(make: Make, frames: Any, box: Box) -> float:
    """Frames/s from each frame's minimum time."""
    frames = [tricue.Frame(frame) for frame in frames]
    return float(1 / np.min([run(make(), frames, box).seconds for _ in range(ROUNDS)], axis=0).mean())
