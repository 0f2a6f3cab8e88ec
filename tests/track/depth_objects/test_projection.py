# SPDX-License-Identifier: MIT
"""Rectangles in meters, and their boxes in a camera's image."""

import numpy as np
from tricue import Box, Intrinsics
from tricue.track.depth_objects.projection import (
    back_project_box,
    project_box,
    project_rectangle,
)

CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5)
NUMBERS = CAMERA.vector


def boxes(count):
    """Boxes in and across the image, and depths."""
    rng = np.random.default_rng(0)
    return [
        (Box(*rng.uniform([-40, -40, 2, 2], [176, 144, 90, 140]).tolist()), float(rng.uniform(0.5, 8)))
        for _ in range(count)
    ]


def test_states_and_boxes_are_inverse():
    """A box's state, seen by the camera, is the box, in the rectangle's center, size and depth too."""
    for box, z in boxes(50):
        state = back_project_box(box, z, NUMBERS)
        np.testing.assert_allclose(project_box(state, NUMBERS), box, rtol=1e-12, atol=1e-12)
        x, y, *others = project_rectangle(state, NUMBERS)
        np.testing.assert_allclose((x, y), box.center, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(others, [box.width, box.height, z], rtol=1e-12)


def test_corners_are_where_the_camera_projects_them():
    """A box's corners are the projections of its rectangle's, half a pixel on: (0, 0) is a corner there, and
    the center of that pixel here.
    """
    for box, z in boxes(50):
        x, y, _, width, height = back_project_box(box, z, NUMBERS)
        corners = np.array([[x - width / 2, y - height / 2, z], [x + width / 2, y + height / 2, z]])
        np.testing.assert_allclose((CAMERA.project(corners) + 0.5).ravel(), box.xyxy, rtol=0, atol=1e-10)
