# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig

from benchmarks.quality.fused.variants import Offered, participants, with_settings

CAMERA = Intrinsics.from_fov(8, 6, 60)
IMAGE = np.zeros((6, 8, 3), np.uint8)
RGBD = Frame(IMAGE, np.ones((6, 8), np.float32), timestamp=2.0)


def test_channels_are_taken_away():
    """A tracker with a colon and channels sees these alone, as if the others weren't there, cameras too."""
    whole, color, depth = participants(["fused", "fused:color", "flow-depth:depth"])
    offer = Offered(("color", "depth"), CAMERA)
    assert whole.view(offer)(RGBD).channels == ("color", "depth")
    assert color.view(offer)(RGBD).channels == ("color",)
    assert color.view(offer)(RGBD).timestamp == 2.0
    assert depth.view(offer)(RGBD).channels == ("depth",)
    assert whole.contender(offer)._tracker.intrinsics == CAMERA
    assert color.contender(offer)._tracker.intrinsics is None
    assert depth.contender(offer)._tracker.params.cues == ("disparity",)
    assert [each.label for each in (whole, color)] == ["fused", "fused:color"]


def test_who_lacks_a_channel_says_which():
    """Of what the sequence has, or of what was taken away."""
    depth, color, stereo = participants(["fused:depth", "fused:color", "stereo-head"])
    assert depth.refuses(Offered(("color",))) == "no depth"
    assert color.refuses(Offered(("color", "depth"))) == ""
    assert stereo.refuses(Offered(("color", "depth"))) == "no stereo pair"
    rig = StereoRig(Intrinsics.from_fov(160, 120, 60), 0.1)
    assert stereo.refuses(Offered(("color", "right"), rig=rig)) == ""
    assert stereo.contender(Offered(("color", "right"), rig=rig))._tracker.rig == rig


def test_settings_reach_their_tracker():
    """Numbers and words, for the one that they name; further ones go before."""
    fused, color = participants(["fused", "color-particle"], ["fused.cues=filter,color", "fused.ridge=0.5"])
    assert dict(fused.entrant.settings) == {"cues": ("filter", "color"), "ridge": 0.5}
    assert color.entrant.settings == ()
    other = with_settings(fused, "another", {"ridge": 0.25})
    params = other.contender(Offered(("color",)))._tracker.params
    assert (other.label, params.ridge, params.cues) == ("another", 0.25, ("filter", "color"))


@pytest.mark.parametrize(
    ("words", "settings", "error"),
    [
        (["nobody"], [], "expected some of color-particle"),
        (["fused:colour"], [], "expected channels of color, depth, right, got 'colour'"),
        (["fused"], ["ridge=1"], "expected tracker.name=value, got 'ridge=1'"),
        (["still-box"], ["fused.ridge=1"], "expected one of still-box, got 'fused'"),
        (["fused"], ["fused.ridge=-1"], "ridge"),
    ],
)
def test_what_is_not_known_is_named(words, settings, error):
    """Trackers, channels and parameters."""
    with pytest.raises(ValueError, match=error):
        participants(words, settings)
