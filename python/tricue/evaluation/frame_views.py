# SPDX-License-Identifier: MIT
"""What a tracker gets of a frame: the channels that it uses, or depth as a picture."""

from collections.abc import Callable

from tricue.camera.frame import Frame
from tricue.draw.depth_pictures import depth_picture, depth_range

FrameView = Callable[[Frame], Frame]
"""Selects the channels of a frame that a tracker gets; its time isn't measured."""


def depth_as_picture() -> FrameView:
    """Renders depth as a picture in the color channel, with the depth range of the first frame."""
    depth_limits: list[tuple[float, float]] = []

    def view(frame: Frame) -> Frame:
        frame.require("depth")
        assert frame.depth is not None
        if not depth_limits:
            depth_limits.append(depth_range(frame.depth) or (0.0, 1.0))
        return Frame(depth_picture(frame.depth, *depth_limits[0]), timestamp=frame.timestamp)

    return view


def select_channels(names: frozenset[str], frame: Frame) -> Frame:
    """The frame with these channels only."""
    channels = {name: getattr(frame, name) for name in names}
    return Frame(**channels, timestamp=frame.timestamp)
