# SPDX-License-Identifier: MIT
"""Ellipsoids, of which bodies are made."""

from typing import NamedTuple

from tricue.scenes.arrays import Array


class Ellipsoids(NamedTuple):
    """Ellipsoids {p : (p - c)^T S^-1 (p - c) <= 1}; S is R diag(semi-axes^2) R^T."""

    centers: Array  # (n, 3), metres
    shapes: Array  # (n, 3, 3), square metres

    def transformed(self, rotation: Array, offset: Array) -> "Ellipsoids":
        """Each point p moved to rotation @ p + offset."""
        return Ellipsoids(self.centers @ rotation.T + offset, rotation @ self.shapes @ rotation.T)


class OrientedEllipsoids(NamedTuple):
    """Unit balls stretched and turned into ellipsoids: q goes to root @ q + center, S = root root^T.

    Each q is a point of the body that keeps its place in it, which shapes alone can't say.
    """

    centers: Array  # (n, 3), metres
    roots: Array  # (n, 3, 3), metres

    @property
    def ellipsoids(self) -> Ellipsoids:
        return Ellipsoids(self.centers, self.roots @ self.roots.transpose(0, 2, 1))

    def transformed(self, rotation: Array, offset: Array) -> "OrientedEllipsoids":
        """Each point p moved to rotation @ p + offset."""
        return OrientedEllipsoids(self.centers @ rotation.T + offset, rotation @ self.roots)
