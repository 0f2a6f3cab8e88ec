# SPDX-License-Identifier: MIT
"""Third-party tracker classes, adapted to the interface of tricue's trackers."""

import copy
import inspect
import math
from collections.abc import Callable, Container
from dataclasses import replace
from numbers import Real
from typing import Any

import numpy as np

from tricue.camera.box import Box, BoxLike, as_box
from tricue.camera.frame import Frame, FrameLike, as_frame
from tricue.camera.shared_frame import SharedFrame
from tricue.errors import BoxNeededError
from tricue.track.base.frame_image import FrameImage
from tricue.track.base.track import Status, Track
from tricue.track.base.traits import Channels, Traits
from tricue.track.base.validation import require_initialized

ADAPTED_TRAITS = Traits(channels=(Channels.of("color"),), follows="what its class says", source="not ours")
_ADAPTED: dict[Any, Any] = {}  # adapted classes by original class, so that each is adapted once
_ANSWERS = "a Track, a box (x, y, width, height), (found, box), (box, score), or None for a lost target"


def traits_of(tracker: Any) -> Traits:
    """The traits of a tracker or its class; without any, those of a plain tracker."""
    found = getattr(tracker, "traits", None)
    return found if isinstance(found, Traits) else ADAPTED_TRAITS


def adapt_class(cls: Any) -> Any:
    """The class itself if it has ``traits`` and ``Params``; otherwise a class of the same name with tricue's
    interface.

    A third-party tracker needs only ``init(image, box)`` and ``update(image)``, in a class or in the result
    of a function. image: BGR (H, W, 3) uint8, with a frame's other parts as attributes such as ``timestamp``;
    a ``tricue.Frame`` if ``init`` is annotated so. box: (x, y, width, height). ``update`` returns a
    ``Track``, a box, (found, box) as cv2's trackers do, (box, score), or None for a lost target; a box of NaN
    or infinity counts as lost, too. score: any finite number, higher for more confidence. Without ``traits``,
    the tracker is assumed to need color and an initial box, and to draw random numbers if it takes a
    ``seed``. With ``traits``, it gets a ``tricue.Frame``, its constructor the camera that they name, and, if
    they say that it detects targets, ``init`` also None as the box, and then returns a ``Track``; overlays
    show its box alone. TypeError if a method is missing.
    """
    declared = traits_of(cls)
    if declared is not ADAPTED_TRAITS and hasattr(cls, "Params"):
        return cls
    if isinstance(cls, type) and not _is_tracker(cls):
        raise TypeError(f"{cls.__qualname__}: expected a class with init(frame, box) and update(frame)")
    if cls not in _ADAPTED:
        plain = declared is ADAPTED_TRAITS
        random = takes_seed(cls) if plain else declared.random
        traits = replace(declared, random=random, shows=frozenset())
        members = {"_cls": staticmethod(cls), "__doc__": cls.__doc__, "traits": traits}
        _ADAPTED[cls] = type(getattr(cls, "__name__", "Adapted"), (_Adapted,), members)
    return _ADAPTED[cls]


def takes_seed(make: Callable[..., Any]) -> bool:
    """Whether a class or a function has a keyword ``seed``."""
    return "seed" in _keywords(make)


def _keywords(make: Callable[..., Any]) -> Container[str]:
    """The names of a class's or a function's arguments."""
    try:
        return inspect.signature(make).parameters
    except (TypeError, ValueError):  # some compiled ones have no signature
        return ()


def check_track(track: Any, method: str) -> Track:
    """A third party's track, if its box and score comply with the interface; ValueError otherwise. The box
    of a lost target may be unknown.
    """
    if not isinstance(track, Track):
        raise ValueError(f"{method}: expected a Track, got {track!r:.80}")
    lost = track.status is Status.LOST and not all(map(math.isfinite, track.box))
    box = track.box if lost else as_box(track.box, f"{method} returned a box")
    if not (isinstance(track.score, Real) and math.isfinite(track.score)):
        raise ValueError(f"{method}: expected a finite score, got {track.score!r:.80}")
    return replace(track, box=box)


def with_known_numbers(track: Track, last: Box) -> Track:
    """The track with finite numbers only, as files and pictures need them.

    If a third party's box of a lost target is unknown, it becomes the ``last`` one. A position, covariance or
    depth that isn't finite becomes None, and a position given as a tuple an array.
    """
    known: dict[str, Any] = {} if all(map(math.isfinite, track.box)) else {"box": last}
    for name in ("position", "covariance"):
        value = getattr(track, name)
        array = None if value is None else np.asarray(value, np.float64)
        if array is not None and not np.isfinite(array).all():
            array = None
        if array is not value:
            known[name] = array
    if track.depth is not None and not math.isfinite(track.depth):
        known["depth"] = None
    return replace(track, **known) if known else track


def check_is_tracker(value: Any) -> None:
    """TypeError for anything but a tracker."""
    is_class = isinstance(value, type)  # a class has the methods, too
    if is_class or not _is_tracker(value):
        got = f"the class {value.__name__}" if is_class else type(value).__name__
        raise TypeError(f"tracker: expected a tricue tracker, got {got}")


def is_of_cv2(tracker: Any) -> bool:
    """Whether it is one of cv2's own trackers."""
    return type(tracker).__module__.partition(".")[0] == "cv2"


class _Adapted:
    """Accepts ``seed`` and ``kernels`` as every tracker does, and passes the other keywords on."""

    traits = ADAPTED_TRAITS
    Params = None
    _cls: Callable[..., Any]

    def __init__(self, *, seed: int = 0, kernels: str = "native", **params: Any) -> None:
        self.seed, self.kernels, self.params = seed, kernels, params
        cls = type(self)._cls
        has_traits = traits_of(cls) is not ADAPTED_TRAITS
        common = {"seed": seed, "kernels": kernels} if has_traits else {"seed": seed}
        taken = {name: value for name, value in common.items() if name in _keywords(cls)}
        self.tracker = _maker(cls)(**taken, **params)
        if not _is_tracker(self.tracker):
            made = type(self.tracker).__name__
            raise TypeError(
                f"{type(self).__name__}: expected to make a tracker with init and update, got {made}"
            )
        self._takes_frame = has_traits or _takes_frame(self.tracker.init)
        self._box: Box | None = None  # the last known box, set by ``init``

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on ``box``; without it, if it detects targets, on one that it finds."""
        if box is None:
            if self.traits.detects is None:
                raise BoxNeededError("box: expected (x, y, width, height), got None")
            found = check_track(self.tracker.init(self._input(frame), None), "init")
            self._box = found.box
            return found
        first = as_box(box)
        start = first.as_int() if is_of_cv2(self.tracker) else first  # cv2 5 takes only integers
        given = self.tracker.init(self._input(frame), start)
        self._box = first
        if given is None or isinstance(given, (bool, np.bool_)):
            return Track(first, 1.0, Status.TRACKED)
        return self._track(given, "init", first)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame."""
        last = require_initialized(self._box)  # some of cv2's trackers crash without it
        return self._track(self.tracker.update(self._input(frame)), "update", last)

    def __copy__(self) -> Any:
        """A copy with the same state, but independent, as copies of tricue's trackers are."""
        return _restore(type(self)._cls, copy.deepcopy(self.__dict__))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restore, (type(self)._cls, self.__dict__)

    def _input(self, value: FrameLike) -> Frame | FrameImage:
        frame = as_frame(value)
        if self.traits.best(frame.channels) is None:
            frame.require(*self.traits.channels[-1].names)
        if isinstance(frame, SharedFrame):
            frame = frame.with_own_images()  # it may draw into them, and other targets need them
        return frame if self._takes_frame else FrameImage.of(frame)

    def _track(self, given: Any, method: str, last: Box) -> Track:
        if isinstance(given, Track):
            track = check_track(given, method)
            self._box = with_known_numbers(track, last).box
            return track
        found, box, score = _parts(given)
        if not found or box is None or _is_empty(box):
            return Track(last, 0.0, Status.LOST)
        try:
            found_box = as_box(box, f"{method} returned a box")
        except TypeError:
            raise ValueError(f"{method}: expected {_ANSWERS}, got {given!r:.80}") from None
        if not (isinstance(score, Real) and math.isfinite(score)):
            raise ValueError(f"{method}: expected a finite score, got {score!r:.80}")
        self._box = found_box
        return Track(found_box, float(score), Status.TRACKED)


def _maker(cls: Callable[..., Any]) -> Callable[..., Any]:
    """The function that makes the tracker; for cv2 ``create``, since trackers from its constructors crash."""
    is_cv2s = isinstance(cls, type) and cls.__module__.partition(".")[0] == "cv2"
    make: Callable[..., Any] = getattr(cls, "create", cls) if is_cv2s else cls
    return make


def _restore(cls: Callable[..., Any], values: dict[str, Any]) -> Any:
    tracker = object.__new__(adapt_class(cls))
    tracker.__dict__.update(values)
    return tracker


def _is_tracker(value: Any) -> bool:
    return all(callable(getattr(value, name, None)) for name in ("init", "update"))


def _takes_frame(init: Callable[..., Any]) -> bool:
    """Whether a method's first parameter is annotated as a frame."""
    try:
        first = next(iter(inspect.signature(init).parameters.values()))
    except (StopIteration, TypeError, ValueError):
        return False
    return first.annotation is not first.empty and "Frame" in str(first.annotation)


def _parts(given: Any) -> tuple[bool, Any, Any]:
    """Whether the target was found, the box, and the score, from an answer that isn't a Track."""
    if isinstance(given, (tuple, list)) and len(given) == 2:
        first, second = given
        if isinstance(first, (bool, np.bool_)):
            return bool(first), second, 1.0
        return True, first, second
    return True, given, 1.0


def _is_empty(box: Any) -> bool:
    """Whether a box means that the target is lost: its width and height are 0, as some trackers return, or it
    isn't finite, as after a division by 0.
    """
    try:
        numbers = [float(value) for value in box]
    except (TypeError, ValueError):
        return False
    return len(numbers) == 4 and not (all(map(math.isfinite, numbers)) and any(numbers[2:]))
