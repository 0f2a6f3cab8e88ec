// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/aligned_matrix.hpp"

namespace tricue {

/// A non-owning view of a matrix with any number of columns.
struct LeftFactor {
    LeftFactor(const AlignedMatrix& matrix)
        : numbers(matrix.row(0)), pitch(matrix.pitch()), rows(matrix.rows()) {}
    LeftFactor(const float* first, std::ptrdiff_t apart, int count)
        : numbers(first), pitch(apart), rows(count) {}

    const float* numbers;
    std::ptrdiff_t pitch;  ///< numbers from a row to the next
    int rows;
};

/// left (m, k or more) times the first `cols` columns of right (k, n), into those of the first m rows of `product`. Sums go along k
/// in order on every machine.
///
/// For small matrices: Eigen's products use only the registers that every machine has.
void multiply(const LeftFactor& left, const AlignedMatrix& right, int cols, AlignedMatrix& product);

}  // namespace tricue
