# SPDX-License-Identifier: MIT
"""Images with masks of their skin: from a user's folder, or rendered."""

from collections.abc import Iterator
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Image
from tricue.data.skin_masks import find_masked_images
from tricue.scenes import skin_picture

Mask = NDArray[np.bool_]


class SkinImages(Protocol):
    """Images with their masks, read or rendered at each iteration."""

    @property
    def title(self) -> str:
        """A title for the images."""

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


class SkinFolder:
    """``image/NAME.*`` and ``mask/NAME.*`` in a user's folder, see :mod:`tricue.data.skin_masks`.

    Errors name the file: FileNotFoundError for a missing folder, ValueError for invalid content.
    """

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise FileNotFoundError(f"{folder}: expected a folder of images and masks, found none")
        self._files = find_masked_images(folder)
        self.title = f"{len(self._files)} images in {folder.name or folder}"

    def __len__(self) -> int:
        return len(self._files)

    def __iter__(self) -> Iterator[tuple[Image, Mask]]:
        return (each.read() for each in self._files)
