# SPDX-License-Identifier: MIT
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from tricue.camera.box import Box
from tricue.data.open_source import open_source
from tricue.errors import TargetNotFoundError
from tricue.track.head_detection import face_detection

DETECTORS = ["cv2", "scikit-image"]


@pytest.fixture(params=DETECTORS)
def detector(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Detection by either cascade alone."""
    if request.param == "cv2":
        if face_detection._load_cascade() is None:
            pytest.skip("this cv2 has no cascades")
    else:
        pytest.importorskip("skimage", reason="needs scikit-image: pip install tricue[face]")
        monkeypatch.setattr(face_detection, "_load_cascade", lambda: None)
    return request.param


def portrait(side: int = 240) -> tuple[np.ndarray, Box]:
    """A photograph with a face, BGR, and the face's box."""
    pytest.importorskip("skimage", reason="needs scikit-image: pip install tricue[face]")
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


@pytest.mark.parametrize(("name", "index"), [("David", 40), ("Girl", 0), ("Jumping", 0)])
def test_a_real_face_is_found(data: Path, detector: str, name: str, index: int) -> None:
    """It proves that in real sequences, of which one is gray, the face found lies on the true one."""
    source = open_source(data / "color" / name)
    image = next(frame for i, frame in enumerate(source) if i == index).color
    true = source.true_box(index)
    assert image is not None
    assert true is not None
    found = face_detection.find_face(image)
    assert found is not None
    assert found.iou(true) > 0.5


def test_a_face_in_color_and_in_gray(detector: str) -> None:
    """It proves that a photograph's face is found in either, as (H, W, 3) and (H, W)."""
    image, true = portrait()
    gray = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    for each in (image, gray, cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)):
        found = face_detection.find_face(each)
        assert found is not None
        assert found.iou(true) > 0.5


def test_the_largest_face_is_taken(detector: str) -> None:
    """It proves that of two faces the larger one is found, on whichever side it is."""
    left = face_detection.find_face(pasted([(240, 0), (160, 300)]))
    right = face_detection.find_face(pasted([(160, 0), (240, 200)]))
    assert left is not None
    assert right is not None
    assert left.iou(portrait(240)[1]) > 0.5
    true = portrait(240)[1]
    assert right.iou(true._replace(x=true.x + 200)) > 0.5


def test_no_face_is_none(detector: str) -> None:
    """It proves that a picture without a face, even a tiny one, and noise give no box."""
    assert face_detection.find_face(np.full((60, 80, 3), 90, np.uint8)) is None
    assert face_detection.find_face(np.full((3, 3), 90, np.uint8)) is None
    assert face_detection.find_face(np.full((1, 400), 90, np.uint8)) is None
    rng = np.random.default_rng(0)
    assert face_detection.find_face(rng.integers(0, 256, (120, 160, 3), np.uint8)) is None


def test_a_face_of_another_color_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that what has a face's patterns in blue instead of red is no face to scikit-image."""
    image, _ = portrait()
    monkeypatch.setattr(face_detection, "_load_cascade", lambda: None)
    assert face_detection.find_face(image) is not None
    assert face_detection.find_face(np.ascontiguousarray(image[..., ::-1])) is None


def test_both_cascades_draw_the_same_box(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the box of a face doesn't depend much on which cascade finds it."""
    if face_detection._load_cascade() is None:
        pytest.skip("this cv2 has no cascades")
    image, _ = portrait()
    first = face_detection.find_face(image)
    monkeypatch.setattr(face_detection, "_load_cascade", lambda: None)
    second = face_detection.find_face(image)
    assert first is not None
    assert second is not None
    assert first.iou(second) > 0.7


class Cascade:
    """A cascade like cv2's: it keeps the image that it looks at, and lets other threads run meanwhile."""

    def detectMultiScale(self, gray: np.ndarray, **_: object) -> list[tuple[int, ...]]:  # noqa: N802
        self.image = gray
        time.sleep(0.01)
        return [(0, 0, *self.image.shape)]


def test_threads_get_the_faces_of_their_own_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """The cascade is loaded once, and two trackers may start at the same time."""
    cascade = Cascade()
    monkeypatch.setattr(face_detection, "_load_cascade", lambda: cascade)
    images = [np.zeros((side, side), np.uint8) for side in (100, 200, 300, 400)]
    alone = [face_detection.find_face(image) for image in images]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(face_detection.find_face, images)) == alone


def test_a_tracker_starts_on_a_face(detector: str) -> None:
    """It proves that the color particle tracker without a box starts on the face that find_face finds."""
    image, _ = portrait()
    found = face_detection.find_face(image)
    assert found is not None
    given, detected = (tricue.ColorParticleTracker(seed=3) for _ in range(2))
    assert detected.init(image) == given.init(image, found)
    assert detected.update(image) == given.update(image)


def test_a_tracker_without_a_face_needs_a_box(detector: str) -> None:
    """It proves that a frame without a face is an error that callers tell apart, and leaves the tracker."""
    tracker = tricue.ColorParticleTracker()
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*, as no face was found in this frame"):
        tracker.init(np.full((60, 80, 3), 90, np.uint8))
    with pytest.raises(RuntimeError, match="expected init first"):
        tracker.update(np.full((60, 80, 3), 90, np.uint8))


@pytest.mark.parametrize("lacking", ["class", "file"])
def test_a_cv2_without_cascades_is_noticed(lacking: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a cv2 that lacks the class or the file, as 5.x, has no cascade."""
    if lacking == "class":
        monkeypatch.delattr(cv2, "CascadeClassifier", raising=False)
    else:
        monkeypatch.setattr(Path, "is_file", lambda _: False)
    assert face_detection._load_cascade.__wrapped__() is None


@pytest.mark.parametrize("there", [True, False])
def test_scikit_image_is_noticed(there: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an installed scikit-image is noticed without importing it, and a missing one, too."""
    if there:
        pytest.importorskip("skimage")
    else:
        monkeypatch.setitem(sys.modules, "skimage", None)
    assert face_detection._has_scikit_image.__wrapped__() is there
