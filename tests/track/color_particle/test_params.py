# SPDX-License-Identifier: MIT
"""The parameters of the color particle tracker: that they come back from a file, and extremes."""

import math
from pathlib import Path

import numpy as np
import pytest
from tricue import ColorParticleTracker, FusedTracker
from tricue.track.color_particle.appearance import probability

Params = ColorParticleTracker.Params


@pytest.mark.parametrize(("name", "pair"), [("ring", (1.8, 1.3)), ("size_range", (4.0, 0.3))])
def test_pairs_out_of_order_are_named(name, pair):
    """An outer radius under the inner, or a largest size under the smallest, is refused by name."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        ColorParticleTracker(**{name: pair})


@pytest.mark.parametrize(
    "params",
    [Params(), Params.paper(), Params(particles=7, sharpness=12.5, grid=(5, 9), observation="lookup")],
)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, the None of sharpness too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


def test_the_first_frame_is_remembered_at_any_learning_rate(scene):
    """With ``learning_rate=1`` the learned ranks are those of the last frame, and the first frame's stay."""
    tracker = ColorParticleTracker(learning_rate=1.0)
    tracker.init(scene.frames[0], scene.boxes[0])
    _, first = tracker._state.appearance.model.maps
    for frame in scene.frames[1:5]:
        tracker.update(frame)
    learned, remembered = tracker._state.appearance.model.maps
    np.testing.assert_array_equal(remembered, first)
    assert not np.array_equal(learned, first)


@pytest.mark.parametrize(
    "extreme",
    [
        {"particles": 2},
        {"grid": (2, 2)},
        {"grid": (64, 64)},
        {"grid_reach": 4, "ring": (1, 8)},
        {"max_step": 0, "max_step_sizes": 0},
        {"position_noise": 0, "velocity_noise": 0, "size_noise": 0, "aspect_noise": 0},
        {"size_range": (1e-9, 1e6), "size_noise": 2.0},
        {"size_range": (1e6, 1e6)},
        {"skin_share": 0.99, "skin_threshold": -1},
        {"sharpness": 1e9, "color_weight": 1e9},
        {"sharpness": 1e-9, "color_weight": 0, "likelihood": "linear"},
        {"likelihood_drop": 0, "wide_search_spread": 50.0},
        {"max_likelihood_drop": 0},
        {"learning_rate": 1, "color_rate": 1, "first_frame_weight": 1, "min_score_to_learn": 0},
        {"min_score": 1, "lost_after": 0.0, "min_score_to_redetect": 0},
        {"resample_below": 0, "size_pull": 1, "size_rate": 1, "velocity_rate": 1},
        {"resample_below": 1, "velocity_rate": 0},
    ],
    ids=str,
)
def test_extremes_give_finite_tracks(extreme, run):
    """Whatever the ranges allow gives finite boxes with an area and scores in [0, 1], over 36 frames."""
    for track in run(**extreme):
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1


@pytest.mark.parametrize("tracker", [ColorParticleTracker, FusedTracker])
def test_frames_until_lost_are_deprecated(tracker):
    """A whole number is taken for frames, as in version 0.1.0, with a warning that tells the seconds."""
    with pytest.warns(DeprecationWarning, match=r"^lost_after: .*give seconds: 0.3 instead of 9"):
        assert tracker(lost_after=9).params.lost_after == pytest.approx(0.3)


@pytest.mark.parametrize(("log_likelihood", "score"), [(-1e9, 0.0), (1e9, 1.0), (-math.inf, 0.0)])
def test_what_is_hardly_likely_has_a_probability(log_likelihood, score):
    """A sharp likelihood gives log-likelihoods whose exponential is no number."""
    assert probability(log_likelihood, lead=0.0) == pytest.approx(score, abs=1e-12)
