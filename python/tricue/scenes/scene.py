# SPDX-License-Identifier: MIT
"""What every scene is: frames and the true box in each."""

from dataclasses import dataclass

from tricue.camera.box import Box
from tricue.camera.frame import Frame


@dataclass(frozen=True, slots=True)
class Scene:
    """A sequence made by this package, so that its truth is exact; the same arguments give the same bits."""

    name: str
    frames: tuple[Frame, ...]
    boxes: tuple[Box, ...]
    """The true box in each frame, pixels."""
    changes: tuple[int, ...] = ()
    """The frames in which the light or the brightness of the target changes abruptly."""
