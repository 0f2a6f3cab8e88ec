# SPDX-License-Identifier: MIT
"""Views of a frame for a tracker: the channels that it uses, or depth as a picture."""

from collections.abc import Callable

from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_picture, depth_range

FrameView = Callable[[Frame], Frame]
"""Selects the channels of a frame that a tracker gets; not part of the measured time."""


def depth_as_picture() -> FrameView:
    """A view that renders depth as a picture in the color channel, in the first frame's depth range."""
    depth_limits: list[tuple[float, float]] = []

    def view(frame: Frame) -> Frame:
        frame.require("depth")
        assert frame.depth is not None
        if not depth_limits:
            depth_limits.append(depth_range(frame.depth) or (0.0, 1.0))
        return Frame(depth_picture(frame.depth, *depth_limits[0]), timestamp=frame.timestamp)

    return view


def select_channels(names: frozenset[str], frame: Frame) -> Frame:
    """The frame with only these channels."""
    channels = {name: getattr(frame, name) for name in names}
    return Frame(**channels, timestamp=frame.timestamp)
