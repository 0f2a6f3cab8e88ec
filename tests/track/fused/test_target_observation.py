# SPDX-License-Identifier: MIT
"""What the fused tracker's experts read of a frame: pictures of depth, and posteriors by depth."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth
from tricue.track.fused.target_observation import PICTURE_DEPTH_RANGE, TargetObservation, render_depth

CAMERA = Intrinsics.from_fov(250, 200, 60)


def depths(*values: float) -> np.ndarray:
    """A depth image of one row."""
    return np.array([values], np.float32)


def test_render_depth_by_hand():
    """Gray at the target's depth, black from PICTURE_DEPTH_RANGE nearer on, white from as much farther on and
    where nothing is measured, in between in proportion.
    """
    picture = render_depth(
        depths(
            2.0,
            2 - 2 * PICTURE_DEPTH_RANGE,
            2 - PICTURE_DEPTH_RANGE / 2,
            2 + PICTURE_DEPTH_RANGE,
            9.0,
            np.nan,
        ),
        2.0,
    )
    assert picture.shape == (1, 6, 3)
    assert picture.dtype == np.uint8
    assert (picture == picture[..., :1]).all()
    assert picture[0, :, 0].tolist() == pytest.approx([128, 0, 64, 255, 255, 255], abs=1)


def test_pictures_do_not_depend_on_the_distance():
    """The same surface at another distance is the same picture, to a level."""
    surface = np.random.default_rng(0).uniform(-0.6, 0.6, (20, 30)).astype(np.float32)
    near, far = (render_depth(surface + np.float32(z), z).astype(int) for z in (1.0, 6.0))
    assert np.abs(near - far).max() <= 1


def test_pictures_brighten_with_distance():
    """What is farther is never darker."""
    levels = render_depth(np.linspace(0.01, 9, 500, dtype=np.float32)[None], 2.0)[0, :, 0]
    assert (np.diff(levels.astype(int)) >= 0).all()


def test_expect_renders_depth_again():
    """With another expected depth a picture of depth is another one, but one of color the same."""
    depth = np.full((10, 10), 3.0, np.float32)
    k = kernel_sets.load("native")
    of_depth = TargetObservation(
        k, render_depth(depth, 2.0), "depth", CAMERA, DepthImageSource(depth), ExpectedDepth(2.0, 0.1), depth
    )
    of_color = TargetObservation(
        k, render_depth(depth, 2.0), "color", CAMERA, DepthImageSource(depth), ExpectedDepth(2.0, 0.1)
    )
    other = ExpectedDepth(3.0, 0.2)
    assert (of_depth.expect(other).picture == 128).all()
    assert of_color.expect(other).picture is of_color.picture
    assert of_color.expect(other).expected_depth == of_depth.expect(other).expected_depth == other


def test_depth_posterior_by_hand(kernels):
    """P(target | depth) is above 1/2 at the expected depth, under it at others, 1/2 where nothing is
    measured; only what is nearer by more than the margin is an occluder.
    """
    image = np.full((30, 50), 2.0, np.float32)
    image[:, 10:20], image[:, 20:30], image[:, 30:40] = 1.0, 3.0, np.nan
    observation = TargetObservation(
        kernels,
        np.zeros((30, 50, 3), np.uint8),
        "color",
        CAMERA,
        DepthImageSource(image),
        ExpectedDepth(2.0, 0.05),
    )
    posterior, nearer = observation.depth_posterior(0.0, 0.0, 1.0, 30)
    assert posterior[15, 5] > 0.9
    assert max(posterior[15, 15], posterior[15, 25]) < 0.1
    assert nearer[15, [5, 15, 25]].tolist() == [0, 1, 0]
    assert posterior.shape == (30, 30)
    posterior, nearer = observation.depth_posterior(30.0, 0.0, 1.0, 30)
    assert posterior[15, 5] == 0.5
    assert nearer[15, 5] == 0
    assert (posterior[:, 20:] == 0.5).all()  # beyond the image


@pytest.mark.parametrize(("source", "expected"), [(None, ExpectedDepth(2.0, 0.1)), ("there", None)])
def test_no_posterior_without_both(source, expected, kernels):
    """Without a source of depth, or an expected depth, there is no posterior."""
    image = np.full((8, 8), 2.0, np.float32)
    observation = TargetObservation(
        kernels,
        np.zeros((8, 8, 3), np.uint8),
        "color",
        CAMERA,
        DepthImageSource(image) if source else None,
        expected,
    )
    assert observation.depth_posterior(0.0, 0.0, 1.0, 8) is None


@pytest.mark.parametrize(
    ("sigma", "margin"), [(0.01, 0.25), (0.08, 0.25), (0.1, 0.3), (0.15, 0.45), (0.2, 0.5), (0.49, 0.5)]
)
def test_margin_is_three_deviations(sigma, margin):
    """An occluder is nearer by three standard deviations, by a quarter of a meter at least and half of one at
    most.
    """
    assert ExpectedDepth(2.0, sigma).occluder_margin == pytest.approx(margin)


@pytest.mark.parametrize("sigma", [0.5, 2.0])
@pytest.mark.parametrize("z", [0.3, 2.0, 50.0])
def test_a_vague_expectation_has_no_occluders(z, sigma):
    """Nothing is nearer than a vague expected depth: the margin reaches to the camera."""
    assert ExpectedDepth(z, sigma).occluder_margin == z
