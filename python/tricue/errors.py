# SPDX-License-Identifier: MIT
"""Errors that callers tell apart, and errors as users read them."""


class MissingChannelError(ValueError):
    """A frame lacks a channel that the tracker needs: ``channel``, one of "color", "depth", "right"."""

    def __init__(self, message: str, channel: str = "") -> None:
        super().__init__(message)
        self.channel = channel


class UnregisteredDepthError(ValueError):
    """The depth image isn't registered to color: its shape differs from the color image's."""


class BoxError(ValueError):
    """A tracker can't start on this box: it isn't a box, it is outside the image, or nothing in it can be
    tracked.
    """


class BoxNeededError(BoxError):
    """``init`` got no box, and the tracker doesn't look for its target by itself."""


class TargetNotFoundError(BoxError):
    """``init`` got no box, and the tracker found no target in this frame; another frame may have one."""


class NoDepthInBoxError(BoxError):
    """Nothing in the box has a depth, or a disparity, in the range that the tracker uses."""


class WorkerEndedError(RuntimeError):
    """A worker process of a MultiTracker was killed; its targets are gone."""


def one_line(error: BaseException) -> str:
    """The message of an error, in one line."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return " ".join(str(error).split()) or type(error).__name__
