# SPDX-License-Identifier: MIT
"""What the fused tracker's experts read of a frame: pictures of depth, and posteriors by depth."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.kernels import Kernels
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth
from tricue.track.fused.picture_observation import PICTURE_DEPTH_RANGE, PictureObservation

CAMERA = Intrinsics.from_fov(250, 200, 60)


WINDOWS = np.array(
    [[3.3, -4.2, 9.5, 12.0], [-30.0, 2.0, 8.0, 8.0], [11.0, 14.6, 30.0, 2.5], [90.0, 90.0, 4.0, 4.0]]
)


def of_depth(k: Kernels, depth: np.ndarray, z: float | None) -> PictureObservation:
    """A frame without color."""
    expected = None if z is None else ExpectedDepth(z, 0.1)
    return PictureObservation(k, None, CAMERA, DepthImageSource(depth), expected)


@pytest.mark.parametrize(
    "some", [slice(0, 1), slice(1, 2), slice(2, 3), slice(3, 4), slice(0, 3), slice(0, 4)]
)
def test_samples_are_those_of_the_whole_picture(some, kernels):
    """What is drawn of depth for some windows, in the image or over its edges, gives the same samples as the
    picture of the whole image.
    """
    depth = np.random.default_rng(0).uniform(1, 3, (20, 31)).astype(np.float32)
    depth[::3, ::4] = np.nan
    picture = kernels.depth_picture(depth, 2.0, PICTURE_DEPTH_RANGE)
    found = of_depth(kernels, depth, 2.0).sample(WINDOWS[some], 16)
    gray = kernels.sample_windows(picture, WINDOWS[some], 16, 16)
    np.testing.assert_array_equal(found, np.repeat(gray[..., None], 3, axis=-1), strict=True)


def test_expect_draws_depth_again():
    """With another expected depth a picture of depth is another one, but one of color the same."""
    depth, k, other = np.full((10, 10), 3.0, np.float32), kernel_sets.load("native"), ExpectedDepth(3.0, 0.2)
    color = PictureObservation(k, np.full((10, 10, 3), 7, np.uint8), CAMERA, None, None)
    assert (of_depth(k, depth, 2.0).sample(WINDOWS, 4) == 255).all()
    assert (of_depth(k, depth, 2.0).expect(other).sample(WINDOWS, 4) == 128).all()
    assert (color.expect(other).sample(WINDOWS, 4) == 7).all()
    assert color.expect(other).expected_depth == other


def test_depth_is_black_where_none_is_expected():
    """A target of unknown depth is seen nowhere."""
    samples = of_depth(kernel_sets.load("native"), np.full((10, 12), 3.0, np.float32), None).sample(
        WINDOWS, 4
    )
    assert samples.shape == (4, 4, 4, 3)
    assert samples.dtype == np.uint8
    assert not samples.any()


@pytest.mark.parametrize("kind", ["color", "depth"])
def test_shape_is_the_pictures(kind):
    """Height and width, of either kind of picture."""
    k = kernel_sets.load("native")
    color = PictureObservation(k, np.zeros((10, 12, 3), np.uint8), CAMERA, None, None)
    seen = color if kind == "color" else of_depth(k, np.zeros((10, 12), np.float32), 2.0)
    assert seen.shape == (10, 12)


def test_depth_posterior_by_hand(kernels):
    """P(target | depth) is above 1/2 at the expected depth, under it at others, 1/2 where nothing is
    measured; only what is nearer by more than the margin is an occluder.
    """
    image = np.full((30, 50), 2.0, np.float32)
    image[:, 10:20], image[:, 20:30], image[:, 30:40] = 1.0, 3.0, np.nan
    observation = PictureObservation(
        kernels,
        np.zeros((30, 50, 3), np.uint8),
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
    observation = PictureObservation(
        kernels,
        np.zeros((8, 8, 3), np.uint8),
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
