# SPDX-License-Identifier: MIT
from dataclasses import astuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue.evaluation import metrics

NO_BOX = [np.nan] * 4
positions = st.integers(-50, 50)
sizes = st.integers(1, 40)
boxes = st.tuples(positions, positions, sizes, sizes)


@given(st.lists(st.tuples(boxes, boxes), min_size=1, max_size=8))
def test_overlap_counts_pixels(pairs):
    """The overlap of boxes with whole corners is the ratio of the pixels in both to the pixels in either."""
    found, true = map(np.array, zip(*pairs, strict=True))

    def mask(box):
        canvas = np.zeros((140, 140), dtype=bool)
        x, y, width, height = box
        canvas[y + 50 : y + 50 + height, x + 50 : x + 50 + width] = True
        return canvas

    counted = [(mask(a) & mask(b)).sum() / (mask(a) | mask(b)).sum() for a, b in pairs]
    np.testing.assert_allclose(metrics.overlaps(found, true), counted, rtol=1e-12)


def test_shifted_box_has_its_closed_form():
    """A box moved by a share t of its width overlaps by (1 - t) / (1 + t), its center is t widths off."""
    shift = np.array([0.0, 0.25, 0.5, 0.9, 1.0, 2.0])
    true = np.tile([10.0, 20.0, 40.0, 30.0], (6, 1))
    found = true + shift[:, None] * [40.0, 0.0, 0.0, 0.0]
    np.testing.assert_allclose(
        metrics.overlaps(found, true), np.clip((1 - shift) / (1 + shift), 0, 1), atol=1e-15
    )
    np.testing.assert_allclose(metrics.center_errors(found, true), 40.0 * shift, atol=1e-13)


def test_center_error_does_not_depend_on_size():
    """Boxes of different size with one center have no center error; one 3 and 4 pixels away has 5."""
    found = [[0, 0, 10, 10], [3, 4, 10, 10]]
    np.testing.assert_allclose(metrics.center_errors(found, [[-5, -5, 20, 20]] * 2), [0, 5])


def test_success_curve_is_strict_and_has_its_closed_form():
    """An overlap on a threshold is not above it: a perfect result has AUC 20/21, a half one 10/21."""
    np.testing.assert_array_equal(metrics.success_curve([1.0]), [1.0] * 20 + [0.0])
    np.testing.assert_array_equal(metrics.success_curve([0.5]), [1.0] * 10 + [0.0] * 11)
    assert metrics.score([[0, 0, 4, 4]], [[0, 0, 4, 4]]).auc == pytest.approx(20 / 21)
    assert metrics.score([[0, 0, 4, 2]], [[0, 0, 4, 4]]).auc == pytest.approx(10 / 21)


def test_precision_counts_frames_up_to_20_pixels():
    """Precision takes errors of 20 px in, and leaves 20.5 out."""
    true = [[0, 0, 10, 10]] * 4
    found = [[0, 0, 10, 10], [20, 0, 10, 10], [20.5, 0, 10, 10], [0, -20, 10, 10]]
    result = metrics.score(found, true)
    assert result.precision == 0.75
    assert result.success == 0.25
    assert result.mean_error == pytest.approx((0 + 20 + 20.5 + 20) / 4)


def test_normalized_error_is_in_sizes_of_the_true_box():
    """Half a width aside and a whole height down is sqrt(1/4 + 1) whatever the size of either box."""
    true = np.array([[10, 20, 40, 30], [-5, 7, 3, 8]], dtype=float)
    found = true + true[:, [2, 3, 2, 3]] * [0.5, 1.0, 0.0, 0.0]
    np.testing.assert_allclose(metrics.normalized_center_errors(found, true), np.sqrt(1.25), rtol=1e-14)
    grown = found + found[:, [2, 3, 2, 3]] * [-0.5, -0.5, 1.0, 1.0]
    np.testing.assert_allclose(metrics.normalized_center_errors(grown, true), np.sqrt(1.25), rtol=1e-14)
    np.testing.assert_array_equal(
        metrics.normalized_center_errors([NO_BOX, [0, 0, 1, 1]], [[0, 0, 1, 1], NO_BOX]), [np.inf, np.nan]
    )


def test_normalized_precision_has_its_closed_form():
    """Errors on the thresholds count as reached: a perfect result has 1, one a quarter off 26/51, one half
    off 1/51, and one beyond 0.
    """
    true = [[0, 0, 100, 100]]
    for shift, expected in ((0, 1), (25, 26 / 51), (50, 1 / 51), (51, 0)):
        assert metrics.score([[shift, 0, 100, 100]], true).norm_precision == pytest.approx(expected)


def test_thresholds_are_otbs_and_trackingnets():
    """21 overlaps to 1, 51 errors to 50 px, 51 of them to half the box's size."""
    np.testing.assert_allclose(metrics.OVERLAP_THRESHOLDS * 20, range(21), atol=1e-12)
    np.testing.assert_array_equal(metrics.PRECISION_THRESHOLDS, range(51))
    np.testing.assert_allclose(metrics.NORM_PRECISION_THRESHOLDS * 100, range(51), atol=1e-12)


def test_position_error_is_what_the_truth_allows():
    """Three known coordinates give the distance, the depth alone its difference, no depth nothing; and there
    is no error without a position from the tracker.
    """
    nan = np.nan
    found = [[1, 2, 3], [1, 2, 3], [1, 2, 3], [nan] * 3, [1, 2, 3], [1, 2, 3]]
    true = [[1, 6, 6], [nan, nan, 1], [nan] * 3, [1, 2, 3], [5, nan, 4], [1, 2, nan]]
    np.testing.assert_allclose(metrics.position_errors(found, true), [5, 2, nan, nan, 1, nan])


def test_frames_without_truth_are_left_out():
    """A NaN row of the truth changes no summary, whatever the tracker said there."""
    found, true = [[0, 0, 8, 8], [1, 0, 8, 8]], [[0, 0, 8, 8], [0, 0, 8, 8]]
    with_gap = metrics.score([*found, [500, 500, 1, 1]], [*true, NO_BOX])
    assert with_gap == metrics.score(found, true)
    assert np.isnan(astuple(metrics.score([[0, 0, 1, 1]], [NO_BOX]))).all()
    assert np.isnan(astuple(metrics.score(np.empty((0, 4)), np.empty((0, 4))))).all()


def test_missing_box_is_a_miss():
    """A NaN row of the result counts as overlap 0 and an infinite error."""
    result = metrics.score([[0, 0, 8, 8], NO_BOX], [[0, 0, 8, 8]] * 2)
    assert (result.success, result.precision, result.mean_error) == (0.5, 0.5, np.inf)
    assert metrics.overlaps([NO_BOX], [[0, 0, 8, 8]]) == [0.0]


@pytest.mark.parametrize(
    ("found", "true", "words"),
    [
        ([[0, 0, 1, 1]] * 2, [[0, 0, 1, 1]], "boxes: expected as many rows as truth"),
        ([0, 0, 1, 1], [[0, 0, 1, 1]], "boxes: expected an array of shape"),
        ([[0, 0, 1, 1]], [[0, 0, 1]], "truth: expected an array of shape"),
        ([[0, 0, 0, 1]], [[0, 0, 1, 1]], "boxes: expected finite boxes"),
        ([[0, 0, 1, 1]], [[np.inf, 0, 1, 1]], "truth: expected finite boxes"),
    ],
)
def test_bad_boxes_are_named(found, true, words):
    """Every malformed argument is refused by name."""
    with pytest.raises(ValueError, match=words):
        metrics.score(found, true)


@pytest.mark.parametrize(
    ("found", "true", "words"),
    [
        ([[0, 0]], [[0, 0, 0]], "found: expected an array of shape"),
        ([[0, 0, 0]], [0, 0, 0], "true: expected an array of shape"),
        ([[0, 0, 0]], [[0, 0, 0]] * 2, "found: expected as many rows as true"),
    ],
)
def test_bad_positions_are_named(found, true, words):
    """Every malformed position is refused by name."""
    with pytest.raises(ValueError, match=words):
        metrics.position_errors(found, true)
