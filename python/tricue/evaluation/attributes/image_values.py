# SPDX-License-Identifier: MIT
"""Attributes measured from images: the appearance of the target and its surround, frame by frame."""

from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Image
from tricue.camera.frame import Frame

CAMERA_WIDTH = 160  # pixels of the image in which the camera's motion is measured
MAX_CAMERA_SHIFT = 0.25  # of the image's diagonal; a larger shift is a wrong match
TEMPLATE_SIDE = 16  # pixels, square root of the area, of the box that is searched for elsewhere
INNER = 0.8  # the central part of the box that is searched for, to include less background
REACH = 2.5  # box sizes from its center, within which it is searched for
BINS = 8  # per color channel
COLORS = 24  # the box's most frequent colors, each with a share of at least MIN_COLOR
MIN_COLOR = 0.005
SMOOTHING = 1.0  # pixels of Gaussian blur before the Laplacian, against noise and compression
BLUR_REACH = 12  # frames before and after, to compare a frame's sharpness with
SHARP = 90  # percentile of their sharpness that counts as sharp
IMAGE_KEYS = ("blur", "light", "look_alike", "clutter", "camera")


def image_values(frames: Iterable[Frame], boxes: Floats) -> dict[str, Floats]:
    """Values (M,) by attribute key; boxes: (M, 4). NaN without a true box, if the box's part in the image is
    under four pixels wide or high, and in frames without color.
    """
    found = {key: np.full(len(boxes), np.nan) for key in IMAGE_KEYS}
    surround = np.full(len(boxes), np.nan)
    before: Floats | None = None
    for index, (frame, box) in enumerate(zip(frames, boxes, strict=False)):
        if frame.color is None:
            continue
        image = _bgr(frame.color)
        small = _small(image)
        if before is not None:
            found["camera"][index] = _shift(before, small)
        before = small
        if np.isnan(box).any() or (inside := _crop(image, box)) is None:
            continue
        gray = np.asarray(cv2.cvtColor(inside, cv2.COLOR_BGR2GRAY), np.uint8)
        found["blur"][index] = _sharpness(gray)
        found["light"][index] = gray.mean() + 1  # above 0 also for a black box
        surround[index] = _surround_gray(image, box)
        found["look_alike"][index] = _best_elsewhere(image, box)
        found["clutter"][index] = _common_colors(image, box)
    found["light"] = _common_change(found["light"], surround)
    found["blur"] = _relative_sharpness(found["blur"])
    return found


def _bgr(color: Image) -> Image:
    return color if color.ndim == 3 else np.asarray(cv2.cvtColor(color, cv2.COLOR_GRAY2BGR), np.uint8)


def _small(image: Image) -> Floats:
    height, width = image.shape[:2]
    size = CAMERA_WIDTH, max(1, round(CAMERA_WIDTH * height / width))
    gray = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    return np.asarray(cv2.resize(gray, size, interpolation=cv2.INTER_AREA), np.float64)


def _shift(before: Floats, now: Floats) -> float:
    """The shift between two images, relative to their diagonal."""
    height, width = now.shape
    (x, y), _ = cv2.phaseCorrelate(before, now, cv2.createHanningWindow((width, height), cv2.CV_64F))
    shift = float(np.hypot(x, y) / np.hypot(width, height))
    return shift if shift < MAX_CAMERA_SHIFT else float("nan")


def _surround_gray(image: Image, box: Floats) -> float:
    """The mean gray value in and around the box, plus 1."""
    around = _crop(image, box, 2.0)
    return float("nan") if around is None else float(cv2.cvtColor(around, cv2.COLOR_BGR2GRAY).mean()) + 1


def _common_change(inside: Floats, around: Floats) -> Floats:
    """The change since the first frame that the box and its surround have in common: the ratio nearer to 1,
    or 1 if they change in opposite directions. A turn or an occlusion changes only the box, a new background
    only the surround, light both.
    """
    known = np.flatnonzero(~np.isnan(inside) & ~np.isnan(around))
    if not known.size:
        return np.full(len(inside), np.nan)
    one, other = np.log(inside / inside[known[0]]), np.log(around / around[known[0]])
    smaller = np.where(np.abs(one) < np.abs(other), one, other)
    smaller[one * other < 0] = 0.0
    return np.asarray(np.exp(np.where(np.isnan(one + other), np.nan, smaller)))


def _crop(image: Image, box: Floats, scale: float = 1.0) -> Image | None:
    """The part of the image in a box scaled about its center; None if a side is under 4 pixels."""
    left, top, right, bottom = _corners(image, box, scale)
    return image[top:bottom, left:right] if min(right - left, bottom - top) >= 4 else None


def _corners(image: Image, box: Floats, scale: float) -> tuple[int, int, int, int]:
    x, y, width, height = box.tolist()
    far_x, far_y = scale * width / 2, scale * height / 2
    center_x, center_y = x + width / 2, y + height / 2
    limits = image.shape[1], image.shape[0]
    low = [max(0, round(c - f)) for c, f in ((center_x, far_x), (center_y, far_y))]
    high = [min(n, round(c + f)) for c, f, n in ((center_x, far_x, limits[0]), (center_y, far_y, limits[1]))]
    return low[0], low[1], high[0], high[1]


def _sharpness(gray: NDArray[np.uint8]) -> float:
    """The variance of the Laplacian over that of the gray values; independent of brightness and contrast."""
    smooth = cv2.GaussianBlur(gray.astype(np.float32), (0, 0), SMOOTHING)
    return float(cv2.Laplacian(smooth, cv2.CV_32F).var() / max(float(smooth.var()), 1.0))


def _relative_sharpness(values: Floats) -> Floats:
    """Each value over the SHARP percentile of those near it in time; size and background change slowly."""
    relative = np.full(len(values), np.nan)
    for index in np.flatnonzero(~np.isnan(values)):
        near = values[max(0, index - BLUR_REACH) : index + BLUR_REACH + 1]
        relative[index] = values[index] / max(float(np.nanpercentile(near, SHARP)), 1e-12)
    return relative


def _best_elsewhere(image: Image, box: Floats) -> float:
    """The highest similarity of any place beside the box to the box. A place's similarity is the lower of the
    pixels' correlation and the intersection of color histograms.
    """
    scale = TEMPLATE_SIDE / float(np.sqrt(box[2] * box[3]))
    left, top, right, bottom = _corners(image, box, 2 * REACH)
    x, y, x_end, y_end = _corners(image, box, INNER)
    region = cv2.resize(image[top:bottom, left:right], None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    at = round((x - left) * scale), round((y - top) * scale)
    target = region[at[1] : at[1] + round((y_end - y) * scale), at[0] : at[0] + round((x_end - x) * scale)]
    if min(target.shape[:2]) < 4:
        return float("nan")
    pixels, pattern = region.astype(np.float32), target.astype(np.float32)
    correlation = cv2.matchTemplate(pixels, pattern, cv2.TM_CCOEFF_NORMED)
    alike = np.minimum(
        correlation, _intersections(np.asarray(region, np.uint8), np.asarray(target, np.uint8))
    )
    width, height = round(box[2] * scale), round(box[3] * scale)
    alike[max(0, at[1] - height + 1) : at[1] + height, max(0, at[0] - width + 1) : at[0] + width] = -1
    best = float(alike.max())
    return best if np.isfinite(best) and best > -1 else float("nan")


def _intersections(region: Image, target: Image) -> Floats:
    """The histogram intersection of the target with each window of its size in the region, in [0, 1]."""
    height, width = target.shape[:2]
    own = _histogram(target) / (height * width)
    frequent = [color for color in np.argsort(-own, kind="stable")[:COLORS] if own[color] >= MIN_COLOR]
    bins, total = _bins(region), np.zeros((region.shape[0] - height + 1, region.shape[1] - width + 1))
    for color in frequent:
        sums = np.pad((bins == color).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        counts = (
            sums[height:, width:] - sums[:-height, width:] - sums[height:, :-width] + sums[:-height, :-width]
        )
        total += np.minimum(counts / (height * width), own[color])
    return np.asarray(total / own[frequent].sum())


def _common_colors(image: Image, box: Floats) -> float:
    """The Bhattacharyya coefficient of the histograms of the box and of its surround."""
    outer = _crop(image, box, 2.0)
    inner = _crop(image, box)
    if outer is None or inner is None:
        return float("nan")
    inside, both = _histogram(inner), _histogram(outer)
    around = np.maximum(both - inside, 0)
    if not around.any():
        return float("nan")
    return float(np.sqrt(inside * around).sum() / np.sqrt(inside.sum() * around.sum()))


def _histogram(image: Image) -> Floats:
    return np.bincount(_bins(image).ravel(), minlength=BINS**3).astype(np.float64)


def _bins(image: Image) -> NDArray[np.intp]:
    return np.asarray((image // (256 // BINS)).astype(np.intp) @ np.array([BINS**2, BINS, 1]))
