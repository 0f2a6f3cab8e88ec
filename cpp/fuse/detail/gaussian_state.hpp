// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/check.hpp"

namespace tricue {

using Matrix = Eigen::MatrixXd;

/// What the Kalman filter's steps ask of a state.
inline void require_belief(VectorRef mean, StatesRef covariance) {
    if (mean.size() < 1) refuse("mean", "at least one number", "none");
    require_finite(mean, "mean");
    require_covariance(covariance, mean.size(), "covariance");
}

/// The mean of a product and its transpose: rounding leaves them slightly unlike, and filters make that grow.
inline States symmetric(const Matrix& product) {
    return (0.5 * (product + product.transpose())).array();
}

}  // namespace tricue
