# SPDX-License-Identifier: MIT
"""How unknown a position may be."""

import numpy as np
import pytest
from tricue.track.base.position_limit import MAX_SIGMA, limit_covariance


def covariance(rng, size, scale):
    """(size, size), symmetric and positive definite, of numbers about so large."""
    root = rng.normal(0, scale, (size, size))
    return root @ root.T


@pytest.mark.parametrize(("size", "moving"), [(6, range(6)), (10, [0, 1, 2, 7, 8, 9]), (7, range(3))])
def test_what_is_known_less_well_is_limited(size, moving):
    """It stays a covariance with the correlations that it had; what doesn't move keeps its variance."""
    before = covariance(np.random.default_rng(0), size, 1e4)
    after = limit_covariance(before, np.array(moving))
    deviations = np.sqrt(np.diag(after))
    assert deviations[:3].max() == pytest.approx(MAX_SIGMA)
    still = [each for each in range(size) if each not in moving]
    np.testing.assert_array_equal(np.diag(after)[still], np.diag(before)[still])
    own, old = (each / np.outer(*[np.sqrt(np.diag(each))] * 2) for each in (after, before))
    np.testing.assert_allclose(own, old, rtol=1e-9)
    assert np.linalg.eigvalsh(after).min() > 0
    np.testing.assert_array_equal(after, after.T)


def test_what_is_known_stays_as_it_is():
    """It isn't even copied."""
    before = covariance(np.random.default_rng(0), 6, 1.0)
    assert limit_covariance(before, np.arange(6)) is before
