# SPDX-License-Identifier: MIT
"""Rows for docs/benchmarks.md of two trackers of a kind that run at once, in threads and in processes."""

import multiprocessing
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import tricue
from tricue.scenes import face_over_clutter, head, overtaking, walker
from tricue.scenes.stress.scene import stress_scene

PAIR_ROUNDS = 12
SECONDS = 0.3  # of a tracker's run in a round


class Case(NamedTuple):
    """A kind of tracker, with parameters, and what it follows."""

    tracker: str
    parameters: dict[str, Any]
    scene: Callable[[], Any]
    camera: str | None = None  # the scene's, which the tracker takes


CASES = {
    "color-particle": Case("color-particle", {}, lambda: face_over_clutter(0)),
    "color-particle, 300 particles": Case("color-particle", {"particles": 300}, lambda: face_over_clutter(0)),
    "color-particle, 1000 particles": Case(
        "color-particle", {"particles": 1000}, lambda: face_over_clutter(0)
    ),
    "depth-particle, 176x144": Case("depth-particle", {}, lambda: walker(0, 60, "tof"), "intrinsics"),
    "stereo-head, 160x120": Case("stereo-head", {}, lambda: head(0, 60), "rig"),
    "stereo-head, 640x480": Case("stereo-head", {}, lambda: head(0, 60, "640x480"), "rig"),
    "flow-depth, 160x120": Case("flow-depth", {}, lambda: overtaking(0, 60), "rig"),
    "fused, color": Case("fused", {}, lambda: face_over_clutter(0)),
    "fused, color and depth": Case(
        "fused", {}, lambda: stress_scene("fast", 0, channels="rgbd"), "intrinsics"
    ),
    "fused, stereo pair": Case("fused", {}, lambda: stress_scene("fast", 0, channels="stereo"), "rig"),
}


@cache
def scene_of(name: str) -> Any:
    """The scene of a case."""
    return CASES[name].scene()


def pair_rows() -> Iterator[str]:
    """A line per case: two trackers at once, in threads and in processes, and one alone."""
    for name in CASES:
        scene_of(name)  # cached before processes are forked
    context = multiprocessing.get_context("fork")
    with (
        ThreadPoolExecutor(1) as alone,
        ThreadPoolExecutor(2) as threads,
        ProcessPoolExecutor(2, context) as processes,
    ):
        pools = ((alone, 1), (threads, 2), (processes, 2))
        for name in CASES:
            runs = max(1, round(SECONDS / follow(0, name, 1)[1]))
            rounds = [[rate_in(pool, count, name, runs) for pool, count in pools] for _ in range(PAIR_ROUNDS)]
            one, *two = np.max(rounds, axis=0)
            ratios = [f"{each:,.0f} | {each / one:.2f}" for each in two]
            yield f"| {name} | {one:,.0f} | " + " | ".join(ratios) + " |"


def rate_in(pool: Executor, count: int, name: str, runs: int) -> float:
    """Updates/s of so many trackers, each in a worker of the pool."""
    start = perf_counter()
    updates = sum(updates for updates, _ in pool.map(follow, range(count), count * [name], count * [runs]))
    return updates / (perf_counter() - start)


def follow(seed: int, name: str, runs: int) -> tuple[int, float]:
    """Track through a case's scene so many times; the number of updates, and the seconds."""
    case, scene = CASES[name], scene_of(name)
    camera = {} if case.camera is None else {case.camera: getattr(scene, case.camera)}
    start = perf_counter()
    for _ in range(runs):
        tracker = tricue.create(case.tracker, seed=seed, **camera, **case.parameters)
        tracker.init(scene.frames[0], scene.boxes[0])
        for frame in scene.frames[1:]:
            tracker.update(frame)
    return runs * (len(scene.frames) - 1), perf_counter() - start
