# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.frame import Frame

from benchmarks.quality.common.depth_recordings import DepthRecording, find_targets, measured_depths

NAN = float("nan")


def recording(root, **how):
    """The only target's."""
    (entry,) = find_targets(root)
    return DepthRecording(entry.open(), **how)


def red_columns(frame):
    """Those in which the person is red, in the middle of the image."""
    row = frame.color[30].astype(int)
    return np.flatnonzero((row[:, 2] > 150) & (row[:, 0] < 80))


def test_a_further_file_of_true_boxes_is_a_target(walk):
    """It is named by the file and has its own boxes and absences; the depths are of the first target."""
    (walk / "walk" / "groundtruth_wall.txt").write_text("1,2,30,40\nnan,nan,nan,nan\n" + "1,2,30,40\n" * 8)
    first, further = (each.open() for each in find_targets(walk))
    assert (first.entry.name, further.entry.name) == ("walk", "walk wall")
    np.testing.assert_array_equal(first.truth(10)[0], [20, 10, 12, 40])
    np.testing.assert_array_equal(further.truth(10)[[0, 9]], [[1, 2, 30, 40]] * 2)
    assert further.absent(10).tolist() == [False, True] + [False] * 8
    assert first.positions(10)[0, 2] == 2.0
    assert np.isnan(further.positions(10)).all()


def test_a_further_file_with_errors_is_named(walk):
    """By its own name."""
    (walk / "walk" / "groundtruth_wall.txt").write_text("1,2\n")
    with pytest.raises(ValueError, match=r"groundtruth_wall\.txt, line 1"):
        find_targets(walk)[1].open()


def test_color_is_registered_to_depth(walk):
    """Trackers may then use both. At 2 m a shift of 0.1 m is 90 * 0.1 / 2 px in the color image, which are 3
    in the depth image.
    """
    here, shifted = recording(walk), recording(walk, shift=0.1)
    assert not here.opened.registered
    assert (here.inputs.registered, here.inputs.channel) == (True, "color")
    assert here.inputs.intrinsics == here.opened.intrinsics
    columns = red_columns(here.frames[5])
    assert abs(columns[0] - 30) <= 1
    assert abs(columns[-1] - 41) <= 1
    # The person's pixels look 3 px farther right in the color image, where the last of them aren't red.
    inside = [np.intersect1d(red_columns(each.frames[5]), np.arange(30, 42)) for each in (here, shifted)]
    assert len(inside[0]) - len(inside[1]) in (2, 3, 4)
    np.testing.assert_array_equal(here.depths, [2.0] * 10)


def test_registered_color_is_as_in_the_files(walk):
    """With one camera; true depths are those of the position file."""
    (walk / "intrinsics.toml").write_text("fx = 60.0\nfy = 60.0\ncx = 39.5\ncy = 29.5\n")
    found = recording(walk, shift=0.1)
    assert found.inputs is found.opened
    np.testing.assert_array_equal(found.frames[3].color, list(found.opened.source)[3].color)


def test_unknown_depths_are_measured(walk):
    """In the true boxes, where no file has them."""
    (walk / "walk" / "position_z_mm.txt").unlink()
    (walk / "intrinsics.toml").unlink()
    np.testing.assert_array_equal(recording(walk).depths, [2.0] * 10)


def test_depths_are_of_the_inner_half():
    """The median of what was measured there; NaN where nothing was or the box is unknown or outside."""
    depth = np.full((20, 20), 9.0, np.float32)
    depth[5:15, 5:15] = np.linspace(1, 3, 100, dtype=np.float32).reshape(10, 10)
    depth[5:15, 5:10] = np.nan
    boxes = np.array([[0, 0, 20, 20], [5, 5, 4, 4], [NAN] * 4, [30, 0, 8, 8], [-9, 0, 8, 8], [12, 12, 1, 1]])
    found = measured_depths([Frame(depth=depth)] * len(boxes), boxes)
    assert found[0] == pytest.approx(np.median(depth[5:15, 10:15]))
    assert np.isnan(found[1:4]).all()
    assert found[4] == 9.0
    assert found[5] == depth[12, 12]
    assert np.isnan(measured_depths([Frame(np.zeros((4, 4, 3), np.uint8))], boxes[:1])).all()
