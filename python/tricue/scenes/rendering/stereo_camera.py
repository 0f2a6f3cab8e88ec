# SPDX-License-Identifier: MIT
"""Color images of textured ellipsoids and rectangles by ray casting, for one camera or a stereo pair.

Several rays per pixel are averaged, so that edges and textures are placed with subpixel accuracy. Frame: the
left camera's, x right, y down, z forward, meters.
"""

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array, Picture
from tricue.scenes.rendering.paste import expose
from tricue.scenes.rendering.textures import sample_texture

RAYS_PER_PIXEL = {"160x120": 3, "640x480": 2}  # by image size; along each axis
BLUR_DEVIATION = 0.5  # pixels, sigma of the blur of lens and sensor, in addition to averaging
MIN_RAY_DEPTH = 0.05  # meters


class TexturedRectangle(NamedTuple):
    """A rectangle whose perpendicular sides ``along`` and ``down`` begin at ``corner``; all (3,), meters."""

    corner: Array
    along: Array
    down: Array
    texture: Sequence[Picture]  # a pyramid; columns run along


class TexturedEllipsoid(NamedTuple):
    """A textured ellipsoid: the points p with |unit (p - center)| <= 1."""

    center: Array  # (3,)
    unit: Array  # (3, 3), to the unit sphere; the texture's top row is at -y, its middle column at z
    texture: Sequence[Picture]  # a pyramid; columns are longitude, rows latitude


class WhiteLamp(NamedTuple):
    """Directional and ambient light, white; a surface facing the lamp has its texture's brightness."""

    direction: Array  # (3,) unit vector toward the lamp
    ambient: float  # share of ambient light, 0 to 1


class RayImage(NamedTuple):
    """Color (h, w, 3) and depth (h, w) of each ray."""

    color: Picture
    depth: Picture

    def copy(self) -> "RayImage":
        return RayImage(self.color.copy(), self.depth.copy())

    def write(
        self, color: Picture, depth: Picture, seen: NDArray[np.bool_], place: tuple[slice, slice]
    ) -> None:
        """Write color and depth into a part of the image, where ``seen``."""
        imgproc.copy_where(color, seen, self.color[place])
        imgproc.copy_where(np.ascontiguousarray(depth), seen, self.depth[place])


class DrawnEllipsoid(NamedTuple):
    """The part of the image in which an ellipsoid was drawn, and its depths; infinite where rays miss it."""

    place: tuple[slice, slice]
    depth: Picture


class RayCamera(NamedTuple):
    """A camera at (offset, 0, 0) that casts ``rays`` by ``rays`` rays per pixel."""

    intrinsics: Intrinsics  # of the grid of rays
    offset: float  # meters
    rays: int

    @classmethod
    def pair(cls, rig: StereoRig, rays: int) -> tuple["RayCamera", "RayCamera"]:
        """The left and the right camera of a rig."""
        camera = rig.intrinsics
        # Pixel centers are at whole numbers in both grids, so the first pixel's corner is at -0.5.
        cx, cy = ((value + 0.5) * rays - 0.5 for value in (camera.cx, camera.cy))
        grid = Intrinsics(
            camera.fx * rays, camera.fy * rays, cx, cy, camera.width * rays, camera.height * rays
        )
        return cls(grid, 0.0, rays), cls(grid, rig.baseline, rays)

    def draw_rectangle(self, canvas: RayImage, rectangle: TexturedRectangle) -> None:
        """Draw a rectangle where it is nearer than what is there."""
        camera = self.intrinsics
        place = self._place(rectangle)
        if any(part.start == part.stop for part in place):
            return
        x, y = self._rays(*place)
        normal = np.cross(rectangle.along, rectangle.down)
        from_camera = rectangle.corner - [self.offset, 0, 0]
        # For upright rectangles and floors, z and most of u and v vary along one axis only: (1, w) or (h, 1).
        with np.errstate(divide="ignore", invalid="ignore"):
            z = np.float32(normal @ from_camera) / _along_rays(normal, x, y).astype(np.float32)
            u, v = (
                (z * _along_rays(side, x, y) - side @ from_camera) / (side @ side)
                for side in (rectangle.along, rectangle.down)
            )
        seen = (
            ((z > MIN_RAY_DEPTH) & (np.abs(u - 0.5) <= 0.5))
            & (np.abs(v - 0.5) <= 0.5)
            & (z < canvas.depth[place])
        )
        if not seen.any():
            return
        # The texture's level fits the median ray; on a tilted rectangle finer detail may alias.
        texels = rectangle.texture[0].shape[1] / float(np.linalg.norm(rectangle.along)) / camera.fx
        z = np.broadcast_to(z, seen.shape)
        away = float(np.median(z[seen])) if len(rectangle.texture) > 1 else 1.0
        u, v = (np.where(seen, share.astype(np.float32), np.float32(0)) for share in (u, v))
        color = sample_texture(rectangle.texture, u, v, texels * away)
        canvas.write(color, z, seen, place)

    def draw_ellipsoids(
        self, canvas: RayImage, ellipsoids: Sequence[TexturedEllipsoid], lamp: WhiteLamp
    ) -> list[DrawnEllipsoid | None]:
        """Draw ellipsoids where they are nearer than what is there; None for each outside the image."""
        places = self._places(ellipsoids) if ellipsoids else []
        return [
            None if place is None else self._draw_ellipsoid(canvas, ellipsoid, place, lamp)
            for ellipsoid, place in zip(ellipsoids, places, strict=True)
        ]

    def _draw_ellipsoid(
        self, canvas: RayImage, ellipsoid: TexturedEllipsoid, place: tuple[slice, slice], lamp: WhiteLamp
    ) -> DrawnEllipsoid:
        x, y = self._rays(*place)
        # A ray's point z d on the unit sphere is q = z (unit d) - unit c; |q| = 1 gives its depth z.
        to_center = ellipsoid.unit @ (ellipsoid.center - [self.offset, 0, 0])
        rays = [
            np.float32(row[0]) * x + (np.float32(row[1]) * y + np.float32(row[2])) for row in ellipsoid.unit
        ]
        depth = _first_hit(rays, to_center)
        seen = depth < canvas.depth[place]  # False where the ray misses: nothing is beyond infinity
        if seen.any():
            safe = np.where(seen, depth, np.float32(0))
            q = [safe * ray - np.float32(at) for ray, at in zip(rays, to_center, strict=True)]
            color = self._texture(ellipsoid, q) * _shade(q, ellipsoid.unit, lamp)[..., None]
            canvas.write(color, depth, seen, place)
        return DrawnEllipsoid(place, depth)

    def average_rays(self, canvas: RayImage) -> Picture:
        """The image (H, W, 3) of the rays: their mean in each pixel, slightly blurred."""
        size = self.intrinsics.height // self.rays, self.intrinsics.width // self.rays
        return imgproc.gaussian_blur(imgproc.resize(canvas.color, *size, "area"), BLUR_DEVIATION, "replicate")

    def _texture(self, ellipsoid: TexturedEllipsoid, q: Sequence[Picture]) -> Picture:
        longitude, latitude = np.arctan2(q[0], q[2]), np.arcsin(np.minimum(np.maximum(q[1], -1), 1))
        u, v = longitude * np.float32(0.5 / np.pi) + np.float32(0.5), latitude / np.float32(np.pi)
        girth = (
            2 * math.pi / float(np.linalg.norm(ellipsoid.unit[0]))
        )  # circumference at the equator, meters, approximately
        texels = ellipsoid.texture[0].shape[1] / girth * float(ellipsoid.center[2]) / self.intrinsics.fx
        return sample_texture(ellipsoid.texture, u, v + np.float32(0.5), texels)

    def _place(self, rectangle: TexturedRectangle) -> tuple[slice, slice]:
        """The rows and columns of rays that may hit a rectangle; empty if none can."""
        camera = self.intrinsics
        sides = np.array([[0, 0], [1, 0], [0, 1], [1, 1]]) @ np.stack([rectangle.along, rectangle.down])
        corners = rectangle.corner - [self.offset, 0, 0] + sides
        size = np.array([camera.width, camera.height])
        # Outside of one of the four planes of the view frustum: f x + c z = u z for the first or last u.
        x, z = (
            corners[:, :2] * [camera.fx, camera.fy] + corners[:, 2:] * [camera.cx, camera.cy],
            corners[:, 2:],
        )
        if (x < 0).all(axis=0).any() or (x > (size - 1) * z).all(axis=0).any():
            return slice(0, 0), slice(0, 0)
        if z.min() <= MIN_RAY_DEPTH:
            return slice(0, camera.height), slice(0, camera.width)
        left, top = np.ceil((x / z).min(axis=0)).clip(0, size).astype(int).tolist()
        right, bottom = (np.floor((x / z).max(axis=0)) + 1).clip(0, size).astype(int).tolist()
        return slice(top, bottom), slice(left, right)

    def _places(self, ellipsoids: Sequence[TexturedEllipsoid]) -> list[tuple[slice, slice] | None]:
        """The rows and columns of rays that may hit each ellipsoid; None if none can.

        The boxes are those of :meth:`tricue.scenes.rendering.depth_view.MountedCamera.ellipsoid_boxes`.
        """
        centers = np.stack([ellipsoid.center for ellipsoid in ellipsoids]) - [self.offset, 0, 0]
        units = np.stack([ellipsoid.unit for ellipsoid in ellipsoids])
        dual = np.linalg.inv(units.transpose(0, 2, 1) @ units) - centers[:, :, None] * centers[:, None, :]
        ahead = (dual[:, 2, 2] < 0) & (centers[:, 2] > MIN_RAY_DEPTH)
        scale = np.where(ahead, dual[:, 2, 2], -1)[:, None]
        middle = dual[:, :2, 2] / scale
        half = np.sqrt(np.maximum(middle**2 - dual[:, [0, 1], [0, 1]] / scale, 0))
        camera = self.intrinsics
        focal, principal = np.array([camera.fx, camera.fy]), np.array([camera.cx, camera.cy])
        size = np.array([camera.width, camera.height])
        first = np.ceil((middle - half) * focal + principal).clip(0, size).astype(int)
        stop = (np.floor((middle + half) * focal + principal) + 1).clip(0, size).astype(int)
        seen = ahead & np.all(first < stop, axis=1)
        return [
            (slice(top, bottom), slice(left, right)) if inside else None
            for (left, top), (right, bottom), inside in zip(
                first.tolist(), stop.tolist(), seen.tolist(), strict=True
            )
        ]

    def _rays(self, rows: slice, columns: slice) -> tuple[Picture, Picture]:
        """x (1, w) and y (h, 1) of the rays (x, y, 1)."""
        x, y = _all_rays(self.intrinsics)
        return x[:, columns], y[rows]


@lru_cache(maxsize=8)
def _all_rays(camera: Intrinsics) -> tuple[Picture, Picture]:
    """x (1, w) and y (h, 1) of a whole image's rays (x, y, 1)."""
    x = ((np.arange(camera.width) - camera.cx) / camera.fx)[None, :].astype(np.float32)
    y = ((np.arange(camera.height) - camera.cy) / camera.fy)[:, None].astype(np.float32)
    x.setflags(write=False)
    y.setflags(write=False)
    return x, y


def _along_rays(vector: Array, x: Picture, y: Picture) -> Array:
    """The dot products (h, w) of a vector (3,) and rays (x, y, 1); 1 long on an axis without variation."""
    parts = [share * axis for share, axis in zip(vector, (x, y), strict=False) if share]
    return np.asarray(sum(parts) + vector[2])


def _first_hit(rays: Sequence[Picture], to_center: Array) -> Picture:
    """The depth z at which rays r enter the unit sphere around c; infinite where they miss it.

    It is the smaller root of a z^2 - 2 b z + k = 0 with a = |r|^2, b = r . c, k = |c|^2 - 1. The discriminant
    is computed as a - |r x c|^2, because b^2 - a k would lose precision to cancellation.
    """
    (r0, r1, r2), (c0, c1, c2) = rays, (np.float32(value) for value in to_center)
    a = r0 * r0 + r1 * r1 + r2 * r2
    cross_squared = (r1 * c2 - r2 * c1) ** 2 + (r2 * c0 - r0 * c2) ** 2 + (r0 * c1 - r1 * c0) ** 2
    discriminant = a - cross_squared
    depth = np.float32(to_center @ to_center - 1) / (
        r0 * c0 + r1 * c1 + r2 * c2 + np.sqrt(np.maximum(discriminant, 0))
    )
    depth[discriminant < 0] = np.inf
    return np.asarray(depth, np.float32)


def _shade(q: Sequence[Picture], unit: Array, lamp: WhiteLamp) -> Picture:
    """The brightness of each point by Lambert's law; its normal is along unit^T q."""
    gram, toward = unit @ unit.T, unit @ lamp.direction
    along = sum(q[i] * np.float32(toward[i]) for i in range(3))
    pairs = {
        (i, j): q[i] * q[j] * np.float32(gram[i, j]) for i in range(3) for j in range(i, 3) if gram[i, j]
    }
    square = sum(pairs[min(i, j), max(i, j)] for i in range(3) for j in range(3) if gram[i, j])
    lambert = np.maximum(along / np.sqrt(np.maximum(square, 1e-9)), 0)
    return np.asarray(lamp.ambient + (1 - lamp.ambient) * lambert, np.float32)


def expose_lit(
    image: Picture, gain: NDArray[np.float64], noise: float, rng: np.random.Generator | None
) -> NDArray[np.uint8]:
    """The 8-bit image of a picture (H, W, 3) under light with gains (3,), with noise, clipped."""
    lit = image if (gain == 1).all() else np.asarray(image * gain, np.float32)
    return expose(lit, noise, rng)
