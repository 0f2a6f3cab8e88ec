// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/check.hpp"
#include "fuse/detail/small_product.hpp"

namespace tricue {

/// Calls `use` with an empty matrix, whose type is the one for so many rows and columns.
template <typename Use>
inline auto with_matrix_type(Eigen::Index size, Use&& use) {
    return size <= kSmallState ? use(SmallMatrix{}) : use(LargeMatrix{});
}

/// Throws std::invalid_argument unless the mean (N,) is finite, N at least 1, and the covariance (N, N) is one.
inline void require_gaussian_state(VectorRef mean, StatesRef covariance) {
    if (mean.size() < 1) refuse("mean", "at least one number", "none");
    require_finite(mean, "mean");
    require_covariance(covariance, mean.size(), "covariance");
}

/// The mean of a matrix and its transpose: rounding makes them differ slightly, and a filter would amplify that.
template <typename Matrix>
States symmetrized(const Matrix& product) {
    return (0.5 * (product + product.transpose())).array();
}

}  // namespace tricue
