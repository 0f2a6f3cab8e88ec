# SPDX-License-Identifier: MIT
"""Scenes in which a target meets one trouble after the other: light, look-alikes, occlusion, leaving, scale.

Everything lives at metres before one pinhole camera: color, depth, the right image and the truth are drawn
from the same cards and agree.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.rendering.depth_sensor import DEPTH_SENSORS, DepthSensor
from tricue.scenes.rendering.stereo_camera import BLUR_DEVIATION, expose_lit
from tricue.scenes.stress.cards import CardCamera, CardImage
from tricue.scenes.stress.events import STRESS_FRAME_RATE
from tricue.scenes.stress.plan import FRAME_COUNTS
from tricue.scenes.stress.stage import StressStage

STRESS_KINDS = tuple(FRAME_COUNTS)
STRESS_CHANNELS = ("color", "rgbd", "stereo", "depth")
MIN_IMAGE_SIDE = 80  # pixels along each side of an image
EXPOSURE_SAMPLES = 5  # that make a blurred one
METRES_PER_MILLIMETRE = np.float32(0.001)


@dataclass(frozen=True, slots=True, eq=False)
class StressScene:
    """A target among troubles, made by this package; the same arguments give the same bits.

    The truth is that of the geometry in the middle of each exposure, in the color or left camera's image.
    """

    name: str
    kind: str
    seed: int
    frames: tuple[Frame, ...]
    """N, each with the channels that were asked for and ``timestamp``, seconds from 0. Depth is in whole
    millimetres, as cameras give it, and NaN in black frames."""
    boxes: Array
    """(N, 4) x, y, width, height round the whole target whatever hides it, pixels; it may reach over the
    image's edge. NaN where the target is wholly outside the picture, or in another scene."""
    visible: Array
    """(N,) share of the target's pixels that are seen, those beyond the image's edge counted as unseen; 0 too
    in black frames and in the other scene."""
    positions: Array
    """(N, 3) metres in the camera's frame, of the target's middle; NaN where the box is."""
    lookalikes: tuple[Array, ...]
    """(N, 4) boxes of the one with the target's colors, and of the one with its structure; NaN outside."""
    masks: tuple[Mask, ...]
    """(H, W) each: the target's visible pixels."""
    light: Array
    """(N, 3) gain of each channel, BGR; 1 is the light in which the textures have their levels."""
    spans: dict[str, range]
    """The frames in which each event happens, what leads to it and from it included."""
    intrinsics: Intrinsics
    rig: StereoRig | None
    """The pair, with a right image alone."""


def stress_scene(
    kind: str = "all",
    seed: int = 0,
    size: tuple[int, int] = (320, 240),
    channels: str = "color",
    *,
    noise: float = 2.0,
    shutter: float = 0.0,
) -> StressScene:
    """A textured card on a smooth path through a room, 30 frames a second, and what happens to it.

    kind: one of KINDS;
        "plain": nothing else happens;
        "fast": it moves by up to half of its width a frame;
        "light": brightness between 0.4 and 1.3 jumps and drifts, and the light's color changes;
        "camera": the camera pans by 8 to 14 degrees and back, and shakes;
        "scale": it comes or goes so that its size changes 1:4 within 120 frames, and back;
        "leaving": it is out of the picture for 30 frames and comes back over another edge;
        "hidden": something nearer hides it wholly for 20 frames;
        "lookalike": one of its colors with another structure and one of its structure in other colors cross
            its way and stay nearby;
        "blank": 8 black frames, then 24 of another scene, or the other way round;
        "all": all of these but "fast" in 300 frames, in an order drawn from the seed, the size changing
            smoothly all the time.
    channels: "color"; "rgbd", color and registered depth; "stereo", a pair; "depth" alone. Of one kind, seed
        and size all have the same truth, and the same color images.
    noise: standard deviation in levels of 255, independent in both images. shutter: share of a frame's time
        in which the picture is exposed; above 0 what moves is blurred.

    The seed decides the looks, the room, the path and the times. No shadows are cast.
    """
    _check(kind, seed, size, channels, noise, shutter)
    stage = StressStage.build(kind, seed, size)
    truths = [stage.truth_at(index) for index in range(len(stage.moves))]
    cameras = _StressCameras(channels, noise, shutter, seed)
    return StressScene(
        name=f"everything, {kind}, {size[0]}x{size[1]}, seed {seed}",
        kind=kind,
        seed=seed,
        frames=tuple(cameras.record(stage, [truth_at.canvas for truth_at in truths])),
        boxes=np.stack([truth_at.boxes[0] for truth_at in truths]),
        visible=np.array([truth_at.visible for truth_at in truths]),
        positions=np.stack([truth_at.position for truth_at in truths]),
        lookalikes=tuple(np.stack([truth_at.boxes[which] for truth_at in truths]) for which in (1, 2)),
        masks=tuple(truth_at.mask for truth_at in truths),
        light=stage.moves.light,
        spans=stage.moves.spans,
        intrinsics=stage.moves.camera,
        rig=stage.rig if channels == "stereo" else None,
    )


class _StressCameras(NamedTuple):
    """What the cameras make of a stage. Each has a noise of its own, so that one doesn't change another's."""

    channels: str
    noise: float
    shutter: float
    seed: int

    def record(self, stage: StressStage, canvases: Sequence[CardImage]) -> Iterator[Frame]:
        """The frames, from the left camera's canvases."""
        noises = [np.random.default_rng([self.seed, 2, camera]) for camera in range(3)]
        sensor = replace(DEPTH_SENSORS["rgbd"], intrinsics=stage.moves.camera)
        eyes = CardCamera(stage.moves.camera), CardCamera(stage.moves.camera, stage.rig.baseline)
        for index, canvas in enumerate(canvases):
            images: dict[str, NDArray[Any]] = {}
            if self.channels != "depth":
                images["color"] = self._expose(stage, eyes[0], index, noises[0], canvas)
            if self.channels == "stereo":
                images["right"] = self._expose(stage, eyes[1], index, noises[1])
            if self.channels in ("rgbd", "depth"):
                images["depth"] = _measure(sensor, canvas.depth, stage.moves.black[index], noises[2])
            yield Frame(
                images.get("color"),
                images.get("depth"),
                images.get("right"),
                timestamp=index / STRESS_FRAME_RATE,
            )

    def _expose(
        self,
        stage: StressStage,
        eye: CardCamera,
        index: int,
        rng: np.random.Generator,
        sharp: CardImage | None = None,
    ) -> NDArray[np.uint8]:
        """A color image; ``sharp`` is the canvas of the exposure's middle, where there is one."""
        moves = stage.moves
        if moves.black[index]:
            color = np.zeros((eye.camera.height, eye.camera.width, 3), np.float32)
        elif self.shutter > 0:
            shares = (np.arange(EXPOSURE_SAMPLES) + 0.5) / EXPOSURE_SAMPLES - 0.5
            color = np.mean([stage.draw(eye, index, index + self.shutter * s).color for s in shares], axis=0)
        else:
            color = (sharp or stage.draw(eye, index, index)).color
        blurred = np.asarray(cv2.GaussianBlur(color, (0, 0), BLUR_DEVIATION), np.float32)
        return expose_lit(blurred, moves.light[index], self.noise, rng)


def _measure(
    sensor: DepthSensor, depth: Picture, black: np.bool_, rng: np.random.Generator
) -> NDArray[np.float32]:
    """What a depth camera writes: whole millimetres; nothing while its picture is black."""
    if black:
        return np.full(depth.shape, np.nan, np.float32)
    measured = sensor.measure(depth.astype(np.float64), rng)
    return np.asarray(np.rint(measured * 1000) * METRES_PER_MILLIMETRE, np.float32)


def _check(kind: str, seed: int, size: tuple[int, int], channels: str, noise: float, shutter: float) -> None:
    for value, name, known in ((kind, "kind", STRESS_KINDS), (channels, "channels", STRESS_CHANNELS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    if not isinstance(seed, (int, np.integer)) or seed < 0:
        raise ValueError(f"seed: expected a whole number from 0, got {seed!r}")
    if len(size) != 2 or min(positive_whole(side, "size", "pixels") for side in size) < MIN_IMAGE_SIDE:
        raise ValueError(f"size: expected width and height of {MIN_IMAGE_SIDE} pixels or more, got {size!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    if not 0 <= finite(shutter, "shutter", "a share") <= 1:
        raise ValueError(f"shutter: expected a share from 0 to 1, got {shutter!r}")
