# SPDX-License-Identifier: MIT
"""A frame that several trackers use: common results are computed once, and each warning is given once."""

import warnings
from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from tricue.camera.frame import Frame

T = TypeVar("T")
_ATTRIBUTES = ("color", "depth", "right", "timestamp", "pose")


class SharedFrame(Frame):
    """A frame that caches results computed from it, and collects the warnings about it.

    messages: the texts of the trackers' warnings, each once.
    """

    __slots__ = ("_computed", "messages")
    _computed: dict[Hashable, Any]
    messages: list[str]

    def __init__(self, **channels: Any) -> None:
        """channels: the attributes of a :class:`Frame`, which was checked; they aren't checked again."""
        for name in _ATTRIBUTES:
            object.__setattr__(self, name, channels.get(name))
        object.__setattr__(self, "_computed", {})
        object.__setattr__(self, "messages", [])

    @classmethod
    def of(cls, frame: Frame) -> "SharedFrame":
        """A shared frame with a frame's channels, which aren't copied."""
        return cls(**{name: getattr(frame, name) for name in _ATTRIBUTES})

    def with_own_images(self) -> "SharedFrame":
        """The same with copies of the images, for a tracker that may write to them; messages stay common."""
        values = {name: getattr(self, name) for name in _ATTRIBUTES}
        images = {name: values[name].copy() for name in self.channels}
        own = SharedFrame(**values | images)
        object.__setattr__(own, "messages", self.messages)
        return own


def once(frame: Frame, function: Callable[..., T], *arguments: Any) -> T:
    """``function(frame, *arguments)``; for a shared frame it is computed once for each set of arguments.

    Arguments must be hashable. The result must not refer to the frame itself: the cycle would keep its images
    in memory for too long.
    """
    if not isinstance(frame, SharedFrame):
        return function(frame, *arguments)
    key = (function, *arguments)
    if key not in frame._computed:
        frame._computed[key] = function(frame, *arguments)
    found: T = frame._computed[key]
    return found


def messages_of(frame: Frame) -> list[str] | None:
    """The list that collects warnings about the frame; None if they are shown at once."""
    return frame.messages if isinstance(frame, SharedFrame) else None


def warn_of_frame(messages: list[str] | None, message: str, stacklevel: int) -> None:
    """Collect a warning (UserWarning) about a frame, or show it.

    messages: as from :func:`messages_of`. stacklevel: as in warnings.warn, counted from the caller.
    """
    if messages is None:
        warnings.warn(message, UserWarning, stacklevel=stacklevel + 1)
    elif message not in messages:
        messages.append(message)
