// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/simd.hpp"

namespace tricue {

/// The bins of a histogram of flow or disparity: `bins` of [low, high), pixels.
struct ValueRange {
    double low, high;
    int bins;  ///< 1 to 65536
};

/// The same in float32, as values are compared with it.
struct FloatRange {
    explicit FloatRange(const ValueRange& range);

    float least, end;   ///< a value counts from least on, below end
    float low, scale;   ///< bins per pixel
    float top;          ///< the last bin
    std::int32_t none;  ///< the number of bins
};

/// The bin of a value, as below.
TRICUE_INLINE std::int32_t value_bin(float value, const FloatRange& range) {
    const float place = (value - range.low) * range.scale;
    const bool counts = (value >= range.least) & (value < range.end);
    const float within = counts & (place < range.top) ? place : range.top;
    return counts ? static_cast<std::int32_t>(within) : range.none;
}

/// The bin of each value, `range.bins` for NaN and values outside [low, high), which is decided exactly; shared by
/// weighted_histogram and target_pixels.
///
/// bin = floor((value - low) (bins / (high - low))), at most bins - 1, in float32, to which low and the quotient are rounded.
void find_value_bins(const float* values, int n, const FloatRange& range, std::int32_t* bin);

/// @throws std::invalid_argument unless low < high are finite and there are 1 to 65536 bins
void require_range(const ValueRange& range);

}  // namespace tricue
