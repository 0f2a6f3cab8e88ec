# SPDX-License-Identifier: MIT
"""Baselines: OpenCV's trackers, a scripted particle filter, and a box that never moves.

All run in the same loop as tricue's trackers. If a baseline reports failure, its last box is kept, with the
status LOST.
"""

import ctypes
import os
from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation.one_pass import AnyTracker
from tricue.track.base.track import Status, Track

NAMES = (
    *("CSRT", "KCF", "KCF-0.1", "MIL", "MOSSE", "MedianFlow"),  # of cv2, if the installed version has them
    *("CamShift", "meanShift", "script-pf", "still-box"),
)
SCRIPT_PARTICLES = 100
CONTRIB = "opencv-contrib-python-headless"  # the package whose cv2 has all of them
_IN_CONTRIB = ("CSRT", "KCF", "KCF-0.1", "MIL", "MOSSE", "MedianFlow", "Boosting", "TLD")
Maker = Callable[[int], AnyTracker]
"""Makes a tracker from a seed."""


class StillBox:
    """The lower bound: the first box in every frame."""

    def init(self, frame: Frame, box: Box) -> Track:
        self._track = Track(box, 1.0, Status.TRACKED)
        return self._track

    def update(self, frame: Frame) -> Track:
        return self._track


class OpenCVBaseline:
    """A ``cv2.Tracker``, created by ``make`` at each init, with the interface of tricue's trackers."""

    def __init__(self, make: Callable[[], Any]) -> None:
        self._make = make

    def init(self, frame: Frame, box: Box) -> Track:
        self._tracker = self._make()
        self._tracker.init(bgr(frame), box.as_int())
        self._box = box
        return Track(box, 1.0, Status.TRACKED)

    def update(self, frame: Frame) -> Track:
        try:
            found, box = self._tracker.update(bgr(frame))
        except cv2.error:  # some raise when their box leaves the image
            found = False
        if not found or min(box[2:]) <= 0:
            return Track(self._box, 0.0, Status.LOST)
        self._box = Box(*map(float, box))
        return Track(self._box, 1.0, Status.TRACKED)


class HueShift:
    """meanShift or CamShift on the back-projected hue histogram, as in OpenCV's tutorial."""

    def __init__(self, shift: Callable[..., Any]) -> None:
        self._shift = shift

    def init(self, frame: Frame, box: Box) -> Track:
        patch = crop(cv2.cvtColor(bgr(frame), cv2.COLOR_BGR2HSV), box)
        colorful = cv2.inRange(patch, np.array([0, 60, 32]), np.array([180, 255, 255]))
        histogram = cv2.calcHist([patch], [0], colorful, [180], [0, 180])
        self._histogram = cv2.normalize(histogram, None, 0, 255, cv2.NORM_MINMAX)  # type: ignore[call-overload]
        self._window = box.as_int()
        return Track(box, 1.0, Status.TRACKED)

    def update(self, frame: Frame) -> Track:
        hsv = cv2.cvtColor(bgr(frame), cv2.COLOR_BGR2HSV)
        back_projection = cv2.calcBackProject([hsv], [0], self._histogram, [0, 180], 1)
        stop = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_COUNT, 10, 1)
        _, window = self._shift(back_projection, self._window, stop)
        found = min(window[2:]) > 0
        self._window = window if found else self._window
        return Track(Box(*map(float, self._window)), float(found), Status.TRACKED if found else Status.LOST)


class ScriptedParticleFilter:
    """A particle filter that a user may write in twenty lines: cv2's HS histograms, the rest in NumPy."""

    def __init__(self, seed: int = 0) -> None:
        self._rng = np.random.default_rng(seed)

    def init(self, frame: Frame, box: Box) -> Track:
        self._size = np.array(box[2:])
        self._model = self._histogram(cv2.cvtColor(bgr(frame), cv2.COLOR_BGR2HSV), box)
        self._states = np.tile([*box.center, 1.0], (SCRIPT_PARTICLES, 1))  # x, y, scale
        return Track(box, 1.0, Status.TRACKED)

    def update(self, frame: Frame) -> Track:
        hsv = cv2.cvtColor(bgr(frame), cv2.COLOR_BGR2HSV)
        self._states += self._rng.normal(0, [8, 8, 0.02], self._states.shape)
        self._states = np.clip(self._states, [0, 0, 0.3], [hsv.shape[1] - 1, hsv.shape[0] - 1, 3])
        histograms = [self._histogram(hsv, self._box(state)) for state in self._states]
        distances = np.array(
            [cv2.compareHist(self._model, each, cv2.HISTCMP_BHATTACHARYYA) for each in histograms]
        )
        weights = np.exp(-20 * distances**2)
        weights /= weights.sum()
        box = self._box(weights @ self._states)
        self._states = self._states[self._rng.choice(SCRIPT_PARTICLES, SCRIPT_PARTICLES, p=weights)]
        return Track(box, float(1 - weights @ distances), Status.TRACKED)

    def _box(self, state: NDArray[np.float64]) -> Box:
        x, y, scale = state.tolist()
        width, height = (self._size * scale).tolist()
        return Box(x - width / 2, y - height / 2, width, height)

    def _histogram(self, hsv: Any, box: Box) -> Any:
        histogram = cv2.calcHist([crop(hsv, box)], [0, 1], None, [16, 8], [0, 180, 0, 256])
        return cv2.normalize(histogram, None, 1, 0, cv2.NORM_L1)  # type: ignore[call-overload]


def bgr(frame: Frame) -> Any:
    """The color image; baselines need no other channel. ValueError if it is missing."""
    frame.require("color")
    return frame.color


def crop(image: Any, box: Box) -> Any:
    """The pixels of a box, clipped to the image; at least one."""
    x, y, width, height = box.as_int()
    left, top = min(max(x, 0), image.shape[1] - 1), min(max(y, 0), image.shape[0] - 1)
    return image[top : max(y + height, top + 1), left : max(x + width, left + 1)]


def _opencv_makers() -> dict[str, Callable[[], Any]]:
    """Functions that make cv2's trackers; parameters are created here, because cv2's first ones are slow."""
    legacy = getattr(cv2, "legacy", None)
    makers: dict[str, Callable[[], Any]] = {}
    csrt, kcf = getattr(cv2, "TrackerCSRT", None), getattr(cv2, "TrackerKCF", None)
    if csrt:
        makers["CSRT"] = csrt.create
    if kcf:
        low_threshold = kcf.Params()
        low_threshold.detect_thresh = 0.1
        makers["KCF"] = kcf.create
        makers["KCF-0.1"] = lambda: kcf.create(low_threshold)
    if mil := getattr(cv2, "TrackerMIL", None):
        makers["MIL"] = mil.create
    for name in ("MOSSE", "MedianFlow"):
        if hasattr(legacy, f"Tracker{name}"):
            makers[name] = getattr(legacy, f"Tracker{name}").create
    return makers


def missing_reason(name: str, *others: str) -> str:
    """Why the installed cv2 can't run trackers, by their names here or in cv2, and which package can."""
    plain = name.removesuffix("_create").removeprefix("legacy.").removeprefix("Tracker")
    missing = f"cv2 {cv2.__version__} has {'none of them' if others else f'no {name}'}"
    if plain in _IN_CONTRIB:
        return f"{missing}; {CONTRIB} has (uninstall the other opencv packages first: all of them are cv2)"
    there = [each for each in dir(cv2) if each.startswith("Tracker") and "_" not in each]
    return f"{missing}; it has {', '.join(there)}"


def seed(value: int) -> None:
    """Seed the random numbers of OpenCV's trackers: OpenCV's own generator and, for MIL, the C library's
    ``rand``.
    """
    cv2.setRNGSeed(value)
    if os.name == "posix":
        ctypes.CDLL(None).srand(value)


def available() -> dict[str, Maker]:
    """Makers of the baselines that the installed cv2 has, by name; few use their seed."""

    def opencv(make: Callable[[], Any]) -> Maker:
        return lambda seed: OpenCVBaseline(make)

    return {
        **{name: opencv(make) for name, make in _opencv_makers().items()},
        "CamShift": lambda seed: HueShift(cv2.CamShift),
        "meanShift": lambda seed: HueShift(cv2.meanShift),
        "script-pf": ScriptedParticleFilter,
        "still-box": lambda seed: StillBox(),
    }
