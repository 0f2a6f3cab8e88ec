# SPDX-License-Identifier: MIT
import math

import numpy as np
import pytest
from tricue import Intrinsics
from tricue.scenes.people.body import BodyPose, Person, place_body
from tricue.scenes.rendering.depth_room import Furniture, Room
from tricue.scenes.rendering.depth_sensor import (
    DEPTH_SENSORS,
    FLYING_PIXEL_SHARE,
    add_flying_pixels,
    drop_pixels,
    find_depth_edges,
)
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids

TOF, RGBD = DEPTH_SENSORS["tof"], DEPTH_SENSORS["rgbd"]
LEVEL = {name: MountedCamera(camera.intrinsics, 1.2, 0.0) for name, camera in DEPTH_SENSORS.items()}


def sphere(center, radius):
    """One ellipsoid that is a sphere."""
    return Ellipsoids(np.array([center], dtype=float), radius**2 * np.eye(3)[None])


def wall(z, camera=TOF):
    """A z-buffer of a wall across the whole image."""
    return np.full((camera.intrinsics.height, camera.intrinsics.width), float(z))


def step(near=2.0, far=4.0):
    """A near surface in the left half of the image, a far one in the right."""
    depth = wall(near)
    depth[:, depth.shape[1] // 2 :] = far
    return depth


def person(height, z, camera, yaw=math.pi):
    """Somebody at ease on the floor before the level camera, in the camera frame."""
    return place_body(Person(height, 1.0), BodyPose(), 0.0, z, yaw, LEVEL[camera].height)


def test_cameras_are_the_ones_of_the_papers():
    """The SR-3000 of Sabeti et al., section V, and a Kinect."""
    assert TOF.intrinsics == Intrinsics.from_fov(176, 144, 47.5, 39.5)
    assert (TOF.near, TOF.far, TOF.rate) == (0.3, 7.5, 15)
    assert (RGBD.intrinsics.fx, RGBD.intrinsics.fy) == (525, 525)
    assert (RGBD.intrinsics.width, RGBD.intrinsics.height) == (640, 480)
    assert (RGBD.near, RGBD.far, RGBD.rate) == (0.5, 8.0, 30)
    assert TOF.noise_deviation(np.array([2.0, 6.0])) == pytest.approx([0.01, 0.03])
    assert RGBD.noise_deviation(np.array([1.0, 5.0])) == pytest.approx([0.0014, 0.036], rel=0.03)


def test_every_pixel_of_a_sphere_lies_on_the_sphere():
    """Back-projected, the z-buffer's points are a radius from the center, on its near side."""
    center = np.array([0.4, -0.3, 3.0])
    points = LEVEL["rgbd"].surface_points(LEVEL["rgbd"].render(sphere(center, 0.25)))
    assert len(points) > 4000
    np.testing.assert_allclose(np.linalg.norm(points - center, axis=1), 0.25, atol=1e-9)
    toward_camera = ((points - center) * points).sum(axis=1)
    assert toward_camera.max() < 0


@pytest.mark.parametrize("camera", ["tof", "rgbd"])
def test_box_is_the_outline_of_the_z_buffer(camera):
    """The box from the outlines' conics is less than a pixel larger than that of the pixels hit."""
    view = LEVEL[camera]
    bodies = person(1.75, 3.2, camera, yaw=0.7)
    window = view.render(bodies)
    rows, columns = np.nonzero(np.isfinite(window.depth))
    left, top, right, bottom = view.bounding_box(bodies).xyxy
    # A pixel's center lies half a pixel inside it.
    assert 0 <= columns.min() + window.left + 0.5 - left < 1
    assert 0 <= right - (columns.max() + window.left + 0.5) < 1
    assert 0 <= rows.min() + window.top + 0.5 - top < 1.5  # the round top of a head may slip between rows
    assert 0 <= bottom - (rows.max() + window.top + 0.5) < 1.5


@pytest.mark.parametrize("camera", ["tof", "rgbd"])
@pytest.mark.parametrize("z", [2.5, 4.0, 6.0])
def test_size_in_pixels_follows_the_pinhole(camera, z):
    """A person of 1.8 m at z is fy 1.8 / z pixels high within 10 %."""
    box = LEVEL[camera].bounding_box(person(1.8, z, camera))
    assert box.height == pytest.approx(LEVEL[camera].intrinsics.fy * 1.8 / z, rel=0.1)


def test_person_is_as_far_as_the_nearest_surface():
    """Of somebody with the axis at 3 m the trunk's depth is 3 m minus its half depth within centimeters."""
    view = LEVEL["rgbd"]
    bodies = person(1.8, 3.0, "rgbd")
    window = view.render(bodies)
    half = 0.068 * 1.8  # of the chest, the deepest part of the trunk
    camera = view.intrinsics
    row = round(camera.fy * (1.2 - 0.73 * 1.8) / 3.0 + camera.cy) - window.top
    column = round(camera.cx) - window.left
    assert window.depth[row, column] == pytest.approx(3.0 - half, abs=0.02)
    assert 2.75 < view.surface_points(window)[:, 2].mean() < 3.0


def test_body_may_reach_over_the_edge():
    """A window over the edge keeps the whole body; its part inside lies where the same pixels are."""
    view = LEVEL["tof"]
    window = view.render(sphere([-1.2, 0.0, 3.0], 0.4))
    assert window.left < 0
    place, part = window.inside(176, 144)
    assert (place[1].start, part.shape[1]) == (0, window.depth.shape[1] + window.left)
    np.testing.assert_array_equal(part, window.depth[:, -window.left :])
    outside = view.render(sphere([-9.0, 0.0, 3.0], 0.4)).inside(176, 144)
    assert outside[1].size == 0


def test_ellipsoids_behind_the_camera_are_refused():
    """An outline needs the whole ellipsoid in front of the camera."""
    for z in (-3.0, 0.1):
        with pytest.raises(ValueError, match="bodies: expected ellipsoids in front of the camera"):
            LEVEL["tof"].render(sphere([0.0, 0.0, z], 0.3))


def test_room_is_made_of_planes():
    """Back-projected and levelled, every pixel of an empty room lies on the floor, a wall or the ceiling."""
    view = MountedCamera(TOF.intrinsics, 1.3, math.radians(9))
    depth = view.render_room(Room(7.0, 2.5, 2.6))
    rows, columns = np.indices(depth.shape)
    x, y, z = np.moveaxis(TOF.intrinsics.back_project(columns, rows, depth) @ view.rotation, -1, 0)
    on = [np.abs(y - 1.3), np.abs(y - (1.3 - 2.6)), np.abs(z - 7.0), np.abs(np.abs(x) - 2.5)]
    assert np.min(on, axis=0).max() < 1e-9
    assert np.all((y < 1.3 + 1e-9) & (z < 7 + 1e-9) & (np.abs(x) < 2.5 + 1e-9))
    for surface in (on[0], on[2], on[3]):
        assert (surface < 1e-9).sum() > 300


def test_furniture_stands_on_the_floor_where_it_was_put():
    """The front of a box of 1 x 0.5 x 0.8 m at 4 m has its depth and size; turned, its side is nearer."""
    view = LEVEL["rgbd"]
    piece = Furniture(0.3, 4.0, 1.0, 0.5, 0.8, 0.0)
    empty, full = (view.render_room(Room(7.0, 3.0, 2.6, pieces)) for pieces in ((), (piece,)))
    front = np.abs(full - 3.75) < 1e-9
    rows, columns = np.nonzero(front & (full < empty))
    assert np.ptp(rows) + 1 == pytest.approx(525 * 0.8 / 3.75, abs=2)
    assert np.ptp(columns) + 1 == pytest.approx(525 * 1.0 / 3.75, abs=2)
    assert columns.mean() == pytest.approx(319.5 + 525 * 0.3 / 3.75, abs=1)
    turned = view.render_room(Room(7.0, 3.0, 2.6, (piece._replace(yaw=math.pi / 2),)))
    assert np.abs(turned - 3.5).min() < 1e-9  # its long side now points to the camera


@pytest.mark.parametrize("camera", [TOF, RGBD])
@pytest.mark.parametrize("z", [1.0, 3.0, 6.0])
@pytest.mark.parametrize("noise", [1.0, 2.0])
def test_noise_has_the_deviation_of_its_formula(camera, z, noise):
    """On a wall the deviation is that of the formula times ``noise``, with that of the quantization.

    A step's deviation of 1 / sqrt(12) holds where the noise is at least half a step.
    """
    measured = camera.measure(wall(z, camera), np.random.default_rng(0), missing=0, noise=noise)
    quantum = camera.inverse_depth_step * z**2 / math.sqrt(12)
    expected = math.hypot(noise * (camera.base_noise + camera.noise_growth * z**2), quantum)
    assert measured.std() == pytest.approx(expected, rel=0.05)
    assert measured.mean() == pytest.approx(z, abs=0.02 * expected + 0.5 * camera.inverse_depth_step * z**2)


def test_rgbd_depths_are_quantized_in_disparity():
    """Inverse depths are multiples of a step, which is 7 cm at 5 m; time-of-flight depths aren't."""
    slope = np.tile(np.linspace(1, 7, 640), (480, 1))
    inverse = 1 / RGBD.measure(slope, np.random.default_rng(0), missing=0).astype(float)
    np.testing.assert_allclose(
        inverse / RGBD.inverse_depth_step, np.rint(inverse / RGBD.inverse_depth_step), atol=1e-3
    )
    assert RGBD.inverse_depth_step * 25 == pytest.approx(0.07, abs=0.002)
    exact = TOF.measure(wall(3.456), np.random.default_rng(0), missing=0, noise=0)
    np.testing.assert_array_equal(exact, np.float32(3.456))


@pytest.mark.parametrize("camera", [TOF, RGBD])
@pytest.mark.parametrize("noise", [0, 1, 1000])
def test_what_is_out_of_range_is_missing(camera, noise):
    """Whatever the noise, no depth is outside the range; walls far outside leave no pixel."""
    rng = np.random.default_rng(0)
    slope = np.tile(np.linspace(0.2, 9, camera.intrinsics.width), (camera.intrinsics.height, 1))
    measured = camera.measure(slope, rng, missing=0, noise=noise)
    known = measured[np.isfinite(measured)]
    assert camera.near <= known.min()
    assert known.max() <= camera.far
    for z in (0.1, 10.0):
        assert np.isnan(camera.measure(wall(z, camera), rng, noise=min(noise, 1))).all()


@pytest.mark.parametrize("camera", [TOF, RGBD])
@pytest.mark.parametrize("share", [0.0, 0.03, 0.3, 1.0])
def test_missing_share_is_the_one_asked_for(camera, share):
    """Of the pixels within range just the share asked for is missing."""
    measured = camera.measure(wall(3, camera), np.random.default_rng(0), missing=share)
    assert np.isnan(measured).mean() == pytest.approx(share, abs=1 / measured.size)


def test_missing_pixels_come_in_patches_and_at_edges():
    """A missing pixel's neighbor is missing far oftener than others, and edges lose more than surfaces."""
    depth = step()
    edges = find_depth_edges(depth)
    drop_pixels(depth, edges, 0.1, 1.0, np.random.default_rng(0))
    gone = np.isnan(depth)
    assert gone[:, 1:][gone[:, :-1]].mean() > 4 * 0.1
    assert gone[edges].mean() > 3 * gone[~edges].mean()


def test_edges_are_jumps_not_slopes():
    """A jump is an edge one pixel to each side; the floor, however far, is none."""
    edges = find_depth_edges(step())
    assert np.flatnonzero(edges.any(axis=0)).tolist() == [87, 88]
    assert edges[:, 87:89].all()
    floor = LEVEL["tof"].render_room(Room(9.0, 20.0, 20.0))
    assert not find_depth_edges(floor)[floor < 7.5].any()


def test_flying_pixels_lie_between_both_surfaces():
    """At an edge the share of pixels asked for gets depths strictly between; elsewhere nothing changes."""
    depth = step(2.0, 4.0)
    edges = find_depth_edges(depth)
    mixed = add_flying_pixels(depth, edges, FLYING_PIXEL_SHARE, np.random.default_rng(0))
    np.testing.assert_array_equal(mixed[~edges], depth[~edges])
    flying = mixed[mixed != depth]
    assert len(flying) == pytest.approx(FLYING_PIXEL_SHARE * edges.sum(), rel=0.15)
    assert np.all((flying > 2.0) & (flying < 4.0))
    assert flying.std() > 0.4


def test_only_the_time_of_flight_camera_mixes():
    """Between surfaces at 2 and 4 m the time-of-flight camera measures something, the other nothing."""
    between = []
    for camera in (TOF, RGBD):
        measured = camera.measure(step(), np.random.default_rng(0), missing=0)
        between.append(((measured > 2.3) & (measured < 3.7)).sum())
    assert between[0] > 50
    assert between[1] == 0
