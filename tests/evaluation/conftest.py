# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.camera.frame import Frame


@pytest.fixture(scope="session")
def patrol():
    """A textured red square of 40 px that moves 2 px a frame over dim noise: 20 frames, true boxes."""
    rng = np.random.default_rng(1)
    ground = rng.integers(20, 60, (120, 160, 3), dtype=np.uint8)
    square = cv2.resize(rng.integers(90, 255, (6, 6, 3), dtype=np.uint8), (40, 40)) // [4, 4, 1]
    frames, boxes = [], []
    for index in range(20):
        image = ground.copy()
        x, y = 30 + 2 * index, 40
        image[y : y + 40, x : x + 40] = square
        frames.append(Frame(color=image))
        boxes.append(Box(float(x), float(y), 40.0, 40.0))
    return tuple(frames), tuple(boxes)


@pytest.fixture(scope="session")
def folders(patrol, tmp_path_factory):
    """A data set of three OTB sequences: the patrol, the patrol backward, its begin with a black gap."""
    root = tmp_path_factory.mktemp("sequences")
    frames, boxes = patrol
    dark = [Frame(color=np.zeros_like(frame.color)) for frame in frames]
    write_otb(root / "there", frames, boxes)
    write_otb(root / "back", frames[::-1], boxes[::-1])
    write_otb(root / "gap", (*frames[:6], *dark[6:10], *frames[10:14]), boxes[:14])
    return root


def write_otb(folder, frames, boxes):
    """A sequence as OTB lays it out: pixels counted from 1."""
    (folder / "img").mkdir(parents=True)
    for index, frame in enumerate(frames, 1):
        cv2.imwrite(str(folder / "img" / f"{index:04d}.png"), frame.color)
    lines = [f"{box.x + 1:g},{box.y + 1:g},{box.width:g},{box.height:g}\n" for box in boxes]
    (folder / "groundtruth_rect.txt").write_text("".join(lines))
