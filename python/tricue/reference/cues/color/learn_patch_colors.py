# SPDX-License-Identifier: MIT
"""The colors of a target in the middle of a patch, and of its surround, learned."""

import math

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse
from tricue.reference.cues.color.detail.learn_histograms import Cube, learn_histograms

Mask = NDArray[np.bool_]

UNSEEN = 0.5  # P(target) of a color that neither target nor surround has


def learn_patch_colors(
    patch: NDArray[np.uint8],
    other: NDArray[np.float32],
    pixels: tuple[float, float, float, float, float],
    target: Cube,
    surround: Cube,
    rate: float,
    rare: float,
) -> tuple[Cube, Cube, Cube]:
    """Selects the pixels by masks, and calls learn_histograms."""
    width, height, min_surround_size, min_target_posterior, max_surround_posterior = pixels
    if len(other) and other.shape != patch.shape[:2]:
        refuse("other", "the patch's rows and columns", f"{other.shape[0]}, {other.shape[1]}")
    for name, number in (("width", width), ("height", height)):
        if not 0 <= number < math.inf:
            refuse(name, "a finite number, not negative", float(number))
    if not 1 <= min_surround_size < math.inf:
        refuse("min_surround_size", "a finite number, at least 1", float(min_surround_size))
    for name, share in (
        ("min_target_posterior", min_target_posterior),
        ("max_surround_posterior", max_surround_posterior),
    ):
        if not 0 <= share <= 1:
            refuse(name, "a number in [0, 1]", float(share))
    v, u = (
        np.abs(np.arange(size) + 0.5 - size / 2) / max(length / 2, 1.0)
        for size, length in zip(patch.shape[:2], (height, width), strict=True)
    )
    inside: Mask = np.add.outer(v * v, u * u) <= 1
    around: Mask = np.maximum.outer(v, u) > min_surround_size
    if not around.any():
        around = ~inside
    if other.size:
        own = inside & (other > np.float32(min_target_posterior))
        if 2 * own.sum() > inside.sum():
            around = around | (inside & (other < np.float32(max_surround_posterior)))
            inside = own
    own_colors, other_colors = (np.ascontiguousarray(patch[each].T)[None] for each in (inside, around))
    return learn_histograms(own_colors, other_colors, target, surround, rate, rare, UNSEEN)
