# SPDX-License-Identifier: MIT
"""One frame as the experts see it: a picture to read, and how far away its pixels are."""

import math
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
Plane = NDArray[np.float32]
Kind = Literal["color", "depth"]

MARGIN = 0.5  # metres before the target that are surely not its own
RELIEF = 0.5  # metres from the target's depth to black or white, in a picture made of depth


class Expected(NamedTuple):
    """Where along the optical axis the target should be: metres, and standard deviation of its pixels."""

    z: float
    sigma: float

    @property
    def margin(self) -> float:
        """Metres: what is nearer by more is something else before it; nothing is, if that is vague."""
        return max(min(3 * self.sigma, MARGIN), MARGIN / 2) if self.sigma < MARGIN else self.z


Grid = tuple[float, float, float]  # pixels: x, y of its corner, side of a square


Around = tuple[float, float, float]  # pixels: x, y of a place, and how far it is looked from there


class Ranger(Protocol):
    """Measures how far away pixels are. sharp: edges are where they are in the picture."""

    @property
    def sharp(self) -> bool: ...

    def metres(self, grid: Grid, side: int, around: Expected | None) -> Plane:
        """(side, side) of the squares of a grid; NaN where nothing is measured. Of a pair only depths round
        the expected one are found; of None, all.
        """

    def posterior(
        self, k: Kernels, grid: Grid, side: int, expected: Expected, margin: float
    ) -> tuple[Plane, NDArray[np.uint8]]:
        """(side, side) P(target | depth), and 1 where it is nearer than expected by more than a margin."""

    def noise(self, z: float, unit: float) -> float:
        """Metres, standard deviation of one of these at a depth."""


@dataclass(frozen=True, slots=True)
class Sight:
    """picture: (H, W, 3) BGR, of color, or of depth where there is no color, by a camera. ranger: None
    where there is no depth. expected: None where the target's isn't known. depth: (H, W) metres, if the
    picture is made of it.
    """

    k: Kernels
    picture: Image
    kind: Kind
    camera: Intrinsics
    ranger: Ranger | None
    expected: Expected | None
    depth: Plane | None = None

    def expecting(self, expected: Expected, around: Around | None = None) -> "Sight":
        """The same frame for one who expects another depth, and looks no farther than that around."""
        picture = self.picture
        if self.kind == "depth" and self.depth is not None:
            picture = shades(self.depth, expected.z, around)
        return replace(self, picture=picture, expected=expected)

    def depths(self, x: float, y: float, unit: float, side: int) -> tuple[Plane, NDArray[np.uint8]] | None:
        """P(target | depth) of squares of the image, and 1 where something is nearer, else 0; None where
        there is no depth to compare with.
        """
        if self.ranger is None or self.expected is None:
            return None
        noise = self.ranger.noise(self.expected.z, unit)
        own = math.hypot(self.expected.sigma, noise)
        margin = max(self.expected.margin, 3 * noise)
        return self.ranger.posterior(self.k, (x, y, unit), side, self.expected._replace(sigma=own), margin)


def shades(depth: Plane, z: float, around: Around | None = None) -> Image:
    """(H, W, 3) a picture of depth, gray at the target's, black nearer, white farther and where none is
    measured; so that the target looks the same at any distance. Black, too, is what isn't around a place.
    """
    picture = np.zeros((*depth.shape, 3), np.uint8)
    part = _part(depth.shape, around)
    gray = np.fmin(depth[part], np.float32(z + RELIEF))  # what is NaN becomes white
    np.maximum(gray, np.float32(z - RELIEF), out=gray)
    gray -= np.float32(z)
    gray *= np.float32(127 / RELIEF)
    gray += np.float32(128)
    picture[part] = cv2.cvtColor(gray.astype(np.uint8), cv2.COLOR_GRAY2BGR)
    return picture


def _part(shape: tuple[int, ...], around: Around | None) -> tuple[slice, slice]:
    if around is None:
        return slice(None), slice(None)
    x, y, reach = around
    rows, columns = (
        slice(int(min(max(middle - reach, 0), length - 1)), int(min(max(middle + reach + 1, 1), length)))
        for middle, length in ((y, shape[0]), (x, shape[1]))
    )
    return rows, columns
