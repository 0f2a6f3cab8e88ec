# SPDX-License-Identifier: MIT
"""The memory that trackers need on frames of 7680x4320 pixels.

python -m benchmarks.large_frames [--trackers NAME...]

Each tracker is initialized and updated a few times in its own process, on its scene of
benchmarks/frame_size.py in the middle of such frames. The table has the peak memory of each in addition to
the frames.
"""

import argparse
import time
from multiprocessing import get_context
from pathlib import Path

from tricue.evaluation.one_pass import one_thread

from benchmarks.frame_size import Case, Size, cases, embedded
from benchmarks.quality.soak import resident_megabytes

LARGE: Size = (7680, 4320)
UPDATES = 3
HEAD = """\
| tracker | frame, MB | init, MB more | updates, MB more | ms per update | status |
| --- | --- | --- | --- | --- | --- |"""


def forget_peak() -> None:
    """Reset the process's peak memory."""
    Path("/proc/self/clear_refs").write_text("5")


def peak_megabytes() -> float:
    """The peak resident memory of this process since it was reset."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(float(line.split()[1]) * 1024 / 1e6 for line in lines if line.startswith("VmHWM"))


def measure(case: Case) -> str:
    """Initialize and update a tracker on large frames; its line of the table."""
    frames = [embedded(frame, LARGE, index) for index, frame in enumerate(case.frames[:2])]
    images = [image for image in (frames[0].color, frames[0].depth, frames[0].right) if image is not None]
    tracker = case.make(LARGE)
    forget_peak()
    before = resident_megabytes()
    tracker.init(frames[0], case.box(0, LARGE))
    first = peak_megabytes()
    forget_peak()
    start = time.perf_counter()
    for i in range(1, UPDATES + 1):
        track = tracker.update(frames[i % 2])
    milliseconds = 1e3 * (time.perf_counter() - start) / UPDATES
    megabytes = sum(image.nbytes for image in images) / 1e6
    cells = f"{megabytes:.0f} | {first - before:.0f} | {peak_megabytes() - before:.0f} | {milliseconds:.1f}"
    return f"| {case.name} | {cells} | {track.status.name} |"


def report(case: Case) -> None:
    """Print a tracker's line."""
    with one_thread():
        print(measure(case), flush=True)


def main() -> None:
    """Measure each tracker in its own process, one after the other."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--trackers", nargs="+", help="names of the table's rows; all")
    options = parser.parse_args()
    print(HEAD, flush=True)
    failed = False
    for case in cases(2):
        if options.trackers and case.name not in options.trackers:
            continue
        process = get_context("fork").Process(target=report, args=(case,))
        process.start()
        process.join()
        failed |= process.exitcode != 0
    raise SystemExit(failed)


if __name__ == "__main__":
    main()
