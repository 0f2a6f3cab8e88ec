# SPDX-License-Identifier: MIT
"""Color images with a mask for each: ``image/`` and ``mask/`` in one folder, paired by file name."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.data.files import image_paths
from tricue.data.streams import read_image

IMAGE_FOLDERS, MASK_FOLDERS = ("image", "images"), ("mask", "masks")
MARKED_ABOVE = 127  # gray level of a mask, above which a pixel is marked


class MaskedImage(NamedTuple):
    """The files of an image and of its mask."""

    image: Path
    mask: Path

    def read(self) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
        """The image, BGR (H, W, 3), and its mask (H, W).

        The mask is True where it is white and opaque, or, if it has only one color, where it is opaque.

        ValueError or OSError names a file that can't be read, a gray image, a mask whose size isn't its
        image's, or a mask that is gray but nowhere white, such as one of 0 and 1, in which all marks would be
        overlooked.
        """
        image: NDArray[np.uint8] = read_image(self.image, cv2.IMREAD_ANYCOLOR).astype(np.uint8, copy=False)
        if image.ndim != 3:
            raise ValueError(f"{self.image}: expected a color image, got a gray one")
        mask = _read_levels(self.mask)
        if mask.shape != image.shape[:2]:
            (height, width), (rows, columns) = image.shape[:2], mask.shape
            raise ValueError(
                f"{self.mask}: expected a mask of {width}x{height} pixels, as {self.image.name} has, "
                f"got {columns}x{rows}"
            )
        brightest = int(mask.max())
        if 0 < brightest <= MARKED_ABOVE:
            raise ValueError(
                f"{self.mask}: expected white, {MARKED_ABOVE + 1} to 255, where pixels are marked, and black "
                f"elsewhere, got levels up to {brightest}"
            )
        return image, np.asarray(mask > MARKED_ABOVE)


def _read_levels(path: Path) -> NDArray[np.uint8]:
    """A mask's gray levels (H, W); 0 where it is transparent, because the color there means nothing."""
    whole = read_image(path, cv2.IMREAD_UNCHANGED)
    if whole.ndim != 3 or whole.shape[2] != 4:
        return read_image(path, cv2.IMREAD_GRAYSCALE).astype(np.uint8, copy=False)
    if whole.dtype == np.uint16:
        whole = whole >> 8  # as cv2 does for a gray image
    pixels = whole.astype(np.uint8, copy=False)
    levels, opacity = cv2.cvtColor(pixels, cv2.COLOR_BGRA2GRAY), pixels[:, :, 3]
    if levels.min() == levels.max() and opacity.min() < opacity.max():  # the shape is in the opacity
        return opacity
    return np.minimum(levels, opacity)


def is_mask_folder(folder: Path) -> bool:
    """Whether a folder contains a folder of masks, or one of images, beside which masks are then expected."""
    return any(_subfolder(folder, names) is not None for names in (IMAGE_FOLDERS, MASK_FOLDERS))


def find_masked_images(folder: Path) -> list[MaskedImage]:
    """The pairs in a folder with ``image/`` and ``mask/`` (or ``images/``, ``masks/``), in natural order.

    A mask has the name of its image, except for the suffix. ValueError names a folder that is missing or
    empty, an image without a mask, a mask without an image, or the second of two files with the same name.
    """
    image_folder, mask_folder = _required(folder, IMAGE_FOLDERS), _required(folder, MASK_FOLDERS)
    images, masks = _by_name(image_folder), _by_name(mask_folder)
    if not images:
        raise ValueError(f"{image_folder}: expected images, found none")
    _check_partners(images, masks, f"a mask of the same name in {mask_folder}")
    _check_partners(masks, images, f"an image of the same name in {image_folder}")
    return [MaskedImage(image, masks[name]) for name, image in images.items()]


def _by_name(folder: Path) -> dict[str, Path]:
    """The images in a folder, in natural order, by their names without suffix."""
    found: dict[str, Path] = {}
    for path in image_paths(folder):
        if path.stem in found:
            raise ValueError(f"{path}: expected one image of this name, got also {found[path.stem].name}")
        found[path.stem] = path
    return found


def _check_partners(paths: Mapping[str, Path], partners: Mapping[str, Path], expected: str) -> None:
    for name, path in paths.items():
        if name not in partners:
            raise ValueError(f"{path}: expected {expected}, found none")


def _required(folder: Path, names: Sequence[str]) -> Path:
    found = _subfolder(folder, names)
    if found is None and not folder.is_dir():
        raise ValueError(f"{folder}: {'expected a folder' if folder.exists() else 'there is no such folder'}")
    if found is None:
        raise ValueError(f"{folder}: expected the folders image and mask in it, found no {names[0]}")
    return found


def _subfolder(folder: Path, names: Sequence[str]) -> Path | None:
    return next((folder / name for name in names if (folder / name).is_dir()), None)
