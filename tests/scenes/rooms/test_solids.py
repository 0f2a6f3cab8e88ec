# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.rig import Intrinsics
from tricue.scenes.rendering.stereo_camera import RayCamera, RayImage, WhiteLamp
from tricue.scenes.rooms.solids import Placement, make_box, make_can

CAMERA = Intrinsics.from_fov(160, 120, 60.0)
LAMP = WhiteLamp(np.array([0.0, -1.0, 0.0]), 0.6)
GRAY = np.full((16, 16, 3), 128, np.float32)


def depth_of(solid):
    """Its z-buffer (H, W), infinite beside it."""
    canvas = RayImage(np.zeros((120, 160, 3), np.float32), np.full((120, 160), np.inf, np.float32))
    solid.draw(RayCamera(CAMERA, 0.0, 1), canvas, LAMP)
    return canvas.depth


def box_depth(size, pose):
    """The depth at which rays enter a box that stands on y = 0: the last entry between opposite faces."""
    v, u = np.indices((120, 160))
    rays = CAMERA.back_project(u, v, np.ones((120, 160))) @ pose.rotation
    low = np.array([-size[0] / 2, -size[1], -size[2] / 2]) + pose.offset @ pose.rotation
    high = np.array([size[0] / 2, 0, size[2] / 2]) + pose.offset @ pose.rotation
    with np.errstate(divide="ignore"):
        first, last = low / rays, high / rays
    enter, leave = np.minimum(first, last).max(axis=2), np.maximum(first, last).min(axis=2)
    return np.where(enter < leave, enter, np.inf)


@pytest.mark.parametrize("seed", range(4))
def test_a_box_is_closed_from_all_sides(seed):
    """Its faces, those turned away left out, are what rays meet that enter a box, but at its border."""
    rng = np.random.default_rng(seed)
    size = rng.uniform(0.2, 0.5, 3)
    pose = Placement.at(np.array([0.05, 0.1, 1.5]), *rng.uniform(-3, 3, 3))
    found, true = depth_of(make_box(size, [GRAY]).placed(pose)), box_depth(size, pose)
    both = np.isfinite(found) & np.isfinite(true)
    assert both.sum() > 300
    assert np.abs(found[both] - true[both]).max() < 1e-3
    assert (np.isfinite(found) ^ np.isfinite(true)).sum() < 0.02 * both.sum()


def test_a_can_is_round_and_has_a_lid():
    """Seen from above, it is as wide as its diameter at all heights, without gaps; the lid is its highest."""
    pose = Placement.at(np.array([0, 0.1, 1.0]), tilt=-0.5)
    depth = depth_of(make_can(0.1, 0.25, GRAY, GRAY, LAMP).placed(pose))
    seen = np.isfinite(depth)
    for row in np.flatnonzero(seen.any(axis=1))[8:-8]:
        columns = np.flatnonzero(seen[row])
        assert len(columns) == np.ptp(columns) + 1
        assert len(columns) * np.median(depth[row, columns]) / CAMERA.fx == pytest.approx(0.2, rel=0.12)


@pytest.mark.parametrize("seed", range(3))
def test_box_is_around_the_pixels(seed):
    """Of a box and a can's lid and sides, to a pixel."""
    rng = np.random.default_rng(seed)
    solid = make_box(np.array([0.2, 0.3, 0.1]), [GRAY]) + make_can(0.08, 0.4, GRAY, GRAY, LAMP)
    placed = solid.placed(Placement.at(np.array([0, 0.15, 1.2]), *rng.uniform(-0.6, 0.6, 3)))
    rows, columns = np.nonzero(np.isfinite(depth_of(placed)))
    x, y, width, height = placed.box(CAMERA)
    found = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
    assert found == pytest.approx([x, y, x + width, y + height], abs=1.5)


def test_behind_the_camera_there_is_no_box():
    """A thing that is partly behind the camera has none."""
    near = make_box(np.array([0.2, 0.2, 0.4]), [GRAY]).placed(Placement.at(np.array([0, 0, 0.1])))
    assert np.isnan(near.box(CAMERA)).all()
