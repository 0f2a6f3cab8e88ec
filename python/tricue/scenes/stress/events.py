# SPDX-License-Identifier: MIT
"""The events of a stress scene, and the paths of all cards, frame by frame.

Paths are in pixels in the image and in meters along z, since trackers follow motion in the image. The
camera's pan moves only the room; its shake moves all cards.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.motion import sample_gain_steps, sample_path, sample_sway
from tricue.scenes.stress.cards import Card, CardCamera, CardPose, face_camera

STRESS_FRAME_RATE = 30.0  # frames per second
MAX_ROLL, MAX_YAW = np.radians(10), np.radians(12)
MIN_GAIN, MAX_GAIN = 0.4, 1.3  # of the light
BLACK_FRAMES, OTHER_ROOM_FRAMES = 8, 24
EVENT_LEAD_FRAMES = 20  # from an event's start until the target may be gone
MIN_OCCLUDER_DEPTH = 0.55  # meters; the depth camera's range begins at 0.5


@dataclass
class CardPath:
    """The path of a card over N frames. Events change it before anything is drawn."""

    card: Card
    pixels: Array  # (N, 2) of the center in the image, OpenCV's coordinates
    depth: Array  # (N,) meters
    roll: Array  # (N,) radians
    yaw: Array  # (N,) radians about the vertical
    present: NDArray[np.bool_]  # (N,) whether the card is in the scene

    def pose(self, camera: Intrinsics, time: float) -> CardPose:
        """The card's pose at a time in frames, interpolated between frames."""
        u, v, z, roll, yaw = (
            float(np.interp(time, np.arange(len(self.depth)), values))
            for values in (*self.pixels.T, self.depth, self.roll, self.yaw)
        )
        return face_camera(camera.back_project(u, v, z), roll, yaw)

    def half_size(self, camera: Intrinsics, index: int) -> Array:
        """Half the card's width and height (2,) in the image, pixels, approximately."""
        middle = np.array([0, 0, self.depth[index]])
        outline = CardCamera(camera).outline(
            self.card, face_camera(middle, self.roll[index], self.yaw[index])
        )
        return np.asarray(np.ptp(outline, axis=0) / 2)


@dataclass
class StressMotion:
    """All motion and events in N frames."""

    camera: Intrinsics
    target: CardPath
    lookalikes: tuple[CardPath, CardPath]
    occluder: CardPath
    angles: Array  # (N, 2) the camera's yaw to the right and pitch down, radians
    light: Array  # (N, 3) gain of each channel
    black: NDArray[np.bool_]  # (N,) frames without light
    in_other_room: NDArray[np.bool_]  # (N,) frames in another room
    away: Mapping[str, int]  # number of frames out of the image, "leaving", and behind the occluder, "hidden"
    spans: dict[str, range] = field(default_factory=dict)  # the frames of each event

    def __len__(self) -> int:
        return len(self.light)

    def rotation(self, time: float) -> Array:
        """The rotation (3, 3) of the room from the frame of a camera that looks straight ahead."""
        yaw, pitch = (float(np.interp(time, np.arange(len(self)), angle)) for angle in self.angles.T)
        cos, sin = np.cos(yaw), np.sin(yaw)
        about_y = np.array([[cos, 0, -sin], [0, 1, 0], [sin, 0, cos]])
        cos, sin = np.cos(pitch), np.sin(pitch)
        return np.asarray(np.array([[1, 0, 0], [0, cos, -sin], [0, sin, cos]]) @ about_y)


def sample_card_path(
    camera: Intrinsics, card: Card, depth: Array, speed: float, rng: np.random.Generator
) -> CardPath:
    """A smooth random path within the image. speed: the maximum, in widths of the card per frame."""
    frames, time = len(depth), np.arange(len(depth)) / STRESS_FRAME_RATE
    width = card.size[0] * camera.fx / float(np.median(depth))
    largest = float(np.hypot(*card.size) * camera.fx / depth.min() / 2)
    half = np.array([camera.width, camera.height]) / 2
    reach = np.maximum(half - np.minimum(largest + 4, half * 0.8), 0.12 * half)
    offsets = sample_path(frames, (reach[0], reach[1]), speed * width, rng)
    roll, yaw = (limit * sample_sway(time, 2.0, 5.0, rng) for limit in (MAX_ROLL, MAX_YAW))
    pixels = offsets + [camera.cx, camera.cy]
    return CardPath(card, pixels, depth, roll, yaw, np.ones(frames, bool))


def leave_image(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """The target leaves over one edge of the image, and returns over another."""
    path, camera = motion.target, motion.camera
    width = 2 * path.half_size(camera, span.start)[0]
    pace = max(0.2 * width, 0.035 * camera.width)
    out = span.start + EVENT_LEAD_FRAMES
    last = out + motion.away["leaving"] - 1
    gone = path.pixels[span.start]
    edges = np.array([[-1, 0], [1, 0], [0, -1]])
    leaves, returns = rng.permutation(3)[:2]
    for frame, edge, step in ((out, edges[leaves], -1), (last, edges[returns], 1)):
        _cross_edge(motion, frame, edge, step, pace)
    between = np.arange(out + 1, last)
    corner = np.array([-2.0 * camera.width, gone[1]])
    path.pixels[between] = corner


def _cross_edge(motion: StressMotion, frame: int, edge: Array, step: int, pace: float) -> None:
    """Connect the path inside with ``frame``, the first or the last frame wholly outside of the image.

    edge: its outward normal. step: 1 connects the frames after ``frame``, -1 those before. pace: the largest
    speed, pixels per frame; the edge is crossed halfway between two frames.
    """
    path, camera = motion.target, motion.camera
    axis = int(edge[0] == 0)
    size = np.array([camera.width, camera.height])[axis]
    border = (edge[axis] + 1) / 2 * size - 0.5
    for count in range(4, EVENT_LEAD_FRAMES + 1):
        inner = frame + count * step
        start = path.pixels[inner]
        half = path.half_size(camera, frame)[axis]
        stride = edge[axis] * (border + edge[axis] * half - start[axis]) / (count - 0.5)
        if stride < pace:
            break
    offsets = np.arange(count + 1) / count
    end = start.copy()
    end[axis] = border + edge[axis] * (half + stride / 2)
    frames = frame + step * np.arange(count + 1)
    path.pixels[frames] = end + offsets[:, None] * (start - end)


def hide_target(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """The occluder comes fast, hides the target while moving with it, and leaves."""
    path, camera, occluder = motion.target, motion.camera, motion.occluder
    first = span.start + EVENT_LEAD_FRAMES
    after = first + motion.away["hidden"]
    frames = np.arange(len(motion))
    halves = np.array([path.half_size(camera, index) for index in range(first - 1, after + 1)])
    half, tall = halves.max(axis=0)
    margin = 0.35 * half + 3
    depth = max(0.62 * path.depth[first:after].min(), MIN_OCCLUDER_DEPTH)
    occluder.depth[:] = depth
    scale = 2 * depth / camera.fx
    size = (half + margin) * scale * 1.02, (1.6 * tall + margin) * scale
    occluder.card = occluder.card._replace(size=size)
    # In the frames before and after, part of the target is visible beside the occluder.
    before, behind = (half + margin - 0.7 * halves[index, 0] + 2 for index in (0, -1))
    near, far, pace = 0.6 * margin, 2.5 * camera.width, 0.35 * half
    slow = int(np.ceil(far / pace))
    knots = [
        first - 1 - slow,
        first - 1,
        first,
        after - 1,
        after,
        after + slow,
    ]
    offset = np.interp(frames, knots, [-far, -before, -near, near, behind, far])
    occluder.pixels[:] = path.pixels
    occluder.pixels[:, 0] += (1 if rng.random() < 0.5 else -1) * offset
    occluder.present[:] = np.abs(offset) < far


def cross_lookalikes(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """Two look-alikes come, cross the target's path and stay nearby, one in front of it and one behind."""
    path, camera = motion.target, motion.camera
    width, height = 2 * path.half_size(camera, span.start)
    frames = np.arange(len(motion))
    nearer = rng.permutation([0.85, 1.2])
    outside = np.interp(frames, [span.start, span.start + 25, span.stop - 20, span.stop], [1, 0, 0, 1])
    for index, lookalike in enumerate(motion.lookalikes):
        side = 1 if index else -1
        angle = 2 * np.pi * (frames - span.start - 25) / rng.uniform(60, 90) + rng.uniform(-0.5, 0.5)
        across = (
            side
            * width
            * (1.35 * np.cos(angle) + 0.2 * sample_sway(frames / STRESS_FRAME_RATE, 1.0, 3.0, rng))
        )
        up = side * height * (0.45 + 0.15 * sample_sway(frames / STRESS_FRAME_RATE, 1.0, 3.0, rng))
        lookalike.pixels[:, 0] = path.pixels[:, 0] + across + side * outside * 1.5 * camera.width
        lookalike.pixels[:, 1] = path.pixels[:, 1] + up
        lookalike.depth[:] = path.depth * nearer[index]
        lookalike.present[:] = (frames >= span.start) & (frames < span.stop)


def change_light(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """The brightness jumps and drifts between MIN_GAIN and MAX_GAIN, with a new tint at each jump."""
    count = len(span)
    level = sample_gain_steps(count, MIN_GAIN / 0.9, MAX_GAIN / 1.1, rng)
    drift = 1 + 0.1 * sample_sway(np.arange(count) / STRESS_FRAME_RATE, 0.7, 2.0, rng)
    jumps = np.cumsum(np.diff(level, prepend=level[0]) != 0)
    tints = np.exp(rng.uniform(-0.15, 0.15, (jumps[-1] + 1, 3)))
    tints /= tints.mean(axis=1, keepdims=True)
    tints[0] = 1
    motion.light[span.start : span.stop] = (level * drift)[:, None] * tints[jumps]


def shake_camera(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """The camera pans to one side and back, and shakes; both move the room, the shake also the cards."""
    count, camera = len(span), motion.camera
    envelope = np.sin(np.pi * (np.arange(count) + 0.5) / count)
    pan = rng.choice([-1, 1]) * np.radians(rng.uniform(8, 14)) * envelope**2
    trembles = [sample_sway(np.arange(count) / STRESS_FRAME_RATE, 0.2, 0.5, rng) for _ in range(2)]
    yaw, pitch = (0.015 * np.sqrt(envelope) * tremble for tremble in trembles)  # 4 pixels at a width of 320
    inside = slice(span.start, span.stop)
    motion.angles[inside] += np.stack([pan + yaw, pitch], axis=1)
    for path in (motion.target, *motion.lookalikes, motion.occluder):
        path.pixels[inside] -= np.stack([yaw * camera.fx, pitch * camera.fy], axis=1)


def blank_frames(motion: StressMotion, span: range, rng: np.random.Generator) -> None:
    """BLACK_FRAMES and OTHER_ROOM_FRAMES without the target, in random order."""
    start = span.start + int(rng.integers(len(span) - BLACK_FRAMES - OTHER_ROOM_FRAMES + 1))
    first, second = (
        (motion.black, motion.in_other_room) if rng.random() < 0.5 else (motion.in_other_room, motion.black)
    )
    change = start + (BLACK_FRAMES if first is motion.black else OTHER_ROOM_FRAMES)
    first[start:change] = True
    second[change : start + BLACK_FRAMES + OTHER_ROOM_FRAMES] = True


EVENTS: dict[str, Callable[[StressMotion, range, np.random.Generator], None]] = {
    "camera": shake_camera,
    "light": change_light,
    "leaving": leave_image,
    "lookalike": cross_lookalikes,
    "hidden": hide_target,
    "blank": blank_frames,
}
"""By name, in the order in which they change the paths; tricue.scenes.stress.plan decides their times."""
