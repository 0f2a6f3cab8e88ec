# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest

from benchmarks.quality.common import middlebury


def test_pairs_are_read_with_their_factor(tmp_path):
    """Gray levels of the truth are divided by the pair's factor, 0 is unknown; a missing file is named."""
    levels = np.array([[0, 8, 20, 255]], np.uint8)
    (tmp_path / "venus").mkdir()
    for name in ("im2.png", "im6.png", "disp2.png"):
        with pytest.raises(OSError, match=r"expected im2.png, im6.png and disp2.png in .*venus"):
            middlebury.load(tmp_path, "venus")
        cv2.imwrite(str(tmp_path / "venus" / name), levels)
    found = middlebury.load(tmp_path, "venus")
    np.testing.assert_array_equal(found.truth, np.float32([[np.nan, 1, 2.5, 255 / 8]]))
    assert (found.name, found.disparities) == ("venus", 32)
