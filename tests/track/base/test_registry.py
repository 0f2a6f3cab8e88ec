# SPDX-License-Identifier: MIT
import pytest
import tricue
from tricue.track.base import registry


def test_a_tracker_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that create finds the class behind a name, imports it and passes the keywords on."""
    monkeypatch.setitem(registry._TRACKERS, "fraction", "fractions:Fraction")
    assert tricue.create("fraction", numerator=1, denominator=3).numerator == 1  # type: ignore[attr-defined]
    assert registry.names() == (*[name for name in registry.names() if name != "fraction"], "fraction")


@pytest.mark.parametrize("name", ["colour-particle", "", None, 3])
def test_unknown_names_list_the_known(name: str) -> None:
    """It proves that an unknown name is an error that lists the names there are."""
    with pytest.raises(ValueError, match=r"^name: expected one of .*'color-particle'.*, got "):
        tricue.create(name)


def test_the_stereo_tracker_by_its_name() -> None:
    """It proves that "stereo-head" makes a StereoHeadTracker, with its rig, seed, kernels and parameters."""
    rig = tricue.StereoRig(tricue.Intrinsics.from_fov(160, 120, 55), 0.12)
    tracker = tricue.create("stereo-head", rig=rig, seed=3, kernels="reference", fuse=False)
    assert isinstance(tracker, tricue.StereoHeadTracker)
    assert (tracker.rig, tracker.seed, tracker.kernels) == (rig, 3, "reference")
    assert tracker.params == tricue.StereoHeadTracker.Params(fuse=False)
    with pytest.raises(TypeError, match=r"^rig: expected tricue.StereoRig, got Intrinsics"):
        tricue.create("stereo-head", rig=rig.intrinsics)


def test_the_flow_and_depth_tracker_by_its_name() -> None:
    """It proves that "flow-depth" makes a FlowDepthTracker, with its rig or camera, seed, kernels and
    parameters.
    """
    rig = tricue.StereoRig(tricue.Intrinsics.from_fov(160, 120, 55), 0.12)
    tracker = tricue.create("flow-depth", rig=rig, seed=3, kernels="reference", cues=("flow",))
    assert isinstance(tracker, tricue.FlowDepthTracker)
    assert (tracker.rig, tracker.seed, tracker.kernels) == (rig, 3, "reference")
    assert tracker.params == tricue.FlowDepthTracker.Params(cues=("flow",))
    camera = tricue.create("flow-depth", intrinsics=rig.intrinsics)
    assert (camera.intrinsics, camera.rig) == (rig.intrinsics, None)  # type: ignore[attr-defined]
    with pytest.raises(TypeError, match=r"^intrinsics: expected without rig"):
        tricue.create("flow-depth", rig=rig, intrinsics=rig.intrinsics)
