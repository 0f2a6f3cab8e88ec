# SPDX-License-Identifier: MIT
"""The cost of ``tricue evaluate``: time by number of jobs, memory, size of the report.

    python benchmarks/evaluation.py

The sequences are made in a temporary folder: a textured square that moves in a circle over noise, 160x120.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import cv2
import numpy as np
from tricue.evaluation.report.page import REPORT

SEQUENCES, REPORT_SEQUENCES = 200, 20
SHORT, LONG = 60, 20_000  # frames
TRACKERS = ("color-particle,meanShift", "color-particle,flow-depth,meanShift,still-box")


def write_sequence(folder: Path, frames: int, seed: int) -> None:
    """Write a sequence in OTB's layout."""
    rng = np.random.default_rng(seed)
    ground = rng.integers(20, 60, (120, 160, 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (6, 6, 3), dtype=np.uint8), (40, 40)) // [4, 4, 1]
    (folder / "img").mkdir(parents=True)
    lines = []
    for index in range(frames):
        x, y = 60 + round(50 * np.cos(index / 15)), 40 + round(35 * np.sin(index / 15))
        image = ground.copy()
        image[y : y + 40, x : x + 40] = square
        cv2.imwrite(str(folder / "img" / f"{index + 1:05d}.jpg"), image)
        lines.append(f"{x + 1},{y + 1},40,40\n")
    (folder / "groundtruth_rect.txt").write_text("".join(lines))


def measure_evaluate(data: Path, output: Path, trackers: str, *options: str) -> tuple[float, float]:
    """Run the command; returns its time in seconds, and its peak memory in MB."""
    command = [sys.executable, "-m", "tricue", "evaluate", str(data), "--trackers", trackers]
    start = time.monotonic()
    child = subprocess.Popen([*command, "--output", str(output), *options], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status:
        raise SystemExit(f"tricue evaluate failed: {status}")
    return time.monotonic() - start, used.ru_maxrss / 1024


def main() -> None:
    """Make the sequences, evaluate them, and print the costs."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for index in range(SEQUENCES):
            write_sequence(root / "many" / f"{index:03d}", SHORT, index)
        for name, frames in (("short", SHORT), ("long", LONG)):
            write_sequence(root / name, frames, 0)
        for index in range(REPORT_SEQUENCES):
            (root / "some").mkdir(exist_ok=True)
            (root / "some" / f"{index:03d}").symlink_to(root / "many" / f"{index:03d}")
        two, four = TRACKERS
        for jobs in (1, 2):
            seconds, _ = measure_evaluate(root / "many", root / f"jobs{jobs}", two, "--jobs", str(jobs))
            print(f"{SEQUENCES} sequences of {SHORT} frames, {two}, {jobs} jobs: {seconds:.1f} s", flush=True)
        for name, frames in (("short", SHORT), ("long", LONG)):
            _, memory = measure_evaluate(root / name, root / f"{name}-out", four, "--seeds", "1")
            print(f"{frames:,} frames, {four}: {memory:.0f} MB peak", flush=True)
        measure_evaluate(root / "some", root / "report", four)
        size = (root / "report" / REPORT).stat().st_size / 1e6
        print(f"report of {REPORT_SEQUENCES} sequences: {size:.2f} MB", flush=True)


if __name__ == "__main__":
    main()
