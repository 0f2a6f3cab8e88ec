# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.open_source import open_source
from tricue.track.base import face_detection

has_cascade = hasattr(cv2, "CascadeClassifier") and any(
    Path(cv2.data.haarcascades).glob("*frontalface_default*")
)


@pytest.mark.skipif(not has_cascade, reason="this cv2 has no cascades")
def test_a_real_face_is_found(data: Path) -> None:
    """It proves that in a real sequence the face found lies on the true one."""
    source = open_source(data / "color" / "FaceOcc2")
    image = next(iter(source)).color
    assert image is not None
    found = face_detection.find_face(image)
    assert found is not None
    assert source.first_box is not None
    assert found.iou(source.first_box) > 0.5


@pytest.mark.skipif(not has_cascade, reason="this cv2 has no cascades")
def test_no_face_is_none() -> None:
    """It proves that a picture without a face, even a tiny one, gives no box."""
    assert face_detection.find_face(np.full((60, 80, 3), 90, np.uint8)) is None
    assert face_detection.find_face(np.full((3, 3), 90, np.uint8)) is None


@pytest.mark.parametrize("lacking", ["class", "file"])
def test_a_cv2_without_cascades_is_explained(lacking: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that with cv2 5.x, which lacks the class or the file, the error says what to do instead."""
    if lacking == "class":
        monkeypatch.delattr(cv2, "CascadeClassifier", raising=False)
    else:
        monkeypatch.setattr(Path, "is_file", lambda _: False)
    face_detection._load_cascade.cache_clear()
    with pytest.raises(
        ImportError,
        match=r"^box: can't detect faces, because cv2 \S+ has no cascade; give a box \(--box ",
    ):
        face_detection.find_face(np.zeros((60, 80, 3), np.uint8))
