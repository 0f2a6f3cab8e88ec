# SPDX-License-Identifier: MIT
"""What the experts read of one frame, given the depth at which the target is expected."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.fused.arrays import Image, Plane
from tricue.track.fused.depth_sources import GATE_SIGMAS, DepthSource, ExpectedDepth
from tricue.track.fused.target import SearchRegion

PictureKind = Literal["color", "depth"]

PICTURE_DEPTH_RANGE = 0.5  # meters from the expected depth to black or white in a picture of depth


@dataclass(frozen=True, slots=True)
class TargetObservation:
    """A picture of the frame, and a source of depth for its pixels.

    picture: (H, W, 3) BGR, of color, or of depth where there is no color. camera: the picture's.
    depth_source: None where there is no depth. expected_depth: None where the target's depth isn't known.
    depth_image: (H, W) meters, if the picture is made of it.
    """

    k: Kernels
    picture: Image
    kind: PictureKind
    camera: Intrinsics
    depth_source: DepthSource | None
    expected_depth: ExpectedDepth | None
    depth_image: Plane | None = None

    def expect(self, expected: ExpectedDepth, region: SearchRegion | None = None) -> "TargetObservation":
        """The same frame, given another expected depth; a picture of depth is drawn in a region alone."""
        picture = self.picture
        if self.kind == "depth" and self.depth_image is not None:
            picture = render_depth(self.depth_image, expected.z, region)
        return replace(self, picture=picture, expected_depth=expected)

    def depth_posterior(
        self, x: float, y: float, pixel_size: float, side: int
    ) -> tuple[Plane, NDArray[np.uint8]] | None:
        """(side, side) P(target | depth), and 1 where an occluder is, else 0.

        x, y, pixel_size: top left corner of a grid of squares and their side, in image pixels.
        None where there is no depth, or none is expected.
        """
        if self.depth_source is None or self.expected_depth is None:
            return None
        expected = self.expected_depth
        noise = self.depth_source.noise(expected.z, pixel_size)
        sigma = math.hypot(expected.sigma, noise)
        margin = max(expected.occluder_margin, GATE_SIGMAS * noise)
        grid = (x, y, pixel_size)
        return self.depth_source.posterior(self.k, grid, side, expected._replace(sigma=sigma), margin)


def render_depth(depth: Plane, z: float, region: SearchRegion | None = None) -> Image:
    """(H, W, 3) picture of a depth image, in which a target at depth z looks the same at any distance.

    Gray at z, black where it is nearer, white where it is farther or not measured. Outside of the region it
    is black too.
    """
    picture = np.zeros((*depth.shape, 3), np.uint8)
    part = _part(depth.shape, region)
    gray = np.fmin(depth[part], np.float32(z + PICTURE_DEPTH_RANGE))  # what is NaN becomes white
    np.maximum(gray, np.float32(z - PICTURE_DEPTH_RANGE), out=gray)
    gray -= np.float32(z)
    gray *= np.float32(127 / PICTURE_DEPTH_RANGE)
    gray += np.float32(128)
    picture[part] = cv2.cvtColor(gray.astype(np.uint8), cv2.COLOR_GRAY2BGR)
    return picture


def _part(shape: tuple[int, ...], region: SearchRegion | None) -> tuple[slice, slice]:
    if region is None:
        return slice(None), slice(None)
    x, y, reach = region
    rows, columns = (
        slice(int(min(max(center - reach, 0), length - 1)), int(min(max(center + reach + 1, 1), length)))
        for center, length in ((y, shape[0]), (x, shape[1]))
    )
    return rows, columns
