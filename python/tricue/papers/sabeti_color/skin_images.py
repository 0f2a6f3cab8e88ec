# SPDX-License-Identifier: MIT
"""Images with masks of their skin: a folder of the user's, or rendered ones."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.data.files import image_paths
from tricue.data.streams import read_image
from tricue.scenes import skin_picture

Image = NDArray[np.uint8]
Mask = NDArray[np.bool_]

FOLDERS = (("images", "masks"), ("image", "mask"))
"""The names that the two folders may have."""
MIN_SKIN_LEVEL = 128
"""Of 255: a mask's pixel from which it is skin."""


class SkinImages(Protocol):
    """Images with their masks, which are read, or rendered, each time that they are iterated over."""

    @property
    def title(self) -> str:
        """What they are."""

    def __len__(self) -> int: ...

    def __iter__(self) -> Iterator[tuple[Image, Mask]]: ...


class RenderedSkin:
    """Pictures of people in cluttered rooms, rendered once, one for each seed from 0."""

    def __init__(self, count: int) -> None:
        self.title = f"{count} rendered images"
        self._count = count
        self._pairs: list[tuple[Image, Mask]] = []

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[tuple[Image, Mask]]:
        for seed in range(self._count):
            if seed == len(self._pairs):
                self._pairs.append(skin_picture(seed))
            yield self._pairs[seed]


class _Paths(NamedTuple):
    image: Path
    mask: Path


class SkinFolder:
    """``images/NAME.*`` and ``masks/NAME.*`` in a folder, or ``image`` and ``mask``; levels of 128 are skin.

    Errors name the file: ValueError for images without masks, masks without images or of another size, files
    that are no images, and folders without images; FileNotFoundError for a missing folder.
    """

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise FileNotFoundError(f"{folder}: expected a folder of images and masks, found none")
        self._paths = _pair_up(folder)
        self.title = f"{len(self._paths)} images in {folder.name or folder}"

    def __len__(self) -> int:
        return len(self._paths)

    def __iter__(self) -> Iterator[tuple[Image, Mask]]:
        for path, mask_path in self._paths:
            image, levels = read_image(path, cv2.IMREAD_COLOR), read_image(mask_path, cv2.IMREAD_GRAYSCALE)
            if levels.shape != image.shape[:2]:
                (height, width), (rows, columns) = image.shape[:2], levels.shape
                raise ValueError(
                    f"{mask_path}: expected {width}x{height} pixels, as {path.name} has, got {columns}x{rows}"
                )
            yield image, levels >= MIN_SKIN_LEVEL


def _pair_up(folder: Path) -> list[_Paths]:
    """The images of a folder and their masks, by name."""
    for names in FOLDERS:
        images, masks = (folder / name for name in names)
        if images.is_dir() and masks.is_dir():
            break
    else:
        raise ValueError(f"{folder}: expected the folders images and masks in it")
    masks_by_name: dict[str, Path] = {}
    for path in image_paths(masks):
        if path.stem in masks_by_name:
            raise ValueError(f"{path}: expected one mask a name, got also {masks_by_name[path.stem].name}")
        masks_by_name[path.stem] = path
    pairs = []
    for path in image_paths(images):
        if path.stem not in masks_by_name:
            raise ValueError(f"{path}: expected a mask of that name in {masks}, found none")
        pairs.append(_Paths(path, masks_by_name.pop(path.stem)))
    if masks_by_name:
        left = min(masks_by_name.values())
        raise ValueError(f"{left}: expected an image of that name in {images}, found none")
    if not pairs:
        raise ValueError(f"{images}: expected images, found none")
    return pairs
