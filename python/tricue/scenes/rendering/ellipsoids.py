# SPDX-License-Identifier: MIT
"""Sets of ellipsoids, of which bodies are made."""

from typing import NamedTuple

from tricue.scenes.arrays import Array


class Ellipsoids(NamedTuple):
    """Ellipsoids {p : (p - c)^T S^-1 (p - c) <= 1}; S is R diag(semi-axes^2) R^T."""

    centers: Array  # (n, 3), meters
    shapes: Array  # (n, 3, 3), square meters

    def transformed(self, rotation: Array, offset: Array) -> "Ellipsoids":
        """The ellipsoids after each point p has moved to rotation @ p + offset."""
        return Ellipsoids(self.centers @ rotation.T + offset, rotation @ self.shapes @ rotation.T)


class OrientedEllipsoids(NamedTuple):
    """Ellipsoids as images of the unit ball: q goes to root @ q + center, and S = root root^T.

    A point q of the ball is the same point of the body while it moves, which shapes alone don't determine.
    """

    centers: Array  # (n, 3), meters
    roots: Array  # (n, 3, 3), meters

    @property
    def ellipsoids(self) -> Ellipsoids:
        """The same ellipsoids, described by their shapes."""
        return Ellipsoids(self.centers, self.roots @ self.roots.transpose(0, 2, 1))

    def transformed(self, rotation: Array, offset: Array) -> "OrientedEllipsoids":
        """The ellipsoids after each point p has moved to rotation @ p + offset."""
        return OrientedEllipsoids(self.centers @ rotation.T + offset, rotation @ self.roots)
