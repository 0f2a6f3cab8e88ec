# SPDX-License-Identifier: MIT
"""A frame in shared memory: one process writes its images, the others read them without copying."""

import mmap
import os
import weakref
from typing import Any, NamedTuple

import numpy as np

from tricue.camera.shared_frame import SharedFrame

ALIGNMENT = 64  # bytes, of an image's first pixel


class MemoryLayout(NamedTuple):
    """The places of a frame's images in the memory.

    images: the name, type, shape, and first byte of each. size: bytes in total. others: the frame's other
    parts.
    """

    images: tuple[tuple[str, str, tuple[int, ...], int], ...]
    size: int
    others: dict[str, Any]

    @classmethod
    def of(cls, frame: SharedFrame) -> "MemoryLayout":
        """The layout with the images in sequence."""
        images, end = [], 0
        for name in frame.channels:
            image = getattr(frame, name)
            images.append((name, image.dtype.str, image.shape, end))
            end += -(-image.nbytes // ALIGNMENT) * ALIGNMENT
        return cls(tuple(images), end, {"timestamp": frame.timestamp, "pose": frame.pose})


class FrameMemory:
    """Unnamed memory, which is freed with the last process that has it open; it grows with the frames.

    file: its descriptor, if inherited from another process; None to create new memory.
    """

    def __init__(self, file: int | None = None) -> None:
        self.file = os.memfd_create("tricue-frame") if file is None else file
        self.close = weakref.finalize(self, os.close, self.file)  # mappings stay valid
        self._map: mmap.mmap | None = None

    def write(self, frame: SharedFrame) -> MemoryLayout:
        """Copy a frame into the memory; it replaces the previous one."""
        layout = MemoryLayout.of(frame)
        if os.fstat(self.file).st_size < layout.size:
            os.ftruncate(self.file, layout.size)
        for name, place in self._named(layout, mmap.ACCESS_WRITE):
            np.copyto(place, getattr(frame, name))
        return layout

    def read(self, layout: MemoryLayout) -> SharedFrame:
        """The frame in the memory, valid until the next is written; its images are read-only."""
        return SharedFrame(**dict(self._named(layout, mmap.ACCESS_READ)), **layout.others)

    def copy(self, layout: MemoryLayout) -> SharedFrame:
        """The frame in the memory, with copies of its images."""
        images = {name: view.copy() for name, view in self._named(layout, mmap.ACCESS_READ)}
        return SharedFrame(**images, **layout.others)

    def _named(self, layout: MemoryLayout, access: int) -> list[tuple[str, np.ndarray[Any, Any]]]:
        """The images' names, and arrays that view them."""
        if self._map is None or len(self._map) < layout.size:
            self._map = mmap.mmap(self.file, layout.size, access=access)
        buffer = self._map
        return [(name, np.ndarray(shape, kind, buffer, first)) for name, kind, shape, first in layout.images]
