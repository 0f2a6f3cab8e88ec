# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.evaluation import baselines

from benchmarks.quality.common.variants import Inputs, parse_variants, with_settings, without_times

CAMERA = Intrinsics.from_fov(8, 6, 60)
IMAGE = np.zeros((6, 8, 3), np.uint8)
RGBD = Frame(IMAGE, np.ones((6, 8), np.float32), timestamp=2.0)


def test_channels_are_limited():
    """A tracker named with a colon and channels gets only these and their cameras."""
    whole, color, depth = parse_variants(["fused", "fused:color", "flow-depth:depth"])
    inputs = Inputs(("color", "depth"), CAMERA)
    assert whole.view(inputs)(RGBD).channels == ("color", "depth")
    assert color.view(inputs)(RGBD).channels == ("color",)
    assert color.view(inputs)(RGBD).timestamp == 2.0
    assert depth.view(inputs)(RGBD).channels == ("depth",)
    assert whole.make(inputs)._tracker.intrinsics == CAMERA
    assert color.make(inputs)._tracker.intrinsics is None
    assert depth.make(inputs)._tracker.params.cues == ("disparity",)
    assert [each.label for each in (whole, color)] == ["fused", "fused:color"]


def test_times_are_withheld():
    """Of frames with all channels and with some; nothing else changes."""
    inputs = Inputs(("color", "depth"), CAMERA)
    for variant in parse_variants(["fused", "fused:depth"]):
        with_times, without = (each.view(inputs)(RGBD) for each in (variant, without_times(variant)))
        assert (with_times.timestamp, without.timestamp) == (2.0, None)
        assert with_times.channels == without.channels
        assert without_times(variant).label == f"{variant.label}, no times"


def test_missing_channels_are_named():
    """Those that the sequence lacks, and those that the variant excludes."""
    depth, color, stereo = parse_variants(["fused:depth", "fused:color", "stereo-head"])
    assert depth.unsupported(Inputs(("color",))) == "no depth"
    assert color.unsupported(Inputs(("color", "depth"))) == ""
    assert stereo.unsupported(Inputs(("color", "depth"))) == "no stereo pair"
    rig = StereoRig(Intrinsics.from_fov(160, 120, 60), 0.1)
    assert stereo.unsupported(Inputs(("color", "right"), rig=rig)) == ""
    assert stereo.make(Inputs(("color", "right"), rig=rig))._tracker.rig == rig


def test_settings_reach_their_tracker():
    """Numbers and words, for the tracker that they name; further settings override them."""
    fused, color = parse_variants(["fused", "color-particle"], ["fused.cues=filter,color", "fused.ridge=0.5"])
    assert dict(fused.spec.settings) == {"cues": ("filter", "color"), "ridge": 0.5}
    assert color.spec.settings == ()
    other = with_settings(fused, "another", {"ridge": 0.25})
    params = other.make(Inputs(("color",)))._tracker.params
    assert (other.label, params.ridge, params.cues) == ("another", 0.25, ("filter", "color"))


@pytest.mark.parametrize(
    ("words", "settings", "error"),
    [
        (["nobody"], [], "expected some of color-particle"),
        (["fused:light"], [], "expected channels of color, depth, right, got 'light'"),
        (["fused"], ["ridge=1"], "expected tracker.name=value, got 'ridge=1'"),
        (["still-box"], ["fused.ridge=1"], "expected one of still-box, got 'fused'"),
        (["fused"], ["fused.ridge=-1"], "ridge"),
    ],
)
def test_unknown_words_are_named(words, settings, error):
    """Trackers, channels and parameters."""
    with pytest.raises(ValueError, match=error):
        parse_variants(words, settings)


def test_a_cv2_without_contrib_is_enough(monkeypatch, capsys):
    """Trackers that the installed cv2 lacks are left out and named; without any other there is an error."""
    monkeypatch.setattr(baselines, "available", lambda: {"MIL": None})
    found = parse_variants(["fused", "CSRT", "fused:color", "MIL"])
    assert [each.label for each in found] == ["fused", "fused:color", "MIL"]
    assert capsys.readouterr().err == "left out CSRT: the installed cv2 doesn't have it\n"
    with pytest.raises(ValueError, match="expected some that the installed cv2 has, got CSRT, KCF"):
        parse_variants(["CSRT", "KCF"])
