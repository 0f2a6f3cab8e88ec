# SPDX-License-Identifier: MIT
"""A result on a stress scene, made by hand, and a small recording with color and depth."""

import cv2
import numpy as np
import pytest

from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.scene_runs import SceneResult

NAN = float("nan")
FRAMES, LEFT, STEP = 10, 20, 2
DEPTH = "fx = 60.0\nfy = 60.0\ncx = 39.5\ncy = 29.5\n"
COLOR = "fx = 90.0\nfy = 90.0\ncx = 39.5\ncy = 29.5\n"


@pytest.fixture
def scene_result():
    """Makes results of a scene of three frames, the last without the target."""
    return make_result


def make_result(kind="plain", overlaps=(1.0, 0.6, 0.0), counted=(True, True, False), errors=(0.0, 0.2, NAN)):
    """Three frames, the last without the target."""
    gone = np.array([False, False, True])
    seconds = np.array([NAN, 1e-3, 1e-3])
    frames = FrameResults(
        np.array(overlaps), gone, np.array([1.0, 0.9, 0.2]), ~gone, seconds, *[np.full(3, NAN)] * 2
    )
    return SceneResult("x", kind, 0, "color", frames, np.array(errors), np.array(counted), NAN, 1.0, NAN)


@pytest.fixture
def walk(tmp_path):
    """A red person of 12x40 px in depth pixels, 2 m away, who goes 2 px right a frame before a wall at 4 m;
    the color camera has a longer lens.
    """
    folder = tmp_path / "data" / "walk"
    for name in ("color", "depth"):
        (folder / name).mkdir(parents=True)
    truth = []
    for index in range(FRAMES):
        left = LEFT + STEP * index
        depth, color = np.full((60, 80), 4000, np.uint16), np.full((60, 80, 3), 90, np.uint8)
        depth[10:50, left : left + 12] = 2000
        ends = [round((column - 39.5) * 1.5 + 39.5) for column in (left, left + 12)]
        color[:, max(ends[0], 0) : max(ends[1], 0)] = (30, 30, 220)
        cv2.imwrite(str(folder / "depth" / f"{index + 1:08}.png"), depth)
        cv2.imwrite(str(folder / "color" / f"{index + 1:08}.png"), color)
        truth.append(f"{left},10,12,40\n")
    (folder / "groundtruth.txt").write_text("".join(truth))
    (folder / "position_z_mm.txt").write_text("2000\n" * FRAMES)
    channels = "".join(f"channels.{name}={name}/%08d.png\n" for name in ("color", "depth"))
    (folder / "sequence").write_text(f"name=walk\nfps=4\nlength={FRAMES}\n{channels}")
    (folder.parent / "intrinsics.toml").write_text(f"[depth]\n{DEPTH}[color]\n{COLOR}")
    return folder.parent
