# SPDX-License-Identifier: MIT
"""The parameters of the fused tracker: what is refused, and that they come back from a file."""

import dataclasses
import itertools
import typing
from typing import Any

import numpy as np
import pytest
from tricue import Frame, FusedTracker, Status, Track
from tricue.track.fused.params import Cue, FusedParams

FIELDS = {field.name: field for field in dataclasses.fields(FusedParams)}
CUES = typing.get_args(Cue)

REFUSED: dict[str, tuple[Any, ...]] = {
    "cues": ((), ("smell",), "filter", ("ranks",), ("depth", "flow"), ("ranks", "edges", "depth", "flow")),
    "context": (1.4, 8.1, 0, -3),
    "label_width": (0, 1.1),
    "ridge": (0, -1),
    "filter_learning_rate": (-0.1, 0.6),
    "first_frame_weight": (-0.1, 1.1),
    "filter_weight": (-0.1,),
    "filter_mask_size": (1, 99.1),
    "background_weight": (-0.1,),
    "color_weight": (-0.1,),
    "color_learning_rate": (-0.1, 0.6),
    "surround_size": (1, 0.5),
    "surround_weight": (-0.1,),
    "scales": (2, 4, 10, 101, 0),
    "scale_step": (1, 2.1),
    "scale_window": (0, -1),
    "scale_label_width": (0, -1),
    "scale_prior": (-0.1,),
    "scale_first_frame_weight": (-0.1, 1.1),
    "rank_weight": (-0.1,),
    "edge_weight": (-0.1,),
    "size_range": ((2.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (1.0,), (1.0, 2.0, 3.0)),
    "depth_learning_rate": (-0.1, 1.1),
    "outline_time_constant": (0, -1),
    "max_covered": (-0.1, 1.1),
    "depth_continuity_weight": (-0.1,),
    "acceleration_noise": (0, -1),
    "max_speed": (0, -1),
    "rate": (0, -30),
    "velocity_rate": (-0.1, 1.1),
    "velocity_gain": (-0.1, 1.1),
    "min_response_share": (-0.1, 1.1),
    "distance_penalty": (-0.1,),
    "learn_every": (0, -1, 31, 2.5),
    "min_score_to_learn": (-0.1, 1.1),
    "uncertain_learning_factor": (-0.1, 1.1),
    "min_score": (-0.1, 1.1),
    "min_score_to_move": (-0.1, 1.1),
    "lost_after": (-0.1,),
    "max_structure_drop": (-0.1,),
    "min_recovery_share": (-0.1, 1.1),
    "lost_position_noise": (0, -1),
    "min_score_to_redetect": (-0.1, 1.1),
    "candidates": (0, 100),
}


def test_every_field_has_its_bad_values():
    """The table above names every field there is: a new one must be tried too."""
    assert set(REFUSED) == set(FIELDS)


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in REFUSED.items() for value in values], ids=str
)
def test_values_out_of_range_are_named(name, value):
    """A value out of range is an error that begins with the field's name, before any frame."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        FusedTracker(**{name: value})


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [..., "many", float("nan"), b"1", [None, None], True, None], ids=repr)
def test_values_of_another_kind_are_named(name, value):
    """Whatever isn't a value of the field's type, NaN and True included, is an error that begins with its
    name.
    """
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        FusedTracker(**{name: value})


def test_unknown_names_are_told():
    """An unknown name is an error that says the nearest known one."""
    with pytest.raises(TypeError, match=r"^rigde: unknown parameter .*ridge"):
        FusedTracker(rigde=1.0)


def test_params_or_values():
    """Parameters come all at once or one by one, and are those of this tracker."""
    params = FusedParams(velocity_gain=0.25)
    assert FusedTracker(params).params is params
    assert FusedTracker(velocity_gain=0.25).params == params
    assert FusedTracker().params == FusedParams()
    with pytest.raises(TypeError, match=r"^params: expected alone, got also velocity_gain"):
        FusedTracker(params, velocity_gain=0.5)
    with pytest.raises(TypeError, match=r"^params: expected FusedParams, got dict"):
        FusedTracker({"velocity_gain": 0.5})


@pytest.mark.parametrize("count", range(1, len(CUES) + 1))
def test_cues_need_one_that_finds(count):
    """Every choice with filter or color is taken, every other one is refused."""
    for cues in itertools.combinations(CUES, count):
        if {"filter", "color"} & set(cues):
            assert FusedParams(cues=cues).cues == cues
        else:
            with pytest.raises(ValueError, match=r"^cues: expected filter or color"):
                FusedParams(cues=cues)


def test_parameters_come_back_from_a_file(tmp_path):
    """Written to TOML and read again they are the same, all changed at once."""
    changed = FusedParams(
        cues=("color", "edges"), context=2.5, scales=7, size_range=(0.5, 2.0), lost_after=0.3, ridge=1.23e-7
    )
    for params in (FusedParams(), changed):
        params.to_toml(tmp_path / "fused.toml")
        assert FusedParams.from_toml(tmp_path / "fused.toml") == params
    assert changed != FusedParams()


def test_every_parameter_says_its_unit_and_source():
    """Each field has a unit and a source, is in the table, and its default passes its own check."""
    lines = FusedParams.describe().splitlines()
    assert [line.split()[0] for line in lines[1:]] == list(FIELDS)
    assert all(field.metadata["unit"] and field.metadata["source"] for field in FIELDS.values())
    assert FusedParams(**{name: field.default for name, field in FIELDS.items()}) == FusedParams()


EXTREMES: list[dict[str, Any]] = [
    {"context": 1.5},
    {"context": 8.0},
    {"label_width": 1e-9},
    {"label_width": 1.0},
    {"ridge": 1e-12},
    {"ridge": 1e12},
    {"filter_learning_rate": 0.0, "color_learning_rate": 0.0},
    {"filter_learning_rate": 0.5, "color_learning_rate": 0.5},
    {"filter_learning_rate": 0.5, "color_learning_rate": 0.5, "learn_every": 1},
    {"filter_learning_rate": 0.5, "color_learning_rate": 0.5, "learn_every": 2, "min_score_to_learn": 0.0},
    {"filter_learning_rate": 0.0, "color_learning_rate": 0.0, "learn_every": 30},
    {"filter_weight": 0.0, "color_weight": 0.0},
    {"filter_mask_size": 1.0000001},
    {"filter_mask_size": 99.0},
    {"background_weight": 0.0},
    {"background_weight": 1e9},
    {"surround_size": 1.0000001},
    {"surround_size": 1e6},
    {"surround_weight": 1e6},
    {"scales": 3},
    {"scales": 99},
    {"scale_step": 1.0000001},
    {"scale_step": 2.0},
    {"scale_window": 1e-6},
    {"scale_window": 1e3},
    {"scale_label_width": 1e-9},
    {"scale_label_width": 1e9},
    {"scale_prior": 1e9},
    {"rank_weight": 0.0, "edge_weight": 0.0},
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
    {"velocity_rate": 1.0, "velocity_gain": 1.0},
    {"min_response_share": 1.0, "distance_penalty": 0.0},
    {"min_response_share": 0.0, "distance_penalty": 1e9},
    {"min_score_to_learn": 0.0, "min_score": 0.0, "min_score_to_move": 0.0},
    {"uncertain_learning_factor": 0.0},
    {"uncertain_learning_factor": 1.0},
    {"min_score_to_learn": 1.0, "min_score": 1.0, "min_score_to_move": 1.0},
    {"lost_after": 0.0, "candidates": 99},
    {"lost_after": 1e9},
    {"max_structure_drop": 0.0, "min_recovery_share": 1.0},
    {"max_structure_drop": 1e9, "min_recovery_share": 0.0},
    {"lost_position_noise": 1e-9},
    {"lost_position_noise": 1e9},
    {"min_score_to_redetect": 0.0},
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
