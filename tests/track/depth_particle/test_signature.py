# SPDX-License-Identifier: MIT
"""How differently objects are spread over their boxes, and what a target's signature learns."""

import numpy as np
import pytest
from tricue.track.depth_objects.objects import SLICES
from tricue.track.depth_particle.signature import RATE, Signature

TARGET = [0.0, 0.0, 3.0, 0.6, 1.7]


def test_signatures_differ_by_at_most_one(objects_of):
    """Equal signatures are 0 apart, those that share no slice 1, and half of the columns alone a quarter."""
    objects = objects_of([TARGET, TARGET, TARGET])
    first, last = np.eye(SLICES, dtype=np.float32)[[0, -1]]
    half = (first + last) / 2
    objects = objects._replace(columns=np.stack([first, last, half]), rows=np.stack([first, last, first]))
    signature = Signature.of(objects, 0)
    assert [signature.distance(objects, i) for i in range(3)] == pytest.approx([0, 1, 0.25], abs=1e-7)


def test_columns_and_rows_are_told_apart(objects_of):
    """A signature is an object's columns and then its rows, as shares in float64: with the two exchanged an
    object is another.
    """
    objects = objects_of([TARGET, TARGET])
    sharp, even = np.eye(SLICES, dtype=np.float32)[5], objects.rows[0]
    objects = objects._replace(columns=np.stack([sharp, even]), rows=np.stack([even, sharp]))
    signature = Signature.of(objects, 0)
    assert signature.spread.dtype == np.float64
    np.testing.assert_array_equal(signature.spread, np.concatenate([sharp, even]))
    assert signature.distance(objects, 0) == 0
    assert signature.distance(objects, 1) > 0.9


def test_signatures_learn_by_their_rate(objects_of):
    """A signature is an object's own columns, rows and centroid, and moves by a tenth to another's."""
    objects = objects_of([TARGET])
    columns = np.zeros((1, SLICES), np.float32)
    columns[0, 3] = 1
    sharp = Signature.of(objects._replace(columns=columns, shift=np.array([[0.1, -0.2]])), 0)
    even = Signature.unknown()
    assert even.spread[:SLICES].sum() == pytest.approx(1)
    assert even.spread[SLICES:].sum() == pytest.approx(1)
    blended = even.learned(sharp)
    np.testing.assert_allclose(blended.shift, RATE * np.array([0.1, -0.2]), rtol=1e-12)
    assert blended.spread[:SLICES].sum() == pytest.approx(1)
    assert blended.spread[3] == pytest.approx((1 - RATE) / SLICES + RATE)
    np.testing.assert_allclose(blended.spread[SLICES:], 1 / SLICES, rtol=1e-6)
    np.testing.assert_array_equal(even.spread, Signature.unknown().spread)
