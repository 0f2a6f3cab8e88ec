// SPDX-License-Identifier: MIT
#pragma once

namespace tricue {

constexpr int kMaxWindow = 15;

/// The means of n windows of `count` x `count` numbers side by side, an odd count up to kMaxWindow.
///
/// @param rows   `count` rows of n + count - 1 numbers; each sum adds them in this order, so it has the same bits wherever the
///               window is, which running sums wouldn't have
/// @param column room for n + count - 1 numbers, that overlaps none of the rows
void box_filter_row(const float* const* rows, int count, int n, float* column, float* mean);

}  // namespace tricue
