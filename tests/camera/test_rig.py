# SPDX-License-Identifier: MIT
import math
import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue import Intrinsics, StereoRig

CAMERA = Intrinsics(500.0, 510.0, 321.5, 238.25, 640, 480)
GOOD = {"fx": 500.0, "fy": 510.0, "cx": 321.5, "cy": 238.25, "width": 640, "height": 480}


def test_field_of_view_reaches_the_edges() -> None:
    """It proves that from_fov puts the outermost pixels' edges at half the angle of view from the axis."""
    camera = Intrinsics.from_fov(176, 144, 47.5, 39.5)
    left, top, _ = camera.back_project(-0.5, -0.5, 1.0)
    right, bottom, _ = camera.back_project(175.5, 143.5, 1.0)
    assert math.degrees(math.atan(right)) == pytest.approx(47.5 / 2)
    assert math.degrees(math.atan(bottom)) == pytest.approx(39.5 / 2)
    assert (left, top) == pytest.approx((-right, -bottom))


def test_one_angle_means_square_pixels() -> None:
    """It proves that without a vertical angle both focal lengths are the same."""
    camera = Intrinsics.from_fov(640, 480, 60.0)
    assert camera.fx == camera.fy == pytest.approx(320 / math.tan(math.radians(30)))


@given(st.floats(-50, 700), st.floats(-50, 500), st.floats(0.1, 100))
def test_projection_undoes_back_projection(u: float, v: float, z: float) -> None:
    """It proves that a pixel, put at a depth and projected again, comes back, and that the depth is kept."""
    point = CAMERA.back_project(u, v, z)
    assert point[2] == z
    assert CAMERA.project(point) == pytest.approx((u, v), abs=1e-9)


def test_projection_is_the_camera_matrix() -> None:
    """It proves that project computes K X in homogeneous coordinates."""
    points = np.random.default_rng(1).uniform((-1, -1, 1), (1, 1, 5), (20, 3))
    homogeneous = points @ CAMERA.matrix.T
    np.testing.assert_allclose(CAMERA.project(points), homogeneous[:, :2] / homogeneous[:, 2:], rtol=1e-12)


def test_vector_is_the_numbers_of_the_matrix() -> None:
    """It proves the order in which kernels take a camera: focal lengths, then the principal point."""
    (fx, _, cx), (_, fy, cy), _ = CAMERA.matrix
    np.testing.assert_array_equal(CAMERA.vector, np.array([fx, fy, cx, cy]), strict=True)


def test_whole_depth_images_back_project() -> None:
    """It proves that pixel grids broadcast with a depth image and that NaN depths give NaN points."""
    depth = np.full((3, 4), 2.0)
    depth[1, 2] = np.nan
    points = CAMERA.back_project(np.arange(4), np.arange(3)[:, None], depth)
    assert points.shape == (3, 4, 3)
    assert np.array_equal(np.isnan(points).all(axis=-1), np.isnan(depth))


def test_points_behind_the_camera_have_no_pixel() -> None:
    """It proves that points behind the camera or in its center project to NaN instead of a mirrored pixel."""
    assert np.isnan(CAMERA.project([[0.1, 0.1, -1.0], [0.1, 0.1, 0.0]])).all()


def test_depth_from_disparity() -> None:
    """It proves z = f b / d, NaN for disparities that aren't above 0, and agreement with two projections."""
    rig = StereoRig(CAMERA, 0.12)
    z = rig.depth([[30.0, 0.0], [-2.0, np.nan]])
    assert z[0, 0] == pytest.approx(2.0)
    assert np.isnan(z).tolist() == [[False, True], [True, True]]
    left, right = CAMERA.project([0.3, 0.1, 2.0]), CAMERA.project([0.3 - 0.12, 0.1, 2.0])
    assert rig.depth(left[0] - right[0]) == pytest.approx(2.0)


def test_cameras_compare_and_pickle() -> None:
    """It proves that cameras are values: equal when their numbers are, also after pickling."""
    rig = StereoRig(CAMERA, 0.12)
    assert pickle.loads(pickle.dumps(rig)) == rig
    assert StereoRig(CAMERA, 0.13) != rig


def test_a_baseline_in_millimeters_warns() -> None:
    """It proves that a baseline of 120 "meters" is warned of."""
    with pytest.warns(UserWarning, match="is it in meters"):
        StereoRig(CAMERA, 120.0)


@pytest.mark.parametrize(
    ("name", "value", "error"),
    [
        ("fx", 0, ValueError),
        ("fy", -1.0, ValueError),
        ("cx", math.nan, ValueError),
        ("cy", math.inf, ValueError),
        ("fx", "500", TypeError),
        ("cx", None, TypeError),
        ("width", 640.5, TypeError),
        ("height", 0, ValueError),
        ("width", True, TypeError),
    ],
)
def test_bad_intrinsics_are_refused(name: str, value: Any, error: type[Exception]) -> None:
    """It proves that every field of Intrinsics is checked and named."""
    with pytest.raises(error, match=f"^{name}: expected .*, got {value!r}"):
        Intrinsics(**{**GOOD, name: value})


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ((640, 480, 180.0), ValueError, "horizontal_deg: expected degrees above 0 and below 180"),
        ((640, 480, 60.0, 0.0), ValueError, "vertical_deg: expected degrees above 0"),
        ((640, 480, math.nan), ValueError, "horizontal_deg: expected a finite number"),
        ((0, 480, 60.0), ValueError, "width: expected pixels above 0"),
        ((640, 480.0, 60.0, 50.0), TypeError, "height: expected a whole number"),
    ],
)
def test_bad_fields_of_view_are_refused(arguments: Any, error: type[Exception], message: str) -> None:
    """It proves that from_fov names the bad argument."""
    with pytest.raises(error, match=f"^{message}"):
        Intrinsics.from_fov(*arguments)


def test_bad_rigs_and_points_are_refused() -> None:
    """It proves that a rig needs Intrinsics and a positive baseline, and project points of three numbers."""
    with pytest.raises(TypeError, match=r"^intrinsics: expected tricue.Intrinsics, got dict"):
        StereoRig(GOOD, 0.1)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^baseline: expected meters above 0, got -0.1"):
        StereoRig(CAMERA, -0.1)
    with pytest.raises(ValueError, match=r"^points: expected \(..., 3\), got \(2,\)"):
        CAMERA.project([1.0, 2.0])
