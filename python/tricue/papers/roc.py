# SPDX-License-Identifier: MIT
"""The ROC curve from which the skin classifier's threshold is chosen (Sabeti 2008, III.A).

A pixel is classified as skin if its score is above the threshold. Scores are integers in a known range (the
skin boundary (10) times 255 lies in [-255, 255]), so two histograms represent the whole curve exactly, for
any number of images.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.arrays import Image

LOWEST_SKIN_THRESHOLD = -1.0
"""The lowest threshold that trackers accept; a curve's last one is below it, so that all pixels are above."""

LOW, HIGH = -255, 255
"""Range of the scores."""

Mask = NDArray[np.bool_]
Brightest = Literal["pixel", "image"]


@dataclass(frozen=True, slots=True, eq=False)
class Roc:
    """A curve from (0, 0) to (1, 1): arrays with a point per threshold, in descending order."""

    fpr: NDArray[np.float64]
    """Share of the negatives above the threshold."""
    tpr: NDArray[np.float64]
    """Share of the positives above the threshold."""
    thresholds: NDArray[np.float64]

    @property
    def area(self) -> float:
        """Area under the curve: the probability that a positive scores above a negative; ties count half."""
        return float(np.sum(np.diff(self.fpr) * (self.tpr[1:] + self.tpr[:-1]) / 2))

    def at_false_positive_rate(self, rate: float, lowest: float = -math.inf) -> tuple[float, float]:
        """The lowest threshold with at most this false-positive rate, and the true-positive rate there.

        lowest: the lower limit of the returned threshold.
        """
        if not 0.0 <= rate <= 1.0:
            raise ValueError(f"rate: expected a number in [0, 1], got {rate}")
        allowed = int(np.count_nonzero(self.thresholds >= lowest))
        last = min(int(np.searchsorted(self.fpr, rate, side="right")), allowed) - 1
        return float(self.thresholds[last]), float(self.tpr[last])


def round_up(threshold: float, digits: int) -> float:
    """A threshold rounded up to fewer digits; rounded down, scores equal to it would be above it."""
    scale = 10.0**digits
    return math.ceil(threshold * scale) / scale


def roc(pairs: Iterable[tuple[NDArray[np.integer], Mask]]) -> Roc:
    """The curve over pairs of an integer score map, in [LOW, HIGH], and its boolean mask."""
    counts = np.zeros((2, HIGH - LOW + 1), dtype=np.int64)
    for scores, mask in pairs:
        counts += _histograms(scores, mask)
    others, skin = counts.sum(axis=1).tolist()
    if not (others and skin):
        found = "only skin" if skin else "no skin"
        raise ValueError(f"masks: expected skin and other pixels, found {found}")
    above = np.cumsum(counts[:, ::-1], axis=1) / counts.sum(axis=1, keepdims=True)
    fpr, tpr = np.hstack([np.zeros((2, 1)), above])
    return Roc(fpr, tpr, np.arange(HIGH, LOW - 2, -1, dtype=np.float64))


def skin_roc(
    images: Iterable[Image],
    masks: Iterable[Mask],
    reference: NDArray[np.uint8] | None = None,
    kernel_set: kernels.Name = "native",
    brightest: Brightest = "pixel",
) -> Roc:
    """The curve of the skin classifier (10), thresholds on Δ in [-1, 1].

    ``reference`` is the (3,) BGR color (3) for all images. Without it every image has its own, from its own
    skin pixels: the best that a patch taken from the target can give. Images without skin are then left out,
    because they have no such patch. ``brightest``: η of (9), the largest channel of each pixel, as in the
    equation and in the tracker, or of the image, as in the text beside it.
    """
    curve = roc(_scored(images, masks, reference, kernel_set, brightest))
    return Roc(curve.fpr, curve.tpr, curve.thresholds / HIGH)


def _scored(
    images: Iterable[Image],
    masks: Iterable[Mask],
    reference: NDArray[np.uint8] | None,
    kernel_set: kernels.Name,
    brightest: Brightest,
) -> Iterable[tuple[NDArray[np.integer], Mask]]:
    kernel = kernels.load(kernel_set)
    for image, mask in zip(images, masks, strict=True):
        color = reference
        if color is None:
            if not mask.any():
                continue
            color = kernel.skin_reference(np.ascontiguousarray(image[mask][None]))
        boundary: NDArray[np.integer] = kernel.skin_boundary(image, color)
        if brightest == "image":
            boundary = boundary + (image.max().astype(np.int16) - image.max(axis=2))
        yield boundary, mask


def _histograms(scores: NDArray[np.integer], mask: Mask) -> NDArray[np.int64]:
    """The histograms (2, levels) of scores outside and inside the mask."""
    if mask.dtype != np.bool_ or mask.shape != scores.shape:
        raise ValueError(
            f"masks: expected bool of shape {scores.shape}, got {mask.dtype} of shape {mask.shape}"
        )
    if not np.issubdtype(scores.dtype, np.integer):
        raise TypeError(f"scores: expected integers, got {scores.dtype}")
    if scores.size and not LOW <= scores.min() <= scores.max() <= HIGH:
        raise ValueError(f"scores: expected values in [{LOW}, {HIGH}], got [{scores.min()}, {scores.max()}]")
    levels = scores.astype(np.int64) - LOW
    return np.stack([np.bincount(levels[mask == side], minlength=HIGH - LOW + 1) for side in (False, True)])
