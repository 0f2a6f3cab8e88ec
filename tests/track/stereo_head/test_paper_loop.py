# SPDX-License-Identifier: MIT
"""The printed form as a whole: the paper's text written down anew in plain NumPy, without a kernel, gives the
same states.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import StereoHeadTracker
from tricue.scenes import StereoScene

PAPER = StereoHeadTracker.Params.paper()
BINS, LEVELS = (16, 16, 8), (128, 128, 766)
WIDTHS = np.divide(LEVELS, BINS)
FIRST_CENTERS = np.array([-64, -64, 0]) + WIDTHS / 2 - 0.5  # of the whole levels of an axis's first bin
ACROSS, DOWN, BELOW, ABOVE, WINDOW = 8, 2, 4, 4, 5
RATE, GATE = 0.1, 0.5
E_COLOR, E_PHI = np.array([0.5, 0.6, 2.4]), 0.04
Q = np.diag(np.square([0.1, 0.1, 0.1, 2.31, 2.31, 27.6, 1.0]))  # 3 m/s, 30 frames/s; bins' widths / sqrt(12)


class State(NamedTuple):
    """Model histogram M, state vector (7) and its covariance P."""

    model: NDArray[np.float64]
    x: NDArray[np.float64]
    covariance: NDArray[np.float64]


def histogram(image: NDArray[np.uint8], inside: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Of the pixels in (B - G, G - R, B + G + R), its sum 1."""
    b, g, r = image[inside].astype(int).T
    place = [np.clip(b - g + 64, 0, 127) // 8, np.clip(g - r + 64, 0, 127) // 8, (b + g + r) * 8 // 766]
    counts = np.zeros(BINS)
    np.add.at(counts, tuple(place), 1)
    return counts / counts.sum()


def mean_color(model: NDArray[np.float64]) -> NDArray[np.float64]:
    """(3,) of the whole levels that the bins stand for."""
    return FIRST_CENTERS + WIDTHS * np.array([(np.indices(BINS)[i] * model).sum() for i in range(3)])


def moved_to(model: NDArray[np.float64], mean: NDArray[np.float64]) -> NDArray[np.float64]:
    """The histogram as a whole at another mean; what would leave an axis stays in its end bin."""
    for axis, off in enumerate((mean - mean_color(model)) / WIDTHS):
        whole, index = int(np.floor(off)), np.arange(BINS[axis])
        moved = np.zeros(BINS)
        for step, share in ((whole, 1 - off + whole), (whole + 1, off - whole)):
            np.add.at(
                np.moveaxis(moved, axis, 0),
                np.clip(index + step, 0, BINS[axis] - 1),
                share * np.moveaxis(model, axis, 0),
            )
        model = moved
    return model


def ellipse_of(shape: tuple[int, ...], x: float, y: float, minor: float, major: float) -> NDArray[np.bool_]:
    """The pixels whose centers are inside."""
    rows, columns = np.mgrid[: shape[0], : shape[1]] + 0.5
    return ((columns - x) / minor) ** 2 + ((rows - y) / major) ** 2 <= 1


def gray(image: NDArray[np.uint8]) -> NDArray[np.int64]:
    """The gray level of a BGR image, by BT.601."""
    return (image.astype(np.int64) @ np.array([3735, 19235, 9798]) + 2**14) >> 15


def disparities(left: NDArray[np.uint8], right: NDArray[np.uint8], middle: int) -> NDArray[np.int64]:
    """(3), (4) for all pixels: the first d of the least sum over a window, x_right = x_left - d."""
    ours, theirs = (np.pad(gray(image), WINDOW // 2, "edge") for image in (left, right))
    height, width = left.shape[:2]
    costs = []
    for d in range(middle - BELOW, middle + ABOVE + 1):
        columns = np.arange(WINDOW // 2, WINDOW // 2 + width)
        sums = np.zeros((height, width), int)
        for row in range(WINDOW):
            for column in range(-(WINDOW // 2), WINDOW // 2 + 1):
                there = np.clip(columns + column - d, 0, theirs.shape[1] - 1)
                off = ours[row : row + height, columns + column] - theirs[row : row + height, there]
                sums += np.abs(off)
        costs.append(np.where((np.arange(width) >= d) & (np.arange(width) - d < width), sums, 10**9))
    return middle - BELOW + np.argmin(costs, axis=0)


def noise_of(point: NDArray[np.float64], scene: StereoScene) -> NDArray[np.float64]:
    """R: the squares of (9), X and Y at the image's border, of a disparity error of 1 px; and of the rest."""
    camera = scene.rig.intrinsics
    slopes = np.array([camera.width / 2 / camera.fx, camera.height / 2 / camera.fy, 1])
    errors = point**2 / (slopes * camera.fx * scene.rig.baseline) + 1e-4
    return np.diag(np.square([*errors, *E_COLOR, E_PHI]))


def step(state: State, index: int, scene: StereoScene, size: NDArray[np.float64], fuse: bool) -> State:
    """Section 2's modules in their order, and the five steps of section 4.2."""
    camera, frame = scene.rig.intrinsics, scene.frames[index]
    predicted, covariance = state.x, state.covariance + Q
    x, y, z = predicted[:3]
    place = camera.fx * x / z + camera.cx + 0.5, camera.fy * y / z + camera.cy + 0.5
    axes = size / 2 * [camera.fx, camera.fy] / z
    best = -1.0
    for down in range(-DOWN, DOWN + 1):
        for across in range(-ACROSS, ACROSS + 1):
            inside = ellipse_of(frame.color.shape, place[0] + across, place[1] + down, *axes)
            candidate = histogram(frame.color, inside)
            phi = np.minimum(candidate, state.model).sum()  # (1)
            if phi > best + 1e-9:
                best, found, colors, shift = phi, inside, candidate, (across, down)
    length = camera.fx * scene.rig.baseline
    d = disparities(frame.color, frame.right, round(length / z))[found].mean()  # (5)
    z = length / d
    u, v = place[0] + shift[0] - 0.5, place[1] + shift[1] - 0.5
    point = np.array([(u - camera.cx) * z / camera.fx, (v - camera.cy) * z / camera.fy, z])
    model = (1 - RATE) * state.model + RATE * colors if best > GATE else state.model  # (2)
    measured, noise = np.array([*point, *mean_color(model), best]), noise_of(point, scene)
    if not fuse:
        return State(model, measured, noise)
    gain = covariance @ np.linalg.inv(covariance + noise)
    corrected = predicted + gain @ (measured - predicted)
    return State(moved_to(model, corrected[3:6]), corrected, (np.eye(7) - gain) @ covariance)


@pytest.mark.parametrize("fuse", [True, False], ids=["fused", "unfused"])
def test_the_paper_written_anew_gives_the_same_states(fuse: bool, heads) -> None:
    """State, covariance and model agree frame by frame, from the first measurement on. The mean disparity is
    a float32, exact to 1e-7.
    """
    scene = heads(0)
    tracker = StereoHeadTracker(replace(PAPER, fuse=fuse), rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    x, y, minor, major = scene.boxes[0].ellipse
    camera, position = scene.rig.intrinsics, np.array(tracker._state.filter.position)
    size = 2 * np.array([minor, major]) * position[2] / [camera.fx, camera.fy]
    colors = histogram(scene.frames[0].color, ellipse_of(scene.frames[0].color.shape, x, y, minor, major))
    start = np.array([*position, *mean_color(colors), 1.0])
    state = State(colors, start, noise_of(position, scene))
    for index in range(1, 13):
        np.testing.assert_allclose(tracker._state.filter.mean, state.x, rtol=0, atol=1e-6)
        np.testing.assert_allclose(tracker._state.filter.covariance, state.covariance, rtol=1e-5, atol=1e-12)
        np.testing.assert_allclose(tracker._state.learned_histogram, state.model.ravel(), rtol=0, atol=1e-8)
        tracker.update(scene.frames[index])
        state = step(state, index, scene, size, fuse)
