# SPDX-License-Identifier: MIT
"""Stress scenes: a target under changes of light and scale, look-alikes, occlusion, leaving and cuts.

Color, depth, the right image and the truth are rendered from the same cards, so that they agree.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.depth_images import METERS_PER_MILLIMETER
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.pairs import check_pair
from tricue.scenes.rendering.depth_sensor import DEPTH_SENSORS, DepthSensor
from tricue.scenes.rendering.stereo_camera import BLUR_DEVIATION, expose_lit
from tricue.scenes.seeds import check_seed
from tricue.scenes.stress.cards import CardCamera, CardImage
from tricue.scenes.stress.events import STRESS_FRAME_RATE
from tricue.scenes.stress.plan import AWAY_FRAMES, FRAME_COUNTS
from tricue.scenes.stress.stage import StressStage

STRESS_KINDS = tuple(FRAME_COUNTS)
STRESS_CHANNELS = ("color", "rgbd", "stereo", "depth")
MIN_IMAGE_SIDE = 80  # pixels along each side of an image
MIN_AWAY_FRAMES = 2  # the first one without the target, and the last one
EXPOSURE_SAMPLES = 5  # whose mean makes a motion-blurred image


@dataclass(frozen=True, slots=True, eq=False)
class StressScene:
    """A rendered stress scene and its exact truth; the same arguments give the same bits.

    The truth is that of the geometry in the middle of each exposure, in the color (or left) camera's image.
    """

    name: str
    kind: str
    seed: int
    frames: tuple[Frame, ...]
    """N frames with the requested channels and ``timestamp``, seconds from 0. Depth is rounded to
    millimeters, as cameras give it, and NaN in black frames."""
    boxes: Array
    """(N, 4) x, y, width, height around the whole target, pixels, hidden parts included; it may reach beyond
    the image. NaN where the target is wholly outside of the image, and in the other room."""
    visible: Array
    """(N,) share of the target's pixels that are visible; those beyond the image count as hidden. 0 also in
    black frames and in the other room."""
    positions: Array
    """(N, 3) the target's center, meters in the camera's frame; NaN where the box is NaN."""
    lookalikes: tuple[Array, ...]
    """(N, 4) boxes of the two look-alikes: same colors, and same structure; NaN outside of the image."""
    masks: tuple[Mask, ...]
    """(H, W) each: the target's visible pixels."""
    light: Array
    """(N, 3) gain of each channel, BGR; 1 leaves the textures' levels unchanged."""
    spans: dict[str, range]
    """The frames of each event, by name, including the lead-in and the lead-out."""
    intrinsics: Intrinsics
    rig: StereoRig | None
    """The stereo rig; None in scenes without a right image."""


def stress_scene(
    kind: str = "all",
    seed: int = 0,
    size: tuple[int, int] = (320, 240),
    channels: str = "color",
    *,
    noise: float = 2.0,
    shutter: float = 0.0,
    away: int | None = None,
) -> StressScene:
    """A textured card that moves on a smooth path through a room, 30 frames per second, under one difficulty.

    kind: one of STRESS_KINDS;
        "plain": no difficulty;
        "fast": the target moves by up to half of its width per frame;
        "light": the brightness jumps and drifts between 0.4 and 1.3, and the light's color changes;
        "camera": the camera pans by 8 to 14 degrees and back, and shakes;
        "scale": the target's depth changes so that its size changes 1:4 within 120 frames, and back;
        "leaving": the target is outside of the image for 30 frames and returns over another edge;
        "hidden": an occluder hides the target completely for 20 frames;
        "lookalike": a card with the target's colors in another structure, and one with its structure in other
            colors, cross its path and stay nearby;
        "blank": 8 black frames, then 24 in another room, or in reverse order;
        "all": all of these but "fast" in 300 frames, in an order drawn from the seed; the size changes
            smoothly all the time.
    size: width and height, pixels, at least 80.
    channels: "color"; "rgbd", color and registered depth; "stereo", a stereo pair; or "depth". For one kind,
        seed and size, all have the same truth and the same color images.
    noise: standard deviation in levels of 255, independent in both images. shutter: exposure time as a share
        of a frame's time; above 0 there is motion blur.
    away: for the kinds "leaving" and "hidden", the number of frames, at least 2, instead of 30 and 20; the
        scene's length changes by the difference.

    The seed decides the appearance, the room, the path and the times. No shadows are cast. ValueError or
    TypeError names the argument that is wrong.
    """
    _check(kind, seed, size, channels, noise, shutter)
    _check_away(kind, away)
    stage = StressStage.build(kind, seed, size, away)
    truths = [stage.truth_at(index) for index in range(len(stage.motion))]
    cameras = _StressCameras(channels, noise, shutter, seed)
    return StressScene(
        name=f"stress scene, {kind}, {size[0]}x{size[1]}, seed {seed}",
        kind=kind,
        seed=seed,
        frames=tuple(cameras.record(stage, [truth.canvas for truth in truths])),
        boxes=np.stack([truth.boxes[0] for truth in truths]),
        visible=np.array([truth.visible for truth in truths]),
        positions=np.stack([truth.position for truth in truths]),
        lookalikes=tuple(np.stack([truth.boxes[which] for truth in truths]) for which in (1, 2)),
        masks=tuple(truth.mask for truth in truths),
        light=stage.motion.light,
        spans=stage.motion.spans,
        intrinsics=stage.motion.camera,
        rig=stage.rig if channels == "stereo" else None,
    )


class _StressCameras(NamedTuple):
    """The cameras of a scene; each has its own noise, so that an image doesn't depend on the channels."""

    channels: str
    noise: float
    shutter: float
    seed: int

    def record(self, stage: StressStage, canvases: Sequence[CardImage]) -> Iterator[Frame]:
        """The frames. canvases: the left camera's, one per frame."""
        noises = [np.random.default_rng([self.seed, 2, camera]) for camera in range(3)]
        sensor = replace(DEPTH_SENSORS["rgbd"], intrinsics=stage.motion.camera)
        cameras = CardCamera(stage.motion.camera), CardCamera(stage.motion.camera, stage.rig.baseline)
        for index, canvas in enumerate(canvases):
            images: dict[str, NDArray[Any]] = {}
            if self.channels != "depth":
                images["color"] = self._expose(stage, cameras[0], index, noises[0], canvas)
            if self.channels == "stereo":
                images["right"] = self._expose(stage, cameras[1], index, noises[1])
            if self.channels in ("rgbd", "depth"):
                images["depth"] = _measure(sensor, canvas.depth, stage.motion.black[index], noises[2])
            yield Frame(
                images.get("color"),
                images.get("depth"),
                images.get("right"),
                timestamp=index / STRESS_FRAME_RATE,
            )

    def _expose(
        self,
        stage: StressStage,
        camera: CardCamera,
        index: int,
        rng: np.random.Generator,
        sharp: CardImage | None = None,
    ) -> NDArray[np.uint8]:
        """A color image. sharp: the canvas in the middle of the exposure, if already rendered."""
        motion = stage.motion
        if motion.black[index]:
            color = np.zeros((camera.intrinsics.height, camera.intrinsics.width, 3), np.float32)
        elif self.shutter > 0:
            shares = (np.arange(EXPOSURE_SAMPLES) + 0.5) / EXPOSURE_SAMPLES - 0.5
            times = index + self.shutter * shares
            color = np.mean([stage.draw(camera, index, time).color for time in times], axis=0)
        else:
            color = (sharp or stage.draw(camera, index, index)).color
        blurred = imgproc.gaussian_blur(np.asarray(color, np.float32), BLUR_DEVIATION)
        return expose_lit(blurred, motion.light[index], self.noise, rng if self.noise else None)


def _measure(
    sensor: DepthSensor, depth: Picture, black: np.bool_, rng: np.random.Generator
) -> NDArray[np.float32]:
    """A depth image, rounded to millimeters; NaN in black frames."""
    if black:
        return np.full(depth.shape, np.nan, np.float32)
    measured = sensor.measure(depth.astype(np.float64), rng)
    return np.asarray(np.rint(measured * 1000) * np.float32(METERS_PER_MILLIMETER), np.float32)


def _check(kind: str, seed: int, size: tuple[int, int], channels: str, noise: float, shutter: float) -> None:
    for value, name, known in ((kind, "kind", STRESS_KINDS), (channels, "channels", STRESS_CHANNELS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    check_seed(seed)
    expected = f"width and height of {MIN_IMAGE_SIDE} pixels or more"
    check_pair(size, "size", expected)
    if min(positive_whole(side, "size", "pixels") for side in size) < MIN_IMAGE_SIDE:
        raise ValueError(f"size: expected {expected}, got {size!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    if not 0 <= finite(shutter, "shutter", "a share") <= 1:
        raise ValueError(f"shutter: expected a share from 0 to 1, got {shutter!r}")


def _check_away(kind: str, away: int | None) -> None:
    if away is None:
        return
    if kind not in AWAY_FRAMES:
        raise ValueError(f"away: expected none for the kind {kind}, got {away!r}")
    if positive_whole(away, "away", "frames") < MIN_AWAY_FRAMES:
        raise ValueError(f"away: expected {MIN_AWAY_FRAMES} frames or more, got {away!r}")
