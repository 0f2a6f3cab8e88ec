# SPDX-License-Identifier: MIT
"""Pastes cut-outs into images at subpixel positions, and turns the result into 8-bit images."""

import numpy as np
from numpy.typing import NDArray

from tricue import imgproc
from tricue.camera.numbers import finite
from tricue.scenes.arrays import Picture


def ellipse_mask(height: int, width: int, edge: float) -> Picture:
    """The opacity (height, width) of an ellipse that fills its box: 1, falling to 0 in ``edge`` pixels."""
    v, u = (2 * (np.arange(size) + 0.5) / size - 1 for size in (height, width))
    depth = (1 - np.hypot(u[None, :], v[:, None])) * min(height, width) / 2
    return np.clip(depth / edge, 0, 1).astype(np.float32)


def paste(picture: Picture, cutout: Picture, opacity: Picture, x: float, y: float) -> Picture:
    """Blend a cut-out (h, w, 3) into an image (H, W, 3), over [x, x + w) x [y, y + h), bilinearly.

    opacity: (h, w) of the cut-out, 0 to 1.
    """
    height, width = picture.shape[:2]
    moved = imgproc.shift(cutout, x, y, height, width, border="replicate")
    share = imgproc.shift(opacity, x, y, height, width)[..., None]
    return np.asarray(picture * (1 - share) + moved * share, dtype=np.float32)


def expose(picture: Picture, noise: float, rng: np.random.Generator | None) -> NDArray[np.uint8]:
    """The 8-bit image of a sensor with Gaussian noise, clipped to 0 to 255. noise: deviation in levels.

    Without a generator there is no noise. ValueError for an invalid deviation.
    """
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    levels = np.zeros_like(picture) if rng is None else rng.standard_normal(picture.shape, dtype=np.float32)
    levels *= np.float32(noise)
    levels += picture
    np.rint(levels, out=levels)
    return np.clip(levels, 0, 255, out=levels).astype(np.uint8)
