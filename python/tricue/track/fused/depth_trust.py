# SPDX-License-Identifier: MIT
"""Whether a frame's depth can be trusted: not if it is in another unit, or frozen while color changes.

Such depth is left out, with one warning, and the target is followed by color alone.
"""

import math
import zlib
from typing import NamedTuple

import cv2
import numpy as np

from tricue import imgproc
from tricue.arrays import Image, Plane
from tricue.camera.shared_frame import warn_of_frame
from tricue.track.base.validation import ADDED_TIME_ERROR
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.prepared_frame import PreparedFrame

MAX_METERS, MIN_METERS = 100.0, 0.01  # an image whose depths are all above or all below: another unit
SAMPLED = 24, 32  # rows and columns that are compared, approximately
MIN_FROZEN_FRAMES, MIN_FROZEN_SECONDS = 15, 0.5  # slow depth cameras repeat an image for less
MIN_COLOR_CHANGE, MIN_CHANGED_SHARE = 10, 0.01  # gray levels, above a sample's noise; share of the samples


class DepthTrust(NamedTuple):
    """An immutable memory of the depth images so far.

    sample: bytes of the last depth image's sampled pixels. checksum: of all its pixels; None until the sample
    is repeated. color: thinned color image at the first repetition. repeats, seconds: number and duration of
    the repetitions. frozen: whether color changed meanwhile. told: kinds of bad depth that the user was
    warned of.
    """

    sample: bytes = b""
    checksum: int | None = None
    color: Image | None = None
    repeats: int = 0
    seconds: float = 0.0
    frozen: bool = False
    told: frozenset[str] = frozenset()

    def examine(self, frame: PreparedFrame, seconds: float) -> tuple["DepthTrust", PreparedFrame]:
        """The memory after a frame, and the frame, without its depth if that can't be trusted.

        seconds: since the last frame. ValueError for depth in another unit if there is no color to follow
        instead. UserWarning, on behalf of the caller's caller, the first time that a kind of bad depth is
        left out.
        """
        if not isinstance(frame.depth_source, DepthImageSource):
            return self, frame
        depth = frame.depth_source.depth
        sample = _sample(depth)
        if unit := _wrong_unit(sample):
            if frame.color is None:
                raise ValueError(f"frame.depth: {unit}")
            return self._leave_out(frame, "unit", f"{unit}; until then it is left out")
        seen = self._see(depth, sample, frame.color, seconds)
        if not seen.frozen:
            return seen, frame
        still = f"the same image for {seen.repeats + 1} frames, while color changed"
        hint = "does the depth camera still run? It is left out until it changes"
        return seen._leave_out(frame, "frozen", f"expected another image in each frame, got {still}; {hint}")

    def _see(self, depth: Plane, sample: Plane, color: Image | None, seconds: float) -> "DepthTrust":
        """The memory after depth in the right unit."""
        content = sample.tobytes()
        if content != self.sample or np.isnan(sample).all():
            return DepthTrust(content, told=self.told)
        checksum = zlib.crc32(depth.data)
        if self.checksum not in (None, checksum):  # only pixels that aren't sampled have changed
            return DepthTrust(content, checksum, told=self.told)
        first = self.color
        if first is None:
            first = None if color is None else _thin(color)
        repeats, passed = self.repeats + 1, self.seconds + seconds
        frozen = self.frozen
        if repeats >= MIN_FROZEN_FRAMES and passed >= MIN_FROZEN_SECONDS - ADDED_TIME_ERROR and not frozen:
            frozen = first is not None and color is not None and _differs(first, _thin(color))
        return DepthTrust(content, checksum, first, repeats, passed, frozen, self.told)

    def _leave_out(self, frame: PreparedFrame, kind: str, message: str) -> tuple["DepthTrust", PreparedFrame]:
        if kind not in self.told:
            warn_of_frame(frame.messages, f"frame.depth: {message}", stacklevel=4)
        return self._replace(told=self.told | {kind}), frame._replace(depth_source=None)


def _sample(depth: Plane) -> Plane:
    rows, columns = (max(1, side // count) for side, count in zip(depth.shape, SAMPLED, strict=True))
    return np.ascontiguousarray(depth[rows // 2 :: rows, columns // 2 :: columns])


def _wrong_unit(sample: Plane) -> str:
    """What is wrong with the unit and how to fix it; "" if it seems right."""
    low, high = float(np.fmin.reduce(sample, axis=None)), float(np.fmax.reduce(sample, axis=None))
    if math.isnan(low):  # nothing is measured
        return ""
    found = f"expected meters, got {low:.4g} to {high:.4g}"
    give = "depth_scale={0} tells their unit"
    if low > MAX_METERS:
        return f"{found}, which look like millimeters; {give.format('0.001')}"
    if high < MIN_METERS:
        return f"{found}, which look like meters read as millimeters; {give.format('1')}"
    return ""


def _thin(color: Image) -> Image:
    return imgproc.resize(color, *SAMPLED, "area")


def _differs(first: Image, now: Image) -> bool:
    """Whether thinned images differ by more than noise."""
    change = cv2.absdiff(first, now).max(axis=2)
    return bool(np.mean(change > MIN_COLOR_CHANGE) > MIN_CHANGED_SHARE)
