# SPDX-License-Identifier: MIT
"""The baselines of face detection."""

import sys

import cv2
import numpy as np
import pytest

from benchmarks.quality import face_detection
from benchmarks.quality.common import face_cascades

BASELINES = ["cv2", "scikit-image"]


@pytest.fixture(params=BASELINES)
def find(request):
    """The detector of a baseline that is installed."""
    if reason := face_cascades.missing(request.param):
        pytest.skip(reason)
    return face_detection.DETECTORS[request.param]


def test_a_baseline_finds_a_face(find):
    """A photograph's face is found in color and in gray, and none in noise."""
    pytest.importorskip("skimage", reason="needs scikit-image's photograph: pip install tricue[demo]")
    from tricue.camera.box import Box
    from tricue.scenes.rendering.photographs import ASTRONAUT_FACE, load_photograph

    image = cv2.resize(load_photograph("astronaut"), (240, 240), interpolation=cv2.INTER_AREA)
    true = Box(*(240 / 512 * value for value in ASTRONAUT_FACE))
    for each in (image, cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)):
        assert find(each).iou(true) > 0.5
    noise = np.random.default_rng(0).integers(0, 256, (120, 160, 3), np.uint8)
    assert [find(each) for each in (noise, noise[:3, :3], noise[:1, :, 0])] == [None] * 3


@pytest.mark.parametrize("baseline", BASELINES)
def test_a_missing_baseline_is_an_error_in_a_line(baseline, monkeypatch, capsys):
    """Without the package, or with one that lacks the cascade, the error says what to install."""
    monkeypatch.setattr(face_cascades, "_haar_cascade", lambda: None)
    monkeypatch.setattr(face_cascades, "find_spec", lambda _: None)
    monkeypatch.setattr(sys, "argv", ["face_detection", "--detector", baseline])
    with pytest.raises(SystemExit):
        face_detection.main()
    error = capsys.readouterr().err.splitlines()[-1]
    assert f"--detector {baseline}: " in error
    assert "pip install" in error


@pytest.mark.parametrize("lacking", ["class", "folder", "file"])
def test_a_cv2_without_a_cascade_is_noticed(lacking, monkeypatch, tmp_path):
    """That cv2 5 lacks the class, and a stripped one its file, is told instead of an error of cv2."""
    file = tmp_path / "haarcascade_frontalface_default.xml"
    file.touch()
    folder = type("data", (), {"haarcascades": str(tmp_path)})
    monkeypatch.setattr(cv2, "data", folder, raising=False)
    monkeypatch.setattr(cv2, "CascadeClassifier", str, raising=False)
    load = face_cascades._haar_cascade.__wrapped__
    assert load() == str(file)
    if lacking == "class":
        monkeypatch.delattr(cv2, "CascadeClassifier")
    elif lacking == "folder":
        monkeypatch.delattr(cv2, "data")
    else:
        file.unlink()
    assert load() is None
