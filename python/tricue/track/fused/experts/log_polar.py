# SPDX-License-Identifier: MIT
"""Correlation filters in log-polar coordinates, in which a change of size or a turn is a shift.

The peak of their response gives that shift (Reddy and Chatterji 1996; Li, Zhu, Hoi, Song, Wang and Liu 2019).
They are running means over frames (Danelljan et al. 2014), because the size drifts with a filter that is
learned from one frame at a time.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats, Image, Plane
from tricue.kernels import Kernels
from tricue.track.base.params import parameter
from tricue.track.fused.experts.spectra import CHANNELS, FirstFrameParams, Spectra, label_spectrum
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.target import TURN_STEPS, Target, axes
from tricue.track.fused.window import CELL_PIXELS, PATCH_PIXELS, WINDOW_CELLS

P = TypeVar("P", bound="LogPolarParams")
E = TypeVar("E", bound="LogPolarExpert[Any]")  # typing.Self is newer than Python 3.10
Places = NDArray[np.int64]
FilterParts = tuple[Spectra, Plane]  # numerator and denominator

INNER_RADIUS, OUTER_RADIUS = 0.3, 2.5  # of the log-polar patch, in halves of the box's sides
LABEL_WIDTH = 0.7  # cells
MAX_SHIFT = 2, 1  # cells to the right and down, between consecutive frames
STEPS_PER_CELL = TURN_STEPS // WINDOW_CELLS
LOG_PER_CELL = CELL_PIXELS * math.log(OUTER_RADIUS / INNER_RADIUS) / PATCH_PIXELS


@dataclass(frozen=True, kw_only=True)
class LogPolarParams(FirstFrameParams):
    """The parameters of the cues "size" and "turn"."""

    size_learning_rate: float = parameter(
        0.025,
        unit="per frame",
        source="Danelljan et al. 2014",
        low=0,
        high=0.5,
        doc="learning rate of the filters of size and turn",
        was="filter_rate",
    )
    ridge: float = parameter(
        1e-2, unit="of the mean energy", source=PROTOTYPE, above=0, doc="regularization of these filters"
    )
    size_change_penalty: float = parameter(
        0.05,
        unit="per squared cell",
        source=PROTOTYPE,
        low=0,
        doc="penalty on the evidence of another size or turn than the last",
    )


class LogPolarPatch(NamedTuple):
    """(64, 64, 3) samples around a target, and log-polar coordinates in them.

    places: (64, 64) indices of the pixels at the coordinates. taper: (32, 32) weights of the cells.
    """

    samples: Image
    places: Places
    taper: Plane


class LogPolarFilter(NamedTuple):
    """A correlation filter on a patch in log-polar coordinates.

    learned, first: numerator (19, 32, 17) and denominator (32, 17), as learned until now and from the first
    frame. applied: (1, 19, 32, 17) the filter that is applied: the quotient after mixing in a share of the
    first frame's.
    """

    learned: FilterParts
    first: FilterParts
    applied: Spectra

    @classmethod
    def from_patch(cls, k: Kernels, patch: LogPolarPatch, p: LogPolarParams) -> "LogPolarFilter":
        """The filter learned from the first frame."""
        empty = np.zeros((CHANNELS, *LABEL.shape), np.complex64), np.zeros(LABEL.shape, np.float32)
        begun = cls(empty, empty, empty[0])._learn(k, patch, (1.0, 0.0, p.ridge))
        return begun._replace(first=begun.learned)

    def learn(self, k: Kernels, patch: LogPolarPatch, rate: float, p: LogPolarParams) -> "LogPolarFilter":
        """The filter with a patch blended in."""
        return self._learn(k, patch, (rate, p.first_frame_weight, p.ridge))

    def _learn(self, k: Kernels, patch: LogPolarPatch, rates: tuple[float, float, float]) -> "LogPolarFilter":
        """rates: the learning rate, the first frame's share, and the ridge."""
        learned, applied = k.learn_size_filter(*patch, LABEL, self.learned, self.first, *rates)
        return LogPolarFilter(learned, self.first, applied)


@dataclass(frozen=True)
class LogPolarExpert(ABC, Generic[P]):
    """A filter on log-polar coordinates around the target; a subclass says which, and what a shift means."""

    filter: LogPolarFilter
    params: P

    @classmethod
    def from_target(cls: type[E], observation: PictureObservation, target: Target, p: P) -> E:  # noqa: PYI019
        """The expert learned from the first frame."""
        return cls(LogPolarFilter.from_patch(observation.k, cls._read(observation, target), p), p)

    def learn(self: E, observation: PictureObservation, target: Target, rate: float) -> E:  # noqa: PYI019
        """The expert with a target blended in."""
        patch = self._read(observation, target)
        return type(self)(self.filter.learn(observation.k, patch, rate, self.params), self.params)

    def _shift(self, observation: PictureObservation, target: Target) -> tuple[float, float]:
        """Cells by which what is at a target's place has shifted to the right, and the response to that."""
        patch, penalty = self._read(observation, target), self.params.size_change_penalty
        return observation.k.log_polar_shift(*patch, self.filter.applied, (*MAX_SHIFT, penalty))

    @staticmethod
    @abstractmethod
    def _read(observation: PictureObservation, target: Target) -> LogPolarPatch:
        """What the filter sees of a target's place."""


def log_polar_pixels(turn: int = 0, width: float = 1.0, height: float = 1.0) -> Places:
    """(64, 64) indices of pixels in a square patch, by angle from a target's axis (downward) and log radius
    (to the right).

    The patch shows the target and its surround. width, height: the target's, relative to the longer one.
    At small radii, several samples share a pixel. This favors the present size, so that a new size is
    approached over a few frames. Bilinear samples find it at once, but let the size drift on recorded video.
    """
    steps = (np.arange(PATCH_PIXELS) + 0.5) / PATCH_PIXELS
    radius = PATCH_PIXELS / 2 * (INNER_RADIUS / OUTER_RADIUS) ** (1 - steps)
    angle = 2 * math.pi * steps[:, None]
    right, down = width * radius * np.cos(angle), height * radius * np.sin(angle)
    cosine, sine = axes(turn)
    return _nearest(sine * right + cosine * down) * PATCH_PIXELS + _nearest(cosine * right - sine * down)


def _nearest(offset: Floats) -> Places:
    """The pixels at these distances from the middle of a patch, along one axis."""
    return np.clip(np.floor(PATCH_PIXELS / 2 + offset), 0, PATCH_PIXELS - 1).astype(np.int64)


def _taper() -> Plane:
    """The weights (32, 32) that taper toward the smallest and largest radius; angles wrap around."""
    profile = np.sin(np.pi * (np.arange(WINDOW_CELLS) + 0.5) / WINDOW_CELLS)
    return np.tile(profile, (WINDOW_CELLS, 1)).astype(np.float32)


TAPER: NDArray[np.float32] = _taper()
LABEL = label_spectrum(LABEL_WIDTH)
