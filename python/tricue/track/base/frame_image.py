# SPDX-License-Identifier: MIT
"""A frame for trackers written for images: its color image, with the frame's other parts as attributes."""

from typing import Any

import numpy as np

from tricue.camera.frame import Frame
from tricue.camera.pose import Pose


class FrameImage(np.ndarray[Any, Any]):
    """A color image, (H, W, 3) or (H, W) uint8, that also has a :class:`tricue.Frame`'s attributes.

    cv2 and NumPy accept it as an array. Arrays computed from it, such as a crop, have no frame: their
    attributes are None.
    """

    frame: Frame | None

    @classmethod
    def of(cls, frame: Frame) -> "FrameImage":
        """A frame's color image, without a copy; MissingChannelError if there is none."""
        frame.require("color")
        assert frame.color is not None
        image = frame.color.view(cls)
        image.frame = frame
        return image

    def __array_finalize__(self, parent: Any) -> None:
        self.frame = None

    @property
    def color(self) -> Any:
        """The image itself, as a plain array."""
        return np.asarray(self)

    @property
    def depth(self) -> Any:
        """Meters, as in :class:`tricue.Frame`."""
        return None if self.frame is None else self.frame.depth

    @property
    def right(self) -> Any:
        """The right image of a stereo pair."""
        return None if self.frame is None else self.frame.right

    @property
    def timestamp(self) -> float | None:
        """Seconds."""
        return None if self.frame is None else self.frame.timestamp

    @property
    def pose(self) -> Pose | None:
        """The camera's pose."""
        return None if self.frame is None else self.frame.pose
