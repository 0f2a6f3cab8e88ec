// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace tricue {

/// The bins of a histogram of flow or disparity: `bins` of [low, high), pixels.
struct ValueRange {
    double low, high;
    int bins;  ///< 1 to 65536
};

/// The bin of each value, `range.bins` for NaN and values outside [low, high), which is decided exactly; shared by
/// weighted_histogram and target_pixels.
///
/// bin = floor((value - low) (bins / (high - low))), at most bins - 1, in float32, to which low and the quotient are rounded.
void find_value_bins(const float* values, int n, const ValueRange& range, std::int32_t* bin);

/// @throws std::invalid_argument unless low < high are finite and there are 1 to 65536 bins
void require_range(const ValueRange& range);

}  // namespace tricue
