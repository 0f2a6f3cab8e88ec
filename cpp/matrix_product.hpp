// SPDX-License-Identifier: MIT
#pragma once

#include "padded_rows.hpp"

namespace tricue {

/// left (m, k or more) times the first `cols` columns of right (k, n), into those of the first m rows of `product`. Sums go along k in order,
/// whatever the machine.
///
/// For small matrices; Eigen's products stay at the registers that every machine has.
void multiply(const PaddedRows& left, const PaddedRows& right, int cols, PaddedRows& product);

}  // namespace tricue
