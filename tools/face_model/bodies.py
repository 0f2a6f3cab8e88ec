# SPDX-License-Identifier: MIT
"""Shaded ellipsoids, and people made of them: skin-colored, round and symmetric, but without faces."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from tricue.arrays import Floats

from tools.face_model.painting import BLACK_HAIR, Random, any_color, noise, skin_color


class Sun:
    """One light and an even one."""

    def __init__(self, rng: Random) -> None:
        direction = rng.normal(0, 1, 3) - [0, 0.6, 0]
        direction[2] = abs(direction[2]) + 0.3
        self.direction = direction / np.linalg.norm(direction)
        self.ambient = 1.0 if rng.uniform() < 0.2 else rng.uniform(0.1, 0.6)

    def on(self, height: Floats) -> Floats:
        """How bright a surface is."""
        y, x = np.gradient(height)
        toward = self.direction[2] - x * self.direction[0] - y * self.direction[1]
        lambert = np.maximum(toward / np.sqrt(1 + x * x + y * y), 0)
        return np.asarray(self.ambient + (1 - self.ambient) * 1.3 * lambert)


class Ellipsoid(NamedTuple):
    """center: x, y. radii: pixels, along its own x and y. turn: radians."""

    center: Floats
    radii: Floats
    turn: float

    def draw(
        self, image: Floats, color: ArrayLike, sun: Sun, relief: Floats, dye: Floats | float = 1
    ) -> None:
        """Draw it in a light. relief: heights on its surface, and dye: factors, both of the whole image."""
        reach = int(self.radii.max()) + 2
        (left, top), (right, bottom) = (
            np.clip(self.center.astype(int) + offset, 0, len(image)) for offset in (-reach, reach)
        )
        if right - left < 2 or bottom - top < 2:
            return
        place = np.s_[top:bottom, left:right]
        y, x = np.mgrid[place]
        cos, sin = np.cos(self.turn), np.sin(self.turn)
        x, y = x - self.center[0], y - self.center[1]
        along, across = (x * cos + y * sin) / self.radii[0], (y * cos - x * sin) / self.radii[1]
        inside = 1 - np.abs(along) ** 2.4 - np.abs(across) ** 2.4
        height = np.sqrt(np.maximum(inside, 0)) * self.radii.min() + relief[place]
        light = sun.on(height) * np.broadcast_to(dye, image.shape[:2])[place]
        covered = inside > 0
        image[place][covered] = (light[..., np.newaxis] * np.asarray(color))[covered]


class Person:
    """A figure of ellipsoids without a face, in clothes that may have stripes.

    at: pixel of the trunk's middle. height: of the trunk, pixels; the parts' lengths are shares of it.
    """

    def __init__(self, rng: Random, image: Floats, at: Floats, height: float) -> None:
        self.rng, self.image, self.at, self.height = rng, image, at, height
        self.sun = Sun(rng)
        self.lean = rng.normal(0, 0.2)
        self.skin = skin_color(rng)
        self.shirt, self.trousers, self.shorts, self.cap = (any_color(rng, 0.4) for _ in range(4))
        self.bare_arms, self.bare_legs, self.bare_chest = rng.uniform(size=3) < [0.6, 0.5, 0.5]
        self.bumps = noise(rng, image.shape[:2], max(2, self.height / 8))
        self.stripes = 1.0 + self._pattern() * (rng.uniform() < 0.4)

    def draw(self) -> None:
        """With one pair of arms; behind the trunk there may be another person's."""
        if self.rng.uniform() < 0.5:
            self._arms()
        self._legs()
        self._trunk()
        self._arms()
        self._head()

    def _arms(self) -> None:
        color = self.skin if self.bare_arms else self.shirt
        for side in (-1, 1):
            at = side * self.rng.uniform(0.24, 0.38), self.rng.uniform(-0.15, 0.05)
            self._part(at, (0.07, 0.34), color, not self.bare_arms, -side * self.rng.uniform(-5, 60))

    def _legs(self) -> None:
        color, gap = self.skin if self.bare_legs else self.trousers, self.rng.uniform(0.08, 0.14)
        for side in (-1, 1):
            self._part((side * gap, 0.8), (0.1, 0.45), color, not self.bare_legs, self.rng.normal(0, 9))

    def _trunk(self) -> None:
        """The neck, the trunk with a shirt or bare, and trousers."""
        self._part((0, -0.18), (0.1, 0.35), self.skin)
        color = self.skin if self.bare_chest else self.shirt
        self._part((0, 0), (self.rng.uniform(0.2, 0.3), 0.45), color, not self.bare_chest)
        hips = self.rng.uniform(0.2, 0.27), self.rng.uniform(0.1, 0.35)
        self._part((0, self.rng.uniform(0.3, 0.5)), hips, self.shorts, True)
        if self.bare_chest and self.rng.uniform() < 0.7:
            for side in (-0.1, 0.1):
                self._part((side, -0.15), (0.11, 0.1), self.skin * self.rng.uniform(0.8, 1.1))

    def _head(self) -> None:
        """Seen from behind, with hair, shaved or with a cap."""
        hair = BLACK_HAIR * self.rng.uniform(0.3, 4)
        self._part((0, -0.62), (0.12, 0.17), self.skin if self.rng.uniform() < 0.45 else hair)
        if self.rng.uniform() < 0.6:
            self._part((0, -0.68), (0.13, 0.11), self.cap if self.rng.uniform() < 0.4 else hair)

    def _pattern(self) -> Floats:
        across = np.indices(self.image.shape[:2])[self.rng.integers(2)] / self.height
        bands = np.sign(np.sin(2 * np.pi * self.rng.uniform(3, 15) * across))
        return np.asarray(self.rng.uniform(0, 0.9) * bands)

    def _part(
        self,
        at: tuple[float, float],
        radii: tuple[float, float],
        color: Floats,
        clothed: bool = False,
        turn: float = 0,
    ) -> None:
        """turn: degrees."""
        cos, sin = np.cos(self.lean), np.sin(self.lean)
        center = self.at + self.height * np.array([[cos, -sin], [sin, cos]]) @ at
        body = Ellipsoid(center, self.height * np.array(radii), np.radians(turn) + self.lean)
        relief = self.bumps * self.height * (0.03 if clothed else 0.012)
        body.draw(self.image, color, self.sun, relief, self.stripes if clothed else 1)
