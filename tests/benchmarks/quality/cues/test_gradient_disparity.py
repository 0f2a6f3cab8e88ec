# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest

from benchmarks.quality.common import middlebury
from benchmarks.quality.common.middlebury import StereoPair
from benchmarks.quality.cues import gradient_disparity as compare

NEAR, FAR = 6, 11  # px: the left half of the picture, the right half


@pytest.fixture
def pair():
    """Two walls of texture, the right one 5 px nearer, and the truth of that."""
    noise = np.random.default_rng(1).normal(size=(60, 200)).astype(np.float32)
    smooth = cv2.GaussianBlur(noise, (0, 0), 1.5)
    texture = (128 + 40 * smooth / smooth.std()).clip(0, 255).astype(np.uint8)
    truth = np.full((60, 180), NEAR, np.float32)
    truth[:, 100:] = FAR
    right = texture[:, NEAR : NEAR + 180].copy()
    right[:, 100 - FAR : -FAR] = texture[:, 100:180][:, : 180 - 100]
    return StereoPair("walls", texture[:, :180].copy(), right, truth, 16)


def test_exact_disparities_have_no_error(pair):
    """A method that knows the truth has no error, reads all, and takes nothing far for near."""
    result = compare.measure(pair, lambda left, right, prediction: pair.truth, 1)
    assert result[:4] == (0, 100, 0, 0)
    assert (result.nearer_read, result.nearer_median) == (100, 0)


def test_echoing_the_prediction_is_counted(pair):
    """A method that returns the prediction takes every far pixel for near."""

    def echo(left, right, prediction):
        return np.full(pair.truth.shape, prediction, np.float32)

    result = compare.measure(pair, echo, 1)
    assert (result.far_as_near, result.far_as_near_read) == (100, 100)
    assert result.median == 1  # of 0, 1, 2 px on either side


def test_rejecting_all_is_counted(pair):
    """Without any disparity there is no error, and nothing far is taken for near."""
    result = compare.measure(pair, lambda left, right, prediction: np.full_like(pair.truth, np.nan), 1)
    assert result.read == result.far_as_near == result.nearer_read == 0
    assert np.isnan([result.median, result.far_as_near_read, result.nearer_median]).all()


def test_levels_read_what_is_nearer(pair):
    """Of two walls 5 px apart three levels read both, wherever the prediction is."""
    result = compare.measure(pair, compare.three_levels, 1)
    assert result.median < 0.1
    assert result.read > 85
    assert result.nearer_read > 85
    assert result.nearer_median < 0.1
    assert result.far_as_near < 2


def test_table_has_a_line_for_each_method(pair):
    """A line per pair and method, as wide as its heading."""
    lines = compare.table([pair], 1).splitlines()
    assert [line.split("|")[2].strip() for line in lines[2:]] == list(compare.METHODS)
    assert {line.count("|") for line in lines} == {len(compare.COLUMNS) + 1}


def test_folder_without_pairs_is_refused(tmp_path, capsys):
    """The folder is named where no pair is in it."""
    with pytest.raises(SystemExit):
        compare.main([str(tmp_path)])
    assert f"expected pairs such as tsukuba under {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("name", middlebury.PAIRS)
def test_reaches_its_numbers_on_real_pairs(data, name):
    """On each Middlebury pair: median error at most 0.3 px at a density of 30 % or more, and at most 3 % of
    far pixels, read or not, are taken for near ones.
    """
    result = compare.measure(middlebury.load(data / "disparity", name), compare.three_levels, 1)
    assert result.median <= 0.3
    assert result.read >= 30
    assert result.far_as_near <= 3
    assert result.far_as_near_read <= 3
