# SPDX-License-Identifier: MIT
"""Detects stereo pairs that are swapped or not rectified.

Corners of the left image are tracked into the right one and back by pyramidal Lucas-Kanade optical flow
(Bouguet 2000). In a rectified pair, they stay in their rows, and none moves to the right.
"""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.camera.frame import Frame
from tricue.camera.shared_frame import messages_of, warn_of_frame

MAX_ROW_ERROR = 1.5  # pixels between a point's rows in both images, root mean square over the image
MIN_PAIR_DISPARITY = -0.5  # pixels; a smaller one counts as negative
MIN_MATCHES = 20  # with fewer, the check finds nothing
MAX_NEGATIVE_SHARE = 0.5  # of the matches; with more, left and right count as swapped
MAX_CORNERS, FLOW_WINDOW, FLOW_PYRAMID_LEVEL = 200, (11, 11), 4
MAX_ROUND_TRIP_ERROR = 0.5  # pixels between a corner and its place after tracking it there and back
PLANE_FIT_ITERATIONS = 4


class StereoCheck(NamedTuple):
    """Statistics of a stereo pair's matches; NaN with fewer than MIN_MATCHES of them."""

    matches: int
    row_error: float
    """Pixels between a point's rows in the two images, root mean square over the image. It is computed from a
    plane fitted to the matches, which models a shift, a rotation and a scale."""
    negative_share: float
    """Share of the matches with a negative disparity, which no point in front of the cameras has."""

    @property
    def problem(self) -> str:
        """A sentence that says what is wrong with the stereo pair; "" if nothing was found."""
        if self.matches < MIN_MATCHES:
            return ""
        # First, as disparities of cameras that look inward are negative before rectification.
        if self.row_error > MAX_ROW_ERROR:
            return (
                "the stereo pair seems not to be rectified: rows of left and right differ by "
                f"{self.row_error:.1f} px over the image; rectify raw stereo pairs by their calibration "
                "(tricue.camera.rectification)"
            )
        if self.negative_share > MAX_NEGATIVE_SHARE:
            return (
                f"left and right seem to be swapped: {self.negative_share:.0%} of {self.matches} matches "
                "have a negative disparity; give the left camera's image as color, the right one's as right"
            )
        return ""


def check_stereo(left: NDArray[np.uint8], right: NDArray[np.uint8]) -> StereoCheck:
    """Match corners of two images of the same size, uint8, BGR (H, W, 3) or gray (H, W).

    The check is deterministic and takes a few milliseconds.
    """
    corners, found = _track_corners(_gray(left), _gray(right))
    if len(corners) < MIN_MATCHES:
        return StereoCheck(len(corners), np.nan, np.nan)
    disparity, row_errors = corners[:, 0] - found[:, 0], found[:, 1] - corners[:, 1]
    return StereoCheck(
        len(corners),
        _mean_row_error(found, row_errors, left.shape),
        float(np.mean(disparity < MIN_PAIR_DISPARITY)),
    )


def warn_of_stereo(frame: Frame) -> StereoCheck:
    """Check a frame's stereo pair, warn (UserWarning) of a problem, and return the check.

    The warning is attributed to the line that called the caller. ValueError for a frame without a stereo
    pair.
    """
    frame.require("color", "right")
    assert frame.color is not None
    assert frame.right is not None
    check = check_stereo(frame.color, frame.right)
    if check.problem:
        warn_of_frame(messages_of(frame), f"right: {check.problem}", stacklevel=3)
    return check


def _gray(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY) if image.ndim == 3 else image, np.uint8)


def _track_corners(left: NDArray[np.uint8], right: NDArray[np.uint8]) -> tuple[Floats, Floats]:
    """Corners (n, 2) of the left image that track there and back, and their places in the right image."""
    min_distance = max(5, left.shape[1] // 60)
    corners = cv2.goodFeaturesToTrack(left, MAX_CORNERS, 0.01, min_distance)
    if corners is None:
        return np.zeros((0, 2)), np.zeros((0, 2))
    guess = np.empty_like(corners)  # unused, but required by cv2's signature
    there, seen, _ = cv2.calcOpticalFlowPyrLK(
        left, right, corners, guess, winSize=FLOW_WINDOW, maxLevel=FLOW_PYRAMID_LEVEL
    )
    back, known, _ = cv2.calcOpticalFlowPyrLK(
        right, left, there, guess.copy(), winSize=FLOW_WINDOW, maxLevel=FLOW_PYRAMID_LEVEL
    )
    round_trip = np.abs(back - corners).max(axis=(1, 2))
    good = (seen.ravel() == 1) & (known.ravel() == 1) & (round_trip < MAX_ROUND_TRIP_ERROR)
    return corners[good, 0].astype(np.float64), there[good, 0].astype(np.float64)


def _mean_row_error(points: Floats, errors: Floats, shape: tuple[int, ...]) -> float:
    """The root mean square over the image of a plane fitted to the row errors (n,) at points (n, 2).

    Outliers are trimmed: each iteration fits the points whose residuals are at most three times the median.
    """
    size = np.array([shape[1], shape[0]])
    design = np.column_stack([np.ones(len(points)), points / size - 0.5])
    residuals = np.abs(errors - np.median(errors))
    for _ in range(PLANE_FIT_ITERATIONS):
        keep = residuals <= max(3 * float(np.median(residuals)), 0.25)
        plane = np.linalg.lstsq(design[keep], errors[keep], rcond=None)[0]
        residuals = np.abs(errors - design @ plane)
    # Over [-1/2, 1/2]^2 the mean square of a + b u + c v is a^2 + (b^2 + c^2) / 12.
    return float(np.sqrt(plane[0] ** 2 + (plane[1] ** 2 + plane[2] ** 2) / 12))
