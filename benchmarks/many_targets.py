# SPDX-License-Identifier: MIT
"""The cost of a frame with 1, 2, 4 and 8 targets, with one worker and with two.

``python benchmarks/many_targets.py`` prints a table for targets of ``fused`` in color, 640x480. A frame's
time is its minimum over all rounds, in which the cases take turns; a case's time is the median over the
frames. On a machine with two cores, anything else that runs slows down the second worker.
"""

import argparse
import time

import numpy as np
import tricue
from numpy.typing import NDArray
from tricue import imgproc

HEIGHT, WIDTH, FRAMES = 480, 640, 60
THING = 48, 72  # pixels: size of a target
TARGETS, WORKERS = (1, 2, 4, 8), (1, 2)


def film(seed: int = 0) -> tuple[list[NDArray[np.uint8]], list[tricue.Box]]:
    """Frames of textured objects that move over blurred noise, and their boxes in the first frame."""
    rng = np.random.default_rng(seed)
    width, height = THING
    noise = rng.integers(0, 256, (HEIGHT // 16, WIDTH // 16, 3)).astype(np.float32)
    ground = imgproc.resize(noise, HEIGHT, WIDTH, "cubic")
    things = [
        imgproc.resize(rng.integers(0, 256, (9, 6, 3)).astype(np.float32), height, width, "cubic")
        for _ in range(max(TARGETS))
    ]
    left = np.linspace(60, WIDTH - width - 60, len(things))
    top = rng.permutation(np.linspace(60, HEIGHT - height - 60, len(things)))
    start, speed = np.stack([left, top], axis=1), rng.uniform(-1, 1, (len(things), 2))
    frames = []
    for index in range(FRAMES):
        image = ground + rng.normal(0, 2, ground.shape)
        for (x, y), thing in zip(np.rint(start + index * speed).astype(int), things, strict=True):
            image[y : y + height, x : x + width] = thing
        frames.append(np.clip(image, 0, 255).astype(np.uint8))
    return frames, [tricue.Box(float(round(x)), float(round(y)), width, height) for x, y in start]


def seconds(frames: list[NDArray[np.uint8]], boxes: list[tricue.Box], workers: int) -> NDArray[np.float64]:
    """The time of each update, seconds."""
    with tricue.MultiTracker(workers=workers) as several:
        for box in boxes:
            several.add(frames[0], box)
        times = [time.perf_counter()]
        for frame in frames[1:]:
            several.update(frame)
            times.append(time.perf_counter())
    return np.diff(times)


def main() -> None:
    """Measure in turns, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--rounds", type=int, default=20)
    rounds = parser.parse_args().rounds
    frames, boxes = film()
    cases = [(targets, workers) for targets in TARGETS for workers in WORKERS]
    least = {case: np.full(FRAMES - 1, np.inf) for case in cases}
    for _ in range(rounds):
        for targets, workers in cases:
            measured = seconds(frames, boxes[:targets], workers)
            least[targets, workers] = np.minimum(least[targets, workers], measured)
    milliseconds = {case: 1e3 * float(np.median(found)) for case, found in least.items()}
    one = milliseconds[1, 1]
    print("| targets | one worker, ms | times one target | two workers, ms | times one target | gain |")
    print("| --- | --- | --- | --- | --- | --- |")
    for targets in TARGETS:
        alone, shared = milliseconds[targets, 1], milliseconds[targets, 2]
        print(
            f"| {targets} | {alone:.2f} | {alone / one:.1f} | {shared:.2f} | {shared / one:.1f} "
            f"| {alone / shared:.2f} |"
        )


if __name__ == "__main__":
    main()
