# SPDX-License-Identifier: MIT
"""Detection of a frontal face to start on, by comparison with rendered faces.

The image is reduced step by step, and in each reduced image all windows of one size are looked at. Ten
channels describe them: the gradients in eight directions, relative to those around, and gray and redness,
relative to their mean and spread in the window. They are averaged over square cells. A face passes twice: its
cells match a template (a linear discriminant), and there is a majority of weighted votes, each about which of
two mirrored cells exceed a threshold. Template and votes were learned from rendered faces
(`learned_face`). A window that the template exaggerates by one strong feature fails at the votes, and a
window of unlikely details at the template, so a window's score is mostly the lower one of both. What
resembles a face by chance does so at one size, a face at several, so its score is the mean of those at the
best three sizes. In a color image, a face must also have the color of skin.

Sources: Hariharan, Malik and Ramanan 2012 (linear discriminants of gradients); Friedman, Hastie and
Tibshirani 2000 (boosting); Viola and Jones 2001 (windows of all sizes).
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Flags, Floats, Image, Plane
from tricue.camera.box import Box
from tricue.track.head_detection.learned_face import BIAS, TEMPLATE, VOTE_BIAS, VOTES

MIN_SIDE, MIN_SHARE = 20, 10  # of the smallest face: pixels, and the image's shorter side over the face's
WINDOW = 28  # pixels
COARSE, FINE = 4, 2  # pixels, sides of cells; the template has coarse cells, votes have both
PAD = 4  # pixels by which a window may extend beyond the image
SCALE_STEP = 1.15  # from one size of faces to the next
WINDOW_SCALE = 1.3  # side of the window relative to that of the smallest face
HEAD_WIDTH, HEAD_HEIGHT = 0.72, 0.86  # of the window, as in hand-drawn boxes of faces
NEIGHBORHOOD = 13  # pixels, in which gradients are compared
GRADIENT_NOISE, GRAY_NOISE, REDNESS_NOISE = 3.0, 6.0, 0.01  # added to what a channel is divided by
MAX_CANDIDATES = 300  # windows of one size that the votes are about, to bound the time
MATCH_BONUS = 1.5  # the template's score plus this is on a par with the votes' sum
HIGHER_SHARE = 0.125  # of the higher one of both in a window's score
MIN_SCORE, MIN_SCORE_GRAY = 0.66, 0.78  # of a face, by benchmarks.quality.face_detection --left-out
MIN_HIT = -3.0  # least score of a window
SIZES = 3  # of a face, whose best windows' mean is its score
PLACE, LOG_SIZE = 0.18, 0.3  # a face's hits differ by less, in window sides and in log side
SAME_PLACE = 0.08  # of its best hit; in window sides, of the hits that its score is the mean of
DIGITS = 3  # of a face's place; the last ones depend on where cv2 finds an array in memory
MIN_GREEN_DEFICIT, MIN_BLUE_DEFICIT = 0.10, 0.15  # of skin, as shares of red
MAX_GREEN_DEFICIT = 0.55
MIN_CONTRAST, MAX_CONTRAST = 0.10, 0.55  # deviation of a face's gray levels, as a share of their mean
MAX_GRAY_RANGE = 4.0  # levels, mean difference of a pixel's channels; compressed gray video isn't quite gray
MIRRORED = (1, 0, 2, 3, 7, 6, 5, 4, 8, 9)  # channels of the mirrored image
GRAY, REDNESS = 8, 9  # channels


Pixels = NDArray[np.intp]
Vote = tuple[int, int, int, int, float, float]
"""Side of the cell, channel, row, column, threshold, and by how much the sum grows beyond it."""


class PlaneVotes(NamedTuple):
    """About cells of one side and channel, whose first pixels in the window are at row and column."""

    row: Pixels
    column: Pixels
    threshold: Plane
    vote: Floats


class FaceChannels(NamedTuple):
    """planes: of all channels. mean, spread: of gray and redness, in the window that starts at a pixel."""

    planes: list[Plane]
    mean: list[Plane]
    spread: list[Plane]

    def relative(self, channel: int, values: Plane, y: Pixels, x: Pixels) -> Plane:
        """A channel's values, of gray and redness relative to the windows that start at these pixels."""
        if channel < GRAY:
            return values
        return (values - self.mean[channel - GRAY][y, x]) / self.spread[channel - GRAY][y, x]


class Face(NamedTuple):
    """score: the mean of its best windows' scores at the best SIZES sizes."""

    box: Box
    score: float


def find_face(image: Image) -> Box | None:
    """The box of the largest frontal face in a BGR or gray image, or None."""
    faces = find_faces(image, MIN_SCORE_GRAY if is_gray(image) else MIN_SCORE)
    return max((face.box for face in faces), key=lambda box: box.area, default=None)


def find_faces(image: Image, min_score: float) -> list[Face]:
    """All frontal faces in a BGR or gray image, those with the best window first."""
    smallest = max(MIN_SIDE, min(image.shape[:2]) // MIN_SHARE)
    color = image if image.ndim == 3 else cv2.cvtColor(image, cv2.COLOR_GRAY2BGR)
    gray = is_gray(image)
    hits = _hits(np.asarray(color, np.uint8), smallest, gray)
    hits = hits[np.argsort(-hits[:, 0], kind="stable")]
    faces = []
    while len(hits) and hits[0, 0] > min_score:
        best, x, y, side = hits[0].tolist()
        near = np.hypot(hits[:, 1] - x, hits[:, 2] - y) / side
        resized = np.abs(np.log(hits[:, 3] / side))
        alike = resized < LOG_SIZE
        score = _mean_of_sizes(hits[alike & (near < SAME_PLACE)])
        one = hits[alike & (near < PLACE)]
        weights = np.exp(one[:, 0] - best)
        x, y, side = np.round(weights @ one[:, 1:] / weights.sum(), DIGITS).tolist()
        if score > min_score and (gray or _has_face_colors(image, x, y, side)):
            faces.append(Face(Box.from_ellipse(x, y, HEAD_WIDTH * side / 2, HEAD_HEIGHT * side / 2), score))
        hits = hits[(near >= 0.5) | (resized >= 2 * LOG_SIZE)]
    return faces


def _mean_of_sizes(hits: Floats) -> float:
    """The mean score of the best windows at the best sizes; hits: the best first."""
    first = np.unique(hits[:, 3], return_index=True)[1]
    best = np.full(SIZES, MIN_HIT)
    found = np.sort(hits[first, 0])[::-1][:SIZES]
    best[: len(found)] = found
    return float(best.mean())


def is_gray(image: Image) -> bool:
    """Whether an image has no colors."""
    return image.ndim == 2 or float(np.ptp(image, axis=2).mean()) < MAX_GRAY_RANGE


def _hits(image: Image, smallest: int, gray: bool) -> Floats:
    """(N, 4) score, center x, y and side, pixels, of windows that match.

    score: mostly the lower one of the votes' sum and of the match with the template plus MATCH_BONUS.
    """
    hits = [np.empty((0, 4))]
    for reduced, scale in _reduced(image, smallest):
        channels = channels_of(reduced)
        matches = match(channels)
        if not gray:
            matches[~skin(reduced)] = -np.inf
        y, x = np.nonzero(matches + MATCH_BONUS > MIN_HIT)
        if len(y) > MAX_CANDIDATES:
            best = np.argsort(-matches[y, x], kind="stable")[:MAX_CANDIDATES]
            y, x = y[best], x[best]
        both = np.stack([matches[y, x] + MATCH_BONUS, votes(channels, y, x)])
        score = (1 - HIGHER_SHARE) * both.min(axis=0) + HIGHER_SHARE * both.max(axis=0)
        middle = WINDOW / 2 - PAD
        side = np.full(len(y), WINDOW * scale)
        found = np.stack([score, (x + middle) * scale, (y + middle) * scale, side], axis=1)
        hits.append(found[score > MIN_HIT])
    return np.concatenate(hits)


def _reduced(image: Image, smallest: int) -> Iterator[tuple[Image, float]]:
    """The padded image in all sizes, and the factors by which it was reduced."""
    height, width = image.shape[:2]
    side = smallest * WINDOW_SCALE
    while side <= 1.25 * min(height, width):
        scale = side / WINDOW
        size = round(width / scale), round(height / scale)
        if min(size) + 2 * PAD < WINDOW:
            break
        method = cv2.INTER_AREA if scale > 1 else cv2.INTER_LINEAR
        reduced = cv2.resize(image, size, interpolation=method)
        padded = cv2.copyMakeBorder(reduced, PAD, PAD, PAD, PAD, cv2.BORDER_REPLICATE)
        yield np.asarray(padded, np.uint8), scale
        side *= SCALE_STEP


def channels_of(image: Image) -> FaceChannels:
    """All channels of a BGR image."""
    blue, green, red = (np.asarray(each, np.float32) for each in cv2.split(image))
    gray = np.float32(0.114) * blue + np.float32(0.587) * green + np.float32(0.299) * red
    redness = (red - green) / (red + green + blue + 20)
    x, y = (cv2.Sobel(gray, -1, *order, ksize=1, scale=0.5) for order in ((1, 0), (0, 1)))
    root = np.float32(np.sqrt(0.5))
    size = (NEIGHBORHOOD, NEIGHBORHOOD)
    around = cv2.boxFilter(cv2.magnitude(x, y), -1, size, borderType=cv2.BORDER_REFLECT) + GRADIENT_NOISE
    gradients = [
        np.maximum(sign * along, 0) / around
        for along in (x, y, (x + y) * root, (x - y) * root)
        for sign in (1, -1)
    ]
    mean = [cells(each, WINDOW) for each in (gray, redness)]
    spread = [
        np.sqrt(np.maximum(cells(each * each, WINDOW) - middle * middle, 0)) + np.float32(noise)
        for each, middle, noise in zip((gray, redness), mean, (GRAY_NOISE, REDNESS_NOISE), strict=True)
    ]
    return FaceChannels([*gradients, gray, redness], mean, spread)


def cells(plane: Plane, side: int) -> Plane:
    """Means of the squares that start at each pixel."""
    return np.asarray(
        cv2.boxFilter(plane, -1, (side, side), anchor=(0, 0), borderType=cv2.BORDER_REPLICATE), np.float32
    )


def match(channels: FaceChannels, template: Plane = TEMPLATE, bias: float = BIAS) -> Plane:
    """How well each window matches the template; 0 where a face is as likely as not."""
    rows, columns = (size - WINDOW + 1 for size in channels.planes[0].shape)
    total: Plane = np.full((rows, columns), bias, np.float32)
    for channel, weights in enumerate(template):
        part = _weighted(cells(channels.planes[channel], COARSE), weights)[:rows, :columns]
        if channel >= GRAY:
            mean, spread = (each[channel - GRAY] for each in (channels.mean, channels.spread))
            part = (part - mean[:rows, :columns] * weights.sum()) / spread[:rows, :columns]
        total += part
    return total


def _weighted(means: Plane, weights: Plane) -> Plane:
    """The weighted sums of the coarse cells of the windows that start at each pixel.

    Every COARSE-th row and column is an image of its own, in which a window's cells are neighbors. All these
    images are filtered at once, one below the other; what is mixed at their ends are no whole windows.
    """
    height, width = means.shape
    rows, columns = -(-height // COARSE), -(-width // COARSE)
    padded = np.zeros((COARSE * rows, COARSE * columns), np.float32)
    padded[:height, :width] = means
    apart = padded.reshape(rows, COARSE, columns, COARSE).transpose(1, 3, 0, 2).reshape(-1, columns)
    sums = cv2.filter2D(apart, -1, weights, anchor=(0, 0), borderType=cv2.BORDER_REPLICATE)
    together = sums.reshape(COARSE, COARSE, rows, columns).transpose(2, 0, 3, 1)
    return np.asarray(together.reshape(padded.shape), np.float32)


def votes(
    channels: FaceChannels, y: Pixels, x: Pixels, table: Sequence[Vote] = VOTES, bias: float = VOTE_BIAS
) -> Floats:
    """The sums of votes for the windows that start at these pixels."""
    total = np.full(len(y), bias)
    y, x = y[:, np.newaxis], x[:, np.newaxis]
    width = channels.planes[0].shape[1]
    for (side, channel), of_plane in _by_plane(tuple(table)).items():
        pixels = (y * width + x) + (of_plane.row * width + of_plane.column)
        values = cells(channels.planes[channel], side).take(pixels)
        total += (channels.relative(channel, values, y, x) > of_plane.threshold) @ of_plane.vote
    return total


@lru_cache(maxsize=2)
def _by_plane(table: tuple[Vote, ...]) -> dict[tuple[int, int], PlaneVotes]:
    """The votes of both mirrored cells, by the cells' side and channel."""
    planes: dict[tuple[int, int], list[tuple[int, int, float, float]]] = {}
    for side, channel, row, column, threshold, vote in table:
        last = WINDOW // side - 1
        for of_pair, place in ((channel, column), (MIRRORED[channel], last - column)):
            planes.setdefault((side, of_pair), []).append((side * row, side * place, threshold, vote))
    return {plane: _arrays(rows) for plane, rows in planes.items()}


def _arrays(rows: list[tuple[int, int, float, float]]) -> PlaneVotes:
    row, column, threshold, vote = map(np.array, zip(*rows, strict=True))
    return PlaneVotes(row, column, threshold.astype(np.float32), vote)


def skin(image: Image) -> Flags:
    """Whether the mean color of each window's inner half is as reddish as skin of any tone in any light."""
    inner, border = 12, 8
    mean = cv2.boxFilter(
        image.astype(np.float32), -1, (inner, inner), anchor=(0, 0), borderType=cv2.BORDER_REPLICATE
    )
    rows, columns = (size - WINDOW + 1 for size in image.shape[:2])
    blue, green, red = cv2.split(mean[border : border + rows, border : border + columns])
    return np.asarray((red - green > MIN_GREEN_DEFICIT * red) & (red - blue > MIN_BLUE_DEFICIT * red))


def _has_face_colors(image: Image, x: float, y: float, side: float) -> bool:
    """Whether the window's inner half is no redder than skin and has a face's contrast."""
    half = side * 6 / WINDOW
    rows, columns = (slice(max(int(at - half), 0), int(at + half) + 1) for at in (y, x))
    pixels = image[rows, columns].reshape(-1, 3).astype(np.float64)
    _, green, red = pixels.mean(axis=0).tolist()
    gray = pixels.mean(axis=1)
    contrast = gray.std() / max(gray.mean(), 1)
    return bool(red - green < MAX_GREEN_DEFICIT * red and MIN_CONTRAST < contrast < MAX_CONTRAST)
