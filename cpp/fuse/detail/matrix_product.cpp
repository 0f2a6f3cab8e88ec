// SPDX-License-Identifier: MIT
#include "fuse/detail/matrix_product.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

struct Product {
    MatrixRows left, right;
    int cols;
    float* to;
    std::ptrdiff_t pitch;
};

/// Computes kRows rows of the product at a time, kRegisters registers of each: no sum waits for the previous one, and each loaded
/// part of a factor is used for many sums.
template <int kLanes, int kRows, int kRegisters>
TRICUE_INLINE void multiply_block(const Product& product, int y, int x) {
    using Register = Pack<float, kLanes>;
    const MatrixRows left = product.left, right = product.right;
    const float *column = left.numbers + left.pitch * y, *numbers = right.numbers + x;
    Register sums[std::size_t{kRows}][std::size_t{kRegisters}] = {};
    for (int i = 0; i < right.count; ++i, ++column, numbers += right.pitch) {
        Register row_part[std::size_t{kRegisters}];
        for (int part = 0; part < kRegisters; ++part) load(numbers + part * kLanes, row_part[part]);
        for (int row = 0; row < kRows; ++row)
            for (int part = 0; part < kRegisters; ++part)
                sums[row][part] += column[left.pitch * row] * row_part[part];
    }
    const std::ptrdiff_t pitch = product.pitch;
    float* to = product.to + pitch * y + x;
    for (int row = 0; row < kRows; ++row, to += pitch)
        for (int part = 0; part < kRegisters; ++part) store(sums[row][part], to + part * kLanes);
}

template <int kLanes, int kRows, int kRegisters>
TRICUE_INLINE void multiply_rows(const Product& product, int y) {
    int x = 0;
    for (; x + (kRegisters - 1) * kLanes < product.cols; x += kRegisters * kLanes)
        multiply_block<kLanes, kRows, kRegisters>(product, y, x);
    if constexpr (kRegisters > 1)
        for (; x < product.cols; x += kLanes) multiply_block<kLanes, kRows, 1>(product, y, x);
}

/// `rows` rows, 1 to kRows.
template <int kLanes, int kRows, int kRegisters>
TRICUE_INLINE void multiply_some(const Product& product, int y, int rows) {
    if (rows == kRows) return multiply_rows<kLanes, kRows, kRegisters>(product, y);
    if constexpr (kRows > 1) multiply_some<kLanes, kRows - 1, kRegisters>(product, y, rows);
}

/// All rows, in blocks whose heights differ by at most one row, because a few sums at a time would wait for each other. AVX-512
/// has twice as many registers as others.
template <int kBytes>
TRICUE_INLINE void multiply_by(const Product& product) {
    constexpr int kLanes = kBytes / int{sizeof(float)}, kRows = 8;
    int blocks = (product.left.count + kRows - 1) / kRows;
    for (int y = 0; blocks > 0; --blocks) {
        const int rows = (product.left.count - y + blocks - 1) / blocks;
        multiply_some<kLanes, kRows, kBytes == 64 ? 2 : 1>(product, y, rows);
        y += rows;
    }
}

TRICUE_MULTIWIDTH(multiply_all, multiply_by, (const Product& product), (product))

}  // namespace

void multiply(const MatrixRows& left, const MatrixRows& right, int cols, AlignedMatrix& product,
              int first_row) {
    multiply_all({left, right, cols, product.row(first_row), product.pitch()});
}

}  // namespace tricue
