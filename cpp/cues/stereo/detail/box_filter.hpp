// SPDX-License-Identifier: MIT
#pragma once

namespace tricue {

constexpr int kMaxWindow = 15;

/// A plane, of which means over windows are wanted.
struct BoxFilter {
    const float* const* rows;  ///< as many as a window has, the uppermost first
    float* column;             ///< room for their sums, and a line more
    float* mean;
};

/// The means of n windows of `count` x `count` numbers side by side, an odd count up to kMaxWindow, of some planes.
///
/// Rows have n + count - 1 numbers. All are read, and columns and means written, up to a whole number of lines. Each sum adds the rows
/// in their order, so it has the same bits wherever the window is, which running sums wouldn't have.
void box_filter_rows(const BoxFilter* filters, int planes, int count, int n);

}  // namespace tricue
