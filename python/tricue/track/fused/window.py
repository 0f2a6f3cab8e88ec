# SPDX-License-Identifier: MIT
"""Square windows of a frame around a target: the part that the experts read."""

from dataclasses import dataclass

import numpy as np

from tricue.arrays import Floats, Image, Plane
from tricue.track.base.params import Params, parameter
from tricue.track.fused.depth_sources import DepthImageSource, DepthPosterior, Grid
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.support import find_support
from tricue.track.fused.target import Target

WINDOW_CELLS = 32  # on a side
CELL_PIXELS = 2  # patch pixels on a side
PATCH_PIXELS = CELL_PIXELS * WINDOW_CELLS  # on a side
NO_PLANE: Plane = np.empty((0, 0), np.float32)  # where a cue has no evidence
INNER_SHARE = 0.8  # of the box's sides: the part whose pixels are mostly the target's
SUPPORT_POSTERIOR = np.float32(0.05)  # upper bound of P(target | depth) for what the target stands on


@dataclass(frozen=True, kw_only=True)
class WindowParams(Params):
    """The size of the part of the frame that the experts read."""

    context: float = parameter(
        3.0, unit="target", source=PROTOTYPE, low=1.5, high=8, doc="side of the window"
    )


class Window:
    """A square window around a target.

    patch: (64, 64, 3) BGR samples. pixel_size: image pixels per patch pixel. target: the one that the window
    is centered on. size: the target's width and height in patch pixels.
    depth: what depth tells about the (64, 64) patch pixels; None without depth, or if no depth is expected.
    In a picture of depth, it excludes what the target stands on, which looks like the target there; in a
    picture of color, color tells them apart.
    has_occluder: whether an occluder covers any part of the window.
    """

    def __init__(
        self, observation: PictureObservation, target: Target, patch: Image, pixel_size: float
    ) -> None:
        self.observation, self.target, self.patch, self.pixel_size = observation, target, patch, pixel_size
        self.size = target.width / pixel_size, target.height / pixel_size
        self.depth = self._measure_depth()
        # The fastest way to find a 1.
        self.has_occluder = self.depth is not None and 1 in self.depth.occluded.tobytes()

    @property
    def depth_posterior(self) -> Plane:
        """(64, 64) P(target | depth); NO_PLANE if ``depth`` is None."""
        return NO_PLANE if self.depth is None else self.depth.posterior

    @property
    def posterior_without_support(self) -> Plane:
        """(64, 64) ``depth_posterior``, excluding what the target stands on."""
        if self.depth is None or self.observation.kind == "depth":
            return self.depth_posterior
        return self._without_support(self.depth.posterior)

    def _measure_depth(self) -> DepthPosterior | None:
        depth = self.observation.depth_posterior(*self._grid, PATCH_PIXELS)
        if depth is None or self.observation.kind == "color":
            return depth
        return depth._replace(posterior=self._without_support(depth.posterior))

    @property
    def _grid(self) -> Grid:
        half = PATCH_PIXELS / 2 * self.pixel_size
        return self.target.x - half, self.target.y - half, self.pixel_size

    def _without_support(self, posterior: Plane) -> Plane:
        source, expected = self.observation.depth_source, self.observation.expected_depth
        if expected is None or not isinstance(source, DepthImageSource):
            return posterior
        k, camera = self.observation.k, self.observation.camera
        support = find_support(k, source.depth, self._grid, PATCH_PIXELS, self.size, expected.z, camera)
        without: Plane = posterior.copy()
        np.minimum(posterior, SUPPORT_POSTERIOR, out=without, where=support)
        return without

    def inner(self, right: float = 0.0, down: float = 0.0, share: float = 1.0) -> tuple[slice, slice]:
        """Rows and columns of the patch that a box of the target's size covers, at least one of each.

        right, down: patch pixels from the window's center to the box's. share: of the box's sides.
        """
        rows = _span(PATCH_PIXELS / 2 + down, share * self.size[1])
        return rows, _span(PATCH_PIXELS / 2 + right, share * self.size[0])


def extract_window(observation: PictureObservation, target: Target, context: float) -> Window:
    """The window around a target; context: as in :func:`extract_windows`."""
    return extract_windows(observation, [target], context)[0]


def extract_windows(observation: PictureObservation, targets: list[Target], context: float) -> list[Window]:
    """The windows around targets; context: side of a window relative to that of its target."""
    sides = [context * each.side for each in targets]
    patches = observation.sample_squares(targets, sides, PATCH_PIXELS)
    pixel_sizes = [side / PATCH_PIXELS for side in sides]
    return [Window(observation, *each) for each in zip(targets, patches, pixel_sizes, strict=True)]


def _span(center: float, length: float) -> slice:
    first = min(max(round(center - length / 2), 0), PATCH_PIXELS - 1)
    return slice(first, max(min(round(center + length / 2), PATCH_PIXELS), first + 1))


def _hann_window() -> Plane:
    """The weights (32, 32) that taper the cells toward the window's edge."""
    profile: Floats = np.sin(np.pi * (np.arange(WINDOW_CELLS) + 0.5) / WINDOW_CELLS) ** 2
    return np.outer(profile, profile).astype(np.float32)


HANN_WINDOW = _hann_window()
