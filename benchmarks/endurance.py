# SPDX-License-Identifier: MIT
"""Resident memory while trackers run for a long time, and on large frames.

python -m benchmarks.endurance [--updates 1000000] [--trackers NAME...]
python -m benchmarks.endurance --large

Each tracker goes through its scene of benchmarks/frame_size.py, forward and backward, in a process of its
own. The memory is printed after each power of ten and at the end; it is to stay. --large: a start and some
updates on 7680x4320 pixels, and the most memory that each took beside the frames.
"""

import argparse
import resource
import time
from collections.abc import Callable, Iterator
from multiprocessing import get_context
from pathlib import Path

from tricue import Status
from tricue.evaluation.one_pass import one_thread

from benchmarks.frame_size import Case, Size, cases, embedded

LARGE: Size = (7680, 4320)
LARGE_UPDATES = 3
FIRST_LINE = 1000  # updates
HEAD = """\
| tracker | updates | resident MB | seconds | tracked |
| --- | --- | --- | --- | --- |"""
LARGE_HEAD = """\
| tracker | frame, MB | init, MB more | updates, MB more | ms per update | status |
| --- | --- | --- | --- | --- | --- |"""


def resident_megabytes() -> float:
    """Of this process, now."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() / 1e6


def forget_peak() -> None:
    """Begin to measure the peak anew."""
    Path("/proc/self/clear_refs").write_text("5")


def peak_megabytes() -> float:
    """Resident memory of this process, at most since its peak was forgotten."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(float(line.split()[1]) * 1024 / 1e6 for line in lines if line.startswith("VmHWM"))


def endure(case: Case, updates: int) -> Iterator[str]:
    """Track through the scene in a loop; a line of the table after each power of ten, and at the end. A
    tracker that has lost the target starts again when it is at the first frame.
    """
    frames = [*case.frames, *case.frames[-2:0:-1]]
    tracker = case.make(case.small)
    tracker.init(frames[0], case.box(0, case.small))
    tracked, line, start = 0, FIRST_LINE, time.perf_counter()
    for i in range(1, updates + 1):
        status = tracker.update(frames[i % len(frames)]).status
        tracked += status is Status.TRACKED
        if i % len(frames) == 0 and status is Status.LOST:
            tracker.init(frames[0], case.box(0, case.small))
        if i in (line, updates):
            line = 10 * line if i == line else line
            cells = f"{i:,} | {resident_megabytes():.1f} | {time.perf_counter() - start:.0f}"
            yield f"| {case.name} | {cells} | {tracked / i:.0%} |"


def measure_large(case: Case) -> Iterator[str]:
    """Start and update on one large frame; its line of the table."""
    frames = [embedded(frame, LARGE, index) for index, frame in enumerate(case.frames[:2])]
    images = [image for image in (frames[0].color, frames[0].depth, frames[0].right) if image is not None]
    tracker = case.make(LARGE)
    forget_peak()
    before = resident_megabytes()
    tracker.init(frames[0], case.box(0, LARGE))
    first = peak_megabytes()
    forget_peak()
    start = time.perf_counter()
    for i in range(1, LARGE_UPDATES + 1):
        track = tracker.update(frames[i % 2])
    milliseconds = 1e3 * (time.perf_counter() - start) / LARGE_UPDATES
    megabytes = sum(image.nbytes for image in images) / 1e6
    cells = f"{megabytes:.0f} | {first - before:.0f} | {peak_megabytes() - before:.0f} | {milliseconds:.1f}"
    yield f"| {case.name} | {cells} | {track.status.name} |"


def report(lines: Callable[..., Iterator[str]], *arguments: object) -> None:
    """Print the lines as they come."""
    with one_thread():
        for line in lines(*arguments):
            print(line, flush=True)


def main() -> None:
    """A process a tracker, one after the other."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--updates", type=int, default=1_000_000)
    parser.add_argument("--trackers", nargs="+", help="names of the table's rows; all")
    parser.add_argument("--large", action="store_true", help="on 7680x4320 pixels instead")
    options = parser.parse_args()
    print(LARGE_HEAD if options.large else HEAD, flush=True)
    failed = False
    for case in cases():
        if options.trackers and case.name not in options.trackers:
            continue
        arguments = (measure_large, case) if options.large else (endure, case, options.updates)
        process = get_context("fork").Process(target=report, args=arguments)
        process.start()
        process.join()
        failed |= process.exitcode != 0
    raise SystemExit(failed)


if __name__ == "__main__":
    main()
