# SPDX-License-Identifier: MIT
"""Rooms: scenes whose targets, surroundings and sensor faults resemble recordings, with exact truth."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.depth_images import METERS_PER_MILLIMETER
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.pairs import check_pair
from tricue.scenes.rendering.stereo_camera import expose_lit
from tricue.scenes.rooms.plan import ROOM_PLANS, plan_room
from tricue.scenes.rooms.stage import RoomStage, RoomTruth
from tricue.scenes.seeds import check_seed
from tricue.scenes.sensor.depth_camera import DepthFaults, FaultyDepthCamera
from tricue.scenes.sensor.stereo_faults import StereoFaults

ROOM_KINDS = tuple(ROOM_PLANS)
ROOM_CHANNELS = ("color", "rgbd", "stereo", "depth")
FIELD_OF_VIEW, ROOM_BASELINE = 60.0, 0.1  # horizontal, degrees; meters between the pair's cameras
ROOM_RAYS = 2  # per pixel, along each axis
MIN_ROOM_SIDE = 80  # pixels
MIN_FIRST_VISIBLE = 0.9
MAX_TRIES = 40


@dataclass(frozen=True, slots=True, eq=False)
class RoomScene:
    """A rendered room and its exact truth; the same arguments give the same bits.

    The truth is that of the geometry in the color (or left) camera's image, before the sensors' faults.
    """

    name: str
    kind: str
    seed: int
    frames: tuple[Frame, ...]
    """N frames with the requested channels and ``timestamp``, seconds from 0. Depth is rounded to
    millimeters, NaN where nothing was measured."""
    rate: float
    """Frames per second."""
    boxes: Array
    """(N, 4) x, y, width, height around the whole target, pixels, hidden parts included; it may reach beyond
    the image. NaN where the target is wholly outside of the image."""
    visible: Array
    """(N,) share of the target's pixels that are visible; those beyond the image count as hidden."""
    positions: Array
    """(N, 3) meters in the camera's frame: the mean of the surface points at the target's pixels in the
    image, as if nothing hid it. NaN where the box is NaN."""
    masks: tuple[Mask, ...]
    """(H, W) each: the target's visible pixels."""
    spans: dict[str, range]
    """The frames of events by name; in "returning" those of "leaving"."""
    intrinsics: Intrinsics
    rig: StereoRig | None
    """The stereo rig; None in scenes without a right image."""
    depth_faults: DepthFaults
    stereo_faults: StereoFaults
    lookalikes: tuple[Array, ...] = ()
    """Empty; as in a stress scene."""


def room_scene(
    kind: str = "table",
    seed: int = 0,
    size: tuple[int, int] = (320, 240),
    channels: str = "color",
    *,
    frames: int | None = None,
    noise: float = 2.0,
    depth_faults: DepthFaults | None = None,
    stereo_faults: StereoFaults | None = None,
) -> RoomScene:
    """A target in a room, recorded by cameras with the faults of real ones.

    kind: one of ROOM_KINDS;
        "table": it stands on a table among other things; the camera is moved by hand;
        "leaning": it leans on a wall; the camera is moved by hand;
        "pushed": a hand pushes it over a table;
        "held": a hand holds it and moves it above a table;
        "passing": another thing, as far away, is pushed past its front;
        "returning": a hand carries it out of the image and puts it down elsewhere;
        "walker": a person walks on the floor among others.
    size: width and height, pixels, at least 80. channels: one of ROOM_CHANNELS, as in a stress scene.
    frames: only the first so many, if the scene has more.
    noise: standard deviation in levels of 255, independent in both images.
    depth_faults, stereo_faults: the sensors' faults; by default drawn from the seed.

    There are 15 or 30 frames per second; with a walker 4 or 15. There are no cast shadows and no motion blur.
    ValueError or TypeError names the argument that is wrong.
    """
    _check(kind, seed, size, channels, noise)
    stage = _find_stage(kind, seed, Intrinsics.from_fov(*size, FIELD_OF_VIEW))
    count = len(stage.plan) if frames is None else positive_whole(frames, "frames", "frames")
    truths = [stage.truth_at(index) for index in range(min(count, len(stage.plan)))]
    rng = np.random.default_rng([seed, 3, ROOM_KINDS.index(kind)])
    depth_faults = depth_faults or DepthFaults.sample(size[0], rng)
    stereo_faults = stereo_faults or StereoFaults.sample(rng)
    recorder = _Recorder(stage, truths, channels, noise, seed, depth_faults, stereo_faults)
    return RoomScene(
        name=f"room, {kind}, {size[0]}x{size[1]}, seed {seed}",
        kind=kind,
        seed=seed,
        frames=tuple(recorder.record()),
        rate=stage.plan.rate,
        boxes=np.stack([truth.box for truth in truths]),
        visible=np.array([truth.visible for truth in truths]),
        positions=np.stack([truth.position for truth in truths]),
        masks=tuple(truth.view.target for truth in truths),
        spans=stage.plan.spans,
        intrinsics=stage.rig.intrinsics,
        rig=stage.rig if channels == "stereo" else None,
        depth_faults=depth_faults,
        stereo_faults=stereo_faults,
    )


def _find_stage(kind: str, seed: int, camera: Intrinsics) -> RoomStage:
    """The first random plan whose first frame shows the target."""
    for attempt in range(MAX_TRIES):
        plan = plan_room(kind, camera, np.random.default_rng([seed, 0, ROOM_KINDS.index(kind), attempt]))
        stage = RoomStage(plan, StereoRig(camera, ROOM_BASELINE), ROOM_RAYS)
        if stage.truth_at(0).visible >= MIN_FIRST_VISIBLE:
            break
    return stage


@dataclass
class _Recorder:
    """The cameras of a scene; each has its own noise, so that an image doesn't depend on the channels."""

    stage: RoomStage
    truths: Sequence[RoomTruth]
    channels: str
    noise: float
    seed: int
    depth_faults: DepthFaults
    stereo_faults: StereoFaults

    def record(self) -> Iterator[Frame]:
        """The frames."""
        noises = [np.random.default_rng([self.seed, 2, camera]) for camera in range(3)]
        colors = [self._expose(index, noises[0]) for index in range(len(self.truths))]
        depths = self._measure(colors, noises[2]) if self.channels in ("rgbd", "depth") else None
        for index, color in enumerate(colors):
            images: dict[str, NDArray[Any]] = {} if self.channels == "depth" else {"color": color}
            if self.channels == "stereo":
                images["right"] = self._expose(index, noises[1], right=True)
            if depths is not None:
                images["depth"] = depths[index]
            yield Frame(
                images.get("color"),
                images.get("depth"),
                images.get("right"),
                timestamp=index / self.stage.plan.rate,
            )

    def _expose(self, index: int, rng: np.random.Generator, right: bool = False) -> NDArray[np.uint8]:
        picture = self.stage.picture(index, right)
        if right:
            picture = self.stereo_faults.apply(picture)
        return expose_lit(picture, np.ones(3), self.noise, rng if self.noise else None)

    def _measure(
        self, colors: Sequence[NDArray[np.uint8]], rng: np.random.Generator
    ) -> list[NDArray[np.float32]]:
        """The depth images, each of the frame that the delay selects."""
        camera = FaultyDepthCamera(self.stage.rig.intrinsics, self.depth_faults, rng)
        found = []
        for index in range(len(colors)):
            source = int(np.clip(index - self.depth_faults.delay, 0, len(colors) - 1))
            view = self.truths[source].view
            gray = imgproc.bgr_to_gray(colors[source])
            measured = camera.measure(view.depth, gray, view.shiny)
            millimeters = np.rint(measured * 1000) * np.float32(METERS_PER_MILLIMETER)
            found.append(np.asarray(millimeters, np.float32))
        return found


def _check(kind: str, seed: int, size: tuple[int, int], channels: str, noise: float) -> None:
    for value, name, known in ((kind, "kind", ROOM_KINDS), (channels, "channels", ROOM_CHANNELS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    check_seed(seed)
    expected = f"width and height of {MIN_ROOM_SIDE} pixels or more"
    check_pair(size, "size", expected)
    if min(positive_whole(side, "size", "pixels") for side in size) < MIN_ROOM_SIDE:
        raise ValueError(f"size: expected {expected}, got {size!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
