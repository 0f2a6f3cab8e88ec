# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue.scenes.rendering import textures
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.stereo_camera import (
    RayCamera,
    RayImage,
    TexturedEllipsoid,
    TexturedRectangle,
    WhiteLamp,
    expose_lit,
)

RIG = StereoRig(Intrinsics.from_fov(160, 120, 55), 0.11)
LAMP = WhiteLamp(np.array([0.0, 0.0, -1.0]), 0.5)


def canvas_of(eye):
    """Gray nothing, infinitely far."""
    shape = eye.intrinsics.height, eye.intrinsics.width
    return RayImage(np.full((*shape, 3), 90, np.float32), np.full(shape, np.inf, np.float32))


def paper(size, seed=0):
    """A rough texture (a pyramid) for a board ``size`` meters wide and high, fine enough for the images."""
    texels = round(size * 250)
    return textures.build_pyramid(
        textures.make_surface("blotches", (texels, texels), np.full(3, 128.0), np.random.default_rng(seed))
    )


def ellipsoid(center=(0.1, -0.05, 1.5), half=(0.08, 0.11, 0.1), texture=None):
    """An upright ellipsoid of one gray, or with a texture."""
    texture = [np.full((8, 16, 3), 200, np.float32)] if texture is None else texture
    return TexturedEllipsoid(np.array(center), np.diag(1 / np.array(half)), texture)


def sub_pixel_shift(left, right, rough, rows, columns):
    """By how many pixels the right image has to go right to lie on the left one there, by least squares.

    It is moved by the Fourier transform's shift theorem: cv2.remap knows only 32 places in a pixel.
    """
    wave = 2 * np.pi * np.fft.rfftfreq(right.shape[1])[None, :, None]
    spectrum, part = np.fft.rfft(right, axis=1), (slice(*rows), slice(*columns))
    shifts = rough + np.arange(-1, 1.001, 0.05)
    errors = []
    for shift in shifts:
        moved = np.fft.irfft(spectrum * np.exp(-1j * wave * shift), n=right.shape[1], axis=1)
        errors.append(np.mean((moved[part] - left[part]) ** 2))
    best = int(np.argmin(errors))
    below, least, above = errors[best - 1 : best + 2]
    return shifts[best] + 0.05 * (below - above) / (below - 2 * least + above) / 2


@pytest.mark.parametrize("rays", [2, 3])
@pytest.mark.parametrize("z", [0.83, 1.37, 2.9])
def test_a_boards_disparity_is_exact(rays, z):
    """A board parallel to the images is shifted by f b / z between them, to 0.01 px."""
    rectangle = TexturedRectangle(
        np.array([-2.0, -2, z]), np.array([4.0, 0, 0]), np.array([0, 4.0, 0]), paper(4.0)
    )
    left, right = (
        eye.average_rays(canvas)
        for eye in RayCamera.pair(RIG, rays)
        for canvas in [canvas_of(eye)]
        if eye.draw_rectangle(canvas, rectangle) is None
    )
    disparity = RIG.intrinsics.fx * RIG.baseline / z
    assert sub_pixel_shift(left, right, disparity, (10, 110), (40, 140)) == pytest.approx(disparity, abs=0.01)


def test_a_slanted_boards_depth_is_its_planes():
    """The depths of a board that is turned about the vertical fulfil its plane's equation on every ray."""
    eye, _ = RayCamera.pair(RIG, 2)
    canvas = canvas_of(eye)
    along = np.array([6.0, 0, 1.5])
    eye.draw_rectangle(
        canvas, TexturedRectangle(np.array([-3.0, -3, 2.0]), along, np.array([0, 6.0, 0]), paper(6.0))
    )
    v, u = np.indices(canvas.depth.shape)
    x, _, z = np.moveaxis(eye.intrinsics.back_project(u, v, canvas.depth), -1, 0)
    np.testing.assert_allclose(z, 2.0 + (x + 3) / 6 * 1.5, rtol=1e-5)


@pytest.mark.parametrize(
    ("corner", "along"),
    [
        ((-0.3, -0.2, 1.5), (0.6, 0, 0.2)),  # inside the image
        ((0.5, -0.4, 1.0), (3.0, 0, 1.0)),  # over its right edge
        ((-0.6, 0.117, -0.5), (0.0, 0, 4.0)),  # from behind the camera
        ((-3.0, -0.2, 1.5), (0.6, 0, 0.2)),  # beside the image
        ((-0.3, -0.2, -1.5), (0.6, 0, 0.2)),  # behind the camera
    ],
)
def test_a_board_is_seen_on_just_those_rays_that_meet_it(corner, along):
    """In single rays of double precision a board is hit where the canvas has its depth, but for its edge."""
    eye, _ = RayCamera.pair(RIG, 1)
    corner, along, down = (np.array(side, float) for side in (corner, along, (0, 0.5, 0)))
    canvas = canvas_of(eye)
    eye.draw_rectangle(canvas, TexturedRectangle(corner, along, down, paper(1.0)))
    v, u = np.indices(canvas.depth.shape)
    rays = eye.intrinsics.back_project(u, v, 1.0)
    a, b, depth = np.moveaxis(
        np.linalg.solve(np.stack([along, down, corner], axis=1), rays[..., None])[..., 0], -1, 0
    )
    # A ray r = a along + b down + c corner meets the plane at r / c.
    meets = (depth > 0) & (np.abs(a / depth - 0.5) < 0.5) & (np.abs(b / depth - 0.5) < 0.5)
    assert (np.isfinite(canvas.depth) != meets).sum() <= 2
    both = np.isfinite(canvas.depth) & meets
    np.testing.assert_allclose(canvas.depth[both], 1 / depth[both], rtol=1e-5)


def test_solids_agree_with_the_depth_cameras_rays():
    """A rotated ellipsoid's depths are those that the depth camera's renderer, in double precision, gives."""
    turn = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]
    body = TexturedEllipsoid(
        np.array([0.2, -0.1, 1.7]), turn / np.array([[0.08], [0.11], [0.2]]), ellipsoid().texture
    )
    for eye in RayCamera.pair(RIG, 3):
        canvas = canvas_of(eye)
        (part,) = eye.draw_ellipsoids(canvas, [body], LAMP)
        center = body.center - [eye.offset, 0, 0]
        shape = np.linalg.inv(body.unit.T @ body.unit)
        window = MountedCamera(eye.intrinsics, 0, 0).render(Ellipsoids(center[None], shape[None]))
        place, expected = window.inside(eye.intrinsics.width, eye.intrinsics.height)
        assert part.place == place
        both = np.isfinite(expected) & np.isfinite(part.depth)
        assert (np.isfinite(expected) != np.isfinite(part.depth)).sum() <= 2  # on the very rim
        np.testing.assert_allclose(part.depth[both], expected[both], atol=2e-4)  # steep on the rim
        assert np.median(np.abs(part.depth[both] - expected[both])) < 1e-6


def test_the_nearer_surface_is_seen_whatever_the_order():
    """Two crossing things give the same picture in either order of drawing."""
    eye, _ = RayCamera.pair(RIG, 1)
    rectangle = TexturedRectangle(
        np.array([-1.0, -1, 1.5]), np.array([2.0, 0, 0]), np.array([0, 2.0, 0]), paper(2.0)
    )
    first, second = canvas_of(eye), canvas_of(eye)
    eye.draw_rectangle(first, rectangle)
    eye.draw_ellipsoids(first, [ellipsoid()], LAMP)
    eye.draw_ellipsoids(second, [ellipsoid()], LAMP)
    eye.draw_rectangle(second, rectangle)
    np.testing.assert_array_equal(first.color, second.color)
    np.testing.assert_array_equal(first.depth, second.depth)


def test_edges_are_where_the_outline_is():
    """A gray ellipsoid's pixels sum up to its outline's area in both images, to half a percent."""
    flat = WhiteLamp(np.array([0.0, 0, -1]), 1.0)
    for offset in (0.0, 0.0013, 0.0029):
        for eye in RayCamera.pair(RIG, 3):
            canvas = canvas_of(eye)
            eye.draw_ellipsoids(canvas, [ellipsoid(center=(0.1 + offset, 0, 1.5))], flat)
            area = float((eye.average_rays(canvas)[..., 0] - 90).sum() / (200 - 90))
            body = ellipsoid(center=(0.1 + offset - eye.offset, 0, 1.5))
            shape = np.linalg.inv(body.unit.T @ body.unit)
            left, top, right, bottom = MountedCamera(RIG.intrinsics, 0, 0).ellipsoid_boxes(
                Ellipsoids(body.center[None], shape[None])
            )[0]
            # The outline's axes are nearly upright: the middle is at the image's height.
            assert area == pytest.approx(np.pi / 4 * (right - left) * (bottom - top), rel=0.005)


def test_light_falls_from_the_lamp():
    """A gray ball is brightest towards the lamp, and as dark as the ambient light on the other side."""
    eye, _ = RayCamera.pair(RIG, 1)
    canvas = canvas_of(eye)
    lamp = WhiteLamp(np.array([1.0, 0, -1]) / np.sqrt(2), 0.4)
    (part,) = eye.draw_ellipsoids(canvas, [ellipsoid(center=(0, 0, 1.0), half=(0.2, 0.2, 0.2))], lamp)
    values = np.where(np.isfinite(part.depth), canvas.color[part.place][..., 0], np.nan)
    assert np.nanmax(values) == pytest.approx(200, rel=0.01)
    assert np.nanmin(values) == pytest.approx(0.4 * 200, rel=0.01)
    middle = values[values.shape[0] // 2]
    assert np.nanargmax(middle) > 0.7 * len(middle)


@pytest.mark.parametrize("center", [(0, 0, -1.0), (0, 0, 0.05), (9.0, 0, 1.5), (0, -9.0, 1.5)])
def test_what_is_not_in_the_image_is_not_drawn(center):
    """Ellipsoids behind, round and beside the camera leave the canvas as it was."""
    eye, _ = RayCamera.pair(RIG, 1)
    canvas = canvas_of(eye)
    assert eye.draw_ellipsoids(canvas, [ellipsoid(center=center)], LAMP) == [None]
    assert np.isinf(canvas.depth).all()


def test_noise_is_independent_in_both_images():
    """Two photographs of one picture differ by white noise of the deviation times the root of 2."""
    rng = np.random.default_rng(0)
    picture = np.full((120, 160, 3), 100, np.float32)
    first, second = (expose_lit(picture, np.ones(3), 2.0, rng).astype(float) for _ in range(2))
    assert np.std(first - second) == pytest.approx(2 * np.sqrt(2 + 2 / 12 / 4), rel=0.02)
