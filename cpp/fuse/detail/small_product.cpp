// SPDX-License-Identifier: MIT
#include "fuse/detail/small_product.hpp"

#include <algorithm>
#include <array>

#include "base/simd.hpp"

namespace tricue {
namespace {

/// The product c of a, whose columns have zeros below up to kSmallState, and b. Columns of c are written with what is below them,
/// which the next column replaces; c has room for that below its last one.
TRICUE_MULTIVERSION
void multiply(const double* __restrict a, Eigen::Index rows, const double* __restrict b, Eigen::Index inner,
              Eigen::Index cols, double* __restrict c) {
    for (Eigen::Index j = 0; j < cols; ++j, b += inner, c += rows) {
        double sums[kSmallState];
        for (int i = 0; i < kSmallState; ++i) sums[i] = a[i] * b[0];
        for (Eigen::Index k = 1; k < inner; ++k)
            for (int i = 0; i < kSmallState; ++i) sums[i] += a[k * kSmallState + i] * b[k];
        for (int i = 0; i < kSmallState; ++i) c[i] = sums[i];
    }
}

}  // namespace

SmallMatrix product(const SmallMatrix& a, const SmallMatrix& b) {
    std::array<double, kSmallState * kSmallState> columns{};
    for (Eigen::Index k = 0; k < a.cols(); ++k)
        std::copy_n(a.data() + k * a.rows(), a.rows(), columns.data() + k * kSmallState);
    SmallMatrix c(a.rows(), b.cols());
    multiply(columns.data(), a.rows(), b.data(), b.rows(), b.cols(), c.data());
    return c;
}

LargeMatrix product(const LargeMatrix& a, const LargeMatrix& b) {
    return a.lazyProduct(b);
}

}  // namespace tricue
