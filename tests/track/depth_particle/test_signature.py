# SPDX-License-Identifier: MIT
"""The distributions of an object over its box, and what a signature learns."""

import numpy as np
import pytest
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS
from tricue.track.depth_particle.signature import SIGNATURE_RATE, Signature

TARGET = [0.0, 0.0, 3.0, 0.6, 1.7]


def test_a_signature_is_of_columns_and_rows(objects_of):
    """A signature is the distribution over an object's columns, then that over its rows, in float64."""
    objects = objects_of([TARGET])
    sharp, even = np.eye(DISTRIBUTION_BINS, dtype=np.float32)[5], objects.rows[0]
    signature = Signature.from_object(objects._replace(columns=sharp[None]), 0)
    assert signature.distribution.dtype == np.float64
    np.testing.assert_array_equal(signature.distribution, np.concatenate([sharp, even]))


def test_signatures_learn_by_their_rate(objects_of):
    """A signature is an object's own columns, rows and centroid, and moves by a tenth to another's."""
    objects = objects_of([TARGET])
    columns = np.zeros((1, DISTRIBUTION_BINS), np.float32)
    columns[0, 3] = 1
    objects.centroid_offset[:] = 0.1, -0.2
    sharp = Signature.from_object(objects._replace(columns=columns), 0)
    even = Signature.uniform()
    assert even.distribution[:DISTRIBUTION_BINS].sum() == pytest.approx(1)
    assert even.distribution[DISTRIBUTION_BINS:].sum() == pytest.approx(1)
    blended = even.learn(sharp)
    np.testing.assert_allclose(blended.centroid_offset, SIGNATURE_RATE * np.array([0.1, -0.2]), rtol=1e-12)
    assert blended.distribution[:DISTRIBUTION_BINS].sum() == pytest.approx(1)
    assert blended.distribution[3] == pytest.approx((1 - SIGNATURE_RATE) / DISTRIBUTION_BINS + SIGNATURE_RATE)
    np.testing.assert_allclose(blended.distribution[DISTRIBUTION_BINS:], 1 / DISTRIBUTION_BINS, rtol=1e-6)
    np.testing.assert_array_equal(even.distribution, Signature.uniform().distribution)
