# SPDX-License-Identifier: MIT
"""The color model of given skin and hair samples (Moreno et al. 2002, section 3.1)."""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.arrays import Floats
from tricue.track.stereo_head.params import StereoHeadParams

Samples = Iterable[tuple[NDArray[np.uint8], NDArray[np.bool_]]]

MIN_WEIGHT = 1e-5  # share of the model; bins with less are left out
DIGITS = 6


def count_colors(samples: Samples, p: StereoHeadParams, kernel_set: kernels.Name = "native") -> Floats:
    """(L,) histogram of sum 1 of the marked pixels of all samples, in the order of ``color_bins``.

    samples: BGR images (H, W, 3) with masks (H, W) that are True where they count. Each pixel has the same
    weight. ValueError where no pixel is marked, or for a mask of another size; TypeError for one of numbers.
    """
    k = kernels.load(kernel_set)
    counts = np.zeros(math.prod(p.bins))
    for image, mask in samples:
        if not (isinstance(mask, np.ndarray) and mask.dtype == np.bool_):
            got = getattr(mask, "dtype", type(mask).__name__)
            raise TypeError(f"samples: expected a mask of True and False, got {got}; mask > 0 makes one")
        height, width = image.shape[:2]
        if mask.shape != (height, width):
            raise ValueError(f"samples: expected a mask of shape {(height, width)}, got {mask.shape}")
        bins = k.color_bins(image, (0, 0, width, height), p.color_space, 1)
        counts += np.bincount(bins[mask], minlength=len(counts))
    if not counts.any():
        raise ValueError("samples: expected at least one marked pixel, got none")
    return np.asarray(counts / counts.sum())


def head_colors(
    skin: Samples, hair: Samples, hair_weight: float = 0.5, params: StereoHeadParams | None = None
) -> tuple[tuple[int, float], ...]:
    """The parameter ``head_colors`` of samples: a histogram with a mode of skin and one of hair.

    hair_weight: the hair's share of the model, in [0, 1]. params: the color space; default the defaults.
    Errors as those of :func:`count_colors`.
    """
    if not 0 <= hair_weight <= 1:
        raise ValueError(f"hair_weight: expected a share in [0, 1], got {hair_weight}")
    p = params or StereoHeadParams()
    model = (1 - hair_weight) * count_colors(skin, p) + hair_weight * count_colors(hair, p)
    return tuple(
        (int(each), round(float(model[each]), DIGITS)) for each in np.flatnonzero(model > MIN_WEIGHT)
    )
