// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/padded_rows.hpp"

namespace tricue {

/// A matrix (rows, any number of columns) as somebody else has it.
struct LeftFactor {
    LeftFactor(const PaddedRows& matrix)
        : numbers(matrix.row(0)), pitch(matrix.pitch()), rows(matrix.rows()) {}
    LeftFactor(const float* first, std::ptrdiff_t apart, int count)
        : numbers(first), pitch(apart), rows(count) {}

    const float* numbers;
    std::ptrdiff_t pitch;  ///< numbers from a row to the next
    int rows;
};

/// left (m, k or more) times the first `cols` columns of right (k, n), into those of the first m rows of `product`. Sums go along k in order,
/// whatever the machine.
///
/// For small matrices; Eigen's products stay at the registers that every machine has.
void multiply(const LeftFactor& left, const PaddedRows& right, int cols, PaddedRows& product);

}  // namespace tricue
