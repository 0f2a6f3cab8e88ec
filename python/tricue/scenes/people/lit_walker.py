# SPDX-License-Identifier: MIT
"""A walker in front of a color camera and a time-of-flight camera, in fading or blinding light.

For section VI of Sabeti, Parvizi and Wu (2008). Both cameras have the same view, so depth is registered.
"""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array, Picture
from tricue.scenes.people import walks
from tricue.scenes.people.body import TRUNK_PARTS, Person
from tricue.scenes.people.pedestrian import Outfit, Pedestrian
from tricue.scenes.people.walks import WalkableArea
from tricue.scenes.rendering import textures, zbuffer
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.rectangles import make_rectangle_texture, make_upright_rectangle
from tricue.scenes.rendering.stereo_camera import RayCamera, RayImage, TexturedRectangle, WhiteLamp
from tricue.scenes.scene import DepthScene
from tricue.scenes.seeds import make_generator
from tricue.scenes.sensor.low_light import LowLightSensor
from tricue.scenes.sensor.time_of_flight import SPEED_OF_LIGHT, TimeOfFlightCamera

LightCourse = Literal["indoors", "dusk", "sunrise"]
LIGHT_COURSES = get_args(LightCourse)
RATE = 15.0  # frames per second
RAYS = 3  # per pixel along each axis; the middle one goes through the pixel's center
NEAREST, FARTHEST = 2.4, 4.4  # meters, of the walker
HALF_WIDTH, WALL_HEIGHT = 4.0, 4.5  # meters, of the hall; the ceiling is above the image
BGR_TO_GRAY = np.array([0.114, 0.587, 0.299])
CLUTTER = 10  # boards behind the walker
MIN_BEHIND = 0.7  # meters from the walker's farthest position to those boards
DARKEST, BRIGHTEST = 1e-4, 100.0  # light at the end of dusk, and of sunrise
CHANGE_START, CHANGE_END = 1 / 6, 5 / 6  # of the frames, between which the light changes
DARK_REFLECTANCE, REFLECTANCE_RANGE = 0.2, 0.6  # in near infrared, where clothes are brighter
CLOTHES_CONTRAST = 0.25
HEAD = list(TRUNK_PARTS).index("head")  # of a body's ellipsoids


@dataclass(frozen=True, slots=True, eq=False)
class LitScene(DepthScene):
    """A scene whose frames have color as well as depth, under light that may change."""

    light: NDArray[np.float64]
    """(M,) 1 indoors, 0 in darkness, 100 in the sun."""
    heads: tuple[Box, ...]
    """The person's head in each frame, as ``boxes`` has the body."""


def lit_walker(
    seed: int = 0,
    frames: int = 90,
    *,
    light: LightCourse = "indoors",
    wall: float = 6.5,
    unambiguous_range: float = 7.5,
    min_reflectance: float = 0.0,
) -> LitScene:
    """One person walks a loop 2.4 to 4.4 m away, before colored boards; 176x144 pixels, 15 frames per second.

    light: "indoors" is constant; at "dusk" it falls to one ten-thousandth, and is off for the last sixth of
        the frames; at "sunrise" it grows a hundredfold.
    wall: meters to the end of the hall, more than 5.5.
    unambiguous_range: meters, of the time-of-flight camera; see
        :class:`tricue.scenes.sensor.time_of_flight.TimeOfFlightCamera`, also for min_reflectance.

    Nothing hides the person. ValueError or TypeError names the argument that is wrong.
    """
    _check(frames, light, wall, unambiguous_range, min_reflectance)
    rng = make_generator(seed)
    stage = _Stage.sample(frames, wall, rng)
    camera = TimeOfFlightCamera(
        stage.view.intrinsics,
        SPEED_OF_LIGHT / (2 * unambiguous_range),
        min_reflectance=min_reflectance,
    )
    levels = light_levels(light, frames)
    rendered = [stage.render(index) for index in range(frames)]
    color_sensor = LowLightSensor()
    recorded = []
    for index, (picture, depth) in enumerate(rendered):
        color = color_sensor.expose(picture, float(levels[index]), rng)
        measured = camera.measure(depth, _reflectance(picture), float(levels[index]), rng)
        recorded.append(Frame(color, measured.depth, timestamp=index / RATE))
    truths = [stage.truth(index, depth) for index, (_, depth) in enumerate(rendered)]
    return LitScene(
        name=f"walker, {light}, {unambiguous_range:g} m, seed {seed}",
        frames=tuple(recorded),
        boxes=tuple(truth.box for truth in truths),
        visible_boxes=tuple(truth.visible_box for truth in truths),
        positions=np.stack([truth.position for truth in truths]),
        visible=np.array([truth.visible for truth in truths]),
        intrinsics=stage.view.intrinsics,
        others=((),) * frames,
        light=levels,
        heads=tuple(truth.head for truth in truths),
    )


def light_levels(course: LightCourse, frames: int) -> Array:
    """The light (M,) in each frame."""
    last = {"indoors": 1.0, "dusk": DARKEST, "sunrise": BRIGHTEST}[course]
    share = np.clip((np.arange(frames) / frames - CHANGE_START) / (CHANGE_END - CHANGE_START), 0, 1)
    levels: Array = np.power(last, share)
    if course == "dusk":
        levels[share == 1] = 0.0
    return levels


class _Truth(NamedTuple):
    box: Box
    visible_box: Box | None
    position: Array
    visible: float
    head: Box


class _Stage(NamedTuple):
    """The view, the hall, which is drawn only once, and the walker."""

    view: MountedCamera
    rays: RayCamera
    hall: RayImage
    walker: Pedestrian
    lamp: WhiteLamp  # camera frame

    @classmethod
    def sample(cls, frames: int, wall: float, rng: np.random.Generator) -> "_Stage":
        """A random hall, camera, person and path."""
        intrinsics = Intrinsics.from_fov(176, 144, 47.5, 39.5)
        height = rng.uniform(1.1, 1.5)
        pitch = (math.atan2(height, NEAREST) + math.atan2(height - 1.75, NEAREST)) / 2
        view = MountedCamera(intrinsics, height, pitch)
        rays, _ = RayCamera.pair(StereoRig(intrinsics, 1.0), RAYS)
        slope = intrinsics.width / 2 / intrinsics.fx
        floor = WalkableArea(NEAREST, FARTHEST, slope, HALF_WIDTH - walks.ARM_CLEARANCE)
        person = Person.sample(rng)
        gestures = walks.sample_gestures(frames, RATE, rng)
        path = walks.sample_loop(floor, gestures.crouch, RATE, rng)
        outfit = Outfit.sample(CLOTHES_CONTRAST, False, rng)
        walker = Pedestrian.walk(person, outfit, path, height, RATE)
        walker = walker.at_detail((NEAREST + FARTHEST) / 2, rays.intrinsics.fx)
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
        lamp = WhiteLamp(view.rotation @ direction / np.linalg.norm(direction), rng.uniform(0.5, 0.7))
        return cls(view, rays, _render_hall(view, rays, wall, rng), walker, lamp)

    def render(self, index: int) -> tuple[Picture, Array]:
        """The picture (H, W, 3) in levels, and the z-buffer (H, W) at the pixels' centers."""
        canvas = self.hall.copy()
        self.rays.draw_ellipsoids(canvas, self.walker.ellipsoids(index, self.view.rotation), self.lamp)
        middle = slice(RAYS // 2, None, RAYS)
        return self.rays.average_rays(canvas), canvas.depth[middle, middle].astype(np.float64)

    def truth(self, index: int, depth: Array) -> _Truth:
        """The truth in a frame with a z-buffer (H, W)."""
        body = self.walker.parts[index].transformed(self.view.rotation, np.zeros(3)).ellipsoids
        window = self.view.render(body)
        # The canvas has only single precision.
        nearly = window._replace(depth=window.depth - 1e-3)
        mask, share = zbuffer.find_visible_pixels(nearly, depth)
        position = self.view.surface_points(window).mean(axis=0)
        head = self.view.bounding_box(Ellipsoids(*(each[HEAD : HEAD + 1] for each in body)))
        return _Truth(self.view.bounding_box(body), zbuffer.box_of_mask(mask), position, share, head)


def _render_hall(view: MountedCamera, rays: RayCamera, wall: float, rng: np.random.Generator) -> RayImage:
    """The hall without people: walls, floor, and clutter behind the walker."""
    shape = rays.intrinsics.height, rays.intrinsics.width
    canvas = RayImage(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))
    for level in [*_walls(view.height, wall, rng), *_clutter(view.height, wall, rng)]:
        corner, along, down = (view.rotation @ each for each in level[:3])
        rays.draw_rectangle(canvas, TexturedRectangle(corner, along, down, level.texture))
    return canvas


def _walls(floor: float, wall: float, rng: np.random.Generator) -> list[TexturedRectangle]:
    """The back wall, both sides, and the floor; y is down, and the floor at y = ``floor``."""
    color, top = 0.5 * textures.random_color(rng) + rng.uniform(50, 100), floor - WALL_HEIGHT
    ground = 0.6 * textures.random_color(rng) + 40
    across, up, ahead = np.diag([2 * HALF_WIDTH, WALL_HEIGHT, wall])
    corners = [
        (np.array([-HALF_WIDTH, top, wall]), across, up, textures.BLOTCHED_SURFACE, color),
        (np.array([-HALF_WIDTH, top, 0.0]), ahead, up, textures.PLAIN_SURFACE, color),
        (np.array([HALF_WIDTH, top, wall]), -ahead, up, textures.PLAIN_SURFACE, color),
        (np.array([-HALF_WIDTH, floor, 0.0]), across, ahead, textures.WOOD_SURFACE, ground),
    ]
    return [
        TexturedRectangle(
            corner,
            along,
            down,
            textures.build_pyramid(textures.make_surface(kind, (512, 1024), shade, rng)),
        )
        for corner, along, down, kind, shade in corners
    ]


def _clutter(floor: float, wall: float, rng: np.random.Generator) -> list[TexturedRectangle]:
    """Boards of all colors on the floor and on the walls."""
    slope = math.tan(math.radians(47.5 / 2))
    things = []
    for place in range(CLUTTER):
        half = rng.uniform([0.2, 0.3], [0.6, 0.9])
        z = rng.uniform(FARTHEST + MIN_BEHIND, wall - 0.1)
        x = ((place + rng.random()) / CLUTTER * 2 - 1) * min(slope * z, HALF_WIDTH - 0.6)
        y = floor - half[1] if rng.random() < 0.6 else floor - rng.uniform(half[1] + 0.3, 2.6)
        kind = str(
            rng.choice([textures.STRIPED_SURFACE, textures.BLOTCHED_SURFACE, textures.CLUTTERED_SURFACE])
        )
        texture = make_rectangle_texture(kind, 2 * half, textures.random_color(rng), rng)
        things.append(make_upright_rectangle(np.array([x, y, z]), half, rng.uniform(-0.4, 0.4), texture))
    return things


def _reflectance(picture: Picture) -> Array:
    """The reflectance (H, W) of a picture's surfaces in near infrared."""
    gray = np.clip(picture, 0, 255).astype(np.float64) @ BGR_TO_GRAY / 255
    return np.asarray(DARK_REFLECTANCE + REFLECTANCE_RANGE * gray)


def _check(frames: int, light: str, wall: float, unambiguous_range: float, min_reflectance: float) -> None:
    positive_whole(frames, "frames", "a count")
    if light not in LIGHT_COURSES:
        raise ValueError(f"light: expected one of {', '.join(LIGHT_COURSES)}, got {light!r}")
    least = FARTHEST + MIN_BEHIND + 0.4
    if finite(wall, "wall", "meters") <= least:
        raise ValueError(f"wall: expected more than {least:.1f} m, got {wall!r}")
    if finite(unambiguous_range, "unambiguous_range", "meters") <= 0:
        raise ValueError(f"unambiguous_range: expected meters above 0, got {unambiguous_range!r}")
    if not 0 <= finite(min_reflectance, "min_reflectance", "a share") <= 1:
        raise ValueError(f"min_reflectance: expected a share from 0 to 1, got {min_reflectance!r}")
