# SPDX-License-Identifier: MIT
"""Proposals: the windows that are examined in a search of the whole frame."""

import math
from typing import NamedTuple, TypeVar

import numpy as np

from tricue.arrays import Plane
from tricue.track.fused.depth_object import find_objects
from tricue.track.fused.depth_sources import ExpectedDepth
from tricue.track.fused.experts.depth import DepthMeasurement, measure_center_depths
from tricue.track.fused.localize import LocalizationModel
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.position_filter import PositionFilter
from tricue.track.fused.target import Target
from tricue.track.fused.window import Window, extract_window, extract_windows

MAX_OBJECT_PROPOSALS = 3  # objects in depth, per frame
MAX_COLOR_PLACES = 10  # places where the target's colors stand out, found in a frame
COLOR_PLACES_IN_TURN = 2  # of these, examined per frame in turn, in addition to the best
MAX_GRID_PROPOSALS = 3  # places of a grid over the whole frame, per frame
MAX_GRID_SIDE = 32  # places on a side of that grid, however small the target
SAMPLES_PER_TARGET = 8  # on a side of the target, in the search for its colors
MAX_FRAME_SAMPLES = 256  # on the longer side of the frame, in the search for the target's colors
CONTRAST_STEP = 2  # samples between two places whose contrast is measured
PROPOSED_SCALES = 1.0, 0.7, 1.0, 1.4  # relative to the target's last size, in turn; used without depth

T = TypeVar("T")


class LostTarget(NamedTuple):
    """A target that is searched for.

    target: its last place, with the size at which it was last recognized, because later matches may not have
    been the target. missed_frames: number of frames since then. frame: index of the current frame, which
    decides whose turn it is among the proposals.
    """

    target: Target
    position: PositionFilter | None
    missed_frames: int
    frame: int


def propose_windows(
    model: LocalizationModel, observation: PictureObservation, lost: LostTarget
) -> list[Window]:
    """Windows where the target's colors or objects in depth stand out, and some of a grid over the frame.

    With depth, each window has the size that fits the target at its depth.
    """
    propose = _color_proposals if observation.kind == "color" else _object_proposals
    targets = propose(model, observation, lost) + _grid_proposals(observation, lost, model.params)
    context = model.params.context
    if model.depth is None or observation.depth_source is None:
        factor = PROPOSED_SCALES[lost.frame % len(PROPOSED_SCALES)]
        return extract_windows(observation, [each.scale(factor) for each in targets], context)
    depths = measure_center_depths(observation, targets)
    return [
        extract_window(*_at_depth(model, observation, target, depth), context)
        for target, depth in zip(targets, depths, strict=True)
    ]


def _at_depth(
    model: LocalizationModel, observation: PictureObservation, target: Target, depth: DepthMeasurement | None
) -> tuple[PictureObservation, Target]:
    """The frame with a place's depth as the expected depth, and the target with its size at that depth."""
    if depth is None or model.depth is None:
        return observation, target
    growth = model.depth.length / (depth.z * target.side)
    expected = ExpectedDepth(depth.z, model.depth.depth_spread)
    return observation.expect(expected), target.scale(model.limit_growth(growth, target))


def _object_proposals(
    model: LocalizationModel, observation: PictureObservation, lost: LostTarget
) -> list[Target]:
    """The target at the objects of a depth image, those closest to it in metric size first.

    Sabeti, Parvizi and Wu 2008, section IV.A.
    """
    found = []
    for each in find_objects(observation, observation.depth_image)[0]:
        side = Target.of(each.box).side
        mismatch = abs(math.log(side * each.z / model.depth.length)) if model.depth else 0.0
        found.append((mismatch, lost.target.at(*each.box.center)))
    found.sort(key=lambda each: each[0])
    return [each for _, each in found[:MAX_OBJECT_PROPOSALS]]


def _color_proposals(
    model: LocalizationModel, observation: PictureObservation, lost: LostTarget
) -> list[Target]:
    """The target where its colors stand out most, and, in turn, at some of the next best places."""
    assert observation.picture is not None, "the picture is of color"
    height, width = observation.shape
    k, target = observation.k, lost.target
    step = max(target.side / SAMPLES_PER_TARGET, max(height, width) / MAX_FRAME_SAMPLES)
    rows, columns = (max(2 * round(length / step / 2), 2) for length in (height, width))
    whole = np.array([[0.0, 0.0, width, height]])
    samples = k.sample_windows(observation.picture, whole, rows, columns)[0]
    posterior = k.color_posterior(samples, model.appearance.color.table)
    across, down = width / columns, height / rows
    upright = target.upright
    size = upright.width / across, upright.height / down
    contrast = k.box_contrast(posterior, *size, model.params.surround_size, 1.0)
    apart = target.side / (CONTRAST_STEP * down), target.side / (CONTRAST_STEP * across)
    targets = [
        target.at(
            across * (columns // 2 + CONTRAST_STEP * (j - columns // 4)),
            down * (rows // 2 + CONTRAST_STEP * (i - rows // 4)),
        )
        for i, j in _separate_peaks(contrast, apart)
    ]
    best, *others = targets
    return [best, *_in_turn(others, COLOR_PLACES_IN_TURN, lost.frame)]


def _separate_peaks(contrast: Plane, apart: tuple[float, float]) -> list[tuple[int, int]]:
    """Row and column of the cells with the most contrast, in descending order.

    contrast: (R, C); overwritten. apart: rows and columns; two peaks are at least one of them apart.
    """
    rows, columns = (max(math.ceil(each), 1) for each in apart)
    peaks: list[tuple[int, int]] = []
    for _ in range(MAX_COLOR_PLACES):
        i, j = divmod(int(contrast.argmax()), contrast.shape[1])
        if contrast[i, j] == -np.inf:
            break
        peaks.append((i, j))
        contrast[max(i - rows + 1, 0) : i + rows, max(j - columns + 1, 0) : j + columns] = -np.inf
    return peaks


def _grid_proposals(observation: PictureObservation, lost: LostTarget, p: FusedParams) -> list[Target]:
    """The target at a few places of a grid over the frame, half a window apart, in turn from near to far."""
    target = lost.target
    half = p.context * target.side / 2
    height, width = observation.shape
    rows, columns = (min(max(math.ceil(length / half), 1), MAX_GRID_SIDE) for length in (height, width))
    x, y = (np.arange(columns) + 0.5) * width / columns, (np.arange(rows) + 0.5) * height / rows
    squared = np.add.outer((y - target.y) ** 2, (x - target.x) ** 2).ravel()
    nearest = _in_turn(np.argsort(squared, kind="stable").tolist(), MAX_GRID_PROPOSALS, lost.frame)
    return [target.at(float(x[i % columns]), float(y[i // columns])) for i in nearest]


def _in_turn(items: list[T], count: int, frame: int) -> list[T]:
    """The next ``count`` items of a list, which starts again after its end."""
    first = frame * count
    return [items[(first + i) % len(items)] for i in range(min(count, len(items)))]
