# SPDX-License-Identifier: MIT
"""Writes docs/benchmarks.md (``make bench``) from pytest-benchmark's JSON file; measures the trackers itself.

``--kernels`` puts the rows of the kernels that were measured into the page and leaves all else, for a run of some of
the benchmarks: ``pytest benchmarks/fuse/bench_resample.py --benchmark-json=FILE``, then ``python -m benchmarks.report
--kernels FILE``. ``python -m benchmarks.report --trackers`` measures the trackers alone, and leaves the kernels.
"""

import argparse
import json
import multiprocessing
import platform
import re
import textwrap
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache, partial
from pathlib import Path
from time import perf_counter
from typing import Any

import cv2
import numpy as np
import tricue
from numpy.typing import NDArray
from tricue import _core
from tricue.camera.box import Box
from tricue.evaluation import baselines, metrics
from tricue.evaluation.one_pass import AnyTracker, Run, one_thread, run
from tricue.evaluation.tracker_spec import depth_as_picture
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

from benchmarks import frame_size
from benchmarks.limits import machine as limits

ROUNDS = 12
PAIR_ROUNDS = 30
DEPTH_FRAMES, FEW = 60, 8  # in depth; of what takes over 50 ms a frame
STEREO_FRAMES = 100
WALK_FRAMES = 100
SLOW = 3  # rounds for what takes over 2 ms a frame
OUT = Path(__file__).parents[1] / "docs" / "benchmarks.md"
EXPORTED = frozenset(name for name in dir(_core) if not name.startswith("_"))
SIDES = {"native": "native", "reference": "reference", "baseline": "baseline", "script": "baseline"}
"""Ids of a kernel's benchmarks, and the columns that they fill; others are not in the table."""
Make = Callable[[], AnyTracker]

HEAD = """\
# Benchmarks

Written by `make bench`; don't edit. One thread, frames decoded before the clock starts. Machines differ and are noisy: the ratios of
one run are what counts.

{machine}"""
KERNELS = """
## Kernels

Every kernel that the extension exports; the minimum of many rounds, in µs. Where a name tells no size, the input is 100 ellipses of
251 samples, or a frame of 320x240. The baseline is OpenCV's function for the same job, or the short cv2 and NumPy script that one
would write. Every result is checked against the twin's. Where a native kernel is less than 20 times as fast as its twin, the twin is a
few vectorized NumPy expressions, or a call's own cost of half a microsecond is most of the native time.

The limit is what this machine can do at most: the least time that it needs for the bytes or the operations that the inputs demand, by
probes in the same run (`benchmarks/limits/machine.py` has the kinds of work). Where a kernel is below a tenth of it, the last column
says what keeps it there.
{run}
| kernel | native | reference | baseline | reference / native | baseline / native | share of the limit | below a tenth, as |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
ALL = "All rows are of one run, by {clock}, on {machine}"
LATER = "The rows of {names} are of a later run than the others, by {clock}, on {machine}"
ENOUGH = 0.1  # of the limit
CLOCKS = {"perf_counter": "the wall clock", "process_time": "the process's own time"}
"""By pytest-benchmark's timers; the second is for a machine that is busy."""
TRACKERS = """
## Trackers on figure 1's scene

320x240, a face of 50x63, 90 frames, 100 particles; {rounds} rounds in turn. Frames/s from each frame's minimum
over the rounds, p50 and p99 over all updates. A tracker that loses the target and fails fast has a high rate and
no overlap. This and all that follows was measured in one run, on {machine}

| tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 |
| --- | --- | --- | --- | --- | --- |
"""
DEPTH = """
## Trackers in depth

A person who walks, crouches and turns, {frames} frames of a time-of-flight camera (176x144) and of an RGB-D camera (640x480); {rounds} rounds
in turn. cv2's trackers see the depth as an 8-bit picture, made before the clock starts. The reference runs once, on {few} frames.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 |
| --- | --- | --- | --- | --- | --- | --- |
"""
STEREO = """
## Trackers in stereo

A head in light that swings by 30 %, {frames} pairs of a stereo camera; {rounds} rounds in turn. cv2's trackers see the left image alone, and
give no position. The reference runs once, on {few} pairs.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 | median error |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
WALKERS = """
## Following a walker

Somebody who is overtaken, hidden and seen again, {frames} frames of a panning stereo pair; {rounds} rounds in turn. cv2's trackers see
the left image alone, and give no position. Overlap and error count in all frames, a fifth of which hide the walker. The reference
runs once, on {few} pairs.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 | median error |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
SIZES = """
## Frame sizes and particles

The same scene scaled; frames/s from each frame's minimum over {rounds} rounds.

| | 100 particles | 300 | 1000 |
| --- | --- | --- | --- |
"""
PAIRS = """
## Two trackers at once

Updates/s of both together against one alone, best of {rounds} rounds in turn. Kernels release the GIL where they have enough work. The
loop itself is Python and holds it; with few particles the loop is half of the time, and to hand the GIL over takes as long as a
small kernel. Two processes have no such limit.

| particles | one | two threads | ratio | two processes | ratio |
| --- | --- | --- | --- | --- | --- |
"""


def main() -> None:
    """Put the document together, or put the kernels' rows into it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("json", type=Path, nargs="?", help="of pytest-benchmark")
    parser.add_argument("--kernels", action="store_true", help="write the rows of these kernels alone")
    parser.add_argument("--trackers", action="store_true", help="measure the trackers alone; takes no file")
    options = parser.parse_args()
    if options.trackers == (options.json is not None) or (options.trackers and options.kernels):
        parser.error("expected a file, or --trackers alone")
    page = OUT.read_text()
    if options.trackers:
        OUT.write_text(page[: page.index(first_line(TRACKERS))] + trackers())
        return
    report = json.loads(options.json.read_text())
    rows = kernel_rows(report)
    clock = CLOCKS[report["benchmarks"][0]["options"]["timer"]]
    OUT.write_text(with_rows(page, rows, clock) if options.kernels else document(rows, clock))


def document(rows: dict[str, str], clock: str) -> str:
    """The whole page, with the trackers measured now."""
    if missing := EXPORTED - kernels_of(rows):
        raise SystemExit(f"report: no benchmark of {', '.join(sorted(missing))} was run")
    kernels = HEAD.format(machine=machine()), KERNELS.format(run=run_of(rows, clock)) + table(rows)
    return "\n".join([*kernels, "", trackers()])


def trackers() -> str:
    """The page from the trackers on, measured now."""
    with one_thread():
        parts = [
            TRACKERS.format(rounds=ROUNDS, machine=machine()).lstrip() + "\n".join(tracker_rows(scene())),
            DEPTH.format(frames=DEPTH_FRAMES, rounds=ROUNDS, few=FEW) + "\n".join(depth_rows()),
            STEREO.format(frames=STEREO_FRAMES, rounds=ROUNDS, few=FEW) + "\n".join(stereo_rows()),
            WALKERS.format(frames=WALK_FRAMES, rounds=ROUNDS, few=FEW) + "\n".join(walker_rows()),
            SIZES.format(rounds=ROUNDS) + "\n".join(size_rows(scene())) + "\n",
            frame_size.section(ROUNDS).rstrip(),
            PAIRS.format(rounds=PAIR_ROUNDS) + "\n".join(pair_rows()) + "\n",
        ]
    return "\n".join(parts)


def with_rows(page: str, rows: dict[str, str], clock: str) -> str:
    """The page with the rows of these kernels new, and without those of kernels that are gone."""
    start, end = page.index(first_line(KERNELS)), page.index(first_line(TRACKERS))
    kept = {
        row.split("|")[1].strip(): row
        for row in page[start:end].splitlines()
        if re.match(r"\| [a-z]\w+[^|]*\| \d", row) and kernel_of(row.split("|")[1].strip()) in EXPORTED
    }
    kept = {name: row for name, row in kept.items() if kernel_of(name) not in kernels_of(rows)}
    return page[:start] + KERNELS.format(run=run_of(rows, clock)) + table(kept | rows) + "\n" + page[end:]


def first_line(section: str) -> str:
    """Of a section's text, by which it is found in the page."""
    return section.strip().partition("\n")[0]


def run_of(rows: dict[str, str], clock: str) -> str:
    """The paragraph that tells of these rows' run."""
    names = kernels_of(rows)
    text = (ALL if names >= EXPORTED else LATER).format(
        clock=clock, machine=machine(), names=", ".join(sorted(names))
    )
    return "\n" + textwrap.fill(text, 130) + "\n"


def table(rows: dict[str, str]) -> str:
    """The rows by their names."""
    return "\n".join(row for _, row in sorted(rows.items()))


def kernel_of(group: str) -> str:
    """The kernel of a group such as "sad_disparity, 160x120"."""
    return group.partition(",")[0]


def kernels_of(rows: dict[str, str]) -> set[str]:
    """The kernels of these rows."""
    return {kernel_of(group) for group in rows}


@cache
def scene() -> Scene:
    """What all trackers are timed on."""
    return face_over_clutter(seed=0)


def machine() -> str:
    """What it was measured on."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    model = names[0] if names else platform.machine()
    versions = f"Python {platform.python_version()}, NumPy {np.__version__}, cv2 {cv2.__version__}"
    return f"{model}; {versions}."


def kernel_rows(report: dict[str, Any]) -> dict[str, str]:
    """A row a group of a kernel's benchmarks, by the group's name."""
    groups: dict[str, dict[str, float]] = {}
    shares: dict[str, str] = {}
    for each in report["benchmarks"]:
        name, column = each["group"], SIDES.get(str(each["param"]).rpartition("-")[2])
        if kernel_of(name) in EXPORTED and column:
            seconds = groups.setdefault(name, {})[column] = each["stats"]["min"]
            if column == "native":
                shares[name] = share_of_limit(name, each["extra_info"]["work"], report["limits"], seconds)
    return {name: f"{row_of(name, **times)} {shares[name]} |" for name, times in groups.items()}


def row_of(name: str, native: float, reference: float, baseline: float) -> str:
    """A kernel's times and what they are of the native one, from seconds."""
    times = f"{1e6 * native:.1f} | {1e6 * reference:.0f} | {1e6 * baseline:.0f}"
    return f"| {name} | {times} | {reference / native:.1f} | {baseline / native:.1f} |"


def share_of_limit(name: str, work: dict[str, Any], machine: limits.Limits, seconds: float) -> str:
    """How near a kernel comes to the limit, and why not nearer. Ends the program where that can't be so."""
    least, kind = limits.least_time({key: work[key] for key in work if key != "why"}, machine)
    share = least / seconds
    if share > 1:
        raise SystemExit(f"report: {name} does {work} in {seconds:.2g} s; this machine needs {least:.2g} s")
    if share < ENOUGH and "why" not in work:
        raise SystemExit(f"report: {name} is at {share:.0%} of the limit by {kind}; say why")
    shown = f"{share:.0%}" if share >= 0.01 else f"{share:.1%}"
    return f"{shown}, {kind} | {work['why'] if share < ENOUGH else ''}"


def tracker_rows(scene: Scene) -> Iterator[str]:
    """A line a tracker, in turn over the rounds."""
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
    """A line a size and tracker in depth."""
    for size, camera in (("176x144", "tof"), ("640x480", "rgbd")):
        scene = walker(seed=0, frames=DEPTH_FRAMES, camera=camera)
        runs = depth_runs(scene)
        best = {name: np.min([each.seconds for each in found], axis=0).mean() for name, found in runs.items()}
        for name, found in runs.items():
            p50, p99 = np.percentile([each.seconds for each in found], [50, 99]) * 1e3
            held = np.mean(metrics.overlaps(found[0].boxes, scene.boxes[: len(found[0].boxes)]) > 0.5)
            ratio = best[name] / best["depth-particle"]
            yield f"| {size} | {name} | {1 / best[name]:,.0f} | {p50:.3f} | {p99:.3f} | {ratio:.2f} | {held:.0%} |"


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
    """A line a size and tracker in stereo."""
    for size in ("160x120", "640x480"):
        scene = head(0, STEREO_FRAMES, size)
        yield from pair_lines(size, scene, "stereo-head", {})


def walker_rows() -> Iterator[str]:
    """A line a size and tracker of a walker."""
    alone = {"flow alone": {"cues": ("flow",)}, "disparity alone": {"cues": ("disparity",)}}
    for size in ("160x120", "640x480"):
        scene = overtaking(0, WALK_FRAMES, size)
        yield from pair_lines(size, scene, "flow-depth", alone)


def pair_lines(
    size: str, scene: StereoScene | WalkScene, tracker: str, variants: dict[str, dict[str, Any]]
) -> Iterator[str]:
    """A line a tracker of pairs: ours, its variants, its reference, and OpenCV's."""
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
    """The median error of the position as a share of the distance; nothing where there is no position."""
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
    """Runs of how each is made, on its frames, in as many of the rounds."""
    runs: dict[str, list[Run]] = {name: [] for name in entries}
    for turn in range(ROUNDS):
        for name, (make, frames, rounds) in entries.items():
            if turn < rounds:
                runs[name].append(run(make(), frames, box))
    return runs


def ours(**parameters: Any) -> Make:
    """How to make our tracker."""
    return lambda: tricue.create("color-particle", **{"seed": 0} | parameters)


def size_rows(scene: Scene) -> Iterator[str]:
    """A line a frame size."""
    for scale in (0.5, 1, 2):
        frames = [cv2.resize(frame.color, None, fx=scale, fy=scale) for frame in scene.frames]
        box = Box(*(scale * number for number in scene.boxes[0]))
        rates = [rate(ours(particles=count), frames, box) for count in (100, 300, 1000)]
        size = f"{frames[0].shape[1]}x{frames[0].shape[0]}"
        yield f"| {size} | " + " | ".join(f"{each:,.0f}" for each in rates) + " |"


def rate(make: Make, frames: Any, box: Box) -> float:
    """Frames/s from each frame's minimum."""
    frames = [tricue.Frame(frame) for frame in frames]
    return float(1 / np.min([run(make(), frames, box).seconds for _ in range(ROUNDS)], axis=0).mean())


def pair_rows() -> Iterator[str]:
    """A line a number of particles: two trackers at once, in threads and in processes, against one alone."""
    scene()  # before a process is forked
    context = multiprocessing.get_context("fork")
    with (
        ThreadPoolExecutor(1) as alone,
        ThreadPoolExecutor(2) as threads,
        ProcessPoolExecutor(2, context) as processes,
    ):
        for particles in (100, 300, 1000):
            pools = ((alone, 1), (threads, 2), (processes, 2))
            rounds = [[rate_in(pool, count, particles) for pool, count in pools] for _ in range(PAIR_ROUNDS)]
            one, *two = np.max(rounds, axis=0)
            ratios = [f"{each:,.0f} | {each / one:.2f}" for each in two]
            yield f"| {particles} | {one:,.0f} | " + " | ".join(ratios) + " |"


def rate_in(pool: Executor, count: int, particles: int) -> float:
    """Updates/s of so many trackers, each in a worker of the pool."""
    start = perf_counter()
    updates = sum(pool.map(follow, range(count), count * [particles]))
    return updates / (perf_counter() - start)


def follow(seed: int, particles: int) -> int:
    """Three times through the scene; how many updates that are."""
    tracker = ours(particles=particles, seed=seed)()
    tracker.init(scene().frames[0], scene().boxes[0])
    for frame in 3 * scene().frames:
        tracker.update(frame)
    return 3 * len(scene().frames)


if __name__ == "__main__":
    main()
