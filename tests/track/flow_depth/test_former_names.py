# SPDX-License-Identifier: MIT
"""That parameters of the flow and depth tracker are still taken and read by their former names."""

import pytest
from tricue import FlowDepthTracker

Params = FlowDepthTracker.Params
FORMER = {
    "ripple": "min_prominence",
    "flow_reach": "flow_half_range",
    "depth_reach": "disparity_half_range",
    "depth_change": "disparity_change",
    "surround": "surround_weight",
    "sharp": "depth_camera_scale",
    "memory": "density_memory",
    "posterior": "min_posterior",
    "posterior_alone": "min_posterior_one_cue",
    "neighbours": "min_neighbors",
    "block": "block_side",
    "share": "min_block_share",
    "votes": "votes_to_add",
    "against": "votes_to_remove",
    "idle": "max_frames_without_pixels",
    "nearer": "occluder_margin",
    "similar": "disparity_tolerance",
    "covered": "max_occluded_share",
    "few": "min_pixels",
    "again": "min_pixels_to_redetect",
    "unsure": "unoccluded_lost_after",
    "agility": "acceleration_noise",
}


@pytest.mark.parametrize(("former", "name"), FORMER.items())
def test_former_names_warn_and_work(former, name):
    """A value given by its former name is that of the parameter, with a warning that gives the new name."""
    value = getattr(Params(), name)
    with pytest.warns(DeprecationWarning, match=f"^{former}: deprecated, the parameter is {name} now"):
        assert Params(**{former: value}) == Params()
    with pytest.warns(DeprecationWarning, match=f"^{former}: deprecated, the parameter is {name} now"):
        assert getattr(Params(), former) == value
