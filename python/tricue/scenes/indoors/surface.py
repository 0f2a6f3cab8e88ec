# SPDX-License-Identifier: MIT
"""Smooth bodies: smooth unions of round cones, rendered by sphere tracing.

Hart, "Sphere tracing: a geometric method for the antialiased ray tracing of implicit surfaces", 1996. Frame:
x right, y down, z forward from the camera, meters.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.scenes.arrays import Array, Picture

Integers = NDArray[np.int64]
MAX_STEPS = 40
CHUNK = 2048  # points at a time, so that their distances to all cones stay in the cache
HIT = 2e-4  # meters from the surface at which a ray ends
FAR_BLENDS = 5.0  # blend widths, beyond which only the nearest part counts


class Cones(NamedTuple):
    """Round cones: spheres swept along segments, with linearly changing radii."""

    starts: Array  # (n, 3), meters
    ends: Array  # (n, 3), meters
    radii: Array  # (n, 2), meters, at both ends
    sides: Array  # (n, 3) unit vectors perpendicular to the segments, where the angle about them is 0
    materials: Integers  # (n,) the paint of each
    blend: float  # meters, the width over which cones blend

    def moved(self, rotation: Array, offset: Array) -> "Cones":
        """The cones after each point p has moved to rotation @ p + offset."""
        starts, ends = (points @ rotation.T + offset for points in (self.starts, self.ends))
        return self._replace(starts=starts, ends=ends, sides=self.sides @ rotation.T)

    def __or__(self, other: "Cones") -> "Cones":
        """The cones of both, with the blend of the first."""
        starts, ends, radii, sides = (np.concatenate(pair) for pair in zip(self[:4], other[:4], strict=True))
        return Cones(starts, ends, radii, sides, np.append(self.materials, other.materials), self.blend)


class Surface(NamedTuple):
    """The surface at each of m points near a body."""

    normals: Picture  # (m, 3)
    parts: Integers  # (m,) of the nearest cone
    shares: Picture  # (m,) position along its segment, 0 to 1
    angles: Picture  # (m,) angle about its segment, radians


class Body:
    """Cones, prepared for computing the distances of many points."""

    def __init__(self, cones: Cones) -> None:
        self.cones = cones
        self.middle = (cones.starts.mean(axis=0) + cones.ends.mean(axis=0)) / 2
        self._starts = (cones.starts - self.middle).astype(np.float32)
        self._along = (cones.ends - cones.starts).astype(np.float32)
        self._radii = cones.radii[:, 0].astype(np.float32)
        self._taper = (cones.radii[:, 1] - cones.radii[:, 0]).astype(np.float32)
        self._square = np.maximum((self._along**2).sum(axis=1), np.float32(1e-12))

    def distance(self, points: Picture) -> Picture:
        """Signed distances (m,) of points (m, 3), meters; a lower bound far away, smooth near the body."""
        smooth = np.empty(len(points), np.float32)
        for first in range(0, len(points), CHUNK):
            chunk = slice(first, first + CHUNK)
            smooth[chunk] = self._blend(self._distances(points[chunk])[0])
        return smooth

    def _blend(self, distances: Picture) -> Picture:
        """The minimum (m,) of the distances (m, n) to all cones, smooth where several are near."""
        nearest = distances.min(axis=1)
        blend = np.float32(self.cones.blend)
        near = np.flatnonzero(nearest < FAR_BLENDS * blend)
        smooth = nearest - 3 * blend  # far away: the most that a blend can subtract
        inside = nearest[near]
        total = np.exp((inside[:, None] - distances[near]) / blend).sum(axis=1)
        smooth[near] = inside - blend * np.log(total)
        return np.asarray(smooth, np.float32)

    def look(self, points: Picture) -> Surface:
        """The surface at points (m, 3) on it."""
        distances, shares = self._distances(points)
        parts = distances.argmin(axis=1)
        weights = np.exp((distances.min(axis=1)[:, None] - distances) / np.float32(self.cones.blend))
        rows = np.arange(len(points))
        normals = np.zeros_like(points)
        local = points - self.middle.astype(np.float32)
        for part in range(weights.shape[1]):
            away = local - self._starts[part] - shares[:, part, None] * self._along[part]
            normals += (weights[:, part] / np.maximum(np.linalg.norm(away, axis=1), 1e-9))[:, None] * away
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
        share = shares[rows, parts]
        away = local - self._starts[parts] - share[:, None] * self._along[parts]
        axes = self._along / np.sqrt(self._square)[:, None]
        sides = self.cones.sides.astype(np.float32)
        across = np.cross(axes, sides)
        angles = np.arctan2((away * across[parts]).sum(axis=1), (away * sides[parts]).sum(axis=1))
        return Surface(normals, parts, share, angles)

    def _distances(self, points: Picture) -> tuple[Picture, Picture]:
        """The distances (m, n) to each cone, and the position of the nearest point along it, 0 to 1."""
        local = points - self.middle.astype(np.float32)
        along = local @ self._along.T - (self._starts * self._along).sum(axis=1)
        shares = np.clip(along / self._square, 0, 1)
        square = (local**2).sum(axis=1)[:, None] - 2 * local @ self._starts.T
        square += (self._starts**2).sum(axis=1)
        square += shares * (shares * self._square - 2 * along)
        np.maximum(square, 0, out=square)
        distances = np.sqrt(square, out=square) - self._radii - shares * self._taper
        return distances, shares


class Hits(NamedTuple):
    """Where each of m rays hits a body, or passes nearest to it."""

    depths: Picture  # (m,) meters along the ray
    coverage: Picture  # (m,) share of the pixel that the body covers, 0 to 1


def trace(body: Body, rays: Picture, pixel: float) -> Hits:
    """Trace rays (m, 3), unit vectors from the camera. pixel: the angle of a pixel, radians.

    At a body's edge the coverage falls from 1 to 0 within a pixel; it is one half at the edge.
    """
    first, last = _bounds(body.cones, rays)
    active = np.flatnonzero(first < last)
    depths = np.maximum(first, 0.05)
    nearest = np.full(len(rays), np.inf, np.float32)
    best = depths.copy()
    for _ in range(MAX_STEPS):
        if not len(active):
            break
        at = depths[active]
        away = body.distance(at[:, None] * rays[active])
        size = np.float32(pixel) * at
        widths = away / size + np.float32(0.5)  # pixels from an edge that is half a pixel inside
        hit = widths <= HIT / size
        widths[hit] = 0.0
        closer = widths < nearest[active]
        nearest[active[closer]] = widths[closer]
        best[active[closer]] = at[closer]
        depths[active] = at + np.maximum(away + 0.5 * size, HIT)
        active = active[~hit & (depths[active] < last[active])]
    return Hits(best, np.clip(1 - nearest, 0, 1).astype(np.float32))


def _bounds(cones: Cones, rays: Picture) -> tuple[Picture, Picture]:
    """Where rays first enter and last leave the spheres around cones, (m,) each; infinite, 0 for misses."""
    first, last = np.full(len(rays), np.inf, np.float32), np.zeros(len(rays), np.float32)
    for start, end, radii in zip(cones.starts, cones.ends, cones.radii, strict=True):
        center = ((start + end) / 2).astype(np.float32)
        radius = np.float32(np.linalg.norm(end - start) / 2 + radii.max() + 3 * cones.blend)
        along = rays @ center
        square = radius**2 - (center @ center - along**2)
        meets = square > 0
        half = np.sqrt(square[meets])
        first[meets] = np.minimum(first[meets], along[meets] - half)
        last[meets] = np.maximum(last[meets], along[meets] + half)
    return first, last


def open_sky(body: Body, points: Picture, normals: Picture) -> Picture:
    """The share (m,) of ambient light that reaches each point; it is lower in folds."""
    light = np.ones(len(points), np.float32)
    for height, weight in ((0.008, 0.35), (0.03, 0.35)):
        free = body.distance(points + np.float32(height) * normals) / np.float32(height)
        light -= np.float32(weight) * np.clip(1 - free, 0, 1)
    return light


def direct_light(body: Body, points: Picture, normals: Picture, lamp: Array) -> Picture:
    """The share (m,) of the lamp's light that isn't blocked by a body. lamp: unit vector (3,) toward it."""
    direction = lamp.astype(np.float32)
    light = np.ones(len(points), np.float32)
    for step in (0.02, 0.04, 0.07, 0.12, 0.2):
        free = body.distance(points + np.float32(0.004) * normals + np.float32(step) * direction)
        np.minimum(light, np.clip(free / np.float32(0.1 * step) + 0.5, 0, 1), out=light)
    return light
