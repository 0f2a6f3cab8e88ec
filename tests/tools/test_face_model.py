# SPDX-License-Identifier: MIT
"""The tool that learns faces from renders."""

import numpy as np
import pytest
from tricue.track.head_detection.face_detection import channels_of

from tools.face_model import camera, learn
from tools.face_model.__main__ import FILE, installed, rendered, shares, table
from tools.face_model.buildings import building


def test_a_small_model_is_the_same_again_and_knows_faces(monkeypatch: pytest.MonkeyPatch) -> None:
    """One seed gives one table, and faces are told from scenes."""
    for name, value in {"VOTES": 20, "FIRST_VOTES": 6, "RATE": 1.0, "SAMPLE": 600}.items():
        monkeypatch.setattr(learn, name, value)
    models = [learn.learn(*rendered(0, 60, 15), np.random.default_rng(0)) for _ in range(2)]
    assert table(models[0]) == table(models[1])
    found, false = shares(models[0], *rendered(1, 40, 10))
    assert found > 0.4
    assert false < 0.2


def test_a_moved_camera_takes_no_light_and_shifts_nothing() -> None:
    """Paths of all directions and lengths have a sum of 1 and their mean in the middle."""
    rng = np.random.default_rng(0)
    for _ in range(100):
        path = camera._path(rng)
        assert path.min() >= 0
        assert path.sum() == pytest.approx(1)
        middle = (np.indices(path.shape) * path).sum(axis=(1, 2))
        np.testing.assert_allclose(middle, (len(path) - 1) / 2)


def test_buildings_are_the_same_again_and_have_edges() -> None:
    """Walls, towers and wheels are drawn on all images, with albedos above 0."""
    both = [[building(np.random.default_rng(seed), 60) for seed in range(20)] for _ in range(2)]
    np.testing.assert_array_equal(*both)
    assert np.min(both) > 0
    assert all(np.ptp(image, axis=(0, 1)).min() > 0.01 for image in both[0])


def test_features_of_a_mirrored_face_are_the_mirrored_features() -> None:
    """The symmetric model relies on it."""
    (image,), _ = rendered(0, 1, 0)
    both = image, np.ascontiguousarray(image[:, ::-1])
    here, there = (learn.features(channels_of(each), [6], [6]) for each in both)
    np.testing.assert_allclose(here[:, learn.MIRROR], there, atol=0.01)


def test_the_installed_table_is_as_it_was_written() -> None:
    """Nobody edited the learned numbers."""
    assert table(installed()) == FILE.read_text(encoding="utf-8")
