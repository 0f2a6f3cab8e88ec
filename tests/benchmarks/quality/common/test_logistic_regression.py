# SPDX-License-Identifier: MIT
import numpy as np

from benchmarks.quality.common.logistic_regression import fit


def test_known_weights_are_found():
    """Labels drawn by known log-odds, of features in different units and with an offset each."""
    rng = np.random.default_rng(0)
    features = rng.normal([5.0, 0.3, 0.0], [2.0, 0.1, 1.0], (100_000, 3))
    true = np.array([0.8, -12.0, 0.0, -0.4])
    labels = rng.random(len(features)) < 1 / (1 + np.exp(-(features @ true[:-1] + true[-1])))
    found = fit(features, labels, np.ones(len(features)))
    np.testing.assert_allclose(found * [2.0, 0.1, 1.0, 0.3], true * [2.0, 0.1, 1.0, 0.3], atol=0.05)


def test_weights_count_like_copies():
    """A sample of weight 3 counts like three; one of weight 0 doesn't, but for the standard deviations."""
    features = np.array([[0.0], [1.0], [2.0], [3.0], [1.5], [1.5]])
    labels = np.array([False, True, False, True, True, True])
    weights = np.array([1.0, 1.0, 3.0, 1.0, 0.0, 0.0])
    found = fit(features, labels, weights)
    log_odds = features[:, 0] * found[0] + found[1]
    residual = weights * (1 / (1 + np.exp(-log_odds)) - labels)
    assert abs(residual.sum()) < 1e-9
    other = fit(features, labels, np.ones(6))
    assert found[0] * 2.5 + found[1] < other[0] * 2.5 + other[1]


def test_separable_labels_have_finite_weights():
    """The penalty limits them."""
    found = fit(np.arange(10.0)[:, None], np.arange(10) >= 5, np.ones(10))
    assert np.isfinite(found).all()
    assert np.sign(np.arange(10) * found[0] + found[1]).tolist() == [-1.0] * 5 + [1.0] * 5
