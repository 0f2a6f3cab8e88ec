# SPDX-License-Identifier: MIT
import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue.scenes.rooms import looks


def test_tiles_repeat_themselves():
    """A tiling is like itself two pitches on, and unlike itself on the way there."""
    for seed in range(5):
        picture = looks.tiles(200, 300, np.random.default_rng(seed))[..., 1]
        rows = picture - picture.mean()
        likeness = [(rows[:, lag:] * rows[:, :-lag]).mean() / rows.var() for lag in range(4, 60)]
        assert max(likeness) > 0.9
        assert min(likeness) < 0.5


def test_furniture_is_often_without_texture_or_tiled():
    """Of walls, floors and tables about two of five have nearly one color, and one of five is a pattern."""
    flat = 0
    for seed in range(60):
        picture = looks.furniture_cover(48, 64, np.random.default_rng(seed))
        flat += (picture.std(axis=(0, 1)) < 0.02 * picture.mean(axis=(0, 1)) + 0.5).all()
    assert 14 <= flat <= 34  # 24 expected, deviation 4


def test_prints_have_their_aspect():
    """A package's print has the sides that the face has, to a texel, with the longer one as told."""
    for aspect in (0.4, 1.0, 2.5):
        picture = looks.print_picture(aspect, np.random.default_rng(1))
        rows, columns = picture.shape[:2]
        assert max(rows, columns) == looks.PRINT_TEXELS
        assert columns == pytest.approx(aspect * rows, abs=max(1.0, aspect))
