# SPDX-License-Identifier: MIT
"""A third-party tracker in its own process: inspects it, creates it, and gets its tracks."""

import inspect
import json
import random
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation import baselines
from tricue.track.base import registry
from tricue.track.base.adapter import check_track, is_of_cv2, takes_seed
from tricue.track.base.track import Status, Track
from tricue.track.base.traits import Channels, Traits

CV2, TRAX = "cv2:", "trax:"  # prefixes of the places of cv2's trackers and of programs
PlainTrack = tuple[tuple[float, ...], float, str, Any, Any]
"""Box, score, status, position and covariance, in types that any process can unpickle."""


class Description(NamedTuple):
    """What is known of a tracker before it is created. version: identifies its code, as JSON."""

    traits: Traits
    version: str


class Host:
    """One tracker. place: ``module:Class``, ``file.py:Class``, ``cv2:Name`` or ``trax:command``."""

    def __init__(self, place: str) -> None:
        self._place = place
        self._tracker: Any = None

    def describe(self, settings: Mapping[str, Any]) -> Description:
        """Its traits and version. ValueError, TypeError, OSError or ImportError if it can't be found or
        doesn't take the settings.
        """
        if self._place.startswith(TRAX):
            from tricue.evaluation.toolkits.trax_client import program_channels, program_version

            command = self._place.removeprefix(TRAX)
            traits = Traits(channels=(Channels(program_channels(command)),))
            return Description(traits, json.dumps(program_version(command)))
        if self._place.startswith(CV2):
            cv2_maker(self._place)
            return Description(Traits(channels=(Channels.of("color"),)), json.dumps({"cv2": cv2.__version__}))
        found = registry.tracker_class(self._place)
        _check_settings(found, settings)
        version = {"code": registry.code_digest(self._place), **settings}
        return Description(found.traits, json.dumps(version, default=str))

    def make(self, keywords: Mapping[str, Any], seed: int) -> None:
        """Create the tracker, replacing the previous one, and seed all common random number generators."""
        self.close()
        random.seed(seed)
        np.random.seed(seed)  # noqa: NPY002 (theirs may draw from it)
        baselines.seed(seed)
        self._tracker = self._made(keywords, seed)

    def init(self, frame: Frame, box: Box) -> PlainTrack:
        """The track of the first frame."""
        return _to_plain(self._tracker.init(frame, box), "init")

    def update(self, frame: Frame) -> tuple[PlainTrack, float]:
        """The track, and the seconds that it took."""
        start = time.perf_counter()
        track = self._tracker.update(frame)
        seconds = time.perf_counter() - start
        if self._place.startswith(TRAX):
            seconds = self._tracker.update_seconds  # without the time to write images
        return _to_plain(track, "update"), seconds

    def close(self) -> None:
        """End a program that was started."""
        tracker, self._tracker = self._tracker, None
        if tracker is not None and self._place.startswith(TRAX):
            tracker.close()

    def _made(self, keywords: Mapping[str, Any], seed: int) -> Any:
        if self._place.startswith(TRAX):
            from tricue.evaluation.toolkits.trax_client import TraxProgram

            return TraxProgram(self._place.removeprefix(TRAX))
        if self._place.startswith(CV2):
            return baselines.OpenCVBaseline(cv2_maker(self._place))
        made = registry.create(self._place, seed=seed, **keywords)
        if is_of_cv2(inner := getattr(made, "tracker", None)):  # from a function that makes one of cv2's
            return baselines.OpenCVBaseline(lambda: inner)
        return made


def cv2_maker(place: str) -> Callable[[], Any]:
    """The function that creates a cv2 tracker, such as ``cv2:TrackerMIL`` or ``cv2:legacy.TrackerMOSSE``. If
    the installed cv2 doesn't have it, ValueError says which package does.
    """
    name = place.removeprefix(CV2)
    found: Any = cv2
    for part in name.removesuffix("_create").split("."):
        found = getattr(found, part, None)
    make: Callable[[], Any] | None = getattr(found, "create", None)
    if make is None:
        raise ValueError(f"{place}: {baselines.missing_reason(name)}")
    return make


def _check_settings(made: Any, settings: Mapping[str, Any]) -> None:
    if made.Params is not None:
        made.Params(**settings)
    elif settings:
        with suppress(ValueError):  # some compiled ones have no signature
            seed = {"seed": 0} if takes_seed(made._cls) else {}
            cameras = dict.fromkeys(made.traits.camera)
            inspect.signature(made._cls).bind(**{**seed, **cameras, **settings})


def _to_plain(track: Any, method: str) -> PlainTrack:
    checked = check_track(track, method)
    position, covariance = (
        None if value is None else _finite_or_nan(np.asarray(value, dtype=np.float64).reshape(shape))
        for value, shape in ((checked.position, 3), (checked.covariance, (3, 3)))
    )
    box = tuple(map(float, checked.box))
    return box, float(checked.score), Status(checked.status).value, position, covariance


def _finite_or_nan(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """The values with NaN (unknown) in place of infinity, which may come from a division by 0."""
    return np.where(np.isfinite(values), values, np.nan)


def from_plain(plain: PlainTrack) -> Track:
    """The track with these values."""
    box, score, status, position, covariance = plain
    return Track(Box(*box), score, Status(status), position, covariance)
