# SPDX-License-Identifier: MIT
"""That the geometry of the stereo head tracker is that of its rig, and (9) that of its back-projection."""

import numpy as np
import pytest
from tricue import Intrinsics, StereoHeadTracker, StereoRig
from tricue.track.stereo_head.stereo_geometry import MIN_POSITION_NOISE, StereoGeometry, fit_polynomials

Params = StereoHeadTracker.Params
CAMERA = Intrinsics(150.0, 140.0, 81.0, 58.5, 160, 120)
RIG = StereoRig(CAMERA, 0.11)
GEOMETRY = StereoGeometry.of(RIG)
POINTS = np.array([[0.0, 0.0, 1.0], [-0.4, 0.2, 0.8], [1.1, -0.7, 3.9], [0.02, 0.3, 6.0]])


@pytest.mark.parametrize("point", POINTS, ids=str)
def test_projects_as_the_rig(point):
    """A point's place is the camera's pixel, half a pixel on as boxes count, and its disparity the rig's."""
    x, y, disparity = GEOMETRY.project(point)
    assert (x, y) == pytest.approx(tuple(CAMERA.project(point) + 0.5), rel=1e-14)
    assert RIG.depth(disparity) == pytest.approx(point[2], rel=1e-14)
    assert GEOMETRY.disparity(point[2]) == pytest.approx(disparity, rel=1e-14)


@pytest.mark.parametrize("noise", ["propagated", "polynomial"])
@pytest.mark.parametrize("point", POINTS, ids=str)
def test_a_projected_point_comes_back(point, noise, kernels):
    """Projecting and triangulating a point gives it back, to rounding, whatever its noise is taken for."""
    found, _ = GEOMETRY.triangulate(kernels, *GEOMETRY.project(point), 1, Params(noise_model=noise))
    np.testing.assert_allclose(found, point, rtol=0, atol=1e-13)


@pytest.mark.parametrize("z", [0.5, 1.0, 4.0])
def test_size_and_ellipse_are_inverse(z):
    """An ellipse measured in meters at a distance has the same semi-axes there, half of them twice as far
    away, and lies around the projected point.
    """
    point = np.array([0.1, -0.1, z])
    size = GEOMETRY.size(12.0, 15.0, z)
    x, y, minor, major = GEOMETRY.ellipse(point, size)
    assert (x, y) == GEOMETRY.project(point)[:2]
    assert (minor, major) == pytest.approx((12.0, 15.0), rel=1e-14)
    assert GEOMETRY.ellipse(2 * point, size) == pytest.approx((x, y, 6.0, 7.5), rel=1e-14)
    assert size == pytest.approx((24 * z / CAMERA.fx, 30 * z / CAMERA.fy), rel=1e-14)


@pytest.mark.parametrize("step", [1, 4])
@pytest.mark.parametrize("point", POINTS, ids=str)
def test_propagated_noise_is_that_of_finite_differences(point, step, kernels):
    """The covariance is J S J^T with J by central differences of project's inverse through the rig alone.

    A step h in the disparity leaves z f'''/6 h^2 of the derivative: 1e-4 px of 2.7 px or more, relative 2e-9.
    """
    p = Params(disparity_noise=0.3, place_noise=0.8)
    place = np.array(GEOMETRY.project(point))
    _, covariance = GEOMETRY.triangulate(kernels, *place, step, p)

    def back(x, y, disparity):
        return CAMERA.back_project(x - 0.5, y - 0.5, RIG.depth(disparity))

    sides = [1e-4 * side for side in np.eye(3)]
    jacobian = np.stack([(back(*place + h) - back(*place - h)) / 2e-4 for h in sides], axis=1)
    noise = np.diag([0.8 * step, 0.8 * step, 0.3]) ** 2
    scale = np.abs(covariance).max()
    np.testing.assert_allclose(covariance, jacobian @ noise @ jacobian.T, rtol=0, atol=1e-7 * scale)


@pytest.mark.parametrize("error", [1.0, 0.25])
def test_cubics_are_what_a_disparity_error_does(error):
    """(9) for X, Y at the image's border, on either side, and for Z is the error of the rig's back-projection
    to first order, over the whole working range.

    That error is quadratic in each coordinate, so that cubics fit it to the rounding of polyfit, whose
    condition is below 1e4 here.
    """
    p = Params(disparity_noise=error)
    small = 1e-6  # of the error, so that what is beyond first order is a millionth of it
    z = np.linspace(p.near, p.far, 37)
    disparity = GEOMETRY.disparity(1.0) / z
    for u_side in (-1, 1):
        u, v = CAMERA.cx + u_side * CAMERA.width / 2, CAMERA.cy + u_side * CAMERA.height / 2
        there = CAMERA.back_project(u, v, z)
        moved = CAMERA.back_project(u, v, RIG.depth(disparity - small * error))
        expected = np.abs(moved - there) / small
        for axis, cubic in enumerate(fit_polynomials(GEOMETRY, p)):
            np.testing.assert_allclose(np.polyval(cubic, there[:, axis]), expected[:, axis], rtol=1e-5)


def test_cubics_have_their_closed_form():
    """The coefficients are those of z^2 / (f b) and of x^2 / (slope f b): a_i1 alone isn't 0."""
    fb = CAMERA.fx * RIG.baseline
    slopes = CAMERA.width / 2 / CAMERA.fx, CAMERA.height / 2 / CAMERA.fy, 1.0
    for cubic, slope in zip(fit_polynomials(GEOMETRY, Params(disparity_noise=1)), slopes, strict=True):
        np.testing.assert_allclose(cubic, [0, 1 / (slope * fb), 0, 0], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("point", POINTS, ids=str)
def test_printed_noise_is_diagonal(point, kernels):
    """With noise_model="polynomial" the covariance is the square of (9), plus a minimum, on the
    diagonal alone.
    """
    p = Params(noise_model="polynomial", disparity_noise=1)
    _, covariance = GEOMETRY.triangulate(kernels, *GEOMETRY.project(point), 4, p)
    errors = [
        np.polyval(cubic, value) for cubic, value in zip(fit_polynomials(GEOMETRY, p), point, strict=True)
    ]
    np.testing.assert_allclose(covariance, np.diag((np.abs(errors) + MIN_POSITION_NOISE) ** 2), rtol=1e-9)


def test_the_cubics_are_fitted_once(kernels, monkeypatch):
    """The next frame's position takes no other fit, which takes longer than a whole update."""
    p = Params(noise_model="polynomial", disparity_noise=0.731)
    GEOMETRY.triangulate(kernels, *GEOMETRY.project(POINTS[0]), 4, p)
    monkeypatch.setattr(np, "polyfit", lambda *_: pytest.fail("fitted again"))
    GEOMETRY.triangulate(kernels, *GEOMETRY.project(POINTS[1]), 4, p)


def test_noise_grows_with_the_square_of_the_distance(kernels):
    """Straight ahead the deviation of Z is z^2 / (f b) that of the disparity: twice as far, four times."""
    near, far = (
        GEOMETRY.triangulate(kernels, CAMERA.cx + 0.5, CAMERA.cy + 0.5, GEOMETRY.disparity(z), 1, Params())[
            1
        ][2, 2]
        ** 0.5
        for z in (1.5, 3.0)
    )
    assert near == pytest.approx(1.5**2 / (CAMERA.fx * RIG.baseline) * Params().disparity_noise, rel=1e-12)
    assert far == pytest.approx(4 * near, rel=1e-12)
