// SPDX-License-Identifier: MIT
#include "fuse/detail/matrix_product.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

struct Factors {
    const float *left, *right;
    int rows, inner, cols;
    std::ptrdiff_t left_pitch, right_pitch, product_pitch;  ///< numbers from a row to the next
};

/// kRows rows of the product, one register of each at a time: no sum waits for the one before, and the right factor is read once
/// for all rows.
template <int kLanes, int kRows>
TRICUE_INLINE void multiply_rows(const Factors& factors, int y, float* product) {
    using Register = Pack<float, kLanes>;
    const float* left = factors.left + factors.left_pitch * y;
    for (int x = 0; x < factors.cols; x += kLanes) {
        Register sums[std::size_t{kRows}] = {};
        for (int i = 0; i < factors.inner; ++i) {
            Register right;
            load(factors.right + factors.right_pitch * i + x, right);
            for (int row = 0; row < kRows; ++row) sums[row] += left[factors.left_pitch * row + i] * right;
        }
        for (int row = 0; row < kRows; ++row)
            store(sums[row], product + factors.product_pitch * (y + row) + x);
    }
}

/// All rows from y on: kRows at a time, then the remaining ones fewer at a time.
template <int kLanes, int kRows>
TRICUE_INLINE void multiply_from(const Factors& factors, int y, float* product) {
    for (; y + kRows <= factors.rows; y += kRows) multiply_rows<kLanes, kRows>(factors, y, product);
    if constexpr (kRows > 1) multiply_from<kLanes, kRows / 2>(factors, y, product);
}

template <int kBytes>
TRICUE_INLINE void multiply_by(const Factors& factors, float* product) {
    constexpr int kRows = 8;
    multiply_from<kBytes / int{sizeof(float)}, kRows>(factors, 0, product);
}

TRICUE_MULTIWIDTH(multiply_all, multiply_by, (const Factors& factors, float* product), (factors, product))

}  // namespace

void multiply(const LeftFactor& left, const AlignedMatrix& right, int cols, AlignedMatrix& product) {
    multiply_all({left.numbers, right.row(0), left.rows, right.rows(), cols, left.pitch, right.pitch(),
                  product.pitch()},
                 product.row(0));
}

}  // namespace tricue
