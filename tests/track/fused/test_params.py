# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker: that they come back from a file, and extremes."""

import inspect
import itertools
import typing
from collections import Counter
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from tricue import Frame, FusedTracker, Status, Track
from tricue.track.fused.experts import Cue
from tricue.track.fused.params import FusedParams

CUES = typing.get_args(Cue)


@pytest.mark.parametrize("count", range(1, len(CUES) + 1))
def test_cues_need_one_that_finds(count):
    """Every choice with filter or color is taken, every other one is refused."""
    for cues in itertools.combinations(CUES, count):
        if {"filter", "color"} & set(cues):
            assert FusedParams(cues=cues).cues == cues
        else:
            with pytest.raises(ValueError, match=r"^cues: expected filter or color"):
                FusedParams(cues=cues)


def test_each_parameter_has_one_home():
    """What two experts read is declared by one, so that nobody else overrides its default."""
    declared = Counter(name for cls in FusedParams.__mro__ for name in inspect.get_annotations(cls))
    assert declared == Counter(f.name for f in fields(FusedParams))


def test_parameters_come_back_from_a_file(tmp_path):
    """Written to TOML and read again they are the same, all changed at once."""
    changed = FusedParams(
        cues=("color", "size"),
        context=2.5,
        candidates=7,
        size_range=(0.5, 2.0),
        lost_after=0.3,
        ridge=1.23e-7,
    )
    for params in (FusedParams(), changed):
        params.to_toml(tmp_path / "fused.toml")
        assert FusedParams.from_toml(tmp_path / "fused.toml") == params
    assert changed != FusedParams()


EXTREMES: list[dict[str, Any]] = [
    {"context": 1.5},
    {"context": 8.0},
    {"label_width": 1e-9},
    {"label_width": 1.0},
    {"ridge": 1e-12},
    {"ridge": 1e12},
    {"size_learning_rate": 0.0, "color_learning_rate": 0.0},
    {"size_learning_rate": 0.5, "color_learning_rate": 0.5},
    {"size_learning_rate": 0.5, "color_learning_rate": 0.5, "learn_every": 0.0},
    {"size_learning_rate": 0.5, "color_learning_rate": 0.5, "learn_every": 0.07, "min_score": 0.0},
    {"size_learning_rate": 0.0, "color_learning_rate": 0.0, "learn_every": 1.0},
    {"filter_weight": 0.0, "color_weight": 0.0},
    {"filter_mask_size": 1.0000001},
    {"filter_mask_size": 99.0},
    {"temporal_weight": 0.0},
    {"temporal_weight": 1e9},
    {"filter_penalty": 1e-9},
    {"filter_penalty": 1e9},
    {"surround_size": 1.0000001},
    {"surround_size": 1e6},
    {"surround_weight": 1e6},
    {"size_change_penalty": 0.0},
    {"size_change_penalty": 1e9},
    {"size_range": (1.0, 1.0)},
    {"size_range": (1e-6, 1e6)},
    {"depth_learning_rate": 1.0},
    {"outline_time_constant": 1e-9},
    {"outline_time_constant": 1e9},
    {"max_covered": 0.0},
    {"max_covered": 1.0},
    {"depth_continuity_weight": 0.0},
    {"depth_continuity_weight": 1e9},
    {"acceleration_noise": 1e-9, "max_speed": 1e-9},
    {"acceleration_noise": 1e6, "max_speed": 1e6},
    {"rate": 1e-9},
    {"rate": 1e9},
    {"min_response_share": 1.0, "distance_penalty": 0.0},
    {"min_response_share": 0.0, "distance_penalty": 1e9},
    {"min_score": 0.0, "min_score_to_move": 0.0},
    {"min_score": 1.0, "min_score_to_move": 1.0},
    {"jump_weight": 0.0},
    {"jump_weight": 1e9},
    {"lost_after": 0.0, "candidates": 99},
    {"lost_after": 1e9},
    {"max_missed_seconds": 0.0, "min_score_to_redetect": 1.0},
    {"max_missed_seconds": 1e9, "min_score_to_redetect": 0.0},
    {"lost_position_noise": 1e-9},
    {"lost_position_noise": 1e9},
    {"min_score_to_redetect": 0.0},
    {"min_score_above_clutter": 0.0, "clutter_margin": 0.0},
]


@pytest.mark.parametrize("extreme", EXTREMES, ids=str)
def test_extremes_give_finite_tracks(extreme, stage):
    """Whatever the ranges allow gives finite tracks, with depth and without, and over frames without anything
    to see.
    """
    frames = stage([(100.0, 90.0), (103.0, 91.0), (106.0, 92.0)])
    depth = np.full(frames[0].shape[:2], 3.0, np.float32)
    depth[90:153, 100:150] = 1.5
    black = np.zeros_like(frames[0])
    tracker = FusedTracker(**extreme)
    tracks: list[Track] = [tracker.init(Frame(frames[0], depth=depth), (100, 90, 50, 63))]
    others = [Frame(frame, depth=depth) for frame in frames[1:]]
    others += [Frame(black), Frame(depth=depth), Frame(black), Frame(frames[0], depth=depth)]
    for track in [*tracks, *map(tracker.update, others)]:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        assert isinstance(track.status, Status)
        assert np.isfinite(track.position).all()
        assert np.linalg.eigvalsh(track.covariance).min() > 0
