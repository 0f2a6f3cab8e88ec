# SPDX-License-Identifier: MIT
"""A frame prepared for measuring: reduced, gray, with a right image or with depth converted to disparity."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Image, Plane
from tricue.camera.frame import Frame
from tricue.kernels import Kernels
from tricue.track.flow_depth.params import PAPER_COLUMNS, FlowDepthParams
from tricue.track.flow_depth.rectangles import Region
from tricue.track.flow_depth.verged_geometry import VergedGeometry


class ReducedFrame(NamedTuple):
    """A frame reduced to cells of ``step`` x ``step`` pixels; lengths and disparities are in cells.

    gray, right: (h, w), mean gray levels, 0 where they aren't wanted; right is None without a right image.
    disparity: (h, w) from a depth image, NaN where it has none; None without one.
    offset: by which disparities are smaller than those of parallel cameras.
    """

    gray: Image
    right: Image | None
    disparity: Plane | None
    step: int
    offset: float = 0.0

    @property
    def scale(self) -> float:
        """The scale relative to the paper's images, which have 160 columns."""
        return float(self.gray.shape[1] / PAPER_COLUMNS)

    def disparity_scale(self, p: FlowDepthParams) -> float:
        """The same for differences of disparity, which are smaller with a depth camera."""
        return self.scale * (1.0 if self.disparity is None else p.depth_camera_scale)


class WantedCells(NamedTuple):
    """The wanted cells of the left and the right image; None for all."""

    left: Region | None = None
    right: Region | None = None


def cell_side(shape: tuple[int, ...], p: FlowDepthParams) -> int:
    """The side of a cell, pixels, for images of this shape."""
    height, width = shape[:2]
    return max(1, min(round(width / p.resolution), height, width))


def reduce_frame(
    k: Kernels,
    frame: Frame,
    geometry: VergedGeometry,
    p: FlowDepthParams,
    wanted: WantedCells = WantedCells(),  # noqa: B008  it is immutable
) -> ReducedFrame:
    """Reduce the channels of a checked frame that the cues need."""
    image = frame.color if frame.color is not None else frame.depth
    assert image is not None
    step = cell_side(image.shape, p)
    gray = (
        k.reduce_gray(frame.color, step, wanted.left)  # a copy, because the caller may reuse the array
        if frame.color is not None
        else np.zeros((image.shape[0] // step, image.shape[1] // step), np.uint8)
    )
    if "disparity" not in p.cues:
        return ReducedFrame(gray, None, None, step)
    offset = geometry.offset / step
    if frame.depth is not None:
        return ReducedFrame(gray, None, _depth_to_disparity(frame.depth, geometry, step), step, offset)
    right = frame.right
    assert right is not None
    if geometry.angle:
        right = right if right.ndim == 2 else k.reduce_gray(right, 1)
        camera = geometry.camera
        center = float(camera[2]), float(camera[3])
        right = k.rectify_verged(right, geometry.angle, float(camera[0]), center, geometry.offset)
    return ReducedFrame(gray, k.reduce_gray(right, step, wanted.right), None, step, offset)


def _depth_to_disparity(depth: Plane, geometry: VergedGeometry, step: int) -> Plane:
    """The disparity (h, w), cells, of the geometry's stereo pair at each cell's middle pixel."""
    height, width = (size // step for size in depth.shape)
    middle = depth[step // 2 :: step, step // 2 :: step][:height, :width]
    with np.errstate(divide="ignore", over="ignore"):
        disparity = np.float32(geometry.disparity_times_depth / step) / middle - np.float32(
            geometry.offset / step
        )
    disparity[~np.isfinite(disparity)] = np.nan
    return np.ascontiguousarray(disparity)
