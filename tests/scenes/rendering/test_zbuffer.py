# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.scenes.rendering.depth_view import DepthWindow
from tricue.scenes.rendering.zbuffer import box_of_mask, find_visible_pixels, merge_window


def window(left, top, depth):
    """A window of these depths."""
    return DepthWindow(left, top, np.array(depth, float))


def test_the_nearer_one_wins():
    """Of two windows that overlap the nearer one's pixels stay, whichever comes first."""
    near, far = window(1, 0, [[2, 2], [2, np.inf]]), window(0, 0, [[3, 3], [3, 3]])
    for order in ((near, far), (far, near)):
        depth = np.full((3, 4), 9.0)
        for one in order:
            merge_window(one, depth)
        np.testing.assert_array_equal(depth, [[3, 2, 2, 9], [3, 2, 9, 9], [9, 9, 9, 9]])
        wins, share = find_visible_pixels(far, depth)
        np.testing.assert_array_equal(np.argwhere(wins), [[0, 0], [1, 0]])
        assert share == 0.5
        assert find_visible_pixels(near, depth)[1] == 1


def test_where_a_window_is_nearest_is_told():
    """Laying returns the window's part inside the image and the pixels that it took."""
    depth = np.full((2, 3), 2.0)
    (rows, columns), nearer = merge_window(window(-1, 1, [[1, 1, 3]]), depth)
    assert (rows, columns) == (slice(1, 2), slice(0, 2))
    np.testing.assert_array_equal(nearer, [[True, False]])
    np.testing.assert_array_equal(depth, [[2, 2, 2], [1, 2, 2]])


def test_what_is_outside_the_image_is_not_seen():
    """Pixels beyond the edge don't count, and a window that is wholly there has the share 0."""
    depth = np.full((2, 3), 9.0)
    half_out = window(2, 0, [[1, 1]])
    merge_window(half_out, depth)
    assert find_visible_pixels(half_out, depth)[1] == 1
    assert find_visible_pixels(window(5, 0, [[1.0]]), depth)[1] == 0


def test_box_round_holds_all_pixels():
    """The box goes from the first pixel's edge to the last one's; no pixels have no box."""
    mask = np.zeros((5, 6), bool)
    assert box_of_mask(mask) is None
    mask[1, 4] = mask[3, 2] = True
    assert box_of_mask(mask) == pytest.approx(Box(2, 1, 3, 3))
