# SPDX-License-Identifier: MIT
"""A frame, checked for the cues that are used."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from numpy.typing import NDArray

from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.errors import MissingChannelError
from tricue.track.base import validation


class CueInput(NamedTuple):
    """A frame with the channels that the cues need, and the image in whose pixels the box is given."""

    frame: Frame
    image: NDArray[Any]


def require_cue_channels(
    frame: FrameLike,
    cues: Sequence[str],
    shape: tuple[int, ...] | None = None,
    camera: StereoRig | Intrinsics | None = None,
) -> CueInput:
    """The frame, checked for the cues flow, disparity or both.

    ValueError for a missing channel, for depth whose shape isn't the color image's (it has to be registered
    to color), and for a shape other than the first frame's; for disparity alone its height and width count,
    as color may be missing in some frames that have depth. camera: the tracker's, for the error.
    """
    channels = as_frame(frame)
    if "flow" in cues or channels.depth is None:
        channels.require("color")
    if "disparity" in cues and channels.depth is None and channels.right is None:
        hint = "cues=('flow',) needs neither"
        raise MissingChannelError(f"frame: expected the channel right or depth, got color; {hint}", "right")
    image: Any = channels.depth if channels.color is None else channels.color
    name = "depth" if channels.color is None else "color"
    axes = 3 if "flow" in cues else 2
    if shape is not None and image.shape[:axes] != shape[:axes]:
        raise validation.changed_size(f"frame.{name}", "shape", shape, image.shape, camera)
    if "disparity" in cues and channels.depth is not None:
        validation.check_depth_size(channels.depth, image.shape[:2])
    return CueInput(channels, image)
