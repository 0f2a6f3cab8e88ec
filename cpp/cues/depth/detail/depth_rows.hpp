// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

namespace tricue {

constexpr float kUnmeasured = std::numeric_limits<float>::infinity();  ///< in searches for the nearest

inline float smaller(float a, float b) {
    return a < b ? a : b;
}

/// The nearest of each of n pixels and its left and right neighbors; the row has one more float at either end.
void nearest_in_row(const float* padded, int n, float* nearest);

/// Copies every step-th number of a row, n in all.
void thin_row(const float* from, std::ptrdiff_t n, std::ptrdiff_t step, float* to);

}  // namespace tricue
