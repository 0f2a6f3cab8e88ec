# SPDX-License-Identifier: MIT
"""The values of every tracker's parameters that are refused, and how they are named."""

import dataclasses
from typing import Any

import pytest
from tricue import (
    ColorParticleTracker,
    DepthParticleTracker,
    FlowDepthTracker,
    FusedTracker,
    StereoHeadTracker,
)

REFUSED: dict[type[Any], dict[str, tuple[Any, ...]]] = {
    ColorParticleTracker: {
        "particles": (1, 0, -5, 100_001),
        "observation": ("ranks", "", "RANK-SPATIAL"),
        "likelihood": ("square", ""),
        "window_shape": ("circle", ""),
        "skin_region": ("window", ""),
        "drift": (-0.1, 1.1),
        "sharpness": (0, -1.0),
        "grid": ((1, 12), (12, 65), (12,), (12, 12, 12)),
        "grid_reach": (0, -1, 4.1),
        "color_weight": (-0.1,),
        "ring": ((0.9, 1.8), (1.3, 8.1), (1.3,)),
        "ring_samples": (0,),
        "skin_threshold": (-1.1, 1.1),
        "skin_share": (-0.1, 1.0),
        "max_step": (-1,),
        "max_step_sizes": (-0.1,),
        "velocity_rate": (-0.1, 1.1),
        "position_noise": (-0.1,),
        "velocity_noise": (-0.1,),
        "size_noise": (-0.1, 1e300),
        "aspect_noise": (-0.1, 1e300),
        "size_pull": (-0.1, 1.1),
        "size_rate": (-0.1, 1.1),
        "size_range": ((0, 4), (-1, 4), (0.3,)),
        "resample_below": (-0.1, 1.1),
        "likelihood_drop": (-0.1,),
        "max_likelihood_drop": (-0.1,),
        "wide_search_spread": (0, -0.1),
        "learning_rate": (-0.1, 1.1),
        "color_rate": (-0.1, 1.1),
        "first_frame_weight": (-0.1, 1.1),
        "min_score_to_learn": (-0.1, 1.1),
        "min_score": (-0.1, 1.1),
        "lost_after": (-0.1,),
        "min_lead": (-0.1,),
        "max_time_without_lead": (-0.1,),
        "min_score_to_redetect": (-0.1, 1.1),
        "rate": (0, -1),
    },
    DepthParticleTracker: {
        "particles": (1, 0, -5, 100_001),
        "near": (0, -1.0, 8.0, 9.0),
        "far": (0, -1.0, 1e300),
        "resolution": (15, 0, -1),
        "sweeps": (0, 3),
        "rate": (0, -15.0),
        "floor": (),
        "floor_clear": (-0.1,),
        "edges": (),
        "edge_gap": (-0.1,),
        "edge_slope": (-0.1,),
        "max_gap_share": (-0.1, 1.1),
        "gap_passes": (-1, 17),
        "levels": (7, 0, 4097),
        "bandwidth": (0, -0.1),
        "prominence": (-0.1, 1.1),
        "min_area": (0, -0.1),
        "aspect": ((0, 5), (-1, 5), (5.0, 1.0), (1.0,), (1.0, 2.0, 3.0)),
        "human_filter": (),
        "depth_signature": (),
        "complete": (),
        "human_height": ((0, 2), (-1, 2), (2.2, 0.9), (1.0,)),
        "max_fill": (0, -0.1, 1.1),
        "histogram": ("Relative", "", "both"),
        "likelihood": ("square", ""),
        "sharpness": (0, -1.0),
        "histogram_reach": (0, -0.5),
        "bins": (3, 0, 4097),
        "grid": ((1, 10), (14, 65), (14,), (14, 10, 3)),
        "contrast": (-0.1,),
        "margin": (1.0, 0.5),
        "measurement": (-0.1,),
        "size_prior": (-0.1,),
        "object_share": (-0.1, 1.0),
        "leave_out_others": (),
        "motion": ("acceleration", ""),
        "max_speed": (0, -1.0),
        "velocity_rate": (-0.1, 1.1),
        "position_noise": (-0.1,),
        "speed_noise": (-0.1,),
        "size_noise": (0, -0.1),
        "size_rate": (-0.1, 1.1),
        "learning_rate": (-0.1, 1.1),
        "occluder_margin": (0, -0.1),
        "max_covered": (-0.1, 1.1),
        "min_visible_share": (-0.1, 1.1),
        "likelihood_drop": (-0.1,),
        "coast": (),
        "lost_after": (-0.1,),
    },
    StereoHeadTracker: {
        "resolution": (15, 0, -1),
        "min_head_cells": (-1, 1001),
        "search": ((-1, 4), (8, 65), (8,), (8, 4, 2)),
        "bins": ((0, 16, 8), (16, 65, 8), (16, 16), (64, 64, 64)),
        "max_chroma": (0, 256),
        "compensate_light": (),
        "ring": (1, 0.5, 4.1),
        "ring_weight": (-0.1,),
        "depth_weight": (-0.1,),
        "depth_ring": (-0.1,),
        "disparity_tolerance": (0, -0.1, 1e300),
        "hair": (-0.1, 1.1),
        "first_frame_weight": (-0.1, 1.1),
        "learning_rate": (-0.1, 1.1),
        "learn": ("Coherent", "", "none"),
        "min_intersection_to_learn": (-0.1, 1.1),
        "learning_gate": ("mean", ""),
        "head_colors": ((), ((0,),), ((0, -1.0),), ((2048, 1.0),), ((1, 1.0), (1, 1.0)), ((1, 0.0),)),
        "subpixel": (),
        "disparities": ((0, 4), (4, 65), (4,), (4, 4, 4)),
        "window": (0, -1, 4, 17),
        "uniqueness": (-1, 101),
        "prefilter": (),
        "ellipse_margin": (-0.1, 1.1),
        "disparity_statistic": ("mode", ""),
        "fuse": (),
        "motion": ("acceleration", ""),
        "acceleration_noise": (0, -0.1),
        "max_speed": (0, -1.0),
        "noise_model": ("cubic", ""),
        "disparity_noise": (0, -0.1),
        "place_noise": (0, -0.1),
        "color_noise": (0, -0.1, (4, 4), (4, 4, 0)),
        "color_drift": (0, -0.1, (4, 4), (4, 4, 0)),
        "intersection_noise": (0, -0.1, 1e300),
        "feedback": (),
        "rate": (0, -30.0),
        "min_score": (-0.1, 1.1),
        "max_deviations": (0, -0.1),
        "search_frame_after": (-0.1,),
        "min_score_to_redetect": (-0.1, 1.1),
        "lost_after": (-0.1,),
        "near": (0, -1.0, 0.0009, 6.0, 9.0),
        "far": (0, -1.0, 1e300),
    },
    FlowDepthTracker: {
        "cues": ((), ("depth",), ("flow", "flow"), ("flow", "disparity", "flow"), "flow"),
        "resolution": (31, 0, -1),
        "vergence": (-45, 45, 90),
        "sigma": (0, 0.49, 8.1),
        "flow_levels": (0, 7),
        "min_angle": (-0.1, 1.1),
        "min_contrast": (-0.1,),
        "disparity_levels": (0, 7),
        "disparity_radius": (-1, 8),
        "max_disparity_step": (0, -1),
        "histogram_region": ("box", ""),
        "velocity_smoothing": (),
        "prior_center": (-0.1, 1.1),
        "min_region_share": (-0.1, 1.1),
        "outlier_share": (-0.1, 0.5),
        "block_rules": ("paper", ""),
        "target_window": ("blocks", ""),
        "complete_occlusion": ("flow", ""),
        "votes_to_release": (0, -1, 10**30),
        "bins": (7, 513),
        "smoothing": (0, 8.1),
        "min_prominence": (-0.1, 1),
        "flow_half_range": (0.009, 0, -1),
        "disparity_half_range": (0.009, 0, -1),
        "flow_change": (0, -1),
        "disparity_change": (0, -1),
        "surround_weight": (-0.1, 1),
        "margin": (-0.1, 2.1),
        "density_memory": (-0.1, 1),
        "min_posterior": (0, 1.1),
        "min_posterior_one_cue": (0, 1.1),
        "min_neighbors": (-1, 9),
        "block_side": (0, 1.1),
        "min_block_share": (0, 1.1),
        "votes_to_add": (0, -1, 10**30),
        "votes_to_remove": (0, -1, 10**30),
        "occluder_margin": (0, -1),
        "disparity_tolerance": (0, -1),
        "thickness": (-0.1, 1),
        "depth_camera_scale": (0, 1.1),
        "max_frames_without_pixels": (0, -1, 10**30),
        "max_occluded_share": (0, 1.1),
        "min_pixels": (0, 1.1),
        "min_pixels_to_redetect": (0, 1.1),
        "unoccluded_lost_after": (-0.1,),
        "lost_after": (-0.1,),
        "rate": (0, -30),
        "place_noise": (0, -1),
        "disparity_noise": (0, -1),
        "acceleration_noise": (0, -1),
    },
    FusedTracker: {
        "cues": (
            (),
            ("smell",),
            "filter",
            ("ranks",),
            ("depth", "flow"),
            ("ranks", "edges", "depth", "flow"),
        ),
        "context": (1.4, 8.1, 0, -3),
        "label_width": (0, 1.1),
        "ridge": (0, -1),
        "temporal_weight": (-0.1,),
        "filter_penalty": (0, -1),
        "first_frame_weight": (-0.1, 1.1),
        "filter_weight": (-0.1,),
        "filter_mask_size": (1, 99.1),
        "color_weight": (-0.1,),
        "color_learning_rate": (-0.1, 0.6),
        "surround_size": (1, 0.5),
        "surround_weight": (-0.1,),
        "size_learning_rate": (-0.1, 0.6),
        "size_change_penalty": (-0.1,),
        "size_range": ((2.0, 1.0), (0.0, 1.0), (-1.0, 1.0), (1.0,), (1.0, 2.0, 3.0)),
        "depth_learning_rate": (-0.1, 1.1),
        "turn_back": (-0.1, 1.1),
        "turn_noise": (0, -0.1),
        "outline_time_constant": (0, -1),
        "max_covered": (-0.1, 1.1),
        "depth_continuity_weight": (-0.1,),
        "acceleration_noise": (0, -1),
        "max_speed": (0, -1),
        "rate": (0, -30),
        "min_response_share": (-0.1, 1.1),
        "distance_penalty": (-0.1,),
        "learn_every": (-0.1, 1.1),
        "min_score": (-0.1, 1.1),
        "min_score_to_move": (-0.1, 1.1),
        "jump_weight": (-0.1,),
        "lost_after": (-0.1,),
        "max_missed_seconds": (-0.1,),
        "lost_position_noise": (0, -1),
        "min_score_to_redetect": (-0.1, 1.1),
        "min_score_above_clutter": (-0.1, 1.1),
        "clutter_margin": (-0.1,),
        "candidates": (0, 100, 2.5),
    },
}
TRACKERS = tuple(REFUSED)
TYPES = [("cues", "flow"), ("cues", "filter"), ("candidates", 2.5)]  # not numbers out of range
OTHER_KINDS = (..., "many", float("nan"), b"1", [None, None], True, None)


def fields(tracker):
    """The tracker's parameters, by name."""
    return {field.name: field for field in dataclasses.fields(tracker.Params)}


def cases(of):
    """A parameter set for each tracker, name and value that ``of(tracker, name)`` gives, named after them."""
    return [
        pytest.param(tracker, name, value, id=f"{tracker.__name__}-{name}-{value!r}")
        for tracker in TRACKERS
        for name in fields(tracker)
        for value in of(tracker, name)
    ]


def other_kinds(tracker, name):
    """Values that the field's type doesn't have: a switch has True, and some have None."""
    default = fields(tracker)[name].default
    allowed = [value for value in (True, None) if type(value) is type(default)]
    return [value for value in OTHER_KINDS if not any(value is each for each in allowed)]


def infinities(tracker, name):
    """Both, for numbers; None stands for one that is worked out, unless the field holds a tuple."""
    field = fields(tracker)[name]
    is_number = isinstance(field.default, float | None) and "tuple" not in str(field.type)
    return [float("inf"), -float("inf")] if is_number else []


@pytest.mark.parametrize("tracker", TRACKERS)
def test_every_field_has_its_bad_values(tracker):
    """The table above names every field there is: a new one must be tried too."""
    assert set(REFUSED[tracker]) == set(fields(tracker))


@pytest.mark.parametrize(("tracker", "name", "value"), cases(lambda tracker, name: REFUSED[tracker][name]))
def test_values_out_of_range_are_named(tracker, name, value):
    """A value out of range is a ValueError that begins with the field's name, before any frame; a TypeError
    where a word stands for a list, or a fraction for a count.
    """
    error = TypeError if (name, value) in TYPES else ValueError
    with pytest.raises(error, match=f"^{name}: expected"):
        tracker(**{name: value})


@pytest.mark.parametrize(("tracker", "name", "value"), cases(other_kinds))
def test_values_of_another_kind_are_named(tracker, name, value):
    """Whatever isn't a value of the field's type, NaN and True included, is an error that begins with its
    name.
    """
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        tracker(**{name: value})


@pytest.mark.parametrize(("tracker", "name", "value"), cases(infinities))
def test_numbers_are_finite(tracker, name, value):
    """An infinite number is a ValueError that begins with the field's name, whatever its range."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        tracker(**{name: value})


@pytest.mark.parametrize(
    ("tracker", "near", "far"),
    [
        (DepthParticleTracker, 3.0, 3.0),
        (DepthParticleTracker, 3.0, 2.0),
        (DepthParticleTracker, 8.0, 8.0),
        (StereoHeadTracker, 3.0, 3.0),
        (StereoHeadTracker, 3.0, 2.0),
        (StereoHeadTracker, 6.0, 6.0),
    ],
)
def test_near_is_under_far(tracker, near, far):
    """A range that is empty or upside down is refused by the name of its lower end."""
    with pytest.raises(ValueError, match=r"^near: expected under far, .*got"):
        tracker(near=near, far=far)
