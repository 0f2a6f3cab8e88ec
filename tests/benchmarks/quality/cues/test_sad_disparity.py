# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import middlebury
from benchmarks.quality.common.middlebury import StereoPair
from benchmarks.quality.cues import sad_disparity

SHIFT = 5


@pytest.fixture
def pair():
    """Noise that is 5 px farther to the left in the right image, and the truth of that."""
    wide = np.random.default_rng(1).integers(0, 256, (60, 120), dtype=np.uint8)
    left, right = wide[:, :-SHIFT].copy(), wide[:, SHIFT:].copy()
    return StereoPair("noise", left, right, np.full(left.shape, SHIFT, np.float32), 16)


def test_both_match_what_is_only_shifted(pair):
    """Both matchers find the shift wherever their window lies inside, in 85 % or more of the pixels."""
    for result in sad_disparity.measure(pair, rounds=1):
        assert result.bad < 2
        assert result.kept > 85
        assert result.rate > 0


def test_error_is_that_from_the_truth(pair):
    """With a truth of half a pixel more all errors grow by as much; of 2 px more all pixels are bad."""
    exact, half, far = (
        sad_disparity.measure(pair._replace(truth=pair.truth + np.float32(more)), rounds=1)[1]
        for more in (0, 0.5, 2)
    )
    assert half.mean == pytest.approx(0.5, abs=exact.mean + 1e-6)
    assert far.bad > 98


def test_pixels_without_truth_do_not_count(pair):
    """Where nothing is known nothing is wrong, however much the rest is."""
    truth = pair.truth.copy()
    truth[:30] = np.nan
    known = sad_disparity.measure(pair._replace(truth=truth), rounds=1)[1]
    truth[30:] += np.float32(2)
    assert known.bad < 2
    assert sad_disparity.measure(pair._replace(truth=truth), rounds=1)[1].bad > 98


def test_report_has_a_table_for_each_case(pair):
    """Dense and kept, in equal light and darker: a line per pair, and the means."""
    texts = list(sad_disparity.report([pair, pair._replace(name="other")], [7], rounds=1))
    assert [text.splitlines()[0] for text in texts] == [
        *("7x7, dense", "7x7, dense, the right image 10% darker"),
        *("7x7, kept", "7x7, kept, the right image 10% darker"),
    ]
    for text in texts:
        rows = [line.split("|")[1].strip() for line in text.strip().splitlines()[2:]]
        assert rows == ["pair", "---", "noise", "other", "mean"]


def test_folder_without_pairs_is_refused(tmp_path, capsys):
    """The folder is named where no pair is in it."""
    with pytest.raises(SystemExit):
        sad_disparity.main([str(tmp_path)])
    assert f"expected pairs such as tsukuba under {tmp_path}" in capsys.readouterr().err


@pytest.mark.parametrize("gain", sad_disparity.GAINS)
def test_ours_is_no_worse_on_real_pairs(data, gain):
    """On the Middlebury pairs mean error and bad pixels are no worse than StereoBM's, in the mean of them."""
    pairs = [middlebury.load(data / "disparity", name) for name in middlebury.PAIRS]
    results = np.array([sad_disparity.measure(pair, gain=gain, rounds=1) for pair in pairs])
    theirs, ours = results.mean(axis=0)
    assert ours[0] <= theirs[0]
    assert ours[1] <= theirs[1]
