# SPDX-License-Identifier: MIT
"""Detection of a face without a cascade."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tricue.data.open_source import open_source
from tricue.scenes import room_scene
from tricue.track.head_detection import face_detection


@pytest.fixture(autouse=True)
def no_cascade(monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither cascade is installed."""
    monkeypatch.setattr(face_detection, "_load_cascade", lambda: None)
    monkeypatch.setattr(face_detection, "_has_scikit_image", lambda: False)


@pytest.mark.parametrize(("name", "index"), [("Girl", 0), ("FaceOcc2", 0)])
def test_a_real_face_is_found(data: Path, name: str, index: int) -> None:
    """It proves that in real sequences, of which one is gray, the face found lies on the true one."""
    source = open_source(data / "color" / name)
    image = next(frame for i, frame in enumerate(source) if i == index).color
    true = source.true_box(index)
    assert image is not None
    assert true is not None
    padded = np.zeros((image.shape[0], image.shape[1] + 9, 3), np.uint8)[:, 4:-5]
    padded[:] = image
    found = face_detection.find_face(image)
    assert found is not None
    assert found.iou(true) > 0.5
    assert face_detection.find_face(padded) == found


def test_no_face_is_none(rendered: Callable[..., Any]) -> None:
    """It proves that blank and tiny images, noise, and a room with a walker without a face give no box."""
    rng = np.random.default_rng(0)
    images = [np.full((60, 80, 3), 90, np.uint8), np.full((3, 3), 90, np.uint8), np.zeros((1, 400), np.uint8)]
    images += [rng.integers(0, 256, (120, 160, 3), np.uint8) for _ in range(3)]
    images += [
        frame.color for frame in rendered(room_scene, kind="walker", seed=0, channels="rgbd").frames[:3]
    ]
    assert [face_detection.find_face(image) for image in images] == [None] * len(images)
