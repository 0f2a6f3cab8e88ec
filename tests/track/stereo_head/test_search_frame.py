# SPDX-License-Identifier: MIT
"""That a head is found again anywhere in the picture and at any distance, by its colors and its depth."""

import cv2
import numpy as np
import pytest
from tricue import Box, Intrinsics, StereoHeadTracker, StereoRig
from tricue.kernels import load
from tricue.track.stereo_head.prepared_pair import PreparedPair
from tricue.track.stereo_head.search_frame import DISTANCE_RATIO, LostHead, _sample_distances, search_frame
from tricue.track.stereo_head.stereo_geometry import StereoGeometry

Params = StereoHeadTracker.Params
P = Params()
SKIN = np.array([110, 140, 205])
WIDTH, HEIGHT = 0.17, 0.21  # meters
CAMERA = Intrinsics.from_fov(160, 120, 55)
FAR_WALL = 3  # pixels of disparity at 160 columns


def rig(scale: int = 1) -> StereoRig:
    """160x120 pixels, or so many times as many."""
    return StereoRig(Intrinsics.from_fov(160 * scale, 120 * scale, 55), 0.11)


def grain(shape: tuple[int, int], color: np.ndarray, spread: int, seed: int) -> np.ndarray:
    """A texture about a color, BGR."""
    levels = np.random.default_rng(seed).integers(-spread, spread + 1, shape)
    return np.clip(color + levels[..., None], 0, 255).astype(np.uint8)


def stage(
    geometry: StereoGeometry, where: list[tuple[float, float, float]], colors: list[np.ndarray]
) -> tuple[PreparedPair, list[Box]]:
    """Heads of these colors at x, y (shares of the picture) and z before a wall, as flat ellipses at whole
    disparities, far ones first.
    """
    height, width = geometry.shape
    scale = width // 160
    wall = grain((height, width + 99 * scale), np.array([90, 150, 60]), 50, 0)
    sides = [wall[:, :width].copy(), wall[:, FAR_WALL * scale : width + FAR_WALL * scale].copy()]
    boxes = []
    for index, ((x, y, z), color) in enumerate(zip(where, colors, strict=True)):
        disparity = round(geometry.disparity(z))
        half = np.array([WIDTH, HEIGHT]) / 2 * geometry.rig[:2] / z
        middle = np.array([x * width, y * height])
        boxes.append(Box.from_ellipse(*middle, *half))
        texture = grain((height, width), color, 30, 1 + index)
        rows, columns = np.indices((height, width)) + 0.5
        for side, shift in zip(sides, (0, disparity), strict=True):
            mask = ((columns + shift - middle[0]) / half[0]) ** 2 + ((rows - middle[1]) / half[1]) ** 2 < 1
            side[mask] = np.roll(texture, -shift, axis=1)[mask]
    return PreparedPair.of(load("native"), sides[0], sides[1], np.inf, None, P), boxes


def histogram(k, color: np.ndarray) -> np.ndarray:
    """The model (L,) of a head's texture."""
    bins = k.color_bins(grain((60, 60), color, 30, 9), (0, 0, 60, 60), P.color_space, 1)
    counts = np.bincount(bins.ravel(), minlength=int(np.prod(P.bins))).astype(float)
    return counts / counts.sum()


def overlap(ellipse: tuple[float, float, float, float], box: Box) -> float:
    """IoU."""
    return Box.from_ellipse(*ellipse).iou(box)


def anywhere(colors: np.ndarray) -> LostHead:
    """A head of these colors that may be at any place and distance."""
    return LostHead((WIDTH, HEIGHT), colors, np.array([0.0, 0.0, 3.0]), 100.0)


def metric(geometry: StereoGeometry, place: tuple[float, float, float]) -> np.ndarray:
    """(3,) meters of a place on the stage."""
    x, y, z = place
    height, width = geometry.shape
    return CAMERA.back_project(x * width - 0.5, y * height - 0.5, z)


ANYWHERE = [(x, y, z) for z in (0.8, 1.3, 2.0, 3.0) for x in (0.25, 0.5, 0.8) for y in (0.3, 0.65)]


@pytest.mark.parametrize(
    ("kernels", "place"),
    [("native", place) for place in ANYWHERE] + [("reference", place) for place in ANYWHERE[13:14]],
)
def test_a_head_is_found_anywhere(kernels, place):
    """Wherever a head is in the picture, and however far, the ellipse is on it, of its size, with its own
    disparity, not that of the grid of distances.
    """
    k, geometry = load(kernels), StereoGeometry.of(rig())
    pair, (box,) = stage(geometry, [place], [SKIN])
    found = search_frame(k, pair, geometry, anywhere(histogram(k, SKIN)), P)
    assert found is not None
    ellipse, disparity = found
    assert overlap(ellipse, box) > 0.5
    assert disparity == pytest.approx(round(geometry.disparity(place[2])), abs=0.3)


def test_places_are_pixels_of_the_picture():
    """In a picture of 640x480, searched at a quarter of it, ellipse and disparity are its own pixels."""
    kernels = load("native")
    geometry = StereoGeometry.of(rig(4))
    pair, (box,) = stage(geometry, [(0.7, 0.4, 1.5)], [SKIN])
    assert pair.step == 4
    ellipse, disparity = search_frame(kernels, pair, geometry, anywhere(histogram(kernels, SKIN)), P)
    assert overlap(ellipse, box) > 0.5
    assert disparity == pytest.approx(round(geometry.disparity(1.5)), abs=1.0)


@pytest.mark.parametrize("ours", [0, 1])
def test_colors_tell_heads_apart(ours):
    """Of two heads of one size at one distance the one of the model's colors is found."""
    kernels = load("native")
    geometry, colors = StereoGeometry.of(rig()), [SKIN, np.array([190, 120, 60])]
    pair, boxes = stage(geometry, [(0.3, 0.5, 1.6), (0.75, 0.5, 1.6)], colors)
    ellipse, _ = search_frame(kernels, pair, geometry, anywhere(histogram(kernels, colors[ours])), P)
    assert overlap(ellipse, boxes[ours]) > 0.5


@pytest.mark.parametrize(
    "places",
    [
        [(0.3, 0.5, 2.6), (0.75, 0.5, 1.1)],
        [(0.2, 0.5, 1.6), (0.8, 0.5, 1.6)],
        [(0.5, 0.2, 1.4), (0.5, 0.8, 1.4)],
    ],
    ids=["nearer", "beside", "below"],
)
@pytest.mark.parametrize("ours", [0, 1])
def test_a_head_is_found_where_it_can_be(ours, places):
    """Of two heads of the same colors the one within reach of where it was is found, whether the other is
    nearer or farther, beside it or below, and what is found is within reach.
    """
    k, geometry = load("native"), StereoGeometry.of(rig())
    pair, boxes = stage(geometry, places, [SKIN, SKIN])
    there = metric(geometry, places[ours])
    head = LostHead((WIDTH, HEIGHT), histogram(k, SKIN), there + [0.1, -0.1, 0.05], 0.35)
    ellipse, disparity = search_frame(k, pair, geometry, head, P)
    assert overlap(ellipse, boxes[ours]) > 0.5
    z = geometry.disparity(1.0) / disparity
    found = CAMERA.back_project(ellipse[0] - 0.5, ellipse[1] - 0.5, z)
    assert np.linalg.norm(found - head.last_seen) <= head.radius * (1 + 1e-12)


def test_outside_the_radius_nothing_is_found():
    """Where no place of the image is within the radius nothing is found, however like the head it is."""
    k, geometry = load("native"), StereoGeometry.of(rig())
    pair, _ = stage(geometry, [(0.5, 0.5, 1.5)], [SKIN])
    aside = LostHead((WIDTH, HEIGHT), histogram(k, SKIN), np.array([5.0, 0.0, 1.5]), 0.3)
    assert search_frame(k, pair, geometry, aside, P) is None


@pytest.mark.parametrize(
    ("z", "reach", "expected"), [(2.0, 0.5, (1.5, 2.5)), (0.5, 0.3, (P.near, 0.8)), (5.9, 1.0, (4.9, P.far))]
)
def test_radius_and_range_bound_the_distance(z, reach, expected):
    """A head can be nearer and farther by its radius, between near and far."""
    head = LostHead((WIDTH, HEIGHT), np.ones(1), np.array([0.3, 0.1, z]), reach)
    assert head.distances(P) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("near", "far"), [(0.4, 6.0), (1.0, 1.05), (2.0, 2.0)])
def test_distances_are_a_step_apart(near, far):
    """They go from near to far, both included, each at most 1 / DISTANCE_RATIO times the one before."""
    found = _sample_distances(near, far)
    assert found[0] == pytest.approx(near, rel=1e-12)
    assert found[-1] == pytest.approx(far, rel=1e-12)
    ratios = np.divide(found[1:], found[:-1])
    assert (ratios >= 1).all()
    assert (ratios <= 1 / DISTANCE_RATIO * (1 + 1e-12)).all()


def test_what_is_too_small_is_not_searched(kernels):
    """A head whose ellipse would be smaller than a searched cell is not found: None."""
    geometry = StereoGeometry.of(rig())
    image = cv2.resize(np.zeros((2, 2, 3), np.uint8), (160, 120))
    pair = PreparedPair.of(load("native"), image, image, np.inf, None, P)
    tiny = anywhere(histogram(kernels, SKIN))._replace(size=(0.002, 0.002))
    assert search_frame(kernels, pair, geometry, tiny, P) is None
