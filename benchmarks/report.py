# SPDX-License-Identifier: MIT
"""Writes docs/benchmarks.md (``make bench``) from pytest-benchmark's JSON file and from trackers, which it measures.

``--kernels`` puts the rows of the kernels that were measured into the page and leaves all else, for a run of some of
the benchmarks: ``pytest benchmarks/fuse/bench_resample.py --benchmark-json=FILE``, then ``python -m benchmarks.report
--kernels FILE``. ``python -m benchmarks.report --trackers`` measures the trackers alone, and leaves the kernels.
"""

import argparse
import json
import platform
import re
import textwrap
from pathlib import Path

import cv2
import numpy as np
from tricue.evaluation.one_pass import one_thread

from benchmarks import frame_size
from benchmarks.kernel_rows import EXPORTED, kernel_of, kernel_rows, kernels_of
from benchmarks.tracker_rows import (
    DEPTH_FRAMES,
    FEW,
    ROUNDS,
    STEREO_FRAMES,
    WALK_FRAMES,
    depth_rows,
    scene,
    size_rows,
    stereo_rows,
    tracker_rows,
    walker_rows,
)
from benchmarks.two_at_once import PAIR_ROUNDS, pair_rows

OUT = Path(__file__).parents[1] / "docs" / "benchmarks.md"

HEAD = """\
# Benchmarks

Written by `make bench`; don't edit. One thread, frames decoded before the clock starts. Machines differ and are noisy: compare only
ratios within one run. Kernels use AVX-512 if the processor has it; with AVX2 alone, an
update takes up to 1.3 times as long (`make level-speeds`).

{machine}"""
KERNELS = """
## Kernels

Every kernel that the extension exports; the minimum of many rounds, in µs. If a name has no size, the input is 100 ellipses of
251 samples, or a frame of 320x240. The baseline is OpenCV's function for the same job, or the short cv2 and NumPy script that one
would write. Every result is checked against the twin's. If a native kernel is less than 20 times as fast as its twin, the twin is a few
vectorized NumPy expressions, or the overhead of a call, half a microsecond, is most of the native time.

The limit is the least time that this machine needs for the bytes or the operations that the inputs demand, measured by probes in the
same run (`benchmarks/limits/machine.py` has the kinds of work). Where the share is below a tenth, the last column says why.
{run}
| kernel | native | reference | baseline | reference / native | baseline / native | share of the limit | why below a tenth |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
ALL = "All rows are from one run, timed by {clock}, on {machine}"
LATER = "The rows of {names} are from a later run than the others, timed by {clock}, on {machine}"
CLOCKS = {"perf_counter": "the wall clock", "process_time": "the process's own time"}
"""By pytest-benchmark's timers; the second is for a machine that is busy."""
TRACKERS = """
## Trackers on figure 1's scene

320x240, a face of 50x63, 90 frames, 100 particles; {rounds} alternating rounds. Frames/s from each frame's minimum
over the rounds, p50 and p99 over all updates. A tracker that has lost the target returns early, so it has a high rate and
no overlap. This and everything below was measured in one run, on {machine}

| tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 |
| --- | --- | --- | --- | --- | --- |
"""
DEPTH = """
## Trackers in depth

A person who walks, crouches and turns, {frames} frames of a time-of-flight camera (176x144) and of an RGB-D camera (640x480); {rounds}
alternating rounds. cv2's trackers see the depth as an 8-bit picture, made before the clock starts. The reference runs once, on {few} frames.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 |
| --- | --- | --- | --- | --- | --- | --- |
"""
STEREO = """
## Trackers in stereo

A head in light that varies by 30 %, {frames} pairs of a stereo camera; {rounds} alternating rounds. cv2's trackers see only the left image, and
give no position. The reference runs once, on {few} pairs.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 | median error |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
WALKERS = """
## Following a walker

A walker who is overtaken, hidden and visible again, {frames} frames of a panning stereo pair; {rounds} alternating rounds. cv2's trackers see
only the left image, and give no position. Overlap and error are over all frames; a fifth of them hide the walker. The reference
runs once, on {few} pairs.

| frames | tracker | frames/s | p50 ms | p99 ms | time / ours | overlap above 0.5 | median error |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""
SIZES = """
## Frame sizes and particles

Figure 1's scene, scaled; frames/s from each frame's minimum over {rounds} rounds.

| | 100 particles | 300 | 1000 |
| --- | --- | --- | --- |
"""
PAIRS = """
## Two trackers at once

Updates/s of both together compared with one alone, best of {rounds} alternating rounds, first frames included. Kernels with enough work
release the GIL, and at first wait for it awake (`python/bindings/unlocked.hpp`); the loop itself is Python and holds it. Two processes
have no such limit.

| trackers | one | two threads | ratio | two processes | ratio |
| --- | --- | --- | --- | --- | --- |
"""


def main() -> None:
    """Write the whole page, or the kernels' rows, or the trackers."""
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
    """The whole page, with new measurements of the trackers."""
    if missing := EXPORTED - kernels_of(rows):
        raise SystemExit(f"report: no benchmark of {', '.join(sorted(missing))} was run")
    kernels = HEAD.format(machine=machine()), KERNELS.format(run=run_of(rows, clock)) + table(rows)
    return "\n".join([*kernels, "", trackers()])


def trackers() -> str:
    """The page from the trackers on, with new measurements."""
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
    """The page with new rows for these kernels, and without rows of kernels that no longer exist."""
    start, end = page.index(first_line(KERNELS)), page.index(first_line(TRACKERS))
    kept = {
        row.split("|")[1].strip(): row
        for row in page[start:end].splitlines()
        if re.match(r"\| [a-z]\w+[^|]*\| \d", row) and kernel_of(row.split("|")[1].strip()) in EXPORTED
    }
    kept = {name: row for name, row in kept.items() if kernel_of(name) not in kernels_of(rows)}
    return page[:start] + KERNELS.format(run=run_of(rows, clock)) + table(kept | rows) + "\n" + page[end:]


def first_line(section: str) -> str:
    """The first line of a section's text, by which the section is found in the page."""
    return section.strip().partition("\n")[0]


def run_of(rows: dict[str, str], clock: str) -> str:
    """The paragraph about the run of these rows."""
    names = kernels_of(rows)
    text = (ALL if names >= EXPORTED else LATER).format(
        clock=clock, machine=machine(), names=", ".join(sorted(names))
    )
    return "\n" + textwrap.fill(text, 130) + "\n"


def table(rows: dict[str, str]) -> str:
    """The rows by their names."""
    return "\n".join(row for _, row in sorted(rows.items()))


def machine() -> str:
    """The machine and the versions that were measured."""
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    model = names[0] if names else platform.machine()
    versions = f"Python {platform.python_version()}, NumPy {np.__version__}, cv2 {cv2.__version__}"
    return f"{model}; {versions}."


if __name__ == "__main__":
    main()
