# SPDX-License-Identifier: MIT
"""Compares the speed of trackers at two commits, on one machine, in turns.

python -m benchmarks.paired eed0460 HEAD [--rounds 8]

Both commits are built into build/paired, once each, and see the same frames, rendered by the installed
tricue. Processes of both take turns; each tracks a scene three times. The time of an update is its minimum
over all processes, because other work only adds time. A case's time is the median over its updates.
"""

import argparse
import json
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "build" / "paired"
WORKER = Path(__file__).with_name("paired_worker.py")
FRAMES = 60


def cases() -> Iterator[tuple[str, str, Any, str | None]]:
    """Name, tracker, scene, and the attribute of the scene that is the tracker's camera."""
    from tricue.scenes import face_over_clutter, head, overtaking, walker
    from tricue.scenes.stress.scene import stress_scene

    yield "color-particle, 320x240", "color-particle", face_over_clutter(0, FRAMES), None
    yield "fused, color, 320x240", "fused", face_over_clutter(0, FRAMES), None
    yield "depth-particle, 176x144", "depth-particle", walker(0, FRAMES, "tof"), "intrinsics"
    yield "stereo-head, 160x120", "stereo-head", head(0, FRAMES), "rig"
    yield "stereo-head, 640x480", "stereo-head", head(0, FRAMES, "640x480"), "rig"
    yield "flow-depth, 160x120", "flow-depth", overtaking(0, FRAMES), "rig"
    yield "fused, color and depth", "fused", stress_scene("fast", 0, channels="rgbd"), "intrinsics"
    yield "fused, stereo pair", "fused", stress_scene("fast", 0, channels="stereo"), "rig"


def dump(name: str, tracker: str, scene: Any, camera: str | None) -> Path:
    """The file of a case: its frames, first box and camera as plain arrays, which every version can read."""
    frames = scene.frames[:FRAMES]
    channels = {
        channel: np.stack([getattr(frame, channel) for frame in frames])
        for channel in ("color", "depth", "right")
        if getattr(frames[0], channel) is not None
    }
    times = np.array([np.nan if frame.timestamp is None else frame.timestamp for frame in frames])
    lens: tuple[float, ...] = ()
    if camera is not None:
        held = getattr(scene, camera)
        its = held.intrinsics if camera == "rig" else held
        lens = (its.fx, its.fy, its.cx, its.cy, its.width, its.height)
        lens += (held.baseline,) if camera == "rig" else ()
    path = FOLDER / f"{name.replace(', ', '-').replace(' ', '-')}.npz"
    about = {"name": name, "tracker": tracker, "camera": lens}
    box = np.array(scene.boxes[0], float)
    np.savez(path, about=np.array(json.dumps(about)), times=times, box=box, **channels)
    return path


def build(commit: str) -> Path:
    """The folder of a commit's package, which is built if it isn't there."""
    name = subprocess.run(
        ["git", "rev-parse", "--short", commit], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout.strip()
    source, site = FOLDER / f"{name}-source", FOLDER / name
    if not (site / "tricue").is_dir():
        if not source.is_dir():
            subprocess.run(
                ["git", "worktree", "add", "--quiet", "--detach", source, name], cwd=ROOT, check=True
            )
        command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        subprocess.run([*command, "--no-deps", "--target", site, source], check=True)
        subprocess.run(["git", "worktree", "remove", "--force", source], cwd=ROOT, check=True)
    return site


def measure(site: Path, case: Path) -> NDArray[np.float64]:
    """The seconds of each update of a case, minimum of three runs, in a process with a package."""
    environment = os.environ | {"PYTHONPATH": str(site)}
    command = [sys.executable, str(WORKER), str(case)]
    done = subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE, text=True)
    return np.array(json.loads(done.stdout))


def main() -> None:
    """Build, measure in turns, and print a line per case."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--rounds", type=int, default=8)
    options = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    sites = [build(options.old), build(options.new)]
    files = {each[0]: dump(*each) for each in cases()}
    found: dict[tuple[str, Path], list[NDArray[np.float64]]] = defaultdict(list)
    for _ in range(options.rounds):
        for name, file in files.items():
            for site in sites:
                found[name, site].append(measure(site, file))
    print(f"| case | {options.old}, us | {options.new}, us | times as fast |\n| --- | --- | --- | --- |")
    for name in files:
        old, new = (1e6 * float(np.median(np.min(found[name, site], axis=0))) for site in sites)
        print(f"| {name} | {old:.0f} | {new:.0f} | {old / new:.2f} |")


if __name__ == "__main__":
    main()
