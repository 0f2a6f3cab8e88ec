# SPDX-License-Identifier: MIT
"""The distance between the distributions of objects over their boxes, and what a signature learns."""

import numpy as np
import pytest
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS
from tricue.track.depth_particle.signature import SIGNATURE_RATE, Signature

TARGET = [0.0, 0.0, 3.0, 0.6, 1.7]


def test_signatures_differ_by_at_most_one(objects_of):
    """Equal signatures are 0 apart, those that share no bin 1, and half of the columns alone a quarter."""
    objects = objects_of([TARGET, TARGET, TARGET])
    first, last = np.eye(DISTRIBUTION_BINS, dtype=np.float32)[[0, -1]]
    half = (first + last) / 2
    objects = objects._replace(columns=np.stack([first, last, half]), rows=np.stack([first, last, first]))
    signature = Signature.from_object(objects, 0)
    assert [signature.distance(objects, i) for i in range(3)] == pytest.approx([0, 1, 0.25], abs=1e-7)


def test_columns_and_rows_are_distinguished(objects_of):
    """A signature is the distribution over an object's columns, then that over its rows, in float64. With the
    two exchanged it is another.
    """
    objects = objects_of([TARGET, TARGET])
    sharp, even = np.eye(DISTRIBUTION_BINS, dtype=np.float32)[5], objects.rows[0]
    objects = objects._replace(columns=np.stack([sharp, even]), rows=np.stack([even, sharp]))
    signature = Signature.from_object(objects, 0)
    assert signature.distribution.dtype == np.float64
    np.testing.assert_array_equal(signature.distribution, np.concatenate([sharp, even]))
    assert signature.distance(objects, 0) == 0
    assert signature.distance(objects, 1) > 0.9


def test_signatures_learn_by_their_rate(objects_of):
    """A signature is an object's own columns, rows and centroid, and moves by a tenth to another's."""
    objects = objects_of([TARGET])
    columns = np.zeros((1, DISTRIBUTION_BINS), np.float32)
    columns[0, 3] = 1
    sharp = Signature.from_object(
        objects._replace(columns=columns, centroid_offset=np.array([[0.1, -0.2]])), 0
    )
    even = Signature.uniform()
    assert even.distribution[:DISTRIBUTION_BINS].sum() == pytest.approx(1)
    assert even.distribution[DISTRIBUTION_BINS:].sum() == pytest.approx(1)
    blended = even.learn(sharp)
    np.testing.assert_allclose(blended.centroid_offset, SIGNATURE_RATE * np.array([0.1, -0.2]), rtol=1e-12)
    assert blended.distribution[:DISTRIBUTION_BINS].sum() == pytest.approx(1)
    assert blended.distribution[3] == pytest.approx((1 - SIGNATURE_RATE) / DISTRIBUTION_BINS + SIGNATURE_RATE)
    np.testing.assert_allclose(blended.distribution[DISTRIBUTION_BINS:], 1 / DISTRIBUTION_BINS, rtol=1e-6)
    np.testing.assert_array_equal(even.distribution, Signature.uniform().distribution)
