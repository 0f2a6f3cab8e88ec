# SPDX-License-Identifier: MIT
"""Samples of a color: images in which masks or boxes mark the color."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.data.open_source import open_source
from tricue.data.skin_masks import find_masked_images, is_mask_folder


class ColorSample(NamedTuple):
    """An image, BGR (H, W, 3), and its mask (H, W), True where it shows the color."""

    image: NDArray[np.uint8]
    mask: NDArray[np.bool_]


def read_color_samples(place: Path) -> Iterator[ColorSample]:
    """The samples in a folder with ``image/`` and ``mask/``, or in any recording with true boxes.

    A box marks all pixels inside it; frames without a box are left out. ValueError or OSError names the file,
    or the place if it has neither masks nor boxes, or if these mark no pixel.
    """
    marked = False
    for sample in _read_masks(place) if is_mask_folder(place) else _read_boxes(place):
        marked = marked or bool(sample.mask.any())
        yield sample
    if not marked:
        raise ValueError(f"{place}: expected samples, no mask or box marks a pixel")


def _read_masks(place: Path) -> Iterator[ColorSample]:
    for pair in find_masked_images(place):
        yield ColorSample(*pair.read())


def _read_boxes(place: Path) -> Iterator[ColorSample]:
    source = open_source(place)
    if source.truth is None:
        raise ValueError(
            f"{place}: expected masks, in the folders image and mask, or a table of boxes; found neither"
        )
    known = np.flatnonzero(np.isfinite(source.truth).all(axis=1))
    if source.length is not None:
        known = known[known < source.length]
    for index, frame in zip(known, source.frames(known.tolist()), strict=True):
        if frame.color is None or frame.color.ndim != 3:
            raise ValueError(f"{place}: expected color images")
        mask = np.zeros(frame.color.shape[:2], np.bool_)
        x0, y0, x1, y1 = (max(0, round(side)) for side in Box(*source.truth[index].tolist()).xyxy)
        mask[y0:y1, x0:x1] = True
        yield ColorSample(frame.color, mask)
