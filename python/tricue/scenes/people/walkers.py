# SPDX-License-Identifier: MIT
"""People in front of a depth camera, as in figures 5 to 7 of Sabeti, Parvizi and Wu (2008), section V."""

import math
from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.scenes.arrays import Array
from tricue.scenes.people import walks
from tricue.scenes.people.body import BodyPose, Person, place_body
from tricue.scenes.people.walks import WalkableArea
from tricue.scenes.rendering import zbuffer
from tricue.scenes.rendering.depth_room import Room
from tricue.scenes.rendering.depth_sensor import DEPTH_SENSORS, DepthSensor
from tricue.scenes.rendering.depth_view import DepthWindow, MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.scene import Bystander, DepthScene
from tricue.scenes.seeds import make_generator

MIN_WALKER_DISTANCE = {"tof": 2.4, "rgbd": 2.0}  # meters; from this distance on a body fits into the image
MAX_WALKER_DISTANCE = 6.2  # meters; within the range of both sensors
DEPTH_CHANGE_SPEED = 1.2  # meters per second, of a hidden target
MAX_DEPTH_CHANGE = 1.3  # meters
MAX_HIDDEN_SHARE = 0.6  # of the duration of a sweep
COVERING_DURATION = 0.4  # seconds until the target is covered, and uncovered again


def walker(
    seed: int = 0, frames: int = 90, camera: str = "tof", *, missing: float = 0.03, noise: float = 1.0
) -> DepthScene:
    """One person walks a loop through a room, and crouches, raises the arms and turns around on the way.

    camera: "tof", 176x144 pixels at 15 frames per second, or "rgbd", 640x480 at 30. missing: share of the
    pixels within range that have no depth, 0 to 1.
    noise: multiplies the sensor's noise; at 0 the time-of-flight depths are exact, the RGB-D ones quantized.

    The seed decides the person, the path, the gestures, the room, its furniture, the camera's height and
    pitch, and the noise. Nothing hides the person, who is always within the sensor's range and mostly in the
    image. ValueError or TypeError names the argument that is wrong.
    """
    _check(frames, camera, missing, noise)
    rng = make_generator(seed)
    stage = _sample_stage(camera, rng)
    person, rate = Person.sample(rng), stage.sensor.rate
    gestures = walks.sample_gestures(frames, rate, rng)
    path = walks.sample_loop(stage.floor, gestures.crouch, rate, rng)
    poses = walks.compute_poses(person, path, rate, gestures)
    actor = _Actor(person, path, walks.compute_headings(path, rate) + gestures.turn, poses)
    return _record(f"walker, {camera}, seed {seed}", stage, [actor], _SensorErrors(missing, noise), rng)


def crossing(
    seed: int = 0,
    frames: int = 90,
    camera: str = "tof",
    *,
    depth_change: float = 0.0,
    missing: float = 0.03,
    noise: float = 1.0,
) -> DepthScene:
    """A nearer person crosses in front of the target and hides it for some frames halfway.

    depth_change: meters, at most 1.3 either way, by which the target moves away (if negative, nearer) while
    it is hidden; it then stays hidden longer. With half of the seeds a third person passes behind. They turn
    around and cross again every six seconds; one crossing takes at least about two seconds (30 frames "tof",
    60 "rgbd"). The other arguments and errors are those of :func:`walker`.
    """
    _check(frames, camera, missing, noise)
    rng = make_generator(seed)
    stage = _sample_stage(camera, rng)
    rate = stage.sensor.rate
    time = walks.compute_sweep_times(frames, rate)
    _check_depth_change(depth_change, float(np.ptp(time)))
    target = Person.sample(rng)
    # A nearer person who is at least as tall hides the head too, because the camera is below it.
    people = [target, Person.sample(rng, shortest=target.height)]
    paths = [*_crossing_paths(stage, time, depth_change, rng)]
    if rng.random() < 0.5:
        people.append(Person.sample(rng))
        paths.append(_path_behind(stage, time, paths[0], rng))
    # The person in front faces the camera, to be broad enough to hide the target.
    looks = [None, np.abs(time) < _hidden_duration(depth_change, time) / 2, None]
    actors = [
        _Actor(
            person, path, walks.compute_headings(path, rate, look), walks.compute_poses(person, path, rate)
        )
        for person, path, look in zip(people, paths, looks, strict=False)
    ]
    return _record(f"crossing, {camera}, seed {seed}", stage, actors, _SensorErrors(missing, noise), rng)


class _DepthStage(NamedTuple):
    """The mounted camera, the room without furniture, and the area in which people walk."""

    sensor: DepthSensor
    view: MountedCamera
    room: Room
    floor: WalkableArea


class _Actor(NamedTuple):
    """A person's path and poses in a scene."""

    person: Person
    path: Array  # (M, 2) x and z, meters, level frame
    facing: Array  # (M,) radians
    poses: list[BodyPose]

    def body(self, index: int, view: MountedCamera) -> Ellipsoids:
        """The person's body in a frame, in the camera frame."""
        x, z = self.path[index].tolist()
        level = place_body(self.person, self.poses[index], x, z, float(self.facing[index]), view.height)
        return level.transformed(view.rotation, np.zeros(3))


class _SensorErrors(NamedTuple):
    """The arguments of :meth:`DepthSensor.measure`."""

    missing: float
    noise: float


class _PersonTruth(NamedTuple):
    """One person in one frame, rendered alone."""

    box: Box
    position: Array
    window: DepthWindow


def _sample_stage(camera: str, rng: np.random.Generator) -> _DepthStage:
    """A random room, and a camera that looks slightly down and sees a whole body at the smallest distance."""
    sensor, near = DEPTH_SENSORS[camera], MIN_WALKER_DISTANCE[camera]
    height, wall, side = rng.uniform([1.0, 6.8, 3.1], [1.6, 10.0, 4.2]).tolist()
    # The mean of the angles to the floor and to a head at 1.75 m.
    pitch = (math.atan2(height, near) + math.atan2(height - 1.75, near)) / 2 + math.radians(
        rng.uniform(-1, 1)
    )
    slope = sensor.intrinsics.width / 2 / sensor.intrinsics.fx
    floor = WalkableArea(
        near, min(MAX_WALKER_DISTANCE, wall - 1.0), slope, side + walks.BODY_CLEARANCE - walks.ARM_CLEARANCE
    )
    return _DepthStage(sensor, MountedCamera(sensor.intrinsics, height, pitch), Room(wall, side, 2.6), floor)


def _crossing_paths(
    stage: _DepthStage, time: Array, depth_change: float, rng: np.random.Generator
) -> tuple[Array, Array]:
    """The paths (M, 2) of the target, and of the person who crosses its line of sight at time 0."""
    near, half = stage.floor.near, float(time.max())
    changing = abs(depth_change) / DEPTH_CHANGE_SPEED
    sense = rng.choice([-1, 1])
    start = near + rng.uniform(1.4 + max(-depth_change, 0), 2.7 - max(depth_change, 0))
    share = np.clip(time / changing + 0.5, 0, 1) if changing else np.zeros(len(time))
    z = start + depth_change * share + rng.uniform(-0.15, 0.15) * time
    aside, speed = rng.uniform([-0.15, 0.3], [0.15, 0.6])
    room_to_side = float(stage.floor.reach(z).min()) - abs(aside)
    x = aside + sense * min(speed, room_to_side / max(half, 1.0)) * time
    slowed = walks.slow_down_time(time, _hidden_duration(depth_change, time), 0.1)
    crossing_z = near + rng.uniform(0.0, 0.4)
    nearer = crossing_z + rng.choice([-1, 1]) * rng.uniform(0.2, 0.3) * slowed
    angular = rng.uniform(0.7, 1.1) / crossing_z  # speed relative to the line of sight to the target
    return np.stack([x, z], axis=1), np.stack([nearer * (x / z - sense * angular * slowed), nearer], axis=1)


def _hidden_duration(depth_change: float, time: Array) -> float:
    """Seconds for which the target is hidden."""
    return min(
        abs(depth_change) / DEPTH_CHANGE_SPEED + COVERING_DURATION, MAX_HIDDEN_SHARE * float(np.ptp(time))
    )


def _path_behind(stage: _DepthStage, time: Array, target: Array, rng: np.random.Generator) -> Array:
    """A path (M, 2) from side to side, behind the target's."""
    beside = stage.room.side - walks.BODY_CLEARANCE
    x = rng.uniform(-0.5, 0.5)
    speed = min(rng.uniform(0.5, 0.9), (beside - abs(x)) / max(float(time.max()), 1.0))
    deepest = min(float(target[:, 1].max()) + rng.uniform(0.6, 1.2), stage.room.wall - walks.BODY_CLEARANCE)
    return np.stack([x + rng.choice([-1, 1]) * speed * time, np.full(len(time), deepest)], axis=1)


def _record(
    name: str, stage: _DepthStage, actors: list[_Actor], flaws: _SensorErrors, rng: np.random.Generator
) -> DepthScene:
    """Render the frames and record the truth; the first actor is the target."""
    view, room = stage.view, stage.room
    ways = np.concatenate([actor.path for actor in actors])
    room = room._replace(furniture=walks.place_furniture(8, room.wall, room.side, ways, rng))
    background = view.render_room(room)
    frames, sights, seen = [], [], []
    for index in range(len(actors[0].path)):
        sights.append([_render_person(view, actor.body(index, view)) for actor in actors])
        depth = background.copy()
        for sight in sights[-1]:
            zbuffer.merge_window(sight.window, depth)
        mask, share = zbuffer.find_visible_pixels(sights[-1][0].window, depth)
        seen.append((zbuffer.box_of_mask(mask), share))
        measured = stage.sensor.measure(depth, rng, missing=flaws.missing, noise=flaws.noise)
        frames.append(Frame(depth=measured, timestamp=index / stage.sensor.rate))
    return DepthScene(
        name=name,
        frames=tuple(frames),
        boxes=tuple(target.box for target, *_ in sights),
        visible_boxes=tuple(box for box, _ in seen),
        positions=np.stack([target.position for target, *_ in sights]),
        visible=np.array([share for _, share in seen]),
        intrinsics=view.intrinsics,
        others=tuple(tuple(Bystander(other.box, other.position) for other in rest) for _, *rest in sights),
    )


def _render_person(view: MountedCamera, bodies: Ellipsoids) -> _PersonTruth:
    window = view.render(bodies)
    return _PersonTruth(view.bounding_box(bodies), view.surface_points(window).mean(axis=0), window)


def _check(frames: int, camera: str, missing: float, noise: float) -> None:
    positive_whole(frames, "frames", "a count")
    if camera not in DEPTH_SENSORS:
        raise ValueError(f"camera: expected one of {', '.join(DEPTH_SENSORS)}, got {camera!r}")
    if not 0 <= finite(missing, "missing", "a share of the pixels") <= 1:
        raise ValueError(f"missing: expected a share of the pixels from 0 to 1, got {missing!r}")
    if finite(noise, "noise", "a factor") < 0:
        raise ValueError(f"noise: expected a factor of 0 or more, got {noise!r}")


def _check_depth_change(meters: float, span: float) -> None:
    """Raise ValueError if the target can't walk that far while hidden, in a sweep of ``span`` seconds."""
    most = min(MAX_DEPTH_CHANGE, max(MAX_HIDDEN_SHARE * span - COVERING_DURATION, 0.0) * DEPTH_CHANGE_SPEED)
    if abs(finite(meters, "depth_change", "meters")) > most:
        raise ValueError(f"depth_change: expected at most {most:.2f} m in {span:.1f} s, got {meters!r}")
