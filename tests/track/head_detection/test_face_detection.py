# SPDX-License-Identifier: MIT
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from tricue.camera.box import Box
from tricue.data.open_source import open_source
from tricue.errors import TargetNotFoundError
from tricue.scenes import room_scene
from tricue.track.head_detection.face_detection import (
    BIAS,
    COARSE,
    TEMPLATE,
    WINDOW,
    cells,
    channels_of,
    find_face,
    match,
)


def portrait(side: int = 240) -> tuple[np.ndarray, Box]:
    """A photograph with a face, BGR, and the face's box."""
    pytest.importorskip("skimage", reason="needs scikit-image's photograph: pip install tricue[demo]")
    from tricue.scenes.rendering.photographs import ASTRONAUT_FACE, load_photograph

    scale = side / 512
    image = cv2.resize(load_photograph("astronaut"), (side, side), interpolation=cv2.INTER_AREA)
    return image, Box(*(scale * value for value in ASTRONAUT_FACE))


def pasted(sizes: list[tuple[int, int]]) -> np.ndarray:
    """Portraits beside each other, each of a side and at an x, on gray."""
    canvas = np.full((240, 480, 3), 120, np.uint8)
    for side, x in sizes:
        canvas[:side, x : x + side] = portrait(side)[0]
    return canvas


@pytest.mark.parametrize("name", ["David", "Girl", "Jumping", "FaceOcc2"])
def test_a_real_face_is_found(data: Path, name: str) -> None:
    """In the first frame of real sequences, of which two are gray, the face found lies on the true one."""
    source = open_source(data / "color" / name)
    image = next(iter(source)).color
    true = source.true_box(0)
    assert image is not None
    assert true is not None
    found = find_face(image)
    assert found is not None
    assert found.iou(true) > 0.5


@pytest.mark.parametrize("name", ["Cyclist", "HandBook", "MotorRolling"])
def test_no_face_in_a_real_scene(data: Path, name: str) -> None:
    """Doors and towers that resemble faces the most in recorded sequences aren't taken for one."""
    image = next(iter(open_source(data / "color" / name))).color
    assert image is not None
    assert find_face(image) is None


def test_a_face_in_color_and_in_gray() -> None:
    """A photograph's face is found in either, as (H, W, 3) and (H, W)."""
    image, true = portrait()
    gray = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    for each in (image, gray, cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)):
        found = find_face(each)
        assert found is not None
        assert found.iou(true) > 0.5


@pytest.mark.parametrize("side", [150, 200, 300, 512])
def test_a_face_of_any_size(side: int) -> None:
    """The face of a photograph is found in reduced copies and in the whole one."""
    image, true = portrait(side)
    found = find_face(image)
    assert found is not None
    assert found.iou(true) > 0.5


@pytest.mark.parametrize("side", [150, 200, 240, 300])
def test_a_shaken_face(side: int) -> None:
    """In gray, a face is found that moves down by a sixth of its width during the exposure."""
    image, true = portrait(side)
    way = round(true.width / 6)
    found = find_face(cv2.cvtColor(cv2.blur(image, (1, way)), cv2.COLOR_BGR2GRAY))
    assert found is not None
    assert found.iou(true) > 0.5


def test_the_largest_face_is_taken() -> None:
    """Of two faces the larger one is found, on whichever side it is."""
    true = portrait(240)[1]
    left, right = find_face(pasted([(240, 0), (160, 300)])), find_face(pasted([(160, 0), (240, 200)]))
    assert left is not None
    assert right is not None
    assert left.iou(true) > 0.5
    assert right.iou(true._replace(x=true.x + 200)) > 0.5


def test_no_face_is_none(rendered: Callable[..., Any]) -> None:
    """Blank and tiny images, noise, and a room with a walker without a face give no box."""
    rng = np.random.default_rng(0)
    images = [np.full((60, 80, 3), 90, np.uint8), np.full((3, 3), 90, np.uint8), np.zeros((1, 400), np.uint8)]
    images += [rng.integers(0, 256, (120, 160, 3), np.uint8) for _ in range(3)]
    scene = rendered(room_scene, kind="walker", seed=0, channels="rgbd")
    images += [frame.color for frame in scene.frames[:3]]
    assert [find_face(image) for image in images] == [None] * len(images)


def test_a_face_of_another_color_is_none() -> None:
    """What has a face's pattern in blue instead of red is no face."""
    image, _ = portrait()
    assert find_face(image) is not None
    assert find_face(np.ascontiguousarray(image[..., ::-1])) is None


@pytest.mark.parametrize("size", [(28, 28), (29, 43), (46, 31)])
def test_the_match_is_the_weighted_sum_of_a_windows_cells(size: tuple[int, int]) -> None:
    """In every window of images whose sides are whole cells or not, also in the last one."""
    channels = channels_of(np.random.default_rng(0).integers(0, 256, (*size, 3), np.uint8))
    matches = match(channels)
    rows, columns = (each - WINDOW + 1 for each in size)
    assert matches.shape == (rows, columns)
    y, x = (each[..., np.newaxis, np.newaxis] for each in np.indices((rows, columns)))
    row, column = COARSE * np.indices((WINDOW // COARSE,) * 2)
    expected = np.full((rows, columns), BIAS)
    for channel, weights in enumerate(TEMPLATE):
        means = cells(channels.planes[channel], COARSE)[y + row, x + column]
        expected += (channels.relative(channel, means, y, x) * weights).sum(axis=(2, 3))
    np.testing.assert_allclose(matches, expected, atol=1e-3)


def test_strides_do_not_matter(data: Path) -> None:
    """A face in a crop of a larger array has the same box as in a copy of it, in color and in gray."""
    image = next(iter(open_source(data / "color" / "Girl"))).color
    assert image is not None
    padded = np.zeros((image.shape[0], image.shape[1] + 9, 3), np.uint8)[:, 4:-5]
    padded[:] = image
    found = find_face(image)
    assert found is not None
    assert find_face(padded) == found
    assert find_face(padded[..., 1]) == find_face(np.ascontiguousarray(image[..., 1]))


def test_threads_get_the_faces_of_their_own_images() -> None:
    """Two trackers may start at the same time."""
    images = [pasted([(side, x)]) for side, x in ((240, 0), (240, 200), (160, 0), (160, 300))]
    alone = [find_face(image) for image in images]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(find_face, images)) == alone
    assert len(set(alone)) == len(images)


def test_a_tracker_starts_on_a_face() -> None:
    """The color particle tracker without a box starts on the face that find_face finds."""
    image, _ = portrait()
    found = find_face(image)
    assert found is not None
    given, detected = (tricue.ColorParticleTracker(seed=3) for _ in range(2))
    assert detected.init(image) == given.init(image, found)
    assert detected.update(image) == given.update(image)


def test_a_tracker_without_a_face_needs_a_box() -> None:
    """A frame without a face is an error that callers tell apart, and leaves the tracker."""
    tracker = tricue.ColorParticleTracker()
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*, as no face was found in this frame"):
        tracker.init(np.full((60, 80, 3), 90, np.uint8))
    with pytest.raises(RuntimeError, match="expected init first"):
        tracker.update(np.full((60, 80, 3), 90, np.uint8))
