# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import sequences


def test_sequence_comes_back_as_written(folders, patrol):
    """Frames are those written, boxes count from 0, frames past the truth have NaN."""
    path = folders / "there" / "groundtruth_rect.txt"
    sequence = sequences.load(path.parent)
    assert sequence.name == "there"
    assert all(np.array_equal(a.color, b.color) for a, b in zip(sequence.frames, patrol[0], strict=True))
    np.testing.assert_array_equal(sequence.truth, patrol[1])


@pytest.mark.parametrize("text", ["", "nan,nan,nan,nan\n1,2,3,4\n"])
def test_sequence_without_a_first_box_is_named(text, folders, tmp_path):
    """A sequence whose first frame has no true box can't be started on, and is named."""
    (tmp_path / "patrol").mkdir()
    (tmp_path / "patrol" / "img").symlink_to(folders / "there" / "img")
    (tmp_path / "patrol" / "groundtruth_rect.txt").write_text(text)
    with pytest.raises(ValueError, match="patrol: expected a true box in the first frame"):
        sequences.load(tmp_path / "patrol")


def test_recorded_sequences_load(data):
    """The recorded sequences decode, and every one has a first true box inside its first frame."""
    for path in (data / "color" / name for name in ("Couple", "Crossing", "Football1")):
        sequence = sequences.load(path)
        height, width = sequence.frames[0].color.shape[:2]
        x, y, box_width, box_height = sequence.truth[0]
        assert 0 <= x < x + box_width <= width
        assert 0 <= y < y + box_height <= height
        assert len(sequence.truth) == len(sequence.frames) > 70
