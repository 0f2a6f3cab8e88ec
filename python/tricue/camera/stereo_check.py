# SPDX-License-Identifier: MIT
"""Whether a stereo pair looks like a rectified one, left image first: what can be noticed of one that isn't.

Corners of the left image are followed into the right one and back, by the pyramidal tracker of Lucas and
Kanade (Bouguet, 2000). In a rectified pair they stay in their row and don't move to the right.
"""

import warnings
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame

Array = NDArray[np.float64]

MOST_RISE = 1.5  # pixels between the rows of a point, root mean square over the image
FARTHEST = -0.5  # pixels of disparity: what is below lies behind infinity
FEWEST = 20  # matches without which nothing is said
CORNERS, WINDOW, LEVELS = 200, (11, 11), 4
BACK = 0.5  # pixels within which a corner has to come back
TRIMS = 4


class StereoCheck(NamedTuple):
    """What the matches of a pair say; NaN where there are fewer than FEWEST."""

    matches: int
    rise: float
    """How far a point's row is off in the right image, pixels, root mean square over the image, by the plane
    that fits the matches: a shift, a rotation and a scale show in it."""
    behind: float
    """Share of the matches with a negative disparity, which nothing before the cameras has."""

    @property
    def problem(self) -> str:
        """A sentence about what is wrong with the pair, "" where nothing was noticed."""
        if self.matches < FEWEST:
            return ""
        if self.behind > 0.5:
            return (
                f"left and right seem to be swapped: {self.behind:.0%} of {self.matches} matches have a "
                "negative disparity; give the left camera's image as color, the right one's as right"
            )
        if self.rise > MOST_RISE:
            return (
                f"the pair seems not to be rectified: rows of left and right differ by {self.rise:.1f} px "
                "over the image; rectify raw pairs by their calibration (tricue.camera.rectification)"
            )
        return ""


def check_stereo(left: NDArray[np.uint8], right: NDArray[np.uint8]) -> StereoCheck:
    """Match corners of two images of one size, BGR or grey. It takes some milliseconds; deterministic."""
    corners, found = _follow(_grey(left), _grey(right))
    if len(corners) < FEWEST:
        return StereoCheck(len(corners), np.nan, np.nan)
    disparity, rise = corners[:, 0] - found[:, 0], found[:, 1] - corners[:, 1]
    return StereoCheck(
        len(corners), _typical_rise(found, rise, left.shape), float(np.mean(disparity < FARTHEST))
    )


def warn_of_stereo(frame: Frame, stacklevel: int = 2) -> StereoCheck:
    """Check a frame's pair and warn (UserWarning) of a problem that it shows; what was found.

    stacklevel: as of warnings.warn, seen from the caller: 2 is the line that calls the caller.
    """
    frame.require("color", "right")
    assert frame.color is not None
    assert frame.right is not None
    check = check_stereo(frame.color, frame.right)
    if check.problem:
        warnings.warn(f"right: {check.problem}", UserWarning, stacklevel=stacklevel + 1)
    return check


def _grey(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return np.asarray(cv2.cvtColor(image, cv2.COLOR_BGR2GRAY) if image.ndim == 3 else image, np.uint8)


def _follow(left: NDArray[np.uint8], right: NDArray[np.uint8]) -> tuple[Array, Array]:
    """Corners (n, 2) of the left image and where they are in the right one, of those that come back."""
    apart = max(5, left.shape[1] // 60)
    corners = cv2.goodFeaturesToTrack(left, CORNERS, 0.01, apart)
    if corners is None:
        return np.zeros((0, 2)), np.zeros((0, 2))
    guess = np.empty_like(corners)  # not used; cv2's signature asks for it
    there, seen, _ = cv2.calcOpticalFlowPyrLK(left, right, corners, guess, winSize=WINDOW, maxLevel=LEVELS)
    back, known, _ = cv2.calcOpticalFlowPyrLK(
        right, left, there, guess.copy(), winSize=WINDOW, maxLevel=LEVELS
    )
    missed = np.abs(back - corners).max(axis=(1, 2))
    good = (seen.ravel() == 1) & (known.ravel() == 1) & (missed < BACK)
    return corners[good, 0].astype(np.float64), there[good, 0].astype(np.float64)


def _typical_rise(places: Array, rise: Array, shape: tuple[int, ...]) -> float:
    """The root mean square over the image of the plane through (u, v, rise), wrong matches trimmed."""
    size = np.array([shape[1], shape[0]])
    design = np.column_stack([np.ones(len(places)), places / size - 0.5])
    near = np.abs(rise - np.median(rise))
    for _ in range(TRIMS):
        keep = near <= max(3 * float(np.median(near)), 0.25)
        plane = np.linalg.lstsq(design[keep], rise[keep], rcond=None)[0]
        near = np.abs(rise - design @ plane)
    # Over [-1/2, 1/2]^2 the mean square of a + b u + c v is a^2 + (b^2 + c^2) / 12.
    return float(np.sqrt(plane[0] ** 2 + (plane[1] ** 2 + plane[2] ** 2) / 12))
