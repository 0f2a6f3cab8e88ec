# SPDX-License-Identifier: MIT
import re
import subprocess
import sys
from pathlib import Path

import pytest
import tricue
from tricue.track.base import registry

ROOT = Path(__file__).parents[1]


def test_everything_promised_is_there() -> None:
    """It proves that every public name can be had, and dir() lists it."""
    assert set(tricue.__all__) == set(dir(tricue))
    for name in tricue.__all__:
        assert getattr(tricue, name) is not None


@pytest.mark.parametrize("name", registry.names())
def test_every_tracker_is_at_the_front_door(name: str) -> None:
    """It proves that each tracker that create() makes is a public class with parameters, seed and kernels."""
    tracker = tricue.create(name, seed=3, kernels="reference")
    public = type(tracker).__name__
    assert public in tricue.__all__
    assert getattr(tricue, public) is type(tracker)
    assert tracker.params == type(tracker).Params()  # type: ignore[attr-defined]
    assert (tracker.seed, tracker.kernels) == (3, "reference")  # type: ignore[attr-defined]


def test_both_trackers_of_the_paper_are_there() -> None:
    """It proves that the names of the color and the depth tracker are what users were told."""
    assert {"color-particle", "depth-particle"} <= set(registry.names())
    assert {"ColorParticleTracker", "DepthParticleTracker"} <= set(tricue.__all__)


def test_the_stereo_tracker_is_there() -> None:
    """It proves that the name of the stereo tracker, its class and its rig are what users were told."""
    assert "stereo-head" in registry.names()
    assert {"StereoHeadTracker", "StereoRig"} <= set(tricue.__all__)


def test_the_flow_and_depth_tracker_is_there() -> None:
    """It proves that the name of the flow and depth tracker and its class are what users were told."""
    assert "flow-depth" in registry.names()
    assert "FlowDepthTracker" in tricue.__all__


def test_the_fused_tracker_is_there() -> None:
    """It proves that the name of the fused tracker and its class are what users were told."""
    assert "fused" in registry.names()
    assert "FusedTracker" in tricue.__all__


def test_the_version_stands_in_one_place() -> None:
    """It proves that __version__ is what pyproject.toml says."""
    declared = re.search(r'^version = "(.+)"', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert declared is not None
    assert tricue.__version__ == declared[1]


def test_unknown_attributes_are_errors() -> None:
    """It proves that a name that tricue doesn't have is a plain AttributeError."""
    with pytest.raises(AttributeError, match="module 'tricue' has no attribute 'Boks'"):
        tricue.Boks  # noqa: B018


def test_a_missing_extension_is_explained() -> None:
    """It proves that without the native kernels the import says what is missing and how to build it."""
    code = "import sys; sys.modules['tricue._core'] = None; import tricue"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "tricue: the native kernels can't be loaded" in done.stderr
    assert "pip install ." in done.stderr


def test_the_import_is_light() -> None:
    """It proves that importing tricue loads neither cv2 nor matplotlib."""
    code = "import sys, tricue; print(sorted({'cv2', 'matplotlib', 'skimage'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
