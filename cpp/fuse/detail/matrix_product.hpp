// SPDX-License-Identifier: MIT
#pragma once

#include "fuse/detail/aligned_matrix.hpp"

namespace tricue {

/// A non-owning view of some rows of a matrix, with any number of columns.
struct MatrixRows {
    MatrixRows(const AlignedMatrix& matrix) : MatrixRows(matrix.row(0), matrix.pitch(), matrix.rows()) {}
    MatrixRows(const float* first, std::ptrdiff_t apart, int many)
        : numbers(first), pitch(apart), count(many) {}

    const float* numbers;
    std::ptrdiff_t pitch;  ///< numbers from one row to the next
    int count;
};

/// Writes left (m, k or more) times the first `cols` columns of right (k, n) to those of `product`, in the rows from `first_row`
/// on. Sums go along k in the same order on every machine.
///
/// For small matrices, because Eigen's products use only the registers that every machine has. Whole registers are read and
/// written: rows of `right` must be aligned like those of an AlignedMatrix.
void multiply(const MatrixRows& left, const MatrixRows& right, int cols, AlignedMatrix& product,
              int first_row = 0);

}  // namespace tricue
