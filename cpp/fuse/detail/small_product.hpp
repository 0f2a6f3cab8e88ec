// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// The most numbers of a state, or of a measurement, for which matrices hold their numbers themselves.
constexpr int kSmallState = 12;

/// A matrix with at most kMax rows and columns, which needs no allocated memory.
template <int kMax>
using MatrixUpTo = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMax, kMax>;

using SmallMatrix = MatrixUpTo<kSmallState>;
using LargeMatrix = MatrixUpTo<Eigen::Dynamic>;

/// The product of two matrices, whose numbers are summed in order. Eigen sums those of small matrices one by one; here columns of a
/// fixed length, with zeros below, are summed in registers.
SmallMatrix product(const SmallMatrix& a, const SmallMatrix& b);
LargeMatrix product(const LargeMatrix& a, const LargeMatrix& b);

}  // namespace tricue
