# SPDX-License-Identifier: MIT
import os
import pickle
import subprocess
import sys
from importlib.metadata import EntryPoint
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.errors import MissingChannelError
from tricue.track.base import registry
from tricue.track.base.traits import Channels, Traits


class Plain:
    """Somebody else's tracker: two methods, no base class."""

    def __init__(self, step: float = 0.0) -> None:
        self.step = step

    def init(self, frame: tricue.Frame, box: tricue.Box) -> None:
        assert isinstance(frame, tricue.Frame)
        self.box = box

    def update(self, frame: tricue.Frame) -> tuple[float, ...] | None:
        assert frame.color is not None
        if not frame.color.any():
            return None
        self.box = self.box._replace(x=self.box.x + self.step)
        return tuple(self.box)


class Mixed(Plain):
    """It answers with a Track, and with None for a lost target."""

    def update(self, frame: tricue.Frame) -> Any:
        box = super().update(frame)
        return box and tricue.Track(tricue.Box(*box), 0.5, tricue.Status.TRACKED)


GRAY = np.full((40, 60, 3), 128, np.uint8)
PLAIN = f"{Plain.__module__}:Plain"


def test_any_class_by_its_module() -> None:
    """It proves that a class with init and update alone is a tracker: boxes are tracks, None is lost."""
    tracker = tricue.create(PLAIN, step=2.0, seed=4)
    assert tracker.init(GRAY, (1, 2, 10, 12)) == tricue.Track(
        tricue.Box(1, 2, 10, 12), 1.0, tricue.Status.TRACKED
    )
    assert tracker.update(GRAY).box == (3, 2, 10, 12)
    lost = tracker.update(np.zeros_like(GRAY))
    assert (lost.box, lost.score, lost.status) == ((3, 2, 10, 12), 0.0, tricue.Status.LOST)
    again = pickle.loads(pickle.dumps(tracker))
    assert again.update(GRAY) == tracker.update(GRAY)
    with pytest.raises(ValueError, match="box: expected"):
        tracker.init(GRAY)


class Nearest:
    """Somebody else's tracker of the nearest depth in the box, which declares no parameters."""

    traits = Traits(
        channels=(Channels.of("depth"),),
        camera=frozenset({"intrinsics"}),
        detects="person",
        shows=frozenset({"mask"}),
    )

    def __init__(self, intrinsics: tricue.Intrinsics, farther: float = 0.0) -> None:
        self.intrinsics, self.farther = intrinsics, farther

    def init(self, frame: Any, box: tricue.Box | None) -> tricue.Track:
        self.box = tricue.Box(1, 2, 10, 12) if box is None else box
        return self.update(frame)

    def update(self, frame: Any) -> tricue.Track:
        position = self.intrinsics.back_project(0, 0, np.nanmin(frame.depth) + self.farther)
        return tricue.Track(self.box, 0.5, tricue.Status.TRACKED, position)


def test_a_class_with_traits_needs_nothing_else() -> None:
    """It proves that a class with init, update and traits is run on other channels than color, with a camera,
    with and without a box, and in a MultiTracker; it needs no Params, and no keywords seed and kernels.
    """
    camera = tricue.Intrinsics.from_fov(60, 40, 60)
    depth = tricue.Frame(depth=np.full((40, 60), 2.0))
    name = f"{__name__}:Nearest"
    tracker = tricue.create(name, intrinsics=camera, farther=0.5, seed=3, kernels="reference")
    for box in ((3, 4, 5, 6), None):
        track = tracker.init(depth, box)
        assert track.box == (box or (1, 2, 10, 12))
        assert track.position is not None
        assert track.position[2] == 2.5
        assert pickle.loads(pickle.dumps(tracker)).update(depth) == tracker.update(depth)
    with pytest.raises(MissingChannelError, match=r"expected the channel depth, .*, got color"):
        tracker.update(GRAY)
    assert registry.traits(name).needs == "depth"
    assert not registry.traits(name).shows
    with tricue.MultiTracker(name, intrinsics=camera) as several:
        number = several.add(depth, (3, 4, 5, 6))
        assert several.update(depth)[number].box == (3, 4, 5, 6)


def test_the_last_box_may_be_a_tracks() -> None:
    """A target that is lost, by None, is where the last track was, not where it started."""
    tracker = tricue.create(f"{__name__}:Mixed", step=2.0)
    tracker.init(GRAY, (1, 2, 10, 12))
    assert tracker.update(GRAY).box == (3, 2, 10, 12)
    assert tracker.update(np.zeros_like(GRAY)).box == (3, 2, 10, 12)


def test_a_package_offers_trackers(monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that an entry point of the group tricue.trackers is a name like ours."""
    offered = {"plain": EntryPoint("plain", PLAIN, registry.GROUP)}
    monkeypatch.setattr(registry, "_installed_entry_points", lambda: offered)
    assert registry.names()[-1] == "plain"
    assert tricue.create("plain", step=1.0).init(GRAY, (1, 2, 10, 12)).score == 1
    assert registry.traits("plain").needs == "color"


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("mine.py", "name: expected one of .*, module:Class or file.py:Class, got 'mine.py'"),
        ("no_such_module:Tracker", "no_such_module:Tracker: there is no module no_such_module"),
        ("fractions:Nothing", "fractions:Nothing: the module fractions has no Nothing"),
        ("./mine:Mine", "./mine:Mine: expected module:Class or path/to/file.py:Class"),
        (":Mine", ":Mine: expected module:Class or path/to/file.py:Class"),
        ("math:pi", "math:pi: expected a class with init and update, got float"),
        ("fractions:Fraction", r"Fraction: expected a class with init\(frame, box\) and update"),
    ],
)
def test_what_is_no_tracker_is_named(name: str, message: str) -> None:
    """It proves that a module, a class or methods that aren't there are named."""
    with pytest.raises((TypeError, ValueError), match=f"^{message}"):
        tricue.create(name)


@pytest.mark.parametrize("name", registry.names())
def test_every_tracker_tells_its_traits(name: str) -> None:
    """It proves that each has traits, runs on each of its sets of channels, and has what it says it shows."""
    traits = registry.traits(name)
    for each in traits.channels:
        tracker = tricue.create(name, **each.params)
        assert traits.best(each.names) is not None
        assert each in traits.fitting(tracker.params)
        for attribute in traits.shows:
            getattr(tracker, attribute)
    assert (traits.detects == "person") == (name == "depth-particle")
    assert traits.random == (name in ("color-particle", "depth-particle"))
    assert traits.follows
    assert traits.source


@pytest.mark.parametrize("name", ["colr-particle", "", None, 3])
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


def test_a_tracker_of_cv2_by_its_class() -> None:
    """It proves that cv2's classes are made by ``create``; what their constructors make crashes in init."""
    code = (
        "import numpy as np, tricue\n"
        "image = np.random.default_rng(0).integers(0, 256, (60, 80, 3), np.uint8)\n"
        "tracker = tricue.create('cv2:TrackerMIL')\n"
        "tracker.init(image, (20, 10, 30, 30))\n"
        "print(tracker.update(image).status)\n"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (told.returncode, told.stdout) == (0, "tracked\n")


@pytest.mark.parametrize("name", ["cv2:TrackerMIL", PLAIN])
def test_a_third_partys_update_needs_init(name: str) -> None:
    """In a process of its own, for without this check MIL of cv2 ends the process by SIGSEGV."""
    code = f"import numpy as np, tricue\ntricue.create({name!r}).update(np.zeros((60, 80, 3), np.uint8))\n"
    folders = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, sys.path))}
    told = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False, env=folders
    )
    assert told.stderr.endswith("RuntimeError: update: expected init first, with a frame and a box\n")
