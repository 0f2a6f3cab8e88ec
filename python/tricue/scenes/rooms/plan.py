# SPDX-License-Identifier: MIT
"""What happens in a room: the target's pose in each frame, the hand that moves it, and what passes."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array
from tricue.scenes.motion import sample_path, sample_sway
from tricue.scenes.people import walks
from tricue.scenes.people.body import Person
from tricue.scenes.people.pedestrian import Outfit, Pedestrian
from tricue.scenes.rendering.stereo_camera import WhiteLamp
from tricue.scenes.rooms import cameras
from tricue.scenes.rooms.cameras import Viewpoint
from tricue.scenes.rooms.furniture import TABLE_HEIGHT, make_shell, make_table, scatter_things
from tricue.scenes.rooms.solids import Placement, Solid
from tricue.scenes.rooms.things import TARGET_SHAPES, Thing, make_hand, make_thing

DURATIONS = {4.0: 10.0, 15.0: 5.0, 30.0: 3.0}  # seconds, by frames per second
MIN_SHARE, MAX_SHARE = 0.12, 0.36  # of the image's height that a target on a table covers
MIN_DISTANCE, MAX_DISTANCE = 0.5, 2.0  # meters to a target on a table
CLUTTER = 5, 12  # least and most things on a table
MIN_SLEEVE = 0.5  # meters
ROOM_SIDE = 2.6  # meters to each side that people walk
GRIP_SHARE = 0.5  # of a thing's height, at which a hand holds it


@dataclass
class RoomPlan:
    """What is in a room in each of N frames, in the world's frame."""

    rate: float
    lamp: WhiteLamp
    cameras: list[Placement]
    still: list[Thing]
    target: list[Solid]
    shiny: bool  # whether the target is shiny
    movers: list[list[Solid]] = field(default_factory=list)
    """The other moving things, each in every frame."""
    spans: dict[str, range] = field(default_factory=dict)
    """The frames of events, by name, as in a stress scene."""

    def __len__(self) -> int:
        return len(self.cameras)


@dataclass
class _Table:
    """A laid table: the target's place on it, the view of it, and everything that stands still."""

    rng: np.random.Generator
    rate: float
    lamp: WhiteLamp
    thing: Thing
    place: Array  # (3,) of the target's base
    view: Viewpoint
    still: list[Thing]
    half_view: float  # meters, half the visible width at the target's distance

    @property
    def frames(self) -> int:
        return round(self.rate * DURATIONS[self.rate])

    @property
    def time(self) -> Array:
        return np.arange(self.frames) / self.rate

    def plan(self, camera: list[Placement], target: list[Solid]) -> RoomPlan:
        return RoomPlan(self.rate, self.lamp, camera, self.still, target, self.thing.shiny)

    def path(self, reach: tuple[float, float], speed: float) -> Array:
        """A path (N, 3) about the target's place on the table. speed: meters per second."""
        offsets = sample_path(self.frames, reach, speed / self.rate, self.rng)
        path: Array = self.place + np.column_stack([offsets[:, 0], np.zeros(self.frames), offsets[:, 1]])
        return path

    def hand(self, thing: Thing) -> Solid:
        """A hand on a thing that stands on y = 0 at the origin."""
        side = self.rng.choice([-1, 1])
        forearm = np.array([side, self.rng.uniform(-0.4, 0.1), self.rng.uniform(-0.2, 0.7)])
        length = max(MIN_SLEEVE, 3 * self.half_view)  # it ends outside the image
        hand = make_hand(forearm / np.linalg.norm(forearm), thing.size, length, self.rng)
        return hand.placed(Placement.at(np.array([0, -GRIP_SHARE * thing.size[1], 0])))


def plan_room(kind: str, camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A random scene of a kind of ROOM_PLANS."""
    return ROOM_PLANS[kind](camera, rng)


def _set_table(
    camera: Intrinsics, rng: np.random.Generator, *, free: float = 0.0, against_wall: bool = False
) -> _Table:
    """A random table. free: radius in meters around the target's place that stays free of other things."""
    direction = rng.uniform([-0.8, -1.0, -0.8], [0.8, -0.6, 0.0])
    lamp = WhiteLamp(direction / np.linalg.norm(direction), rng.uniform(0.5, 0.7))
    shape = TARGET_SHAPES[rng.integers(len(TARGET_SHAPES))]
    side = float(np.exp(rng.uniform(np.log(0.07), np.log(0.26))))
    thing = make_thing(shape, side, lamp, rng)
    distance = side * camera.fy / (camera.height * rng.uniform(MIN_SHARE, MAX_SHARE))
    distance = float(np.clip(distance, MIN_DISTANCE, MAX_DISTANCE))
    width, depth = rng.uniform([1.2, 0.8], [2.0, 1.2]).tolist()
    place = np.array([rng.uniform(-0.25, 0.25), 0, rng.uniform(-0.2, 0.25) * depth])
    back = depth / 2 + float(rng.choice([0.02, rng.uniform(0.3, 2.5)]))
    if against_wall:
        back = depth / 2 + 0.02
        place[2] = back - 0.01
    look_at = place + [0, -thing.size[1] / 2, 0] + rng.uniform(-0.12, 0.12, 3) * distance
    view = Viewpoint(look_at, distance, rng.uniform(-0.4, 0.4), math.radians(rng.uniform(14, 60)))
    if against_wall:
        view = view._replace(pitch=math.radians(rng.uniform(10, 35)))
    radius = float(np.hypot(*thing.size[[0, 2]])) / 2 + free
    others = scatter_things(
        int(rng.integers(*CLUTTER)),
        np.array([[*place[[0, 2]], radius]]),
        np.array([width, depth]) / 2,
        lamp,
        rng,
    )
    still = [*make_shell(TABLE_HEIGHT, back, -4.0, rng), *make_table(width, depth, rng), *others]
    half_view = distance * camera.width / camera.fx / 2
    return _Table(rng, float(rng.choice([15, 30])), lamp, thing, place, view, still, half_view)


def stand_on_table(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """The target stands on a table; the camera is handheld."""
    made = _set_table(camera, rng)
    pose = Placement.at(made.place, yaw=rng.uniform(-0.6, 0.6))
    target = [made.thing.solid.placed(pose)] * made.frames
    return made.plan(cameras.hold(made.view, made.frames, made.rate, rng), target)


def lean_on_wall(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A flat target leans on the wall behind a table; the camera is handheld."""
    made = _set_table(camera, rng, against_wall=True)
    flat = np.diag([1.0, 1.0, min(0.02 / made.thing.size[2], 1.0)])
    tilt = -rng.uniform(0.08, 0.3)
    lean = Placement.at(made.place - [0, 0, made.thing.size[1] * math.sin(-tilt) + 0.01], tilt=tilt)
    squeezed = Solid(
        tuple(
            face._replace(corner=flat @ face.corner, along=flat @ face.along, down=flat @ face.down)
            for face in made.thing.solid.faces
        ),
        made.thing.solid.balls.transformed(flat, np.zeros(3)),
        made.thing.solid.skins,
    )
    target = [squeezed.placed(lean)] * made.frames
    return made.plan(cameras.hold(made.view, made.frames, made.rate, rng), target)


def push_over_table(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A hand pushes the target across a table."""
    made = _set_table(camera, rng, free=0.12)
    reach = min(0.5 * made.half_view, 0.35), min(0.3 * made.half_view, 0.2)
    path = made.path(reach, rng.uniform(0.3, 0.9))
    yaw = rng.uniform(-0.4, 0.4) + 0.3 * sample_sway(made.time, 1.5, 4.0, rng)
    hand = made.hand(made.thing)
    poses = [Placement.at(at, yaw=turn) for at, turn in zip(path, yaw.tolist(), strict=True)]
    plan = made.plan(cameras.stand(made.view, made.frames), [made.thing.solid.placed(pose) for pose in poses])
    plan.movers = [[hand.placed(pose) for pose in poses]]
    return plan


def hold_in_hand(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A hand holds the target and moves and turns it above a table; the camera is static or handheld."""
    made = _set_table(camera, rng)
    path = made.path((0.5 * made.half_view, 0.3 * made.half_view), rng.uniform(0.4, 1.2))
    path[:, 1] -= 0.05 + 0.3 * made.half_view * (0.5 + 0.5 * sample_sway(made.time, 1.5, 4.0, rng))
    turns = rng.uniform(0.1, 0.5, 3) * np.stack(
        [sample_sway(made.time, 1.0, 3.0, rng) for _ in range(3)], axis=1
    )
    poses = [Placement.at(at, *turn) for at, turn in zip(path, turns.tolist(), strict=True)]
    hold = rng.random() < 0.4
    camera_poses = (
        cameras.hold(made.view, made.frames, made.rate, rng)
        if hold
        else cameras.stand(made.view, made.frames)
    )
    hand = made.hand(made.thing)
    plan = made.plan(camera_poses, [made.thing.solid.placed(pose) for pose in poses])
    plan.movers = [[hand.placed(pose) for pose in poses]]
    return plan


def pass_before(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A hand pushes another thing, as far away as the target, past its front; the camera is static."""
    made = _set_table(camera, rng, free=0.1)
    shape = TARGET_SHAPES[rng.integers(len(TARGET_SHAPES))]
    side = float(np.sqrt(made.thing.size[0] * made.thing.size[1])) * rng.uniform(0.6, 1.1)
    other = make_thing(shape, side, made.lamp, rng)
    gap = (made.thing.size[2] + other.size[2]) / 2 + rng.uniform(0.02, 0.06)
    toward = made.place - [0, 0, gap]  # far enough in front of the target for the depths of both
    far = made.half_view + other.size[0]
    start = rng.uniform(0.1, 0.25) * made.time[-1]
    stop = start + rng.uniform(0.35, 0.6) * made.time[-1]
    middle, rest = (start + stop) / 2, rng.uniform(0.0, 0.3)
    knots = [start, middle - rest, middle + rest, stop]
    direction = float(rng.choice([-1, 1]))
    across = direction * np.interp(made.time, knots, [-far, -0.1 * side, 0.1 * side, far])
    whole = other.solid + made.hand(other)
    plan = made.plan(
        cameras.stand(made.view, made.frames),
        [made.thing.solid.placed(Placement.at(made.place, yaw=rng.uniform(-0.5, 0.5)))] * made.frames,
    )
    plan.movers = [[whole.placed(Placement.at(toward + [x, 0, 0])) for x in across.tolist()]]
    return plan


def return_elsewhere(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A hand carries the target out of the image and puts it down elsewhere; the camera is static."""
    made = _set_table(camera, rng, free=0.1)
    last = made.time[-1]
    out = rng.uniform(0.15, 0.25) * last
    gone, back = out + 0.15 * last, out + 0.45 * last
    here, there = (float(rng.choice([-1, 1])) for _ in range(2))
    beyond = 1.3 * made.half_view + made.thing.size[0] + 0.15
    final = (
        np.array([rng.choice([-1, 1]) * rng.uniform(0.25, 0.45), 0, rng.uniform(-0.2, 0.4)]) * made.half_view
    )
    knots = [out, gone, gone + 0.01, back, back + 0.15 * last]
    x = np.interp(made.time, knots, [0, here * beyond, there * beyond, there * beyond, final[0]])
    z = np.interp(made.time, knots, [0, 0.2 * final[2], final[2], final[2], final[2]])
    lifted = np.interp(
        made.time, [out - 0.1, out + 0.1, back, back + 0.12 * last, last], [0, 0.08, 0.08, 0.04, 0]
    )
    path = made.place + np.column_stack([x, -lifted, z])
    poses = [Placement.at(at) for at in path]
    # The hand comes from the side, and leaves when the target stands.
    away = np.interp(made.time, [out - 0.3, out - 0.1, back + 0.25 * last, back + 0.4 * last], [1, 0, 0, 1])
    hand = made.hand(made.thing)
    plan = made.plan(cameras.stand(made.view, made.frames), [made.thing.solid.placed(pose) for pose in poses])
    side = np.sign(hand.balls.centers[0, 0])
    plan.movers = [
        [
            hand.placed(Placement.at(pose.offset + [side * 2 * beyond * share, 0, 0]))
            for pose, share in zip(poses, away.tolist(), strict=True)
        ]
    ]
    plan.spans = {"leaving": range(round(out * made.rate), made.frames)}
    return plan


def walk_on_floor(camera: Intrinsics, rng: np.random.Generator) -> RoomPlan:
    """A person walks on the floor among others, at few frames per second; the camera is static."""
    rate = float(rng.choice([4, 4, 15]))
    frames = round(rate * DURATIONS[rate])
    direction = rng.uniform([-0.8, -1.0, -0.8], [0.8, -0.6, 0.0])
    lamp = WhiteLamp(direction / np.linalg.norm(direction), rng.uniform(0.5, 0.7))
    height, back = rng.uniform(1.4, 2.6), rng.uniform(6.0, 7.5)
    area = walks.WalkableArea(1.8, back - 1.8, camera.width / camera.fx / 2, ROOM_SIDE)
    people = [_walker(area, frames, rate, rng) for _ in range(int(rng.integers(2, 5)))]
    desks = []
    for _ in range(int(rng.integers(2, 5))):
        at = np.array([rng.uniform(-2.5, 2.5), -TABLE_HEIGHT, back - rng.uniform(0.5, 1.2)])
        set_table = [
            *make_table(1.4, 0.7, rng),
            *scatter_things(3, np.zeros((0, 3)), np.array([0.7, 0.35]), lamp, rng),
        ]
        desks += [each._replace(solid=each.solid.placed(Placement.at(at))) for each in set_table]
    view = Viewpoint(np.array([0, -0.9, 3.2]), 3.2, 0.0, math.atan2(height - 0.9, 3.2))
    plan = RoomPlan(
        rate, lamp, cameras.stand(view, frames), [*make_shell(0.0, back, -1.0, rng), *desks], people[0], False
    )
    plan.movers = people[1:]
    return plan


def _walker(area: walks.WalkableArea, frames: int, rate: float, rng: np.random.Generator) -> list[Solid]:
    """A person in each frame, on the floor y = 0."""
    path = walks.sample_loop(area, np.zeros(frames), rate, rng)
    outfit = Outfit.sample(rng.uniform(0.02, 0.1), coat=False, rng=rng)
    person = Pedestrian.walk(Person.sample(rng), outfit, path, 0.0, rate)
    return [Solid((), parts, tuple(person.part_textures)) for parts in person.parts]


ROOM_PLANS: dict[str, Callable[[Intrinsics, np.random.Generator], RoomPlan]] = {
    "table": stand_on_table,
    "leaning": lean_on_wall,
    "pushed": push_over_table,
    "held": hold_in_hand,
    "passing": pass_before,
    "returning": return_elsewhere,
    "walker": walk_on_floor,
}
