# SPDX-License-Identifier: MIT
"""Third-party tracker classes, adapted to the interface of tricue's trackers."""

from collections.abc import Callable
from typing import Any

from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.errors import BoxNeededError
from tricue.track.base.track import Status, Track
from tricue.track.base.traits import Channels, Traits

ADAPTED_TRAITS = Traits(channels=(Channels.of("color"),), follows="what its class says", source="not ours")
_ADAPTED: dict[Any, Any] = {}  # adapted classes by original class, so that each is adapted once


def traits_of(tracker: Any) -> Traits:
    """The traits of a tracker or its class; of one that has none those of a plain one."""
    found = getattr(tracker, "traits", None)
    return found if isinstance(found, Traits) else ADAPTED_TRAITS


def adapt_class(cls: Any) -> Any:
    """The class itself if it has ``traits``; otherwise a class of the same name with tricue's interface.

    A third-party class needs only ``init(frame, box)`` and ``update(frame)``: frame is a ``tricue.Frame``,
    box (x, y, width, height). They may return a ``Track``, a box, or None for a lost target. The class is
    assumed to need color and an initial box, and to draw no random numbers. TypeError if a method is missing.
    """
    if traits_of(cls) is not ADAPTED_TRAITS:
        return cls
    if not all(callable(getattr(cls, name, None)) for name in ("init", "update")):
        raise TypeError(f"{cls.__qualname__}: expected a class with init(frame, box) and update(frame)")
    if cls not in _ADAPTED:
        _ADAPTED[cls] = type(cls.__name__, (_Adapted,), {"_cls": cls, "__doc__": cls.__doc__})
    return _ADAPTED[cls]


class _Adapted:
    """Accepts ``seed`` and ``kernels`` as every tracker does, and passes the other keywords on."""

    traits = ADAPTED_TRAITS
    Params = None
    _cls: Callable[..., Any]

    def __init__(self, *, seed: int = 0, kernels: str = "native", **params: Any) -> None:
        self.seed, self.kernels, self.params = seed, kernels, params
        self.tracker = type(self)._cls(**params)
        self._box = Box(0, 0, 0, 0)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on ``box``."""
        if box is None:
            raise BoxNeededError("box: expected (x, y, width, height), got None")
        self._box = as_box(box)
        given = self.tracker.init(_require_color(frame), self._box)
        return self._track(self._box if given is None else given)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame."""
        return self._track(self.tracker.update(_require_color(frame)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (type(self)._cls, self.__dict__)

    def _track(self, given: Any) -> Track:
        if isinstance(given, Track):
            return given
        if given is None:
            return Track(self._box, 0.0, Status.LOST)
        self._box = as_box(given)
        return Track(self._box, 1.0, Status.TRACKED)


def _restore(cls: type[Any], values: dict[str, Any]) -> Any:
    tracker = object.__new__(adapt_class(cls))
    tracker.__dict__.update(values)
    return tracker


def _require_color(frame: FrameLike) -> Frame:
    channels = as_frame(frame)
    channels.require("color")
    return channels
