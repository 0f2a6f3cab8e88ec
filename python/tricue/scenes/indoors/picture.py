# SPDX-License-Identifier: MIT
"""Layers: what a camera sees of each body, composited; with the blur of motion and lens."""

from typing import NamedTuple

import numpy as np

from tricue.camera.rig import Intrinsics
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.indoors.paint import HeadFrame, Paints
from tricue.scenes.indoors.surface import Body, Integers, direct_light, open_sky, trace

CAMERA = Intrinsics.from_fov(320, 240, 50.0)
MIN_COVERAGE = 0.5  # of a pixel, to count as the body's
BLUR_STEP = 0.7  # pixels between the exposures that a motion blur averages


class ColoredLamp(NamedTuple):
    """A lamp and ambient light, each with BGR gains."""

    direction: Array  # (3,) unit vector toward the lamp
    direct: Array  # (3,)
    ambient: Array  # (3,)

    @classmethod
    def sample(cls, rng: np.random.Generator) -> "ColoredLamp":
        """A lamp above and in front of the scene, warmer or colder than the rest."""
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.5, -0.6])
        warmth = rng.uniform(-0.06, 0.10) * np.array([-1, 0, 1.0])
        ambient = rng.uniform(0.36, 0.48)
        return cls(
            direction / np.linalg.norm(direction),
            (1.12 - ambient) * (1 + warmth),
            ambient * (1 - 0.6 * warmth),
        )


class Layer(NamedTuple):
    """A picture that covers part of the ones behind."""

    color: Picture  # (H, W, 3), multiplied by the coverage
    coverage: Picture  # (H, W), 0 to 1
    parts: Integers  # (H, W): the cone at each pixel, -1 where the coverage is below one half
    skin: Picture  # (H, W) the share of each whole pixel that is skin

    def over(self, picture: Picture) -> Picture:
        """The picture (H, W, 3) with the layer in front."""
        return np.asarray(picture * (1 - self.coverage[..., None]) + self.color, np.float32)

    def moving(self, step: Array) -> "Layer":
        """The layer, blurred by a motion of ``step`` (2,) pixels along x and y while the shutter is open."""
        count = int(np.ceil(np.hypot(*step) / BLUR_STEP)) + 1
        if count == 1:
            return self
        stack = np.concatenate([self.color, self.coverage[..., None]], axis=2)
        shares = np.linspace(-0.5, 0.5, count)
        blurred = np.mean([shift(stack, *(share * step).tolist()) for share in shares], axis=0)
        return Layer(
            blurred[..., :3].astype(np.float32), blurred[..., 3].astype(np.float32), self.parts, self.skin
        )


def render(
    body: Body, paints: Paints, lamp: ColoredLamp, head: HeadFrame | None = None, shadow: Body | None = None
) -> Layer:
    """Render a body as the camera sees it. shadow: another body that shades it from the lamp."""
    rows, columns = _window(body)
    y, x = np.mgrid[rows, columns]
    rays = np.stack(
        [(x - CAMERA.cx) / CAMERA.fx, (y - CAMERA.cy) / CAMERA.fy, np.ones(x.shape)],
        axis=-1,
        dtype=np.float32,
    ).reshape(-1, 3)
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    hits = trace(body, rays, 1 / CAMERA.fx)
    seen = np.flatnonzero(hits.coverage > 0)
    layer = Layer(
        np.zeros((CAMERA.height, CAMERA.width, 3), np.float32),
        np.zeros((CAMERA.height, CAMERA.width), np.float32),
        np.full((CAMERA.height, CAMERA.width), -1),
        np.zeros((CAMERA.height, CAMERA.width), np.float32),
    )
    if not len(seen):
        return layer
    points, coverage = hits.depths[seen, None] * rays[seen], hits.coverage[seen]
    surface = body.look(points)
    cones = body.cones
    lengths = np.linalg.norm(cones.ends - cones.starts, axis=1)
    colors, skin = paints.colors(points, surface, cones.materials, lengths, head)
    light = direct_light(body, points, surface.normals, lamp.direction)
    if shadow is not None:
        light *= direct_light(shadow, points, surface.normals, lamp.direction)
    colors *= _shade(surface.normals, light, open_sky(body, points, surface.normals), lamp)
    colors += skin[:, None] * _sheen(surface.normals, rays[seen], light, lamp)
    at = (
        seen // (columns.stop - columns.start) + rows.start,
        seen % (columns.stop - columns.start) + columns.start,
    )
    layer.color[at] = colors * coverage[:, None]
    layer.coverage[at] = coverage
    layer.skin[at] = skin * coverage
    layer.parts[at] = np.where(coverage >= MIN_COVERAGE, surface.parts, -1)
    return layer


def _shade(normals: Picture, light: Picture, sky: Picture, lamp: ColoredLamp) -> Picture:
    """The gains (m, 3) by Lambert's law; the edge of the shadow is softened, as on skin and cloth."""
    toward = normals @ lamp.direction.astype(np.float32)
    soft = np.clip((toward + 0.15) / 1.15, 0, 1) * light
    above = 0.78 - 0.22 * normals[:, 1]  # the ceiling is brighter than the floor
    gains = np.outer(soft, lamp.direct) + np.outer(sky * above, lamp.ambient)
    return np.asarray(gains, np.float32)


def _sheen(normals: Picture, rays: Picture, light: Picture, lamp: ColoredLamp) -> Picture:
    """The levels (m, 1) of the lamp's reflection on smooth skin."""
    half = lamp.direction.astype(np.float32) - rays
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    shine = np.clip((normals * half).sum(axis=1), 0, 1) ** 24
    return np.asarray(26 * (shine * light)[:, None], np.float32)


def _window(body: Body) -> tuple[slice, slice]:
    """The rows and columns that a body can cover: those of all its spheres, with a margin."""
    cones = body.cones
    margin = 3 * cones.blend
    low, high = np.full(2, np.inf), np.full(2, -np.inf)
    for ends, radii in zip((cones.starts, cones.ends), (cones.radii + margin).T, strict=True):
        z = np.maximum(ends[:, 2] - radii, 0.05)
        center = ends[:, :2] / ends[:, 2:] * [CAMERA.fx, CAMERA.fy] + [CAMERA.cx, CAMERA.cy]
        size = (radii / z * CAMERA.fx * 1.15 + 2)[:, None]
        low, high = (
            np.minimum(low, (center - size).min(axis=0)),
            np.maximum(high, (center + size).max(axis=0)),
        )
    left, top = np.clip(np.floor(low), 0, [CAMERA.width, CAMERA.height]).astype(int).tolist()
    right, bottom = np.clip(np.ceil(high), 0, [CAMERA.width, CAMERA.height]).astype(int).tolist()
    return slice(top, max(bottom, top)), slice(left, max(right, left))


def mask_of(layer: Layer, first: int, stop: int) -> Mask:
    """The pixels (H, W) of which the cones first to stop - 1 cover at least half."""
    return np.asarray((layer.parts >= first) & (layer.parts < stop))


def shift(picture: Picture, x: float, y: float) -> Picture:
    """A picture (H, W, ...) moved by x and y pixels, bilinearly, padded with zeros."""
    for axis, step in ((1, x), (0, y)):
        whole = int(np.floor(step))
        share = np.float32(step - whole)
        picture = (1 - share) * _move(picture, whole, axis) + share * _move(picture, whole + 1, axis)
    return picture


def _move(picture: Picture, step: int, axis: int) -> Picture:
    size = picture.shape[axis]
    moved = np.zeros_like(picture)
    to, start = [slice(None)] * picture.ndim, [slice(None)] * picture.ndim
    to[axis] = slice(max(step, 0), max(min(size + step, size), 0))
    start[axis] = slice(max(-step, 0), max(min(size - step, size), 0))
    if abs(step) < size:
        moved[tuple(to)] = picture[tuple(start)]
    return moved


def blur(picture: Picture, deviation: float) -> Picture:
    """A picture (H, W, ...) blurred by a Gaussian, with its edge replicated."""
    radius = int(np.ceil(3 * deviation))
    weights = np.exp(-0.5 * (np.arange(-radius, radius + 1) / deviation) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        size = picture.shape[axis]
        pads = [(radius, radius) if each == axis else (0, 0) for each in range(picture.ndim)]
        padded = np.pad(picture, pads, mode="edge")
        moved = [np.take(padded, range(i, i + size), axis=axis) for i in range(len(weights))]
        picture = np.asarray(np.tensordot(weights, moved, axes=1), np.float32)
    return picture
