# SPDX-License-Identifier: MIT
"""Resident memory during 100,000 updates: ``python benchmarks/endurance.py`` prints it every 10,000."""

from pathlib import Path

import tricue
from tricue.scenes import face_over_clutter

UPDATES, PRINT_INTERVAL = 100_000, 10_000


def resident_megabytes() -> float:
    """Of this process."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def main() -> None:
    """Track through a scene, forward and backward, in a loop."""
    scene = face_over_clutter(seed=0)
    frames = [*scene.frames, *scene.frames[-2:0:-1]]
    tracker = tricue.ColorParticleTracker(seed=0)
    tracker.init(scene.frames[0], scene.boxes[0])
    for i in range(1, UPDATES + 1):
        track = tracker.update(frames[i % len(frames)])
        if i % PRINT_INTERVAL == 0:
            print(f"{i:7,} updates: {resident_megabytes():.1f} MB, {track.status}")


if __name__ == "__main__":
    main()
