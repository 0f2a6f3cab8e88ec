# SPDX-License-Identifier: MIT
"""Every tracker, one update per frame: native, reference, and the alternatives that a user has."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
import pytest
import tricue
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import baselines as opencv_trackers
from tricue.evaluation import metrics
from tricue.evaluation.frame_views import depth_as_picture
from tricue.scenes import face_over_clutter, head, overtaking, walker
from tricue.scenes.stress.scene import stress_scene
from tricue.track.base.track import Status

USUAL = 60
BOTH: dict[str, dict[str, Any]] = {"native": {}, "reference": {"kernels": "reference"}}
BASELINES = opencv_trackers.available()


@cache
def scene(make: Callable[..., Any], *arguments: Any) -> Any:
    """A scene, made before any clock starts."""
    if make in (face_over_clutter, stress_scene):
        pytest.importorskip("skimage", reason="needs scikit-image: pip install tricue[demo]")
    return make(*arguments)


@dataclass(frozen=True, kw_only=True)
class Case:
    """A tracker on a scene: one group of the benchmarks."""

    tracker: str
    size: str
    scene: tuple[Any, ...]  # the function that makes it, and its arguments
    ours: dict[str, dict[str, Any]] = field(default_factory=BOTH.copy)  # parameters, by variant
    baselines: Sequence[str] = ("KCF", "CSRT")
    camera: str | None = None  # the scene's attribute that the tracker needs
    others: dict[str, tuple[Any, ...]] = field(default_factory=dict)  # for variants that see another scene
    cameras: dict[str, str] = field(default_factory=dict)  # for variants that need another attribute
    frames: int = USUAL
    slow: int  # number of frames for the reference, which is slow
    within: float  # pixels by which both sets of kernels may differ
    depth: bool = False  # whether cv2's trackers see depth as a picture

    def __str__(self) -> str:
        return f"{self.tracker}-{self.size}"

    @property
    def group(self) -> str:
        return f"{self.tracker}, {self.size}, one update"

    def scene_of(self, name: str) -> Any:
        """The scene that a variant or a baseline sees."""
        return scene(*self.others.get(name, self.scene))

    def frames_of(self, name: str) -> list[Frame]:
        """The frames that a variant or a baseline sees."""
        frames = self.scene_of(name).frames[: self.slow if name == "reference" else self.frames]
        return list(map(depth_as_picture(), frames)) if self.depth and name not in self.ours else list(frames)

    def started(self, name: str) -> Any:
        """A tracker after its init."""
        seen = self.scene_of(name)
        if name in self.ours:
            key = self.cameras.get(name, self.camera)
            camera = {} if key is None else {key: getattr(seen, key)}
            tracker = tricue.create(self.tracker, **camera, **self.ours[name])
        else:
            tracker = BASELINES[name](0)
        tracker.init(self.frames_of(name)[0], Box(*map(float, seen.boxes[0])))
        return tracker


def cases() -> Iterator[Case]:
    """All groups."""
    yield Case(
        tracker="color-particle",
        size="320x240",
        scene=(face_over_clutter, 0),  # figure 1's
        baselines=tuple(BASELINES),
        frames=90,
        slow=90,
        within=1e-9,
    )
    for size, camera in (("176x144", "tof"), ("640x480", "rgbd")):
        yield Case(
            tracker="depth-particle",
            size=size,
            scene=(walker, 0, USUAL, camera),
            camera="intrinsics",
            slow=8,
            within=1e-6,
            depth=True,
        )
    for size in ("160x120", "640x480"):
        yield Case(
            tracker="stereo-head",
            size=size,
            scene=(head, 0, USUAL, size),  # in swinging light
            camera="rig",
            slow=6,
            within=1e-6,
        )
        yield Case(
            tracker="flow-depth",
            size=size,
            scene=(overtaking, 0, USUAL, size),  # hidden and seen again
            ours={**BOTH, "flow alone": {"cues": ("flow",)}, "disparity alone": {"cues": ("disparity",)}},
            baselines=("KCF", "CSRT", "MedianFlow"),
            camera="rig",
            slow=5,
            within=1e-3,
        )
    yield FUSED


SEES = {"color and depth": "intrinsics", "pair": "rig"}
FUSED = Case(
    tracker="fused",
    size="320x240",
    scene=(stress_scene, "scale", 0, (320, 240), "color"),  # its size changes 1:2 in these frames
    ours={"native": {}, **{name: {} for name in SEES}, "reference": {"kernels": "reference"}},
    baselines=("CSRT", "KCF", "MedianFlow"),
    others={
        "color and depth": (stress_scene, "scale", 0, (320, 240), "rgbd"),
        "pair": (stress_scene, "scale", 0, (320, 240), "stereo"),
    },
    cameras=SEES,
    slow=8,
    within=0.1,  # a sample that is rounded to another gray level changes what is learned
)
RUNS = [
    pytest.param(case, name, id=f"{case}-{name}")
    for case in cases()
    for name in (*case.ours, *(baseline for baseline in case.baselines if baseline in BASELINES))
]


def boxes_of(case: Case, name: str) -> np.ndarray:
    """The boxes of a track after the first frame."""
    tracker = case.started(name)
    return np.array([tracker.update(frame).box for frame in case.frames_of(name)[1:]])


@pytest.mark.parametrize(("case", "name"), RUNS)
def bench_update(benchmark: Any, case: Case, name: str) -> None:
    """A round is a frame; init isn't measured. Both sets of kernels agree within the case's tolerance."""
    benchmark.group = case.group
    boxes = []
    tracker = case.started(name)
    frames = case.frames_of(name)[1:]
    feed = iter(frames)
    benchmark.pedantic(
        lambda frame: boxes.append(tracker.update(frame).box),
        setup=lambda: ((next(feed),), {}),
        rounds=len(frames),
    )
    truth = np.array(case.scene_of(name).boxes[1 : 1 + len(boxes)])
    benchmark.extra_info["overlap above 0.5"] = float(np.mean(metrics.overlaps(np.array(boxes), truth) > 0.5))
    if name == "reference":
        assert np.abs(np.array(boxes) - boxes_of(case, "native")[: len(boxes)]).max() < case.within


@pytest.mark.benchmark(group=FUSED.group)
def bench_fused_lost(benchmark: Any) -> None:
    """A round is a frame in which the tracker, on color, searches the whole frame for its lost target.

    The frames show another room without the target, so that it stays lost.
    """
    tracker = FUSED.started("native")
    for frame in FUSED.frames_of("native")[1:11]:  # until it knows its typical features
        tracker.update(frame)
    make, kind, _, *others = FUSED.scene
    feed = iter(scene(make, kind, 1, *others).frames[:USUAL])
    while tracker.update(next(feed)).status is not Status.LOST:
        pass
    searched = list(feed)
    feed = iter(searched)
    statuses = []
    benchmark.pedantic(
        lambda frame: statuses.append(tracker.update(frame).status),
        setup=lambda: ((next(feed),), {}),
        rounds=len(searched),
    )
    assert len(searched) >= USUAL // 2
    assert set(statuses) == {Status.LOST}
