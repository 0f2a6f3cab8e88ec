# SPDX-License-Identifier: MIT
"""What evaluating costs: ``python benchmarks/evaluation.py`` prints time by jobs, memory, the report's size.

The sequences are made in a temporary folder: a textured square that goes round over noise, 160x120.
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

MANY, SHORT, LONG = 200, 60, 20_000  # sequences; frames
REPORTED = 20  # sequences of the report
TRACKERS = ("color-particle,meanShift", "color-particle,flow-depth,meanShift,still-box")


def write_sequence(folder: Path, frames: int, seed: int) -> None:
    """OTB's layout."""
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


def evaluated(data: Path, output: Path, trackers: str, *options: str) -> tuple[float, float]:
    """Seconds and peak memory in MB of the whole command."""
    command = [sys.executable, "-m", "tricue", "evaluate", str(data), "--trackers", trackers]
    begin = time.monotonic()
    child = subprocess.Popen([*command, "--output", str(output), *options], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    if status:
        raise SystemExit(f"tricue evaluate failed: {status}")
    return time.monotonic() - begin, used.ru_maxrss / 1024


def main() -> None:
    """Make the sequences, evaluate, print."""
    with tempfile.TemporaryDirectory() as place:
        root = Path(place)
        for index in range(MANY):
            write_sequence(root / "many" / f"{index:03d}", SHORT, index)
        for name, frames in (("short", SHORT), ("long", LONG)):
            write_sequence(root / name, frames, 0)
        for index in range(REPORTED):
            (root / "some").mkdir(exist_ok=True)
            (root / "some" / f"{index:03d}").symlink_to(root / "many" / f"{index:03d}")
        both, own = TRACKERS
        for jobs in (1, 2):
            seconds, _ = evaluated(root / "many", root / f"jobs{jobs}", both, "--jobs", str(jobs))
            print(f"{MANY} sequences of {SHORT} frames, {both}, {jobs} jobs: {seconds:.1f} s", flush=True)
        for name, frames in (("short", SHORT), ("long", LONG)):
            _, memory = evaluated(root / name, root / f"{name}-out", own, "--seeds", "1")
            print(f"{frames:,} frames, {own}: {memory:.0f} MB at most", flush=True)
        evaluated(root / "some", root / "report", own)
        size = (root / "report" / REPORT).stat().st_size / 1e6
        print(f"report of {REPORTED} sequences: {size:.2f} MB", flush=True)


if __name__ == "__main__":
    main()
