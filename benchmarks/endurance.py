# SPDX-License-Identifier: MIT
"""Memory over 100,000 updates: ``python benchmarks/endurance.py`` prints the resident size as it goes."""

from pathlib import Path

import tricue
from tricue.scenes import face_over_clutter

UPDATES, EVERY = 100_000, 10_000


def resident() -> float:
    """Megabytes."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def main() -> None:
    """Follow the scene to its end and back, again and again."""
    scene = face_over_clutter(seed=0)
    frames = [*scene.frames, *scene.frames[-2:0:-1]]
    tracker = tricue.ColorParticleTracker(seed=0)
    tracker.init(scene.frames[0], scene.boxes[0])
    for i in range(1, UPDATES + 1):
        track = tracker.update(frames[i % len(frames)])
        if i % EVERY == 0:
            print(f"{i:7,} updates: {resident():.1f} MB, {track.status}")


if __name__ == "__main__":
    main()
