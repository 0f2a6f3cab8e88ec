# SPDX-License-Identifier: MIT
"""That parameters of the stereo head tracker are still taken and read by their former names."""

import pytest
from tricue import StereoHeadTracker

Params = StereoHeadTracker.Params
FORMER = {
    "chroma": "max_chroma",
    "light": "compensate_light",
    "coherent": "disparity_tolerance",
    "anchor": "first_frame_weight",
    "gate": "min_intersection_to_learn",
    "rim": "ellipse_margin",
    "center": "disparity_statistic",
    "agility": "acceleration_noise",
    "fastest": "max_speed",
    "noise": "noise_model",
    "seen_above": "min_score",
    "surprise": "max_deviations",
    "again_after": "search_frame_after",
    "again_above": "min_score_to_redetect",
}


@pytest.mark.parametrize(("former", "name"), FORMER.items())
def test_former_names_warn_and_work(former, name):
    """A value given by its former name is that of the parameter, with a warning that gives the new name."""
    value = getattr(Params(), name)
    with pytest.warns(DeprecationWarning, match=f"^{former}: deprecated, the parameter is {name} now"):
        assert Params(**{former: value}) == Params()
    with pytest.warns(DeprecationWarning, match=f"^{former}: deprecated, the parameter is {name} now"):
        assert getattr(Params(), former) == value
