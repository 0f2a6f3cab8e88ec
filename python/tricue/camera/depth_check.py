# SPDX-License-Identifier: MIT
"""Detects depth that isn't registered to color, by the edges of both.

Edges of depth are compared with those of color after many shifts and scales. Registered depth fits best
without any; unregistered depth fits best after some shift or scale. Edges match if their directions agree:
each edge is a complex number at twice the angle of its direction, and the match is their correlation.
"""

from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Plane
from tricue.camera.frame import Frame
from tricue.camera.shared_frame import messages_of, warn_of_frame

CELLS = 160  # across the thinned images, approximately
MAX_SHIFT = 10  # cells along x and y
SCALES = np.array([0.925, 0.95, 0.975, 1.0, 1.025, 1.05, 1.075])
MAX_REGISTERED_ERROR = 1.5  # cells, root mean square over the image; that of registered depth isn't larger
MIN_ERROR = 2.25  # cells, above which depth may count as unregistered
MIN_EDGE_CELLS = 150  # with fewer edges of depth, the check finds nothing
MIN_HEIGHT = 3 * MAX_SHIFT  # cells, so that all shifts can be told apart
MIN_WIDTH = 120  # cells; in a smaller image, a few edges decide
MIN_DEPTH_STEP = 0.1  # difference of log depth over two cells that makes an edge
MAX_COLOR_SLOPE = 15.0  # gray levels per cell; a steeper slope has the same weight
MIN_PEAK, MIN_ADVANTAGE = (4.2, 5.2), (1.3, 1.4)
"""For shifts alone, and for shifts with scales, which are more, so that one fits by chance more easily."""


class EdgeFit(NamedTuple):
    """The shift and scale of depth after which its edges fit best to those of color.

    right, down: pixels. error: how far shift and scale move the image's pixels, root mean square, pixels.
    peak: how far the match is above the median match of all shifts and scales, in standard deviations of
    these. advantage: ratio of the match to the best one among errors that registered depth may have.
    """

    right: int
    down: int
    scale: float
    error: float
    peak: float
    advantage: float


class DepthCheck(NamedTuple):
    """The fits of a depth image to color.

    edges: number of cells with an edge of depth; 0 if the image is too small to be checked. width: of the
    image, pixels. fits: the best shift alone, and the best shift with a scale; empty with fewer edges than
    MIN_EDGE_CELLS, or if the image is less than MIN_WIDTH cells wide or MIN_HEIGHT cells high.
    """

    edges: int
    width: int
    fits: tuple[EdgeFit, ...] = ()

    @property
    def problem(self) -> str:
        """What is wrong with the depth, to be read after "depth:"; "" if nothing was found."""
        min_error = MIN_ERROR * _step(self.width)
        for fit, min_peak, min_advantage in zip(self.fits, MIN_PEAK, MIN_ADVANTAGE, strict=False):
            if fit.error > min_error and fit.peak > min_peak and fit.advantage > min_advantage:
                return (
                    f"seems not to be registered to color: its edges lie about {fit.error:.0f} px beside "
                    f"those of color, and fit after a shift by ({fit.right}, {fit.down}) px and a scale of "
                    f"{fit.scale:g}; register it by both cameras' intrinsics "
                    "(tricue.camera.registration.Registration), and by where they stand to each other if "
                    "that is known (Reprojection there)"
                )
        return ""


def check_depth(color: NDArray[np.uint8], depth: Plane) -> DepthCheck:
    """Compare the edges of color, BGR (H, W, 3) or gray (H, W), with those of depth (H, W), meters or NaN.

    The check is deterministic and takes a few milliseconds.
    """
    width = depth.shape[1]
    step = _step(width)
    thinned = depth[step // 2 :: step, step // 2 :: step]
    if thinned.shape[0] < MIN_HEIGHT or thinned.shape[1] < MIN_WIDTH:
        return DepthCheck(0, width)
    edges = _depth_edges(thinned)
    count = int(np.count_nonzero(edges.any(axis=2)))
    if count < MIN_EDGE_CELLS:
        return DepthCheck(count, width)
    matches = _matches(edges, _color_edges(color, edges.shape[1::-1]))
    matches -= np.median(matches)
    shifts = np.arange(-MAX_SHIFT, MAX_SHIFT + 1)
    spread = (SCALES - 1) ** 2 * (edges.shape[0] ** 2 + edges.shape[1] ** 2) / 12
    errors = np.sqrt(spread[:, None, None] + shifts[:, None] ** 2 + shifts**2)
    best_registered = max(float(matches[errors <= MAX_REGISTERED_ERROR].max()), 1e-9)

    def best_of(chosen: NDArray[np.intp]) -> EdgeFit:
        scale, down, right = np.unravel_index(
            int(matches[chosen].argmax()), (len(chosen), *matches.shape[1:])
        )
        at = chosen[scale], down, right
        match = float(matches[at])
        return EdgeFit(
            step * int(shifts[right]),
            step * int(shifts[down]),
            float(SCALES[at[0]]),
            step * float(errors[at]),
            match / max(float(matches.std()), 1e-9),
            match / best_registered,
        )

    return DepthCheck(count, width, (best_of(np.flatnonzero(SCALES == 1)), best_of(np.arange(len(SCALES)))))


def warn_of_depth(frame: Frame) -> DepthCheck:
    """Check a frame's depth against its color, warn (UserWarning) of a problem, and return the check.

    The warning is attributed to the line that called the caller. ValueError for a frame without color or
    depth.
    """
    frame.require("color", "depth")
    assert frame.color is not None
    assert frame.depth is not None
    check = check_depth(frame.color, frame.depth)
    if check.problem:
        warn_of_frame(messages_of(frame), f"depth: {check.problem}", stacklevel=3)
    return check


def _step(width: int) -> int:
    """The side of a cell in pixels."""
    return max(1, round(width / CELLS))


def _depth_edges(depth: Plane) -> Plane:
    """(h, w, 2) unit vectors at twice the angle of each cell's edge; 0 where there is none.

    Edges are steps of log depth, so that near and far objects are treated alike.
    """
    filled = _fill_shadows(depth)
    known = np.isfinite(filled)
    level = np.log(np.where(known, filled, 1)).astype(np.float32)
    slopes = np.zeros((2, *level.shape), np.float32)
    slopes[0, :, 1:-1] = level[:, 2:] - level[:, :-2]
    slopes[1, 1:-1] = level[2:] - level[:-2]
    strength = np.hypot(*slopes)
    beside_unknown = cv2.dilate((~known).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    edge = (strength > MIN_DEPTH_STEP) & ~beside_unknown
    return _doubled(slopes, edge.astype(np.float32))


def _color_edges(color: NDArray[np.uint8], size: tuple[int, ...]) -> Plane:
    """(h, w, 2) vectors at twice the angle of each cell's slope; their length is the steepness, limited."""
    small = cv2.resize(color, size, interpolation=cv2.INTER_AREA)
    gray = (cv2.cvtColor(small, cv2.COLOR_BGR2GRAY) if small.ndim == 3 else small).astype(np.float32)
    along = [cv2.Sobel(gray, cv2.CV_32F, *axis, scale=1 / 8) for axis in ((1, 0), (0, 1))]
    slopes = np.asarray(along, np.float32)
    return _doubled(slopes, np.minimum(np.hypot(*slopes), MAX_COLOR_SLOPE))


def _doubled(slopes: Plane, length: Plane) -> Plane:
    """Vectors (h, w, 2) of given length at twice the angle of slopes (2, h, w): opposite slopes are equal."""
    x, y = slopes
    doubled = np.stack([x * x - y * y, 2 * x * y], axis=-1)
    return np.asarray(doubled * (length / (x * x + y * y + 1e-9))[..., None], np.float32)


def _fill_shadows(depth: Plane) -> Plane:
    """Depth with holes filled along rows by the farther neighbor, as the background is in the shadow."""
    known, columns = np.isfinite(depth), np.arange(depth.shape[1])
    before = np.maximum.accumulate(np.where(known, columns, 0), axis=1)
    after = np.minimum.accumulate(np.where(known, columns, len(columns) - 1)[:, ::-1], axis=1)[:, ::-1]
    left, right = (np.take_along_axis(depth, index, axis=1) for index in (before, after))
    return np.asarray(np.fmax(left, right), np.float32)


def _matches(edges: Plane, color_edges: Plane) -> Plane:
    """How well edges fit after each scale and each shift down and right: (scales, shifts, shifts).

    Scaling keeps the image's center in place.
    """
    height, width = edges.shape[:2]
    padded = [cv2.getOptimalDFTSize(side + 2 * MAX_SHIFT) for side in (height, width)]
    spectrum = cv2.dft(_pad(color_edges, padded))
    places = np.argwhere(edges.any(axis=2))
    directions = edges[places[:, 0], places[:, 1]]
    middle, shape = np.array([height - 1, width - 1]) / 2, np.array([height, width])
    found = []
    for scale in SCALES:
        moved = np.rint((places - middle) * scale + middle).astype(int)
        inside = ((moved >= 0) & (moved < shape)).all(axis=1)
        scaled = np.zeros((*padded, 2), np.float32)
        scaled[moved[inside, 0], moved[inside, 1]] = directions[inside]
        product = cv2.mulSpectrums(spectrum, cv2.dft(scaled), 0, conjB=True)
        surface = cv2.idft(product, flags=cv2.DFT_SCALE)[..., 0] / max(int(inside.sum()), 1)
        side = 2 * MAX_SHIFT + 1
        found.append(np.roll(surface, (MAX_SHIFT, MAX_SHIFT), (0, 1))[:side, :side])
    return np.asarray(found, np.float32)


def _pad(image: Plane, size: list[int]) -> Plane:
    padded = np.zeros((*size, image.shape[2]), np.float32)
    padded[: image.shape[0], : image.shape[1]] = image
    return padded
