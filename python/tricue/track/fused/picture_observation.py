# SPDX-License-Identifier: MIT
"""The frame as the experts read it, given the depth at which the target is expected."""

import math
import operator
from collections.abc import Sequence
from typing import Literal, NamedTuple

import cv2
import numpy as np

from tricue.arrays import Floats, Image, Plane
from tricue.camera.rig import Intrinsics
from tricue.kernels import Kernels
from tricue.track.fused.depth_sources import (
    GATE_SIGMAS,
    DepthImageSource,
    DepthPosterior,
    DepthSource,
    ExpectedDepth,
)
from tricue.track.fused.target import Target

PictureKind = Literal["color", "depth"]

PICTURE_DEPTH_RANGE = 0.5  # meters from the expected depth to black or white in a picture of depth
SAMPLE_REACH = 2  # pixels: how far beyond a window its samples may read


class PictureObservation(NamedTuple):
    """A picture of the frame, and a source of depth for its pixels.

    picture: (H, W, 3) BGR color image; None without color, where the picture is drawn from the depth image.
    camera: of the picture. depth_source: None without depth. expected_depth: None if the target's depth isn't
    known.
    """

    k: Kernels
    picture: Image | None
    camera: Intrinsics
    depth_source: DepthSource | None
    expected_depth: ExpectedDepth | None

    @property
    def kind(self) -> PictureKind:
        """What the picture shows."""
        return "depth" if self.picture is None else "color"

    @property
    def depth_image(self) -> Plane:
        """(H, W) meters: what a picture of depth is drawn from."""
        assert isinstance(self.depth_source, DepthImageSource), "without color it is read from one"
        return self.depth_source.depth

    @property
    def shape(self) -> tuple[int, int]:
        """Height and width of the picture."""
        image = self.depth_image if self.picture is None else self.picture
        return image.shape[0], image.shape[1]

    def expect(self, expected: ExpectedDepth) -> "PictureObservation":
        """The same frame with another expected depth."""
        return self._replace(expected_depth=expected)

    def sample(self, windows: Floats, side: int) -> Image:
        """(N, side, side, 3) samples of the picture in windows (N, 4): left, top, width, height in pixels.

        A picture of depth is drawn only under the windows; it is black if no depth is expected.
        """
        if self.picture is not None:
            return self.k.sample_windows(self.picture, windows, side, side)
        if self.expected_depth is None:
            return np.zeros((len(windows), side, side, 3), np.uint8)
        height, width = self.shape
        lefts, tops, widths, heights = windows.T.tolist()
        left, right = _span(lefts, widths, width)
        top, bottom = _span(tops, heights, height)
        part = self.depth_image[top:bottom, left:right]
        picture = self.k.depth_picture(part, self.expected_depth.z, PICTURE_DEPTH_RANGE)
        samples = self.k.sample_windows(picture, windows - (left, top, 0, 0), side, side)
        return _bgr(samples.reshape(-1, side)).reshape(-1, side, side, 3)

    def sample_squares(self, targets: Sequence[Target], sides: Sequence[float], side: int) -> Image:
        """(N, side, side, 3) samples of the picture in squares around targets, turned like the targets.

        sides: of the squares, image pixels. Turns are ignored in a picture of depth.
        """
        each = list(zip(targets, sides, strict=True))
        if self.picture is None or not any(target.turn for target in targets):
            return self.sample(np.array([(t.x - s / 2, t.y - s / 2, s, s) for t, s in each]), side)
        squares = np.array([(t.x, t.y, *t.along(s, 0.0), *t.along(0.0, s)) for t, s in each])
        return self.k.sample_turned_windows(self.picture, squares, side, side)

    def depth_posterior(self, x: float, y: float, pixel_size: float, side: int) -> DepthPosterior | None:
        """What depth tells about a grid of squares; None without depth, or if no depth is expected.

        x, y, pixel_size: top left corner of the grid and the squares' side, image pixels. side: squares on a
        side of the grid.
        """
        if self.depth_source is None or self.expected_depth is None:
            return None
        expected = self.expected_depth
        noise = self.depth_source.noise(expected.z, pixel_size)
        sigma = math.hypot(expected.sigma, noise)
        margin = max(expected.occluder_margin, GATE_SIGMAS * noise)
        grid = (x, y, pixel_size)
        return self.depth_source.posterior(self.k, grid, side, expected._replace(sigma=sigma), margin)


def _bgr(gray: Image) -> Image:
    return cv2.cvtColor(gray, cv2.COLOR_GRAY2BGR)  # type: ignore[return-value]


def _span(starts: list[float], lengths: list[float], size: int) -> tuple[int, int]:
    """The start and the end of the pixels that windows read along an axis; at least one pixel."""
    first = max(min(starts) - SAMPLE_REACH, 0.0)
    end = min(max(map(operator.add, starts, lengths)) + SAMPLE_REACH, size)
    return int(min(first, size - 1)), max(math.ceil(end), 1)
