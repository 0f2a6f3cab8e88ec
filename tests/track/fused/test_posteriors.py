# SPDX-License-Identifier: MIT
"""What posteriors by several cues are combined to."""

import numpy as np
from tricue import kernels as kernel_sets
from tricue.track.fused import experts

K = kernel_sets.load("native")


def combine_posteriors(posteriors):
    """The tracker's, by native kernels."""
    return experts.combine_posteriors(K, posteriors)


def plane(value: float) -> np.ndarray:
    """(64, 64) posterior with the same value everywhere."""
    return np.full((64, 64), value, np.float32)


def test_odds_multiply():
    """0.8 and 0.6 are odds of 4 and 1.5, together 6, which is 6/7; a third of 0.25 makes it 2/3."""
    np.testing.assert_allclose(combine_posteriors([plane(0.8), plane(0.6)]), 6 / 7, rtol=1e-5)
    np.testing.assert_allclose(combine_posteriors([plane(0.8), plane(0.6), plane(0.25)]), 2 / 3, rtol=1e-5)


def test_missing_posteriors_do_not_count():
    """Of none it is None, of one itself, and None in between changes nothing."""
    assert combine_posteriors([]) is None
    assert combine_posteriors([None, None]) is None
    np.testing.assert_array_equal(combine_posteriors([None, plane(0.3)]), plane(0.3))
    np.testing.assert_array_equal(
        combine_posteriors([plane(0.8), None, plane(0.6)]), combine_posteriors([plane(0.8), plane(0.6)])
    )


def test_one_half_is_neutral():
    """A posterior of 1/2 changes no other, whatever the order."""
    some = np.random.default_rng(0).uniform(0.001, 0.999, (64, 64)).astype(np.float32)
    np.testing.assert_allclose(combine_posteriors([some, plane(0.5)]), some, rtol=1e-4)
    np.testing.assert_allclose(combine_posteriors([plane(0.5), some]), some, rtol=1e-4)


def test_certain_posteriors():
    """Certainties stay certain, contradictions stay finite."""
    assert combine_posteriors([plane(1.0), plane(0.3)]).max() == 1
    assert combine_posteriors([plane(0.0), plane(0.7)]).max() == 0
    assert np.isfinite(combine_posteriors([plane(1.0), plane(0.0)])).all()
