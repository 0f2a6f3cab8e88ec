# SPDX-License-Identifier: MIT
"""Checks that scenes and tracks are the same with every version of cv2.

    python tools/compare_opencv.py [VERSION ...]

makes an environment for each version of opencv-python-headless in build/opencv (by default the oldest that
works with NumPy 2, the newest 4.x and the newest 5.x). In each, it renders all kinds of scenes with the
tricue that is installed here, follows a target in each scene with all trackers that can, and fails if pixels
or tracks differ. NumPy is the same in all, because its transforms and exponentials differ in the last bit
between major versions. This takes a minute once the environments exist.
"""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import tricue
from tricue.track.base import registry

ROOT = Path(__file__).parents[1]
ENVIRONMENTS = ROOT / "build" / "opencv"
VERSIONS = ("==4.10.0.84", "==4.*", "==5.*")
FRAMES = 10

Make = Callable[[], Any]


def scenes() -> Iterator[tuple[str, Make]]:
    """Every kind of scene: its name, and the function that makes it."""
    from tricue import scenes

    yield "light change", partial(scenes.light_change, 0, FRAMES)
    yield "face over clutter", partial(scenes.face_over_clutter, 0, FRAMES)
    for kind in scenes.HEAD_KINDS:
        yield f"head, {kind}", partial(scenes.head, 0, FRAMES, kind=kind)
    for kind in scenes.OVERTAKING_KINDS:
        yield f"overtaking, {kind}", partial(scenes.overtaking, 0, FRAMES, kind=kind)
    yield "overtaking, depth", partial(scenes.overtaking, 0, FRAMES, depth=True)
    for camera in ("tof", "rgbd"):
        yield f"walker, {camera}", partial(scenes.walker, 0, FRAMES, camera)
        yield f"crossing, {camera}", partial(scenes.crossing, 0, FRAMES, camera)
    for channels in scenes.STRESS_CHANNELS:
        yield f"stress, {channels}", partial(scenes.stress_scene, "fast", 1, channels=channels)
    for kind in scenes.ROOM_KINDS:
        for channels in ("rgbd", "stereo"):
            made = partial(scenes.room_scene, kind, channels=channels, frames=FRAMES)
            yield f"room, {kind}, {channels}", made


def digest(arrays: Iterator[Any]) -> str:
    """The hash of arrays; None is skipped."""
    found = hashlib.sha256()
    for array in arrays:
        if array is not None:
            found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()[:16]


def tracks(scene: Any) -> Iterator[tuple[str, list[Any]]]:
    """Box, score and position in each frame, by each tracker that can follow the scene's target."""
    for name in registry.names():
        tracker = tricue.create(name)
        try:
            found = [tracker.init(scene.frames[0], scene.boxes[0])]
        except (TypeError, ValueError):  # it needs channels that the scene lacks
            continue
        found += [tracker.update(frame) for frame in scene.frames[1:]]
        yield (
            name,
            [
                part
                for track in found
                for part in (np.array(track.box), np.array(track.score), track.position)
            ],
        )


def measure() -> dict[str, str]:
    """The hashes of each scene's pixels, and of each track in the scene."""
    hashes = {}
    for name, make in scenes():
        scene = make()
        channels = (part for frame in scene.frames for part in (frame.color, frame.depth, frame.right))
        hashes[name] = digest(channels)
        for tracker, track in tracks(scene):
            hashes[f"{name}: {tracker}"] = digest(iter(track))
    return hashes


def environment(version: str) -> Path:
    """The Python of an environment with a version of cv2; the environment is made if it doesn't exist."""
    folder = ENVIRONMENTS / version.strip("=")
    python = folder / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(folder)], check=True)
        packages = [
            f"opencv-python-headless{version}",
            f"numpy=={np.__version__}",
            "scikit-image",
            "pooch",
            "matplotlib",
        ]
        command = [str(python), "-m", "pip", "--disable-pip-version-check", "install", "--quiet", *packages]
        subprocess.run(command, check=True)
    return python


def copy_package() -> Path:
    """A folder with this tricue alone: the installed one is in the same folder as this environment's cv2."""
    folder = ENVIRONMENTS / "package"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(Path(tricue.__file__).parent, folder / "tricue")
    return folder


def measured_in(python: Path, package: Path) -> dict[str, str]:
    """The hashes that another Python measures with a copy of the package."""
    paths = os.pathsep.join(map(str, (package, Path(__file__).parent)))
    command = [
        str(python),
        "-W",
        "ignore",
        "-c",
        "import compare_opencv, json; print(json.dumps(compare_opencv.measure()))",
    ]
    found = subprocess.run(
        command, check=True, stdout=subprocess.PIPE, text=True, env=os.environ | {"PYTHONPATH": paths}
    )
    return dict(json.loads(found.stdout))


def main() -> int:
    """Measure in each environment, print what differs, and fail if anything does."""
    versions = sys.argv[1:] or VERSIONS
    package = copy_package()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        measured = pool.map(lambda version: measured_in(environment(version), package), versions)
        found = dict(zip(versions, measured, strict=True))
    first, *others = found.items()
    different = [
        f"{name}: {version} differs from {first[0]}"
        for version, hashes in others
        for name, value in hashes.items()
        if value != first[1][name]
    ]
    print(
        "\n".join(different) or f"cv2 {', '.join(versions)}: {len(first[1])} scenes and tracks, all the same"
    )
    return int(bool(different))


if __name__ == "__main__":
    sys.exit(main())
